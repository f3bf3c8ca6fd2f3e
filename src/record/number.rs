/// Appends a number in the fewest digits that read back to the same f64; zero is `0` whatever its sign.
///
/// From 1e-5 up to 1e16 it is written out, beyond with an exponent. Infinity is `inf`; not a number is an empty field.
pub fn shortest(value: f64, out: &mut String) {
    use std::fmt::Write;
    // Writing to a string cannot fail.
    let _ = match value {
        v if v.is_nan() => Ok(()),
        0.0 => out.write_str("0"),
        v if (1e-5..1e16).contains(&v.abs()) || v.is_infinite() => write!(out, "{v}"),
        v => write!(out, "{v:e}"),
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_read_back() {
        let written = |value| {
            let mut out = String::new();
            shortest(value, &mut out);
            out
        };
        for (value, expected) in [
            (2.0, "2"),
            (-0.0, "0"),
            (0.1 + 0.2, "0.30000000000000004"),
            (1e-7, "1e-7"),
            (1e300, "1e300"),
            (100_000.0, "100000"),
            (123_456.0, "123456"),
            (0.001, "0.001"),
            (f64::INFINITY, "inf"),
            (f64::NAN, ""),
        ] {
            assert_eq!(written(value), expected);
        }
        for k in 0..10_000u64 {
            let value = f64::from_bits(k.wrapping_mul(0x9e37_79b9_7f4a_7c15));
            if value.is_finite() {
                assert_eq!(written(value).parse::<f64>().unwrap(), value);
            }
        }
    }
}

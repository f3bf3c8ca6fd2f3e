use std::io::Write;

/// Appends a number in the fewest digits that read back to the same f64; zero is `0`, without a sign.
///
/// Magnitudes from 1e-5 to below 1e16 are written without an exponent, all others with one. Infinity is `inf` or
/// `-inf`; NaN is an empty field.
pub fn append_number(value: f64, out: &mut Vec<u8>) {
    if value == 0.0 {
        out.push(b'0');
    } else if (1e-5..1e16).contains(&value.abs()) {
        let mut digits = zmij::Buffer::new();
        let written = digits.format_finite(value);
        out.extend_from_slice(written.strip_suffix(".0").unwrap_or(written).as_bytes());
    } else if value.is_infinite() {
        out.extend_from_slice(if value > 0.0 { b"inf" } else { b"-inf" });
    } else if !value.is_nan() {
        // Such numbers are rare. Writing to memory cannot fail.
        let _ = write!(out, "{value:e}");
    }
}

/// A number rounded to `digits` significant digits without trailing zeros; in scientific notation if its magnitude is
/// below `least_decimal` or at least 1e7.
pub fn format_significant(value: f64, digits: usize, least_decimal: f64) -> String {
    let rounded: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    match rounded {
        0.0 => "0".to_owned(),
        x if x.is_finite() && !(least_decimal..1e7).contains(&x.abs()) => format!("{x:e}"),
        x => x.to_string(),
    }
}

/// Appends a whole number.
pub fn append_integer(value: usize, out: &mut Vec<u8>) {
    out.extend_from_slice(itoa::Buffer::new().format(value).as_bytes());
}

/// A number in the fewest digits that read back to the same value.
pub(super) fn format_number(value: f64) -> String {
    let mut out = Vec::new();
    append_number(value, &mut out);
    String::from_utf8(out).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_read_back() {
        let written = |value| {
            let mut out = Vec::new();
            append_number(value, &mut out);
            String::from_utf8(out).unwrap()
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
            (f64::NEG_INFINITY, "-inf"),
            (f64::NAN, ""),
        ] {
            assert_eq!(written(value), expected);
        }
        for k in 0..10_000u64 {
            let value = f64::from_bits(k.wrapping_mul(0x9e37_79b9_7f4a_7c15));
            if value.is_finite() {
                assert_eq!(written(value).parse::<f64>().unwrap(), value);
            }
            // In the range without an exponent; the standard library's digits are the shortest, too.
            let usual = (value % 1e4) * 1e-3;
            if (1e-5..1e16).contains(&usual.abs()) {
                assert_eq!(written(usual), usual.to_string());
            }
        }
        for exponent in -5..16 {
            let power: f64 = format!("1e{exponent}").parse().unwrap();
            for value in
                [power, -power, power.next_up(), power * 1.5, power * 9.999].into_iter().filter(|v| v.abs() < 1e16)
            {
                assert_eq!(written(value), value.to_string());
            }
        }
    }
}

//! Lengths and deviations in a few digits, for people.

use coupler_curves::exchange::format_significant;

/// A length in six significant digits, for a path of a size: what is 0 but for rounding is 0.
pub fn format_length(value: f64, size: f64) -> String {
    const ROUNDING: f64 = 1e-12;
    if value.abs() < ROUNDING * size { "0".to_owned() } else { format_significant(value, 6, 1e-4 * size.min(1.0)) }
}

/// A deviation relative to the size of the path, in three significant digits.
pub fn format_relative(value: f64) -> String {
    format_length(format_significant(value, 3, 0.0).parse().unwrap_or(value), 1.0)
}

/// A length on a drawing, for a path of a size: to a ten-thousandth of it, which is less than a line is broad.
pub fn format_drawn_length(value: f64, size: f64) -> String {
    // As it is written, the exponent is exact.
    let exponent = format!("{size:e}").rsplit('e').next().and_then(|exponent| exponent.parse::<i32>().ok());
    let decimals = usize::try_from(4 - exponent.unwrap_or(0)).unwrap_or(0);
    let text = format!("{value:.decimals$}");
    let digits = |c: char| c == '0' || c == '.' || c == '-';
    if text.chars().all(digits) { "0".to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drawn_lengths_have_no_noise() {
        for (value, size, text) in [
            (-6.911_4, 17.0, "-6.911"),
            (6.911_13, 17.0, "6.911"),
            (-1e-9, 17.0, "0"),
            (170.293_4, 0.4, "170.29340"),
            (1234.5, 5e6, "1234"),
        ] {
            assert_eq!(format_drawn_length(value, size), text);
        }
    }
}

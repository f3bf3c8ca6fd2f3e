//! Decimal numbers as written on axes.

use super::super::typography;

/// The number `digits` times a power of ten, correctly rounded; `digits` is a whole number.
pub(super) fn decimal(digits: f64, power: i32) -> f64 {
    // Parsing is correctly rounded; a multiplication by a power of ten would not be.
    format!("{digits:.0}e{power}").parse().unwrap_or(f64::NAN)
}

/// The power of ten of the first digit of a number; 0 if it is zero or not finite.
pub(super) fn decimal_exponent(value: f64) -> i32 {
    format!("{:e}", value.abs()).split_once('e').and_then(|(_, power)| power.parse().ok()).unwrap_or(0)
}

/// A number with a fixed number of decimals, from 0 to 17.
pub(super) fn format_fixed(value: f64, decimals: i32) -> String {
    typography::format_fixed(value, decimals.clamp(0, 17) as usize)
}

/// A number as a multiple of a power of ten with a fixed number of decimals: `2.5×10⁻⁷`; zero is `0`.
pub(super) fn format_scientific(value: f64, power: i32, decimals: i32) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let power_of_ten = format!("10{}", typography::superscript(&power.to_string()));
    // Moving the decimal point in the text avoids the rounding of a division.
    let (mantissa, exponent) = split_exponent(value);
    let mantissa = format_fixed(parse_decimal(&mantissa, exponent - power), decimals);
    if mantissa == "1" { power_of_ten } else { format!("{mantissa}×{power_of_ten}") }
}

fn split_exponent(value: f64) -> (String, i32) {
    let text = format!("{value:e}");
    let (mantissa, power) = text.split_once('e').unwrap_or((&text, "0"));
    (mantissa.to_owned(), power.parse().unwrap_or(0))
}

fn parse_decimal(mantissa: &str, power: i32) -> f64 {
    format!("{mantissa}e{power}").parse().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_formatted_as_in_print() {
        assert_eq!(format_fixed(-0.25, 2), "−0.25");
        assert_eq!(format_fixed(-0.0, 1), "0.0");
        assert_eq!(format_scientific(1e-6, -6, 0), "10⁻⁶");
        assert_eq!(format_scientific(2.5e12, 12, 1), "2.5×10¹²");
        assert_eq!(format_scientific(-5e-7, -6, 1), "−0.5×10⁻⁶");
        assert_eq!(
            [decimal_exponent(1.0), decimal_exponent(0.0999), decimal_exponent(1e300), decimal_exponent(0.0)],
            [0, -2, 300, 0]
        );
        assert_eq!(decimal(3.0, -1), 0.3);
    }
}

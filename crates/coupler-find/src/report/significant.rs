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

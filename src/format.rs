//! Numbers, as text.

use coupler_curves::exchange;

/// A number rounded to `digits` significant digits, in scientific notation below 1e-5 and from 1e7 on.
pub fn format_significant(value: f64, digits: usize) -> String {
    exchange::format_significant(value, digits, 1e-5)
}

/// An angle in degrees, with one decimal.
pub fn angle(degrees: f64) -> String {
    // Without the sign of -0.0.
    format!("{:.1}°", (10.0 * degrees).round() / 10.0 + 0.0)
}

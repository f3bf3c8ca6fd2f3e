//! Values without their rounding.

/// An input from 0 up to a period.
pub(super) fn within_period(input: f64, period: f64) -> f64 {
    /// The accuracy with which starts of portions are found, in degrees.
    const SAME: f64 = 1e-6;
    let within = input.rem_euclid(period);
    if within > period - SAME { 0.0 } else { within }
}

/// A value, or 0 if it is no more than rounding.
pub(super) fn without_rounding(value: f64, rounding: f64) -> f64 {
    if value.abs() <= rounding { 0.0 } else { value }
}

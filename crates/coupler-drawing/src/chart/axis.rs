//! The range of an axis, and positions along it.

use super::Quantity;
use coupler_curves::geometry::trig;

/// Values of a greater magnitude count as infinite, and smaller values than its inverse as zero on a logarithmic axis.
const MAX_MAGNITUDE: f64 = 1e300;

/// Values with a smaller relative difference are equal up to rounding.
const ROUNDING: f64 = 1e-11;

/// Whether a value can be drawn.
pub fn is_drawable(value: f64, is_log: bool) -> bool {
    value.abs() <= MAX_MAGNITUDE && (value >= 1.0 / MAX_MAGNITUDE || !is_log)
}

/// A range with a length: a single value is extended by a tenth of itself on both sides, and zero by 1.
pub fn widen_range(low: f64, high: f64) -> [f64; 2] {
    let size = low.abs().max(high.abs());
    if high - low > ROUNDING * size && high - low > 1e-290 {
        return [low, high];
    }
    let margin = if size > 1e-290 { 0.1 * size } else { 1.0 };
    [low - margin, high + margin]
}

/// The range of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisRange {
    /// The least value.
    pub low: f64,
    /// The greatest value.
    pub high: f64,
    /// Whether the axis is logarithmic.
    pub is_log: bool,
}

impl AxisRange {
    /// The range of a quantity: its own, or that of the values that can be drawn.
    pub fn new(quantity: &Quantity, values: impl Iterator<Item = f64>) -> AxisRange {
        let is_log = quantity.is_log;
        let drawn = values.filter(|&value| is_drawable(value, is_log));
        let (low, high) = drawn.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        let [low, high] = quantity.range.unwrap_or_else(|| match (low <= high, is_log) {
            (true, true) if high <= low * (1.0 + ROUNDING) => [low / 2.0, high * 2.0],
            (true, true) => [low, high],
            (true, false) => widen_range(low, high),
            (false, _) => [1.0, 2.0],
        });
        AxisRange { low, high, is_log }
    }

    /// The position of a value along the axis, 0 at its start and 1 at its end; `None` if it cannot be drawn.
    pub fn fraction(&self, value: f64) -> Option<f64> {
        is_drawable(value, self.is_log).then(|| {
            let [low, high, value] = match self.is_log {
                true => [self.low, self.high, value].map(trig::log10),
                false => [self.low, self.high, value],
            };
            (value - low) / (high - low)
        })
    }
}

//! The motion of the output link along a circuit: its range, time ratio, dwell, toggle positions and ratios.

mod coordinate;
mod dwell;
pub(super) mod motion;
mod range;
mod ratio;
mod time_ratio;
mod toggles;

pub use dwell::{DWELL, DWELL_START};
pub use range::{MAX, MIN, STROKE, SWING, output_limit_poses};
pub use ratio::{MECHANICAL_ADVANTAGE_MAX, MECHANICAL_ADVANTAGE_MIN, VELOCITY_RATIO_MAX, VELOCITY_RATIO_MIN};
pub use time_ratio::TIME_RATIO;
pub use toggles::TOGGLES;

use std::cell::OnceCell;

use super::{TracedCurve, Value};
use coordinate::OutputCoordinate;
use motion::OutputMotion;

impl OutputMotion {
    /// The motion of the output link; `None` if the linkage has none, or its position is undefined somewhere.
    pub fn new(curve: &TracedCurve) -> Option<OutputMotion> {
        let coordinate = OutputCoordinate { output: curve.linkage.output()?, placement: curve.linkage.placement };
        let coordinate = curve.circuit_function(coordinate)?;
        let turns_fully =
            coordinate.is_closed() && coordinate.change().abs() > 1.0 && !coordinate.quantity().is_slider();
        let extremes = coordinate.extremes();
        let dwell_band = curve.linkage.dwell;
        let (dwell, velocity_ratios, toggle_count) = (OnceCell::new(), OnceCell::new(), OnceCell::new());
        Some(OutputMotion { coordinate, turns_fully, extremes, dwell_band, dwell, velocity_ratios, toggle_count })
    }

    /// Its swing in radians, 2 pi if it turns fully, or its stroke.
    fn travel(&self) -> f64 {
        let [least, greatest] = &self.extremes;
        if self.turns_fully { std::f64::consts::TAU } else { greatest.value - least.value }
    }

    /// Whether it does not move: its travel is only rounding.
    fn is_at_rest(&self) -> bool {
        const ROUNDING: f64 = 1e-11;
        let size = self.extremes.iter().map(|extreme| extreme.value.abs()).fold(0.0, f64::max);
        let scale = if self.coordinate.quantity().is_slider() { size } else { 1.0 };
        self.travel() <= ROUNDING * scale
    }
}

/// A value of a linkage with an output link; missing for others.
fn output_value(curve: &TracedCurve, value: impl Fn(&OutputMotion) -> Option<f64>) -> Value {
    curve.output().and_then(value).map_or(Value::Missing, Value::Number)
}

impl TracedCurve<'_> {
    /// The motion of the output link; `None` if there is none.
    pub(in crate::measure) fn output(&self) -> Option<&OutputMotion> {
        self.circuit_results.0.output.get_or_init(|| OutputMotion::new(self)).as_ref()
    }
}

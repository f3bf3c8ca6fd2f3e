//! Velocity ratio and mechanical advantage.

use super::motion::{OutputMotion, VelocityRatios};
use super::output_value;
use crate::measure::circuit_function::Place;
use crate::measure::{Measure, Subject};

/// The measure `velocity_ratio_min`.
pub const VELOCITY_RATIO_MIN: Measure = Measure::number(
    "velocity_ratio_min",
    "least velocity ratio",
    "",
    "least velocity ratio: derivative of the output's angle in radians, or of its displacement, with respect to the input in radians or as a length; -inf at a limit",
    |curve| output_value(curve, |output| Some(output.velocity_ratios().range[0])),
).of(Subject::WithOutput);

/// The measure `velocity_ratio_max`.
pub const VELOCITY_RATIO_MAX: Measure = Measure::number(
    "velocity_ratio_max",
    "greatest velocity ratio",
    "",
    "greatest velocity ratio; inf at a limit of the input",
    |curve| output_value(curve, |output| Some(output.velocity_ratios().range[1])),
)
.of(Subject::WithOutput);

/// The measure `mechanical_advantage_min`.
pub const MECHANICAL_ADVANTAGE_MIN: Measure = Measure::number(
    "mechanical_advantage_min",
    "least mechanical advantage",
    "",
    "least mechanical advantage without friction: output torque or force divided by that of the input, 1 / |velocity ratio|; 0 at a limit of the input",
    |curve| output_value(curve, |output| Some(output.velocity_ratios().magnitudes[1].recip())),
)
.more_is_better().of(Subject::WithOutput);

/// The measure `mechanical_advantage_max`.
pub const MECHANICAL_ADVANTAGE_MAX: Measure = Measure::number(
    "mechanical_advantage_max",
    "greatest mechanical advantage",
    "",
    "greatest mechanical advantage; inf at a toggle position",
    |curve| output_value(curve, |output| Some(output.velocity_ratios().magnitudes[0].recip())),
)
.more_is_better()
.of(Subject::WithOutput);

impl OutputMotion {
    /// The extremes of the velocity ratio.
    fn velocity_ratios(&self) -> VelocityRatios {
        *self.velocity_ratios.get_or_init(|| self.compute_velocity_ratios())
    }

    fn compute_velocity_ratios(&self) -> VelocityRatios {
        if self.is_at_rest() {
            return VelocityRatios { range: [0.0; 2], magnitudes: [0.0; 2] };
        }
        let coordinate = &self.coordinate;
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        let ratios: Vec<f64> =
            coordinate.steepest_places().into_iter().flat_map(|place| self.velocity_ratios_at(place)).collect();
        for &ratio in &ratios {
            range = [range[0].min(ratio), range[1].max(ratio)];
        }
        let changes_sign = range[0] < 0.0 && range[1] > 0.0;
        let least = if self.toggle_count() > 0 {
            0.0
        } else if changes_sign {
            // It does so at limits or corners only.
            ratios.iter().fold(f64::INFINITY, |least, ratio| least.min(ratio.abs()))
        } else {
            range[0].abs().min(range[1].abs())
        };
        VelocityRatios { range, magnitudes: [least, range[0].abs().max(range[1].abs())] }
    }

    /// The velocity ratios before and after a place: from the derivatives of the pose, or, where these are not defined or
    /// not exact, from the polynomial; infinite at a limit that the output passes.
    fn velocity_ratios_at(&self, place: Place) -> [f64; 2] {
        let coordinate = &self.coordinate;
        let ratio = coordinate.quantity().rate(&coordinate.derivatives(place));
        if ratio.is_finite() && !coordinate.is_next_to_change_point(place) {
            [ratio; 2]
        } else {
            coordinate.interpolated_rates(place)
        }
    }
}

//! Where a curve is nearest to a timed target at the inputs of its points.

use super::aim::Aim;
use super::circuit::Traced;
use crate::timing::{TimedPlace, TimedRow};
use coupler_curves::motion::Pass;

/// The pass on which a curve is nearest to a timed target, the input at the first point, and the place.
pub(super) fn best(aim: &Aim, traced: &Traced) -> Option<((usize, f64), TimedPlace)> {
    /// The steps of a turn, or of the range of a pass.
    const STEPS: usize = 96;
    let target = aim.timed.as_ref()?;
    let of_pass = |(number, pass): (usize, &Pass)| {
        let is_whole = traced.is_regular() && traced.is_full_turn();
        let [low, high] = pass.input_range();
        let step_deg = if is_whole { 360.0 / STEPS as f64 } else { (high - low) / STEPS as f64 };
        let count = if is_whole { (pass.input_length() / step_deg).round() as usize } else { STEPS + 1 };
        let inputs: Vec<f64> = (0..count).map(|k| (low + step_deg * k as f64).min(high)).collect();
        let points = traced.points_at(&traced.places_at_inputs(number, &inputs)?)?;
        let place = target.best_place(&TimedRow { points: &points, step_deg, is_whole })?;
        Some(((number, inputs[place.first]), place))
    };
    let found = traced.circuit.passes.iter().enumerate().filter_map(of_pass);
    found.reduce(|best, other| if other.1.sum < best.1.sum { other } else { best })
}

//! The time ratio of a linkage whose output goes back and forth while its input turns.

use super::motion::OutputMotion;
use super::output_value;
use crate::measure::circuit_function::Place;
use crate::measure::{Measure, Subject};

/// The measure `time_ratio`.
pub const TIME_RATIO: Measure = Measure::number(
    "time_ratio",
    "time ratio",
    "",
    "time ratio of an output that rocks or slides while the input turns fully: input angle of its slower stroke divided by that of its faster one; 1 or more",
    |curve| {
        /// Strokes that differ by less are equally long.
        const EQUAL: f64 = 1e-11;
        let is_full_turn = curve.circuit.is_full_turn();
        let ratio = |output: &OutputMotion| ratio(output).map(|ratio| if ratio < 1.0 + EQUAL { 1.0 } else { ratio });
        output_value(curve, |output| ratio(output).filter(|_| is_full_turn))
    },
).of(Subject::WithOutput);

fn ratio(output: &OutputMotion) -> Option<f64> {
    if output.turns_fully || output.is_at_rest() {
        return None;
    }
    let coordinate = &output.coordinate;
    let total = coordinate.total_input();
    // The input counted from the start of the circuit, with its last digits from the exact derivative.
    let covered = |place: Place| {
        let refined = coordinate.refined_input(place, |derivatives| coordinate.quantity().rate(derivatives));
        coordinate.covered_input(place) + (refined - coordinate.input(place))
    };
    let [least, greatest] = &output.extremes;
    let (starts, turns) = (&least.places, &greatest.places);
    // From the first place at the upper limit back to the last one before it at the lower limit, and forward to the
    // next: with these, an output that goes back and forth several times is measured on one of its strokes.
    let turn = covered(*turns.first()?);
    let distances = |sign: f64| starts.iter().map(move |&start| (sign * (covered(start) - turn)).rem_euclid(total));
    let [back, forth] = [-1.0, 1.0].map(|sign| distances(sign).fold(f64::INFINITY, f64::min));
    Some(back.max(forth) / back.min(forth))
}

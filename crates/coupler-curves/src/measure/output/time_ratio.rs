//! The time ratio of a linkage whose output goes back and forth while its input turns.

use super::motion::OutputMotion;
use super::output_value;
use crate::geometry::in_rising_order;
use crate::measure::circuit_function::Place;
use crate::measure::{Measure, Subject};

/// The measure `time_ratio`.
pub const TIME_RATIO: Measure = Measure::number(
    "time_ratio",
    "time ratio",
    "",
    "time ratio of an output that rocks or slides while the input turns fully: input angle of its slowest stroke from limit to limit divided by that of its fastest; 1 or more",
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
    // Where the output is at a limit, in the order of the circuit. A stroke is from the last place at one limit to the next
    // at the other: an output may reach a limit several times before it goes back, and go back and forth several times.
    let [least, greatest] = &output.extremes;
    let visits = [(least, false), (greatest, true)]
        .into_iter()
        .flat_map(|(limit, is_greatest)| limit.places.iter().map(move |&place| (place, is_greatest)))
        .map(|(place, is_greatest)| (covered(place), is_greatest));
    let visits = in_rising_order(visits.collect(), |visit| visit.0);
    let next = visits.iter().cycle().skip(1);
    let strokes = visits.iter().zip(next).filter(|(from, to)| from.1 != to.1);
    let [shortest, longest] = strokes
        .map(|(from, to)| (to.0 - from.0).rem_euclid(total))
        .fold([f64::INFINITY, 0.0f64], |[least, most], stroke| [least.min(stroke), most.max(stroke)]);
    (shortest.is_finite()).then(|| longest / shortest)
}

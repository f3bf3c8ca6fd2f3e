use super::curve::Place;
use super::{Measure, TracedCurve, Value};
use crate::linkage::Input;

/// The measure `speed_ratio`.
pub const SPEED_RATIO: Measure = Measure::number(
    "speed_ratio",
    "ratio of the longest dash to the shortest",
    "",
    "ratio of the longest dash to the shortest: the first 3 of every 5 deg of input, from input 0, except those cut by the end of a pass",
    |curve: &TracedCurve| ratio(curve).map_or(Value::Missing, Value::Number),
);

fn ratio(curve: &TracedCurve) -> Option<f64> {
    const PERIOD: f64 = 5.0;
    const DASH_SPAN: f64 = 3.0;
    if curve.linkage.input() == Input::Length {
        return None;
    }
    let (smooth, lengths) = (curve.smooth(), curve.arc_length());
    let [mut least, mut greatest] = [f64::INFINITY, 0.0f64];
    let mut from = 0;
    for (k, pass) in curve.circuit.passes.iter().enumerate() {
        let [low, high] = pass.input_range();
        let (first, last) = ((low / PERIOD).ceil() as i64, ((high - DASH_SPAN) / PERIOD).floor() as i64);
        let mut dash = |dash: i64| {
            let begin = dash as f64 * PERIOD;
            let mut ends = [begin, begin + DASH_SPAN];
            if pass.input_direction() < 0.0 {
                ends.reverse();
            }
            let [a, b]: [Option<Place>; 2] = ends.map(|input| {
                let place = smooth.find(k, input, from)?;
                from = place.piece;
                Some(place)
            });
            let (a, b) = (lengths.at(a?), lengths.at(b?));
            // The end of a full turn is its beginning.
            Some(if b >= a { b - a } else { b + lengths.total() - a })
        };
        let dashes: Vec<i64> =
            if pass.input_direction() > 0.0 { (first..=last).collect() } else { (first..=last).rev().collect() };
        for length in dashes.into_iter().filter_map(&mut dash) {
            (least, greatest) = (least.min(length), greatest.max(length));
        }
    }
    (greatest > 0.0).then(|| greatest / least)
}

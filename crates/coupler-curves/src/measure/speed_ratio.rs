use super::{Measure, TracedCurve, Value};
use crate::linkage::Input;
use crate::motion;

/// The measure `speed_ratio`.
pub const SPEED_RATIO: Measure = Measure {
    name: "speed_ratio",
    unit: "",
    is_word: false,
    definition: "ratio of the longest dash to the shortest: the first 3 of every 5 deg of input, from input 0, except those cut by the end of a pass",
    compute: |curve: &TracedCurve| ratio(curve).map_or(Value::Missing, Value::Number),
};

fn ratio(curve: &TracedCurve) -> Option<f64> {
    const PERIOD: f64 = 5.0;
    const DASH_SPAN: f64 = 3.0;
    /// Points of a dash.
    const POINTS: usize = 5;
    if curve.linkage.input() == Input::Length {
        return None;
    }
    let (linkage, joint) = curve.single_point_linkage();
    let mut lengths: Vec<f64> = Vec::new();
    for pass in &curve.circuit.passes {
        let [low, high] = pass.input_range();
        let (first, last) = ((low / PERIOD).ceil() as i64, ((high - DASH_SPAN) / PERIOD).floor() as i64);
        let input_at = |k: i64, i: usize| k as f64 * PERIOD + DASH_SPAN * i as f64 / (POINTS - 1) as f64;
        let inputs: Vec<f64> = (first..=last).flat_map(|k| (0..POINTS).map(move |i| input_at(k, i))).collect();
        let columns = motion::poses(linkage, pass, &inputs);
        for k in 0..inputs.len() / POINTS {
            let at = |i: usize| columns.point(joint, k * POINTS + i);
            let chords =
                |step: usize| (0..POINTS - 1).step_by(step).map(|i| (at(i + step) - at(i)).norm()).sum::<f64>();
            // Richardson extrapolation: the error of the chords is a quarter for chords half as long, apart from the
            // fourth power of their length, which is less than a millionth for three degrees.
            lengths.push((4.0 * chords(1) - chords(2)) / 3.0);
        }
    }
    let [least, greatest] =
        lengths.iter().fold([f64::INFINITY, 0.0f64], |[least, greatest], l| [least.min(*l), greatest.max(*l)]);
    (greatest > 0.0).then(|| greatest / least)
}

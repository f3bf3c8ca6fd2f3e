use super::{Measure, TracedCurve, Value};
use crate::linkage::Input;
use crate::motion;

/// How evenly the path is gone through.
pub const SPEED_RATIO: Measure = Measure {
    name: "speed_ratio",
    unit: "",
    is_word: false,
    definition: "longest dash to shortest: the first 3 of every 5 deg of input, from input 0, without those that a pass's end cuts",
    compute: |subject: &TracedCurve| ratio(subject).map_or(Value::Missing, Value::Number),
};

fn ratio(subject: &TracedCurve) -> Option<f64> {
    const PERIOD: f64 = 5.0;
    const DRAWN: f64 = 3.0;
    /// Places in a dash.
    const PLACES: usize = 5;
    if subject.linkage.input() == Input::Length {
        return None;
    }
    let (linkage, joint) = subject.single_point_linkage();
    let mut lengths: Vec<f64> = Vec::new();
    for pass in &subject.circuit.passes {
        let [low, high] = pass.input_range();
        let (first, last) = ((low / PERIOD).ceil() as i64, ((high - DRAWN) / PERIOD).floor() as i64);
        let place = |k: i64, i: usize| k as f64 * PERIOD + DRAWN * i as f64 / (PLACES - 1) as f64;
        let inputs: Vec<f64> = (first..=last).flat_map(|k| (0..PLACES).map(move |i| place(k, i))).collect();
        let columns = motion::poses(linkage, pass, &inputs);
        for k in 0..inputs.len() / PLACES {
            let at = |i: usize| columns.point(joint, k * PLACES + i);
            let chords =
                |step: usize| (0..PLACES - 1).step_by(step).map(|i| (at(i + step) - at(i)).norm()).sum::<f64>();
            // What chords miss of an arc is a quarter for chords half as long, but for the fourth power of their length:
            // of three degrees, less than a millionth.
            lengths.push((4.0 * chords(1) - chords(2)) / 3.0);
        }
    }
    let [least, greatest] =
        lengths.iter().fold([f64::INFINITY, 0.0f64], |[least, greatest], l| [least.min(*l), greatest.max(*l)]);
    (greatest > 0.0).then(|| greatest / least)
}

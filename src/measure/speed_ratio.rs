use super::trail::Trail;
use super::{Measure, Subject, Value};
use crate::linkage::Input;
use crate::motion;

/// How evenly the path is gone through.
pub const SPEED_RATIO: Measure = Measure {
    name: "speed_ratio",
    unit: "",
    is_word: false,
    definition: "longest dash to shortest: the first 3 of every 5 deg of input, from input 0, without those that a pass's end cuts",
    take: |subject: &Subject| ratio(subject).map_or(Value::Missing, Value::Number),
};

fn ratio(subject: &Subject) -> Option<f64> {
    const PERIOD: f64 = 5.0;
    const DRAWN: f64 = 3.0;
    /// Places in a dash: by circles through three of them its length is good to a millionth.
    const PLACES: usize = 5;
    if subject.linkage.input() == Input::Length {
        return None;
    }
    let mut lengths: Vec<f64> = Vec::new();
    for pass in &subject.circuit.passes {
        let [low, high] = [pass.from.stop.at.min(pass.to.stop.at), pass.from.stop.at.max(pass.to.stop.at)];
        let (first, last) = ((low / PERIOD).ceil() as i64, ((high - DRAWN) / PERIOD).floor() as i64);
        let place = |k: i64, i: usize| k as f64 * PERIOD + DRAWN * i as f64 / (PLACES - 1) as f64;
        let inputs: Vec<f64> = (first..=last).flat_map(|k| (0..PLACES).map(move |i| place(k, i))).collect();
        let columns = motion::poses(subject.linkage, pass, &inputs);
        for k in 0..inputs.len() / PLACES {
            let points = (0..PLACES).map(|i| columns.point(subject.joint, k * PLACES + i)).collect();
            lengths.push(Trail::through(points).lengths().iter().sum());
        }
    }
    let [least, greatest] =
        lengths.iter().fold([f64::INFINITY, 0.0f64], |[least, greatest], l| [least.min(*l), greatest.max(*l)]);
    (greatest > 0.0).then(|| greatest / least)
}

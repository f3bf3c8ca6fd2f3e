use super::extreme::extremes;
use super::{Measure, TracedCurve, Value};
use crate::geometry::{Vector, complex_product, cross, trig};
use crate::linkage::FourBar;

/// The measure `output_swing_deg`.
pub const OUTPUT_SWING: Measure = Measure {
    name: "output_swing_deg",
    unit: "deg",
    is_word: false,
    definition: "angle that the output link of a four-bar swings through over the circuit; 360 if it turns fully",
    compute: |curve: &TracedCurve| swing(curve).map_or(Value::Missing, Value::Number),
};

fn swing(curve: &TracedCurve) -> Option<f64> {
    let [_, _, b, c] = FourBar::pins(curve.linkage)?;
    let circuit = curve.circuit;
    let arm = |i: usize| circuit.positions.point(b, i) - circuit.positions.point(c, i);
    let angle = |from: Vector, to: Vector| trig::degrees(trig::atan2(cross(from, to), from.dot(&to)));
    // The rotation from the first sample to each sample, and over the whole circuit.
    let mut turned = vec![0.0];
    for i in 1..circuit.len() {
        turned.push(turned[i - 1] + angle(arm(i - 1), arm(i)));
    }
    let last = circuit.len() - 1;
    if circuit.is_closed && (turned[last] + angle(arm(last), arm(0))).abs() > 180.0 {
        return Some(360.0);
    }
    // If it rocks, it is never more than 180 degrees from the middle of its swing, so that signed angles from there are
    // unambiguous.
    let [low, high] = turned.iter().fold([0.0f64; 2], |[low, high], t| [low.min(*t), high.max(*t)]);
    let (cos, sin) = trig::cos_sin_deg((low + high) / 2.0);
    let first = arm(0);
    let middle = complex_product(Vector::new(cos, sin), first);
    let [least, greatest] = extremes(curve, |position| angle(middle, position(b) - position(c)));
    Some(greatest - least)
}

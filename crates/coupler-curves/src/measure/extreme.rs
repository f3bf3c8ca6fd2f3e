//! Extremes of a quantity over a circuit.

use super::TracedCurve;
use crate::geometry::Point;
use crate::linkage::JointId;
use crate::motion::{self, Pass};

/// The least and the greatest value over a circuit of a quantity of the pose, from its samples and then from parabolas
/// between them. `quantity` is called with the positions of the joints. The error of the value is of the second order
/// in that of the input at the extreme.
pub(super) fn extremes(curve: &TracedCurve, quantity: impl Fn(&dyn Fn(JointId) -> Point) -> f64) -> [f64; 2] {
    let circuit = curve.circuit;
    let values: Vec<f64> = (0..circuit.len()).map(|i| quantity(&|joint| circuit.positions.point(joint, i))).collect();
    let at = |pass: &Pass, input: f64| {
        let pose = motion::pose(curve.single_point_linkage().0, pass, input);
        quantity(&|joint| pose[joint])
    };
    [1.0, -1.0].map(|sign| {
        let finite = (0..values.len()).filter(|&i| values[i].is_finite());
        let Some(best) = finite.min_by(|&a, &b| (sign * values[a]).total_cmp(&(sign * values[b]))) else {
            return f64::NAN;
        };
        let mut least = sign * values[best];
        for pass in &circuit.passes {
            let [low, high] = pass.input_range();
            let middle = circuit.inputs[best];
            // On a full turn the first sample is between the last and the second.
            let step = (high - low) / circuit.len().max(2) as f64;
            let turn = if middle > high { low - high } else { 0.0 };
            if pass.mode == circuit.mode_at(best) && (low - step..=high + step).contains(&(middle + turn)) {
                let neighbours = [-1, 1].map(|direction: isize| {
                    let k = best as isize + direction;
                    let neighbour = usize::try_from(k).ok().and_then(|k| circuit.inputs.get(k));
                    let distance = neighbour.map_or(step, |input| (input - middle).abs());
                    (middle + turn + direction as f64 * distance).clamp(low, high)
                });
                least = least.min(parabolic_minimum(
                    |input| sign * at(pass, input),
                    neighbours[0],
                    middle + turn,
                    neighbours[1],
                ));
            }
        }
        sign * least
    })
}

/// The minimum of a function around `b`, where it is less than at both ends, by parabolas through three points.
fn parabolic_minimum(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64, mut c: f64) -> f64 {
    const ROUNDS: usize = 8;
    let (mut fa, mut fb, mut fc) = (f(a), f(b), f(c));
    for _ in 0..ROUNDS {
        let (left, right) = ((b - a) * (fb - fc), (b - c) * (fb - fa));
        let vertex = b - ((b - a) * left - (b - c) * right) / (2.0 * (left - right));
        if !vertex.is_finite() || vertex <= a || vertex >= c || vertex == b {
            break;
        }
        let fv = f(vertex);
        if fv > fb {
            // The vertex is a new end.
            if vertex < b { (a, fa) = (vertex, fv) } else { (c, fc) = (vertex, fv) }
        } else if vertex < b {
            (c, fc, b, fb) = (b, fb, vertex, fv);
        } else {
            (a, fa, b, fb) = (b, fb, vertex, fv);
        }
    }
    fb.min(fa).min(fc)
}

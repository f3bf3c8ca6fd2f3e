//! The distance of two curves as sets of points, independent of how they are sampled.

use super::curve_samples::CurveSamples;
use coupler_curves::geometry::{Point, Vector, cross, distance_to_segment};
use coupler_curves::linkage::JointId;
use coupler_curves::motion::{Circuit, Pass, poses};
use coupler_curves::solve::SolvedCell;

/// The Hausdorff distance of a recorded and a current curve: the greatest distance of a recorded point from the current
/// curve, or of a current sample from the recorded curve, whichever is more.
///
/// The distance from the current curve is found by solving the linkage for the point nearest to a recorded point, and
/// is exact to rounding except near a limit. The distance from the recorded curve is a lower bound, found from its
/// samples: between them the curve is taken to be no more curved than at its neighbouring samples.
pub(super) fn hausdorff_distance(
    recorded: &CurveSamples,
    current: &CurveSamples,
    (solved, joint, circuit): (&SolvedCell, JointId, &Circuit),
) -> f64 {
    let curve = CurveDistance { solved, joint, circuit, samples: current };
    let from_current = thinned_points(recorded, current.len()).map(|p| curve.distance(p));
    let from_recorded =
        thinned_points(current, recorded.len()).map(|p| distance_from_samples(p, recorded, circuit.is_closed));
    from_current.chain(from_recorded).filter(|distance| !distance.is_nan()).fold(0.0, f64::max)
}

/// The points of a curve that exist, thinned so that not too many pairs are compared with `others` points.
fn thinned_points(samples: &CurveSamples, others: usize) -> impl Iterator<Item = Point> {
    /// This many pairs are compared within a few hundredths of a second.
    const MAX_PAIRS: usize = 4_000_000;
    let step = (samples.len() * others).div_ceil(MAX_PAIRS).max(1);
    samples.points.iter().copied().step_by(step).filter(|p| !p.x.is_nan() && !p.y.is_nan())
}

/// Computes distances from the curve of a joint.
struct CurveDistance<'a> {
    solved: &'a SolvedCell,
    joint: JointId,
    circuit: &'a Circuit,
    samples: &'a CurveSamples,
}

impl CurveDistance<'_> {
    /// The distance of a point from the curve.
    fn distance(&self, point: Point) -> f64 {
        /// The iteration starts from this many samples: a curve may come near a point more than once.
        const STARTS: usize = 2;
        let square = |k: usize| (self.samples.points[k] - point).norm_squared();
        let mut order: Vec<usize> = (0..self.samples.len()).filter(|&k| !square(k).is_nan()).collect();
        let starts = STARTS.min(order.len());
        if starts > 0 && starts < order.len() {
            order.select_nth_unstable_by(starts - 1, |&a, &b| square(a).total_cmp(&square(b)));
        }
        order[..starts].iter().map(|&k| self.distance_near_sample(k, point)).fold(f64::INFINITY, f64::min)
    }

    /// The distance of a point from the curve near a sample.
    fn distance_near_sample(&self, k: usize, point: Point) -> f64 {
        let input = self.samples.inputs[k];
        let mut best = (self.samples.points[k] - point).norm();
        let contains_input = |pass: &&Pass| (pass.input_range()[0]..=pass.input_range()[1]).contains(&input);
        for pass in self.circuit.passes.iter().filter(contains_input) {
            best = best.min(self.distance_on_pass(pass, input, point));
        }
        best
    }

    /// The distance of a point from the curve on a pass, by Newton's method from an input.
    fn distance_on_pass(&self, pass: &Pass, mut at: f64, point: Point) -> f64 {
        const STEPS: usize = 5;
        let [low, high] = pass.input_range();
        // Small enough for second-order differences, and large enough that they are not lost in rounding.
        let step = 1e-4 * (high - low).min(1.0);
        let mut best = f64::INFINITY;
        for _ in 0..STEPS {
            let middle = at.clamp(low + step, high - step);
            let positions = poses(&self.solved.linkage, pass, &[middle - step, middle, middle + step, at]);
            let [a, b, c, own] = [0, 1, 2, 3].map(|k| positions.point(self.joint, k));
            let (first, second) = ((c - a) / (2.0 * step), ((c - b) - (b - a)) / (step * step));
            best = best.min(normal_distance(own, first + second * (at - middle), point));
            let from = b - point;
            // A Newton step to where the line to the point is perpendicular to the curve.
            let correction = from.dot(&first) / (first.norm_squared() + from.dot(&second));
            let next = (middle - correction).clamp(low, high);
            if !next.is_finite() || next == at {
                break;
            }
            at = next;
        }
        best
    }
}

/// The distance of `point` from a curve near `position`, where its derivative is `derivative`: along the normal if the
/// foot of the perpendicular is close to `position`.
fn normal_distance(position: Point, derivative: Vector, point: Point) -> f64 {
    let offset = point - position;
    match derivative.try_normalize(0.0) {
        Some(tangent) if tangent.dot(&offset).abs() < 1e-6 * derivative.norm() => cross(tangent, offset).abs(),
        _ => offset.norm(),
    }
}

/// A lower bound of the distance of a point from the curve through some samples.
fn distance_from_samples(point: Point, samples: &CurveSamples, closed: bool) -> f64 {
    let n = samples.len();
    let at = |k: usize| samples.points[k % n];
    let chords = if closed { n } else { n.saturating_sub(1) };
    let from_chord = |k: usize| {
        let (a, b) = (at(k), at(k + 1));
        let distance = distance_to_segment(point, a, b);
        if distance.is_nan() {
            return f64::INFINITY;
        }
        // Between two samples the curve is taken to leave their chord at most twice as far as the circle through them
        // and a neighbour does.
        let before = if k > 0 || closed { curvature([at(k + n - 1), a, b]) } else { 0.0 };
        let after = if k + 2 < n || closed { curvature([a, b, at(k + 2)]) } else { 0.0 };
        (distance - (b - a).norm_squared() * before.max(after) / 4.0).max(0.0)
    };
    (0..chords).map(from_chord).fold(if n == 1 { (at(0) - point).norm() } else { f64::INFINITY }, f64::min)
}

/// The curvature of the circle through three points; 0 if two of them coincide.
fn curvature([a, b, c]: [Point; 3]) -> f64 {
    let curvature = 2.0 * cross(b - a, c - b) / ((b - a).norm() * (c - b).norm() * (c - a).norm());
    if curvature.is_finite() { curvature.abs() } else { 0.0 }
}

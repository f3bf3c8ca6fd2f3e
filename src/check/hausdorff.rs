//! How far two curves are apart as sets of points, whatever their samples.

use super::curve_samples::CurveSamples;
use coupler_curves::geometry::{Point, Vector, cross, distance_to_segment};
use coupler_curves::linkage::JointId;
use coupler_curves::motion::{Circuit, Pass, poses};
use coupler_curves::solve::SolvedCell;

/// How far recorded points are from the curve that comes out now at most, or the samples of that from the recorded
/// curve, whichever is more.
///
/// The one is found from the linkage itself: the place on its curve that is nearest to a recorded point, to rounding but
/// near a limit. The other is found from the recorded samples, between which the curve may bend as their neighbours do.
pub(super) fn hausdorff_distance(
    was: &CurveSamples,
    is: &CurveSamples,
    (solved, joint, circuit): (&SolvedCell, JointId, &Circuit),
) -> f64 {
    let nearest = CurveDistance { solved, joint, circuit, samples: is };
    let out = thinned_points(was, is.len()).map(|p| nearest.distance(p));
    let back = thinned_points(is, was.len()).map(|p| distance_from_samples(p, was, circuit.is_closed));
    out.chain(back).filter(|far| !far.is_nan()).fold(0.0, f64::max)
}

/// The samples of a curve that have a place; of very many, as many as can be held against so many of another.
fn thinned_points(track: &CurveSamples, others: usize) -> impl Iterator<Item = Point> {
    /// So many pairs are looked at in a few hundredths of a second.
    const MAX_PAIRS: usize = 4_000_000;
    let step = (track.len() * others).div_ceil(MAX_PAIRS).max(1);
    track.points.iter().copied().step_by(step).filter(|p| !p.x.is_nan() && !p.y.is_nan())
}

/// For the places on a curve that are nearest to others.
struct CurveDistance<'a> {
    solved: &'a SolvedCell,
    joint: JointId,
    circuit: &'a Circuit,
    samples: &'a CurveSamples,
}

impl CurveDistance<'_> {
    fn distance(&self, point: Point) -> f64 {
        /// So many samples are gone out from: a curve may come near a point more than once.
        const STARTS: usize = 2;
        let square = |k: usize| (self.samples.points[k] - point).norm_squared();
        let mut order: Vec<usize> = (0..self.samples.len()).filter(|&k| !square(k).is_nan()).collect();
        let begun = STARTS.min(order.len());
        if begun > 0 && begun < order.len() {
            order.select_nth_unstable_by(begun - 1, |&a, &b| square(a).total_cmp(&square(b)));
        }
        order[..begun].iter().map(|&k| self.distance_near_sample(k, point)).fold(f64::INFINITY, f64::min)
    }

    /// From the place that is nearest about a sample.
    fn distance_near_sample(&self, k: usize, point: Point) -> f64 {
        let at = self.samples.inputs[k];
        let mut best = (self.samples.points[k] - point).norm();
        let holds = |pass: &&Pass| (pass.input_range()[0]..=pass.input_range()[1]).contains(&at);
        for pass in self.circuit.passes.iter().filter(holds) {
            best = best.min(self.distance_on_pass(pass, at, point));
        }
        best
    }

    fn distance_on_pass(&self, pass: &Pass, mut at: f64, point: Point) -> f64 {
        const STEPS: usize = 5;
        let [low, high] = pass.input_range();
        // Near enough for differences of the second order, and far enough for them to be more than rounding.
        let by = 1e-4 * (high - low).min(1.0);
        let mut best = f64::INFINITY;
        for _ in 0..STEPS {
            let middle = at.clamp(low + by, high - by);
            let places = poses(&self.solved.linkage, pass, &[middle - by, middle, middle + by, at]);
            let [a, b, c, own] = [0, 1, 2, 3].map(|k| places.point(self.joint, k));
            let (rate, bend) = ((c - a) / (2.0 * by), ((c - b) - (b - a)) / (by * by));
            best = best.min(normal_distance(own, rate + bend * (at - middle), point));
            let from = b - point;
            // To where the way to the point is square to the curve.
            let step = from.dot(&rate) / (rate.norm_squared() + from.dot(&bend));
            let next = (middle - step).clamp(low, high);
            if !next.is_finite() || next == at {
                break;
            }
            at = next;
        }
        best
    }
}

/// How far a point is from a curve at a place near it: along the normal, where it is nearly opposite.
fn normal_distance(place: Point, rate: Vector, point: Point) -> f64 {
    let way = point - place;
    match rate.try_normalize(0.0) {
        Some(along) if along.dot(&way).abs() < 1e-6 * rate.norm() => cross(along, way).abs(),
        _ => way.norm(),
    }
}

/// How far a point is from the curve through some samples, by no more than is certain.
fn distance_from_samples(point: Point, samples: &CurveSamples, closed: bool) -> f64 {
    let n = samples.len();
    let at = |k: usize| samples.points[k % n];
    let chords = if closed { n } else { n.saturating_sub(1) };
    let from_chord = |k: usize| {
        let (a, b) = (at(k), at(k + 1));
        let far = distance_to_segment(point, a, b);
        if far.is_nan() {
            return f64::INFINITY;
        }
        // Between two samples the curve leaves their chord as far as a circle through them and a neighbour does, or twice that.
        let before = if k > 0 || closed { curvature([at(k + n - 1), a, b]) } else { 0.0 };
        let after = if k + 2 < n || closed { curvature([a, b, at(k + 2)]) } else { 0.0 };
        (far - (b - a).norm_squared() * before.max(after) / 4.0).max(0.0)
    };
    (0..chords).map(from_chord).fold(if n == 1 { (at(0) - point).norm() } else { f64::INFINITY }, f64::min)
}

/// How much the circle through three points bends.
fn curvature([a, b, c]: [Point; 3]) -> f64 {
    let bend = 2.0 * cross(b - a, c - b) / ((b - a).norm() * (c - b).norm() * (c - a).norm());
    if bend.is_finite() { bend.abs() } else { 0.0 }
}

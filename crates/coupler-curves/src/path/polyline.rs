//! The path of a joint as a polyline through positions on it.

use crate::geometry::{Point, distance_to_segment, simplify_polyline};
use crate::linkage::{Input, JointId, Linkage};
use crate::motion::{self, Circuit, Pass};

/// The path that a joint traces on a circuit, from its beginning to its end, through positions of the joint.
///
/// No chord is further than `tolerance` (in the plane's unit) from the curve: half of that is for the refinement, as
/// measured at the first quarter and the middle of a chord's input, and half for the removal of points that are that
/// close to the line without them. Where a position is undefined, or jumps between neighbouring values of the input, a
/// chord leads across.
pub fn joint_polyline(linkage: &Linkage, circuit: &Circuit, joint: JointId, tolerance: f64) -> Vec<Point> {
    let mut out: Vec<Point> = Vec::new();
    for pass in &circuit.passes {
        let ends = [pass.from.input.value, pass.to.input.value];
        let points = refined_lines(linkage, pass, ends, joint, tolerance, MAX_NODES).concat();
        let meets = |end: &Point| points.first().is_some_and(|start| (end - start).norm() <= tolerance);
        let seam = usize::from(out.last().is_some_and(meets));
        out.extend(points.into_iter().skip(seam));
    }
    out
}

/// The most nodes of a path: with more it is not refined further, even if the tolerance is not met.
pub(super) const MAX_NODES: usize = 100_000;

/// The path of a joint between two inputs of a pass, in lines without undefined positions and jumps; see
/// [`joint_polyline`]. From more than `max_nodes` nodes it is not refined further.
pub(super) fn refined_lines(
    linkage: &Linkage,
    pass: &Pass,
    [from, to]: [f64; 2],
    joint: JointId,
    tolerance: f64,
    max_nodes: usize,
) -> Vec<Vec<Point>> {
    let nodes = PathNodes::between(linkage, pass, [from, to], joint, tolerance / 2.0, max_nodes);
    nodes.unbroken_lines(tolerance).into_iter().map(|line| simplify_polyline(line, tolerance / 2.0)).collect()
}

/// Inputs of a pass, and the positions of a joint there.
struct PathNodes {
    inputs: Vec<f64>,
    /// Whether the path from a node to the next may be further from its chord than the tolerance.
    needs_refinement: Vec<bool>,
    points: Vec<Point>,
}

impl PathNodes {
    /// Enough nodes for the joint to be no further than `tolerance` from its chords, at the middles of their inputs.
    fn between(
        linkage: &Linkage,
        pass: &Pass,
        [from, to]: [f64; 2],
        joint: JointId,
        tolerance: f64,
        max_nodes: usize,
    ) -> PathNodes {
        /// The most input that a chord spans, in degrees of the fastest crank: a longer one may cross its curve at its
        /// middle.
        const MAX_CHORD_DEG: f64 = 3.0;
        /// The fewest chords of a pass.
        const MIN_CHORDS: f64 = 64.0;
        /// Each round halves the input between neighbours. After this many they are neighbouring numbers: near a
        /// singular position a joint may go as far as its links reach while the input changes by no more.
        const MAX_ROUNDS: usize = 60;
        let share = pass.input_length() / MIN_CHORDS;
        let longest = match linkage.input() {
            Input::Angle { .. } => share.min(MAX_CHORD_DEG / linkage.fastest_crank_ratio()),
            Input::Length => share,
        };
        let chords = ((to - from).abs() / longest).ceil().clamp(1.0, max_nodes as f64);
        let inner = (0..chords as usize).map(|k| from + (to - from) * (k as f64 / chords));
        let mut nodes = PathNodes::at_inputs(linkage, pass, inner.chain([to]).collect(), joint);
        for _ in 0..MAX_ROUNDS {
            let pairs = |k: &usize| nodes.needs_refinement[k - 1];
            let pairs: Vec<usize> = (1..nodes.inputs.len()).filter(pairs).collect();
            if pairs.is_empty() || nodes.inputs.len() > max_nodes {
                break;
            }
            let at = |share: &dyn Fn(f64, f64) -> f64| {
                let inputs = pairs.iter().map(|&k| share(nodes.inputs[k - 1], nodes.inputs[k])).collect();
                PathNodes::at_inputs(linkage, pass, inputs, joint)
            };
            let (middles, quarters) = (at(&|a, b| (a + b) / 2.0), at(&|a, b| a + (b - a) / 4.0));
            nodes = nodes.refined(&middles, &quarters, tolerance);
        }
        nodes
    }

    fn at_inputs(linkage: &Linkage, pass: &Pass, inputs: Vec<f64>, joint: JointId) -> PathNodes {
        let positions = motion::poses(linkage, pass, &inputs);
        let points = (0..inputs.len()).map(|k| positions.point(joint, k)).collect();
        PathNodes { needs_refinement: vec![true; inputs.len()], points, inputs }
    }

    /// Inserts the middles of those chords that are further than `tolerance` from their curve at its middle, or at its
    /// first quarter: at its middle the curve may cross the chord. Also of those whose middle is near one end: then the
    /// joint moves fast in one half, and not necessarily along the chord.
    fn refined(&self, middles: &PathNodes, quarters: &PathNodes, tolerance: f64) -> PathNodes {
        let mut out = PathNodes { inputs: Vec::new(), needs_refinement: Vec::new(), points: Vec::new() };
        let mut push = |input: f64, point: Point, needs_refinement: bool| {
            out.inputs.push(input);
            out.points.push(point);
            out.needs_refinement.push(needs_refinement);
        };
        let mut next = 0;
        for (k, &from) in self.points.iter().enumerate() {
            let is_refined = self.needs_refinement[k] && k + 1 < self.points.len();
            let exceeds_tolerance = is_refined && {
                let (middle, to) = (middles.points[next], self.points[k + 1]);
                distance_to_segment(middle, from, to) > tolerance
                    || distance_to_segment(quarters.points[next], from, to) > tolerance
                    || is_uneven([from, middle, to], tolerance)
            };
            push(self.inputs[k], from, exceeds_tolerance);
            if exceeds_tolerance {
                push(middles.inputs[next], middles.points[next], true);
            }
            next += usize::from(is_refined);
        }
        out
    }

    /// The lines of nodes without undefined positions and jumps.
    fn unbroken_lines(&self, tolerance: f64) -> Vec<&[Point]> {
        let is_defined = |p: &Point| p.x.is_finite() && p.y.is_finite();
        let is_jump = |k: usize| {
            let [a, b] = [self.inputs[k], self.inputs[k + 1]];
            let middle = (a + b) / 2.0;
            (middle == a || middle == b) && (self.points[k + 1] - self.points[k]).norm() > tolerance
        };
        let mut lines = Vec::new();
        let mut from = 0;
        for (k, point) in self.points.iter().enumerate() {
            if !is_defined(point) {
                lines.push(&self.points[from..k]);
                from = k + 1;
            } else if k + 1 < self.points.len() && is_jump(k) {
                lines.push(&self.points[from..=k]);
                from = k + 1;
            }
        }
        lines.push(&self.points[from..]);
        lines.retain(|line| !line.is_empty());
        lines
    }
}

/// Whether the middle of a chord's input is so near one of its ends that the chord cannot be judged by it, and the chord
/// is longer than `tolerance`. Next to a limit the larger part is 2.4 times the smaller one, next to a cusp 3 times.
fn is_uneven([from, middle, to]: [Point; 3], tolerance: f64) -> bool {
    const MAX_RATIO: f64 = 4.0;
    let (before, after) = ((middle - from).norm(), (to - middle).norm());
    before.max(after) > tolerance.max(MAX_RATIO * before.min(after))
}

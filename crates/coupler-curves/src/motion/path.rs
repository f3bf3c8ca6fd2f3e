//! The path that a joint traces, refined to a chord error; as a whole and cut into dashes of equal input.

use super::pass::Pass;
use super::pass_positions::positions_at_inputs;
use super::sampling::Circuit;
use crate::geometry::{Point, distance_to_segment, simplify_polyline};
use crate::linkage::{BranchArc, DyadId, Input, JointId, Linkage};

/// How a curve is cut into dashes: dash k starts at input `k * period` and spans `dash_span`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashPattern {
    /// The input from the start of a dash to that of the next, in degrees or lengths.
    pub period: f64,
    /// The input that a dash spans, in degrees or lengths.
    pub dash_span: f64,
}

/// A dash: the path that a joint traces while the input goes from one value to another.
#[derive(Clone, Debug, PartialEq)]
pub struct Dash {
    /// The points of the path.
    pub points: Vec<Point>,
    /// Whether it belongs to the arc shown in the figure of the linkage's source; true if no arc is given.
    pub is_in_figure: bool,
}

/// The path that a joint traces on a circuit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointPath {
    /// The whole path, from the circuit's beginning to its end.
    pub points: Vec<Point>,
    /// The dashes.
    pub dashes: Vec<Dash>,
}

/// The paths of the given joints on a circuit, one for each joint.
///
/// No chord is further than `tolerance` (in the plane's unit) from the curve: half of that is for the refinement, as
/// measured at the first quarter and the middle of a chord's input, and half for the removal of points that are that
/// close to the line without them. The inputs are refined for all joints together. Where a position is undefined, or
/// jumps between neighbouring values of the input, a dash ends and another one begins.
pub fn joint_paths(
    linkage: &Linkage,
    circuit: &Circuit,
    joints: &[JointId],
    dashes: DashPattern,
    tolerance: f64,
) -> Vec<JointPath> {
    let mut out = vec![JointPath::default(); joints.len()];
    let mut continues = false;
    for pass in &circuit.passes {
        let pieces = cut_into_pieces(pass, dashes, linkage.motion_options.figure_arc);
        let nodes = PathNodes::from_pieces(linkage, pass, &pieces, joints, tolerance / 2.0);
        let runs = nodes.piece_ranges(&pieces);
        for (path, points) in out.iter_mut().zip(&nodes.points) {
            let defined: Vec<Point> = points.iter().copied().filter(is_defined).collect();
            let seam = usize::from(meets(&path.points, &defined, tolerance));
            path.points.extend(simplify_polyline(&defined, tolerance / 2.0).into_iter().skip(seam));
            for (piece, run) in pieces.iter().zip(&runs).filter(|(piece, _)| piece.is_drawn) {
                for line in nodes.unbroken_lines(points, run.clone(), tolerance) {
                    let line = simplify_polyline(line, tolerance / 2.0);
                    match path.dashes.last_mut() {
                        // A dash that contains a limit continues from the previous pass.
                        Some(last)
                            if continues
                                && piece.starts_pass
                                && last.is_in_figure == piece.is_in_figure
                                && meets(&last.points, &line, tolerance) =>
                        {
                            last.points.extend(line.into_iter().skip(1));
                        }
                        _ => path.dashes.push(Dash { points: line, is_in_figure: piece.is_in_figure }),
                    }
                }
            }
        }
        continues = pieces.last().is_some_and(|piece| piece.is_drawn);
    }
    out
}

/// Whether a position is defined.
fn is_defined(p: &Point) -> bool {
    p.x.is_finite() && p.y.is_finite()
}

/// Whether a line begins where another one ends.
fn meets(before: &[Point], after: &[Point], tolerance: f64) -> bool {
    before.last().zip(after.first()).is_some_and(|(end, begin)| (begin - end).norm() <= tolerance)
}

/// A part of a pass: a dash or a gap, in the direction of the pass.
struct PathPiece {
    from: f64,
    to: f64,
    is_drawn: bool,
    is_in_figure: bool,
    starts_pass: bool,
}

/// Cuts a pass into dashes and gaps, in the order of the pass.
fn cut_into_pieces(pass: &Pass, dashes: DashPattern, arc: Option<BranchArc>) -> Vec<PathPiece> {
    let (from, to) = (pass.from.input.value, pass.to.input.value);
    let [low, high] = pass.input_range();
    let mut cuts = vec![low, high];
    let mut k = (low / dashes.period).floor();
    while k * dashes.period < high {
        cuts.extend([k * dashes.period, k * dashes.period + dashes.dash_span]);
        k += 1.0;
    }
    // The arc is given within one turn; the pass may lie in another.
    let arc_of_branch = arc.filter(|arc| arc.branch == pass.mode.sign(DyadId::FIRST));
    let turn = ((low + high) / 720.0).floor() * 360.0;
    let arcs: Vec<[f64; 2]> = arc_of_branch
        .iter()
        .flat_map(|arc| [turn - 360.0, turn, turn + 360.0].map(|t| arc.input_deg.map(|deg| deg + t)))
        .collect();
    cuts.extend(arcs.iter().flatten());
    cuts.retain(|deg| (low..=high).contains(deg));
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    if from > to {
        cuts.reverse();
    }
    let piece = |pair: &[f64]| {
        let middle = (pair[0] + pair[1]) / 2.0;
        let is_drawn = middle.rem_euclid(dashes.period) < dashes.dash_span;
        let is_in_figure = arc.is_none() || arcs.iter().any(|[a, b]| (*a..=*b).contains(&middle));
        PathPiece { from: pair[0], to: pair[1], is_drawn, is_in_figure, starts_pass: pair[0] == from }
    };
    cuts.windows(2).map(piece).collect()
}

/// Inputs of a pass, including the ends of all its pieces, and the positions of the joints there.
struct PathNodes {
    inputs: Vec<f64>,
    /// Whether the path from a node to the next may be further from its chord than the tolerance.
    needs_refinement: Vec<bool>,
    /// The positions of each joint.
    points: Vec<Vec<Point>>,
}

impl PathNodes {
    /// Enough nodes for no joint to be further than `tolerance` from its chords, at the middles of their inputs.
    fn from_pieces(
        linkage: &Linkage,
        pass: &Pass,
        pieces: &[PathPiece],
        joints: &[JointId],
        tolerance: f64,
    ) -> PathNodes {
        /// The most input that a chord spans, in degrees of the fastest crank: a longer one may cross its curve at its
        /// middle.
        const MAX_CHORD_DEG: f64 = 3.0;
        /// The fewest chords of a pass.
        const MIN_CHORDS: f64 = 64.0;
        /// Each round halves the input between neighbours. After this many they are neighbouring numbers: near a
        /// singular position a joint may go as far as its links reach while the input changes by no more.
        const MAX_ROUNDS: usize = 60;
        /// A pass of more nodes than this is not refined further, even if the tolerance is not met.
        const MAX_NODES: usize = 100_000;
        let longest = match linkage.input() {
            Input::Angle { .. } => {
                (MAX_CHORD_DEG / linkage.fastest_crank_ratio()).min(pass.input_length() / MIN_CHORDS)
            }
            Input::Length => pass.input_length() / MIN_CHORDS,
        };
        let mut inputs: Vec<f64> = Vec::new();
        for piece in pieces {
            let chords = ((piece.to - piece.from).abs() / longest).ceil().clamp(1.0, MAX_NODES as f64);
            let part = |k: usize| piece.from + (piece.to - piece.from) * (k as f64 / chords);
            inputs.extend((0..chords as usize).map(part));
        }
        inputs.extend(pieces.last().map(|piece| piece.to));
        let mut nodes = PathNodes::at_inputs(linkage, pass, inputs, joints);
        for _ in 0..MAX_ROUNDS {
            let pairs = |k: &usize| nodes.needs_refinement[k - 1];
            let pairs: Vec<usize> = (1..nodes.inputs.len()).filter(pairs).collect();
            if pairs.is_empty() || nodes.inputs.len() > MAX_NODES {
                break;
            }
            let at = |share: &dyn Fn(f64, f64) -> f64| {
                let inputs = pairs.iter().map(|&k| share(nodes.inputs[k - 1], nodes.inputs[k])).collect();
                PathNodes::at_inputs(linkage, pass, inputs, joints)
            };
            let (middles, quarters) = (at(&|a, b| (a + b) / 2.0), at(&|a, b| a + (b - a) / 4.0));
            nodes = nodes.refined(&middles, &quarters, tolerance);
        }
        nodes
    }

    fn at_inputs(linkage: &Linkage, pass: &Pass, inputs: Vec<f64>, joints: &[JointId]) -> PathNodes {
        let columns = positions_at_inputs(linkage, pass, &inputs);
        let column = |joint: &JointId| {
            let (x, y) = (columns.x(*joint), columns.y(*joint));
            x.iter().zip(y).map(|(x, y)| Point::new(*x, *y)).collect()
        };
        PathNodes { needs_refinement: vec![true; inputs.len()], points: joints.iter().map(column).collect(), inputs }
    }

    /// Inserts the middles of those chords that are further than `tolerance` from their curve at its middle, or at its
    /// first quarter: at its middle the curve may cross the chord. Also of those whose middle is near one end: then the
    /// joint moves fast in one half, and not necessarily along the chord.
    fn refined(&self, middles: &PathNodes, quarters: &PathNodes, tolerance: f64) -> PathNodes {
        let mut next = 0;
        // For each node, the middle to be inserted after it, if any.
        let mut middle_after: Vec<Option<usize>> = vec![None; self.inputs.len()];
        for k in 1..self.inputs.len() {
            if self.needs_refinement[k - 1] {
                let joints = self.points.iter().zip(middles.points.iter().zip(&quarters.points));
                let exceeds_tolerance = |(points, (middles, quarters)): (&Vec<Point>, (&Vec<Point>, &Vec<Point>))| {
                    let (from, middle, to) = (points[k - 1], middles[next], points[k]);
                    distance_to_segment(middle, from, to) > tolerance
                        || distance_to_segment(quarters[next], from, to) > tolerance
                        || is_uneven([from, middle, to], tolerance)
                };
                middle_after[k - 1] = joints.into_iter().any(exceeds_tolerance).then_some(next);
                next += 1;
            }
        }
        fn interleave<T: Copy>(old: &[T], new: &[T], after: &[Option<usize>]) -> Vec<T> {
            let mut out = Vec::with_capacity(old.len() + new.len());
            for (value, middle) in old.iter().zip(after) {
                out.push(*value);
                out.extend(middle.map(|middle| new[middle]));
            }
            out
        }
        let needs_refinement: Vec<bool> = middle_after.iter().map(Option::is_some).collect();
        let points = self.points.iter().zip(&middles.points);
        PathNodes {
            inputs: interleave(&self.inputs, &middles.inputs, &middle_after),
            needs_refinement: interleave(&needs_refinement, &middles.needs_refinement, &middle_after),
            points: points.map(|(old, new)| interleave(old, new, &middle_after)).collect(),
        }
    }

    /// The lines of a joint's `points` over a run of nodes, without undefined positions and jumps.
    fn unbroken_lines<'p>(
        &self,
        points: &'p [Point],
        run: std::ops::RangeInclusive<usize>,
        tolerance: f64,
    ) -> Vec<&'p [Point]> {
        let is_jump = |k: usize| {
            let [a, b] = [self.inputs[k], self.inputs[k + 1]];
            let middle = (a + b) / 2.0;
            (middle == a || middle == b) && (points[k + 1] - points[k]).norm() > tolerance
        };
        let mut lines = Vec::new();
        let mut from = *run.start();
        for k in run.clone() {
            if !is_defined(&points[k]) {
                lines.push(&points[from..k]);
                from = k + 1;
            } else if k < *run.end() && is_jump(k) {
                lines.push(&points[from..=k]);
                from = k + 1;
            }
        }
        lines.push(&points[from..=*run.end()]);
        lines.retain(|line| !line.is_empty());
        lines
    }

    /// The nodes of each piece, including its ends.
    fn piece_ranges(&self, pieces: &[PathPiece]) -> Vec<std::ops::RangeInclusive<usize>> {
        let mut from = 0;
        let run = |piece: &PathPiece| {
            let steps = self.inputs[from..].iter().position(|at| *at == piece.to).unwrap_or(0);
            let run = from..=from + steps;
            from += steps;
            run
        };
        pieces.iter().map(run).collect()
    }
}

/// Whether the middle of a chord's input is so near one of its ends that the chord cannot be judged by it, and the chord
/// is longer than `tolerance`. Next to a limit the larger part is 2.4 times the smaller one, next to a cusp 3 times.
fn is_uneven([from, middle, to]: [Point; 3], tolerance: f64) -> bool {
    const MAX_RATIO: f64 = 4.0;
    let (before, after) = ((middle - from).norm(), (to - middle).norm());
    before.max(after) > tolerance.max(MAX_RATIO * before.min(after))
}

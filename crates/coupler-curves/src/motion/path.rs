//! The path a joint draws, refined to a chord error, whole and cut into dashes of equal input.

use super::circuit::{InputPosition, Pass};
use super::pass_ends::place_at_end;
use super::positions::{DyadSigns, InputColumns, JointPositions, convert_to_view_frame, place_leading_joints};
use super::sampling::Circuit;
use crate::geometry::{Point, distance_to_segment, simplify_polyline};
use crate::linkage::{BranchArc, DyadSet, Input, JointId, Linkage};

/// How a curve is cut into dashes: dash k starts at input k * period and spans `drawn`, both in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashPattern {
    /// Input from the start of a dash to that of the next, in degrees.
    pub period: f64,
    /// Input a dash spans, in degrees.
    pub dash_span: f64,
}

/// A dash: what a joint draws while the input goes from one value to another.
#[derive(Clone, Debug, PartialEq)]
pub struct Dash {
    /// The points of the path.
    pub points: Vec<Point>,
    /// Whether it belongs to the arc that the linkage's source shows; true where none is named.
    pub is_in_figure: bool,
}

/// What a joint draws on a circuit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointPath {
    /// All of it, from the circuit's beginning to its end.
    pub points: Vec<Point>,
    /// The dashes.
    pub dashes: Vec<Dash>,
}

/// The paths of some joints on a circuit, joint by joint.
///
/// No chord is further than `tolerance` (in the plane's unit) from the curve: half of that is for the refinement, as
/// judged at the middle of a chord's input, and half for the points that are left out again because the line passes
/// them that near. The inputs are refined for all joints together.
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
            let seam = usize::from(!path.points.is_empty());
            path.points.extend(simplify_polyline(points, tolerance / 2.0).into_iter().skip(seam));
            for (piece, run) in pieces.iter().zip(&runs).filter(|(piece, _)| piece.is_drawn) {
                let points = simplify_polyline(&points[run.clone()], tolerance / 2.0);
                match path.dashes.last_mut() {
                    // A dash that a limit falls in goes on where the pass before ended.
                    Some(last) if continues && piece.starts_pass && last.is_in_figure == piece.is_in_figure => {
                        last.points.extend(points.into_iter().skip(1));
                    }
                    _ => path.dashes.push(Dash { points, is_in_figure: piece.is_in_figure }),
                }
            }
        }
        continues = pieces.last().is_some_and(|piece| piece.is_drawn);
    }
    out
}

/// A part of a pass: a dash or a gap, in the sense of the pass.
struct PathPiece {
    from: f64,
    to: f64,
    is_drawn: bool,
    is_in_figure: bool,
    starts_pass: bool,
}

/// The parts of a pass, one after the other.
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
    let here = arc.filter(|arc| arc.branch == pass.mode.sign(0));
    let turn = ((low + high) / 720.0).floor() * 360.0;
    let arcs: Vec<[f64; 2]> = here
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
        let drawn = middle.rem_euclid(dashes.period) < dashes.dash_span;
        let figure = arc.is_none() || arcs.iter().any(|[a, b]| (*a..=*b).contains(&middle));
        PathPiece { from: pair[0], to: pair[1], is_drawn: drawn, is_in_figure: figure, starts_pass: pair[0] == from }
    };
    cuts.windows(2).map(piece).collect()
}

/// Inputs of a pass, the ends of all its pieces among them, and where the joints are there.
struct PathNodes {
    inputs: Vec<f64>,
    /// Whether the path from a node to the next may still be bent.
    needs_refinement: Vec<bool>,
    /// The places of each joint.
    points: Vec<Vec<Point>>,
}

impl PathNodes {
    /// As many as it takes for no joint to be further than `tolerance` from its chords, at the middles of their inputs.
    fn from_pieces(
        linkage: &Linkage,
        pass: &Pass,
        pieces: &[PathPiece],
        joints: &[JointId],
        tolerance: f64,
    ) -> PathNodes {
        /// No chord spans more of a crank's turn than this, in degrees: a longer one may cross its curve at its middle.
        const MAX_CHORD_DEG: f64 = 3.0;
        /// Nor more of a pass than a part in this.
        const MIN_CHORDS: f64 = 64.0;
        /// Each round halves the input between neighbours; 2^-30 of a dash is far below any paper's resolution.
        const MAX_ROUNDS: usize = 30;
        /// A pass of more nodes than this is not drawn finer, whatever the tolerance.
        const MAX_NODES: usize = 100_000;
        let longest = match linkage.input() {
            Input::Angle { .. } => MAX_CHORD_DEG.min(pass.input_length() / MIN_CHORDS),
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
            let pairs = (1..nodes.inputs.len()).filter(|&k| nodes.needs_refinement[k - 1]);
            let middles: Vec<f64> = pairs.map(|k| (nodes.inputs[k - 1] + nodes.inputs[k]) / 2.0).collect();
            if middles.is_empty() || nodes.inputs.len() > MAX_NODES {
                break;
            }
            nodes = nodes.refined(&PathNodes::at_inputs(linkage, pass, middles, joints), tolerance);
        }
        nodes
    }

    fn at_inputs(linkage: &Linkage, pass: &Pass, at: Vec<f64>, joints: &[JointId]) -> PathNodes {
        let columns = positions_at_inputs(linkage, pass, &at);
        let column = |joint: &JointId| {
            let (x, y) = (columns.x(*joint), columns.y(*joint));
            x.iter().zip(y).map(|(x, y)| Point::new(*x, *y)).collect()
        };
        PathNodes { needs_refinement: vec![true; at.len()], points: joints.iter().map(column).collect(), inputs: at }
    }

    /// The nodes with those of the middles of their open chords that are off their chord.
    fn refined(&self, middles: &PathNodes, tolerance: f64) -> PathNodes {
        let mut next = 0;
        // For each node, the middle after it, if the path is bent there.
        let mut middle_after: Vec<Option<usize>> = vec![None; self.inputs.len()];
        for k in 1..self.inputs.len() {
            if self.needs_refinement[k - 1] {
                let joints = self.points.iter().zip(&middles.points);
                let is_bent = |(points, middles): (&Vec<Point>, &Vec<Point>)| {
                    distance_to_segment(middles[next], points[k - 1], points[k]) > tolerance
                };
                middle_after[k - 1] = joints.into_iter().any(is_bent).then_some(next);
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
        let still_open: Vec<bool> = middle_after.iter().map(Option::is_some).collect();
        let points = self.points.iter().zip(&middles.points);
        PathNodes {
            inputs: interleave(&self.inputs, &middles.inputs, &middle_after),
            needs_refinement: interleave(&still_open, &middles.needs_refinement, &middle_after),
            points: points.map(|(old, new)| interleave(old, new, &middle_after)).collect(),
        }
    }

    /// The nodes of each piece, its ends included.
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

/// All joints at some inputs of a pass; at its ends exactly as the circuit has them.
pub(super) fn positions_at_inputs(linkage: &Linkage, pass: &Pass, degs: &[f64]) -> JointPositions {
    let input = linkage.input();
    let inputs = InputColumns::new(&degs.iter().map(|&at| InputPosition::new(input, at)).collect::<Vec<_>>());
    let mut out = JointPositions::new(linkage.joints.len(), degs.len());
    let modes = DyadSigns::new(pass.mode, DyadSet::EMPTY);
    place_leading_joints(linkage, linkage.joints.len(), inputs.as_slices(), &modes, &mut out, 0..degs.len());
    for (i, &deg) in degs.iter().enumerate() {
        for (end, begins) in [(pass.from, true), (pass.to, false)] {
            if deg == end.input.value && !end.flat_dyads.is_empty() {
                place_at_end(linkage, pass, begins, &mut out, i);
            }
        }
    }
    convert_to_view_frame(linkage, &mut out);
    out
}

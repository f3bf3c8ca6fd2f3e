//! The path a joint draws, refined to a chord error, whole and cut into dashes of equal input.

use super::circuit::{Pass, Stop};
use super::ends::place_end;
use super::kernel::{Columns, Modes, OwnInputs, place, see};
use super::sampling::Circuit;
use crate::geometry::{Point, distance_to_segment, thinned};
use crate::linkage::{Arc, Flat, Input, JointId, Linkage};

/// How a curve is cut into dashes: dash k starts at input k * period and spans `drawn`, both in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dashes {
    /// Input from the start of a dash to that of the next, in degrees.
    pub period: f64,
    /// Input a dash spans, in degrees.
    pub drawn: f64,
}

/// A dash: what a joint draws while the input goes from one value to another.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// The points of the path.
    pub points: Vec<Point>,
    /// Whether it belongs to the arc that the linkage's source shows; true where none is named.
    pub figure: bool,
}

/// What a joint draws on a circuit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    /// All of it, from the circuit's beginning to its end.
    pub whole: Vec<Point>,
    /// The dashes.
    pub dashes: Vec<Stroke>,
}

/// The paths of some joints on a circuit, joint by joint.
///
/// No chord is further than `tolerance` (in the plane's unit) from the curve: half of that is for the refinement, as
/// judged at the middle of a chord's input, and half for the points that are left out again because the line passes
/// them that near. The inputs are refined for all joints together.
pub fn paths(linkage: &Linkage, circuit: &Circuit, joints: &[JointId], dashes: Dashes, tolerance: f64) -> Vec<Path> {
    let mut out = vec![Path::default(); joints.len()];
    let mut continues = false;
    for pass in &circuit.passes {
        let pieces = pieces(pass, dashes, linkage.travel.arc);
        let nodes = Nodes::of(linkage, pass, &pieces, joints, tolerance / 2.0);
        let runs = nodes.runs(&pieces);
        for (path, points) in out.iter_mut().zip(&nodes.points) {
            let seam = usize::from(!path.whole.is_empty());
            path.whole.extend(thinned(points, tolerance / 2.0).into_iter().skip(seam));
            for (piece, run) in pieces.iter().zip(&runs).filter(|(piece, _)| piece.drawn) {
                let points = thinned(&points[run.clone()], tolerance / 2.0);
                match path.dashes.last_mut() {
                    // A dash that a limit falls in goes on where the pass before ended.
                    Some(last) if continues && piece.at_start && last.figure == piece.figure => {
                        last.points.extend(points.into_iter().skip(1));
                    }
                    _ => path.dashes.push(Stroke { points, figure: piece.figure }),
                }
            }
        }
        continues = pieces.last().is_some_and(|piece| piece.drawn);
    }
    out
}

/// A part of a pass: a dash or a gap, in the sense of the pass.
struct Piece {
    from: f64,
    to: f64,
    drawn: bool,
    figure: bool,
    at_start: bool,
}

/// The parts of a pass, one after the other.
fn pieces(pass: &Pass, dashes: Dashes, arc: Option<Arc>) -> Vec<Piece> {
    let (from, to) = (pass.from.stop.at, pass.to.stop.at);
    let [low, high] = pass.range();
    let mut cuts = vec![low, high];
    let mut k = (low / dashes.period).floor();
    while k * dashes.period < high {
        cuts.extend([k * dashes.period, k * dashes.period + dashes.drawn]);
        k += 1.0;
    }
    // The arc is given within one turn; the pass may lie in another.
    let here = arc.filter(|arc| arc.branch == pass.signs.get(0));
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
        let drawn = middle.rem_euclid(dashes.period) < dashes.drawn;
        let figure = arc.is_none() || arcs.iter().any(|[a, b]| (*a..=*b).contains(&middle));
        Piece { from: pair[0], to: pair[1], drawn, figure, at_start: pair[0] == from }
    };
    cuts.windows(2).map(piece).collect()
}

/// Inputs of a pass, the ends of all its pieces among them, and where the joints are there.
struct Nodes {
    at: Vec<f64>,
    /// Whether the path from a node to the next may still be bent.
    open: Vec<bool>,
    /// The places of each joint.
    points: Vec<Vec<Point>>,
}

impl Nodes {
    /// As many as it takes for no joint to be further than `tolerance` from its chords, at the middles of their inputs.
    fn of(linkage: &Linkage, pass: &Pass, pieces: &[Piece], joints: &[JointId], tolerance: f64) -> Nodes {
        /// No chord spans more of a crank's turn than this, in degrees: a longer one may cross its curve at its middle.
        const LONGEST: f64 = 3.0;
        /// Nor more of a pass than a part in this.
        const FEWEST: f64 = 64.0;
        /// Each round halves the input between neighbours; 2^-30 of a dash is far below any paper's resolution.
        const ROUNDS: usize = 30;
        /// A pass of more nodes than this is not drawn finer, whatever the tolerance.
        const MOST: usize = 100_000;
        let longest = match linkage.input() {
            Input::Angle { .. } => LONGEST.min(pass.length() / FEWEST),
            Input::Length => pass.length() / FEWEST,
        };
        let mut inputs: Vec<f64> = Vec::new();
        for piece in pieces {
            let chords = ((piece.to - piece.from).abs() / longest).ceil().clamp(1.0, MOST as f64);
            let part = |k: usize| piece.from + (piece.to - piece.from) * (k as f64 / chords);
            inputs.extend((0..chords as usize).map(part));
        }
        inputs.extend(pieces.last().map(|piece| piece.to));
        let mut nodes = Nodes::placed(linkage, pass, inputs, joints);
        for _ in 0..ROUNDS {
            let pairs = (1..nodes.at.len()).filter(|&k| nodes.open[k - 1]);
            let middles: Vec<f64> = pairs.map(|k| (nodes.at[k - 1] + nodes.at[k]) / 2.0).collect();
            if middles.is_empty() || nodes.at.len() > MOST {
                break;
            }
            nodes = nodes.refined(&Nodes::placed(linkage, pass, middles, joints), tolerance);
        }
        nodes
    }

    fn placed(linkage: &Linkage, pass: &Pass, at: Vec<f64>, joints: &[JointId]) -> Nodes {
        let columns = at_inputs(linkage, pass, &at);
        let column = |joint: &JointId| {
            let (x, y) = (columns.x(*joint), columns.y(*joint));
            x.iter().zip(y).map(|(x, y)| Point::new(*x, *y)).collect()
        };
        Nodes { open: vec![true; at.len()], points: joints.iter().map(column).collect(), at }
    }

    /// The nodes with those of the middles of their open chords that are off their chord.
    fn refined(&self, middles: &Nodes, tolerance: f64) -> Nodes {
        let mut next = 0;
        // For each node, the middle after it, if the path is bent there.
        let mut middle_after: Vec<Option<usize>> = vec![None; self.at.len()];
        for k in 1..self.at.len() {
            if self.open[k - 1] {
                let joints = self.points.iter().zip(&middles.points);
                let is_bent = |(points, middles): (&Vec<Point>, &Vec<Point>)| {
                    distance_to_segment(middles[next], points[k - 1], points[k]) > tolerance
                };
                middle_after[k - 1] = joints.into_iter().any(is_bent).then_some(next);
                next += 1;
            }
        }
        fn merged<T: Copy>(old: &[T], new: &[T], after: &[Option<usize>]) -> Vec<T> {
            let mut out = Vec::with_capacity(old.len() + new.len());
            for (value, middle) in old.iter().zip(after) {
                out.push(*value);
                out.extend(middle.map(|middle| new[middle]));
            }
            out
        }
        let still_open: Vec<bool> = middle_after.iter().map(Option::is_some).collect();
        let points = self.points.iter().zip(&middles.points);
        Nodes {
            at: merged(&self.at, &middles.at, &middle_after),
            open: merged(&still_open, &middles.open, &middle_after),
            points: points.map(|(old, new)| merged(old, new, &middle_after)).collect(),
        }
    }

    /// The nodes of each piece, its ends included.
    fn runs(&self, pieces: &[Piece]) -> Vec<std::ops::RangeInclusive<usize>> {
        let mut from = 0;
        let run = |piece: &Piece| {
            let steps = self.at[from..].iter().position(|at| *at == piece.to).unwrap_or(0);
            let run = from..=from + steps;
            from += steps;
            run
        };
        pieces.iter().map(run).collect()
    }
}

/// All joints at some inputs of a pass; at its ends exactly as the circuit has them.
pub(super) fn at_inputs(linkage: &Linkage, pass: &Pass, degs: &[f64]) -> Columns {
    let input = linkage.input();
    let inputs = OwnInputs::new(&degs.iter().map(|&at| Stop::of(input, at)).collect::<Vec<_>>());
    let mut out = Columns::new(linkage.joints.len(), degs.len());
    let modes = Modes::new(pass.signs, Flat::NONE);
    place(linkage, linkage.joints.len(), inputs.all(), &modes, &mut out, 0..degs.len());
    for (i, &deg) in degs.iter().enumerate() {
        for (end, begins) in [(pass.from, true), (pass.to, false)] {
            if deg == end.stop.at && !end.flat.is_none() {
                place_end(linkage, pass, begins, &mut out, i);
            }
        }
    }
    see(linkage, &mut out);
    out
}

//! The path a joint draws, refined to a chord error, and cut into dashes of equal input.

use super::circuit::{Pass, Stop};
use super::ends::place_end;
use super::kernel::{Columns, Modes, OwnInputs, place, see};
use super::sampling::Circuit;
use crate::geometry::{Point, distance_to_segment};
use crate::linkage::{Arc, Flat, JointId, Linkage};

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

/// The strokes of some joints on a circuit, joint by joint.
///
/// A chord is nowhere further than `tolerance` (in the plane's unit) from the curve, as judged at the middle of its
/// input; the paths of all `joints` share their inputs.
pub fn strokes(
    linkage: &Linkage,
    circuit: &Circuit,
    joints: &[JointId],
    dashes: Dashes,
    tolerance: f64,
) -> Vec<Vec<Stroke>> {
    let mut out: Vec<Vec<Stroke>> = vec![Vec::new(); joints.len()];
    let mut continues = false;
    for pass in &circuit.passes {
        for piece in pieces(pass, dashes, linkage.travel.arc) {
            let path = refine(linkage, pass, &piece, joints, tolerance);
            for (strokes, points) in out.iter_mut().zip(path) {
                match strokes.last_mut() {
                    // A dash that a limit falls in goes on where the pass before ended.
                    Some(last) if continues && piece.at_start && last.figure == piece.figure => {
                        last.points.extend(points.into_iter().skip(1));
                    }
                    _ => strokes.push(Stroke { points, figure: piece.figure }),
                }
            }
            continues = piece.at_end;
        }
    }
    out
}

/// A part of a pass that is drawn.
struct Piece {
    from: f64,
    to: f64,
    figure: bool,
    at_start: bool,
    at_end: bool,
}

fn pieces(pass: &Pass, dashes: Dashes, arc: Option<Arc>) -> Vec<Piece> {
    let (from, to) = (pass.from.stop.at, pass.to.stop.at);
    let [low, high] = [from.min(to), from.max(to)];
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
    let mut out: Vec<Piece> = Vec::new();
    for pair in cuts.windows(2) {
        let middle = (pair[0] + pair[1]) / 2.0;
        if middle.rem_euclid(dashes.period) < dashes.drawn {
            let inside = arc.is_none() || arcs.iter().any(|[a, b]| (*a..=*b).contains(&middle));
            out.push(Piece {
                from: pair[0],
                to: pair[1],
                figure: inside,
                at_start: pair[0] == from,
                at_end: pair[1] == to,
            });
        }
    }
    if from > to {
        out.reverse();
        for piece in &mut out {
            (piece.from, piece.to) = (piece.to, piece.from);
            (piece.at_start, piece.at_end) = (piece.from == from, piece.to == to);
        }
    }
    out
}

/// The paths of `joints` over a piece of a pass.
fn refine(linkage: &Linkage, pass: &Pass, piece: &Piece, joints: &[JointId], tolerance: f64) -> Vec<Vec<Point>> {
    /// Each round halves the input between neighbours; 2^-30 of a dash is far below any paper's resolution.
    const ROUNDS: usize = 30;
    /// A dash of more points than this is not drawn finer, whatever the tolerance.
    const MOST: usize = 10_000;
    let places = |degs: Vec<f64>| -> Vec<Node> {
        let columns = at(linkage, pass, &degs);
        let points = |i: usize| joints.iter().map(|&joint| columns.point(joint, i)).collect();
        degs.iter().enumerate().map(|(i, &at)| Node { at, points: points(i), open: true }).collect()
    };
    let is_bent = |middle: &Node, a: &Node, b: &Node| {
        (0..joints.len()).any(|j| distance_to_segment(middle.points[j], a.points[j], b.points[j]) > tolerance)
    };
    let mut nodes = places(vec![piece.from, (piece.from + piece.to) / 2.0, piece.to]);
    for _ in 0..ROUNDS {
        let pairs = nodes.windows(2).filter(|pair| pair[0].open);
        let middles = places(pairs.map(|pair| (pair[0].at + pair[1].at) / 2.0).collect());
        if middles.is_empty() || nodes.len() > MOST {
            break;
        }
        let mut middles = middles.into_iter();
        let mut old = std::mem::take(&mut nodes).into_iter().peekable();
        while let Some(mut node) = old.next() {
            let middle = old.peek().filter(|_| node.open).and_then(|next| Some((middles.next()?, next)));
            let inserted = middle.filter(|(middle, next)| is_bent(middle, &node, next)).map(|(middle, _)| middle);
            node.open = inserted.is_some();
            nodes.push(node);
            nodes.extend(inserted);
        }
    }
    (0..joints.len()).map(|j| nodes.iter().map(|node| node.points[j]).collect()).collect()
}

/// A place of a path: its input, where the joints are, and whether the path to the next may still be bent.
struct Node {
    at: f64,
    points: Vec<Point>,
    open: bool,
}

/// All joints at some inputs of a pass; at its ends exactly as the circuit has them.
pub(super) fn at(linkage: &Linkage, pass: &Pass, degs: &[f64]) -> Columns {
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

//! Divides the pieces of a circuit until all joints are resolved.

use super::InputMap;
use super::circuit_pieces::{CircuitPiece, CircuitPieces, MAX_PIECES, nodes_of};
use super::first_pieces::{first_pieces, junction_after};
use crate::geometry::{Chebyshev, TERMS, in_rising_order, trig};
use crate::linkage::{Input, JointId, JointKind, Linkage};
use crate::motion::circuit::UnsampledCircuit;
use crate::motion::input_columns::InputColumns;
use crate::motion::pass::{InputPosition, Pass};
use crate::motion::pass_positions::place_on_pass;
use crate::motion::positions::{JointPositions, convert_to_view_frame};

/// A piece that is not yet known to be short enough.
#[derive(Clone, Copy)]
struct PendingPiece {
    piece: CircuitPiece,
    /// Its position in the circuit, to sort by.
    place: [f64; 2],
    /// The greatest of the last terms of the piece it is a part of, relative to the size.
    parent_tail: f64,
    depth: usize,
}

impl PendingPiece {
    fn is_centred(&self) -> bool {
        self.piece.passes[0] != self.piece.passes[1]
    }

    /// Its parts: halves, or three parts around what it is centred at.
    fn parts(&self, tail: f64) -> Vec<PendingPiece> {
        let cuts: &[[f64; 2]] =
            if self.is_centred() { &[[-1.0, -0.5], [-0.5, 0.5], [0.5, 1.0]] } else { &[[-1.0, 0.0], [0.0, 1.0]] };
        let width = self.place[1] - self.place[0];
        let part = |cut: &[f64; 2]| PendingPiece {
            piece: self.piece.restricted(*cut),
            place: cut.map(|u| self.place[0] + width * (u + 1.0) / 2.0),
            parent_tail: tail,
            depth: self.depth + 1,
        };
        cuts.iter().map(part).collect()
    }
}

/// The last terms of a resolved series, relative to the size of the linkage: a few roundings of its positions.
const RESOLVED: f64 = 2e-15;

/// Where rounding is greater than [`RESOLVED`], dividing does not help. Last terms up to this part of the size that do
/// not decrease are taken to be rounding.
const ROUNDING: f64 = 1e-10;

/// The same relative to the coordinates: more than the former where joints move little and are far from the origin, as those of a
/// linkage with a very short link.
const ROUNDING_OF_COORDINATES: f64 = 16.0 * f64::EPSILON;

/// Each division halves a piece. After this many its ends are nearly neighbouring numbers.
const MAX_DEPTH: usize = 44;

/// A resolved piece: where it was computed.
struct ResolvedPiece {
    piece: PendingPiece,
    round: usize,
    index: usize,
}

/// Divides a circuit.
pub(super) fn divide_circuit(linkage: &Linkage, circuit: &UnsampledCircuit) -> CircuitPieces {
    let (first, starts_centred) = first_pieces(linkage, circuit);
    let pending = |(k, piece): (usize, &CircuitPiece)| PendingPiece {
        piece: *piece,
        place: [k as f64, k as f64 + 1.0],
        parent_tail: f64::INFINITY,
        depth: 0,
    };
    let mut pending: Vec<PendingPiece> = first.iter().enumerate().map(pending).collect();
    let checked = joints_to_resolve(linkage);
    let (mut size, mut rounding) = (0.0f64, ROUNDING);
    let (mut rounds, mut resolved) = (Vec::new(), Vec::new());
    while !pending.is_empty() {
        let positions = node_positions(linkage, circuit, &pending);
        if rounds.is_empty() {
            size = extent(&positions, &checked);
            rounding = ROUNDING.max(ROUNDING_OF_COORDINATES * greatest_coordinate(linkage, &positions) / size);
        }
        let mut next = Vec::new();
        for (index, piece) in pending.iter().enumerate() {
            let tail = tail(&positions, index, &checked) / size;
            let is_rounding = tail <= rounding && tail >= 0.5 * piece.parent_tail;
            // Where nothing moves the tail is 0 / 0.
            let is_full = resolved.len() + next.len() + (pending.len() - index) > MAX_PIECES;
            if tail <= RESOLVED || is_rounding || piece.depth >= MAX_DEPTH || size == 0.0 || is_full {
                resolved.push(ResolvedPiece { piece: *piece, round: rounds.len(), index });
            } else {
                next.extend(piece.parts(tail));
            }
        }
        rounds.push(positions);
        pending = next;
    }
    let resolved = in_rising_order(resolved, |resolved: &ResolvedPiece| resolved.piece.place[0]);
    assemble(linkage, circuit, &rounds, &resolved, starts_centred)
}

/// The joints whose resolution is that of all: the others are linear in them.
fn joints_to_resolve(linkage: &Linkage) -> Vec<JointId> {
    let is_nonlinear = |joint: &JointId| {
        !matches!(
            linkage.joints[*joint].kind,
            JointKind::Fixed(_) | JointKind::Rigid { .. } | JointKind::Parallelogram { .. }
        ) || linkage.seen_from.is_some_and(|_| matches!(linkage.joints[*joint].kind, JointKind::Fixed(_)))
    };
    linkage.joint_ids().filter(is_nonlinear).collect()
}

/// The greatest coordinate of joints from which others are computed.
fn greatest_coordinate(linkage: &Linkage, positions: &JointPositions) -> f64 {
    let is_point = |joint: &JointId| matches!(linkage.joints[*joint].kind, JointKind::Rigid { .. });
    let joints = linkage.joint_ids().filter(|joint| !is_point(joint));
    let coordinates = joints.flat_map(|joint| positions.x(joint).iter().chain(positions.y(joint)));
    coordinates.fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// The greatest extent of the paths of joints along x or y.
fn extent(positions: &JointPositions, joints: &[JointId]) -> f64 {
    let column_extent = |column: &[f64]| {
        let [low, high] = column
            .iter()
            .filter(|value| value.is_finite())
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &value| [low.min(value), high.max(value)]);
        if low < high { high - low } else { 0.0 }
    };
    let extents = joints.iter().map(|&joint| column_extent(positions.x(joint)).max(column_extent(positions.y(joint))));
    extents.fold(0.0, f64::max)
}

/// The greatest of the last terms of all joints on a piece; infinite if a position is undefined.
fn tail(positions: &JointPositions, piece: usize, joints: &[JointId]) -> f64 {
    let columns = joints.iter().flat_map(|&joint| [positions.x(joint), positions.y(joint)]);
    let tails = columns.map(|column| {
        let tail = Chebyshev::tail_of(nodes_of(column, piece));
        if tail.is_nan() { f64::INFINITY } else { tail }
    });
    tails.fold(0.0, f64::max)
}

/// The positions of all joints at the nodes of pieces.
fn node_positions(linkage: &Linkage, circuit: &UnsampledCircuit, pieces: &[PendingPiece]) -> JointPositions {
    let mut inputs = Vec::with_capacity(pieces.len() * TERMS);
    let mut node_passes = Vec::with_capacity(pieces.len() * TERMS);
    let mut rotations = Rotations::default();
    for PendingPiece { piece, .. } in pieces {
        rotations.push_inputs(linkage.input(), circuit, piece, &mut inputs);
        node_passes.extend(Chebyshev::nodes().map(|u| piece.pass_at(u)));
    }
    let mut positions = JointPositions::new(linkage.joints.len(), inputs.len());
    let columns = InputColumns::new(&inputs);
    let mut from = 0;
    for run in node_passes.chunk_by(|a, b| a == b) {
        let range = from..from + run.len();
        place_on_pass(linkage, &circuit.passes[run[0]], columns.slice(range.clone()), &mut positions, range.clone());
        from = range.end;
    }
    convert_to_view_frame(linkage, &mut positions);
    positions
}

/// The cosines and sines of half a piece's input at the nodes, for the widths of pieces met so far: nodes of all pieces
/// of a width are rotated from their middles by the same angles.
#[derive(Default)]
struct Rotations(Vec<(f64, [(f64, f64); TERMS])>);

impl Rotations {
    /// The inputs at the nodes of a piece.
    fn push_inputs(
        &mut self,
        input: Input,
        circuit: &UnsampledCircuit,
        piece: &CircuitPiece,
        out: &mut Vec<InputPosition>,
    ) {
        let nodes = Chebyshev::nodes();
        match (input, piece.map) {
            (Input::Length, map) => out.extend(nodes.map(|u| InputPosition::new(input, map.input(u)))),
            (Input::Angle { .. }, map @ InputMap::Linear { middle, half }) => {
                let known = self.0.iter().position(|(width, _)| *width == half);
                let known = known.unwrap_or_else(|| {
                    self.0.push((half, nodes.map(|u| trig::cos_sin_deg(half * u))));
                    self.0.len() - 1
                });
                let (cos, sin) = trig::cos_sin_deg(middle);
                let rotated = |(u, (c, s)): (f64, (f64, f64))| InputPosition {
                    value: map.input(u),
                    cos: cos * c - sin * s,
                    sin: sin * c + cos * s,
                };
                out.extend(nodes.iter().copied().zip(self.0[known].1).map(rotated));
            }
            (Input::Angle { .. }, map @ InputMap::Root { direction, middle, half, .. }) => {
                // From the limit's own cosine and sine, which are more exact than its angle.
                out.extend(nodes.map(|u| {
                    let pass = piece.pass_at(u);
                    let Pass { from, to, .. } = &circuit.passes[pass];
                    let end = if middle + half * u < 0.0 { to } else { from };
                    let root = middle + half * u;
                    let (c, s) = trig::cos_sin_deg(-direction * root * root);
                    let InputPosition { cos, sin, .. } = end.input;
                    InputPosition { value: map.input(u), cos: cos * c - sin * s, sin: sin * c + cos * s }
                }));
            }
        }
    }
}

/// The resolved pieces in one list; a first piece that is centred at the start of the circuit is cut there, so that the
/// circuit begins at its start.
fn assemble(
    linkage: &Linkage,
    circuit: &UnsampledCircuit,
    rounds: &[JointPositions],
    resolved: &[ResolvedPiece],
    starts_centred: bool,
) -> CircuitPieces {
    // Of the first centred piece the outer parts before the start are the last pieces of the circuit.
    let before_start = if starts_centred { resolved.iter().take_while(|r| r.piece.place[1] <= 0.5).count() } else { 0 };
    let is_cut = |r: &ResolvedPiece| starts_centred && r.piece.place[0] < 0.5 && r.piece.place[1] > 0.5;
    let mut parts: Vec<(&ResolvedPiece, [f64; 2])> = Vec::with_capacity(resolved.len() + 1);
    for r in resolved[before_start..].iter().chain(&resolved[..before_start]) {
        parts.push((r, if is_cut(r) { [0.0, 1.0] } else { [-1.0, 1.0] }));
    }
    if let Some(cut) = resolved.iter().find(|r| is_cut(r)) {
        parts.push((cut, [-1.0, 0.0]));
    }
    let last_pass = circuit.passes.len() - 1;
    let whole_turns = circuit.passes[last_pass].to.input.value - circuit.passes[0].from.input.value;
    let mut out = CircuitPieces {
        pieces: Vec::with_capacity(parts.len()),
        positions: JointPositions::new(linkage.joints.len(), parts.len() * TERMS),
        corners: Vec::with_capacity(parts.len()),
    };
    for (k, &(r, part)) in parts.iter().enumerate() {
        let mut piece = if part == [-1.0, 1.0] { r.piece.piece } else { r.piece.piece.restricted(part) };
        let is_before_start = starts_centred && r.piece.place[0] < 0.5 && k > 0 && part[0] < 0.0;
        if is_before_start && piece.passes == [last_pass; 2] {
            piece.map = piece.map.shifted(whole_turns);
        }
        let previous = out.pieces.last().map(|previous: &CircuitPiece| previous.passes[1]);
        out.corners.push(previous.is_some_and(|previous| previous != piece.passes[0]));
        out.pieces.push(piece);
        for joint in linkage.joint_ids() {
            for (from, to) in
                [(rounds[r.round].x(joint), &mut out.positions.x), (rounds[r.round].y(joint), &mut out.positions.y)]
            {
                let nodes = nodes_of(from, r.index);
                let column = joint.index() * parts.len() * TERMS + k * TERMS;
                let values = if part == [-1.0, 1.0] {
                    *nodes
                } else {
                    let series = Chebyshev::from_values(nodes);
                    let (middle, half) = ((part[0] + part[1]) / 2.0, (part[1] - part[0]) / 2.0);
                    Chebyshev::nodes().map(|u| series.at(middle + half * u))
                };
                to[column..][..TERMS].copy_from_slice(&values);
            }
        }
    }
    if let (true, Some(last)) = (circuit.is_closed, out.pieces.last()) {
        let first = out.pieces[0];
        out.corners[0] = !starts_centred
            && !junction_after(linkage, circuit, last_pass).is_plain
            && last.passes[1] == last_pass
            && first.passes[0] == 0;
    }
    out
}

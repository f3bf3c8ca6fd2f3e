//! A circuit in pieces on which the positions of all joints are polynomials in a regular parameter, to rounding.
//!
//! Between limits the parameter of a piece is the input. Near a limit, where positions change with the root of the
//! input, it is that root: positive after the limit, negative before it, so that one piece continues through the limit
//! and the positions are analytic on it. A piece continues through a change point, too, where every dyad that is flat
//! there changes its side. So no node is near an input at which positions are badly conditioned, except next to a
//! corner, where a piece ends.
//!
//! A piece is divided until the last terms of the Chebyshev series of all joints are rounding.

use super::circuit::UnsampledCircuit;
use super::derivatives::JointDerivatives;
use super::pass::{InputPosition, Pass};
use super::positions::{DyadSigns, InputColumns, JointPositions, convert_to_view_frame, place_leading_joints};
use super::sampling::Circuit;
use crate::geometry::{Chebyshev, TERMS, in_rising_order, trig};
use crate::linkage::{DyadSet, Input, JointId, JointKind, Linkage};

/// How the input depends on the parameter `u` of a piece, from -1 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InputMap {
    /// `middle + half * u`.
    Linear {
        /// The input in the middle, in degrees or in units of length.
        middle: f64,
        /// Half of the input it spans; negative where the input falls.
        half: f64,
    },
    /// `limit - direction * (middle + half * u)^2`.
    Root {
        /// The input at the limit.
        limit: f64,
        /// 1 where the limit is the greatest input nearby, -1 where it is the least.
        direction: f64,
        /// The signed root of the distance from the limit in the middle.
        middle: f64,
        /// Half of the range of that root.
        half: f64,
    },
}

impl InputMap {
    /// The input at a parameter.
    pub fn input(&self, u: f64) -> f64 {
        match *self {
            InputMap::Linear { middle, half } => middle + half * u,
            InputMap::Root { limit, direction, middle, half } => {
                let root = middle + half * u;
                limit - direction * root * root
            }
        }
    }

    /// The derivative of the input with respect to the parameter.
    pub fn input_rate(&self, u: f64) -> f64 {
        match *self {
            InputMap::Linear { half, .. } => half,
            InputMap::Root { direction, middle, half, .. } => -2.0 * direction * (middle + half * u) * half,
        }
    }

    /// The parameter at an input on the piece, on the side of the limit that `after` says; not limited to [-1, 1].
    pub fn parameter(&self, input: f64, after: bool) -> f64 {
        match *self {
            InputMap::Linear { middle, half } => (input - middle) / half,
            InputMap::Root { limit, direction, middle, half } => {
                let root = (direction * (limit - input)).max(0.0).sqrt();
                ((if after { root } else { -root }) - middle) / half
            }
        }
    }

    /// The same piece at inputs that are greater by `by`.
    fn shifted(&self, by: f64) -> InputMap {
        match *self {
            InputMap::Linear { middle, half } => InputMap::Linear { middle: middle + by, half },
            InputMap::Root { limit, direction, middle, half } => {
                InputMap::Root { limit: limit + by, direction, middle, half }
            }
        }
    }

    fn restricted(&self, [from, to]: [f64; 2]) -> InputMap {
        let (centre, share) = ((from + to) / 2.0, (to - from) / 2.0);
        match *self {
            InputMap::Linear { middle, half } => {
                InputMap::Linear { middle: middle + half * centre, half: half * share }
            }
            InputMap::Root { limit, direction, middle, half } => {
                InputMap::Root { limit, direction, middle: middle + half * centre, half: half * share }
            }
        }
    }
}

/// A piece of a circuit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CircuitPiece {
    /// How the input depends on the parameter.
    pub map: InputMap,
    /// The indices of the passes before and after `split`.
    pub passes: [usize; 2],
    /// The parameter at which the second pass begins; 1 if there is only one pass.
    pub split: f64,
}

impl CircuitPiece {
    fn on_pass(pass: usize, map: InputMap) -> CircuitPiece {
        CircuitPiece { map, passes: [pass, pass], split: 1.0 }
    }

    /// The index of the pass at a parameter.
    pub fn pass_at(&self, u: f64) -> usize {
        self.passes[usize::from(u > self.split)]
    }

    /// The parameter at an input on a pass; `None` if it is not on the piece.
    pub fn parameter_at(&self, pass: usize, input: f64) -> Option<f64> {
        /// The rounding of inputs relative to the width of a piece.
        const EDGE: f64 = 1e-9;
        let after = match self.map {
            InputMap::Root { middle, .. } if self.passes[0] == self.passes[1] => middle > 0.0,
            _ => pass == self.passes[1],
        };
        let u = self.map.parameter(input, after);
        (self.passes.contains(&pass) && u.abs() <= 1.0 + EDGE).then(|| u.clamp(-1.0, 1.0))
    }

    /// The input it spans, forward and backward.
    pub fn input_travel(&self) -> f64 {
        self.input_travel_to(1.0)
    }

    /// The input from its beginning to a parameter, forward and backward.
    pub fn input_travel_to(&self, u: f64) -> f64 {
        let distance = |from: f64, to: f64| (self.map.input(to) - self.map.input(from)).abs();
        match self.map {
            InputMap::Root { .. } if u > self.split && self.passes[0] != self.passes[1] => {
                distance(-1.0, self.split) + distance(self.split, u)
            }
            _ => distance(-1.0, u),
        }
    }

    /// The part between two parameters.
    pub fn restricted(&self, [from, to]: [f64; 2]) -> CircuitPiece {
        let map = self.map.restricted([from, to]);
        let split = (self.split - (from + to) / 2.0) / ((to - from) / 2.0);
        match () {
            () if split >= 1.0 => CircuitPiece { map, passes: [self.passes[0]; 2], split: 1.0 },
            () if split <= -1.0 => CircuitPiece { map, passes: [self.passes[1]; 2], split: 1.0 },
            () => CircuitPiece { map, passes: self.passes, split },
        }
    }
}

/// A circuit in pieces, in the order of the motion.
#[derive(Clone, Debug)]
pub struct CircuitPieces {
    /// The pieces, without gaps.
    pub pieces: Vec<CircuitPiece>,
    /// The positions of all joints at the [`Chebyshev::nodes`] of all pieces, in the frame the linkage is seen from.
    positions: JointPositions,
    /// Whether paths may have a corner between each piece and the one before it; of the first piece of a closed
    /// circuit, between it and the last.
    pub corners: Vec<bool>,
}

impl CircuitPieces {
    /// The positions of a joint on a piece: the series of x and of y.
    pub fn series(&self, piece: usize, joint: JointId) -> [Chebyshev; 2] {
        let column = |values: &[f64]| Chebyshev::from_values(nodes_of(values, piece));
        [column(self.positions.x(joint)), column(self.positions.y(joint))]
    }

    /// The positions of all joints at the nodes of all pieces, [`TERMS`] a piece.
    pub fn positions(&self) -> &JointPositions {
        &self.positions
    }

    /// The number of pieces.
    pub fn len(&self) -> usize {
        self.pieces.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }
}

impl Circuit {
    /// The circuit in pieces; computed on first use.
    pub fn pieces(&self, linkage: &Linkage) -> &CircuitPieces {
        self.pieces.get_or_init(|| {
            let circuit = UnsampledCircuit { passes: self.passes.clone(), is_closed: self.is_closed };
            Box::new(divide_circuit(linkage, &circuit))
        })
    }
}

/// What happens between a pass and the next.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Junction {
    /// Whether the input reverses, or positions change with its root.
    is_limit: bool,
    /// Whether positions are analytic across it in the regular parameter.
    is_analytic: bool,
    /// Whether there is nothing at all: the seam of a full turn, or the end of a range.
    is_plain: bool,
}

/// The junction at the end of pass `k`; at the end of an open circuit there is nothing to continue with.
fn junction_after(linkage: &Linkage, circuit: &UnsampledCircuit, k: usize) -> Junction {
    let pass = &circuit.passes[k];
    let is_last = k + 1 == circuit.passes.len();
    if pass.to.flat_dyads.is_empty() {
        return Junction { is_limit: false, is_analytic: false, is_plain: true };
    }
    if is_last && !circuit.is_closed {
        return Junction {
            is_limit: is_unbounded_at(linkage, pass, pass.to.input.value),
            is_analytic: false,
            is_plain: false,
        };
    }
    let next = &circuit.passes[(k + 1) % circuit.passes.len()];
    let is_limit = pass.input_direction() != next.input_direction();
    let is_analytic = linkage
        .dyad_ids()
        .all(|dyad| pass.to.flat_dyads.contains(dyad) == (pass.mode.sign(dyad) != next.mode.sign(dyad)));
    Junction { is_limit, is_analytic, is_plain: false }
}

/// Whether the velocity of a joint is unbounded at an input of a pass.
fn is_unbounded_at(linkage: &Linkage, pass: &Pass, input: f64) -> bool {
    let derivatives = JointDerivatives::on_pass(linkage, pass, input);
    linkage.joint_ids().any(|joint| {
        let velocity = derivatives.velocity(joint);
        !velocity.x.is_finite() || !velocity.y.is_finite()
    })
}

/// The greatest part of a turn of the fastest crank that a piece spans at first, as a number of pieces a turn.
const PIECES_PER_TURN: f64 = 8.0;

/// The number of pieces a stretch of an actuator's stroke is first divided into.
const PIECES_PER_STROKE: f64 = 4.0;

/// The most pieces of a circuit; one that needs more is resolved as well as these can. A crank geared to turn thousands of
/// times needs as many.
const MAX_PIECES: usize = 1024;

/// The number of nodes of a circuit, about: of a linkage whose circuits turn fully.
pub(super) fn estimate_node_count(linkage: &Linkage) -> usize {
    /// Most first pieces are halved once, and some again.
    const PARTS: f64 = 4.0;
    let turns = match linkage.input() {
        Input::Angle { turns } => f64::from(turns),
        Input::Length => 1.0,
    };
    let pieces = turns * PIECES_PER_TURN * linkage.fastest_crank_ratio() * PARTS;
    TERMS * pieces.min(MAX_PIECES as f64) as usize
}

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

/// The first pieces of a circuit, in order; whether the first of them is centred at the start of the circuit.
fn first_pieces(linkage: &Linkage, circuit: &UnsampledCircuit) -> (Vec<CircuitPiece>, bool) {
    let count = circuit.passes.len();
    let junctions: Vec<Junction> = (0..count).map(|k| junction_after(linkage, circuit, k)).collect();
    let before = |k: usize| match k {
        0 if circuit.is_closed => junctions[count - 1],
        0 => {
            let first = &circuit.passes[0];
            let is_flat = !first.from.flat_dyads.is_empty();
            Junction {
                is_limit: is_flat && is_unbounded_at(linkage, first, first.from.input.value),
                is_analytic: false,
                is_plain: !is_flat,
            }
        }
        k => junctions[k - 1],
    };
    // The input of each pass up to which the root of the distance from a limit is the parameter, at either end.
    let root_share = |k: usize| {
        let length = circuit.passes[k].input_length();
        [before(k), junctions[k]].map(|junction| if junction.is_limit { length / 2.0 } else { 0.0 })
    };
    let widest = match linkage.input() {
        Input::Angle { .. } => 360.0 / PIECES_PER_TURN / linkage.fastest_crank_ratio(),
        Input::Length => circuit.passes.iter().map(Pass::input_length).fold(0.0, f64::max) / PIECES_PER_STROKE,
    };
    let travel: f64 = circuit.passes.iter().map(Pass::input_length).sum();
    let widest = widest.max(travel / (MAX_PIECES / 4) as f64);
    let next = |k: usize| (k + 1) % count;
    // Half the width of the piece centred at each junction: of the root, or of the input.
    let centred = |k: usize| -> f64 {
        let junction = junctions[k];
        let is_joined = (circuit.is_closed || k + 1 != count) && junction.is_analytic;
        let shared = |share: fn([f64; 2], f64) -> f64| {
            let (own, other) = (
                share([root_share(k)[0], root_share(k)[1]], circuit.passes[k].input_length()),
                share([root_share(next(k))[1], root_share(next(k))[0]], circuit.passes[next(k)].input_length()),
            );
            own.min(other)
        };
        match junction {
            _ if !is_joined => 0.0,
            Junction { is_limit: true, .. } => shared(|[_, near], _| near).sqrt(),
            // Half of what is left beside the share of a limit at the other end, and never more than half a piece.
            _ => (shared(|[far, _], length| length - far) / 2.0).min(widest / 2.0),
        }
    };
    let widths: Vec<f64> = (0..count).map(centred).collect();
    let mut pieces = Vec::new();
    let centred_piece = |k: usize| {
        let pass = &circuit.passes[k];
        let map = if junctions[k].is_limit {
            InputMap::Root {
                limit: pass.to.input.value,
                direction: pass.input_direction(),
                middle: 0.0,
                half: widths[k],
            }
        } else {
            InputMap::Linear { middle: pass.to.input.value, half: pass.input_direction() * widths[k] }
        };
        CircuitPiece { map, passes: [k, next(k)], split: 0.0 }
    };
    let starts_centred = circuit.is_closed && widths[count - 1] > 0.0;
    if starts_centred {
        // The inputs at the start are those of the first pass, which may be whole turns from those of the last.
        let piece = centred_piece(count - 1);
        let from = circuit.passes[0].from.input.value;
        let map = match piece.map {
            InputMap::Root { direction, middle, half, .. } => InputMap::Root { limit: from, direction, middle, half },
            InputMap::Linear { half, .. } => InputMap::Linear { middle: from, half },
        };
        pieces.push(CircuitPiece { map, ..piece });
    }
    for (k, pass) in circuit.passes.iter().enumerate() {
        let (direction, [from, to]) = (pass.input_direction(), [pass.from.input.value, pass.to.input.value]);
        let [root_from, root_to] = root_share(k);
        let width_from = if k > 0 || circuit.is_closed { widths[(k + count - 1) % count] } else { 0.0 };
        let root = |limit: f64, side: f64, [low, high]: [f64; 2], pieces: &mut Vec<CircuitPiece>| {
            // Before its limit the root is negative.
            if high - low > 1e-9 * high {
                let middle = side * (low + high) / 2.0;
                let map = InputMap::Root { limit, direction: direction * -side, middle, half: (high - low) / 2.0 };
                pieces.push(CircuitPiece::on_pass(k, map));
            }
        };
        if root_from > 0.0 {
            root(from, 1.0, [width_from, root_from.sqrt()], &mut pieces);
        }
        let linear_from = from + direction * if root_from > 0.0 { root_from } else { width_from };
        let linear_to = to - direction * if root_to > 0.0 { root_to } else { widths[k] };
        let length = (linear_to - linear_from) * direction;
        if length > 1e-9 * pass.input_length() {
            let parts = (length / widest - 1e-9).ceil().max(1.0);
            for part in 0..parts as usize {
                let half = (linear_to - linear_from) / parts / 2.0;
                let middle = linear_from + half * (2 * part + 1) as f64;
                pieces.push(CircuitPiece::on_pass(k, InputMap::Linear { middle, half }));
            }
        }
        if root_to > 0.0 {
            root(to, -1.0, [widths[k], root_to.sqrt()], &mut pieces);
        }
        if widths[k] > 0.0 && k + 1 < count {
            pieces.push(centred_piece(k));
        }
    }
    (pieces, starts_centred)
}

/// The last terms of a resolved series, relative to the size of the linkage: a few roundings of its positions.
const RESOLVED: f64 = 2e-15;

/// Where rounding is greater than [`RESOLVED`], dividing does not help. Last terms up to this part of the size that do
/// not decrease are taken to be rounding.
const ROUNDING: f64 = 1e-10;

/// Each division halves a piece. After this many its ends are nearly neighbouring numbers.
const MAX_DEPTH: usize = 44;

/// A resolved piece: where it was computed.
struct ResolvedPiece {
    piece: PendingPiece,
    round: usize,
    index: usize,
}

/// Divides a circuit.
fn divide_circuit(linkage: &Linkage, circuit: &UnsampledCircuit) -> CircuitPieces {
    let (first, starts_centred) = first_pieces(linkage, circuit);
    let pending = |(k, piece): (usize, &CircuitPiece)| PendingPiece {
        piece: *piece,
        place: [k as f64, k as f64 + 1.0],
        parent_tail: f64::INFINITY,
        depth: 0,
    };
    let mut pending: Vec<PendingPiece> = first.iter().enumerate().map(pending).collect();
    let checked = joints_to_resolve(linkage);
    let mut size = 0.0f64;
    let (mut rounds, mut resolved) = (Vec::new(), Vec::new());
    while !pending.is_empty() {
        let positions = node_positions(linkage, circuit, &pending);
        if rounds.is_empty() {
            size = extent(&positions, &checked);
        }
        let mut next = Vec::new();
        for (index, piece) in pending.iter().enumerate() {
            let tail = tail(&positions, index, &checked) / size;
            let is_rounding = tail <= ROUNDING && tail >= 0.5 * piece.parent_tail;
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

/// The values at the nodes of one piece, in a column of all.
fn nodes_of(column: &[f64], piece: usize) -> &[f64; TERMS] {
    &column.as_chunks::<TERMS>().0[piece]
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
        let signs = DyadSigns::new(circuit.passes[run[0]].mode, DyadSet::EMPTY);
        let all = linkage.joints.len();
        place_leading_joints(linkage, all, columns.slice(range.clone()), &signs, &mut positions, range.clone());
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

//! The pieces that a circuit is divided into at first: at its limits and change points, and evenly between them.

use super::InputMap;
use super::circuit_pieces::{CircuitPiece, MAX_PIECES};
use crate::linkage::{Input, Linkage};
use crate::motion::circuit::UnsampledCircuit;
use crate::motion::derivatives::JointDerivatives;
use crate::motion::pass::Pass;

/// What happens between a pass and the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Junction {
    /// Whether the input reverses, or positions change with its root.
    is_limit: bool,
    /// Whether positions are analytic across it in the regular parameter.
    is_analytic: bool,
    /// Whether there is nothing at all: the seam of a full turn, or the end of a range.
    pub is_plain: bool,
}

/// The junction at the end of pass `k`; at the end of an open circuit there is nothing to continue with.
pub(super) fn junction_after(linkage: &Linkage, circuit: &UnsampledCircuit, k: usize) -> Junction {
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
    // Dyads whose bases vanish are on the sides that continuity requires.
    let is_analytic = pass.mode.flipped(pass.to.flat_dyads).is_same_apart_from(pass.to.vanishing_dyads, next.mode);
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
pub(super) const PIECES_PER_TURN: f64 = 8.0;

/// The number of pieces a stretch of an actuator's stroke is first divided into.
const PIECES_PER_STROKE: f64 = 4.0;

/// The first pieces of a circuit, in order; whether the first of them is centred at the start of the circuit.
pub(super) fn first_pieces(linkage: &Linkage, circuit: &UnsampledCircuit) -> (Vec<CircuitPiece>, bool) {
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

//! A circuit in pieces on which the positions of all joints are polynomials in a regular parameter, to rounding.
//!
//! Between limits the parameter of a piece is the input. Near a limit, where positions change with the root of the
//! input, it is that root: positive after the limit, negative before it, so that one piece continues through the limit
//! and the positions are analytic on it. A piece continues through a change point, too, where every dyad that is flat
//! there changes its side. So no node is near an input at which positions are badly conditioned, except next to a
//! corner, where a piece ends.
//!
//! A piece is divided until the last terms of the Chebyshev series of all joints are rounding.

mod circuit_pieces;
mod division;
mod first_pieces;
mod input_map;

pub use circuit_pieces::{CircuitPiece, CircuitPieces};
pub use input_map::InputMap;

use super::circuit::UnsampledCircuit;
use super::sampling::Circuit;
use crate::geometry::TERMS;
use crate::linkage::{Input, Linkage};
use circuit_pieces::MAX_PIECES;
use division::divide_circuit;
use first_pieces::PIECES_PER_TURN;

impl Circuit {
    /// The circuit in pieces; computed on first use.
    pub fn pieces(&self, linkage: &Linkage) -> &CircuitPieces {
        self.pieces.get_or_init(|| {
            let circuit = UnsampledCircuit { passes: self.passes.clone(), is_closed: self.is_closed };
            Box::new(divide_circuit(linkage, &circuit))
        })
    }
}

/// The number of nodes of a circuit, about: of a linkage whose circuits turn fully.
pub(in crate::motion) fn estimate_node_count(linkage: &Linkage) -> usize {
    /// Most first pieces are halved once, and some again.
    const PARTS: f64 = 4.0;
    let turns = match linkage.input() {
        Input::Angle { turns } => f64::from(turns),
        Input::Length => 1.0,
    };
    let pieces = turns * PIECES_PER_TURN * linkage.fastest_crank_ratio() * PARTS;
    TERMS * pieces.min(MAX_PIECES as f64) as usize
}

//! The pieces of a circuit.

use super::InputMap;
use crate::geometry::{Chebyshev, TERMS};
use crate::linkage::JointId;
use crate::motion::positions::JointPositions;

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
    pub(super) fn on_pass(pass: usize, map: InputMap) -> CircuitPiece {
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
    pub(super) positions: JointPositions,
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

/// The values at the nodes of one piece, in a column of all.
pub(super) fn nodes_of(column: &[f64], piece: usize) -> &[f64; TERMS] {
    &column.as_chunks::<TERMS>().0[piece]
}

/// The most pieces of a circuit; one that needs more is resolved as well as these can. A crank geared to turn thousands of
/// times needs as many.
pub(super) const MAX_PIECES: usize = 1024;

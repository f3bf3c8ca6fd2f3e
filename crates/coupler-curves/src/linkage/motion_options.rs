//! Where a motion starts, its input range, its circuits, and how it continues at change points.

use super::AssemblyMode;

/// Where the motion of a linkage starts, its input range and its circuits.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MotionOptions {
    /// The sides of the dyads at the start.
    pub mode: AssemblyMode,
    /// The input at the start, in degrees or as a length; by default the middle of the first assemblable range from 0
    /// up.
    pub start: Option<f64>,
    /// The least and the greatest input, in degrees or as lengths; by default the whole assemblable range.
    pub range: Option<[f64; 2]>,
    /// The circuits to solve.
    pub circuits: CircuitSelection,
    /// How the motion continues at a change point.
    pub continuation: Continuation,
    /// The dyads that change sides where several are flat at one input.
    pub coincident: CoincidentDyads,
    /// The part of the curve that the source's figure shows; the rest is drawn lighter.
    pub figure_arc: Option<BranchArc>,
}

/// The circuits to solve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CircuitSelection {
    /// The circuit through the start pose.
    #[default]
    Start,
    /// Every circuit.
    All,
}

/// How the motion continues at a change point, where a dyad is flat and both branches meet without a limit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Continuation {
    /// The joints keep their directions and so change to the other branch; a circuit may then take two turns.
    #[default]
    Smooth,
    /// The branch stays the same, and the paths of the joints have a corner.
    Branch,
}

/// The dyads that change sides where several become flat at one input and could change sides independently.
///
/// A dyad whose base joints coincide there changes its side in any case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CoincidentDyads {
    /// All of them.
    #[default]
    Together,
    /// Only the first in the order of joints.
    First,
    /// Only the last in the order of joints.
    Last,
}

/// A part of one branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BranchArc {
    /// The input at its ends, in degrees.
    pub input_deg: [f64; 2],
    /// The side of the first dyad, 1 or -1.
    pub branch: i8,
}

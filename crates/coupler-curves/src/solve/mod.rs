//! Solves one cell of a family: its linkage, motion and measures; changes its parameters before.

mod changed_cell;
mod moved_point;
mod screening;
mod solved_cell;
mod solver;
mod tolerance;

pub use changed_cell::{ChangeError, ChangedCell};
pub use moved_point::MovedPointError;
pub use solved_cell::{MeasuredCurve, SolvedCell, Status};
pub use solver::Solver;

// For the other crates of the workspace only.
#[doc(hidden)]
pub use self::{
    changed_cell::OriginalNumbers,
    moved_point::{MovablePoint, PointCoordinate},
    tolerance::{CurveTolerance, curve_tolerances},
};

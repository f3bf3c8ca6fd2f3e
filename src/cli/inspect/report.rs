//! What is shown of a linkage.

use coupler_curves::family::Family;
use coupler_curves::solve::SolvedCell;

use super::cognate_set::CognateSet;
use super::equation::Equation;
use super::pose::Pose;
use super::tolerance::Tolerance;

/// The description of a linkage.
pub(super) struct Report<'a> {
    pub(super) family: &'a Family,
    pub(super) solved: &'a SolvedCell,
    /// The requested input.
    pub(super) input: Option<f64>,
    /// The poses at that input.
    pub(super) poses: Vec<Pose<'a>>,
    /// The equations of the coupler curves, and whether to print their coefficients.
    pub(super) equations: (Vec<Equation>, bool),
    /// The tolerances of its lengths, if requested.
    pub(super) tolerance: Option<Tolerance>,
    /// The cognates, if requested.
    pub(super) cognates: Option<CognateSet>,
}

//! The result of a synthesis.

use super::kind::DrivenLinkage;
use super::requirements::Requirement;
use super::scaled_design::Design;

/// The result of [`straight_line`](super::straight_line).
#[derive(Clone, Debug, Default)]
pub struct SynthesisResult {
    /// The linkages that meet the requirements, the best first.
    pub designs: Vec<Design>,
    /// The linkages that were rejected, and why.
    pub rejected: Vec<RejectedLinkage>,
    /// If no linkage meets the requirements: for each requirement, the value that would allow one, all others
    /// unchanged.
    pub relaxations: Vec<Relaxation>,
}

/// A linkage that was rejected, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct RejectedLinkage {
    /// The linkage and its driver.
    pub driven_linkage: DrivenLinkage,
    /// Whether its proportions are those of the closed condition.
    pub is_closed_form: bool,
    /// The reason, as a phrase.
    pub reason: String,
}

/// A changed requirement with which all others can be met.
#[derive(Clone, Debug)]
pub struct Relaxation {
    /// The requirement.
    pub requirement: Requirement,
    /// The value it would have to have, to four digits; `None` if it would have to be dropped.
    pub value: Option<f64>,
    /// The linkage that then meets the requirements.
    pub design: Design,
}

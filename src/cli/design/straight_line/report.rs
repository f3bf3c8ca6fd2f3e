//! What is shown of a search for designs.

use crate::design::{Requirement, Requirements, SynthesisResult};

/// The requirements and the result of the search.
pub(super) struct Report {
    pub(super) requirements: Requirements,
    /// Whether the straightness was given as `--deviation`, not as `--tolerance`.
    pub(super) is_deviation_given: bool,
    pub(super) results: SynthesisResult,
}

/// The command-line option that sets a requirement.
pub(super) fn option_name(requirement: Requirement) -> &'static str {
    match requirement {
        Requirement::Input => "--input",
        Requirement::DoublePoint => "--double-point",
        Requirement::QuickReturn => "--return",
        Requirement::P => "--p",
        Requirement::Length => "--length",
        Requirement::Tolerance => "--tolerance",
        Requirement::Size => "--size",
        Requirement::MuMin => "--mu-min",
        Requirement::Kinds => "--types",
    }
}

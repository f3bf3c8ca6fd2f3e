//! What is shown of a search for linkages that guide a body.

use crate::find::{FoundPoses, Relaxed};
use coupler_find::PoseSet;

/// Poses, and what has been found for them.
pub(super) struct PoseReport {
    /// The name of the file.
    pub(super) name: String,
    /// What of the file was taken.
    pub(super) reading: String,
    pub(super) poses: PoseSet,
    pub(super) found: FoundPoses,
}

/// The options without which there are linkages, with what to give for each.
pub(super) fn options_of(relaxed: &Relaxed) -> Vec<&'static str> {
    let option = |option: &&'static str| match *option {
        "full_turn" => "--input any",
        "where" => "another --where",
        "pivots" => "a larger --pivots",
        "max_link" => "a greater --max-link",
        "any_order" => "--any-order",
        "any_circuit" => "--any-circuit",
        other => other,
    };
    relaxed.options.iter().map(option).collect()
}

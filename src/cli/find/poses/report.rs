//! What is shown of a search for linkages that guide a body.

use crate::find::FoundPoses;
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

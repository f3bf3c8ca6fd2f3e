//! What is shown of a search of an atlas.

use crate::find::{AtlasAnswer, Findings};
use crate::manifest::Plan;
use coupler_find::Target;

/// What has been found in an atlas.
pub(super) struct AtlasReport {
    pub(super) name: String,
    /// What of its file was taken.
    pub(super) reading: String,
    pub(super) target: Target,
    pub(super) plan: Plan,
    pub(super) findings: Findings<AtlasAnswer>,
}

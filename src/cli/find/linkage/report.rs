//! What is shown of a search for the dimensions of a linkage.

use crate::find::Findings;
use coupler_find::{LinkageAnswer, Target};

/// What has been found for a linkage.
pub(super) struct LinkageReport {
    pub(super) name: String,
    /// What of its file was taken.
    pub(super) reading: String,
    pub(super) target: Target,
    /// The linkage, or what several are named together.
    pub(super) linkage: String,
    /// The parameters that were searched; none of several linkages.
    pub(super) searched: Option<Vec<String>>,
    pub(super) findings: Findings<LinkageAnswer>,
    /// The text of the linkage, if it is none of the catalogue.
    pub(super) own_linkage: Option<String>,
}

//! What is shown of a search for four-bars.

use std::path::Path;

use coupler_find::{Answer, Constraint, Target};

/// A path, and what has been found for it.
pub(super) struct Report {
    /// The name of the path, for titles.
    pub(super) name: String,
    /// What of its file was taken.
    pub(super) reading: String,
    pub(super) target: Target,
    pub(super) answers: Vec<Answer>,
    /// If there is no answer, the constraints to relax, and the answer without them.
    pub(super) nearest_miss: Option<(Vec<Constraint>, Answer)>,
}

impl Report {
    /// The name of the path without its folder.
    pub fn title(&self) -> String {
        title_of(&self.name)
    }
}

/// The name of a path without its folder.
pub(super) fn title_of(name: &str) -> String {
    Path::new(name).file_name().map_or(name.to_owned(), |name| name.to_string_lossy().into_owned())
}

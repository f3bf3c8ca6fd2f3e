//! What is shown of a search for a function.

use crate::find::function::FunctionAttempt;
use crate::find::function::words::details_in_words;
use coupler_find::{FunctionAnswer, FunctionOptions, FunctionTarget};

use super::super::title_of;

/// A function, and what has been found for it.
pub(super) struct FunctionReport {
    /// The name of its file, or the function as it is written.
    pub name: String,
    pub target: FunctionTarget,
    /// The first row of a table, in degrees or as a length.
    pub first: Option<[f64; 2]>,
    pub options: FunctionOptions,
    /// What has been tried, of which the last is what has been found.
    pub attempts: Vec<FunctionAttempt>,
}

impl FunctionReport {
    /// The name for titles.
    pub fn title(&self) -> String {
        if self.target.as_law().is_some() { self.name.clone() } else { title_of(&self.name) }
    }

    pub fn answers(&self) -> &[FunctionAnswer] {
        self.attempts.last().map_or(&[], |attempt| &attempt.findings.answers)
    }

    /// The linkages, and how they were found: "four-bars, 5 precision points".
    pub fn details(&self) -> String {
        let method = self.attempts.last().map(|attempt| attempt.method);
        details_in_words(&self.target, self.options.kind, method)
    }
}

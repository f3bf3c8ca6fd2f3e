//! What is wrong with a file of another program.

use std::fmt::{self, Display, Formatter};

/// What is wrong with a file of another program: where, what, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The place in the file, as in "joint 3".
    pub place: String,
    /// What is wrong there.
    pub message: String,
    /// How to mend it.
    pub remedy: String,
}

impl Error {
    pub(super) fn new(place: impl Display, message: impl Display, remedy: impl Display) -> Error {
        Error { place: place.to_string(), message: message.to_string(), remedy: remedy.to_string() }
    }
}

impl Display for Error {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(f, "{}: {}; {}", self.place, self.message, self.remedy)
    }
}

impl std::error::Error for Error {}

/// A text from a file in backquotes, shortened, with escapes for what does not show.
pub(super) fn quote(text: &str) -> String {
    /// The most characters that are quoted.
    const MAX_QUOTED: usize = 40;
    let shortened: String = text.chars().take(MAX_QUOTED).collect();
    let more = if shortened.len() < text.len() { "…" } else { "" };
    format!("`{}{more}`", shortened.escape_debug())
}

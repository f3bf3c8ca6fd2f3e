//! Problems in a text, each with its place and how to fix it.
//!
//! A parser does not stop at the first mistake: it adds a [`Problem`] and continues, so that one run reports all of
//! them. [`report()`] renders them with the offending text underlined.

mod report;
mod suggestion;

pub use report::report;

// For the other crates of the workspace only.
#[doc(hidden)]
pub use self::suggestion::{list_words, nearest_word, suggestion, suggestion_among};

use std::ops::Range;

/// A range of bytes in a text.
pub type Span = Range<usize>;

/// The severity of a problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The text is invalid.
    Error,
    /// The text is valid, but may not be what was meant.
    Warning,
}

/// A problem in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Error or warning.
    pub severity: Severity,
    /// The message, in lower case and without a full stop.
    pub message: String,
    /// The offending part of the text.
    pub span: Span,
    /// A label next to the underline; may be empty.
    pub label: String,
    /// How to fix it; may be empty.
    pub help: String,
}

impl Problem {
    /// An error at `span`.
    pub fn error(span: Span, message: impl Into<String>) -> Problem {
        Problem { severity: Severity::Error, message: message.into(), span, label: String::new(), help: String::new() }
    }

    /// A warning at `span`.
    pub fn warning(span: Span, message: impl Into<String>) -> Problem {
        Problem { severity: Severity::Warning, ..Problem::error(span, message) }
    }

    /// Sets the label next to the underline.
    pub fn with_label(mut self, label: impl Into<String>) -> Problem {
        self.label = label.into();
        self
    }

    /// Sets the help, which says how to fix it.
    pub fn with_help(mut self, help: impl Into<String>) -> Problem {
        self.help = help.into();
        self
    }

    /// Whether this is an error rather than a warning.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

//! What is wrong with a text, where in it, and the remedy.
//!
//! A reader of texts never stops at the first mistake: it notes a [`Problem`] and reads on, so that one run names
//! them all. [`report`] draws them with the offending text underlined.

mod report;
mod suggestion;

pub use report::report;
pub use suggestion::{nearest_word, suggestion};

use std::ops::Range;

/// A place in a text: a range of bytes.
pub type Span = Range<usize>;

/// How grave a problem is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// Nothing can be made of the text.
    Error,
    /// The text is understood, but perhaps not what was meant.
    Warning,
}

/// One thing wrong with a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Error or warning.
    pub severity: Severity,
    /// What is wrong, in lower case and without a full stop.
    pub message: String,
    /// The offending text, in bytes from the start of the text.
    pub span: Span,
    /// A word beside the underline; may be empty.
    pub label: String,
    /// The remedy; may be empty.
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

    /// The same with a word beside the underline.
    pub fn with_label(mut self, label: impl Into<String>) -> Problem {
        self.label = label.into();
        self
    }

    /// The same with a remedy.
    pub fn with_help(mut self, help: impl Into<String>) -> Problem {
        self.help = help.into();
        self
    }

    /// Whether this is an error and not a warning.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

//! How users write options.

use std::fmt::Display;

/// How users write an option.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notation {
    /// `--max-link 3`
    CommandLine,
    /// `max_link=3`
    Python,
}

impl Notation {
    /// An option without its value.
    pub fn name(self, option: &str) -> String {
        match self {
            Notation::CommandLine => format!("--{}", option.replace('_', "-")),
            Notation::Python => option.to_owned(),
        }
    }

    /// An option with its value.
    pub fn with_value(self, option: &str, value: impl Display) -> String {
        let between = if self == Notation::Python { "=" } else { " " };
        format!("{}{between}{value}", self.name(option))
    }
}

//! The kinds of expressions.

/// The kind of an expression's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A number.
    Number,
    /// True or false.
    Boolean,
}

impl Kind {
    /// The message for a value of the other kind where this one is expected.
    pub(super) fn mismatch_message(self) -> &'static str {
        match self {
            Kind::Number => "expected a number, found a condition",
            Kind::Boolean => "expected a condition, found a numeric expression",
        }
    }
}

//! Expressions in manifests: parsed once, evaluated often.
//!
//! The operators, from loosest to tightest:
//!
//! ```text
//! or
//! and
//! not
//! ==  !=  <  <=  >  >=
//! +  -
//! *  /
//! unary -
//! ^
//! ```
//!
//! `^` is right-associative and binds tighter than unary minus: `-2^2` is -4 and `2^3^2` is 512. Angles are in
//! radians. `x == 110 +- 0.5`, also written `±`, is `abs(x - 110) <= 0.5`. A missing value is NaN: it propagates through arithmetic, and every comparison with it is false. Booleans
//! are 1 and 0. No text makes the parser panic, and nesting beyond [`MAX_DEPTH`] is an error.

mod angle_units;
mod arithmetic;
mod caption;
mod conjuncts;
mod function;
mod kind;
mod lexer;
mod math_text;
mod parser;
mod program;
mod quantity;
mod scope;
mod unit;

pub use caption::Caption;
pub(crate) use caption::format_number;
pub use kind::Kind;
pub use program::{CompiledExpression, Expression};
pub use scope::Scope;
pub use unit::Unit;
pub(crate) use unit::length_unit_help;

// For the other crates of the workspace only.
#[doc(hidden)]
pub use self::{
    conjuncts::{Comparison, Relation},
    function::Function,
    math_text::{MathPiece, MathText, displayed_name, join_names},
    program::PostfixToken,
    quantity::Quantity,
    unit::Dimension,
};

use crate::problem::{Problem, Span};

/// The greatest depth to which parentheses, function calls, powers and signs may be nested.
#[doc(hidden)]
pub const MAX_DEPTH: usize = 100;

/// The names that always have a value.
#[doc(hidden)]
pub const CONSTANTS: [(&str, f64); 1] = [("pi", std::f64::consts::PI)];

/// The most errors of one expression or caption that are told.
const MAX_ERRORS: usize = 500;

/// An error in an expression; the span is in bytes from the start of the expression's own text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Error {
    /// What is wrong.
    pub message: String,
    /// The place of the error.
    pub span: Span,
    /// How to fix it; may be empty.
    pub help: String,
    /// Whether it is a name that has no meaning in a scope.
    pub is_unknown_name: bool,
    /// What else is wrong with the expression, apart from this.
    pub others: Vec<Error>,
}

impl Error {
    /// What is wrong and how to fix it, in one line, also of the others.
    pub fn message_with_help(&self) -> String {
        let parts = std::iter::once(self).chain(&self.others).flat_map(|error| [&*error.message, &*error.help]);
        parts.filter(|part| !part.is_empty()).collect::<Vec<_>>().join("; ")
    }

    pub(crate) fn new(span: Span, message: impl Into<String>, help: impl Into<String>) -> Error {
        Error { message: message.into(), span, help: help.into(), is_unknown_name: false, others: Vec::new() }
    }

    /// Errors of one expression as one, the first; `None` if there are none.
    fn joined(mut errors: Vec<Error>) -> Option<Error> {
        let others = errors.split_off(1.min(errors.len()));
        errors.pop().map(|error| Error { others, ..error })
    }

    /// This error and the others, each by itself.
    pub fn into_each(mut self) -> impl Iterator<Item = Error> {
        let others = std::mem::take(&mut self.others);
        std::iter::once(self).chain(others)
    }

    /// The same errors in a larger text, in which the expression begins at `start`.
    pub(crate) fn moved_by(mut self, start: usize) -> Error {
        let others = self.others.iter_mut().map(|error| &mut error.span);
        std::iter::once(&mut self.span).chain(others).for_each(|span| *span = start + span.start..start + span.end);
        self
    }

    /// The error, without the others, as a problem of a larger text; `to_outer_span` maps spans of the expression to spans of that text.
    pub fn into_problem(self, to_outer_span: impl FnOnce(Span) -> Span) -> Problem {
        Problem::error(to_outer_span(self.span), self.message).with_help(self.help)
    }
}

//! The arithmetic of manifests: parsed once, evaluated often.
//!
//! ```text
//! or  and  not  = the comparisons == != < <= > >=  + -  * /  unary minus  ^      from loosest to tightest
//! ```
//!
//! `^` is right-associative and binds tighter than unary minus: `-2^2` is -4 and `2^3^2` is 512. Angles are
//! radians. A value that is missing is not a number: every comparison with it is false, and it spreads through
//! arithmetic. Truths are 1 and 0. Nothing panics on any text, and nesting beyond [`MAX_DEPTH`] is an error.

mod caption;
mod function;
mod lexer;
mod parser;
mod program;
mod quantity;

pub use caption::Caption;
pub use function::Function;
pub use program::{CompiledExpression, Expression, Kind, PostfixToken};
pub use quantity::{Dimension, Quantity, Unit};

use crate::problem::{Problem, Span};

/// How deep parentheses, function calls, powers and signs may be nested.
pub const MAX_DEPTH: usize = 100;

/// The names that always have a value.
pub const CONSTANTS: [(&str, f64); 1] = [("pi", std::f64::consts::PI)];

/// What is wrong with an expression; the span is in bytes from the start of the expression's own text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Error {
    /// What is wrong.
    pub message: String,
    /// Where.
    pub span: Span,
    /// The remedy; may be empty.
    pub help: String,
}

impl Error {
    fn new(span: Span, message: impl Into<String>, help: impl Into<String>) -> Error {
        Error { message: message.into(), span, help: help.into() }
    }

    /// The error as a problem of the text that `place` maps this expression's spans into.
    pub fn into_problem(self, place: impl FnOnce(Span) -> Span) -> Problem {
        Problem::error(place(self.span), self.message).with_help(self.help)
    }
}

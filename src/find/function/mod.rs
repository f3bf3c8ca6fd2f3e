//! Function generation: what is read, asked and shown of it.

mod drawing;
mod formula;
mod manifest;
mod request;
mod search;
pub mod words;

pub use drawing::draw_function;
pub use formula::{FORMULA_EXAMPLE, is_formula, parse_formula};
pub use manifest::function_manifest;
pub use request::{FunctionFit, FunctionRequest};
pub use search::{FunctionAttempt, find_function};

//! Function generation: what is read, asked and shown of it.

mod drawing;
mod file;
mod formula;
mod linkage;
mod manifest;
mod record;
mod request;
mod search;
pub mod words;

pub use drawing::{draw_function, draw_linkage_function};
pub use file::{ReadFunction, read_function};
pub use formula::{FORMULA_EXAMPLE, is_formula, parse_formula};
pub use linkage::{find_function_by, linkage_error_in_words, linkage_function_manifest, linkage_motion_in_words};
pub use manifest::function_manifest;
pub use record::{FunctionRecord, LinkageFunctionRecord, method_name};
pub use request::{FunctionFit, FunctionLinkage, FunctionRequest, FunctionSearch};
pub use search::{FunctionAttempt, find_function};

//! A template as written in TOML: the `[[linkage]]` tables of manifests and of the catalogue.

mod joint;
mod joints;
mod linkage;
mod normal;
mod reader;

pub use linkage::{CIRCUITS, COINCIDENTS, CONTINUATIONS, check_name, slug, template};
pub use normal::normal;
pub use reader::{Fields, Reader, Value};

use crate::problem::Problem;
use crate::template::Template;

/// The templates of a text that has nothing but `[[linkage]]` tables.
///
/// # Errors
/// Every problem of the text.
pub fn templates(text: &str) -> Result<Vec<Template>, Vec<Problem>> {
    let mut reader = Reader::new(text);
    let document = reader.document();
    let mut found = Vec::new();
    if let Some(root) = Fields::of(&document, "the file", &["linkage"], &mut reader) {
        for value in root.tables("linkage", &mut reader) {
            found.extend(template(value, &mut reader));
        }
    }
    let problems = reader.into_problems();
    if problems.is_empty() { Ok(found) } else { Err(problems) }
}

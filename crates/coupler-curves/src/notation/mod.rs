//! A template as written in TOML: the `[[linkage]]` tables of manifests and of the catalogue.

mod fields;
mod form;
mod joint;
mod joints;
mod kinds;
mod linkage;
mod normal;
mod reader;

pub use fields::Fields;
pub use form::{Form, Key, Table, words};
pub use linkage::{
    CIRCUITS, CIRCUITS_KEY, COINCIDENT_KEY, COINCIDENTS, CONTINUATION_KEY, CONTINUATIONS, check_name, slug, template,
};
pub use normal::normal;
pub use reader::{Reader, Value};

use linkage::LINKAGE;

use crate::problem::Problem;
use crate::template::Template;

/// The key of `[[linkage]]` tables.
pub const LINKAGES: Key =
    Key::new("linkage", Form::List(&ONE, [0, usize::MAX]), "Linkages of one's own, joint by joint.");
static ONE: Form = Form::Table(&LINKAGE);

static FILE: Table = Table::new("the file", &[LINKAGES]);

/// The templates of a text that has nothing but `[[linkage]]` tables.
///
/// # Errors
/// Every problem of the text.
pub fn templates(text: &str) -> Result<Vec<Template>, Vec<Problem>> {
    let mut reader = Reader::new(text);
    let document = reader.document();
    let mut found = Vec::new();
    if let Some(root) = Fields::of(&document, &FILE, &mut reader) {
        for value in root.tables("linkage", &mut reader) {
            found.extend(template(value, &mut reader));
        }
    }
    let problems = reader.into_problems();
    if problems.is_empty() { Ok(found) } else { Err(problems) }
}

//! A template as written in TOML: the `[[linkage]]` tables of manifests and of the catalogue.

mod canonical;
mod fields;
mod joint;
mod joint_kinds;
mod joints;
mod linkage;
mod schema;
mod toml_parser;

pub use canonical::canonical_text;
pub use fields::Fields;
pub use linkage::{
    CIRCUIT_SELECTIONS, CIRCUITS_KEY, COINCIDENT_DYADS, COINCIDENT_KEY, CONTINUATION_KEY, CONTINUATIONS,
    check_identifier, parse_slug, parse_template,
};
pub use schema::{KeySchema, TableSchema, ValueSchema, words};
pub use toml_parser::{TomlParser, TomlValue};

use linkage::LINKAGE;

use crate::problem::Problem;
use crate::template::Template;

/// The key of `[[linkage]]` tables.
pub const LINKAGES_KEY: KeySchema = KeySchema::new(
    "linkage",
    ValueSchema::List(&LINKAGE_SCHEMA, [0, usize::MAX]),
    "Linkages of one's own, joint by joint.",
);
static LINKAGE_SCHEMA: ValueSchema = ValueSchema::Table(&LINKAGE);

static FILE: TableSchema = TableSchema::new("the file", &[LINKAGES_KEY]);

/// The templates of a text that has nothing but `[[linkage]]` tables.
///
/// # Errors
/// Every problem of the text.
pub fn parse_templates(text: &str) -> Result<Vec<Template>, Vec<Problem>> {
    let mut reader = TomlParser::new(text);
    let document = reader.parse_document();
    let mut found = Vec::new();
    if let Some(root) = Fields::from_value(&document, &FILE, &mut reader) {
        for value in root.tables("linkage", &mut reader) {
            found.extend(parse_template(value, &mut reader));
        }
    }
    let problems = reader.into_problems();
    if problems.is_empty() { Ok(found) } else { Err(problems) }
}

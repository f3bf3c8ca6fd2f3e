//! The linkage format: templates as `[[linkage]]` tables in TOML, in manifests and in the catalogue.

mod canonical;
mod drawing;
mod entries;
mod fields;
mod identifiers;
mod joint_forms;
mod joint_id;
mod joint_values;
mod joints;
mod linkage;
mod load;
mod names;
mod parameters;
mod quantities;
mod schema;
mod syntax_errors;
mod tolerance;
mod toml_parser;

// For the other crates of the workspace only.
#[doc(hidden)]
pub use self::{
    canonical::{canonical_toml, quoted, toml_key, toml_number},
    fields::{Fields, one_or_more},
    identifiers::{check_identifier, identifier_error, parse_slug},
    linkage::{
        CIRCUIT_SELECTIONS, CIRCUITS_KEY, COINCIDENT_DYADS, COINCIDENT_KEY, CONTINUATION_KEY, CONTINUATIONS,
        parse_template,
    },
    load::{LOAD_KEY, parse_load},
    schema::{KeySchema, TableSchema, ValueSchema, words},
    tolerance::{TOLERANCE_KEY, parse_tolerance},
    toml_parser::{MAX_PROBLEMS, TomlParser, TomlValue},
};

use linkage::LINKAGE;

use crate::problem::Problem;
use crate::template::Template;

/// The key of `[[linkage]]` tables.
#[doc(hidden)]
pub const LINKAGES_KEY: KeySchema = KeySchema::new(
    "linkage",
    ValueSchema::List(&LINKAGE_SCHEMA, [0, usize::MAX]),
    "Custom linkages, by a drawing or joint by joint.",
);
static LINKAGE_SCHEMA: ValueSchema = ValueSchema::Table(&LINKAGE);

static FILE: TableSchema = TableSchema::new("the file", &[LINKAGES_KEY]);

/// Parses a text that consists of `[[linkage]]` tables.
///
/// # Errors
/// Every problem of the text.
pub fn parse_templates(text: &str) -> Result<Vec<Template>, Vec<Problem>> {
    let mut parser = TomlParser::new(text);
    let document = parser.parse_document();
    let mut templates = Vec::new();
    if let Some(root) = Fields::from_value(&document, &FILE, &mut parser) {
        for value in root.tables("linkage", &mut parser) {
            templates.extend(parse_template(value, &mut parser));
        }
    }
    let problems = parser.into_problems();
    if problems.is_empty() { Ok(templates) } else { Err(problems) }
}

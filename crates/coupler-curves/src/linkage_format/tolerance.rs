//! The schema of a `tolerance` and its parser.

use super::schema::{KeySchema, ValueSchema};
use super::toml_parser::{TomlParser, TomlValue};
use crate::problem::Problem;
use crate::template::Template;

/// The key of a tolerance: of a `[[linkage]]`, and of a family in its place.
pub const TOLERANCE_KEY: KeySchema = KeySchema::new(
    "tolerance",
    ValueSchema::Positive,
    "How far each length of the linkage may be off: measures of the moves of the curve follow from it, and a band along it.",
);

/// Parses the tolerance of the lengths of a template, if it is known.
pub fn parse_tolerance<'t>(
    value: &TomlValue<'t>,
    template: Option<&Template>,
    parser: &mut TomlParser<'t>,
) -> Option<f64> {
    let tolerance = parser.constant(value)?;
    if tolerance <= 0.0 {
        let problem = Problem::error(value.span(), format!("`tolerance` must be greater than 0, found {tolerance}"));
        parser
            .report(problem.with_help("it is a length, such as 0.1: each length of the linkage is off by it at most"));
        return None;
    }
    let template = template?;
    if template.lengths().is_none() {
        let message = format!("`{}`: {}", template.id, Template::NO_LENGTHS);
        let help = "leave `tolerance` out, or trace one point of the grid";
        parser.report(Problem::error(value.span(), message).with_help(help));
        return None;
    }
    Some(tolerance)
}

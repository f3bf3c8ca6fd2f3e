//! The schema of `parameters` of a `[[linkage]]` and its parser.

use super::fields::Fields;
use super::identifiers::check_identifier;
use super::schema::{KeySchema, TableSchema, ValueSchema, words};
use super::toml_parser::{TomlParser, TomlValue};
use crate::expression::{Dimension, Kind, Scope, Unit};
use crate::problem::Problem;
use crate::template::{Parameter, ParameterKind};

/// The keys of a parameter.
pub(super) static PARAMETER: TableSchema = TableSchema::new(
    "a parameter",
    &[
        KeySchema::new(
            "default",
            ValueSchema::Number,
            "The value where a family gives none; it may use other parameters.",
        ),
        KeySchema::new(
            "example",
            ValueSchema::Number,
            "A value for a family to start from, where there is no default.",
        ),
        KeySchema::new("min", ValueSchema::Number, "The least value; a bound of 0 is itself excluded."),
        KeySchema::new("max", ValueSchema::Number, "The greatest value; a bound of 0 is itself excluded."),
        KeySchema::new(
            "kind",
            ValueSchema::Word(|| words(&PARAMETER_KINDS)),
            "What it is a number of; by default as its use shows.",
        ),
        KeySchema::new(
            "unit",
            ValueSchema::Word(|| words(Dimension::Angle.units())),
            "The unit of an angle; by default the one it is used with, or else radians.",
        ),
    ],
);

/// The words for the kinds of parameters.
const PARAMETER_KINDS: [(&str, ParameterKind); 3] =
    [("length", ParameterKind::Length), ("angle", ParameterKind::Angle(Unit::Rad)), ("ratio", ParameterKind::Ratio)];

/// Parses the parameters, and whether each states its unit; `None` if it is not known which there are.
pub(super) fn parse_parameters<'t>(
    value: &TomlValue<'t>,
    parser: &mut TomlParser<'t>,
) -> Option<Vec<(Parameter, bool)>> {
    let table = Fields::with_any_keys(value, "`parameters`", parser)?;
    let scope = Scope::from_numbers(table.keys());
    let mut out = Vec::new();
    for (name, span, value) in table.entries() {
        check_identifier(name, span, parser);
        // One that cannot be read has its name all the same.
        let fields = Fields::from_value(value, &PARAMETER, parser);
        let get = |key: &str| fields.as_ref().and_then(|fields| fields.get(key));
        let default = get("default").and_then(|value| {
            let expression = parser.expression(value)?;
            let compiled = expression.compile(&scope, Kind::Number);
            parser.ok_or_report(value, compiled).map(|_| expression)
        });
        let limit = |key, parser: &mut TomlParser<'t>| get(key).and_then(|value| parser.constant(value));
        let (min, max) = (limit("min", parser), limit("max", parser));
        if let (Some(min), Some(max)) = (min, max)
            && min > max
        {
            let problem = Problem::error(value.span(), format!("the least value {min} is above the greatest {max}"));
            parser.report(problem.with_help("exchange `min` and `max`"));
        }
        let kind = get("kind").and_then(|value| parser.word(value, &PARAMETER_KINDS));
        let unit = get("unit").and_then(|value| Some((value, parser.word(value, Dimension::Angle.units())?)));
        let kind = match (kind, unit) {
            (None | Some(ParameterKind::Angle(_)), Some((_, unit))) => ParameterKind::Angle(unit),
            (Some(kind), Some((value, _))) => {
                let problem = Problem::error(value.span(), format!("`{name}` is {}", kind.description()));
                parser.report(problem.with_help("only angles have a unit: leave it out, or write kind = \"angle\""));
                kind
            }
            (kind, None) => kind.unwrap_or_default(),
        };
        let default_text = get("default").map(|value| parser.value_text(value)).unwrap_or_default();
        let example = limit("example", parser);
        let parameter = Parameter { name: name.to_owned(), kind, default, default_text, example, min, max };
        out.push((parameter, unit.is_some()));
    }
    Some(out)
}

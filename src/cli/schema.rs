//! The JSON Schema of a manifest, generated from the tables that its parser uses.

use crate::manifest::{KeySchema, MANIFEST, TableSchema, ValueSchema};
use coupler_curves::expression::Dimension;
use serde_json::{Map, Value, json};

/// The schema (2020-12), with which an editor completes a manifest and marks its errors.
pub(super) fn schema_json() -> String {
    let mut schema = table(&MANIFEST);
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("A manifest of coupler-atlas");
    format!("{schema:#}\n")
}

fn table(table: &TableSchema) -> Value {
    let properties: Map<String, Value> = table.keys.iter().map(|key| (key.name.to_owned(), property(key))).collect();
    let required: Vec<&str> = table.keys.iter().filter(|key| key.is_required).map(|key| key.name).collect();
    let mut schema = json!({ "type": "object", "properties": properties, "additionalProperties": false });
    if !required.is_empty() {
        schema["required"] = json!(required);
    }
    if !table.one_of.is_empty() {
        schema["oneOf"] = table.one_of.iter().map(|key| json!({ "required": [key] })).collect();
    }
    if !table.any_of.is_empty() {
        schema["anyOf"] = table.any_of.iter().map(|key| json!({ "required": [key] })).collect();
    }
    if let Some((key, other)) = table.dependent_keys {
        schema["dependentRequired"] = json!({ key: [other] });
    }
    schema
}

fn property(key: &KeySchema) -> Value {
    let mut schema = value_schema(&key.value);
    schema["description"] = json!(key.description);
    // A default that is not JSON would be left out; a test checks that each one is.
    if let Some(Ok(default)) = key.default.map(|default| serde_json::from_str::<Value>(&default())) {
        schema["default"] = default;
    }
    schema
}

/// A name that an expression can use.
const NAME_PATTERN: &str = "^(?!(and|or|not|pi)$)[A-Za-z_][A-Za-z0-9_]*$";
/// Lower-case letters and digits in words joined by hyphens, except device names of Windows.
const SLUG_PATTERN: &str = "^(?!(con|prn|aux|nul|(com|lpt)[0-9])$)[a-z0-9]+(-[a-z0-9]+)*$";
/// Two numbers, each perhaps with decimals.
const RATIO_PATTERN: &str = "^\\s*[0-9]+([.][0-9]+)?\\s*:\\s*[0-9]+([.][0-9]+)?\\s*$";
const COLOR_PATTERN: &str = "^#([0-9A-Fa-f]{3}|[0-9A-Fa-f]{6})$";

fn value_schema(value: &ValueSchema) -> Value {
    match value {
        ValueSchema::Text => json!({ "type": "string" }),
        ValueSchema::Slug => json!({ "type": "string", "pattern": SLUG_PATTERN, "maxLength": 64 }),
        ValueSchema::Color => json!({ "type": "string", "pattern": COLOR_PATTERN }),
        ValueSchema::Word(words) => json!({ "enum": words() }),
        ValueSchema::WithExamples(base, examples) => {
            let mut schema = value_schema(base);
            schema["examples"] = json!(examples());
            schema
        }
        ValueSchema::Boolean => json!({ "type": "boolean" }),
        ValueSchema::Integer(range) => bounded("integer", "minimum", "maximum", *range),
        // A string is an expression.
        ValueSchema::Number | ValueSchema::Input => json!({ "type": ["number", "string"] }),
        ValueSchema::Positive => json!({ "type": ["number", "string"], "exclusiveMinimum": 0 }),
        ValueSchema::InRange([least, most]) => {
            json!({ "type": ["number", "string"], "minimum": least, "maximum": most })
        }
        // What is not greater than 0 is left to the parser, as it is of other numbers.
        ValueSchema::Ratio => json!({ "type": "string", "pattern": RATIO_PATTERN }),
        ValueSchema::Quantity(dimension) => json!({ "type": "string", "pattern": ends_with_unit(*dimension) }),
        ValueSchema::List(item, range) => list(item, *range),
        ValueSchema::Set(item, range) => {
            let mut schema = list(item, *range);
            schema["uniqueItems"] = json!(true);
            schema
        }
        ValueSchema::OneOrMore(item, least) => {
            json!({ "anyOf": [value_schema(item), list(item, [*least, usize::MAX])] })
        }
        ValueSchema::Table(keys) => table(keys),
        ValueSchema::IdentifierMap(item) => {
            let names = json!({ "pattern": NAME_PATTERN });
            json!({ "type": "object", "propertyNames": names, "additionalProperties": value_schema(item) })
        }
        ValueSchema::Map(item) => json!({ "type": "object", "additionalProperties": value_schema(item) }),
        ValueSchema::Variants(variants) => {
            json!({ "oneOf": variants().into_iter().map(|(_, variant)| table(variant)).collect::<Vec<_>>() })
        }
        ValueSchema::AnyOf(values) => json!({ "anyOf": values.iter().map(value_schema).collect::<Vec<_>>() }),
    }
}

fn list(item: &ValueSchema, range: [usize; 2]) -> Value {
    let mut schema = bounded("array", "minItems", "maxItems", range);
    schema["items"] = value_schema(item);
    schema
}

/// A type with its bounds; `usize::MAX` is none, and 0 only one of numbers, for there are no fewer items.
fn bounded(kind: &str, minimum: &str, maximum: &str, [least, most]: [usize; 2]) -> Value {
    let mut schema = json!({ "type": kind });
    if least > 0 || kind == "integer" {
        schema[minimum] = json!(least);
    }
    if most < usize::MAX {
        schema[maximum] = json!(most);
    }
    schema
}

fn ends_with_unit(dimension: Dimension) -> String {
    let units: Vec<&str> = dimension.units().iter().map(|(name, _)| *name).collect();
    format!("({})\\s*$", units.join("|"))
}

//! The JSON Schema of a manifest, from the tables its reader goes by.

use coupler_atlas::manifest::{Form, Key, MANIFEST, Table};
use coupler_curves::expression::Dimension;
use serde_json::{Map, Value, json};

/// The schema, with which an editor completes a manifest and finds its slips as it is written.
pub(super) fn json() -> String {
    let mut schema = table(&MANIFEST);
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("A manifest of coupler-atlas");
    format!("{schema:#}\n")
}

fn table(table: &Table) -> Value {
    let properties: Map<String, Value> = table.keys.iter().map(|key| (key.name.to_owned(), property(key))).collect();
    let required: Vec<&str> = table.keys.iter().filter(|key| key.is_required).map(|key| key.name).collect();
    let mut schema = json!({ "type": "object", "properties": properties, "additionalProperties": false });
    if !required.is_empty() {
        schema["required"] = json!(required);
    }
    if !table.one_of.is_empty() {
        schema["oneOf"] = table.one_of.iter().map(|key| json!({ "required": [key] })).collect();
    }
    if let Some((key, other)) = table.with {
        schema["dependentRequired"] = json!({ key: [other] });
    }
    schema
}

fn property(key: &Key) -> Value {
    let mut schema = form(&key.form);
    schema["description"] = json!(key.about);
    // A test reads every default.
    if let Ok(default) = serde_json::from_str::<Value>(key.default) {
        schema["default"] = default;
    }
    schema
}

/// A name that can be used in an expression.
const NAME: &str = "^(?!(and|or|not|pi)$)[A-Za-z_][A-Za-z0-9_]*$";
/// Lower-case letters and digits in words joined by hyphens, and no device of Windows.
const SLUG: &str = "^(?!(con|prn|aux|nul|(com|lpt)[0-9])$)[a-z0-9]+(-[a-z0-9]+)*$";
const COLOR: &str = "^#([0-9A-Fa-f]{3}|[0-9A-Fa-f]{6})$";

fn form(form: &Form) -> Value {
    match form {
        Form::Text => json!({ "type": "string" }),
        Form::Slug => json!({ "type": "string", "pattern": SLUG, "maxLength": 64 }),
        Form::Color => json!({ "type": "string", "pattern": COLOR }),
        Form::Word(words) => json!({ "enum": words() }),
        Form::Like(like, examples) => {
            let mut schema = self::form(like);
            schema["examples"] = json!(examples());
            schema
        }
        Form::Truth => json!({ "type": "boolean" }),
        Form::Count(range) => within("integer", "minimum", "maximum", *range),
        // Any text may be an expression.
        Form::Number | Form::Input => json!({ "type": ["number", "string"] }),
        Form::Positive => json!({ "type": ["number", "string"], "exclusiveMinimum": 0 }),
        Form::Within([least, most]) => {
            json!({ "type": ["number", "string"], "minimum": least, "maximum": most })
        }
        Form::Quantity(dimension) => json!({ "type": "string", "pattern": ends_with_unit(*dimension) }),
        Form::List(of, range) => list(of, *range),
        Form::Set(of, range) => {
            let mut schema = list(of, *range);
            schema["uniqueItems"] = json!(true);
            schema
        }
        Form::OneOrMore(of, least) => json!({ "anyOf": [self::form(of), list(of, [*least, usize::MAX])] }),
        Form::Table(keys) => table(keys),
        Form::Names(of) => {
            let names = json!({ "pattern": NAME });
            json!({ "type": "object", "propertyNames": names, "additionalProperties": self::form(of) })
        }
        Form::Entries(of) => json!({ "type": "object", "additionalProperties": self::form(of) }),
        Form::Kinds(kinds) => json!({ "oneOf": kinds.iter().map(|(_, kind)| table(kind)).collect::<Vec<_>>() }),
        Form::Either(forms) => json!({ "anyOf": forms.iter().map(self::form).collect::<Vec<_>>() }),
    }
}

fn list(of: &Form, range: [usize; 2]) -> Value {
    let mut schema = within("array", "minItems", "maxItems", range);
    schema["items"] = form(of);
    schema
}

/// A type with its bounds, so far as there are any.
fn within(kind: &str, minimum: &str, maximum: &str, [least, most]: [usize; 2]) -> Value {
    let mut schema = json!({ "type": kind });
    if least > 0 {
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

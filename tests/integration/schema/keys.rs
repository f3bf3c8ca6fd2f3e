//! The schema has the same keys as the parser.

use std::collections::BTreeSet;

use coupler_atlas::manifest::{MANIFEST, PlannedFamily, TableSchema, ValueSchema};
use coupler_curves::template::Template;
use serde_json::Value;

use super::{EVERY_KEY, SCHEMA, collect_pointers, is_valid, json, parser_errors, toml};

use crate::support::plan::plan;

/// The table schemas of a schema: itself, or those among its alternatives.
fn tables(schema: &Value) -> Vec<&Value> {
    if schema.get("properties").is_some() {
        return vec![schema];
    }
    let alternatives = ["anyOf", "oneOf"].into_iter().filter_map(|key| schema.get(key)?.as_array());
    alternatives.flatten().flat_map(tables).collect()
}

/// The schemas of the values one level below a schema: of the key in a table, of all items in a list.
fn inner<'s>(schema: &'s Value, key: &str) -> Vec<&'s Value> {
    let mut found = Vec::new();
    found.extend(schema.get("properties").and_then(|properties| properties.get(key)));
    found.extend(schema.get("items"));
    found.extend(schema.get("additionalProperties").filter(|inner| inner.is_object()));
    let alternatives = ["anyOf", "oneOf"].into_iter().filter_map(|key| schema.get(key)?.as_array());
    found.extend(alternatives.flatten().flat_map(|alternative| inner(alternative, key)));
    found
}

/// The table schemas at a JSON pointer of a manifest that have all keys of the value there.
fn tables_at<'s>(pointer: &str, value: &Value) -> Vec<&'s Value> {
    let mut schemas = vec![&*SCHEMA];
    for key in pointer.split('/').skip(1) {
        schemas = schemas.into_iter().flat_map(|schema| inner(schema, key)).collect();
    }
    let entries = value.as_object().unwrap();
    let has_keys = |table: &&Value| entries.keys().all(|key| table["properties"].get(key).is_some());
    schemas.into_iter().flat_map(tables).filter(has_keys).collect()
}

/// The words in backquotes.
fn quoted_words(text: &str) -> BTreeSet<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

/// Compares the schema with the parser's help for a key that resembles none, which lists all keys of the table.
#[test]
fn each_table_has_the_keys_that_the_parser_knows() {
    let whole = json(EVERY_KEY);
    let mut pointers = Vec::new();
    collect_pointers(&whole, "", &mut pointers);
    let mut compared = 0;
    for pointer in pointers {
        let value = whole.pointer(&pointer).unwrap();
        if !value.is_object() {
            continue;
        }
        let tables = tables_at(&pointer, value);
        let mut changed = whole.clone();
        changed.pointer_mut(&pointer).unwrap()["zzzzzzzzzzzzzzzzzzzzzzzz"] = Value::from("1");
        let errors = parser_errors(&toml(&changed)).unwrap_or_default();
        let Some((_, help)) = errors.iter().find(|(message, _)| message.contains(" has no key `zzz")) else {
            assert!(tables.is_empty(), "{pointer} has fixed keys in the schema only");
            continue;
        };
        assert!(!is_valid(&changed), "{pointer}");
        let known: Vec<BTreeSet<&str>> = tables
            .iter()
            .map(|table| table["properties"].as_object().unwrap().keys().map(String::as_str).collect())
            .collect();
        assert!(known.contains(&quoted_words(help)), "{pointer}: the parser says {help}, the schema {known:?}");
        compared += 1;
    }
    assert_eq!(compared, 90, "the number of tables compared");
}

/// Collects the keys that a manifest gives, each with the name of its table.
fn collect_given_keys(schema: &ValueSchema, value: &Value, found: &mut BTreeSet<(&'static str, &'static str)>) {
    match (schema, value) {
        (ValueSchema::Table(table), Value::Object(_)) => collect_given_keys_of(table, value, found),
        (
            ValueSchema::List(inner, _) | ValueSchema::Set(inner, _) | ValueSchema::OneOrMore(inner, _),
            Value::Array(items),
        ) => {
            items.iter().for_each(|item| collect_given_keys(inner, item, found));
        }
        (ValueSchema::OneOrMore(inner, _) | ValueSchema::WithExamples(inner, _), value) => {
            collect_given_keys(inner, value, found);
        }
        (ValueSchema::IdentifierMap(inner) | ValueSchema::Map(inner), Value::Object(entries)) => {
            entries.values().for_each(|value| collect_given_keys(inner, value, found));
        }
        (ValueSchema::Variants(variants), Value::Object(entries)) => {
            let (_, variant) = variants().into_iter().find(|(key, _)| entries.contains_key(*key)).unwrap();
            collect_given_keys_of(variant, value, found);
        }
        (ValueSchema::AnyOf(schemas), value) => {
            schemas.iter().for_each(|schema| collect_given_keys(schema, value, found));
        }
        _ => {}
    }
}

fn collect_given_keys_of(table: &TableSchema, value: &Value, found: &mut BTreeSet<(&'static str, &'static str)>) {
    for key in table.keys {
        if let Some(value) = value.get(key.name) {
            found.insert((table.display_name, key.name));
            collect_given_keys(&key.value, value, found);
        }
    }
}

/// Collects the keys of all tables in a schema, each with the name of its table.
fn collect_known_keys(schema: &ValueSchema, found: &mut BTreeSet<(&'static str, &'static str)>) {
    match schema {
        ValueSchema::Table(table) => collect_known_keys_of(table, found),
        ValueSchema::List(inner, _)
        | ValueSchema::Set(inner, _)
        | ValueSchema::OneOrMore(inner, _)
        | ValueSchema::WithExamples(inner, _) => collect_known_keys(inner, found),
        ValueSchema::IdentifierMap(inner) | ValueSchema::Map(inner) => collect_known_keys(inner, found),
        ValueSchema::Variants(variants) => {
            variants().into_iter().for_each(|(_, table)| collect_known_keys_of(table, found))
        }
        ValueSchema::AnyOf(schemas) => schemas.iter().for_each(|schema| collect_known_keys(schema, found)),
        _ => {}
    }
}

fn collect_known_keys_of(table: &TableSchema, found: &mut BTreeSet<(&'static str, &'static str)>) {
    for key in table.keys {
        assert!(
            key.description.ends_with(['.']) && key.description.len() > 8,
            "the description of `{}` of {} is too short or has no full stop",
            key.name,
            table.display_name
        );
        let is_json = |default: fn() -> String| serde_json::from_str::<Value>(&default()).is_ok();
        assert!(key.default.is_none_or(is_json), "the default of `{}` of {} is not JSON", key.name, table.display_name);
        found.insert((table.display_name, key.name));
        collect_known_keys(&key.value, found);
    }
}

/// Ensures that the tests based on that manifest cover every new key.
#[test]
fn the_manifest_with_every_key_has_every_key() {
    let (mut given, mut known) = (BTreeSet::new(), BTreeSet::new());
    collect_given_keys_of(&MANIFEST, &json(EVERY_KEY), &mut given);
    collect_known_keys_of(&MANIFEST, &mut known);
    let missing: Vec<_> = known.difference(&given).collect();
    assert!(missing.is_empty() && known.len() > 120, "{missing:?} of {}", known.len());
}

#[test]
fn writing_out_a_default_changes_nothing() {
    let minimal = "[atlas]\ntitle = \"T\"\n[page]\ntheme = {}\n[[family]]\nid = \"f\"\nlinkage = \"own\"\nplace = {}\n\
                 sampling = { samples = 9 }\ncases = [{ g = 4 }]\n[[linkage]]\nid = \"own\"\ntrace = [\"M\"]\n\
                 parameters = { g = {} }\n[linkage.joints]\nO = { fixed = [0, 0] }\nC = { fixed = [\"g\", 0] }\n\
                 A = { crank = \"O\", length = 1 }\nB = { dyad = [\"A\", \"C\"], lengths = [3, 3], side = \"left\" }\n\
                 M = { point = [\"A\", \"B\"] }\nG = { gear = \"A\", about = \"C\", length = 1, ratio = [1, 1] }\n\
                 N = { dyad = [\"G\", \"M\"], lengths = [9, 9], side = \"left\" }\n";
    let minimal = minimal.replace("trace = [\"M\"]", "trace = [\"M\", \"N\"]");
    let plan = |manifest: &Value| {
        let plan = plan(&toml(manifest));
        let PlannedFamily { family, layout, chart, formats, source, .. } = &plan.families[0];
        let Template { circuits, continuation, coincident, orientation: placement, .. } = &*family.template;
        let linkage = family.linkage(&family.cell(0)).unwrap();
        let options =
            (&family.sampling, &family.columns, &family.measures, &family.straight, circuits, continuation, coincident);
        let atlas = (&plan.title, &plan.output, plan.volume_pages, &plan.page, plan.dpi, plan.text_mode);
        format!("{atlas:?} {layout:?} {chart:?} {formats:?} {source} {options:?} {placement:?} {linkage:?}")
    };
    let (whole, mut compared) = (json(&minimal), 0);
    let expected = plan(&whole);
    let mut pointers = Vec::new();
    collect_pointers(&whole, "", &mut pointers);
    for pointer in pointers {
        let value = whole.pointer(&pointer).unwrap();
        let tables = if value.is_object() { tables_at(&pointer, value) } else { Vec::new() };
        let [table] = tables[..] else { continue };
        for (key, property) in table["properties"].as_object().unwrap() {
            let Some(default) = property.get("default").filter(|_| value.get(key).is_none()) else { continue };
            let mut changed = whole.clone();
            changed.pointer_mut(&pointer).unwrap()[key] = default.clone();
            assert_eq!(plan(&changed), expected, "{pointer}/{key}");
            compared += 1;
        }
    }
    assert!(compared >= 25, "only {compared} defaults were written out");
}

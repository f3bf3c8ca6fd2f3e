//! The schema has the reader's keys, and no others.

use std::collections::BTreeSet;

use coupler_atlas::manifest::{self, MANIFEST, PlannedFamily, TableSchema, ValueSchema};
use coupler_curves::template::Template;
use serde_json::Value;

use super::{EVERY_KEY, SCHEMA, complaints, is_valid, json, places, toml};

/// The tables a schema may stand for: itself, or those of its alternatives.
fn tables(schema: &Value) -> Vec<&Value> {
    if schema.get("properties").is_some() {
        return vec![schema];
    }
    let alternatives = ["anyOf", "oneOf"].into_iter().filter_map(|key| schema.get(key)?.as_array());
    alternatives.flatten().flat_map(tables).collect()
}

/// The schemas of what is in a value of a schema, by the key; of a list, that of all its items.
fn inner<'s>(schema: &'s Value, key: &str) -> Vec<&'s Value> {
    let mut found = Vec::new();
    found.extend(schema.get("properties").and_then(|properties| properties.get(key)));
    found.extend(schema.get("items"));
    found.extend(schema.get("additionalProperties").filter(|inner| inner.is_object()));
    let alternatives = ["anyOf", "oneOf"].into_iter().filter_map(|key| schema.get(key)?.as_array());
    found.extend(alternatives.flatten().flat_map(|alternative| inner(alternative, key)));
    found
}

/// The tables of the program's own that may stand at a place of a manifest, without those that do not have its keys.
fn tables_at<'s>(place: &str, value: &Value) -> Vec<&'s Value> {
    let mut schemas = vec![&*SCHEMA];
    for key in place.split('/').skip(1) {
        schemas = schemas.into_iter().flat_map(|schema| inner(schema, key)).collect();
    }
    let entries = value.as_object().unwrap();
    let has_keys = |table: &&Value| entries.keys().all(|key| table["properties"].get(key).is_some());
    schemas.into_iter().flat_map(tables).filter(has_keys).collect()
}

/// The words in backticks.
fn quoted(text: &str) -> BTreeSet<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

/// Asked for a key that is like none, the reader names all it knows.
#[test]
fn each_table_has_the_keys_that_the_reader_knows() {
    let whole = json(EVERY_KEY);
    let mut all = Vec::new();
    places(&whole, "", &mut all);
    let mut seen = 0;
    for place in all {
        let value = whole.pointer(&place).unwrap();
        if !value.is_object() {
            continue;
        }
        let tables = tables_at(&place, value);
        let mut strange = whole.clone();
        strange.pointer_mut(&place).unwrap()["zzzzzzzzzzzzzzzzzzzzzzzz"] = Value::from("1");
        let said = complaints(&toml(&strange)).unwrap_or_default();
        let Some((_, help)) = said.iter().find(|(message, _)| message.contains(" has no key `zzz")) else {
            assert!(tables.is_empty(), "{place} has keys of its own in the schema only");
            continue;
        };
        assert!(!is_valid(&strange), "{place}");
        let known: Vec<BTreeSet<&str>> = tables
            .iter()
            .map(|table| table["properties"].as_object().unwrap().keys().map(String::as_str).collect())
            .collect();
        assert!(known.contains(&quoted(help)), "{place}: the reader says {help}, the schema {known:?}");
        seen += 1;
    }
    assert_eq!(seen, 45, "tables were compared");
}

/// The keys that a manifest gives in the tables of its form, each by its table and its name.
fn given(form: &ValueSchema, value: &Value, found: &mut BTreeSet<(&'static str, &'static str)>) {
    match (form, value) {
        (ValueSchema::Table(table), Value::Object(_)) => given_in(table, value, found),
        (ValueSchema::List(of, _) | ValueSchema::Set(of, _) | ValueSchema::OneOrMore(of, _), Value::Array(items)) => {
            items.iter().for_each(|item| given(of, item, found));
        }
        (ValueSchema::OneOrMore(of, _) | ValueSchema::WithExamples(of, _), value) => given(of, value, found),
        (ValueSchema::IdentifierMap(of) | ValueSchema::Map(of), Value::Object(entries)) => {
            entries.values().for_each(|value| given(of, value, found));
        }
        (ValueSchema::Variants(kinds), Value::Object(entries)) => {
            let kind = kinds.iter().find(|(key, _)| entries.contains_key(*key)).unwrap();
            given_in(&kind.1, value, found);
        }
        (ValueSchema::AnyOf(forms), value) => forms.iter().for_each(|form| given(form, value, found)),
        _ => {}
    }
}

fn given_in(table: &TableSchema, value: &Value, found: &mut BTreeSet<(&'static str, &'static str)>) {
    for key in table.keys {
        if let Some(value) = value.get(key.name) {
            found.insert((table.display_name, key.name));
            given(&key.value, value, found);
        }
    }
}

/// Every table of a form, with its keys.
fn known(form: &ValueSchema, found: &mut BTreeSet<(&'static str, &'static str)>) {
    match form {
        ValueSchema::Table(table) => known_in(table, found),
        ValueSchema::List(of, _)
        | ValueSchema::Set(of, _)
        | ValueSchema::OneOrMore(of, _)
        | ValueSchema::WithExamples(of, _) => known(of, found),
        ValueSchema::IdentifierMap(of) | ValueSchema::Map(of) => known(of, found),
        ValueSchema::Variants(kinds) => kinds.iter().for_each(|(_, table)| known_in(table, found)),
        ValueSchema::AnyOf(forms) => forms.iter().for_each(|form| known(form, found)),
        _ => {}
    }
}

fn known_in(table: &TableSchema, found: &mut BTreeSet<(&'static str, &'static str)>) {
    for key in table.keys {
        assert!(
            key.description.ends_with(['.']) && key.description.len() > 8,
            "{} of {} is described",
            key.name,
            table.display_name
        );
        let is_json = |default: fn() -> String| serde_json::from_str::<Value>(&default()).is_ok();
        assert!(
            key.default.is_none_or(is_json),
            "the default of {} of {} is JSON",
            key.name,
            table.display_name
        );
        found.insert((table.display_name, key.name));
        known(&key.value, found);
    }
}

/// Without this, the tests that go by that manifest would say nothing of a new key.
#[test]
fn the_manifest_with_every_key_has_every_key() {
    let (mut here, mut all) = (BTreeSet::new(), BTreeSet::new());
    given_in(&MANIFEST, &json(EVERY_KEY), &mut here);
    known_in(&MANIFEST, &mut all);
    let missing: Vec<_> = all.difference(&here).collect();
    assert!(missing.is_empty() && all.len() > 120, "{missing:?} of {}", all.len());
}

/// A default that is written out changes nothing.
#[test]
fn defaults_are_what_holds_without_them() {
    let least = "[atlas]\ntitle = \"T\"\n[page]\ntheme = {}\n[[family]]\nid = \"f\"\nlinkage = \"own\"\nplace = {}\n\
                 sampling = { samples = 9 }\ncases = [{ g = 4 }]\n[[linkage]]\nid = \"own\"\ntrace = [\"M\"]\n\
                 parameters = { g = {} }\n[linkage.joints]\nO = { fixed = [0, 0] }\nC = { fixed = [\"g\", 0] }\n\
                 A = { crank = \"O\", length = 1 }\nB = { dyad = [\"A\", \"C\"], lengths = [3, 3], side = \"left\" }\n\
                 M = { point = [\"A\", \"B\"] }\nG = { gear = \"A\", about = \"C\", length = 1, ratio = [1, 1] }\n\
                 N = { dyad = [\"G\", \"M\"], lengths = [9, 9], side = \"left\" }\n";
    let least = least.replace("trace = [\"M\"]", "trace = [\"M\", \"N\"]");
    let plan = |manifest: &Value| {
        let plan = manifest::parse(&toml(manifest)).plan.unwrap_or_else(|| panic!("{}", toml(manifest)));
        let PlannedFamily { family, layout, chart, formats, source, .. } = &plan.families[0];
        let Template { circuits, continuation, coincident, orientation: placement, .. } = &*family.template;
        let linkage = family.linkage(&family.cell(0)).unwrap();
        let asked = (
            &family.sampling,
            &family.columns,
            &family.is_computed,
            &family.straight,
            circuits,
            continuation,
            coincident,
        );
        let whole = (&plan.title, &plan.output, plan.volume_pages, &plan.page, plan.dpi, plan.text_mode);
        format!("{whole:?} {layout:?} {chart:?} {formats:?} {source} {asked:?} {placement:?} {linkage:?}")
    };
    let (whole, mut seen) = (json(&least), 0);
    let without = plan(&whole);
    let mut all = Vec::new();
    places(&whole, "", &mut all);
    for place in all {
        let value = whole.pointer(&place).unwrap();
        let tables = if value.is_object() { tables_at(&place, value) } else { Vec::new() };
        let [table] = tables[..] else { continue };
        for (key, property) in table["properties"].as_object().unwrap() {
            let Some(default) = property.get("default").filter(|_| value.get(key).is_none()) else { continue };
            let mut with = whole.clone();
            with.pointer_mut(&place).unwrap()[key] = default.clone();
            assert_eq!(plan(&with), without, "{place}/{key}");
            seen += 1;
        }
    }
    assert!(seen >= 25, "{seen} defaults were written out");
}

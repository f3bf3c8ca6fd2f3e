//! The JSON schema of manifests, compared with what the parser accepts.

mod corpus;
mod keys;
mod slips;

use std::fmt::Write;
use std::path::Path;
use std::sync::LazyLock;

use coupler_atlas::manifest::{self, CaseTable, DesignRequest, FileProblem, Files, ParseOutcome, WishPlace};
use coupler_atlas::manifest_files::{KnownTable, ManifestFiles};
use coupler_curves::template::Template;
use coupler_drawing::scene::{FontFamily, Typeface};
use jsonschema::Validator;
use serde_json::{Map, Number, Value};
use toml::de::{DeTable, DeValue};

use crate::support::command::run;

/// A manifest with every key.
const EVERY_KEY: &str = include_str!("every-key.toml");

/// What `list schema` prints.
static SCHEMA: LazyLock<Value> = LazyLock::new(|| {
    let (code, out, err) = run(Path::new("."), &["list", "schema"]);
    assert!(code == 0 && err.is_empty(), "{err}");
    serde_json::from_str(&out).unwrap()
});

static VALIDATOR: LazyLock<Validator> = LazyLock::new(|| jsonschema::draft202012::new(&SCHEMA).unwrap());

/// Whether a manifest satisfies the schema.
fn is_valid(manifest: &Value) -> bool {
    VALIDATOR.is_valid(manifest)
}

/// The violations of the schema by a manifest, a line each.
fn schema_errors(manifest: &Value) -> String {
    VALIDATOR.iter_errors(manifest).map(|error| format!("{}: {error}\n", error.instance_path())).collect()
}

/// Parses a manifest with the files that [`EVERY_KEY`] names, and what its search finds.
fn parse(text: &str) -> ParseOutcome {
    /// Found once, and not in each of some thousand changed manifests.
    static FOUND: LazyLock<Vec<KnownTable>> = LazyLock::new(|| {
        let plan = parse_with(EVERY_KEY, Vec::new()).plan.unwrap();
        KnownTable::of_plan(&plan).into_iter().filter(|table| table.path == "the designs of designs").collect()
    });
    parse_with(text, FOUND.clone())
}

fn parse_with(text: &str, known: Vec<KnownTable>) -> ParseOutcome {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/integration/schema/every-key.toml");
    manifest::parse_with_files(text, Some(&OwnFont(ManifestFiles::new(&path).with_tables(known))))
}

/// The files of a manifest, but for the font.
struct OwnFont(ManifestFiles);

impl Files for OwnFont {
    fn font(&self, _: &str) -> Result<Vec<u8>, String> {
        Ok(Typeface::from(FontFamily::Sans).regular().bytes().to_vec())
    }

    fn cases(&self, path: &str, limit: usize, report: &mut dyn FnMut(FileProblem)) -> Option<CaseTable> {
        self.0.cases(path, limit, report)
    }

    fn designs(
        &self,
        template: &Template,
        request: &DesignRequest,
        report: &mut dyn FnMut(WishPlace, FileProblem),
    ) -> Option<CaseTable> {
        self.0.designs(template, request, report)
    }
}

/// The messages and help texts of the parser's errors; `None` if it accepts the manifest.
fn parser_errors(text: &str) -> Option<Vec<(String, String)>> {
    let loaded = parse(text);
    let errors = loaded.problems.into_iter().filter(|problem| problem.is_error());
    loaded.plan.is_none().then(|| errors.map(|problem| (problem.message, problem.help)).collect())
}

/// A TOML text as JSON, as editors check it against a schema.
fn json(text: &str) -> Value {
    let table = DeTable::parse(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    table_as_json(table.get_ref())
}

fn table_as_json(table: &DeTable) -> Value {
    let entries = table.iter().map(|(key, value)| (key.get_ref().to_string(), as_json(value.get_ref())));
    Value::Object(entries.collect::<Map<_, _>>())
}

fn as_json(value: &DeValue) -> Value {
    match value {
        DeValue::String(text) => Value::String(text.to_string()),
        DeValue::Integer(number) => i64::from_str_radix(number.as_str(), number.radix()).unwrap().into(),
        DeValue::Float(number) => Number::from_f64(number.as_str().parse().unwrap()).unwrap().into(),
        DeValue::Boolean(value) => (*value).into(),
        DeValue::Datetime(date) => date.to_string().into(),
        DeValue::Array(items) => items.iter().map(|item| as_json(item.get_ref())).collect(),
        DeValue::Table(table) => table_as_json(table),
    }
}

/// A manifest as a TOML text, with inline tables instead of headers.
fn toml(manifest: &Value) -> String {
    let root = manifest.as_object().unwrap();
    root.iter().map(|(key, value)| format!("{} = {}\n", Value::String(key.clone()), inline(value))).collect()
}

fn inline(value: &Value) -> String {
    match value {
        Value::Array(items) => format!("[{}]", items.iter().map(inline).collect::<Vec<_>>().join(", ")),
        Value::Object(entries) => {
            let mut out = String::from("{ ");
            for (k, (key, value)) in entries.iter().enumerate() {
                let comma = if k > 0 { ", " } else { "" };
                write!(out, "{comma}{} = {}", Value::String(key.clone()), inline(value)).unwrap();
            }
            out + " }"
        }
        // These are written alike in JSON and TOML.
        _ => value.to_string(),
    }
}

/// Collects the JSON pointers of a value and of all values in it.
fn collect_pointers(value: &Value, pointer: &str, found: &mut Vec<String>) {
    found.push(pointer.to_owned());
    match value {
        Value::Array(items) => {
            items.iter().enumerate().for_each(|(k, item)| collect_pointers(item, &format!("{pointer}/{k}"), found));
        }
        Value::Object(entries) => {
            entries.iter().for_each(|(key, value)| collect_pointers(value, &format!("{pointer}/{key}"), found));
        }
        _ => {}
    }
}

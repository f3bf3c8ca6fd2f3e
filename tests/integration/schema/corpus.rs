//! Every manifest that the parser accepts satisfies the schema.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::{json, parse, schema_errors};

use crate::support::command::run;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Collects the files with an extension below a folder.
fn files(folder: &Path, extension: &str, found: &mut Vec<PathBuf>) {
    for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        match path.is_dir() {
            true => files(&path, extension, found),
            false if path.extension().is_some_and(|other| other == extension) => found.push(path),
            false => {}
        }
    }
}

/// The parts of a text between an opening and a closing delimiter.
fn between<'a>(text: &'a str, open: &str, close: &str) -> Vec<&'a str> {
    text.split(open).skip(1).filter_map(|rest| rest.split(close).next()).collect()
}

/// Whether the parser accepts a text as a manifest.
///
/// # Panics
///
/// If the parser accepts it and the schema does not.
fn is_manifest(text: &str, name: &str) -> bool {
    let is_accepted = parse(text).plan.is_some();
    if is_accepted {
        let errors = schema_errors(&json(text));
        assert!(errors.is_empty(), "{name}: {errors}");
    }
    is_accepted
}

#[test]
fn every_manifest_of_the_repository_satisfies_the_schema() {
    for name in ["atlas.toml", "examples", "src/cli/starter.toml", "tests/integration/schema/every-key.toml"] {
        let path = root().join(name);
        let mut found = vec![path.clone()];
        if path.is_dir() {
            found.clear();
            files(&path, "toml", &mut found);
        }
        for path in found {
            assert!(is_manifest(&fs::read_to_string(&path).unwrap(), name), "{} is not a manifest", path.display());
        }
    }
    for name in ["README.md", "docs/manifest.md", "docs/tutorial.md"] {
        let document = fs::read_to_string(root().join(name)).unwrap();
        let blocks = between(&document, "```toml\n", "```");
        assert!(!blocks.is_empty(), "{name} has no TOML block");
        for block in blocks {
            assert!(is_manifest(block, name), "{name} has a TOML block that is not a manifest:\n{block}");
        }
    }
    // The manifests of the tests, as far as they are written as one valid text.
    let mut tests = Vec::new();
    files(&root().join("tests/integration"), "rs", &mut tests);
    let checked = tests.iter().map(|path| {
        let text = fs::read_to_string(path).unwrap();
        between(&text, "r#\"", "\"#").into_iter().filter(|text| is_manifest(text, &path.to_string_lossy())).count()
    });
    assert!(checked.sum::<usize>() > 8, "too few manifests found in the tests");
}

#[test]
#[ignore = "thorough"]
fn the_catalogue_and_what_the_program_writes_satisfy_the_schema() {
    let mut catalogue = Vec::new();
    files(&root().join("crates/coupler-curves/src/catalogue"), "toml", &mut catalogue);
    assert!(catalogue.len() > 15);
    let family = json!({ "id": "f", "linkage": "evans", "sampling": { "samples": 9 }, "cases": [{ "p": 2 }] });
    for path in catalogue {
        let mut manifest = json(&fs::read_to_string(&path).unwrap());
        manifest["atlas"] = json!({ "title": "T" });
        manifest["family"] = Value::Array(vec![family.clone()]);
        let errors = schema_errors(&manifest);
        assert!(errors.is_empty(), "{}: {errors}", path.display());
    }
    for arguments in [
        &["design", "straight-line", "--input", "motor", "--p", "2.5", "--toml"][..],
        &["inspect", "four-bar", "frame=4", "crank=1", "coupler=3", "rocker=3.5", "--cognates", "--toml"],
    ] {
        let (_, text, err) = run(root(), arguments);
        assert!(is_manifest(&text, arguments[0]), "{arguments:?}: {text}{err}");
    }
}

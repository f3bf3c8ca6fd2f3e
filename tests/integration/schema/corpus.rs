//! Whatever the reader accepts satisfies the schema.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use coupler_atlas::manifest;
use serde_json::{Value, json};

use super::{json, objections};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn files(folder: &Path, extension: &str, found: &mut Vec<PathBuf>) {
    for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        match path.is_dir() {
            true => files(&path, extension, found),
            false if path.extension().is_some_and(|known| known == extension) => found.push(path),
            false => {}
        }
    }
}

/// The parts of a text between two marks.
fn between<'a>(text: &'a str, from: &str, to: &str) -> Vec<&'a str> {
    text.split(from).skip(1).filter_map(|rest| rest.split(to).next()).collect()
}

/// Checks the manifest, if the reader takes it for one.
fn satisfies(text: &str, name: &str) -> bool {
    let is_manifest = manifest::parse(text).plan.is_some();
    if is_manifest {
        let objections = objections(&json(text));
        assert!(objections.is_empty(), "{name}: {objections}");
    }
    is_manifest
}

#[test]
fn every_manifest_of_the_repository_satisfies_the_schema() {
    let whole = ["atlas.toml", "examples", "src/cli/starter.toml", "tests/integration/schema/every-key.toml"];
    for name in whole {
        let path = root().join(name);
        let mut found = vec![path.clone()];
        if path.is_dir() {
            found.clear();
            files(&path, "toml", &mut found);
        }
        for path in found {
            assert!(satisfies(&fs::read_to_string(&path).unwrap(), name), "{} is a manifest", path.display());
        }
    }
    let readme = fs::read_to_string(root().join("docs/manifest.md")).unwrap();
    assert!(between(&readme, "```toml\n", "```").into_iter().all(|text| satisfies(text, "docs/manifest.md")));
    // Those of the tests, so far as they stand there whole and good.
    let mut tests = Vec::new();
    files(&root().join("tests/integration"), "rs", &mut tests);
    let checked = tests.iter().map(|path| {
        let text = fs::read_to_string(path).unwrap();
        between(&text, "r#\"", "\"#").into_iter().filter(|text| satisfies(text, &path.to_string_lossy())).count()
    });
    assert!(checked.sum::<usize>() > 8, "the tests' manifests are found");
}

#[test]
fn the_catalogue_and_what_the_program_writes_satisfy_the_schema() {
    let mut catalogue = Vec::new();
    files(&root().join("crates/coupler-curves/src/catalogue"), "toml", &mut catalogue);
    assert!(catalogue.len() > 15);
    let family = json!({ "id": "f", "linkage": "evans", "sampling": { "samples": 9 }, "cases": [{ "p": 2 }] });
    for path in catalogue {
        let mut manifest = json(&fs::read_to_string(&path).unwrap());
        manifest["atlas"] = json!({ "title": "T" });
        manifest["family"] = Value::Array(vec![family.clone()]);
        let objections = objections(&manifest);
        assert!(objections.is_empty(), "{}: {objections}", path.display());
    }
    for arguments in [
        &["design", "straight-line", "--input", "motor", "--p", "2.5", "--toml"][..],
        &["inspect", "four-bar", "frame=4", "crank=1", "coupler=3", "rocker=3.5", "--cognates", "--toml"],
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_coupler-atlas")).args(arguments).output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(satisfies(&text, arguments[0]), "{arguments:?}: {text}{}", String::from_utf8_lossy(&output.stderr));
    }
}

//! Failures of the machine: a full disk, a folder that cannot be written, a killed program, files that vanish, a wrong
//! clock.
//!
//! After each of them, every file under its final name is complete, the record is true, no earlier file is lost, the
//! message names the file and the remedy, and the next run completes the atlas to the bytes of an undisturbed one.

mod clock;
#[cfg(target_os = "linux")]
mod disk;
mod kills;
mod places;
#[cfg(target_os = "linux")]
mod unreadable;

use std::collections::BTreeMap;
use std::path::Path;

use crate::support::folder::{Atlas, check_record, tree};

/// A manifest with panels, a chart and a book, sampled with this step.
fn manifest(step: &str) -> String {
    format!(
        r#"[atlas]
title = "T"
output = "out"
formats = ["svg", "png", "pdf"]
[page]
paper = {{ width = "110 mm", height = "100 mm" }}
dpi = 30
[[family]]
id = "evans"
linkage = "evans"
panels = [1, 1]
sampling = {{ step = "{step}" }}
grid = {{ p = {{ from = 2, to = 4, count = 5 }}, k = {{ from = 1, to = 2, count = 4 }} }}
let = {{ a = "(1 + p)^1.5 / 2" }}
[[family]]
id = "over"
linkage = "evans"
sampling = {{ step = "{step}" }}
grid = {{ p = [2, 3, 4] }}
let = {{ a = "(1 + p)^1.5 / 2" }}
layout = "chart"
chart = {{ x = "p", y = ["length"] }}
"#
    )
}

/// Two manifests whose atlases have the same files with different bytes.
fn old_and_new() -> [String; 2] {
    ["10 deg", "6 deg"].map(manifest)
}

type Tree = BTreeMap<String, Vec<u8>>;

/// The files of an undisturbed run.
fn undisturbed(manifest: &str) -> Tree {
    let atlas = Atlas::new(manifest);
    complete(&atlas);
    tree(&atlas.out())
}

fn complete(atlas: &Atlas) {
    let (code, _, err) = atlas.run(&[]);
    assert_eq!(code, 0, "{err}");
}

/// Whether a file is one that an interrupted run leaves besides the atlas: a lock or an unfinished file.
fn is_unfinished(name: &str) -> bool {
    name.rsplit('/').next().unwrap().starts_with(".coupler-atlas")
}

/// Asserts that every file is complete, old or new, that no file of both atlases is missing, and that the record is
/// true.
fn check_files(out: &Path, before: &Tree, after: &Tree) {
    check_record(out);
    let found = tree(out);
    let is_record = |name: &str| name == "run.json" || name == "images.json";
    for (name, bytes) in found.iter().filter(|(name, _)| !is_unfinished(name) && !is_record(name)) {
        let is_known = [before, after].iter().any(|tree| tree.get(name) == Some(bytes));
        assert!(is_known, "{name} has neither the old nor the new bytes");
    }
    let lost: Vec<&String> =
        before.keys().filter(|name| after.contains_key(*name) && !found.contains_key(*name)).collect();
    assert!(lost.is_empty(), "lost files: {lost:?}");
}

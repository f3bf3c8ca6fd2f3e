//! What happens when the machine fails: the disk is full, a folder cannot be written, the program is killed, files vanish,
//! the clock is wrong.
//!
//! Whatever it is, no file is half there under its name, the record says no more than what is so, nothing is lost of what
//! was there before, the message names the file and the remedy, and the next run completes the atlas to the bytes of an
//! undisturbed one.

mod clock;
#[cfg(target_os = "linux")]
mod disk;
mod kills;
mod places;

use std::collections::BTreeMap;
use std::path::Path;

use crate::folder::{Atlas, record_is_true, tree};

/// An atlas of pages, charts and a book, sampled so finely.
fn manifest(step: &str) -> String {
    format!(
        r#"[atlas]
title = "T"
output = "out"
formats = ["svg", "png", "pdf"]
[page]
paper = {{ width = "110 mm", height = "90 mm" }}
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

/// Two manifests of the same files with different bytes.
fn old_and_new() -> [String; 2] {
    ["10 deg", "6 deg"].map(manifest)
}

type Tree = BTreeMap<String, Vec<u8>>;

/// What a run makes that nothing disturbs.
fn undisturbed(manifest: &str) -> Tree {
    let atlas = Atlas::new(manifest);
    complete(&atlas);
    tree(&atlas.out())
}

fn complete(atlas: &Atlas) {
    let (code, _, err) = atlas.run(&[]);
    assert_eq!(code, 0, "{err}");
}

/// What an interrupted run may leave besides the atlas: a lock, and what is not finished.
fn is_unfinished(name: &str) -> bool {
    name.rsplit('/').next().unwrap().starts_with(".coupler-atlas")
}

/// Every file is whole, old or new; all that there was before and is to be after is there; nothing is recorded that is not so.
fn is_sound(out: &Path, before: &Tree, after: &Tree) {
    record_is_true(out);
    let found = tree(out);
    for (name, bytes) in found.iter().filter(|(name, _)| !is_unfinished(name) && *name != "run.json") {
        let is_known = [before, after].iter().any(|tree| tree.get(name) == Some(bytes));
        assert!(is_known, "{name} is neither as it was nor as it is to be");
    }
    let lost: Vec<&String> =
        before.keys().filter(|name| after.contains_key(*name) && !found.contains_key(*name)).collect();
    assert!(lost.is_empty(), "{lost:?} are lost");
}

//! `export --parts`: its files, the unit of the family in them, and what is refused.

use std::fs;

use tempfile::TempDir;

use crate::support::command::{folder_with, printed, run};
use crate::support::folder::files;

/// Lengths in centimetres; a joint whose name no file can have, and two whose names differ in case only.
const MANIFEST: &str = r#"[atlas]
title = "T"
[[linkage]]
id = "mine"
trace = ["M"]
[linkage.joints]
O = { fixed = [0, 0] }
o = { fixed = [4, 0] }
A = { crank = "O", length = 1 }
"a/ä" = { dyad = ["A", "o"], lengths = [3, 3.5], side = "left" }
M = { point = ["A", "a/ä"], along = 1.5, across = 1 }
[[family]]
id = "mine"
linkage = "mine"
unit = "cm"
cases = [{}]
"#;

#[test]
fn parts_are_files_of_their_own_in_the_unit_of_the_family() {
    let folder = folder_with(MANIFEST);
    let said = printed(folder.path(), &["export", "mine:1", "--parts", "--format", "dxf,svg", "-o", "parts"]);
    assert_eq!(said, "10 files written to parts\n");
    let names = ["A-a-ä-M", "OA", "assembly", "frame", "o-a-ä"];
    let expected: Vec<String> =
        names.iter().flat_map(|name| ["dxf", "svg"].map(|end| format!("mine-1-1-1-{name}.{end}"))).collect();
    let mut found = files(&folder.path().join("parts"));
    found.sort();
    assert_eq!(found, expected);
    let read = |name: &str| fs::read_to_string(folder.path().join("parts").join(name)).unwrap();
    let assembly = read("mine-1-1-1-assembly.dxf");
    assert!(assembly.is_ascii() && assembly.contains("$INSUNITS\n 70\n5\n"), "centimetres");
    // A layer has no slash.
    assert!(assembly.contains("\nA-a_\\U+00E4-M\n") && !assembly.contains("\nA-a/"), "{assembly}");
    let crank = read("mine-1-1-1-OA.svg");
    // A centimetre from pin to pin, with links of 0.3 cm and a margin of a hole of 0.15 cm around all.
    let width: f64 = crank.split("width=\"").nth(1).unwrap().split("mm\"").next().unwrap().parse().unwrap();
    assert!((width - 16.0).abs() < 1.0, "{width} mm");
}

#[test]
fn sizes_and_formats_that_make_no_parts_are_refused_before_anything_is_written() {
    let folder = TempDir::new().unwrap();
    let four_bar = [
        "--linkage",
        "four-bar",
        "frame=4",
        "crank=1",
        "coupler=3",
        "rocker=3.5",
        "along=1.5",
        "across=1",
        "-o",
        "out",
    ];
    for (options, message) in [
        (&["--hole", "6"][..], "--parts"),
        (&["--parts", "--hole", "0"], "expected a length greater than 0 in the unit of the linkage, as in --hole 6"),
        (&["--parts", "--width", "x"], "as in --width 20"),
        (
            &["--parts", "--hole", "0.4"],
            "a hole of 0.4 is not smaller than the width 0.3 of the links: give a smaller --hole",
        ),
        (
            &["--parts", "--hole", "1.5", "--width", "2"],
            "the holes O and A are 1 apart, and 1.5 wide: give a smaller --hole",
        ),
        (&["--parts", "--format", "csv"], "parts are drawn as dxf or svg, not as csv: give --format dxf"),
    ] {
        let arguments: Vec<&str> = ["export"].iter().chain(&four_bar).chain(options).copied().collect();
        let (code, _, said) = run(folder.path(), &arguments);
        assert!(code == 2 && said.contains(message), "{options:?}: {said}");
        assert!(!folder.path().join("out").exists(), "{options:?}");
    }
}

//! `check` reports what has changed, and nothing else.

use std::fs;
use std::path::Path;
use std::process::Output;

use tempfile::TempDir;

use crate::support::command::{folder_with, program};
use crate::support::folder::{edit_record, tree, update_digest};

/// Three families: turning cranks, rockers with both branches and several circuits, and a length as input.
const MANIFEST: &str = r#"[atlas]
title = "Atlas <of> \"curves\""
output = "output"
formats = ["svg"]

[[family]]
id = "evans"
linkage = "evans"
title = "Evans"
panels = [2, 2]
sampling = { step = "2 deg" }
columns = ["psi_deg", "vx"]
cases = [{ p = 2, s = 2.59, a = 2.59 }, { p = 3, s = 4, a = 4 }, { p = 3, s = 4.1, a = 4.1 }]

[[family]]
id = "bars"
linkage = "four-bar"
title = "Four-bars"
sampling = { samples = 90 }
circuits = "all"
cases = [{ frame = 4, crank = 3, coupler = 2, rocker = 3.4 }, { frame = 4, crank = 2, coupler = 4, rocker = 3.5 }]
let = { along = 1, across = 0.7 }

[[family]]
id = "actuator"
linkage = "linear-actuator"
title = "Actuator"
sampling = { samples = 40 }
cases = [{ g = 2, r = 1, e = 0.2 }]
let = { along = 1.75, across = 0.5 }
"#;

/// A folder with a manifest and the atlas recorded from it.
struct RecordedAtlas {
    folder: TempDir,
}

impl RecordedAtlas {
    fn new() -> RecordedAtlas {
        let atlas = RecordedAtlas { folder: folder_with(MANIFEST) };
        let output = atlas.run(&["render", "-q"]);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        atlas
    }

    fn path(&self, name: &str) -> std::path::PathBuf {
        self.folder.path().join(name)
    }

    fn write_manifest(&self, text: &str) {
        fs::write(self.path("atlas.toml"), text).unwrap();
    }

    fn run(&self, arguments: &[&str]) -> Output {
        program(self.folder.path()).args(arguments).output().unwrap()
    }

    /// The exit code of `check` with more arguments, and the findings of its JSON report.
    fn check(&self, more: &[&str]) -> (i32, Vec<serde_json::Value>) {
        let mut arguments = vec!["check", "--against", "output", "--report", "json"];
        arguments.extend(more);
        let output = self.run(&arguments);
        let text = String::from_utf8(output.stdout).unwrap();
        let report: serde_json::Value =
            serde_json::from_str(&text).unwrap_or_else(|_| panic!("{text}{}", String::from_utf8_lossy(&output.stderr)));
        let findings = report["findings"].as_array().unwrap().clone();
        assert_eq!(report["has_differences"].as_bool().unwrap(), output.status.code() == Some(1));
        (output.status.code().unwrap(), findings)
    }

    /// The kinds of the findings, in the order of the report, without consecutive repetitions.
    fn kinds(&self) -> Vec<String> {
        let mut kinds: Vec<String> = self.check(&[]).1.iter().map(|f| f["kind"].as_str().unwrap().to_owned()).collect();
        kinds.dedup();
        kinds
    }

    /// Changes the lines of a recorded file.
    fn edit(&self, name: &str, change: impl FnOnce(&mut Vec<String>)) {
        let path = self.path("output").join(name);
        let text = fs::read_to_string(&path).unwrap();
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        change(&mut lines);
        fs::write(path, lines.join("\n") + "\n").unwrap();
    }

    fn update_digest(&self, family: &str, table: &str) {
        update_digest(&self.path("output"), family, table);
    }
}

/// The row of a sample of a curve, which is given by its cell, trace and circuit.
fn row(lines: &[String], curve: [usize; 3], sample: usize) -> usize {
    let start = format!("{},{},{},", curve[0], curve[1], curve[2]);
    let header: Vec<&str> = lines[0].split(',').collect();
    let at = header.iter().position(|name| *name == "sample").unwrap();
    let is_sample = |line: &String| line.starts_with(&start) && line.split(',').nth(at) == Some(&sample.to_string());
    lines.iter().position(is_sample).unwrap()
}

/// Changes a field of a row, by the name of its column.
fn edit_field(lines: &mut [String], row: usize, name: &str, change: impl FnOnce(&str) -> String) {
    let at = lines[0].split(',').position(|column| column == name).unwrap();
    let mut fields: Vec<String> = lines[row].split(',').map(str::to_owned).collect();
    fields[at] = change(&fields[at]);
    lines[row] = fields.join(",");
}

/// Adds a distance to a number.
fn add(distance: f64) -> impl Fn(&str) -> String {
    move |text| (text.parse::<f64>().unwrap() + distance).to_string()
}

#[test]
fn an_unchanged_atlas_has_no_findings_in_any_run() {
    let atlas = RecordedAtlas::new();
    for jobs in ["1", "2", "7"].into_iter().cycle().take(12) {
        assert_eq!(atlas.check(&["--jobs", jobs]), (0, vec![]));
    }
}

#[test]
fn a_point_that_has_moved_by_1e_8_is_reported_with_its_distance() {
    let atlas = RecordedAtlas::new();
    atlas.edit("evans/points.csv", |lines| {
        let at = row(lines, [2, 1, 1], 57);
        edit_field(lines, at, "x", add(1e-8));
    });
    atlas.update_digest("evans", "points.csv");
    let (code, findings) = atlas.check(&[]);
    assert_eq!((code, findings.len()), (1, 1), "{findings:?}");
    let found = &findings[0];
    assert_eq!(found["kind"], "moved");
    assert_eq!((&found["family"], &found["cell"], &found["sample"]), (&"evans".into(), &2.into(), &57.into()));
    assert_eq!(
        (found["input"].as_f64(), found["moved"].as_u64(), found["of"].as_u64()),
        (Some(114.0), Some(1), Some(180))
    );
    let distance = found["distance"].as_f64().unwrap();
    // The coordinate is about 4, where doubles are 9e-16 apart.
    assert!((distance - 1e-8).abs() < 2e-15, "{distance}");
    // The distance of the curves as sets of points is that of the point from its curve, and no more.
    let apart = found["apart"].as_f64().unwrap();
    assert!(apart > 0.0 && apart <= distance * (1.0 + 1e-6), "{apart}");
    // A greater tolerance accepts the change: on the command line, in the manifest, or of the family.
    assert_eq!(atlas.check(&["--atol", "2e-8"]).0, 0);
    assert_eq!(atlas.check(&["--rtol", "1e-8"]).0, 0);
    atlas.write_manifest(
        &MANIFEST.replace("[[family]]\nid = \"evans\"", "[check]\natol = 2e-8\n[[family]]\nid = \"evans\""),
    );
    assert_eq!(atlas.check(&[]).0, 0);
    assert_eq!(atlas.check(&["--atol", "1e-9"]).0, 1, "the command line overrides the manifest");
    atlas.write_manifest(&MANIFEST.replace("linkage = \"evans\"", "linkage = \"evans\"\ncheck = { atol = 2e-8 }"));
    assert_eq!(atlas.check(&[]).0, 0);
}

#[test]
fn other_samples_of_the_same_curve_do_not_move_it() {
    let atlas = RecordedAtlas::new();
    // Another step: other points of the same curve.
    let shifted = MANIFEST.replacen("sampling = { step = \"2 deg\" }", "sampling = { step = \"3 deg\" }", 1);
    atlas.write_manifest(&shifted);
    let (_, findings) = atlas.check(&[]);
    let samples: Vec<_> = findings.iter().filter(|f| f["kind"] == "samples").collect();
    assert_eq!(samples.len(), 3);
    for found in samples {
        // The curves are a few units in size, so this is rounding.
        assert!(found["apart"].as_f64().unwrap() < 1e-13, "{found}");
        assert_eq!((found["was"].as_u64(), found["is"].as_u64()), (Some(180), Some(120)));
    }
    assert!(findings.iter().all(|f| f["kind"] != "moved"), "{findings:?}");
}

#[test]
fn a_changed_length_is_reported_with_its_effects() {
    let atlas = RecordedAtlas::new();
    atlas.write_manifest(&MANIFEST.replace("{ p = 3, s = 4, a = 4 }", "{ p = 3, s = 4, a = 4.0000001 }"));
    let (_, findings) = atlas.check(&[]);
    assert!(findings.iter().all(|f| f["family"] == "evans" && f["cell"] == 2), "{findings:?}");
    let kinds: Vec<&str> = findings.iter().map(|f| f["kind"].as_str().unwrap()).collect();
    assert_eq!(&kinds[..2], ["parameter", "moved"]);
    let moved = &findings[1];
    assert!(moved["apart"].as_f64().unwrap() > 1e-8, "another curve, not other points of the same: {moved}");
    assert!(kinds[2..].iter().all(|kind| ["measure", "column"].contains(kind)), "{kinds:?}");
    // A crank that no longer turns fully has another class, and lacks measures of one that does.
    atlas.write_manifest(&MANIFEST.replace("{ p = 3, s = 4, a = 4 }", "{ p = 3, s = 1.2, a = 1.2 }"));
    let (_, findings) = atlas.check(&[]);
    let kinds: Vec<&str> = findings.iter().map(|f| f["kind"].as_str().unwrap()).collect();
    assert_eq!((&kinds[..2], kinds.contains(&"class")), (&["parameter", "parameter"][..], true), "{kinds:?}");
    assert!(findings.iter().any(|f| f["name"] == "type") && !kinds.contains(&"damaged"), "{findings:?}");
}

#[test]
fn added_and_removed_cells_and_families_are_reported() {
    let atlas = RecordedAtlas::new();
    atlas.write_manifest(&MANIFEST.replace("{ p = 2, s = 2.59, a = 2.59 }, ", ""));
    assert_eq!(atlas.kinds(), ["cell-removed", "cell-renumbered"]);
    atlas.write_manifest(
        &MANIFEST.replace("{ p = 3, s = 4, a = 4 }", "{ p = 2.2, s = 3, a = 3 }, { p = 3, s = 4, a = 4 }"),
    );
    let (_, findings) = atlas.check(&[]);
    let reported: Vec<(&str, u64)> =
        findings.iter().map(|f| (f["kind"].as_str().unwrap(), f["cell"].as_u64().unwrap())).collect();
    assert_eq!(reported, [("cell-added", 2), ("cell-renumbered", 3), ("cell-renumbered", 4)]);
    atlas.write_manifest(&MANIFEST.replace("id = \"bars\"", "id = \"bars-two\""));
    assert_eq!(atlas.kinds(), ["family-removed", "family-added"]);
    atlas.write_manifest(&MANIFEST.replace("linkage = \"evans\"", "linkage = \"hoeken\"").replace(
        "cases = [{ p = 2, s = 2.59, a = 2.59 }, { p = 3, s = 4, a = 4 }, { p = 3, s = 4.1, a = 4.1 }]",
        "cases = [{}]",
    ));
    assert!(atlas.kinds().contains(&"family-changed".to_owned()));
}

#[test]
fn reversed_renumbered_and_missing_circuits_are_reported() {
    let atlas = RecordedAtlas::new();
    let original = fs::read_to_string(atlas.path("output/bars/points.csv")).unwrap();
    let circuits = |text: &str| {
        let mut found: Vec<String> =
            text.lines().filter(|l| l.starts_with("1,")).map(|l| l.split(',').nth(2).unwrap().to_owned()).collect();
        found.dedup();
        found
    };
    assert_eq!(circuits(&original), ["1", "2"], "the first four-bar has two circuits");
    let restored = || {
        fs::write(atlas.path("output/bars/points.csv"), &original).unwrap();
        atlas.update_digest("bars", "points.csv");
    };
    // The values of a circuit's rows in reverse order.
    atlas.edit("bars/points.csv", |lines| {
        let rows: Vec<usize> = (0..lines.len()).filter(|&k| lines[k].starts_with("1,1,1,")).collect();
        let values: Vec<Vec<String>> = rows.iter().map(|&k| lines[k].split(',').map(str::to_owned).collect()).collect();
        for (k, &line) in rows.iter().enumerate() {
            let mut fields = values[rows.len() - 1 - k].clone();
            fields[4].clone_from(&values[k][4]);
            lines[line] = fields.join(",");
        }
    });
    atlas.update_digest("bars", "points.csv");
    let (_, findings) = atlas.check(&[]);
    let reported: Vec<(&str, u64)> =
        findings.iter().map(|f| (f["kind"].as_str().unwrap(), f["circuit"].as_u64().unwrap_or(0))).collect();
    assert_eq!(reported, [("circuit-reversed", 1)], "{findings:?}");
    // Two circuits with their numbers exchanged.
    restored();
    atlas.edit("bars/points.csv", |lines| {
        for line in lines.iter_mut() {
            if let Some(rest) = line.strip_prefix("1,1,1,") {
                *line = format!("1,1,2,{rest}");
            } else if let Some(rest) = line.strip_prefix("1,1,2,") {
                *line = format!("1,1,1,{rest}");
            }
        }
    });
    atlas.update_digest("bars", "points.csv");
    assert_eq!(atlas.kinds(), ["circuit-renumbered"]);
    // A record without one of the circuits.
    restored();
    atlas.edit("bars/points.csv", |lines| lines.retain(|line| !line.starts_with("1,1,2,")));
    atlas.update_digest("bars", "points.csv");
    assert_eq!(atlas.kinds(), ["circuit-added"]);
    // A record of both as one circuit, which has since been split.
    restored();
    atlas.edit("bars/points.csv", |lines| {
        let count = lines.iter().filter(|line| line.starts_with("1,1,1,")).count();
        for (k, line) in lines.iter_mut().filter(|line| line.starts_with("1,1,2,")).enumerate() {
            let mut fields: Vec<String> = line.split(',').map(str::to_owned).collect();
            fields[2] = "1".to_owned();
            fields[4] = (count + k).to_string();
            *line = fields.join(",");
        }
    });
    atlas.update_digest("bars", "points.csv");
    assert_eq!(atlas.kinds(), ["circuit-split"]);
    // A sample on the other branch.
    restored();
    atlas.edit("bars/points.csv", |lines| {
        let at = row(lines, [2, 1, 1], 10);
        edit_field(lines, at, "branch", |branch| if branch == "1" { "-1".to_owned() } else { "1".to_owned() });
    });
    atlas.update_digest("bars", "points.csv");
    let (_, findings) = atlas.check(&[]);
    assert_eq!((findings[0]["kind"].as_str(), findings[0]["sample"].as_u64()), (Some("branch"), Some(10)));
}

#[test]
fn different_samples_measures_and_columns_are_reported() {
    let atlas = RecordedAtlas::new();
    atlas.edit("evans/points.csv", |lines| {
        let at = row(lines, [1, 1, 1], 57);
        lines.remove(at);
        let at = row(lines, [2, 1, 1], 30);
        edit_field(lines, at, "vx", add(1e-3));
    });
    atlas.update_digest("evans", "points.csv");
    atlas.edit("evans/cells.csv", |lines| {
        edit_field(lines, 3, "length", add(1e-6));
        edit_field(lines, 1, "class", |_| "drag-link".to_owned());
    });
    atlas.update_digest("evans", "cells.csv");
    let (_, findings) = atlas.check(&[]);
    let reported: Vec<(&str, u64)> =
        findings.iter().map(|f| (f["kind"].as_str().unwrap(), f["cell"].as_u64().unwrap())).collect();
    assert_eq!(reported, [("class", 1), ("samples", 1), ("measure", 3), ("column", 2)]);
    assert_eq!(findings[1]["missing"], serde_json::json!([57]));
    assert_eq!(findings[2]["name"], "length");
    assert_eq!((findings[3]["name"].as_str(), findings[3]["sample"].as_u64()), (Some("vx"), Some(30)));
    assert_eq!(atlas.check(&["--measure-rtol", "1e-2"]).1.len(), 2, "the tolerance of measures is separate");
}

/// A crank that differs by 1e-13 changes nothing, also not what is rounding, and where one of several portions that are equally long is the first.
#[test]
fn a_change_within_the_tolerance_is_no_finding() {
    let atlas = RecordedAtlas::new();
    atlas.write_manifest(
        &MANIFEST.replace("p = 2, s", "p = 2.0000000000002, s").replace("crank = 3,", "crank = 3.0000000000003,"),
    );
    let (_, findings) = atlas.check(&["--ignore", "too_close"]);
    let unexpected =
        |finding: &&serde_json::Value| !["drawing", "family-changed"].contains(&finding["kind"].as_str().unwrap());
    assert_eq!(findings.iter().find(unexpected), None);
    // A parameter within a wider tolerance is none, either.
    atlas.write_manifest(&MANIFEST.replace("p = 2, s", "p = 2.000001, s"));
    let kinds = |more: &[&str]| -> Vec<String> {
        let mut kinds: Vec<String> =
            atlas.check(more).1.iter().map(|f| f["kind"].as_str().unwrap().to_owned()).collect();
        kinds.dedup();
        kinds
    };
    assert_eq!(kinds(&[])[0], "parameter");
    let wide = kinds(&["--rtol", "1e-3", "--measure-rtol", "1e-2"]);
    assert!(wide.iter().all(|kind| kind == "drawing"), "{wide:?}");
}

/// Measures and columns have tolerances of their own, on the command line and in manifests.
#[test]
fn single_measures_have_tolerances() {
    let atlas = RecordedAtlas::new();
    atlas.edit("evans/cells.csv", |lines| {
        edit_field(lines, 1, "length", add(1e-6));
        edit_field(lines, 2, "area", add(1e-6));
    });
    atlas.update_digest("evans", "cells.csv");
    atlas.edit("evans/points.csv", |lines| {
        let at = row(lines, [2, 1, 1], 30);
        edit_field(lines, at, "vx", add(1e-6));
    });
    atlas.update_digest("evans", "points.csv");
    let names = |more: &[&str]| -> Vec<String> {
        atlas.check(more).1.iter().map(|finding| finding["name"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(names(&[]).len(), 3);
    assert_eq!(names(&["--tolerance", "length=1e-5", "--ignore", "vx"]), ["area"]);
    assert_eq!(names(&["--tolerance", "length=1e-9", "--tolerance", "vx=1e-5"]).len(), 2);
    atlas.write_manifest(&MANIFEST.replace(
        "title = \"Evans\"\n",
        "title = \"Evans\"\ncheck = { ignore = [\"length\"], measures = { vx = 1e-5 } }\n",
    ));
    assert_eq!(names(&[]), ["area"]);
    assert_eq!(names(&["--tolerance", "length=1e-9"]).len(), 2, "the command line comes first");
}

/// Reports for reviewers and for code scanning; the folders of their files are made.
#[test]
fn reports_are_written_as_markdown_and_sarif() {
    let atlas = RecordedAtlas::new();
    atlas.edit("evans/points.csv", |lines| {
        let at = row(lines, [1, 1, 1], 57);
        edit_field(lines, at, "x", add(1e-3));
    });
    atlas.update_digest("evans", "points.csv");
    let reports = ["--report", "markdown=reports/a/check.md", "--report", "sarif=reports/check.sarif", "--summary"];
    let output = atlas.run(&[&["check", "--against", "output"], &reports[..]].concat());
    assert_eq!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert!(
        lines.len() == 2 && lines[0].starts_with("evans  1 curve moved, at most cell 1, trace 1, circuit 1: 1.000e-3"),
        "{text}"
    );
    let markdown = fs::read_to_string(atlas.path("reports/a/check.md")).unwrap();
    assert!(markdown.contains("| evans | 1 | cell 1, trace 1, circuit 1: 1.000e-3"), "{markdown}");
    assert!(markdown.contains("| moved | evans, cell 1, trace 1, circuit 1 | moved by 1.000e-3"), "{markdown}");
    let sarif: serde_json::Value =
        serde_json::from_slice(&fs::read(atlas.path("reports/check.sarif")).unwrap()).unwrap();
    let result = &sarif["runs"][0]["results"][0];
    assert_eq!(
        (&sarif["version"], &result["ruleId"], &result["level"]),
        (&"2.1.0".into(), &"moved".into(), &"error".into())
    );
    let place = &result["locations"][0]["physicalLocation"];
    assert_eq!(place["artifactLocation"]["uri"], "atlas.toml");
    let line = place["region"]["startLine"].as_u64().unwrap() as usize;
    assert_eq!(MANIFEST.lines().nth(line - 1), Some("[[family]]"));
    assert_eq!(sarif["runs"][0]["tool"]["driver"]["rules"][0]["id"], "moved");
}

#[test]
fn a_linkage_that_can_no_longer_or_can_now_be_assembled_is_reported() {
    let atlas = RecordedAtlas::new();
    let unassembled = MANIFEST.replace("{ p = 3, s = 4, a = 4 }", "{ p = 9, s = 4, a = 4 }");
    atlas.write_manifest(&unassembled);
    assert_eq!(atlas.kinds(), ["parameter", "status", "circuit-lost"]);
    // The reverse.
    atlas.run(&["render", "-q"]);
    assert_eq!(atlas.check(&[]), (0, vec![]));
    atlas.write_manifest(MANIFEST);
    assert_eq!(atlas.kinds(), ["parameter", "status", "circuit-added"]);
}

#[test]
fn an_atlas_of_images_or_a_book_is_checked_too() {
    let atlas = RecordedAtlas::new();
    for formats in ["[\"png\"]", "[\"pdf\"]", "[\"svg\", \"png\", \"pdf\"]"] {
        atlas.write_manifest(&MANIFEST.replace("[\"svg\"]", formats));
        atlas.run(&["render", "-q"]);
        assert_eq!(atlas.check(&[]), (0, vec![]), "{formats}");
    }
    fs::remove_file(atlas.path("output/atlas.pdf")).unwrap();
    fs::remove_file(atlas.path("output/evans/evans-001.png")).unwrap();
    assert_eq!(atlas.check(&[]).1.len(), 2);
}

/// A repository keeps tables and pages, and no images, book or gallery.
#[test]
#[ignore = "thorough"]
fn what_a_folder_leaves_out_is_said_and_no_difference() {
    let atlas = RecordedAtlas::new();
    atlas.write_manifest(&MANIFEST.replace("[\"svg\"]", "[\"svg\", \"png\", \"pdf\"]"));
    atlas.run(&["render", "-q"]);
    let output = atlas.path("output");
    let whole = tree(&output);
    let restore =
        |names: &[&String]| names.iter().for_each(|name| fs::write(output.join(name), &whole[*name]).unwrap());
    let is_gallery = |name: &&String| *name == "index.html" || name.ends_with(".js");
    let is_image = |name: &&String| name.ends_with(".png") || name.ends_with(".pdf") || *name == "images.json";
    let gallery: Vec<&String> = whole.keys().filter(is_gallery).collect();
    let images: Vec<&String> = whole.keys().filter(is_image).collect();
    let left_out = || {
        let report = String::from_utf8(atlas.run(&["check", "--against", "output"]).stdout).unwrap();
        report.lines().find_map(|line| line.strip_prefix("not compared, ")).unwrap_or_default().to_owned()
    };
    assert_eq!((atlas.check(&[]), left_out()), ((0, vec![]), String::new()));
    for name in gallery.iter().chain(&images) {
        fs::remove_file(output.join(name)).unwrap();
    }
    assert_eq!(atlas.check(&[]), (0, vec![]));
    let words = format!("for the folder has none of them: 3 images, 1 volume, {} files of the gallery", gallery.len());
    assert_eq!(left_out(), words);
    // Of a family, neither the book nor the page.
    let report = atlas.run(&["check", "--against", "output", "--only", "evans"]).stdout;
    assert!(String::from_utf8(report).unwrap().contains("has none of them: 1 image, 1 file of the gallery\n"));
    // In every report.
    for format in ["json", "junit", "github"] {
        let report =
            String::from_utf8(atlas.run(&["check", "--against", "output", "--report", format]).stdout).unwrap();
        assert!(report.contains(if format == "json" { "\"volumes\": 1" } else { &words }), "{format}: {report}");
    }
    // A page is compared, also if its record no longer lists it.
    let (_, record) = whole.get_key_value("run.json").unwrap();
    for (name, key) in [("index.html", "gallery"), ("kernel.js", "kernel")] {
        fs::write(output.join(name), "edited").unwrap();
        edit_record(&output, |run| drop(run.as_object_mut().unwrap().remove(key).unwrap()));
        assert_eq!((atlas.check(&[]).0, left_out().contains("gallery")), (1, false), "{name}");
        fs::remove_file(output.join(name)).unwrap();
        fs::write(output.join("run.json"), record).unwrap();
    }
    // What is kept must be right, and a run makes the rest again.
    atlas.edit("evans/points.csv", |lines| lines[3].push('1'));
    assert!(!atlas.check(&[]).1.is_empty());
    assert_eq!(atlas.run(&["render", "-q"]).status.code(), Some(0));
    assert!(tree(&output) == whole);
    // A part of a kind is damage: of images also their record, which says that they were there.
    for (kind, is_listed) in [(&gallery, false), (&images, true)] {
        for name in kind {
            fs::remove_file(output.join(name)).unwrap();
            let (code, findings) = atlas.check(&[]);
            assert!(code == 1 && findings.iter().any(|f| f["file"] == ***name), "{name}: {findings:?}");
            assert_eq!(left_out(), "", "{name}");
            restore(&[name]);
        }
        for name in kind.iter().filter(|name| **name != "images.json") {
            fs::remove_file(output.join(name)).unwrap();
        }
        assert_eq!(atlas.check(&[]).1.is_empty(), !is_listed);
        restore(kind);
    }
}

#[test]
fn pages_drawn_differently_are_distinguished_from_edited_pages() {
    let atlas = RecordedAtlas::new();
    atlas.write_manifest(
        &MANIFEST.replace("[[family]]\nid = \"evans\"", "[page]\ndash = \"6 deg\"\n[[family]]\nid = \"evans\""),
    );
    let (code, findings) = atlas.check(&[]);
    assert!(code == 1 && findings.iter().all(|f| f["kind"] == "drawing"), "{findings:?}");
    assert_eq!(findings.len(), 2, "the dashes of an actuator are not in degrees: {findings:?}");
    atlas.write_manifest(MANIFEST);
    atlas.edit("bars/bars-001.svg", |lines| {
        let at = lines.iter().position(|line| line.contains("<path")).unwrap();
        lines[at] = lines[at].replacen("m", "m1 1", 1);
    });
    let (_, findings) = atlas.check(&[]);
    assert!(findings.iter().any(|f| f["kind"] == "altered" && f["file"] == "bars/bars-001.svg"), "{findings:?}");
    assert!(findings.iter().all(|f| f["kind"] != "drawn-off"), "the edited path is the border: {findings:?}");
    // A curve that is moved on its page, with the digest updated: by a tenth of a millimetre, and by a hundredth of
    // that.
    atlas.run(&["render", "-q", "--force"]);
    let page = fs::read_to_string(atlas.path("output/evans/evans-001.svg")).unwrap();
    let at = page.find("class=\"curve\"").unwrap();
    let path = at + page[at..].find(" d=\"m").unwrap() + 5;
    let end = path + page[path..].find(' ').unwrap();
    let x: f64 = page[path..end].parse().unwrap();
    for (distance, kinds) in [(0.1, vec!["drawn-off", "drawing"]), (0.001, vec!["drawing"])] {
        let moved = format!("{}{:.3}{}", &page[..path], x + distance, &page[end..]);
        fs::write(atlas.path("output/evans/evans-001.svg"), moved).unwrap();
        atlas.update_digest("evans", "evans-001.svg");
        assert_eq!(atlas.kinds(), kinds, "{distance}");
    }
    atlas.run(&["render", "-q", "--force"]);
    // An image with a flipped bit in the middle.
    atlas.run(&["render", "-q", "--format", "png"]);
    assert_eq!(atlas.kinds(), [""; 0]);
    let image = atlas.path("output/bars/bars-001.png");
    let mut bytes = fs::read(&image).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&image, bytes).unwrap();
    assert_eq!(atlas.kinds(), ["damaged"]);
    atlas.run(&["render", "-q", "--force"]);
    fs::remove_file(atlas.path("output/bars/bars-001.svg")).unwrap();
    assert_eq!(atlas.kinds(), ["damaged"]);
}

#[test]
fn damaged_records_are_reported() {
    let atlas = RecordedAtlas::new();
    let folder = atlas.path("output/evans");
    let points = fs::read(folder.join("points.csv")).unwrap();
    let cells = fs::read(folder.join("cells.csv")).unwrap();
    let with = |name: &str, bytes: &[u8]| fs::write(folder.join(name), bytes).unwrap();
    let text = String::from_utf8(points.clone()).unwrap();
    let line = |k: usize| text.match_indices('\n').nth(k).unwrap().0 + 1;
    type Case<'a> = (&'a str, Vec<u8>, &'a str);
    let cases: Vec<Case> = vec![
        ("truncated", points[..points.len() / 2].to_vec(), "damaged"),
        ("empty", Vec::new(), "damaged"),
        ("only a header", points[..line(0)].to_vec(), "damaged"),
        ("a row twice", [&points[..line(5)], &points[line(4)..]].concat(), "damaged"),
        (
            "rows in another order",
            [&points[..line(0)], &points[line(3)..line(4)], &points[line(0)..line(3)], &points[line(4)..]].concat(),
            "damaged",
        ),
        ("not a number", text.replacen(",0,0,", ",0,zero,", 1).into_bytes(), "damaged"),
        ("NaN", text.replacen(",0,0,", ",0,NaN,", 1).into_bytes(), "damaged"),
        ("no text", [&points[..line(2)], b"1,1,1,1,\xff\xfe,0,0,0,0,0\n", &points[line(3)..]].concat(), "damaged"),
        ("another column", text.replacen(",x,", ",abscissa,", 1).into_bytes(), "damaged"),
        ("a column more", text.lines().map(|l| format!("{l},1\n")).collect::<String>().into_bytes(), "family-changed"),
        ("a line without end", [&points[..line(2)], &vec![b'1'; 200_000][..]].concat(), "damaged"),
        ("quotes without end", [&points[..line(2)], b"1,\"1,1,1", &points[line(2)..]].concat(), "damaged"),
        ("strange cells", [&points[..], b"4000000000,1,1,1,0,0,0,0,0,0\nx,1\n-3,1\n"].concat(), "damaged"),
        ("huge numbers", [&points[..], b"1,99999999999,1,1,99999999999,0,1e308,-1e308,0,0\n"].concat(), "damaged"),
        ("nothing but zeros", vec![0; 100_000], "damaged"),
    ];
    for (name, bytes, kind) in cases {
        with("points.csv", &bytes);
        let (code, findings) = atlas.check(&[]);
        assert_eq!(code, 1, "{name}");
        assert!(findings.iter().any(|f| f["kind"] == kind), "{name}: {findings:?}");
    }
    // An atlas with other line ends, or with a byte order mark, is the same atlas.
    with("points.csv", text.replace('\n', "\r\n").as_bytes());
    with("cells.csv", &[b"\xef\xbb\xbf", &cells[..]].concat());
    let (code, findings) = atlas.check(&[]);
    assert!(code == 0 && findings.iter().all(|f| f["kind"] == "rewritten"), "{findings:?}");
    assert_eq!(findings.len(), 2);
    // A sparse file of a terabyte.
    fs::OpenOptions::new().write(true).open(folder.join("points.csv")).unwrap().set_len(1 << 40).unwrap();
    let (_, findings) = atlas.check(&[]);
    assert!(findings[0]["wrong"].as_str().unwrap().starts_with("has 1099511627776 bytes"), "{findings:?}");
    // A folder, or a link to a device, in place of a file.
    fs::remove_file(folder.join("points.csv")).unwrap();
    fs::create_dir(folder.join("points.csv")).unwrap();
    assert!(atlas.kinds().contains(&"damaged".to_owned()));
    #[cfg(unix)]
    {
        fs::remove_dir(folder.join("points.csv")).unwrap();
        std::os::unix::fs::symlink("/dev/zero", folder.join("points.csv")).unwrap();
        assert!(atlas.kinds().contains(&"damaged".to_owned()));
    }
    // Without a valid record there is nothing to compare with.
    for bytes in [&b"{"[..], b"{\"format\": 99}", b"[]", b"\xff"] {
        fs::write(atlas.path("output/run.json"), bytes).unwrap();
        let output = atlas.run(&["check", "--against", "output"]);
        assert_eq!(output.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&output.stderr).contains("run.json"));
    }
    fs::remove_file(atlas.path("output/run.json")).unwrap();
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("/dev/zero", atlas.path("output/run.json")).unwrap();
        assert_eq!(atlas.run(&["check", "--against", "output"]).status.code(), Some(2));
        fs::remove_file(atlas.path("output/run.json")).unwrap();
    }
    assert_eq!(atlas.run(&["check", "--against", "output"]).status.code(), Some(2));
    assert_eq!(atlas.run(&["check", "--against", "nowhere"]).status.code(), Some(2));
}

#[test]
fn reports_and_difference_pages_are_well_formed() {
    let atlas = RecordedAtlas::new();
    atlas.write_manifest(&MANIFEST.replace("a = 4 }", "a = 4.001 }").replace("samples = 40", "samples = 41"));
    let output = atlas.run(&[
        "check",
        "--against",
        "output",
        "--report",
        "junit=report.xml",
        "--report",
        "json=report.json",
        "--report",
        "github",
        "--diff",
        "moved",
    ]);
    assert_eq!(output.status.code(), Some(1));
    let annotations = String::from_utf8(output.stdout).unwrap();
    // The line of the family in the manifest.
    let line = MANIFEST[..MANIFEST.find("id = \"evans\"").unwrap()].matches('\n').count();
    let first = annotations.lines().next().unwrap();
    assert!(
        first.starts_with(&format!("::error file=atlas.toml,line={line},title=parameter%3A evans%2C cell 2::")),
        "{first}"
    );
    let xml = fs::read_to_string(atlas.path("report.xml")).unwrap();
    let mut reader = quick_xml::Reader::from_str(&xml);
    let mut failures = 0;
    loop {
        match reader.read_event().unwrap() {
            quick_xml::events::Event::Start(start) if start.name().as_ref() == "failure" => failures += 1,
            quick_xml::events::Event::Eof => break,
            _ => {}
        }
    }
    assert!(failures >= 2, "{xml}");
    let report: serde_json::Value = serde_json::from_slice(&fs::read(atlas.path("report.json")).unwrap()).unwrap();
    assert_eq!((report["format"].as_u64(), report["has_differences"].as_bool()), (Some(1), Some(true)));
    let total: u64 = report["counts"].as_object().unwrap().values().map(|n| n.as_u64().unwrap()).sum();
    assert_eq!(total as usize, report["findings"].as_array().unwrap().len());
    let index = fs::read_to_string(atlas.path("moved/index.html")).unwrap();
    assert!(index.contains("Atlas &lt;of&gt; &quot;curves&quot;") && !index.contains("<of>"));
    for name in ["evans-2-1-1.svg", "actuator-1-1-1.svg"] {
        assert!(index.contains(name) && atlas.path("moved").join(name).is_file(), "{name}");
    }
}

#[test]
fn bless_records_the_current_output() {
    let atlas = RecordedAtlas::new();
    atlas.write_manifest(&MANIFEST.replace("a = 4 }", "a = 4.001 }"));
    assert_eq!(atlas.check(&[]).0, 1);
    let output = atlas.run(&["check", "--against", "output", "--bless"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(String::from_utf8_lossy(&output.stdout).contains("parameter"), "the replaced differences are printed");
    assert_eq!(atlas.check(&[]), (0, vec![]));
    let before = fs::read(atlas.path("output/run.json")).unwrap();
    let output = atlas.run(&["check", "--against", "output", "--bless"]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("nothing has changed"));
    assert_eq!(fs::read(atlas.path("output/run.json")).unwrap(), before);
}

#[test]
fn wrong_arguments_are_reported() {
    let atlas = RecordedAtlas::new();
    for (arguments, word) in [
        (&["--only", "evens"][..], "did you mean `evans`"),
        (&["--atol", "-1"], "must not be negative"),
        (&["--rtol", "much"], "expected a number"),
        (&["--report", "xml"], "unknown report `xml`"),
        (&["--report", "json="], "expected a file after"),
        (&["--bless", "--only", "evans"], "--bless records all families"),
        (&["--ignore", "lenght"], "did you mean `length`"),
        (&["--tolerance", "length"], "expected a name and a ratio"),
        (&["--tolerance", "length=-1"], "must not be negative"),
        (&["--report", "json=output"], "is a folder"),
    ] {
        let mut all = vec!["check", "--against", "output"];
        all.extend(arguments);
        let output = atlas.run(&all);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && errors.contains(word), "{arguments:?}: {errors}");
    }
    atlas.write_manifest(&MANIFEST.replace(
        "linkage = \"evans\"",
        "linkage = \"evans\"\ncheck = { atol = -1, atoll = 2, ignore = [\"lenght\"], measures = { are = 1, vx = -1 } }",
    ));
    let output = atlas.run(&["check", "--against", "output"]);
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    for words in ["`atol` must not be negative", "atoll", "`lenght`", "`are`", "`vx` must not be negative"] {
        assert!(errors.contains(words), "{words}: {errors}");
    }
    assert!(Path::new(&atlas.path("output/run.json")).is_file());
}

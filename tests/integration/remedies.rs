//! What a new user may type is answered with what to write in its place.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use crate::support::command::{folder_with, printed, run};

/// A manifest of a four-bar.
const FOUR_BAR: &str = r#"[atlas]
title = "T"
[[family]]
id = "mine"
linkage = "four-bar"
sampling = { samples = 12 }
grid = { frame = 4, crank = 1, coupler = 3, rocker = 3, along = 1, across = 1 }
"#;

/// A path that a linkage traces only with a worst transmission angle of about 0.
const STRAIGHT: &str = "0,0\n1,0.1\n2,0\n3,-0.1\n4,0.3\n";

/// The message of a command that is refused.
fn refused(folder: &Path, arguments: &[&str]) -> String {
    let (code, _, err) = run(folder, arguments);
    assert_eq!(code, 2, "{arguments:?}: {err}");
    err
}

/// Asserts that each command is refused with a message that has this part.
fn all_refused(folder: &Path, cases: &[(&[&str], &str)]) {
    for (arguments, part) in cases {
        let err = refused(folder, arguments);
        assert!(err.contains(part), "{arguments:?}: {part}:\n{err}");
    }
}

#[test]
fn a_drawing_is_not_written_under_the_name_of_another_format() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("path.csv"), "0,0\n1,1\n2,1\n3,0\n1,-1\n").unwrap();
    let inspect = ["inspect", "four-bar", "frame=4", "crank=1", "coupler=3", "rocker=3", "--svg"];
    all_refused(
        folder.path(),
        &[
            (&["find", "path.csv", "--svg", "x.png"], "the drawing is SVG, not PNG: name a file that ends in .svg"),
            (&[&inspect[..], &["m.PNG"]].concat(), "`coupler-atlas export … --format png`"),
            (&[&inspect[..], &["m.pdf"]].concat(), "`coupler-atlas render MANIFEST --format pdf`"),
            (&[&inspect[..], &["m.dxf"]].concat(), "`coupler-atlas export … --format dxf`"),
        ],
    );
    printed(folder.path(), &[&inspect[..], &["m.svg"]].concat());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn a_path_that_is_no_manifest_has_the_manifest_to_name() {
    let folder = folder_with(FOUR_BAR);
    let path = |name: &str| folder.path().join(name);
    fs::rename(path("atlas.toml"), path("mine.toml")).unwrap();
    fs::create_dir(path("empty")).unwrap();
    fs::create_dir(path("with")).unwrap();
    fs::write(path("with/atlas.toml"), FOUR_BAR).unwrap();
    fs::write(path("sketch.svg"), "<svg/>").unwrap();
    fs::write(path("sketch.csv"), "1,2\n3,4\n").unwrap();
    fs::write(path("picture.toml"), b"\x89PNG\r\n\x1a\n").unwrap();
    all_refused(
        folder.path(),
        &[
            (&["render", "mine"], "cannot find mine: did you mean mine.toml?\n"),
            (&["render", "with"], "with is a folder: name its manifest, with/atlas.toml\n"),
            (&["render", "empty"], "empty is a folder: name a manifest, a file whose name ends in .toml\n"),
            (&["validate", "sketch.svg"], "sketch.svg is a drawing, not a manifest: `coupler-atlas find sketch.svg`"),
            (&["render", "sketch.csv"], "sketch.csv is a file of points, not a manifest"),
            (&["render", "nope.csv"], "cannot find nope.csv: name a manifest, a file whose name ends in .toml\n"),
            (&["render", "nope.toml"], "`coupler-atlas init nope.toml` writes a manifest to start from"),
            (&["render", "nope"], "`coupler-atlas init nope.toml` writes a manifest to start from"),
            (&["render", "picture.toml"], "picture.toml is not a text: name a manifest"),
        ],
    );
    printed(folder.path(), &["render", "mine.toml", "-q"]);
    let err = refused(folder.path(), &["render", "mine"]);
    assert_eq!(err, "error: mine is a folder: name its manifest, mine.toml\n");
}

#[test]
fn a_file_that_is_no_path_has_what_to_name() {
    let folder = folder_with(FOUR_BAR);
    fs::write(folder.path().join("picture.png"), b"\x89PNG\r\n\x1a\n").unwrap();
    all_refused(
        folder.path(),
        &[
            (&["find", "nope.svg"], "cannot find nope.svg: name a table of points, JSON or a drawing in SVG or DXF\n"),
            (&["find", "picture.png"], "picture.png: it is no table of points, JSON, SVG or DXF\n"),
            (&["find", "."], ". is a folder: name a table of points"),
            (&["find", "atlas.toml"], "atlas.toml is a manifest, not a path: `coupler-atlas render atlas.toml`"),
        ],
    );
    assert_eq!(refused(folder.path(), &["find", "atlas.toml"]).lines().count(), 1);
}

#[test]
fn wrong_arguments_have_a_hint() {
    let folder = folder_with(FOUR_BAR);
    all_refused(
        folder.path(),
        &[
            (&["help"], "tip: the help is `coupler-atlas --help`, and on a command `coupler-atlas find --help`"),
            (&["help", "check"], "tip: the help on a command is `coupler-atlas check --help`"),
            (&["mine.toml"], "tip: a manifest is drawn with `coupler-atlas render mine.toml`"),
            (&["sketch.svg"], "tip: a path is searched for with `coupler-atlas find sketch.svg`"),
            (
                &["render", "atlas.toml", "--format", "svg", "pdf"],
                "tip: several formats are divided by commas: --format svg,pdf",
            ),
            (&["render", "-format", "pdf"], "tip: options of several letters have two hyphens: --format"),
            (
                &["inspect", "four-bar", "frame=4", "crank=1", "coupler=3"],
                "four-bar: `rocker` has no value: add it, as in rocker=",
            ),
            (
                &["export", "--linkage", "four-bar", "frame=4", "crank=1", "coupler=3"],
                "four-bar: `rocker` has no value: add it, as in rocker=",
            ),
        ],
    );
}

#[test]
fn conditions_on_words_and_unknown_names_have_short_remedies() {
    let folder = folder_with(FOUR_BAR);
    fs::write(folder.path().join("path.csv"), STRAIGHT).unwrap();
    let find = |condition: &str| refused(folder.path(), &["find", "path.csv", "--where", condition]);
    for operator in ["=", "=="] {
        let err = find(&format!("class {operator} crank-rocker"));
        assert!(err.contains("`class` is a word, and cannot be compared; write `is_crank_rocker`\n"), "{err}");
    }
    let err = find("foo > 1");
    let names = "it can be one of frame, crank, coupler, rocker, along, across, x, y, turn, or a measure: \
                 `coupler-atlas list measures` lists them\n";
    assert!(err.contains(&format!("unknown name `foo`; {names}")), "{err}");
    let err = find("foo > 1 and bar < 2");
    assert!(err.contains("unknown name `foo`; ") && err.contains("unknown name `bar`; "), "{err}");
    for condition in ["class = crank-rocker", "class == crank-rocker"] {
        fs::write(folder.path().join("atlas.toml"), format!("{FOUR_BAR}where = \"{condition}\"\n")).unwrap();
        let err = refused(folder.path(), &["validate"]);
        assert!(err.contains("help: write `is_crank_rocker`") && err.contains("1 problem"), "{err}");
    }
}

#[test]
fn a_linkage_that_jams_and_a_poor_fit_are_said_to_be_so() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("path.csv"), STRAIGHT).unwrap();
    let find =
        |more: &[&str]| run(folder.path(), &[&["find", "path.csv", "--index", "300", "--input", "any"], more].concat());
    let (code, out, err) = find(&["--where", "mu_worst_deg < 5"]);
    let read = "note: path.csv: x is column 1, y column 2; open, for its ends are apart\n";
    assert_eq!((code, err.as_str()), (0, read));
    let note = "note: the best linkage jams, or nearly so: its worst transmission angle is";
    let remedy = "--where \"(mu_worst_deg < 5) and mu_worst_deg >= 30\"\n";
    assert!(out.contains(note) && out.contains(remedy), "{out}");
    for form in ["--toml", "--json"] {
        let (code, out, err) = find(&["--where", "mu_worst_deg < 5", form]);
        assert!(code == 0 && err.contains(note) && !out.contains("note:"), "{form}: {err}");
    }
    let (_, out, _) = find(&["--where", "mu_worst_deg > 10", "--no-refine", "--closed", "--max-link", "2"]);
    assert!(!out.contains(note), "{out}");
    let poor = "note: the best fit is poor; what may help: a weaker --where, a greater --max-link, no --no-refine, --effort thorough, --part";
    assert!(out.contains(poor), "{out}");
}

#[test]
fn a_reason_is_given_once_for_a_single_linkage() {
    let folder = folder_with(&FOUR_BAR.replace("frame = 4", "frame = 40"));
    let (code, out, err) = run(folder.path(), &["render"]);
    assert_eq!(code, 0, "{err}");
    assert_eq!(err.matches("B cannot be placed").count(), 1, "{err}");
    assert!(err.contains("change the lengths: with frame = 40, crank = 1") && !err.contains("nearest"), "{err}");
    assert!(out.contains("1 cell (1 not assembled), 0 curves, 1 page\n"), "{out}");
}

#[test]
fn the_summary_says_what_was_drawn_and_removed_and_where() {
    let folder = folder_with(FOUR_BAR);
    let path = |name: &str| folder.path().join(name);
    let out = printed(folder.path(), &["render", "--format", "pdf"]);
    assert!(out.contains("mine: 1 cell, 2 curves, 1 page\n"), "{out}");
    for sub in ["a", "b"] {
        fs::create_dir(path(sub)).unwrap();
        let text =
            FOUR_BAR.replace("\"mine\"", &format!("\"of-{sub}\"")).replace("\"T\"", "\"T\"\noutput = \"../common\"");
        fs::write(path(&format!("{sub}/mine.toml")), text).unwrap();
    }
    let out = printed(folder.path(), &["render", "a/mine.toml"]);
    assert!(out.contains("written to common; open common/index.html\n") && !out.contains("removed"), "{out}");
    let out = printed(folder.path(), &["render", "b/mine.toml"]);
    assert!(out.contains("removed: of-a, which is not in the manifest\n"), "{out}");
    assert!(path("common/of-b").exists() && !path("common/of-a").exists());
}

//! The command-line program: commands, exit codes and files.

use std::fs;
use std::path::Path;

use coupler_curves::geometry::trig;
use tempfile::TempDir;

use crate::support::command::{folder_with, run};
use crate::support::folder::{files, tree};
use crate::support::table::{numbers, rows};

const MANIFEST: &str = r#"[atlas]
title = "T"
output = "pages"
formats = ["svg"]
[[family]]
id = "evans"
linkage = "evans"
title = "Evans <linkage> & \"co\""
panels = [2, 1]
sampling = { step = "10 deg" }
grid = { p = [2, 3, 4] }
let = { a = "(1 + p)^1.5 / 2" }
[[family]]
id = "far"
linkage = "watt"
sampling = { samples = 20 }
cases = [{ p = 4, r = 2, a = 1 }, { p = 90, r = 2, a = 1 }]
"#;

#[test]
fn render_writes_pages_points_cells_and_a_record() {
    let folder = folder_with(MANIFEST);
    let (code, out, err) = run(folder.path(), &["render"]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("evans: 3 cells, 3 curves, 2 pages"), "{out}");
    assert!(out.contains("far: 2 cells (1 not assembled), 1 curve, 1 page"), "{out}");
    assert!(err.contains("warning: far, cell 2: B cannot be placed: A and C are 88 or more apart"), "{err}");
    let pages = folder.path().join("pages");
    assert_eq!(
        files(&pages),
        [
            "evans/cells.csv",
            "evans/evans-001.svg",
            "evans/evans-002.svg",
            "evans/gallery.js",
            "evans/points.csv",
            "far/cells.csv",
            "far/far-001.svg",
            "far/gallery.js",
            "far/points.csv",
            "index.html",
            "kernel.js",
            "run.json"
        ]
    );
    let points = fs::read_to_string(pages.join("evans/points.csv")).unwrap();
    let mut lines = points.lines();
    assert_eq!(lines.next(), Some("cell,trace,circuit,branch,sample,input_deg,x,y"));
    assert!(lines.next().unwrap().starts_with("1,1,1,1,0,0,2,"));
    assert_eq!(lines.count(), 3 * 36 - 1);
    let cells = fs::read_to_string(pages.join("far/cells.csv")).unwrap();
    assert!(cells.starts_with("cell,trace,circuit,p,r,s,a,k,status,reason,class,"), "{cells}");
    assert!(cells.contains("\n1,1,1,4,2,2,1,0.5,ok,,triple-rocker,"), "{cells}");
    assert!(
        cells.contains("\n2,,,90,2,2,1,0.5,none,\"B cannot be placed: A and C are 88 or more apart, links"),
        "{cells}"
    );
    let page = fs::read_to_string(pages.join("evans/evans-001.svg")).unwrap();
    assert!(page.contains("Evans &lt;linkage&gt; &amp; &quot;co&quot;"));
    assert!(page.contains(
        "<g id=\"evans-1-1-1\" class=\"curve\" data-cell=\"1\" data-trace=\"1\" data-circuit=\"1\" data-scale=\""
    ));
    let far = fs::read_to_string(pages.join("far/far-001.svg")).unwrap();
    assert!(far.contains("not assembled"));
}

#[test]
fn png_records_its_resolution() {
    let folder =
        folder_with(&MANIFEST.replace("[[family]]\nid = \"evans\"", "[page]\ndpi = 60\n[[family]]\nid = \"evans\""));
    let (code, _, err) = run(folder.path(), &["render", "-q", "--format", "png", "--only", "evans"]);
    assert_eq!(code, 0, "{err}");
    let bytes = fs::read(folder.path().join("pages/evans/evans-001.png")).unwrap();
    assert_eq!(&bytes[37..41], b"pHYs");
    assert_eq!(u32::from_be_bytes(bytes[41..45].try_into().unwrap()), 2362, "60 / 0.0254 pixels to the metre");
    let image = image::load_from_memory(&bytes).unwrap();
    assert_eq!((image.width(), image.height()), (1020, 660), "17 by 11 inches");
}

#[test]
fn only_leaves_other_families_alone() {
    let folder = folder_with(MANIFEST);
    run(folder.path(), &["render", "-q"]);
    let pages = folder.path().join("pages");
    let before = tree(&pages);
    fs::write(folder.path().join("atlas.toml"), MANIFEST.replace("[2, 3, 4]", "[2, 5]")).unwrap();
    let (code, out, _) = run(folder.path(), &["render", "--only", "far"]);
    assert_eq!(code, 0);
    assert!(!out.contains("evans"));
    assert_eq!(tree(&pages), before);
    let (code, _, err) = run(folder.path(), &["render", "--only", "fra"]);
    assert_eq!(code, 2);
    assert!(err.contains("there is no family `fra`: did you mean `far`?"), "{err}");
}

#[test]
fn a_record_that_cannot_be_read_is_not_overwritten_by_only() {
    let folder = folder_with(MANIFEST);
    run(folder.path(), &["render", "-q"]);
    let record = folder.path().join("pages/run.json");
    for (text, message) in [("{", "not the record of a run"), ("{\"format\": 1}", "missing field")] {
        fs::write(&record, text).unwrap();
        let (code, _, err) = run(folder.path(), &["render", "--only", "far"]);
        assert_eq!(code, 2, "{err}");
        assert!(err.contains(message) && err.contains("render all of them"), "{err}");
        assert_eq!(fs::read_to_string(&record).unwrap(), text);
    }
    assert_eq!(run(folder.path(), &["render", "-q"]).0, 2);
    assert_eq!(run(folder.path(), &["render", "-q", "--overwrite"]).0, 0);
}

#[test]
fn exit_codes_distinguish_the_kinds_of_failure() {
    let folder = folder_with(MANIFEST);
    let code = |arguments: &[&str]| run(folder.path(), arguments).0;
    assert_eq!(code(&["validate"]), 0);
    assert_eq!(code(&["render", "-q", "--strict"]), 1, "a cell is not assembled");
    assert_eq!(code(&["render", "missing.toml"]), 2);
    assert_eq!(code(&["render", "."]), 2, "a folder is not a manifest");
    assert_eq!(code(&["rendr"]), 2);
    assert_eq!(code(&["render", "--jobs", "0"]), 2);
    assert_eq!(code(&["render", "--format", "gif"]), 2);
    fs::write(folder.path().join("blocked"), "a file").unwrap();
    assert_eq!(code(&["render", "-q", "-o", "blocked"]), 3, "a file is in the folder's place");
    assert_eq!(fs::read_to_string(folder.path().join("blocked")).unwrap(), "a file");
    fs::write(folder.path().join("binary.toml"), [0xff, 0xfe, 0x00]).unwrap();
    assert_eq!(code(&["validate", "binary.toml"]), 2);
}

#[test]
fn validate_writes_nothing_and_names_every_problem() {
    let folder = folder_with(&MANIFEST.replace("\"10 deg\"", "\"0 deg\"").replace("\"watt\"", "\"wat\""));
    let (code, out, err) = run(folder.path(), &["validate"]);
    assert_eq!((code, out.as_str()), (2, ""));
    assert!(err.contains("`step` must not be 0") && err.contains("did you mean `watt`?"), "{err}");
    assert!(err.contains("atlas.toml:10:21"), "{err}");
    assert_eq!(files(folder.path()), ["atlas.toml"]);
}

#[test]
fn a_where_that_keeps_no_cell_is_a_warning() {
    let folder = folder_with(&MANIFEST.replace("let =", "where = \"p > 9\"\nlet ="));
    let (code, out, err) = run(folder.path(), &["render"]);
    assert_eq!(code, 0);
    assert!(err.contains("warning: `where` keeps none of the 3 cells"), "{err}");
    assert!(out.contains("evans: 3 cells (3 left out by `where`), 0 curves, 0 pages"), "{out}");
    let some = folder_with(&MANIFEST.replace("let =", "where = \"p > 2 and is_crank_rocker\"\nlet ="));
    let (_, out, _) = run(some.path(), &["render"]);
    assert!(out.contains("evans: 3 cells (1 left out by `where`), 2 curves, 1 page"), "{out}");
    let cells = fs::read_to_string(some.path().join("pages/evans/cells.csv")).unwrap();
    let cells: Vec<String> = rows(&cells).iter().map(|row| row["cell"].clone()).collect();
    assert_eq!(cells, ["2", "3"], "cells that are kept keep their numbers");
}

#[test]
fn init_writes_a_manifest_that_renders_and_never_overwrites() {
    let folder = TempDir::new().unwrap();
    assert_eq!(run(folder.path(), &["init", "my.toml"]).0, 0);
    let (code, out, err) = run(folder.path(), &["render", "my.toml", "--strict", "--format", "svg"]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("mine: 6 cells, 6 curves, 1 page"), "{out}");
    fs::write(folder.path().join("my.toml"), "mine").unwrap();
    let (code, _, err) = run(folder.path(), &["init", "my.toml"]);
    assert_eq!(code, 2);
    assert!(err.contains("exists already"), "{err}");
    assert_eq!(fs::read_to_string(folder.path().join("my.toml")).unwrap(), "mine");
}

#[test]
fn list_names_the_catalogue() {
    let folder = TempDir::new().unwrap();
    let (code, out, _) = run(folder.path(), &["list"]);
    assert_eq!(code, 0);
    for word in ["linkages", "four-bar", "chebyshev", "p, r, a, s, k", "measures", "input_min_deg", "layouts", "panels"]
    {
        assert!(out.contains(word), "{word}:\n{out}");
    }
    assert!(!run(folder.path(), &["list", "layouts"]).1.contains("evans"));
}

/// Simulates a full disk by a file-size limit, at which writes also fail part of the way.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_every_file_whole() {
    let folder = folder_with(MANIFEST);
    run(folder.path(), &["render", "-q"]);
    let pages = folder.path().join("pages");
    let before = tree(&pages);
    fs::write(folder.path().join("atlas.toml"), MANIFEST.replace("10 deg", "1 deg")).unwrap();
    let script = "trap '' XFSZ; ulimit -f 16; exec \"$0\" render -q";
    use crate::support::command::{result, shell};
    let (code, _, err) = result(shell(folder.path(), script).output().unwrap());
    assert_eq!(code, 3);
    assert!(err.contains("cannot write") && err.contains("File too large"), "{err}");
    // Pages may be new or old, but each is complete, and no temporary file remains.
    let after = tree(&pages);
    assert!(!after.is_empty() && after.keys().eq(before.keys()));
    for (name, bytes) in after.iter().filter(|(name, _)| name.ends_with(".svg")) {
        assert!(bytes.ends_with(b"</svg>\n"), "{name}");
    }
    // The record distinguishes them: another run into the same folder makes all of them new.
    let (code, out, err) = run(folder.path(), &["render"]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("far: 2 cells (1 not assembled), 1 curve, 1 page (unchanged)"), "{out}");
    let fresh = folder_with(&MANIFEST.replace("10 deg", "1 deg"));
    run(fresh.path(), &["render", "-q"]);
    assert_eq!(tree(&pages), tree(&fresh.path().join("pages")));
}

#[test]
fn additional_columns_come_last_and_unbounded_values_are_inf() {
    let folder =
        folder_with(&MANIFEST.replace("linkage = \"watt\"", "linkage = \"watt\"\ncolumns = [\"psi_deg\", \"vx\"]"));
    let (code, _, err) = run(folder.path(), &["render", "-q"]);
    assert_eq!(code, 0, "{err}");
    let points = fs::read_to_string(folder.path().join("pages/far/points.csv")).unwrap();
    assert!(points.starts_with("cell,trace,circuit,branch,sample,input_deg,x,y,psi_deg,vx\n"));
    let unbounded = points.lines().filter(|line| line.ends_with(",inf")).count();
    assert_eq!(unbounded, 2, "at the two limits");
}

#[test]
fn inspect_prints_class_circuits_and_poses() {
    let folder = TempDir::new().unwrap();
    let (code, out, err) = run(folder.path(), &["inspect", "roberts", "p=2", "r=2", "a=1", "b=2", "--at", "60"]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("class: double-rocker"), "{out}");
    assert!(
        out.contains("circuit 1: from 28.95502437° on branch 1 to 97.18075578° (B flat), on branch -1 to 28.95502437°"),
        "{out}"
    );
    assert_eq!(out.matches("at 60°, circuit 1, branch").count(), 2, "{out}");
    let json = |arguments: &[&str]| -> serde_json::Value {
        let (code, out, err) = run(folder.path(), &[&["inspect", "--json"], arguments].concat());
        assert_eq!(code, 0, "{err}");
        serde_json::from_str(&out).unwrap()
    };
    let value = json(&["slider-crank", "crank=1", "coupler=2", "--at", "90", "--branch", "1"]);
    assert_eq!(value["format"], 1);
    // The crank upright: the slider is at sqrt(3), and moves as fast as the crank pin.
    let slider = &value["poses"][0]["joints"][3];
    assert!((slider["place"][0].as_f64().unwrap() - 3f64.sqrt()).abs() < 1e-12);
    assert!((slider["velocity"][0].as_f64().unwrap() + 1.0).abs() < 1e-12);
    // Both pins of the coupler move in the same direction, so it does not turn.
    assert!(value["poses"][0]["links"][1]["angular_velocity"].as_f64().unwrap().abs() < 1e-15);
    let (code, _, err) = run(folder.path(), &["inspect", "evans", "p=2", "a=sqrt(7)", "q=1"]);
    assert_eq!(code, 2);
    assert!(err.contains("unknown parameter `q`"), "{err}");
    assert!(run(folder.path(), &["inspect", "evens"]).2.contains("did you mean `evans`?"));
    assert!(run(folder.path(), &["inspect", "evans", "p"]).2.contains("there is no `=`"));
    assert!(run(folder.path(), &["inspect", "evans", "p=2"]).2.contains("`a` has no value"));
    assert!(run(folder.path(), &["inspect", "evans", "p=9", "a=1"]).1.contains("not assembled: B cannot be placed"));
    assert_eq!(run(folder.path(), &["inspect", "evans", "p=2", "a=sqrt(7)", "--at", "nan"]).0, 2);
    assert_eq!(run(folder.path(), &["inspect", "evans", "p=2", "a=sqrt(7)", "--animate"]).0, 2, "it needs a file");
}

/// Bernoulli's lemniscate as Watt's curve: (8.11) with p = 2, r = sqrt 2 and its a = 1, a node in the middle.
#[test]
fn inspect_prints_the_equation() {
    let here = Path::new(".");
    let arguments = ["inspect", "watt", "p=2", "r=sqrt(2)", "a=2"];
    let (code, text, err) = run(here, &[&arguments[..], &["--sextic"]].concat());
    assert_eq!(code, 0, "{err}");
    assert!(text.contains("M: on a sextic, three times through the circular points"), "{text}");
    assert!(text.contains("crunode (1, 0)") && text.contains("\nx^6"), "{text}");
    let plain = run(here, &arguments).1;
    assert!(plain.contains("crunode (1, 0)") && !plain.contains("x^6"));
    let json: serde_json::Value = serde_json::from_str(&run(here, &[&arguments[..], &["--json"]].concat()).1).unwrap();
    let equation = &json["equations"][0];
    assert_eq!(equation["circular_points"], 3);
    let c = |i: usize, j: usize| equation["coefficients"][i][j].as_f64().unwrap();
    let count: usize = (0..=6).map(|i| equation["coefficients"][i].as_array().unwrap().len()).sum();
    assert_eq!(count, 28);
    // The lemniscate times its circle, about (1, 0), with X = x - 1: ((X^2 + y^2)^2 - 2 (X^2 - y^2)) (X^2 + y^2 - 2).
    let expected = [(6, 0, 1.0), (4, 2, 3.0), (0, 6, 1.0), (5, 0, -6.0), (1, 4, -6.0)];
    let product = |x: f64, y: f64| {
        let (x2, y2) = ((x - 1.0) * (x - 1.0), y * y);
        ((x2 + y2) * (x2 + y2) - 2.0 * (x2 - y2)) * (x2 + y2 - 2.0)
    };
    for (i, j, value) in expected {
        assert!((c(i, j) - value).abs() < 1e-13, "x^{i} y^{j}: {}", c(i, j));
    }
    for (x, y) in [(0.3, 0.7), (-1.0, 2.0), (2.5, -0.4)] {
        let power = |x: f64, n: usize| (0..n).fold(1.0, |p, _| p * x);
        let all = (0..=6).flat_map(|i| (0..=6 - i).map(move |j| (i, j)));
        let sum: f64 = all.map(|(i, j)| c(i, j) * power(x, i) * power(y, j)).sum();
        assert!((sum - product(x, y)).abs() < 1e-12 * (1.0 + sum.abs()), "{sum} {}", product(x, y));
    }
    assert!(!run(here, &["inspect", "klann"]).1.contains("sextic"), "not a four-bar");
    assert!(!run(here, &["inspect", "evans", "p=2", "a=2.5", "k=1"]).1.contains("sextic"), "a circle");
}

/// The text and the JSON of `inspect`.
fn inspect(arguments: &[&str]) -> (String, serde_json::Value) {
    let print = |more: &[&str]| {
        let (code, out, err) = run(Path::new("."), &[&["inspect"], arguments, more].concat());
        assert_eq!(code, 0, "{err}");
        out
    };
    (print(&[]), serde_json::from_str(&print(&["--json"])).unwrap())
}

/// Natesan (4.8) and (4.9) for figure 35: p = r = s = 2, a = 1.
#[test]
fn inspect_prints_the_limits_of_a_roberts_linkage() {
    let (text, json) = inspect(&["roberts", "p=2", "r=2", "a=1", "b=2"]);
    // (4.8): cos = (4 + 9 - 4) / 12; folded: (4 + 1 - 4) / 4; (4.9): (4 + 4 - 9) / 8.
    let expected =
        "limits of the rocker, by the crank's angle from the frame: ±41.40962211° (extended), ±75.52248781° (folded)";
    assert!(text.contains(expected), "{text}");
    assert!(text.contains("arc of the source's figure: from 41.40962211° to 97.18075578° on branch 1"), "{text}");
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let degrees = |cosine: f64| trig::degrees(trig::acos(cosine));
    let limits = &json["rocker_limits"];
    assert!((number(&limits["extended"]) - degrees(0.75)).abs() < 1e-12);
    assert!((number(&limits["folded"]) - degrees(0.25)).abs() < 1e-12);
    assert!((number(&json["arc"]["from"]) - degrees(0.75)).abs() < 1e-12);
    assert!((number(&json["arc"]["to"]) - degrees(-0.125)).abs() < 1e-12);
    assert_eq!(json["circuits"][0]["full_turn"], false);
    // A crank of a drag link goes round its rocker's limits: there are none.
    let (text, json) = inspect(&["four-bar", "frame=1", "crank=3", "coupler=3.5", "rocker=4"]);
    assert!(text.contains("by the crank's angle from the frame: none"), "{text}");
    assert_eq!(json["rocker_limits"], serde_json::json!({ "extended": null, "folded": null }));
    assert_eq!(
        (&json["circuits"][0]["full_turn"], &json["curves"][0]["measures"]["is_full_turn"]),
        (&true.into(), &"yes".into())
    );
}

#[test]
fn inspect_prints_the_ranges_of_an_inverted_slider_crank() {
    let (text, json) = inspect(&["inverted-slider-crank"]);
    // g = 2, r = 1, e = 1/2: cosines of psi 1/4 and -3/4, squares of the slide 3/4 and 35/4.
    let line = "inverted slider-crank: crank theta turns fully, slide s from 0.8660254038 to 2.958039892, output psi from 75.52248781° to 138.5903779°; and the mirror image";
    assert!(text.contains(line), "{text}");
    let psi = &json["inverted_slider_crank"]["psi_deg"];
    assert!((psi[0].as_f64().unwrap() - trig::degrees(trig::acos(0.25))).abs() < 1e-12);
    assert!((psi[1].as_f64().unwrap() - trig::degrees(trig::acos(-0.75))).abs() < 1e-12);
    let (text, _) = inspect(&["inverted-slider-crank", "g=1", "r=2", "e=0"]);
    assert!(text.contains("output psi turns fully"), "{text}");
    assert_eq!(inspect(&["slider-crank"]).1["inverted_slider_crank"], serde_json::Value::Null);
}

/// Natesan (5.5) and (5.6), a known direction and a known length: the offset slider-crank has two roots, of which the
/// start's circuit has the first.
#[test]
fn inspect_prints_the_second_root_of_a_slider() {
    let arguments = ["slider-crank", "crank=1", "coupler=3", "offset=0.5", "--at", "40", "--branch"];
    let (cosine, sine) = trig::cos_sin_deg(40.0);
    for (branch, root) in [("1", 1.0), ("-1", -1.0)] {
        let (text, json) = inspect(&[&arguments[..], &[branch]].concat());
        assert!(text.contains(&format!("branch {branch}\n")) && !text.contains("no circuit"), "{text}");
        let [pose] = &json["poses"].as_array().unwrap()[..] else { panic!("one pose: {text}") };
        let place = |k: usize| pose["joints"][3]["place"][k].as_f64().unwrap();
        // C is the vector to the crank pin and A^u the slider's direction: (5.5) is -C.A^u and a root, with the distance
        // of the line from C as C.(A^u x k).
        let distance = sine - 0.5;
        let expected = cosine + root * (9.0 - distance * distance).sqrt();
        assert!((place(0) - expected).abs() < 1e-12 && (place(1) - 0.5).abs() < 1e-12, "{branch}: {expected} {text}");
    }
}

/// Natesan (7.7), (8.3) and (8.12).
#[test]
fn inspect_prints_the_centred_equation_and_the_crossings_of_the_axis() {
    // Figure 11, and (8.12) with the thesis's a = 1/2, p = 2, r = 2.59.
    let arguments = ["chebyshev", "p=2", "r=2.59", "a=1"];
    let (text, json) = inspect(&[&arguments[..], &["--sextic"]].concat());
    let crossing = |sign: f64| (-1.0 + sign * 4.0 - 4.0 + 4.0 * 2.59f64 * 2.59).sqrt() / 2.0;
    let y = &json["equations"][0]["axis"]["y"];
    assert_eq!(json["equations"][0]["axis"]["x"], 1.0);
    assert!((y[0].as_f64().unwrap() - crossing(1.0)).abs() < 1e-12, "{y}");
    assert!((y[1].as_f64().unwrap() - crossing(-1.0)).abs() < 1e-12, "{y}");
    assert!(text.contains("M: crosses its axis x = 1 at y = ±2.541279205, ±2.111421322 (Natesan 8.12)"), "{text}");
    let heading = "about the middle of the frame, X = x - 1, Y = y (Natesan 7.6); no odd powers of X, the curve is symmetrical about X = 0:";
    assert!(text.contains(heading) && text.contains("\nX^6"), "{text}");
    let centred = json["equations"][0]["centred_coefficients"].as_array().unwrap();
    assert_eq!(centred[6][0], 1.0);
    assert!([1, 3, 5].iter().all(|i: &usize| centred[*i].as_array().unwrap().iter().all(|c| c == 0.0)), "{centred:?}");
    // (8.3), figure 1: y^2 = 4 a^2 - (p - r)^2 and 4 a^2 - (p + r)^2.
    let (text, json) = inspect(&["evans", "p=2", "a=2.59"]);
    let y = &json["equations"][0]["axis"]["y"];
    assert!((y[0].as_f64().unwrap() - (4.0 * 2.59f64 * 2.59 - 1.0).sqrt()).abs() < 1e-12, "{y}");
    assert!((y[1].as_f64().unwrap() - (4.0 * 2.59f64 * 2.59 - 9.0).sqrt()).abs() < 1e-12, "{y}");
    assert!(text.contains("M: crosses its axis x = 2 at y = ±") && text.contains("(Natesan 8.3)"), "{text}");
    // A curve that is not symmetrical about the middle keeps its odd powers; one of other proportions has no such axis.
    let (text, json) =
        inspect(&["four-bar", "frame=4", "crank=1", "coupler=3", "rocker=3.5", "along=1", "across=1", "--sextic"]);
    assert!(text.contains("Y = y (Natesan 7.6):\n") && !text.contains("crosses its axis"), "{text}");
    assert!(json["equations"][0]["axis"].is_null());
}

#[test]
fn inspect_names_six_bars() {
    for (id, kind) in [("klann", "Stephenson III"), ("watt-six-bar", "Watt II"), ("hart-inversor", "Watt I")] {
        let (text, json) = inspect(&[id]);
        assert!(text.contains(&format!("six-bar: {kind}\n")), "{text}");
        assert_eq!(json["six_bar"], kind);
        assert_eq!(json["curves"][0]["measures"]["six_bar"], kind);
    }
    let (text, json) = inspect(&["hoeken"]);
    assert!(!text.contains("six-bar") && json["six_bar"].is_null());
    assert!(json["curves"][0]["measures"]["six_bar"].is_null());
}

/// docs/inspect.md describes every key of the JSON, and no other.
#[test]
fn the_json_of_inspect_has_the_described_keys() {
    fn keys(value: &serde_json::Value, found: &mut std::collections::BTreeSet<String>) {
        match value {
            serde_json::Value::Array(values) => values.iter().for_each(|value| keys(value, found)),
            serde_json::Value::Object(object) => {
                for (key, value) in object {
                    found.insert(key.clone());
                    // The keys inside these are names of parameters and measures.
                    if !["parameters", "measures"].contains(&key.as_str()) {
                        keys(value, found);
                    }
                }
            }
            _ => {}
        }
    }
    let mut printed = std::collections::BTreeSet::new();
    for arguments in [
        &["watt", "p=4", "r=2", "a=2", "s=2", "--at", "10", "--cognates", "--tolerance", "0.1"][..],
        &["inverted-slider-crank"],
        &["roberts", "p=2", "r=2", "a=1", "b=2"],
    ] {
        let (_, out, _) = run(Path::new("."), &[&["inspect", "--json"], arguments].concat());
        keys(&serde_json::from_str(&out).unwrap(), &mut printed);
    }
    let text = include_str!("../../docs/inspect.md");
    let columns = text.lines().filter_map(|line| line.strip_prefix("| `")?.split(" |").next());
    let described: std::collections::BTreeSet<String> = columns
        .flat_map(|column| column.split('`').filter(|word| word.chars().all(|c| c.is_ascii_lowercase() || c == '_')))
        .filter(|word| !word.is_empty())
        .map(str::to_owned)
        .collect();
    let inner = ["trace", "measures", "flat", "name", "place", "velocity", "acceleration", "jerk"];
    let inner = inner.into_iter().chain(["angular_velocity", "angular_acceleration"]).map(str::to_owned);
    for key in inner.clone() {
        assert!(text.contains(&format!("`{key}`")), "{key}");
    }
    assert_eq!(printed, described.into_iter().chain(inner).collect());
}

/// The manifest of a four-bar and its cognates is valid, and each of its families draws the original's curve.
#[test]
fn cognates_make_a_manifest_that_draws_one_curve() {
    for arguments in [
        &["four-bar", "frame=4", "crank=1.5", "coupler=3", "rocker=3.5", "along=1.8", "across=1.3"][..],
        &["chebyshev", "p=3", "r=4"],
        &["roberts", "p=4", "r=2", "a=2", "b=3"],
        &["watt", "p=4", "r=2", "a=1"],
        &["evans", "p=2", "a=2.5"],
    ] {
        let folder = TempDir::new().unwrap();
        let inspect = |more: &[&str]| run(folder.path(), &[&["inspect"], arguments, &["--cognates"], more].concat());
        let (code, text, err) = inspect(&["--toml"]);
        assert_eq!(code, 0, "{err}");
        fs::write(folder.path().join("three.toml"), &text).unwrap();
        let (code, _, err) = run(folder.path(), &["validate", "three.toml"]);
        assert_eq!(code, 0, "{err}\n{text}");
        // Spaced by arc length, because samples at equal steps of the input lie far apart near a limit.
        let spaced = text.replace("{ step = \"2 deg\" }", "{ samples = 1000, spacing = \"arc\" }");
        fs::write(folder.path().join("three.toml"), spaced).unwrap();
        let (code, out, err) = run(folder.path(), &["render", "three.toml", "--strict", "-q", "--format", "svg"]);
        assert_eq!(code, 0, "{out}{err}");
        let points = |name: &str| -> Vec<[f64; 2]> {
            let path = format!("three/{}-{name}/points.csv", arguments[0]);
            let table = fs::read_to_string(folder.path().join(path)).unwrap();
            rows(&table).iter().map(|row| numbers(row, ["x", "y"])).collect()
        };
        let original = points("original");
        for name in ["cognate-1", "cognate-2"] {
            let deviation = |from: &[[f64; 2]], to: &[[f64; 2]]| {
                let nearest = |p: &[f64; 2]| to.iter().map(|q| distance(*p, *q)).fold(f64::INFINITY, f64::min);
                from.iter().map(nearest).fold(0.0, f64::max)
            };
            let cognate = points(name);
            let deviation = deviation(&original, &cognate).max(deviation(&cognate, &original));
            // The curves are at most some 15 units long and have 1000 samples, so that the nearest sample is at most
            // half a step away.
            assert!(deviation < 0.0125, "{} {name}: {deviation}", arguments[0]);
        }
        let (_, json, _) = inspect(&["--json"]);
        let value: serde_json::Value = serde_json::from_str(&json).unwrap();
        assert_eq!(value["cognates"]["linkages"].as_array().unwrap().len(), 3);
        assert!(inspect(&[]).1.contains("cognate 2: "));
        assert_eq!(inspect(&["--svg", "three.svg"]).0, 0);
        let plate = fs::read_to_string(folder.path().join("three.svg")).unwrap();
        assert!(plate.contains("and its cognates") && plate.matches("class=\"curve\"").count() >= 1);
    }
}

fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    ((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1])).sqrt()
}

#[test]
fn requests_for_cognates_that_do_not_exist_are_input_errors() {
    let here = Path::new(".");
    for (arguments, message) in [
        (&["klann"][..], "the linkage is not a four-bar"),
        (&["slider-crank", "crank=1", "coupler=2"], "the linkage is not a four-bar"),
        (&["evans", "p=2", "a=2.5", "k=1"], "the coupler point is the rocker pin"),
        (&["hoeken", "--trace", "2"], "give --trace 1 to 1"),
        (&["hoeken", "--trace", "0"], "give --trace 1 to 1"),
    ] {
        let (code, out, err) = run(here, &[&["inspect"], arguments, &["--cognates"]].concat());
        assert!(code == 2 && out.is_empty() && err.contains(message), "{arguments:?}: {err}");
    }
    assert_eq!(run(here, &["inspect", "hoeken", "--toml"]).0, 2, "it needs --cognates");
    assert_eq!(run(here, &["inspect", "hrones-nelson", "--cognates", "--trace", "10"]).0, 0);
}

#[test]
fn the_manual_and_completions_name_every_command() {
    let here = Path::new(".");
    let (code, manual, _) = run(here, &["man"]);
    assert_eq!(code, 0);
    let (code, completions, _) = run(here, &["completions", "bash"]);
    assert_eq!(code, 0);
    for command in ["render", "validate", "inspect", "list", "init", "completions", "man"] {
        assert!(manual.contains(&format!(".SH {}\n", command.to_uppercase())), "{command}");
        assert!(completions.contains(command), "{command}");
    }
    assert!(manual.contains("\\-\\-animate") && manual.contains("EXIT STATUS"));
    assert_eq!(run(here, &["completions", "dos"]).0, 2);
}

#[test]
fn an_animated_plate_covers_the_whole_circuit() {
    let folder = TempDir::new().unwrap();
    let plate = |arguments: &[&str]| {
        let (code, _, err) = run(folder.path(), &[arguments, &["--svg", "plate.svg"]].concat());
        assert_eq!(code, 0, "{err}");
        fs::read_to_string(folder.path().join("plate.svg")).unwrap()
    };
    let moving = plate(&["inspect", "hoeken", "--animate"]);
    let xs: Vec<&str> =
        moving.split("attributeName=\"cx\" values=\"").nth(1).unwrap().split('"').next().unwrap().split(';').collect();
    assert_eq!(xs.len(), 121, "one frame per three degrees, and the first one again");
    assert_eq!(xs[0], xs[120]);
    assert!(moving.contains("dur=\"4s\"") && moving.contains("repeatCount=\"indefinite\""));
    let still = plate(&["inspect", "hoeken"]);
    assert!(!still.contains("<animate"));
    // A circuit from one limit position to the other and back.
    let rocking = plate(&["inspect", "watt", "p=4", "r=2", "s=2", "a=2", "--animate"]);
    assert!(rocking.matches("<animate").count() > 8);
}

#[test]
fn inspect_draws_plates_of_linkages_defined_in_a_manifest() {
    let folder = TempDir::new().unwrap();
    run(folder.path(), &["init", "my.toml"]);
    let arguments = ["inspect", "my-four-bar", "frame=3", "--manifest", "my.toml", "--svg", "plate.svg"];
    let (code, out, err) = run(folder.path(), &arguments);
    assert_eq!(code, 0, "{err}");
    assert!(out.starts_with("my-four-bar: frame = 3, crank = 1, height = 1\n"), "{out}");
    let plate = fs::read_to_string(folder.path().join("plate.svg")).unwrap();
    assert!(plate.contains("class=\"curve\"") && plate.ends_with("</svg>\n"));
}

/// Pages are ordered by `sort` and tables by cell; captions show measures, and the straight portion is marked.
#[test]
fn pages_are_sorted_and_tables_are_not() {
    let manifest = MANIFEST.replace(
        "let = {",
        "sort = \"-p\"\ncaption = \"{class} {input_min_deg}: straight {straight_length:.3}\"\nstraight = { input = \"60 deg\" }\nlet = {",
    );
    let folder = folder_with(&manifest);
    let (code, _, err) = run(folder.path(), &["render", "--only", "evans"]);
    assert_eq!(code, 0, "{err}");
    let read = |name: &str| fs::read_to_string(folder.path().join("pages/evans").join(name)).unwrap();
    let rows = rows(&read("cells.csv"));
    assert_eq!(rows.iter().map(|row| &row["cell"]).collect::<Vec<_>>(), ["1", "2", "3"]);
    let (first, second) = (read("evans-001.svg"), read("evans-002.svg"));
    for (page, cells) in [(&first, &[3, 2][..]), (&second, &[1][..])] {
        let positions: Vec<usize> =
            cells.iter().map(|k| page.find(&format!("id=\"evans-{k}-1-1\"")).unwrap()).collect();
        assert!(positions.is_sorted(), "{cells:?}");
        for k in cells {
            let [input, length] = numbers(&rows[k - 1], ["straight_input_deg", "straight_length"]);
            assert!((input - 60.0).abs() < 1e-6);
            let line = format!("crank-rocker –: straight {length:.3}");
            assert!(page.contains(&line), "cell {k}: {line}");
        }
        assert_eq!(page.matches("class=\"straight\"").count(), cells.len());
        assert_eq!(page.matches("class=\"axis\"").count(), cells.len());
    }
}

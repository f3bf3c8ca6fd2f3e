//! `find --atlas`: curves of an atlas are found where they are, placed, refined and exported.

use std::fs;

use serde_json::Value as Json;
use tempfile::TempDir;

use crate::support::command::{folder_with, printed, run};
use crate::support::table::{numbers, rows};

const MANIFEST: &str = r#"
[atlas]
title = "sliders and four-bars"
formats = ["svg"]

[[family]]
id = "sliders"
linkage = "slider-crank"
grid = { coupler = [2, 2.5, 3], across = [0.5, 1.5] }
sampling = { samples = 180 }

[[family]]
id = "bars"
linkage = "four-bar"
cases = [{ frame = 3, crank = 1, coupler = 2.5, rocker = 2.8, along = 1, across = 1 }, { frame = 1, crank = 2, coupler = 2.5, rocker = 2.2, along = 1, across = -2 }]
sampling = { samples = 180 }
"#;

/// A folder with the manifest, and a path that is the mirror image of `sliders:4.1.1`, 7 times as large, elsewhere.
fn folder() -> (TempDir, Vec<[f64; 2]>) {
    let folder = folder_with(MANIFEST);
    let csv = printed(folder.path(), &["export", "sliders:4.1.1", "--format", "csv"]);
    let points: Vec<[f64; 2]> = rows(&csv)
        .iter()
        .step_by(3)
        .map(|row| numbers(row, ["x", "y"]))
        .map(|[x, y]| [100.0 + 7.0 * y, 7.0 * x - 30.0])
        .collect();
    let rows: String = points.iter().map(|[x, y]| format!("{x},{y}\n")).collect();
    fs::write(folder.path().join("path.csv"), rows).unwrap();
    (folder, points)
}

#[test]
fn a_curve_of_another_linkage_is_found_placed_and_scaled() {
    let (folder, points) = folder();
    let args = ["find", "path.csv", "--closed", "--atlas", "atlas.toml", "--top", "2"];
    let json: Json = serde_json::from_str(&printed(folder.path(), &[&args[..], &["--json"]].concat())).unwrap();
    let best = &json["results"][0];
    assert_eq!(best["cell"], "sliders:4.1.1");
    assert_eq!(
        (&best["cell_number"], &best["linkage"], &best["refined"]),
        (&4.into(), &"slider-crank".into(), &false.into())
    );
    assert!(best["rms_relative"].as_f64().unwrap() < 1e-9, "{best}");
    assert!((best["placement"]["scale"].as_f64().unwrap() - 7.0).abs() < 1e-9);
    assert_eq!(best["placement"]["mirrored"], true);
    // Its dimensions are those of the cell, 7 times as large, and its pivot is where the origin was.
    let parameter = |name: &str| best["parameters"][name].as_f64().unwrap();
    assert!((parameter("crank") - 7.0).abs() < 1e-8 && (parameter("coupler") - 17.5).abs() < 1e-8, "{best}");
    let pivot = [&best["pivots"]["O"][0], &best["pivots"]["O"][1]].map(|value| value.as_f64().unwrap());
    assert!((pivot[0] - 100.0).abs() < 1e-8 && (pivot[1] + 30.0).abs() < 1e-8, "{best}");
    // The points of the linkage with these dimensions are as far apart as those of the path.
    let manifest = printed(folder.path(), &[&args[..], &["--toml"]].concat());
    fs::write(folder.path().join("found.toml"), &manifest).unwrap();
    assert!(manifest.contains("sliders:4.1.1") && manifest.contains("scale 7"), "{manifest}");
    let csv = printed(folder.path(), &["export", "found.toml", "slider-crank-exported:1.1.1", "--format", "csv"]);
    assert_eq!(csv.lines().count(), 181);
    let again =
        printed(folder.path(), &["find", "path.csv", "--closed", "--atlas", "found.toml", "--no-refine", "--json"]);
    let again: Json = serde_json::from_str(&again).unwrap();
    assert!((again["results"][0]["placement"]["scale"].as_f64().unwrap() - 1.0).abs() < 1e-8, "{again}");
    assert_eq!(points.len(), json["target"]["points"].as_array().unwrap().len());
    // The number of threads does not matter.
    let one = printed(folder.path(), &[&args[..], &["--json", "-j", "1"]].concat());
    assert_eq!(one, printed(folder.path(), &[&args[..], &["--json", "-j", "3"]].concat()));
    let svg = printed(folder.path(), &[&args[..], &["--svg", "-"]].concat());
    assert!(svg.contains("sliders:4.1.1"));
}

#[test]
fn fixed_curves_are_compared_where_they_are() {
    let (folder, _) = folder();
    let args =
        ["find", "--like", "bars:2.1.1", "--atlas", "atlas.toml", "--fixed", "--json", "--input", "any", "-j", "1"];
    let json: Json = serde_json::from_str(&printed(folder.path(), &args)).unwrap();
    assert_eq!(json["results"][0]["cell"], "bars:2.1.1");
    assert!(json["results"][0]["rms_relative"].as_f64().unwrap() < 1e-12);
    let placement = &json["results"][0]["placement"];
    assert_eq!(placement.to_string(), r#"{"mirrored":false,"rotation_deg":0.0,"scale":1.0,"shift":[0.0,0.0]}"#);
}

#[test]
fn four_bars_are_refined_from_their_cell() {
    let (folder, _) = folder();
    let bean = "0,0\n3,1\n6,1\n8,-1\n8,-4\n6,-5\n4,-4\n2,-4\n0,-5\n-1.5,-3\n";
    fs::write(folder.path().join("bean.csv"), bean).unwrap();
    let find = |more: &[&str]| -> Json {
        let args = [&["find", "bean.csv", "--closed", "--atlas", "atlas.toml", "--json"], more].concat();
        serde_json::from_str(&printed(folder.path(), &args)).unwrap()
    };
    let (refined, placed) = (find(&[]), find(&["--no-refine"]));
    let bar = |json: &Json| {
        let results = json["results"].as_array().unwrap();
        results.iter().find(|result| result["cell"].as_str().unwrap().starts_with("bars")).cloned().unwrap()
    };
    let rms = |result: &Json| result["rms"].as_f64().unwrap();
    assert_eq!((&bar(&refined)["refined"], &bar(&placed)["refined"]), (&true.into(), &false.into()));
    assert!(rms(&bar(&refined)) < 0.5 * rms(&bar(&placed)), "{refined} {placed}");
    assert!(bar(&refined)["crank_pivot"].is_array() && bar(&placed)["pivots"]["O"].is_array());
    // Conditions and boxes.
    let none = find(&["--where", "coupler > 100"]);
    assert_eq!((none["results"].as_array().unwrap().len(), &none["nearest_miss"]["relax"][0]), (0, &"--where".into()));
    let long = find(&["--where", "coupler > 2.7", "--no-refine", "--top", "50"]);
    assert!(
        long["results"].as_array().unwrap().iter().all(|result| result["parameters"]["coupler"].as_f64() > Some(2.7))
    );
    let boxed = find(&["--pivots=-1,-1,1,1", "--no-refine", "--top", "50"]);
    for result in boxed["results"].as_array().unwrap() {
        let pivots = result["pivots"].as_object().unwrap();
        assert!(pivots.values().all(|p| [0, 1].iter().all(|k| p[k].as_f64().unwrap().abs() <= 1.0)), "{result}");
    }
}

#[test]
#[ignore = "thorough"]
fn a_rendered_folder_is_searched_by_the_manifest_beside_it() {
    let (folder, _) = folder();
    printed(folder.path(), &["render", "--quiet"]);
    let args = |atlas| ["find", "path.csv", "--closed", "--json", "--atlas", atlas];
    assert_eq!(printed(folder.path(), &args("atlas")), printed(folder.path(), &args("atlas.toml")));
    // Another manifest, none, another version.
    fs::write(folder.path().join("atlas.toml"), MANIFEST.replace("[2, 2.5, 3]", "[2, 3]")).unwrap();
    let error = |args: &[&str]| {
        let (code, _, stderr) = run(folder.path(), args);
        assert_eq!(code, 2, "{stderr}");
        stderr
    };
    assert!(error(&args("atlas")).contains("does not have the families and cells of"));
    fs::remove_file(folder.path().join("atlas.toml")).unwrap();
    assert!(error(&args("atlas")).contains("name the manifest"));
    let record = folder.path().join("atlas").join("run.json");
    let text = fs::read_to_string(&record).unwrap();
    fs::write(&record, text.replacen("\"format\": 1", "\"format\": 99", 1)).unwrap();
    assert!(error(&args("atlas")).contains("format 99"));
    fs::remove_file(&record).unwrap();
    assert!(error(&args("atlas")).contains("is not the folder of an atlas"));
}

#[test]
fn options_that_do_not_go_together_are_errors() {
    let (folder, _) = folder();
    let error = |more: &[&str]| {
        let (code, _, stderr) = run(folder.path(), &[&["find", "path.csv"], more].concat());
        assert_eq!(code, 2, "{stderr}");
        stderr
    };
    assert!(error(&["--fixed"]).contains("--atlas MANIFEST|DIR"));
    assert!(error(&["--atlas", "atlas.toml", "--timed"]).contains("--timed and --atlas"));
    assert!(error(&["--atlas", "atlas.toml", "--index", "100"]).contains("--index"));
    assert!(error(&["--atlas", "atlas.toml", "--where", "nothing > 1"]).contains("--where: `nothing > 1`"));
    assert!(error(&["--atlas", "missing.toml"]).contains("cannot find missing.toml"));
    // A family whose cells cannot be assembled has no curve.
    let sliders = MANIFEST.replace("coupler = [2, 2.5, 3]", "coupler = [0.1], offset = [9]");
    let text = sliders.replace("frame = 3", "frame = 30").replace("frame = 1,", "frame = 30,");
    fs::write(folder.path().join("empty.toml"), text).unwrap();
    let (code, stdout, stderr) = run(folder.path(), &["find", "path.csv", "--atlas", "empty.toml"]);
    assert!(code == 0 && stdout.contains("no curve of the atlas is like the path"), "{code} {stdout} {stderr}");
}

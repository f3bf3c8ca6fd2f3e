//! What the program has exported is read back as it was.

use std::collections::BTreeMap;
use std::fs;

use coupler_atlas::find::Outline;
use coupler_curves::geometry::{Point, distance_to_segment};
use serde_json::Value as Json;
use tempfile::TempDir;

use super::{read, read_timed};
use crate::support::command::{folder_with, printed, program, result};

/// Closed and open curves, of cranks, rockers and actuators, with even and uneven steps.
const MANIFEST: &str = r#"[atlas]
title = "T"
[[linkage]]
id = "swing"
trace = ["M"]
input = { from = "20 deg", to = "250 deg" }
[linkage.joints]
O = { fixed = [0, 0] }
C = { fixed = [4, 0] }
A = { crank = "O", length = 1.5 }
B = { dyad = ["A", "C"], lengths = [3, 3.5], side = "left" }
M = { point = ["A", "B"], along = 1.5, across = 1 }
[[family]]
id = "swing"
linkage = "swing"
sampling = { step = "7 deg" }
cases = [{}]
[[family]]
id = "bars"
linkage = "four-bar"
sampling = { step = "10 deg" }
grid = { frame = [3.5, 4.2], crank = [1, 1.6], coupler = [3, 3.6], rocker = 3.3, along = [-1, 1.5], across = [0.4, 2] }
[[family]]
id = "double"
linkage = "four-bar"
sampling = { samples = 40 }
cases = [{ frame = 4, crank = 3, coupler = 1.2, rocker = 2.6, along = 1, across = 0.5 }, { frame = 2, crank = 3, coupler = 4.5, rocker = 2.2, along = 2 }]
[[family]]
id = "evans"
linkage = "evans"
sampling = { samples = 30, spacing = "smooth" }
cases = [{ p = 2, a = 2.59 }, { p = 3, a = 4.1 }]
place = { mirror = true, rotate = "30 deg" }
[[family]]
id = "actuator"
linkage = "linear-actuator"
sampling = { step = 0.05 }
cases = [{ g = 2, r = 0.75, e = 0.3 }]
[[family]]
id = "grid"
linkage = "hrones-nelson"
sampling = { step = "10 deg" }
cases = [{ A = 3, B = 3.5, C = 3 }]
"#;

/// The exported curves by their file names without endings, with the JSON of each.
fn export() -> (TempDir, BTreeMap<String, Json>) {
    let folder = folder_with(MANIFEST);
    printed(folder.path(), &["export", "--format", "csv,json,dxf,svg,moving-svg", "-o", "exported"]);
    let mut curves = BTreeMap::new();
    for entry in fs::read_dir(folder.path().join("exported")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "json") {
            let json = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
            curves.insert(path.file_stem().unwrap().to_string_lossy().into_owned(), json);
        }
    }
    assert!(curves.len() > 40, "{}", curves.len());
    (folder, curves)
}

fn is_closed(curve: &Json) -> bool {
    let circuit = curve["circuit"].as_u64().unwrap() as usize;
    curve["circuits"][circuit - 1]["closed"].as_bool().unwrap()
}

/// The values of a column of the samples.
fn column(curve: &Json, name: &str) -> Vec<f64> {
    let k = curve["columns"].as_array().unwrap().iter().position(|own| own == name).unwrap();
    curve["points"].as_array().unwrap().iter().map(|row| row[k].as_f64().unwrap()).collect()
}

fn samples(curve: &Json) -> Vec<Point> {
    column(curve, "x").into_iter().zip(column(curve, "y")).map(|(x, y)| Point::new(x, y)).collect()
}

/// The greatest distance of points from the polyline through others, which is closed or not.
fn distance(points: &[Point], polyline: &[Point], closed: bool) -> f64 {
    let mut polyline = polyline.to_vec();
    polyline.extend(closed.then(|| polyline[0]));
    let nearest = |p: &Point| {
        polyline.windows(2).map(|pair| distance_to_segment(*p, pair[0], pair[1])).fold(f64::INFINITY, f64::min)
    };
    points.iter().map(nearest).fold(0.0, f64::max)
}

fn extent(points: &[Point]) -> f64 {
    let side = |of: fn(&Point) -> f64| {
        points.iter().map(of).fold(f64::NEG_INFINITY, f64::max) - points.iter().map(of).fold(f64::INFINITY, f64::min)
    };
    side(|p| p.x).max(side(|p| p.y))
}

#[test]
fn tables_and_json_are_read_back_exactly() {
    let (folder, curves) = export();
    let (mut closed, mut open) = (0, 0);
    for (name, curve) in &curves {
        for extension in ["csv", "json"] {
            let bytes = fs::read(folder.path().join(format!("exported/{name}.{extension}"))).unwrap();
            let outline = read(&bytes).unwrap_or_else(|error| panic!("{name}.{extension}: {error}"));
            assert_eq!(outline.points, samples(curve), "{name}.{extension}");
            assert_eq!(outline.is_closed, Some(is_closed(curve)), "{name}.{extension}");
            if curve["family"] != "actuator" {
                assert_eq!(
                    read_timed(&bytes).unwrap().angles_deg,
                    Some(column(curve, "input_deg")),
                    "{name}.{extension}"
                );
            }
        }
        if is_closed(curve) { closed += 1 } else { open += 1 }
    }
    assert!(closed > 60 && open > 0, "{closed} closed and {open} open");
}

/// Drawings have the curve to the accuracy of their digits and chords; the samples are chords of it as well.
#[test]
#[ignore = "thorough"]
fn drawings_are_read_back() {
    let (folder, curves) = export();
    for (name, curve) in &curves {
        let samples = samples(curve);
        let extent = extent(&samples);
        for ending in [".dxf", ".svg", "-moving.svg"] {
            let bytes = fs::read(folder.path().join(format!("exported/{name}{ending}"))).unwrap();
            let outline = read(&bytes).unwrap_or_else(|error| panic!("{name}{ending}: {error}"));
            let Outline { points, is_closed: closed, reading, .. } = outline;
            assert!(reading.taken.contains("a curve of this program"), "{name}{ending}: {reading:?}");
            // A path along which the point goes to and fro is drawn once.
            let is_retraced =
                distance(&samples[..samples.len() / 2], &samples[samples.len() / 2..], false) < 1e-6 * extent;
            assert!(closed.is_some() == is_closed(curve) || is_retraced, "{name}{ending}");
            let off = distance(&samples, &points, closed.is_some());
            // A hundred chords of a curve with corners are up to a few thousandths from it.
            assert!(off < 1.5e-2 * extent, "{name}{ending}: {}", off / extent);
        }
    }
}

#[test]
fn the_program_says_what_it_has_read() {
    let (folder, curves) = export();
    let name = curves.keys().find(|name| name.starts_with("bars")).unwrap();
    let find = |arguments: &[&str]| {
        let mut command = program(folder.path());
        let quick = ["--index", "2000", "--no-refine", "--top", "1", "--json"];
        result(command.arg("find").args(arguments).args(quick).output().unwrap())
    };
    let (code, out, error) = find(&[&format!("exported/{name}.csv")]);
    assert_eq!(code, 0, "{error}");
    assert!(error.contains(&format!("note: exported/{name}.csv: x is column 7 `x`, y column 8 `y`")), "{error}");
    let json: Json = serde_json::from_str(&out).unwrap();
    assert!(
        json["target"]["closed"] == true && json["target"]["read"].as_str().unwrap().starts_with("x is column 7"),
        "{out}"
    );
    // What is printed can be read again, and has no outline to choose.
    fs::write(folder.path().join("found.json"), &out).unwrap();
    let (code, again, _) = find(&["found.json"]);
    let again: Json = serde_json::from_str(&again).unwrap();
    assert!(code == 0 && again["target"]["points"] == json["target"]["points"] && again["target"]["closed"] == true);
    let (code, _, error) = find(&["found.json", "--outline", "2"]);
    assert!(code == 2 && error.contains("JSON has only one path"), "{error}");
    let (code, _, error) = find(&[&format!("exported/{name}.svg"), "--outline", "99"]);
    assert!(code == 2 && error.contains("give a number from 1 to"), "{error}");
}

/// The curves of a table of several are chosen by their numbers.
#[test]
fn a_curve_of_points_csv_is_chosen() {
    let (folder, curves) = export();
    printed(folder.path(), &["render", "-q"]);
    let bytes = fs::read(folder.path().join("atlas/bars/points.csv")).unwrap();
    let error = read(&bytes).unwrap_err();
    assert!(error.contains("choose one, as in --outline 1") && error.contains("`1.1.1`"), "{error}");
    let (name, curve) = curves.iter().rfind(|(name, _)| name.starts_with("bars")).unwrap();
    let id = name.trim_start_matches("bars-").replace('-', ".");
    assert_eq!(super::choose(&bytes, &id).unwrap().points, samples(curve));
}

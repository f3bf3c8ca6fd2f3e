//! Manifests that are exported with their linkages in numbers make the same curves again.

use std::path::Path;

use crate::support::command::{folder_with, printed, run};
use crate::support::curve_rows::{distance_to_curve, rows};
use crate::support::plan::plan;

/// Families of the catalogue, of a linkage that is placed and has a range, and of drawings.
const MANIFEST: &str = r#"[atlas]
title = "T"
[[family]]
id = "evans"
linkage = "evans"
cases = [{ p = 2.5, a = 2.6 }, { p = 3, a = 3.2 }]
straight = { length = 0.5 }
dwell = { angle = "0.5 deg" }
[[family]]
id = "chebyshev"
linkage = "chebyshev"
cases = [{ p = 2.59, r = 2, k = 0.5 }]
[[family]]
id = "bars"
linkage = "hrones-nelson"
cases = [{ A = 3, B = 3.5, C = 3 }]
[[family]]
id = "leg"
linkage = "jansen"
cases = [{}]
[[family]]
id = "geared"
linkage = "geared-five-bar"
cases = [{}]
[[family]]
id = "slot"
linkage = "linear-actuator"
cases = [{ g = 2, r = 0.75, e = 0.3 }]
[[family]]
id = "inverted"
linkage = "inverted-slider-crank"
cases = [{}, { e = 0 }]
[[family]]
id = "placed"
linkage = "slider"
cases = [{ r = 1 }]
place = { mirror = true, rotate = "30 deg" }
[[family]]
id = "lift"
linkage = "lift"
cases = [{ lift = 0.25 }]
[[family]]
id = "bar"
linkage = "bar"
cases = [{}]
[[linkage]]
id = "slider"
parameters = { r = {} }
trace = ["M"]
input = { from = "20 deg", to = "200 deg" }
[linkage.joints]
O = { fixed = [0, 0] }
P = { fixed = [0, -1] }
Q = { fixed = [3, -0.4] }
A = { crank = "O", length = "r" }
B = { slide = "A", length = "3.3 * r", line = ["P", "Q"], offset = 0.3, side = "ahead" }
M = { point = ["A", "B"], along = 1.5, across = 1 }
[[linkage]]
id = "lift"
parameters = { lift = { default = 0 } }
trace = ["M"]
[linkage.drawing]
joints = { O = [0, 0], C = [4, 0], A = [0.6, 0.8], B = [3.4, "2.6 + lift"], M = [2.5, 3.4], N = [1, 1], E = [5, 1], F = [6, 0] }
frame = ["O", "C", "F"]
links = [["O", "A"], ["A", "B", "M", "N"], ["B", "C"], ["B", "E"], ["E", "F"]]
input = "O A"
[[linkage]]
id = "bar"
trace = ["M"]
[linkage.drawing]
joints = { O = [0, 0], C = [4, 0], A = [0.6, 0.8], D = [5, 0.5], M = [5, 2] }
frame = ["O", "C"]
links = [["O", "A"], ["C", "D", "M"]]
slides = { A = ["C", "D"] }
input = "O A"
"#;

/// Exports a curve as a manifest by itself, and writes it to a file.
fn export(folder: &Path, curve: &str, form: &str) -> String {
    let manifest = printed(folder, &["export", curve, "--format", "toml", "--form", form]);
    std::fs::write(folder.join("again.toml"), &manifest).unwrap();
    manifest
}

/// The same samples, to the last bit, from every kind of joint.
#[test]
fn joints_in_numbers_make_the_same_curves() {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    for curve in [
        "evans:2.1.1",
        "chebyshev:1.1.1",
        "bars:1.10.1",
        "leg:1.1.1",
        "geared:1.1.1",
        "slot:1.1.1",
        "placed:1.1.1",
        "lift:1.1.1",
        "bar:1.1.1",
    ] {
        let manifest = export(path, curve, "joints");
        let family = &plan(&manifest).families[0].family.id.clone();
        let numbers = curve.split_once(":").unwrap().1.split_once(".").unwrap().1;
        let expected = rows(path, &["export", curve]);
        let found = rows(path, &["export", "again.toml", &format!("{family}:1.{numbers}")]);
        assert_eq!(expected.len(), found.len(), "{curve}: {manifest}");
        for (a, b) in expected.iter().zip(&found) {
            assert!((0..3).all(|k| (a[k] - b[k]).abs() < 1e-9), "{curve}: {a:?} {b:?}: {manifest}");
        }
        assert!(!manifest.contains("parameters") && !manifest.contains("[linkage.drawing]"), "{manifest}");
    }
}

#[test]
fn drawings_make_the_same_curves() {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    for curve in [
        "evans:1.1.1",
        "evans:2.1.1",
        "chebyshev:1.1.1",
        "bars:1.10.1",
        "leg:1.1.1",
        "placed:1.1.1",
        "lift:1.1.1",
        "bar:1.1.1",
        "inverted:1.1.1",
        "inverted:2.1.1",
    ] {
        let manifest = export(path, curve, "drawing");
        let expected = rows(path, &["export", curve]);
        // The input of a linkage that is placed is measured in its drawing.
        let is_placed = curve.starts_with("placed");
        let placed = |[input, x, y]: [f64; 3]| [if is_placed { 30.0 - input } else { input }, x, y];
        let distance = distance_to_curve(&manifest, expected.into_iter().map(placed));
        assert!(distance < 1e-9, "{curve}: {distance}: {manifest}");
        assert!(!manifest.contains("[linkage.joints]") && !manifest.contains("place ="), "{manifest}");
    }
    let (code, out, err) = run(path, &["export", "geared:1.1.1", "--format", "toml", "--form", "drawing"]);
    let words = ["geared:1.1.1: a drawing has no gear, which `", "--form joints"];
    assert!(code == 2 && out.is_empty() && words.iter().all(|words| err.contains(words)), "{err}");
    let (code, _, err) = run(path, &["export", "slot:1.1.1", "--format", "toml", "--form", "drawing"]);
    assert!(code == 2 && err.contains("a drawing has no actuator with an offset, which `A` needs"), "{err}");
    let (code, _, err) = run(path, &["export", "evans:1", "--form", "drawing"]);
    assert!(code == 2 && err.contains("--form drawing is for manifests: add --format toml"), "{err}");
    let (code, _, err) = run(path, &["export", "evans:1", "--format", "toml", "--form", "links"]);
    assert!(code == 2 && err.contains("joints"), "{err}");
}

/// Several cells are several families with linkages of their own; in a drawing, each circuit is one.
#[test]
fn several_cells_are_in_one_manifest() {
    let folder = folder_with(MANIFEST);
    let path = folder.path();
    for (form, words) in [("joints", ["evans", "chebyshev"]), ("drawing", ["evans", "lift"])] {
        let text = printed(path, &[&["export"][..], &words, &["--format", "toml", "--form", form]].concat());
        let plan = plan(&text);
        let ids: Vec<&str> = plan.families.iter().map(|planned| planned.family.id.as_str()).collect();
        assert_eq!(ids[..2], ["evans-exported", "evans-exported-2"], "{text}");
        assert!(ids.len() >= 3 && text.contains("# evans:2.1.1"), "{text}");
        assert!(text.contains("straight = { length = 0.5 }\ndwell = { angle = \"0.5 deg\" }"), "{text}");
    }
}

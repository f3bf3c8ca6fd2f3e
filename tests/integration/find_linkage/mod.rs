//! `find --linkage`: curves of linkages with random dimensions are found again, wherever they are.

use std::fs;
use std::sync::atomic::AtomicBool;

use coupler_atlas::find::find_linkage;
use coupler_curves::catalogue;
use coupler_curves::family::{Family, Sampling};
use coupler_curves::geometry::{Point, trig};
use coupler_curves::measure::MeasureSet;
use coupler_curves::solve::Solver;
use coupler_find::{Effort, LinkageSpace, Options, PathKind, Target};
use serde_json::Value as Json;
use tempfile::TempDir;

pub mod random_curves;
mod several;

use random_curves::{Random, answers, deviations, placed, random_curve, search};

use crate::support::command::{folder_with, printed, run};
use crate::support::table::{numbers, rows};

#[test]
fn the_part_that_is_done_rises_to_all_of_it() {
    let mut random = Random(5);
    let template = catalogue::find("slider-crank").unwrap();
    let (points, _) = random_curve(&template, true, &mut random, 60);
    let target = Target::new(&points, PathKind::Closed).unwrap();
    let space = LinkageSpace::new(template, &[]).unwrap();
    let mut parts = Vec::new();
    let never = AtomicBool::new(false);
    find_linkage(&space, &target, &Options::default(), Some(300), &never, |part| parts.push(part)).unwrap();
    assert!(parts.len() > 10 && parts.is_sorted(), "{parts:?}");
    assert!(parts[0] > 0.0 && parts[0] < 0.5 && parts[parts.len() - 1] <= 1.0, "{parts:?}");
}

#[test]
#[ignore = "thorough"]
fn random_curves_of_built_in_linkages_are_found() {
    let options = Options { effort: Effort::Quick, ..Options::default() };
    for (name, full_turn) in [
        ("slider-crank", true),
        ("inverted-slider-crank", true),
        ("evans", true),
        ("chebyshev", true),
        ("roberts", false),
        ("watt", false),
        ("scotch-yoke", true),
        ("linear-actuator", false),
    ] {
        let all = deviations(name, full_turn, 2, &options);
        assert!(all.iter().all(|rms| *rms < 1e-3), "{name}: {all:?}");
    }
    for name in ["geared-five-bar", "watt-six-bar", "stephenson-six-bar", "klann"] {
        let all = deviations(name, true, 1, &options);
        assert!(all.iter().all(|rms| *rms < 2e-3), "{name}: {all:?}");
    }
}

/// Angle, size, place, reflection, direction and start of the path do not change how near the linkage comes.
#[test]
#[ignore = "thorough"]
fn the_answer_does_not_depend_on_how_the_path_is_placed() {
    let template = catalogue::find("slider-crank").unwrap();
    let points = random_curve(&template, true, &mut Random(3), 60).0;
    // A path that is no curve of the linkage.
    let bent: Vec<Point> =
        points.iter().enumerate().map(|(k, p)| Point::new(p.x + 0.1 * trig::sin(0.4 * k as f64), p.y)).collect();
    let options = Options { effort: Effort::Quick, most: 1, ..Options::default() };
    let rms = |points: &[Point]| search(&template, points, &options)[0].curve.fit.deviation.rms_relative;
    let own = rms(&bent);
    assert!(own > 1e-3, "{own}");
    let mut random = Random(8);
    let mut turned = placed(&bent, &mut random);
    turned.rotate_left(23);
    let reversed: Vec<Point> = turned.iter().rev().copied().collect();
    for other in [rms(&turned), rms(&reversed)] {
        assert!((other - own).abs() < 1e-5 * own, "{own} {other}");
    }
}

#[test]
fn a_timed_path_is_met_at_its_inputs_and_a_part_where_it_is() {
    let template = catalogue::find("slider-crank").unwrap();
    let given = [("crank", 1.0), ("coupler", 2.6), ("offset", 0.4), ("along", 1.7), ("across", 0.9)];
    let given: Vec<(String, f64)> = given.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let family = Family::single_cell(template.clone(), &given, Sampling::Samples(72)).unwrap();
    let solved = Solver::new(&family).measuring(MeasureSet::EMPTY).solve(0).unwrap();
    let circuit = solved.circuit(&solved.curves[0]);
    let points = placed(&circuit.points(solved.curves[0].joint).collect::<Vec<_>>(), &mut Random(5));
    let space = LinkageSpace::new(template, &[]).unwrap();
    let options = Options { effort: Effort::Quick, most: 1, ..Options::default() };
    // In the opposite direction, from any zero.
    let angles: Vec<f64> = circuit.inputs.iter().map(|input| 40.0 - input).collect();
    let target = Target::timed(&points, PathKind::Closed, &angles).unwrap();
    let answer = &answers(&space, &target, &options)[0];
    assert!(answer.curve.fit.deviation.rms_relative < 1e-6, "{:?}", answer.curve.fit);
    let [from, to] = answer.inputs;
    assert!(((from - to).abs() - 355.0).abs() < 1e-6, "{from} {to}");
    // The same points at other times are no motion of the linkage.
    let angles: Vec<f64> = circuit.inputs.iter().map(|input| input + 25.0 * trig::sin(input.to_radians())).collect();
    let target = Target::timed(&points, PathKind::Closed, &angles).unwrap();
    let other = answers(&space, &target, &options);
    assert!(other.first().is_none_or(|answer| answer.curve.fit.deviation.rms_relative > 1e-3), "{other:?}");
    let part = Target::new(&points[10..45], PathKind::Part).unwrap();
    let answer = &answers(&space, &part, &options)[0];
    assert!(
        answer.curve.fit.deviation.rms_relative < 1e-3 && (answer.curve.fit.deviation.length_ratio - 1.0).abs() < 0.01
    );
}

const OWN: &str = r#"
[[linkage]]
id = "my-slider"
parameters = { r = { default = 1, min = 0 }, l = { default = 3, min = 0 }, u = { default = "l / 2" }, v = { default = 0.5 } }
trace = ["M"]

[linkage.joints]
O = { fixed = [0, 0] }
X = { fixed = [1, 0] }
A = { crank = "O", length = "r" }
B = { slide = "A", length = "l", line = ["O", "X"], offset = 0, side = "ahead" }
M = { point = ["A", "B"], along = "u", across = "v" }
"#;

/// A folder with a path, a curve of no slider-crank nearly like one, and a linkage of its own.
fn folder() -> TempDir {
    let folder = folder_with(&format!("[atlas]\ntitle = \"mine\"\n{OWN}"));
    let rows: String = (0..60)
        .map(|k| std::f64::consts::TAU * f64::from(k) / 60.0)
        .map(|t| {
            format!(
                "{},{}\n",
                40.0 + 20.0 * trig::cos(t) + 3.0 * trig::sin(2.0 * t),
                -7.0 + 9.0 * trig::sin(t) + 2.0 * trig::cos(2.0 * t)
            )
        })
        .collect();
    fs::write(folder.path().join("path.csv"), rows).unwrap();
    folder
}

/// The root of the mean square of the distances of points from a dense closed polyline, with a parabola through the nearest three of its
/// points.
fn rms_from(points: &[[f64; 2]], curve: &[[f64; 2]]) -> f64 {
    let square = |p: &[f64; 2], q: &[f64; 2]| (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
    let nearest = |p: &[f64; 2]| {
        let count = curve.len();
        let k = (0..count).min_by(|a, b| square(p, &curve[*a]).total_cmp(&square(p, &curve[*b]))).unwrap();
        let [a, b, c] = [count - 1, 0, 1].map(|by| curve[(k + by) % count]);
        let at = |u: f64| [0, 1].map(|n| b[n] + 0.5 * u * (c[n] - a[n]) + 0.5 * u * u * (c[n] - 2.0 * b[n] + a[n]));
        let (mut low, mut high) = (-1.0, 1.0);
        for _ in 0..200 {
            let [x, y] = [low + (high - low) * 0.4, low + (high - low) * 0.6];
            if square(p, &at(x)) < square(p, &at(y)) { high = y } else { low = x }
        }
        square(p, &at(0.5 * (low + high)))
    };
    (points.iter().map(nearest).sum::<f64>() / points.len() as f64).sqrt()
}

#[test]
#[ignore = "thorough"]
fn the_manifest_renders_the_linkages_and_reproduces_the_deviation() {
    let folder = folder();
    for (linkage, more) in [("slider-crank", &[][..]), ("my-slider", &["--manifest", "atlas.toml"][..])] {
        let args =
            [&["find", "path.csv", "--closed", "--linkage", linkage, "--effort", "quick", "--top", "2"], more].concat();
        let json: Json = serde_json::from_str(&printed(folder.path(), &[&args[..], &["--json"]].concat())).unwrap();
        let manifest = printed(folder.path(), &[&args[..], &["--toml"]].concat());
        fs::write(folder.path().join("found.toml"), manifest.replace("samples = 360", "samples = 20000")).unwrap();
        printed(folder.path(), &["validate", "found.toml"]);
        for (k, suffix) in ["", "-2"].iter().enumerate() {
            let result = &json["results"][k];
            let name = format!("{linkage}-exported{suffix}:1.1.1");
            let csv = printed(folder.path(), &["export", "found.toml", &name, "--format", "csv"]);
            let shift = [0, 1].map(|axis| result["placement"]["shift"][axis].as_f64().unwrap());
            // The comments of the manifest have it with all digits.
            assert!(manifest.contains(&format!("shifted by ({}, {})", shift[0], shift[1])), "{manifest}");
            let points = rows(&csv).into_iter().map(|row| numbers(&row, ["x", "y"]));
            let curve: Vec<[f64; 2]> = points.map(|[x, y]| [x + shift[0], y + shift[1]]).collect();
            let points: Vec<[f64; 2]> = json["target"]["points"]
                .as_array()
                .unwrap()
                .iter()
                .map(|p| [0, 1].map(|k| p[k].as_f64().unwrap()))
                .collect();
            let (own, again) = (result["rms"].as_f64().unwrap(), rms_from(&points, &curve));
            // Without regard to the order of the points the distances are not greater.
            let is_in_order = result["in_order"].as_bool().unwrap();
            assert!(again < own * (1.0 + 1e-9), "{linkage} {k}: {own} {again}");
            assert!(!is_in_order || again > own * (1.0 - 1e-9), "{linkage} {k}: {own} {again}");
            assert!(is_in_order || k > 0, "{result}");
        }
    }
}

#[test]
#[ignore = "thorough"]
fn the_answer_is_the_same_for_any_number_of_threads() {
    let folder = folder();
    let args = ["find", "path.csv", "--linkage", "watt-six-bar", "--effort", "quick", "--index", "1500", "--json"];
    let [one, three] = ["1", "3"].map(|jobs| printed(folder.path(), &[&args[..], &["-j", jobs]].concat()));
    assert_eq!(one, three);
    let svg =
        printed(folder.path(), &["find", "path.csv", "--linkage", "slider-crank", "--index", "500", "--svg", "-"]);
    assert!(svg.contains("crank = "));
}

#[test]
#[ignore = "thorough"]
fn constraints_hold_and_the_nearest_miss_names_what_to_relax() {
    let folder = folder();
    let find = |more: &[&str]| -> Json {
        let args = ["find", "path.csv", "--linkage", "slider-crank", "--json", "--effort", "quick", "--index", "1000"];
        serde_json::from_str(&printed(folder.path(), &[&args[..], more].concat())).unwrap()
    };
    let free = find(&[]);
    let pivot = |result: &Json| [0, 1].map(|axis| result["pivots"]["O"][axis].as_f64().unwrap());
    let first = &free["results"][0];
    // A box beside the pivot of the best.
    let [x, y] = pivot(first);
    let corners = format!("--pivots={},{},{},{}", x + 2.0, y - 30.0, x + 40.0, y + 30.0);
    let boxed = find(&[&corners, "--top", "3"]);
    for result in boxed["results"].as_array().unwrap() {
        let [px, py] = pivot(result);
        assert!(px >= x + 2.0 && px <= x + 40.0 && (py - y).abs() <= 30.0, "{result}");
    }
    assert!(!boxed["results"].as_array().unwrap().is_empty());
    let short = find(&["--max-link", "1.9"]);
    let size = short["target"]["size"].as_f64().unwrap();
    let longest = |result: &Json| result["longest_link"].as_f64().unwrap() / size;
    assert!(short["results"].as_array().unwrap().iter().all(|result| longest(result) <= 1.9), "{short}");
    let kept = find(&["--keep", "offset", "--keep", "coupler=3*crank", "--top", "1"]);
    let parameter = |name: &str| kept["results"][0]["parameters"][name].as_f64().unwrap();
    assert_eq!(parameter("offset"), 0.0);
    assert!((parameter("coupler") - 3.0 * parameter("crank")).abs() < 1e-9);
    assert_eq!(kept["searched"].to_string(), r#"["crank","along","across"]"#);
    let condition = find(&["--where", "across > 0 and mu_worst_deg > 20", "--top", "2"]);
    for result in condition["results"].as_array().unwrap() {
        assert!(result["parameters"]["across"].as_f64() > Some(0.0) && result["mu_worst_deg"].as_f64() > Some(20.0));
    }
    let none = find(&["--where", "crank > coupler"]);
    assert_eq!((none["results"].as_array().unwrap().len(), &none["nearest_miss"]["relax"][0]), (0, &"--where".into()));
    let text = printed(
        folder.path(),
        &["find", "path.csv", "--linkage", "slider-crank", "--where", "crank > 1e9", "--index", "500"],
    );
    assert!(text.contains("another --where"), "{text}");
    // The search of four-bars is the stronger one.
    let four_bar = ["find", "path.csv", "--effort", "quick", "--top", "1"];
    assert_eq!(
        printed(folder.path(), &[&four_bar[..], &["--linkage", "four-bar"]].concat()),
        printed(folder.path(), &four_bar)
    );
}

#[test]
fn errors_name_what_is_wrong_and_what_to_do() {
    let folder = folder();
    let error = |args: &[&str]| {
        let (code, _, stderr) = run(folder.path(), &[&["find", "path.csv"], args].concat());
        assert_eq!(code, 2, "{args:?}");
        stderr
    };
    assert!(error(&["--linkage", "slidr-crank"]).contains("did you mean `slider-crank`?"));
    assert!(error(&["--linkage", "my-slidr", "--manifest", "atlas.toml"]).contains("did you mean `my-slider`?"));
    assert!(error(&["--linkage", "my-slider"]).contains("there is no linkage `my-slider`"));
    assert!(error(&["--linkage", "evans", "--atlas", "atlas.toml"]).contains("cannot be used with"));
    assert!(error(&["--linkage", "evans", "--fixed"]).contains("--fixed"));
    assert!(error(&["--keep", "s"]).contains("--linkage"));
    assert!(error(&["--manifest", "atlas.toml"]).contains("--linkage NAME"));
    assert!(error(&["--linkage", "linear-actuator", "--timed"]).contains("is a length"));
    assert!(
        error(&["--linkage", "evans", "--index", "2000000"]).contains("parameter sets: give one from 1 to 1000000")
    );
    assert!(error(&["--linkage", "evans", "--where", "crank > 1"]).contains("--where"));
    let all = error(&["--linkage", "evans", "--keep", "q", "--keep", "p", "--keep", "k=two", "--keep", "r=-1"]);
    for part in ["no parameter `q`", "`p` has no default", "`two`", "`r` is -1"] {
        assert!(all.contains(part), "{part}: {all}");
    }
    let all = ["--keep", "p=2", "--keep", "r", "--keep", "a=3", "--keep", "s", "--keep", "k"];
    assert!(error(&[&["--linkage", "evans"], &all[..]].concat()).contains("all are kept"));
    fs::write(folder.path().join("none.toml"), OWN.replace("trace = [\"M\"]", "trace = []")).unwrap();
    assert!(error(&["--linkage", "my-slider", "--manifest", "none.toml"]).contains("trace"));
    fs::write(
        folder.path().join("none.toml"),
        OWN.replace("parameters = ", "caption = \"none\"\nlegend = \"\" # ")
            .replace("\"r\"", "1")
            .replace("\"l\"", "3")
            .replace("\"u\"", "2")
            .replace("\"v\"", "1"),
    )
    .unwrap();
    assert!(error(&["--linkage", "my-slider", "--manifest", "none.toml"]).contains("no parameter to vary"));
}

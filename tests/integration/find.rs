//! `find`: what it prints is evaluated by formulas of its own.

use std::f64::consts::TAU;
use std::fs;
use std::io::Write as _;
use std::process::Stdio;

use coupler_curves::geometry::trig;
use serde_json::Value as Json;
use tempfile::TempDir;

use crate::support::command::{folder_with, printed, program, result, run};
use crate::support::table::{numbers, rows};

type Point = [f64; 2];

/// A path of a four-bar's coupler point, roughly: ten points of a bean, with a comment and a header.
const BEAN: &str = "# a bean\nx,y\n0,0\n3,1\n6,1\n8,-1\n8,-4\n6,-5\n4,-4\n2,-4\n0,-5\n-1.5,-3\n";

fn folder_with_bean() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("bean.csv"), BEAN).unwrap();
    folder
}

fn bean() -> Vec<Point> {
    let row =
        |line: &str| line.split(',').map(|field| field.parse().unwrap()).collect::<Vec<f64>>().try_into().unwrap();
    BEAN.lines().skip(2).map(row).collect()
}

fn distance(a: Point, b: Point) -> f64 {
    ((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])).sqrt()
}

fn number(value: &Json) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

fn pair(value: &Json) -> Point {
    [number(&value[0]), number(&value[1])]
}

/// The curve of a linkage of the JSON whose crank turns fully, as points at equal angles of the crank from `input_deg[0]` on, in the
/// direction of the path.
fn curve(linkage: &Json, count: usize) -> Vec<Point> {
    let [o, c] = [&linkage["crank_pivot"], &linkage["rocker_pivot"]].map(pair);
    let length = |name: &str| number(&linkage["parameters"][name]);
    assert!((distance(o, c) - length("frame")).abs() < 1e-9 * length("frame"));
    let side = if linkage["side"] == "left" { 1.0 } else { -1.0 };
    let sign = if linkage["direction"] == "forward" { 1.0 } else { -1.0 };
    let point = |k: usize| {
        let angle = number(&linkage["input_deg"][0]) * TAU / 360.0 + sign * TAU * k as f64 / count as f64;
        let a = [o[0] + length("crank") * trig::cos(angle), o[1] + length("crank") * trig::sin(angle)];
        let to = [c[0] - a[0], c[1] - a[1]];
        let reach = distance(a, c);
        let (b, r) = (length("coupler"), length("rocker"));
        let along = (b * b - r * r + reach * reach) / (2.0 * reach);
        let across = side * (b * b - along * along).max(0.0).sqrt();
        // The direction of the coupler, then the coupler point.
        let unit = [(to[0] * along - to[1] * across) / (reach * b), (to[1] * along + to[0] * across) / (reach * b)];
        let (u, v) = (length("along"), length("across"));
        [a[0] + u * unit[0] - v * unit[1], a[1] + u * unit[1] + v * unit[0]]
    };
    (0..count).map(point).collect()
}

/// The distance of a point from a closed polyline.
fn distance_from(curve: &[Point], p: Point) -> f64 {
    let segment = |k: usize| {
        let (a, b) = (curve[k], curve[(k + 1) % curve.len()]);
        let (d, to) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
        let part = ((to[0] * d[0] + to[1] * d[1]) / (d[0] * d[0] + d[1] * d[1])).clamp(0.0, 1.0);
        distance([a[0] + part * d[0], a[1] + part * d[1]], p)
    };
    (0..curve.len()).map(segment).fold(f64::INFINITY, f64::min)
}

fn rms(points: &[Point], curve: &[Point]) -> f64 {
    let squares = points.iter().map(|p| distance_from(curve, *p)).map(|d| d * d);
    (squares.sum::<f64>() / points.len() as f64).sqrt()
}

fn json(folder: &TempDir, arguments: &[&str]) -> Json {
    serde_json::from_str(&printed(folder.path(), &[&["find"], arguments, &["--json"]].concat())).unwrap()
}

#[test]
fn the_json_describes_the_curves() {
    let folder = folder_with_bean();
    let found = json(&folder, &["bean.csv"]);
    assert_eq!(found["target"]["points"].as_array().unwrap().len(), 10);
    assert_eq!(found["target"]["closed"], true);
    let results = found["results"].as_array().unwrap();
    assert!(!results.is_empty());
    let mut last = 0.0;
    for (rank, result) in (1..).zip(results) {
        assert_eq!(result["rank"], rank);
        assert!(number(&result["rms"]) >= last);
        last = number(&result["rms"]);
        assert!((last / number(&found["target"]["size"]) - number(&result["rms_relative"])).abs() < 1e-12);
        assert!(result["full_turn"] == true && result["meets_constraints"] == true);
        let span = number(&result["input_deg"][1]) - number(&result["input_deg"][0]);
        assert!(
            span.abs() > 180.0 && span.abs() < 360.0 && (span > 0.0) == (result["direction"] == "forward"),
            "{result}"
        );
        let own = curve(result, 20_000);
        if result["in_order"] == true {
            assert!((rms(&bean(), &own) - last).abs() < 1e-6, "{}", rms(&bean(), &own));
        }
        // The side is that at the first point of the path.
        assert!(distance(own[0], bean()[0]) <= number(&result["max"]) + 1e-6);
        let cognates = result["cognates"].as_array().unwrap();
        assert_eq!(cognates.len(), 2);
        for cognate in cognates.iter().filter(|cognate| cognate["full_turn"] == true) {
            let other = curve(cognate, 500);
            assert!(other.iter().all(|p| distance_from(&own, *p) < 1e-5), "{cognate}");
        }
    }
}

/// The manifest that is printed has the curves where they are on the path.
#[test]
fn the_manifest_reproduces_the_deviation() {
    let folder = folder_with_bean();
    let found = json(&folder, &["bean.csv", "--top", "3"]);
    let manifest = printed(folder.path(), &["find", "bean.csv", "--top", "3", "--toml"]);
    fs::write(folder.path().join("found.toml"), &manifest).unwrap();
    assert_eq!(run(folder.path(), &["render", "found.toml", "--quiet"]).0, 0);
    let mut deviations: Vec<f64> = Vec::new();
    for form in ["left", "right"] {
        let Ok(table) = fs::read_to_string(folder.path().join(format!("found/found-{form}/points.csv"))) else {
            continue;
        };
        let mut cells: Vec<Vec<Point>> = Vec::new();
        for row in rows(&table) {
            let cell: usize = row["cell"].parse().unwrap();
            cells.resize(cells.len().max(cell), Vec::new());
            cells[cell - 1].push(numbers(&row, ["x", "y"]));
        }
        deviations.extend(cells.iter().map(|cell| rms(&bean(), cell)));
    }
    deviations.sort_by(f64::total_cmp);
    let results = found["results"].as_array().unwrap();
    assert_eq!(deviations.len(), results.len(), "{manifest}");
    for (deviation, result) in deviations.iter().zip(results) {
        // The samples of points.csv are chords of the curve.
        assert!((deviation - number(&result["rms"])).abs() < 2e-3, "{deviation} {result}");
    }
}

#[test]
fn the_answer_does_not_depend_on_threads_or_the_cache() {
    let folder = folder_with_bean();
    let with = |arguments: &[&str], cache: &str| {
        let mut command = program(folder.path());
        command.args(["find", "bean.csv", "--index", "3000", "--effort", "quick"]).args(arguments);
        let (code, out, err) = result(command.env("XDG_CACHE_HOME", folder.path().join(cache)).output().unwrap());
        assert_eq!(
            (code, err.as_str()),
            (
                0,
                "note: bean.csv: x is column 1 `x`, y column 2 `y`; closed, for its ends are near, which is not certain: it may be open\n"
            )
        );
        out
    };
    let first = with(&["-j", "1"], "cache");
    assert!(fs::read_dir(folder.path().join("cache/coupler-atlas")).unwrap().count() == 1);
    assert_eq!(with(&["-j", "2"], "cache"), first);
    assert_eq!(with(&["-j", "3"], "other"), first);
    // No folder can be made in a file.
    assert_eq!(with(&[], "bean.csv"), first);
    assert_ne!(with(&["--no-refine"], "cache"), first);
}

#[test]
fn a_curve_of_an_atlas_is_found_again() {
    let folder = folder_with(
        "[atlas]\ntitle = \"a\"\n[[family]]\nid = \"bars\"\nlinkage = \"four-bar\"\n\
         cases = [{ frame = 4, crank = 1.5, coupler = 3, rocker = 3.5, along = 1, across = 2 },\n\
         { frame = 4, crank = 3, coupler = 3, rocker = 3.5 }]\n",
    );
    let found = json(&folder, &["--like", "bars:1.1.2"]);
    let first = &found["results"][0];
    assert!(first["quality"] == "exact" && number(&first["rms_relative"]) < 1e-6, "{first}");
    let four_bars = || std::iter::once(first).chain(first["cognates"].as_array().unwrap());
    let is_own = |bar: &Json| (number(&bar["parameters"]["crank"]) - 1.5).abs() < 1e-6 && bar["side"] == "right";
    assert!(four_bars().any(is_own), "{first}");
    let (code, _, error) = run(folder.path(), &["find", "--like", "bars:1"]);
    assert!(code == 2 && error.contains("bars:1 has 2 curves: name one"), "{error}");
    assert_eq!(run(folder.path(), &["find", "--like", "bars:9.1.1"]).0, 2);
}

#[test]
fn a_path_is_closed_open_or_a_part() {
    let folder = folder_with_bean();
    fs::write(folder.path().join("hook.csv"), "0,0\n1,0.2\n2,0.2\n3,-0.1\n3.8,-0.8\n4,-1.7\n3.6,-2.4\n").unwrap();
    let kind = |arguments: &[&str]| {
        let found = json(&folder, &[arguments, &["--effort", "quick", "--top", "1"]].concat());
        let first = &found["results"][0];
        let ratio = number(&first["length_ratio"]);
        assert!(found["target"]["kind"] == "open" || (0.87..=1.15).contains(&ratio), "{found}");
        assert!(number(&first["rms_relative"]) < 0.02, "{first}");
        found["target"]["kind"].as_str().unwrap().to_owned()
    };
    assert_eq!(kind(&["bean.csv"]), "closed");
    assert_eq!(kind(&["bean.csv", "--open"]), "open");
    assert_eq!(kind(&["hook.csv"]), "open");
    assert_eq!(kind(&["hook.csv", "--part"]), "part");
    let (code, _, error) = run(folder.path(), &["find", "hook.csv", "--part", "--open"]);
    assert!(code == 2 && error.contains("--part"), "{error}");
}

#[test]
fn timed_paths_are_reached_at_the_angles_of_the_crank() {
    let folder = folder_with_bean();
    // A crank-rocker at uneven inputs, by the intersection of two circles.
    let point = |degrees: f64| {
        let (a, c) = ([trig::cos(trig::radians(degrees)), trig::sin(trig::radians(degrees))], [3.0, 0.0]);
        let (dx, dy) = (c[0] - a[0], c[1] - a[1]);
        let distance = trig::hypot(dx, dy);
        let along = (distance * distance + 3.0 * 3.0 - 2.5 * 2.5) / (2.0 * distance);
        let across = (9.0 - along * along).sqrt();
        let unit = [(dx * along - dy * across) / (3.0 * distance), (dy * along + dx * across) / (3.0 * distance)];
        [a[0] + 1.5 * unit[0] - unit[1], a[1] + 1.5 * unit[1] + unit[0]]
    };
    let angles: Vec<f64> = (0..36).map(|k| 10.0 * f64::from(k) + 3.0 * trig::sin(f64::from(k))).collect();
    let rows = angles.iter().map(|angle| (point(*angle), 77.0 - angle));
    let table: String = rows.map(|([x, y], angle)| format!("{x},{y},{angle}\n")).collect();
    fs::write(folder.path().join("timed.csv"), &table).unwrap();
    let found = json(&folder, &["timed.csv", "--timed", "--top", "1"]);
    let first = &found["results"][0];
    assert!(number(&first["rms_relative"]) < 1e-6, "{first}");
    assert_eq!(found["target"]["angles_deg"].as_array().unwrap().len(), 36);
    let turned = (number(&first["input_deg"][1]) - number(&first["input_deg"][0])).abs();
    assert!((turned - (angles[35] - angles[0])).abs() < 1e-4, "{turned}");
    // Without angles a closed path has equal steps, which this one does not take.
    let untimed: String = table.lines().map(|line| line.rsplit_once(',').unwrap().0.to_owned() + "\n").collect();
    fs::write(folder.path().join("even.csv"), untimed).unwrap();
    let found = json(&folder, &["even.csv", "--timed", "--closed", "--top", "1"]);
    assert!(number(&found["results"][0]["rms_relative"]) > 1e-3, "{found}");
    let (code, text, _) = run(folder.path(), &["find", "even.csv", "--timed", "--closed", "--effort", "quick"]);
    assert!(code == 0 && text.starts_with("even.csv: 36 points, closed, timed"), "{text}");
    let (code, _, error) = run(folder.path(), &["find", "even.csv", "--timed", "--open"]);
    assert!(code == 2 && error.contains("--timed needs an angle"), "{error}");
    fs::write(folder.path().join("still.csv"), with_one_angle(&table)).unwrap();
    let (code, _, error) = run(folder.path(), &["find", "still.csv", "--timed"]);
    assert!(code == 2 && error.contains("the crank does not move"), "{error}");
}

/// A table with one angle for all points.
fn with_one_angle(table: &str) -> String {
    table.lines().map(|line| format!("{},30\n", line.rsplit_once(',').unwrap().0)).collect()
}

#[test]
#[ignore = "thorough"]
fn constraints_are_kept_or_named() {
    let folder = folder_with_bean();
    let found = json(&folder, &["bean.csv", "--where", "mu_worst_deg >= 35 and is_crank_rocker", "--max-link", "5"]);
    let results = found["results"].as_array().unwrap();
    assert!(!results.is_empty());
    for result in results {
        assert!(number(&result["mu_worst_deg"]) >= 35.0 && result["class"] == "crank-rocker", "{result}");
        assert!(number(&result["longest_link"]) <= 5.0 * number(&found["target"]["size"]) * (1.0 + 1e-9));
    }
    let (code, text, _) = run(folder.path(), &["find", "bean.csv", "--pivots", "500,500,501,501", "--effort", "quick"]);
    assert_eq!(code, 0);
    assert!(text.contains("no linkage meets the constraints") && text.contains("--pivots"), "{text}");
    let found = json(&folder, &["bean.csv", "--pivots", "500,500,501,501", "--effort", "quick"]);
    assert!(found["results"].as_array().unwrap().is_empty());
    assert_eq!(found["nearest_miss"]["relax"], serde_json::json!(["--pivots"]));
}

#[test]
fn every_mistake_is_named() {
    let folder = folder_with_bean();
    let wrong = ["find", "bean.csv", "--where", "mu_wrst > 3", "--max-link", "-1", "--pivots", "1,2,3", "--fixed"];
    let (code, _, error) = run(folder.path(), &wrong);
    assert_eq!(code, 2);
    for option in ["--where", "--max-link -1: give a positive number", "--pivots", "--fixed compares"] {
        assert!(error.contains(option), "{error}");
    }
    for (text, expected) in [
        ("", "needs at least 5 distinct points, and has 0"),
        ("1,2\n3,4\n", "has 2: through fewer pass the curves of infinitely many four-bars"),
        ("1,2\nx,4\n1,NaN\n", "line 2: `x` is not a number"),
        ("1,2\nx,4\n1,NaN\n", "line 3: `NaN` is NaN"),
        ("<svg><text/></svg>", "the drawing has no path"),
        ("{\"points\": 3}", "no list of points"),
    ] {
        fs::write(folder.path().join("path"), text).unwrap();
        let (code, out, error) = run(folder.path(), &["find", "path"]);
        assert!(code == 2 && out.is_empty() && error.contains(expected), "{text}: {error}");
    }
    fs::write(folder.path().join("path"), "x,y,angle\n0,0,0\n2,0,40\n3,1,80\n2,3,120\n0,2,170\n").unwrap();
    let quick = ["find", "path", "--index", "200", "--effort", "quick"];
    let (code, _, error) = run(folder.path(), &quick);
    assert!(code == 0 && error.contains("the angles in path are not used"), "{error}");
    let (code, _, error) = run(folder.path(), &[&quick[..], &["--timed"]].concat());
    assert!(code == 0 && !error.contains("are not used"), "{error}");
    let (code, _, error) = run(folder.path(), &["find", "missing.csv"]);
    assert!(code == 2 && error.contains("missing.csv"), "{error}");
    // The path is not overwritten.
    let (code, _, error) = run(folder.path(), &["find", "bean.csv", "--svg", "bean.csv", "--effort", "quick"]);
    assert!(code == 2 && fs::read_to_string(folder.path().join("bean.csv")).unwrap() == BEAN, "{error}");
}

#[test]
fn a_drawing_is_read_and_drawn() {
    let folder = TempDir::new().unwrap();
    let drawing = "<svg xmlns='http://www.w3.org/2000/svg'><path d='M0 0C30 -60 90 -10 60 30S-20 40 0 0z'/></svg>";
    let mut command = program(folder.path());
    command.args(["find", "-", "--svg", "found.svg", "--top", "2"]).stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(drawing.as_bytes()).unwrap();
    let (code, text, _) = result(child.wait_with_output().unwrap());
    assert!(code == 0 && text.starts_with("standard input: 100 points, closed"), "{text}");
    let page = fs::read_to_string(folder.path().join("found.svg")).unwrap();
    let page = roxmltree::Document::parse(&page).unwrap();
    let group = |class: &str| page.descendants().filter(|node| node.attribute("class") == Some(class)).count();
    assert!(group("target") == 1 && group("found") >= 1 && group("linkage") == 1);
}

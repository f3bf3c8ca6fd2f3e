//! `find --function`: what it prints, draws and renders is evaluated by formulas of its own.

use std::fs;

use coupler_curves::geometry::trig;
use serde_json::Value as Json;
use tempfile::TempDir;

use crate::support::command::{printed, run};
use crate::support::table::{numbers, rows};

const LOG: &str = "y = log10(x) for x = 1..10 over 60 deg of input and 90 deg of output";

fn folder() -> TempDir {
    TempDir::new().unwrap()
}

fn json(folder: &TempDir, arguments: &[&str]) -> Json {
    let all = [&["find"], arguments, &["--function", "--json"]].concat();
    serde_json::from_str(&printed(folder.path(), &all)).unwrap()
}

fn number(value: &Json) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

/// Whether a four-bar of a result closes at an input and an output, in degrees, as a part of its size.
fn gap(result: &Json, input: f64, output: f64) -> f64 {
    let length = |name: &str| number(&result["parameters"][name]);
    let [a, b, c] = ["crank", "coupler", "rocker"].map(length);
    let [input, output] = [input, output].map(trig::radians);
    let x = length("frame") + c * trig::cos(output) - a * trig::cos(input);
    let y = c * trig::sin(output) - a * trig::sin(input);
    trig::hypot(x, y) / b - 1.0
}

#[test]
fn precision_points_of_a_formula_are_exact_and_what_is_left_out_is_told() {
    let folder = folder();
    let found = json(&folder, &[LOG]);
    // Five points have one linkage, which does not reach the range's end; then four are taken.
    assert_eq!((found["method"].as_str(), found["precision_points"].as_u64()), (Some("points"), Some(4)));
    for result in found["results"].as_array().unwrap() {
        let start = [&result["input_deg"][0], &result["output"][0]].map(number);
        for k in 0..4 {
            let x = 5.5 - 4.5 * trig::cos(std::f64::consts::PI * (2.0 * f64::from(k) + 1.0) / 8.0);
            let (input, output) = (60.0 * (x - 1.0) / 9.0, 90.0 * trig::log10(x));
            let gap = gap(result, start[0] + input, start[1] + output);
            assert!(gap.abs() < 1e-9, "{result} {k} {gap}");
        }
        assert!((number(&result["input_deg"][1]) - start[0] - 60.0).abs() < 1e-9);
    }
    let (code, out, _) = run(folder.path(), &["find", LOG, "--function"]);
    assert!(
        code == 0 && out.contains("note: 5 precision points have no answer, the only solution is left out"),
        "{out}"
    );
    let (code, out, _) = run(folder.path(), &["find", LOG, "--function", "--points", "5"]);
    assert!(code == 0 && out.contains("no linkage was found") && out.contains("fewer --points"), "{out}");
    let given = ["find", LOG, "--function", "--points", "3", "--input-start", "60", "--output-start=240"];
    let (code, out, _) = run(folder.path(), &given);
    assert!(code == 0 && out.contains("it changes branch between points 1 and 2"), "{out}");
}

#[test]
fn a_rendered_linkage_generates_the_function_over_its_range() {
    let folder = folder();
    let at = folder.path();
    let toml = printed(at, &["find", LOG, "--function", "--fit", "minimax", "--top", "3", "--toml"]);
    fs::write(at.join("found.toml"), &toml).unwrap();
    printed(at, &["validate", "found.toml"]);
    printed(at, &["render", "found.toml", "-q"]);
    let found = json(&folder, &[LOG, "--fit", "minimax", "--top", "3"]);
    let best = &found["results"][0];
    let side = best["side"].as_str().unwrap();
    let family = at.join(format!("found/found-{side}"));
    let cells = fs::read_to_string(family.join("cells.csv")).unwrap();
    let [input_min, mu] = numbers(&rows(&cells)[0], ["input_min_deg", "mu_worst_deg"]);
    assert!((input_min - number(&best["input_deg"][0])).abs() < 1e-9);
    assert!((mu - number(&best["mu_worst_deg"])).abs() < 1e-9);
    let points = fs::read_to_string(family.join("points.csv")).unwrap();
    let greatest = number(&best["error_greatest"]).abs();
    let mut count = 0;
    let mut most: f64 = 0.0;
    let points = rows(&points).into_iter().map(|row| numbers(&row, ["cell", "input_deg", "x", "y"]));
    for [_, input, x, y] in points.filter(|[cell, ..]| *cell == 1.0) {
        let rocker = trig::degrees(trig::atan2(y, x - 1.0));
        let travel = input - number(&best["input_deg"][0]);
        let wanted = number(&best["output"][0]) + 90.0 * trig::log10(1.0 + 9.0 * travel / 60.0);
        let error = (rocker - wanted + 180.0).rem_euclid(360.0) - 180.0;
        assert!(error.abs() <= greatest + 1e-9, "{input}: {error}");
        most = most.max(error.abs());
        count += 1;
    }
    assert!(count > 25 && most > 0.98 * greatest, "{count} {most} {greatest}");
}

#[test]
fn the_chart_has_the_function_the_outputs_and_the_errors() {
    let folder = folder();
    let at = folder.path();
    printed(at, &["find", LOG, "--function", "--svg", "log.svg"]);
    let svg = fs::read_to_string(at.join("log.svg")).unwrap();
    let document = roxmltree::Document::parse(&svg).unwrap();
    let titles: Vec<&str> = document
        .descendants()
        .filter(|node| node.attribute("class") == Some("series"))
        .filter_map(|node| node.children().find(|child| child.has_tag_name("title"))?.text())
        .collect();
    for wanted in ["output from the start", "structural error"] {
        for line in ["wanted", "linkage 1", "no error of linkage 1"] {
            let is_line = |title: &&str| title.contains(wanted) && title.ends_with(line);
            assert!(titles.iter().any(is_line), "{wanted}, {line}: {titles:?}");
        }
    }
}

#[test]
fn rows_of_a_table_are_points_or_are_fitted() {
    let folder = folder();
    let at = folder.path();
    // Of the four-bar 1, 0.4, 1.2, 0.9, with the rocker's pin on the left, from an input of 70°; the zeros are any.
    let rocker = |input: f64| {
        let (a, b, c) = (0.4, 1.2, 0.9);
        let [x, y] = [a * trig::cos(trig::radians(input)) - 1.0, a * trig::sin(trig::radians(input))];
        let diagonal = trig::hypot(x, y);
        let angle = trig::acos((c * c + diagonal * diagonal - b * b) / (2.0 * c * diagonal));
        trig::degrees((trig::atan2(y, x)).rem_euclid(std::f64::consts::TAU) - angle)
    };
    let table = |inputs: &[f64]| {
        let lines = inputs.iter().map(|input| format!("{};{}", input - 50.0, rocker(*input) - rocker(70.0) + 5.0));
        format!("input [deg];output\n{}\n", lines.collect::<Vec<_>>().join("\n"))
    };
    fs::write(at.join("five.csv"), table(&[70.0, 95.0, 118.0, 150.0, 171.0])).unwrap();
    let many: Vec<f64> = (0..30).map(|k| 70.0 + 4.0 * f64::from(k)).collect();
    fs::write(at.join("many.csv"), table(&many)).unwrap();
    for (file, method) in [("five.csv", "points"), ("many.csv", "least-squares")] {
        let found = json(&folder, &[file]);
        assert_eq!(found["method"].as_str(), Some(method), "{file}");
        let is_own = |result: &Json| {
            let near = |name: &str, value: f64| (number(&result["parameters"][name]) - value).abs() < 1e-5;
            near("crank", 0.4) && near("coupler", 1.2) && near("rocker", 0.9)
        };
        let own = found["results"].as_array().unwrap().iter().find(|result| is_own(result));
        let own = own.unwrap_or_else(|| panic!("{file}: {found}"));
        assert!(number(&own["error_greatest"]).abs() < 1e-6 && own["side"] == "left");
        assert!((number(&own["input_deg"][0]) - 70.0).abs() < 1e-3);
    }
    // The output of a slider-crank by its unit.
    fs::write(at.join("slider.csv"), "input,output [mm]\n0,0\n20,4\n45,12\n60,18\n").unwrap();
    let found = json(&folder, &["slider.csv", "--input-start", "20"]);
    assert_eq!(found["results"][0]["linkage"].as_str(), Some("slider-crank"), "{found}");
}

/// A Scotch yoke generates a cosine, and an oscillating slide the function of its own formula.
#[test]
fn the_dimensions_of_any_linkage_are_found() {
    let folder = folder();
    let at = folder.path();
    let cosine = "y = cos(x) for x = 0.3..2.1 over 103.1324031235482 deg of input and 50 of output";
    let found = json(&folder, &[cosine, "--linkage", "scotch-yoke", "--top", "1"]);
    let best = &found["results"][0];
    assert!(number(&best["error_greatest"]).abs() < 1e-6, "{found}");
    // An oscillating slide: of an inverted slider-crank without offset, with the crank 1 and the frame 2.5, tan ψ = sin θ / (cos θ - 2.5).
    let slide =
        |input: f64| trig::degrees(trig::atan2(trig::sin(trig::radians(input)), trig::cos(trig::radians(input)) - 2.5));
    let lines = (0..20).map(|k| 40.0 + 5.0 * f64::from(k)).map(|input| format!("{input},{}\n", slide(input)));
    fs::write(at.join("slide.csv"), format!("input,output\n{}", lines.collect::<String>())).unwrap();
    let keep = ["slide.csv", "--linkage", "inverted-slider-crank", "--keep", "e=0", "--keep", "r=1"];
    let found = json(&folder, &keep);
    let best = &found["results"][0];
    assert!((number(&best["parameters"]["g"]) - 2.5).abs() < 1e-4, "{found}");
    assert!(number(&best["error_greatest"]).abs() < 1e-5 && number(&best["parameters"]["r"]) == 1.0);
    let toml = printed(at, &[&["find"], &keep[..], &["--function", "--top", "1", "--toml"]].concat());
    fs::write(at.join("slide.toml"), toml).unwrap();
    printed(at, &["render", "slide.toml", "-q"]);
    let cells = fs::read_to_string(at.join("slide/found-1/cells.csv")).unwrap();
    let swings = rows(&cells).into_iter().map(|row| numbers(&row, ["output_swing_deg"])[0]);
    let outputs: Vec<f64> = (0..=9500).map(|k| slide(40.0 + 0.01 * f64::from(k)).rem_euclid(360.0)).collect();
    let span = outputs.iter().fold(0.0, |most: f64, x| most.max(*x))
        - outputs.iter().fold(360.0, |least: f64, x| least.min(*x));
    assert!(swings.into_iter().any(|swing| (swing - span).abs() < 1e-3), "{span}");
    printed(at, &["find", cosine, "--function", "--linkage", "scotch-yoke", "--svg", "yoke.svg"]);
    for (arguments, told) in [
        (&[LOG, "--linkage", "scotch-yoke"][..], "its output is a length"),
        (&[LOG, "--linkage", "excavator"], "its input is a length"),
        (&[LOG, "--linkage", "evans", "--points", "2"], "free parameters and starts: give from 3 to"),
        (&[LOG, "--linkage", "evans", "--points", "30"], "30 precision points"),
        (&[LOG, "--linkage", "evans", "--points", "3", "--fit", "minimax"], "leave one out"),
        (&["slide.csv", "--linkage", "evans", "--points", "3"], "it has 20 rows: leave it out"),
        (&[LOG, "--linkage", "evans", "--max-link", "0.5"], "--max-link 0.5: give how many times"),
        (&[LOG, "--linkage", "evans", "--keep", "q"], "--keep: evans has no parameter `q`"),
        (&[LOG, "--linkage", "evan"], "evan"),
        (&[LOG, "--effort", "thorough"], "--effort is of --linkage NAME"),
    ] {
        let (code, _, err) = run(at, &[&["find", "--function"], arguments].concat());
        assert!(code == 2 && err.contains(told), "{arguments:?}: {err}");
    }
}

/// An oscillating slide has as many unknowns as there are points here: its frame and both starts.
#[test]
fn any_linkage_is_exact_at_precision_points() {
    const SQUARE: &str = "y = x^2 for x = 0..1 over 60 deg of input and 12 deg of output";
    let folder = folder();
    let slide = ["--linkage", "inverted-slider-crank", "--keep", "e=0", "--keep", "r=1"];
    let found = json(&folder, &[&[SQUARE, "--points", "3", "--max-link", "5"][..], &slide].concat());
    let results = found["results"].as_array().unwrap();
    assert!(!results.is_empty(), "{found}");
    let mut last = 0.0;
    for result in results {
        let g = number(&result["parameters"]["g"]);
        let [input, output] = ["input_deg", "output"].map(|key| number(&result[key][0]));
        for x in [0.5 - 0.25 * 3.0_f64.sqrt(), 0.5, 0.5 + 0.25 * 3.0_f64.sqrt()] {
            let (cos, sin) = trig::cos_sin_deg(input + 60.0 * x);
            let there = trig::degrees(trig::atan2(sin, cos - g));
            let error = (there - output - 12.0 * x * x + 180.0).rem_euclid(360.0) - 180.0;
            assert!(error.abs() < 1e-6, "{x}: {error} {result}");
        }
        assert!((0.2..=5.0).contains(&g), "{g}");
        let greatest = number(&result["error_greatest"]).abs();
        assert!(greatest >= last && greatest > 1e-4, "{found}");
        last = greatest;
    }
    // Its point does not move the output.
    let kept = ["--keep", "along=0", "--keep", "across=0"];
    let four = ["find", SQUARE, "--function", "--points", "4"];
    let (code, _, error) = run(folder.path(), &[&four[..], &slide, &kept].concat());
    assert!(
        code == 2 && error.contains("at most 3 can be exact with so many free parameters and starts: give 3,"),
        "{error}"
    );
}

#[test]
fn every_slip_is_an_error_with_its_place_and_a_remedy() {
    let folder = folder();
    let at = folder.path();
    let files = [
        ("names.csv", "x,y\n1,2\n"),
        ("slips.csv", "input,output\n0,0\n20,3\n10,x\n30\n"),
        ("values.csv", "input,output\n0,0\n20,nan\n20,3\n10,4\n"),
        ("few.csv", "input,output\n0,0\n20,3\n"),
        ("turns.csv", "input,output\n0,0\n20,3\n500,4\n"),
        ("rest.csv", "input,output\n0,1\n20,1\n50,1\n"),
        ("good.csv", "input,output\n0,0\n20,15\n45,30\n60,42\n"),
        ("path.json", "[[0, 0], [1, 2]]"),
    ];
    for (name, text) in files {
        fs::write(at.join(name), text).unwrap();
    }
    let cases: [(&[&str], &[&str]); 17] = [
        (
            &["names.csv"],
            &["line 1: no column `input` among x, y: name the columns input,output", "without --function"],
        ),
        (&["slips.csv"], &["slips.csv: line 4: `x` is not a number", "slips.csv: line 5: the output is missing"]),
        (
            &["values.csv"],
            &[
                "line 3: NaN is not a finite number",
                "line 4: the input is 20 after 20",
                "line 5: the input is 10 after 20",
            ],
        ),
        (&["few.csv"], &["it has 2 rows, and a function has from 3 to 5000"]),
        (&["turns.csv"], &["the input turns by 500°, and at most 360°"]),
        (&["rest.csv"], &["the output is 1 in all rows"]),
        (&["path.json"], &["it is JSON: a function is a table with the columns input,output"]),
        (&["none.csv"], &["cannot find none.csv: name a table", "y = log10(x) for x = 1..10"]),
        (
            &["y = log(x) for x = 1..10 over 60 of input and 90 deg of output"],
            &["unknown function `log`", "^^^", "no unit of an angle"],
        ),
        (&["y = log10(x) for x = 0..10 over 60 deg of input and 90 deg of output"], &["y is -inf at x = 0"]),
        (&["y = x for x = 1..10 over 60 deg of input"], &["`and` is missing", "write it like"]),
        (&[LOG, "--points", "6"], &["--points 6: at most 5 points can be exact: give from 3 to 5"]),
        (&[LOG, "--points", "4", "--input-start", "20", "--output-start", "x"], &["--output-start: `x`"]),
        (&[LOG, "--points", "4", "--fit", "minimax"], &["--points is the number of points", "leave one out"]),
        (
            &["good.csv", "--fit", "points", "--input-start", "0", "--output-start", "0"],
            &["the table has 4 rows", "least-squares or minimax"],
        ),
        (
            &["good.csv", "--max-link", "0.5", "--where", "mu_wrst > 3", "--points", "3"],
            &["--max-link 0.5", "--where: `mu_wrst > 3`", "--points is of a formula"],
        ),
        (&[LOG, "--linkage", "slider-crank"], &["the output of a slider-crank is a length"]),
    ];
    for (arguments, told) in cases {
        let all = [&["find"], arguments, &["--function"]].concat();
        let (code, out, err) = run(at, &all);
        assert!(code == 2 && out.is_empty(), "{arguments:?}: {code} {out}{err}");
        for words in told {
            assert!(err.contains(words), "{arguments:?}: no {words:?} in\n{err}");
        }
    }
    let (code, _, err) = run(at, &["find", "good.csv", "--function", "--closed"]);
    assert!(code == 2 && err.contains("--closed"), "{err}");
    let (code, _, err) = run(at, &["find", "good.csv", "--points", "3"]);
    assert!(code == 2 && err.contains("--function"), "{err}");
}

#[test]
fn a_wish_that_cannot_be_met_is_told_and_is_no_error() {
    let folder = folder();
    let wish = ["find", LOG, "--function", "--fit", "least-squares", "--where", "mu_worst_deg > 89"];
    let (code, out, _) = run(folder.path(), &wish);
    assert!(code == 0 && out.contains("no linkage was found") && out.contains("not meet --where"), "{out}");
    let toml = printed(folder.path(), &[&wish[..], &["--toml"]].concat());
    assert!(toml.contains("No linkage meets the constraints"), "{toml}");
}

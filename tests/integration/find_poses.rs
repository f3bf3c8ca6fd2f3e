//! `find --poses`: what it prints is evaluated by formulas of its own.

use std::fs;

use coupler_curves::geometry::trig;
use serde_json::Value as Json;
use tempfile::TempDir;

use crate::support::command::{printed, run};

/// Poses of a crank-rocker with a frame of 80, a crank of 30, a coupler of 60 and a rocker of 70, rounded.
const POSES: &str = include_str!("../../examples/poses.csv");

fn folder_with(name: &str, text: &str) -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join(name), text).unwrap();
    folder
}

fn json(folder: &TempDir, arguments: &[&str]) -> Json {
    let text = printed(folder.path(), &[&["find", "poses.csv", "--poses", "--json"], arguments].concat());
    serde_json::from_str(&text).unwrap()
}

fn number(value: &Json) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

/// The body's point, and the direction of the coupler in degrees, for an angle of the crank.
fn body(result: &Json, input_deg: f64) -> ([f64; 2], f64) {
    let parameter = |name: &str| number(&result["parameters"][name]);
    let side = if result["branch"] == 1 { 1.0 } else { -1.0 };
    let [o_x, o_y, crank] = ["x", "y", "crank"].map(parameter);
    let (cos, sin) = trig::cos_sin_deg(input_deg);
    let a = [o_x + crank * cos, o_y + crank * sin];
    let (tc, ts) = trig::cos_sin_deg(parameter("turn"));
    let to_frame = |frame: f64| [o_x + frame * tc - a[0], o_y + frame * ts - a[1]];
    let [ux, uy] = match result["linkage"].as_str().unwrap() {
        "four-bar" => {
            let (rod, rocker) = (parameter("coupler"), parameter("rocker"));
            let [dx, dy] = to_frame(parameter("frame"));
            let square = dx * dx + dy * dy;
            let along = (rod * rod - rocker * rocker + square) / (2.0 * square);
            let across = side * (rod * rod / square - along * along).max(0.0).sqrt();
            [(dx * along - dy * across) / rod, (dy * along + dx * across) / rod]
        }
        "slider-crank" => {
            let rod = parameter("coupler");
            let height = parameter("offset") - ((a[1] - o_y) * tc - (a[0] - o_x) * ts);
            let along = side * (rod * rod - height * height).max(0.0).sqrt();
            [(tc * along - ts * height) / rod, (ts * along + tc * height) / rod]
        }
        _ => {
            // From the crank pin towards the block, whose pivot is to the right.
            let offset = parameter("offset");
            let [dx, dy] = to_frame(parameter("frame"));
            let square = dx * dx + dy * dy;
            let slide = (square - offset * offset).max(0.0).sqrt();
            [(dx * slide - dy * offset) / square, (dy * slide + dx * offset) / square]
        }
    };
    let [along, across] = ["along", "across"].map(parameter);
    ([a[0] + along * ux - across * uy, a[1] + along * uy + across * ux], trig::degrees(trig::atan2(uy, ux)))
}

/// Checks that the results pass the poses in order, with the errors that they state; returns how many there are.
fn check(found: &Json, tolerance: f64) -> usize {
    let results = found["results"].as_array().unwrap();
    let size = number(&found["target"]["size"]);
    for result in results {
        let inputs: Vec<f64> = result["input_deg"].as_array().unwrap().iter().map(number).collect();
        let [rises, falls] = [1.0, -1.0].map(|sign| inputs.windows(2).all(|pair| sign * (pair[1] - pair[0]) > 0.0));
        assert!(rises || falls, "{result}");
        assert!((inputs[inputs.len() - 1] - inputs[0]).abs() < 360.0, "{result}");
        let mut to_body: Option<f64> = None;
        for (k, input) in inputs.iter().enumerate() {
            let ([x, y], direction) = body(result, *input);
            let pose = &found["target"]["points"][k];
            let (dx, dy) = (x - number(&pose[0]), y - number(&pose[1]));
            let distance = (dx * dx + dy * dy).sqrt();
            let stated = number(&result["errors"][k][0]);
            assert!((distance - stated).abs() < 1e-8 * size && stated <= tolerance * size, "{k}: {distance} {result}");
            // The direction of the body from that of the coupler is the same at all poses.
            let own = number(&found["target"]["angles_deg"][k]) + number(&result["errors"][k][1]) - direction;
            let first = *to_body.get_or_insert(own);
            let turned = (own - first + 180.0).rem_euclid(360.0) - 180.0;
            assert!(turned.abs() < 1e-6, "{k}: {turned} {result}");
        }
    }
    results.len()
}

#[test]
fn five_poses_are_passed_exactly() {
    let folder = folder_with("poses.csv", POSES);
    let found = json(&folder, &["--input", "any"]);
    assert_eq!(check(&found, 1e-9), 2);
    assert_eq!(found["freedom"], "points");
    assert_eq!(found["dyads"].as_array().unwrap().len(), 4);
    let left_out = found["pairs_left_out"].as_array().unwrap().len();
    assert_eq!(found["pairs"], 2 + left_out);
    // The linkage of which the poses were taken, up to their rounding.
    let is_own = |result: &Json| {
        let is_near = |(name, value): (&str, f64)| (number(&result["parameters"][name]) / value - 1.0).abs() < 0.05;
        [("frame", 80.0), ("crank", 30.0), ("coupler", 60.0), ("rocker", 70.0)].into_iter().all(is_near)
    };
    assert!(found["results"].as_array().unwrap().iter().any(is_own), "{found}");
    let radians: String = POSES
        .lines()
        .map(|line| match line.rsplit_once(',').map(|(point, angle)| (point, angle.parse::<f64>())) {
            Some((point, Ok(angle))) => format!("{point},{}\n", trig::radians(angle)),
            _ => line.replace("angle_deg", "angle_rad") + "\n",
        })
        .collect();
    fs::write(folder.path().join("poses.csv"), radians).unwrap();
    assert_eq!(check(&json(&folder, &["--input", "any"]), 1e-9), 2);
}

#[test]
fn fewer_and_more_poses_are_passed_or_nearly() {
    let lines: Vec<&str> = POSES.lines().collect();
    for (count, freedom) in [(2, "space"), (3, "plane"), (4, "curve")] {
        let folder = folder_with("poses.csv", &lines[..count + 2].join("\n"));
        for input in ["any", "full-turn"] {
            let found = json(&folder, &["--input", input, "--effort", "quick"]);
            assert_eq!(found["freedom"], freedom);
            assert!(check(&found, 1e-9) > 0, "{count} {input}");
            if input == "full-turn" {
                assert!(found["results"].as_array().unwrap().iter().all(|result| result["full_turn"] == true));
            }
        }
    }
    let more = format!("{POSES}-3,45.9,-17.2\n").replace(
        "\n2.3,56.2,-20.9\n-10.4,35.2,-11.9\n-3,45.9,-17.2\n",
        "\n2.3,56.2,-20.9\n-3,48,-18\n-10.4,35.2,-11.9\n",
    );
    let folder = folder_with("poses.csv", &more);
    let found = json(&folder, &["--effort", "quick"]);
    assert_eq!(found["freedom"], "none");
    assert!(check(&found, 0.2) > 0);
    let rms = number(&found["results"][0]["rms_relative"]);
    assert!(rms > 1e-6 && rms < 0.05, "{rms}");
}

#[test]
fn wishes_are_kept() {
    let folder = folder_with("poses.csv", &POSES.lines().take(5).collect::<Vec<_>>().join("\n"));
    let wishes = [
        "--pivots=-50,-50,50,50",
        "--max-link",
        "6",
        "--where",
        "mu_worst_deg >= 30 and rocker > 0",
        "--effort",
        "quick",
    ];
    let found = json(&folder, &wishes);
    assert!(check(&found, 1e-9) > 0);
    let size = number(&found["target"]["size"]);
    for result in found["results"].as_array().unwrap() {
        assert_eq!(result["linkage"], "four-bar");
        assert!(number(&result["mu_worst_deg"]) >= 30.0 && number(&result["longest_link"]) <= 6.0 * size);
        for pivot in ["crank_pivot", "rocker_pivot"] {
            assert!((0..2).all(|k| number(&result[pivot][k]).abs() <= 50.0), "{result}");
        }
    }
    for (condition, linkage) in [("coupler", "slider-crank"), ("frame", "inverted-slider-crank")] {
        let condition = format!("abs(offset) < 100 and {condition} > 0");
        let found = json(&folder, &["--where", &condition, "--effort", "quick"]);
        assert!(check(&found, 1e-9) > 0);
        assert!(found["results"].as_array().unwrap().iter().all(|result| result["linkage"] == linkage));
    }
    // What cannot be met is named.
    let none = json(&folder, &["--where", "mu_worst_deg > 90", "--effort", "quick"]);
    assert_eq!(none["results"].as_array().unwrap().len(), 0);
    assert_eq!(none["nearest_miss"]["relax"][0], "another --where");
}

#[test]
fn given_pivots_are_kept() {
    let lines: Vec<&str> = POSES.lines().collect();
    let folder = folder_with("poses.csv", &lines[..5].join("\n"));
    // Those of the linkage of which the poses were taken, which passes them up to their rounding.
    let given = ["--input", "any", "--max-link", "inf", "--pivot=0,0", "--pivot=80,0"];
    let found = json(&folder, &given);
    // With the other one as the crank it passes a limit.
    assert_eq!((&found["pairs"], check(&found, 1e-9)), (&Json::from(2), 1));
    for result in found["results"].as_array().unwrap() {
        let mut pivots = [&result["crank_pivot"], &result["rocker_pivot"]].map(|at| [number(&at[0]), number(&at[1])]);
        pivots.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let error = [pivots[0][0], pivots[0][1], pivots[1][0] - 80.0, pivots[1][1]];
        assert!(error.iter().all(|error| error.abs() < 1e-12), "{result}");
    }
    let lengths = ["crank", "coupler", "rocker"].map(|name| number(&found["results"][0]["parameters"][name]));
    assert!(lengths.iter().zip([30.0, 60.0, 70.0]).all(|(own, there)| (own / there - 1.0).abs() < 0.1), "{lengths:?}");
    // Outside the box of the other one, and of four poses not at all.
    let one = json(&folder, &["--input", "any", "--pivot=0,0", "--pivots=10,-50,200,50", "--effort", "quick"]);
    assert!(check(&one, 1e-9) > 0);
    let is_given = |at: &Json| number(&at[0]).abs() < 1e-12 && number(&at[1]).abs() < 1e-12;
    for result in one["results"].as_array().unwrap() {
        assert!(is_given(&result["crank_pivot"]) || is_given(&result["rocker_pivot"]), "{result}");
    }
    let far = printed(folder.path(), &["find", "poses.csv", "--poses", "--pivot=0,0", "--pivot=80,0"]);
    assert!(far.contains("2: a link is longer than --max-link") && far.contains("--max-link"), "{far}");
    let wrong = ["find", "poses.csv", "--poses", "--pivot=0,0", "--pivot=0,0", "--pivot=x,1", "--pivot=inf,1"];
    let (code, _, error) = run(folder.path(), &wrong);
    assert_eq!(code, 2);
    for expected in ["(0, 0) is given twice", "`x` is not a number", "(inf, 1) is not finite", "given 3 times"] {
        assert!(error.contains(expected), "{expected}: {error}");
    }
    fs::write(folder.path().join("poses.csv"), lines[..6].join("\n")).unwrap();
    let (code, _, error) = run(folder.path(), &["find", "poses.csv", "--poses", "--pivot=0,0"]);
    assert!(code == 2 && error.contains("the pivots of 4 are on a curve"), "{error}");
}

#[test]
fn poses_in_another_order_are_left_out() {
    let mut lines: Vec<&str> = POSES.lines().collect();
    lines.swap(3, 4);
    let folder = folder_with("poses.csv", &lines.join("\n"));
    let text = printed(folder.path(), &["find", "poses.csv", "--poses"]);
    assert!(text.contains("the poses are passed in another order, 1 3 2 4 5"), "{text}");
    assert!(text.contains("no linkage passes the poses as asked for; with --any-order there"), "{text}");
    let found = json(&folder, &["--any-order"]);
    assert!(!found["results"].as_array().unwrap().is_empty());
    assert!(found["results"].as_array().unwrap().iter().all(|result| result["in_order"] == false));
}

#[test]
fn the_manifest_renders_and_the_page_is_drawn() {
    let lines: Vec<&str> = POSES.lines().collect();
    let folder = folder_with("poses.csv", &lines[..6].join("\n"));
    let find = ["find", "poses.csv", "--poses", "--input", "any", "--effort", "quick"];
    let (code, manifest, error) = run(folder.path(), &[&find[..], &["--toml", "--svg", "page.svg"]].concat());
    assert_eq!(code, 0, "{error}");
    fs::write(folder.path().join("found.toml"), &manifest).unwrap();
    printed(folder.path(), &["render", "found.toml", "--strict"]);
    let page = fs::read_to_string(folder.path().join("page.svg")).unwrap();
    for text in ["the centre-point curve", "the circle-point curve", "the poses: 4"] {
        assert!(page.contains(text), "{text}");
    }
    let pages: Vec<String> = fs::read_dir(folder.path().join("found"))
        .unwrap()
        .flat_map(|entry| fs::read_dir(entry.unwrap().path()).into_iter().flatten())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "svg"))
        .map(|path| fs::read_to_string(path).unwrap())
        .collect();
    assert_eq!(pages.len(), manifest.matches("{ rank = ").count());
    for page in &pages {
        for text in
            ["passes the 4 poses; input ", "the centre-point curve", "the circle-point curve", "pose of the body"]
        {
            assert!(page.contains(text), "{text}");
        }
    }
    // Another pose is missed, by as much as another linkage of the same curve would: in panels, too.
    let missed = manifest.replacen("    [29.8, 59.6, 8.6],\n", "    [29.8, 59.6, 8.6],\n    [29.8, 60.6, 8.6],\n", 8);
    let missed = missed.replace("layout = \"poses\"", "layout = \"panels\"\npanels = [1, 1]");
    assert_ne!(missed, manifest);
    fs::write(folder.path().join("missed.toml"), missed).unwrap();
    printed(folder.path(), &["render", "missed.toml", "--strict"]);
    let family = fs::read_dir(folder.path().join("missed")).unwrap().find_map(|entry| {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        fs::read_to_string(entry.path().join(format!("{name}-001.svg"))).ok()
    });
    let family = family.unwrap();
    assert!(family.contains("misses the poses by up to ") && !family.contains("; input "), "{family}");
    // A curve of the manifest passes the body's places.
    let family = manifest.lines().find_map(|line| line.strip_prefix("id = \"found-")).unwrap().trim_end_matches('"');
    let curve = |circuit: usize| {
        let name = format!("found-{family}:1.1.{circuit}");
        let (code, text, _) = run(folder.path(), &["export", "found.toml", &name, "--format", "json"]);
        (code == 0).then(|| serde_json::from_str::<Json>(&text).unwrap())
    };
    let target = json(&folder, &["--input", "any", "--effort", "quick"])["target"].clone();
    let is_near = |curve: &Json| {
        let points = curve["points"].as_array().unwrap();
        let columns: Vec<&str> =
            curve["columns"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
        let [x, y] = ["x", "y"].map(|name| columns.iter().position(|own| *own == name).unwrap());
        let distance = |pose: &Json, point: &Json| {
            let (dx, dy) = (number(&point[x]) - number(&pose[0]), number(&point[y]) - number(&pose[1]));
            (dx * dx + dy * dy).sqrt()
        };
        let nearest = |pose: &Json| points.iter().map(|point| distance(pose, point)).fold(f64::INFINITY, f64::min);
        target["points"].as_array().unwrap().iter().all(|pose| nearest(pose) < 0.1 * number(&target["size"]))
    };
    assert!([1, 2, 3, 4].into_iter().filter_map(curve).any(|curve| is_near(&curve)));
}

#[test]
fn the_answer_does_not_depend_on_threads() {
    let folder = folder_with("poses.csv", &POSES.lines().take(5).collect::<Vec<_>>().join("\n"));
    let with =
        |jobs| printed(folder.path(), &["find", "poses.csv", "--poses", "--effort", "quick", "--json", "-j", jobs]);
    assert_eq!(with("1"), with("3"));
}

#[test]
fn every_mistake_is_named() {
    let folder = folder_with("poses.csv", POSES);
    let wrong = [
        "find",
        "poses.csv",
        "--poses",
        "--timed",
        "--closed",
        "--atlas",
        "atlas.toml",
        "--index",
        "3",
        "--where",
        "foo > 1",
        "--max-link",
        "-3",
        "--pivots",
        "1,2,3",
    ];
    let (code, out, error) = run(folder.path(), &wrong);
    assert!(code == 2 && out.is_empty());
    for expected in [
        "--timed and --poses",
        "--closed and",
        "--atlas and",
        "--index and",
        "unknown name `foo`",
        "--pivots",
        "--max-link -3",
    ] {
        assert!(error.contains(expected), "{expected}: {error}");
    }
    for (text, expected) in [
        ("", "it has no pose: give 2 or more"),
        ("x,y,angle_deg\n1,2,3\n", "it has 1 pose: give 2 or more"),
        ("x,y\n1,2\n3,4\n", "each pose needs the angle of the body"),
        ("a,b,c\n1,2,3\n3,4,5\n", "no columns `x` and `y`"),
        ("x,y,angle_deg\n1,2,3\n4,5,nan\n", "line 3: `nan` is NaN: an angle must be finite"),
        ("x,y,angle_deg\n1,2,3\n4,5,6\n1,2,363\n4,5,6\n", "poses 1 and 3 are the same"),
        ("x,y,angle_deg\n1,2,3\n4,5,6\n1,2,363\n4,5,6\n", "poses 2 and 4 are the same"),
        ("x,y,angle_deg\n4,0,0\n0,4,90\n-4,0,180\n", "the body only turns about (0, 0)"),
    ] {
        fs::write(folder.path().join("wrong.csv"), text).unwrap();
        let (code, out, error) = run(folder.path(), &["find", "wrong.csv", "--poses"]);
        assert!(code == 2 && out.is_empty() && error.contains(expected), "{text}: {error}");
    }
    fs::write(folder.path().join("moved.csv"), "x,y,angle\n0,0,0\n1,0,0\n3,1,0\n4,5,0\n").unwrap();
    let (code, out, error) = run(folder.path(), &["find", "moved.csv", "--poses"]);
    assert!(code == 0 && out.contains("the body does not turn") && error.contains("in degrees"), "{out} {error}");
    // Without the option it is named.
    let (_, _, error) = run(folder.path(), &["find", "poses.csv", "--index", "200", "--effort", "quick"]);
    assert!(error.contains("with --poses they are those of a body"), "{error}");
    let (code, _, error) = run(folder.path(), &["find", "poses.csv", "--any-order"]);
    assert!(code == 2 && error.contains("--poses"), "{error}");
}

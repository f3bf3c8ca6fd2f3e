//! The kernel answers what the crates below it compute, for every family of the repository's atlas.

use std::path::Path;

use coupler_curves::exchange::SelectedCurve;
use coupler_curves::geometry::{Bounds, Point};
use coupler_curves::linkage::CircuitSelection;
use coupler_curves::measure::{self, MeasureSet, TracedCurve, Value as Measured};
use coupler_curves::motion::{self, Motion, Pass};
use coupler_curves::solve::{SolvedCell, Solver};
use coupler_drawing::curve_file::{self, CurveFormat, FileOptions};
use coupler_drawing::plate::PAPER;
use coupler_drawing::render::Format;
use coupler_kernel::{Kernel, Response};
use coupler_manifest::{Plan, PlannedFamily, parse_for_formats};
use serde_json::{Value, json};

/// The plan of a manifest at the root of the repository.
fn plan(name: &str) -> Plan {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name);
    parse_for_formats(&std::fs::read_to_string(path).unwrap(), &Format::ALL, None).plan.unwrap()
}

fn call(kernel: &mut Kernel, request: &Value) -> (Value, Vec<f64>) {
    let Response { json, numbers } = kernel.call(&request.to_string());
    (serde_json::from_str(&json).unwrap(), numbers)
}

/// The answer to a request that must have one.
fn answer(kernel: &mut Kernel, request: &Value) -> (Value, Vec<f64>) {
    let (value, numbers) = call(kernel, request);
    assert!(value.get("error").is_none(), "{request}: {value}");
    (value, numbers)
}

/// The elements of an array of an answer.
fn array<'n>(value: &Value, numbers: &'n [f64]) -> &'n [f64] {
    let [start, length] = [0, 1].map(|k| value["$"][k].as_u64().unwrap() as usize);
    &numbers[start..start + length]
}

fn open_family(kernel: &mut Kernel, planned: &PlannedFamily) -> usize {
    let (family, _) = answer(kernel, &json!({ "method": "open_family", "manifest": planned.excerpt() }));
    family["family"].as_u64().unwrap() as usize
}

/// The curve of a cell as the page names it.
fn curve_request(
    planned: &PlannedFamily,
    handle: usize,
    k: usize,
    curve: [usize; 2],
    changes: &[(&str, f64)],
) -> Value {
    let family = &planned.family;
    let cell = family.cell(k);
    let values: Vec<(&str, f64)> =
        family.space.slots_of(k).map(|slot| (family.names[slot].as_str(), cell.values[slot])).collect();
    json!({ "family": handle, "cell": cell.number, "curve": curve, "values": values, "changes": changes })
}

/// Some cells of every family of the atlas, solved.
fn solved_cells(plan: &Plan) -> impl Iterator<Item = (&PlannedFamily, usize, SolvedCell)> {
    plan.families.iter().filter(|planned| planned.chart.is_none()).flat_map(|planned| {
        let solver = Solver::new(&planned.family);
        let cells = (0..planned.family.cell_count()).step_by(7);
        cells.filter_map(move |k| Some((planned, k, solver.solve(k)?)))
    })
}

#[test]
fn an_excerpt_of_a_manifest_has_the_same_family() {
    for name in ["atlas.toml", "examples/hrones-nelson.toml"] {
        let plan = plan(name);
        for planned in &plan.families {
            let text = planned.excerpt();
            let outcome = parse_for_formats(&text, &Format::ALL, None);
            let again = outcome.plan.unwrap_or_else(|| panic!("{text}\n{:?}", outcome.problems));
            let (family, excerpt) = (&planned.family, &again.families[0].family);
            assert_eq!((&again.title, &again.page), (&plan.title, &plan.page));
            assert_eq!((&excerpt.names, &excerpt.title), (&family.names, &family.title));
            assert_eq!((excerpt.sampling, excerpt.straight), (family.sampling, family.straight));
            assert_eq!(format!("{:?}", excerpt.template), format!("{:?}", family.template));
            assert_eq!(format!("{:?}", excerpt.derived), format!("{:?}", family.derived));
            assert_eq!(format!("{:?}", excerpt.captions), format!("{:?}", family.captions));
            assert_eq!(again.families[0].source, planned.source);
            assert_eq!(excerpt.cell(0).values, family.cell(0).values);
            assert_eq!(again.families[0].excerpt(), text);
        }
    }
}

#[test]
fn poses_and_measures_are_those_of_the_core() {
    let plan = plan("atlas.toml");
    let mut kernel = Kernel::default();
    let mut poses = 0;
    for (planned, k, solved) in solved_cells(&plan) {
        let family = open_family(&mut kernel, planned);
        for measured in &solved.curves {
            let curve = curve_request(planned, family, k, [measured.trace, measured.circuit], &[]);
            let request = json!({ "method": "open_study", "curve": curve, "shown": null, "is_rough": false });
            let (opened, _) = answer(&mut kernel, &request);
            assert_eq!(opened["reason"], Value::Null, "{}", planned.family.id);
            assert_eq!(opened["shown"], opened["home"]);
            assert_eq!(opened["joint"], measured.joint.index());
            let study = opened["study"].as_u64().unwrap() as usize;
            let circuit = solved.circuit(measured);
            let mut pose = Vec::new();
            for (number, pass) in circuit.passes.iter().enumerate() {
                for input in inputs(pass) {
                    kernel.pose(study, number, input, &mut pose);
                    let expected = motion::pose(&solved.linkage, pass, input);
                    let expected: Vec<u64> = expected.iter().flat_map(|p| [p.x, p.y]).map(f64::to_bits).collect();
                    let found: Vec<u64> = pose[Kernel::POSE_HEADER..].iter().copied().map(f64::to_bits).collect();
                    assert_eq!(found, expected);
                    let joint = measured.joint.index();
                    let [x, y] = kernel.joint_position(study, joint, number, input);
                    assert_eq!([x.to_bits(), y.to_bits()], expected[2 * joint..2 * joint + 2]);
                    poses += 1;
                }
            }
            // Measures do not depend on the samples of the circuit they are computed from.
            let (measures, _) = answer(&mut kernel, &json!({ "method": "measures", "study": study }));
            for (measure, value) in measure::ALL.iter().zip(compute_measures(&solved, measured)) {
                let expected = match value {
                    Measured::Number(number) if number.is_infinite() => json!(number.to_string()),
                    Measured::Number(number) => json!(number),
                    Measured::Word(word) => json!(word),
                    Measured::Missing => Value::Null,
                };
                let found = &measures["values"][measure.name];
                let is_near = |a: f64, b: f64| (a - b).abs() <= 1e-6 * (1.0 + a.abs().max(b.abs()));
                let is_equal = match (expected.as_f64(), found.as_f64()) {
                    (Some(a), Some(b)) => is_near(a, b),
                    _ => expected == *found,
                };
                assert!(is_equal, "{}: {} is {found}, not {expected}", planned.family.id, measure.name);
            }
            answer(&mut kernel, &json!({ "method": "close_study", "study": study }));
        }
        answer(&mut kernel, &json!({ "method": "close_family", "family": family }));
    }
    assert!(poses > 150, "{poses}");
}

/// Inputs of a pass, its ends among them.
fn inputs(pass: &Pass) -> Vec<f64> {
    let [from, to] = [pass.from.input.value, pass.to.input.value];
    [0.0, 0.31, 0.77, 1.0].map(|part| if part == 1.0 { to } else { from + (to - from) * part }).to_vec()
}

fn compute_measures(solved: &SolvedCell, measured: &coupler_curves::solve::MeasuredCurve) -> Vec<Measured> {
    let circuit = solved.circuit(measured);
    let motion = Motion { circuits: vec![circuit.clone()], assembly_error: None };
    measure::compute_all(&TracedCurve::new(&solved.linkage, &motion, circuit, measured.joint))
}

/// Panics unless the exports of every `stride`th cell are those of the program; more than so many files are compared.
fn assert_same_exports(stride: usize, least: usize) {
    let plan = plan("atlas.toml");
    let options = FileOptions {
        page: plan.page.clone().with_paper(PAPER),
        text_mode: plan.text_mode,
        chord_tolerance: FileOptions::DEFAULT_CHORD_TOLERANCE,
    };
    let mut kernel = Kernel::default();
    let mut files = 0;
    for (planned, k, _) in solved_cells(&plan).step_by(stride) {
        let family = open_family(&mut kernel, planned);
        // The program measures everything for an export.
        let solved = Solver::new(&planned.family).measuring(MeasureSet::ALL).solve(k).unwrap();
        for selected in SelectedCurve::all_from_cell(&planned.family, &planned.source, &[], &solved) {
            let numbers = [selected.curve().trace, selected.curve().circuit];
            let curve = curve_request(planned, family, k, numbers, &[]);
            for format in CurveFormat::ALL {
                let request = json!({ "method": "export", "curve": curve, "format": format.name() });
                let (file, _) = answer(&mut kernel, &request);
                let expected = String::from_utf8(curve_file::bytes(&selected, format, &options)).unwrap();
                assert_eq!(file["name"], format.file_name(&selected));
                assert!(file["text"] == expected.as_str(), "{} as {}", selected.name(), format.name());
                files += 1;
            }
            let (text, _) = answer(&mut kernel, &json!({ "method": "fragment", "curves": [curve] }));
            assert_eq!(text["text"], selected.to_toml());
        }
        answer(&mut kernel, &json!({ "method": "close_family", "family": family }));
    }
    assert!(files > least, "{files}");
}

#[test]
fn exports_are_those_of_the_program() {
    assert_same_exports(2, 100);
}

#[test]
#[ignore = "thorough"]
fn all_exports_are_those_of_the_program() {
    assert_same_exports(1, 200);
}

#[test]
fn readings_and_portions_are_on_the_curve() {
    let plan = plan("atlas.toml");
    let mut kernel = Kernel::default();
    for (planned, k, solved) in solved_cells(&plan) {
        let family = open_family(&mut kernel, planned);
        let Some(measured) = solved.curves.first() else { continue };
        let curve = curve_request(planned, family, k, [measured.trace, measured.circuit], &[]);
        let request = json!({ "method": "open_study", "curve": curve, "shown": null, "is_rough": true });
        let study = answer(&mut kernel, &request).0["study"].as_u64().unwrap() as usize;
        let joint = measured.joint.index();
        let bounds = Bounds::from_points(solved.circuit(measured).points(measured.joint));
        let size = bounds.size().norm();
        for sample in [17, 40] {
            let p = solved.circuit(measured).positions.point(measured.joint, sample % solved.circuit(measured).len());
            let (reading, _) =
                answer(&mut kernel, &json!({ "method": "nearest", "study": study, "point": [p.x, p.y] }));
            let place = [0, 1].map(|k| reading["place"][k].as_f64().unwrap());
            let off = (Point::new(place[0], place[1]) - p).norm();
            assert!(off < 1e-6 * size, "{} {off}", planned.family.id);
        }
        let (measures, numbers) = answer(&mut kernel, &json!({ "method": "measures", "study": study }));
        if let Some(portion) = measures.get("straight").filter(|portion| !portion.is_null()) {
            let points = array(&portion["points"], &numbers);
            for (end, at) in [("from", &points[..2]), ("to", &points[points.len() - 2..])] {
                let (pass, input) =
                    (portion[end]["pass"].as_u64().unwrap() as usize, portion[end]["input"].as_f64().unwrap());
                let [x, y] = kernel.joint_position(study, joint, pass, input);
                let off = (Point::new(x, y) - Point::new(at[0], at[1])).norm();
                // Ends of portions are interpolated between samples.
                assert!(off < 1e-3 * size, "{} {end}: {off} of {size}", planned.family.id);
            }
        }
        let (path, numbers) =
            answer(&mut kernel, &json!({ "method": "path", "study": study, "tolerance": 1e-4 * size }));
        let (dashes, starts) = (array(&path["dashes"], &numbers), array(&path["starts"], &numbers));
        assert!(dashes.len() > 20 && starts.len() > 2 && starts.iter().all(|start| 2.0 * start < dashes.len() as f64));
    }
}

#[test]
fn changed_curves_and_other_circuits_are_found() {
    let text = "[atlas]\ntitle = \"T\"\n[[family]]\nid = \"evans\"\nlinkage = \"evans\"\nsampling = { samples = 90 }\n\
                grid = { p = [2, 3], a = [2.5] }";
    let plan = parse_for_formats(text, &Format::ALL, None).plan.unwrap();
    let planned = &plan.families[0];
    let mut kernel = Kernel::default();
    let family = open_family(&mut kernel, planned);
    let study = |kernel: &mut Kernel, changes: &[(&str, f64)], shown: Value| {
        let curve = curve_request(planned, family, 0, [1, 1], changes);
        answer(kernel, &json!({ "method": "open_study", "curve": curve, "shown": shown, "is_rough": false })).0
    };
    let own = study(&mut kernel, &[], Value::Null);
    let circuits = own["circuits"].as_array().unwrap().len();
    assert!(circuits == 2 && own["home"] == own["shown"], "{own}");
    // A value that derives from a changed one follows it, unless it is changed itself.
    let longer = study(&mut kernel, &[("a", 2.75)], Value::Null);
    assert_eq!((&longer["values"]["a"], &longer["values"]["s"]), (&json!(2.75), &json!(2.75)));
    let other = study(&mut kernel, &[], json!(1));
    assert_eq!(other["shown"], 1);
    let impossible = study(&mut kernel, &[("p", 40.0)], Value::Null);
    assert!(impossible["reason"].is_string() && impossible.get("study").is_none(), "{impossible}");
    let moved = study(&mut kernel, &[("M.along", 1.25)], Value::Null);
    assert_eq!(moved["reason"], Value::Null);
    assert_eq!(own["point"]["name"], "M");
    // The second circuit as a file has the name that the command line takes.
    let curve = curve_request(planned, family, 0, [1, 1], &[("circuit", 2.0)]);
    let (file, _) = answer(&mut kernel, &json!({ "method": "export", "curve": curve, "format": "json" }));
    assert_eq!(file["name"], "evans-1-1-2-circuit-2.json");
    assert!(planned.family.template.circuits == CircuitSelection::Start);
}

#[test]
fn requests_that_cannot_be_answered_have_an_error() {
    let mut kernel = Kernel::default();
    let plan = plan("atlas.toml");
    let family = open_family(&mut kernel, &plan.families[0]);
    let curve = |family: usize, trace: usize| json!({ "family": family, "cell": 1, "curve": [trace, 1], "values": [], "changes": [] });
    let requests = [
        "".to_owned(),
        "{".to_owned(),
        "[]".to_owned(),
        "null".to_owned(),
        json!({ "method": "sing" }).to_string(),
        json!({ "method": "open_family" }).to_string(),
        json!({ "method": "open_family", "manifest": "title = 1" }).to_string(),
        json!({ "method": "open_family", "manifest": "" }).to_string(),
        json!({ "method": "path", "study": 0, "tolerance": 1e-3 }).to_string(),
        json!({ "method": "path", "study": -1, "tolerance": "a" }).to_string(),
        json!({ "method": "export", "curve": curve(7, 1), "format": "svg" }).to_string(),
        json!({ "method": "export", "curve": curve(family, 1), "format": "svg" }).to_string(),
        json!({ "method": "export", "curve": curve(family, 0), "format": "gif" }).to_string(),
        json!({ "method": "fragment", "curves": [{ "family": family }] }).to_string(),
    ];
    for request in requests {
        let value: Value = serde_json::from_str(&kernel.call(&request).json).unwrap();
        assert!(value["error"].as_str().is_some_and(|error| !error.is_empty()), "{request}: {value}");
    }
    let mut pose = vec![1.0];
    kernel.pose(3, 0, 0.0, &mut pose);
    assert!(pose.is_empty() && kernel.joint_position(0, 0, 0, 0.0).iter().all(|x| x.is_nan()));
    let (about, _) = answer(&mut kernel, &json!({ "method": "about" }));
    assert_eq!(about["sources"].as_str().unwrap().len(), 64);
    assert!(about["compiler"].as_str().unwrap().starts_with("rustc "));
}

/// The motion of a joint is that of the core, and the torque against a load is its measure.
#[test]
fn the_motion_of_a_joint_has_torques_against_a_load() {
    let manifest = "[atlas]\ntitle = \"T\"\n[[family]]\nid = \"f\"\nlinkage = \"slider-crank\"\nsampling = { samples = 36 }\ncases = [{}]\n";
    let plan = parse_for_formats(manifest, &Format::ALL, None).plan.unwrap();
    let planned = &plan.families[0];
    let mut kernel = Kernel::default();
    let family = open_family(&mut kernel, planned);
    let curve = curve_request(planned, family, 0, [1, 1], &[]);
    let opened = json!({ "method": "open_study", "curve": curve, "shown": null, "is_rough": false });
    let study = answer(&mut kernel, &opened).0["study"].clone();
    let linkage = planned.family.linkage(&planned.family.cell(0)).unwrap();
    let joint = linkage.find_joint("B").unwrap();
    let request = |count: usize, place: Value, load: Value| json!({ "method": "joint_motion", "study": study, "joint": joint.index(), "count": count, "place": place, "load": load });
    let (series, numbers) = answer(&mut kernel, &request(90, Value::Null, json!("50 on B at 180 deg")));
    let at = |key: &str| array(&series[key], &numbers);
    let (inputs, velocities, torques) = (at("inputs"), at("velocities"), at("torques"));
    assert!(inputs.len() >= 90 && at("accelerations").len() == 2 * inputs.len());
    for k in 0..inputs.len() {
        assert!((torques[k] - 50.0 * velocities[2 * k]).abs() < 1e-9, "{k}");
    }
    let peak = series["torque"]["peak"].as_f64().unwrap();
    let sampled = torques.iter().fold(0.0f64, |most, torque| most.max(torque.abs()));
    assert!(peak >= sampled && peak < 1.01 * sampled, "{peak} {sampled}");
    let links = series["links"].as_array().unwrap();
    let crank = links.iter().find(|link| link["joints"] == json!(["O", "A"])).unwrap();
    assert!(array(&crank["velocities"], &numbers).iter().all(|rate| (rate - 1.0).abs() < 1e-12));
    // At the input of the greatest torque it is the torque.
    let place = json!({ "pass": 0, "input": series["torque"]["peak_input"] });
    let (one, numbers) = answer(&mut kernel, &request(0, place, json!("50 on B at 180 deg")));
    assert!((array(&one["torques"], &numbers)[0].abs() - peak).abs() < 1e-9);
    let (without, _) = answer(&mut kernel, &request(9, Value::Null, Value::Null));
    assert!(without["torques"].is_null() && without["torque"].is_null());
    for (load, message) in [("50 on Z", "no single joint `Z`"), ("50", "is no load")] {
        let (refused, _) = call(&mut kernel, &request(9, Value::Null, json!(load)));
        assert!(refused["error"].as_str().unwrap().contains(message), "{refused}");
    }
}

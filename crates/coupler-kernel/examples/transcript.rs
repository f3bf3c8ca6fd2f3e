//! Prints requests and what the kernel answers to them here, one call on a line, for `tests/gallery/module.mjs`, which puts them to the kernel
//! built for WebAssembly: `.ci/kernel`. With the argument `sources` only the digest of what the kernel is built from.
//!
//! A line is a JSON object: `new` starts with a new instance; `request` and the numbers `given` with it are answered by `json` and `numbers`; `pose`
//! and `joint` are the arguments of those calls, answered by `numbers`. Numbers are the hexadecimal digits of their bytes.

use std::collections::BTreeSet;
use std::env;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use coupler_curves::geometry::trig;
use coupler_curves::linkage::JointKind;
use coupler_drawing::curve_file::CurveFormat;
use coupler_kernel::Kernel;
use coupler_manifest::{self as manifest, PlannedFamily};
use serde_json::{Value, json};

use generator::{KIND_COUNT, Random, manifest as random_manifest};

#[path = "../../../tests/integration/random_linkages/generator.rs"]
mod generator;
#[path = "../build/sources.rs"]
mod sources;

fn main() -> io::Result<()> {
    let digest = sources::digest(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")))?;
    let mut out = BufWriter::new(io::stdout().lock());
    if env::args().nth(1).is_some_and(|argument| argument == "sources") {
        return writeln!(out, "{digest}");
    }
    let (mut families, mut kinds) = (0, BTreeSet::new());
    for seed in 0..4 {
        let mut session = Session::start(&mut out)?;
        for planned in &random_families(seed) {
            let linkage = planned.family.linkage(&planned.family.cell(0)).unwrap();
            kinds.extend(linkage.joints.iter().map(|joint| name(joint.kind)));
            session.ask_about_first_cell(planned, seed as usize)?;
        }
        families += session.families;
        assert!(session.calls > 8 * session.families, "{} calls, {} families", session.calls, session.families);
    }
    // Every kind of joint is among them.
    let joints = "Aligned Crank DrivenSlider Dyad Fixed Gear Parallelogram Piston Rigid Slide Slot Yoke";
    assert_eq!(kinds.into_iter().collect::<Vec<_>>().join(" "), joints);
    assert!(families > 50, "{families} families");
    Session::start(&mut out)?.search()
}

/// The name of a kind of joint.
fn name(kind: JointKind) -> String {
    format!("{kind:?}").split(|c: char| !c.is_alphabetic()).next().unwrap_or_default().to_owned()
}

/// The families of a random manifest, with one for each kind of linkage.
fn random_families(seed: u64) -> Vec<PlannedFamily> {
    let text = random_manifest(&mut Random(seed), 0..KIND_COUNT, 1);
    let outcome = manifest::parse(&text);
    outcome.plan.unwrap_or_else(|| panic!("{text}\n{:?}", outcome.problems)).families
}

/// The bytes of numbers, in hexadecimal digits; of a NaN, whose sign depends on the processor, those of one and the same.
fn hex(numbers: &[f64]) -> String {
    let bytes = numbers.iter().flat_map(|number| if number.is_nan() { f64::NAN } else { *number }.to_le_bytes());
    bytes.map(|byte| format!("{byte:02x}")).collect()
}

/// The calls to one instance of the kernel.
struct Session<'a, W: Write> {
    out: &'a mut W,
    kernel: Kernel,
    /// The families asked about, and the requests.
    families: usize,
    calls: usize,
}

impl<'a, W: Write> Session<'a, W> {
    fn start(out: &'a mut W) -> io::Result<Session<'a, W>> {
        writeln!(out, "{}", json!({ "new": true }))?;
        Ok(Session { out, kernel: Kernel::default(), families: 0, calls: 0 })
    }

    /// The answer to a request.
    fn ask(&mut self, request: &Value) -> io::Result<Value> {
        self.ask_with_numbers(request, &[])
    }

    fn ask_with_numbers(&mut self, request: &Value, given: &[f64]) -> io::Result<Value> {
        let request = request.to_string();
        let answer = self.kernel.call_with_numbers(&request, given);
        let (given, numbers) = (hex(given), hex(&answer.numbers));
        let line = json!({ "request": request, "given": given, "json": answer.json, "numbers": numbers });
        writeln!(self.out, "{line}")?;
        self.calls += 1;
        Ok(serde_json::from_str(&answer.json)?)
    }

    fn ask_pose(&mut self, study: u64, pass: usize, input: f64) -> io::Result<()> {
        let mut numbers = Vec::new();
        self.kernel.pose(study as usize, pass, input, &mut numbers);
        writeln!(self.out, "{}", json!({ "pose": [study, pass, input], "numbers": hex(&numbers) }))?;
        let joint = (numbers.len() - Kernel::POSE_HEADER) / 2 - 1;
        let position = self.kernel.joint_position(study as usize, joint, pass, input);
        writeln!(self.out, "{}", json!({ "joint": [study, joint, pass, input], "numbers": hex(&position) }))
    }

    /// Everything that the page asks about a curve of a family's first cell, and its file in one format, another for each family.
    fn ask_about_first_cell(&mut self, planned: &PlannedFamily, seed: usize) -> io::Result<()> {
        let family = &planned.family;
        let cell = family.cell(0);
        let handle = self.ask(&json!({ "method": "open_family", "manifest": planned.excerpt() }))?["family"].clone();
        assert!(handle.is_number(), "{}", planned.excerpt());
        self.ask(&json!({ "method": "first_cell", "family": handle }))?;
        // As strings, which the kernel reads to the last bit.
        let value = |slot: usize| (family.names[slot].as_str(), cell.values[slot].to_string());
        let values: Vec<(&str, String)> = family.space.slots_of(0).map(value).collect();
        let curve = json!({ "family": handle, "cell": 1, "curve": [1, 1], "values": values, "changes": [] });
        let opened = self.ask(&json!({ "method": "open_study", "curve": curve, "shown": null, "is_rough": false }))?;
        if let Some(study) = opened["study"].as_u64() {
            let shown = opened["shown"].as_u64().and_then(|shown| opened["circuits"].get(shown as usize));
            for (number, pass) in shown.and_then(|circuit| circuit["passes"].as_array()).unwrap().iter().enumerate() {
                let [from, to] = ["from", "to"].map(|end| pass[end].as_f64().unwrap());
                for part in [0.0, 0.37, 1.0] {
                    self.ask_pose(study, number, if part == 1.0 { to } else { from + (to - from) * part })?;
                }
            }
            for request in [
                json!({ "method": "measures", "study": study }),
                json!({ "method": "path", "study": study, "tolerance": 1e-2 }),
                json!({ "method": "speeds", "study": study, "count": 50 }),
                json!({ "method": "joint_motion", "study": study, "joint": 1, "count": 50, "place": null, "load": null }),
                json!({ "method": "cognates", "study": study }),
                json!({ "method": "centrodes", "study": study, "samples": 50 }),
                json!({ "method": "nearest", "study": study, "point": [1.5, 0.5] }),
                json!({ "method": "close_study", "study": study }),
            ] {
                self.ask(&request)?;
            }
        }
        self.ask(&json!({ "method": "curve_data", "curve": curve }))?;
        let format = CurveFormat::ALL[(self.families + seed) % CurveFormat::ALL.len()];
        self.families += 1;
        self.ask(&json!({ "method": "export", "curve": curve, "format": format.name() }))?;
        self.ask(&json!({ "method": "close_family", "family": handle }))?;
        Ok(())
    }

    /// The catalogue, a search for four-bars, and one for curves by their shape.
    fn search(&mut self) -> io::Result<()> {
        self.ask(&json!({ "method": "catalogue" }))?;
        self.ask(&json!({ "method": "grow_index" }))?;
        let point = |k: usize| {
            let t = std::f64::consts::TAU * k as f64 / 24.0;
            [3.0 * trig::cos(t) + 0.4 * trig::cos(2.0 * t), 2.0 * trig::sin(t)]
        };
        let points: Vec<f64> = (0..24).flat_map(point).collect();
        let array = json!({ "$": [0, points.len()] });
        let options = json!({
            "points": array, "kind": "closed", "full_turn": false, "max_link": "inf", "most": 1,
            "pivots": null, "condition": "mu_worst_deg >= 1", "refine": true, "start": null,
        });
        let with_options = |method: &str, more: &Value| {
            let mut request = json!({ "method": method });
            let members = [&options, more].into_iter().flat_map(|part| part.as_object().unwrap().clone());
            request.as_object_mut().unwrap().extend(members);
            request
        };
        self.ask_with_numbers(&with_options("open_search", &json!({})), &points)?;
        for _ in 0..900 {
            self.ask(&json!({ "method": "step_search", "search": 0 }))?;
        }
        let request = json!({ "method": "answers", "search": 0, "name": "egg" });
        let found = loop {
            let found = self.ask(&request)?;
            if found["is_complete"] == true {
                break found;
            }
        };
        assert_eq!(found["answers"].as_array().unwrap().len(), 1, "{found}");
        for file in ["<svg><path d='M0 0C1 2 3 4 9 0' stroke='red'/></svg>", "x,y\n1,2\n3,4\n5,1", "[[1, 2], 3]"] {
            let bytes: Vec<f64> = file.bytes().map(f64::from).collect();
            let request = json!({ "method": "read_path", "bytes": { "$": [0, bytes.len()] }, "outline": null });
            self.ask_with_numbers(&request, &bytes)?;
        }
        // The path itself, and a curve like nothing.
        self.ask(&json!({ "method": "open_curves", "count": 2 }))?;
        let other = [0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 24.0, 3.0, 1.0, 0.0];
        let curves: Vec<f64> = points.iter().copied().chain(other).collect();
        let at = |start: usize, length: usize| json!({ "$": [start, length] });
        let added = json!({ "method": "add_curves", "curves": 0, "points": at(0, 54), "counts": at(54, 2), "closed": at(56, 2) });
        assert_eq!(self.ask_with_numbers(&added, &curves)?["count"], 2);
        let shape = with_options("open_shape", &json!({ "mirror": true, "least": 0.15, "wanted": 1 }));
        self.ask_with_numbers(&shape, &points)?;
        let compared = self.ask(&json!({ "method": "compare_shape", "shape": 0, "curves": 0, "from": 0 }))?;
        assert_eq!(compared["next"], Value::Null);
        let closely = json!({ "method": "compare_closely", "shape": 0, "points": at(0, 54), "counts": at(54, 2), "closed": at(56, 2) });
        self.ask_with_numbers(&closely, &curves)?;
        let fit = json!({ "method": "fit_shape", "shape": 0, "points": array, "closed": true });
        assert!(self.ask_with_numbers(&fit, &points)?["fit"]["rms"].as_f64().unwrap() < 1e-6);
        let deviation = json!({ "method": "deviation", "from": array, "points": array, "closed": true });
        self.ask_with_numbers(&deviation, &points)?;
        Ok(())
    }
}

//! The module of the gallery returns bit for bit what the kernel that it is built from returns here.
//!
//! That of the repository, or with `KERNEL_MODULE=FILE` another, such as one that has just been built.

use std::collections::BTreeSet;
use std::env;
use std::fs;
use std::io::Read;
use std::path::Path;

use coupler_curves::family::Sampling;
use coupler_curves::geometry::trig;
use coupler_curves::motion::{Motion, Sampler};
use coupler_drawing::curve_file::CurveFormat;
use coupler_kernel::{Kernel, Response};
use coupler_manifest::{self as manifest, PlannedFamily};
use serde_json::{Value, json};
use wasmi::{Engine, Instance, Linker, Module, Store, TypedFunc};

use generator::{KIND_COUNT, Random, manifest as random_manifest};

#[path = "../../../tests/integration/random_linkages/generator.rs"]
mod generator;
#[path = "../build/sources.rs"]
mod sources;

/// The root of the repository.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// The module of the repository.
fn recorded() -> Vec<u8> {
    let packed = fs::read(Path::new(ROOT).join("src/gallery/kernel.wasm.gz")).unwrap();
    let mut bytes = Vec::new();
    flate2::read::GzDecoder::new(&packed[..]).read_to_end(&mut bytes).unwrap();
    bytes
}

/// The module, as the page runs it.
struct Page {
    store: Store<()>,
    instance: Instance,
}

impl Page {
    /// A page with the module that is tested.
    fn new() -> Page {
        Page::with(&env::var_os("KERNEL_MODULE").map_or_else(recorded, |path| fs::read(path).unwrap()))
    }

    fn with(module: &[u8]) -> Page {
        let engine = Engine::default();
        let module = Module::new(&engine, module).unwrap();
        assert_eq!(module.imports().count(), 0, "the page gives the module nothing");
        let mut store = Store::new(&engine, ());
        let instance = Linker::new(&engine).instantiate_and_start(&mut store, &module).unwrap();
        let mut page = Page { store, instance };
        page.function::<(), ()>("kernel_start").call(&mut page.store, ()).unwrap();
        page
    }

    fn function<P: wasmi::WasmParams, R: wasmi::WasmResults>(&self, name: &str) -> TypedFunc<P, R> {
        self.instance.get_typed_func(&self.store, name).unwrap()
    }

    fn read(&self, at: u32, length: usize) -> Vec<u8> {
        let memory = self.instance.get_memory(&self.store, "memory").unwrap();
        memory.data(&self.store)[at as usize..at as usize + length].to_vec()
    }

    fn numbers(&self, at: u32, count: usize) -> Vec<f64> {
        let bytes = self.read(at, 8 * count);
        bytes.chunks(8).map(|number| f64::from_le_bytes(number.try_into().unwrap())).collect()
    }

    fn call(&mut self, request: &str) -> Response {
        self.call_with_numbers(request, &[])
    }

    fn call_with_numbers(&mut self, request: &str, numbers: &[f64]) -> Response {
        let input = self.function::<u32, u32>("kernel_numbers").call(&mut self.store, numbers.len() as u32).unwrap();
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        let memory = self.instance.get_memory(&self.store, "memory").unwrap();
        memory.write(&mut self.store, input as usize, &bytes).unwrap();
        let allocate = self.function::<u32, u32>("kernel_allocate");
        let at = allocate.call(&mut self.store, request.len() as u32).unwrap();
        let memory = self.instance.get_memory(&self.store, "memory").unwrap();
        memory.write(&mut self.store, at as usize, request.as_bytes()).unwrap();
        let call = self.function::<(u32, u32), u32>("kernel_call");
        let parts = call.call(&mut self.store, (at, request.len() as u32)).unwrap();
        let parts = self.read(parts, 16);
        let part = |k: usize| u32::from_le_bytes(parts[4 * k..4 * k + 4].try_into().unwrap());
        let json = String::from_utf8(self.read(part(0), part(1) as usize)).unwrap();
        Response { json, numbers: self.numbers(part(2), part(3) as usize) }
    }

    fn pose(&mut self, study: u32, pass: u32, input: f64) -> Vec<f64> {
        let pose = self.function::<(u32, u32, f64), u32>("kernel_pose");
        let at = pose.call(&mut self.store, (study, pass, input)).unwrap();
        let count = self.function::<(), u32>("kernel_pose_length").call(&mut self.store, ()).unwrap();
        self.numbers(at, count as usize)
    }

    fn joint_position(&mut self, study: u32, joint: u32, pass: u32, input: f64) -> Vec<f64> {
        let position = self.function::<(u32, u32, u32, f64), u32>("kernel_joint_position");
        let at = position.call(&mut self.store, (study, joint, pass, input)).unwrap();
        self.numbers(at, 2)
    }
}

/// The bits of numbers; those of a NaN, whose sign depends on the processor, are left open.
fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| if number.is_nan() { f64::NAN.to_bits() } else { number.to_bits() }).collect()
}

/// Both kernels.
struct Both {
    page: Page,
    kernel: Kernel,
    compared: usize,
}

impl Both {
    /// The answer to a request, which must be the same of both.
    fn answer(&mut self, request: &Value) -> Value {
        self.answer_with_numbers(request, &[])
    }

    fn answer_with_numbers(&mut self, request: &Value, numbers: &[f64]) -> Value {
        let request = request.to_string();
        let found = self.page.call_with_numbers(&request, numbers);
        let expected = self.kernel.call_with_numbers(&request, numbers);
        assert!(found.json == expected.json, "{request}\n{}\n{}", found.json, expected.json);
        assert_eq!(bits(&found.numbers), bits(&expected.numbers), "{request}");
        self.compared += 1;
        serde_json::from_str(&found.json).unwrap()
    }

    fn pose(&mut self, study: u64, pass: usize, input: f64) {
        let mut expected = Vec::new();
        self.kernel.pose(study as usize, pass, input, &mut expected);
        let found = self.page.pose(study as u32, pass as u32, input);
        assert_eq!(bits(&found), bits(&expected));
        let joint = (expected.len() - Kernel::POSE_HEADER) / 2 - 1;
        let position = self.kernel.joint_position(study as usize, joint, pass, input);
        assert_eq!(bits(&self.page.joint_position(study as u32, joint as u32, pass as u32, input)), bits(&position));
    }

    /// Compares everything that the page asks about a curve of a family's first cell, and its file in a format.
    fn compare_first_cell(&mut self, planned: &PlannedFamily, format: CurveFormat) {
        let family = &planned.family;
        let cell = family.cell(0);
        let handle = self.answer(&json!({ "method": "open_family", "manifest": planned.excerpt() }))["family"].clone();
        assert!(handle.is_number(), "{}", planned.excerpt());
        // As strings, which the kernel reads to the last bit.
        let value = |slot: usize| (family.names[slot].as_str(), cell.values[slot].to_string());
        let values: Vec<(&str, String)> = family.space.slots_of(0).map(value).collect();
        let curve = json!({ "family": handle, "cell": 1, "curve": [1, 1], "values": values, "changes": [] });
        let opened = self.answer(&json!({ "method": "open_study", "curve": curve, "shown": null, "is_rough": false }));
        if let Some(study) = opened["study"].as_u64() {
            let circuit = &opened["circuits"][opened["shown"].as_u64().unwrap() as usize];
            for (number, pass) in circuit["passes"].as_array().unwrap().iter().enumerate() {
                let [from, to] = ["from", "to"].map(|end| pass[end].as_f64().unwrap());
                for part in [0.0, 0.37, 1.0] {
                    self.pose(study, number, if part == 1.0 { to } else { from + (to - from) * part });
                }
            }
            for request in [
                json!({ "method": "measures", "study": study }),
                json!({ "method": "path", "study": study, "tolerance": 1e-2 }),
                json!({ "method": "speeds", "study": study, "count": 50 }),
                json!({ "method": "cognates", "study": study }),
                json!({ "method": "centrodes", "study": study, "samples": 50 }),
                json!({ "method": "nearest", "study": study, "point": [1.5, 0.5] }),
                json!({ "method": "close_study", "study": study }),
            ] {
                self.answer(&request);
            }
        }
        self.answer(&json!({ "method": "export", "curve": curve, "format": format.name() }));
        self.answer(&json!({ "method": "close_family", "family": handle }));
    }
}

/// Between renewals the module of the repository is an earlier one.
#[test]
#[ignore = "once for a change: `.ci/kernel exact` runs it"]
fn the_module_of_the_repository_is_that_of_its_sources() {
    let mut page = Page::with(&recorded());
    let about: Value = serde_json::from_str(&page.call(&json!({ "method": "about" }).to_string()).json).unwrap();
    let digest = sources::digest(Path::new(ROOT)).unwrap();
    assert_eq!(about["sources"], digest, "the module is stale: run .ci/kernel update");
    assert!(about["compiler"].as_str().unwrap().starts_with("rustc 1."));
}

/// What was compared: the numbers of cells and of answers, and the kinds of their joints.
type Compared = (usize, usize, BTreeSet<String>);

/// The module is interpreted here, a hundred times as slowly as in a page: circuits in more pieces take too long.
const MANY_PIECES: usize = 60;

/// Compares the families of a random manifest, with one for each kind of linkage.
fn compare_random_linkages(seed: u64) -> Compared {
    let mut both = Both { page: Page::new(), kernel: Kernel::default(), compared: 0 };
    let text = random_manifest(&mut Random(seed), 0..KIND_COUNT, 1);
    let outcome = manifest::parse(&text);
    let plan = outcome.plan.unwrap_or_else(|| panic!("{text}\n{:?}", outcome.problems));
    // The module is interpreted here, a hundred times as slowly as in a page.
    let has_few_samples = |planned: &&PlannedFamily| match planned.family.sampling {
        Sampling::Samples(n) | Sampling::DenseAtLimits(n) | Sampling::ArcLength(n) => n <= 400,
        Sampling::Step(step) => step >= 1.0,
    };
    let (mut cells, mut kinds) = (0, BTreeSet::new());
    for planned in plan.families.iter().filter(has_few_samples) {
        let linkage = planned.family.linkage(&planned.family.cell(0)).unwrap();
        // Between limits that are hardly apart a circuit is in a thousand pieces.
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(4)));
        if motion.circuits.iter().any(|circuit| circuit.pieces(&linkage).len() > MANY_PIECES) {
            continue;
        }
        kinds.extend(linkage.joints.iter().map(|joint| format!("{:?}", joint.kind)));
        // The next family has the next format.
        both.compare_first_cell(planned, CurveFormat::ALL[(cells + seed as usize) % CurveFormat::ALL.len()]);
        cells += 1;
    }
    let name = |kind: String| kind.split(|c: char| !c.is_alphabetic()).next().unwrap_or_default().to_owned();
    (cells, both.compared, kinds.into_iter().map(name).collect())
}

#[test]
fn the_module_returns_what_the_kernel_returns_here() {
    let all = |a: Compared, b: Compared| (a.0 + b.0, a.1 + b.1, &a.2 | &b.2);
    let (cells, answers, kinds) = [0, 2].map(compare_random_linkages).into_iter().fold(Compared::default(), all);
    assert!(cells > 50 && answers > 8 * cells, "{cells} cells, {answers} answers");
    let joints = "Aligned Crank Dyad Fixed Gear Parallelogram Piston Rigid Slide Slot Yoke";
    assert_eq!(kinds.into_iter().collect::<Vec<_>>().join(" "), joints);
}

#[test]
fn the_module_finds_what_the_kernel_finds_here() {
    let mut both = Both { page: Page::new(), kernel: Kernel::default(), compared: 0 };
    both.answer(&json!({ "method": "grow_index" }));
    let point = |k: usize| {
        let t = std::f64::consts::TAU * k as f64 / 24.0;
        [3.0 * trig::cos(t) + 0.4 * trig::cos(2.0 * t), 2.0 * trig::sin(t)]
    };
    let points: Vec<f64> = (0..24).flat_map(point).collect();
    let array = json!({ "$": [0, points.len()] });
    let options = json!({ "points": array, "kind": "closed", "full_turn": false, "max_link": "inf", "most": 1 });
    let with_options = |method: &str, more: &Value| {
        let mut request = json!({ "method": method });
        let members = [&options, more].into_iter().flat_map(|part| part.as_object().unwrap().clone());
        request.as_object_mut().unwrap().extend(members);
        request
    };
    both.answer_with_numbers(&with_options("open_search", &json!({})), &points);
    for _ in 0..900 {
        both.answer(&json!({ "method": "step_search", "search": 0 }));
    }
    let request = json!({ "method": "answers", "search": 0, "name": "egg" });
    let found = std::iter::repeat_with(|| both.answer(&request)).find(|found| found["is_complete"] == true).unwrap();
    assert_eq!(found["answers"].as_array().unwrap().len(), 1, "{found}");
    // The path itself, and a curve like nothing.
    both.answer(&json!({ "method": "open_curves" }));
    let curves: Vec<f64> = points.iter().copied().chain([0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 24.0, 3.0, 1.0, 0.0]).collect();
    let at = |start: usize, length: usize| json!({ "$": [start, length] });
    let added =
        json!({ "method": "add_curves", "curves": 0, "points": at(0, 54), "counts": at(54, 2), "closed": at(56, 2) });
    assert_eq!(both.answer_with_numbers(&added, &curves)["count"], 2);
    both.answer_with_numbers(
        &with_options("open_shape", &json!({ "mirror": true, "least": 0.15, "wanted": 1 })),
        &points,
    );
    let compared = both.answer(&json!({ "method": "compare_shape", "shape": 0, "curves": 0, "from": 0 }));
    assert_eq!(compared["next"], Value::Null);
    let fit = json!({ "method": "fit_shape", "shape": 0, "points": array, "closed": true });
    assert!(both.answer_with_numbers(&fit, &points)["fit"]["rms"].as_f64().unwrap() < 1e-6);
    let deviation = json!({ "method": "deviation", "from": array, "points": array, "closed": true });
    both.answer_with_numbers(&deviation, &points);
}

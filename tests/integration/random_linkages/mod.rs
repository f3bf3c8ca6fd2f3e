//! Random linkages are rendered, and checked at once: the check finds nothing. Their splines are within the tolerance.

pub mod generator;

use std::fs;
use std::path::Path;

use coupler_curves::geometry::{Bounds, Capsule, CapsuleTree, Point, Spline};
use coupler_curves::linkage::{JointId, Linkage};
use coupler_curves::motion::{self, Circuit, Motion, Pass, Sampler, Sampling, eased_input};
use coupler_curves::path::{DashPattern, joint_path};
use sha2::{Digest, Sha256};

use crate::support::folder::{Atlas, edit_record};
use crate::support::plan::plan;
use generator::{KIND_COUNT, Random};

/// The findings of a check right after the render, and of one after each page was given a comment: pages with other bytes
/// than those of a fresh drawing are read back, and their curves compared with the linkages.
fn findings(text: &str) -> [Vec<serde_json::Value>; 2] {
    let atlas = Atlas::rendered(text, &["-q", "-o", "out"]);
    let first = check(&atlas, text);
    add_comments(&atlas);
    [first, check(&atlas, text)]
}

fn check(atlas: &Atlas, text: &str) -> Vec<serde_json::Value> {
    let (_, out, err) = atlas.check(&["--report", "json", "-q"]);
    let report: serde_json::Value = serde_json::from_str(&out).unwrap_or_else(|_| panic!("{err}\n{text}"));
    assert!(report["curves"].as_u64().is_some_and(|curves| curves > 50), "{report}\n{text}");
    report["findings"].as_array().unwrap().clone()
}

/// Adds a comment to each page, and records its digest as if a run had written it so.
fn add_comments(atlas: &Atlas) {
    let add_comment = |folder: &Path, file: &mut serde_json::Value| {
        let path = folder.join(file["name"].as_str().unwrap());
        if path.extension().is_some_and(|extension| extension == "svg") {
            let page = fs::read_to_string(&path).unwrap().replace("</svg>", "<!-- --></svg>");
            file["sha256"] = format!("{:x}", Sha256::digest(&page)).into();
            fs::write(path, page).unwrap();
        }
    };
    edit_record(&atlas.out(), |run| {
        for family in run["families"].as_array_mut().unwrap() {
            let folder = atlas.out().join(family["id"].as_str().unwrap());
            family["files"].as_array_mut().unwrap().iter_mut().for_each(|file| add_comment(&folder, file));
        }
    });
}

/// A number from the environment.
fn number(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| text.parse().unwrap())
}

/// Renders and checks at least so many random linkages.
fn check_random_linkages(count: u64) {
    const CELLS: usize = 3;
    let manifests = (count as usize).div_ceil(CELLS * KIND_COUNT);
    let mut random = Random(number("RANDOM_SEED", 1951));
    for _ in 0..manifests {
        let text = generator::manifest(&mut random, 0..KIND_COUNT, CELLS);
        let [found, read_back] = findings(&text);
        assert!(found.is_empty(), "{found:#?}\n{text}");
        let is_comment = |finding: &serde_json::Value| finding["kind"] == "drawing";
        assert!(!read_back.is_empty() && read_back.iter().all(is_comment), "{read_back:#?}\n{text}");
    }
}

/// Three of each kind.
#[test]
#[ignore = "thorough"]
fn a_check_right_after_the_render_finds_nothing() {
    check_random_linkages(1);
}

/// `RANDOM_LINKAGES=5000` sets their number, and `RANDOM_SEED=…` the seed.
#[test]
#[ignore = "thorough"]
fn a_check_of_many_linkages_right_after_the_render_finds_nothing() {
    check_random_linkages(number("RANDOM_LINKAGES", 1000));
}

/// Positions at ten times as many inputs as a page has dashes and gaps are on the splines, and dashes end where their
/// inputs do.
#[test]
fn splines_are_within_their_tolerance() {
    const CELLS: usize = 2;
    const DASHES: f64 = 60.0;
    let plan = plan(&generator::manifest(&mut Random(1952), 0..KIND_COUNT, CELLS));
    let mut count = 0;
    for planned in &plan.families {
        let family = &planned.family;
        // The families may have few samples, which say nothing about the extent.
        let sampler = Sampler::new(Sampling::Samples(180));
        let cells = (0..family.cell_count()).filter_map(|k| family.linkage(&family.cell(k)).ok());
        for linkage in cells {
            for circuit in &Motion::solve(&linkage, &sampler).circuits {
                let longest = circuit.passes.iter().map(Pass::input_length).fold(0.0, f64::max);
                let pattern = DashPattern { period: longest / DASHES, dash_span: 0.6 * longest / DASHES };
                for &joint in &linkage.traced {
                    let extent = Bounds::from_points(circuit.points(joint)).size().max();
                    check_splines(&linkage, circuit, joint, (pattern, 1e-4 * extent), &family.id);
                    count += 1;
                }
            }
        }
    }
    assert!(count > 100, "{count}");
}

fn check_splines(
    linkage: &Linkage,
    circuit: &Circuit,
    joint: JointId,
    (pattern, tolerance): (DashPattern, f64),
    family: &str,
) {
    let path = joint_path(linkage, circuit, joint, pattern, tolerance);
    let chords = |splines: &mut dyn Iterator<Item = &Spline>| {
        let capsule = |pair: &[Point]| Capsule { ends: [pair[0], pair[1]], radius: 0.0 };
        let of_spline = |spline: &Spline| spline.flatten(1e-2 * tolerance).windows(2).map(capsule).collect::<Vec<_>>();
        CapsuleTree::new(splines.flat_map(of_spline).collect())
    };
    let whole = chords(&mut path.whole.iter());
    let dashed = chords(&mut path.dashes.iter().map(|dash| &dash.spline));
    // Chords, and rounding of positions where the curve is small for its linkage.
    let enough = 1.01 * tolerance + 1e-13 * circuit.points(joint).map(|p| p.coords.norm()).fold(1.0, f64::max);
    let mut travel = 0.0;
    for pass in &circuit.passes {
        let count = (pass.input_length() / pattern.period * 20.0).ceil().max(200.0) as usize;
        let inputs: Vec<f64> = (0..=count).map(|k| eased_input(pass, k as f64 / count as f64)).collect();
        let positions = motion::poses(linkage, pass, &inputs);
        for (k, input) in inputs.iter().enumerate() {
            let point = positions.point(joint, k);
            if !(point.x.is_finite() && point.y.is_finite()) {
                continue;
            }
            let distance = whole.signed_distance(point, enough);
            assert!(distance <= enough, "{family}: {} of the tolerance at {input}", distance / tolerance);
            let at = travel + (input - pass.from.input.value).abs();
            let margin = 1e-6 * pattern.period;
            let is_first = path
                .dashed_travel
                .as_ref()
                .is_none_or(|stretches| stretches.iter().any(|[from, to]| from + margin < at && at < to - margin));
            let phase = input.rem_euclid(pattern.period);
            if is_first && margin < phase && phase < pattern.dash_span - margin {
                let distance = dashed.signed_distance(point, enough);
                assert!(distance <= enough, "{family}: {} of the tolerance in a dash at {input}", distance / tolerance);
            }
        }
        travel += pass.input_length();
    }
}

//! Chapter 10: designs for given requirements, with each design measured independently.

use coupler_curves::linkage::JointId;
use std::path::Path;

use coupler_atlas::design::{
    self, Design, Driver, LinkageKind, ProportionOrigin, Requirement, Requirements, SynthesisResult,
};
use coupler_curves::family::{Sampling, StraightCriterion};
use coupler_curves::geometry::{Point, trig};
use coupler_curves::measure::{self, TracedCurve, Value};
use coupler_curves::motion::{Motion, Sampler};
use proptest::prelude::*;
use serde_json::Value as Json;
use tempfile::TempDir;

use crate::support::command::{Ran, program};
use crate::support::folder::Atlas;
use crate::support::plan::faultless_plan;
use crate::support::table;

fn number(curve: &TracedCurve, name: &str) -> f64 {
    let measure = measure::ALL.iter().find(|measure| measure.name == name).unwrap();
    match (measure.compute)(curve) {
        Value::Number(number) => number,
        other => panic!("{name} is {other:?}"),
    }
}

/// The straight length, deviation, size and transmission angle of a design, measured with twice its samples.
fn measure_again(design: &Design) -> [f64; 4] {
    let Design { family, .. } = design;
    let linkage = family.linkage(&family.cell(0)).unwrap();
    let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(720)));
    let circuit = &motion.circuits[0];
    // A search ends where a wave of the curve just fits its strip; with twice the samples that wave is a little higher.
    let straight = StraightCriterion::Tolerance(design.tolerance * 1.005);
    let curve = TracedCurve::new(&linkage, &motion, circuit, linkage.traced[0]).with_straight_criterion(straight);
    let portion = curve.straight().unwrap();
    let joints = linkage.joint_ids();
    let extent = |samples: &[usize]| {
        let points: Vec<Point> =
            joints.clone().flat_map(|joint| samples.iter().map(move |&k| circuit.positions.point(joint, k))).collect();
        points.iter().flat_map(|a| points.iter().map(move |b| (a - b).norm())).fold(0.0, f64::max)
    };
    let acute = |deg: f64| deg.min(180.0 - deg);
    let (size, mu) = match design.driven_linkage.input {
        Driver::Motor => {
            assert!(circuit.is_closed && circuit.passes.len() == 1, "a motor turns it fully");
            // Every fourth sample: the greatest distance is known to (pi / 180)^2 / 2.
            let samples: Vec<usize> = (0..circuit.len()).step_by(4).collect();
            (extent(&samples), acute(number(&curve, "mu_min_deg")).min(acute(number(&curve, "mu_max_deg"))))
        }
        Driver::Rocker => {
            // The samples on the portion: within its strip and between its ends.
            let [a, b] = [portion.points[0], portion.points[portion.points.len() - 1]];
            let along = (b - a) / (b - a).norm();
            let is_on = |k: &usize| {
                let off = circuit.positions.point(linkage.traced[0], *k) - a;
                let (s, h) = (along.dot(&off), along.x * off.y - along.y * off.x);
                (0.0..=portion.length).contains(&s) && h.abs() <= 2.01 * portion.deviation
            };
            let samples: Vec<usize> = (0..circuit.len()).filter(is_on).collect();
            let named = |name: &str| linkage.find_joint(name).unwrap();
            let [o, a, b, c] = ["O", "A", "B", "C"].map(named);
            let angle = |k: usize, [p, q, r]: [JointId; 3]| {
                let at = |joint| circuit.positions.point(joint, k);
                acute((at(p) - at(q)).angle(&(at(r) - at(q))).to_degrees())
            };
            let least = |pins| samples.iter().map(|&k| angle(k, pins)).fold(90.0, f64::min);
            (extent(&samples), least([a, b, c]).max(least([o, a, b])))
        }
    };
    let criterion = StraightCriterion::Length(design.straight.length * (1.0 - 1e-6));
    let whole = TracedCurve::new(&linkage, &motion, circuit, linkage.traced[0]).with_straight_criterion(criterion);
    [portion.length, whole.straight().unwrap().deviation, size, mu]
}

/// Asserts that all designs meet the requirements.
fn check(requirements: &Requirements, found: &SynthesisResult) {
    // With samples twice as dense, measures agree to a part in a thousand.
    const SAMPLED: f64 = 1e-3;
    // The ends of a portion are moved between samples one after the other, so its greatest length is known to a
    // hundredth. Whether a portion of the required length is straight enough is checked separately.
    const LONGEST: f64 = 1e-2;
    for design in &found.designs {
        let name = format!("{requirements:?}: {:?} {:?}", design.driven_linkage, design.solved_cell.cell.values);
        let [length, deviation, size, mu] = measure_again(design);
        assert!((length / design.straight.length - 1.0).abs() < LONGEST, "{name}: {length}");
        assert!(
            2.0 * deviation <= requirements.tolerance * design.straight.length * (1.0 + SAMPLED),
            "{name}: {deviation}"
        );
        assert!(mu >= requirements.mu_min - 0.05 && mu >= design.performance.mu_min - 0.5, "{name}: {mu}");
        assert!(size <= design.performance.size * (1.0 + SAMPLED), "{name}: {size} {}", design.performance.size);
        if let Some(length) = requirements.length {
            assert!((design.straight.length / length - 1.0).abs() < 1e-9, "{name}");
        }
        if let Some(size) = requirements.size {
            assert!(design.performance.size <= size * (1.0 + 1e-9), "{name}");
        }
        if let Some(p) = requirements.p {
            let unit =
                if matches!(design.driven_linkage.kind, LinkageKind::Evans | LinkageKind::Hoeken) { "r" } else { "a" };
            assert!((design.parameter("p") / design.parameter(unit) - p).abs() < 1e-12 * p, "{name}");
        }
        assert!(requirements.input.is_none_or(|input| input == design.driven_linkage.input), "{name}");
        assert!(requirements.double_point.is_none_or(|required| required == (design.crunode_count > 0)), "{name}");
        assert!(!requirements.quick_return || design.time_ratio() > Some(1.0), "{name}");
        let class = design.class;
        assert!(
            match design.driven_linkage.kind {
                LinkageKind::Evans | LinkageKind::Hoeken => class == "crank-rocker",
                LinkageKind::Chebyshev => class == "double-rocker",
                LinkageKind::Watt => class == "triple-rocker",
                LinkageKind::Roberts => class == "double-rocker" || class == "triple-rocker",
            },
            "{name}: {class}"
        );
    }
}

fn hoeken() -> Requirements {
    Requirements { kinds: vec![LinkageKind::Hoeken], ..Requirements::default() }
}

fn watt_and_roberts() -> Requirements {
    Requirements { kinds: vec![LinkageKind::Watt, LinkageKind::Roberts], ..Requirements::default() }
}

fn searched_design(found: &SynthesisResult) -> &Design {
    found.designs.iter().find(|design| design.origin == ProportionOrigin::Search).unwrap()
}

#[test]
#[ignore = "thorough"]
fn the_closed_conditions_are_those_of_the_thesis() {
    let all = Requirements { p: Some(2.0), mu_min: 0.0, max_designs: 20, ..Requirements::default() };
    let found = design::straight_line(&all);
    check(&all, &found);
    let closed = |kind, input| {
        let is_it = |d: &&Design| {
            d.origin == ProportionOrigin::ClosedCondition
                && d.driven_linkage.kind == kind
                && d.driven_linkage.input == input
        };
        found.designs.iter().find(is_it).unwrap_or_else(|| panic!("{kind:?}"))
    };
    // 3^1.5 / 2, by (8.10) and (8.19).
    let straight = 27.0f64.sqrt() / 2.0;
    for (kind, input, names) in [
        (LinkageKind::Evans, Driver::Motor, ["a", "s"]),
        (LinkageKind::Chebyshev, Driver::Motor, ["r", "s"]),
        (LinkageKind::Chebyshev, Driver::Rocker, ["r", "s"]),
    ] {
        let design = closed(kind, input);
        for name in names {
            assert!((design.parameter(name) - straight).abs() < 1e-14, "{kind:?} {name}");
        }
    }
    // Hoeken's by (8.10) is Evans's, and is not shown twice.
    assert!(found.rejected.iter().any(|one| one.is_closed_form && one.driven_linkage.kind == LinkageKind::Hoeken));
    // Evans's curve by (8.10) is Chebyshev's by (8.19) at twice the size: they are cognates.
    let lengths = [LinkageKind::Evans, LinkageKind::Chebyshev].map(|kind| closed(kind, Driver::Motor).straight.length);
    assert!((lengths[0] / lengths[1] - 2.0).abs() < 0.01, "{lengths:?}");
    let watt = closed(LinkageKind::Watt, Driver::Rocker);
    assert!(
        (watt.parameter("p") * watt.parameter("p") - 4.0 * watt.parameter("r") * watt.parameter("r") - 1.0).abs()
            < 1e-12
    );
    let roberts = closed(LinkageKind::Roberts, Driver::Rocker);
    assert!((roberts.parameter("r") - roberts.parameter("b")).abs() < 1e-12 && roberts.parameter("p") == 2.0);
    // For each kind and input, the searched designs are no worse than that of the closed condition.
    for closed in found.designs.iter().filter(|design| design.origin == ProportionOrigin::ClosedCondition) {
        let relative_length = |design: &Design| design.straight.length / design.performance.size;
        let best = found
            .designs
            .iter()
            .filter(|d| d.driven_linkage == closed.driven_linkage)
            .map(relative_length)
            .fold(0.0, f64::max);
        assert!(best >= relative_length(closed), "{:?}", closed.driven_linkage);
    }
}

#[test]
#[ignore = "thorough"]
fn designs_meet_the_requirements() {
    let sets = [
        Requirements {
            input: Some(Driver::Motor),
            length: Some(100.0),
            size: Some(400.0),
            mu_min: 25.0,
            kinds: vec![LinkageKind::Evans],
            ..Requirements::default()
        },
        Requirements { input: Some(Driver::Rocker), length: Some(2.0), mu_min: 45.0, ..watt_and_roberts() },
        Requirements { quick_return: true, size: Some(1.0), tolerance: 0.002, ..hoeken() },
        Requirements {
            double_point: Some(true),
            size: Some(30.0),
            kinds: vec![LinkageKind::Watt, LinkageKind::Roberts],
            ..Requirements::default()
        },
    ];
    for requirements in sets {
        let found = design::straight_line(&requirements);
        assert!(!found.designs.is_empty(), "{requirements:?}");
        check(&requirements, &found);
    }
}

#[test]
#[ignore = "thorough"]
fn the_straightest_within_a_size_is_straighter_than_the_longest_for_it() {
    let requirements = Requirements { length: Some(100.0), size: Some(300.0), ..hoeken() };
    let found = design::straight_line(&requirements);
    check(&requirements, &found);
    let longest = design::straight_line(&Requirements { size: None, ..requirements.clone() });
    let (straightest, longest) = (searched_design(&found), searched_design(&longest));
    assert!(straightest.performance.size > longest.performance.size && longest.performance.size < 200.0);
    // Near (8.10) a path deviates as x^4: a linkage half as large again deviates far less.
    assert!(straightest.straight.deviation < 0.1 * longest.straight.deviation);
    // The allowed size is used.
    assert!(straightest.performance.size > 0.98 * 300.0, "{}", straightest.performance.size);
}

#[test]
#[ignore = "thorough"]
fn doubled_requirements_double_the_lengths_and_nothing_else() {
    let small = Requirements { length: Some(50.0), size: Some(200.0), ..hoeken() };
    let large = Requirements { length: Some(100.0), size: Some(400.0), ..small.clone() };
    let [small, large] = [small, large].map(|requirements| design::straight_line(&requirements));
    assert_eq!(small.designs.len(), large.designs.len());
    for (a, b) in small.designs.iter().zip(&large.designs) {
        for name in ["p", "r", "a"] {
            assert_eq!(2.0 * a.parameter(name), b.parameter(name));
        }
        assert_eq!(2.0 * a.straight.length, b.straight.length);
        assert_eq!(2.0 * a.straight.deviation, b.straight.deviation);
        assert_eq!(2.0 * a.performance.size, b.performance.size);
        assert_eq!((a.swing, a.speed_ratio, a.tolerance), (b.swing, b.speed_ratio, b.tolerance));
        assert_eq!((a.performance.mu_min, a.time_ratio()), (b.performance.mu_min, b.time_ratio()));
    }
}

#[test]
#[ignore = "thorough"]
fn the_suggested_relaxations_suffice() {
    let requirements = Requirements { length: Some(100.0), size: Some(160.0), mu_min: 20.0, ..hoeken() };
    let found = design::straight_line(&requirements);
    let relaxed: Vec<Requirement> = found.relaxations.iter().map(|relaxation| relaxation.requirement).collect();
    for requirement in [Requirement::Size, Requirement::Length, Requirement::Tolerance] {
        assert!(relaxed.contains(&requirement), "{relaxed:?}");
    }
    for relaxation in &found.relaxations {
        let changed = match (relaxation.requirement, relaxation.value) {
            (Requirement::Size, Some(to)) => Requirements { size: Some(to), ..requirements.clone() },
            (Requirement::Length, Some(to)) => Requirements { length: Some(to), ..requirements.clone() },
            (Requirement::Tolerance, Some(to)) => Requirements { tolerance: to, ..requirements.clone() },
            (Requirement::MuMin, Some(to)) => Requirements { mu_min: to, ..requirements.clone() },
            (Requirement::Kinds, None) => continue,
            other => panic!("{other:?}"),
        };
        let again = design::straight_line(&changed);
        assert!(!again.designs.is_empty(), "{:?} {:?}", relaxation.requirement, relaxation.value);
        check(&changed, &again);
    }
}

proptest! {
    #![proptest_config(proptest::test_runner::Config { cases: 4, ..super::proptest_config() })]

    #[test]
    #[ignore = "thorough"]
    fn requirements_are_met_or_the_rejections_explained(
        (p, tolerance) in (1.05..8.0f64, -4.0..-1.5f64),
        (mu_min, part) in (0.0..60.0f64, 0.1..0.9f64),
        kind in prop::sample::select(vec![LinkageKind::Hoeken, LinkageKind::Chebyshev, LinkageKind::Watt, LinkageKind::Roberts]),
    ) {
        let tolerance = trig::pow(10.0, tolerance);
        let requirements = Requirements {
            p: Some(p), tolerance, mu_min, length: Some(part), size: Some(1.0), kinds: vec![kind], ..Requirements::default()
        };
        let found = design::straight_line(&requirements);
        check(&requirements, &found);
        prop_assert!(!found.designs.is_empty() || !found.rejected.is_empty());
    }
}

fn run(folder: &Path, arguments: &[&str]) -> Ran {
    crate::support::command::run(folder, &[&["design", "straight-line"], arguments].concat())
}

#[test]
fn the_program_prints_a_table_trade_offs_and_rejections() {
    let folder = TempDir::new().unwrap();
    let arguments = ["--types", "hoeken,watt", "--input", "motor", "--p", "2", "--length", "100", "--svg", "plate.svg"];
    let (code, out, err) = run(folder.path(), &arguments);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(out.contains("crank-rocker  motor on the crank"), "{out}");
    assert!(out.contains("(searched)") && out.contains("(by (8.10))") && out.contains("against 1: "), "{out}");
    assert!(out.contains("left out: watt: no link that could be driven turns fully"), "{out}");
    let plate = std::fs::read_to_string(folder.path().join("plate.svg")).unwrap();
    let rows = out.matches("motor on the crank").count();
    assert!(rows >= 2 && plate.matches("class=\"curve\"").count() == rows, "the plate has all {rows} designs");
}

#[test]
#[ignore = "thorough"]
fn designs_are_the_same_with_any_number_of_threads() {
    let output = |threads: &str| {
        let arguments = ["design", "straight-line", "--types", "hoeken,watt", "--p", "2.5", "--json"];
        program(Path::new(".")).env("RAYON_NUM_THREADS", threads).args(arguments).output().unwrap().stdout
    };
    let one = output("1");
    assert!(!one.is_empty() && one == output("3"));
}

#[test]
#[ignore = "thorough"]
fn the_printed_manifest_renders_the_same_numbers() {
    let requirements = ["--types", "hoeken,chebyshev", "--p", "2", "--length", "80", "--mu-min", "0"];
    let (code, text, err) = run(Path::new("."), &[&requirements[..], &["--toml"]].concat());
    assert_eq!(code, 0, "{err}");
    faultless_plan(&text);
    let atlas = Atlas::rendered(&text, &["-q", "-o", "out"]);
    let (_, json, _) = run(Path::new("."), &[&requirements[..], &["--json"]].concat());
    let json: Json = serde_json::from_str(&json).unwrap();
    let designs = json["designs"].as_array().unwrap();
    let mut rows = 0;
    for linkage in ["hoeken", "chebyshev"] {
        let read = table::rows(&atlas.read(&format!("{linkage}/cells.csv")));
        let of_kind: Vec<&Json> = designs.iter().filter(|design| design["linkage"] == linkage).collect();
        assert_eq!(read.len(), of_kind.len(), "{linkage}");
        for (row, design) in read.iter().zip(of_kind) {
            for name in ["straight_length", "straight_deviation", "straight_start_deg", "straight_input_deg"] {
                let [cell] = table::numbers(row, [name]);
                // The manifest's numbers are those of the design, up to the rounding of the measures.
                let designed = design[name].as_f64().unwrap();
                assert!((cell - designed).abs() <= 1e-9 * cell.abs(), "{linkage} {name}: {cell} {designed}");
            }
            rows += 1;
        }
    }
    assert!(rows >= 4, "{rows}");
}

#[test]
fn all_invalid_requirements_are_reported_at_once() {
    let folder = TempDir::new().unwrap();
    let arguments = [
        "--p",
        "1",
        "--length",
        "-3",
        "--tolerance",
        "1e-12",
        "--size",
        "1/0",
        "--mu-min",
        "90",
        "--types",
        "hoken",
        "--best",
        "0",
    ];
    let (code, out, err) = run(folder.path(), &arguments);
    assert_eq!((code, out.as_str()), (2, ""));
    for part in [
        "--p: 1 is not from 1.02",
        "--length: -3 is not from",
        "--tolerance: 0.000000000001 is not from 0.00002",
        "--size: `1/0` is inf: give a finite number",
        "--mu-min: 90 is not from 0 to 89",
        "--types: unknown linkage `hoken`: did you mean `hoeken`?",
        "--best: 0 is not a whole number from 1 to 20",
    ] {
        assert!(err.contains(part), "{part}: {err}");
    }
    assert_eq!(err.matches("error: ").count(), 7, "{err}");
    assert_eq!(run(folder.path(), &["--deviation", "0.1"]).0, 2, "a deviation needs a length");
}

#[test]
#[ignore = "thorough"]
fn what_no_linkage_meets_has_a_hint() {
    let folder = TempDir::new().unwrap();
    let too_small = ["--types", "hoeken", "--length", "10", "--size", "10.001"];
    let (code, out, err) = run(folder.path(), &too_small);
    assert_eq!((code, out.as_str()), (2, ""));
    assert!(err.contains("no linkage meets these requirements") && err.contains("hint: with --size "), "{err}");
}

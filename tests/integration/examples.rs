//! The atlases in `examples`: all are valid and documented, a part of each is rendered, and their linkages do what their
//! comments say.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use coupler_atlas::manifest::Plan;
use coupler_atlas::sweep;
use coupler_curves::family::Family;
use coupler_curves::geometry::trig;
use coupler_curves::measure::{Measure, MeasureKey};
use coupler_curves::solve::{SolvedCell, Solver};
use tempfile::TempDir;

use crate::support;
use crate::support::command::run;
use crate::support::plan::faultless_plan;

fn folder() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/examples"))
}

/// The texts of the examples by their names.
fn examples() -> BTreeMap<String, String> {
    let paths = fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    let manifests = paths.filter(|path| path.extension().is_some_and(|extension| extension == "toml"));
    let name = |path: &Path| path.file_stem().unwrap().to_string_lossy().into_owned();
    manifests.map(|path| (name(&path), fs::read_to_string(&path).unwrap())).collect()
}

fn plan(name: &str) -> Plan {
    support::plan::plan(&fs::read_to_string(folder().join(format!("{name}.toml"))).unwrap())
}

fn family<'p>(plan: &'p Plan, id: &str) -> &'p Family {
    plan.families.iter().map(|planned| &planned.family).find(|family| family.id == id).unwrap()
}

/// Every `step`-th cell of a family.
fn solved(family: &Family, step: usize) -> Vec<SolvedCell> {
    let solver = Solver::new(family);
    let solve = |k| solver.solve(k).unwrap();
    (0..family.cell_count()).step_by(step).map(solve).collect()
}

/// A measure of the first curve of a cell.
fn measure(solved: &SolvedCell, key: MeasureKey<f64>) -> f64 {
    solved.curves[0].measure(key).unwrap_or_else(|| panic!("no {}", key.name))
}

/// A parameter or another name of a cell.
fn value(family: &Family, solved: &SolvedCell, name: &str) -> f64 {
    let at = family.names.iter().position(|other| &**other == name).unwrap();
    solved.cell.values[at]
}

#[test]
fn every_example_is_valid_and_documented() {
    let document = fs::read_to_string(folder().join("../docs/examples.md")).unwrap();
    let examples = examples();
    assert!(examples.len() >= 7);
    for (name, text) in &examples {
        faultless_plan(text);
        assert!(text.contains(&format!("#     coupler-atlas render examples/{name}.toml\n")), "{name}: no command");
        assert!(text.contains(&format!("output = \"../target/{name}\"\n")), "{name} is rendered among the sources");
        assert!(document.contains(&format!("`examples/{name}.toml`")), "{name} is not in docs/examples.md");
    }
}

/// A family of each example that takes little time, with the number of its pages.
const PARTS: [(&str, &str, usize); 7] = [
    ("designs", "dwell", 1),
    ("drawings", "press", 1),
    ("offset-slider-crank", "slider", 1),
    ("inverted-slider-crank", "conchoids", 1),
    ("geared-five-bars", "ratio-2-1", 6),
    ("dwell-six-bars", "two-dwells", 2),
    ("straight-line-linkages", "roberts", 1),
];

#[test]
fn a_part_of_every_example_is_rendered() {
    let rendered: Vec<&str> = PARTS.iter().map(|(name, ..)| *name).collect();
    // Those after Hrones and Nelson are rendered by the tests of documents.
    let others = examples().into_keys().filter(|name| !name.starts_with("hrones-nelson"));
    assert!(others.eq({
        let mut names = rendered;
        names.sort_unstable();
        names
    }));
    for (name, id, page_count) in PARTS {
        let folder = TempDir::new().unwrap();
        let manifest = self::folder().join(format!("{name}.toml"));
        let arguments = ["render", manifest.to_str().unwrap(), "-o", "out", "--only", id, "--format", "svg", "-q"];
        let (code, _, err) = run(folder.path(), &arguments);
        assert_eq!((code, err.as_str()), (0, ""), "{name}");
        let pages = crate::support::folder::files(&folder.path().join("out").join(id));
        let pages: Vec<&String> = pages.iter().filter(|page| page.ends_with(".svg")).collect();
        assert_eq!(pages.len(), page_count, "{name}: {pages:?}");
        for page in pages {
            let svg = fs::read_to_string(folder.path().join("out").join(id).join(page)).unwrap();
            assert!(
                svg.contains("data-cell=") || svg.contains("class=\"series\""),
                "{name}: nothing is drawn on {page}"
            );
            assert!(!svg.contains("cannot be"), "{name}: a linkage on {page} cannot be assembled");
        }
    }
}

/// The numbers of curves, linkages and pages that the comments state.
#[test]
fn the_examples_have_the_sizes_that_their_comments_state() {
    let state = |name: &str, statement: String| {
        assert!(examples()[name].replace("\n# ", " ").contains(&statement), "{name}: {statement}");
    };
    for (name, ids) in [
        ("offset-slider-crank", &["in-line", "offset"][..]),
        ("inverted-slider-crank", &["swinging", "turning", "offset"]),
    ] {
        let plan = plan(name);
        let counts: Vec<usize> = ids
            .iter()
            .flat_map(|id| sweep::select_cells(family(&plan, id), true, &AtomicBool::new(false)).unwrap().point_counts)
            .map(|points| points as usize)
            .collect();
        let curves: usize = counts.iter().sum();
        let thousands =
            if curves >= 1000 { format!("{},{:03}", curves / 1000, curves % 1000) } else { curves.to_string() };
        state(name, format!("{thousands} curves of {} linkages on {} pages", counts.len(), curves.div_ceil(10)));
    }
    let geared = plan("geared-five-bars");
    let is_counted = |family: &&Family| family.id.starts_with("ratio") || family.id == "unequal-cranks";
    let curves: usize =
        geared.families.iter().map(|planned| &planned.family).filter(is_counted).map(Family::cell_count).sum();
    state("geared-five-bars", format!("{curves} curves on {} pages", curves / 12));
    let dwells = plan("dwell-six-bars");
    let ids = ["arc-rocker", "arc-slider", "line-rocker", "two-dwells", "line-yoke"];
    let linkages: usize = ids.iter().map(|id| family(&dwells, id).cell_count()).sum();
    state("dwell-six-bars", format!("{linkages} of them on pages"));
}

/// The worst transmission angle of an offset slider-crank is acos((1 + e) / L).
#[test]
fn the_offset_of_slider_cranks_is_limited_by_their_transmission_angle() {
    let plan = plan("offset-slider-crank");
    let family = family(&plan, "offset");
    let mut kept = 0;
    for solved in solved(family, 4) {
        let [l, e] = ["L", "e"].map(|name| value(family, &solved, name));
        let cosine = (1.0 + e) / l;
        let expected = if cosine < 1.0 { trig::degrees(trig::acos(cosine)) } else { 0.0 };
        assert_eq!(solved.curves.is_empty(), expected < 20.0, "L = {l}, e = {e}");
        if !solved.curves.is_empty() {
            assert_eq!(solved.curves.len(), 50);
            assert!((measure(&solved, Measure::MU_WORST) - expected).abs() < 1e-6, "L = {l}, e = {e}");
            kept += 1;
        }
    }
    assert!(kept >= 5);
}

/// Points of the coupler of an inverted slider-crank are at a fixed distance from the crank pin on a line through C.
#[test]
fn points_of_the_conchoids_are_on_lines_through_the_pivot() {
    let plan = plan("inverted-slider-crank");
    let family = family(&plan, "conchoids");
    for solved in solved(family, 1) {
        let [g, along] = ["g", "along"].map(|name| value(family, &solved, name));
        let circuit = solved.circuit(&solved.curves[0]);
        let m = circuit.points(solved.curves[0].joint);
        let a = circuit.points(solved.linkage.find_joint("A").unwrap());
        assert!(circuit.len() >= 72);
        for (m, a) in m.zip(a) {
            let [to_m, to_c] = [[m.x - a.x, m.y - a.y], [g - a.x, -a.y]];
            assert!((trig::hypot(to_m[0], to_m[1]) - along.abs()).abs() < 1e-12);
            assert!((to_m[0] * to_c[1] - to_m[1] * to_c[0]).abs() < 1e-12, "g = {g}, along = {along}");
        }
    }
}

/// The cranks of all geared five-bars turn fully, also with the gears in the least favourable phase.
#[test]
fn the_cranks_of_geared_five_bars_turn_fully() {
    let plan = plan("geared-five-bars");
    for planned in plan.families.iter().filter(|planned| planned.family.id.starts_with("ratio")) {
        for solved in solved(&planned.family, 7) {
            let name = &planned.family.id;
            assert!(solved.curves.len() == 1 && solved.curves[0].measure(Measure::INPUT_MIN).is_none(), "{name}");
        }
    }
}

/// The outputs of the dwell linkages rest for a quarter of a turn, or nearly twice a sixth, and can be driven.
#[test]
fn the_outputs_of_dwell_linkages_rest() {
    let plan = plan("dwell-six-bars");
    for (id, least) in
        [("arc-rocker", 100.0), ("arc-slider", 100.0), ("line-rocker", 80.0), ("two-dwells", 50.0), ("line-yoke", 90.0)]
    {
        for solved in solved(family(&plan, id), 5) {
            assert!(measure(&solved, Measure::OUTPUT_DWELL) >= least, "{id}");
            assert!(measure(&solved, Measure::MU_WORST) >= 30.0, "{id}");
        }
    }
}

/// The exact linkages are exact over a stroke of 1, and the others deviate the less the larger they are.
#[test]
fn straight_line_linkages_have_a_stroke_of_one() {
    let plan = plan("straight-line-linkages");
    for id in ["peaucellier-lipkin", "hart-inversor", "isosceles-slider-crank"] {
        for solved in solved(family(&plan, id), 3) {
            assert!((measure(&solved, Measure::STRAIGHT_LENGTH) - 1.0).abs() < 1e-9, "{id}");
            assert_eq!(measure(&solved, Measure::STRAIGHT_DEVIATION), 0.0, "{id}");
        }
    }
    for id in ["motor-driven", "rocker-driven", "roberts"] {
        let deviations: Vec<f64> =
            solved(family(&plan, id), 1).iter().map(|solved| measure(solved, Measure::STRAIGHT_DEVIATION)).collect();
        for row in deviations.chunks(4) {
            assert!(row.is_sorted_by(|a, b| a > b) && row[0] < 0.01, "{id}: {row:?}");
        }
    }
}

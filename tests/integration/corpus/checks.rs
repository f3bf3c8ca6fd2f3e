//! Properties that hold for any text, shared by the fuzz targets and the tests over their corpora.

use coupler_curves::solve::{Solver, Status};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use coupler_atlas::check::{self, Report};
use coupler_atlas::find::{self, Outline, ReadOptions};
use coupler_atlas::manifest;
use coupler_atlas::output;
use coupler_curves::expression::{Caption, Dimension, Error, Expression, Quantity, Scope};
use coupler_curves::family::Family;
use coupler_curves::motion::{Sampler, Sampling};
use coupler_curves::problem::report;

/// Asserts that a manifest makes a plan or has problems, each at a place in the text and with help, and that the
/// printed problems have no control characters.
///
/// A cell of each of the first families of a plan can be solved.
pub fn manifest(text: &str) {
    // A manifest that allows a family more cells than usual may take long to check.
    if text.contains("limit") {
        return;
    }
    let loaded = manifest::parse(text);
    for problem in &loaded.problems {
        assert!(text.get(problem.span.clone()).is_some(), "{problem:?} is not in the text");
        assert!(!problem.message.is_empty() && !problem.help.is_empty(), "{problem:?}");
    }
    let printed = report(&loaded.problems, "atlas.toml", text, false);
    assert!(printed.chars().all(|c| c == '\n' || !c.is_control()), "{printed:?}");
    assert_eq!(loaded.plan.is_none(), loaded.problems.iter().any(|problem| problem.is_error()), "{printed}");
    for planned in loaded.plan.iter().flat_map(|plan| &plan.families).take(3) {
        solve_last_cell(&planned.family);
    }
}

/// Solves the last cell of a family, coarsely, if few enough points are traced.
fn solve_last_cell(family: &Family) {
    let Some(last) = family.cell_count().checked_sub(1) else { return };
    let few = family.linkage(&family.cell(last)).is_ok_and(|linkage| linkage.traced.len() <= 20);
    if few && let Some(solved) = Solver::with_sampler(family, Sampler::new(Sampling::Samples(12))).solve(last) {
        assert!(solved.status() != Status::Failed, "{}", solved.reason());
        let circuits = &solved.motion.circuits;
        assert!(circuits.iter().all(|circuit| circuit.inputs.iter().all(|input| input.is_finite())));
        family.format_captions(&solved.cell, solved.first_curve_values());
    }
}

/// Asserts that an expression, a quantity or a caption is parsed, or has an error at a place in the text.
pub fn expression(text: &str) {
    let parsed = Expression::parse(text);
    if let Ok(parsed) = &parsed {
        assert_error_is_placed(parsed.check(&Scope::from_numbers(["p", "r"])), text);
        parsed.evaluate(|k| 0.5 + k as f64);
    }
    assert_error_is_placed(parsed, text);
    assert_error_is_placed(Quantity::parse(text, Dimension::Angle), text);
    assert_error_is_placed(Quantity::parse(text, Dimension::PaperLength), text);
    match Caption::parse(text) {
        Ok(caption) => drop(caption.format(|_| 2.5, |_| None)),
        error => assert_error_is_placed(error, text),
    }
}

/// Asserts that a check ends with findings, whatever replaces `points.csv` of a recorded atlas, and finds something if
/// the text is not the recorded one.
pub fn points(text: &str) {
    check_with_replaced_file("e/points.csv", text);
}

/// The same for `cells.csv`.
pub fn cells(text: &str) {
    check_with_replaced_file("e/cells.csv", text);
}

/// The same for a page.
pub fn page(text: &str) {
    check_with_replaced_file("e/e-001.svg", text);
}

/// The same for the record of the run, without which there may be no check at all.
pub fn record(text: &str) {
    check_with_replaced_file("run.json", text);
}

/// Asserts that bytes are read as a path, of which it is said what was taken, or have problems.
pub fn path(bytes: &[u8]) {
    for (is_timed, outline) in [(false, None), (true, None), (false, Some("1"))] {
        match find::parse_outline(bytes, &ReadOptions { is_timed, outline, ..ReadOptions::default() }) {
            Ok(Outline { points, angles_deg, reading, .. }) => {
                assert!(points.len() <= find::MAX_POINTS);
                assert!(points.iter().all(|p| p.x.is_finite() && p.y.is_finite()), "{points:?}");
                assert!(angles_deg.is_none_or(|angles| is_timed && angles.len() == points.len()));
                assert!(points.is_empty() || !reading.taken.is_empty());
                assert!(!(is_timed && reading.has_unused_angles));
            }
            Err(problems) => assert!(!problems.is_empty() && problems.iter().all(|problem| !problem.is_empty())),
        }
    }
}

/// A manifest of two cells, one of which is not assembled.
const SMALL: &str = "[atlas]\ntitle = \"T\"\nformats = [\"svg\"]\n[[family]]\nid = \"e\"\nlinkage = \"evans\"\n\
                     sampling = { samples = 9 }\ncolumns = [\"psi_deg\"]\ncases = [{ p = 2, a = 2 }, { p = 9, a = 2 }]\n";

/// Replaces a file of a recorded atlas by a text, checks the atlas, and restores the file.
fn check_with_replaced_file(name: &str, text: &str) {
    // There is one atlas, with one check of it at a time.
    static ATLAS: Mutex<Option<PathBuf>> = Mutex::new(None);
    let mut atlas = ATLAS.lock().unwrap_or_else(PoisonError::into_inner);
    let plan = manifest::parse(SMALL).plan.expect("a plan");
    let folder = atlas.get_or_insert_with(|| {
        let folder = std::env::temp_dir().join(format!("coupler-atlas-corpus-{}", std::process::id()));
        output::write_atlas(&plan, &folder, &output::Options::default(), &mut |_| {}).expect("an atlas");
        folder
    });
    let path: &Path = &folder.join(name);
    let original = std::fs::read(path).expect("a file of the atlas");
    std::fs::write(path, text).expect("a file of the atlas");
    let report = check::check_atlas(&plan, folder, &check::Options::default(), &mut |_| {});
    std::fs::write(path, &original).expect("a file of the atlas");
    let Ok(report) = report else {
        assert_eq!(name, "run.json", "only a damaged record may stop a check");
        return;
    };
    let Report { findings, .. } = &report;
    assert!(
        findings
            .iter()
            .all(|finding| !finding.location.to_string().is_empty() && !finding.change.to_string().is_empty())
    );
    // Of a record, line ends and a byte order mark may be changed.
    let plain = text.trim_start_matches('\u{feff}').replace('\r', "");
    let is_same = text.as_bytes() == original || name == "run.json" && plain.as_bytes() == original;
    assert!(is_same || !findings.is_empty(), "{name} has been changed");
    assert!(text.as_bytes() != original || findings.is_empty(), "{findings:?}");
}

/// Asserts that an error has a span of whole characters of the text, and help.
fn assert_error_is_placed<T>(result: Result<T, Error>, text: &str) {
    if let Err(Error { message, span, help, .. }) = result {
        assert!(text.get(span.clone()).is_some(), "{message} at {span:?} of {text:?}");
        assert!(!message.is_empty() && !help.is_empty(), "{message}");
    }
}

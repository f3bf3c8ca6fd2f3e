//! What holds of any text: the fuzz targets and the test over their corpora ask the same.

use coupler_curves::solve;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use coupler_atlas::check::{self, Report};
use coupler_atlas::manifest;
use coupler_atlas::output;
use coupler_curves::expression::{Caption, Dimension, Error, Expression, Quantity};
use coupler_curves::family::Family;
use coupler_curves::motion::{Sampler, Sampling};
use coupler_curves::problem::report;

/// A manifest is a plan or has problems: each at a place in it, with a remedy, and what is said of them is plain text.
///
/// Of a plan a cell of each family can be solved.
pub fn manifest(text: &str) {
    // Whoever allows a family more cells than usual has asked for the time it takes to look at all of them.
    if text.contains("limit") {
        return;
    }
    let loaded = manifest::parse(text);
    for problem in &loaded.problems {
        assert!(text.get(problem.span.clone()).is_some(), "{problem:?} is not in the text");
        assert!(!problem.message.is_empty() && !problem.help.is_empty(), "{problem:?}");
    }
    let said = report(&loaded.problems, "atlas.toml", text, false);
    assert!(said.chars().all(|c| c == '\n' || !c.is_control()), "{said:?}");
    assert_eq!(loaded.plan.is_none(), loaded.problems.iter().any(|problem| problem.is_error()), "{said}");
    for planned in loaded.plan.iter().flat_map(|plan| &plan.families).take(3) {
        solve(&planned.family);
    }
}

/// Its last cell, coarsely, if few enough points are traced.
fn solve(family: &Family) {
    let Some(last) = family.cell_count().checked_sub(1) else { return };
    let few = family.linkage(&family.cell(last)).is_ok_and(|linkage| linkage.traced.len() <= 20);
    if few && let Some(solved) = solve::solve_cell(family, &Sampler::new(Sampling::Samples(12)), last) {
        let circuits = &solved.motion.circuits;
        assert!(circuits.iter().all(|circuit| circuit.inputs.iter().all(|input| input.is_finite())));
        family.format_captions(&solved.cell, solved.first_curve_values());
    }
}

/// An expression, a quantity or a caption is read, or has a mistake at a place in it.
pub fn expression(text: &str) {
    let read = Expression::parse(text);
    if let Ok(read) = &read {
        is_placed(read.check(&["p", "r"], |_| None), text);
        read.evaluate(|k| 0.5 + k as f64);
    }
    is_placed(read, text);
    is_placed(Quantity::parse(text, Dimension::Angle), text);
    is_placed(Quantity::parse(text, Dimension::PaperLength), text);
    match Caption::parse(text) {
        Ok(caption) => drop(caption.format(|_| 2.5, |_| None)),
        error => is_placed(error, text),
    }
}

/// Whatever stands in place of a file of a recorded atlas, a check ends with findings, and finds something if the text is not
/// what was recorded.
pub fn points(text: &str) {
    recorded("e/points.csv", text);
}

/// The same of the other table.
pub fn cells(text: &str) {
    recorded("e/cells.csv", text);
}

/// The same of a page.
pub fn page(text: &str) {
    recorded("e/e-001.svg", text);
}

/// The same of the record of the run: it may not be usable at all.
pub fn record(text: &str) {
    recorded("run.json", text);
}

/// A manifest of two cells, one of which is not assembled.
const SMALL: &str = "[atlas]\ntitle = \"T\"\nformats = [\"svg\"]\n[[family]]\nid = \"e\"\nlinkage = \"evans\"\n\
                     sampling = { samples = 9 }\ncolumns = [\"psi_deg\"]\ncases = [{ p = 2, a = 2 }, { p = 9, a = 2 }]\n";

/// Puts a text in place of a file of a recorded atlas, checks that, and puts back what was there.
fn recorded(name: &str, text: &str) {
    // One atlas, and one check of it at a time.
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
        assert_eq!(name, "run.json", "a table or a page keeps nothing from being checked");
        return;
    };
    let Report { findings, .. } = &report;
    assert!(
        findings
            .iter()
            .all(|finding| !finding.location.to_string().is_empty() && !finding.change.to_string().is_empty())
    );
    // What a record says of itself, its program for one, is nothing that a check looks at.
    assert!(text.as_bytes() == original || name == "run.json" || !findings.is_empty(), "{name} has been changed");
    assert!(text.as_bytes() != original || findings.is_empty(), "{findings:?}");
}

fn is_placed<T>(read: Result<T, Error>, text: &str) {
    if let Err(Error { message, span, help }) = read {
        assert!(text.get(span.clone()).is_some(), "{message} at {span:?} of {text:?}");
        assert!(!message.is_empty() && !help.is_empty(), "{message}");
    }
}

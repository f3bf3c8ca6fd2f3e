//! Manifests as they are read.

use std::path::Path;

use coupler_atlas::manifest::{self, ParseOutcome, Plan};
use coupler_atlas::manifest_files::ManifestFiles;
use coupler_curves::problem::report;

/// A manifest that names no files, with the searches that it wishes.
fn parse(text: &str) -> ParseOutcome {
    manifest::parse_with_files(text, Some(&ManifestFiles::new(Path::new(""))))
}

/// The plan of a manifest without errors.
#[track_caller]
pub fn plan(text: &str) -> Plan {
    let loaded = parse(text);
    loaded.plan.unwrap_or_else(|| panic!("{}\n{text}", report(&loaded.problems, "atlas.toml", text, false)))
}

/// The plan of a manifest without errors and warnings.
#[track_caller]
pub fn faultless_plan(text: &str) -> Plan {
    let ParseOutcome { plan, problems } = parse(text);
    assert!(problems.is_empty(), "{}\n{text}", report(&problems, "atlas.toml", text, false));
    plan.unwrap()
}

/// The report on a manifest that is not accepted, each of whose problems has a remedy.
#[track_caller]
pub fn problems(text: &str) -> String {
    let loaded = manifest::parse(text);
    assert!(loaded.plan.is_none(), "the manifest is accepted:\n{text}");
    for problem in &loaded.problems {
        assert!(!problem.help.is_empty(), "no help: {}", problem.message);
    }
    report(&loaded.problems, "atlas.toml", text, false)
}

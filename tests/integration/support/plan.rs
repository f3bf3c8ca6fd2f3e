//! Manifests as they are read.

use coupler_atlas::manifest::{self, Plan};
use coupler_curves::problem::report;

/// The plan of a manifest without errors.
#[track_caller]
pub fn plan(text: &str) -> Plan {
    let loaded = manifest::parse(text);
    loaded.plan.unwrap_or_else(|| panic!("{}\n{text}", report(&loaded.problems, "atlas.toml", text, false)))
}

/// The plan of a manifest without errors and warnings.
#[track_caller]
pub fn faultless_plan(text: &str) -> Plan {
    let problems = manifest::parse(text).problems;
    assert!(problems.is_empty(), "{}\n{text}", report(&problems, "atlas.toml", text, false));
    plan(text)
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

//! `validate`: reports every problem of a manifest.

use std::path::PathBuf;

use clap::Args;
use coupler_atlas::output;

use super::source::{self, DEFAULT_MANIFEST};
use super::{Outcome, pluralize, print, printable};

/// Report every problem of a manifest, and write nothing.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The manifest.
    #[arg(default_value = DEFAULT_MANIFEST)]
    manifest: PathBuf,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    let source = source::read(&arguments.manifest)?;
    source.report_problems(&output::empty_family_warnings(&source.plan, None));
    let cells: usize = source.plan.families.iter().map(|planned| planned.family.cell_count()).sum();
    let families = match source.plan.families.len() {
        1 => "1 family".to_owned(),
        n => format!("{n} families"),
    };
    print(&format!("{}: {families}, {}\n", printable(arguments.manifest.display()), pluralize(cells, "cell")))?;
    Ok(Outcome::Done)
}

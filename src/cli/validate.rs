use std::path::PathBuf;

use clap::Args;
use coupler_atlas::build;

use super::{Outcome, count, plan, print};

/// Find every problem of a manifest, and write nothing.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The manifest.
    #[arg(default_value = "atlas.toml")]
    manifest: PathBuf,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    let source = plan::read(&arguments.manifest)?;
    source.report(&build::empty_families(&source.plan, None));
    let cells: usize = source.plan.families.iter().map(|planned| planned.family.cells()).sum();
    let families = match source.plan.families.len() {
        1 => "1 family".to_owned(),
        n => format!("{n} families"),
    };
    print(&format!("{}: {families}, {}\n", arguments.manifest.display(), count(cells, "cell")))?;
    Ok(Outcome::Done)
}

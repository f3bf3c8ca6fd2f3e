//! `find --atlas`: the curves of an atlas that are nearest to a path.

mod json;
mod report;
mod text;

use std::path::Path;
use std::sync::atomic::AtomicBool;

use crate::find::{self, AtlasAnswer, AtlasQuery};
use crate::output;
use crate::record::{self, UnknownManifest};
use coupler_curves::family::Family;
use coupler_find::{Constraint, Options, Target};

use super::super::source::ManifestSource;
use super::{Arguments, Best, Failure, Outcome, Shown, show, source, title_of};
use report::AtlasReport;

pub(super) fn run(
    (arguments, atlas): (&Arguments, &Path),
    options: &Options,
    (name, reading, target): (String, String, Target),
    is_drawing_printed: bool,
) -> Result<Outcome, Failure> {
    let source = read(atlas)?;
    let query = AtlasQuery { options, condition: arguments.condition.as_deref(), is_fixed: arguments.fixed };
    let findings = find::find_in_atlas(&source.plan, &target, &query, &AtomicBool::new(false))
        .map_err(|error| Failure::input(format!("--where: {error}")))?;
    if findings.curves == 0 {
        source.report_problems(&output::empty_family_warnings(&source.plan, None));
    }
    let report = AtlasReport { name, reading, target, plan: source.plan, findings };
    show(&report, arguments, is_drawing_printed)
}

/// Reads the manifest of an atlas, or that beside the folder of a rendered one.
///
/// # Errors
/// There is none, it has errors, or it is not that of the folder.
fn read(atlas: &Path) -> Result<ManifestSource, Failure> {
    let is_folder = match atlas.metadata() {
        Ok(metadata) => metadata.is_dir(),
        Err(source) if !output::is_wrong_input(&source) => {
            return Err(output::Error::Read { path: atlas.to_owned(), source }.into());
        }
        Err(_) => false,
    };
    if !is_folder {
        return source::read(atlas);
    }
    let example = |message: String| Failure::input(format!("{message}, as in --atlas path/to/atlas.toml"));
    let (path, run) = record::manifest_of(atlas).map_err(|error| match error {
        UnknownManifest::Unreadable { .. } => Failure::system(error),
        error => example(error.to_string()),
    })?;
    let source = source::read(&path)?;
    record::check_families(atlas, &path, &source.plan, &run).map_err(example)?;
    Ok(source)
}

impl Shown for AtlasReport {
    fn manifest(&self) -> String {
        self.findings.manifest(&title_of(&self.name), &self.target, &self.plan)
    }

    fn best(&self) -> Option<Best> {
        let best = self.findings.answers.first()?;
        let refined = best.refined.as_ref();
        let mu_worst_deg = refined.map_or(best.curve.mu_worst_deg, |answer| answer.mechanism.mu_worst_deg);
        Some(Best { quality: best.deviation().quality(), mu_worst_deg })
    }

    fn miss(&self) -> Option<(Family, usize)> {
        let (constraints, AtlasAnswer { place: [family, cell], .. }) = self.findings.nearest_miss.as_ref()?;
        // The condition is on the cell as it is in the atlas.
        constraints.contains(&Constraint::Condition).then(|| (self.plan.families[*family].family.clone(), *cell))
    }

    fn json(&self) -> Result<String, Failure> {
        json::json(self)
    }

    fn text(&self) -> String {
        text::text(self)
    }

    fn drawing(&self) -> Vec<u8> {
        self.findings.drawing(&title_of(&self.name), &self.target, &self.plan)
    }
}

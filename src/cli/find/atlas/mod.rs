//! `find --atlas`: the curves of an atlas that are nearest to a path.

mod json;
mod text;

pub(super) use text::placed;

use std::path::{Path, PathBuf};

use crate::find::{self, AtlasAnswer, AtlasOptions};
use crate::manifest::Plan;
use crate::record::{FolderRecord, RunRecord};
use coupler_curves::exchange::{ParameterSet, manifest_families};
use coupler_curves::find::{
    Answer, Condition, Index, Options, Quality, Search, Target, answer_families, answers_manifest, manifest_head,
    scaled_values,
};
use coupler_curves::linkage_format::quoted;
use coupler_curves::measure;
use coupler_curves::motion::Sampler;
use coupler_curves::solve::solve_measuring;
use coupler_drawing::page::FoundCurve;
use rayon::prelude::*;

use super::super::source::ManifestSource;
use super::{Arguments, Best, InputError, Outcome, Shown, drawing, show, source, title_of};

/// What has been found in an atlas.
pub(super) struct AtlasReport {
    name: String,
    target: Target,
    plan: Plan,
    /// The number of curves that were compared.
    curves: usize,
    answers: Vec<Found>,
    /// The options to relax, and the nearest curve without them.
    nearest_miss: Option<(Vec<&'static str>, Found)>,
}

/// A curve of an atlas, and the four-bar that was refined from it, if it is one; the outline is then that of the refined curve.
pub(super) struct Found {
    curve: AtlasAnswer,
    refined: Option<Answer>,
}

impl Found {
    fn rms(&self) -> f64 {
        self.refined.as_ref().map_or(self.curve.curve.fit.rms, |answer| answer.rms)
    }
}

/// The error of options that do not go together, if there is one.
pub(super) fn check(arguments: &Arguments) -> Result<(), InputError> {
    let error = |message: &str| Err(InputError(message.to_owned()));
    match arguments {
        Arguments { atlas: None, linkage: None, fixed: true, .. } => {
            error("--fixed compares the curves of an atlas where they are: name one with --atlas MANIFEST|DIR")
        }
        Arguments { atlas: Some(_), timed: true, .. } => error(
            "--timed and --atlas do not go together: the curves of an atlas are compared by their shape; leave one out",
        ),
        Arguments { atlas: Some(_), index: Some(_), .. } => error(
            "--index is the number of random four-bars, and with --atlas the curves of the atlas take their place: leave one out",
        ),
        _ => Ok(()),
    }
}

pub(super) fn run(
    (arguments, atlas): (&Arguments, &Path),
    options: &Options,
    (name, target): (String, Target),
    is_drawing_printed: bool,
) -> anyhow::Result<Outcome> {
    let source = read(atlas)?;
    let atlas_options = AtlasOptions::new(options, arguments.condition.clone(), arguments.fixed);
    let search = |atlas_options: &AtlasOptions| {
        let found = find::search_atlas(&source.plan, &target, atlas_options);
        found.map_err(|error| InputError(error.to_string()))
    };
    let (answers, curves) = search(&atlas_options)?;
    let answers = ranked(answers, &target, options, arguments);
    let mut nearest_miss = None;
    if answers.is_empty() {
        let (others, _) = search(&atlas_options.relaxed())?;
        let set = [
            ("--where", atlas_options.condition.is_some()),
            ("--pivots", atlas_options.pivots.is_some()),
            ("--max-link", atlas_options.max_link.is_finite()),
            ("--input", atlas_options.full_turn),
        ];
        let relax = set.into_iter().filter(|(_, is_set)| *is_set).map(|(option, _)| option).collect();
        let nearest = others.into_iter().next().map(|curve| Found { curve, refined: None });
        nearest_miss = nearest.map(|nearest| (relax, nearest));
    }
    let report = AtlasReport { name, target, plan: source.plan, curves, answers, nearest_miss };
    show(&report, arguments, is_drawing_printed)
}

/// The curves that are refined for each answer.
const STARTS_PER_ANSWER: usize = 8;

/// Refines four-bars, merges curves that are the same to a thousandth of the target's size, and ranks them.
fn ranked(curves: Vec<AtlasAnswer>, target: &Target, options: &Options, arguments: &Arguments) -> Vec<Found> {
    let distinct = |found: Vec<Found>, most| find::distinct(found, |found| &found.curve.curve, target, most);
    let placed = curves.into_iter().map(|curve| Found { curve, refined: None });
    // Several are refined to the same curve.
    let mut found = distinct(placed.collect(), STARTS_PER_ANSWER * options.most);
    // A condition on names that a four-bar does not have cannot be kept in a refinement.
    let condition = arguments.condition.as_deref().map(Condition::new).transpose();
    if options.refine
        && !arguments.fixed
        && let Ok(condition) = condition
    {
        let options = Options { most: 1, condition, ..options.clone() };
        let index = Index::new();
        let refine = |found: &Found| {
            let start = found.curve.curve.four_bar?;
            let answer = Search::from_four_bar(target, options.clone(), &start).run(&index).into_iter().next()?;
            let solved = answer.mechanism.solved().filter(|_| answer.rms < found.curve.curve.fit.rms)?;
            let curve = &solved.curves[0];
            Some((answer, solved.circuit(curve).points(curve.joint).collect()))
        };
        found.par_iter_mut().for_each(|found| {
            if let Some((answer, outline)) = refine(found) {
                (found.refined, found.curve.curve.outline) = (Some(answer), outline);
            }
        });
    }
    found.sort_by(|a, b| a.rms().total_cmp(&b.rms()));
    distinct(found, options.most)
}

/// Reads the manifest of an atlas, or that beside the folder of a rendered one.
///
/// # Errors
/// There is none, it has errors, or it is not that of the folder.
fn read(atlas: &Path) -> anyhow::Result<ManifestSource> {
    if !atlas.is_dir() {
        return source::read(atlas);
    }
    let folder = super::super::printable(atlas.display());
    let record = FolderRecord::read(atlas).map_err(|error| {
        InputError(format!(
            "{folder} is not the folder of an atlas: run.json: {error}; name its manifest: --atlas atlas.toml"
        ))
    })?;
    let run: RunRecord = record.run;
    let beside = |name: &String| -> Vec<PathBuf> {
        let absolute = std::path::absolute(atlas).unwrap_or_else(|_| atlas.to_owned());
        absolute.ancestors().skip(1).take(2).map(|parent| parent.join(name)).collect()
    };
    let path = run.manifest.iter().flat_map(beside).find(|path| path.is_file());
    let Some(path) = path else {
        let name = run.manifest.as_deref().unwrap_or("standard input");
        let message = format!(
            "{folder} was rendered from {name}, which is not beside it, and its tables do not say what its linkages are: name the \
             manifest, as in --atlas path/to/atlas.toml"
        );
        return Err(InputError(message).into());
    };
    let source = source::read(&path)?;
    let families = source.plan.families.iter().map(|planned| (&planned.family.id, planned.family.cell_count()));
    if !families.eq(run.families.iter().map(|family| (&family.id, family.cells))) {
        let path = super::super::printable(path.display());
        let message = format!(
            "{folder} does not have the families and cells of {path}: render it again, or name the manifest: --atlas {path}"
        );
        return Err(InputError(message).into());
    }
    Ok(source)
}

impl Shown for AtlasReport {
    /// A manifest that renders the linkages: refined four-bars where they are on the path, others in the direction that they have in the
    /// atlas, and as large as they are on the path if their dimensions scale.
    fn manifest(&self) -> String {
        let name = title_of(&self.name);
        let refined: Vec<Answer> = self.answers.iter().filter_map(|found| found.refined.clone()).collect();
        let placed: Vec<(usize, &AtlasAnswer)> = (1..)
            .zip(&self.answers)
            .filter(|(_, found)| found.refined.is_none())
            .map(|(k, found)| (k, &found.curve))
            .collect();
        if placed.is_empty() {
            return answers_manifest(&name, self.target.size(), &refined);
        }
        let mut sets = Vec::new();
        let mut out = manifest_head(&name) + &answer_families(&name, self.target.size(), &refined) + "\n";
        for (rank, AtlasAnswer { place, name, curve }) in placed {
            let family = &self.plan.families[place[0]].family;
            let scale = curve.fit.placement.scale();
            let factor = if curve.is_scalable { scale } else { 1.0 };
            let size = if curve.is_scalable { "as large as on the path" } else { "in its own size" };
            out += &format!("# {rank}: {}, {size}; {}\n", name, text::placed(curve, self.target.size()));
            let values = scaled_values(&family.template, &curve.values, factor);
            sets.push(ParameterSet { family, values, curve_name: format!("{rank}: {name}") });
        }
        out + &manifest_families(&sets, false)
    }

    fn best(&self) -> Option<Best> {
        let Found { curve: AtlasAnswer { curve, .. }, refined } = self.answers.first()?;
        Some(match refined {
            Some(answer) => Best { quality: answer.quality(), mu_worst_deg: answer.mechanism.mu_worst_deg },
            None => Best { quality: Quality::of(curve.fit.rms_relative), mu_worst_deg: curve.mu_worst_deg },
        })
    }

    fn json(&self) -> anyhow::Result<String> {
        json::json(self)
    }

    fn text(&self) -> String {
        text::text(self)
    }

    /// The path and the curves on one page.
    fn drawing(&self) -> Vec<u8> {
        let found = (1..).zip(&self.answers).filter_map(|(rank, found)| match &found.refined {
            Some(answer) => drawing::found(rank, answer, self.target.size()),
            None => self.drawn(rank, &found.curve),
        });
        drawing::page_of(
            &format!("{} in {}", title_of(&self.name), quoted(&self.plan.title)),
            &self.target,
            Vec::new(),
            found.collect(),
        )
    }
}

impl AtlasReport {
    fn drawn(&self, rank: usize, AtlasAnswer { place, name, curve }: &AtlasAnswer) -> Option<FoundCurve> {
        let [place, cell] = *place;
        let family = &self.plan.families[place].family;
        let needed: Vec<bool> = (0..measure::ALL.len()).map(|k| family.filter_or_sort_uses(k)).collect();
        let solved = solve_measuring(family, &Sampler::new(family.sampling), cell, &needed)?;
        let label = format!("{rank}: {name}, {}", text::placed(curve, self.target.size()));
        drawing::placed(curve, solved, label)
    }
}

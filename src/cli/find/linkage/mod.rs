//! `find --linkage`: the dimensions of any linkage for which its curve is nearest to a path.

mod json;
mod text;

use std::path::Path;
use std::sync::Arc;

use crate::find::{self, LinkageAnswer, MAX_SAMPLES};
use crate::manifest;
use coupler_curves::exchange::{ParameterSet, manifest_families};
use coupler_curves::family::Family;
use coupler_curves::find::{
    Condition, Constraint, LinkageSpace, Mechanism, Options, Quality, Target, answers_manifest, manifest_head,
    nearest_miss_by,
};
use coupler_curves::measure;
use coupler_curves::motion::Sampler;
use coupler_curves::solve::solve_measuring;
use coupler_curves::template::{Orientation, Template};

use super::super::linkage::find_template;
use super::super::source;
use super::{Arguments, Best, InputError, InputErrors, Outcome, Shown, drawing, show, title_of};

/// What has been found for a linkage.
pub(super) struct LinkageReport {
    name: String,
    target: Target,
    space: LinkageSpace,
    /// The number of curves in which the path was looked up.
    curves: usize,
    answers: Vec<LinkageAnswer>,
    /// If there is no answer, the constraints to relax, and the answer without them.
    nearest_miss: Option<(Vec<Constraint>, LinkageAnswer)>,
    /// The text of the linkage, if it is none of the catalogue.
    own_linkage: Option<String>,
}

/// The linkage to search, and the text of the manifest that has it.
pub(super) struct Sought {
    pub template: Arc<Template>,
    space: LinkageSpace,
    own_linkage: Option<String>,
}

/// The error of options that do not go with `--linkage`, if there is one.
pub(super) fn check(arguments: &Arguments) -> Result<(), InputError> {
    let error = |message: &str| Err(InputError(message.to_owned()));
    match arguments {
        Arguments { linkage: Some(_), fixed: true, .. } => error(
            "--fixed compares the curves of an atlas where they are, and --linkage searches linkages of any size in any place: leave one out",
        ),
        Arguments { linkage: None, like: None, manifest: Some(_), .. } => {
            error("--manifest FILE has the curve of --like CURVE or the linkage of --linkage NAME: give one of these")
        }
        Arguments { linkage: Some(_), index: Some(index), .. } if *index > MAX_SAMPLES as u64 => Err(InputError(
            format!("--index {index}: of --linkage it is the number of parameter sets, at most {MAX_SAMPLES}"),
        )),
        _ => Ok(()),
    }
}

/// The linkage that the arguments name; `None` for the search of four-bars, which a `four-bar` with all its parameters free has as well.
///
/// # Errors
/// There is no such linkage, or it cannot be searched.
pub(super) fn sought(arguments: &Arguments) -> anyhow::Result<Option<Sought>> {
    /// The linkage of the catalogue that the search of four-bars finds.
    const FOUR_BAR: &str = "four-bar";
    let Some(name) = &arguments.linkage else { return Ok(None) };
    let template = find_template(name, arguments.manifest.as_deref())?;
    if template.id == FOUR_BAR && arguments.keep.is_empty() {
        return Ok(None);
    }
    if arguments.timed && template.is_driven_by_length() {
        let message = format!(
            "--timed needs an input that is an angle, and that of {name} is a length: leave --timed out, or choose another linkage"
        );
        return Err(InputError(message).into());
    }
    let kept: Vec<(String, Option<String>)> = arguments
        .keep
        .iter()
        .map(|text| match text.split_once('=') {
            Some((name, value)) => (name.trim().to_owned(), Some(value.trim().to_owned())),
            None => (text.trim().to_owned(), None),
        })
        .collect();
    let space = LinkageSpace::new(template.clone(), &kept).map_err(|errors| {
        let prefix = if kept.is_empty() { "--linkage" } else { "--keep" };
        let messages: Vec<String> = errors.iter().map(|error| format!("{prefix}: {error}")).collect();
        InputErrors::from_messages(&messages)
    })?;
    let own_linkage = match (&arguments.manifest, coupler_curves::catalogue::find(&template.id)) {
        (Some(path), None) => own_text(path, &template.id)?,
        _ => None,
    };
    Ok(Some(Sought { template, space, own_linkage }))
}

/// The text of a linkage of a manifest.
fn own_text(path: &Path, id: &str) -> anyhow::Result<Option<String>> {
    let text = source::read_text(path)?;
    Ok(manifest::linkage_text(&text, id))
}

pub(super) fn run(
    arguments: &Arguments,
    sought: Sought,
    options: &Options,
    (name, target): (String, Target),
    is_drawing_printed: bool,
) -> anyhow::Result<Outcome> {
    let Sought { space, own_linkage, .. } = sought;
    let samples = arguments.index.map(|count| count as usize);
    let (answers, curves) = find::search_linkage(&space, &target, options, samples);
    let nearest = |options: &Options| find::search_linkage(&space, &target, options, samples).0.into_iter().next();
    let nearest_miss = match answers.is_empty() {
        true => nearest_miss_by(options, nearest, |answer| answer.curve.fit.rms),
        false => None,
    };
    let report = LinkageReport { name, target, space, curves, answers, nearest_miss, own_linkage };
    show(&report, arguments, is_drawing_printed)
}

/// The condition of the arguments for a linkage.
///
/// # Errors
/// It is none.
pub(super) fn condition(
    template: Option<&Template>,
    text: &str,
) -> Result<Condition, coupler_curves::expression::Error> {
    match template {
        Some(template) => Condition::for_template(template, text),
        None => Condition::for_template(&Mechanism::template(), text),
    }
}

impl Shown for LinkageReport {
    /// A manifest that renders the linkages: in the direction that they have on the path and mirrored as there, and as large if their
    /// dimensions scale. Families have no shift; comments have it.
    fn manifest(&self) -> String {
        let name = title_of(&self.name);
        if self.answers.is_empty() {
            return answers_manifest(&name, self.target.size(), &[]);
        }
        let mut out = manifest_head(&name);
        out.extend(self.own_linkage.iter().map(|text| format!("\n{text}")));
        out.push('\n');
        let families: Vec<Family> =
            (1..).zip(&self.answers).map(|(rank, answer)| placed_family(&format!("curve {rank}"), answer)).collect();
        let mut sets = Vec::new();
        for ((rank, answer), family) in (1..).zip(&self.answers).zip(&families) {
            out += &format!("# {rank}: {}\n", text::place_comment(answer, self.target.size()));
            let curve_name = format!("{rank}: {}", text::deviation(&answer.curve, self.target.size()));
            sets.push(ParameterSet { family, values: answer.curve.values.clone(), curve_name });
        }
        out + &manifest_families(&sets, self.own_linkage.is_some())
    }

    fn best(&self) -> Option<Best> {
        let LinkageAnswer { curve, .. } = self.answers.first()?;
        Some(Best { quality: Quality::of(curve.fit.rms_relative), mu_worst_deg: curve.mu_worst_deg })
    }

    fn json(&self) -> anyhow::Result<String> {
        json::json(self)
    }

    fn text(&self) -> String {
        text::text(self)
    }

    /// The path and the curves on one page.
    fn drawing(&self) -> Vec<u8> {
        let found = (1..).zip(&self.answers).filter_map(|(rank, answer)| {
            let family = &answer.family;
            let needed = vec![false; measure::ALL.len()];
            let solved = solve_measuring(family, &Sampler::new(family.sampling), 0, &needed)?;
            let label = format!(
                "{rank}: {}, {}",
                text::deviation(&answer.curve, self.target.size()),
                text::parameters(&self.space, &answer.curve, self.target.size())
            );
            drawing::placed(&answer.curve, solved, label)
        });
        let title = format!("{}: {}", title_of(&self.name), self.space.template().id);
        drawing::page_of(&title, &self.target, Vec::new(), found.collect())
    }
}

/// The family of an answer, in its direction on the path.
fn placed_family(title: &str, answer: &LinkageAnswer) -> Family {
    let placement = &answer.curve.fit.placement;
    let mut family = answer.family.clone();
    family.title = format!("{}: {}", family.title, title);
    let template = Arc::make_mut(&mut family.template);
    template.orientation = Orientation::new(placement.is_mirrored, placement.rotation_deg());
    family
}

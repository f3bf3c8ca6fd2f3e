//! `find --linkage`: the dimensions of any linkage for which its curve is nearest to a path.

mod json;
mod report;
mod text;

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::find;
use crate::manifest;
use coupler_curves::family::Family;
use coupler_curves::template::Template;
use coupler_find::{Condition, Constraint, LinkageSearch, LinkageSpace, Mechanism, Options, Quality, Target};

use super::super::linkage::find_template;
use super::super::source;
use super::{Arguments, Best, InputError, InputErrors, Outcome, Shown, show, title_of};
use report::LinkageReport;

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
        Arguments { linkage: Some(_), index: Some(index), .. } if *index > LinkageSearch::MAX_SAMPLES as u64 => {
            Err(InputError(format!(
                "--index {index}: of --linkage it is the number of parameter sets, at most {}",
                LinkageSearch::MAX_SAMPLES
            )))
        }
        _ => Ok(()),
    }
}

/// The linkage that the arguments name; `None` for the search of four-bars, which a `four-bar` with all its parameters free has as well.
///
/// # Errors
/// There is no such linkage, or it cannot be searched.
pub(super) fn sought(arguments: &Arguments) -> anyhow::Result<Option<Sought>> {
    let Some(name) = &arguments.linkage else { return Ok(None) };
    let template = find_template(name, arguments.manifest.as_deref())?;
    let kept: Vec<(String, Option<String>)> = arguments
        .keep
        .iter()
        .map(|text| match text.split_once('=') {
            Some((name, value)) => (name.trim().to_owned(), Some(value.trim().to_owned())),
            None => (text.trim().to_owned(), None),
        })
        .collect();
    if find::is_free_four_bar(&template, &kept) {
        return Ok(None);
    }
    if arguments.timed && template.is_driven_by_length() {
        let message = format!(
            "--timed needs an input that is an angle, and that of {name} is a length: leave --timed out, or choose another linkage"
        );
        return Err(InputError(message).into());
    }
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
    (name, reading, target): (String, String, Target),
    is_drawing_printed: bool,
) -> anyhow::Result<Outcome> {
    let Sought { space, own_linkage, .. } = sought;
    let samples = arguments.index.map(|count| count as usize);
    let findings = find::find_linkage(&space, &target, options, samples, &AtomicBool::new(false))
        .map_err(|error| InputError(error.to_string()))?;
    let report = LinkageReport { name, reading, target, space, findings, own_linkage };
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
        Some(template) => Condition::new(template, text),
        None => Condition::new(&Mechanism::template(), text),
    }
}

impl Shown for LinkageReport {
    fn manifest(&self) -> String {
        self.findings.manifest(&title_of(&self.name), &self.target, self.own_linkage.as_deref())
    }

    fn best(&self) -> Option<Best> {
        let curve = &self.findings.answers.first()?.curve;
        Some(Best { quality: Quality::of(curve.fit.rms_relative), mu_worst_deg: curve.mu_worst_deg })
    }

    fn miss(&self) -> Option<(Family, usize)> {
        let (constraints, answer) = self.findings.nearest_miss.as_ref()?;
        constraints.contains(&Constraint::Condition).then(|| (answer.family.clone(), 0))
    }

    fn json(&self) -> anyhow::Result<String> {
        json::json(self)
    }

    fn text(&self) -> String {
        text::text(self)
    }

    fn drawing(&self) -> Vec<u8> {
        self.findings.drawing(&title_of(&self.name), &self.target, &self.space)
    }
}

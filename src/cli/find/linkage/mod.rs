//! `find --linkage`: the dimensions of any linkage for which its curve is nearest to a path.

mod json;
mod report;
mod text;

use std::sync::atomic::AtomicBool;

use crate::find::{self, Findings, SearchedLinkage, Several};
use coupler_curves::family::Family;
use coupler_find::{Constraint, LinkageAnswer, LinkageSpace, Options, Target};

use super::super::linkage::{find_template, own_text};
use super::super::progress_bar;
use super::{Arguments, Best, Failure, Outcome, Shown, show, title_of};
use report::LinkageReport;

/// The linkage that the arguments name.
pub(super) struct Named {
    pub searched: SearchedLinkage,
    /// Its text, if it is of a manifest.
    pub own_linkage: Option<String>,
}

/// The linkage that the arguments name, if they name one.
///
/// # Errors
/// There is no such linkage, or a manifest that is not used.
pub(super) fn named(arguments: &Arguments) -> Result<Option<Named>, Failure> {
    let Some(name) = &arguments.linkage else {
        return match (&arguments.manifest, &arguments.like) {
            (Some(_), None) => {
                let message =
                    "--manifest FILE has the curve of --like CURVE or the linkage of --linkage NAME: give one of these";
                Err(Failure::input(message))
            }
            _ => Ok(None),
        };
    };
    let template = find_template(name, arguments.manifest.as_deref())?;
    let kept = arguments.keep.iter().map(|text| match text.split_once('=') {
        Some((name, value)) => (name.trim().to_owned(), Some(value.trim().to_owned())),
        None => (text.trim().to_owned(), None),
    });
    let own_linkage = own_text(arguments.manifest.as_deref(), &template)?;
    Ok(Some(Named { searched: SearchedLinkage { template, kept: kept.collect() }, own_linkage }))
}

pub(super) fn run(
    arguments: &Arguments,
    (space, Named { own_linkage, .. }): (LinkageSpace, Named),
    options: &Options,
    (name, reading, target): (String, String, Target),
    is_drawing_printed: bool,
) -> Result<Outcome, Failure> {
    let samples = arguments.index.map(|count| count as usize);
    let linkage = space.template().id.clone();
    let findings = with_bar(&linkage, |report_part| {
        find::find_linkage(&space, &target, options, samples, &AtomicBool::new(false), report_part)
    })?;
    let searched = Some(space.free_names().map(str::to_owned).collect());
    let report = LinkageReport { name, reading, target, linkage, searched, findings, own_linkage };
    show(&report, arguments, is_drawing_printed)
}

/// The several linkages that the arguments name, if they do and no manifest has a linkage of this name.
pub(super) fn several(arguments: &Arguments) -> Option<Several> {
    arguments.linkage.as_deref().filter(|_| arguments.manifest.is_none()).and_then(Several::named)
}

pub(super) fn run_several(
    arguments: &Arguments,
    several: Several,
    options: &Options,
    (name, reading, target): (String, String, Target),
    is_drawing_printed: bool,
) -> Result<Outcome, Failure> {
    let count = arguments.index.map(|count| count as usize);
    let linkage = several.name().to_owned();
    let findings = with_bar(&linkage, |report_part| {
        find::find_among(several, &target, options, count, &AtomicBool::new(false), report_part)
    })?;
    let report = LinkageReport { name, reading, target, linkage, searched: None, findings, own_linkage: None };
    show(&report, arguments, is_drawing_printed)
}

/// What a search finds that reports which part of it is done.
fn with_bar(
    name: &str,
    search: impl FnOnce(&mut dyn FnMut(f64)) -> Result<Findings<LinkageAnswer>, find::Error>,
) -> Result<Findings<LinkageAnswer>, Failure> {
    let bar = progress_bar::of_parts(name);
    let findings = search(&mut |part| bar.set_position((1000.0 * part) as u64));
    bar.finish_and_clear();
    findings.map_err(Failure::input)
}

impl Shown for LinkageReport {
    fn manifest(&self) -> String {
        self.findings.manifest(&title_of(&self.name), &self.target, self.own_linkage.as_deref())
    }

    fn best(&self) -> Option<Best> {
        let curve = &self.findings.answers.first()?.curve;
        Some(Best { quality: curve.fit.deviation.quality(), mu_worst_deg: curve.mu_worst_deg })
    }

    fn miss(&self) -> Option<(Family, usize)> {
        let (constraints, answer) = self.findings.nearest_miss.as_ref()?;
        constraints.contains(&Constraint::Condition).then(|| (answer.family.clone(), 0))
    }

    fn json(&self) -> Result<String, Failure> {
        json::json(self)
    }

    fn text(&self) -> String {
        text::text(self)
    }

    fn drawing(&self) -> Vec<u8> {
        self.findings.drawing(&title_of(&self.name), &self.target, &self.linkage)
    }
}

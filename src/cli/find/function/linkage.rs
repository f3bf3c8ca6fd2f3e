//! `find --function --linkage`: the dimensions of any linkage whose output is a function of its input.

use std::fmt::Write;
use std::sync::atomic::AtomicBool;

use crate::find::description::named_values;
use crate::find::function::words::linkage_details_in_words;
use crate::find::function::{
    LinkageFunctionRecord, draw_linkage_function, find_function_by, linkage_error_in_words, linkage_function_manifest,
    linkage_motion_in_words,
};
use coupler_find::{FunctionTarget, LinkageFunctionAnswer, LinkageFunctionOptions, LinkageSpace};
use serde::Serialize;

use super::super::super::jams::jams;
use super::super::super::progress_bar;
use super::super::super::report as reports;
use super::super::json::FORMAT;
use super::super::{Arguments, Failure, Outcome, Shown, show, title_of};
use crate::format::angle;

/// A function, and the dimensions of a linkage that have been found for it.
struct LinkageFunctionReport {
    name: String,
    target: FunctionTarget,
    space: LinkageSpace,
    own_linkage: Option<String>,
    answers: Vec<LinkageFunctionAnswer>,
}

/// A function with its name.
pub(super) type NamedFunction = (String, FunctionTarget);

pub(super) fn run(
    arguments: &Arguments,
    (space, options): (LinkageSpace, LinkageFunctionOptions),
    own_linkage: Option<String>,
    (name, target): NamedFunction,
    is_drawing_printed: bool,
) -> Result<Outcome, Failure> {
    let bar = progress_bar::of_parts(&space.template().id);
    let report_part = |part: f64| bar.set_position((1000.0 * part) as u64);
    let found = find_function_by(&space, &target, &options, &AtomicBool::new(false), report_part);
    bar.finish_and_clear();
    let found = found.map_err(Failure::input)?;
    let answers = found.map_err(Failure::input)?;
    show(&LinkageFunctionReport { name, target, space, own_linkage, answers }, arguments, is_drawing_printed)
}

#[derive(Serialize)]
struct Document {
    function: String,
    linkage: String,
    searched: Vec<String>,
    results: Vec<LinkageFunctionRecord>,
}

impl LinkageFunctionReport {
    fn title(&self) -> String {
        if self.target.as_law().is_some() { self.name.clone() } else { title_of(&self.name) }
    }

    fn details(&self) -> String {
        linkage_details_in_words(&self.space)
    }
}

impl Shown for LinkageFunctionReport {
    fn drawing(&self) -> Vec<u8> {
        draw_linkage_function(&self.title(), &self.details(), &self.target, &self.answers)
    }

    fn json(&self) -> Result<String, Failure> {
        let template = self.space.template();
        let record = |(rank, answer)| LinkageFunctionRecord::new(rank, answer, template);
        let document = Document {
            function: self.name.clone(),
            linkage: template.id.clone(),
            searched: self.space.free_names().map(str::to_owned).collect(),
            results: (1..).zip(&self.answers).map(record).collect(),
        };
        reports::json(FORMAT, &document)
    }

    fn manifest(&self) -> String {
        let id = &self.space.template().id;
        let own = self.own_linkage.as_deref();
        linkage_function_manifest(&self.title(), self.target.is_length(), id, &self.answers, own)
    }

    fn text(&self) -> String {
        let mut out = format!("{}: {}\n", self.name, self.details());
        if self.answers.is_empty() {
            return out
                + "no linkage was found; what may help: a weaker --where, a greater --max-link, fewer --points, other starts or none, --effort thorough\n";
        }
        let is_length = self.target.is_length();
        for (rank, answer) in (1..).zip(&self.answers) {
            let mu = match answer.mu_worst_deg {
                mu if mu.is_finite() => format!(", mu worst {}", angle(mu)),
                _ => String::new(),
            };
            let _ = writeln!(out, "{rank:>3}  {}{mu}", linkage_error_in_words(answer, is_length));
            let _ = writeln!(out, "     {}", named_values(self.space.template(), &answer.values));
            let _ = writeln!(out, "     {}", linkage_motion_in_words(answer, is_length));
        }
        out
    }

    fn notes(&self, arguments: &Arguments) -> String {
        self.answers.first().map_or(String::new(), |best| jams(best.mu_worst_deg, arguments.condition.as_deref()))
    }
}

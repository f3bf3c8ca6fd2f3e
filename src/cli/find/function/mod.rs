//! `find --function`: the linkages whose output is a function of their input.

mod json;
mod linkage;
mod report;
mod text;

use std::path::Path;
use std::sync::atomic::AtomicBool;

use crate::find::Notation;
use crate::find::function::{
    self, FunctionLinkage, FunctionRequest, FunctionSearch, draw_function, find_function, function_manifest,
};
use crate::output;
use coupler_curves::expression::Expression;
use coupler_curves::problem;
use coupler_find::{FunctionTarget, Options};

use super::super::effort::EffortChoice;
use super::super::jams::jams;
use super::arguments::InputChoice;
use super::linkage::named;
use super::request::parse_length;
use super::{Arguments, Failure, Outcome, Shown, files, not_a_path, show};
use report::FunctionReport;

pub(super) fn run(arguments: &Arguments, is_drawing_printed: bool) -> Result<Outcome, Failure> {
    let named = if arguments.linkage.is_some() { named(arguments)? } else { None };
    let (searched, own_linkage) = named.map(|named| (named.searched, named.own_linkage)).unzip();
    let linkage = FunctionLinkage::of(searched, arguments.manifest.is_some());
    let Read { name, target, first } = read_target(arguments, linkage.is_length())?;
    if let Some(jobs) = arguments.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    match check(arguments, &target, linkage)? {
        FunctionSearch::Any(space, options) => {
            let own_linkage = own_linkage.flatten();
            linkage::run(arguments, (space, options), own_linkage, (name, target), is_drawing_printed)
        }
        FunctionSearch::Closed(options, methods) => {
            let attempts =
                find_function(&target, &options, &methods, &AtomicBool::new(false)).map_err(Failure::input)?;
            let report = FunctionReport { name, target, first, options, attempts };
            show(&report, arguments, is_drawing_printed)
        }
    }
}

/// A function that has been read.
struct Read {
    name: String,
    target: FunctionTarget,
    /// The first row of a table.
    first: Option<[f64; 2]>,
}

/// The function that the arguments name.
///
/// # Errors
/// It cannot be read, or is none.
fn read_target(arguments: &Arguments, is_length: bool) -> Result<Read, Failure> {
    let path = arguments.path.as_deref().unwrap_or(Path::new("-"));
    let text = path.to_string_lossy();
    if function::is_formula(&text) && !path.exists() {
        return match function::parse_formula(&text) {
            Ok(target) => Ok(Read { name: text.trim().to_owned(), target, first: None }),
            Err(problems) => {
                let report = problem::report(&problems, "the function", &text, false);
                let report = report.trim_end().strip_prefix("error: ").unwrap_or(&report).to_owned();
                Err(Failure::inputs(&[report]))
            }
        };
    }
    files::protect(path, "the function");
    let name = files::input_name(path);
    let bytes = output::read_bytes(path).map_err(|error| not_a_path::unreadable_function(path, error))?;
    let (target, first) = function::read_function(&bytes, is_length).map_err(|problems| {
        let problems: Vec<String> = problems.iter().map(|problem| format!("{name}: {problem}")).collect();
        Failure::inputs(&problems)
    })?;
    Ok(Read { name, target, first })
}

/// The numbers of the arguments.
struct Numbers {
    /// The starts of input and output.
    starts: [Option<f64>; 2],
    max_link: Option<f64>,
}

/// Reads the numbers of the arguments, and says what is wrong with them.
fn read_numbers(arguments: &Arguments) -> (Numbers, Vec<String>) {
    let mut problems = Vec::new();
    let mut keep = |found: Result<f64, String>| found.map_err(|problem| problems.push(problem)).ok();
    let mut number = |option: &str, text: &Option<String>| {
        let text = text.as_deref()?;
        let bare = text.trim().trim_end_matches("deg").trim_end_matches('°');
        let value = Expression::evaluate_constant(bare);
        keep(value.map_err(|error| format!("{option}: `{text}`: {error}; write a number, as in {option} 30")))
    };
    let starts = [number("--input-start", &arguments.input_start), number("--output-start", &arguments.output_start)];
    let max_link = arguments.max_link.as_deref().and_then(|text| keep(parse_length(text)));
    (Numbers { starts, max_link }, problems)
}

/// The search that the arguments ask for.
///
/// # Errors
/// All that is wrong with them.
fn check(arguments: &Arguments, target: &FunctionTarget, linkage: FunctionLinkage) -> Result<FunctionSearch, Failure> {
    let (Numbers { starts: [input_start_deg, output_start], max_link }, mut problems) = read_numbers(arguments);
    let request = FunctionRequest {
        notation: Notation::CommandLine,
        target,
        linkage,
        has_manifest: arguments.manifest.is_some(),
        fit: arguments.fit.map(Into::into),
        points: arguments.points,
        input_start_deg,
        output_start,
        full_turn: arguments.input == Some(InputChoice::FullTurn),
        max_link,
        condition: arguments.condition.as_deref(),
        effort: Some(arguments.effort).filter(|effort| *effort != EffortChoice::Normal).map(Into::into),
        seed: Some(arguments.seed).filter(|seed| *seed != Options::default().seed),
        most: arguments.top.into(),
    };
    match request.check() {
        Ok(checked) if problems.is_empty() => Ok(checked),
        checked => {
            problems.extend(checked.err().into_iter().flatten());
            Err(Failure::inputs(&problems))
        }
    }
}

impl Shown for FunctionReport {
    fn drawing(&self) -> Vec<u8> {
        draw_function(&self.title(), &self.details(), &self.target, self.answers())
    }

    fn json(&self) -> Result<String, Failure> {
        json::json(self)
    }

    fn manifest(&self) -> String {
        function_manifest(&self.title(), self.answers())
    }

    fn text(&self) -> String {
        text::text(self)
    }

    fn notes(&self, arguments: &Arguments) -> String {
        let mut out = String::new();
        for (before, attempt) in self.attempts.iter().zip(self.attempts.iter().skip(1)) {
            out += &text::tried(before, attempt.method);
        }
        out += &text::any_zero(self);
        out += &self
            .answers()
            .first()
            .map_or(String::new(), |best| jams(best.mu_worst_deg, arguments.condition.as_deref()));
        out
    }
}

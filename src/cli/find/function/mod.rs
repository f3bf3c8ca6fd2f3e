//! `find --function`: the linkages whose output is a function of their input.

mod json;
mod linkage;
mod report;
mod text;

use std::path::Path;
use std::sync::atomic::AtomicBool;

use crate::find::function::{self, FunctionRequest, draw_function, find_function, function_manifest};
use crate::find::{self, Notation};
use crate::output;
use coupler_curves::expression::Expression;
use coupler_curves::linkage::OutputLink;
use coupler_curves::problem;
use coupler_find::{FunctionMethod, FunctionOptions, FunctionTarget, GeneratorKind, Options};

use super::super::effort::EffortChoice;
use super::super::jams::jams;
use super::arguments::InputChoice;
use super::linkage::named;
use super::request::parse_length;
use super::{Arguments, Failure, Outcome, Shown, files, not_a_path, show};
use report::FunctionReport;

pub(super) fn run(arguments: &Arguments, is_drawing_printed: bool) -> Result<Outcome, Failure> {
    let closed_form = closed_form(arguments);
    let named = if closed_form.is_some() || arguments.linkage.is_none() { None } else { named(arguments)? };
    check_linkage_options(arguments, named.is_some())?;
    let output = named.as_ref().and_then(|named| named.searched.template.structure().ok()?.output());
    let is_length = output.map_or(closed_form == Some(GeneratorKind::SliderCrank), OutputLink::is_slider);
    let Read { name, target, first } = read_target(arguments, is_length)?;
    if let Some(jobs) = arguments.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    let (numbers, problems) = read_numbers(arguments);
    if let Some(named) = named {
        if !problems.is_empty() {
            return Err(Failure::inputs(&problems));
        }
        return linkage::run(arguments, named, (name, target), (numbers.starts, numbers.max_link), is_drawing_printed);
    }
    let of_target = if target.is_length() { GeneratorKind::SliderCrank } else { GeneratorKind::FourBar };
    let kind = closed_form.unwrap_or(of_target);
    let (options, methods) = check(arguments, &target, kind, (numbers, problems))?;
    let attempts = find_function(&target, &options, &methods, &AtomicBool::new(false)).map_err(Failure::input)?;
    let report = FunctionReport { name, target, first, options, attempts };
    show(&report, arguments, is_drawing_printed)
}

/// The linkage that is named, if it is solved in closed form with all its lengths free.
fn closed_form(arguments: &Arguments) -> Option<GeneratorKind> {
    match arguments.linkage.as_deref() {
        _ if !arguments.keep.is_empty() || arguments.manifest.is_some() => None,
        Some("four-bar") => Some(GeneratorKind::FourBar),
        Some("slider-crank") => Some(GeneratorKind::SliderCrank),
        _ => None,
    }
}

/// Refuses options of the search for any linkage where there is none.
///
/// # Errors
/// One of them is given.
fn check_linkage_options(arguments: &Arguments, has_linkage: bool) -> Result<(), Failure> {
    let is_effort = arguments.effort != EffortChoice::Normal;
    let given = [
        ("--manifest", arguments.manifest.is_some()),
        ("--effort", is_effort),
        ("--seed", arguments.seed != Options::default().seed),
    ];
    let unused = given.iter().filter(|(_, is_given)| *is_given && !has_linkage);
    let problems: Vec<String> = unused
        .map(|(option, _)| {
            format!("{option} is of --linkage NAME, the dimensions of any linkage: name one, or leave it out")
        })
        .collect();
    if problems.is_empty() { Ok(()) } else { Err(Failure::inputs(&problems)) }
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
    let in_file = |problems: &[String]| {
        let problems: Vec<String> = problems.iter().map(|problem| format!("{name}: {problem}")).collect();
        Failure::inputs(&problems)
    };
    let found = find::parse_function(&bytes).map_err(|problems| in_file(&problems))?;
    let is_length = found.is_length.unwrap_or(is_length);
    let target = FunctionTarget::rows(&found.rows, is_length).map_err(|problems| {
        let with_line = |problem: &coupler_find::FunctionTargetError| {
            let line = problem.row().and_then(|row| found.lines.get(row - 1));
            line.map_or(problem.to_string(), |line| format!("line {line}: {problem}"))
        };
        in_file(&problems.iter().map(with_line).collect::<Vec<_>>())
    })?;
    Ok(Read { name, target, first: found.rows.first().copied() })
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

/// What the arguments ask for of a linkage in closed form.
///
/// # Errors
/// All that is wrong with them.
fn check(
    arguments: &Arguments,
    target: &FunctionTarget,
    kind: GeneratorKind,
    (numbers, mut problems): (Numbers, Vec<String>),
) -> Result<(FunctionOptions, Vec<FunctionMethod>), Failure> {
    let [input_start_deg, output_start] = numbers.starts;
    let request = FunctionRequest {
        notation: Notation::CommandLine,
        target,
        kind,
        fit: arguments.fit.map(Into::into),
        points: arguments.points,
        input_start_deg,
        output_start,
        full_turn: arguments.input == Some(InputChoice::FullTurn),
        max_link: numbers.max_link.unwrap_or(FunctionRequest::MAX_LINK),
        condition: arguments.condition.as_deref(),
        most: arguments.top.into(),
    };
    match request.check() {
        Ok(checked) if problems.is_empty() => Ok(checked),
        Ok(_) => Err(Failure::inputs(&problems)),
        Err(others) => {
            problems.extend(others);
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

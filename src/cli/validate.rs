//! `validate`: reports every problem of a manifest.

use std::path::{Path, PathBuf};

use crate::manifest::Plan;
use crate::output;
use clap::{Args, ValueHint};
use coupler_curves::problem::{self, Problem};
use serde::Serialize;

use super::files::DEFAULT_MANIFEST;
use super::report::{self, ReportRequest};
use super::source;
use super::{Failure, Outcome, files, print, print_bytes};
use coupler_curves::text::pluralize;

/// Report every problem of a manifest, and write nothing but the requested reports.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The manifest; - for standard input.
    #[arg(default_value = DEFAULT_MANIFEST, value_hint = ValueHint::FilePath)]
    manifest: PathBuf,
    /// Write a report as text or json to a file, or print it: text, the default, to standard error, json to standard
    /// output instead of it; may be given more than once.
    #[arg(long, value_name = "FORMAT[=FILE]", value_parser = parse_report)]
    report: Vec<ReportRequest<ReportFormat>>,
}

/// The format of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReportFormat {
    Text,
    Json,
}

/// The formats of reports by their names.
pub const REPORTS: [(&str, ReportFormat); 2] = [("text", ReportFormat::Text), ("json", ReportFormat::Json)];

fn parse_report(text: &str) -> Result<ReportRequest<ReportFormat>, String> {
    report::parse_request(text, &REPORTS)
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let path = &arguments.manifest;
    let text = source::read_text(path)?;
    let loaded = source::parse(path, &text)?;
    let mut problems = loaded.problems;
    let plan = loaded.plan.as_ref();
    problems.extend(plan.into_iter().flat_map(|plan| output::empty_family_warnings(plan, None)));
    problems.extend(plan.into_iter().flat_map(output::scale_problems));
    let plan = plan.filter(|_| !problems.iter().any(Problem::is_error));
    let is_printed = |format| arguments.report.iter().any(|given| given.format == format && given.file.is_none());
    if is_printed(ReportFormat::Text) || !is_printed(ReportFormat::Json) {
        source::report_problems(path, &text, &problems);
    }
    for ReportRequest { format, file } in &arguments.report {
        let report = match format {
            ReportFormat::Text => problem::report(&problems, &files::input_name(path), &text, false),
            ReportFormat::Json => json(path, &text, &problems, plan)?,
        };
        match (file, format) {
            (Some(file), _) => files::write(file, report.as_bytes())?,
            (None, ReportFormat::Json) => print_bytes(report.as_bytes())?,
            (None, ReportFormat::Text) => {}
        }
    }
    let Some(plan) = plan else {
        let errors = problems.iter().filter(|problem| problem.is_error()).count();
        return Err(source::problems_error(path, errors));
    };
    if !is_printed(ReportFormat::Json) {
        let [families, cells] =
            [(plan.families.len(), "family"), (cell_count(plan), "cell")].map(|(count, noun)| pluralize(count, noun));
        print(&format!("{}: {families}, {cells}\n", files::input_name(path)))?;
    }
    Ok(Outcome::Done)
}

fn cell_count(plan: &Plan) -> usize {
    plan.families.iter().map(|planned| planned.family.cell_count()).sum()
}

/// The version of the format of the JSON, which docs/commands.md describes.
const FORMAT: u32 = 1;

#[derive(Serialize)]
struct Document<'a> {
    has_errors: bool,
    families: Option<usize>,
    cells: Option<usize>,
    problems: Vec<JsonProblem<'a>>,
}

#[derive(Serialize)]
struct JsonProblem<'a> {
    file: &'a str,
    line: usize,
    column: usize,
    severity: &'static str,
    message: &'a str,
    label: Option<&'a str>,
    help: Option<&'a str>,
}

impl<'a> JsonProblem<'a> {
    fn new(problem: &'a Problem, file: &'a str, text: &str) -> JsonProblem<'a> {
        // A problem at the end is on the last line, as in the text, and not on an empty one after it.
        let end = text.strip_suffix('\n').map_or(text.len(), str::len);
        let before = &text[..text.floor_char_boundary(problem.span.start.min(end))];
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        let non_empty = |text: &'a String| Some(text.as_str()).filter(|text| !text.is_empty());
        JsonProblem {
            file,
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
            severity: if problem.is_error() { "error" } else { "warning" },
            message: &problem.message,
            label: non_empty(&problem.label),
            help: non_empty(&problem.help),
        }
    }
}

/// The problems of a manifest as JSON, in the order of the text: errors first, each in the order of the manifest.
fn json(path: &Path, text: &str, problems: &[Problem], plan: Option<&Plan>) -> Result<String, Failure> {
    let file = path.to_string_lossy();
    let mut ordered: Vec<&Problem> = problems.iter().collect();
    ordered.sort_by_key(|problem| (!problem.is_error(), problem.span.start));
    let document = Document {
        has_errors: plan.is_none(),
        families: plan.map(|plan| plan.families.len()),
        cells: plan.map(cell_count),
        problems: ordered.into_iter().map(|problem| JsonProblem::new(problem, &file, text)).collect(),
    };
    report::json(FORMAT, &document)
}

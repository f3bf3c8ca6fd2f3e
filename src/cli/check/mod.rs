//! `check`: compares a fresh run of a manifest with a recorded atlas.

mod github;
mod json;
mod junit;
mod left_out;
mod markdown;
mod overlays;
mod place;
mod sarif;
mod summary;
mod table;

use std::path::{Path, PathBuf};

use crate::check::{self, Event, Report};
use crate::manifest::{PartialTolerances, Tolerances, tolerated_names};
use crate::output;
use clap::{Args, ValueHint};
use indicatif::ProgressBar;

use super::files::DEFAULT_MANIFEST;
use super::report::{self, ReportRequest};
use super::source::{self, ManifestSource};
use super::{Failure, Outcome, choice, files, print, print_bytes, print_stderr, printable, progress_bar};

/// Run a manifest again, and report what has changed since an atlas was recorded: which curve, where and by how much.
///
/// Nothing is written except the requested reports. Exits with 0 if nothing has changed, and with 1 if anything has.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The manifest; - for standard input.
    #[arg(default_value = DEFAULT_MANIFEST, value_hint = ValueHint::FilePath)]
    manifest: PathBuf,
    /// The folder of the recorded atlas, with its run.json.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath, value_parser = files::folder_parser())]
    against: PathBuf,
    /// Check only this family; may be given more than once.
    #[arg(long, value_name = "FAMILY")]
    only: Vec<String>,
    #[arg(
        long,
        value_name = "LENGTH",
        value_parser = parse_tolerance,
        help = tolerance_help(
            "The greatest distance a point may move, in the unit of the manifest",
            |tolerances| tolerances.atol
        )
    )]
    atol: Option<f64>,
    #[arg(
        long,
        value_name = "RATIO",
        value_parser = parse_tolerance,
        help = tolerance_help(
            "The greatest distance a point may move, relative to the size of its curve; a move is reported if it \
             exceeds both --atol and --rtol",
            |tolerances| tolerances.rtol
        )
    )]
    rtol: Option<f64>,
    #[arg(
        long,
        value_name = "RATIO",
        value_parser = parse_tolerance,
        help = tolerance_help("The greatest relative change of a measure", |tolerances| tolerances.measure_rtol)
    )]
    measure_rtol: Option<f64>,
    /// The greatest relative change of one measure or column, as in straight_length=1e-6; may be given more than once.
    #[arg(long, value_name = "NAME=RATIO", value_parser = parse_named_tolerance)]
    tolerance: Vec<(&'static str, f64)>,
    /// A measure or a column that is not compared; may be given more than once.
    #[arg(long, value_name = "NAME", value_parser = parse_name)]
    ignore: Vec<&'static str>,
    /// Write a report as json, junit, sarif, markdown or github (annotations) to a file, or print it instead of the table; may be
    /// given more than once.
    #[arg(long, value_name = "FORMAT[=FILE]", value_parser = parse_report)]
    report: Vec<ReportRequest<ReportFormat>>,
    /// Draw each curve that has moved, as recorded and as it is now, into this folder, with an index.html.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath, value_parser = files::folder_parser())]
    diff: Option<PathBuf>,
    /// Print for each family which curves have changed and how far, instead of the findings.
    #[arg(long)]
    summary: bool,
    /// Report the changes, then replace the recorded atlas by the new run.
    #[arg(long)]
    bless: bool,
    /// The number of threads [default: one for each processor].
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Print only changes.
    #[arg(short, long)]
    quiet: bool,
}

/// The help of a tolerance, with its default.
fn tolerance_help(text: &str, value: fn(&Tolerances) -> f64) -> String {
    let default = match value(&Tolerances::default()) {
        0.0 => "0".to_owned(),
        value => format!("{value:e}"),
    };
    format!("{text} [default: the manifest's, or {default}]")
}

/// The format of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReportFormat {
    Json,
    Junit,
    Sarif,
    Markdown,
    Github,
}

/// The formats of reports by their names.
pub const REPORTS: [(&str, ReportFormat); 5] = [
    ("json", ReportFormat::Json),
    ("junit", ReportFormat::Junit),
    ("sarif", ReportFormat::Sarif),
    ("markdown", ReportFormat::Markdown),
    ("github", ReportFormat::Github),
];

fn parse_report(text: &str) -> Result<ReportRequest<ReportFormat>, String> {
    report::parse_request(text, &REPORTS)
}

fn parse_tolerance(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "expected a number, as in 1e-9".to_owned())?;
    if value >= 0.0 { Ok(value) } else { Err("a tolerance must not be negative".to_owned()) }
}

fn parse_name(text: &str) -> Result<&'static str, String> {
    let known = tolerated_names();
    let names: Vec<(&str, &'static str)> = known.iter().map(|name| (*name, *name)).collect();
    choice::parse("measure or column", text, &names)
}

fn parse_named_tolerance(text: &str) -> Result<(&'static str, f64), String> {
    let (name, ratio) = text.split_once('=').ok_or("expected a name and a ratio, as in straight_length=1e-6")?;
    Ok((parse_name(name)?, parse_tolerance(ratio)?))
}

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    // Before the manifest is read, which may have designs to search for.
    if let Some(jobs) = arguments.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    let source = source::read(&arguments.manifest)?;
    source.require_families(&arguments.only)?;
    if arguments.bless && !arguments.only.is_empty() {
        let message =
            "--bless records all families: leave out --only, or use `render --force --only` for a single family";
        return Err(Failure::input(message));
    }
    // What cannot be written is said before the check, which may take long.
    for file in arguments.report.iter().filter_map(|request| request.file.as_ref()) {
        files::require_writable(file)?;
    }
    if let Some(folder) = &arguments.diff {
        overlays::require_own_folder(folder)?;
    }
    let Arguments { atol, rtol, measure_rtol, .. } = *arguments;
    let ignored = arguments.ignore.iter().map(|name| (*name, f64::INFINITY));
    let named = arguments.tolerance.iter().copied().chain(ignored);
    let by_name = named.map(|(name, tolerance)| (name.to_owned(), tolerance)).collect();
    let tolerances = PartialTolerances { atol, rtol, measure_rtol, by_name };
    let options = check::Options { only: arguments.only.clone(), tolerances, ..check::Options::default() };
    let mut bar = ProgressBar::hidden();
    let report = check::check_atlas(&source.plan, &arguments.against, &options, &mut |event| match event {
        Event::Begin { family, pages } if !arguments.quiet => {
            bar = progress_bar::of_things(family, pages, "pages");
        }
        Event::Begin { .. } => {}
        Event::Page => bar.inc(1),
        Event::End => bar.finish_and_clear(),
    })?;
    write_reports(arguments, &source, &report)?;
    if let Some(folder) = &arguments.diff {
        overlays::write(folder, &source.plan, &arguments.against, &options, &report)?;
    }
    if arguments.bless {
        return bless(arguments, &source, &report);
    }
    Ok(if report.has_differences() { Outcome::Difference } else { Outcome::Done })
}

/// The report as a table.
pub(super) fn report_text(report: &Report) -> String {
    table::text(report)
}

/// Writes the requested reports, and prints the table unless a report is printed instead.
fn write_reports(arguments: &Arguments, source: &ManifestSource, report: &Report) -> Result<(), Failure> {
    let mut has_table = true;
    for request in &arguments.report {
        let text = match request.format {
            ReportFormat::Json => json::text(report)?,
            ReportFormat::Junit => junit::text(report)?,
            ReportFormat::Sarif => sarif::text(report, source)?,
            ReportFormat::Markdown => markdown::text(report),
            ReportFormat::Github => github::text(report, source),
        };
        match &request.file {
            Some(file) => files::write(file, text.as_bytes())?,
            None => {
                has_table = false;
                print_bytes(text.as_bytes())?;
            }
        }
    }
    if has_table && (!arguments.quiet || !report.findings.is_empty()) {
        print(&if arguments.summary { summary::text(report) } else { table::text(report) })?;
    }
    Ok(())
}

/// Replaces the recorded atlas by a fresh run.
fn bless(arguments: &Arguments, source: &ManifestSource, report: &Report) -> Result<Outcome, Failure> {
    if report.findings.is_empty() {
        print_stderr("nothing has changed: the recorded atlas is kept\n");
        return Ok(Outcome::Done);
    }
    let folder: &Path = &arguments.against;
    if !arguments.summary {
        print_stderr(&summary::text(report));
    }
    print_stderr(&format!("recording the new atlas in {}\n", printable(folder.display())));
    let manifest = Some(source.file_name());
    let options = output::Options { force: true, manifest, ..output::Options::default() };
    output::write_atlas(&source.plan, folder, &options, &mut |_| {}).map_err(|error| source.failure(error))?;
    Ok(Outcome::Done)
}

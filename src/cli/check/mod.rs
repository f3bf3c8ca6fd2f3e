//! `check`: what has changed since an atlas was recorded.

mod github;
mod json;
mod junit;
mod overlays;
mod table;

use std::path::{Path, PathBuf};

use clap::Args;
use coupler_atlas::check::{self, Event, Report};
use coupler_atlas::manifest::PartialTolerances;
use coupler_atlas::output;
use coupler_curves::problem::suggestion;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::source::{self, ManifestSource};
use super::{InputError, Outcome, print, print_stderr};

/// Run a manifest afresh, and tell what has changed since an atlas was recorded: which curve, where and by how much.
///
/// Nothing is written but the reports asked for. Exits with 0 if nothing has changed, and with 1 if anything has.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The manifest.
    #[arg(default_value = "atlas.toml")]
    manifest: PathBuf,
    /// The folder of the recorded atlas, with its run.json.
    #[arg(long, value_name = "DIR")]
    against: PathBuf,
    /// Check this family only; may be given more than once.
    #[arg(long, value_name = "FAMILY")]
    only: Vec<String>,
    /// How far a point may move, in units of length, in place of the manifest's [default: 0].
    #[arg(long, value_name = "LENGTH", value_parser = parse_tolerance, allow_negative_numbers = true)]
    atol: Option<f64>,
    /// How far a point may move, in parts of its curve's size [default: 1e-12]. The greater of both counts.
    #[arg(long, value_name = "PART", value_parser = parse_tolerance, allow_negative_numbers = true)]
    rtol: Option<f64>,
    /// How much a measure may change, in parts of itself [default: 1e-9].
    #[arg(long, value_name = "PART", value_parser = parse_tolerance, allow_negative_numbers = true)]
    measure_rtol: Option<f64>,
    /// Report as json, junit or github (annotations), to a file, or instead of the table; may be given more than once.
    #[arg(long, value_name = "FORMAT[=FILE]", value_parser = parse_report)]
    report: Vec<ReportRequest>,
    /// Draw a page for each curve that has moved into this folder, old and new, and an index.html of them.
    #[arg(long, value_name = "DIR")]
    diff: Option<PathBuf>,
    /// Make what comes out now the recorded atlas, after telling what that replaces.
    #[arg(long)]
    bless: bool,
    /// How many threads to use [default: one for each processor].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Say nothing but what has changed.
    #[arg(short, long)]
    quiet: bool,
}

/// A report that is asked for.
#[derive(Clone, Debug)]
struct ReportRequest {
    format: ReportFormat,
    /// Where it goes; to standard output, in place of the table, where it is not said.
    file: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ReportFormat {
    Json,
    Junit,
    Github,
}

fn parse_report(text: &str) -> Result<ReportRequest, String> {
    const KNOWN: [(&str, ReportFormat); 3] =
        [("json", ReportFormat::Json), ("junit", ReportFormat::Junit), ("github", ReportFormat::Github)];
    let (name, file) = text.split_once('=').map_or((text, None), |(name, file)| (name, Some(file)));
    let names = KNOWN.map(|(name, _)| name);
    let format = KNOWN.into_iter().find(|(known, _)| *known == name).map(|(_, format)| format);
    let format = format.ok_or_else(|| format!("there is no report `{name}`: {}", suggestion(name, &names)))?;
    match file {
        Some("") => Err(format!("there is no file after `=`: write {name}=report.{name}")),
        file => Ok(ReportRequest { format, file: file.map(PathBuf::from) }),
    }
}

fn parse_tolerance(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "it is no number: give one such as 1e-9".to_owned())?;
    if value >= 0.0 { Ok(value) } else { Err("a tolerance is 0 or more".to_owned()) }
}

pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    let source = source::read(&arguments.manifest)?;
    source.require_families(&arguments.only)?;
    if arguments.bless && !arguments.only.is_empty() {
        let words = "--bless records all families: leave out --only, or `render --force --only` one of them";
        return Err(InputError(words.to_owned()).into());
    }
    if let Some(jobs) = arguments.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    let Arguments { atol, rtol, measure_rtol, .. } = *arguments;
    let tolerances = PartialTolerances { atol, rtol, measure_rtol };
    let options = check::Options { only: arguments.only.clone(), tolerances };
    let mut bar = ProgressBar::hidden();
    let report = check::check_atlas(&source.plan, &arguments.against, &options, &mut |event| match event {
        Event::Begin { family, pages } if !arguments.quiet => {
            let style = ProgressStyle::with_template("{msg:20} {bar:40} {pos}/{len} pages");
            bar = ProgressBar::with_draw_target(Some(pages as u64), ProgressDrawTarget::stderr());
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar.set_message(family.to_owned());
        }
        Event::Begin { .. } => {}
        Event::Page => bar.inc(1),
        Event::End => bar.finish_and_clear(),
    })?;
    write_reports(arguments, &source, &report)?;
    if let Some(folder) = &arguments.diff {
        overlays::write(folder, &source.plan, &arguments.against, (&options, &report))?;
    }
    if arguments.bless {
        return bless(arguments, &source, &report);
    }
    Ok(if report.has_differences() { Outcome::Difference } else { Outcome::Done })
}

/// Writes the reports that are asked for, and the table unless another takes its place.
fn write_reports(arguments: &Arguments, source: &ManifestSource, report: &Report) -> anyhow::Result<()> {
    let mut has_table = true;
    for wanted in &arguments.report {
        let text = match wanted.format {
            ReportFormat::Json => json::text(report)?,
            ReportFormat::Junit => junit::text(report)?,
            ReportFormat::Github => github::text(report, source),
        };
        match &wanted.file {
            Some(file) => output::write_file(file, text.as_bytes())?,
            None => {
                has_table = false;
                print(&text)?;
            }
        }
    }
    if has_table && (!arguments.quiet || !report.findings.is_empty()) {
        print(&table::text(report))?;
    }
    Ok(())
}

/// Records what comes out now.
fn bless(arguments: &Arguments, source: &ManifestSource, report: &Report) -> anyhow::Result<Outcome> {
    if report.findings.is_empty() {
        print_stderr("nothing has changed: the recorded atlas stays as it is\n");
        return Ok(Outcome::Done);
    }
    let folder: &Path = &arguments.against;
    print_stderr(&format!("recording the new state in {}\n", folder.display()));
    let options = output::Options { force: true, ..output::Options::default() };
    output::write_atlas(&source.plan, folder, &options, &mut |_| {})?;
    Ok(Outcome::Done)
}

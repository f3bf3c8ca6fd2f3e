use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use coupler_atlas::output::{self, Event};
use coupler_atlas::record::FamilyRecord;
use coupler_curves::problem::suggestion;
use coupler_drawing::render::Format;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::{EXIT_INTERRUPTED, Outcome, pluralize, print, print_stderr, source};

/// Solve every family of a manifest, and write its pages and point sets.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The manifest.
    #[arg(default_value = "atlas.toml")]
    manifest: PathBuf,
    /// The folder to write to, relative to the current folder [default: the manifest's `output`, beside it].
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// The formats of pages, in place of the manifest's: svg, png, pdf (one book). What an earlier run drew in others stays.
    #[arg(long, value_name = "FORMATS", value_delimiter = ',', value_parser = parse_format)]
    format: Option<Vec<Format>>,
    /// Render this family only, and leave the others' files as they are; may be given more than once.
    #[arg(long, value_name = "FAMILY")]
    only: Vec<String>,
    /// Draw every page, also those that are there already as this version of the program draws them.
    #[arg(long)]
    force: bool,
    /// How many threads to use [default: one for each processor].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Exit with 1 if a cell cannot be assembled, or not over the whole range asked for.
    #[arg(long)]
    strict: bool,
    /// Say nothing but what goes wrong.
    #[arg(short, long)]
    quiet: bool,
}

fn parse_format(name: &str) -> Result<Format, String> {
    let known = Format::ALL.map(Format::name);
    Format::ALL
        .into_iter()
        .find(|format| format.name() == name)
        .ok_or_else(|| format!("there is no format `{name}`: {}", suggestion(name, &known)))
}

/// How many cells that were not assembled are named one by one.
const MAX_WARNINGS: usize = 10;

pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    let source = source::read(&arguments.manifest)?;
    source.require_families(&arguments.only)?;
    if let Some(jobs) = arguments.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    let output = source.output_folder(arguments.output.as_deref());
    let (formats, only, force) = (arguments.format.clone(), arguments.only.clone(), arguments.force);
    let options = output::Options { formats, only, force, interrupt: interrupt_flag()? };
    let mut teller =
        ProgressReporter { is_quiet: arguments.quiet, bar: ProgressBar::hidden(), warnings: 0, not_assembled: 0 };
    let mut lines = String::new();
    let run =
        output::write_atlas(&source.plan, &output, &options, &mut |event| teller.handle_event(event, &mut lines))?;
    source.report_problems(&output::empty_family_warnings(&source.plan, Some(&run)));
    if !arguments.quiet {
        lines.push_str(&format!("written to {}\n", output.display()));
        print(&lines)?;
    }
    Ok(if arguments.strict && teller.not_assembled > 0 { Outcome::Difference } else { Outcome::Done })
}

/// What becomes true when the program is asked to end; asked once more, it ends at once.
fn interrupt_flag() -> anyhow::Result<Arc<AtomicBool>> {
    let interrupt = Arc::new(AtomicBool::new(false));
    let asked = Arc::clone(&interrupt);
    ctrlc::set_handler(move || {
        if asked.swap(true, Ordering::Relaxed) {
            std::process::exit(EXIT_INTERRUPTED.into());
        }
    })?;
    Ok(interrupt)
}

/// Tells what happens: a bar on a terminal, a line for each family at the end.
struct ProgressReporter {
    is_quiet: bool,
    bar: ProgressBar,
    warnings: usize,
    not_assembled: usize,
}

impl ProgressReporter {
    fn handle_event(&mut self, event: Event, lines: &mut String) {
        match event {
            Event::Begin { family, pages } if !self.is_quiet => {
                let style = ProgressStyle::with_template("{msg:20} {bar:40} {pos}/{len} pages");
                self.bar = ProgressBar::with_draw_target(Some(pages as u64), ProgressDrawTarget::stderr());
                self.bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
                self.bar.set_message(family.to_owned());
            }
            Event::Begin { .. } => {}
            Event::Page => self.bar.inc(1),
            Event::Shortfall { family, cell, reason } => {
                self.not_assembled += 1;
                self.warnings += 1;
                if self.warnings <= MAX_WARNINGS {
                    self.bar.suspend(|| print_stderr(&format!("warning: {family}, cell {cell}: {reason}\n")));
                }
            }
            Event::End { record, drawn } => {
                self.bar.finish_and_clear();
                if self.warnings > MAX_WARNINGS {
                    print_stderr(&format!(
                        "warning: {}, and {} more, see cells.csv\n",
                        record.id,
                        self.warnings - MAX_WARNINGS
                    ));
                }
                self.warnings = 0;
                lines.push_str(&summary(record, drawn));
            }
            Event::Book { record, is_drawn } => {
                self.bar.finish_and_clear();
                let names: Vec<&str> = record.files.iter().map(|file| file.name.as_str()).collect();
                let named = match &names[..] {
                    [first, .., last] => format!("{first} to {last}"),
                    _ => names.concat(),
                };
                let unchanged = if is_drawn { "" } else { " (unchanged)" };
                lines.push_str(&format!("{named}: {}{unchanged}\n", pluralize(record.pages, "page")));
            }
            Event::UnusableRecord { record, error } => {
                let record = record.display();
                print_stderr(&format!(
                    "warning: {record} is no help: {error}; everything is drawn, and nothing removed\n"
                ));
            }
        }
    }
}

fn summary(record: &FamilyRecord, drawn: Option<usize>) -> String {
    let mut line = format!("{}: {}", record.id, pluralize(record.cells, "cell"));
    if record.kept < record.cells {
        line.push_str(&format!(" ({} left out by `where`)", record.cells - record.kept));
    }
    if record.not_assembled > 0 {
        line.push_str(&format!(" ({} not assembled)", record.not_assembled));
    }
    line.push_str(&format!(", {}", pluralize(record.curves, "curve")));
    if record.curves_left_out > 0 {
        line.push_str(&format!(" ({} more left out by `where`)", record.curves_left_out));
    }
    line.push_str(&format!(", {}", pluralize(record.pages, "page")));
    match drawn {
        None => line.push_str(" (unchanged)"),
        // Pages that are bound only are not drawn one by one.
        Some(drawn) if drawn < record.pages && record.files.len() > record.pages => {
            line.push_str(&format!(" ({drawn} of {} drawn)", pluralize(record.pages, "page")));
        }
        Some(_) => {}
    }
    line.push('\n');
    line
}

//! `render`: solves and draws the families of a manifest.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use clap::{Args, ValueHint};
use coupler_atlas::gallery::PAGE_FILE;
use coupler_atlas::output::{self, Event};
use coupler_atlas::record::{Digest, FamilyRecord, IMAGES_FILE_NAME, RUN_FILE_NAME, RunRecord, file_digest};
use coupler_drawing::render::Format;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::source::{self, DEFAULT_MANIFEST};
use super::{EXIT_INTERRUPTED, Outcome, choice, files, pluralize, print, print_stderr, printable};

/// Solve every family of a manifest, and write its pages and point sets.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The manifest; - for standard input, which needs --output.
    #[arg(default_value = DEFAULT_MANIFEST, value_hint = ValueHint::FilePath)]
    manifest: PathBuf,
    /// The folder to write to [default: `output` of the manifest, relative to it, or else its path without the
    /// extension].
    #[arg(short, long, value_name = "DIR", value_hint = ValueHint::DirPath, value_parser = files::folder_parser())]
    output: Option<PathBuf>,
    /// The formats of pages, instead of the manifest's: svg, png, pdf (one book); pages that an earlier run wrote in
    /// other formats are kept.
    #[arg(long, value_name = "FORMATS", value_delimiter = ',', value_parser = parse_format)]
    format: Option<Vec<Format>>,
    /// Render only this family, and leave the files of others unchanged; may be given more than once.
    #[arg(long, value_name = "FAMILY")]
    only: Vec<String>,
    /// Draw every page, including those that are up to date.
    #[arg(long)]
    force: bool,
    /// Replace the atlas of another manifest, and files that no earlier run wrote.
    #[arg(long)]
    overwrite: bool,
    /// The number of threads [default: one for each processor].
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Exit with 1 if a cell that `where` does not leave out cannot be assembled over the whole requested range.
    #[arg(long)]
    strict: bool,
    /// Print only warnings and errors.
    #[arg(short, long)]
    quiet: bool,
}

fn parse_format(name: &str) -> Result<Format, String> {
    let format = choice::parse("format", name, &Format::ALL.map(|format| (format.name(), format)))?;
    match format.is_built_in() {
        true => Ok(format),
        false => {
            let name = format.name();
            Err(format!("this build cannot write `{name}`: build the program with the feature `pdf`"))
        }
    }
}

/// The number of cells of a family that are reported one by one as not assembled.
const MAX_WARNINGS: usize = 10;

pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    let source = source::read(&arguments.manifest)?;
    source.require_families(&arguments.only)?;
    if arguments.format.iter().flatten().any(|format| *format != Format::Svg) {
        source.require_drawable()?;
    }
    if let Some(jobs) = arguments.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    let output = source.output_folder(arguments.output.as_deref())?;
    let options = output::Options {
        formats: arguments.format.clone(),
        only: arguments.only.clone(),
        force: arguments.force,
        overwrite: arguments.overwrite,
        manifest: Some(source.file_name()),
        interrupt: interrupt_flag()?,
    };
    let mut reporter = ProgressReporter::new(arguments.quiet);
    let mut lines = String::new();
    let before = file_digests(&output);
    let run =
        output::write_atlas(&source.plan, &output, &options, &mut |event| reporter.handle_event(event, &mut lines))?;
    source.report_problems(&output::empty_family_warnings(&source.plan, Some(&run)));
    if !arguments.quiet {
        let is_changed = reporter.has_drawn || file_digests(&output) != before;
        lines.push_str(&closing_line(&output, &run, is_changed));
        print(&lines)?;
    }
    Ok(if arguments.strict && reporter.not_assembled > 0 { Outcome::Difference } else { Outcome::Done })
}

/// The digests of the files that describe an atlas as a whole, each `None` if it cannot be read. They change with any
/// file that a run writes, unless it restores one, of which it reports that something was drawn.
fn file_digests(output: &Path) -> [Option<Digest>; 3] {
    [RUN_FILE_NAME, IMAGES_FILE_NAME, PAGE_FILE].map(|name| file_digest(&output.join(name)).ok())
}

/// "written to output; open output/index.html or output/book.pdf".
fn closing_line(output: &Path, run: &RunRecord, is_changed: bool) -> String {
    let what = if is_changed { "written to" } else { "nothing has changed in" };
    let book = run.book.iter().filter_map(|book| book.files.first());
    let paths = run.gallery.iter().chain(book).map(|file| output.join(&file.name)).filter(|path| path.is_file());
    let open = match paths.map(|path| printable(path.display())).collect::<Vec<_>>().join(" or ") {
        none if none.is_empty() => String::new(),
        names => format!("; open {names}"),
    };
    format!("{what} {}{open}\n", printable(output.display()))
}

/// How long a run may take to end after Ctrl-C before the process ends.
const GRACE_PERIOD: Duration = Duration::from_millis(700);

/// A flag that the first Ctrl-C sets; the second ends the program at once.
fn interrupt_flag() -> anyhow::Result<Arc<AtomicBool>> {
    let interrupt = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupt);
    ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(EXIT_INTERRUPTED.into());
        }
        // A cell of very many samples, or a large page, may not look at the flag soon enough. Whatever the threads are
        // doing, files are complete and in the journal.
        std::thread::spawn(|| {
            std::thread::sleep(GRACE_PERIOD);
            print_stderr(&format!("error: {}\n", output::Error::Interrupted));
            std::process::exit(EXIT_INTERRUPTED.into());
        });
    })?;
    Ok(interrupt)
}

/// Reports the progress of a run: a bar on a terminal, and a line for each family at the end.
struct ProgressReporter {
    is_quiet: bool,
    bar: ProgressBar,
    /// The cells of the current family that are not assembled.
    warnings: usize,
    /// The cells of all families that are not assembled.
    not_assembled: usize,
    /// Whether anything of a family or of the book was drawn.
    has_drawn: bool,
}

impl ProgressReporter {
    fn new(is_quiet: bool) -> ProgressReporter {
        ProgressReporter { is_quiet, bar: ProgressBar::hidden(), warnings: 0, not_assembled: 0, has_drawn: false }
    }

    fn handle_event(&mut self, event: Event, lines: &mut String) {
        match event {
            Event::Begin { family, pages } if !self.is_quiet => {
                let style = ProgressStyle::with_template("{msg:20} {bar:40} {pos}/{len} pages");
                self.bar = ProgressBar::with_draw_target(Some(pages as u64), ProgressDrawTarget::stderr());
                self.bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
                self.bar.set_message(printable(family));
            }
            Event::Begin { .. } => {}
            Event::Page => self.bar.inc(1),
            Event::Shortfall { family, cell, reason } => {
                self.not_assembled += 1;
                self.warnings += 1;
                if self.warnings <= MAX_WARNINGS {
                    self.bar
                        .suspend(|| print_stderr(&format!("warning: {family}, cell {cell}: {}\n", printable(reason))));
                }
            }
            Event::End { record, drawn } => {
                self.bar.finish_and_clear();
                if self.warnings > MAX_WARNINGS {
                    print_stderr(&format!(
                        "warning: {}: {} more cells are not assembled; see cells.csv\n",
                        record.id,
                        self.warnings - MAX_WARNINGS
                    ));
                }
                self.warnings = 0;
                self.has_drawn |= drawn.is_some();
                lines.push_str(&summary(record, drawn));
            }
            Event::Book { record, is_drawn } => {
                self.bar.finish_and_clear();
                self.has_drawn |= is_drawn;
                let names: Vec<&str> = record.files.iter().map(|file| file.name.as_str()).collect();
                let files = match &names[..] {
                    [first, .., last] => format!("{first} to {last}"),
                    _ => names.concat(),
                };
                let unchanged = if is_drawn { "" } else { " (unchanged)" };
                lines.push_str(&format!("{files}: {}{unchanged}\n", pluralize(record.pages, "page")));
            }
            Event::UnusableRecord { record, error } => {
                let (record, error) = (printable(record.display()), printable(error));
                print_stderr(&format!(
                    "warning: {record} is replaced: {error}; every page is drawn, and no file is removed\n"
                ));
            }
        }
    }
}

/// "evans: 3 cells (1 not assembled), 2 curves, 1 page"; `drawn` is `None` if the family is unchanged.
fn summary(record: &FamilyRecord, drawn: Option<usize>) -> String {
    let mut line = format!("{}: {}", record.id, pluralize(record.cells, "cell"));
    let counts = [
        (record.not_assembled - record.partly_assembled + record.unassembled_left_out, "not assembled"),
        (record.partly_assembled, "assembled over a part of the range"),
        (record.cells - record.kept - record.unassembled_left_out, "left out by `where`"),
    ];
    let counts = counts.into_iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}"));
    let counts: Vec<String> = counts.collect();
    if !counts.is_empty() {
        line.push_str(&format!(" ({})", counts.join(", ")));
    }
    line.push_str(&format!(", {}", pluralize(record.curves, "curve")));
    if record.curves_left_out > 0 {
        line.push_str(&format!(" ({} more left out by `where`)", record.curves_left_out));
    }
    line.push_str(&format!(", {}", pluralize(record.pages, "page")));
    match drawn {
        None => line.push_str(" (unchanged)"),
        // Pages that are only in the book have no files.
        Some(drawn) if drawn < record.pages && record.files.len() > record.pages => {
            line.push_str(&format!(" ({drawn} of {} drawn)", pluralize(record.pages, "page")));
        }
        Some(_) => {}
    }
    line.push('\n');
    line
}

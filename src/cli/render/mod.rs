//! `render`: solves and draws the families of a manifest.

mod live_page;
mod progress;
mod watch;

use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crate::gallery::{KERNEL_FILE, PAGE_FILE};
use crate::manifest::PlannedFamily;
use crate::output::{self, DrawnPages, PageShardSource};
use crate::record::{Digest, IMAGES_FILE_NAME, RUN_FILE_NAME, RunRecord, file_digest};
use crate::sweep::Division;
use clap::{Args, ValueHint};
use coupler_drawing::render::Format;
use progress::ProgressReporter;

use super::source::{self, DEFAULT_MANIFEST, ManifestSource};
use super::{EXIT_INTERRUPTED, Outcome, choice, files, pluralize, print, print_stderr, printable, sweep};

/// Solve every family of a manifest, and write its pages and point sets.
#[derive(Clone, Debug, Args)]
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
    /// Draw only the I-th of N equal parts of the pages of each family, I from 0 to N - 1, as in --shard 3/64; gather completes
    /// the atlas when all are drawn.
    #[arg(long, value_name = "I/N", value_parser = sweep::parse_shard, conflicts_with_all = ["only", "strict", "open", "watch"])]
    shard: Option<Division>,
    /// Exit with 1 if a cell that `where` does not leave out cannot be assembled over the whole requested range.
    #[arg(long)]
    strict: bool,
    /// Print only warnings and errors.
    #[arg(short, long)]
    quiet: bool,
    /// Open the gallery, or else the book, in the program that the system has for it; with --watch, a page that shows the
    /// pages and the problems of the manifest as they change.
    #[arg(long)]
    open: bool,
    /// Render again whenever the manifest changes, until Ctrl-C.
    #[arg(long, conflicts_with = "strict")]
    watch: bool,
}

pub(super) fn parse_format(name: &str) -> Result<Format, String> {
    let format = choice::parse("format", name, &Format::ALL.map(|format| (format.name(), format)))?;
    match format.is_built_in() {
        true => Ok(format),
        false => {
            let name = format.name();
            Err(format!("this build cannot write `{name}`: build the program with the feature `pdf`"))
        }
    }
}

pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    if let Some(jobs) = arguments.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    let interrupt = interrupt_flag(output::Error::Interrupted)?;
    if arguments.watch {
        return watch::run(arguments, &interrupt);
    }
    if let Some(division) = arguments.shard {
        return draw_shard(arguments, division, &interrupt);
    }
    let rendered = render(arguments, &interrupt)?;
    if arguments.open {
        match openable_paths(&rendered).next() {
            Some(path) => open(&path),
            None => print_stderr("warning: there is no gallery and no book to open\n"),
        }
    }
    Ok(if arguments.strict && rendered.not_assembled > 0 { Outcome::Difference } else { Outcome::Done })
}

/// Draws a part of the pages.
fn draw_shard(arguments: &Arguments, division: Division, interrupt: &Arc<AtomicBool>) -> anyhow::Result<Outcome> {
    let source = source::read(&arguments.manifest)?;
    if arguments.format.iter().flatten().any(|format| *format != Format::Svg) {
        source.require_drawable()?;
    }
    let output = source.output_folder(arguments.output.as_deref())?;
    let options = output_options(arguments, &source, interrupt);
    let mut reporter = ProgressReporter::new(arguments.quiet, true);
    let formats = |planned: &PlannedFamily| options.formats.as_ref().unwrap_or(&planned.formats).clone();
    if source.plan.families.iter().flat_map(formats).all(|format| format.page_format().is_none()) {
        print_stderr("note: there are no pages to divide: a book is drawn by gather, or by render without --shard\n");
    }
    let manifest = PageShardSource { plan: &source.plan, text: &source.text, folder: source.folder() };
    let DrawnPages { pages, drawn, is_atlas_complete } =
        output::write_page_shard(manifest, &output, &options, division, &mut |event| {
            reporter.handle_event(event, &mut String::new());
        })?;
    reporter.finish();
    if !arguments.quiet {
        let folder = printable(output.display());
        let next = match is_atlas_complete {
            true => format!("in {folder}, where the atlas is complete already"),
            false => format!("in {folder}; when all shards are, complete it: coupler-atlas gather {folder}"),
        };
        print(&format!("{}, {drawn} of them drawn, {next}\n", pluralize(pages, "page")))?;
    }
    Ok(Outcome::Done)
}

/// Completes an atlas whose pages shards have drawn: `manifest` is that of the shards with its path, and `formats` theirs.
/// Prints what `render` prints, to standard error.
pub(super) fn complete(
    source: &ManifestSource,
    output: &Path,
    formats: Option<Vec<Format>>,
    is_quiet: bool,
) -> anyhow::Result<()> {
    let options = output::Options { formats, manifest: Some(source.file_name()), ..output::Options::default() };
    let mut reporter = ProgressReporter::new(is_quiet, true);
    let mut lines = String::new();
    let run =
        output::write_atlas(&source.plan, output, &options, &mut |event| reporter.handle_event(event, &mut lines))?;
    source.report_problems(&output::empty_family_warnings(&source.plan, Some(&run)));
    if !is_quiet {
        let rendered = Rendered { output: output.to_owned(), run, not_assembled: reporter.not_assembled };
        print_stderr(&format!("{lines}{}", closing_line(&rendered, true)));
    }
    Ok(())
}

fn output_options(arguments: &Arguments, source: &ManifestSource, interrupt: &Arc<AtomicBool>) -> output::Options {
    output::Options {
        formats: arguments.format.clone(),
        only: arguments.only.clone(),
        force: arguments.force,
        overwrite: arguments.overwrite,
        manifest: Some(source.file_name()),
        interrupt: Arc::clone(interrupt),
    }
}

/// An atlas that has been rendered.
struct Rendered {
    /// Its folder.
    output: PathBuf,
    run: RunRecord,
    /// The cells that could not be assembled.
    not_assembled: usize,
}

/// Reads the manifest, and renders it once.
fn render(arguments: &Arguments, interrupt: &Arc<AtomicBool>) -> anyhow::Result<Rendered> {
    let source = source::read(&arguments.manifest)?;
    source.require_families(&arguments.only)?;
    if arguments.format.iter().flatten().any(|format| *format != Format::Svg) {
        source.require_drawable()?;
    }
    let output = source.output_folder(arguments.output.as_deref())?;
    let options = output_options(arguments, &source, interrupt);
    let mut reporter = ProgressReporter::new(arguments.quiet, !arguments.watch);
    let mut lines = String::new();
    let before = file_digests(&output);
    let run =
        output::write_atlas(&source.plan, &output, &options, &mut |event| reporter.handle_event(event, &mut lines))?;
    source.report_problems(&output::empty_family_warnings(&source.plan, Some(&run)));
    let rendered = Rendered { output, run, not_assembled: reporter.not_assembled };
    if !arguments.quiet {
        let is_changed = reporter.has_drawn || file_digests(&rendered.output) != before;
        lines.push_str(&closing_line(&rendered, is_changed));
        print(&lines)?;
    }
    Ok(rendered)
}

/// The digests of the files that describe an atlas as a whole, each `None` if it cannot be read. They change with any
/// file that a run writes, unless it restores one, of which it reports that something was drawn.
fn file_digests(output: &Path) -> [Option<Digest>; 4] {
    [RUN_FILE_NAME, IMAGES_FILE_NAME, PAGE_FILE, KERNEL_FILE].map(|name| file_digest(&output.join(name)).ok())
}

/// The files that show the whole atlas: the gallery and the book, if there are.
fn openable_paths(Rendered { output, run, .. }: &Rendered) -> impl Iterator<Item = PathBuf> {
    let book = run.book.iter().filter_map(|book| book.files.first());
    run.gallery.iter().chain(book).map(|file| output.join(&file.name)).filter(|path| path.is_file())
}

/// "written to output; open output/index.html or output/book.pdf".
fn closing_line(rendered: &Rendered, is_changed: bool) -> String {
    let what = if is_changed { "written to" } else { "nothing has changed in" };
    let names: Vec<String> =
        openable_paths(rendered).map(|path| printable(files::without_parents(&path).display())).collect();
    let open = if names.is_empty() { String::new() } else { format!("; open {}", names.join(" or ")) };
    format!("{what} {}{open}\n", printable(files::without_parents(&rendered.output).display()))
}

/// Opens a file in the program that the system has for it. A failure is no error: the files are written.
fn open(path: &Path) {
    if let Err(error) = open::that_detached(path) {
        let message = format!("warning: cannot open {}: {}\n", printable(path.display()), printable(error));
        print_stderr(&message);
    }
}

/// How long a run may take to end after Ctrl-C before the process ends.
const GRACE_PERIOD: Duration = Duration::from_millis(700);

/// A flag that the first Ctrl-C sets; the second ends the program at once, and so does a run that does not look at it, with this
/// error.
pub(super) fn interrupt_flag(message: impl Display) -> anyhow::Result<Arc<AtomicBool>> {
    let message = message.to_string();
    let interrupt = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupt);
    ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(EXIT_INTERRUPTED.into());
        }
        // A cell of very many samples, or a large page, may not look at the flag soon enough. Whatever the threads are
        // doing, files are complete and in the journal.
        let message = message.clone();
        std::thread::spawn(move || {
            std::thread::sleep(GRACE_PERIOD);
            print_stderr(&format!("error: {message}\n"));
            std::process::exit(EXIT_INTERRUPTED.into());
        });
    })?;
    Ok(interrupt)
}

//! `render`: solves and draws the families of a manifest.

mod arguments;
mod live_page;
mod progress;
mod rendering;
mod watch;

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::manifest::PlannedFamily;
use crate::output::{self, DrawnPages, PageShardSource};
use crate::sweep::Division;
pub use arguments::Arguments;
pub(super) use arguments::parse_format;
use coupler_drawing::render::Format;
use progress::ProgressReporter;
use rendering::{Rendered, closing_line, open, openable_paths, output_options, render};

use super::source::{self, ManifestSource};
use super::{Failure, Outcome, interrupt, print, print_stderr, printable};
use coupler_curves::text::pluralize;

pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if let Some(jobs) = arguments.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global()?;
    }
    let interrupt = interrupt::interrupt_flag(output::Error::Interrupted)?;
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
fn draw_shard(arguments: &Arguments, division: Division, interrupt: &Arc<AtomicBool>) -> Result<Outcome, Failure> {
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
        })
        .map_err(|error| source.failure(error))?;
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
) -> Result<(), Failure> {
    let options = output::Options { formats, manifest: Some(source.file_name()), ..output::Options::default() };
    let mut reporter = ProgressReporter::new(is_quiet, true);
    let mut lines = String::new();
    let run =
        output::write_atlas(&source.plan, output, &options, &mut |event| reporter.handle_event(event, &mut lines))
            .map_err(|error| source.failure(error))?;
    source.report_problems(&output::empty_family_warnings(&source.plan, Some(&run)));
    if !is_quiet {
        let rendered = Rendered { output: output.to_owned(), run, not_assembled: reporter.not_assembled };
        print_stderr(&format!("{lines}{}", closing_line(&rendered, true)));
    }
    Ok(())
}

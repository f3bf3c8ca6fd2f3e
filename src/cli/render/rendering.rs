//! A run that renders a manifest.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::gallery::{KERNEL_FILE, PAGE_FILE};
use crate::output;
use crate::record::{Digest, IMAGES_FILE_NAME, RUN_FILE_NAME, RunRecord, file_digest};
use coupler_drawing::render::Format;

use super::super::source::{self, ManifestSource};
use super::super::{Failure, files, print, print_stderr, printable};
use super::arguments::Arguments;
use super::progress::ProgressReporter;

pub(super) fn output_options(
    arguments: &Arguments,
    source: &ManifestSource,
    interrupt: &Arc<AtomicBool>,
) -> output::Options {
    output::Options {
        formats: arguments.format.clone(),
        only: arguments.only.clone(),
        force: arguments.force,
        overwrite: arguments.overwrite,
        repair: arguments.repair,
        manifest: Some(source.file_name()),
        interrupt: Arc::clone(interrupt),
    }
}

/// An atlas that has been rendered.
pub(super) struct Rendered {
    /// Its folder.
    pub(super) output: PathBuf,
    pub(super) run: RunRecord,
    /// The cells that could not be assembled.
    pub(super) not_assembled: usize,
}

/// Reads the manifest, and renders it once.
pub(super) fn render(arguments: &Arguments, interrupt: &Arc<AtomicBool>) -> Result<Rendered, Failure> {
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
        output::write_atlas(&source.plan, &output, &options, &mut |event| reporter.handle_event(event, &mut lines))
            .map_err(|error| source.failure(error))?;
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
pub(super) fn openable_paths(Rendered { output, run, .. }: &Rendered) -> impl Iterator<Item = PathBuf> {
    let book = run.book.iter().filter_map(|book| book.files.first());
    run.gallery.iter().chain(book).map(|file| output.join(&file.name)).filter(|path| path.is_file())
}

/// "written to output; open output/index.html or output/book.pdf".
pub(super) fn closing_line(rendered: &Rendered, is_changed: bool) -> String {
    let what = if is_changed { "written to" } else { "nothing has changed in" };
    let names: Vec<String> =
        openable_paths(rendered).map(|path| printable(files::without_parents(&path).display())).collect();
    let open = if names.is_empty() { String::new() } else { format!("; open {}", names.join(" or ")) };
    format!("{what} {}{open}\n", printable(files::without_parents(&rendered.output).display()))
}

/// Opens a file in the program that the system has for it. A failure is no error: the files are written.
pub(super) fn open(path: &Path) {
    if let Err(error) = open::that_detached(path) {
        let message = format!("warning: cannot open {}: {}\n", printable(path.display()), printable(error));
        print_stderr(&message);
    }
}

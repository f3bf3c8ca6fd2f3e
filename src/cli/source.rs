//! Reads a manifest, and prints the problems in it.

use std::cell::RefCell;
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::manifest::{self, FileReader, ParseOutcome, Plan};
use crate::manifest_files::ManifestFiles;
use crate::output;
use crate::record::RunRecord;
use coupler_curves::family::Family;
use coupler_curves::problem::{self, Problem, suggestion};
use indicatif::ProgressBar;

use super::{Failure, color, files, not_a_manifest, print_stderr, print_styled, progress_bar};
use coupler_curves::text::pluralize;

/// A manifest with its path and text, for messages.
pub struct ManifestSource {
    pub path: PathBuf,
    pub text: String,
    pub plan: Plan,
}

/// Reads the text of a manifest.
///
/// # Errors
/// The file cannot be read.
pub fn read_text(path: &Path) -> Result<String, Failure> {
    files::protect(path, "the manifest");
    let text = output::read_text(path).map_err(|error| match error {
        output::Error::Read { source, .. } if files::is_standard(path) => files::standard_input_error(&source),
        output::Error::Read { source, .. } => match not_a_manifest::reason(path, source.kind()) {
            Some(reason) => Failure::input(reason),
            None => output::Error::Read { path: path.to_owned(), source }.into(),
        },
        error => Failure::from(error),
    })?;
    match not_a_manifest::form(path, &text) {
        Some(form) => Err(Failure::input(form)),
        None => Ok(text),
    }
}

/// Parses the text of a manifest, and reads the files that it names.
///
/// # Errors
/// The system failed to read one of them, so that nothing is known about it.
pub fn parse(path: &Path, text: &str) -> Result<ParseOutcome, output::Error> {
    with_files(path, |files| manifest::parse_with_files(text, files))
}

/// Reads the files that a manifest names while it is parsed. That one is missing or wrong is a problem of the manifest.
fn with_files(path: &Path, parse: impl FnOnce(FileReader) -> ParseOutcome) -> Result<ParseOutcome, output::Error> {
    let named = ManifestFiles::new(path).with_progress(search_bar());
    let outcome = parse(Some(&named));
    files::set_named(named.take_named());
    named.take_failure().map_or(Ok(outcome), Err)
}

/// Shows of a search which part of it is done.
fn search_bar() -> impl Fn(&str, f64) {
    let shown: RefCell<Option<ProgressBar>> = RefCell::default();
    move |name, part| {
        let mut shown = shown.borrow_mut();
        shown.get_or_insert_with(|| progress_bar::of_parts(name)).set_position((1000.0 * part) as u64);
        if part >= 1.0 {
            shown.take().iter().for_each(ProgressBar::finish_and_clear);
        }
    }
}

/// Reads a manifest, and prints every problem in it to standard error.
///
/// # Errors
/// The file cannot be read, or the manifest has errors.
pub fn read(path: &Path) -> Result<ManifestSource, Failure> {
    read_with(path, |text| parse(path, text))
}

/// Reads a manifest for tables of some of its cells, see [`manifest::parse_for_tables`], and prints every problem in it to
/// standard error.
///
/// # Errors
/// The file cannot be read, or the manifest has errors.
pub fn read_for_tables(path: &Path, cells: &dyn Fn(&Family) -> Range<usize>) -> Result<ManifestSource, Failure> {
    read_with(path, |text| with_files(path, |files| manifest::parse_for_tables(text, files, cells)))
}

fn read_with(
    path: &Path,
    parse: impl FnOnce(&str) -> Result<ParseOutcome, output::Error>,
) -> Result<ManifestSource, Failure> {
    parse_text(path, read_text(path)?, parse)
}

fn parse_text(
    path: &Path,
    text: String,
    parse: impl FnOnce(&str) -> Result<ParseOutcome, output::Error>,
) -> Result<ManifestSource, Failure> {
    let loaded = parse(&text)?;
    report_problems(path, &text, &loaded.problems);
    match loaded.plan {
        Some(plan) => Ok(ManifestSource { path: path.to_owned(), text, plan }),
        None => {
            let errors = loaded.problems.iter().filter(|p| p.is_error()).count();
            Err(problems_error(path, errors))
        }
    }
}

/// A manifest with a text that has been read before, of which every problem is printed to standard error.
///
/// # Errors
/// The manifest has errors.
pub fn with_text(path: &Path, text: String) -> Result<ManifestSource, Failure> {
    parse_text(path, text, |text| parse(path, text))
}

/// The error of a manifest with problems.
pub fn problems_error(path: &Path, errors: usize) -> Failure {
    Failure::input(format!("{}: {}", files::input_name(path), pluralize(errors, "problem")))
}

impl ManifestSource {
    /// Prints further problems in the manifest to standard error.
    pub fn report_problems(&self, problems: &[Problem]) {
        report_problems(&self.path, &self.text, problems);
    }

    /// The failure of an error of writing its atlas; what is wrong with the manifest is printed to standard error.
    pub fn failure(&self, error: output::Error) -> Failure {
        match error {
            output::Error::Misfits(problems) => {
                self.report_problems(&problems);
                problems_error(&self.path, problems.len())
            }
            error => error.into(),
        }
    }

    /// Checks that all texts can be drawn, in a format that needs fonts, and prints those that cannot to standard error.
    ///
    /// # Errors
    /// The number of texts.
    pub fn require_drawable(&self) -> Result<(), Failure> {
        let undrawable = &self.plan.undrawable;
        self.report_problems(undrawable);
        if undrawable.is_empty() { Ok(()) } else { Err(problems_error(&self.path, undrawable.len())) }
    }

    /// Checks that each id is that of a family.
    ///
    /// # Errors
    /// The first id of which the manifest has no family.
    pub fn require_families(&self, only: &[String]) -> Result<(), Failure> {
        let ids: Vec<&str> = self.plan.families.iter().map(|planned| planned.family.id.as_str()).collect();
        match only.iter().find(|id| !ids.contains(&id.as_str())) {
            Some(id) => Err(Failure::input(format!("there is no family `{id}`: {}", suggestion(id, &ids)))),
            None => Ok(()),
        }
    }

    /// The output folder: the one given on the command line; or that of the manifest, relative to it; or the manifest's
    /// path without its extension.
    ///
    /// # Errors
    /// None is given, and the manifest has no folder or no extension.
    pub fn output_folder(&self, given: Option<&Path>) -> Result<PathBuf, Failure> {
        if let Some(folder) = given {
            return Ok(folder.to_owned());
        }
        if files::is_standard(&self.path) {
            return Err(Failure::input(
                "a manifest from standard input has no folder: name one to write to with -o".to_owned(),
            ));
        }
        output::default_folder(&self.plan, &self.path)
            .ok_or_else(|| Failure::input(output::no_folder_message(&self.path)))
    }

    /// The folder of the manifest, in which the files are that it names.
    pub fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }

    /// The name of the manifest in the record of a run: its file name, without the folder.
    pub fn file_name(&self) -> String {
        match self.path.file_name() {
            Some(name) => name.to_string_lossy().into_owned(),
            None => RunRecord::STANDARD_INPUT.to_owned(),
        }
    }
}

/// Prints problems in a text to standard error.
pub fn report_problems(path: &Path, text: &str, problems: &[Problem]) {
    let styled = color::is_stderr_styled();
    let report = problem::report(problems, &files::input_name(path), text, styled);
    // A styled report has the escape sequences of its colours, and no other control characters.
    if styled { print_styled(&report) } else { print_stderr(&report) }
}

//! `render --watch`: renders a manifest again whenever it or a file that it names changes.

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::sleep;
use std::time::Duration;

use crate::manifest_files::NamedFile;

use super::super::{Failure, Outcome, files, print_stderr, printable};
use super::arguments::Arguments;
use super::live_page::LivePage;
use super::rendering::{open, render};

/// How often the manifest is looked at.
const INTERVAL: Duration = Duration::from_millis(30);

/// Renders the manifest, and again whenever it or a file that it names changes, until it is interrupted.
///
/// # Errors
/// The manifest is not a file, or a run is interrupted. Other errors are printed, and the next change is waited for.
pub(super) fn run(arguments: &Arguments, interrupt: &Arc<AtomicBool>) -> Result<Outcome, Failure> {
    let path = &arguments.manifest;
    if files::is_standard(path) {
        return Err(Failure::input("--watch needs a manifest in a file: standard input does not change"));
    }
    let mut live_page = arguments.open.then(LivePage::new).transpose()?;
    if let Some(page) = &live_page {
        open(page.path());
    }
    // Everything is drawn at most once.
    let mut arguments = arguments.clone();
    loop {
        // What changes from here on is rendered next.
        let contents = Contents::of(path);
        let result = render(&arguments, interrupt);
        let named = files::take_named();
        arguments.force = false;
        if let Some(page) = &mut live_page {
            match &result {
                Ok(rendered) => page.show(rendered)?,
                Err(error) => page.show_problem(&problem_text(path, error))?,
            }
        }
        match result {
            Err(error) if error.is_interrupted() => return Err(error),
            Err(error) => {
                error.report();
            }
            Ok(_) => {}
        }
        let names: Vec<String> = std::iter::once(path)
            .chain(named.iter().map(|file| &file.path))
            .map(|path| printable(path.display()))
            .collect();
        print_stderr(&format!("waiting for changes of {}; Ctrl-C ends\n", names.join(", ")));
        while contents.are_current(path) && named.iter().all(is_current) {
            if interrupt.load(Ordering::Relaxed) {
                return Ok(Outcome::Done);
            }
            sleep(INTERVAL);
        }
    }
}

/// What is in a file; `None` if it cannot be read.
#[derive(PartialEq, Eq)]
struct Contents(Option<Vec<u8>>);

impl Contents {
    fn of(path: &Path) -> Contents {
        Contents(fs::read(path).ok())
    }

    /// Whether the file still has these contents. An editor may write a file in several parts, or remove it before it writes
    /// the new one: others count when they are there and have not changed for an interval.
    fn are_current(&self, path: &Path) -> bool {
        let next = Contents::of(path);
        if next == *self || next.0.is_none() {
            return true;
        }
        sleep(INTERVAL);
        Contents::of(path) != next
    }
}

/// Whether a file that a manifest names is as it was; others count as those of a manifest do, see [`Contents::are_current`].
fn is_current(file: &NamedFile) -> bool {
    let next = file.now();
    if next == *file || !next.exists() {
        return true;
    }
    sleep(INTERVAL);
    file.now() != next
}

/// The problems of a manifest, or else the error, as text.
fn problem_text(path: &Path, error: &Failure) -> String {
    let Ok(text) = super::source::read_text(path) else { return error.to_string() };
    let problems = super::source::parse(path, &text).map(|loaded| loaded.problems).unwrap_or_default();
    if problems.is_empty() {
        return error.to_string();
    }
    coupler_curves::problem::report(&problems, &files::input_name(path), &text, false)
}

//! Runs a [`Plan`]: names the files, and writes each whole or not at all; what is there already it leaves alone.

mod book;
mod error;
mod family;
mod files;
mod inputs;
mod journal;
mod lock;
mod pages;
mod previous_run;
mod registry;

pub use error::Error;
pub use files::{create_folder, read_manifest, write as write_file, write_new};

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::manifest::{Plan, PlannedFamily};
use crate::record::{BookRecord, FamilyRecord, ReadError, RunRecord};
use crate::sweep;
use coupler_curves::problem::Problem;
use coupler_drawing::render::Format;
use journal::Journal;
use lock::Lock;

/// What is to be built of a plan.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The formats of all families, in place of their own.
    pub formats: Option<Vec<Format>>,
    /// The families to build; all where empty. Those left out keep their files and their record.
    pub only: Vec<String>,
    /// Whether to draw also what is there already as it would be drawn.
    pub force: bool,
    /// Whoever makes this true ends the run as soon as the pages are whole that are being drawn.
    pub interrupt: Arc<AtomicBool>,
}

/// Something that happened while building.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// A family of so many cells on so many pages is begun.
    Begin {
        /// Its id.
        family: &'a str,
        /// Its pages.
        pages: usize,
    },
    /// A page is done.
    Page,
    /// A family is done.
    End {
        /// What there is of it.
        record: &'a FamilyRecord,
        /// How many of its pages were drawn; none where nothing of it was even solved, for nothing has changed.
        drawn: Option<usize>,
    },
    /// The book is done.
    Book {
        /// What there is of it.
        record: &'a BookRecord,
        /// Whether it was made, for something in it has changed.
        is_drawn: bool,
    },
    /// A cell was not assembled, or not over the whole range asked for.
    Shortfall {
        /// The family's id.
        family: &'a str,
        /// The cell's number.
        cell: usize,
        /// Why.
        reason: &'a str,
    },
    /// The record of an earlier run cannot be used: everything is drawn, and nothing removed.
    UnusableRecord {
        /// The record.
        record: &'a Path,
        /// Why.
        error: &'a ReadError,
    },
}

/// Builds a plan into a folder, and tells what happens on the way.
///
/// What an earlier run left there stays as it is where it would come out the same: its record says what it was made
/// from. What that run wrote and no longer belongs is removed; what it did not write never is.
///
/// Every file is written under another name and renamed, `run.json` last: whatever goes wrong, each file in the
/// folder is whole, old or new, and the record says no more than what is so.
///
/// # Errors
/// A file that cannot be written; a record of an earlier run that is needed and cannot be read, or of another format;
/// another run into the same folder; an interruption. What is finished is then recorded, and the next run goes on from there.
pub fn write_atlas(
    plan: &Plan,
    output: &Path,
    options: &Options,
    tell: &mut dyn FnMut(Event),
) -> Result<RunRecord, Error> {
    files::create_folder(output)?;
    let _lock = Lock::acquire(output)?;
    let is_asked = |planned: &&PlannedFamily| options.only.is_empty() || options.only.contains(&planned.family.id);
    // Nothing is touched in a folder of another format.
    let earlier = previous_run::read(output, !options.only.is_empty(), tell)?;
    files::remove_temporary_files(output);
    let mut journal = Journal::open(plan, output, earlier);
    for planned in plan.families.iter().filter(is_asked) {
        check_interrupt(&options.interrupt)?;
        family::write((plan, planned), output, options, &mut journal, tell)?;
    }
    if options.only.is_empty() {
        journal.remove_unplanned_families(output)?;
    }
    book::write(plan, output, options, &mut journal, tell)?;
    journal.write_gallery(output)?;
    journal.close()
}

fn check_interrupt(interrupt: &AtomicBool) -> Result<(), Error> {
    if interrupt.load(Ordering::Relaxed) { Err(Error::Interrupted) } else { Ok(()) }
}

/// A warning for each family whose `where` keeps nothing: found by a sweep, or, of what was built, in its record.
pub fn empty_family_warnings(plan: &Plan, built: Option<&RunRecord>) -> Vec<Problem> {
    let kept = |planned: &PlannedFamily| match built {
        None => Some(sweep::kept_cells(&planned.family).len()),
        Some(run) => run.families.iter().find(|record| record.id == planned.family.id).map(|record| record.kept),
    };
    let warning = |planned: &PlannedFamily| {
        let span = planned.filter_span.clone()?;
        let message = format!("`where` keeps none of the {} cells", planned.family.cell_count());
        let problem = Problem::warning(span, message).with_help("loosen the condition, or leave it out");
        (kept(planned) == Some(0)).then_some(problem)
    };
    plan.families.iter().filter_map(warning).collect()
}

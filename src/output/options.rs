//! How an atlas is written, and what a run reports.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::error::Error;
use crate::manifest::PlannedFamily;
use crate::record::{BookRecord, FamilyRecord, ReadError};
use coupler_drawing::render::Format;

/// How an atlas is written.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The formats of all families, in place of their own.
    pub formats: Option<Vec<Format>>,
    /// The ids of the families to write; all if empty. The others keep their files and their records.
    pub only: Vec<String>,
    /// Whether to draw pages again that are up to date.
    pub force: bool,
    /// Whether to replace the atlas of another manifest, and files that no earlier run wrote.
    pub overwrite: bool,
    /// Whether to rebuild a record that is lost or damaged, from the files that are known to be those of the atlas.
    pub repair: bool,
    /// The file name of the manifest, without its folder, or [`RunRecord::STANDARD_INPUT`](crate::record::RunRecord::STANDARD_INPUT). It is recorded; only the
    /// same manifest may write to the folder again. `None` writes to the folder of any manifest.
    pub manifest: Option<String>,
    /// Set to true to end the run as soon as the pages being drawn are finished.
    pub interrupt: Arc<AtomicBool>,
}

impl Options {
    /// Whether a family is written.
    pub(super) fn includes(&self, planned: &PlannedFamily) -> bool {
        self.only.is_empty() || self.only.contains(&planned.family.id)
    }
}

/// Progress of a run.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// A family, or the book, is begun.
    Begin {
        /// Its id, or `book`.
        family: &'a str,
        /// The number of its pages.
        pages: usize,
    },
    /// A page is finished.
    Page,
    /// A family is finished.
    End {
        /// Its record.
        record: &'a FamilyRecord,
        /// The number of pages drawn; `None` if nothing has changed and none of its cells was solved.
        drawn: Option<usize>,
    },
    /// The book is finished.
    Book {
        /// Its record.
        record: &'a BookRecord,
        /// Whether it was written, because something in it has changed.
        is_drawn: bool,
    },
    /// A chapter or a list of the book that the manifest has would be empty, and is left out.
    EmptyBookPart {
        /// "chapter" or "list".
        kind: &'a str,
        /// Its title.
        title: &'a str,
    },
    /// A cell could not be assembled, or not over the whole requested range.
    Shortfall {
        /// The family's id.
        family: &'a str,
        /// The cell's number.
        cell: usize,
        /// Why.
        reason: &'a str,
    },
    /// The files of a family of an earlier run are removed, because it is not in the manifest.
    Removed {
        /// Its id.
        family: &'a str,
    },
    /// The record of the folder was lost or damaged, and is rebuilt.
    Rebuilt {
        /// The file of the record.
        record: &'a Path,
        /// The number of files that are known to be those of the atlas.
        files: usize,
        /// The files that are not, which are left as they are.
        others: &'a [PathBuf],
    },
    /// The record of an earlier run cannot be used: everything is drawn, and nothing is removed.
    UnusableRecord {
        /// The file of the record.
        record: &'a Path,
        /// Why.
        error: &'a ReadError,
    },
}

pub(super) fn check_interrupt(interrupt: &AtomicBool) -> Result<(), Error> {
    if interrupt.load(Ordering::Relaxed) { Err(Error::Interrupted) } else { Ok(()) }
}

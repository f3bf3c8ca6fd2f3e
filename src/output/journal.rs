//! The record of a run while it is in progress.

use std::fs;
use std::path::{Path, PathBuf};

use super::Error;
use super::files::{self, write};
use crate::gallery::{self, GalleryFamily};
use crate::manifest::Plan;
use crate::record::{BookRecord, FamilyRecord, FileRecord, RunRecord};

/// `run.json` during a run: at any time it claims nothing that is not true, whatever happens next.
#[derive(Debug)]
pub(super) struct Journal<'a> {
    plan: &'a Plan,
    path: PathBuf,
    /// The records of families, of this run or an earlier one.
    families: Vec<FamilyRecord>,
    /// The record of the book.
    book: Option<BookRecord>,
    /// The record of the gallery's page.
    gallery: Option<FileRecord>,
    /// The bytes of the file.
    saved_bytes: Vec<u8>,
}

impl<'a> Journal<'a> {
    /// Opens the journal of a folder with the record of an earlier run.
    pub fn open(plan: &'a Plan, output: &Path, earlier: Option<RunRecord>) -> Journal<'a> {
        let path = output.join("run.json");
        // A file that cannot be read is missing, or is going to be replaced.
        let saved_bytes = fs::read(&path).unwrap_or_default();
        let (families, book, gallery) = earlier.map(|run| (run.families, run.book, run.gallery)).unwrap_or_default();
        Journal { plan, path, families, book, gallery, saved_bytes }
    }

    /// The record of the book.
    #[cfg(feature = "pdf")]
    pub fn book(&self) -> Option<&BookRecord> {
        self.book.as_ref()
    }

    /// Replaces the record of the book, on disk too.
    #[cfg(feature = "pdf")]
    pub fn set_book(&mut self, record: Option<BookRecord>) -> Result<(), Error> {
        self.book = record;
        self.save()?;
        Ok(())
    }

    /// The record of a family.
    pub fn family(&self, id: &str) -> Option<&FamilyRecord> {
        self.families.iter().find(|record| record.id == id)
    }

    /// Replaces the record of a family, on disk too.
    pub fn set_family(&mut self, record: FamilyRecord) -> Result<(), Error> {
        match self.families.iter_mut().find(|known| known.id == record.id) {
            Some(known) if *known == record => return Ok(()),
            Some(known) => *known = record,
            None => self.families.push(record),
        }
        self.save()?;
        Ok(())
    }

    /// Removes the files and records of families that are no longer in the plan.
    ///
    /// # Errors
    /// A file cannot be removed.
    pub fn remove_unplanned_families(&mut self, output: &Path) -> Result<(), Error> {
        let is_planned = |record: &FamilyRecord| self.plan.families.iter().any(|p| p.family.id == record.id);
        for record in self.families.iter().filter(|record| !is_planned(record)) {
            let folder = output.join(&record.id);
            files::remove_files(&folder, record.files.iter().map(|file| file.name.as_str()))?;
            // A folder with files that this program did not write is kept.
            let _ = fs::remove_dir(&folder);
        }
        let plan = self.plan;
        self.families.retain(|record| plan.families.iter().any(|p| p.family.id == record.id));
        Ok(())
    }

    /// The record of the run: the families in the order of the plan, and at the end those that are not in it.
    fn to_run(&self) -> RunRecord {
        let mut run = RunRecord::new(&self.plan.title);
        let position = |record: &FamilyRecord| self.plan.families.iter().position(|p| p.family.id == record.id);
        run.families = self.families.clone();
        run.book = self.book.clone();
        run.gallery = self.gallery.clone();
        run.families.sort_by_key(|record| position(record).unwrap_or(usize::MAX));
        run
    }

    /// Writes the record if the file has other bytes.
    fn save(&mut self) -> Result<RunRecord, Error> {
        let run = self.to_run();
        let bytes = run.to_bytes();
        if bytes != self.saved_bytes {
            write(&self.path, &bytes)?;
            self.saved_bytes = bytes;
        }
        Ok(run)
    }

    /// Writes the gallery's page for the current record.
    ///
    /// # Errors
    /// The page cannot be written.
    pub fn write_gallery(&mut self, output: &Path) -> Result<(), Error> {
        let run = self.to_run();
        let bytes = |record: &FamilyRecord| {
            fs::metadata(output.join(&record.id).join(gallery::SCRIPT_FILE)).map_or(0, |metadata| metadata.len())
        };
        let shown: Vec<GalleryFamily> =
            run.families.iter().map(|record| GalleryFamily { record, script_bytes: bytes(record) }).collect();
        let page = gallery::index_html(&run, &shown);
        let record = FileRecord::from_bytes(gallery::PAGE_FILE, page.as_bytes());
        if self.gallery.as_ref() != Some(&record) || !files::is_intact(output, &record) {
            // The record makes no claim about the page while it is being written.
            self.gallery = None;
            self.save()?;
            write(&output.join(gallery::PAGE_FILE), page.as_bytes())?;
        }
        self.gallery = Some(record);
        Ok(())
    }

    /// Writes the finished record, and returns it.
    pub fn close(mut self) -> Result<RunRecord, Error> {
        self.save()
    }
}

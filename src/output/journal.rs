use std::fs;
use std::path::{Path, PathBuf};

use super::Error;
use super::files::{self, write};
use crate::gallery::{self, GalleryFamily};
use crate::manifest::Plan;
use crate::record::{BookRecord, FamilyRecord, FileRecord, RunRecord};

/// `run.json` as it grows: at any time it says no more than what is so, whatever comes next.
#[derive(Debug)]
pub(super) struct Journal<'a> {
    plan: &'a Plan,
    path: PathBuf,
    /// What is known of families, done in this run or an earlier one.
    families: Vec<FamilyRecord>,
    /// What is known of the book.
    book: Option<BookRecord>,
    /// What is known of the gallery's page.
    gallery: Option<FileRecord>,
    /// What is in the file.
    saved_bytes: Vec<u8>,
}

impl<'a> Journal<'a> {
    /// The journal of a folder, with what is left in it of an earlier run.
    pub fn open(plan: &'a Plan, output: &Path, earlier: Option<RunRecord>) -> Journal<'a> {
        let path = output.join("run.json");
        // Where it cannot be read there is none, or it is one that is replaced.
        let written = fs::read(&path).unwrap_or_default();
        let (families, book, gallery) = earlier.map(|run| (run.families, run.book, run.gallery)).unwrap_or_default();
        Journal { plan, path, families, book, gallery, saved_bytes: written }
    }

    /// What is known of the book.
    pub fn book(&self) -> Option<&BookRecord> {
        self.book.as_ref()
    }

    /// Replaces what is known of the book, on disk too.
    pub fn set_book(&mut self, record: Option<BookRecord>) -> Result<(), Error> {
        self.book = record;
        self.save()?;
        Ok(())
    }

    /// What is known of a family.
    pub fn family(&self, id: &str) -> Option<&FamilyRecord> {
        self.families.iter().find(|record| record.id == id)
    }

    /// Replaces what is known of a family, on disk too.
    pub fn set_family(&mut self, record: FamilyRecord) -> Result<(), Error> {
        match self.families.iter_mut().find(|known| known.id == record.id) {
            Some(known) if *known == record => return Ok(()),
            Some(known) => *known = record,
            None => self.families.push(record),
        }
        self.save()?;
        Ok(())
    }

    /// Removes what families left that the plan no longer has, and forgets them.
    ///
    /// # Errors
    /// A file that cannot be removed.
    pub fn remove_unplanned_families(&mut self, output: &Path) -> Result<(), Error> {
        let is_planned = |record: &FamilyRecord| self.plan.families.iter().any(|p| p.family.id == record.id);
        for record in self.families.iter().filter(|record| !is_planned(record)) {
            let folder = output.join(&record.id);
            files::remove_files(&folder, record.files.iter().map(|file| file.name.as_str()))?;
            // A folder that is not empty has something of others in it, and stays.
            let _ = fs::remove_dir(&folder);
        }
        let plan = self.plan;
        self.families.retain(|record| plan.families.iter().any(|p| p.family.id == record.id));
        Ok(())
    }

    /// What is known, the families in the order of the plan, those it does not have at the end.
    fn to_run(&self) -> RunRecord {
        let mut run = RunRecord::new(&self.plan.title);
        let place = |record: &FamilyRecord| self.plan.families.iter().position(|p| p.family.id == record.id);
        run.families = self.families.clone();
        run.book = self.book.clone();
        run.gallery = self.gallery.clone();
        run.families.sort_by_key(|record| place(record).unwrap_or(usize::MAX));
        run
    }

    /// Writes what is known, if the file does not say it yet.
    fn save(&mut self) -> Result<RunRecord, Error> {
        let run = self.to_run();
        let bytes = run.to_bytes();
        if bytes != self.saved_bytes {
            write(&self.path, &bytes)?;
            self.saved_bytes = bytes;
        }
        Ok(run)
    }

    /// Writes the gallery's page for what is known now.
    ///
    /// # Errors
    /// A page that cannot be written.
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
            // Until it is written, nothing is known of it.
            self.gallery = None;
            self.save()?;
            write(&output.join(gallery::PAGE_FILE), page.as_bytes())?;
        }
        self.gallery = Some(record);
        Ok(())
    }

    /// The finished record.
    pub fn close(mut self) -> Result<RunRecord, Error> {
        self.save()
    }
}

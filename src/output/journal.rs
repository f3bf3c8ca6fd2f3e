//! The record of a run while it is in progress.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use serde_json::Value;

use super::files::{self, AtomicFile, write};
use super::previous_run::PreviousRun;
use super::{Error, Event, Options};
use crate::gallery::{self, DataBytes, GalleryFamily};
use crate::manifest::{MAX_PAGE_FILES, Plan, PlannedFamily};
use crate::record::{
    BookRecord, FamilyProgress, FamilyRecord, FileRecord, FolderRecord, IMAGES_FILE_NAME, JOURNAL_FILE_NAME,
    JournalEntry, RUN_FILE_NAME, RunRecord, images_of_run, path_in_atlas, read_regular_file,
};

/// The record of a run in progress: in memory, and in a journal on disk.
///
/// Before the first file of an earlier run is replaced, what its `run.json` claims is moved to the journal, to which each
/// file is then added before and after it is written. At any time, `run.json` alone and both together claim nothing that
/// is not true. The journal is only appended to, so its cost is proportional to the number of files.
#[derive(Debug)]
pub(super) struct Journal<'a> {
    plan: &'a Plan,
    output: PathBuf,
    manifest: Option<&'a str>,
    /// The records of families, of this run or an earlier one.
    families: Vec<FamilyRecord>,
    /// The index of each family, by id.
    indices: HashMap<String, usize>,
    /// The record of the book.
    book: Option<BookRecord>,
    /// The record of the gallery's page.
    gallery: Option<FileRecord>,
    /// The record of the script with its kernel.
    kernel: Option<FileRecord>,
    /// How far an earlier run that did not end has written the tables of families.
    progress: HashMap<String, FamilyProgress>,
    /// Whether an earlier run has written `images.json`.
    has_images_file: bool,
    /// The index of the finished pieces of the gallery's data of these families.
    pieces: HashMap<String, Vec<Value>>,
    /// Whether an earlier run did not end, whose files the disk may not have yet.
    is_unfinished: bool,
    /// The file, once this run has changed anything.
    file: Option<Arc<JournalFile>>,
}

/// The file of a journal, to which all threads append.
#[derive(Debug)]
pub(super) struct JournalFile {
    path: PathBuf,
    file: Mutex<File>,
    /// The files of the atlas that are complete.
    written: Mutex<BTreeSet<PathBuf>>,
}

impl JournalFile {
    /// Begins a journal with some entries, and opens it for others.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn begin(path: PathBuf, entries: impl Iterator<Item = JournalEntry>) -> Result<JournalFile, Error> {
        let mut journal = AtomicFile::new(path.clone())?;
        for entry in entries {
            journal.write_bytes(&entry.to_line())?;
        }
        journal.commit()?;
        JournalFile::open(path)
    }

    /// Opens a journal that has been begun.
    fn open(path: PathBuf) -> Result<JournalFile, Error> {
        let file = File::options().append(true).open(&path);
        let file = file.map_err(|source| Error::Write { path: path.clone(), source })?;
        Ok(JournalFile { path, file: Mutex::new(file), written: Mutex::default() })
    }

    /// Appends an entry.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn append(&self, entry: &JournalEntry) -> Result<(), Error> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        // A single call, so that a killed run leaves at most one incomplete line.
        file.write_all(&entry.to_line()).map_err(|source| Error::Write { path: self.path.clone(), source })
    }

    /// Replaces a file by `write`, and returns its record; `folder` is empty, or the id of the family. An entry before it
    /// says that nothing is known about the file, and one after it that it is complete.
    ///
    /// # Errors
    /// The error of `write`, or the journal cannot be written.
    pub fn replace_file(
        &self,
        folder: &str,
        name: &str,
        write: impl FnOnce() -> Result<FileRecord, Error>,
    ) -> Result<FileRecord, Error> {
        self.append(&JournalEntry::Writing(path_in_atlas(folder, name)))?;
        let record = write()?;
        let path = self.path.with_file_name(folder).join(name);
        self.written.lock().unwrap_or_else(PoisonError::into_inner).insert(path);
        self.append(&JournalEntry::written(folder, record.clone()))?;
        Ok(record)
    }

    /// Removes those of some files that exist; `folder` is empty, or the id of the family. Entries before it say that nothing is
    /// known about them.
    ///
    /// # Errors
    /// The journal cannot be written, or a file not be removed.
    pub fn remove_files<'n>(&self, folder: &str, names: impl Iterator<Item = &'n str>) -> Result<(), Error> {
        let names: Vec<&str> = names.collect();
        for name in &names {
            self.append(&JournalEntry::Writing(path_in_atlas(folder, name)))?;
        }
        files::remove_files(&self.path.with_file_name(folder), names.into_iter())
    }
}

impl<'a> Journal<'a> {
    /// Opens the journal of a folder with the record of an earlier run.
    pub fn open(plan: &'a Plan, output: &Path, options: &'a Options, earlier: PreviousRun) -> Journal<'a> {
        let PreviousRun { families, book, gallery, kernel, progress, pieces, has_images_file, is_unfinished, .. } =
            earlier;
        let indices = families.iter().enumerate().map(|(k, family)| (family.id.clone(), k)).collect();
        let progress = progress.into_iter().map(|progress| (progress.family.clone(), progress)).collect();
        let (output, manifest) = (output.to_owned(), options.manifest.as_deref());
        Journal {
            plan,
            output,
            manifest,
            families,
            indices,
            book,
            gallery,
            kernel,
            progress,
            has_images_file,
            pieces,
            is_unfinished,
            file: None,
        }
    }

    /// The file, to which changes have to be appended before they are made. At the first call, what an earlier run
    /// claims is moved to it.
    ///
    /// # Errors
    /// The journal, or the earlier `run.json`, cannot be written.
    pub fn file(&mut self) -> Result<Arc<JournalFile>, Error> {
        if let Some(file) = &self.file {
            return Ok(Arc::clone(file));
        }
        let file = Arc::new(self.begin()?);
        self.file = Some(Arc::clone(&file));
        Ok(file)
    }

    fn begin(&self) -> Result<JournalFile, Error> {
        let path = self.output.join(JOURNAL_FILE_NAME);
        let mut journal = AtomicFile::new(path.clone())?;
        let mut add = |entry: JournalEntry| journal.write_bytes(&entry.to_line());
        add(JournalEntry::Atlas(Box::new(RunRecord::new(self.manifest, &self.plan.title))))?;
        for family in &self.families {
            add(JournalEntry::Family(family.without_files()))?;
            for file in family.files.iter().filter(|file| file.makes_claims()) {
                add(JournalEntry::written(&family.id, file.clone()))?;
            }
        }
        if let Some(book) = &self.book {
            add(JournalEntry::Book(book.without_files()))?;
        }
        let others = self.book.iter().flat_map(|book| &book.files).chain(&self.gallery).chain(&self.kernel);
        for file in others.filter(|file| file.makes_claims()) {
            add(JournalEntry::written("", file.clone()))?;
        }
        for (family, pieces) in &self.pieces {
            for (number, index) in pieces.iter().enumerate() {
                add(JournalEntry::Piece { family: family.clone(), number, index: index.clone() })?;
            }
        }
        for progress in self.progress.values() {
            add(JournalEntry::Progress(progress.clone()))?;
        }
        journal.commit_durably()?;
        if self.output.join(RUN_FILE_NAME).exists() {
            files::write_durably(&self.output.join(RUN_FILE_NAME), &self.to_run().without_claims().to_bytes())?;
        }
        JournalFile::open(path)
    }

    /// The record of the book.
    #[cfg(feature = "pdf")]
    pub fn book(&self) -> Option<&BookRecord> {
        self.book.as_ref()
    }

    /// Replaces the record of the book.
    ///
    /// # Errors
    /// The journal cannot be written.
    #[cfg(feature = "pdf")]
    pub fn set_book(&mut self, record: Option<BookRecord>) -> Result<(), Error> {
        if let Some(record) = &record {
            let entry = JournalEntry::Book(record.without_files());
            self.file()?.append(&entry)?;
        }
        self.book = record;
        Ok(())
    }

    /// The record of a family.
    pub fn family(&self, id: &str) -> Option<&FamilyRecord> {
        self.indices.get(id).map(|&index| &self.families[index])
    }

    /// How far an earlier run that did not end has written the tables of a family, and the index of the pieces of the
    /// gallery's data that it has finished.
    pub fn progress(&self, id: &str) -> Option<(&FamilyProgress, &[Value])> {
        Some((self.progress.get(id)?, self.pieces.get(id).map(Vec::as_slice).unwrap_or_default()))
    }

    /// Replaces the record of a family.
    ///
    /// # Errors
    /// The journal cannot be written.
    pub fn set_family(&mut self, record: FamilyRecord) -> Result<(), Error> {
        if self.family(&record.id) == Some(&record) {
            return Ok(());
        }
        let entry = JournalEntry::Family(record.without_files());
        self.file()?.append(&entry)?;
        match self.indices.get(&record.id) {
            Some(&index) => self.families[index] = record,
            None => {
                self.indices.insert(record.id.clone(), self.families.len());
                self.families.push(record);
            }
        }
        Ok(())
    }

    /// Checks that the files of a family's pages, together with those of the families written before, are not too many.
    ///
    /// # Errors
    /// They are too many for the record of an atlas.
    pub fn check_page_files(&self, id: &str, files: usize) -> Result<(), Error> {
        let others = || self.families.iter().filter(|record| record.id != id);
        let total = |files: usize, record: &FamilyRecord| files.saturating_add(record.files.len());
        if others().fold(files, total) <= MAX_PAGE_FILES {
            return Ok(());
        }
        let planned: HashSet<&str> = self.plan.families.iter().map(|planned| planned.family.id.as_str()).collect();
        let files = others().filter(|record| planned.contains(record.id.as_str())).fold(files, total);
        if files <= MAX_PAGE_FILES { Ok(()) } else { Err(Error::TooManyFiles { family: id.to_owned(), files }) }
    }

    /// Removes the files and records of families that are no longer in the plan, and reports them.
    ///
    /// # Errors
    /// A file cannot be removed.
    pub fn remove_unplanned_families(&mut self, report: &mut dyn FnMut(Event)) -> Result<(), Error> {
        let planned: HashSet<&str> = self.plan.families.iter().map(|planned| planned.family.id.as_str()).collect();
        let is_planned = |record: &FamilyRecord| planned.contains(record.id.as_str());
        if self.families.iter().all(is_planned) {
            return Ok(());
        }
        let file = self.file()?;
        for record in self.families.iter().filter(|record| !is_planned(record)) {
            file.remove_files(&record.id, record.files.iter().map(|file| file.name.as_str()))?;
            // A folder with files that this program did not write is kept.
            let _ = fs::remove_dir(self.output.join(&record.id));
            report(Event::Removed { family: &record.id });
        }
        self.families.retain(is_planned);
        self.indices = self.families.iter().enumerate().map(|(k, family)| (family.id.clone(), k)).collect();
        Ok(())
    }

    /// The record of the run: the families in the order of the plan, and at the end those that are not in it.
    fn to_run(&self) -> RunRecord {
        let mut run = RunRecord::new(self.manifest, &self.plan.title);
        let planned = self.plan.families.iter().enumerate();
        let positions: HashMap<&str, usize> = planned.map(|(k, planned)| (planned.family.id.as_str(), k)).collect();
        run.families = self.families.clone();
        run.book = self.book.clone();
        run.gallery = self.gallery.clone();
        run.kernel = self.kernel.clone();
        run.families.sort_by_key(|record| positions.get(record.id.as_str()).copied().unwrap_or(usize::MAX));
        run
    }

    /// Writes the gallery's kernel, and its page for the current record.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write_gallery(&mut self) -> Result<(), Error> {
        let run = self.to_run();
        let planned: HashMap<&str, &PlannedFamily> =
            self.plan.families.iter().map(|planned| (planned.family.id.as_str(), planned)).collect();
        let show = |record| {
            let bytes = DataBytes::new(record, |name| files::size(&self.output.join(&record.id).join(name)))?;
            Ok(GalleryFamily { record, bytes, planned: planned.get(record.id.as_str()).copied() })
        };
        let shown: Vec<GalleryFamily> = run.families.iter().map(show).collect::<Result<_, Error>>()?;
        let page = gallery::index_html(&run, self.plan.page.paper, &shown);
        // The kernel first, so that a page always finds one.
        self.kernel = Some(self.write_text(gallery::KERNEL_FILE, &gallery::kernel_script(), run.kernel.as_ref())?);
        self.gallery = Some(self.write_text(gallery::PAGE_FILE, &page, run.gallery.as_ref())?);
        Ok(())
    }

    /// Writes a file in the folder of the atlas unless it is there as `known`, and returns its record.
    fn write_text(&mut self, name: &str, text: &str, known: Option<&FileRecord>) -> Result<FileRecord, Error> {
        let record = FileRecord::from_bytes(name, text.as_bytes());
        if known == Some(&record) && files::is_intact(&self.output, &record) {
            return Ok(record);
        }
        let path = self.output.join(name);
        self.file()?.replace_file("", name, || write(&path, text.as_bytes()).map(|()| record))
    }

    /// The files that the disk may not have yet: those of this run, and of one that did not end.
    fn files_to_sync(&self, run: &RunRecord) -> BTreeSet<PathBuf> {
        match &self.file {
            _ if self.is_unfinished => claimed_files(&self.output, run),
            Some(file) => std::mem::take(&mut *file.written.lock().unwrap_or_else(PoisonError::into_inner)),
            None => BTreeSet::new(),
        }
    }

    /// Hands all files to the disk, so that the record stays true if the machine fails, writes the finished record, removes the journal, and returns the record.
    ///
    /// # Errors
    /// The disk does not take the files, or the record cannot be written.
    pub fn close(self) -> Result<RunRecord, Error> {
        let mut run = self.to_run();
        files::sync(&self.files_to_sync(&run))?;
        write_record(&self.output, &mut run, self.has_images_file)?;
        drop(self.file);
        remove_journal(&self.output)?;
        Ok(run)
    }
}

/// The files of a record that it says something about.
fn claimed_files(output: &Path, run: &RunRecord) -> BTreeSet<PathBuf> {
    let of_family = |family: &FamilyRecord| {
        let folder = output.join(&family.id);
        family.files.iter().filter(|file| file.makes_claims()).map(|file| folder.join(&file.name)).collect::<Vec<_>>()
    };
    let others = run.book.iter().flat_map(|book| &book.files).chain(&run.gallery).chain(&run.kernel);
    let others = others.filter(|file| file.makes_claims()).map(|file| output.join(&file.name));
    run.families.iter().flat_map(of_family).chain(others).collect()
}

/// Writes `images.json`, and then `run.json`, so that they outlive a failure of the machine. Without images and books, an `images.json` of an earlier run is removed.
fn write_record(output: &Path, run: &mut RunRecord, has_images_file: bool) -> Result<(), Error> {
    match images_of_run(run) {
        Some(images) => write_if_different(&output.join(IMAGES_FILE_NAME), &images)?,
        None if has_images_file => files::remove_files(output, std::iter::once(IMAGES_FILE_NAME))?,
        None => {}
    }
    write_if_different(&output.join(RUN_FILE_NAME), &run.to_bytes())
}

/// Removes the journal, if there is one; a folder without it need not be writable.
fn remove_journal(output: &Path) -> Result<(), Error> {
    let path = output.join(JOURNAL_FILE_NAME);
    if fs::symlink_metadata(&path).is_err_and(|error| error.kind() == io::ErrorKind::NotFound) {
        return Ok(());
    }
    fs::remove_file(&path).map_err(|source| Error::Write { path, source })
}

/// Writes a file unless it has these bytes already, so that an unchanged atlas needs no permission to write.
fn write_if_different(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    if read_regular_file(path, bytes.len() as u64).is_ok_and(|found| found == bytes) {
        Ok(())
    } else {
        files::write_durably(path, bytes)
    }
}

/// Writes what the journal of a run that has failed says into `run.json`; this claims nothing untrue, since nothing more
/// is written. The journal is kept for the next run if it `continues` the unfinished tables. If a file cannot be written,
/// the journal says the same.
pub(super) fn suspend(output: &Path, continues: bool) {
    let write = || -> Result<(), Error> {
        let Ok(FolderRecord { mut run, is_unfinished: true, .. }) = FolderRecord::read(output) else { return Ok(()) };
        write_record(output, &mut run, false)?;
        if continues { Ok(()) } else { remove_journal(output) }
    };
    let _ = write();
}

//! The state of a family's files while threads write them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::Error;
use super::files::{self, AtomicFile, write};
use crate::record::FileRecord;

/// The records of a family's files while threads write them.
#[derive(Debug)]
pub(super) struct FileRegistry {
    folder: PathBuf,
    /// The records of an earlier run, by file name.
    previous: BTreeMap<String, FileRecord>,
    /// The records of this run, by file name; `None` while a file is being written.
    current: Mutex<BTreeMap<String, Option<FileRecord>>>,
}

impl FileRegistry {
    /// Creates the registry of a folder from the records of an earlier run.
    pub fn new(folder: &Path, earlier: Vec<FileRecord>) -> FileRegistry {
        let earlier = earlier.into_iter().map(|record| (record.name.clone(), record)).collect();
        FileRegistry { folder: folder.to_owned(), previous: earlier, current: Mutex::default() }
    }

    fn lock_current(&self) -> MutexGuard<'_, BTreeMap<String, Option<FileRecord>>> {
        // Each change is a single insertion, so a panic cannot leave the map inconsistent.
        self.current.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The record of a file of the earlier run, if it is intact and was made from the same inputs.
    pub fn reuse_unchanged(&self, name: &str, inputs: &str) -> Option<FileRecord> {
        let record = self.previous.get(name).filter(|record| record.inputs_sha256.as_deref() == Some(inputs))?;
        if !files::is_intact(&self.folder, record) {
            return None;
        }
        self.lock_current().insert(name.to_owned(), Some(record.clone()));
        Some(record.clone())
    }

    /// Writes a file and registers its record.
    pub fn write_file(&self, record: FileRecord, bytes: &[u8]) -> Result<FileRecord, Error> {
        self.track_write(record.name.clone(), || write(&self.folder.join(&record.name), bytes).map(|()| record))
    }

    /// Renames a finished file to its final name and registers its record.
    pub fn commit_file(&self, file: AtomicFile) -> Result<FileRecord, Error> {
        self.track_write(file.name(), || file.commit())
    }

    fn track_write(&self, name: String, make: impl FnOnce() -> Result<FileRecord, Error>) -> Result<FileRecord, Error> {
        self.lock_current().insert(name.clone(), None);
        let record = make()?;
        self.lock_current().insert(name, Some(record.clone()));
        Ok(record)
    }

    /// Records that stay true while more files are written: files not finished in this run have only their names.
    pub fn certain_records(&self) -> Vec<FileRecord> {
        self.merge_records(|record| FileRecord::from_name(&record.name))
    }

    /// The records of all files, when no more are written.
    pub fn final_records(&self) -> Vec<FileRecord> {
        self.merge_records(FileRecord::clone)
    }

    fn merge_records(&self, from_previous: impl Fn(&FileRecord) -> FileRecord) -> Vec<FileRecord> {
        let current = self.lock_current();
        let mut records: BTreeMap<&str, FileRecord> =
            self.previous.iter().map(|(name, record)| (name.as_str(), from_previous(record))).collect();
        for (name, record) in current.iter() {
            // A file that could not be written keeps only its name, and only if it is from an earlier run.
            let record =
                record.clone().or_else(|| records.contains_key(name.as_str()).then(|| FileRecord::from_name(name)));
            if let Some(record) = record {
                records.insert(name, record);
            }
        }
        records.into_values().collect()
    }
}

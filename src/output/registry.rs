use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::Error;
use super::files::{self, AtomicFile, write};
use crate::record::FileRecord;

/// What can be said of a family's files while threads write them.
#[derive(Debug)]
pub(super) struct FileRegistry {
    folder: PathBuf,
    /// What an earlier run said, by the files' names.
    previous: BTreeMap<String, FileRecord>,
    /// Those this run has settled: by their records, or by none while they are being written.
    current: Mutex<BTreeMap<String, Option<FileRecord>>>,
}

impl FileRegistry {
    /// What an earlier run said of the files in a folder.
    pub fn new(folder: &Path, earlier: Vec<FileRecord>) -> FileRegistry {
        let earlier = earlier.into_iter().map(|record| (record.name.clone(), record)).collect();
        FileRegistry { folder: folder.to_owned(), previous: earlier, current: Mutex::default() }
    }

    fn lock_current(&self) -> MutexGuard<'_, BTreeMap<String, Option<FileRecord>>> {
        // Each change of the map is a single one, so that no panic leaves it half made.
        self.current.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The record of a file that is as it would be if it were made from these inputs now.
    pub fn reuse_unchanged(&self, name: &str, inputs: &str) -> Option<FileRecord> {
        let record = self.previous.get(name).filter(|record| record.inputs_sha256.as_deref() == Some(inputs))?;
        if !files::is_intact(&self.folder, record) {
            return None;
        }
        self.lock_current().insert(name.to_owned(), Some(record.clone()));
        Some(record.clone())
    }

    /// Writes a file.
    pub fn write_file(&self, record: FileRecord, bytes: &[u8]) -> Result<FileRecord, Error> {
        self.track_write(record.name.clone(), || write(&self.folder.join(&record.name), bytes).map(|()| record))
    }

    /// Gives a file its name.
    pub fn commit_file(&self, file: AtomicFile) -> Result<FileRecord, Error> {
        self.track_write(file.name(), || file.commit())
    }

    fn track_write(&self, name: String, make: impl FnOnce() -> Result<FileRecord, Error>) -> Result<FileRecord, Error> {
        self.lock_current().insert(name.clone(), None);
        let record = make()?;
        self.lock_current().insert(name, Some(record.clone()));
        Ok(record)
    }

    /// What is so of all files, and remains so while others are written: of those that are not settled, their names.
    pub fn certain_records(&self) -> Vec<FileRecord> {
        self.merge_records(|record| FileRecord::from_name(&record.name))
    }

    /// What is so of all files, now that no more are written.
    pub fn final_records(&self) -> Vec<FileRecord> {
        self.merge_records(FileRecord::clone)
    }

    fn merge_records(&self, of_unsettled: impl Fn(&FileRecord) -> FileRecord) -> Vec<FileRecord> {
        let settled = self.lock_current();
        let mut told: BTreeMap<&str, FileRecord> =
            self.previous.iter().map(|(name, record)| (name.as_str(), of_unsettled(record))).collect();
        for (name, record) in settled.iter() {
            // Of one whose writing has failed no more is known than its name, and that only if it is an earlier run's.
            let record =
                record.clone().or_else(|| told.contains_key(name.as_str()).then(|| FileRecord::from_name(name)));
            if let Some(record) = record {
                told.insert(name, record);
            }
        }
        told.into_values().collect()
    }
}

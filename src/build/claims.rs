use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::Error;
use super::files::{self, Growing, write};
use crate::record::FileRecord;

/// What can be said of a family's files while threads write them.
#[derive(Debug)]
pub(super) struct Claims {
    folder: PathBuf,
    /// What an earlier run said, by the files' names.
    earlier: BTreeMap<String, FileRecord>,
    /// Those this run has settled: by their records, or by none while they are being written.
    settled: Mutex<BTreeMap<String, Option<FileRecord>>>,
}

impl Claims {
    /// What an earlier run said of the files in a folder.
    pub fn new(folder: &Path, earlier: Vec<FileRecord>) -> Claims {
        let earlier = earlier.into_iter().map(|record| (record.name.clone(), record)).collect();
        Claims { folder: folder.to_owned(), earlier, settled: Mutex::default() }
    }

    fn settled(&self) -> MutexGuard<'_, BTreeMap<String, Option<FileRecord>>> {
        // Each change of the map is a single one, so that no panic leaves it half made.
        self.settled.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The record of a file that is as it would be if it were made from these inputs now.
    pub fn kept(&self, name: &str, inputs: &str) -> Option<FileRecord> {
        let record = self.earlier.get(name).filter(|record| record.inputs_sha256.as_deref() == Some(inputs))?;
        if !files::is_intact(&self.folder, record) {
            return None;
        }
        self.settled().insert(name.to_owned(), Some(record.clone()));
        Some(record.clone())
    }

    /// Writes a file.
    pub fn write(&self, record: FileRecord, bytes: &[u8]) -> Result<FileRecord, Error> {
        self.settle(record.name.clone(), || write(&self.folder.join(&record.name), bytes).map(|()| record))
    }

    /// Gives a file its name.
    pub fn finish(&self, file: Growing) -> Result<FileRecord, Error> {
        self.settle(file.name(), || file.finish())
    }

    fn settle(&self, name: String, make: impl FnOnce() -> Result<FileRecord, Error>) -> Result<FileRecord, Error> {
        self.settled().insert(name.clone(), None);
        let record = make()?;
        self.settled().insert(name, Some(record.clone()));
        Ok(record)
    }

    /// What is so of all files, and remains so while others are written: of those that are not settled, their names.
    pub fn lasting(&self) -> Vec<FileRecord> {
        self.told(|record| FileRecord::of_name(&record.name))
    }

    /// What is so of all files, now that no more are written.
    pub fn at_end(&self) -> Vec<FileRecord> {
        self.told(FileRecord::clone)
    }

    fn told(&self, of_unsettled: impl Fn(&FileRecord) -> FileRecord) -> Vec<FileRecord> {
        let settled = self.settled();
        let mut told: BTreeMap<&str, FileRecord> =
            self.earlier.iter().map(|(name, record)| (name.as_str(), of_unsettled(record))).collect();
        for (name, record) in settled.iter() {
            // Of one whose writing has failed no more is known than its name, and that only if it is an earlier run's.
            let record = record.clone().or_else(|| told.contains_key(name.as_str()).then(|| FileRecord::of_name(name)));
            if let Some(record) = record {
                told.insert(name, record);
            }
        }
        told.into_values().collect()
    }
}

//! The state of a family's files while threads write them.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use super::Error;
use super::files::{self, write};
use super::journal::JournalFile;
use super::table_file::TableFile;
use crate::record::{Digest, FileRecord};

/// Writes the files of a family, and adds them to the journal.
#[derive(Debug)]
pub(super) struct FileRegistry<'a> {
    /// The id of the family, which its folder has as its name.
    family: &'a str,
    folder: PathBuf,
    /// The records of an earlier run, by file name.
    previous: HashMap<&'a str, &'a FileRecord>,
    journal: &'a JournalFile,
}

impl<'a> FileRegistry<'a> {
    /// Creates the registry of a family's folder from the records of an earlier run.
    pub fn new(
        family: &'a str,
        folder: &Path,
        earlier: &'a [FileRecord],
        journal: &'a JournalFile,
    ) -> FileRegistry<'a> {
        let previous = earlier.iter().map(|record| (record.name.as_str(), record)).collect();
        FileRegistry { family, folder: folder.to_owned(), previous, journal }
    }

    /// The record of a file of the earlier run, if it is intact and was made from the same inputs.
    pub fn reuse_unchanged(&self, name: &str, inputs: Digest) -> Option<FileRecord> {
        self.reuse_if(name, |record| record.inputs_sha256 == Some(inputs))
    }

    /// The record of a file of the earlier run, if it is usable and intact. The file is read only if it is usable.
    pub fn reuse_if(&self, name: &str, is_usable: impl Fn(&FileRecord) -> bool) -> Option<FileRecord> {
        let record = self.previous.get(name).copied().filter(|record| is_usable(record))?;
        files::is_intact(&self.folder, record).then(|| record.clone())
    }

    /// Writes a file, and returns its record.
    pub fn write_file(&self, record: FileRecord, bytes: &[u8]) -> Result<FileRecord, Error> {
        self.journal.replace_file(self.family, &record.name.clone(), || {
            let path = self.folder.join(&record.name);
            if let (true, Some(subfolder)) = (record.name.contains('/'), path.parent()) {
                files::create_folder(subfolder)?;
            }
            write(&path, bytes).map(|()| record)
        })
    }

    /// Renames a finished table to its final name, and returns its record.
    pub fn commit_file(&self, file: TableFile) -> Result<FileRecord, Error> {
        self.journal.replace_file(self.family, &file.name(), || file.commit())
    }
}

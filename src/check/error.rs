//! Why an atlas cannot be checked.

use std::path::PathBuf;

use super::finding::Change;
use super::outdated;
use crate::record::{FileError, ReadError, TableError};

/// Why an atlas cannot be checked.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The record of the atlas cannot be used.
    #[error("cannot use {}: {source}; {}", path.display(), outdated::record_remedy(source))]
    Record {
        /// The path of the record.
        path: PathBuf,
        /// Why.
        source: ReadError,
    },
    /// The system fails to read a recorded file.
    #[error("cannot use {}: it cannot be read: {reason}; run it again", path.display())]
    Unreadable {
        /// The path of the file.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// A run is writing to the atlas.
    #[error("a run is writing to {}: wait for it to end", folder.display())]
    Busy {
        /// The folder of the atlas.
        folder: PathBuf,
    },
    /// The check was interrupted.
    #[error("interrupted")]
    Interrupted,
}

impl Error {
    /// The change of a recorded file that is wrong.
    ///
    /// # Errors
    /// Nothing is known to be wrong with it: the system fails to read it.
    pub(super) fn or_damage(error: impl Into<TableError>) -> Result<Change, Error> {
        match error.into() {
            TableError::File(FileError::Unreadable { path, reason }) => Err(Error::Unreadable { path, reason }),
            error => Ok(Change::Damaged { message: error.to_string() }),
        }
    }
}

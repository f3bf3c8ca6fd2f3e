//! Why an atlas cannot be checked.

use std::path::PathBuf;

use super::outdated;
use crate::record::ReadError;

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

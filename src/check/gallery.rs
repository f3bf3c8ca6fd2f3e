//! Checks the files of the gallery. They contain only data of the tables and pages, so it is enough to check that they
//! have not been edited since they were recorded.

use std::io;
use std::path::Path;

use super::Error;
use super::finding::{Finding, Location};
use super::tables::file_change;
use crate::record::{Digest, FileError, FileRecord, TextDigests, open_regular_file};

/// The finding on a file of the gallery, if it has changed; `name` is its path in the folder of the atlas.
///
/// # Errors
/// The system fails to read it.
pub(super) fn check_file(output: &Path, name: &str, record: &FileRecord) -> Result<Option<Finding>, Error> {
    let change = match digests(&output.join(name)) {
        Ok(digests) => file_change(Some(record), &digests),
        Err(error) => Some(Error::or_damage(error)?),
    };
    Ok(change.map(|change| Location::default().with_file(name).finding(change)))
}

/// The digests of a file: of its bytes, and of its text with plain line endings.
fn digests(path: &Path) -> Result<[Digest; 2], FileError> {
    let mut digests = TextDigests::default();
    io::copy(&mut open_regular_file(path, u64::MAX)?, &mut digests).map_err(FileError::at(path))?;
    Ok(digests.finish())
}

//! The gallery's page and data, held against what is recorded of them: they have nothing that the tables have not, so that
//! it is enough that nobody has changed them.

use std::io;
use std::path::Path;

use super::finding::{Change, Finding, Location};
use super::tables::file_change;
use crate::record::{FileRecord, TableError, TextDigests, open_regular_file};

/// What has become of a file of the gallery, by its name within the atlas's folder.
pub(super) fn check_file(output: &Path, name: &str, record: &FileRecord) -> Option<Finding> {
    let change = match digests(&output.join(name)) {
        Ok(digests) => file_change(Some(record), &digests),
        Err(flaw) => Some(Change::Damaged { message: flaw.to_string() }),
    };
    change.map(|change| Location::default().with_file(name).finding(change))
}

/// The digests of a file.
fn digests(path: &Path) -> Result<[String; 2], TableError> {
    let mut digests = TextDigests::default();
    let read = io::copy(&mut open_regular_file(path, u64::MAX)?, &mut digests);
    read.map_err(|error| TableError::Unreadable(error.to_string()))?;
    Ok(digests.finish())
}

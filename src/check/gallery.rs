//! The gallery's page and data, held against what is recorded of them: they have nothing that the tables have not, so that
//! it is enough that nobody has changed them.

use std::io;
use std::path::Path;

use super::finding::{Change, Finding, Place};
use super::tables::altered;
use crate::record::{FileRecord, Flaw, LineDigests, open_plain};

/// What has become of a file of the gallery, by its name within the atlas's folder.
pub(super) fn differs(output: &Path, name: &str, record: &FileRecord) -> Option<Finding> {
    let change = match digests(&output.join(name)) {
        Ok(digests) => altered(Some(record), &digests),
        Err(flaw) => Some(Change::Damaged { wrong: flaw.to_string() }),
    };
    change.map(|change| Place::default().file(name).has(change))
}

/// The digests of a file.
fn digests(path: &Path) -> Result<[String; 2], Flaw> {
    let mut digests = LineDigests::default();
    let read = io::copy(&mut open_plain(path, u64::MAX)?, &mut digests);
    read.map_err(|error| Flaw::Unreadable(error.to_string()))?;
    Ok(digests.finish())
}

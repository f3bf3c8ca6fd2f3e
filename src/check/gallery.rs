//! The gallery's page and data, held against what is recorded of them: they have nothing that the tables have not, so that
//! it is enough that nobody has changed them.

use std::io::{self, Read};
use std::path::Path;

use super::finding::{Change, Finding, Place};
use super::tables::altered;
use crate::record::{FileRecord, Flaw, RunningDigest, open_plain};

/// What has become of a file of the gallery, by its name within the atlas's folder.
pub(super) fn differs(output: &Path, name: &str, record: &FileRecord) -> Option<Finding> {
    let change = match digests(&output.join(name)) {
        Ok(digests) => altered(Some(record), &digests),
        Err(flaw) => Some(Change::Damaged { wrong: flaw.to_string() }),
    };
    change.map(|change| Place::default().file(name).has(change))
}

/// The digests of a file: of its bytes, and of those with plain line ends.
fn digests(path: &Path) -> Result<[String; 2], Flaw> {
    let mut file = open_plain(path, u64::MAX)?;
    let mut digests = [RunningDigest::default(), RunningDigest::default()];
    let mut buffer = vec![0; 1 << 16];
    loop {
        let count = match file.read(&mut buffer) {
            Ok(0) => return Ok(digests.map(RunningDigest::finish)),
            Ok(count) => count,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(Flaw::Unreadable(error.to_string())),
        };
        digests[0].add(&buffer[..count]);
        buffer[..count].split(|&byte| byte == b'\r').for_each(|part| digests[1].add(part));
    }
}

//! Opens the files of a recorded atlas. The folder is not trusted: a name may be that of a pipe, which would block, of a
//! device, which would never end, or of a file that is far too large.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use super::digest::{Digest, RunningDigest};

/// Why a file cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FileError {
    /// It does not exist.
    #[error("does not exist")]
    NotFound,
    /// Something other than a file has its name.
    #[error("is {0}, not a file")]
    NotAFile(&'static str),
    /// It cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(String),
    /// It is far larger than this program could have written.
    #[error("has {bytes} bytes, expected at most {max}")]
    TooLarge {
        /// Its size in bytes.
        bytes: u64,
        /// The greatest size expected.
        max: u64,
    },
}

impl From<io::Error> for FileError {
    fn from(error: io::Error) -> FileError {
        match error.kind() {
            io::ErrorKind::NotFound => FileError::NotFound,
            _ => FileError::Unreadable(error.to_string()),
        }
    }
}

/// Opens a regular file of at most `max_bytes` bytes. Links are not followed.
///
/// # Errors
/// The file cannot be read, is larger, or is not a regular file.
pub fn open_regular_file(path: &Path, max_bytes: u64) -> Result<File, FileError> {
    let metadata = fs::symlink_metadata(path)?;
    let kind = metadata.file_type();
    if !kind.is_file() {
        return Err(FileError::NotAFile(match () {
            () if kind.is_symlink() => "a link",
            () if kind.is_dir() => "a folder",
            () => "a device",
        }));
    }
    if metadata.len() > max_bytes {
        return Err(FileError::TooLarge { bytes: metadata.len(), max: max_bytes });
    }
    Ok(File::open(path)?)
}

/// The digest of a regular file, read in parts.
///
/// # Errors
/// The file cannot be read, or is not a regular file.
pub fn file_digest(path: &Path) -> Result<Digest, FileError> {
    let mut digest = RunningDigest::default();
    io::copy(&mut open_regular_file(path, u64::MAX)?, &mut digest)?;
    Ok(digest.finish())
}

/// Reads a regular file of at most `max_bytes` bytes.
///
/// # Errors
/// The file cannot be read, is larger, or is not a regular file.
pub fn read_regular_file(path: &Path, max_bytes: u64) -> Result<Vec<u8>, FileError> {
    let mut bytes = Vec::new();
    // The limit holds even if the file grows while it is read.
    open_regular_file(path, max_bytes)?.take(max_bytes).read_to_end(&mut bytes)?;
    Ok(bytes)
}

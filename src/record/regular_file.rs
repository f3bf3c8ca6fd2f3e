//! Opens the files of a recorded atlas. The folder is not trusted: a name may be that of a pipe, which would block, of a
//! device, which would never end, or of a file that is far too large.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

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
    /// The system fails to read it, so that nothing is known about it and another attempt may succeed.
    #[error("cannot be read: {reason}")]
    Unreadable {
        /// Its path.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// It is far larger than this program could have written.
    #[error("has {bytes} bytes, expected at most {max}")]
    TooLarge {
        /// Its size in bytes.
        bytes: u64,
        /// The greatest size expected.
        max: u64,
    },
}

impl FileError {
    /// What an error of the system says about the file at a path.
    pub fn at(path: &Path) -> impl Fn(io::Error) -> FileError {
        |error| match error.kind() {
            // There is no file in a file, and none with a name that no file can have.
            io::ErrorKind::NotFound
            | io::ErrorKind::NotADirectory
            | io::ErrorKind::InvalidFilename
            | io::ErrorKind::InvalidInput => FileError::NotFound,
            _ => FileError::Unreadable { path: path.to_owned(), reason: error.to_string() },
        }
    }
}

/// Opens a regular file of at most `max_bytes` bytes. Links are not followed.
///
/// # Errors
/// The file cannot be read, is larger, or is not a regular file.
pub fn open_regular_file(path: &Path, max_bytes: u64) -> Result<File, FileError> {
    let metadata = fs::symlink_metadata(path).map_err(FileError::at(path))?;
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
    File::open(path).map_err(FileError::at(path))
}

/// The digest of a regular file, read in parts.
///
/// # Errors
/// The file cannot be read, or is not a regular file.
pub fn file_digest(path: &Path) -> Result<Digest, FileError> {
    let mut digest = RunningDigest::default();
    io::copy(&mut open_regular_file(path, u64::MAX)?, &mut digest).map_err(FileError::at(path))?;
    Ok(digest.finish())
}

/// Reads a regular file of at most `max_bytes` bytes.
///
/// # Errors
/// The file cannot be read, is larger, or is not a regular file.
pub fn read_regular_file(path: &Path, max_bytes: u64) -> Result<Vec<u8>, FileError> {
    let mut bytes = Vec::new();
    // The limit holds even if the file grows while it is read.
    let mut file = open_regular_file(path, max_bytes)?.take(max_bytes);
    file.read_to_end(&mut bytes).map_err(FileError::at(path))?;
    Ok(bytes)
}

use std::io::{self, ErrorKind};
use std::path::PathBuf;

use crate::record::ReadError;
use coupler_drawing::render;

/// An error of reading a manifest or writing an atlas.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A file or folder cannot be written.
    #[error("cannot write {}: {source}; {}", path.display(), remedy(source.kind()))]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The record of an earlier run cannot be used.
    #[error("cannot use {}, which records the other families: {source}; render all of them", path.display())]
    Record {
        /// The record.
        path: PathBuf,
        /// Why.
        source: ReadError,
    },
    /// The folder has a record of an unknown format, which would be overwritten.
    #[error(
        "cannot overwrite {}: {source}; render with the version that wrote it, or into another folder with -o",
        path.display()
    )]
    Format {
        /// The record.
        path: PathBuf,
        /// What format it has.
        source: ReadError,
    },
    /// A page cannot be drawn as an image.
    #[error("cannot draw {name}: {error}")]
    Image {
        /// The name of the image.
        name: String,
        /// Why.
        error: render::PngError,
    },
    /// The book cannot be written.
    #[error("cannot write the book: {0}")]
    #[cfg(feature = "pdf")]
    Book(render::pdf::Error),
    /// Another run is in progress.
    #[error("another run is writing to {}: wait until it ends, or name another folder with -o", folder.display())]
    Busy {
        /// The folder that both write to.
        folder: PathBuf,
    },
    /// The run was interrupted.
    #[error("interrupted: finished files are kept, and the next run continues from there")]
    Interrupted,
}

/// What to do about a file or folder that cannot be written.
fn remedy(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "free some space and run it again: finished files are kept"
        }
        ErrorKind::FileTooLarge => "raise the limit on file size, or write to a disk that allows larger files",
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => "change its permissions, or name another path",
        ErrorKind::NotADirectory | ErrorKind::IsADirectory | ErrorKind::AlreadyExists => {
            "something else has this path: move it away, or name another path"
        }
        ErrorKind::NotFound => "its folder no longer exists: run it again",
        _ => "correct that and run it again: finished files are kept",
    }
}

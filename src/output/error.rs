use std::io::{self, ErrorKind};
use std::path::PathBuf;

use crate::record::ReadError;
use coupler_drawing::render;

/// Why a plan was not built, or a file not read or written.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A text cannot be read.
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
    #[error("cannot use {}, which tells what the other families have: {source}; render all of them", path.display())]
    Record {
        /// The record.
        path: PathBuf,
        /// Why.
        source: ReadError,
    },
    /// The folder has a record that this program does not understand, and would write over.
    #[error(
        "cannot render over {}: {source}; render with the version that wrote it, or into another folder with -o",
        path.display()
    )]
    Format {
        /// The record.
        path: PathBuf,
        /// What format it has.
        source: ReadError,
    },
    /// A page makes no image.
    #[error("cannot draw {name}: {error}")]
    Image {
        /// The image.
        name: String,
        /// Why.
        error: render::PngError,
    },
    /// The book cannot be made.
    #[error("cannot bind the book: {0}")]
    Book(render::pdf::Error),
    /// Another run has not ended.
    #[error("another run is writing to {}: wait for its end, or name another folder with -o", folder.display())]
    Busy {
        /// Where both write to.
        folder: PathBuf,
    },
    /// The run was asked to stop.
    #[error("interrupted: what is finished is kept, and the next run goes on from there")]
    Interrupted,
}

/// What to do about a file or folder that cannot be written.
fn remedy(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "make room, and run it again: what is finished is kept",
        ErrorKind::FileTooLarge => "raise the limit on the size of files, or write to a disk that takes larger ones",
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "allow it to be written, or name another place for it"
        }
        ErrorKind::NotADirectory | ErrorKind::IsADirectory | ErrorKind::AlreadyExists => {
            "something else is in its place: move that away, or name another place"
        }
        ErrorKind::NotFound => "its folder is gone: run it again",
        _ => "mend that, and run it again: what is finished is kept",
    }
}

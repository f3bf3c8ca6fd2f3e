use std::io::{self, ErrorKind};
use std::path::PathBuf;

use crate::manifest::MAX_PAGE_FILES;
use crate::record::ReadError;
use coupler_curves::problem::Problem;
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
    #[error("cannot use {}, which records the other families: {source}; {}", path.display(), other_families_remedy(source))]
    Record {
        /// The record.
        path: PathBuf,
        /// Why.
        source: ReadError,
    },
    /// The folder has a record that this program cannot read, and that would be overwritten.
    #[error("cannot overwrite {}: {source}; {}", path.display(), record_remedy(source))]
    ForeignRecord {
        /// The record.
        path: PathBuf,
        /// Why it cannot be read.
        source: ReadError,
    },
    /// The record is lost or damaged, and there is nothing to rebuild it from.
    #[error(
        "cannot rebuild {}: {source}, and no file of the folder is what this manifest makes; write to another folder with -o, \
         or replace what is there with --overwrite",
        path.display()
    )]
    NothingToRepair {
        /// The record.
        path: PathBuf,
        /// What is wrong with it.
        source: ReadError,
    },
    /// The folder has the atlas of another manifest.
    #[error(
        "{} has the atlas of another manifest, {manifest}, with the title {title:?}: write to another folder with -o, \
         or replace that atlas with --overwrite",
        folder.display()
    )]
    OtherManifest {
        /// The folder.
        folder: PathBuf,
        /// The file name of the other manifest.
        manifest: String,
        /// Its title.
        title: String,
    },
    /// Files would be overwritten that no earlier run wrote.
    #[error(
        "no earlier run wrote {}{}: move {} away, write to another folder with -o, or replace {} with --overwrite",
        first.display(),
        if *others == 0 { String::new() } else { format!(" and {others} more") },
        if *others == 0 { "it" } else { "them" },
        if *others == 0 { "it" } else { "them" }
    )]
    ForeignFile {
        /// The first of the files.
        first: PathBuf,
        /// The number of the others.
        others: usize,
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
    /// The pages have too many files.
    #[error(
        "the pages of the families up to `{family}` have {files} files, more than the limit of {}; put more panels on \
         a page, write fewer formats, or divide the atlas",
        MAX_PAGE_FILES
    )]
    TooManyFiles {
        /// The family's id.
        family: String,
        /// The number of files.
        files: usize,
    },
    /// Linkages do not fit their pages at the scale that the manifest gives.
    #[error("{}", .0.iter().map(|problem| format!("{}: {}", problem.message, problem.help)).collect::<Vec<_>>().join("\n"))]
    Misfits(Vec<Problem>),
    /// A family has no page with a number.
    #[error("`{family}` has no page {number}: {}", pages_that_there_are(*count))]
    NoSuchPage {
        /// The family's id.
        family: String,
        /// The number, counted from 1.
        number: usize,
        /// The number of its pages.
        count: usize,
    },
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

impl Error {
    /// Whether the input is wrong, so that another attempt is useless: it was read whole, or its name is that of no file.
    pub fn is_input(&self) -> bool {
        match self {
            Error::Read { source, .. } => is_wrong_input(source),
            Error::Record { source, .. } | Error::ForeignRecord { source, .. } => !source.is_system_failure(),
            Error::NothingToRepair { .. }
            | Error::OtherManifest { .. }
            | Error::ForeignFile { .. }
            | Error::Misfits(_)
            | Error::NoSuchPage { .. }
            | Error::TooManyFiles { .. } => true,
            _ => false,
        }
    }
}

/// Whether a file that cannot be read is wrong or not there, and the system has not failed.
pub fn is_wrong_input(error: &io::Error) -> bool {
    // What was found in a file has no number of the system.
    let is_name = |kind| {
        use ErrorKind::{InvalidFilename, IsADirectory, NotADirectory, NotFound};
        matches!(kind, NotFound | NotADirectory | IsADirectory | InvalidFilename)
    };
    error.raw_os_error().is_none() || is_name(error.kind())
}

/// The numbers of the pages of a family that has so many.
fn pages_that_there_are(count: usize) -> String {
    match count {
        0 => "it has none, since `where` keeps no cell".to_owned(),
        1 => "its only page is 1".to_owned(),
        count => format!("its pages are numbered from 1 to {count}"),
    }
}

/// What to do about a record that cannot be read, and of which a part is needed.
fn other_families_remedy(error: &ReadError) -> &'static str {
    match error.is_system_failure() {
        true => "correct that and run it again",
        false => "rebuild it with --repair, without --only, or render all of them with --overwrite",
    }
}

/// What to do about a record that cannot be read.
fn record_remedy(error: &ReadError) -> &'static str {
    match error {
        ReadError::UnsupportedFormat { .. } => {
            "render with the version that wrote it, or into another folder with -o, or replace it with --overwrite"
        }
        error if error.is_system_failure() => "correct that and run it again",
        error if error.is_damage() => {
            "rebuild it from the files of the atlas with --repair, or write to another folder with -o, or replace what is \
             there with --overwrite"
        }
        _ => "write to another folder with -o, or replace what is there with --overwrite",
    }
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
        ErrorKind::NotFound => "its folder does not exist: create it, or name another",
        _ => "correct that and run it again: finished files are kept",
    }
}

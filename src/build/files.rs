use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::record::{FileRecord, ReadError, Run, RunningDigest};
use crate::render;

/// What went wrong with a file.
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
    #[error("cannot write {}: {source}", path.display())]
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
    /// A page makes no image.
    #[error("cannot draw {name}: {error}")]
    Image {
        /// The image.
        name: String,
        /// Why.
        error: render::PngError,
    },
}

/// The text of a manifest.
///
/// # Errors
/// A file that cannot be read, or is not text.
pub fn read_manifest(path: &Path) -> Result<String, Error> {
    let text = fs::read_to_string(path).map_err(|source| Error::Read { path: path.to_owned(), source })?;
    // A byte order mark is no part of a text: columns are counted without it.
    Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text))
}

/// Writes a file that must not exist yet.
///
/// # Errors
/// A file that exists already (`AlreadyExists`) or cannot be written.
pub fn write_new(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let written = fs::OpenOptions::new().write(true).create_new(true).open(path).and_then(|mut f| f.write_all(bytes));
    written.map_err(|source| Error::Write { path: path.to_owned(), source })
}

/// The record of an earlier run into a folder, if there was one.
pub(super) fn earlier_run(output: &Path) -> Result<Option<Run>, Error> {
    let path = output.join("run.json");
    match Run::read(&path) {
        Ok(run) => Ok(Some(run)),
        Err(ReadError::File(error)) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(source) => Err(Error::Record { path, source }),
    }
}

pub(super) fn create_folder(path: &Path) -> Result<(), Error> {
    fs::create_dir_all(path).map_err(|source| Error::Write { path: path.to_owned(), source })
}

/// Writes a file whole or not at all.
///
/// # Errors
/// A file that cannot be written; one that was there is then as it was.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let mut file = Growing::open(path.to_owned())?;
    file.put(bytes)?;
    file.keep()
}

/// A file that grows under another name and takes its own when it is finished; until then nothing is lost, and
/// nothing is left behind if it never is.
pub(super) struct Growing {
    path: PathBuf,
    file: io::BufWriter<NamedTempFile>,
    digest: RunningDigest,
}

impl Growing {
    /// A file that begins with a header.
    pub fn create(path: PathBuf, header: &str) -> Result<Growing, Error> {
        let mut file = Growing::open(path)?;
        file.append(header)?;
        Ok(file)
    }

    fn open(path: PathBuf) -> Result<Growing, Error> {
        let folder = path.parent().unwrap_or(Path::new("."));
        let mut builder = tempfile::Builder::new();
        builder.prefix(".coupler-atlas-").suffix(".tmp");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // A temporary file is its owner's alone; a result is for everyone the umask allows.
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        match builder.tempfile_in(folder) {
            Ok(file) => Ok(Growing { path, file: io::BufWriter::new(file), digest: RunningDigest::default() }),
            Err(source) => Err(Error::Write { path, source }),
        }
    }

    fn put(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.file.write_all(bytes).map_err(|source| Error::Write { path: self.path.clone(), source })
    }

    /// Adds text.
    pub fn append(&mut self, text: &str) -> Result<(), Error> {
        self.digest.add(text.as_bytes());
        self.put(text.as_bytes())
    }

    fn keep(self) -> Result<(), Error> {
        let Growing { path, file, .. } = self;
        let kept = file.into_inner().map_err(io::IntoInnerError::into_error).and_then(|file| {
            file.persist(&path).map_err(|error| error.error)?;
            Ok(())
        });
        kept.map_err(|source| Error::Write { path, source })
    }

    /// Gives the file its name.
    pub fn finish(self) -> Result<FileRecord, Error> {
        let name = self.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let record = self.digest.clone().record(name);
        self.keep()?;
        Ok(record)
    }
}

//! Reads and writes files; every file is written atomically.

use std::fs;
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

use tempfile::{PathPersistError, TempPath};

use super::Error;
use crate::record::is_intact_png;
use crate::record::{FileRecord, RunningDigest};

/// Reads the text of a manifest.
///
/// # Errors
/// The file cannot be read, or is not UTF-8 text.
pub fn read_manifest(path: &Path) -> Result<String, Error> {
    let text = fs::read_to_string(path).map_err(|source| Error::Read { path: path.to_owned(), source })?;
    // The byte order mark is not part of the text: columns are counted without it.
    Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text))
}

/// Writes a file that must not exist yet.
///
/// # Errors
/// The file exists already (`AlreadyExists`) or cannot be written; a failure leaves no new file.
pub fn write_new(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let mut file = AtomicFile::new(path.to_owned())?;
    file.write_bytes(bytes)?;
    file.persist_with(TempPath::persist_noclobber)
}

/// Opens a file for reading.
pub(super) fn open(path: &Path) -> io::Result<fs::File> {
    fs::File::open(path)
}

/// Creates a folder and its parents.
///
/// # Errors
/// The folder cannot be created.
pub fn create_folder(path: &Path) -> Result<(), Error> {
    fs::create_dir_all(path).map_err(|source| Error::Write { path: path.to_owned(), source })
}

/// Writes a file atomically.
///
/// # Errors
/// The file cannot be written; an existing file is then unchanged.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let mut file = AtomicFile::new(path.to_owned())?;
    file.write_bytes(bytes)?;
    file.persist_with(TempPath::persist)
}

/// Whether a file is as its record says. Text is compared by its digest. Images and books have no digest: an image must
/// be complete with correct checksums, and a book must be complete.
pub(super) fn is_intact(folder: &Path, record: &FileRecord) -> bool {
    let path = folder.join(&record.name);
    let is_file = fs::symlink_metadata(&path).is_ok_and(|metadata| metadata.is_file());
    let is_unchanged = || -> io::Result<bool> {
        let Some(sha256) = &record.sha256 else {
            let is_book = record.name.ends_with(".pdf");
            return if is_book { is_complete_pdf(&path) } else { Ok(is_intact_png(&fs::read(&path)?)) };
        };
        let mut file = fs::File::open(&path)?;
        let mut digest = RunningDigest::default();
        io::copy(&mut file, &mut digest)?;
        Ok(digest.finish() == *sha256)
    };
    is_file && is_unchanged().unwrap_or(false)
}

/// Whether a file ends with the end marker of a PDF.
fn is_complete_pdf(path: &Path) -> io::Result<bool> {
    const END: &[u8; 5] = b"%%EOF";
    let mut file = fs::File::open(path)?;
    let mut found = [0; END.len()];
    file.seek(io::SeekFrom::End(-(END.len() as i64)))?;
    file.read_exact(&mut found)?;
    Ok(found == *END)
}

/// Removes those files of a folder that exist. Symbolic links to folders or files are not followed and not removed.
pub(super) fn remove_files<'n>(folder: &Path, names: impl Iterator<Item = &'n str>) -> Result<(), Error> {
    if !is_folder(folder) {
        return Ok(());
    }
    for path in names.map(|name| folder.join(name)) {
        if fs::symlink_metadata(&path).is_ok_and(|metadata| metadata.is_file()) {
            fs::remove_file(&path).map_err(|source| Error::Write { path, source })?;
        }
    }
    Ok(())
}

/// Removes the temporary files that a killed run left in a folder and its subfolders; only this program gives files
/// such names. No other run may be writing there.
pub(super) fn remove_temporary_files(output: &Path) {
    for entry in entries(output) {
        if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            entries(&entry.path()).for_each(remove_if_temporary);
        } else {
            remove_if_temporary(entry);
        }
    }
}

/// The entries of a folder that can be read.
fn entries(folder: &Path) -> impl Iterator<Item = fs::DirEntry> {
    fs::read_dir(folder).into_iter().flatten().flatten()
}

fn remove_if_temporary(entry: fs::DirEntry) {
    let name = entry.file_name();
    let is_ours =
        name.to_str().is_some_and(|name| name.starts_with(TEMPORARY_AFFIXES.0) && name.ends_with(TEMPORARY_AFFIXES.1));
    if is_ours && entry.file_type().is_ok_and(|kind| kind.is_file()) {
        // A file that cannot be removed does no harm.
        let _ = fs::remove_file(entry.path());
    }
}

/// Whether a path is a folder, and not a symbolic link to one.
fn is_folder(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|metadata| metadata.is_dir())
}

/// The beginning and the end of the names of temporary files.
const TEMPORARY_AFFIXES: (&str, &str) = (".coupler-atlas-", ".tmp");

/// A file that is written under a temporary name and renamed when it is finished. Until then an existing file is
/// unchanged; the temporary file is removed if it is never finished.
pub(super) struct AtomicFile {
    path: PathBuf,
    file: io::BufWriter<fs::File>,
    /// The temporary name; the file is removed on drop unless it is renamed.
    temporary_path: TempPath,
    digest: RunningDigest,
}

impl AtomicFile {
    /// Creates a file that begins with a header.
    pub fn with_header(path: PathBuf, header: &str) -> Result<AtomicFile, Error> {
        let mut file = AtomicFile::new(path)?;
        file.append(header.as_bytes())?;
        Ok(file)
    }

    fn new(path: PathBuf) -> Result<AtomicFile, Error> {
        // A device or a pipe would be replaced by a file.
        if fs::metadata(&path).is_ok_and(|metadata| !metadata.is_file() && !metadata.is_dir()) {
            let source =
                io::Error::new(io::ErrorKind::InvalidInput, "it exists and is not a regular file; give another name");
            return Err(Error::Write { path, source });
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut builder = tempfile::Builder::new();
        builder.prefix(TEMPORARY_AFFIXES.0).suffix(TEMPORARY_AFFIXES.1);
        // `tempfile` makes files readable by their owner only; results get the permissions that the umask allows.
        match builder.make_in(folder, |path| fs::File::create_new(path)) {
            Ok(file) => {
                let (file, temporary_path) = file.into_parts();
                Ok(AtomicFile {
                    path,
                    file: io::BufWriter::new(file),
                    temporary_path,
                    digest: RunningDigest::default(),
                })
            }
            Err(source) => Err(Error::Write { path, source }),
        }
    }

    fn write_bytes(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.file.write_all(bytes).map_err(|source| Error::Write { path: self.path.clone(), source })
    }

    /// Appends text.
    pub fn append(&mut self, text: &[u8]) -> Result<(), Error> {
        self.digest.update(text);
        self.write_bytes(text)
    }

    /// The final name of the file.
    pub fn name(&self) -> String {
        self.path.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// Closes the file and renames it.
    fn persist_with(self, rename: fn(TempPath, PathBuf) -> Result<(), PathPersistError>) -> Result<(), Error> {
        let AtomicFile { path, file, temporary_path, .. } = self;
        let result = file.into_inner().map_err(io::IntoInnerError::into_error).and_then(|file| {
            drop(file);
            rename(temporary_path, path.clone()).map_err(|error| error.error)
        });
        result.map_err(|source| Error::Write { path, source })
    }

    /// Finishes the file, and returns its record.
    pub fn commit(self) -> Result<FileRecord, Error> {
        let record = self.digest.clone().into_file_record(self.name());
        self.persist_with(TempPath::persist)?;
        Ok(record)
    }
}

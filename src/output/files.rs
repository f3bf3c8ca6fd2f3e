use std::fs;
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

use tempfile::{PathPersistError, TempPath};

use super::Error;
use crate::record::is_intact_png;
use crate::record::{FileRecord, RunningDigest};

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
/// A file that exists already (`AlreadyExists`) or cannot be written; there is none then if there was none.
pub fn write_new(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let mut file = AtomicFile::new(path.to_owned())?;
    file.write_bytes(bytes)?;
    file.persist_with(TempPath::persist_noclobber)
}

/// A file to be read.
pub(super) fn open(path: &Path) -> io::Result<fs::File> {
    fs::File::open(path)
}

/// Makes a folder, and those it is in.
///
/// # Errors
/// A folder that cannot be made.
pub fn create_folder(path: &Path) -> Result<(), Error> {
    fs::create_dir_all(path).map_err(|source| Error::Write { path: path.to_owned(), source })
}

/// Writes a file whole or not at all.
///
/// # Errors
/// A file that cannot be written; one that was there is then as it was.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let mut file = AtomicFile::new(path.to_owned())?;
    file.write_bytes(bytes)?;
    file.persist_with(TempPath::persist)
}

/// Whether a file of a folder is what its record says: a text by its bytes; an image or a book, whose bytes no record has,
/// by being whole, an image also by the checksums in it.
pub(super) fn is_intact(folder: &Path, record: &FileRecord) -> bool {
    let path = folder.join(&record.name);
    let is_file = fs::symlink_metadata(&path).is_ok_and(|metadata| metadata.is_file());
    let holds = || -> io::Result<bool> {
        let Some(sha256) = &record.sha256 else {
            let is_book = record.name.ends_with(".pdf");
            return if is_book { is_complete_pdf(&path) } else { Ok(is_intact_png(&fs::read(&path)?)) };
        };
        let mut file = fs::File::open(&path)?;
        let mut digest = RunningDigest::default();
        io::copy(&mut file, &mut digest)?;
        Ok(digest.finish() == *sha256)
    };
    is_file && holds().unwrap_or(false)
}

/// Whether a book ends as none does that was cut short.
fn is_complete_pdf(path: &Path) -> io::Result<bool> {
    const END: &[u8; 5] = b"%%EOF";
    let mut file = fs::File::open(path)?;
    let mut found = [0; END.len()];
    file.seek(io::SeekFrom::End(-(END.len() as i64)))?;
    file.read_exact(&mut found)?;
    Ok(found == *END)
}

/// Removes files of a folder, those of them that are there. Neither the folder nor a file may be a link to another.
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

/// Removes what a run that was killed had begun to write in a folder and in those within it, whosever they are: what is
/// named so is nobody else's. No other run may be writing there.
pub(super) fn remove_temporary_files(output: &Path) {
    for entry in entries(output) {
        if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            entries(&entry.path()).for_each(remove_if_temporary);
        } else {
            remove_if_temporary(entry);
        }
    }
}

/// What is in a folder, as far as it can be read.
fn entries(folder: &Path) -> impl Iterator<Item = fs::DirEntry> {
    fs::read_dir(folder).into_iter().flatten().flatten()
}

fn remove_if_temporary(entry: fs::DirEntry) {
    let name = entry.file_name();
    let is_ours =
        name.to_str().is_some_and(|name| name.starts_with(TEMPORARY_AFFIXES.0) && name.ends_with(TEMPORARY_AFFIXES.1));
    if is_ours && entry.file_type().is_ok_and(|kind| kind.is_file()) {
        // One that cannot be removed is in nobody's way.
        let _ = fs::remove_file(entry.path());
    }
}

/// Whether a path is a folder itself, and no link to one.
fn is_folder(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|metadata| metadata.is_dir())
}

/// How the names of files begin and end that are not finished.
const TEMPORARY_AFFIXES: (&str, &str) = (".coupler-atlas-", ".tmp");

/// A file that grows under another name and takes its own when it is finished; until then nothing is lost, and
/// nothing is left behind if it never is.
pub(super) struct AtomicFile {
    path: PathBuf,
    file: io::BufWriter<fs::File>,
    /// Its other name, which goes with this unless it is exchanged for its own.
    temporary_path: TempPath,
    digest: RunningDigest,
}

impl AtomicFile {
    /// A file that begins with a header.
    pub fn with_header(path: PathBuf, header: &str) -> Result<AtomicFile, Error> {
        let mut file = AtomicFile::new(path)?;
        file.append(header.as_bytes())?;
        Ok(file)
    }

    fn new(path: PathBuf) -> Result<AtomicFile, Error> {
        // A device or a pipe would be replaced by a file.
        if fs::metadata(&path).is_ok_and(|metadata| !metadata.is_file() && !metadata.is_dir()) {
            let source = io::Error::new(io::ErrorKind::InvalidInput, "it is there, and is no file: name a file");
            return Err(Error::Write { path, source });
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut builder = tempfile::Builder::new();
        builder.prefix(TEMPORARY_AFFIXES.0).suffix(TEMPORARY_AFFIXES.1);
        // A temporary file would be its owner's alone; a result is for everyone the umask allows.
        match builder.make_in(folder, |path| fs::File::create_new(path)) {
            Ok(file) => {
                let (file, unfinished) = file.into_parts();
                Ok(AtomicFile {
                    path,
                    file: io::BufWriter::new(file),
                    temporary_path: unfinished,
                    digest: RunningDigest::default(),
                })
            }
            Err(source) => Err(Error::Write { path, source }),
        }
    }

    fn write_bytes(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.file.write_all(bytes).map_err(|source| Error::Write { path: self.path.clone(), source })
    }

    /// Adds text.
    pub fn append(&mut self, text: &[u8]) -> Result<(), Error> {
        self.digest.update(text);
        self.write_bytes(text)
    }

    /// The name it will have.
    pub fn name(&self) -> String {
        self.path.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// Closes the file and renames it.
    fn persist_with(self, rename: fn(TempPath, PathBuf) -> Result<(), PathPersistError>) -> Result<(), Error> {
        let AtomicFile { path, file, temporary_path: unfinished, .. } = self;
        let kept = file.into_inner().map_err(io::IntoInnerError::into_error).and_then(|file| {
            drop(file);
            rename(unfinished, path.clone()).map_err(|error| error.error)
        });
        kept.map_err(|source| Error::Write { path, source })
    }

    /// Gives the file its name.
    pub fn commit(self) -> Result<FileRecord, Error> {
        let record = self.digest.clone().into_file_record(self.name());
        self.persist_with(TempPath::persist)?;
        Ok(record)
    }
}

//! Reads and writes files; every file is written atomically.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use tempfile::{PathPersistError, TempPath};

use super::Error;
use super::temporary::{self, Temporary};
use crate::manifest::MAX_MANIFEST_BYTES;
use crate::record::{FileRecord, JOURNAL_FILE_NAME, LOCK_FILE_NAME, RUN_FILE_NAME, RunRecord, file_digest};

/// What is said of bytes that are no UTF-8.
const NO_TEXT: &str = "stream did not contain valid UTF-8";

/// Reads the text of a manifest: of a file, or of standard input if the name is `-`.
///
/// # Errors
/// The file cannot be read, is not a regular file, is too large, or is not UTF-8 text.
pub fn read_text(path: &Path) -> Result<String, Error> {
    let no_text =
        |_| Error::Read { path: path.to_owned(), source: io::Error::new(io::ErrorKind::InvalidData, NO_TEXT) };
    let text = String::from_utf8(read_bytes(path)?).map_err(no_text)?;
    // The byte order mark is not part of the text: columns are counted without it.
    Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text))
}

/// Reads a manifest or a path, which may be in any encoding: a file, or standard input if the name is `-`.
///
/// # Errors
/// The file cannot be read, is not a regular file, or is too large.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, Error> {
    let bytes = match path.as_os_str() == RunRecord::STANDARD_INPUT {
        true => read_limited(io::stdin().lock()),
        false => open_regular(path).and_then(read_limited),
    };
    bytes.map_err(|source| Error::Read { path: path.to_owned(), source })
}

/// Opens a file, which may be a link to one. Opening a pipe would wait for another program.
pub(crate) fn open_regular(path: &Path) -> io::Result<fs::File> {
    let metadata = fs::metadata(path)?;
    if !metadata.is_file() && !metadata.is_dir() {
        let message = "it is not a regular file; give a file, or `-` for standard input";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    }
    fs::File::open(path)
}

/// Reads at most [`MAX_MANIFEST_BYTES`].
fn read_limited(source: impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take(MAX_MANIFEST_BYTES as u64 + 1).read_to_end(&mut bytes)?;
    if bytes.len() > MAX_MANIFEST_BYTES {
        let message = format!("it has more than {MAX_MANIFEST_BYTES} bytes, the most that are read; divide it");
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    }
    Ok(bytes)
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
    file.commit()
}

/// Writes a file atomically, so that it outlives a failure of the machine.
///
/// # Errors
/// The file cannot be written; an existing file is then unchanged, or replaced by the whole new one.
pub(super) fn write_durably(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let mut file = AtomicFile::new(path.to_owned())?;
    file.write_bytes(bytes)?;
    file.commit_durably()
}

/// Hands the bytes of finished files to the disk, each once, and then their names. A file that is not there any more is left out.
///
/// # Errors
/// The disk does not take them.
pub(super) fn sync(paths: &BTreeSet<PathBuf>) -> Result<(), Error> {
    let sync_file = |path: &PathBuf| {
        // Windows hands on only what may be written.
        let synced = match fs::File::options().read(true).write(cfg!(windows)).open(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
            opened => opened.and_then(|file| file.sync_all()),
        };
        synced.map_err(|source| Error::Write { path: path.clone(), source })
    };
    paths.par_iter().try_for_each(sync_file)?;
    let folders: BTreeSet<&Path> = paths.iter().filter_map(|path| path.parent()).collect();
    folders.into_par_iter().try_for_each(sync_folder)
}

/// Hands the names of the files in a folder to the disk; on Windows they are with the files.
fn sync_folder(folder: &Path) -> Result<(), Error> {
    if cfg!(not(unix)) {
        return Ok(());
    }
    // An empty path is that of the current folder.
    let opened = fs::File::open(if folder.as_os_str().is_empty() { Path::new(".") } else { folder });
    match opened.and_then(|folder| folder.sync_all()) {
        // Some file systems do it by themselves, and refuse this.
        Err(error) if matches!(error.kind(), io::ErrorKind::InvalidInput | io::ErrorKind::Unsupported) => Ok(()),
        result => result.map_err(|source| Error::Write { path: folder.to_owned(), source }),
    }
}

/// Whether a file has the digest in its record; a record without a digest makes no claim.
pub(super) fn is_intact(folder: &Path, record: &FileRecord) -> bool {
    let recorded = record.sha256.or(record.image_sha256);
    recorded.is_some_and(|recorded| file_digest(&folder.join(&record.name)) == Ok(recorded))
}

/// Removes those files of a folder that exist, and their subfolders that are then empty. Symbolic links to folders or
/// files are not followed and not removed.
pub(super) fn remove_files<'n>(folder: &Path, names: impl Iterator<Item = &'n str>) -> Result<(), Error> {
    let mut subfolders = BTreeSet::new();
    for name in names {
        let path = folder.join(name);
        let Some(parent) = path.parent() else { continue };
        let is_in_folder = file_type(parent)?.is_some_and(|kind| kind.is_dir());
        if is_in_folder && file_type(&path)?.is_some_and(|kind| kind.is_file()) {
            fs::remove_file(&path).map_err(|source| Error::Write { path: path.clone(), source })?;
            if parent != folder {
                subfolders.insert(parent.to_owned());
            }
        }
    }
    for subfolder in subfolders {
        // A folder with other files is kept.
        let _ = fs::remove_dir(subfolder);
    }
    Ok(())
}

/// Removes the temporary files that a killed run left in a folder and its subfolders; only this program gives files
/// such names. `is_resumable` says whether the unfinished tables in the folder of a family are kept. No other run may be
/// writing there.
pub(super) fn remove_temporary_files(output: &Path, is_resumable: &dyn Fn(&str) -> bool) {
    remove_temporary_in(output, false);
    // A folder with a record of its own is another atlas, to which another run may be writing.
    let is_atlas = |folder: &Path| {
        [RUN_FILE_NAME, JOURNAL_FILE_NAME, LOCK_FILE_NAME].iter().any(|name| folder.join(name).exists())
    };
    for family in subfolders(output).filter(|folder| !is_atlas(folder)) {
        remove_temporary_in(&family, family.file_name().and_then(|name| name.to_str()).is_some_and(is_resumable));
        // Many pages are in subfolders of their own.
        subfolders(&family).for_each(|folder| remove_temporary_in(&folder, false));
    }
}

/// The entries of a folder that can be read.
pub(super) fn entries(folder: &Path) -> impl Iterator<Item = fs::DirEntry> {
    fs::read_dir(folder).into_iter().flatten().flatten()
}

/// The folders in a folder; links are not followed.
fn subfolders(folder: &Path) -> impl Iterator<Item = PathBuf> {
    entries(folder).filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_dir())).map(|entry| entry.path())
}

fn remove_temporary_in(folder: &Path, keeps_partial: bool) {
    let has_affixes = |name: &str, (begin, end): (&str, &str)| name.starts_with(begin) && name.ends_with(end);
    let is_temporary =
        |name: &str| has_affixes(name, TEMPORARY_AFFIXES) || has_affixes(name, PARTIAL_AFFIXES) && !keeps_partial;
    for entry in entries(folder) {
        let Ok(kind) = entry.file_type() else { continue };
        let is_named = |is_named: &dyn Fn(&str) -> bool| entry.file_name().to_str().is_some_and(is_named);
        if kind.is_file() && is_named(&is_temporary) {
            temporary::remove(&entry.path());
        } else if kind.is_dir() && is_named(&|name| has_affixes(name, TEMPORARY_AFFIXES)) {
            // That of a repair.
            temporary::remove_folder(&entry.path());
        }
    }
}

/// The size of a file in bytes; 0 if there is none.
pub(super) fn size(path: &Path) -> Result<u64, Error> {
    match fs::metadata(path) {
        Ok(metadata) => Ok(metadata.len()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(0),
        Err(source) => Err(Error::Read { path: path.to_owned(), source }),
    }
}

/// What has a path, where a link is not followed; `None` if nothing has.
fn file_type(path: &Path) -> Result<Option<fs::FileType>, Error> {
    match fs::symlink_metadata(path) {
        Ok(metadata) => Ok(Some(metadata.file_type())),
        Err(error) if matches!(error.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory) => Ok(None),
        Err(source) => Err(Error::Write { path: path.to_owned(), source }),
    }
}

/// The beginning and the end of the names of temporary files.
pub(super) const TEMPORARY_AFFIXES: (&str, &str) = (".coupler-atlas-", ".tmp");

/// The beginning and the end of the names of unfinished files that a later run may continue.
pub(super) const PARTIAL_AFFIXES: (&str, &str) = (".coupler-atlas-", ".partial");

/// Checks that a file may get this name. A device or a pipe would be replaced by a file.
pub(super) fn check_replaceable(path: &Path) -> Result<(), Error> {
    if fs::metadata(path).is_ok_and(|metadata| !metadata.is_file() && !metadata.is_dir()) {
        let source =
            io::Error::new(io::ErrorKind::InvalidInput, "it exists and is not a regular file; give another name");
        return Err(Error::Write { path: path.to_owned(), source });
    }
    Ok(())
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// A file that is written under a temporary name and renamed when it is finished. Until then an existing file is
/// unchanged; the temporary file is removed if it is never finished.
#[derive(Debug)]
pub(crate) struct AtomicFile {
    path: PathBuf,
    file: io::BufWriter<fs::File>,
    /// The temporary name; the file is removed on drop unless it is renamed.
    temporary: Temporary,
}

impl AtomicFile {
    pub fn new(path: PathBuf) -> Result<AtomicFile, Error> {
        AtomicFile::with_affixes(path, TEMPORARY_AFFIXES)
    }

    /// A file whose temporary name has this beginning and this end.
    pub fn with_affixes(path: PathBuf, (begin, end): (&str, &str)) -> Result<AtomicFile, Error> {
        check_replaceable(&path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut builder = tempfile::Builder::new();
        builder.prefix(begin).suffix(end);
        // `tempfile` makes files readable by their owner only; results get the permissions that the umask allows.
        match builder.make_in(folder, |path| fs::File::create_new(path)) {
            Ok(file) => {
                let (file, temporary_path) = file.into_parts();
                Ok(AtomicFile { path, file: io::BufWriter::new(file), temporary: Temporary::new(temporary_path) })
            }
            Err(source) => Err(Error::Write { path, source }),
        }
    }

    /// Appends bytes.
    pub fn write_bytes(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.file.write_all(bytes).map_err(|source| Error::Write { path: self.path.clone(), source })
    }

    /// Closes the file and renames it.
    pub fn commit(self) -> Result<(), Error> {
        self.persist_with(TempPath::persist)
    }

    /// Closes the file, hands its bytes to the disk, so that no failure of the machine leaves a part of it under its name,
    /// renames it, and hands the new name to the disk.
    pub fn commit_durably(mut self) -> Result<(), Error> {
        let synced = self.file.flush().and_then(|()| self.file.get_ref().sync_all());
        synced.map_err(|source| Error::Write { path: self.path.clone(), source })?;
        let folder = self.path.parent().unwrap_or(Path::new("")).to_owned();
        self.commit()?;
        sync_folder(&folder)
    }

    fn persist_with(self, rename: fn(TempPath, PathBuf) -> Result<(), PathPersistError>) -> Result<(), Error> {
        let AtomicFile { path, file, temporary } = self;
        let result = file.into_inner().map_err(io::IntoInnerError::into_error).and_then(|file| {
            drop(file);
            temporary.rename(&path, rename)
        });
        result.map_err(|source| Error::Write { path, source })
    }
}

//! A file that is written in steps, and continued by the next run if this one is killed.

use std::fs::{self, File};
use std::io::{self, BufWriter, Read, Seek, Write};
use std::path::{Path, PathBuf};

use super::files::{PARTIAL_AFFIXES, check_replaceable};
use super::{Error, temporary};
use crate::record::{FileRecord, PartialFile, RunningDigest, open_regular_file};

/// A file that is written under another name and renamed when it is finished. Until then an existing file of its final
/// name is unchanged. The unfinished file is removed on drop, unless it is kept for the next run.
pub(super) struct TableFile {
    path: PathBuf,
    partial_path: PathBuf,
    file: BufWriter<File>,
    digest: RunningDigest,
    bytes: u64,
    is_kept: bool,
}

impl TableFile {
    /// Creates a file that begins with a header.
    pub fn with_header(path: PathBuf, header: &str) -> Result<TableFile, Error> {
        check_replaceable(&path)?;
        let partial_path = partial_path(&path);
        // Whatever has this name is removed, not written through.
        let created = match fs::remove_file(&partial_path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => File::create_new(&partial_path),
        };
        let file = created.map_err(|source| Error::Write { path: path.clone(), source })?;
        let mut file = TableFile::new((path, partial_path), file, RunningDigest::default(), 0);
        file.append(header.as_bytes())?;
        Ok(file)
    }

    /// Opens the unfinished file of an earlier run, to continue after these bytes of it; `None` if they are not there.
    pub fn resume(path: PathBuf, written: &PartialFile) -> Option<TableFile> {
        let partial_path = partial_path(&path);
        check_replaceable(&path).ok()?;
        let mut digest = RunningDigest::default();
        let mut prefix = open_regular_file(&partial_path, u64::MAX).ok()?.take(written.bytes);
        let bytes = io::copy(&mut prefix, &mut digest).ok()?;
        if bytes != written.bytes || digest.clone().finish() != written.sha256 {
            return None;
        }
        let mut file = File::options().write(true).open(&partial_path).ok()?;
        file.set_len(bytes).ok()?;
        file.seek(io::SeekFrom::End(0)).ok()?;
        Some(TableFile::new((path, partial_path), file, digest, bytes))
    }

    fn new((path, partial_path): (PathBuf, PathBuf), file: File, digest: RunningDigest, bytes: u64) -> TableFile {
        TableFile { path, partial_path, file: BufWriter::new(file), digest, bytes, is_kept: false }
    }

    /// Appends text.
    pub fn append(&mut self, text: &[u8]) -> Result<(), Error> {
        self.digest.update(text);
        self.bytes += text.len() as u64;
        self.file.write_all(text).map_err(|source| Error::Write { path: self.path.clone(), source })
    }

    /// Hands all text to the system, so that it outlives this process, and describes it.
    pub fn flush(&mut self) -> Result<PartialFile, Error> {
        self.file.flush().map_err(|source| Error::Write { path: self.path.clone(), source })?;
        Ok(PartialFile { name: self.name(), bytes: self.bytes, sha256: self.digest.clone().finish() })
    }

    /// The final name of the file.
    pub fn name(&self) -> String {
        self.path.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// The text so far, to be read again after [`TableFile::flush`].
    pub fn reader(&self) -> Option<impl Read> {
        open_regular_file(&self.partial_path, u64::MAX).ok().map(|file| file.take(self.bytes))
    }

    /// Keeps the unfinished file for the next run.
    pub fn keep(mut self) {
        self.is_kept = self.file.flush().is_ok();
    }

    /// Renames the finished file, and returns its record.
    pub fn commit(mut self) -> Result<FileRecord, Error> {
        let PartialFile { name, sha256, .. } = self.flush()?;
        fs::rename(&self.partial_path, &self.path)
            .map_err(|source| Error::Write { path: self.path.clone(), source })?;
        self.is_kept = true;
        Ok(FileRecord::from_digest(name, sha256))
    }
}

impl Drop for TableFile {
    fn drop(&mut self) {
        if !self.is_kept {
            temporary::remove(&self.partial_path);
        }
    }
}

/// The name of a file while it is unfinished.
fn partial_path(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{}{name}{}", PARTIAL_AFFIXES.0, PARTIAL_AFFIXES.1))
}

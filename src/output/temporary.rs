//! Temporary files, and those that cannot be removed.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use tempfile::{PathPersistError, TempPath};

/// The temporary files of this process that could not be removed, with the reasons.
static LEFTOVERS: Mutex<Vec<(PathBuf, io::Error)>> = Mutex::new(Vec::new());

/// The temporary files that this process could not remove since the last call, with the reasons. They do no harm, and the
/// next run tries again.
pub fn take_leftovers() -> Vec<(PathBuf, io::Error)> {
    std::mem::take(&mut *LEFTOVERS.lock().unwrap_or_else(PoisonError::into_inner))
}

/// Removes a temporary file, if it is there.
pub(crate) fn remove(path: &Path) {
    note(path, fs::remove_file(path));
}

/// Removes a temporary folder, if it is there.
pub(super) fn remove_folder(path: &Path) {
    note(path, fs::remove_dir_all(path));
}

fn note(path: &Path, removed: io::Result<()>) {
    if let Err(error) = removed
        && error.kind() != io::ErrorKind::NotFound
    {
        LEFTOVERS.lock().unwrap_or_else(PoisonError::into_inner).push((path.to_owned(), error));
    }
}

/// A temporary file, which is removed on drop unless it is renamed.
#[derive(Debug)]
pub(super) struct Temporary(Option<TempPath>);

impl Temporary {
    /// Takes on the removal of a file.
    pub fn new(path: TempPath) -> Temporary {
        Temporary(Some(path))
    }

    /// Gives the file another name.
    ///
    /// # Errors
    /// Why it keeps its name, and is removed.
    pub fn rename(
        mut self,
        to: &Path,
        rename: fn(TempPath, PathBuf) -> Result<(), PathPersistError>,
    ) -> io::Result<()> {
        let Some(path) = self.0.take() else { return Ok(()) };
        rename(path, to.to_owned()).map_err(|PathPersistError { error, path }| {
            self.0 = Some(path);
            error
        })
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(path) = self.0.take().and_then(|path| path.keep().ok()) {
            remove(&path);
        }
    }
}

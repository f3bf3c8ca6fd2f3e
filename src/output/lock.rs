//! Locks a folder against other runs.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use same_file::Handle;

use super::{Error, temporary};
use crate::record::LOCK_FILE_NAME;

/// A lock on a folder: no other run writes to it until this is dropped.
#[derive(Debug)]
pub(crate) struct Lock {
    path: PathBuf,
    /// The lock is on the open file, so it ends with the process, however that ends; a file left behind locks nothing.
    /// `None` if the folder cannot be written: then there is nothing to protect.
    file: Option<File>,
    is_exclusive: bool,
}

impl Lock {
    /// Locks a folder.
    ///
    /// # Errors
    /// Another run has locked the folder; the lock file cannot be written.
    pub fn acquire(folder: &Path) -> Result<Lock, Error> {
        Lock::lock_file(folder.join(LOCK_FILE_NAME), false)
            .and_then(|lock| lock.ok_or_else(|| Error::Busy { folder: folder.to_owned() }))
    }

    /// Waits until no other run has locked a file, and locks it.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn wait_for(path: PathBuf) -> Result<Lock, Error> {
        // A run that waits always gets it.
        let unlocked = Lock { path: path.clone(), file: None, is_exclusive: false };
        Ok(Lock::lock_file(path, true)?.unwrap_or(unlocked))
    }

    /// Whether other runs are kept off: not where the file system has no locks, or the folder cannot be written.
    pub fn is_exclusive(&self) -> bool {
        self.is_exclusive
    }

    /// Locks a file; `None` if another run has locked it and this one does not wait.
    fn lock_file(path: PathBuf, waits: bool) -> Result<Option<Lock>, Error> {
        let failed = |source: io::Error| Error::Write { path: path.clone(), source };
        loop {
            let Some(file) = open(&path).map_err(failed)? else {
                return Ok(Some(Lock { path, file: None, is_exclusive: false }));
            };
            let locked = if waits { file.lock().map_err(TryLockError::Error) } else { file.try_lock() };
            match locked {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => return Ok(None),
                // Some file systems have no locks, and say so by different errors; runs there are not protected from
                // one another.
                Err(TryLockError::Error(_)) => return Ok(Some(Lock { path, file: Some(file), is_exclusive: false })),
            }
            // Another run may have ended and removed the file between our opening and locking it. The locked file is
            // then not the one that the next run will open.
            let locked = file.try_clone().and_then(Handle::from_file).map_err(failed)?;
            match Handle::from_path(&path) {
                Ok(current) if current == locked => {
                    return Ok(Some(Lock { path, file: Some(file), is_exclusive: true }));
                }
                Ok(_) => {}
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                Err(error) => return Err(failed(error)),
            }
        }
    }
}

/// Opens the lock file; `None` if it does not exist and cannot be created in this folder.
fn open(path: &Path) -> io::Result<Option<File>> {
    // Opening a pipe would wait for another program, and a link may lead to the file of another.
    if fs::symlink_metadata(path).is_ok_and(|metadata| !metadata.is_file()) {
        return Err(io::Error::new(io::ErrorKind::AlreadyExists, "it is not a regular file"));
    }
    let is_read_only =
        |error: &io::Error| matches!(error.kind(), io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem);
    match File::options().create(true).truncate(false).write(true).open(path) {
        Ok(file) => Ok(Some(file)),
        Err(error) if is_read_only(&error) => match File::open(path) {
            Ok(file) => Ok(Some(file)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(_) => Err(error),
        },
        Err(error) => Err(error),
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // The file is removed while it is still locked, so a run that opened it before notices that it is gone.
        if self.file.is_some() {
            temporary::remove(&self.path);
        }
    }
}

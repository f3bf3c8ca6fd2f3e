//! Locks a folder against other runs.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use same_file::Handle;

use super::Error;
use crate::record::LOCK_FILE_NAME;

/// A lock on a folder: no other run writes to it until this is dropped.
#[derive(Debug)]
pub(super) struct Lock {
    path: PathBuf,
    /// The lock is on the open file, so it ends with the process, however that ends; a file left behind locks nothing.
    _file: File,
}

impl Lock {
    /// Locks a folder.
    ///
    /// # Errors
    /// Another run has locked the folder; the lock file cannot be written.
    pub fn acquire(folder: &Path) -> Result<Lock, Error> {
        let path = folder.join(LOCK_FILE_NAME);
        let failed = |source: io::Error| Error::Write { path: path.clone(), source };
        loop {
            let file = File::options().create(true).truncate(false).write(true).open(&path).map_err(failed)?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => return Err(Error::Busy { folder: folder.to_owned() }),
                // Some file systems have no locks; runs there are not protected from one another.
                Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {}
                Err(TryLockError::Error(error)) => return Err(failed(error)),
            }
            // Another run may have ended and removed the file between our opening and locking it. The locked file is
            // then not the one that the next run will open.
            let locked = file.try_clone().and_then(Handle::from_file).map_err(failed)?;
            match Handle::from_path(&path) {
                Ok(current) if current == locked => return Ok(Lock { path, _file: file }),
                Ok(_) => {}
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                Err(error) => return Err(failed(error)),
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // The file is removed while it is still locked, so a run that opened it before notices that it is gone. A file
        // that cannot be removed does no harm.
        let _ = fs::remove_file(&self.path);
    }
}

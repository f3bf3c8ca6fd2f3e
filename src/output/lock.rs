use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use same_file::Handle;

use super::Error;
use crate::record::LOCK_FILE_NAME;

/// A folder that no other run writes to as long as this lives.
#[derive(Debug)]
pub(super) struct Lock {
    path: PathBuf,
    /// The lock is on the open file, so that it ends with the process however that ends; one that is left behind is
    /// no lock.
    _file: File,
}

impl Lock {
    /// Locks a folder.
    ///
    /// # Errors
    /// Another run that has locked it; a lock that cannot be written.
    pub fn acquire(folder: &Path) -> Result<Lock, Error> {
        let path = folder.join(LOCK_FILE_NAME);
        let failed = |source: io::Error| Error::Write { path: path.clone(), source };
        loop {
            let file = File::options().create(true).truncate(false).write(true).open(&path).map_err(failed)?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => return Err(Error::Busy { folder: folder.to_owned() }),
                // There are file systems without locks, and no other way to lock them.
                Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {}
                Err(TryLockError::Error(error)) => return Err(failed(error)),
            }
            // Between our opening it and locking it, another run may have ended and removed it: then what is locked is
            // no longer the file that the next run will find.
            let locked = file.try_clone().and_then(Handle::from_file).map_err(failed)?;
            match Handle::from_path(&path) {
                Ok(there) if there == locked => return Ok(Lock { path, _file: file }),
                Ok(_) => {}
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                Err(error) => return Err(failed(error)),
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Removed while it is still locked: whoever opened it before finds that it is gone. Where it cannot be removed
        // it does no harm.
        let _ = fs::remove_file(&self.path);
    }
}

//! Finds the tables of shards in folders.

use std::io;
use std::path::{Path, PathBuf};

use super::record::TableKind;
use super::{Error, TableFormat};
use crate::output;

/// The tables of cells in some folders.
#[derive(Debug, Default)]
pub(super) struct FoundTables {
    /// Their paths, in order in each folder.
    pub tables: Vec<PathBuf>,
    /// Folders in them that cannot be read, and why.
    pub unreadable: Vec<(PathBuf, io::Error)>,
}

impl FoundTables {
    /// Adds those in a folder and in the folders in it, which may be links.
    ///
    /// # Errors
    /// The folder cannot be read.
    pub fn add(&mut self, folder: &Path) -> Result<(), output::Error> {
        let failed = |source| output::Error::Read { path: folder.to_owned(), source };
        let mut found = Vec::new();
        for entry in folder.read_dir().map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            match path.metadata() {
                Ok(metadata) if metadata.is_dir() => {}
                // A link to nothing is no folder.
                Err(error) if error.kind() != io::ErrorKind::NotFound => {
                    self.unreadable.push((path, error));
                    continue;
                }
                _ => {
                    found.push(path);
                    continue;
                }
            }
            match path.read_dir().and_then(|entries| entries.map(|entry| Ok(entry?.path())).collect()) {
                Ok::<Vec<PathBuf>, _>(inner) => found.extend(inner),
                Err(error) => self.unreadable.push((path, error)),
            }
        }
        found.retain(|path| is_table(path));
        found.sort();
        self.tables.extend(found);
        Ok(())
    }
}

/// Whether a folder, or a folder in it, has tables of shards.
///
/// # Errors
/// The folder cannot be read.
pub fn has_tables(folder: &Path) -> Result<bool, Error> {
    let mut found = FoundTables::default();
    found.add(folder)?;
    Ok(!found.tables.is_empty())
}

/// Whether a path is that of a table of cells.
pub(super) fn is_table(path: &Path) -> bool {
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    let name = name.strip_prefix(TableKind::Cells.name()).unwrap_or_default();
    name.starts_with('-') && TableFormat::ALL.iter().any(|format| format.name() == extension)
}

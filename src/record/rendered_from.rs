//! The manifest of a rendered atlas.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::{FolderRecord, RUN_FILE_NAME, ReadError, RunRecord};
use crate::manifest::Plan;

/// Why it is not known from which manifest a folder was rendered.
#[derive(Debug, thiserror::Error)]
pub enum UnknownManifest {
    /// The system failed to read the record, so that nothing is known about the folder.
    #[error("cannot use {}: {source}", path.display())]
    Unreadable {
        /// The record.
        path: PathBuf,
        /// Why.
        source: ReadError,
    },
    /// It is no folder of an atlas.
    #[error("{} is not the folder of an atlas: {RUN_FILE_NAME}: {source}; name its manifest", folder.display())]
    NoAtlas {
        /// The folder.
        folder: PathBuf,
        /// What is wrong with the record.
        source: ReadError,
    },
    /// The manifest is not beside it.
    #[error(
        "{} was rendered from {}, which is not beside it, and its tables do not say what its linkages are: name the manifest",
        folder.display(),
        name.as_deref().unwrap_or("standard input")
    )]
    NotBeside {
        /// The folder.
        folder: PathBuf,
        /// The file name of the manifest; `None` if it had none.
        name: Option<String>,
    },
}

/// The manifest beside the folder of an atlas, and the record of the run that rendered it.
///
/// # Errors
/// It is no folder of an atlas, cannot be read, or its manifest is not beside it.
pub fn manifest_of(folder: &Path) -> Result<(PathBuf, RunRecord), UnknownManifest> {
    let record = FolderRecord::read(folder).map_err(|source| match source.is_system_failure() {
        true => UnknownManifest::Unreadable { path: folder.join(RUN_FILE_NAME), source },
        false => UnknownManifest::NoAtlas { folder: folder.to_owned(), source },
    })?;
    let run: RunRecord = record.run;
    let beside = |name: &String| -> Vec<PathBuf> {
        // As the folder was named, if that has a name before it.
        let as_named = folder.file_name().map(|_| folder.with_file_name(name));
        let absolute = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
        as_named.into_iter().chain(absolute.ancestors().skip(1).take(2).map(|parent| parent.join(name))).collect()
    };
    let path = run.manifest.iter().flat_map(beside).find(|path| may_be_file(path));
    match path {
        Some(path) => Ok((path, run)),
        None => Err(UnknownManifest::NotBeside { folder: folder.to_owned(), name: run.manifest }),
    }
}

/// Whether a file has a path, as far as the system says; where it fails to, reading the file says why.
fn may_be_file(path: &Path) -> bool {
    match path.metadata() {
        Ok(metadata) => metadata.is_file(),
        Err(error) => !matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory),
    }
}

/// Checks that an atlas has the families and cells of a manifest.
///
/// # Errors
/// A message with the folder and the path of the manifest.
pub fn check_families(folder: &Path, path: &Path, plan: &Plan, run: &RunRecord) -> Result<(), String> {
    let families = plan.families.iter().map(|planned| (&planned.family.id, planned.family.cell_count()));
    if families.eq(run.families.iter().map(|family| (&family.id, family.cells))) {
        return Ok(());
    }
    let (folder, path) = (folder.display(), path.display());
    Err(format!("{folder} does not have the families and cells of {path}: render it again, or name the manifest"))
}

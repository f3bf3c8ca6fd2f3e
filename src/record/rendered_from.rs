//! The manifest of a rendered atlas.

use std::path::{Path, PathBuf};

use super::{FolderRecord, RunRecord};
use crate::manifest::Plan;

/// The manifest beside the folder of an atlas, and the record of the run that rendered it.
///
/// # Errors
/// A message: it is no folder of an atlas, or its manifest is not beside it.
pub fn manifest_of(folder: &Path) -> Result<(PathBuf, RunRecord), String> {
    let shown = folder.display();
    let record = FolderRecord::read(folder)
        .map_err(|error| format!("{shown} is not the folder of an atlas: run.json: {error}; name its manifest"))?;
    let run: RunRecord = record.run;
    let beside = |name: &String| -> Vec<PathBuf> {
        // As the folder was named, if that has a name before it.
        let as_named = folder.file_name().map(|_| folder.with_file_name(name));
        let absolute = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
        as_named.into_iter().chain(absolute.ancestors().skip(1).take(2).map(|parent| parent.join(name))).collect()
    };
    let path = run.manifest.iter().flat_map(beside).find(|path| path.is_file());
    let Some(path) = path else {
        let name = run.manifest.as_deref().unwrap_or("standard input");
        return Err(format!(
            "{shown} was rendered from {name}, which is not beside it, and its tables do not say what its linkages are: name the manifest"
        ));
    };
    Ok((path, run))
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

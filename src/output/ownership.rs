//! Refuses to write where files of others would be lost: an atlas of another manifest, and files that no earlier run
//! wrote.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::previous_run::{DATA_FILES, PreviousRun, is_page_folder, is_volume_file_name, parse_page_number};
use super::{Error, Options, files};
use crate::gallery;
use crate::manifest::{Plan, PlannedFamily};
use crate::record::{FileRecord, IMAGES_FILE_NAME};
use coupler_drawing::render::Format;

/// Checks that a folder is free, or has an earlier atlas of the same manifest.
///
/// The manifest is the same if its file name is, and if its title is or all families of the earlier atlas are still in
/// it: a manifest may be given another title, but two manifests of one name and different contents may lie in different
/// folders.
///
/// # Errors
/// The folder has the atlas of another manifest.
pub(super) fn check_owner(plan: &Plan, output: &Path, options: &Options, previous: &PreviousRun) -> Result<(), Error> {
    let (Some(current), Some((manifest, title))) = (&options.manifest, &previous.owner) else { return Ok(()) };
    let planned: HashSet<&str> = plan.families.iter().map(|planned| planned.family.id.as_str()).collect();
    let is_same_atlas =
        *title == plan.title || previous.families.iter().all(|family| planned.contains(family.id.as_str()));
    if options.overwrite || current == manifest && is_same_atlas {
        return Ok(());
    }
    let (manifest, title) = (manifest.clone(), title.clone());
    Err(Error::OtherManifest { folder: output.to_owned(), manifest, title })
}

/// Checks that none of the files that a run may write exists, unless an earlier run wrote it.
///
/// # Errors
/// Such files exist, or the folder of a family is a link.
pub(super) fn check_files(plan: &Plan, output: &Path, options: &Options, previous: &PreviousRun) -> Result<(), Error> {
    let mut foreign = Vec::new();
    let is_selected = |planned: &&PlannedFamily| options.only.is_empty() || options.only.contains(&planned.family.id);
    let mut formats: HashSet<&'static str> = HashSet::new();
    for planned in plan.families.iter().filter(is_selected) {
        let family_formats = options.formats.as_ref().unwrap_or(&planned.formats);
        formats.extend(family_formats.iter().map(|format| format.name()));
        let record = previous.families.iter().find(|family| family.id == planned.family.id);
        let known = record.map(|record| record.files.as_slice()).unwrap_or_default();
        find_foreign_pages(&output.join(&planned.family.id), (planned, family_formats), known, &mut foreign);
    }
    let has_images = formats.contains(Format::Png.name()) || formats.contains(Format::Pdf.name());
    let known: HashSet<&str> =
        previous.book.iter().flat_map(|book| &book.files).map(|file| file.name.as_str()).collect();
    for entry in files::entries(output) {
        let name = entry.file_name().to_string_lossy().into_owned();
        let is_known = match name.as_str() {
            gallery::PAGE_FILE => previous.gallery.is_some(),
            gallery::KERNEL_FILE => previous.kernel.is_some(),
            IMAGES_FILE_NAME => previous.has_images_file || !has_images,
            name if is_volume_file_name(name) => known.contains(name) || !formats.contains(Format::Pdf.name()),
            _ => continue,
        };
        if is_foreign(&entry.path(), is_known) {
            foreign.push(entry.path());
        }
    }
    if options.overwrite {
        return foreign.iter().try_for_each(|path| remove_link(path));
    }
    foreign.sort();
    let count = foreign.len();
    match foreign.into_iter().next() {
        Some(first) => Err(Error::ForeignFile { first, others: count - 1 }),
        None => Ok(()),
    }
}

/// Adds the files in the folder of a family that have the names of its tables and pages but are not known.
fn find_foreign_pages(
    folder: &Path,
    (planned, formats): (&PlannedFamily, &[Format]),
    known: &[FileRecord],
    foreign: &mut Vec<PathBuf>,
) {
    if is_link(folder) {
        foreign.push(folder.to_owned());
        return;
    }
    let known: HashSet<&str> = known.iter().map(|file| file.name.as_str()).collect();
    let (family, most_pages) = (&planned.family.id, planned.max_pages());
    let is_written = |name: &str| {
        let page = |format| parse_page_number(family, name, format).filter(|&page| page <= most_pages);
        DATA_FILES.contains(&name)
            || gallery::is_data_file_name(name)
            || formats.iter().filter_map(|format| format.page_format()).any(|f| page(f).is_some())
    };
    let find = |folder: &Path, prefix: &str, foreign: &mut Vec<PathBuf>| {
        for entry in files::entries(folder) {
            let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
            if is_written(&name) && is_foreign(&entry.path(), known.contains(name.as_str())) {
                foreign.push(entry.path());
            }
        }
    };
    find(folder, "", foreign);
    for entry in files::entries(folder) {
        let name = entry.file_name().to_string_lossy().into_owned();
        if is_page_folder(&name) && is_link(&entry.path()) {
            foreign.push(entry.path());
        } else if is_page_folder(&name) {
            find(&entry.path(), &format!("{name}/"), foreign);
        }
    }
}

/// Whether an existing path is that of a file that no run wrote: a link, or a regular file that is not known. Folders and
/// devices are reported when they are to be replaced, which is not possible.
pub(super) fn is_foreign(path: &Path, is_known: bool) -> bool {
    is_link(path) || !is_known && fs::symlink_metadata(path).is_ok_and(|metadata| metadata.is_file())
}

pub(super) fn is_link(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|metadata| metadata.is_symlink())
}

/// Removes a link, so that a file or folder takes its place and nothing is written through it.
pub(super) fn remove_link(path: &Path) -> Result<(), Error> {
    if !is_link(path) {
        return Ok(());
    }
    fs::remove_file(path).map_err(|source| Error::Write { path: path.to_owned(), source })
}

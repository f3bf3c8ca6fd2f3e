//! What a folder may leave out: images and books, and the gallery. All of them are made again from the manifest, so that a
//! repository need keep only tables and pages.
//!
//! A kind is left out if the folder has none of its files. Images and books have their own record, `images.json`, which
//! says that they were there: with it, none may be missing.

use std::fs;
use std::path::Path;

use serde::Serialize;

use crate::gallery::{KERNEL_FILE, PAGE_FILE, is_data_file_name};
use crate::record::{FileError, FileRecord, FolderRecord, ImagesState, RunRecord, path_in_atlas};

/// The numbers of files that a record lists and that were not compared, because the folder has none of their kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// The images of pages.
    pub images: usize,
    /// The volumes of the book.
    pub volumes: usize,
    /// The files of the gallery: its page, its kernel, and the data of families.
    pub gallery_files: usize,
}

impl LeftOut {
    /// What the folder of a record leaves out, counted in the families `only`, or in the whole atlas if there are none;
    /// nothing where a run has not ended, whose files are yet to come.
    pub(super) fn of(record: &FolderRecord, folder: &Path, only: &[String]) -> LeftOut {
        if record.is_unfinished {
            return LeftOut::default();
        }
        let run = &record.run;
        let is_data_file = |file: &FileRecord| is_data_file_name(&file.name);
        // What the system fails to find is there: it fails to read it, too.
        let is_missing = |error| FileError::at(folder)(error) == FileError::NotFound;
        let is_absent = |name: &String| fs::symlink_metadata(folder.join(name)).is_err_and(is_missing);
        let volumes = file_names(run.book.iter().flat_map(|book| &book.files));
        // The page and its kernel have these names, also where the record has others or none.
        let page = [PAGE_FILE, KERNEL_FILE].map(str::to_owned);
        let has_images = record.images != ImagesState::Missing
            || !family_files(run, &[], FileRecord::is_image).iter().chain(&volumes).all(is_absent);
        let has_gallery = !page.iter().chain(&family_files(run, &[], is_data_file)).all(is_absent);
        // Of single families, neither the book nor the page is compared.
        let if_all = |files: usize| if only.is_empty() { files } else { 0 };
        let left_out = |is_left_out: bool, files: usize| if is_left_out { files } else { 0 };
        LeftOut {
            images: left_out(!has_images, family_files(run, only, FileRecord::is_image).len()),
            volumes: left_out(!has_images, if_all(volumes.len())),
            gallery_files: left_out(!has_gallery, if_all(page.len()) + family_files(run, only, is_data_file).len()),
        }
    }

    /// Whether images and books are left out.
    pub(super) fn leaves_images(self) -> bool {
        self.images + self.volumes > 0
    }

    /// Whether the gallery is left out.
    pub(super) fn leaves_gallery(self) -> bool {
        self.gallery_files > 0
    }
}

/// The names of files in the folder of an atlas.
fn file_names<'r>(files: impl IntoIterator<Item = &'r FileRecord>) -> Vec<String> {
    files.into_iter().map(|file| file.name.clone()).collect()
}

/// Certain files of the families `only`, or of all if there are none, by their paths in the folder of the atlas.
fn family_files(run: &RunRecord, only: &[String], is_one: fn(&FileRecord) -> bool) -> Vec<String> {
    let families = run.families.iter().filter(|family| only.is_empty() || only.contains(&family.id));
    let files = families.flat_map(|family| family.files.iter().map(move |file| (&family.id, file)));
    files.filter(|(_, file)| is_one(file)).map(|(id, file)| path_in_atlas(id, &file.name)).collect()
}

//! Rebuilds the record of a folder whose `run.json` is lost or damaged.
//!
//! Without a record nothing says which files a run wrote. Those are known by their bytes: a file is one of the atlas if it is
//! what the manifest makes now, or if the journal of a run that did not end or `images.json` has its digest. Nothing else is
//! touched.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::files::{self, TEMPORARY_AFFIXES};
use super::previous_run::{PreviousRun, sanitize};
use super::{Error, Event, Options, temporary};
use crate::record::{
    BookRecord, Digest, FamilyRecord, FileError, FileRecord, FolderRecord, IMAGES_FILE_NAME, RUN_FILE_NAME, ReadError,
    RunRecord, file_digest, path_in_atlas, read_images,
};

/// What an earlier run has left in a folder whose record is lost or damaged; `None` if its record can be read, or there is
/// nothing to rebuild it from because the folder is empty. `render` writes the atlas into a folder.
///
/// # Errors
/// That of `render`; no file of the folder is one of the atlas.
pub(super) fn recover(
    output: &Path,
    options: &Options,
    report: &mut dyn FnMut(Event),
    render: impl FnOnce(&Path, &Options, &mut dyn FnMut(Event)) -> Result<RunRecord, Error>,
) -> Result<Option<PreviousRun>, Error> {
    let source = match FolderRecord::read(output) {
        Err(error) if error.is_damage() => error,
        // Another error is found again when the record is needed.
        _ => return Ok(None),
    };
    files::remove_temporary_files(output, &|_| false);
    if others(output, &HashSet::new()).is_empty() && !output.join(RUN_FILE_NAME).exists() {
        return Ok(None);
    }
    let (begin, end) = TEMPORARY_AFFIXES;
    let folder = tempfile::Builder::new().prefix(begin).suffix(end).tempdir_in(output).map(tempfile::TempDir::keep);
    let folder = folder.map_err(|source| Error::Write { path: output.to_owned(), source })?;
    let fresh_options = Options { repair: false, overwrite: false, ..options.clone() };
    let fresh = render(&folder, &fresh_options, &mut |event| {
        // What is said of families is said again when the atlas is completed.
        if matches!(event, Event::Begin { .. } | Event::Page) {
            report(event);
        }
    });
    temporary::remove_folder(&folder);
    let evidence =
        Evidence::of(output).map_err(|source| Error::ForeignRecord { path: output.join(RUN_FILE_NAME), source })?;
    let (previous, files) = evidence.recover(fresh?);
    if files.is_empty() {
        return match source {
            ReadError::File(FileError::NotFound) => Ok(None),
            source => Err(Error::NothingToRepair { path: output.join(RUN_FILE_NAME), source }),
        };
    }
    let others = others(output, &files);
    report(Event::Rebuilt { record: &output.join(RUN_FILE_NAME), files: files.len(), others: &others });
    Ok(Some(previous))
}

/// What tells which files an earlier run wrote.
struct Evidence<'a> {
    output: &'a Path,
    /// What the journal of a run that did not end says.
    journal: PreviousRun,
    /// The digests of images and books as they were written, by their paths.
    images: HashMap<String, Digest>,
}

impl Evidence<'_> {
    /// # Errors
    /// The system fails to read the journal or the digests of images.
    fn of(output: &Path) -> Result<Evidence<'_>, ReadError> {
        let journal = match FolderRecord::read_without_run(output) {
            Ok(record) => sanitize(record),
            Err(error) if error.is_system_failure() => return Err(error),
            Err(_) => PreviousRun::default(),
        };
        Ok(Evidence { output, journal, images: read_images(output)?.0.into_iter().collect() })
    }

    /// What an earlier run has left, given the record of the same atlas in another folder, and the paths of its files.
    fn recover(self, fresh: RunRecord) -> (PreviousRun, HashSet<String>) {
        let families = self.families(&fresh);
        let book = self.book(fresh.book);
        let single = |fresh: Option<FileRecord>, known: &Option<FileRecord>| {
            fresh.or(known.clone()).and_then(|file| self.recover_file("", &file, known.as_ref()))
        };
        let gallery = single(fresh.gallery, &self.journal.gallery);
        let kernel = single(fresh.kernel, &self.journal.kernel);
        let others = book.iter().flat_map(|book| &book.files).chain(&gallery).chain(&kernel);
        let of_families =
            families.iter().flat_map(|family| family.files.iter().map(|file| path_in_atlas(&family.id, &file.name)));
        let files: HashSet<String> = of_families.chain(others.map(|file| file.name.clone())).collect();
        let is_empty = |name| fs::symlink_metadata(self.output.join(name)).is_ok_and(|metadata| metadata.len() == 0);
        let has_images_file = !self.images.is_empty() || is_empty(IMAGES_FILE_NAME);
        // The disk may not have the files of a run that did not end.
        let previous = PreviousRun {
            families,
            book,
            gallery,
            kernel,
            has_images_file,
            is_unfinished: true,
            ..PreviousRun::default()
        };
        (previous, files)
    }

    /// The families of the atlas, and those that only the journal has, with the files that were written.
    fn families(&self, fresh: &RunRecord) -> Vec<FamilyRecord> {
        let nothing = Vec::new();
        let recover = |family: &FamilyRecord, known: &Vec<FileRecord>| {
            let files = self.recover_files(&family.id, &family.files, known);
            let is_whole = family.files.iter().all(|file| files.contains(file));
            let inputs_sha256 = family.inputs_sha256.filter(|_| is_whole);
            FamilyRecord { inputs_sha256, files, ..family.without_files() }
        };
        let in_journal = |id: &str| self.journal.families.iter().find(|family| family.id == id);
        let of_atlas = fresh
            .families
            .iter()
            .map(|family| recover(family, in_journal(&family.id).map_or(&nothing, |known| &known.files)));
        let is_other = |family: &&FamilyRecord| fresh.families.iter().all(|fresh| fresh.id != family.id);
        let others = self.journal.families.iter().filter(is_other).map(|family| {
            let family = FamilyRecord { inputs_sha256: None, files: Vec::new(), ..family.clone() };
            recover(&family, in_journal(&family.id).map_or(&nothing, |known| &known.files))
        });
        of_atlas.chain(others).filter(|family| !family.files.is_empty()).collect()
    }

    fn book(&self, fresh: Option<BookRecord>) -> Option<BookRecord> {
        let known = self.journal.book.as_ref();
        let book = fresh.or_else(|| Some(BookRecord { inputs_sha256: None, ..known?.without_files() }))?;
        let files = self.recover_files("", &book.files, known.map_or(&[], |known| &known.files));
        let is_whole = book.files.iter().all(|file| files.contains(file));
        let inputs_sha256 = book.inputs_sha256.filter(|_| is_whole);
        (!files.is_empty()).then(|| BookRecord { inputs_sha256, files, ..book.without_files() })
    }

    /// The records of those files of a folder that were written: of the atlas as it is now, and further ones of the journal.
    fn recover_files(&self, folder: &str, fresh: &[FileRecord], known: &[FileRecord]) -> Vec<FileRecord> {
        let by_name: HashMap<&str, &FileRecord> = known.iter().map(|file| (file.name.as_str(), file)).collect();
        let current: HashSet<&str> = fresh.iter().map(|file| file.name.as_str()).collect();
        let further = known.iter().filter(|file| !current.contains(file.name.as_str()));
        let files: Vec<&FileRecord> = fresh.iter().chain(further).collect();
        let recover = |file: &&FileRecord| self.recover_file(folder, file, by_name.get(file.name.as_str()).copied());
        files.par_iter().filter_map(recover).collect()
    }

    /// The record of a file if it is that of the atlas now, or a run has written it; one of an earlier state is known by its
    /// name alone, and so is an empty one, which a failure of the machine leaves and which has nothing to lose.
    fn recover_file(&self, folder: &str, fresh: &FileRecord, known: Option<&FileRecord>) -> Option<FileRecord> {
        let path = path_in_atlas(folder, &fresh.name);
        let found = file_digest(&self.output.join(&path)).ok()?;
        let has_digest = |file: &&FileRecord| file.sha256.or(file.image_sha256) == Some(found);
        let is_written = || self.images.get(&path) == Some(&found) || found == Digest::of(b"");
        Some(fresh)
            .filter(has_digest)
            .or(known.filter(has_digest))
            .cloned()
            .or_else(|| is_written().then(|| FileRecord::from_name(&fresh.name)))
    }
}

/// The files of a folder, its subfolders and the subfolders of those that are neither a record nor among these, in order.
fn others(output: &Path, files: &HashSet<String>) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![(String::new(), 0)];
    while let Some((folder, depth)) = folders.pop() {
        for entry in files::entries(&output.join(&folder)) {
            let name = entry.file_name().to_string_lossy().into_owned();
            let path = path_in_atlas(&folder, &name);
            let is_record = name.starts_with(".coupler-atlas") || [RUN_FILE_NAME, IMAGES_FILE_NAME].contains(&&*path);
            if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                // Pages are at most in subfolders of a family's folder.
                folders.extend((depth < 2).then_some((path, depth + 1)));
            } else if !is_record && !files.contains(&path) {
                found.push(output.join(path));
            }
        }
    }
    found.sort();
    found
}

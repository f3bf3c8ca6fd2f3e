//! What is recorded in the folder of an atlas.

use std::collections::HashMap;
use std::io::{self, BufReader};
use std::path::Path;

use serde_json::Value;

use super::images::{IMAGES_FILE_NAME, ImageDigests, images_from_bytes, images_to_bytes};
use super::journal::{FamilyProgress, JournalReplay, path_in_atlas};
use super::regular_file::{FileError, open_regular_file, read_regular_file};
use super::run::{FileRecord, JOURNAL_FILE_NAME, MAX_RECORDED_FILES, RUN_FILE_NAME, ReadError, RunRecord};

/// The most bytes of a record: enough for all the files that a record may list.
const MAX_BYTES: u64 = 1 << 28;

/// What is recorded in the folder of an atlas.
#[derive(Debug)]
pub struct FolderRecord {
    /// The record of the run, with the digests of images and with what the journal of an unfinished run says.
    pub run: RunRecord,
    /// The state of `images.json`.
    pub images: ImagesState,
    /// How far an unfinished run has written the tables of families.
    pub progress: Vec<FamilyProgress>,
    /// The index of the finished pieces of the gallery's data of these families.
    pub pieces: HashMap<String, Vec<Value>>,
    /// Whether the last run did not end.
    pub is_unfinished: bool,
    /// Whether `run.json` is as it was written.
    pub is_as_written: bool,
}

/// The state of `images.json`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ImagesState {
    /// There is none.
    Missing,
    /// It is as it was written.
    Intact,
    /// It cannot be used, and why.
    Damaged(String),
}

impl FolderRecord {
    /// Reads the record of a folder.
    ///
    /// # Errors
    /// There is no record ([`FileError::NotFound`]), it cannot be read, is not a record of this format, or not as it was written.
    pub fn read(folder: &Path) -> Result<FolderRecord, ReadError> {
        let record = FolderRecord::read_altered(folder)?;
        if record.is_as_written { Ok(record) } else { Err(ReadError::Altered) }
    }

    /// Reads the record of a folder, to compare with it: nothing that it says may be relied on unless it
    /// [is as it was written](FolderRecord::is_as_written).
    ///
    /// # Errors
    /// There is no record ([`FileError::NotFound`]), it cannot be read, or it is not a record of this format.
    pub fn read_altered(folder: &Path) -> Result<FolderRecord, ReadError> {
        match read_regular_file(&folder.join(RUN_FILE_NAME), MAX_BYTES) {
            Ok(bytes) => {
                let (run, is_as_written) = RunRecord::from_bytes(check_size(&bytes)?)?;
                FolderRecord::with_run(folder, Some(run), is_as_written)
            }
            Err(FileError::NotFound) => FolderRecord::read_without_run(folder),
            Err(error) => Err(error.into()),
        }
    }

    /// Reads what a folder records besides `run.json`: the journal of an unfinished run.
    ///
    /// # Errors
    /// There is none ([`FileError::NotFound`]), or it cannot be read.
    pub fn read_without_run(folder: &Path) -> Result<FolderRecord, ReadError> {
        FolderRecord::with_run(folder, None, true)
    }

    fn with_run(folder: &Path, mut earlier: Option<RunRecord>, is_as_written: bool) -> Result<FolderRecord, ReadError> {
        let (mut digests, mut images) = read_images(folder)?;
        if let Some(run) = &mut earlier {
            for_each_image(run, |path, file| file.image_sha256 = digests.remove(path));
        }
        if !digests.is_empty() && earlier.is_some() {
            images = ImagesState::Damaged(format!("lists files that {RUN_FILE_NAME} does not"));
        }
        let journal_path = folder.join(JOURNAL_FILE_NAME);
        let journal = match open_regular_file(&journal_path, u64::MAX) {
            Ok(file) => Some(file),
            Err(FileError::NotFound) => None,
            Err(error) => return Err(ReadError::Journal(error)),
        };
        let is_unfinished = journal.is_some();
        let replay = match journal {
            Some(file) => JournalReplay::new(earlier, BufReader::new(file)),
            None => JournalReplay::new(earlier, io::empty()),
        };
        let replay = replay.map_err(|error| ReadError::Journal(FileError::at(&journal_path)(error)))?;
        let (run, progress, pieces) = replay.ok_or(FileError::NotFound)?.finish();
        Ok(FolderRecord { run, images, progress, pieces, is_unfinished, is_as_written })
    }
}

/// Reads `images.json`: the digests in it, and its state.
///
/// # Errors
/// The system fails to read it.
pub fn read_images(folder: &Path) -> Result<(ImageDigests, ImagesState), ReadError> {
    Ok(match read_regular_file(&folder.join(IMAGES_FILE_NAME), MAX_BYTES) {
        Ok(bytes) => match images_from_bytes(&bytes) {
            Some(digests) => (digests, ImagesState::Intact),
            None => (ImageDigests::new(), ImagesState::Damaged("is not what a run has written".to_owned())),
        },
        Err(FileError::NotFound) => (ImageDigests::new(), ImagesState::Missing),
        Err(error @ FileError::Unreadable { .. }) => return Err(ReadError::Images(error)),
        Err(error) => (ImageDigests::new(), ImagesState::Damaged(error.to_string())),
    })
}

/// Checks that a record does not list more files than memory is meant for.
fn check_size(bytes: &[u8]) -> Result<&[u8], ReadError> {
    // Every object begins with a brace; families and other objects are few.
    let objects = bytes.iter().filter(|&&byte| byte == b'{').count();
    if objects > MAX_RECORDED_FILES + MAX_RECORDED_FILES / 4 {
        return Err(ReadError::TooManyFiles { files: objects });
    }
    Ok(bytes)
}

/// The bytes of `images.json` for a record; `None` if the atlas has neither images nor books.
pub fn images_of_run(run: &mut RunRecord) -> Option<Vec<u8>> {
    let mut digests = ImageDigests::new();
    for_each_image(run, |path, file| digests.extend(file.image_sha256.map(|digest| (path.to_owned(), digest))));
    (!digests.is_empty()).then(|| images_to_bytes(&digests))
}

/// Calls a function with each image and book of a record, and its path in the folder of the atlas.
fn for_each_image(run: &mut RunRecord, mut receive: impl FnMut(&str, &mut FileRecord)) {
    for family in &mut run.families {
        for file in family.files.iter_mut().filter(|file| file.is_image()) {
            receive(&path_in_atlas(&family.id, &file.name), file);
        }
    }
    for file in run.book.iter_mut().flat_map(|book| &mut book.files) {
        let path = file.name.clone();
        receive(&path, file);
    }
}

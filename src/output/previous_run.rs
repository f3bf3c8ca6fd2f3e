//! Reads the record of an earlier run. The file is not trusted: entries that this program cannot have written are
//! dropped.

use std::collections::HashMap;
use std::io;
use std::ops::Range;
use std::path::Path;

use rayon::prelude::*;
use serde_json::Value;

use super::{Error, Event, Options, files};
use crate::gallery;
use crate::pipeline::page_file_name;
use crate::record::{
    BookRecord, Digest, FamilyProgress, FamilyRecord, FileError, FileRecord, FolderRecord, ImagesState, RUN_FILE_NAME,
    ReadError, RunRecord, has_images,
};
#[cfg(feature = "pdf")]
use coupler_drawing::page::book::Volume;
use coupler_drawing::render::PageFormat;

/// The files that every family has: its tables, and the head of its data for the gallery.
pub(super) const DATA_FILES: [&str; 3] = ["cells.csv", "points.csv", gallery::SCRIPT_FILE];

/// The page number in the name of a page's file; `None` if it is not such a name. The name may begin with the name of a
/// subfolder of pages.
pub(super) fn parse_page_number(family: &str, name: &str, format: PageFormat) -> Option<usize> {
    let name = match name.split_once('/') {
        Some((folder, name)) if is_page_folder(folder) => name,
        Some(_) => return None,
        None => name,
    };
    let number = name.strip_prefix(family)?.strip_prefix('-')?.strip_suffix(format.name())?.strip_suffix('.')?;
    let is_number = number.len() >= 3 && number.bytes().all(|b| b.is_ascii_digit());
    if is_number { number.parse().ok() } else { None }
}

/// Whether a folder has the name of a subfolder of pages, as in `1001-2000`.
pub(super) fn is_page_folder(name: &str) -> bool {
    let is_number = |number: &str| number.len() >= 4 && number.bytes().all(|b| b.is_ascii_digit());
    name.split_once('-').is_some_and(|(first, last)| is_number(first) && is_number(last))
}

/// The file name of a volume, or of the book if it has only one.
#[cfg(feature = "pdf")]
pub(super) fn volume_name(volume: &Volume) -> String {
    let Volume { number, volume_count, .. } = *volume;
    match volume_count.to_string().len() {
        _ if volume_count == 1 => "atlas.pdf".to_owned(),
        digits => format!("atlas-{number:0digits$}.pdf"),
    }
}

/// What an earlier run has left in a folder.
#[derive(Debug, Default)]
pub(super) struct PreviousRun {
    /// The file name of its manifest, and the atlas's title; `None` if there was no run, or an older one, which did not
    /// record the manifest.
    pub owner: Option<(String, String)>,
    /// The records of its families.
    pub families: Vec<FamilyRecord>,
    /// The record of its book.
    pub book: Option<BookRecord>,
    /// The record of the gallery's page.
    pub gallery: Option<FileRecord>,
    /// The record of the script with its kernel.
    pub kernel: Option<FileRecord>,
    /// How far a run that did not end has written the tables of families.
    pub progress: Vec<FamilyProgress>,
    /// The index of the finished pieces of the gallery's data of these families.
    pub pieces: HashMap<String, Vec<Value>>,
    /// Whether it has written `images.json`.
    pub has_images_file: bool,
    /// Whether it did not end, so that the disk may not have its files yet.
    pub is_unfinished: bool,
}

/// Reads the record of an earlier run, if there is one. It is needed if the run leaves some families as they are.
///
/// # Errors
/// The record cannot be used, or has another format, and must not be overwritten.
pub(super) fn read(output: &Path, options: &Options, report: &mut dyn FnMut(Event)) -> Result<PreviousRun, Error> {
    let path = output.join(RUN_FILE_NAME);
    match FolderRecord::read(output) {
        Ok(record) => Ok(sanitize(record)),
        Err(ReadError::File(FileError::NotFound)) => Ok(PreviousRun::default()),
        // A folder cannot be overwritten.
        Err(ReadError::File(FileError::NotAFile("a folder"))) => {
            Err(Error::Write { path, source: io::ErrorKind::IsADirectory.into() })
        }
        Err(source @ ReadError::UnsupportedFormat { .. }) if !options.only.is_empty() => {
            Err(Error::ForeignRecord { path, source })
        }
        Err(source) if !options.only.is_empty() => Err(Error::Record { path, source }),
        Err(error) if options.overwrite => {
            report(Event::UnusableRecord { record: &path, error: &error });
            Ok(PreviousRun::default())
        }
        Err(source) => Err(Error::ForeignRecord { path, source }),
    }
}

impl PreviousRun {
    /// Adds what shards have recorded of pages: the record of a file replaces an earlier one. A family of which a page has changed
    /// is no longer made from the inputs of the earlier run as a whole.
    pub fn add_pages(&mut self, run: RunRecord) {
        let progress = Vec::new();
        let added = sanitize(FolderRecord {
            run,
            images: ImagesState::Missing,
            progress,
            pieces: HashMap::new(),
            is_unfinished: true,
            is_as_written: true,
        });
        self.is_unfinished = true;
        for family in added.families {
            match self.families.iter_mut().find(|known| known.id == family.id) {
                None => self.families.push(FamilyRecord { inputs_sha256: None, ..family }),
                Some(known) => {
                    let mut places: HashMap<String, usize> =
                        known.files.iter().enumerate().map(|(k, file)| (file.name.clone(), k)).collect();
                    for file in family.files {
                        match places.get(&file.name) {
                            Some(place) if known.files[*place] == file => continue,
                            Some(place) => known.files[*place] = file,
                            None => {
                                places.insert(file.name.clone(), known.files.len());
                                known.files.push(file);
                            }
                        }
                        known.inputs_sha256 = None;
                    }
                }
            }
        }
    }
}

/// Drops repeated or invalid families from a record, and files whose names this program does not use.
pub(super) fn sanitize(record: FolderRecord) -> PreviousRun {
    let FolderRecord { run, images, progress, pieces, is_unfinished, .. } = record;
    let RunRecord { manifest, title, families, mut book, gallery, kernel, .. } = run;
    let is_slug = |id: &str| {
        let is_plain = |b: u8| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-';
        !id.is_empty() && id.bytes().all(is_plain)
    };
    let mut unique: Vec<FamilyRecord> = Vec::new();
    let mut indices: HashMap<String, usize> = HashMap::new();
    for mut family in families.into_iter().filter(|family| is_slug(&family.id)) {
        let id = family.id.clone();
        family.files.retain(|file| is_family_file_name(&id, &file.name));
        match indices.get(&id) {
            // Of a repeated family, only the names of its files are used.
            Some(&index) => {
                let names = family.files.iter().map(|file| FileRecord::from_name(&file.name));
                unique[index].files.extend(names);
            }
            None => {
                indices.insert(id, unique.len());
                unique.push(family);
            }
        }
    }
    let families = unique;
    if let Some(book) = &mut book {
        book.files.retain(|file| is_volume_file_name(&file.name));
    }
    let gallery = gallery.filter(|file| file.name == gallery::PAGE_FILE);
    let kernel = kernel.filter(|file| file.name == gallery::KERNEL_FILE);
    let has_images_file = images == ImagesState::Intact || manifest.is_some() && has_images(&families, book.as_ref());
    let owner = manifest.map(|manifest| (manifest, title));
    PreviousRun { owner, families, book, gallery, kernel, progress, pieces, has_images_file, is_unfinished }
}

/// Whether a file of a family can have this name.
fn is_family_file_name(family: &str, name: &str) -> bool {
    DATA_FILES.contains(&name)
        || gallery::is_data_file_name(name)
        || PageFormat::ALL.into_iter().any(|format| parse_page_number(family, name, format).is_some())
}

/// Sorts the records of a family's files: its tables and data, then its pages by number and format. The order does not
/// depend on the runs that wrote them.
pub(super) fn sort_files(family: &str, files: &mut [FileRecord]) {
    files.sort_by_cached_key(|file| {
        let page = PageFormat::ALL
            .into_iter()
            .zip(0..)
            .find_map(|(format, order)| Some((parse_page_number(family, &file.name, format)?, order)));
        let table = DATA_FILES.iter().position(|name| *name == file.name).unwrap_or(DATA_FILES.len());
        (page, table, file.name.clone())
    });
}

/// Whether a family is made from these inputs, and some of its pages, from 0, are intact in these formats.
pub(super) fn has_pages(
    record: &FamilyRecord,
    inputs: Digest,
    (pages, formats): (Range<usize>, &[PageFormat]),
    folder: &Path,
) -> bool {
    let known: HashMap<&str, &FileRecord> = record.files.iter().map(|file| (file.name.as_str(), file)).collect();
    let is_intact = |page: usize, format: PageFormat| {
        let file = known.get(page_file_name(&record.id, page + 1, record.pages, format).as_str());
        file.is_some_and(|file| file.inputs_sha256.is_some() && files::is_intact(folder, file))
    };
    record.inputs_sha256 == Some(inputs)
        && pages.into_par_iter().all(|page| formats.iter().all(|&format| is_intact(page, format)))
}

/// Whether a volume can have this file name.
pub(super) fn is_volume_file_name(name: &str) -> bool {
    let number = name.strip_prefix("atlas-").and_then(|rest| rest.strip_suffix(".pdf"));
    let is_number = |number: &str| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit());
    name == "atlas.pdf" || number.is_some_and(is_number)
}

/// The record of a family, restricted to these formats; `None` unless all its files are intact and made from these
/// inputs.
pub(super) fn unchanged_record(
    earlier: &FamilyRecord,
    inputs: Digest,
    formats: &[PageFormat],
    folder: &Path,
) -> Option<FamilyRecord> {
    if earlier.inputs_sha256 != Some(inputs) {
        return None;
    }
    let known: std::collections::HashMap<&str, &FileRecord> =
        earlier.files.iter().map(|file| (file.name.as_str(), file)).collect();
    let tables = DATA_FILES.iter().map(|name| known.get(name).filter(|file| file.sha256.is_some()));
    let pieces = earlier.files.iter().filter(|file| gallery::parse_piece_file_name(&file.name).is_some());
    let pieces = pieces.map(|file| known.get(file.name.as_str()).filter(|file| file.sha256.is_some()));
    let page = |page| formats.iter().map(move |&format| (page, format));
    let pages = (1..=earlier.pages).flat_map(page).map(|(page, format)| {
        known
            .get(page_file_name(&earlier.id, page, earlier.pages, format).as_str())
            .filter(|file| file.inputs_sha256.is_some())
    });
    // `collect` stops at the first file that is not in the record.
    let expected: Option<Vec<&FileRecord>> = tables.chain(pieces).chain(pages).map(|file| file.copied()).collect();
    let expected = expected?;
    let all_intact = expected.par_iter().all(|file| files::is_intact(folder, file));
    all_intact.then(|| FamilyRecord { files: expected.into_iter().cloned().collect(), ..earlier.clone() })
}

//! Reads the record of an earlier run. The file is not trusted: entries that this program cannot have written are
//! dropped.

use std::io;
use std::path::Path;

use rayon::prelude::*;

use super::{Error, Event, files};
use crate::gallery;
use crate::pipeline::page_file_name;
use crate::record::{FamilyRecord, FileRecord, ReadError, RunRecord};
#[cfg(feature = "pdf")]
use coupler_drawing::page::book::Volume;
use coupler_drawing::render::PageFormat;

/// The files that every family has: its tables, and its data for the gallery.
const DATA_FILES: [&str; 3] = ["cells.csv", "points.csv", gallery::SCRIPT_FILE];

/// The page number in the name of a page's file; `None` if it is not such a name.
pub(super) fn parse_page_number(family: &str, name: &str, format: PageFormat) -> Option<usize> {
    let number = name.strip_prefix(family)?.strip_prefix('-')?.strip_suffix(format.name())?.strip_suffix('.')?;
    let is_number = number.len() >= 3 && number.bytes().all(|b| b.is_ascii_digit());
    if is_number { number.parse().ok() } else { None }
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

/// Reads the record of an earlier run, if there is one. It is needed if the run leaves some families as they are.
///
/// # Errors
/// The record is needed and cannot be used, or has another format and must not be overwritten.
pub(super) fn read(output: &Path, is_needed: bool, report: &mut dyn FnMut(Event)) -> Result<Option<RunRecord>, Error> {
    let path = output.join("run.json");
    match RunRecord::read(&path) {
        Ok(run) => Ok(Some(sanitize(run))),
        Err(ReadError::Io(error)) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(source @ ReadError::UnsupportedFormat { .. }) => Err(Error::Format { path, source }),
        Err(source) if is_needed => Err(Error::Record { path, source }),
        Err(error) => {
            report(Event::UnusableRecord { record: &path, error: &error });
            Ok(None)
        }
    }
}

/// Drops repeated or invalid families from a record, and files whose names this program does not use.
fn sanitize(mut run: RunRecord) -> RunRecord {
    let is_slug = |id: &str| {
        let is_plain = |b: u8| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-';
        !id.is_empty() && id.bytes().all(is_plain)
    };
    let mut ids = Vec::new();
    run.families.retain(|family| {
        let is_first = !ids.contains(&family.id);
        ids.push(family.id.clone());
        is_first && is_slug(&family.id)
    });
    run.gallery = run.gallery.filter(|file| file.name == gallery::PAGE_FILE);
    if let Some(book) = &mut run.book {
        book.files.retain(|file| is_volume_file_name(&file.name));
    }
    for family in &mut run.families {
        let id = family.id.clone();
        family.files.retain(|file| is_family_file_name(&id, &file.name));
    }
    run
}

/// Whether a file of a family can have this name.
fn is_family_file_name(family: &str, name: &str) -> bool {
    DATA_FILES.contains(&name)
        || PageFormat::ALL.into_iter().any(|format| parse_page_number(family, name, format).is_some())
}

/// Whether a volume can have this file name.
fn is_volume_file_name(name: &str) -> bool {
    let number = name.strip_prefix("atlas-").and_then(|rest| rest.strip_suffix(".pdf"));
    let is_number = |number: &str| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit());
    name == "atlas.pdf" || number.is_some_and(is_number)
}

/// The record of a family, restricted to these formats; `None` unless all its files are intact and made from these
/// inputs.
pub(super) fn unchanged_record(
    earlier: &FamilyRecord,
    inputs: &str,
    formats: &[PageFormat],
    folder: &Path,
) -> Option<FamilyRecord> {
    if earlier.inputs_sha256.as_deref() != Some(inputs) {
        return None;
    }
    let known: std::collections::HashMap<&str, &FileRecord> =
        earlier.files.iter().map(|file| (file.name.as_str(), file)).collect();
    let tables = DATA_FILES.iter().map(|name| known.get(name).filter(|file| file.sha256.is_some()));
    let page = |page| formats.iter().map(move |&format| (page, format));
    let pages = (1..=earlier.pages).flat_map(page).map(|(page, format)| {
        known.get(page_file_name(&earlier.id, page, format).as_str()).filter(|file| file.inputs_sha256.is_some())
    });
    // `collect` stops at the first file that is not in the record.
    let expected: Option<Vec<&FileRecord>> = tables.chain(pages).map(|file| file.copied()).collect();
    let expected = expected?;
    let all_intact = expected.par_iter().all(|file| files::is_intact(folder, file));
    all_intact.then(|| FamilyRecord { files: expected.into_iter().cloned().collect(), ..earlier.clone() })
}

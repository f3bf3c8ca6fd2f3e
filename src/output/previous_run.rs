//! What an earlier run left in a folder, as its record tells. A record is a file that anyone may have written: nothing
//! is made of it but what this program could have put there.

use std::io;
use std::path::Path;

use rayon::prelude::*;

use super::{Error, Event, files};
use crate::gallery;
use crate::pipeline::page_file_name;
use crate::record::{FamilyRecord, FileRecord, ReadError, RunRecord};
use coupler_drawing::page::book::Volume;
use coupler_drawing::render::PageFormat;

/// The tables of a family, which every one has, and its data for the gallery.
const DATA_FILES: [&str; 3] = ["cells.csv", "points.csv", gallery::SCRIPT_FILE];

/// The number of a page, from its name.
pub(super) fn parse_page_number(family: &str, name: &str, format: PageFormat) -> Option<usize> {
    let number = name.strip_prefix(family)?.strip_prefix('-')?.strip_suffix(format.name())?.strip_suffix('.')?;
    let is_number = number.len() >= 3 && number.bytes().all(|b| b.is_ascii_digit());
    if is_number { number.parse().ok() } else { None }
}

/// The name of the book, or of a volume of it.
pub(super) fn volume_name(volume: &Volume) -> String {
    let Volume { number, volume_count: of, .. } = *volume;
    match of.to_string().len() {
        _ if of == 1 => "atlas.pdf".to_owned(),
        digits => format!("atlas-{number:0digits$}.pdf"),
    }
}

/// The record of an earlier run, if there was one. Where other families are to stay as they are it must be a good one.
///
/// # Errors
/// A record that is needed and cannot be used; one of another format, which is not to be written over.
pub(super) fn read(output: &Path, is_needed: bool, tell: &mut dyn FnMut(Event)) -> Result<Option<RunRecord>, Error> {
    let path = output.join("run.json");
    match RunRecord::read(&path) {
        Ok(run) => Ok(Some(sanitize(run))),
        Err(ReadError::Io(error)) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(source @ ReadError::UnsupportedFormat { .. }) => Err(Error::Format { path, source }),
        Err(source) if is_needed => Err(Error::Record { path, source }),
        Err(error) => {
            tell(Event::UnusableRecord { record: &path, error: &error });
            Ok(None)
        }
    }
}

/// A record without what is no name of a file in a family's folder.
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

/// Whether this program gives such a name to a file of a family.
fn is_family_file_name(family: &str, name: &str) -> bool {
    DATA_FILES.contains(&name)
        || PageFormat::ALL.into_iter().any(|format| parse_page_number(family, name, format).is_some())
}

/// Whether this program gives such a name to a volume.
fn is_volume_file_name(name: &str) -> bool {
    let number = name.strip_prefix("atlas-").and_then(|rest| rest.strip_suffix(".pdf"));
    let is_number = |number: &str| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit());
    name == "atlas.pdf" || number.is_some_and(is_number)
}

/// The record of a family all of whose files are as they would be if they were made from these inputs now: those it
/// has in these formats.
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
    // A record that has not all of them ends this at the first that it has not.
    let expected: Option<Vec<&FileRecord>> = tables.chain(pages).map(|file| file.copied()).collect();
    let expected = expected?;
    let all_intact = expected.par_iter().all(|file| files::is_intact(folder, file));
    all_intact.then(|| FamilyRecord { files: expected.into_iter().cloned().collect(), ..earlier.clone() })
}

//! Compares what `run.json` says of an atlas, its families and its files with the manifest.

use std::collections::HashSet;

use super::family::CellCounts;
use super::finding::{Change, Finding, Location};
use crate::gallery::{SCRIPT_FILE, is_data_file_name};
use crate::manifest::{Plan, PlannedFamily};
use crate::pipeline::{FamilyPipeline, Inputs, page_file_name};
use crate::record::{FamilyRecord, FolderRecord, RUN_FILE_NAME, ReadError, RunRecord};
use coupler_drawing::render::{Format, PageFormat};

/// What is said of an `inputs_sha256` that is another one than that of the manifest.
const OTHER_INPUTS: &str =
    "states other inputs (inputs_sha256) than those of the manifest: `render` records them again";

/// The finding on a record that is not as this program has written it.
pub(super) fn check_origin(FolderRecord { run, is_as_written, .. }: &FolderRecord) -> Option<Finding> {
    let message = if !is_as_written {
        format!("{}: `render --repair` rebuilds it", ReadError::Altered)
    } else if run.program != env!("CARGO_PKG_NAME") {
        format!(
            "it was written by {}, not by {}: `render` records the atlas again",
            run.program,
            env!("CARGO_PKG_NAME")
        )
    } else {
        return None;
    };
    Some(Location::default().with_file(RUN_FILE_NAME).finding(Change::Damaged { message }))
}

/// The finding on the record of an atlas whose files are as recorded, if it does not say what they are made from.
pub(super) fn check_atlas(plan: &Plan, record: &RunRecord) -> Option<Finding> {
    let message = match record.title == plan.title {
        false => format!("has the title {:?}, expected {:?}", record.title, plan.title),
        true if !has_inputs_of_book(plan, record) => format!("the book: {OTHER_INPUTS}"),
        true => return None,
    };
    Some(Location::default().with_file(RUN_FILE_NAME).finding(Change::Damaged { message }))
}

/// Whether a recorded book may be that of the manifest: of the families that are in it, or of all. A run with `--formats` may
/// make a book of any families where the manifest asks for none.
fn has_inputs_of_book(plan: &Plan, record: &RunRecord) -> bool {
    let Some(book) = &record.book else { return true };
    let all: Vec<&PlannedFamily> = plan.families.iter().collect();
    let selected: Vec<&PlannedFamily> =
        all.iter().copied().filter(|planned| planned.formats.contains(&Format::Pdf)).collect();
    let is_made_from = |families: &[&PlannedFamily]| book.inputs_sha256 == Some(Inputs::of_book(plan, families));
    let is_one = book.files.iter().all(|file| file.inputs_sha256 == book.inputs_sha256);
    is_one && (selected.is_empty() || is_made_from(&selected) || is_made_from(&all))
}

/// The finding on the record of a family whose files are as recorded, if it does not say what is in them.
pub(super) fn check_family(pipeline: &FamilyPipeline, record: &FamilyRecord, counts: CellCounts) -> Option<Finding> {
    let (family, arrangement) = (&pipeline.composer.planned.family, &pipeline.arrangement);
    let location = Location::in_family(&family.id).with_file(RUN_FILE_NAME);
    let message = if record.inputs_sha256.is_none() {
        "does not say that the family is complete"
    } else if [record.cells, record.kept, record.unassembled_left_out]
        != [family.cell_count(), arrangement.kept.len(), arrangement.unassembled_left_out]
    {
        "has another number of cells"
    } else if CellCounts::of_record(record) != counts {
        "has another number of curves, or of cells that are not assembled"
    } else if record.title != family.title {
        "has another title of the family"
    } else if !lists_all_pages(pipeline, record) {
        "does not list all pages of the family"
    } else {
        return None;
    };
    Some(location.finding(Change::Damaged { message: message.to_owned() }))
}

/// The finding on the record of a family if that states other inputs than those of the manifest. `other_inputs` are the pages of which it
/// does. It says something about the record if nothing else differs in the atlas: a change of the manifest is found by its effects.
pub(super) fn check_inputs(planned: &PlannedFamily, record: &FamilyRecord, other_inputs: &[String]) -> Option<Finding> {
    let message = match other_inputs.first() {
        _ if record.inputs_sha256 != Some(Inputs::new(planned).family_digest()) => OTHER_INPUTS.to_owned(),
        Some(page) => format!("{page}: {OTHER_INPUTS}"),
        None => return None,
    };
    let location = Location::in_family(&planned.family.id).with_file(RUN_FILE_NAME);
    Some(location.finding(Change::Damaged { message }))
}

/// Whether the record of a family lists each of its pages in the same formats, and no other pages.
fn lists_all_pages(pipeline: &FamilyPipeline, record: &FamilyRecord) -> bool {
    let page_count = pipeline.pagination.page_count;
    let listed: HashSet<&str> = record.files.iter().map(|file| file.name.as_str()).collect();
    let has_tables = ["cells.csv", "points.csv", SCRIPT_FILE].iter().all(|name| listed.contains(name));
    let data_files = 2 + listed.iter().filter(|name| is_data_file_name(name)).count();
    let page_files: usize = PageFormat::ALL
        .into_iter()
        .map(|format| {
            let is_listed =
                |page: &usize| listed.contains(page_file_name(&record.id, *page, page_count, format).as_str());
            (1..=page_count).filter(is_listed).count()
        })
        .filter(|&count| count == page_count)
        .sum();
    has_tables && data_files + page_files == record.files.len()
}

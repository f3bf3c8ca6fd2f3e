//! Writes the tables of a family, and those of its pages that are not up to date.

use std::collections::HashMap;
use std::path::Path;

use super::family_writer::{FamilyTask, FamilyWriter};
use super::files;
use super::initial_record::initial_record;
use super::journal::Journal;
use super::pages::OutputSink;
use super::registry::FileRegistry;
use super::survey::{FamilySurvey, Surveyor};
use super::{Error, Event, Options, previous_run};
use crate::gallery::FamilyScript;
use crate::manifest::{Plan, PlannedFamily};
use crate::pipeline::{FamilyPipeline, Inputs};
use crate::record::{CellTable, FamilyRecord, FileRecord, open_regular_file, read_unassembled_cells};
use coupler_curves::exchange::PointTable;
use coupler_drawing::render::{Format, PageFormat};

/// Writes a family into its folder, unless all of its files are up to date. If there is a surveyor, the result is the survey of its
/// cells; `None` if not all of them have been solved.
pub(super) fn write(
    (plan, planned): (&Plan, &PlannedFamily),
    output: &Path,
    options: &Options,
    (journal, surveyor): (&mut Journal, Option<Surveyor>),
    report: &mut dyn FnMut(Event),
) -> Result<Option<FamilySurvey>, Error> {
    let family = &planned.family;
    let folder = output.join(&family.id);
    let formats = options.formats.as_ref().unwrap_or(&planned.formats);
    let formats: Vec<PageFormat> = formats.iter().copied().filter_map(Format::page_format).collect();
    let inputs_sha256 = Inputs::new(planned).family_digest();
    let earlier = journal.family(&family.id).cloned();
    let unchanged = |record: &FamilyRecord| {
        let record = previous_run::unchanged_record(record, inputs_sha256, &formats, &folder)?;
        let shortfalls = recorded_shortfalls(&record, &folder)?;
        Some((record, shortfalls))
    };
    if let Some((mut record, shortfalls)) = earlier.as_ref().filter(|_| !options.force).and_then(unchanged) {
        record.files.extend(pages_in_other_formats(earlier.as_ref(), &record, &formats, options));
        previous_run::sort_files(&family.id, &mut record.files);
        for (cell, reason) in &shortfalls {
            report(Event::Shortfall { family: &family.id, cell: *cell, reason });
        }
        report(Event::End { record: &record, drawn: None });
        // A change is recorded before a file is removed.
        journal.set_family(record.clone())?;
        remove_stale_files(earlier, &record, journal)?;
        return Ok(None);
    }
    let pipeline = FamilyPipeline::new(plan, planned, &options.interrupt).ok_or(Error::Interrupted)?;
    let page_count = pipeline.pagination.page_count;
    journal.check_page_files(&family.id, page_count.saturating_mul(formats.len()))?;
    report(Event::Begin { family: &family.id, pages: page_count });
    files::create_folder(&folder)?;
    let mut known = earlier.as_ref().map(|record| record.files.clone()).unwrap_or_default();
    if options.force {
        known.iter_mut().for_each(|file| *file = FileRecord::from_name(&file.name));
    }
    let record = initial_record(&pipeline);
    // From here on, the files of an earlier run may be replaced at any time.
    journal.set_family(FamilyRecord {
        inputs_sha256: None,
        files: known.clone(),
        ..earlier.clone().unwrap_or(record)
    })?;
    let progress = journal.progress(&family.id).filter(|_| !options.force);
    let progress = progress.map(|(progress, pieces)| (progress.clone(), pieces.to_vec()));
    let journal_file = journal.file()?;
    let registry = FileRegistry::new(&family.id, &folder, &known, &journal_file);
    let (composer, interrupt) = (&pipeline.composer, &*options.interrupt);
    let tables = (PointTable::new(family), CellTable::new(family));
    let script = FamilyScript::new(plan, planned);
    let sink = OutputSink { composer, formats: &formats, tables, script, registry: &registry, interrupt, surveyor };
    let task = FamilyTask { pipeline: &pipeline, sink, folder: &folder, journal: &journal_file, inputs_sha256 };
    let resumed = progress.and_then(|(progress, pieces)| FamilyWriter::resume(task, (&progress, &pieces), report));
    let is_surveyed = resumed.is_none() && surveyor.is_some();
    let writer = match resumed {
        Some(writer) => writer,
        None => FamilyWriter::start(task)?,
    };
    let (record, drawn, survey) = writer.write_all(report)?;
    let mut record = FamilyRecord { inputs_sha256: Some(inputs_sha256), ..record };
    record.files.extend(pages_in_other_formats(earlier.as_ref(), &record, &formats, options));
    previous_run::sort_files(&family.id, &mut record.files);
    report(Event::End { record: &record, drawn: Some(drawn) });
    journal.set_family(record.clone())?;
    remove_stale_files(earlier, &record, journal)?;
    Ok(is_surveyed.then_some(survey))
}

/// The unassembled cells of a family that is up to date, from its table; `None` if the table can no longer be read.
fn recorded_shortfalls(record: &FamilyRecord, folder: &Path) -> Option<Vec<(usize, String)>> {
    if record.not_assembled == 0 {
        return Some(Vec::new());
    }
    open_regular_file(&folder.join("cells.csv"), u64::MAX).ok().map(read_unassembled_cells)
}

/// Removes the files of an earlier run that are not among those of a record.
fn remove_stale_files(
    earlier: Option<FamilyRecord>,
    record: &FamilyRecord,
    journal: &mut Journal,
) -> Result<(), Error> {
    let current: std::collections::HashSet<&str> = record.files.iter().map(|file| file.name.as_str()).collect();
    let known = earlier.map(|earlier| earlier.files).unwrap_or_default();
    let mut stale = known.iter().map(|file| file.name.as_str()).filter(|name| !current.contains(name)).peekable();
    if stale.peek().is_some() { journal.file()?.remove_files(&record.id, stale) } else { Ok(()) }
}

/// The pages of an earlier run in formats that this command line leaves out. They stay; a page that is not up to date
/// loses the digest of its inputs.
fn pages_in_other_formats(
    earlier: Option<&FamilyRecord>,
    record: &FamilyRecord,
    formats: &[PageFormat],
    options: &Options,
) -> Vec<FileRecord> {
    let Some(earlier) = earlier.filter(|_| options.formats.is_some()) else { return Vec::new() };
    let page_in = |file: &FileRecord, formats: &[PageFormat]| {
        formats.iter().find_map(|&format| previous_run::parse_page_number(&record.id, &file.name, format))
    };
    let drawn: HashMap<usize, &FileRecord> =
        record.files.iter().filter_map(|file| Some((page_in(file, formats)?, file))).collect();
    let others: Vec<PageFormat> = PageFormat::ALL.into_iter().filter(|format| !formats.contains(format)).collect();
    let kept_page = |file: &FileRecord| {
        let page = page_in(file, &others).filter(|page| (1..=record.pages).contains(page))?;
        let is_current = match drawn.get(&page) {
            Some(drawn) => drawn.inputs_sha256 == file.inputs_sha256,
            None => record.inputs_sha256 == earlier.inputs_sha256,
        };
        let inputs_sha256 = file.inputs_sha256.filter(|_| is_current);
        Some(FileRecord { inputs_sha256, ..file.clone() })
    };
    earlier.files.iter().filter_map(kept_page).collect()
}

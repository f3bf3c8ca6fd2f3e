//! Writes the tables of a family, and those of its pages that are not up to date.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use super::files::{self, AtomicFile};
use super::inputs::Inputs;
use super::journal::Journal;
use super::pages::{OutputSink, PageFiles, TableRows};
use super::registry::FileRegistry;
use super::{Error, Event, Options, previous_run};
use crate::gallery::{self, FamilyScript};
use crate::manifest::{Plan, PlannedFamily};
use crate::pipeline::{FamilyPipeline, Output};
use crate::record::{CellTable, FamilyRecord, FileRecord, read_unassembled_cells};
use coupler_curves::exchange::PointTable;
use coupler_drawing::render::{Format, PageFormat};

/// Writes a family into its folder, unless all of its files are up to date.
pub(super) fn write(
    (plan, planned): (&Plan, &PlannedFamily),
    output: &Path,
    options: &Options,
    journal: &mut Journal,
    report: &mut dyn FnMut(Event),
) -> Result<(), Error> {
    let family = &planned.family;
    let folder = output.join(&family.id);
    let formats = options.formats.as_ref().unwrap_or(&planned.formats);
    let formats: Vec<PageFormat> = formats.iter().copied().filter_map(Format::page_format).collect();
    let inputs = Inputs::new(planned);
    let inputs_sha256 = inputs.family_digest();
    let earlier = journal.family(&family.id).cloned();
    let unchanged = |record: &FamilyRecord| {
        let record = previous_run::unchanged_record(record, &inputs_sha256, &formats, &folder)?;
        let shortfalls = recorded_shortfalls(&record, &folder)?;
        Some((record, shortfalls))
    };
    if let Some((mut record, shortfalls)) = earlier.as_ref().filter(|_| !options.force).and_then(unchanged) {
        record.files.extend(pages_in_other_formats(earlier.as_ref(), &record, &formats, options));
        // The files keep the order of the earlier record.
        let known = earlier.iter().flat_map(|earlier| &earlier.files);
        let order: HashMap<&str, usize> = known.zip(0..).map(|(file, index)| (file.name.as_str(), index)).collect();
        record.files.sort_by_key(|file| order.get(file.name.as_str()).copied());
        for (cell, reason) in &shortfalls {
            report(Event::Shortfall { family: &family.id, cell: *cell, reason });
        }
        remove_stale_files(earlier, &record, &folder)?;
        report(Event::End { record: &record, drawn: None });
        return journal.set_family(record);
    }
    let pipeline = FamilyPipeline::new(plan, planned, &options.interrupt).ok_or(Error::Interrupted)?;
    report(Event::Begin { family: &family.id, pages: pipeline.pagination.page_count });
    files::create_folder(&folder)?;
    let mut known = earlier.as_ref().map(|record| record.files.clone()).unwrap_or_default();
    if options.force {
        known.iter_mut().for_each(|file| *file = FileRecord::from_name(&file.name));
    }
    let registry = FileRegistry::new(&folder, known);
    let record = initial_record(&pipeline);
    if let Some(earlier) = &earlier {
        // From here on, the files of the earlier run may be replaced at any time.
        journal.set_family(FamilyRecord {
            inputs_sha256: None,
            files: registry.certain_records(),
            ..earlier.clone()
        })?;
    }
    let (composer, interrupt) = (pipeline.composer, &*options.interrupt);
    let tables = (PointTable::new(family), CellTable::new(family));
    let script = FamilyScript::new(plan, planned);
    let sink = OutputSink { composer, formats: &formats, inputs, tables, script, registry: &registry, interrupt };
    let mut writer = FamilyWriter { pipeline: &pipeline, sink, folder, record, drawn_pages: 0, unrecorded_pages: 0 };
    match writer.write_all(journal, report) {
        Ok(()) => {
            let mut record = FamilyRecord { inputs_sha256: Some(inputs_sha256), ..writer.record };
            record.files.extend(pages_in_other_formats(earlier.as_ref(), &record, &formats, options));
            remove_stale_files(earlier, &record, &writer.folder)?;
            report(Event::End { record: &record, drawn: Some(writer.drawn_pages) });
            journal.set_family(record)
        }
        Err(error) => {
            // The next run continues from here. If this cannot be written, the record on disk is still true.
            let _ = journal.set_family(FamilyRecord { files: registry.final_records(), ..writer.record });
            Err(error)
        }
    }
}

/// The unassembled cells of a family that is up to date, from its table; `None` if the table can no longer be read.
fn recorded_shortfalls(record: &FamilyRecord, folder: &Path) -> Option<Vec<(usize, String)>> {
    if record.not_assembled == 0 {
        return Some(Vec::new());
    }
    files::open(&folder.join("cells.csv")).ok().map(read_unassembled_cells)
}

/// Removes the files of an earlier run that are not among those of a record.
fn remove_stale_files(earlier: Option<FamilyRecord>, record: &FamilyRecord, folder: &Path) -> Result<(), Error> {
    let current: std::collections::HashSet<&str> = record.files.iter().map(|file| file.name.as_str()).collect();
    let known = earlier.map(|earlier| earlier.files).unwrap_or_default();
    files::remove_files(folder, known.iter().map(|file| file.name.as_str()).filter(|name| !current.contains(name)))
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
        let inputs_sha256 = file.inputs_sha256.clone().filter(|_| is_current);
        Some(FileRecord { inputs_sha256, ..file.clone() })
    };
    earlier.files.iter().filter_map(kept_page).collect()
}

/// The record of a family before any of its files is written.
fn initial_record(pipeline: &FamilyPipeline) -> FamilyRecord {
    let family = &pipeline.composer.planned.family;
    FamilyRecord {
        id: family.id.clone(),
        title: family.title.clone(),
        linkage: family.template.id.clone(),
        inputs_sha256: None,
        cells: family.cell_count(),
        kept: pipeline.arrangement.kept.len(),
        not_assembled: 0,
        curves_left_out: 0,
        curves: 0,
        pages: pipeline.pagination.page_count,
        files: Vec::new(),
    }
}

/// Writes the files of a family.
struct FamilyWriter<'a> {
    pipeline: &'a FamilyPipeline<'a>,
    sink: OutputSink<'a>,
    folder: PathBuf,
    record: FamilyRecord,
    /// The number of pages drawn.
    drawn_pages: usize,
    /// The number of pages drawn since they were last recorded.
    unrecorded_pages: usize,
}

/// The number of pages drawn between records; a run that is killed loses at most as many.
const PAGES_PER_RECORD: usize = 400;

impl FamilyWriter<'_> {
    /// Writes the tables, the script and the pages.
    fn write_all(&mut self, journal: &mut Journal, report: &mut dyn FnMut(Event)) -> Result<(), Error> {
        let OutputSink { tables: (points_table, cells_table), script, registry, .. } = self.sink;
        let mut points = AtomicFile::with_header(self.folder.join("points.csv"), &points_table.header())?;
        let mut cells = AtomicFile::with_header(self.folder.join("cells.csv"), &cells_table.header())?;
        let mut script_file = AtomicFile::with_header(self.folder.join(gallery::SCRIPT_FILE), &script.begin())?;
        let (pipeline, sink) = (self.pipeline, self.sink);
        pipeline.run(&sink, |output| match output {
            Output::Cells(rows) => {
                points.append(&rows.points)?;
                cells.append(&rows.cells)?;
                script_file.append(rows.gallery_data.as_bytes())?;
                self.add_counts(&rows, report);
                Ok(())
            }
            Output::Page(page) => {
                script_file.append(page.gallery_data.as_bytes())?;
                self.record_page(page, journal, report)
            }
        })?;
        script_file.append(script.end().as_bytes())?;
        let tables = [registry.commit_file(cells)?, registry.commit_file(points)?, registry.commit_file(script_file)?];
        self.record.files.splice(0..0, tables);
        Ok(())
    }

    /// Adds the counts of some cells to the record, and reports those that could not be assembled.
    fn add_counts(&mut self, rows: &TableRows, report: &mut dyn FnMut(Event)) {
        self.record.curves += rows.curve_count;
        self.record.curves_left_out += rows.curves_left_out;
        self.record.not_assembled += rows.shortfalls.len();
        for (cell, reason) in &rows.shortfalls {
            report(Event::Shortfall { family: &self.record.id, cell: *cell, reason });
        }
    }

    /// Adds a page to the record, and saves the record after every [`PAGES_PER_RECORD`] drawn pages.
    fn record_page(
        &mut self,
        page: PageFiles,
        journal: &mut Journal,
        report: &mut dyn FnMut(Event),
    ) -> Result<(), Error> {
        self.record.files.extend(page.files);
        if page.is_drawn {
            self.drawn_pages += 1;
            self.unrecorded_pages += 1;
        }
        if self.unrecorded_pages == PAGES_PER_RECORD {
            self.unrecorded_pages = 0;
            journal.set_family(FamilyRecord { files: self.sink.registry.certain_records(), ..self.record.clone() })?;
        }
        report(Event::Page);
        Ok(())
    }
}

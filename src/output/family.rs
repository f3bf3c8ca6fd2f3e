//! Builds a family: its tables, and its pages where they are not there yet as they would be.

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

/// Builds a family into its folder, unless all of it is there as it would be.
pub(super) fn write(
    (plan, planned): (&Plan, &PlannedFamily),
    output: &Path,
    options: &Options,
    journal: &mut Journal,
    tell: &mut dyn FnMut(Event),
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
        let told = recorded_shortfalls(&record, &folder)?;
        Some((record, told))
    };
    if let Some((mut record, told)) = earlier.as_ref().filter(|_| !options.force).and_then(unchanged) {
        record.files.extend(pages_in_other_formats(earlier.as_ref(), &record, &formats, options));
        // In the order they had.
        let known = earlier.iter().flat_map(|earlier| &earlier.files);
        let places: HashMap<&str, usize> = known.zip(0..).map(|(file, place)| (file.name.as_str(), place)).collect();
        record.files.sort_by_key(|file| places.get(file.name.as_str()).copied());
        for (cell, reason) in &told {
            tell(Event::Shortfall { family: &family.id, cell: *cell, reason });
        }
        remove_stale_files(earlier, &record, &folder)?;
        tell(Event::End { record: &record, drawn: None });
        return journal.set_family(record);
    }
    let press = FamilyPipeline::new(plan, planned, &options.interrupt).ok_or(Error::Interrupted)?;
    tell(Event::Begin { family: &family.id, pages: press.pagination.page_count });
    files::create_folder(&folder)?;
    let mut known = earlier.as_ref().map(|record| record.files.clone()).unwrap_or_default();
    if options.force {
        known.iter_mut().for_each(|file| *file = FileRecord::from_name(&file.name));
    }
    let claims = FileRegistry::new(&folder, known);
    let record = initial_record(&press);
    if let Some(earlier) = &earlier {
        // From here on, what was there may be replaced at any time.
        journal.set_family(FamilyRecord { inputs_sha256: None, files: claims.certain_records(), ..earlier.clone() })?;
    }
    let (composer, interrupt) = (press.composer, &*options.interrupt);
    let tables = (PointTable::new(family), CellTable::new(family));
    let statements = FamilyScript::new(plan, planned);
    let printer =
        OutputSink { composer, formats: &formats, inputs, tables, script: statements, registry: &claims, interrupt };
    let mut work =
        FamilyWriter { pipeline: &press, sink: printer, folder, record, drawn_pages: 0, unrecorded_pages: 0 };
    match work.write_all(journal, tell) {
        Ok(()) => {
            let mut record = FamilyRecord { inputs_sha256: Some(inputs_sha256), ..work.record };
            record.files.extend(pages_in_other_formats(earlier.as_ref(), &record, &formats, options));
            remove_stale_files(earlier, &record, &work.folder)?;
            tell(Event::End { record: &record, drawn: Some(work.drawn_pages) });
            journal.set_family(record)
        }
        Err(error) => {
            // The next run goes on from here. If that cannot be written, there stands what is so in any case.
            let _ = journal.set_family(FamilyRecord { files: claims.final_records(), ..work.record });
            Err(error)
        }
    }
}

/// The cells of a family that was left alone which are not assembled; nothing where its table has gone since.
fn recorded_shortfalls(record: &FamilyRecord, folder: &Path) -> Option<Vec<(usize, String)>> {
    if record.not_assembled == 0 {
        return Some(Vec::new());
    }
    files::open(&folder.join("cells.csv")).ok().map(read_unassembled_cells)
}

/// Removes the files of an earlier run that are not among those of a record.
fn remove_stale_files(earlier: Option<FamilyRecord>, record: &FamilyRecord, folder: &Path) -> Result<(), Error> {
    let stay: std::collections::HashSet<&str> = record.files.iter().map(|file| file.name.as_str()).collect();
    let known = earlier.map(|earlier| earlier.files).unwrap_or_default();
    files::remove_files(folder, known.iter().map(|file| file.name.as_str()).filter(|name| !stay.contains(name)))
}

/// The pages that an earlier run drew in formats which the command line leaves out this time: they stay, and what they were
/// made from is known no more where it is not what the family's pages are made from now.
fn pages_in_other_formats(
    earlier: Option<&FamilyRecord>,
    record: &FamilyRecord,
    formats: &[PageFormat],
    options: &Options,
) -> Vec<FileRecord> {
    let Some(earlier) = earlier.filter(|_| options.formats.is_some()) else { return Vec::new() };
    let page_in = |file: &FileRecord, of: &[PageFormat]| {
        of.iter().find_map(|&format| previous_run::parse_page_number(&record.id, &file.name, format))
    };
    let drawn: HashMap<usize, &FileRecord> =
        record.files.iter().filter_map(|file| Some((page_in(file, formats)?, file))).collect();
    let others: Vec<PageFormat> = PageFormat::ALL.into_iter().filter(|format| !formats.contains(format)).collect();
    let left = |file: &FileRecord| {
        let page = page_in(file, &others).filter(|page| (1..=record.pages).contains(page))?;
        let is_current = match drawn.get(&page) {
            Some(drawn) => drawn.inputs_sha256 == file.inputs_sha256,
            None => record.inputs_sha256 == earlier.inputs_sha256,
        };
        let inputs_sha256 = file.inputs_sha256.clone().filter(|_| is_current);
        Some(FileRecord { inputs_sha256, ..file.clone() })
    };
    earlier.files.iter().filter_map(left).collect()
}

/// What is known of a family before any of it is made.
fn initial_record(press: &FamilyPipeline) -> FamilyRecord {
    let family = &press.composer.planned.family;
    FamilyRecord {
        id: family.id.clone(),
        title: family.title.clone(),
        linkage: family.template.id.clone(),
        inputs_sha256: None,
        cells: family.cell_count(),
        kept: press.arrangement.kept.len(),
        not_assembled: 0,
        curves_left_out: 0,
        curves: 0,
        pages: press.pagination.page_count,
        files: Vec::new(),
    }
}

/// A family that is being built.
struct FamilyWriter<'a> {
    pipeline: &'a FamilyPipeline<'a>,
    sink: OutputSink<'a>,
    folder: PathBuf,
    record: FamilyRecord,
    /// How many pages were drawn.
    drawn_pages: usize,
    /// How many of them since they were last recorded.
    unrecorded_pages: usize,
}

/// So many pages are drawn before they are recorded: a run that is killed loses no more.
const PAGES_PER_RECORD: usize = 400;

impl FamilyWriter<'_> {
    fn write_all(&mut self, journal: &mut Journal, tell: &mut dyn FnMut(Event)) -> Result<(), Error> {
        let OutputSink { tables: (points_table, cells_table), script: statements, registry: claims, .. } = self.sink;
        let mut points = AtomicFile::with_header(self.folder.join("points.csv"), &points_table.header())?;
        let mut cells = AtomicFile::with_header(self.folder.join("cells.csv"), &cells_table.header())?;
        let mut shown = AtomicFile::with_header(self.folder.join(gallery::SCRIPT_FILE), &statements.begin())?;
        let (press, printer) = (self.pipeline, self.sink);
        press.run(&printer, |off| match off {
            Output::Cells(rows) => {
                points.append(&rows.points)?;
                cells.append(&rows.cells)?;
                shown.append(rows.gallery_data.as_bytes())?;
                self.add_counts(&rows, tell);
                Ok(())
            }
            Output::Page(page) => {
                shown.append(page.gallery_data.as_bytes())?;
                self.record_page(page, journal, tell)
            }
        })?;
        shown.append(statements.end().as_bytes())?;
        let tables = [claims.commit_file(cells)?, claims.commit_file(points)?, claims.commit_file(shown)?];
        self.record.files.splice(0..0, tables);
        Ok(())
    }

    fn add_counts(&mut self, rows: &TableRows, tell: &mut dyn FnMut(Event)) {
        self.record.curves += rows.curve_count;
        self.record.curves_left_out += rows.curves_left_out;
        self.record.not_assembled += rows.shortfalls.len();
        for (cell, reason) in &rows.shortfalls {
            tell(Event::Shortfall { family: &self.record.id, cell: *cell, reason });
        }
    }

    /// Records a page.
    fn record_page(
        &mut self,
        page: PageFiles,
        journal: &mut Journal,
        tell: &mut dyn FnMut(Event),
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
        tell(Event::Page);
        Ok(())
    }
}

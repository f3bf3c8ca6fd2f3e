//! Builds a family: its tables, and its pages where they are not there yet as they would be.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use super::claims::Claims;
use super::files::{self, Growing};
use super::inputs::Inputs;
use super::journal::Journal;
use super::pages::{Printed, Printer, Rows};
use super::{Error, Event, Options, earlier};
use crate::gallery::{self, Statements};
use crate::manifest::{Plan, PlannedFamily};
use crate::press::{Off, Press};
use crate::record::{Cells, FamilyRecord, FileRecord, shortfalls};
use coupler_curves::exchange::Points;
use coupler_drawing::render::{Format, PageFormat};

/// Builds a family into its folder, unless all of it is there as it would be.
pub(super) fn build(
    (plan, planned): (&Plan, &PlannedFamily),
    output: &Path,
    options: &Options,
    journal: &mut Journal,
    tell: &mut dyn FnMut(Event),
) -> Result<(), Error> {
    let family = &planned.family;
    let folder = output.join(&family.id);
    let formats = options.formats.as_ref().unwrap_or(&planned.formats);
    let formats: Vec<PageFormat> = formats.iter().copied().filter_map(Format::of_pages).collect();
    let inputs = Inputs::new(planned);
    let inputs_sha256 = inputs.of_family();
    let earlier = journal.of(&family.id).cloned();
    let unchanged = |record: &FamilyRecord| {
        let record = earlier::unchanged(record, &inputs_sha256, &formats, &folder)?;
        let told = known_shortfalls(&record, &folder)?;
        Some((record, told))
    };
    if let Some((mut record, told)) = earlier.as_ref().filter(|_| !options.force).and_then(unchanged) {
        record.files.extend(others_left(earlier.as_ref(), &record, &formats, options));
        // In the order they had.
        let known = earlier.iter().flat_map(|earlier| &earlier.files);
        let places: HashMap<&str, usize> = known.zip(0..).map(|(file, place)| (file.name.as_str(), place)).collect();
        record.files.sort_by_key(|file| places.get(file.name.as_str()).copied());
        for (cell, reason) in &told {
            tell(Event::Shortfall { family: &family.id, cell: *cell, reason });
        }
        remove_others(earlier, &record, &folder)?;
        tell(Event::End { record: &record, drawn: None });
        return journal.put(record);
    }
    let press = Press::new(plan, planned, &options.interrupt).ok_or(Error::Interrupted)?;
    tell(Event::Begin { family: &family.id, pages: press.setting.pages });
    files::create_folder(&folder)?;
    let mut known = earlier.as_ref().map(|record| record.files.clone()).unwrap_or_default();
    if options.force {
        known.iter_mut().for_each(|file| *file = FileRecord::of_name(&file.name));
    }
    let claims = Claims::new(&folder, known);
    let record = blank(&press);
    if let Some(earlier) = &earlier {
        // From here on, what was there may be replaced at any time.
        journal.put(FamilyRecord { inputs_sha256: None, files: claims.lasting(), ..earlier.clone() })?;
    }
    let (composer, interrupt) = (press.composer, &*options.interrupt);
    let tables = (Points::new(family), Cells::new(family));
    let statements = Statements::new(plan, planned);
    let printer = Printer { composer, formats: &formats, inputs, tables, statements, claims: &claims, interrupt };
    let mut work = Work { press: &press, printer, folder, record, drawn: 0, since: 0 };
    match work.all(journal, tell) {
        Ok(()) => {
            let mut record = FamilyRecord { inputs_sha256: Some(inputs_sha256), ..work.record };
            record.files.extend(others_left(earlier.as_ref(), &record, &formats, options));
            remove_others(earlier, &record, &work.folder)?;
            tell(Event::End { record: &record, drawn: Some(work.drawn) });
            journal.put(record)
        }
        Err(error) => {
            // The next run goes on from here. If that cannot be written, there stands what is so in any case.
            let _ = journal.put(FamilyRecord { files: claims.at_end(), ..work.record });
            Err(error)
        }
    }
}

/// The cells of a family that was left alone which are not assembled; nothing where its table has gone since.
fn known_shortfalls(record: &FamilyRecord, folder: &Path) -> Option<Vec<(usize, String)>> {
    if record.not_assembled == 0 {
        return Some(Vec::new());
    }
    files::open(&folder.join("cells.csv")).ok().map(shortfalls)
}

/// Removes the files of an earlier run that are not among those of a record.
fn remove_others(earlier: Option<FamilyRecord>, record: &FamilyRecord, folder: &Path) -> Result<(), Error> {
    let stay: std::collections::HashSet<&str> = record.files.iter().map(|file| file.name.as_str()).collect();
    let known = earlier.map(|earlier| earlier.files).unwrap_or_default();
    files::remove(folder, known.iter().map(|file| file.name.as_str()).filter(|name| !stay.contains(name)))
}

/// The pages that an earlier run drew in formats which the command line leaves out this time: they stay, and what they were
/// made from is known no more where it is not what the family's pages are made from now.
fn others_left(
    earlier: Option<&FamilyRecord>,
    record: &FamilyRecord,
    formats: &[PageFormat],
    options: &Options,
) -> Vec<FileRecord> {
    let Some(earlier) = earlier.filter(|_| options.formats.is_some()) else { return Vec::new() };
    let page_in = |file: &FileRecord, of: &[PageFormat]| {
        of.iter().find_map(|&format| earlier::page_number(&record.id, &file.name, format))
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
fn blank(press: &Press) -> FamilyRecord {
    let family = &press.composer.planned.family;
    FamilyRecord {
        id: family.id.clone(),
        title: family.title.clone(),
        linkage: family.template.id.clone(),
        inputs_sha256: None,
        cells: family.cells(),
        kept: press.arrangement.kept.len(),
        not_assembled: 0,
        curves_left_out: 0,
        curves: 0,
        pages: press.setting.pages,
        files: Vec::new(),
    }
}

/// A family that is being built.
struct Work<'a> {
    press: &'a Press<'a>,
    printer: Printer<'a>,
    folder: PathBuf,
    record: FamilyRecord,
    /// How many pages were drawn.
    drawn: usize,
    /// How many of them since they were last recorded.
    since: usize,
}

/// So many pages are drawn before they are recorded: a run that is killed loses no more.
const PAGES_TO_A_RECORD: usize = 400;

impl Work<'_> {
    fn all(&mut self, journal: &mut Journal, tell: &mut dyn FnMut(Event)) -> Result<(), Error> {
        let Printer { tables: (points_table, cells_table), statements, claims, .. } = self.printer;
        let mut points = Growing::create(self.folder.join("points.csv"), &points_table.header())?;
        let mut cells = Growing::create(self.folder.join("cells.csv"), &cells_table.header())?;
        let mut shown = Growing::create(self.folder.join(gallery::SCRIPT), &statements.begin())?;
        let (press, printer) = (self.press, self.printer);
        press.run(&printer, |off| match off {
            Off::Cells(rows) => {
                points.append(&rows.points)?;
                cells.append(&rows.cells)?;
                shown.append(rows.shown.as_bytes())?;
                self.count(&rows, tell);
                Ok(())
            }
            Off::Page(page) => {
                shown.append(page.shown.as_bytes())?;
                self.keep(page, journal, tell)
            }
        })?;
        shown.append(statements.end().as_bytes())?;
        let tables = [claims.finish(cells)?, claims.finish(points)?, claims.finish(shown)?];
        self.record.files.splice(0..0, tables);
        Ok(())
    }

    fn count(&mut self, rows: &Rows, tell: &mut dyn FnMut(Event)) {
        self.record.curves += rows.curves;
        self.record.curves_left_out += rows.left_out;
        self.record.not_assembled += rows.shortfalls.len();
        for (cell, reason) in &rows.shortfalls {
            tell(Event::Shortfall { family: &self.record.id, cell: *cell, reason });
        }
    }

    /// Records a page.
    fn keep(&mut self, page: Printed, journal: &mut Journal, tell: &mut dyn FnMut(Event)) -> Result<(), Error> {
        self.record.files.extend(page.files);
        if page.is_drawn {
            self.drawn += 1;
            self.since += 1;
        }
        if self.since == PAGES_TO_A_RECORD {
            self.since = 0;
            journal.put(FamilyRecord { files: self.printer.claims.lasting(), ..self.record.clone() })?;
        }
        tell(Event::Page);
        Ok(())
    }
}

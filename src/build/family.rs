//! Builds a family: its tables, and its pages where they are not there yet as they would be.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use super::claims::Claims;
use super::files::{self, Growing};
use super::inputs::Inputs;
use super::journal::Journal;
use super::pages::{Printed, Printer};
use super::{Error, Event, Options, earlier, stop_if};
use crate::chart::{Gathering, Taken};
use crate::family::Family;
use crate::manifest::{Plan, PlannedFamily};
use crate::measure::{self, Measure};
use crate::page::{self, Layout};
use crate::record::{Cells, FamilyRecord, FileRecord, Points, shortfalls};
use crate::render::Format;
use crate::sweep::{self, Arrangement, Groups, Solved, Status};

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
    let mut formats = options.formats.as_ref().unwrap_or(&planned.formats).clone();
    formats.retain(|format| format.has_a_file_for_each_page());
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
    let arrangement = arrangement(planned, &options.interrupt)?;
    let setting = Setting::new(planned, &arrangement);
    tell(Event::Begin { family: &family.id, pages: setting.pages });
    files::create_folder(&folder)?;
    let mut known = earlier.as_ref().map(|record| record.files.clone()).unwrap_or_default();
    if options.force {
        known.iter_mut().for_each(|file| *file = FileRecord::of_name(&file.name));
    }
    let claims = Claims::new(&folder, known);
    let record = blank(planned, &arrangement, setting.pages);
    if let Some(earlier) = &earlier {
        // From here on, what was there may be replaced at any time.
        journal.put(FamilyRecord { inputs_sha256: None, files: claims.lasting(), ..earlier.clone() })?;
    }
    let (interrupt, of) = (&*options.interrupt, setting.pages);
    let printer = Printer { plan, planned, formats: &formats, inputs, claims: &claims, interrupt, of };
    let mut work = Work { planned, printer, arrangement: &arrangement, setting, folder, record, drawn: 0, since: 0 };
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

/// The pages that an earlier run drew in formats which the command line leaves out this time: they stay.
fn others_left(
    earlier: Option<&FamilyRecord>,
    record: &FamilyRecord,
    formats: &[Format],
    options: &Options,
) -> Vec<FileRecord> {
    let known = earlier.filter(|_| options.formats.is_some()).map(|earlier| earlier.files.as_slice());
    let others: Vec<Format> = Format::ALL.into_iter().filter(|format| !formats.contains(format)).collect();
    let is_of_page = |file: &&FileRecord| {
        others.iter().any(|&format| {
            earlier::page_number(&record.id, &file.name, format).is_some_and(|page| (1..=record.pages).contains(&page))
        })
    };
    known.unwrap_or_default().iter().filter(is_of_page).cloned().collect()
}

/// What is known of a family before any of it is made.
fn blank(planned: &PlannedFamily, arrangement: &Arrangement, pages: usize) -> FamilyRecord {
    let family = &planned.family;
    FamilyRecord {
        id: family.id.clone(),
        title: family.title.clone(),
        linkage: family.template.id.clone(),
        inputs_sha256: None,
        cells: family.cells(),
        kept: arrangement.kept.len(),
        not_assembled: 0,
        curves_left_out: 0,
        curves: 0,
        pages,
        files: Vec::new(),
    }
}

/// Which cells of a family are shown, and in what order.
pub(super) fn arrangement(planned: &PlannedFamily, interrupt: &AtomicBool) -> Result<Arrangement, Error> {
    let counts_points = planned.layout == Layout::CouplerGrid;
    sweep::arrange(&planned.family, counts_points, interrupt).ok_or(Error::Interrupted)
}

/// Which measures it takes to draw the cells of a family on pages of their own.
pub(super) fn told_on_pages(family: &Family) -> Vec<bool> {
    let is_in_a_caption = |name: &str| family.captions.iter().flatten().any(|caption| caption.uses(name));
    let is_told = |(k, measure): (usize, &Measure)| {
        page::MEASURES.contains(&measure.name) || family.asks_for(k) || is_in_a_caption(measure.name)
    };
    measure::ALL.iter().enumerate().map(is_told).collect()
}

/// How the cells of a family are put on pages.
pub(super) struct Setting {
    /// How many cells are worked on together: those of a page, or one with all its pages.
    pub size: usize,
    pub pages: usize,
    /// The numbers of the first pages of cells that have several.
    begins: Vec<usize>,
}

/// How many cells charts take in at a time.
const CELLS_TO_A_GROUP: usize = 16;

impl Setting {
    pub fn new(planned: &PlannedFamily, arrangement: &Arrangement) -> Setting {
        let kept = arrangement.kept.len();
        let cells_to_a_page = planned.layout.cells();
        let begins = match planned.layout {
            Layout::CouplerGrid => first_pages(&arrangement.points),
            _ => Vec::new(),
        };
        let (size, pages) = match &planned.chart {
            None if planned.layout == Layout::CouplerGrid => (1, begins.last().map_or(0, |end| end - 1)),
            None => (cells_to_a_page, kept.div_ceil(cells_to_a_page)),
            Some(_) if kept == 0 => (CELLS_TO_A_GROUP, 0),
            Some(chart) => (CELLS_TO_A_GROUP, chart.y.len().div_ceil(cells_to_a_page)),
        };
        Setting { size, pages, begins }
    }

    /// The first page of the k-th cell in the order of pages.
    pub fn page_of(&self, k: usize) -> usize {
        self.begins.get(k).copied().unwrap_or(k / self.size + 1)
    }
}

/// The numbers of the first pages of cells with so many traced points, and the one after the last.
fn first_pages(points: &[usize]) -> Vec<usize> {
    let mut next = 1;
    let mut begins = vec![next];
    for points in points {
        next += points.div_ceil(Layout::POINTS).max(1);
        begins.push(next);
    }
    begins
}

/// What comes of a group of cells.
struct Made {
    /// The pages, if they are drawn on some of their own.
    pages: Vec<Printed>,
    /// What charts take of them.
    taken: Vec<Taken>,
    points: Vec<u8>,
    cells: Vec<u8>,
    curves: usize,
    left_out: usize,
    shortfalls: Vec<(usize, String)>,
}

/// A family that is being built.
struct Work<'a> {
    planned: &'a PlannedFamily,
    printer: Printer<'a>,
    arrangement: &'a Arrangement,
    setting: Setting,
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
        let family = &self.planned.family;
        let points_table = Points::new(family, dyads(family));
        let cells_table = Cells::new(family);
        let mut points = Growing::create(self.folder.join("points.csv"), &points_table.header())?;
        let mut cells = Growing::create(self.folder.join("cells.csv"), &cells_table.header())?;
        let mut gathering = self.planned.chart.as_ref().map(|chart| Gathering::new(chart, family));
        self.sweep((points_table, cells_table), (&mut points, &mut cells), &mut gathering, journal, tell)?;
        if self.planned.chart.is_none() && family.sort.is_some() {
            self.sorted_pages(journal, tell)?;
        }
        if let (Some(chart), Some(gathering)) = (&self.planned.chart, gathering) {
            let gathered = gathering.finish();
            for page in 1..=self.setting.pages {
                let page = self.printer.charts(page, chart, &gathered)?;
                self.keep(page, journal, tell)?;
            }
        }
        let claims = self.printer.claims;
        let tables = [claims.finish(cells)?, claims.finish(points)?];
        self.record.files.splice(0..0, tables);
        Ok(())
    }

    /// Takes every cell into the tables, and draws the pages that are in their order.
    fn sweep(
        &mut self,
        (points_table, cells_table): (Points, Cells),
        (points, cells): (&mut Growing, &mut Growing),
        gathering: &mut Option<Gathering>,
        journal: &mut Journal,
        tell: &mut dyn FnMut(Event),
    ) -> Result<(), Error> {
        let (planned, printer, interrupt) = (self.planned, self.printer, self.printer.interrupt);
        let family = &planned.family;
        let draws = planned.chart.is_none() && family.sort.is_none();
        let begins = self.setting.begins.clone();
        let make = |group: usize, solved: Vec<Solved>| -> Result<Made, Error> {
            let (mut points, mut cells) = (Vec::new(), Vec::new());
            for solved in &solved {
                stop_if(interrupt)?;
                points_table.rows(solved, &mut points);
                cells_table.rows(solved, &mut cells);
            }
            let shortfall =
                |s: &Solved| Some((s.cell.number, s.motion.shortfall.clone()?)).filter(|_| s.status() != Status::Ok);
            let pages = if draws { draw(&printer, &begins, group, &solved)? } else { Vec::new() };
            let taken = planned.chart.iter().flat_map(|chart| solved.iter().flat_map(|solved| chart.take(solved)));
            Ok(Made {
                pages,
                taken: taken.collect(),
                points,
                cells,
                curves: solved.iter().map(|s| s.curves.len()).sum(),
                left_out: solved.iter().map(|s| s.left_out).sum(),
                shortfalls: solved.iter().filter_map(shortfall).collect(),
            })
        };
        let groups = self.groups(&self.arrangement.kept, None);
        sweep::run(family, groups, make, |made| -> Result<(), Error> {
            let made = made?;
            points.append(&made.points)?;
            cells.append(&made.cells)?;
            if let Some(gathering) = gathering {
                made.taken.into_iter().for_each(|taken| gathering.add(taken));
            }
            self.record.curves += made.curves;
            self.record.curves_left_out += made.left_out;
            self.record.not_assembled += made.shortfalls.len();
            for (cell, reason) in &made.shortfalls {
                tell(Event::Shortfall { family: &family.id, cell: *cell, reason });
            }
            made.pages.into_iter().try_for_each(|page| self.keep(page, journal, tell))
        })
    }

    /// Draws pages in an order of their own, that of the tables being that of the cells.
    fn sorted_pages(&mut self, journal: &mut Journal, tell: &mut dyn FnMut(Event)) -> Result<(), Error> {
        let printer = self.printer;
        let begins = self.setting.begins.clone();
        let make = |group: usize, solved: Vec<Solved>| draw(&printer, &begins, group, &solved);
        let wanted = told_on_pages(&self.planned.family);
        let groups = self.groups(&self.arrangement.order, Some(&wanted));
        sweep::run(&self.planned.family, groups, make, |pages| -> Result<(), Error> {
            pages?.into_iter().try_for_each(|page| self.keep(page, journal, tell))
        })
    }

    fn groups<'c>(&self, cells: &'c [usize], wanted: Option<&'c [bool]>) -> Groups<'c> {
        Groups { cells, size: self.setting.size, bytes: self.printer.bytes(), wanted }
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

/// Draws the pages of a group of cells.
fn draw(printer: &Printer, begins: &[usize], group: usize, solved: &[Solved]) -> Result<Vec<Printed>, Error> {
    match (printer.planned.layout, solved) {
        (Layout::CouplerGrid, [solved]) => printer.grids(begins[group], solved),
        _ => Ok(vec![printer.panels(group + 1, solved)?]),
    }
}

/// How many two-valued joints the linkages of a family have.
fn dyads(family: &Family) -> usize {
    family.linkage(&family.cell(0)).map_or(0, |linkage| linkage.dyads())
}

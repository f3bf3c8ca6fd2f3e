//! Runs a [`Plan`]: names the files, and writes each whole or not at all.

mod files;
mod pages;

pub use files::{Error, read_manifest, write as write_file, write_new};

use std::path::Path;

use crate::chart::{Gathering, Taken};
use crate::family::Family;
use crate::manifest::{Plan, PlannedFamily};
use crate::page::Layout;
use crate::problem::Problem;
use crate::record::{Cells, FamilyRecord, Points, Run};
use crate::render::Format;
use crate::sweep::{self, Solved, Status};
use files::{Growing, write};
use pages::{Printer, Rendered};

/// What is to be built of a plan.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The formats of all families, in place of their own.
    pub formats: Option<Vec<Format>>,
    /// The families to build; all where empty. Those left out keep their files and their record.
    pub only: Vec<String>,
}

/// Something that happened while building.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// A family of so many cells on so many pages is begun.
    Begin {
        /// Its id.
        family: &'a str,
        /// Its pages.
        pages: usize,
    },
    /// A page is done.
    Page,
    /// A family is done.
    End {
        /// What was written of it.
        record: &'a FamilyRecord,
    },
    /// A cell was not assembled, or not over the whole range asked for.
    Shortfall {
        /// The family's id.
        family: &'a str,
        /// The cell's number.
        cell: usize,
        /// Why.
        reason: &'a str,
    },
}

/// Builds a plan into a folder, and tells what happens on the way.
///
/// Every file is written under another name and renamed, `run.json` last: whatever goes wrong, each file in the
/// folder is whole, old or new.
///
/// # Errors
/// A file that cannot be written; a record of an earlier run that is needed and cannot be read.
pub fn run(plan: &Plan, output: &Path, options: &Options, tell: &mut dyn FnMut(Event)) -> Result<Run, Error> {
    let earlier = if options.only.is_empty() { None } else { files::earlier_run(output)? };
    let mut record = Run::new(&plan.title);
    for family in &plan.families {
        let id = &family.family.id;
        if options.only.is_empty() || options.only.contains(id) {
            record.families.push(build_family(plan, family, output, options, tell)?);
        } else {
            let kept = earlier.iter().flat_map(|run| &run.families).find(|record| record.id == *id);
            record.families.extend(kept.cloned());
        }
    }
    write(&output.join("run.json"), &record.to_bytes())?;
    Ok(record)
}

/// A warning for each family whose `where` keeps nothing: found by a sweep, or, of what was built, in its record.
pub fn empty_families(plan: &Plan, built: Option<&Run>) -> Vec<Problem> {
    let kept = |planned: &PlannedFamily| match built {
        None => Some(sweep::select(&planned.family).len()),
        Some(run) => run.families.iter().find(|record| record.id == planned.family.id).map(|record| record.kept),
    };
    let warning = |planned: &PlannedFamily| {
        let span = planned.filter_span.clone()?;
        let message = format!("`where` keeps none of the {} cells", planned.family.cells());
        let problem = Problem::warning(span, message).help("loosen the condition, or leave it out");
        (kept(planned) == Some(0)).then_some(problem)
    };
    plan.families.iter().filter_map(warning).collect()
}

/// The cells of a page and the rows that go with them, ready to be written.
struct Made {
    /// The pages, if they are drawn on some of their own.
    pages: Vec<Rendered>,
    /// What charts take of them.
    taken: Vec<Taken>,
    points: String,
    cells: String,
    curves: usize,
    left_out: usize,
    shortfalls: Vec<(usize, String)>,
}

/// How many cells charts take in at a time.
const CELLS_TO_A_GROUP: usize = 16;

fn build_family(
    plan: &Plan,
    planned: &PlannedFamily,
    output: &Path,
    options: &Options,
    tell: &mut dyn FnMut(Event),
) -> Result<FamilyRecord, Error> {
    let family = &planned.family;
    let folder = output.join(&family.id);
    files::create_folder(&folder)?;
    let kept = sweep::select(family);
    let cells_to_a_page = planned.layout.cells();
    let order = sweep::order(family, &kept);
    let begins = match planned.layout {
        Layout::CouplerGrid => first_pages(&sweep::points(family, &order)),
        _ => Vec::new(),
    };
    let (group, pages) = match &planned.chart {
        None if planned.layout == Layout::CouplerGrid => (1, begins.last().map_or(0, |end| end - 1)),
        None => (cells_to_a_page, kept.len().div_ceil(cells_to_a_page)),
        Some(_) if kept.is_empty() => (CELLS_TO_A_GROUP, 0),
        Some(chart) => (CELLS_TO_A_GROUP, chart.y.len().div_ceil(cells_to_a_page)),
    };
    let formats = options.formats.as_ref().unwrap_or(&planned.formats);
    let printer = Printer { plan, planned, formats, of: pages };
    tell(Event::Begin { family: &family.id, pages });

    let points_table = Points::new(family, dyads(family));
    let cells_table = Cells::new(family);
    let mut points = Growing::create(folder.join("points.csv"), &points_table.header())?;
    let mut cells = Growing::create(folder.join("cells.csv"), &cells_table.header())?;
    let mut record = FamilyRecord {
        id: family.id.clone(),
        title: family.title.clone(),
        linkage: family.template.id.clone(),
        cells: family.cells(),
        kept: kept.len(),
        not_assembled: 0,
        curves_left_out: 0,
        curves: 0,
        pages,
        files: Vec::new(),
    };
    let draw = |group: usize, solved: &[Solved]| match (planned.layout, solved) {
        (Layout::CouplerGrid, [solved]) => printer.grids(begins[group], solved),
        _ => Ok(vec![printer.panels(group + 1, solved)?]),
    };
    let make = |page: usize, solved: Vec<Solved>| -> Result<Made, Error> {
        let (mut points, mut cells) = (String::new(), String::new());
        for solved in &solved {
            points_table.rows(solved, &mut points);
            cells_table.rows(solved, &mut cells);
        }
        let shortfall =
            |s: &Solved| Some((s.cell.number, s.motion.shortfall.clone()?)).filter(|_| s.status() != Status::Ok);
        let curves = solved.iter().map(|s| s.curves.len()).sum();
        let left_out = solved.iter().map(|s| s.left_out).sum();
        let shortfalls = solved.iter().filter_map(shortfall).collect();
        let is_drawn = planned.chart.is_none() && family.sort.is_none();
        let pages = if is_drawn { draw(page, &solved)? } else { Vec::new() };
        let taken =
            planned.chart.iter().flat_map(|chart| solved.iter().flat_map(|solved| chart.take(solved))).collect();
        Ok(Made { pages, taken, points, cells, curves, left_out, shortfalls })
    };
    let mut gathering = planned.chart.as_ref().map(|chart| Gathering::new(chart, family));
    sweep::run(family, (&kept, group), make, |made| -> Result<(), Error> {
        let made = made?;
        points.append(&made.points)?;
        cells.append(&made.cells)?;
        if let Some(gathering) = &mut gathering {
            made.taken.into_iter().for_each(|taken| gathering.add(taken));
        }
        record.curves += made.curves;
        record.curves_left_out += made.left_out;
        record.not_assembled += made.shortfalls.len();
        for (cell, reason) in &made.shortfalls {
            tell(Event::Shortfall { family: &family.id, cell: *cell, reason });
        }
        for page in made.pages {
            keep(page, &folder, &mut record)?;
            tell(Event::Page);
        }
        Ok(())
    })?;
    if planned.chart.is_none() && family.sort.is_some() {
        // Tables are in the order of the cells, pages in one of their own.
        let draw = |group: usize, solved: Vec<Solved>| draw(group, &solved);
        sweep::run(family, (&order, group), draw, |pages| -> Result<(), Error> {
            for page in pages? {
                keep(page, &folder, &mut record)?;
                tell(Event::Page);
            }
            Ok(())
        })?;
    }
    if let (Some(chart), Some(gathering)) = (&planned.chart, gathering) {
        let gathered = gathering.finish();
        for page in 1..=pages {
            keep(printer.charts(page, chart, &gathered)?, &folder, &mut record)?;
            tell(Event::Page);
        }
    }
    record.files.insert(0, points.finish()?);
    record.files.insert(0, cells.finish()?);
    tell(Event::End { record: &record });
    Ok(record)
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

/// Writes a page and records it.
fn keep(page: Rendered, folder: &Path, record: &mut FamilyRecord) -> Result<(), Error> {
    for (name, bytes) in &page.files {
        write(&folder.join(name), bytes)?;
    }
    record.files.extend(page.records);
    Ok(())
}

/// How many two-valued joints the linkages of a family have.
fn dyads(family: &Family) -> usize {
    family.linkage(&family.cell(0)).map_or(0, |linkage| linkage.dyads())
}

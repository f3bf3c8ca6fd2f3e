//! Runs a [`Plan`]: names the files, and writes each whole or not at all.

mod files;

pub use files::{Error, read_manifest, write as write_file, write_new};

use std::path::Path;

use crate::expression::Caption;
use crate::family::Family;
use crate::manifest::{Plan, PlannedFamily};
use crate::page::{self, Panel, Sheet, View};
use crate::problem::Problem;
use crate::record::{Cells, FamilyRecord, FileRecord, Points, Run};
use crate::render::{self, Format};
use crate::sweep::{self, Solved, Status};
use files::{Growing, write};

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

/// A page and the rows that go with it, ready to be written.
struct Made {
    pages: Vec<(String, Vec<u8>)>,
    records: Vec<FileRecord>,
    points: String,
    cells: String,
    curves: usize,
    left_out: usize,
    shortfalls: Vec<(usize, String)>,
}

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
    let (group, formats) = (planned.layout.cells(), options.formats.as_ref().unwrap_or(&planned.formats));
    let pages = kept.len().div_ceil(group);
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
        let (pages, records) = draw_page(plan, planned, formats, (page + 1, pages), &solved)?;
        Ok(Made { pages, records, points, cells, curves, left_out, shortfalls })
    };
    sweep::run(family, (&kept, group), make, |made| -> Result<(), Error> {
        let made = made?;
        for (name, bytes) in &made.pages {
            write(&folder.join(name), bytes)?;
        }
        points.append(&made.points)?;
        cells.append(&made.cells)?;
        record.files.extend(made.records);
        record.curves += made.curves;
        record.curves_left_out += made.left_out;
        record.not_assembled += made.shortfalls.len();
        for (cell, reason) in &made.shortfalls {
            tell(Event::Shortfall { family: &family.id, cell: *cell, reason });
        }
        tell(Event::Page);
        Ok(())
    })?;
    record.files.insert(0, points.finish()?);
    record.files.insert(0, cells.finish()?);
    tell(Event::End { record: &record });
    Ok(record)
}

/// How many two-valued joints the linkages of a family have.
fn dyads(family: &Family) -> usize {
    family.linkage(&family.cell(0)).map_or(0, |linkage| linkage.dyads())
}

/// Where the linkage comes from, and how a page is to be read.
fn source_line(planned: &PlannedFamily, dash_deg: f64) -> String {
    let dashes = match planned.family.template.is_driven_by_length() {
        true => "a dash and its gap span equal lengths of the actuator".to_owned(),
        false => format!("one dash and its gap = {dash_deg}° of input"),
    };
    let key = format!("{dashes} · scale bars in units of length");
    if planned.source.is_empty() { key } else { format!("{} · {key}", planned.source) }
}

type Pages = (Vec<(String, Vec<u8>)>, Vec<FileRecord>);

/// Composes a page and renders it in each format.
fn draw_page(
    plan: &Plan,
    planned: &PlannedFamily,
    formats: &[Format],
    (page, of): (usize, usize),
    solved: &[Solved],
) -> Result<Pages, Error> {
    let family = &planned.family;
    let template = &family.template;
    let line = |caption: &Option<Caption>, solved: &Solved| family.describe(caption.as_ref(), &solved.cell);
    let panel = |solved| Panel {
        inks: Vec::new(),
        caption: line(&template.caption, solved),
        note: line(&template.note, solved),
        solved,
        view: View::Clearest,
    };
    let sheet = Sheet {
        atlas: &plan.title,
        family: &family.id,
        title: &family.title,
        symbols: &family.names,
        source: source_line(planned, plan.page.dash_deg),
        page,
        of,
        layout: planned.layout,
        panels: solved.iter().map(panel).collect(),
    };
    let scene = page::compose(&sheet, &plan.page);
    let (mut pages, mut records) = (Vec::new(), Vec::new());
    let svg = render::svg(&scene, plan.text);
    for format in formats {
        let name = format!("{}-{page:03}.{}", family.id, format.name());
        match format {
            Format::Svg => {
                records.push(FileRecord::of_bytes(&name, &svg));
                pages.push((name, svg.clone()));
            }
            Format::Png => {
                records.push(FileRecord::of_drawing(&name, &svg, plan.dpi));
                let png = render::png(&scene, plan.dpi).map_err(|error| Error::Image { name: name.clone(), error })?;
                pages.push((name, png));
            }
        }
    }
    Ok((pages, records))
}

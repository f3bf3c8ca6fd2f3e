//! Binds the pages of families into a book, or several volumes of one.
//!
//! The cells are solved for it anew: a book is made where any page of it has changed, and then has all of them.

use coupler_curves::solve;
use std::path::Path;

use super::inputs::Inputs;
use super::journal::Journal;
use super::{Error, Event, Options, files, previous_run};
use crate::manifest::{Plan, PlannedFamily};
use crate::pipeline::{Composer, FamilyPipeline, Pagination, curves_by_page, measures_used_on_pages};
use crate::record::{BookRecord, FileRecord};
use crate::sweep::{self, CellGroups, CellSelection};
use coupler_curves::solve::SolvedCell;
use coupler_curves::template::CircuitSelection;
use coupler_drawing::chart::ChartBuilder;
use coupler_drawing::page::book::{self, Atlas, CellEntry, Chapter, IndexEntry, Volume};
use coupler_drawing::page::{Layout, PanelPage};
use coupler_drawing::render::{Format, pdf};
use coupler_drawing::scene::Scene;

/// The program, as a book names it.
const PROGRAM: &str = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));

/// Binds the families that are to be in the book, unless it is there as it would be.
///
/// Where only some families are asked for, a book is made of those if it is asked for in so many words, and left alone
/// otherwise.
pub(super) fn write(
    plan: &Plan,
    output: &Path,
    options: &Options,
    journal: &mut Journal,
    tell: &mut dyn FnMut(Event),
) -> Result<(), Error> {
    let is_bound = |planned: &&PlannedFamily| {
        let formats = options.formats.as_ref().unwrap_or(&planned.formats);
        let is_asked = options.only.is_empty() || options.only.contains(&planned.family.id);
        is_asked && formats.contains(&Format::Pdf)
    };
    let bound: Vec<&PlannedFamily> = plan.families.iter().filter(is_bound).collect();
    if options.formats.is_none() && !options.only.is_empty() || options.formats.is_some() && bound.is_empty() {
        return Ok(());
    }
    let earlier = journal.book().cloned();
    if bound.is_empty() {
        remove_stale_volumes(earlier.as_ref(), &[], output)?;
        return journal.set_book(None);
    }
    let inputs_sha256 = Inputs::book_digest(&bound, plan.volume_pages);
    let is_unchanged = |record: &&BookRecord| {
        let is_whole = |file: &FileRecord| file.inputs_sha256.is_some() && files::is_intact(output, file);
        record.inputs_sha256.as_ref() == Some(&inputs_sha256) && record.files.iter().all(is_whole)
    };
    if let Some(record) = earlier.as_ref().filter(|_| !options.force).filter(is_unchanged) {
        tell(Event::Book { record, is_drawn: false });
        return Ok(());
    }
    if let Some(earlier) = &earlier {
        // From here on, what was there may be replaced at any time.
        let files = earlier.files.iter().map(|file| FileRecord::from_name(&file.name)).collect();
        journal.set_book(Some(BookRecord { inputs_sha256: None, files, ..earlier.clone() }))?;
    }
    let files = write_volumes(plan, &bound, (output, &inputs_sha256), options, tell)?;
    let pages = files.iter().map(|(_, pages)| pages).sum();
    let files: Vec<FileRecord> = files.into_iter().map(|(file, _)| file).collect();
    remove_stale_volumes(earlier.as_ref(), &files, output)?;
    let record = BookRecord { inputs_sha256: Some(inputs_sha256), pages, files };
    tell(Event::Book { record: &record, is_drawn: true });
    journal.set_book(Some(record))
}

fn remove_stale_volumes(earlier: Option<&BookRecord>, stay: &[FileRecord], output: &Path) -> Result<(), Error> {
    let known = earlier.iter().flat_map(|record| &record.files).map(|file| file.name.as_str());
    files::remove_files(output, known.filter(|name| stay.iter().all(|file| file.name != **name)))
}

/// A family, and where its cells go.
struct FamilyPart<'a> {
    pipeline: FamilyPipeline<'a>,
    /// How many pages of the atlas stand before its own.
    pages_before: usize,
}

/// The chapter a family makes.
fn chapter<'a>(planned: &'a PlannedFamily, arrangement: &CellSelection, setting: &Pagination) -> Chapter<'a> {
    let family = &planned.family;
    let cell = |(k, &cell): (usize, &usize)| {
        // What is measured is not known yet.
        let [caption, _] = family.format_captions(&family.cell(cell), &[]);
        CellEntry { caption, page: setting.first_page(k) }
    };
    let cells =
        if planned.chart.is_none() { arrangement.page_order.iter().enumerate().map(cell).collect() } else { vec![] };
    // Points are counted for coupler grids; on the one circuit of the start each draws one curve.
    let is_counted = planned.layout == Layout::CouplerGrid && family.template.circuits == CircuitSelection::Start;
    let curves = is_counted.then(|| arrangement.point_counts.iter().sum());
    Chapter { title: &family.title, symbols: &family.names, curve_count: curves, page_count: setting.page_count, cells }
}

/// Composes all pages, adds them to the volumes in order, and writes these: their files, and how many pages they have.
fn write_volumes(
    plan: &Plan,
    bound: &[&PlannedFamily],
    (output, inputs_sha256): (&Path, &str),
    options: &Options,
    tell: &mut dyn FnMut(Event),
) -> Result<Vec<(FileRecord, usize)>, Error> {
    let mut parts: Vec<FamilyPart> = Vec::new();
    let mut chapters = Vec::new();
    let mut before = 0;
    for &planned in bound {
        let press = FamilyPipeline::new(plan, planned, &options.interrupt).ok_or(Error::Interrupted)?;
        chapters.push(chapter(planned, &press.arrangement, &press.pagination));
        let pages = press.pagination.page_count;
        parts.push(FamilyPart { pipeline: press, pages_before: before });
        before += pages;
    }
    let atlas = Atlas { title: &plan.title, program: PROGRAM, chapters };
    let first = parts.iter().find(|part| part.pipeline.composer.planned.chart.is_none()).and_then(first_cell);
    let frontispiece = first.as_ref().map(|(composer, solved)| composer.frontispiece(solved));
    let volumes = atlas.volumes(plan.volume_pages);
    tell(Event::Begin { family: "book", pages: before });
    let mut bindery = BookWriter {
        plan,
        atlas: &atlas,
        frontispiece: frontispiece.as_ref(),
        output,
        inputs_sha256,
        remaining_volumes: volumes.iter(),
        open_volume: None,
        geometries: Vec::new(),
        files: Vec::new(),
    };
    bindery.open_next_volume()?;
    for (number, part) in parts.iter().enumerate() {
        part.compose_pages(number, options, &mut |leaf: PageGroup| {
            bindery.geometries.extend(leaf.geometries);
            for scene in leaf.scenes {
                bindery.add_page(scene)?;
                tell(Event::Page);
            }
            Ok(())
        })?;
    }
    bindery.close_volume()?;
    Ok(bindery.files)
}

/// The first cell of a family that has a curve, of a coupler grid with those of the page in the middle.
fn first_cell<'a>(part: &'a FamilyPart) -> Option<(&'a Composer<'a>, SolvedCell)> {
    let family = &part.pipeline.composer.planned.family;
    let sampler = coupler_curves::motion::Sampler::new(family.sampling);
    let solved =
        part.pipeline.arrangement.page_order.iter().filter_map(|&cell| solve::solve_cell(family, &sampler, cell));
    let mut solved = solved.take(100).find(|solved| !solved.curves.is_empty())?;
    if part.pipeline.composer.planned.layout == Layout::CouplerGrid {
        let leaves = curves_by_page(&solved);
        let shown = &leaves[leaves.len() / 2];
        solved.curves = shown.iter().map(|&k| solved.curves[k].clone()).collect();
    }
    Some((&part.pipeline.composer, solved))
}

/// Pages that follow each other, and what the index will say of their cells.
struct PageGroup {
    scenes: Vec<Scene>,
    geometries: Vec<IndexEntry>,
}

/// About how many bytes a composed page takes: ten thousand points, and what it takes to find them.
const BYTES_PER_PAGE: usize = 1 << 20;

impl FamilyPart<'_> {
    /// Composes the pages of a family on all threads, and gives them to `take` in order.
    fn compose_pages(
        &self,
        number: usize,
        options: &Options,
        take: &mut dyn FnMut(PageGroup) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let FamilyPipeline { composer, arrangement, pagination: setting } = &self.pipeline;
        let family = &composer.planned.family;
        let (interrupt, chart) = (&*options.interrupt, &composer.planned.chart);
        let wanted = measures_used_on_pages(family);
        let wanted = Some(wanted.as_slice());
        let groups = CellGroups {
            cells: &arrangement.page_order,
            size: setting.group_size,
            work_bytes: BYTES_PER_PAGE,
            requested_measures: wanted,
        };
        if let Some(chart) = chart {
            let mut gathering = ChartBuilder::new(chart, family);
            let groups = CellGroups { cells: &arrangement.kept, requested_measures: None, ..groups };
            let gather =
                |_, solved: Vec<SolvedCell>| solved.iter().flat_map(|s| chart.sample_cell(s)).collect::<Vec<_>>();
            sweep::process_groups(family, groups, gather, |taken| {
                super::check_interrupt(interrupt)?;
                taken.into_iter().for_each(|taken| gathering.add(taken));
                Ok(())
            })?;
            let gathered = gathering.build();
            return (1..=setting.page_count).try_for_each(|page| {
                take(PageGroup { scenes: vec![composer.chart_page(page, chart, &gathered)], geometries: Vec::new() })
            });
        }
        let compose = |group: usize, solved: Vec<SolvedCell>| -> Result<PageGroup, Error> {
            super::check_interrupt(interrupt)?;
            Ok(self.compose_group(number, group, &solved))
        };
        sweep::process_groups(family, groups, compose, |leaf| take(leaf?))
    }

    /// The pages of a group of cells.
    fn compose_group(&self, number: usize, group: usize, solved: &[SolvedCell]) -> PageGroup {
        let FamilyPart { pipeline: FamilyPipeline { composer, pagination: setting, .. }, pages_before: before } = self;
        let family = &composer.planned.family;
        let geometry = |solved: &SolvedCell, page: &dyn Fn(usize) -> usize| {
            let [caption, _] = family.format_captions(&solved.cell, solved.first_curve_values());
            IndexEntry::from_solved_cell(solved, number, &caption, page)
        };
        let page = setting.first_page(group * setting.group_size);
        match (composer.planned.layout, solved) {
            (Layout::CouplerGrid, [solved]) => {
                let leaves = curves_by_page(solved);
                let on = |k: usize| leaves.iter().position(|shown| shown.contains(&k)).unwrap_or(0);
                let found = vec![geometry(solved, &|k| before + page + on(k))];
                PageGroup {
                    scenes: composer.coupler_grid_pages(page, solved).map(|(_, _, compose)| compose()).collect(),
                    geometries: found,
                }
            }
            _ => {
                let found = solved.iter().map(|solved| geometry(solved, &|_| before + page)).collect();
                PageGroup { scenes: vec![composer.panel_page(page, solved)], geometries: found }
            }
        }
    }
}

/// Where volumes are made, one after the other.
struct BookWriter<'a> {
    plan: &'a Plan,
    atlas: &'a Atlas<'a>,
    frontispiece: Option<&'a PanelPage<'a>>,
    output: &'a Path,
    inputs_sha256: &'a str,
    /// The volumes that are not begun.
    remaining_volumes: std::slice::Iter<'a, Volume>,
    open_volume: Option<OpenVolume<'a>>,
    /// What the index of the open volume will have, and perhaps a little of the next.
    geometries: Vec<IndexEntry>,
    /// The finished volumes, each with how many pages it has.
    files: Vec<(FileRecord, usize)>,
}

/// A volume that is being made.
struct OpenVolume<'a> {
    volume: &'a Volume,
    book: pdf::Book,
    /// How many pages stand before those of the families.
    front_pages: usize,
}

impl<'a> BookWriter<'a> {
    /// Adds a page of a family.
    fn add_page(&mut self, mut scene: Scene) -> Result<(), Error> {
        if self
            .open_volume
            .as_ref()
            .is_some_and(|open| open.book.page_count() == open.front_pages + open.volume.page_count)
        {
            self.close_volume()?;
            self.open_next_volume()?;
        }
        let Some(open) = &mut self.open_volume else { return Ok(()) };
        let label = book::page_number(open.volume, open.front_pages, open.book.page_count());
        book::draw_page_number(&mut scene, label, &self.plan.page);
        open.book.add_page(&scene, label).map_err(Error::Book)
    }

    /// Opens the next volume.
    fn open_next_volume(&mut self) -> Result<(), Error> {
        let Some(volume) = self.remaining_volumes.next() else { return Ok(()) };
        let mut book = pdf::Book::new(self.atlas.title, PROGRAM);
        let front = book::compose_front_matter(self.atlas, volume, self.frontispiece, &self.plan.page);
        for (place, scene) in front.iter().enumerate() {
            book.add_page(scene, book::page_number(volume, front.len(), place)).map_err(Error::Book)?;
        }
        self.open_volume = Some(OpenVolume { volume, book, front_pages: front.len() });
        Ok(())
    }

    /// Finishes the open volume, and writes it.
    fn close_volume(&mut self) -> Result<(), Error> {
        let Some(OpenVolume { volume, mut book, front_pages: front }) = self.open_volume.take() else { return Ok(()) };
        let index = book::compose_index(self.atlas, volume, front, &self.geometries, &self.plan.page);
        for scene in &index {
            let label = book::page_number(volume, front, book.page_count());
            book.add_page(scene, label).map_err(Error::Book)?;
        }
        // The cell at the seam may be in both volumes.
        self.geometries = self.geometries.pop().into_iter().collect();
        let pages = book.page_count();
        let bytes = book.finish(&book::outline(self.atlas, volume, [front, index.len()])).map_err(Error::Book)?;
        let record = FileRecord::from_name(previous_run::volume_name(volume)).with_inputs(self.inputs_sha256);
        files::write(&self.output.join(&record.name), &bytes)?;
        self.files.push((record, pages));
        Ok(())
    }
}

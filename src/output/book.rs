//! Writes the pages of families as a book, in one or several volumes.
//!
//! The book is written whole if any page of it has changed; its cells are then solved again.

use coupler_curves::solve;
use std::path::Path;

use super::inputs::Inputs;
use super::journal::{Journal, JournalFile};
use super::{Error, Event, Options, files, previous_run};
use crate::manifest::{Plan, PlannedFamily};
use crate::pipeline::{Composer, FamilyPipeline, build_chart, curves_by_page, measures_used_on_pages};
use crate::record::{BookRecord, Digest, FileRecord};
use crate::sweep::{self, CellGroups, CellIndices};
use coupler_curves::linkage::{FourBar, FourBarClass};
use coupler_curves::solve::SolvedCell;
use coupler_curves::template::CircuitSelection;
use coupler_drawing::chart::ChartBuilder;
use coupler_drawing::page::book::{self, Atlas, CellEntry, Chapter, IndexEntry, Volume};
use coupler_drawing::page::{Layout, PanelPage};
use coupler_drawing::render::{Format, pdf};
use coupler_drawing::scene::Scene;

/// The name and version of the program in the metadata of a book.
const PROGRAM: &str = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));

/// Writes the book of all families with the format `pdf`, unless it is up to date.
///
/// If the run is restricted to some families, their book is written only if the run also names the formats.
pub(super) fn write(
    plan: &Plan,
    output: &Path,
    options: &Options,
    journal: &mut Journal,
    report: &mut dyn FnMut(Event),
) -> Result<(), Error> {
    let is_in_book = |planned: &&PlannedFamily| {
        let formats = options.formats.as_ref().unwrap_or(&planned.formats);
        let is_selected = options.only.is_empty() || options.only.contains(&planned.family.id);
        is_selected && formats.contains(&Format::Pdf)
    };
    let selected: Vec<&PlannedFamily> = plan.families.iter().filter(is_in_book).collect();
    if options.formats.is_none() && !options.only.is_empty() || options.formats.is_some() && selected.is_empty() {
        return Ok(());
    }
    let earlier = journal.book().cloned();
    if selected.is_empty() {
        if earlier.is_some() {
            journal.file()?;
        }
        remove_stale_volumes(earlier.as_ref(), &[], output)?;
        return journal.set_book(None);
    }
    let inputs_sha256 = Inputs::book_digest(&selected, plan.volume_pages);
    let is_unchanged = |record: &&BookRecord| {
        let is_intact = |file: &FileRecord| file.inputs_sha256.is_some() && files::is_intact(output, file);
        record.inputs_sha256 == Some(inputs_sha256) && record.files.iter().all(is_intact)
    };
    if let Some(record) = earlier.as_ref().filter(|_| !options.force).filter(is_unchanged) {
        report(Event::Book { record, is_drawn: false });
        return Ok(());
    }
    // From here on, the files of an earlier run may be replaced at any time.
    let earlier_files = earlier.iter().flat_map(|earlier| earlier.files.clone()).collect();
    journal.set_book(Some(BookRecord { inputs_sha256: None, pages: 0, files: earlier_files }))?;
    let files = write_volumes(plan, &selected, (output, inputs_sha256, &*journal.file()?), options, report)?;
    let pages = files.iter().map(|(_, pages)| pages).sum();
    let files: Vec<FileRecord> = files.into_iter().map(|(file, _)| file).collect();
    remove_stale_volumes(earlier.as_ref(), &files, output)?;
    let record = BookRecord { inputs_sha256: Some(inputs_sha256), pages, files };
    report(Event::Book { record: &record, is_drawn: true });
    journal.set_book(Some(record))
}

fn remove_stale_volumes(earlier: Option<&BookRecord>, current: &[FileRecord], output: &Path) -> Result<(), Error> {
    let known = earlier.iter().flat_map(|record| &record.files).map(|file| file.name.as_str());
    files::remove_files(output, known.filter(|name| current.iter().all(|file| file.name != **name)))
}

/// A chapter of the book: a family, or those of its cells that have a chapter of their own.
struct FamilyPart<'a> {
    pipeline: &'a FamilyPipeline<'a>,
    title: String,
    /// The cells, in the order of their pages.
    cells: CellIndices,
    /// The positions of the cells in the order of the pages of the whole family.
    positions: CellIndices,
    /// The page of the chapter on which each cell begins, and the page after the last, from 1; empty if the chapter is
    /// the whole family.
    first_pages: Vec<usize>,
    /// The number of pages of the chapters before it.
    pages_before: usize,
}

/// The chapters of a family, after a number of pages. The change points of a coupler grid follow the other cells, in a
/// chapter of their own: their motion is not determined by their lengths.
fn family_parts<'a>(pipeline: &'a FamilyPipeline<'a>, pages_before: usize) -> Vec<FamilyPart<'a>> {
    let family = &pipeline.composer.planned.family;
    let order = pipeline.arrangement.page_order();
    let is_divisible = pipeline.composer.planned.layout == Layout::CouplerGrid;
    let is_change_point = |position: &u32| {
        let cell = order.get(*position as usize).map(|cell| family.cell(cell));
        let linkage = cell.and_then(|cell| family.linkage(&cell).ok());
        let four_bar = linkage.and_then(|linkage| FourBar::from_linkage(&linkage));
        four_bar.is_some_and(|four_bar| four_bar.class() == FourBarClass::ChangePoint)
    };
    let positions = (0..).take(if is_divisible { order.len() } else { 0 });
    let (change_points, others): (Vec<u32>, Vec<u32>) = positions.partition(is_change_point);
    if change_points.is_empty() || others.is_empty() {
        return vec![FamilyPart {
            pipeline,
            title: family.title.clone(),
            cells: order.clone(),
            positions: CellIndices::First(order.len()),
            first_pages: Vec::new(),
            pages_before,
        }];
    }
    let others = FamilyPart::with_positions(pipeline, family.title.clone(), others, pages_before);
    let title = format!("{}: change points", family.title);
    let change_points = FamilyPart::with_positions(pipeline, title, change_points, pages_before + others.page_count());
    vec![others, change_points]
}

impl<'a> FamilyPart<'a> {
    /// The chapter of the cells at some positions of a family in which each cell has pages of its own.
    fn with_positions(
        pipeline: &'a FamilyPipeline<'a>,
        title: String,
        positions: Vec<u32>,
        pages_before: usize,
    ) -> FamilyPart<'a> {
        let FamilyPipeline { arrangement, pagination, .. } = pipeline;
        let order = arrangement.page_order();
        let cell = |&position: &u32| order.get(position as usize).and_then(|cell| u32::try_from(cell).ok());
        let mut first_pages = vec![1];
        let mut next = 1;
        for &position in &positions {
            next += pagination.first_page(position as usize + 1) - pagination.first_page(position as usize);
            first_pages.push(next);
        }
        let cells = CellIndices::Listed(positions.iter().filter_map(cell).collect());
        FamilyPart { pipeline, title, cells, positions: CellIndices::Listed(positions), first_pages, pages_before }
    }

    fn page_count(&self) -> usize {
        self.first_pages.last().map_or(self.pipeline.pagination.page_count, |end| end - 1)
    }

    /// The page of the chapter on which its `k`-th cell begins, from 1.
    fn first_page(&self, k: usize) -> usize {
        self.first_pages.get(k).copied().unwrap_or_else(|| self.pipeline.pagination.first_page(k))
    }

    /// The number of the page of its family on which the `k`-th cell of the chapter begins, which its file has too.
    fn first_page_of_family(&self, k: usize) -> usize {
        self.pipeline.pagination.first_page(self.positions.get(k).unwrap_or(k))
    }

    /// The chapter as the contents list it.
    fn chapter(&self) -> Chapter<'_> {
        let FamilyPipeline { composer: Composer { planned, .. }, arrangement, .. } = self.pipeline;
        let family = &planned.family;
        let cell = |(k, cell): (usize, usize)| {
            // The values of measures are not known yet.
            let [caption, _] = family.format_captions(&family.cell(cell), &[]);
            CellEntry { caption, page: self.first_page(k) }
        };
        let cells = if planned.chart.is_none() { self.cells.iter().enumerate().map(cell).collect() } else { vec![] };
        // Points are counted for coupler grids; if only the starting circuit is traced, each point has one curve.
        let is_counted = planned.layout == Layout::CouplerGrid && family.template.circuits == CircuitSelection::Start;
        let count = |position: usize| arrangement.point_counts.get(position).map_or(0, |&count| count as usize);
        Chapter {
            title: &self.title,
            symbols: &family.names,
            curve_count: is_counted.then(|| self.positions.iter().map(count).sum()),
            page_count: self.page_count(),
            cells,
        }
    }
}

/// The approximate memory of the pages of a volume, which is written when it is complete, in bytes.
const MAX_VOLUME_BYTES: usize = 150_000_000;
/// The memory of a page of a book, and of each curve on it, in bytes.
const BYTES_PER_BOOK_PAGE: usize = 4_000;
const BYTES_PER_BOOK_CURVE: usize = 6_000;

/// The most pages of a volume for which it fits memory.
fn max_volume_pages(selected: &[&PlannedFamily]) -> usize {
    let bytes = |planned: &&PlannedFamily| {
        let curves = match planned.layout {
            Layout::Panels { .. } => planned.layout.cells_per_page() * planned.family.template.curve_count(),
            Layout::CouplerGrid => Layout::POINTS_PER_PAGE,
            Layout::Chart { .. } => 0,
        };
        BYTES_PER_BOOK_PAGE + curves * BYTES_PER_BOOK_CURVE
    };
    (MAX_VOLUME_BYTES / selected.iter().map(bytes).max().unwrap_or(BYTES_PER_BOOK_PAGE)).max(1)
}

/// Composes all pages and writes the volumes in order; returns their records and page counts.
fn write_volumes(
    plan: &Plan,
    selected: &[&PlannedFamily],
    (output, inputs_sha256, journal): (&Path, Digest, &JournalFile),
    options: &Options,
    report: &mut dyn FnMut(Event),
) -> Result<Vec<(FileRecord, usize)>, Error> {
    let pipelines = selected.iter().map(|planned| FamilyPipeline::new(plan, planned, &options.interrupt));
    let pipelines: Vec<FamilyPipeline> = pipelines.collect::<Option<_>>().ok_or(Error::Interrupted)?;
    let mut parts: Vec<FamilyPart> = Vec::new();
    let mut page_count = 0;
    for pipeline in &pipelines {
        parts.extend(family_parts(pipeline, page_count));
        page_count += pipeline.pagination.page_count;
    }
    let atlas =
        Atlas { title: &plan.title, program: PROGRAM, chapters: parts.iter().map(FamilyPart::chapter).collect() };
    let first = pipelines.iter().find(|pipeline| pipeline.composer.planned.chart.is_none()).and_then(first_cell);
    let frontispiece = first.as_ref().map(|(composer, solved)| composer.frontispiece(solved));
    let volumes = atlas.volumes(plan.volume_pages.min(max_volume_pages(selected)));
    report(Event::Begin { family: "book", pages: page_count });
    let mut writer = BookWriter {
        plan,
        atlas: &atlas,
        frontispiece: frontispiece.as_ref(),
        output,
        inputs_sha256,
        journal,
        remaining_volumes: volumes.iter(),
        open_volume: None,
        geometries: Vec::new(),
        files: Vec::new(),
    };
    writer.open_next_volume()?;
    for (number, part) in parts.iter().enumerate() {
        part.compose_pages(number, options, &mut |group_pages: PageGroup| {
            writer.geometries.extend(group_pages.geometries);
            for scene in group_pages.scenes {
                writer.add_page(scene)?;
                report(Event::Page);
            }
            Ok(())
        })?;
    }
    writer.close_volume()?;
    Ok(writer.files)
}

/// The first cell of a family that has a curve, among its first hundred; of a coupler grid, with the curves of the
/// middle page only.
fn first_cell<'a>(pipeline: &'a FamilyPipeline) -> Option<(&'a Composer<'a>, SolvedCell)> {
    let family = &pipeline.composer.planned.family;
    let sampler = coupler_curves::motion::Sampler::new(family.sampling);
    let order = pipeline.arrangement.page_order();
    let solved = order.iter().filter_map(|cell| solve::solve_cell(family, &sampler, cell));
    let mut solved = solved.take(100).find(|solved| !solved.curves.is_empty())?;
    if pipeline.composer.planned.layout == Layout::CouplerGrid {
        let pages = curves_by_page(&solved);
        let shown = &pages[pages.len() / 2];
        solved.curves = shown.iter().map(|&k| solved.curves[k].clone()).collect();
    }
    Some((&pipeline.composer, solved))
}

/// Consecutive pages, and the index entries of their cells.
struct PageGroup {
    scenes: Vec<Scene>,
    geometries: Vec<IndexEntry>,
}

/// The approximate memory of a composed page, in bytes: ten thousand points, and the work to compute them.
const BYTES_PER_PAGE: usize = 1 << 20;

impl FamilyPart<'_> {
    /// Composes the pages of a chapter on all threads, and passes them to `add_pages` in order.
    fn compose_pages(
        &self,
        number: usize,
        options: &Options,
        add_pages: &mut dyn FnMut(PageGroup) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let FamilyPipeline { composer, arrangement, pagination } = self.pipeline;
        let family = &composer.planned.family;
        let (interrupt, chart) = (&*options.interrupt, &composer.planned.chart);
        let measures = measures_used_on_pages(composer.planned);
        let measures = Some(measures.as_slice());
        let groups = CellGroups {
            cells: &self.cells,
            first_group: 0,
            size: pagination.group_size,
            work_bytes: BYTES_PER_PAGE,
            requested_measures: measures,
        };
        if let Some(chart) = chart {
            let mut builder = ChartBuilder::new(chart, family);
            let groups = CellGroups { cells: &arrangement.kept, requested_measures: None, ..groups };
            let sample = |_, solved: Vec<SolvedCell>| {
                solved.iter().flat_map(|s| chart.sample_cell(family, s)).collect::<Vec<_>>()
            };
            sweep::process_groups(family, groups, sample, |samples| {
                super::check_interrupt(interrupt)?;
                samples.into_iter().for_each(|sample| builder.add(sample));
                Ok(())
            })?;
            let chart_data = build_chart(builder);
            return (1..=pagination.page_count).try_for_each(|page| {
                add_pages(PageGroup {
                    scenes: vec![composer.chart_page(page, chart, &chart_data)],
                    geometries: Vec::new(),
                })
            });
        }
        let compose = |group: usize, solved: Vec<SolvedCell>| -> Result<PageGroup, Error> {
            super::check_interrupt(interrupt)?;
            Ok(self.compose_group(number, group, &solved))
        };
        sweep::process_groups(family, groups, compose, |group_pages| add_pages(group_pages?))
    }

    /// Composes the pages of a group of cells.
    fn compose_group(&self, number: usize, group: usize, solved: &[SolvedCell]) -> PageGroup {
        let FamilyPipeline { composer, pagination, .. } = self.pipeline;
        let family = &composer.planned.family;
        let index_entry = |solved: &SolvedCell, page: &dyn Fn(usize) -> usize| {
            let [caption, _] = family.format_captions(&solved.cell, solved.first_curve_values());
            IndexEntry::from_solved_cell(solved, number, &caption, page)
        };
        let first = group * pagination.group_size;
        let (page, book_page) = (self.first_page_of_family(first), self.pages_before + self.first_page(first));
        match (composer.planned.layout, solved) {
            (Layout::CouplerGrid, [solved]) => {
                let pages = curves_by_page(solved);
                let page_offset = |k: usize| pages.iter().position(|shown| shown.contains(&k)).unwrap_or(0);
                let geometries = vec![index_entry(solved, &|k| book_page + page_offset(k))];
                PageGroup {
                    scenes: composer.coupler_grid_pages(page, solved).map(|(_, _, compose)| compose()).collect(),
                    geometries,
                }
            }
            _ => {
                let geometries = solved.iter().map(|solved| index_entry(solved, &|_| book_page)).collect();
                PageGroup { scenes: vec![composer.panel_page(page, solved)], geometries }
            }
        }
    }
}

/// Writes the volumes of a book, one after another.
struct BookWriter<'a> {
    plan: &'a Plan,
    atlas: &'a Atlas<'a>,
    frontispiece: Option<&'a PanelPage<'a>>,
    output: &'a Path,
    inputs_sha256: Digest,
    journal: &'a JournalFile,
    /// The volumes not begun yet.
    remaining_volumes: std::slice::Iter<'a, Volume>,
    open_volume: Option<OpenVolume<'a>>,
    /// The index entries of the open volume, and possibly some of the next.
    geometries: Vec<IndexEntry>,
    /// The finished volumes, each with its page count.
    files: Vec<(FileRecord, usize)>,
}

/// A volume that is being written.
struct OpenVolume<'a> {
    volume: &'a Volume,
    book: pdf::Book,
    /// The number of pages of front matter.
    front_pages: usize,
}

impl<'a> BookWriter<'a> {
    /// Adds a page of a family; opens the next volume if this one is full.
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

    /// Adds the index to the open volume, and writes it.
    fn close_volume(&mut self) -> Result<(), Error> {
        let Some(OpenVolume { volume, mut book, front_pages: front }) = self.open_volume.take() else { return Ok(()) };
        let index = book::compose_index(self.atlas, volume, front, &self.geometries, &self.plan.page);
        for scene in &index {
            let label = book::page_number(volume, front, book.page_count());
            book.add_page(scene, label).map_err(Error::Book)?;
        }
        // A cell whose pages cross the volumes is in the indices of both.
        self.geometries = self.geometries.pop().into_iter().collect();
        let pages = book.page_count();
        let bytes = book.finish(&book::outline(self.atlas, volume, [front, index.len()])).map_err(Error::Book)?;
        let name = previous_run::volume_name(volume);
        let record = self.journal.replace_file("", &name, || {
            files::write(&self.output.join(&name), &bytes)?;
            Ok(FileRecord::from_book(name.clone(), &bytes).with_inputs(self.inputs_sha256))
        })?;
        self.files.push((record, pages));
        Ok(())
    }
}

//! The chapters of a book, and their pages.

use std::collections::{BTreeSet, HashMap};

use super::super::survey::FamilySurvey;
use super::super::{Error, Options, check_interrupt};
use super::sections::{self, ListedCell};
use crate::manifest::BookPlan;
use crate::pipeline::{Composer, FamilyPipeline, build_chart, measures_used_on_pages};
use crate::sweep::{self, CellGroups, CellIndices};

use coupler_curves::family::ParameterSpace;
use coupler_curves::solve::{SolvedCell, Solver};
use coupler_curves::template::CircuitSelection;
use coupler_drawing::chart::ChartBuilder;
use coupler_drawing::page::Layout;
use coupler_drawing::page::book::{CellEntry, Chapter, Tab};
use coupler_drawing::scene::Scene;

/// A family of the book with what is known of its cells.
pub(super) struct BookFamily<'a> {
    /// Its place among the families of the plan.
    pub number: usize,
    pub pipeline: FamilyPipeline<'a>,
    pub survey: FamilySurvey,
}

impl BookFamily<'_> {
    /// A solver of its cells, which computes the measures that pages need.
    pub fn page_solver(&self) -> Solver<'_> {
        let planned = self.pipeline.composer.planned;
        Solver::new(&planned.family).measuring(measures_used_on_pages(planned))
    }

    /// Solves a cell by its index, and measures it unless it has been.
    pub fn solve(&self, solver: &Solver, cell: usize) -> Option<SolvedCell> {
        self.solve_known(solver, cell).or_else(|| solver.solve(cell))
    }

    /// Solves a cell that has been measured.
    fn solve_known(&self, solver: &Solver, cell: usize) -> Option<SolvedCell> {
        let measured = self.survey.curves.get(&u32::try_from(cell).ok()?)?;
        solver.solve_measured(cell, measured.clone())
    }
}

/// A chapter of the book: a family, or those of its cells that have a chapter of their own.
pub(super) struct FamilyPart<'a> {
    pub family: &'a BookFamily<'a>,
    pub title: String,
    /// Whether it is the only one of its family, or the first.
    is_main: bool,
    /// The cells, in the order of their pages.
    pub cells: CellIndices,
    /// The positions of the cells in the order of the pages of the whole family.
    positions: CellIndices,
    /// The page of the chapter on which each cell begins, and the page after the last, from 1; empty if the chapter is
    /// the whole family.
    first_pages: Vec<usize>,
    /// The number of pages of the chapters before it.
    pub pages_before: usize,
}

/// The chapters of a family, after a number of pages: its cells, without those that the book has chapters for, and these.
pub(super) fn family_parts<'a>(
    family: &'a BookFamily<'a>,
    book: &BookPlan,
    mut pages_before: usize,
) -> Vec<FamilyPart<'a>> {
    let BookFamily { pipeline, survey, .. } = family;
    let order = pipeline.arrangement.page_order();
    let title = &pipeline.composer.planned.family.title;
    let is_divisible = pipeline.composer.planned.chart.is_none() && !survey.chapters.is_empty();
    let mut groups: Vec<Vec<u32>> = vec![Vec::new(); 1 + book.chapters.len()];
    for position in (0..).take(if is_divisible { order.len() } else { 0 }) {
        let cell = order.get(position as usize).and_then(|cell| u32::try_from(cell).ok());
        let chapter = cell.and_then(|cell| survey.chapters.get(&cell)).map_or(0, |chapter| chapter + 1);
        groups[chapter].push(position);
    }
    if groups[1..].iter().all(Vec::is_empty) {
        return vec![FamilyPart {
            family,
            title: title.clone(),
            is_main: true,
            cells: order.clone(),
            positions: CellIndices::Range(0..order.len()),
            first_pages: Vec::new(),
            pages_before,
        }];
    }
    let titles = book.chapters.iter().map(|chapter| format!("{title}: {}", chapter.title));
    let titles: Vec<String> = std::iter::once(title.clone()).chain(titles).collect();
    let mut parts = Vec::new();
    for (title, positions) in titles.into_iter().zip(groups).filter(|(_, group)| !group.is_empty()) {
        let part = FamilyPart::with_positions((family, title, parts.is_empty()), positions, pages_before);
        pages_before += part.page_count();
        parts.push(part);
    }
    parts
}

impl<'a> FamilyPart<'a> {
    /// The chapter of the cells at some positions of a family.
    fn with_positions(
        (family, title, is_main): (&'a BookFamily<'a>, String, bool),
        positions: Vec<u32>,
        pages_before: usize,
    ) -> FamilyPart<'a> {
        let FamilyPipeline { arrangement, pagination, composer } = &family.pipeline;
        let order = arrangement.page_order();
        let cell = |&position: &u32| order.get(position as usize).and_then(|cell| u32::try_from(cell).ok());
        let mut first_pages = vec![1];
        let mut next = 1;
        for (k, &position) in positions.iter().enumerate() {
            next += match composer.planned.layout {
                Layout::CouplerGrid => {
                    pagination.first_page(position as usize + 1) - pagination.first_page(position as usize)
                }
                // The last cell of a page begins the next, and so does the last of all.
                _ => usize::from((k + 1) % pagination.group_size == 0 || k + 1 == positions.len()),
            };
            first_pages.push(next);
        }
        let cells = CellIndices::Listed(positions.iter().filter_map(cell).collect());
        let positions = CellIndices::Listed(positions);
        FamilyPart { family, title, is_main, cells, positions, first_pages, pages_before }
    }

    pub fn page_count(&self) -> usize {
        self.first_pages.last().map_or(self.family.pipeline.pagination.page_count, |end| end - 1)
    }

    /// The page of the chapter on which its `k`-th cell begins, from 1.
    pub fn first_page(&self, k: usize) -> usize {
        self.first_pages.get(k).copied().unwrap_or_else(|| self.family.pipeline.pagination.first_page(k))
    }

    /// The chapter as the contents list it.
    pub fn chapter(&self) -> Chapter<'_> {
        let FamilyPipeline { composer: Composer { planned, captions, .. }, arrangement, .. } = &self.family.pipeline;
        let family = &planned.family;
        let cell = |(k, cell): (usize, usize)| {
            let caption = captions.of_unsolved_cell(&family.cell(cell));
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
            sections: self.sections(&cells),
            cells,
        }
    }

    /// What the contents list of the chapter.
    fn sections(&self, cells: &[CellEntry]) -> Vec<(CellEntry, usize)> {
        let planned = self.family.pipeline.composer.planned;
        let listed: Vec<ListedCell> = (self.cells.iter().enumerate().zip(cells))
            .map(|((k, index), entry)| {
                // The last page of a cell that shares its last page with the next is that on which the next begins.
                let end = if k + 1 < cells.len() { self.first_page(k + 1) } else { self.page_count() + 1 };
                let last_page = if planned.layout == Layout::CouplerGrid { end - 1 } else { entry.page };
                ListedCell { entry, values: planned.family.cell(index).values, last_page }
            })
            .collect();
        sections::of_cells(&listed, &planned.family)
    }

    /// The marks of the chapter in the thumb index: one for each value of the first parameter of its grid, if its pages are in that
    /// order and there are not too many or too few; otherwise one.
    ///
    /// In an atlas of several families, marks have the number of the chapter and a short title.
    pub fn tabs(&self, (number, short_title): (usize, &str), is_only_family: bool) -> Vec<Tab> {
        /// The least number of pages that are divided, and the most marks.
        const LEAST_PAGES: usize = 24;
        const MOST_TABS: usize = 12;
        let planned = self.family.pipeline.composer.planned;
        let family = &planned.family;
        let title = self.title.strip_prefix(&format!("{}: ", family.title)).filter(|_| !self.is_main);
        let label = if is_only_family { title.unwrap_or(&self.title) } else { short_title };
        let label = label.to_owned();
        let number = (!is_only_family).then_some(number);
        let whole = vec![Tab { number, label, first_page: self.pages_before + 1 }];
        let ParameterSpace::Grid(axes) = &family.space else { return whole };
        let is_in_order = self.is_main && is_only_family && family.sort.is_none() && planned.chart.is_none();
        let (Some(axis), true) = (axes.first(), is_in_order && self.page_count() >= LEAST_PAGES) else { return whole };
        let mut tabs: Vec<(f64, Tab)> = Vec::new();
        for (k, cell) in self.cells.iter().enumerate() {
            let value = family.cell(cell).values.get(axis.slot).copied().unwrap_or(f64::NAN);
            if tabs.last().is_none_or(|(last, _)| *last != value) {
                let label = family.equation(axis.slot, value).to_string();
                tabs.push((value, Tab { number: None, label, first_page: self.pages_before + self.first_page(k) }));
            }
            if tabs.len() > MOST_TABS {
                return whole;
            }
        }
        if tabs.len() > 1 { tabs.into_iter().map(|(_, tab)| tab).collect() } else { whole }
    }
}

/// The chapters and the first pages of some cells: by the place of a family in the plan and the index of a cell.
pub(super) type CellPlaces = HashMap<(usize, u32), (usize, usize)>;

/// Finds the chapters and first pages of cells.
pub(super) fn find_cells(parts: &[FamilyPart], wanted: &BTreeSet<(usize, u32)>) -> CellPlaces {
    let mut found = HashMap::new();
    for (chapter, part) in parts.iter().enumerate() {
        for (k, cell) in part.cells.iter().enumerate() {
            let key = (part.family.number, u32::try_from(cell).unwrap_or(u32::MAX));
            if wanted.contains(&key) {
                found.insert(key, (chapter, part.pages_before + part.first_page(k)));
            }
        }
    }
    found
}

/// The approximate memory of a composed page, in bytes: ten thousand points, and the work to compute them.
const BYTES_PER_PAGE: usize = 1 << 20;

impl FamilyPart<'_> {
    /// Composes the pages of a chapter on all threads, and passes them to `add_pages` in order.
    pub fn compose_pages(
        &self,
        options: &Options,
        add_pages: &mut dyn FnMut(Vec<Scene>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let FamilyPipeline { composer, arrangement, pagination } = &self.family.pipeline;
        let composer = &composer.with_title(&self.title);
        let family = &composer.planned.family;
        let (interrupt, chart) = (&*options.interrupt, &composer.planned.chart);
        let solve_known = |solver: &Solver, cell: usize| self.family.solve_known(solver, cell);
        let groups = CellGroups {
            cells: &self.cells,
            first_group: 0,
            size: pagination.group_size,
            work_bytes: BYTES_PER_PAGE,
            requested_measures: Some(measures_used_on_pages(composer.planned)),
            solve_known: Some(&solve_known),
        };
        if let Some(chart) = chart {
            let mut builder = ChartBuilder::new(chart, family);
            let groups = CellGroups { cells: &arrangement.kept, requested_measures: None, solve_known: None, ..groups };
            let sample = |_, solved: Vec<SolvedCell>| {
                solved.iter().flat_map(|s| chart.sample_cell(family, s)).collect::<Vec<_>>()
            };
            sweep::process_groups(family, groups, sample, |samples| {
                check_interrupt(interrupt)?;
                samples.into_iter().for_each(|sample| builder.add(sample));
                Ok(())
            })?;
            let chart_data = build_chart(builder);
            return (1..=pagination.page_count)
                .try_for_each(|page| add_pages(vec![composer.chart_page(page, chart, &chart_data)]));
        }
        let compose = |_: usize, solved: Vec<SolvedCell>| -> Result<Vec<Scene>, Error> {
            check_interrupt(interrupt)?;
            Ok(compose_group(composer, &solved))
        };
        sweep::process_groups(family, groups, compose, |scenes| add_pages(scenes?))
    }
}

/// Composes the pages of a group of cells.
pub(super) fn compose_group(composer: &Composer, solved: &[SolvedCell]) -> Vec<Scene> {
    // Pages have the numbers of the book only.
    match (composer.planned.layout, solved) {
        (Layout::CouplerGrid, [solved]) => {
            composer.coupler_grid_pages(1, solved).map(|(_, _, compose)| compose()).collect()
        }
        _ => vec![composer.panel_page(1, solved)],
    }
}

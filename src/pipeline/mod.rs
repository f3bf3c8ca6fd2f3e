//! The tables and pages of a family as they come off the press, in order: [`crate::output`] writes them, and
//! [`crate::check`] holds them against those that were written.

mod composer;
mod pagination;

pub use composer::{Composer, curves_by_page};
pub use pagination::{Pagination, measures_used_on_pages};

use std::sync::atomic::AtomicBool;

use crate::manifest::{Plan, PlannedFamily};
use crate::sweep::{self, CellGroups, CellSelection};
use coupler_curves::solve::SolvedCell;
use coupler_drawing::chart::{Chart, ChartBuilder, ChartSample};
use coupler_drawing::page::Layout;
use coupler_drawing::render::PageFormat;
use coupler_drawing::scene::Scene;

/// The name of the file of a page.
pub fn page_file_name(family: &str, page: usize, format: PageFormat) -> String {
    format!("{family}-{page:03}.{}", format.name())
}

/// A family that is to be printed.
#[derive(Debug)]
pub struct FamilyPipeline<'a> {
    /// What its pages show.
    pub composer: Composer<'a>,
    /// Which cells are shown, and in what order.
    pub arrangement: CellSelection,
    /// How they are put on pages.
    pub pagination: Pagination,
}

/// A page that is to be composed.
pub struct PageJob<'a> {
    /// Its number, from 1.
    pub number: usize,
    /// What is on it.
    pub content: PageContent<'a>,
    compose: Box<dyn FnOnce() -> Scene + 'a>,
}

/// What is on a page.
#[derive(Clone, Copy, Debug)]
pub enum PageContent<'a> {
    /// Curves of some cells.
    Cells {
        /// The cells.
        cells: &'a [SolvedCell],
        /// Of a coupler grid the places of the curves; otherwise all curves are shown, and nothing is here.
        curves: &'a [usize],
    },
    /// Charts, on which every cell of the family may count.
    Charts,
}

impl PageJob<'_> {
    /// Composes the page.
    pub fn compose(self) -> Scene {
        (self.compose)()
    }
}

/// What is done with what comes off the press, on all threads.
pub trait Sink: Sync {
    /// What comes of a group of cells.
    type CellsOutput: Send;
    /// What comes of a page.
    type PageOutput: Send;
    /// Why it stops.
    type Error: Send;

    /// Takes the next cells, in the order of their numbers.
    ///
    /// # Errors
    /// Whatever ends the run.
    fn receive_cells(&self, solved: &[SolvedCell]) -> Result<Self::CellsOutput, Self::Error>;

    /// Takes a page.
    ///
    /// # Errors
    /// Whatever ends the run.
    fn receive_page(&self, leaf: PageJob) -> Result<Self::PageOutput, Self::Error>;

    /// About how many bytes it takes to work on a page.
    fn bytes_per_page(&self) -> usize;
}

/// What has come off the press.
#[derive(Debug)]
pub enum Output<C, P> {
    /// Cells, in the order of their numbers.
    Cells(C),
    /// A page, in the order of pages.
    Page(P),
}

/// What comes of a group of cells, and what charts take of them.
type GroupOutput<H> = (Option<<H as Sink>::CellsOutput>, Vec<<H as Sink>::PageOutput>, Vec<ChartSample>);

impl<'a> FamilyPipeline<'a> {
    /// The press for a family; nothing where `stop` becomes true while its cells are arranged.
    pub fn new(plan: &'a Plan, planned: &'a PlannedFamily, stop: &AtomicBool) -> Option<FamilyPipeline<'a>> {
        let counts_points = planned.layout == Layout::CouplerGrid;
        let arrangement = sweep::select_cells(&planned.family, counts_points, stop)?;
        let setting = Pagination::new(planned, &arrangement);
        let composer = Composer { plan, planned, page_count: setting.page_count };
        Some(FamilyPipeline { composer, arrangement, pagination: setting })
    }

    /// Solves and measures all cells and hands them and their pages to `hand` on all threads, and what comes of them, in
    /// order, to `take` on the thread that calls.
    ///
    /// # Errors
    /// The first error of either.
    pub fn run<H: Sink>(
        &self,
        hand: &H,
        mut take: impl FnMut(Output<H::CellsOutput, H::PageOutput>) -> Result<(), H::Error>,
    ) -> Result<(), H::Error> {
        let planned = self.composer.planned;
        let chart = planned.chart.as_ref();
        let is_sorted = planned.family.sort.is_some();
        let mut gathering = chart.map(|chart| ChartBuilder::new(chart, &planned.family));
        let make = |group: usize, solved: Vec<SolvedCell>| -> Result<GroupOutput<H>, H::Error> {
            let cells = hand.receive_cells(&solved)?;
            let pages = if chart.is_none() && !is_sorted { self.send_pages(group, &solved, hand)? } else { Vec::new() };
            let taken = chart.iter().flat_map(|chart| solved.iter().flat_map(|solved| chart.sample_cell(solved)));
            Ok((Some(cells), pages, taken.collect()))
        };
        let mut off = |made: Result<GroupOutput<H>, H::Error>| {
            let (cells, pages, taken) = made?;
            if let Some(gathering) = &mut gathering {
                taken.into_iter().for_each(|taken| gathering.add(taken));
            }
            cells.into_iter().try_for_each(|cells| take(Output::Cells(cells)))?;
            pages.into_iter().try_for_each(|page| take(Output::Page(page)))
        };
        sweep::process_groups(&planned.family, self.cell_groups(&self.arrangement.kept, hand, None), make, &mut off)?;
        if chart.is_none() && is_sorted {
            // The order of the tables is that of the cells, the order of pages their own.
            let wanted = measures_used_on_pages(&planned.family);
            let groups = self.cell_groups(&self.arrangement.page_order, hand, Some(&wanted));
            let make =
                |group: usize, solved: Vec<SolvedCell>| Ok((None, self.send_pages(group, &solved, hand)?, Vec::new()));
            sweep::process_groups(&planned.family, groups, make, &mut off)?;
        }
        match (chart, gathering) {
            (Some(chart), Some(gathering)) => self.send_charts(chart, gathering, hand, &mut take),
            _ => Ok(()),
        }
    }

    fn cell_groups<'c>(&self, cells: &'c [usize], hand: &impl Sink, wanted: Option<&'c [bool]>) -> CellGroups<'c> {
        CellGroups {
            cells,
            size: self.pagination.group_size,
            work_bytes: hand.bytes_per_page(),
            requested_measures: wanted,
        }
    }

    /// The pages of a group of cells.
    fn send_pages<H: Sink>(
        &self,
        group: usize,
        cells: &[SolvedCell],
        hand: &H,
    ) -> Result<Vec<H::PageOutput>, H::Error> {
        let page = self.pagination.first_page(group * self.pagination.group_size);
        match (self.composer.planned.layout, cells) {
            (Layout::CouplerGrid, [solved]) => {
                let print = |(page, shown, compose): (usize, Vec<usize>, _)| {
                    hand.receive_page(PageJob {
                        number: page,
                        content: PageContent::Cells { cells, curves: &shown },
                        compose: Box::new(compose),
                    })
                };
                self.composer.coupler_grid_pages(page, solved).map(print).collect()
            }
            _ => {
                let compose = Box::new(move || self.composer.panel_page(page, cells));
                Ok(vec![hand.receive_page(PageJob {
                    number: page,
                    content: PageContent::Cells { cells, curves: &[] },
                    compose,
                })?])
            }
        }
    }

    fn send_charts<H: Sink>(
        &self,
        chart: &Chart,
        gathering: ChartBuilder,
        hand: &H,
        take: &mut impl FnMut(Output<H::CellsOutput, H::PageOutput>) -> Result<(), H::Error>,
    ) -> Result<(), H::Error> {
        let gathered = gathering.build();
        for page in 1..=self.pagination.page_count {
            let compose = Box::new(|| self.composer.chart_page(page, chart, &gathered));
            take(Output::Page(hand.receive_page(PageJob { number: page, content: PageContent::Charts, compose })?))?;
        }
        Ok(())
    }
}

//! Produces the tables and pages of a family in order: [`crate::output`] writes them, and [`crate::check`] compares
//! them with recorded ones.

mod captions;
mod charts;
mod composer;
mod inputs;
mod kept_cells;
mod pagination;

pub use captions::Captions;
#[cfg(feature = "pdf")]
pub use charts::build_chart;
pub use composer::Composer;
#[cfg(feature = "pdf")]
pub use composer::curves_by_page;
pub use inputs::Inputs;
pub use pagination::{Pagination, cells_solved_for_page, known_page_count, measures_used_on_pages};

use std::ops::Range;
use std::sync::atomic::AtomicBool;
use std::sync::{Mutex, PoisonError};

use self::kept_cells::KeptCells;
use crate::manifest::{Plan, PlannedFamily};
use crate::record::Digest;
use crate::sweep::{self, CellGroups, CellIndices, CellSelection};
use coupler_curves::measure::MeasureSet;
use coupler_curves::solve::{SolvedCell, Solver};
use coupler_drawing::chart::{Chart, ChartBuilder, ChartSample};
use coupler_drawing::page::Layout;
use coupler_drawing::render::PageFormat;
use coupler_drawing::scene::Scene;

/// The most pages of a family whose files are all in its folder, and the number of pages in a subfolder of a family with
/// more.
pub const PAGES_PER_FOLDER: usize = 1000;

/// The file name of a page in the folder of its family; `of` is the number of pages of the family. A family of more than
/// [`PAGES_PER_FOLDER`] pages has them in subfolders, as in `1001-2000/evans-1234.svg`.
pub fn page_file_name(family: &str, page: usize, of: usize, format: PageFormat) -> String {
    let name = format!("{family}-{page:03}.{}", format.name());
    if of <= PAGES_PER_FOLDER {
        return name;
    }
    let first = page.saturating_sub(1) / PAGES_PER_FOLDER * PAGES_PER_FOLDER + 1;
    let last = (first + PAGES_PER_FOLDER - 1).min(of);
    let width = of.to_string().len();
    format!("{first:0width$}-{last:0width$}/{name}")
}

/// How much of the output of a family an earlier run has delivered: it is not produced again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GroupsDone {
    /// The number of groups of cells, with their pages unless those are sorted.
    pub groups: usize,
    /// The number of groups of sorted cells, with their pages.
    pub sorted_groups: usize,
}

/// Solves the cells of a family and composes its pages.
#[derive(Debug)]
pub struct FamilyPipeline<'a> {
    /// Composes its pages.
    pub composer: Composer<'a>,
    /// Which cells are shown, and in what order.
    pub arrangement: CellSelection,
    /// How the cells are distributed over pages.
    pub pagination: Pagination,
}

/// A page to be composed.
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
    /// The curves of some cells.
    Cells {
        /// The cells.
        cells: &'a [SolvedCell],
        /// On a page of a coupler grid, the indices of its curves; empty on other pages, which show all curves.
        curves: &'a [usize],
    },
    /// Charts, which may show every cell of the family.
    Charts,
}

impl PageJob<'_> {
    /// The digest of what the page is made from; `composer` is that of its family.
    pub fn inputs_digest(&self, composer: &Composer) -> Digest {
        let inputs = Inputs::new(composer.planned);
        match self.content {
            PageContent::Cells { cells, curves } => {
                inputs.page_digest((self.number, composer.page_count), &composer.common_text(), cells, curves)
            }
            PageContent::Charts => inputs.chart_page_digest(self.number),
        }
    }

    /// Composes the page.
    pub fn compose(self) -> Scene {
        (self.compose)()
    }
}

/// Receives solved cells and composed pages; called on every worker thread.
pub trait Sink: Sync {
    /// The result for a group of cells.
    type CellsOutput: Send;
    /// The result for a page.
    type PageOutput: Send;
    /// The error that ends the run.
    type Error: Send;

    /// Processes a group of cells, which are in the order of their numbers.
    ///
    /// # Errors
    /// Any error ends the run.
    fn receive_cells(&self, solved: &[SolvedCell]) -> Result<Self::CellsOutput, Self::Error>;

    /// Processes a page.
    ///
    /// # Errors
    /// Any error ends the run.
    fn receive_page(&self, job: PageJob) -> Result<Self::PageOutput, Self::Error>;

    /// The approximate memory for processing a page, in bytes.
    fn bytes_per_page(&self) -> usize;
}

/// Passes on some pages only, by their numbers, and no cells.
struct PageSelection<'s, S> {
    sink: &'s S,
    pages: Range<usize>,
}

impl<S: Sink> Sink for PageSelection<'_, S> {
    type CellsOutput = ();
    type PageOutput = Option<S::PageOutput>;
    type Error = S::Error;

    fn receive_cells(&self, _: &[SolvedCell]) -> Result<(), S::Error> {
        Ok(())
    }

    fn receive_page(&self, job: PageJob) -> Result<Option<S::PageOutput>, S::Error> {
        self.pages.contains(&job.number).then(|| self.sink.receive_page(job)).transpose()
    }

    fn bytes_per_page(&self) -> usize {
        self.sink.bytes_per_page()
    }
}

/// The results of a [`Sink`].
#[derive(Debug)]
pub enum Output<C, P> {
    /// The result for cells, in the order of their numbers.
    Cells(C),
    /// The result for a page, in the order of pages.
    Page(P),
    /// Everything up to here has been delivered. Families with charts have no such places, since their pages depend on
    /// all cells.
    Done(GroupsDone),
}

/// The results for a group of cells and its pages, and the samples that charts take from it.
type GroupOutput<S> = (Option<<S as Sink>::CellsOutput>, Vec<<S as Sink>::PageOutput>, Vec<ChartSample>);

impl<'a> FamilyPipeline<'a> {
    /// Prepares the pipeline of a family; `None` if `stop` becomes true while its cells are selected.
    pub fn new(plan: &'a Plan, planned: &'a PlannedFamily, stop: &AtomicBool) -> Option<FamilyPipeline<'a>> {
        let arrangement = sweep::select_cells(&planned.family, pagination::counts_points(planned), stop)?;
        let pagination = Pagination::new(planned, &arrangement);
        let composer = Composer::new(plan, planned, pagination.page_count);
        Some(FamilyPipeline { composer, arrangement, pagination })
    }

    /// Solves and measures all cells after those that are done, passes them and their pages to `sink` on all threads, and
    /// passes the results in order to `receive` on the calling thread.
    ///
    /// # Errors
    /// The first error of `sink` or `receive`.
    pub fn run<S: Sink>(
        &self,
        sink: &S,
        mut done: GroupsDone,
        mut receive: impl FnMut(Output<S::CellsOutput, S::PageOutput>) -> Result<(), S::Error>,
    ) -> Result<(), S::Error> {
        let planned = self.composer.planned;
        let GroupsDone { groups: first, sorted_groups: first_sorted } = done;
        let chart = planned.chart.as_ref();
        let is_sorted = planned.family.sort.is_some();
        let mut builder = chart.map(|chart| ChartBuilder::new(chart, &planned.family));
        let has_sorted_pages = chart.is_none() && is_sorted;
        let kept_cells: Mutex<KeptCells> = Mutex::default();
        let make = |group: usize, solved: Vec<SolvedCell>| -> Result<GroupOutput<S>, S::Error> {
            let cells = sink.receive_cells(&solved)?;
            let has_pages = chart.is_none() && !is_sorted;
            let pages = if has_pages { self.send_pages(group, &solved, sink)? } else { Vec::new() };
            let samples = chart
                .iter()
                .flat_map(|chart| solved.iter().flat_map(|solved| chart.sample_cell(&planned.family, solved)));
            let output = (Some(cells), pages, samples.collect());
            if has_sorted_pages {
                kept_cells.lock().unwrap_or_else(PoisonError::into_inner).extend(solved);
            }
            Ok(output)
        };
        let mut deliver = |output: Result<GroupOutput<S>, S::Error>| {
            let (cells, pages, samples) = output?;
            if let Some(builder) = &mut builder {
                samples.into_iter().for_each(|sample| builder.add(sample));
            }
            *(if cells.is_some() { &mut done.groups } else { &mut done.sorted_groups }) += 1;
            cells.into_iter().try_for_each(|cells| receive(Output::Cells(cells)))?;
            pages.into_iter().try_for_each(|page| receive(Output::Page(page)))?;
            if chart.is_none() { receive(Output::Done(done)) } else { Ok(()) }
        };
        let groups = self.cell_groups((&self.arrangement.kept, first), sink, None);
        sweep::process_groups(&planned.family, groups, make, &mut deliver)?;
        if has_sorted_pages {
            // Tables are in the order of the cells, but pages are sorted.
            let measures = measures_used_on_pages(planned);
            let sorted = (self.arrangement.page_order(), first_sorted);
            let take = |_: &Solver, cell: usize| kept_cells.lock().unwrap_or_else(PoisonError::into_inner).take(cell);
            let groups = CellGroups { solve_known: Some(&take), ..self.cell_groups(sorted, sink, Some(measures)) };
            let make =
                |group: usize, solved: Vec<SolvedCell>| Ok((None, self.send_pages(group, &solved, sink)?, Vec::new()));
            sweep::process_groups(&planned.family, groups, make, &mut deliver)?;
        }
        match (chart, builder) {
            (Some(chart), Some(builder)) => self.send_charts(chart, builder, sink, &mut receive),
            _ => Ok(()),
        }
    }

    /// Composes some of the pages, given by their indices from 0, and passes them to `sink` on all threads and the results in
    /// order to `receive`. Cells that are not on these pages are not solved, unless the pages have charts.
    ///
    /// # Errors
    /// The first error of `sink` or `receive`.
    pub fn run_pages<S: Sink>(
        &self,
        sink: &S,
        pages: Range<usize>,
        mut receive: impl FnMut(S::PageOutput) -> Result<(), S::Error>,
    ) -> Result<(), S::Error> {
        let pages = pages.start + 1..pages.end.min(self.pagination.page_count) + 1;
        if pages.is_empty() {
            return Ok(());
        }
        let (first, last) = (pages.start, pages.end - 1);
        let sink = &PageSelection { sink, pages };
        let planned = self.composer.planned;
        if planned.chart.is_some() {
            return self.run(sink, GroupsDone::default(), |output| match output {
                Output::Page(page) => page.map_or(Ok(()), &mut receive),
                Output::Cells(()) | Output::Done(_) => Ok(()),
            });
        }
        let [first, last] = [first, last].map(|page| self.pagination.group_of_page(page));
        let cells = self.arrangement.page_order().first((last + 1) * self.pagination.group_size);
        let measures = measures_used_on_pages(planned);
        let groups = self.cell_groups((&cells, first), sink, Some(measures));
        let make = |group: usize, solved: Vec<SolvedCell>| self.send_pages(group, &solved, sink);
        sweep::process_groups(&planned.family, groups, make, |pages: Result<Vec<Option<S::PageOutput>>, S::Error>| {
            pages?.into_iter().flatten().try_for_each(&mut receive)
        })
    }

    /// The groups in which cells are processed, from the given one.
    fn cell_groups<'c>(
        &self,
        (cells, first_group): (&'c CellIndices, usize),
        sink: &impl Sink,
        measures: Option<MeasureSet>,
    ) -> CellGroups<'c> {
        CellGroups {
            cells,
            first_group,
            size: self.pagination.group_size,
            work_bytes: sink.bytes_per_page(),
            requested_measures: measures,
            solve_known: None,
        }
    }

    /// Passes the pages of a group of cells to the sink.
    fn send_pages<S: Sink>(
        &self,
        group: usize,
        cells: &[SolvedCell],
        sink: &S,
    ) -> Result<Vec<S::PageOutput>, S::Error> {
        let page = self.pagination.first_page(group * self.pagination.group_size);
        match (self.composer.planned.layout, cells) {
            (Layout::CouplerGrid, [solved]) => {
                let send = |(page, curves, compose): (usize, Vec<usize>, _)| {
                    sink.receive_page(PageJob {
                        number: page,
                        content: PageContent::Cells { cells, curves: &curves },
                        compose: Box::new(compose),
                    })
                };
                self.composer.coupler_grid_pages(page, solved).map(send).collect()
            }
            _ => {
                let compose = Box::new(move || self.composer.panel_page(page, cells));
                Ok(vec![sink.receive_page(PageJob {
                    number: page,
                    content: PageContent::Cells { cells, curves: &[] },
                    compose,
                })?])
            }
        }
    }

    /// Passes the pages of charts to the sink.
    fn send_charts<S: Sink>(
        &self,
        chart: &Chart,
        builder: ChartBuilder,
        sink: &S,
        receive: &mut impl FnMut(Output<S::CellsOutput, S::PageOutput>) -> Result<(), S::Error>,
    ) -> Result<(), S::Error> {
        let chart_data = charts::build_chart(builder);
        for page in 1..=self.pagination.page_count {
            let compose = Box::new(|| self.composer.chart_page(page, chart, &chart_data));
            receive(Output::Page(sink.receive_page(PageJob {
                number: page,
                content: PageContent::Charts,
                compose,
            })?))?;
        }
        Ok(())
    }
}

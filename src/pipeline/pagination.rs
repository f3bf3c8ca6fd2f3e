use crate::manifest::PlannedFamily;
use crate::sweep::CellSelection;
use coupler_curves::family::Family;
use coupler_curves::measure::{self, Measure};
use coupler_drawing::page::{self, Layout};

/// Which measures it takes to draw the cells of a family on pages of their own.
pub fn measures_used_on_pages(family: &Family) -> Vec<bool> {
    let is_told = |(k, measure): (usize, &Measure)| {
        let is_told =
            page::PAGE_MEASURES.contains(&measure.name) || family.filter_or_sort_uses(k) || family.captions_use(k);
        is_told && family.is_computed[k]
    };
    measure::ALL.iter().enumerate().map(is_told).collect()
}

/// How the cells of a family are put on pages.
#[derive(Clone, Debug)]
pub struct Pagination {
    /// How many cells are worked on together: those of a page, or one with all its pages.
    pub group_size: usize,
    /// How many pages there are.
    pub page_count: usize,
    /// The numbers of the first pages of cells that have several.
    first_pages: Vec<usize>,
}

/// How many cells charts take in at a time.
const CHART_GROUP_SIZE: usize = 16;

impl Pagination {
    /// How those of a family are that are arranged so.
    pub fn new(planned: &PlannedFamily, arrangement: &CellSelection) -> Pagination {
        let kept = arrangement.kept.len();
        let cells_to_a_page = planned.layout.cells_per_page();
        let begins = match planned.layout {
            Layout::CouplerGrid => first_pages(&arrangement.point_counts),
            _ => Vec::new(),
        };
        let (size, pages) = match &planned.chart {
            None if planned.layout == Layout::CouplerGrid => (1, begins.last().map_or(0, |end| end - 1)),
            None => (cells_to_a_page, kept.div_ceil(cells_to_a_page)),
            Some(_) if kept == 0 => (CHART_GROUP_SIZE, 0),
            Some(chart) => (CHART_GROUP_SIZE, chart.y.len().div_ceil(cells_to_a_page)),
        };
        Pagination { group_size: size, page_count: pages, first_pages: begins }
    }

    /// The first page of the k-th cell in the order of pages.
    pub fn first_page(&self, k: usize) -> usize {
        self.first_pages.get(k).copied().unwrap_or(k / self.group_size + 1)
    }
}

/// The numbers of the first pages of cells with so many traced points, and the one after the last.
fn first_pages(points: &[usize]) -> Vec<usize> {
    let mut next = 1;
    let mut begins = vec![next];
    for points in points {
        next += points.div_ceil(Layout::POINTS_PER_PAGE).max(1);
        begins.push(next);
    }
    begins
}

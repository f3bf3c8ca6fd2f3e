//! Distributes the cells of a family over pages.

use crate::manifest::PlannedFamily;
use crate::sweep::{self, CellIndices, CellSelection};
use coupler_curves::measure::MeasureSet;
use coupler_drawing::page::Layout;

/// The measures that are needed to draw the pages of a family.
pub fn measures_used_on_pages(planned: &PlannedFamily) -> MeasureSet {
    let family = &planned.family;
    (planned.layout.measures() | family.selection_measures() | family.caption_measures()) & family.measures
}

/// Whether a cell may have several pages, so that its traced points are counted.
pub(super) fn counts_points(planned: &PlannedFamily) -> bool {
    planned.layout == Layout::CouplerGrid
}

/// The number of cells of a family that are solved for a single page: those on the page, or all where `where`, `sort` or a coupler grid select cells
/// by their curves, or charts show them, which solve further ones between them.
pub fn cells_solved_for_page(planned: &PlannedFamily) -> usize {
    let all = planned.family.cell_count();
    let has_all = planned.chart.is_some() || sweep::selects_by_solving(&planned.family, counts_points(planned));
    if has_all { all } else { all.min(planned.layout.cells_per_page()) }
}

/// The number of pages of a family if no cell has to be solved to know it.
pub fn known_page_count(planned: &PlannedFamily) -> Option<usize> {
    let is_known = !sweep::selects_by_solving(&planned.family, counts_points(planned));
    let kept = CellIndices::Range(0..planned.family.cell_count());
    is_known.then(|| Pagination::new(planned, &CellSelection { kept, ..CellSelection::default() }).page_count)
}

/// How the cells of a family are distributed over pages.
#[derive(Clone, Debug)]
pub struct Pagination {
    /// The number of cells processed together: those of a page, or one with all its pages.
    pub group_size: usize,
    /// The number of pages.
    pub page_count: usize,
    /// The number of the first page of each cell, if cells have several pages; otherwise empty.
    first_pages: Vec<usize>,
}

/// The most cells processed together for charts.
const CHART_GROUP_SIZE: usize = 16;

/// The approximate memory of the cells processed together for charts, if there is more than one, in bytes.
const CHART_GROUP_BYTES: usize = 20_000_000;

impl Pagination {
    /// The pagination of a family with these selected cells.
    pub fn new(planned: &PlannedFamily, selection: &CellSelection) -> Pagination {
        let kept = selection.kept.len();
        let cells_per_page = planned.layout.cells_per_page();
        let starts = match planned.layout {
            Layout::CouplerGrid => first_pages(&selection.point_counts),
            _ => Vec::new(),
        };
        let chart_group_size =
            (CHART_GROUP_BYTES / planned.family.estimate_cell_bytes().max(1)).clamp(1, CHART_GROUP_SIZE);
        let (size, pages) = match &planned.chart {
            None if planned.layout == Layout::CouplerGrid => (1, starts.last().map_or(0, |end| end - 1)),
            None => (cells_per_page, kept.div_ceil(cells_per_page)),
            Some(_) if kept == 0 => (chart_group_size, 0),
            Some(chart) => (chart_group_size, chart.y.len().div_ceil(cells_per_page)),
        };
        Pagination { group_size: size, page_count: pages, first_pages: starts }
    }

    /// The first page of the k-th cell in the order of pages.
    pub fn first_page(&self, k: usize) -> usize {
        self.first_pages.get(k).copied().unwrap_or(k / self.group_size + 1)
    }
}

impl Pagination {
    /// The group of cells, from 0, that has a page; pages are counted from 1. Charts are of all cells.
    pub fn group_of_page(&self, page: usize) -> usize {
        match self.first_pages.len() {
            0 => page.saturating_sub(1),
            _ => self.first_pages.partition_point(|first| *first <= page).saturating_sub(1),
        }
    }
}

/// The first page of each cell of a coupler grid, given the traced points of each, and the page after the last.
fn first_pages(points: &[u32]) -> Vec<usize> {
    let mut next = 1;
    let mut starts = vec![next];
    for &points in points {
        next += (points as usize).div_ceil(Layout::POINTS_PER_PAGE).max(1);
        starts.push(next);
    }
    starts
}

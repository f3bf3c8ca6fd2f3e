use crate::manifest::PlannedFamily;
use crate::sweep::Arrangement;
use coupler_curves::family::Family;
use coupler_curves::measure::{self, Measure};
use coupler_drawing::page::{self, Layout};

/// Which measures it takes to draw the cells of a family on pages of their own.
pub fn told_on_pages(family: &Family) -> Vec<bool> {
    let is_told = |(k, measure): (usize, &Measure)| {
        let is_told = page::MEASURES.contains(&measure.name) || family.asks_for(k) || family.describes(k);
        is_told && family.measures[k]
    };
    measure::ALL.iter().enumerate().map(is_told).collect()
}

/// How the cells of a family are put on pages.
#[derive(Clone, Debug)]
pub struct Setting {
    /// How many cells are worked on together: those of a page, or one with all its pages.
    pub size: usize,
    /// How many pages there are.
    pub pages: usize,
    /// The numbers of the first pages of cells that have several.
    begins: Vec<usize>,
}

/// How many cells charts take in at a time.
const CELLS_TO_A_GROUP: usize = 16;

impl Setting {
    /// How those of a family are that are arranged so.
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

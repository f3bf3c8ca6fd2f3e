//! The finding charts of a book: small drawings of the curves of a family over its grid.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::super::{Error, Options, check_interrupt};
use super::part::{BookFamily, FamilyPart, assignment};
use crate::manifest::{FindingCharts, Plan};
use crate::pipeline::{Composer, curves_by_page};
use coupler_curves::family::{Axis, ParameterSpace};
use coupler_drawing::page::Layout;
use coupler_drawing::page::book::{self, Emphasis, FindingCell, FindingChart, Miniature};

/// The most cells in the charts of a family: a chart of more is not for eyes.
const MAX_CELLS: usize = 6000;

/// The most pages of the charts of a family.
const MAX_PAGES: usize = 60;

/// The least number of plates for each page of charts.
const LEAST_PLATES: usize = 5;

/// Cells by their indices, with their rows and columns.
type PlacedCells = Vec<(usize, [usize; 2])>;

/// The drawings of a cell: of each page, with its number.
type DrawnPages = Vec<(Vec<Miniature>, usize)>;

/// The finding charts of a family with these chapters.
///
/// Of the parameters of its grid that vary, up to three, the first varies from row to row, the second from column to column, the
/// third from page to page. Cells of another grid or of cases follow one another with their captions, and so do the cells of a grid
/// in which one varies, with its values.
///
/// Titles name the family if `names_family`.
pub(super) fn finding_charts(
    parts: &[&FamilyPart],
    names_family: bool,
    (plan, options): (&Plan, &Options),
) -> Result<Vec<FindingChart>, Error> {
    let Some(family) = parts.first().map(|part| part.family) else { return Ok(Vec::new()) };
    let Composer { planned, captions, .. } = &family.pipeline.composer;
    let axes: &[Axis] = if let ParameterSpace::Grid(axes) = &planned.family.space { axes } else { &[] };
    let varying: Vec<usize> = (0..axes.len()).filter(|&k| axes[k].values.len() > 1).collect();
    let varying = if varying.len() <= 3 { varying } else { Vec::new() };
    let has_captions = varying.is_empty();
    let count: usize = parts.iter().map(|part| part.cells.len()).sum();
    if planned.chart.is_some() || !(2..=MAX_CELLS).contains(&count) {
        return Ok(Vec::new());
    }
    let per_cell = match planned.layout {
        Layout::CouplerGrid => planned.family.template.curve_count().div_ceil(Layout::POINTS_PER_PAGE),
        _ => 1,
    };
    let grid =
        ChartGrid { axes, varying: &varying, count, most: book::max_chart_grid(per_cell, has_captions, &plan.page) };
    // In the order of the grid, whatever the order of pages.
    let first_pages = |part: &&FamilyPart| -> Vec<(usize, usize)> {
        part.cells.iter().enumerate().map(|(k, cell)| (cell, part.pages_before + part.first_page(k))).collect()
    };
    let cells: BTreeMap<usize, usize> = parts.iter().flat_map(first_pages).collect();
    let mut pages: BTreeMap<[usize; 3], PlacedCells> = BTreeMap::new();
    for (sequence, &cell) in cells.keys().enumerate() {
        let (page, place) = grid.place(cell, sequence);
        pages.entry(page).or_default().push((cell, place));
    }
    // Charts serve to look at fewer pages.
    let plates: usize = parts.iter().map(|part| part.page_count()).sum();
    let is_short = plan.book.finding_charts == FindingCharts::WherePlatesAreMany && LEAST_PLATES * pages.len() > plates;
    if pages.len() > MAX_PAGES || is_short {
        return Ok(Vec::new());
    }
    let [rows, columns] = grid.part_sizes();
    let curves_per_page = match planned.layout {
        Layout::CouplerGrid => book::chart_curves_per_page([columns, rows], per_cell, &plan.page),
        _ => 1,
    };
    let mut drawn = draw_cells(family, &cells, curves_per_page, options)?;
    let names = &planned.family.names;
    let label = |axis: usize, k: usize| {
        let value = axes[axis].values.get(k).unwrap_or(f64::NAN);
        assignment(names, axes[axis].slot, value)
    };
    let shown = match (planned.layout, curves_per_page) {
        (Layout::CouplerGrid, 1) => {
            "The curve of the middle point of each page, as large as it fits; below it the number of the page."
        }
        (Layout::CouplerGrid, _) => {
            "Three curves of each page, each as large as it fits: of a point near the first, of the middle point, of one near the \
             last; below them the number of the page."
        }
        _ => "The first curve of each linkage, as large as it fits; below it the number of its page.",
    };
    let mut previous = None;
    let mut part = 0;
    // The charts of a value need numbers if they are divided.
    let is_divided = pages.keys().any(|[_, row, column]| row + column > 0);
    let chart = |(page, placed): ([usize; 3], PlacedCells)| {
        let value = if let [_, _, axis] = varying[..] { Some(label(axis, page[0])) } else { None };
        let family = names_family.then(|| planned.family.title.clone());
        let parts: Vec<String> = family.into_iter().chain(value).collect();
        part = if previous.replace(page[0]) == Some(page[0]) { part + 1 } else { 1 };
        let number = is_divided.then(|| format!("({part})"));
        let title = [Some(parts.join(": ")).filter(|title| !title.is_empty()), number];
        let title = title.into_iter().flatten().collect::<Vec<_>>().join(" ");
        let (rows, columns) = grid.labels(page, &label);
        let cell = |(cell, place): (usize, [usize; 2])| FindingCell {
            place,
            label: match varying[..] {
                [] => captions.of_cell(&planned.family.cell(cell), &[])[0].clone(),
                [axis] => label(axis, grid.index(cell, axis)),
                _ => String::new(),
            },
            pages: drawn.remove(&cell).unwrap_or_default(),
        };
        let cells = placed.into_iter().map(cell).collect();
        FindingChart { title, note: shown.to_owned(), symbols: names.clone(), columns, rows, cells }
    };
    Ok(pages.into_iter().map(chart).collect())
}

/// How the cells of a grid are distributed over charts.
struct ChartGrid<'a> {
    axes: &'a [Axis],
    /// The axes with several values, up to three; none if cells follow one another with captions.
    varying: &'a [usize],
    /// The number of cells that are shown.
    count: usize,
    /// The most columns and rows of a page.
    most: [usize; 2],
}

impl ChartGrid<'_> {
    /// The index of a cell's value on an axis.
    fn index(&self, cell: usize, axis: usize) -> usize {
        let stride: usize = self.axes[axis + 1..].iter().map(|axis| axis.values.len()).product();
        cell / stride.max(1) % self.axes[axis].values.len().max(1)
    }

    /// The rows and columns of the parts into which a table is divided: as even as possible.
    fn part_sizes(&self) -> [usize; 2] {
        let size = |axis: usize, most: usize| {
            let count = self.axes[axis].values.len();
            count.div_ceil(count.div_ceil(most))
        };
        let [columns, rows] = self.most;
        match *self.varying {
            [row, column, ..] => [size(row, rows), size(column, columns)],
            // As many columns as rows, and some more, since pages are wide.
            _ => {
                let columns = (1..columns).find(|columns| 3 * columns * columns >= 5 * self.count).unwrap_or(columns);
                [rows.min(self.count.div_ceil(columns)).max(1), columns]
            }
        }
    }

    /// The page of a cell, and its row and column there; `sequence` is its place among all cells.
    fn place(&self, cell: usize, sequence: usize) -> ([usize; 3], [usize; 2]) {
        let [rows, columns] = self.part_sizes();
        let [row, column, page] = match *self.varying {
            [row, column, ref rest @ ..] => {
                let page = rest.first().map_or(0, |&axis| self.index(cell, axis));
                [self.index(cell, row), self.index(cell, column), page]
            }
            _ => [sequence / columns, sequence % columns, 0],
        };
        ([page, row / rows, column / columns], [row % rows, column % columns])
    }

    /// The labels of the rows and columns of a page.
    fn labels(
        &self,
        [_, row_part, column_part]: [usize; 3],
        label: &dyn Fn(usize, usize) -> String,
    ) -> (Vec<String>, Vec<String>) {
        let [row, column, ..] = *self.varying else { return Default::default() };
        let [rows, columns] = self.part_sizes();
        let labels = |axis: usize, part: usize, size: usize| {
            let count = self.axes[axis].values.len();
            (part * size..count.min((part + 1) * size)).map(|k| label(axis, k)).collect()
        };
        (labels(row, row_part, rows), labels(column, column_part, columns))
    }
}

/// The drawings of cells: of a coupler grid so many curves of each page, evenly chosen, otherwise the first curve.
fn draw_cells(
    family: &BookFamily,
    cells: &BTreeMap<usize, usize>,
    curves_per_page: usize,
    options: &Options,
) -> Result<BTreeMap<usize, DrawnPages>, Error> {
    let planned = family.pipeline.composer.planned;
    let solver = family.page_solver();
    let draw = |(&cell, &first_page): (&usize, &usize)| {
        check_interrupt(&options.interrupt)?;
        let Some(solved) = family.solve(&solver, cell) else { return Ok((cell, Vec::new())) };
        let pages = match planned.layout {
            Layout::CouplerGrid => curves_by_page(&solved),
            _ => vec![(0..solved.curves.len()).take(1).collect()],
        };
        let drawings = |(page, curves): (usize, &Vec<usize>)| {
            // Each from the middle of its share; fewer if there are fewer.
            let count = curves_per_page.min(curves.len());
            let chosen =
                (0..count).filter_map(|k| solved.curves.get(*curves.get((2 * k + 1) * curves.len() / (2 * count))?));
            let drawings: Vec<Miniature> = chosen.map(|curve| Miniature::new(&solved, curve, Emphasis::None)).collect();
            (!drawings.is_empty()).then_some((drawings, page))
        };
        Ok((cell, (first_page..).zip(&pages).filter_map(drawings).collect()))
    };
    cells.par_iter().map(draw).collect()
}

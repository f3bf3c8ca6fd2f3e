//! The finding charts of a book: small drawings of the curves of a family over its grid.

use std::collections::BTreeMap;
use std::ops::Range;

use rayon::prelude::*;

use super::super::{Error, Options, check_interrupt};
use super::part::{BookFamily, FamilyPart};
use crate::manifest::{FindingCharts, Plan};
use crate::pipeline::{Composer, curves_by_page};
use coupler_curves::expression::displayed_name;
use coupler_curves::family::{Axis, ParameterSpace};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};
use coupler_drawing::page::book::{self, Emphasis, FindingCell, FindingChart, FindingCurve, Miniature, ScaleBar};
use coupler_drawing::page::{Layout, circuit_words};

/// The most cells in the charts of a family: a chart of more is not for eyes.
const MAX_CELLS: usize = 6000;

/// The most pages of the charts of a family.
const MAX_PAGES: usize = 240;

/// The least number of plates for each page of charts.
const LEAST_PLATES: usize = 5;

/// Cells by their indices, with their rows and columns.
type PlacedCells = Vec<(usize, [usize; 2])>;

/// The drawings of a cell: of each page, with its number, and the bar at their scale.
type DrawnCell = (Vec<(Vec<FindingCurve>, usize)>, ScaleBar);

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
    let curve_count = planned.family.template.curve_count();
    let per_cell = match planned.layout {
        Layout::CouplerGrid => {
            [curve_count.div_ceil(Layout::POINTS_PER_PAGE), curve_count.min(Layout::POINTS_PER_PAGE)]
        }
        _ => [1, curve_count],
    };
    let most = book::max_chart_grid(per_cell, has_captions, &plan.page);
    let grid = ChartGrid { axes, varying: &varying, count, most };
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
    let mut drawn = draw_cells(family, &cells, options)?;
    let label = |axis: usize, k: usize| {
        let value = axes[axis].values.get(k).unwrap_or(f64::NAN);
        planned.family.equation(axes[axis].slot, value).to_string()
    };
    let shown = note(family, drawn.values());
    // The charts of a value need the ranges of the others if they are divided, or else what they have of all cells.
    let is_divided = pages.keys().any(|[_, row, column]| row + column > 0);
    let is_in_order = cells.values().is_sorted();
    let chart = |(page, placed): ([usize; 3], PlacedCells)| {
        let value = if let [_, _, axis] = varying[..] { Some(label(axis, page[0])) } else { None };
        let ranges = grid.part_ranges(page).into_iter().map(|(axis, indices)| {
            let values = &axes[axis].values;
            let values = indices.filter_map(|k| values.get(k));
            planned.family.equation_of_range(axes[axis].slot, values).to_string()
        });
        // What it has of cells that follow one another.
        let sequence = || match varying[..] {
            [axis] => {
                let values = placed.iter().filter_map(|(cell, _)| axes[axis].values.get(grid.index(*cell, axis)));
                planned.family.equation_of_range(axes[axis].slot, values).to_string()
            }
            _ if is_in_order => {
                let first = placed.iter().filter_map(|(cell, _)| cells.get(cell).copied());
                let drawn = placed.iter().filter_map(|(cell, _)| drawn.get(cell));
                format_range("page", first.chain(drawn.flat_map(|(pages, _)| pages).map(|(_, page)| *page)))
            }
            _ => format_range("figure", placed.iter().map(|(cell, _)| planned.family.cell(*cell).number)),
        };
        let sequence = (is_divided && varying.len() < 2).then(sequence);
        let parts: Vec<String> = value.into_iter().chain(ranges.filter(|_| is_divided)).chain(sequence).collect();
        let dimensions = Some(parts.join(", ")).filter(|said| !said.is_empty());
        // Pages alone say nothing in the contents.
        let family = (names_family || is_divided && has_captions).then(|| planned.family.title.clone());
        let title = family.into_iter().chain(dimensions).collect::<Vec<_>>().join(": ");
        let (rows, columns) = grid.labels(page, &label);
        let cell = |(cell, place): (usize, [usize; 2])| {
            let (label, varying) = match varying[..] {
                [] => {
                    let cell = planned.family.cell(cell);
                    (captions.of_unsolved_cell(&cell), captions.varying(&cell))
                }
                [axis] => (label(axis, grid.index(cell, axis)), Vec::new()),
                _ => Default::default(),
            };
            let (pages, bar) = drawn.remove(&cell).unwrap_or((Vec::new(), ScaleBar::Round(None)));
            let figure = planned.layout.figure_number(&planned.family.cell(cell));
            FindingCell { place, label, varying, pages, figure, bar }
        };
        let cells = placed.into_iter().map(cell).collect();
        FindingChart { title, note: shown.clone(), symbols: planned.family.names.clone(), columns, rows, cells }
    };
    Ok(pages.into_iter().map(chart).collect())
}

/// The least and the greatest of some numbers, as in "pages 1–5" or "page 3".
fn format_range(noun: &str, numbers: impl Iterator<Item = usize>) -> String {
    let [first, last] = numbers.fold([usize::MAX, 0], |[least, most], k| [least.min(k), most.max(k)]);
    if first >= last { format!("{noun} {last}") } else { format!("{noun}s {first}–{last}") }
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

    /// The axes of the rows and columns of a page of a table, with the indices of their values there.
    fn part_ranges(&self, [_, row_part, column_part]: [usize; 3]) -> Vec<(usize, Range<usize>)> {
        let [row, column, ..] = *self.varying else { return Vec::new() };
        let [rows, columns] = self.part_sizes();
        let indices = |axis: usize, part: usize, size: usize| {
            (axis, part * size..self.axes[axis].values.len().min((part + 1) * size))
        };
        vec![indices(row, row_part, rows), indices(column, column_part, columns)]
    }

    /// The labels of the rows and columns of a page.
    fn labels(&self, page: [usize; 3], label: &dyn Fn(usize, usize) -> String) -> (Vec<String>, Vec<String>) {
        let labels = |(axis, indices): (usize, Range<usize>)| indices.map(|k| label(axis, k)).collect::<Vec<_>>();
        let mut labels = self.part_ranges(page).into_iter().map(labels);
        (labels.next().unwrap_or_default(), labels.next().unwrap_or_default())
    }
}

/// What the charts of a family show.
fn note<'d>(family: &BookFamily, mut drawn: impl Iterator<Item = &'d DrawnCell> + Clone) -> String {
    let planned = family.pipeline.composer.planned;
    let is_labelled = |(pages, _): &DrawnCell| pages.iter().flat_map(|(curves, _)| curves).any(|c| !c.label.is_empty());
    let curves = match (planned.layout, &planned.family.template.traced[..]) {
        (Layout::CouplerGrid, _) => "All curves of each page, each with the number of its point".to_owned(),
        (_, [joint]) if !drawn.clone().any(is_labelled) => {
            format!("The curves of {}", displayed_name(&planned.family.template.joints[*joint].name))
        }
        _ => "All curves of each linkage, each with its point".to_owned(),
    };
    let bar = match drawn.all(|(_, bar)| matches!(bar, ScaleBar::Crank(_))) {
        true => "the bar above them is its crank",
        false => "the bar above them is as long as it says",
    };
    format!(
        "{curves}, those of a linkage at one scale: {bar}. Below them {}.",
        match planned.layout.cells_per_page() {
            1 => "the page",
            _ => "the page and the figure",
        }
    )
}

/// The drawings of cells: all curves of each page.
fn draw_cells(
    family: &BookFamily,
    cells: &BTreeMap<usize, usize>,
    options: &Options,
) -> Result<BTreeMap<usize, DrawnCell>, Error> {
    let planned = family.pipeline.composer.planned;
    let solver = family.page_solver();
    let draw = |(&cell, &first_page): (&usize, &usize)| {
        check_interrupt(&options.interrupt)?;
        let round = ScaleBar::Round(planned.family.unit);
        let Some(solved) = family.solve(&solver, cell) else { return Ok((cell, (Vec::new(), round))) };
        let pages = match planned.layout {
            Layout::CouplerGrid => curves_by_page(&solved),
            _ => vec![(0..solved.curves.len()).collect()],
        };
        let drawings = |(page, curves): (usize, &Vec<usize>)| {
            let drawing = |curve: &MeasuredCurve| FindingCurve {
                drawing: Miniature::new(&solved, curve, Emphasis::None),
                label: curve_label(planned.layout, &solved, curve),
            };
            let drawings: Vec<FindingCurve> = curves.iter().map(|&k| drawing(&solved.curves[k])).collect();
            (!drawings.is_empty()).then_some((drawings, page))
        };
        let pages = (first_page..).zip(&pages).filter_map(drawings).collect();
        Ok((cell, (pages, solved.linkage.crank_length().map_or(round, ScaleBar::Crank))))
    };
    cells.par_iter().map(draw).collect()
}

/// What traces a curve: on coupler grids the number of its point, otherwise the joint and the circuit, as far as there are several.
fn curve_label(layout: Layout, solved: &SolvedCell, curve: &MeasuredCurve) -> String {
    let joint = layout.curve_name(&solved.linkage, curve.trace).map(|[_, name]| name);
    joint.into_iter().chain(circuit_words(solved, curve)).collect::<Vec<_>>().join(", ")
}

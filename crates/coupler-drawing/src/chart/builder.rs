//! The points of a chart joined to lines.

use std::collections::BTreeMap;

use super::{Chart, ChartSample, PointSource};
use coupler_curves::family::Family;

/// The most numbers that are kept of a family: 16 MB of them. What comes after is counted.
pub const MAX_NUMBERS: usize = 1 << 21;

/// A line of a chart. A point with a value that is not finite is a gap in it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// What tells it from the others; empty where it is the only one.
    pub label: String,
    /// The cell it is of, where it is of a single one.
    pub cell: Option<usize>,
    /// The number of the traced joint, from 1.
    pub trace: usize,
    /// The number of the circuit, from 1.
    pub circuit: usize,
    /// The x of its points.
    pub x: Vec<f64>,
    /// The y of its points, one list for each quantity of the chart.
    pub y: Vec<Vec<f64>>,
}

/// All that a chart shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChartData {
    /// Its lines.
    pub series: Vec<Series>,
    /// How many curves it was given.
    pub curve_count: usize,
    /// How many of them are not in it, for there are too many.
    pub left_out_count: usize,
}

/// A chart that is being gathered, cell by cell in their order.
#[derive(Debug)]
pub struct ChartBuilder<'a> {
    chart: &'a Chart,
    family: &'a Family,
    /// What tells lines apart, first what tells groups of cells apart, and the points.
    lines: BTreeMap<LineKey, Vec<ChartSample>>,
    /// The groups of cells, each by the values of its names, and their numbers by the bits of those.
    groups: Vec<Vec<f64>>,
    group_indices: BTreeMap<Vec<u64>, usize>,
    number_count: usize,
    curve_count: usize,
    left_out_count: usize,
}

/// The group of the cell, the cell where each has its own line, the trace and the circuit.
type LineKey = (usize, usize, usize, usize);

impl<'a> ChartBuilder<'a> {
    /// A chart of a family without any points yet.
    pub fn new(chart: &'a Chart, family: &'a Family) -> ChartBuilder<'a> {
        let (lines, numbers_of_groups) = (BTreeMap::new(), BTreeMap::new());
        let groups = Vec::new();
        ChartBuilder {
            chart,
            family,
            lines,
            groups,
            group_indices: numbers_of_groups,
            number_count: 0,
            curve_count: 0,
            left_out_count: 0,
        }
    }

    /// Adds what was taken of a curve.
    pub fn add(&mut self, taken: ChartSample) {
        self.curve_count += 1;
        self.number_count += taken.numbers.len();
        if self.number_count > MAX_NUMBERS {
            self.left_out_count += 1;
            return;
        }
        let values = self.group_values(taken.cell);
        let next = self.groups.len();
        let group = *self.group_indices.entry(value_bits(&values)).or_insert(next);
        if group == next {
            self.groups.push(values);
        }
        let cell = if self.chart.point_source == PointSource::Samples { taken.cell } else { 0 };
        self.lines.entry((group, cell, taken.trace, taken.circuit)).or_default().push(taken);
    }

    /// The values that tell the lines of a cell from others.
    fn group_values(&self, cell: usize) -> Vec<f64> {
        let cell = self.family.cell(cell - 1);
        self.chart.group_by.iter().map(|&slot| cell.values[slot]).collect()
    }

    /// The lines, in the order of their first cells, their traces and circuits.
    pub fn build(self) -> ChartData {
        let cells = if self.chart.point_source == PointSource::Curves { self.cells_by_group() } else { Vec::new() };
        let labels = self.labels();
        let mut series = Vec::new();
        for ((key, taken), label) in self.lines.iter().zip(labels) {
            let &(group, cell, trace, circuit) = key;
            let points = match self.chart.point_source {
                PointSource::Samples => taken.iter().flat_map(|taken| taken.numbers.iter().copied()).collect(),
                PointSource::Curves => self.line_points(&cells[group], taken),
            };
            let cell = (self.chart.point_source == PointSource::Samples).then_some(cell);
            let width = self.chart.numbers_per_point();
            let column = |k: usize| points.chunks_exact(width).map(|point| point[k]).collect();
            let (x, y) = (column(0), (1..width).map(column).collect());
            series.push(Series { label, cell, trace, circuit, x, y });
        }
        ChartData { series, curve_count: self.curve_count, left_out_count: self.left_out_count }
    }

    /// The numbers of the cells of each group in the order of a line, those without a curve among them.
    fn cells_by_group(&self) -> Vec<Vec<usize>> {
        let mut cells: Vec<Vec<(f64, usize)>> = vec![Vec::new(); self.groups.len()];
        for k in 0..self.family.cell_count() {
            let Some(&group) = self.group_indices.get(&value_bits(&self.group_values(k + 1))) else { continue };
            let x = if self.chart.is_ordered_by_x { self.chart.cell_x(&self.family.cell(k)) } else { 0.0 };
            cells[group].push((x, k + 1));
        }
        for cells in &mut cells {
            cells.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        }
        cells.into_iter().map(|cells| cells.into_iter().map(|(_, cell)| cell).collect()).collect()
    }

    /// The points of a line by the cells of its group: a gap for each run of cells that have none.
    fn line_points(&self, cells: &[usize], taken: &[ChartSample]) -> Vec<f64> {
        let by_cell: BTreeMap<usize, &ChartSample> = taken.iter().map(|taken| (taken.cell, taken)).collect();
        let gap = vec![f64::NAN; self.chart.numbers_per_point()];
        let mut out: Vec<f64> = Vec::new();
        let mut is_open = false;
        for cell in cells {
            match by_cell.get(cell) {
                Some(taken) => {
                    out.extend(if is_open && !out.is_empty() { &gap[..] } else { &[] });
                    out.extend(&taken.numbers);
                    is_open = false;
                }
                None => is_open = true,
            }
        }
        out
    }

    /// What tells each line from the others: only what is not the same for all.
    fn labels(&self) -> Vec<String> {
        let keys: Vec<LineKey> = self.lines.keys().copied().collect();
        let varies = |of: fn(&LineKey) -> usize| keys.iter().any(|key| of(key) != of(&keys[0]));
        let (traces, circuits) = (varies(|key| key.2), varies(|key| key.3));
        let differs = |k: &usize| self.groups.iter().any(|group| group[*k] != self.groups[0][*k]);
        let names: Vec<usize> = (0..self.chart.group_by.len()).filter(differs).collect();
        let label = |&(group, cell, trace, circuit): &LineKey| {
            let value = |&k: &usize| {
                let name = &self.family.names[self.chart.group_by[k]];
                format!("{name} = {}", round_to_six_digits(self.groups[group][k]))
            };
            let mut parts: Vec<String> = names.iter().map(value).collect();
            let shared = keys.iter().any(|key| key.0 == group && key.1 != cell);
            parts.extend(shared.then(|| format!("no. {cell}")));
            parts.extend(traces.then(|| format!("trace {trace}")));
            parts.extend(circuits.then(|| format!("circuit {circuit}")));
            parts.join(", ")
        };
        keys.iter().map(label).collect()
    }
}

/// Values as what they are told apart by; zero is one whatever its sign.
fn value_bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| (value + 0.0).to_bits()).collect()
}

/// The value in up to six significant digits.
fn round_to_six_digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

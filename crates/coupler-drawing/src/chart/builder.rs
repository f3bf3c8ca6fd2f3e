//! The lines of a chart, built from its points.

use std::collections::BTreeMap;

use super::{Chart, ChartSample, PointSource};
use coupler_curves::expression::round_to_six_digits;
use coupler_curves::family::Family;

/// The most numbers kept of a family, which are 16 MB. Curves beyond that are only counted.
pub const MAX_NUMBERS: usize = 1 << 21;

/// The most curves kept of a family, each of which takes some hundred bytes in addition to its numbers. Curves beyond
/// that are only counted.
pub const MAX_CURVES: usize = 200_000;

/// A line of a chart. A point with a value that is not finite is a gap in it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// The label that distinguishes it from other lines; empty if it is the only one.
    pub label: String,
    /// The number of its cell, if all points are of one cell.
    pub cell: Option<usize>,
    /// The number of the traced joint, from 1.
    pub trace: usize,
    /// The number of the circuit, from 1.
    pub circuit: usize,
    /// The x of the points.
    pub x: Vec<f64>,
    /// The y of the points, one list for each quantity of the chart.
    pub y: Vec<Vec<f64>>,
}

/// The data of a chart.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChartData {
    /// The lines.
    pub series: Vec<Series>,
    /// The number of curves of the family.
    pub curve_count: usize,
    /// The number of curves that are left out because of [`MAX_NUMBERS`] and [`MAX_CURVES`].
    pub left_out_count: usize,
}

/// Builds the data of a chart from samples, which are added in the order of the cells.
#[derive(Debug)]
pub struct ChartBuilder<'a> {
    chart: &'a Chart,
    family: &'a Family,
    /// The samples of each line, in the order of the lines.
    lines: BTreeMap<LineKey, Vec<ChartSample>>,
    /// The values of the parameters in `group_by` for each group of cells.
    groups: Vec<Vec<f64>>,
    /// The index of each group by the bits of these values.
    group_indices: BTreeMap<Vec<u64>, usize>,
    number_count: usize,
    curve_count: usize,
    left_out_count: usize,
}

/// The key of a line: group of cells, cell (0 if a line has points of several), trace and circuit.
type LineKey = (usize, usize, usize, usize);

impl<'a> ChartBuilder<'a> {
    /// A builder for the chart of a family, without points.
    pub fn new(chart: &'a Chart, family: &'a Family) -> ChartBuilder<'a> {
        ChartBuilder {
            chart,
            family,
            lines: BTreeMap::new(),
            groups: Vec::new(),
            group_indices: BTreeMap::new(),
            number_count: 0,
            curve_count: 0,
            left_out_count: 0,
        }
    }

    /// Adds the points of a curve.
    pub fn add(&mut self, sample: ChartSample) {
        self.curve_count += 1;
        self.number_count += sample.numbers.len();
        if self.number_count > MAX_NUMBERS || self.curve_count > MAX_CURVES {
            self.left_out_count += 1;
            return;
        }
        let values = self.group_values(sample.cell);
        let next = self.groups.len();
        let group = *self.group_indices.entry(value_bits(&values)).or_insert(next);
        if group == next {
            self.groups.push(values);
        }
        let cell = if self.chart.point_source == PointSource::Samples { sample.cell } else { 0 };
        self.lines.entry((group, cell, sample.trace, sample.circuit)).or_default().push(sample);
    }

    /// The values of the parameters in `group_by` for a cell, by its number from 1.
    fn group_values(&self, cell: usize) -> Vec<f64> {
        let cell = self.family.cell(cell - 1);
        self.chart.group_by.iter().map(|&slot| cell.values[slot]).collect()
    }

    /// The data of the chart; lines are in the order of their first cells, traces and circuits.
    pub fn build(self) -> ChartData {
        let cells = if self.chart.point_source == PointSource::Curves { self.cells_by_group() } else { Vec::new() };
        let labels = self.labels();
        let mut series = Vec::new();
        for ((key, samples), label) in self.lines.iter().zip(labels) {
            let &(group, cell, trace, circuit) = key;
            let points = match self.chart.point_source {
                PointSource::Samples => samples.iter().flat_map(|sample| sample.numbers.iter().copied()).collect(),
                PointSource::Curves => self.line_points(&cells[group], samples),
            };
            let cell = (self.chart.point_source == PointSource::Samples).then_some(cell);
            let width = self.chart.numbers_per_point();
            let column = |k: usize| points.chunks_exact(width).map(|point| point[k]).collect();
            let (x, y) = (column(0), (1..width).map(column).collect());
            series.push(Series { label, cell, trace, circuit, x, y });
        }
        ChartData { series, curve_count: self.curve_count, left_out_count: self.left_out_count }
    }

    /// The numbers of the cells of each group in the order of a line, including cells without a curve.
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

    /// The points of a line over the cells of its group, with a gap for each run of cells without a point.
    fn line_points(&self, cells: &[usize], samples: &[ChartSample]) -> Vec<f64> {
        let by_cell: BTreeMap<usize, &ChartSample> = samples.iter().map(|sample| (sample.cell, sample)).collect();
        let gap = vec![f64::NAN; self.chart.numbers_per_point()];
        let mut out: Vec<f64> = Vec::new();
        let mut after_gap = false;
        for cell in cells {
            match by_cell.get(cell) {
                Some(sample) => {
                    out.extend(if after_gap && !out.is_empty() { &gap[..] } else { &[] });
                    out.extend(&sample.numbers);
                    after_gap = false;
                }
                None => after_gap = true,
            }
        }
        out
    }

    /// The label of each line, with only those values that are not the same for all lines.
    fn labels(&self) -> Vec<String> {
        let keys: Vec<LineKey> = self.lines.keys().copied().collect();
        let varies = |part: fn(&LineKey) -> usize| keys.iter().any(|key| part(key) != part(&keys[0]));
        let (traces, circuits) = (varies(|key| key.2), varies(|key| key.3));
        let differs = |k: &usize| self.groups.iter().any(|group| group[*k] != self.groups[0][*k]);
        let names: Vec<usize> = (0..self.chart.group_by.len()).filter(differs).collect();
        // The keys are in order of groups and then of cells.
        let groups = keys.chunk_by(|a, b| a.0 == b.0);
        let has_several_cells: Vec<bool> =
            groups.flat_map(|keys| keys.iter().map(|_| keys[0].1 != keys[keys.len() - 1].1)).collect();
        let label = |(&(group, cell, trace, circuit), &needs_cell): (&LineKey, &bool)| {
            let value = |&k: &usize| {
                let name = &self.family.names[self.chart.group_by[k]];
                format!("{name} = {}", round_to_six_digits(self.groups[group][k]))
            };
            let mut parts: Vec<String> = names.iter().map(value).collect();
            parts.extend(needs_cell.then(|| format!("no. {cell}")));
            parts.extend(traces.then(|| format!("trace {trace}")));
            parts.extend(circuits.then(|| format!("circuit {circuit}")));
            parts.join(", ")
        };
        keys.iter().zip(&has_several_cells).map(label).collect()
    }
}

/// The bits of values, by which groups are compared; zero and negative zero are equal.
fn value_bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| (value + 0.0).to_bits()).collect()
}

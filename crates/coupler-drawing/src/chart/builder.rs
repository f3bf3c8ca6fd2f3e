//! The lines of a chart, built from its points.

use std::collections::BTreeMap;

use super::parameters::ordered_places;
use super::path::{LinePath, union};
use super::refinement::{ForEachInterval, Path, Refinement};
use super::{Chart, ChartSample, PointSource, curve_name};

use coupler_curves::family::Family;
use coupler_curves::text::round_to_six_digits;

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
    /// Its place among the lines, from 0 to 1, if they differ by one parameter, or by several that change together; `None`
    /// if they have no such order.
    pub place: Option<f64>,
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
    /// The line as it is drawn for each quantity of the chart, if it does not join the points by straight lines; otherwise
    /// empty.
    pub paths: Vec<LinePath>,
}

impl Series {
    /// The points of the line for the quantity at an index, x and y.
    pub fn points(&self, quantity_index: usize) -> impl Iterator<Item = [f64; 2]> {
        self.x.iter().zip(&self.y[quantity_index]).map(|(&x, &y)| [x, y])
    }

    /// The line for the quantity at an index, as it is drawn.
    pub fn path(&self, quantity_index: usize) -> Vec<[f64; 2]> {
        match self.paths.get(quantity_index) {
            Some(path) => path.points.clone(),
            None => self.points(quantity_index).collect(),
        }
    }
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
        let path_numbers = sample.paths.iter().map(|path| 2 * path.points.len()).sum::<usize>();
        self.number_count += sample.numbers.len() + path_numbers;
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

    /// The data of the chart; lines are in the order of their first cells, traces and circuits, and join the points by
    /// straight lines.
    pub fn build(self) -> ChartData {
        let cells = self.cells_by_group();
        self.build_series(&cells, None)
    }

    /// The data of the chart, with lines that are also sampled between the cells where they are not straight, and that
    /// have gaps where a quantity jumps.
    ///
    /// Lines that do not follow a single parameter, or that leave out curves, join the points by straight lines.
    /// `for_each` runs a function on every interval between two cells; the result does not depend on the order.
    pub fn build_refined(self, for_each: ForEachInterval) -> ChartData {
        let cells = self.cells_by_group();
        let refined = (self.left_out_count == 0).then(|| self.refinement(&cells)).flatten();
        let refined = refined.map(|mut refinement| {
            refinement.refine(for_each);
            refinement
        });
        self.build_series(&cells, refined.as_ref())
    }

    fn refinement(&self, cells: &[Vec<usize>]) -> Option<Refinement<'a>> {
        let mut samples: BTreeMap<usize, Vec<&ChartSample>> = BTreeMap::new();
        for sample in self.lines.values().flatten() {
            samples.entry(sample.cell).or_default().push(sample);
        }
        Refinement::new(self.chart, self.family, cells, &samples)
    }

    /// The lines, with the paths of a refinement.
    fn build_series(&self, cells: &[Vec<usize>], refinement: Option<&Refinement>) -> ChartData {
        let labels = self.labels();
        let places = self.places();
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
            let path = |quantity: usize| {
                let between = refinement?.paths(group, (trace, circuit), quantity);
                Some(self.line_path(&cells[group], samples, quantity, between))
            };
            let paths = match (self.chart.point_source, &samples[..]) {
                (PointSource::Samples, [sample]) => sample.paths.clone(),
                _ => (0..self.chart.y.len()).filter_map(path).collect(),
            };
            let place = places.as_ref().map(|places| places[group]);
            series.push(Series { label, place, cell, trace, circuit, x, y, paths });
        }
        ChartData { series, curve_count: self.curve_count, left_out_count: self.left_out_count }
    }

    /// The path of a line for a quantity: the points of its cells, with what is between them.
    fn line_path(
        &self,
        cells: &[usize],
        samples: &[ChartSample],
        quantity: usize,
        between: impl Iterator<Item = Path>,
    ) -> LinePath {
        let by_cell: BTreeMap<usize, &ChartSample> = samples.iter().map(|sample| (sample.cell, sample)).collect();
        let mut line = LinePath::default();
        let between = between.map(Some).chain(std::iter::repeat_with(|| None));
        for (cell, path) in cells.iter().zip(between) {
            line.points.push(match by_cell.get(cell) {
                Some(sample) => [sample.numbers[0], sample.numbers[1 + quantity]],
                None => [f64::NAN; 2],
            });
            let Some(Path { points, range }) = path else { continue };
            line.points.extend(points);
            line.range = line.range.into_iter().chain(range).reduce(union);
        }
        line
    }

    /// The numbers of the cells of each group in the order of a line, including cells without a curve; empty if lines
    /// have points of one cell.
    fn cells_by_group(&self) -> Vec<Vec<usize>> {
        if self.chart.point_source == PointSource::Samples {
            return Vec::new();
        }
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

    /// The place of each group of cells in the order of the lines, if each has one line.
    fn places(&self) -> Option<Vec<f64>> {
        let has_one_line = self.lines.len() == self.groups.len();
        has_one_line.then(|| ordered_places(&self.groups)).flatten()
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
                let value = round_to_six_digits(self.groups[group][k]);
                self.family.equation(self.chart.group_by[k], value).to_string()
            };
            let mut parts: Vec<String> = names.iter().map(value).collect();
            parts.extend(needs_cell.then(|| format!("no. {cell}")));
            parts.extend(traces.then(|| curve_name(self.family.template.traced_names(), trace).join(" ")));
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

//! The points of a chart from a solved cell.

use super::adaptive::ChartPoint;
use super::axis::AxisRange;
use super::path::LinePath;
use super::scope::SAMPLE_NAMES;
use super::{Chart, PointSource};
use coupler_curves::family::{Cell, Family, Sampling};
use coupler_curves::measure::{COLUMNS, Column, compute_columns, cumulative_lengths};
use coupler_curves::motion::{Circuit, Sampler, UnsampledCircuit};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// The points of a chart from one curve: a single point, or one for each sample.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartSample {
    /// The cell's number, from 1.
    pub cell: usize,
    /// The number of the traced joint, from 1.
    pub trace: usize,
    /// The number of the circuit, from 1.
    pub circuit: usize,
    /// The numbers of all points, [`Chart::numbers_per_point`] for each: x, then each y.
    pub numbers: Vec<f64>,
    /// The line through the points for each y, if they are samples; otherwise empty.
    pub paths: Vec<LinePath>,
}

/// The samples of a turn for the line of a curve: no quantity changes visibly between two of them on paper.
const LINE_SAMPLES: usize = 1440;

/// The most samples for the lines of a family; of one with more curves, lines join its own samples.
const MAX_LINE_SAMPLES: usize = 1 << 20;

impl Chart {
    /// The number of numbers of a point: x and each y.
    pub fn numbers_per_point(&self) -> usize {
        1 + self.y.len()
    }

    /// The points of a cell of a family, by curve.
    pub fn sample_cell(&self, family: &Family, solved: &SolvedCell) -> Vec<ChartSample> {
        let curve_count = family.cell_count().saturating_mul(solved.curves.len());
        let is_dense = curve_count.saturating_mul(LINE_SAMPLES) <= MAX_LINE_SAMPLES;
        let sampler = (self.point_source == PointSource::Samples && is_dense)
            .then(|| Sampler::new(Sampling::DenseAtLimits(LINE_SAMPLES)));
        let sample = |curve: &MeasuredCurve| {
            let (mut numbers, mut paths) = (Vec::new(), Vec::new());
            match self.point_source {
                PointSource::Curves => {
                    numbers.extend(self.evaluate_point(|slot| Family::scope_value(&solved.cell, &curve.values, slot)));
                }
                PointSource::Samples => {
                    numbers = self.evaluate_samples(solved, curve, solved.circuit(curve));
                    paths.extend(sampler.iter().flat_map(|sampler| self.paths(solved, curve, sampler, &numbers)));
                }
            }
            ChartSample { cell: solved.cell.number, trace: curve.trace, circuit: curve.circuit, numbers, paths }
        };
        solved.curves.iter().map(sample).collect()
    }

    /// The line of a curve for each y, from further samples. `numbers` are those of its own samples, which determine the
    /// axes.
    fn paths(&self, solved: &SolvedCell, curve: &MeasuredCurve, sampler: &Sampler, numbers: &[f64]) -> Vec<LinePath> {
        let Circuit { passes, is_closed, .. } = solved.circuit(curve);
        let circuit = UnsampledCircuit { passes: passes.clone(), is_closed: *is_closed };
        let dense = self.evaluate_samples(solved, curve, &sampler.sample_circuit(&solved.linkage, circuit));
        let width = self.numbers_per_point();
        let quantities = std::iter::once(&self.x).chain(&self.y).enumerate();
        let axes: Vec<AxisRange> = quantities
            .map(|(k, quantity)| AxisRange::new(quantity, numbers.chunks_exact(width).map(|point| point[k])))
            .collect();
        let path = |quantity: usize| {
            let point = |numbers: &[f64]| {
                let place = |k: usize| axes[k].fraction(numbers[k]).unwrap_or(f64::NAN);
                ChartPoint { value: [numbers[0], numbers[quantity]], place: [place(0), place(quantity)] }
            };
            LinePath::from_dense_points(&dense.chunks_exact(width).map(point).collect::<Vec<_>>())
        };
        (1..width).map(path).collect()
    }

    /// The x of a cell, evaluated without measures.
    pub fn cell_x(&self, cell: &Cell) -> f64 {
        self.x.expression.evaluate(|slot| Family::scope_value(cell, &[], slot))
    }

    fn evaluate_point<'a>(&'a self, load: impl Fn(usize) -> f64 + 'a) -> impl Iterator<Item = f64> + 'a {
        std::iter::once(&self.x).chain(&self.y).map(move |quantity| quantity.expression.evaluate(&load))
    }

    /// The numbers of every sample of a curve on its circuit; on a closed curve the first sample is repeated at the end.
    fn evaluate_samples(&self, solved: &SolvedCell, curve: &MeasuredCurve, circuit: &Circuit) -> Vec<f64> {
        let curve_slots = solved.cell.values.len() + Family::scope(&[], false).len();
        let used = self.used_columns(curve_slots);
        let columns: Vec<Column> = used.iter().map(|&k| COLUMNS[k]).collect();
        let arc_lengths = if self.uses_slot(curve_slots + 3) {
            cumulative_lengths(&solved.linkage, circuit, curve.joint)
        } else {
            Vec::new()
        };
        // The measures are the same at every sample.
        let fixed: Vec<f64> =
            (0..curve_slots).map(|slot| Family::scope_value(&solved.cell, &curve.values, slot)).collect();
        let mut numbers = Vec::with_capacity((circuit.len() + 1) * self.numbers_per_point());
        for k in 0..circuit.len() + usize::from(circuit.is_closed && !circuit.is_empty()) {
            let sample = k % circuit.len();
            let at = circuit.positions.point(curve.joint, sample);
            let values = compute_columns(&columns, &solved.linkage, circuit, curve.joint, sample);
            let sample_values = [at.x, at.y, input_at(circuit, k), arc_lengths.get(k).copied().unwrap_or(f64::NAN)];
            let load = |slot: usize| match slot.checked_sub(curve_slots) {
                None => fixed[slot],
                Some(slot) if slot < sample_values.len() => sample_values[slot],
                Some(slot) => {
                    let column = used.iter().position(|&column| column == slot - SAMPLE_NAMES.len());
                    column.map_or(f64::NAN, |column| values[column])
                }
            };
            numbers.extend(self.evaluate_point(load));
        }
        numbers
    }

    fn uses_slot(&self, slot: usize) -> bool {
        std::iter::once(&self.x).chain(&self.y).any(|quantity| quantity.expression.slots().contains(&slot))
    }

    /// The indices of the used columns in [`COLUMNS`].
    fn used_columns(&self, curve_slots: usize) -> Vec<usize> {
        (0..COLUMNS.len()).filter(|column| self.uses_slot(curve_slots + SAMPLE_NAMES.len() + column)).collect()
    }
}

/// The input at a sample; for the sample after the last of a closed circuit, the input after one traversal.
fn input_at(circuit: &Circuit, sample: usize) -> f64 {
    let traversed = || match (circuit.passes.first(), circuit.passes.last()) {
        (Some(first), Some(last)) => last.to.input.value - first.from.input.value,
        _ => 0.0,
    };
    circuit.inputs.get(sample).copied().unwrap_or_else(|| circuit.inputs[0] + traversed())
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::measure::{ALL, Value};

    #[test]
    fn scope_slots_are_names_then_measures() {
        let names = vec!["p".to_owned()];
        let cell = Cell { number: 1, values: vec![7.0] };
        assert_eq!(Family::scope_value(&cell, &[], 0), 7.0);
        let length = Family::scope(&names, false).index_of("length").unwrap();
        let measures: Vec<Value> = (0..ALL.len()).map(|k| Value::Number(k as f64)).collect();
        let index = ALL.iter().position(|measure| measure.name == "length").unwrap();
        assert_eq!(Family::scope_value(&cell, &measures, length), index as f64);
        assert!(Family::scope_value(&cell, &measures, 1000).is_nan());
    }
}

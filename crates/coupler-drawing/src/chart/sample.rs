//! The points of a chart from a solved cell.

use super::scope::SAMPLE_NAMES;
use super::{Chart, PointSource};
use coupler_curves::family::{Cell, Family};
use coupler_curves::measure::{COLUMNS, Column, compute_columns, cumulative_lengths};
use coupler_curves::motion::Circuit;
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
}

impl Chart {
    /// The number of numbers of a point: x and each y.
    pub fn numbers_per_point(&self) -> usize {
        1 + self.y.len()
    }

    /// The points of a cell, by curve.
    pub fn sample_cell(&self, solved: &SolvedCell) -> Vec<ChartSample> {
        let sample = |curve: &MeasuredCurve| {
            let numbers = match self.point_source {
                PointSource::Curves => {
                    self.evaluate_point(|slot| Family::scope_value(&solved.cell, &curve.values, slot)).collect()
                }
                PointSource::Samples => self.evaluate_samples(solved, curve),
            };
            ChartSample { cell: solved.cell.number, trace: curve.trace, circuit: curve.circuit, numbers }
        };
        solved.curves.iter().map(sample).collect()
    }

    /// The x of a cell, evaluated without measures.
    pub fn cell_x(&self, cell: &Cell) -> f64 {
        self.x.expression.evaluate(|slot| Family::scope_value(cell, &[], slot))
    }

    fn evaluate_point<'a>(&'a self, load: impl Fn(usize) -> f64 + 'a) -> impl Iterator<Item = f64> + 'a {
        std::iter::once(&self.x).chain(&self.y).map(move |quantity| quantity.expression.evaluate(&load))
    }

    /// The numbers of every sample of a curve; on a closed curve the first sample is repeated at the end.
    fn evaluate_samples(&self, solved: &SolvedCell, curve: &MeasuredCurve) -> Vec<f64> {
        let circuit = solved.circuit(curve);
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
            let values = compute_columns(&columns, &solved.linkage, (circuit, curve.joint), sample);
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

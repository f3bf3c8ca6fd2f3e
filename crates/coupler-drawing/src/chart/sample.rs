//! What a chart takes of a solved cell.

use super::scope::SAMPLE_NAMES;
use super::{Chart, PointSource};
use coupler_curves::family::{Cell, Family};
use coupler_curves::measure::{COLUMNS, Column, compute_columns, cumulative_lengths};
use coupler_curves::motion::Circuit;
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// What a chart takes of a curve: a point, or a point for each of its samples.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartSample {
    /// The cell's number, from 1.
    pub cell: usize,
    /// The number of the traced joint, from 1.
    pub trace: usize,
    /// The number of the circuit, from 1.
    pub circuit: usize,
    /// x and then each y, point after point.
    pub numbers: Vec<f64>,
}

impl Chart {
    /// How many numbers a point has.
    pub fn numbers_per_point(&self) -> usize {
        1 + self.y.len()
    }

    /// What the chart takes of a cell, curve by curve.
    pub fn sample_cell(&self, solved: &SolvedCell) -> Vec<ChartSample> {
        let of_curve = |curve: &MeasuredCurve| {
            let numbers = match self.point_source {
                PointSource::Curves => {
                    self.evaluate_point(|slot| Family::scope_value(&solved.cell, &curve.values, slot)).collect()
                }
                PointSource::Samples => self.evaluate_samples(solved, curve),
            };
            ChartSample { cell: solved.cell.number, trace: curve.trace, circuit: curve.circuit, numbers }
        };
        solved.curves.iter().map(of_curve).collect()
    }

    /// The x of a cell, as far as its own values give it.
    pub fn cell_x(&self, cell: &Cell) -> f64 {
        self.x.expression.evaluate(|slot| Family::scope_value(cell, &[], slot))
    }

    fn evaluate_point<'a>(&'a self, load: impl Fn(usize) -> f64 + 'a) -> impl Iterator<Item = f64> + 'a {
        std::iter::once(&self.x).chain(&self.y).map(move |quantity| quantity.expression.evaluate(&load))
    }

    /// Every sample of a curve; a closed one comes back to its first at the end.
    fn evaluate_samples(&self, solved: &SolvedCell, curve: &MeasuredCurve) -> Vec<f64> {
        let circuit = solved.circuit(curve);
        let of_curves = Family::scope(&vec![String::new(); solved.cell.values.len()]).len();
        let used = self.used_columns(of_curves);
        let columns: Vec<Column> = used.iter().map(|&k| COLUMNS[k]).collect();
        let arcs = if self.uses_slot(of_curves + 3) {
            cumulative_lengths(&solved.linkage, circuit, curve.joint)
        } else {
            Vec::new()
        };
        // The measures are the same at every sample.
        let fixed: Vec<f64> =
            (0..of_curves).map(|slot| Family::scope_value(&solved.cell, &curve.values, slot)).collect();
        let mut numbers = Vec::with_capacity((circuit.len() + 1) * self.numbers_per_point());
        for k in 0..circuit.len() + usize::from(circuit.is_closed && !circuit.is_empty()) {
            let sample = k % circuit.len();
            let at = circuit.positions.point(curve.joint, sample);
            let values = compute_columns(&columns, &solved.linkage, (circuit, curve.joint), sample);
            let own = [at.x, at.y, input_at(circuit, k), arcs.get(k).copied().unwrap_or(f64::NAN)];
            let load = |slot: usize| match slot.checked_sub(of_curves) {
                None => fixed[slot],
                Some(slot) if slot < own.len() => own[slot],
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

    /// The columns it uses, by their places in [`COLUMNS`].
    fn used_columns(&self, of_curves: usize) -> Vec<usize> {
        (0..COLUMNS.len()).filter(|column| self.uses_slot(of_curves + SAMPLE_NAMES.len() + column)).collect()
    }
}

/// The input at a sample; at the one after the last, of a closed circuit, that with which it comes back to its first.
fn input_at(circuit: &Circuit, sample: usize) -> f64 {
    let gone = || match (circuit.passes.first(), circuit.passes.last()) {
        (Some(first), Some(last)) => last.to.input.value - first.from.input.value,
        _ => 0.0,
    };
    circuit.inputs.get(sample).copied().unwrap_or_else(|| circuit.inputs[0] + gone())
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::measure::{ALL, Value};

    #[test]
    fn the_scope_has_the_names_before_the_measures() {
        let names = vec!["p".to_owned()];
        let cell = Cell { number: 1, values: vec![7.0] };
        assert_eq!(Family::scope_value(&cell, &[], 0), 7.0);
        let length = Family::scope(&names).iter().position(|(name, _)| *name == "length").unwrap();
        let measures: Vec<Value> = (0..ALL.len()).map(|k| Value::Number(k as f64)).collect();
        let place = ALL.iter().position(|measure| measure.name == "length").unwrap();
        assert_eq!(Family::scope_value(&cell, &measures, length), place as f64);
        assert!(Family::scope_value(&cell, &measures, 1000).is_nan());
    }
}

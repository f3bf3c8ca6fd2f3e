//! What a chart takes of a solved cell.

use super::scope::OF_SAMPLES;
use super::{Chart, Over};
use coupler_curves::family::{Cell, Family};
use coupler_curves::measure::{COLUMNS, Column, lengths_from_start, take_columns};
use coupler_curves::motion::Circuit;
use coupler_curves::solve::{Curve, Solved};

/// What a chart takes of a curve: a point, or a point for each of its samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Taken {
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
    pub fn width(&self) -> usize {
        1 + self.y.len()
    }

    /// What the chart takes of a cell, curve by curve.
    pub fn take(&self, solved: &Solved) -> Vec<Taken> {
        let of_curve = |curve: &Curve| {
            let numbers = match self.over {
                Over::Curves => self.point(|slot| Family::load(&solved.cell, &curve.measures, slot)).collect(),
                Over::Samples => self.samples(solved, curve),
            };
            Taken { cell: solved.cell.number, trace: curve.trace, circuit: curve.circuit, numbers }
        };
        solved.curves.iter().map(of_curve).collect()
    }

    /// The x of a cell, as far as its own values give it.
    pub fn x_of_cell(&self, cell: &Cell) -> f64 {
        self.x.value.evaluate(|slot| Family::load(cell, &[], slot))
    }

    fn point<'a>(&'a self, load: impl Fn(usize) -> f64 + 'a) -> impl Iterator<Item = f64> + 'a {
        std::iter::once(&self.x).chain(&self.y).map(move |quantity| quantity.value.evaluate(&load))
    }

    /// Every sample of a curve; a closed one comes back to its first at the end.
    fn samples(&self, solved: &Solved, curve: &Curve) -> Vec<f64> {
        let circuit = solved.circuit(curve);
        let of_curves = Family::scope(&vec![String::new(); solved.cell.values.len()]).len();
        let used = self.used(of_curves);
        let columns: Vec<Column> = used.iter().map(|&k| COLUMNS[k]).collect();
        let arcs = if self.uses(of_curves + 3) {
            lengths_from_start(&solved.linkage, circuit, curve.joint)
        } else {
            Vec::new()
        };
        // The measures are the same at every sample.
        let fixed: Vec<f64> = (0..of_curves).map(|slot| Family::load(&solved.cell, &curve.measures, slot)).collect();
        let mut numbers = Vec::with_capacity((circuit.len() + 1) * self.width());
        for k in 0..circuit.len() + usize::from(circuit.closed && !circuit.is_empty()) {
            let sample = k % circuit.len();
            let at = circuit.places.point(curve.joint, sample);
            let values = take_columns(&columns, &solved.linkage, (circuit, curve.joint), sample);
            let own = [at.x, at.y, input(circuit, k), arcs.get(k).copied().unwrap_or(f64::NAN)];
            let load = |slot: usize| match slot.checked_sub(of_curves) {
                None => fixed[slot],
                Some(slot) if slot < own.len() => own[slot],
                Some(slot) => {
                    let column = used.iter().position(|&column| column == slot - OF_SAMPLES.len());
                    column.map_or(f64::NAN, |column| values[column])
                }
            };
            numbers.extend(self.point(load));
        }
        numbers
    }

    fn uses(&self, slot: usize) -> bool {
        std::iter::once(&self.x).chain(&self.y).any(|quantity| quantity.value.slots().contains(&slot))
    }

    /// The columns it uses, by their places in [`COLUMNS`].
    fn used(&self, of_curves: usize) -> Vec<usize> {
        (0..COLUMNS.len()).filter(|column| self.uses(of_curves + OF_SAMPLES.len() + column)).collect()
    }
}

/// The input at a sample; at the one after the last, of a closed circuit, that with which it comes back to its first.
fn input(circuit: &Circuit, sample: usize) -> f64 {
    let gone = || match (circuit.passes.first(), circuit.passes.last()) {
        (Some(first), Some(last)) => last.to.stop.at - first.from.stop.at,
        _ => 0.0,
    };
    circuit.input.get(sample).copied().unwrap_or_else(|| circuit.input[0] + gone())
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::measure::{ALL, Value};

    #[test]
    fn the_scope_has_the_names_before_the_measures() {
        let names = vec!["p".to_owned()];
        let cell = Cell { number: 1, values: vec![7.0] };
        assert_eq!(Family::load(&cell, &[], 0), 7.0);
        let length = Family::scope(&names).iter().position(|(name, _)| *name == "length").unwrap();
        let measures: Vec<Value> = (0..ALL.len()).map(|k| Value::Number(k as f64)).collect();
        let place = ALL.iter().position(|measure| measure.name == "length").unwrap();
        assert_eq!(Family::load(&cell, &measures, length), place as f64);
        assert!(Family::load(&cell, &measures, 1000).is_nan());
    }
}

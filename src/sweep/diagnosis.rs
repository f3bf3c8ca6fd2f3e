//! Why no curve of a family is shown: how near its cells come to being assembled, and its curves to what `where` asks for.

use coupler_curves::family::Family;
use coupler_curves::measure::{self, Measure, Value};
use coupler_curves::motion::Sampler;
use coupler_curves::solve::solve_measuring;
use rayon::prelude::*;

/// What the cells of a family come to without its `where`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diagnosis {
    /// The number of cells that cannot be assembled at any input.
    pub unassembled: usize,
    /// Of those, the cell whose lengths miss by least, relative to them, and the reason why it cannot be assembled; the
    /// first of them if none is a matter of lengths.
    pub nearest: Option<NearestCell>,
    /// The number of curves of the other cells.
    pub curves: usize,
    /// The measures that `where` uses, and their values on these curves.
    pub values: Vec<MeasureValues>,
}

/// A cell that cannot be assembled.
#[derive(Clone, Debug, PartialEq)]
pub struct NearestCell {
    /// Its number.
    pub number: usize,
    /// The names and values of its parameters, as in "p = 2, r = 1".
    pub parameters: String,
    /// Why it cannot be assembled.
    pub reason: String,
    /// By how much its lengths miss, relative to them.
    shortfall: f64,
}

/// The values of a measure over some curves.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasureValues {
    /// The name of the measure.
    pub name: &'static str,
    /// The least and the greatest number; `None` if it is a word, or no curve has a value.
    pub range: Option<[f64; 2]>,
    /// The words, in the order in which they are met.
    pub words: Vec<&'static str>,
}

/// Solves the cells of a family without its `where`.
pub fn diagnose(family: &Family) -> Diagnosis {
    let is_used = |(k, _): &(usize, &'static Measure)| {
        family.filter.as_ref().is_some_and(|filter| family.expression_uses(filter, *k))
    };
    let used: Vec<(usize, &Measure)> = measure::ALL.iter().enumerate().filter(is_used).collect();
    let requested: Vec<bool> = (0..measure::ALL.len()).map(|k| used.iter().any(|(used, _)| *used == k)).collect();
    let unfiltered = Family { filter: None, sort: None, ..family.clone() };
    let sampler = Sampler::new(family.sampling);
    let is_driven_by_length = family.template.is_driven_by_length();
    let nothing = || Diagnosis {
        values: used
            .iter()
            .map(|(_, measure)| MeasureValues {
                name: measure.name_for(is_driven_by_length),
                range: None,
                words: Vec::new(),
            })
            .collect(),
        ..Diagnosis::default()
    };
    let diagnose_cell = |cell: usize| {
        let mut found = nothing();
        let Some(solved) = solve_measuring(&unfiltered, &sampler, cell, &requested) else { return found };
        if let (false, Some(error)) = (solved.motion.is_assembled(), &solved.motion.assembly_error) {
            let parameters = family.template.parameters.iter().zip(family.parameter_values(&solved.cell));
            let parameters: Vec<String> = parameters.map(|(p, value)| format!("{} = {value}", p.name)).collect();
            found.unassembled = 1;
            found.nearest = Some(NearestCell {
                number: solved.cell.number,
                parameters: parameters.join(", "),
                reason: error.to_string(),
                shortfall: error.relative_shortfall().unwrap_or(f64::INFINITY),
            });
        }
        for curve in &solved.curves {
            found.curves += 1;
            for (values, (k, _)) in found.values.iter_mut().zip(&used) {
                values.add(curve.values[*k]);
            }
        }
        found
    };
    (0..family.cell_count()).into_par_iter().map(diagnose_cell).reduce(nothing, Diagnosis::with)
}

impl Diagnosis {
    /// That of the cells of both, of which the others come later.
    fn with(mut self, other: Diagnosis) -> Diagnosis {
        self.unassembled += other.unassembled;
        self.curves += other.curves;
        for (values, others) in self.values.iter_mut().zip(other.values) {
            others.range.iter().flatten().for_each(|&number| values.add(Value::Number(number)));
            others.words.iter().for_each(|word| values.add(Value::Word(word)));
        }
        self.nearest = match (self.nearest, other.nearest) {
            (Some(a), Some(b)) => Some(if b.shortfall < a.shortfall { b } else { a }),
            (a, b) => a.or(b),
        };
        self
    }

    /// What it says, as a sentence; `cells` is the number of all cells.
    pub fn describe(&self, cells: usize) -> String {
        let mut parts = Vec::new();
        if let Some(NearestCell { number, parameters, reason, .. }) = &self.nearest {
            let count = if self.unassembled == cells {
                String::new()
            } else {
                format!("{} cells cannot be assembled; ", self.unassembled)
            };
            parts.push(format!("{count}the nearest is cell {number} ({parameters}): {reason}"));
        }
        if self.curves > 0 && !self.values.is_empty() {
            let values: Vec<String> = self.values.iter().map(MeasureValues::describe).collect();
            parts.push(format!("on the {} curves {}", self.curves, values.join(", ")));
        }
        parts.join("; ")
    }
}

impl MeasureValues {
    fn add(&mut self, value: Value) {
        match value {
            Value::Number(number) if !number.is_nan() => {
                let [least, greatest] = self.range.unwrap_or([number; 2]);
                self.range = Some([least.min(number), greatest.max(number)]);
            }
            Value::Word(word) if !self.words.contains(&word) => self.words.push(word),
            _ => {}
        }
    }

    /// "mu_min_deg is 12.5 to 38.61", "class is crank-rocker or drag-link", "time_ratio has no value".
    fn describe(&self) -> String {
        let name = self.name;
        match self.range.map(|ends| ends.map(rounded)) {
            Some([least, greatest]) if least == greatest => format!("`{name}` is {least}"),
            Some([least, greatest]) => format!("`{name}` is {least} to {greatest}"),
            None if self.words.is_empty() => format!("`{name}` has no value"),
            None => format!("`{name}` is {}", self.words.join(" or ")),
        }
    }
}

/// A number with six significant digits.
fn rounded(number: f64) -> f64 {
    format!("{number:.5e}").parse().unwrap_or(number)
}

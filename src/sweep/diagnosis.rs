//! Why no curve of a family is shown: how near its cells come to being assembled, and its curves to what `where` asks for.

use coupler_curves::expression::CompiledExpression;
use coupler_curves::family::{Family, ScopeName};
use coupler_curves::measure::{self, MeasureSet, Value};
use coupler_curves::solve::Solver;
use coupler_curves::text::{pluralize, round_to_six_digits};
use rayon::prelude::*;
use std::ops::Range;

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
    /// The names of the family that `where` uses and what its comparisons compute of them, and the values in all cells.
    pub names: Vec<NamedValues>,
    /// The measures that `where` uses and what its comparisons compute of them, and the values on these curves.
    pub measures: Vec<NamedValues>,
    /// The conditions that `where` joins by `and`, if there are several.
    pub conditions: Vec<FailedCondition>,
}

/// One of several conditions of a family, and how often it is not met.
#[derive(Clone, Debug, PartialEq)]
pub struct FailedCondition {
    /// The condition.
    pub text: String,
    /// Whether it uses a measure, and so is one on curves; or else on cells.
    pub is_on_curves: bool,
    /// The number of curves or cells that do not meet it.
    pub failed: usize,
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

/// The values of a name of a family over its cells, or of a measure over their curves.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedValues {
    /// The name.
    pub name: String,
    /// The least and the greatest number; `None` if it is a word, or no curve has a value.
    pub range: Option<[f64; 2]>,
    /// The words, in the order in which they are met.
    pub words: Vec<&'static str>,
}

/// Solves cells of a family, given by their indices, without its `where`.
pub fn diagnose(family: &Family, cells: Range<usize>) -> Diagnosis {
    let own = |name: ScopeName| if let ScopeName::Own(slot) = name { Some(slot) } else { None };
    let names: Vec<usize> = family.filter.iter().flat_map(|filter| family.names_in(filter)).filter_map(own).collect();
    let used = family.filter.as_ref().map_or(MeasureSet::EMPTY, |filter| family.measures_in(filter));
    let mut conjuncts = family.filter.as_ref().map(|filter| filter.conjuncts()).unwrap_or_default();
    let is_on_curves = |conjunct: &CompiledExpression| !family.measures_in(conjunct).is_empty();
    let (sides_on_curves, sides_on_cells): (Vec<CompiledExpression>, Vec<CompiledExpression>) =
        conjuncts.iter().flat_map(CompiledExpression::computed_sides).partition(is_on_curves);
    if conjuncts.len() == 1 {
        conjuncts.clear();
    }
    let unfiltered = Family { filter: None, sort: None, ..family.clone() };
    let solver = Solver::new(&unfiltered).measuring(used);
    let is_driven_by_length = family.template.is_driven_by_length();
    let texts = |sides: &[CompiledExpression]| sides.iter().map(CompiledExpression::message_text).collect::<Vec<_>>();
    let none_of = |name| NamedValues { name, range: None, words: Vec::new() };
    let nothing = || Diagnosis {
        names: names
            .iter()
            .map(|&slot| family.names[slot].clone())
            .chain(texts(&sides_on_cells))
            .map(none_of)
            .collect(),
        measures: used
            .iter()
            .map(|k| measure::ALL[k].name_for(is_driven_by_length).to_owned())
            .chain(texts(&sides_on_curves))
            .map(none_of)
            .collect(),
        conditions: conjuncts
            .iter()
            .map(|conjunct| FailedCondition {
                text: conjunct.message_text(),
                is_on_curves: is_on_curves(conjunct),
                failed: 0,
            })
            .collect(),
        ..Diagnosis::default()
    };
    let diagnose_cell = |cell: usize| {
        let mut found = nothing();
        let Some(solved) = solver.solve(cell) else { return found };
        let evaluate = |expression: &CompiledExpression, values: &[Value]| {
            expression.evaluate(|slot| Family::scope_value(&solved.cell, values, slot))
        };
        let numbers = names.iter().map(|&slot| solved.cell.values[slot]);
        let numbers = numbers.chain(sides_on_cells.iter().map(|side| evaluate(side, &[])));
        found.names.iter_mut().zip(numbers).for_each(|(values, number)| values.add(Value::Number(number)));
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
        let mut count_failed = |values: Option<&[Value]>| {
            for (condition, conjunct) in found.conditions.iter_mut().zip(&conjuncts) {
                if condition.is_on_curves == values.is_some() {
                    condition.failed += usize::from(evaluate(conjunct, values.unwrap_or_default()) != 1.0);
                }
            }
        };
        count_failed(None);
        solved.curves.iter().for_each(|curve| count_failed(Some(&curve.values)));
        for curve in &solved.curves {
            found.curves += 1;
            let computed = sides_on_curves.iter().map(|side| Value::Number(evaluate(side, &curve.values)));
            let all = used.iter().map(|k| curve.values[k]).chain(computed);
            found.measures.iter_mut().zip(all).for_each(|(values, value)| values.add(value));
        }
        found
    };
    cells.into_par_iter().map(diagnose_cell).reduce(nothing, Diagnosis::with)
}

impl Diagnosis {
    /// That of the cells of both, of which the others come later.
    fn with(mut self, other: Diagnosis) -> Diagnosis {
        self.unassembled += other.unassembled;
        self.curves += other.curves;
        let (own, others) =
            (self.names.iter_mut().chain(&mut self.measures), other.names.into_iter().chain(other.measures));
        for (values, others) in own.zip(others) {
            others.range.iter().flatten().for_each(|&number| values.add(Value::Number(number)));
            others.words.iter().for_each(|word| values.add(Value::Word(word)));
        }
        for (condition, other) in self.conditions.iter_mut().zip(other.conditions) {
            condition.failed += other.failed;
        }
        self.nearest = match (self.nearest, other.nearest) {
            (Some(a), Some(b)) => Some(if b.shortfall < a.shortfall { b } else { a }),
            (a, b) => a.or(b),
        };
        self
    }

    /// Whether it is known by how much the lengths of a cell miss.
    fn has_nearest(&self) -> bool {
        self.nearest.as_ref().is_some_and(|nearest| nearest.shortfall.is_finite())
    }

    /// What it says of a family with this number of cells, in clauses.
    pub fn describe(&self, cells: usize) -> String {
        let list = |values: &[NamedValues]| values.iter().map(NamedValues::describe).collect::<Vec<_>>().join(", ");
        let mut parts = Vec::new();
        // If `where` does not use a measure it does not matter whether cells can be assembled.
        if let Some(NearestCell { number, parameters, reason, .. }) = &self.nearest
            && (!self.measures.is_empty() || self.names.is_empty())
        {
            let count = match self.unassembled {
                unassembled if unassembled == cells => String::new(),
                unassembled => format!("{} cannot be assembled; ", pluralize(unassembled, "cell")),
            };
            let which = if self.has_nearest() { "the nearest is" } else { "for example" };
            parts.push(match cells {
                1 if parameters.is_empty() => reason.clone(),
                1 => format!("with {parameters}, {reason}"),
                _ => format!("{count}{which} cell {number} ({parameters}): {reason}"),
            });
        }
        if !self.names.is_empty() {
            let place = if cells == 1 { String::new() } else { format!("in {} ", pluralize(cells, "cell")) };
            parts.push(place + &list(&self.names));
        }
        if self.curves > 0 && !self.measures.is_empty() {
            let curves = if self.curves == 1 { "the curve".to_owned() } else { format!("the {} curves", self.curves) };
            parts.push(format!("on {curves} {}", list(&self.measures)));
        }
        let failed = |condition: &FailedCondition| {
            let (count, what) = if condition.is_on_curves { (self.curves, "curves") } else { (cells, "cells") };
            (condition.failed > 0).then(|| match count {
                1 => format!("`{}` fails", condition.text),
                _ => format!("`{}` fails for {} of {count} {what}", condition.text, condition.failed),
            })
        };
        parts.extend(self.conditions.iter().filter_map(failed));
        parts.join("; ")
    }
}

impl NamedValues {
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
        let name = &self.name;
        match self.range.map(|ends| ends.map(round_to_six_digits)) {
            Some([least, greatest]) if least == greatest => format!("`{name}` is {least}"),
            Some([least, greatest]) => format!("`{name}` is {least} to {greatest}"),
            None if self.words.is_empty() => format!("`{name}` has no value"),
            None => format!("`{name}` is {}", self.words.join(" or ")),
        }
    }
}

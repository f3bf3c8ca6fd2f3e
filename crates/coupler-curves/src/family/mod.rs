//! A family: a template and the parameter sets to put in it; the k-th of its cells.

mod parameter_space;

pub use parameter_space::{Axis, Case, MAX_CELLS, ParameterSpace};

use std::sync::Arc;

use crate::expression::{Caption, CompiledExpression, Kind};
use crate::measure;
use crate::problem::suggestion;
use crate::template::{self, Linkage, Template, dependency_order};

pub use crate::measure::{ALL as MEASURES, COLUMNS, Column, StraightCriterion, find_column};
pub use crate::motion::{MAX_SAMPLES, Sampling};

/// A linkage over a grid or a list of cases.
#[derive(Clone, Debug)]
pub struct Family {
    /// Its name: that of its folder and its files.
    pub id: String,
    /// Its title on pages.
    pub title: String,
    /// The linkage.
    pub template: Arc<Template>,
    /// The names that have a value in each cell: the template's parameters, then the helpers.
    pub names: Vec<String>,
    /// The parameter sets.
    pub space: ParameterSpace,
    /// What is computed from what is given: a name's place and its expression over `names`, in order of computation.
    pub derived: Vec<(usize, CompiledExpression)>,
    /// How circuits are sampled.
    pub sampling: Sampling,
    /// The further columns of `points.csv`.
    pub columns: Vec<Column>,
    /// What is asked of the straight portion of each curve.
    pub straight: StraightCriterion,
    /// Which measures are taken of each curve, by their places in [`measure::ALL`].
    pub is_computed: Vec<bool>,
    /// Which curves are kept, over [`Family::scope`].
    pub filter: Option<CompiledExpression>,
    /// What the cells on pages are sorted by, least first, over [`Family::scope`]; by their numbers where there is none.
    pub sort: Option<CompiledExpression>,
    /// The lines under a cell on pages: the linkage's own, or the family's over [`Family::scope`].
    pub captions: [Option<Caption>; 2],
}

/// One parameter set of a family.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Its number, from 1, in grid or case order.
    pub number: usize,
    /// The values of [`Family::names`].
    pub values: Vec<f64>,
}

/// What is wrong with a cell.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CellError {
    /// A parameter has no value.
    #[error("`{0}` has no value")]
    Missing(String),
    /// A value is not finite or out of its bounds.
    #[error("{message}")]
    Value {
        /// The name's place in [`Family::names`].
        slot: usize,
        /// What is wrong with its value.
        message: String,
    },
    /// The values make no linkage.
    #[error(transparent)]
    Template(#[from] template::Error),
}

/// Expressions in an order in which each comes after those it uses; each goes with the place of the name it gives.
///
/// # Errors
/// The places of a cycle of names, the first once more at the end.
pub fn sort_by_dependency(
    sources: Vec<(usize, CompiledExpression)>,
) -> Result<Vec<(usize, CompiledExpression)>, Vec<usize>> {
    let needs = |k: usize| -> Vec<usize> {
        (0..sources.len()).filter(|&other| sources[k].1.slots().contains(&sources[other].0)).collect()
    };
    match dependency_order(sources.len(), needs) {
        Ok(order) => Ok(order.into_iter().map(|k| sources[k].clone()).collect()),
        Err(open) => Err(open.cycle.into_iter().map(|k| sources[k].0).collect()),
    }
}

impl Family {
    /// A family of the one cell that gives a template these values, its defaults for the rest.
    ///
    /// # Errors
    /// A name that is no parameter, defaults that need each other, or what is wrong with the values.
    pub fn single_cell(
        template: Arc<Template>,
        given: &[(String, f64)],
        sampling: Sampling,
    ) -> Result<Family, Vec<String>> {
        let names: Vec<String> = template.parameters.iter().map(|parameter| parameter.name.clone()).collect();
        let known: Vec<&str> = names.iter().map(String::as_str).collect();
        let scope: Vec<(&str, Kind)> = known.iter().map(|name| (*name, Kind::Number)).collect();
        let mut case = Vec::new();
        let mut wrong = Vec::new();
        for (name, value) in given {
            match known.iter().position(|known| known == name) {
                Some(slot) if case.iter().all(|(other, _)| *other != slot) => case.push((slot, *value)),
                Some(_) => wrong.push(format!("`{name}` is given twice")),
                None => wrong.push(format!("there is no parameter `{name}`: {}", suggestion(name, &known))),
            }
        }
        let is_given = |slot: usize| case.iter().any(|(given, _)| *given == slot);
        let default = |(slot, parameter): (usize, &template::Parameter)| {
            let expression = parameter.default.as_ref().filter(|_| !is_given(slot))?;
            Some((slot, expression.compile(&scope, Kind::Number).ok()?))
        };
        let sources = template.parameters.iter().enumerate().filter_map(default).collect();
        let derived = sort_by_dependency(sources).map_err(|cycle| {
            let words: Vec<&str> = cycle.iter().map(|&slot| known[slot]).collect();
            vec![format!("the defaults need each other, {}: give one of them", words.join(" -> "))]
        })?;
        let (id, title) = (template.id.clone(), template.id.clone());
        let space = ParameterSpace::Cases(vec![case]);
        let (columns, straight) = (Vec::new(), StraightCriterion::default());
        let captions = [template.caption.clone(), template.note.clone()];
        let family = Family {
            id,
            title,
            template,
            names,
            space,
            derived,
            sampling,
            columns,
            straight,
            is_computed: vec![true; measure::ALL.len()],
            filter: None,
            sort: None,
            captions,
        };
        if wrong.is_empty() {
            wrong.extend(family.cell_errors(&family.cell(0)).iter().map(ToString::to_string));
        }
        if wrong.is_empty() { Ok(family) } else { Err(wrong) }
    }

    /// How many cells there are.
    pub fn cell_count(&self) -> usize {
        self.space.count()
    }

    /// The `k`-th cell, from 0.
    pub fn cell(&self, k: usize) -> Cell {
        let mut values = vec![f64::NAN; self.names.len()];
        self.space.fill(k, &mut values);
        for (slot, expression) in &self.derived {
            // A case may give what others leave to its default.
            if values[*slot].is_nan() {
                values[*slot] = expression.evaluate(|slot| values[slot]);
            }
        }
        Cell { number: k + 1, values }
    }

    /// The template's parameters in a cell.
    pub fn parameter_values<'c>(&self, cell: &'c Cell) -> &'c [f64] {
        &cell.values[..self.template.parameters.len()]
    }

    /// The linkage of a cell.
    ///
    /// # Errors
    /// Values that make no linkage; none in a family that [`Family::cell_errors`] has none to for any cell.
    pub fn linkage(&self, cell: &Cell) -> Result<Linkage, template::Error> {
        self.template.linkage(self.parameter_values(cell))
    }

    /// What is wrong with a cell: names without a value, or else values out of their bounds, or else the linkage.
    pub fn cell_errors(&self, cell: &Cell) -> Vec<CellError> {
        let has_source = |slot: usize| {
            self.space.assigns(cell.number - 1, slot) || self.derived.iter().any(|(derived, _)| *derived == slot)
        };
        let missing = |(slot, name): (usize, &String)| (!has_source(slot)).then(|| CellError::Missing(name.clone()));
        let found: Vec<CellError> = self.names.iter().enumerate().filter_map(missing).collect();
        if !found.is_empty() {
            return found;
        }
        let objection = |(slot, (name, &value)): (usize, (&String, &f64))| {
            let objection = match self.template.parameters.get(slot) {
                Some(parameter) => parameter.value_error(value),
                None if value.is_finite() => None,
                None => Some(format!("`{name}` is {value}, which is not a finite number")),
            };
            objection.map(|objection| CellError::Value { slot, message: objection })
        };
        let found: Vec<CellError> = self.names.iter().zip(&cell.values).enumerate().filter_map(objection).collect();
        if !found.is_empty() {
            return found;
        }
        self.linkage(cell).err().map(CellError::Template).into_iter().collect()
    }

    /// The lines under a cell with its values, and what was measured of its first curve, in them; empty where there is none.
    pub fn format_captions(&self, cell: &Cell, measures: &[measure::Value]) -> [String; 2] {
        let scope = Family::scope(&self.names);
        let load = |name: &str| match scope.iter().position(|(known, _)| *known == name) {
            Some(slot) => Family::scope_value(cell, measures, slot),
            None => f64::NAN,
        };
        let word = |name: &str| {
            let is_named =
                |(measure, _): &(&measure::Measure, &measure::Value)| measure.name == name && measure.is_word;
            match measure::ALL.iter().zip(measures).find(is_named)? {
                (_, measure::Value::Word(word)) => Some(*word),
                _ => Some("–"),
            }
        };
        self.captions.each_ref().map(|line| line.as_ref().map(|line| line.format(load, word)).unwrap_or_default())
    }

    /// The value of a name in a cell; not a number where there is none.
    pub fn value(&self, name: &str, cell: &Cell) -> f64 {
        self.names.iter().position(|n| n == name).map_or(f64::NAN, |slot| cell.values[slot])
    }

    /// The names a family's `where` may use and what they are: the cells', the measures and the classes.
    pub fn scope(names: &[String]) -> Vec<(&str, Kind)> {
        let own = names.iter().map(|name| (name.as_str(), Kind::Number));
        let is_number = |measure: &&measure::Measure| !measure.is_word;
        let measures = measure::ALL.iter().filter(is_number).map(|measure| (measure.name, Kind::Number));
        let truths = measure::BOOLEANS.iter().map(|(name, _)| (*name, Kind::Boolean));
        own.chain(measures).chain(truths).collect()
    }

    /// Whether `where` or `sort` ask for a measure, told by its place in [`measure::ALL`].
    pub fn filter_or_sort_uses(&self, measure: usize) -> bool {
        self.filter.iter().chain(&self.sort).any(|bound| self.expression_uses(bound, measure))
    }

    /// Whether it takes a measure, told by its place in [`measure::ALL`], to evaluate an expression over [`Family::scope`].
    pub fn expression_uses(&self, expression: &CompiledExpression, measure: usize) -> bool {
        let is_number = |k: &usize| !measure::ALL[*k].is_word;
        let numbers: Vec<usize> = (0..measure::ALL.len()).filter(is_number).collect();
        let mut asked = expression.slots().iter().filter_map(|slot| slot.checked_sub(self.names.len()));
        // What follows the numbers is true or false.
        asked.any(|slot| numbers.get(slot).map_or(measure::defines_booleans(measure), |k| *k == measure))
    }

    /// Whether the lines under a cell tell a measure.
    pub fn captions_use(&self, measure: usize) -> bool {
        self.captions.iter().flatten().any(|caption| caption.uses(measure::ALL[measure].name))
    }

    /// The measures that are taken.
    pub fn computed_measures(&self) -> impl Iterator<Item = (usize, &'static measure::Measure)> {
        measure::ALL.iter().enumerate().filter(|(k, _)| self.is_computed[*k])
    }

    /// The measures that are words: a caption tells them, and nothing can be reckoned with them.
    pub fn word_measure_names() -> impl Iterator<Item = &'static str> {
        measure::ALL.iter().filter(|measure| measure.is_word).map(|measure| measure.name)
    }

    /// The measures that are numbers.
    pub fn numeric_measure_names() -> impl Iterator<Item = &'static str> {
        measure::ALL.iter().filter(|measure| !measure.is_word).map(|measure| measure.name)
    }

    /// Whether a name is that of a column of `points.csv` or `cells.csv`, or of a measure.
    pub fn is_column_name(name: &str) -> bool {
        const COLUMNS: [&str; 8] = ["cell", "trace", "circuit", "branch", "sample", "input_deg", "status", "reason"];
        let is_measure = measure::ALL.iter().any(|measure| measure.name == name);
        COLUMNS.contains(&name) || is_measure || measure::BOOLEANS.iter().any(|(truth, _)| *truth == name)
    }

    /// Whether a curve of a cell with these measures is kept.
    pub fn keeps(&self, cell: &Cell, measures: &[measure::Value]) -> bool {
        let Some(filter) = &self.filter else { return true };
        filter.evaluate(|slot| Family::scope_value(cell, measures, slot)) == 1.0
    }

    /// Where a curve of a cell with these measures comes in the order of pages; not a number where it cannot be told.
    pub fn sort_key(&self, cell: &Cell, measures: &[measure::Value]) -> f64 {
        self.sort
            .as_ref()
            .map_or(cell.number as f64, |sort| sort.evaluate(|slot| Family::scope_value(cell, measures, slot)))
    }

    /// The value of the name at a place of [`Family::scope`]; not a number where it has none, or the scope no such place.
    pub fn scope_value(cell: &Cell, measures: &[measure::Value], slot: usize) -> f64 {
        let numbers = || measure::ALL.iter().zip(measures).filter(|(measure, _)| !measure.is_word);
        let count = measure::ALL.iter().filter(|measure| !measure.is_word).count();
        match slot.checked_sub(cell.values.len()) {
            None => cell.values[slot],
            Some(slot) if slot < count => match numbers().nth(slot) {
                Some((_, measure::Value::Number(value))) => *value,
                _ => f64::NAN,
            },
            Some(slot) => {
                measure::BOOLEANS.get(slot - count).map_or(f64::NAN, |(_, word)| measure::bool_value(word, measures))
            }
        }
    }
}

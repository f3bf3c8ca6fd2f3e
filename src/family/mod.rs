//! A family: a template and the parameter sets to put in it; the k-th of its cells.

mod space;

pub use space::{Axis, Case, MAX_CELLS, Space};

use std::sync::Arc;

use crate::expression::{Bound, Kind};
use crate::measure;
use crate::template::{self, Linkage, Template};

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
    pub space: Space,
    /// What is computed from what is given: a name's place and its expression over `names`, in order of computation.
    pub derived: Vec<(usize, Bound)>,
    /// How circuits are sampled.
    pub sampling: Sampling,
    /// Which curves are kept, over [`Family::scope`].
    pub filter: Option<Bound>,
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
    #[error("{objection}")]
    Value {
        /// The name's place in [`Family::names`].
        slot: usize,
        /// What is wrong with its value.
        objection: String,
    },
    /// The values make no linkage.
    #[error(transparent)]
    Template(#[from] template::Error),
}

impl Family {
    /// How many cells there are.
    pub fn cells(&self) -> usize {
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
    pub fn parameters<'c>(&self, cell: &'c Cell) -> &'c [f64] {
        &cell.values[..self.template.parameters.len()]
    }

    /// The linkage of a cell.
    ///
    /// # Errors
    /// Values that make no linkage; none in a family that passed [`Family::objection`] for every cell.
    pub fn linkage(&self, cell: &Cell) -> Result<Linkage, template::Error> {
        self.template.linkage(self.parameters(cell))
    }

    /// What is wrong with a cell, if anything.
    pub fn objection(&self, cell: &Cell) -> Option<CellError> {
        for (slot, (name, &value)) in self.names.iter().zip(&cell.values).enumerate() {
            let objection = match self.template.parameters.get(slot) {
                Some(parameter) => parameter.objection(value),
                None if value.is_finite() => None,
                None => Some(format!("`{name}` is {value}, which is not a finite number")),
            };
            if let Some(objection) = objection {
                let is_given = self.space.gives(cell.number - 1, slot);
                let has_source = is_given || self.derived.iter().any(|(derived, _)| *derived == slot);
                return Some(if has_source {
                    CellError::Value { slot, objection }
                } else {
                    CellError::Missing(name.clone())
                });
            }
        }
        self.linkage(cell).err().map(CellError::Template)
    }

    /// A line of text with a cell's values in it.
    pub fn describe(&self, caption: &crate::expression::Caption, cell: &Cell) -> String {
        caption.format(|name| self.value(name, cell))
    }

    /// The value of a name in a cell; not a number where there is none.
    pub fn value(&self, name: &str, cell: &Cell) -> f64 {
        self.names.iter().position(|n| n == name).map_or(f64::NAN, |slot| cell.values[slot])
    }

    /// The names a family's `where` may use and what they are: the cells', the measures and the classes.
    pub fn scope(names: &[String]) -> Vec<(&str, Kind)> {
        let own = names.iter().map(|name| (name.as_str(), Kind::Number));
        let measures = measure::ALL.iter().map(|measure| (measure.name, Kind::Number));
        let truths = measure::TRUTHS.iter().map(|(name, _)| (*name, Kind::Truth));
        own.chain(measures).chain(truths).collect()
    }

    /// Whether a curve of a cell with these measures is kept.
    pub fn keeps(&self, cell: &Cell, measures: &[measure::Value]) -> bool {
        let Some(filter) = &self.filter else { return true };
        let load = |slot: usize| {
            let Some(slot) = slot.checked_sub(cell.values.len()) else { return cell.values[slot] };
            match slot.checked_sub(measure::ALL.len()) {
                Some(truth) => measure::truth(measure::TRUTHS[truth].1, measures),
                None => match measures.get(slot) {
                    Some(measure::Value::Number(value)) => *value,
                    _ => f64::NAN,
                },
            }
        };
        filter.evaluate(load) == 1.0
    }
}

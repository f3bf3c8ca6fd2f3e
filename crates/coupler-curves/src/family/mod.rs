//! A family: a linkage template and its parameter sets, the cells.

mod axis_values;
mod dimensions;
mod length_unit;
mod memory;
mod parameter_space;
mod parameter_text;
mod scope;
mod single_cell;

pub use axis_values::AxisValues;
pub use length_unit::LengthUnit;
pub use parameter_space::{Axis, Case, ParameterSpace};
pub use parameter_text::{ParameterSyntaxError, ParameterText, ParameterUnitError};
pub use single_cell::{ParameterError, ParameterErrors};

use std::collections::HashMap;
use std::sync::Arc;

use crate::expression::{Caption, CompiledExpression};
use crate::measure::{self, MeasureSet};
use crate::template::{self, Linkage, Template, dependency_order};

pub use crate::measure::StraightCriterion;
pub use crate::motion::Sampling;

// For the other crates of the workspace only.
#[doc(hidden)]
pub use self::{dimensions::CaptionParameter, parameter_space::MAX_CELLS, scope::ScopeName};
#[doc(hidden)]
pub use crate::{
    measure::{ALL as MEASURES, COLUMNS, Column, find_column},
    motion::MAX_SAMPLES,
};

/// A linkage template over a grid or a list of cases.
#[derive(Clone, Debug)]
pub struct Family {
    /// Its name, which its folder and files share.
    pub id: String,
    /// The title on its pages.
    pub title: String,
    /// The linkage.
    pub template: Arc<Template>,
    /// The unit of its lengths; `None` if they are in a unit of their own.
    pub unit: Option<LengthUnit>,
    /// The names with a value in each cell: the template's parameters, then the helpers.
    pub names: Vec<String>,
    /// The parameter sets.
    pub space: ParameterSpace,
    /// The derived values in order of computation: the index of a name in `names`, and its expression over `names`.
    pub derived: Vec<(usize, CompiledExpression)>,
    /// How circuits are sampled.
    pub sampling: Sampling,
    /// The additional columns of `points.csv`.
    pub columns: Vec<Column>,
    /// The criterion for the straight portion of each curve.
    pub straight: StraightCriterion,
    /// The measures that are computed.
    pub measures: MeasureSet,
    /// The condition on a curve to be kept, over [`Family::scope`].
    pub filter: Option<CompiledExpression>,
    /// The sort key of the cells on pages, ascending, over [`Family::scope`]; their numbers by default.
    pub sort: Option<CompiledExpression>,
    /// The two caption lines of a cell on pages: the linkage's, or the family's over [`Family::scope`].
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

/// Why a cell has no linkage.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CellError {
    /// A parameter has no value.
    #[error("`{0}` has no value")]
    Missing(String),
    /// A value is not finite, or out of its bounds.
    #[error("{message}")]
    Value {
        /// The name's index in [`Family::names`].
        slot: usize,
        /// The error in its value.
        message: String,
    },
    /// The linkage cannot be built from these values.
    #[error(transparent)]
    Template(#[from] template::Error),
}

/// A family has no cell with a number.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no {family}:{number}: its cells are numbered from 1 to {count}")]
pub struct NoSuchCell {
    /// The id of the family.
    pub family: String,
    /// The number.
    pub number: usize,
    /// The number of its cells.
    pub count: usize,
}

/// Sorts expressions so that each comes after those it uses; each is paired with the index of the name it defines.
///
/// # Errors
/// The indices of a cycle of names, with the first repeated at the end.
#[doc(hidden)]
pub fn sort_by_dependency(
    sources: Vec<(usize, CompiledExpression)>,
) -> Result<Vec<(usize, CompiledExpression)>, Vec<usize>> {
    let mut definitions: HashMap<usize, Vec<usize>> = HashMap::new();
    for (k, (slot, _)) in sources.iter().enumerate() {
        definitions.entry(*slot).or_default().push(k);
    }
    let needs = |k: usize| -> Vec<usize> {
        let used = sources[k].1.slots().iter().filter_map(|slot| definitions.get(slot));
        let mut needs: Vec<usize> = used.flatten().copied().collect();
        needs.sort_unstable();
        needs
    };
    match dependency_order(sources.len(), needs) {
        Ok(order) => Ok(order.into_iter().map(|k| sources[k].clone()).collect()),
        Err(error) => Err(error.cycle.into_iter().map(|k| sources[k].0).collect()),
    }
}

impl Family {
    /// The legend of its linkage, with the unit of the lengths.
    pub fn legend(&self) -> String {
        let legend = Some(self.template.legend.clone()).filter(|legend| !legend.is_empty());
        let unit = self.unit.map(LengthUnit::note);
        legend.into_iter().chain(unit).collect::<Vec<_>>().join(" · ")
    }

    /// The line under the title of its pages without the legend, if it ends with that.
    pub fn source_without_legend<'l>(&self, line: &'l str) -> &'l str {
        line.strip_suffix(&self.legend()).and_then(|rest| rest.strip_suffix(" · ")).unwrap_or(line)
    }

    /// The number of cells.
    pub fn cell_count(&self) -> usize {
        self.space.count()
    }

    /// The index, from 0, of the cell with a number, from 1.
    ///
    /// # Errors
    /// The family has no such cell.
    pub fn cell_index(&self, number: usize) -> Result<usize, NoSuchCell> {
        let count = self.cell_count();
        let index = number.checked_sub(1).filter(|k| *k < count);
        index.ok_or_else(|| NoSuchCell { family: self.id.clone(), number, count })
    }

    /// The `k`-th cell, from 0.
    pub fn cell(&self, k: usize) -> Cell {
        let mut values = vec![f64::NAN; self.names.len()];
        self.space.fill(k, &mut values);
        for (slot, expression) in &self.derived {
            // One case may give a value to a parameter that another leaves at its default.
            if values[*slot].is_nan() {
                values[*slot] = expression.evaluate(|slot| values[slot]);
            }
        }
        Cell { number: k + 1, values }
    }

    /// The values of the template's parameters in a cell.
    pub fn parameter_values<'c>(&self, cell: &'c Cell) -> &'c [f64] {
        &cell.values[..self.template.parameters.len()]
    }

    /// The linkage of a cell.
    ///
    /// # Errors
    /// The linkage cannot be built from the cell's values; this never happens if [`Family::cell_errors`] is empty.
    pub fn linkage(&self, cell: &Cell) -> Result<Linkage, template::Error> {
        self.template.linkage(self.parameter_values(cell))
    }

    /// The errors of a cell: names without a value, or else values out of their bounds, or else the linkage's error.
    pub fn cell_errors(&self, cell: &Cell) -> Vec<CellError> {
        let value_error = |(slot, (name, &value)): (usize, (&String, &f64))| {
            let message = match self.template.parameters.get(slot) {
                Some(parameter) => parameter.value_error(value),
                None if value.is_finite() => None,
                None => Some(format!("`{name}` is {value}, which is not a finite number")),
            };
            message.map(|message| CellError::Value { slot, message })
        };
        let errors: Vec<CellError> = self.names.iter().zip(&cell.values).enumerate().filter_map(value_error).collect();
        if errors.is_empty() {
            return self.linkage(cell).err().map(CellError::Template).into_iter().collect();
        }
        // A name without a value is not a number, nor is what is derived from it.
        let missing = self.names_without_value(cell);
        let is_known = |error: &CellError| match error {
            CellError::Value { slot, .. } => missing.is_empty() || cell.values[*slot].is_finite(),
            CellError::Missing(_) | CellError::Template(_) => true,
        };
        let known: Vec<CellError> = errors.into_iter().filter(is_known).collect();
        missing.into_iter().map(CellError::Missing).chain(known).collect()
    }

    /// The names that neither the parameter set of a cell nor an expression gives a value to.
    fn names_without_value(&self, cell: &Cell) -> Vec<String> {
        let mut has_value = vec![false; self.names.len()];
        self.derived.iter().for_each(|(slot, _)| has_value[*slot] = true);
        self.space.slots_of(cell.number - 1).for_each(|slot| has_value[slot] = true);
        self.names.iter().zip(has_value).filter(|(_, has_value)| !has_value).map(|(name, _)| name.clone()).collect()
    }

    /// The value of a name in a cell; NaN for an unknown name.
    pub fn value(&self, name: &str, cell: &Cell) -> f64 {
        self.names.iter().position(|n| n == name).map_or(f64::NAN, |slot| cell.values[slot])
    }

    /// The measures that are computed, with their indices in [`measure::ALL`].
    pub fn computed_measures(&self) -> impl Iterator<Item = (usize, &'static measure::Measure)> {
        self.measures.iter().map(|k| (k, &measure::ALL[k]))
    }

    /// The names of the measures that are words, which captions may show; in expressions only those can be used that are
    /// also the names of booleans.
    pub fn word_measure_names() -> impl Iterator<Item = &'static str> {
        measure::ALL.iter().filter(|measure| measure.is_word).map(|measure| measure.name)
    }

    /// Whether a name is that of a column of `points.csv` or `cells.csv`, of a measure or of a boolean.
    pub fn is_column_name(name: &str) -> bool {
        const COLUMNS: [&str; 11] = [
            "cell",
            "trace",
            "circuit",
            "branch",
            "sample",
            "input_deg",
            "input_length",
            "status",
            "reason",
            "family",
            "joint",
        ];
        COLUMNS.contains(&name)
            || measure::Measure::find(name).is_some()
            || measure::BOOLEANS.iter().any(|boolean| boolean.name == name)
    }
}

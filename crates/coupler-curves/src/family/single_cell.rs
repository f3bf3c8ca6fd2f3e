//! A family of one cell: a linkage with one parameter set.

use std::fmt;
use std::sync::Arc;

use super::{Case, CellError, Family, ParameterSpace, Sampling, StraightCriterion, sort_by_dependency};
use crate::expression::{Kind, Scope};
use crate::measure::MeasureSet;
use crate::problem::suggestion;
use crate::template::{self, Template};

/// Why values cannot be the parameters of a linkage.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ParameterError {
    /// The linkage has no parameter of this name.
    #[error("unknown parameter `{name}`; {suggestion}")]
    Unknown {
        /// The name.
        name: String,
        /// The nearest parameter, or all of them.
        suggestion: String,
    },
    /// A parameter has two values.
    #[error("`{name}` is given twice")]
    Repeated {
        /// The name.
        name: String,
    },
    /// The defaults of some parameters depend on each other.
    #[error("the defaults depend on each other, {}; give one of them", cycle.join(" -> "))]
    CyclicDefaults {
        /// The names, with the first repeated at the end.
        cycle: Vec<String>,
    },
    /// A parameter has no value, or one out of its bounds, or the linkage cannot be built.
    #[error(transparent)]
    Cell(#[from] CellError),
}

/// All errors of a parameter set, at least one; displayed one on a line.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterErrors(Vec<ParameterError>);

impl ParameterErrors {
    /// The errors, in the order of the values and then of the parameters.
    pub fn iter(&self) -> std::slice::Iter<'_, ParameterError> {
        self.0.iter()
    }
}

impl<'a> IntoIterator for &'a ParameterErrors {
    type Item = &'a ParameterError;
    type IntoIter = std::slice::Iter<'a, ParameterError>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl fmt::Display for ParameterErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, error) in self.0.iter().enumerate() {
            write!(f, "{}{error}", if k == 0 { "" } else { "\n" })?;
        }
        Ok(())
    }
}

impl std::error::Error for ParameterErrors {}

impl Family {
    /// The values that the `k`-th parameter set, from 0, gives to names; all others are derived from these.
    pub fn case(&self, k: usize) -> Case {
        let cell = self.cell(k);
        let slots = (0..self.names.len()).filter(|&slot| self.space.assigns(k, slot));
        slots.map(|slot| (slot, cell.values[slot])).collect()
    }

    /// The same family with a single parameter set, and without `where` and `sort`: a cell that is asked for is not left
    /// out. The values are those of the case if it has them, and otherwise derived; [`Family::cell_errors`] has the
    /// errors in them.
    pub fn with_case(&self, case: Case) -> Family {
        Family { space: ParameterSpace::Cases(vec![case]), filter: None, sort: None, ..self.clone() }
    }

    /// A family of one cell: a linkage with these values, and its defaults for the other parameters.
    ///
    /// # Errors
    /// A name that is not a parameter, a parameter given twice, defaults that depend on each other, or the
    /// [`Family::cell_errors`] of the cell.
    pub fn single_cell(
        template: Arc<Template>,
        values: &[(String, f64)],
        sampling: Sampling,
    ) -> Result<Family, ParameterErrors> {
        let names: Vec<String> = template.parameters.iter().map(|parameter| parameter.name.clone()).collect();
        let known: Vec<&str> = names.iter().map(String::as_str).collect();
        let scope = Scope::from_numbers(known.iter().copied());
        let mut has_value = vec![false; names.len()];
        let mut case = Vec::new();
        let mut errors = Vec::new();
        for (name, value) in values {
            match scope.index_of(name) {
                Some(slot) if !has_value[slot] => {
                    has_value[slot] = true;
                    case.push((slot, *value));
                }
                Some(_) => errors.push(ParameterError::Repeated { name: name.clone() }),
                None => {
                    let suggestion = suggestion(name, &known);
                    errors.push(ParameterError::Unknown { name: name.clone(), suggestion });
                }
            }
        }
        let default = |(slot, parameter): (usize, &template::Parameter)| {
            let expression = parameter.default.as_ref().filter(|_| !has_value[slot])?;
            Some((slot, expression.compile(&scope, Kind::Number).ok()?))
        };
        let defaults = template.parameters.iter().enumerate().filter_map(default).collect();
        let derived = sort_by_dependency(defaults).map_err(|cycle| {
            let cycle = cycle.iter().map(|&slot| known[slot].to_owned()).collect();
            ParameterErrors(vec![ParameterError::CyclicDefaults { cycle }])
        })?;
        let family = Family {
            id: template.id.clone(),
            title: template.id.clone(),
            captions: [template.caption.clone(), template.note.clone()],
            unit: None,
            template,
            names,
            space: ParameterSpace::Cases(vec![case]),
            derived,
            sampling,
            columns: Vec::new(),
            straight: StraightCriterion::default(),
            measures: MeasureSet::ALL,
            filter: None,
            sort: None,
        };
        if errors.is_empty() {
            errors.extend(family.cell_errors(&family.cell(0)).into_iter().map(ParameterError::Cell));
        }
        if errors.is_empty() { Ok(family) } else { Err(ParameterErrors(errors)) }
    }
}

//! A cell with other values for some of its parameters, or with a traced point at another place of its link.

use std::sync::Arc;

use super::moved_point::{MovedPointError, move_point};
use super::solved_cell::SolvedCell;
use crate::family::{Case, CellError, Family, NoSuchCell};
use crate::linkage::CircuitSelection;
use crate::problem::suggestion;

/// A changed cell of a family.
#[derive(Clone, Debug)]
pub struct ChangedCell {
    /// A family of this cell only, without `where` and `sort`.
    pub family: Family,
    /// The numbers that the cell and its curves have in the family it was taken from.
    pub numbers: OriginalNumbers,
    /// The number of a circuit among all circuits of the linkage, if one was asked for.
    pub circuit: Option<usize>,
}

/// The numbers of a changed cell and of its curves in the family that the cell was taken from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OriginalNumbers {
    cell: usize,
    /// The number of the trace of a moved point in the changed cell and in the original one, if they differ.
    moved_trace: Option<[usize; 2]>,
}

/// Why a cell cannot be changed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ChangeError {
    /// The family has no such cell.
    #[error(transparent)]
    NoSuchCell(#[from] NoSuchCell),
    /// The family has no parameter and no helper of this name.
    #[error("{family}: there is no `{name}`: {suggestion}")]
    UnknownName {
        /// The id of the family.
        family: String,
        /// The name.
        name: String,
        /// The nearest name, or all of them.
        suggestion: String,
    },
    /// The changed cell has no linkage.
    #[error("{family}:{number}: {error}")]
    Cell {
        /// The id of the family.
        family: String,
        /// The number of the cell.
        number: usize,
        /// What is wrong with its values.
        error: CellError,
    },
    /// The number of a circuit is not a whole number from 1.
    #[error("{family}: `circuit` is {value}, not the number of a circuit, 1 or more")]
    Circuit {
        /// The id of the family.
        family: String,
        /// The number.
        value: f64,
    },
    /// The point cannot be moved.
    #[error("{family}: {error}")]
    MovedPoint {
        /// The id of the family.
        family: String,
        /// Why not.
        error: MovedPointError,
    },
}

impl ChangedCell {
    /// The cell of a family with a number, from 1, and with other values for the named parameters, helpers and
    /// coordinates.
    ///
    /// `M.along` and `M.across` are the coordinates of the point M on its link, which must be the point of `trace`,
    /// counted from 1. `circuit` is the number of a circuit, from 1, among all circuits of the linkage, of which the
    /// family may have only one.
    ///
    /// # Errors
    /// The family has no such cell; or every unknown name; or else every error in the cell's values; or else why the
    /// point cannot be moved.
    pub fn new(
        family: &Family,
        number: usize,
        trace: Option<usize>,
        overrides: &[(String, f64)],
    ) -> Result<ChangedCell, Vec<ChangeError>> {
        let k = family.cell_index(number).map_err(|error| vec![error.into()])?;
        ChangedCell::from_case(family, (number, family.case(k)), trace, overrides)
    }

    /// The same for the cell with a number that these values make, whether the family has it or not.
    ///
    /// # Errors
    /// As of [`ChangedCell::new`].
    pub fn from_case(
        family: &Family,
        (number, mut case): (usize, Case),
        trace: Option<usize>,
        overrides: &[(String, f64)],
    ) -> Result<ChangedCell, Vec<ChangeError>> {
        let id = || family.id.clone();
        let known: Vec<&str> = family.names.iter().map(String::as_str).collect();
        let mut errors = Vec::new();
        // The name of a coordinate contains a dot; that of a parameter never does.
        let (coordinates, parameters): (Vec<_>, Vec<_>) = overrides.iter().partition(|(name, _)| name.contains('.'));
        let mut circuit = None;
        for (name, value) in parameters {
            match known.iter().position(|known| known == name) {
                Some(slot) => {
                    case.retain(|(assigned, _)| *assigned != slot);
                    case.push((slot, *value));
                }
                None if name == "circuit" => match value {
                    value if *value >= 1.0 && value.fract() == 0.0 => circuit = Some(*value as usize),
                    value => errors.push(ChangeError::Circuit { family: id(), value: *value }),
                },
                None => {
                    let suggestion = suggestion(name, &known);
                    errors.push(ChangeError::UnknownName { family: id(), name: name.clone(), suggestion });
                }
            }
        }
        let mut changed = family.with_case(case);
        if errors.is_empty() {
            let cell_errors = changed.cell_errors(&changed.cell(0));
            errors.extend(cell_errors.into_iter().map(|error| ChangeError::Cell { family: id(), number, error }));
        }
        if !errors.is_empty() {
            return Err(errors);
        }
        let mut numbers = OriginalNumbers { cell: number, moved_trace: None };
        if !coordinates.is_empty() {
            let cell = changed.cell(0);
            let (template, moved_trace) =
                move_point(&changed.template, trace, changed.parameter_values(&cell), &coordinates)
                    .map_err(|error| vec![ChangeError::MovedPoint { family: id(), error }])?;
            numbers.moved_trace = trace.filter(|trace| *trace != moved_trace).map(|trace| [moved_trace, trace]);
            changed.template = Arc::new(template);
        }
        if circuit.is_some() {
            Arc::make_mut(&mut changed.template).circuits = CircuitSelection::All;
        }
        Ok(ChangedCell { family: changed, numbers, circuit })
    }
}

impl OriginalNumbers {
    /// The number of a trace of the original cell in the changed one, both from 1.
    pub fn trace(&self, original: usize) -> usize {
        self.moved_trace.filter(|[_, from]| *from == original).map_or(original, |[moved, _]| moved)
    }

    /// The only cell of [`ChangedCell::family`] with its original numbers: the curves of a moved point take the place of
    /// those that it had before.
    pub fn restore(&self, mut solved: SolvedCell) -> SolvedCell {
        solved.cell.number = self.cell;
        if let Some([moved, original]) = self.moved_trace {
            solved.curves.retain(|curve| curve.trace != original);
            solved.curves.iter_mut().filter(|curve| curve.trace == moved).for_each(|curve| curve.trace = original);
            solved.curves.sort_by_key(|curve| [curve.trace, curve.circuit]);
        }
        solved
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;
    use crate::family::ParameterSpace;
    use crate::motion::Sampling;
    use crate::solve::Solver;

    fn family(linkage: &str, values: &[(&str, f64)]) -> Family {
        let values: Vec<_> = values.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
        Family::single_cell(catalogue::find(linkage).unwrap(), &values, Sampling::Samples(24)).unwrap()
    }

    /// A family of two cells.
    fn evans() -> Family {
        let one = family("evans", &[("p", 2.0), ("a", 2.59)]);
        let [p, a] = ["p", "a"].map(|name| one.names.iter().position(|known| known == name).unwrap());
        let cases = [2.0, 3.0].map(|value| vec![(p, value), (a, 2.59)]);
        Family { space: ParameterSpace::Cases(cases.to_vec()), ..one }
    }

    fn overrides(values: &[(&str, f64)]) -> Vec<(String, f64)> {
        values.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect()
    }

    fn solved(changed: &ChangedCell) -> SolvedCell {
        let family = &changed.family;
        changed.numbers.restore(Solver::new(family).solve(0).unwrap())
    }

    #[test]
    fn a_changed_cell_keeps_its_other_values_and_its_number() {
        let changed = ChangedCell::new(&evans(), 2, None, &overrides(&[("a", 2.5)])).unwrap();
        let solved = solved(&changed);
        assert_eq!(changed.family.cell_count(), 1);
        assert_eq!(solved.cell.number, 2);
        assert_eq!(["p", "a"].map(|name| changed.family.value(name, &solved.cell)), [3.0, 2.5]);
    }

    #[test]
    fn a_moved_point_of_a_grid_takes_the_place_of_the_original_one() {
        let grid = family("hrones-nelson", &[]);
        let before = Solver::new(&grid).solve(0).unwrap();
        let changed = ChangedCell::new(&grid, 1, Some(3), &overrides(&[("M.along", 0.0), ("M.across", 0.0)])).unwrap();
        let after = solved(&changed);
        let numbers = |solved: &SolvedCell| -> Vec<_> {
            solved.curves.iter().map(|curve| [curve.trace, curve.circuit]).collect()
        };
        assert_eq!(numbers(&after), numbers(&before));
        let path = |solved: &SolvedCell, k: usize| -> Vec<_> {
            let curve = &solved.curves[k];
            solved.circuit(curve).points(curve.joint).collect()
        };
        assert_eq!(path(&after, 1), path(&before, 1));
        // The point is at the crank pin, which the first circuit of a crank-rocker takes around a circle.
        assert!(path(&after, 2).iter().all(|point| (point.coords.norm() - 1.0).abs() < 1e-12));
    }

    #[test]
    fn every_error_has_a_message() {
        let messages = |number, trace, values: &[(&str, f64)]| -> Vec<String> {
            let errors = ChangedCell::new(&evans(), number, trace, &overrides(values)).unwrap_err();
            errors.iter().map(ToString::to_string).collect()
        };
        assert_eq!(messages(3, None, &[]), ["there is no evans:3: its cells are numbered from 1 to 2"]);
        assert_eq!(messages(0, None, &[]), ["there is no evans:0: its cells are numbered from 1 to 2"]);
        let unknown = messages(1, None, &[("q", 1.0), ("z", 1.0), ("p", -1.0)]);
        assert!(unknown.len() == 2 && unknown[0].starts_with("evans: there is no `q`: "), "{unknown:?}");
        assert_eq!(messages(1, None, &[("p", -2.0)]), ["evans:1: `p` is -2, and must be more than 0"]);
        let moved = [("M.along", 1.0)];
        assert_eq!(
            messages(1, None, &moved),
            ["evans: only the point of a single curve can be moved; name it by cell, trace and circuit"]
        );
        assert_eq!(messages(1, Some(7), &moved), ["evans: there is no trace 7"]);
        assert_eq!(
            messages(1, Some(1), &[("M.up", 1.0)]),
            ["evans: there is no `M.up`: it can be `M.along` or `M.across`"]
        );
        assert_eq!(
            messages(1, Some(1), &[("M.along", f64::INFINITY)]),
            ["evans: the coordinates of `M` are not finite"]
        );
    }
}

use std::collections::HashSet;
use std::sync::Arc;

use super::AxisValues;

/// The most cells of a family that sets no `limit`.
pub const MAX_CELLS: usize = 100_000;

/// One axis of a grid: a name and its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The name's index in [`super::Family::names`].
    pub slot: usize,
    /// Its values, at least one.
    pub values: AxisValues,
}

/// The values of one case: the indices of names, each with its value.
pub type Case = Vec<(usize, f64)>;

/// The parameter sets of a family.
#[derive(Clone, Debug, PartialEq)]
pub enum ParameterSpace {
    /// Every combination, in the order written; the last axis changes fastest.
    Grid(Vec<Axis>),
    /// A list of cases.
    Cases(Vec<Case>),
    /// Many cases that give values to the same names: a row of a table for each.
    Table {
        /// The indices of the names, one for each column, each once.
        slots: Vec<usize>,
        /// The values, row by row: shared by all copies of the family.
        values: Arc<Vec<f64>>,
    },
}

impl ParameterSpace {
    /// The number of parameter sets; saturates at [`usize::MAX`].
    pub fn count(&self) -> usize {
        match self {
            ParameterSpace::Grid(axes) => axes.iter().fold(1, |n: usize, axis| n.saturating_mul(axis.values.len())),
            ParameterSpace::Cases(cases) => cases.len(),
            ParameterSpace::Table { slots, values } => values.len() / slots.len().max(1),
        }
    }

    /// Whether the `k`-th set, from 0, gives a value to the name at an index.
    pub fn assigns(&self, k: usize, slot: usize) -> bool {
        self.slots_of(k).any(|given| given == slot)
    }

    /// The indices of the names that the `k`-th set, from 0, gives values to.
    pub fn slots_of(&self, k: usize) -> impl Iterator<Item = usize> + '_ {
        let (axes, case, columns) = match self {
            ParameterSpace::Grid(axes) => (&axes[..], &[][..], &[][..]),
            ParameterSpace::Cases(cases) => (&[][..], &cases[k][..], &[][..]),
            ParameterSpace::Table { slots, .. } => (&[][..], &[][..], &slots[..]),
        };
        axes.iter().map(|axis| axis.slot).chain(case.iter().map(|(slot, _)| *slot)).chain(columns.iter().copied())
    }

    /// The indices of the names that any set gives a value to, in order.
    pub fn assigned_slots(&self) -> Vec<usize> {
        let mut slots: Vec<usize> = match self {
            ParameterSpace::Grid(axes) => axes.iter().map(|axis| axis.slot).collect(),
            ParameterSpace::Cases(cases) => cases.iter().flatten().map(|(slot, _)| *slot).collect(),
            ParameterSpace::Table { slots, .. } => slots.clone(),
        };
        slots.sort_unstable();
        slots.dedup();
        slots
    }

    /// The distinct lists of names that sets give values to, by their indices and in order, each with the index of the
    /// first set that has it. A grid and a table have one.
    pub fn distinct_names(&self) -> Vec<(usize, Vec<usize>)> {
        let count = match self {
            ParameterSpace::Grid(_) | ParameterSpace::Table { .. } => self.count().min(1),
            ParameterSpace::Cases(cases) => cases.len(),
        };
        let mut found: Vec<(usize, Vec<usize>)> = Vec::new();
        let mut known: HashSet<Vec<usize>> = HashSet::new();
        for k in 0..count {
            let mut slots: Vec<usize> = self.slots_of(k).collect();
            slots.sort_unstable();
            if known.insert(slots.clone()) {
                found.push((k, slots));
            }
        }
        found
    }

    /// The number of sets that give a value to each of the first `names` names.
    pub fn assignment_counts(&self, names: usize) -> Vec<usize> {
        let mut counts = vec![0; names];
        match self {
            ParameterSpace::Grid(axes) => axes.iter().for_each(|axis| counts[axis.slot] = self.count()),
            ParameterSpace::Cases(cases) => cases.iter().flatten().for_each(|(slot, _)| counts[*slot] += 1),
            ParameterSpace::Table { slots, .. } => slots.iter().for_each(|slot| counts[*slot] = self.count()),
        }
        counts
    }

    /// Writes the values of the `k`-th set, from 0, to their indices.
    pub(super) fn fill(&self, k: usize, values: &mut [f64]) {
        match self {
            ParameterSpace::Grid(axes) => {
                let mut rest = k;
                for axis in axes.iter().rev() {
                    values[axis.slot] = axis.values.get(rest % axis.values.len()).unwrap_or(f64::NAN);
                    rest /= axis.values.len();
                }
            }
            ParameterSpace::Cases(cases) => {
                for &(slot, value) in &cases[k] {
                    values[slot] = value;
                }
            }
            ParameterSpace::Table { slots, values: rows } => {
                let row = &rows[k * slots.len()..];
                slots.iter().zip(row).for_each(|(slot, value)| values[*slot] = *value);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_axis_changes_fastest() {
        let axis = |slot, values: &[f64]| Axis { slot, values: values.to_vec().into() };
        let grid = ParameterSpace::Grid(vec![axis(1, &[1.0, 2.0]), axis(0, &[3.0, 4.0, 5.0])]);
        assert_eq!(grid.count(), 6);
        let mut values = [0.0; 2];
        grid.fill(4, &mut values);
        assert_eq!(values, [4.0, 2.0]);
    }

    #[test]
    fn a_table_has_the_values_of_its_rows() {
        let table = ParameterSpace::Table { slots: vec![2, 0], values: Arc::new(vec![1.0, 2.0, 3.0, 4.0]) };
        assert_eq!((table.count(), table.assigned_slots()), (2, vec![0, 2]));
        assert_eq!((table.assignment_counts(3), table.distinct_names()), (vec![2, 0, 2], vec![(0, vec![0, 2])]));
        let mut values = [0.0; 3];
        table.fill(1, &mut values);
        assert_eq!(values, [4.0, 0.0, 3.0]);
    }
}

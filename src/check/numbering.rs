//! Matches recorded cells with current ones.

use std::collections::{HashMap, HashSet};

use super::Error;
use super::finding::{Change, Finding, Location};
use super::tables::Tables;
use crate::pipeline::FamilyPipeline;

/// The recorded numbers of the current cells.
pub(super) struct CellNumbering {
    /// The recorded numbers of the cells that are recorded under another number.
    renumbered: HashMap<usize, usize>,
    /// The numbers of the recorded cells; `None` if no table can be read.
    recorded: Option<HashSet<usize>>,
    /// The current cells that are not recorded, some under a number that another cell has in the record.
    added: HashSet<usize>,
}

/// The number under which a cell is recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RecordedNumber {
    /// Its recorded number.
    Known(usize),
    /// The cell is not recorded.
    Missing,
    /// No table can be read.
    Unknown,
}

impl CellNumbering {
    /// Matches cells by their parameters, and appends a finding for each recorded cell that no longer exists.
    ///
    /// A cell recorded under its number with other parameters counts as the same cell, unless those parameters are now
    /// those of another cell.
    ///
    /// # Errors
    /// The system fails to read a table.
    pub fn from_tables(
        pipeline: &FamilyPipeline,
        tables: &Tables,
        findings: &mut Vec<Finding>,
    ) -> Result<CellNumbering, Error> {
        let mut numbering = CellNumbering { renumbered: HashMap::new(), recorded: None, added: HashSet::new() };
        let Some(numbers) = tables.cell_numbers() else { return Ok(numbering) };
        let family = &pipeline.composer.planned.family;
        let recorded_values = |number: usize| -> Result<Option<Vec<u64>>, Error> {
            let (columns, rows) = match tables.cell_rows(number) {
                Ok(Some(found)) => found,
                Ok(None) => return Ok(None),
                Err(error) => return Error::or_damage(error).map(|_| None),
            };
            let values = rows.first().and_then(|row| columns.recorded_parameters(row).ok());
            Ok(values.map(|values| values.into_iter().map(f64::to_bits).collect()))
        };
        let names = tables.cell_columns().map(|columns| &columns.parameters);
        let slots: Vec<usize> = family
            .template
            .parameters
            .iter()
            .enumerate()
            .filter_map(|(slot, parameter)| {
                names.is_some_and(|names| names.iter().any(|(name, _)| *name == parameter.name)).then_some(slot)
            })
            .collect();
        let current_values = |number: usize| -> Vec<u64> {
            let cell = family.cell(number - 1);
            // Adding 0 turns -0 into 0, as in the tables.
            slots.iter().map(|&slot| (cell.values[slot] + 0.0).to_bits()).collect()
        };
        let recorded: HashSet<usize> = numbers.iter().copied().collect();
        let current: Vec<usize> = pipeline.arrangement.kept.iter().map(|cell| cell + 1).collect();
        // The cells recorded under their number with other values.
        let mut differing: HashSet<usize> = HashSet::new();
        for &number in current.iter().filter(|number| recorded.contains(number)) {
            if recorded_values(number)?.is_some_and(|values| values != current_values(number)) {
                differing.insert(number);
            }
        }
        let kept: HashSet<usize> = current.iter().copied().collect();
        // The recorded cells that may have another number now, by their values. Several may have the same values: they
        // are assigned in order of their numbers.
        let mut unmatched: HashMap<Vec<u64>, Vec<usize>> = HashMap::new();
        for &number in numbers.iter().rev().filter(|number| !kept.contains(number) || differing.contains(number)) {
            if let Some(values) = recorded_values(number)? {
                unmatched.entry(values).or_default().push(number);
            }
        }
        let mut matched: HashSet<usize> = HashSet::new();
        let mut remaining = Vec::new();
        for &number in current.iter().filter(|number| !recorded.contains(number) || differing.contains(number)) {
            match unmatched.get_mut(&current_values(number)).filter(|_| !slots.is_empty()).and_then(Vec::pop) {
                Some(recorded_number) => {
                    numbering.renumbered.insert(number, recorded_number);
                    matched.insert(recorded_number);
                }
                None => remaining.push(number),
            }
        }
        for number in remaining {
            if recorded.contains(&number) && matched.insert(number) {
                continue;
            }
            numbering.added.insert(number);
        }
        let location = Location::in_family(&family.id);
        let is_removed =
            |number: &&usize| !matched.contains(number) && (!kept.contains(number) || differing.contains(number));
        let removed = numbers.iter().filter(is_removed);
        findings.extend(removed.map(|&number| location.with_cell(number).finding(Change::CellRemoved)));
        numbering.recorded = Some(recorded);
        Ok(numbering)
    }

    /// The number under which the cell with the current `number` is recorded.
    pub fn recorded_number(&self, number: usize) -> RecordedNumber {
        match (&self.recorded, self.renumbered.get(&number)) {
            (None, _) => RecordedNumber::Unknown,
            (_, Some(&recorded_number)) => RecordedNumber::Known(recorded_number),
            (Some(_), None) if self.added.contains(&number) => RecordedNumber::Missing,
            (Some(recorded), None) if recorded.contains(&number) => RecordedNumber::Known(number),
            _ => RecordedNumber::Missing,
        }
    }
}

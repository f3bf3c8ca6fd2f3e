//! Which recorded cell is which of those there are now.

use std::collections::{HashMap, HashSet};

use super::finding::{Change, Finding, Location};
use super::tables::Tables;
use crate::pipeline::FamilyPipeline;

/// The recorded numbers of cells.
pub(super) struct CellNumbering {
    /// Those that are recorded under another number.
    renumbered: HashMap<usize, usize>,
    /// The recorded cells; `None` where nothing is known of them.
    recorded: Option<HashSet<usize>>,
    /// Cells under whose number another cell is recorded.
    added: HashSet<usize>,
}

/// Where a cell is recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RecordedNumber {
    /// Under this number.
    Known(usize),
    /// Not at all.
    Missing,
    /// Nobody knows: no table can be read.
    Unknown,
}

impl CellNumbering {
    /// By parameters; a cell that is recorded under its own number with others has other parameters now, unless those it
    /// had are another cell's. Tells of cells that are no more.
    pub fn from_tables(press: &FamilyPipeline, tables: &Tables, findings: &mut Vec<Finding>) -> CellNumbering {
        let mut numbering = CellNumbering { renumbered: HashMap::new(), recorded: None, added: HashSet::new() };
        let Some(numbers) = tables.cell_numbers() else { return numbering };
        let family = &press.composer.planned.family;
        let values = |number: usize| -> Option<Vec<u64>> {
            let (columns, rows) = tables.cell_rows(number).ok()??;
            let values = columns.recorded_parameters(rows.first()?).ok()?;
            Some(values.into_iter().map(f64::to_bits).collect())
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
        let now = |number: usize| -> Vec<u64> {
            let cell = family.cell(number - 1);
            // As they are written: zero has no sign there.
            slots.iter().map(|&slot| (cell.values[slot] + 0.0).to_bits()).collect()
        };
        let recorded: HashSet<usize> = numbers.iter().copied().collect();
        let present: Vec<usize> = press.arrangement.kept.iter().map(|cell| cell + 1).collect();
        // Those whose values are not what they were.
        let differing: Vec<usize> = present
            .iter()
            .copied()
            .filter(|number| recorded.contains(number) && values(*number).is_some_and(|was| was != now(*number)))
            .collect();
        let differs: HashSet<usize> = differing.iter().copied().collect();
        let kept: HashSet<usize> = present.iter().copied().collect();
        // Recorded cells that are to be found under another number: as the values of one may be those of several, the first.
        let mut free: HashMap<Vec<u64>, Vec<usize>> = HashMap::new();
        for &number in numbers.iter().rev().filter(|number| !kept.contains(number) || differs.contains(number)) {
            if let Some(values) = values(number) {
                free.entry(values).or_default().push(number);
            }
        }
        let mut taken: HashSet<usize> = HashSet::new();
        let mut open = Vec::new();
        for &number in present.iter().filter(|number| !recorded.contains(number) || differs.contains(number)) {
            match free.get_mut(&now(number)).filter(|_| !slots.is_empty()).and_then(Vec::pop) {
                Some(was) => {
                    numbering.renumbered.insert(number, was);
                    taken.insert(was);
                }
                None => open.push(number),
            }
        }
        for number in open {
            if recorded.contains(&number) && taken.insert(number) {
                continue;
            }
            numbering.added.insert(number);
        }
        let place = Location::in_family(&family.id);
        let is_gone = |number: &&usize| !taken.contains(number) && (!kept.contains(number) || differs.contains(number));
        findings
            .extend(numbers.iter().filter(is_gone).map(|&number| place.with_cell(number).finding(Change::CellRemoved)));
        numbering.recorded = Some(recorded);
        numbering
    }

    /// Where a cell is recorded.
    pub fn recorded_number(&self, number: usize) -> RecordedNumber {
        match (&self.recorded, self.renumbered.get(&number)) {
            (None, _) => RecordedNumber::Unknown,
            (_, Some(&other)) => RecordedNumber::Known(other),
            (Some(_), None) if self.added.contains(&number) => RecordedNumber::Missing,
            (Some(recorded), None) if recorded.contains(&number) => RecordedNumber::Known(number),
            _ => RecordedNumber::Missing,
        }
    }
}

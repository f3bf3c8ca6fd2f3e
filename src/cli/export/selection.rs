//! The selected curves of a family, cell by cell.

use std::collections::{BTreeMap, BTreeSet};

use crate::sweep::{self, CellGroups, CellIndices};
use coupler_curves::exchange::{CurveName, SelectedCurve};
use coupler_curves::family::{Family, NoSuchCell};
use coupler_curves::solve::{ChangedCell, OriginalNumbers, SolvedCell};

/// The selected curves of a family.
pub(super) struct CurveSelection {
    pub family: Family,
    /// The line under the title of its plates.
    pub source: String,
    /// Parameters that replace those of a cell; if names are any, that cell is the only one.
    pub overrides: Vec<(String, f64)>,
    /// The numbers to show for the only cell and its curves, if its parameters are replaced.
    original_numbers: Option<OriginalNumbers>,
    /// The selected curves by the index of their cell.
    cells: BTreeMap<usize, CellSelection>,
}

/// The selected curves of a cell.
enum CellSelection {
    /// All its curves; names may be none.
    Any,
    /// All its curves; it is an error if names are none.
    AtLeastOne,
    /// These curves, by trace and circuit.
    Only(BTreeSet<[usize; 2]>),
}

impl CurveSelection {
    /// Selects every curve of a family.
    pub fn all(family: Family, source: String) -> CurveSelection {
        let cells = (0..family.cell_count()).map(|cell| (cell, CellSelection::Any)).collect();
        CurveSelection { family, source, overrides: Vec::new(), original_numbers: None, cells }
    }

    /// Selects no curve of a family.
    pub fn empty(family: Family, source: String) -> CurveSelection {
        CurveSelection { cells: BTreeMap::new(), ..CurveSelection::all(family, source) }
    }

    /// Adds the curves that a name without overrides names in this family.
    ///
    /// # Errors
    /// The family has no such cell.
    pub fn add(&mut self, name: &CurveName) -> Result<(), NoSuchCell> {
        let Some(cell) = name.cell else {
            for cell in 0..self.family.cell_count() {
                self.cells.entry(cell).or_insert(CellSelection::Any);
            }
            return Ok(());
        };
        let cell = self.family.cell_index(cell)?;
        match (name.curve, self.cells.get_mut(&cell)) {
            (Some(curve), None) => drop(self.cells.insert(cell, CellSelection::Only([curve].into()))),
            (Some(curve), Some(CellSelection::Only(curves))) => drop(curves.insert(curve)),
            // Every curve of the cell is selected already.
            (Some(_), Some(_)) => {}
            (None, _) => drop(self.cells.insert(cell, CellSelection::AtLeastOne)),
        }
        Ok(())
    }

    /// Selects the curves that a name with overrides names.
    ///
    /// # Errors
    /// Every error in the name, one message each.
    pub fn with_overrides(family: &Family, source: &str, name: &CurveName) -> Result<CurveSelection, Vec<String>> {
        let trace = name.curve.map(|[trace, _]| trace);
        let overrides = name
            .resolve_overrides(&family.template)
            .map_err(|errors| errors.iter().map(|error| format!("{}: {error}", family.id)).collect::<Vec<_>>())?;
        let changed = ChangedCell::new(family, name.cell.unwrap_or(1), trace, &overrides)
            .map_err(|errors| errors.iter().map(ToString::to_string).collect::<Vec<_>>())?;
        let ChangedCell { family, numbers, circuit } = changed;
        let curve = name.curve.map(|[trace, named]| [trace, circuit.unwrap_or(named)]);
        let cells = [(0, curve.map_or(CellSelection::AtLeastOne, |curve| CellSelection::Only([curve].into())))];
        let source = source.to_owned();
        Ok(CurveSelection { family, source, overrides, original_numbers: Some(numbers), cells: cells.into() })
    }

    /// Solves the selected cells; calls `work` with each on all threads, and `receive` with the results in order.
    ///
    /// With `with_measures`, every measure is computed, otherwise only those that `where` and `sort` use.
    ///
    /// # Errors
    /// The first error of `receive`.
    pub fn solve_cells<T: Send, E>(
        &self,
        with_measures: bool,
        work: impl Fn(SolvedCell) -> T + Sync,
        receive: impl FnMut(T) -> Result<(), E>,
    ) -> Result<(), E> {
        // The numbers of cells have at most 32 bits.
        let cells = CellIndices::Listed(self.cells.keys().map(|&cell| cell as u32).collect());
        let groups = CellGroups {
            cells: &cells,
            first_group: 0,
            size: 1,
            work_bytes: 0,
            requested_measures: (!with_measures).then(|| self.family.selection_measures()),
            solve_known: None,
        };
        let works =
            |_, solved: Vec<SolvedCell>| solved.into_iter().map(|solved| work(self.restore_numbers(solved))).next();
        let mut receive = receive;
        sweep::process_groups(&self.family, groups, works, |result| result.map_or(Ok(()), &mut receive))
    }

    fn restore_numbers(&self, solved: SolvedCell) -> SolvedCell {
        match &self.original_numbers {
            Some(numbers) => numbers.restore(solved),
            None => solved,
        }
    }

    /// The index of a cell in the family.
    fn cell_index(&self, solved: &SolvedCell) -> usize {
        if self.original_numbers.is_some() { 0 } else { solved.cell.number - 1 }
    }

    fn cell_selection(&self, solved: &SolvedCell) -> Option<&CellSelection> {
        self.cells.get(&self.cell_index(solved))
    }

    /// Removes the curves of a cell that are not selected.
    pub fn retain_selected(&self, mut solved: SolvedCell) -> SolvedCell {
        if let Some(CellSelection::Only(curves)) = self.cell_selection(&solved) {
            solved.curves.retain(|curve| curves.contains(&[curve.trace, curve.circuit]));
        }
        solved
    }

    /// The selected curves of a solved cell, each by itself.
    pub fn selected_curves(&self, solved: SolvedCell) -> Vec<SelectedCurve<'_>> {
        SelectedCurve::all_from_cell(&self.family, &self.source, &self.overrides, &self.retain_selected(solved))
    }

    /// A message for each selected curve that the solved cell does not have.
    pub fn missing_curves(&self, solved: &SolvedCell) -> Vec<String> {
        let name = format!("{}:{}", self.family.id, solved.cell.number);
        let reason = || match &solved.motion.assembly_error {
            _ if solved.left_out_count > 0 => {
                let index = self.cell_index(solved);
                format!("`where` leaves it out: {}", sweep::diagnose(&self.family, index..index + 1).describe(1))
            }
            Some(reason) if !solved.motion.is_assembled() => format!("it is not assembled: {reason}"),
            _ => "it has no curve".to_owned(),
        };
        match self.cell_selection(solved) {
            Some(CellSelection::AtLeastOne) if solved.curves.is_empty() => vec![format!("{name}: {}", reason())],
            Some(CellSelection::Only(curves)) => {
                let is_missing = |[trace, circuit]: &&[usize; 2]| {
                    !solved.curves.iter().any(|curve| [curve.trace, curve.circuit] == [*trace, *circuit])
                };
                let names: Vec<String> =
                    solved.curves.iter().map(|curve| format!("{name}.{}.{}", curve.trace, curve.circuit)).collect();
                let explanation = match &names[..] {
                    [] => reason(),
                    [only] => format!("the cell's only curve is {only}"),
                    [first, .., last] => format!("its cell has {} curves, {first} to {last}", names.len()),
                };
                let missing = curves.iter().filter(is_missing);
                missing.map(|[trace, circuit]| format!("there is no {name}.{trace}.{circuit}: {explanation}")).collect()
            }
            _ => Vec::new(),
        }
    }
}

//! The selected curves of a family, cell by cell.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use coupler_atlas::sweep::{self, CellGroups, CellIndices};
use coupler_curves::family::{Family, ParameterSpace};
use coupler_curves::measure;
use coupler_curves::problem::suggestion;
use coupler_curves::solve::SolvedCell;

use super::moved_point::move_point;
use super::selector::CurveSelector;

/// The selected curves of a family.
pub(super) struct CurveSelection {
    pub family: Family,
    /// The line under the title of its plates.
    pub source: String,
    /// Parameters that replace those of a cell; if names are any, that cell is the only one.
    pub overrides: Vec<(String, f64)>,
    /// The number to show for the only cell, if its parameters are replaced.
    cell_number: Option<usize>,
    /// The number of a moved trace in the family, and the number to show for it.
    trace_alias: Option<[usize; 2]>,
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
        CurveSelection { family, source, overrides: Vec::new(), cell_number: None, trace_alias: None, cells }
    }

    /// Selects no curve of a family.
    pub fn empty(family: Family, source: String) -> CurveSelection {
        CurveSelection { cells: BTreeMap::new(), ..CurveSelection::all(family, source) }
    }

    /// Adds the curves that a selector without overrides names in this family.
    ///
    /// # Errors
    /// The family has no such cell.
    pub fn add(&mut self, selector: &CurveSelector) -> Result<(), String> {
        let Some(cell) = selector.cell else {
            for cell in 0..self.family.cell_count() {
                self.cells.entry(cell).or_insert(CellSelection::Any);
            }
            return Ok(());
        };
        let cell = cell_index(&self.family, cell)?;
        match (selector.curve, self.cells.get_mut(&cell)) {
            (Some(curve), None) => drop(self.cells.insert(cell, CellSelection::Only([curve].into()))),
            (Some(curve), Some(CellSelection::Only(curves))) => drop(curves.insert(curve)),
            // Every curve of the cell is selected already.
            (Some(_), Some(_)) => {}
            (None, _) => drop(self.cells.insert(cell, CellSelection::AtLeastOne)),
        }
        Ok(())
    }

    /// Selects the curves that a selector with overrides names.
    ///
    /// # Errors
    /// Every error in the selector, one message each.
    pub fn with_overrides(
        family: &Family,
        source: &str,
        selector: &CurveSelector,
    ) -> Result<CurveSelection, Vec<String>> {
        let number = selector.cell.unwrap_or(1);
        let k = cell_index(family, number).map_err(|error| vec![error])?;
        let cell = family.cell(k);
        let mut case: Vec<(usize, f64)> = (0..family.names.len())
            .filter(|&slot| family.space.assigns(k, slot))
            .map(|slot| (slot, cell.values[slot]))
            .collect();
        let known: Vec<&str> = family.names.iter().map(String::as_str).collect();
        let mut errors = Vec::new();
        // The name of a coordinate contains a dot; that of a parameter never does.
        let (points, parameters): (Vec<_>, Vec<_>) =
            selector.overrides.iter().partition(|(name, _)| name.contains('.'));
        for (name, value) in parameters {
            match known.iter().position(|known| known == name) {
                Some(slot) => {
                    case.retain(|(assigned, _)| *assigned != slot);
                    case.push((slot, *value));
                }
                None => errors.push(format!("{}: there is no `{name}`: {}", family.id, suggestion(name, &known))),
            }
        }
        // A named curve is exported even if `where` would leave its cell out.
        let family = Family { space: ParameterSpace::Cases(vec![case]), filter: None, sort: None, ..family.clone() };
        if errors.is_empty() {
            let cell_errors = family.cell_errors(&family.cell(0));
            errors.extend(cell_errors.iter().map(|error| format!("{}:{number}: {error}", family.id)));
        }
        if !errors.is_empty() {
            return Err(errors);
        }
        let (family, trace_alias) = with_moved_point(family, selector, &points)
            .map_err(|error| vec![format!("{}: {error}", selector.family)])?;
        let curve = selector.curve.map(|[trace, circuit]| [trace_alias.map_or(trace, |[number, _]| number), circuit]);
        let cells = [(0, curve.map_or(CellSelection::AtLeastOne, |curve| CellSelection::Only([curve].into())))].into();
        let (source, overrides) = (source.to_owned(), selector.overrides.clone());
        Ok(CurveSelection { family, source, overrides, cell_number: Some(number), trace_alias, cells })
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
        let needed: Vec<bool> =
            (0..measure::ALL.len()).map(|measure| self.family.filter_or_sort_uses(measure)).collect();
        let groups = CellGroups {
            cells: &cells,
            first_group: 0,
            size: 1,
            work_bytes: 0,
            requested_measures: (!with_measures).then_some(&needed),
        };
        let works = |_, solved: Vec<SolvedCell>| solved.into_iter().map(|solved| work(self.renumber(solved))).next();
        let mut receive = receive;
        sweep::process_groups(&self.family, groups, works, |result| result.map_or(Ok(()), &mut receive))
    }

    fn renumber(&self, mut solved: SolvedCell) -> SolvedCell {
        if let Some(number) = self.cell_number {
            solved.cell.number = number;
        }
        solved
    }

    fn cell_selection(&self, solved: &SolvedCell) -> Option<&CellSelection> {
        let cell = if self.cell_number.is_some() { 0 } else { solved.cell.number - 1 };
        self.cells.get(&cell)
    }

    /// Removes the curves of a cell that are not selected, and gives a moved trace the number to show for it.
    pub fn retain_selected(&self, mut solved: SolvedCell) -> SolvedCell {
        if let Some(CellSelection::Only(curves)) = self.cell_selection(&solved) {
            solved.curves.retain(|curve| curves.contains(&[curve.trace, curve.circuit]));
        }
        if let Some([number, shown]) = self.trace_alias {
            solved.curves.iter_mut().filter(|curve| curve.trace == number).for_each(|curve| curve.trace = shown);
        }
        solved
    }

    /// A message for each selected curve that the solved cell does not have.
    pub fn missing_curves(&self, solved: &SolvedCell) -> Vec<String> {
        let name = format!("{}:{}", self.family.id, solved.cell.number);
        let reason = || match &solved.motion.assembly_error {
            _ if solved.left_out_count > 0 => "`where` leaves it out".to_owned(),
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

/// Moves the traced point of a family of one cell by overrides of its coordinates; returns the trace alias if the
/// number of the trace changes.
fn with_moved_point(
    family: Family,
    selector: &CurveSelector,
    coordinates: &[&(String, f64)],
) -> Result<(Family, Option<[usize; 2]>), String> {
    if coordinates.is_empty() {
        return Ok((family, None));
    }
    let [trace, _] =
        selector.curve.ok_or("only the point of a single curve can be moved; name it by cell, trace and circuit")?;
    let cell = family.cell(0);
    let (template, moved_trace) = move_point(&family.template, trace, family.parameter_values(&cell), coordinates)?;
    Ok((Family { template: Arc::new(template), ..family }, (moved_trace != trace).then_some([moved_trace, trace])))
}

/// The index of the cell with a number.
///
/// # Errors
/// The family has no such cell.
fn cell_index(family: &Family, number: usize) -> Result<usize, String> {
    let cells = family.cell_count();
    if number <= cells {
        return Ok(number - 1);
    }
    Err(format!("there is no {}:{number}: its cells are numbered from 1 to {cells}", family.id))
}

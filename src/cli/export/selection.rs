//! From what is named on the command line to cells of families, and which curves of them.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use coupler_atlas::sweep::{self, CellGroups};
use coupler_curves::family::{Family, ParameterSpace};
use coupler_curves::measure;
use coupler_curves::problem::suggestion;
use coupler_curves::solve::SolvedCell;

use super::moved_point::move_point;
use super::selector::CurveSelector;

/// Cells of a family, and which curves of them are taken.
pub(super) struct CurveSelection {
    pub family: Family,
    /// What stands under the title of its plates.
    pub source: String,
    /// Parameters in place of the cell's; there is one cell then.
    pub overrides: Vec<(String, f64)>,
    /// The number the one cell is known by, where its parameters are changed.
    cell_number: Option<usize>,
    /// The number a trace has, and the one it is known by, where its point is moved.
    trace_alias: Option<[usize; 2]>,
    /// By the places of cells.
    cells: BTreeMap<usize, CellSelection>,
}

/// Which curves of a cell.
enum CellSelection {
    /// Those there are, if any.
    Any,
    /// Those there are, and one at least.
    AtLeastOne,
    /// These, by trace and circuit.
    Only(BTreeSet<[usize; 2]>),
}

impl CurveSelection {
    /// Every curve there is of a family.
    pub fn all(family: Family, source: String) -> CurveSelection {
        let wanted = (0..family.cell_count()).map(|cell| (cell, CellSelection::Any)).collect();
        CurveSelection { family, source, overrides: Vec::new(), cell_number: None, trace_alias: None, cells: wanted }
    }

    /// No curve of a family, yet.
    pub fn empty(family: Family, source: String) -> CurveSelection {
        CurveSelection { cells: BTreeMap::new(), ..CurveSelection::all(family, source) }
    }

    /// Takes what a name of this family says, unless its parameters are changed.
    ///
    /// # Errors
    /// A cell that is not there.
    pub fn add(&mut self, name: &CurveSelector) -> Result<(), String> {
        let Some(cell) = name.cell else {
            for cell in 0..self.family.cell_count() {
                self.cells.entry(cell).or_insert(CellSelection::Any);
            }
            return Ok(());
        };
        let cell = cell_index(&self.family, cell)?;
        match (name.curve, self.cells.get_mut(&cell)) {
            (Some(curve), None) => drop(self.cells.insert(cell, CellSelection::Only([curve].into()))),
            (Some(curve), Some(CellSelection::Only(curves))) => drop(curves.insert(curve)),
            // All that there are: the one among them.
            (Some(_), Some(_)) => {}
            (None, _) => drop(self.cells.insert(cell, CellSelection::AtLeastOne)),
        }
        Ok(())
    }

    /// What a name says whose parameters are changed.
    ///
    /// # Errors
    /// What is wrong with it, in a sentence each.
    pub fn with_overrides(family: &Family, source: &str, name: &CurveSelector) -> Result<CurveSelection, Vec<String>> {
        let number = name.cell.unwrap_or(1);
        let k = cell_index(family, number).map_err(|wrong| vec![wrong])?;
        let cell = family.cell(k);
        let mut case: Vec<(usize, f64)> = (0..family.names.len())
            .filter(|&slot| family.space.assigns(k, slot))
            .map(|slot| (slot, cell.values[slot]))
            .collect();
        let known: Vec<&str> = family.names.iter().map(String::as_str).collect();
        let mut wrong = Vec::new();
        // A point has a dot in its name, and no parameter has.
        let (points, parameters): (Vec<_>, Vec<_>) = name.overrides.iter().partition(|(name, _)| name.contains('.'));
        for (name, value) in parameters {
            match known.iter().position(|known| known == name) {
                Some(slot) => {
                    case.retain(|(given, _)| *given != slot);
                    case.push((slot, *value));
                }
                None => wrong.push(format!("{}: there is no `{name}`: {}", family.id, suggestion(name, &known))),
            }
        }
        // What is named is wanted, whatever `where` asks of the family.
        let family = Family { space: ParameterSpace::Cases(vec![case]), filter: None, sort: None, ..family.clone() };
        if wrong.is_empty() {
            wrong
                .extend(family.cell_errors(&family.cell(0)).iter().map(|why| format!("{}:{number}: {why}", family.id)));
        }
        if !wrong.is_empty() {
            return Err(wrong);
        }
        let (family, retraced) =
            with_moved_point(family, name, &points).map_err(|why| vec![format!("{}: {why}", name.family)])?;
        let curve = name.curve.map(|[trace, circuit]| [retraced.map_or(trace, |[own, _]| own), circuit]);
        let wanted = [(0, curve.map_or(CellSelection::AtLeastOne, |curve| CellSelection::Only([curve].into())))].into();
        let (source, changed) = (source.to_owned(), name.overrides.clone());
        Ok(CurveSelection {
            family,
            source,
            overrides: changed,
            cell_number: Some(number),
            trace_alias: retraced,
            cells: wanted,
        })
    }

    /// Solves the cells, on all threads, and hands what `work` makes of each, with the curves that are wanted left of it, to
    /// `take` in order; with every measure, or with those alone that tell which curves there are.
    ///
    /// # Errors
    /// The first error of `take`.
    pub fn solve_cells<T: Send, E>(
        &self,
        with_measures: bool,
        work: impl Fn(SolvedCell) -> T + Sync,
        take: impl FnMut(T) -> Result<(), E>,
    ) -> Result<(), E> {
        let cells: Vec<usize> = self.cells.keys().copied().collect();
        let asked: Vec<bool> =
            (0..measure::ALL.len()).map(|measure| self.family.filter_or_sort_uses(measure)).collect();
        let groups = CellGroups {
            cells: &cells,
            size: 1,
            work_bytes: 0,
            requested_measures: (!with_measures).then_some(&asked),
        };
        let works = |_, solved: Vec<SolvedCell>| solved.into_iter().map(|solved| work(self.renumber(solved))).next();
        let mut take = take;
        sweep::process_groups(&self.family, groups, works, |made| made.map_or(Ok(()), &mut take))
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

    /// A cell with the curves that are wanted left of it.
    pub fn retain_selected(&self, mut solved: SolvedCell) -> SolvedCell {
        if let Some(CellSelection::Only(curves)) = self.cell_selection(&solved) {
            solved.curves.retain(|curve| curves.contains(&[curve.trace, curve.circuit]));
        }
        if let Some([own, known]) = self.trace_alias {
            solved.curves.iter_mut().filter(|curve| curve.trace == own).for_each(|curve| curve.trace = known);
        }
        solved
    }

    /// What is wanted of a cell and not there, a sentence each.
    pub fn missing_curves(&self, solved: &SolvedCell) -> Vec<String> {
        let name = format!("{}:{}", self.family.id, solved.cell.number);
        let why = || match &solved.motion.incomplete_reason {
            _ if solved.left_out_count > 0 => "`where` leaves it out".to_owned(),
            Some(reason) if !solved.motion.is_assembled() => format!("it is not assembled: {reason}"),
            _ => "it has no curve".to_owned(),
        };
        match self.cell_selection(solved) {
            Some(CellSelection::AtLeastOne) if solved.curves.is_empty() => vec![format!("{name}: {}", why())],
            Some(CellSelection::Only(curves)) => {
                let is_missing = |[trace, circuit]: &&[usize; 2]| {
                    !solved.curves.iter().any(|curve| [curve.trace, curve.circuit] == [*trace, *circuit])
                };
                let there: Vec<String> =
                    solved.curves.iter().map(|curve| format!("{name}.{}.{}", curve.trace, curve.circuit)).collect();
                let remedy = match &there[..] {
                    [] => why(),
                    [one] => format!("the cell's only curve is {one}"),
                    [first, .., last] => format!("its cell has {} curves, {first} to {last}", there.len()),
                };
                let missing = curves.iter().filter(is_missing);
                missing.map(|[trace, circuit]| format!("there is no {name}.{trace}.{circuit}: {remedy}")).collect()
            }
            _ => Vec::new(),
        }
    }
}

/// A family of one cell whose traced point is where a name has it, and its number among the traces, where that is another,
/// with the one it is known by.
fn with_moved_point(
    family: Family,
    name: &CurveSelector,
    points: &[&(String, f64)],
) -> Result<(Family, Option<[usize; 2]>), String> {
    if points.is_empty() {
        return Ok((family, None));
    }
    let [trace, _] = name.curve.ok_or("a point is moved of one curve; name it by cell, trace and circuit")?;
    let cell = family.cell(0);
    let (template, own) = move_point(&family.template, trace, family.parameter_values(&cell), points)?;
    Ok((Family { template: Arc::new(template), ..family }, (own != trace).then_some([own, trace])))
}

/// The place of a cell of that number.
fn cell_index(family: &Family, number: usize) -> Result<usize, String> {
    let cells = family.cell_count();
    if number <= cells {
        return Ok(number - 1);
    }
    Err(format!("there is no {}:{number}: its cells are numbered from 1 to {cells}", family.id))
}

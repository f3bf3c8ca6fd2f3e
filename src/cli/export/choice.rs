//! From what is named on the command line to cells of families, and which curves of them.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use coupler_atlas::sweep::{self, Groups};
use coupler_curves::family::{Family, Space};
use coupler_curves::measure;
use coupler_curves::problem::nearest_or_all;
use coupler_curves::solve::Solved;

use super::moved::moved;
use super::name::Name;

/// Cells of a family, and which curves of them are taken.
pub(super) struct Choice {
    pub family: Family,
    /// What stands under the title of its plates.
    pub source: String,
    /// Parameters in place of the cell's; there is one cell then.
    pub changed: Vec<(String, f64)>,
    /// The number the one cell is known by, where its parameters are changed.
    number: Option<usize>,
    /// The number a trace has, and the one it is known by, where its point is moved.
    retraced: Option<[usize; 2]>,
    /// By the places of cells.
    wanted: BTreeMap<usize, Wanted>,
}

/// Which curves of a cell.
enum Wanted {
    /// Those there are, if any.
    Any,
    /// Those there are, and one at least.
    Some,
    /// These, by trace and circuit.
    These(BTreeSet<[usize; 2]>),
}

impl Choice {
    /// Every curve there is of a family.
    pub fn all(family: Family, source: String) -> Choice {
        let wanted = (0..family.cells()).map(|cell| (cell, Wanted::Any)).collect();
        Choice { family, source, changed: Vec::new(), number: None, retraced: None, wanted }
    }

    /// No curve of a family, yet.
    pub fn none(family: Family, source: String) -> Choice {
        Choice { wanted: BTreeMap::new(), ..Choice::all(family, source) }
    }

    /// Takes what a name of this family says, unless its parameters are changed.
    ///
    /// # Errors
    /// A cell that is not there.
    pub fn take(&mut self, name: &Name) -> Result<(), String> {
        let Some(cell) = name.cell else {
            for cell in 0..self.family.cells() {
                self.wanted.entry(cell).or_insert(Wanted::Any);
            }
            return Ok(());
        };
        let cell = cell_of(&self.family, cell)?;
        match (name.curve, self.wanted.get_mut(&cell)) {
            (Some(curve), None) => drop(self.wanted.insert(cell, Wanted::These([curve].into()))),
            (Some(curve), Some(Wanted::These(curves))) => drop(curves.insert(curve)),
            // All that there are: the one among them.
            (Some(_), Some(_)) => {}
            (None, _) => drop(self.wanted.insert(cell, Wanted::Some)),
        }
        Ok(())
    }

    /// What a name says whose parameters are changed.
    ///
    /// # Errors
    /// What is wrong with it, in a sentence each.
    pub fn changed(family: &Family, source: &str, name: &Name) -> Result<Choice, Vec<String>> {
        let number = name.cell.unwrap_or(1);
        let k = cell_of(family, number).map_err(|wrong| vec![wrong])?;
        let cell = family.cell(k);
        let mut case: Vec<(usize, f64)> = (0..family.names.len())
            .filter(|&slot| family.space.gives(k, slot))
            .map(|slot| (slot, cell.values[slot]))
            .collect();
        let known: Vec<&str> = family.names.iter().map(String::as_str).collect();
        let mut wrong = Vec::new();
        // A point has a dot in its name, and no parameter has.
        let (points, parameters): (Vec<_>, Vec<_>) = name.changed.iter().partition(|(name, _)| name.contains('.'));
        for (name, value) in parameters {
            match known.iter().position(|known| known == name) {
                Some(slot) => {
                    case.retain(|(given, _)| *given != slot);
                    case.push((slot, *value));
                }
                None => wrong.push(format!("{}: there is no `{name}`: {}", family.id, nearest_or_all(name, &known))),
            }
        }
        // What is named is wanted, whatever `where` asks of the family.
        let family = Family { space: Space::Cases(vec![case]), filter: None, sort: None, ..family.clone() };
        if wrong.is_empty() {
            wrong.extend(family.objections(&family.cell(0)).iter().map(|why| format!("{}:{number}: {why}", family.id)));
        }
        if !wrong.is_empty() {
            return Err(wrong);
        }
        let (family, retraced) =
            with_moved(family, name, &points).map_err(|why| vec![format!("{}: {why}", name.family)])?;
        let curve = name.curve.map(|[trace, circuit]| [retraced.map_or(trace, |[own, _]| own), circuit]);
        let wanted = [(0, curve.map_or(Wanted::Some, |curve| Wanted::These([curve].into())))].into();
        let (source, changed) = (source.to_owned(), name.changed.clone());
        Ok(Choice { family, source, changed, number: Some(number), retraced, wanted })
    }

    /// Solves the cells, on all threads, and hands what `work` makes of each, with the curves that are wanted left of it, to
    /// `take` in order; with every measure, or with those alone that tell which curves there are.
    ///
    /// # Errors
    /// The first error of `take`.
    pub fn solve<T: Send, E>(
        &self,
        with_measures: bool,
        work: impl Fn(Solved) -> T + Sync,
        take: impl FnMut(T) -> Result<(), E>,
    ) -> Result<(), E> {
        let cells: Vec<usize> = self.wanted.keys().copied().collect();
        let asked: Vec<bool> = (0..measure::ALL.len()).map(|measure| self.family.asks_for(measure)).collect();
        let groups = Groups { cells: &cells, size: 1, bytes: 0, wanted: (!with_measures).then_some(&asked) };
        let works = |_, solved: Vec<Solved>| solved.into_iter().map(|solved| work(self.numbered(solved))).next();
        let mut take = take;
        sweep::run(&self.family, groups, works, |made| made.map_or(Ok(()), &mut take))
    }

    fn numbered(&self, mut solved: Solved) -> Solved {
        if let Some(number) = self.number {
            solved.cell.number = number;
        }
        solved
    }

    fn of(&self, solved: &Solved) -> Option<&Wanted> {
        let cell = if self.number.is_some() { 0 } else { solved.cell.number - 1 };
        self.wanted.get(&cell)
    }

    /// A cell with the curves that are wanted left of it.
    pub fn keep(&self, mut solved: Solved) -> Solved {
        if let Some(Wanted::These(curves)) = self.of(&solved) {
            solved.curves.retain(|curve| curves.contains(&[curve.trace, curve.circuit]));
        }
        if let Some([own, known]) = self.retraced {
            solved.curves.iter_mut().filter(|curve| curve.trace == own).for_each(|curve| curve.trace = known);
        }
        solved
    }

    /// What is wanted of a cell and not there, a sentence each.
    pub fn missing(&self, solved: &Solved) -> Vec<String> {
        let name = format!("{}:{}", self.family.id, solved.cell.number);
        let why = || match &solved.motion.shortfall {
            _ if solved.left_out > 0 => "`where` leaves it out".to_owned(),
            Some(reason) if !solved.motion.is_assembled() => format!("it is not assembled: {reason}"),
            _ => "it has no curve".to_owned(),
        };
        match self.of(solved) {
            Some(Wanted::Some) if solved.curves.is_empty() => vec![format!("{name}: {}", why())],
            Some(Wanted::These(curves)) => {
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
fn with_moved(family: Family, name: &Name, points: &[&(String, f64)]) -> Result<(Family, Option<[usize; 2]>), String> {
    if points.is_empty() {
        return Ok((family, None));
    }
    let [trace, _] = name.curve.ok_or("a point is moved of one curve; name it by cell, trace and circuit")?;
    let cell = family.cell(0);
    let (template, own) = moved(&family.template, trace, family.parameters(&cell), points)?;
    Ok((Family { template: Arc::new(template), ..family }, (own != trace).then_some([own, trace])))
}

/// The place of a cell of that number.
fn cell_of(family: &Family, number: usize) -> Result<usize, String> {
    let cells = family.cells();
    if number <= cells {
        return Ok(number - 1);
    }
    Err(format!("there is no {}:{number}: its cells are numbered from 1 to {cells}", family.id))
}

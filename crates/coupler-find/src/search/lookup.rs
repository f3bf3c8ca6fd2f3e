//! The curves of an index that are most like the target, placed on it.

use crate::complex::Complex;
use crate::four_bar::fitting::Fitting;
use crate::four_bar::index::{Entry, Index};
use crate::four_bar::parameters::Parameters;
use crate::query::Query;
use crate::shape::best::Best;
use crate::target::PathKind;

/// The comparison of the curves of an index with a path, in bounded steps.
pub(crate) struct Lookup {
    query: Query,
    /// The number of linkages that are wanted.
    starts: usize,
    /// The number of the first curve that has not been compared.
    next: usize,
    /// The best of those that have been compared, by how much they are like the path.
    best: Best,
    /// The numbers of the best of all that have not been placed, the best first; `None` until all have been compared.
    unplaced: Option<std::vec::IntoIter<usize>>,
    /// The linkages on the target, with how much their curves are like it.
    placed: Vec<(f64, Parameters)>,
}

/// The curves of a step of comparison.
const CURVES_PER_STEP: usize = 4096;

/// Those whose portions are compared in a step.
const PORTIONS_PER_STEP: usize = 1024;

/// The curves that are compared exactly, for each start.
const EXACT_PER_START: usize = 3;

/// The curves that are compared exactly, for each start, until so many are found that meet a condition.
const EXACT_PER_START_WITH_CONDITION: usize = 20;

impl Lookup {
    /// Begins the lookup of a path of the kind of the target, for a number of starts; whether these must meet a condition.
    pub fn new(kind: PathKind, points: &[Complex], starts: usize, has_condition: bool) -> Lookup {
        let most = starts * if has_condition { EXACT_PER_START_WITH_CONDITION } else { EXACT_PER_START };
        let (query, best) = (Query::new(kind, points), Best::new(most));
        Lookup { query, starts, next: 0, best, unplaced: None, placed: Vec::new() }
    }

    /// Compares or places some curves; false if nothing is left to do.
    pub fn step(&mut self, index: &Index, fitting: &Fitting) -> bool {
        if self.next < index.len() {
            self.compare(index, fitting);
            return true;
        }
        // Few points in a zigzag may have spans that no curve has.
        if let Query::Portion(stroke, _) = &mut self.query
            && self.best.is_empty()
            && stroke.ignore_spans()
        {
            self.next = 0;
            return true;
        }
        self.place_next(index, fitting)
    }

    /// The linkages on the target, at most `most`, the most similar first.
    pub fn into_starts(mut self, most: usize) -> Vec<Parameters> {
        self.placed.sort_by(|a, b| b.0.total_cmp(&a.0));
        self.placed.truncate(most);
        self.placed.into_iter().map(|(_, linkage)| linkage).collect()
    }

    fn compare(&mut self, index: &Index, fitting: &Fitting) {
        let full_turn = fitting.limits.full_turn;
        let from = self.next;
        match &self.query {
            Query::Whole(spectrum, ..) => {
                self.next += CURVES_PER_STEP;
                index.nearest((spectrum, fitting.smooth_length, full_turn), from..self.next, &mut self.best);
            }
            Query::Portion(stroke, _) => {
                self.next += PORTIONS_PER_STEP;
                index.nearest_portions((stroke, full_turn), from..self.next, &mut self.best);
            }
        }
    }

    /// Places the next of the best on the target; false if there is none, or enough have been found.
    fn place_next(&mut self, index: &Index, fitting: &Fitting) -> bool {
        let has_condition = fitting.limits.condition.is_some();
        if has_condition && self.placed.len() >= self.starts {
            return false;
        }
        let numbers = || self.best.sorted().into_iter().map(|(_, number)| number).collect::<Vec<_>>().into_iter();
        let Some(number) = self.unplaced.get_or_insert_with(numbers).next() else { return false };
        let entry = index.entry(number);
        let Some((likeness, linkage)) = entry.and_then(|entry| self.placed_on_target(index, &entry)) else {
            return true;
        };
        let starts: Vec<Parameters> = match has_condition {
            true => linkage.cognates().into_iter().chain([linkage]).filter(|start| fitting.may_begin(start)).collect(),
            false => vec![linkage],
        };
        self.placed.extend(starts.into_iter().map(|start| (likeness, start)));
        true
    }

    /// The linkage of a curve of the index where it is most like the target, with how much it is.
    fn placed_on_target(&self, index: &Index, entry: &Entry) -> Option<(f64, Parameters)> {
        match &self.query {
            Query::Whole(target, target_extent) => {
                let (spectrum, extent, _) = index.spectrum(entry);
                let likeness = index.transform().likeness(target, &spectrum);
                let placed = likeness.similarity(target_extent, &extent);
                Some((likeness.value, entry.linkage.transformed(&placed)))
            }
            Query::Portion(stroke, _) => {
                let (residual, placed) = stroke.placement(&entry.linkage.curve(&entry.circuit))?;
                Some((-f64::from(residual), entry.linkage.transformed(&placed)))
            }
        }
    }
}

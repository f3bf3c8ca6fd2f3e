//! What a book needs to know of the cells of a family before its first page is drawn: which chapter each is in, the best curves of
//! each list, the entries of the index. It is gathered while the tables of the family are written, if they are; the curves are
//! kept as measured then, as far as there is memory, so that the pages of the book are drawn without measuring them again.

use std::collections::{HashMap, HashSet};

use crate::manifest::{BookPlan, ListCriteria, PlannedFamily};
use crate::pipeline::Captions;
use coupler_curves::family::{Cell, Family};
use coupler_curves::measure::Value;
use coupler_curves::solve::{MeasuredCurve, SolvedCell};
use coupler_drawing::page::Layout;
use coupler_drawing::page::book::{self, IndexEntry};

/// Surveys the cells of a family; used by all worker threads.
#[derive(Clone, Copy)]
pub(super) struct Surveyor<'a> {
    planned: &'a PlannedFamily,
    book: &'a BookPlan,
    /// The place of the family among those of the plan.
    number: usize,
}

/// What a book needs to know of a cell.
pub(super) struct CellSurvey {
    /// The index of the cell.
    cell: u32,
    /// The chapter that it is in, if it has one.
    chapter: Option<usize>,
    /// The best curves of each list, in order.
    candidates: Vec<Vec<Candidate>>,
    index_entry: Option<IndexEntry>,
    curves: MeasuredCurves,
}

/// The curves of a cell, and the number of those that `where` excludes.
pub(super) type MeasuredCurves = (Vec<MeasuredCurve>, usize);

/// A curve that may be in a list.
#[derive(Clone)]
pub(super) struct Candidate {
    /// The key by which it is sorted, least first.
    key: f64,
    /// The place of its family among those of the plan.
    pub family: usize,
    /// The index of its cell.
    pub cell: u32,
    /// The number of pages of the cell before that of the curve.
    #[cfg_attr(not(feature = "pdf"), expect(dead_code, reason = "only books have pages in this order"))]
    pub page_offset: usize,
    /// What its linkage is recognized by, if it is listed once whatever its points.
    pub linkage: Option<u64>,
    pub curve: MeasuredCurve,
}

impl Candidate {
    /// The order of a list: by keys, and then as in the tables.
    fn order(&self, other: &Candidate) -> std::cmp::Ordering {
        let place =
            |candidate: &Candidate| (candidate.family, candidate.cell, candidate.curve.trace, candidate.curve.circuit);
        self.key.total_cmp(&other.key).then_with(|| place(self).cmp(&place(other)))
    }
}

/// Sorts the candidates of a list, and keeps the first `count`; of a linkage that is listed once only the first.
pub(super) fn keep_first(candidates: &mut Vec<Candidate>, count: usize) {
    candidates.sort_by(Candidate::order);
    let mut seen = HashSet::new();
    candidates.retain(|candidate| candidate.linkage.is_none_or(|linkage| seen.insert((candidate.family, linkage))));
    candidates.truncate(count);
}

impl<'a> Surveyor<'a> {
    /// The surveyor of the family at a place of the plan.
    pub fn new(planned: &'a PlannedFamily, book: &'a BookPlan, number: usize) -> Surveyor<'a> {
        Surveyor { planned, book, number }
    }

    /// Surveys some cells, which have these captions.
    pub fn survey(&self, solved: &[SolvedCell], captions: &Captions) -> Vec<CellSurvey> {
        solved.iter().map(|solved| self.survey_cell(solved, captions)).collect()
    }

    fn survey_cell(&self, solved: &SolvedCell, captions: &Captions) -> CellSurvey {
        let cell = u32::try_from(solved.cell.number.saturating_sub(1)).unwrap_or(u32::MAX);
        let offsets = self.page_offsets(solved);
        let offset = |k: usize| offsets.get(k).copied().unwrap_or(0);
        let index_entry = self.book.index.then(|| {
            let [caption, _] = captions.of_cell(&solved.cell, solved.first_curve_values());
            IndexEntry::from_solved_cell((solved, self.planned.layout), &caption, offset)
        });
        let candidates = |list: &crate::manifest::PlannedList| {
            let Some(Some(criteria)) = list.criteria.get(self.number) else { return Vec::new() };
            let is_of_linkage = criteria.is_of_linkage(&self.planned.family);
            let candidate = |(k, curve): (usize, &MeasuredCurve)| {
                // The path of a slider on its guide is straight by construction.
                let is_trivial = !list.is_given && solved.linkage.slider_line(curve.joint).is_some();
                if is_trivial && !is_of_linkage {
                    return None;
                }
                let key = list_key(&solved.cell, &curve.values, criteria)?;
                let linkage = is_of_linkage.then(|| book::linkage_identity(solved, curve));
                Some(Candidate {
                    key,
                    family: self.number,
                    cell,
                    page_offset: offset(k),
                    linkage,
                    curve: curve.clone(),
                })
            };
            let mut found: Vec<Candidate> = solved.curves.iter().enumerate().filter_map(candidate).collect();
            keep_first(&mut found, list.per_geometry);
            found
        };
        CellSurvey {
            cell,
            chapter: self.chapter(solved),
            candidates: self.book.lists.iter().map(candidates).collect(),
            index_entry,
            curves: (solved.curves.clone(), solved.left_out_count),
        }
    }

    /// The page of each curve, from 0 for the first of the cell.
    fn page_offsets(&self, solved: &SolvedCell) -> Vec<usize> {
        if self.planned.layout != Layout::CouplerGrid {
            return Vec::new();
        }
        let pages = solved.curves_by_traces(Layout::POINTS_PER_PAGE);
        pages.iter().enumerate().flat_map(|(page, curves)| curves.iter().map(move |_| page)).collect()
    }

    /// The first chapter whose condition holds for a curve of a cell.
    fn chapter(&self, solved: &SolvedCell) -> Option<usize> {
        self.book.chapters.iter().position(|chapter| {
            let Some(Some(condition)) = chapter.conditions.get(self.number) else { return false };
            let holds =
                |values: &[Value]| condition.evaluate(|slot| Family::scope_value(&solved.cell, values, slot)) == 1.0;
            match &solved.curves[..] {
                [] => holds(&[]),
                curves => curves.iter().any(|curve| holds(&curve.values)),
            }
        })
    }
}

/// The key by which a curve is sorted in a list; `None` if it is not in it.
fn list_key(cell: &Cell, values: &[Value], criteria: &ListCriteria) -> Option<f64> {
    let load = |slot| Family::scope_value(cell, values, slot);
    let is_listed = criteria.filter.as_ref().is_none_or(|filter| filter.evaluate(load) == 1.0);
    let key = is_listed.then(|| criteria.sort.evaluate(load))?;
    (!key.is_nan()).then_some(key)
}

/// The approximate memory of the measured curves of all families that are kept, in bytes.
const MAX_CURVE_BYTES: usize = 64_000_000;

/// What a book needs to know of the cells of a family.
#[derive(Default)]
pub(super) struct FamilySurvey {
    /// The chapters of the cells that have one, by their indices.
    pub chapters: HashMap<u32, usize>,
    /// The best curves of each list.
    pub candidates: Vec<Vec<Candidate>>,
    /// The entries of the index, with their cells.
    pub index: Vec<(u32, IndexEntry)>,
    /// The measured curves of cells, as far as there is memory.
    pub curves: HashMap<u32, MeasuredCurves>,
    /// The memory of the measured curves, in bytes.
    curve_bytes: usize,
}

impl FamilySurvey {
    /// Adds the survey of some cells, in the order of the cells.
    pub fn add(&mut self, surveyed: Vec<CellSurvey>, book: &BookPlan) {
        self.candidates.resize_with(book.lists.len(), Vec::new);
        for CellSurvey { cell, chapter, candidates, index_entry, curves } in surveyed {
            self.chapters.extend(chapter.map(|chapter| (cell, chapter)));
            for ((own, new), list) in self.candidates.iter_mut().zip(candidates).zip(&book.lists) {
                own.extend(new);
                // Sorting now and then takes less time than a place for each.
                if own.len() > 4 * list.count {
                    keep_first(own, list.count);
                }
            }
            self.index.extend(index_entry.map(|entry| (cell, entry)));
            if self.index.len() > MAX_INDEX_ENTRIES {
                book::keep_listed(&mut self.index);
            }
            let bytes: usize = curves.0.iter().map(curve_bytes).sum();
            if self.curve_bytes + bytes <= MAX_CURVE_BYTES {
                self.curve_bytes += bytes;
                self.curves.insert(cell, curves);
            }
        }
    }
}

/// The number of entries of the index above which those that it will not list are left out.
const MAX_INDEX_ENTRIES: usize = 30_000;

/// The approximate memory of a measured curve, in bytes.
fn curve_bytes(curve: &MeasuredCurve) -> usize {
    let points = curve.straight.as_ref().map_or(0, |portion| portion.points.len());
    size_of::<MeasuredCurve>() + size_of_val(&curve.values[..]) + points * size_of::<[f64; 2]>()
}

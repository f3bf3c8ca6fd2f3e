//! The lists of the best curves of a book.

use std::collections::BTreeSet;

use rayon::prelude::*;

use super::super::survey::{self, Candidate};
use super::super::{Error, Options, check_interrupt};
use super::part::{BookFamily, CellPlaces, FamilyPart, find_cells};
use crate::manifest::{Plan, PlannedList};
use coupler_curves::expression::Caption;
use coupler_curves::solve::Solver;
use coupler_drawing::page::book::{CurveList, ListEntry, Miniature};
use coupler_drawing::page::circuit_words;

/// The lists of a book, without those that have no entry.
pub(super) fn curve_lists(
    plan: &Plan,
    families: &[BookFamily],
    parts: &[FamilyPart],
    options: &Options,
) -> Result<Vec<CurveList>, Error> {
    let best = |number: usize, list: &PlannedList| {
        let candidates = families.iter().filter_map(|family| family.survey.candidates.get(number));
        let mut found: Vec<Candidate> = candidates.flatten().cloned().collect();
        survey::keep_first(&mut found, list.count);
        found
    };
    let found: Vec<Vec<Candidate>> = plan.book.lists.iter().enumerate().map(|(k, list)| best(k, list)).collect();
    let wanted: BTreeSet<(usize, u32)> = found.iter().flatten().map(|entry| (entry.family, entry.cell)).collect();
    let places = find_cells(parts, &wanted);
    let mut lists = Vec::new();
    for (list, found) in plan.book.lists.iter().zip(found) {
        let entry = |candidate: &Candidate| {
            check_interrupt(&options.interrupt)?;
            let family = families.iter().find(|family| family.number == candidate.family);
            Ok(family.and_then(|family| list_entry(list, candidate, family, &places)))
        };
        let entries: Vec<Option<ListEntry>> = found.par_iter().map(entry).collect::<Result<_, Error>>()?;
        let entries: Vec<ListEntry> = entries.into_iter().flatten().collect();
        if !entries.is_empty() {
            let columns = list.columns.clone();
            lists.push(CurveList { title: list.title.clone(), note: note(list, families), columns, entries });
        }
    }
    Ok(lists)
}

/// What is listed, and how many curves of a linkage.
fn note(list: &PlannedList, families: &[BookFamily]) -> String {
    const WORDS: [&str; 8] = ["two", "three", "four", "five", "six", "seven", "eight", "nine"];
    if list.per_geometry >= list.count {
        return [list.note.as_str(), &format!("At most {} in all.", list.count)].join(" ").trim().to_owned();
    }
    let is_of_linkages = families.iter().all(|family| {
        let criteria = list.criteria.get(family.number).and_then(Option::as_ref);
        criteria.is_none_or(|criteria| criteria.is_of_linkage(&family.pipeline.composer.planned.family))
    });
    let most = match list.per_geometry {
        _ if is_of_linkages => "Each linkage once".to_owned(),
        1 => "The best curve of each linkage".to_owned(),
        most => {
            let most = WORDS.get(most - 2).map_or_else(|| most.to_string(), |word| (*word).to_owned());
            format!("The {most} best curves of each linkage")
        }
    };
    [list.note.as_str(), &format!("{most}, at most {} in all.", list.count)].join(" ").trim().to_owned()
}

fn list_entry(
    list: &PlannedList,
    candidate: &Candidate,
    family: &BookFamily,
    places: &CellPlaces,
) -> Option<ListEntry> {
    let planned = family.pipeline.composer.planned;
    let own = &planned.family;
    let &(chapter, first_page) = places.get(&(candidate.family, candidate.cell))?;
    let curve = &candidate.curve;
    let solved = Solver::new(own).solve_measured(candidate.cell as usize, (vec![curve.clone()], 0))?;
    let drawing = Miniature::new(&solved, curve, list.emphasis);
    let [caption, _] = family.pipeline.composer.captions.of_cell(&solved.cell, &curve.values);
    let criteria = list.criteria.get(candidate.family)?.as_ref()?;
    let format = |caption: &Caption| own.format_caption(caption, &solved.cell, &curve.values);
    let is_table = !list.columns.is_empty();
    let mut lines: Vec<String> = match is_table {
        true => criteria.columns.iter().map(|column| column_value(&format(column))).collect(),
        false => format(&criteria.caption).split(" · ").map(str::to_owned).collect(),
    };
    if let Some(input) = drawing.sharpest_input.filter(|_| !is_table) {
        let unit = solved.linkage.input().unit_sign();
        // Where the input turns fully, it is less than a turn, also as it is printed.
        let input = match solved.circuit(curve).is_full_turn() {
            true => ((10.0 * input).round() / 10.0).rem_euclid(360.0),
            false => input,
        };
        lines.insert(lines.len().min(1), format!("at input {input:.1}{unit}"));
    }
    if let Some(lift) = drawing.dwell_lift.filter(|_| !is_table) {
        lines.insert(lines.len().min(2), format!("lift {lift:.3}"));
    }
    let is_of_linkage = candidate.linkage.is_some();
    let which = if is_of_linkage { circuit_words(&solved, curve) } else { planned.layout.curve_words(&solved, curve) };
    Some(ListEntry {
        drawing: (!is_table).then_some(drawing),
        chapter,
        caption,
        curve: which.unwrap_or_default(),
        lines,
        figure: planned.layout.figure_number(&solved.cell),
        page: first_page + if is_of_linkage { 0 } else { candidate.page_offset },
    })
}

/// What is in a column, without its head.
fn column_value(said: &str) -> String {
    said.split_once(": ").map_or(said, |(_, value)| value).to_owned()
}

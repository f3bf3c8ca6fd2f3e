//! The sections of a chapter in the contents: ranges of dimensions with their pages.

use coupler_curves::family::{Family, ParameterSpace};
use coupler_drawing::page::book::CellEntry;

/// The most sections of a chapter.
const MAX_SECTIONS: usize = 50;

/// The most cells of a chapter that are listed one by one, if they are on different pages.
const MAX_CELLS: usize = 12;

/// The most names whose ranges are stated.
const MAX_NAMES: usize = 4;

/// A cell of a chapter.
pub(super) struct ListedCell<'a> {
    pub entry: &'a CellEntry,
    /// The values of the names of its family.
    pub values: Vec<f64>,
    pub last_page: usize,
}

/// The sections of the cells of a chapter, each with its last page: few cells on pages of their own one by one; those of a grid that follow one
/// another in its order by as many of the first parameters as the contents have space for; others as one.
pub(super) fn of_cells(cells: &[ListedCell], family: &Family) -> Vec<(CellEntry, usize)> {
    let page_of_own = |pair: &[ListedCell]| pair[0].entry.page < pair[1].entry.page;
    if cells.len() <= MAX_CELLS && cells.windows(2).all(page_of_own) {
        let named = cells.iter().filter(|cell| !cell.entry.caption.is_empty());
        return named.map(|cell| (cell.entry.clone(), cell.last_page)).collect();
    }
    let differs = |slot: &usize| cells.iter().any(|cell| cell.values.get(*slot) != cells[0].values.get(*slot));
    let varying: Vec<usize> = given_slots(&family.space).into_iter().filter(differs).collect();
    let is_in_order = matches!(family.space, ParameterSpace::Grid(_)) && family.sort.is_none();
    let groups = |depth: usize| -> Vec<&[ListedCell]> {
        let of = |cell: &ListedCell, slot: usize| cell.values.get(slot).copied();
        cells.chunk_by(|a, b| varying[..depth].iter().all(|&slot| of(a, slot) == of(b, slot))).collect()
    };
    let depths = (1..varying.len()).filter(|_| is_in_order);
    let depth = depths.take_while(|depth| groups(*depth).len() <= MAX_SECTIONS).last().unwrap_or(0);
    let section = |cells: &[ListedCell]| {
        let values = |slot: usize| cells.iter().filter_map(move |cell| cell.values.get(slot).copied());
        let range = |&slot: &usize| family.equation_of_range(slot, values(slot)).to_string();
        // Those by which the sections are divided have one value each.
        let caption = varying.iter().take(depth + MAX_NAMES).map(range).collect::<Vec<_>>().join(", ");
        let last = cells.iter().map(|cell| cell.last_page).max()?;
        (!caption.is_empty()).then_some((CellEntry { caption, page: cells.first()?.entry.page }, last))
    };
    groups(depth).into_iter().filter_map(section).collect()
}

/// The names whose values are given, and not computed from others.
fn given_slots(space: &ParameterSpace) -> Vec<usize> {
    match space {
        ParameterSpace::Grid(axes) => axes.iter().map(|axis| axis.slot).collect(),
        ParameterSpace::Cases(cases) => {
            let mut slots: Vec<usize> = cases.iter().flat_map(|case| case.iter().map(|(slot, _)| *slot)).collect();
            slots.sort_unstable();
            slots.dedup();
            slots
        }
        ParameterSpace::Table { slots, .. } => slots.clone(),
    }
}

//! The contents of a volume.

use super::columns::{Entry, Row};
use super::{Atlas, CellEntry, Chapter, Volume};

/// The most cells of a family that contents and outline list.
const MAX_CELLS: usize = 1000;

/// The rows of the contents: every family with its cells.
pub(super) fn rows<'a>(atlas: &'a Atlas, volume: &Volume) -> Vec<Row<'a>> {
    let mut rows = Vec::new();
    for (pages_before, chapter) in atlas.chapters_with_offset() {
        rows.push(Row::Heading {
            text: chapter.title.to_owned(),
            page: (chapter.page_count > 0).then_some(pages_before + 1),
        });
        let (listed, count) = listed_cells(pages_before, chapter, volume);
        rows.push(Row::Note(chapter.format_counts(", ")));
        if listed.len() < count {
            rows.push(Row::Note(format!("{} of {count} are listed", listed.len())));
        }
        rows.extend(listed.iter().map(|cell| {
            Row::Entry(Entry {
                family: None,
                caption: &cell.caption,
                symbols: chapter.symbols,
                value: String::new(),
                curve: None,
                page: pages_before + cell.page,
            })
        }));
    }
    rows
}

/// The cells of a family that are listed in a volume, and the number of all its cells there.
///
/// At most [`MAX_CELLS`] cells are listed: the first cells of pages at equal steps.
pub(super) fn listed_cells<'c>(
    pages_before: usize,
    chapter: &'c Chapter,
    volume: &Volume,
) -> (Vec<&'c CellEntry>, usize) {
    let is_in_volume = |cell: &&CellEntry| volume.page_range().contains(&(pages_before + cell.page));
    let cells: Vec<&CellEntry> = chapter.cells.iter().filter(is_in_volume).collect();
    let count = cells.len();
    if count <= MAX_CELLS {
        return (cells, count);
    }
    let mut first_cells = cells;
    first_cells.dedup_by_key(|cell| cell.page);
    let step = first_cells.len().div_ceil(MAX_CELLS);
    (first_cells.into_iter().step_by(step).collect(), count)
}

use super::columns::{Entry, Row};
use super::{Atlas, CellEntry, Chapter, Volume};

/// The most cells of a family that contents and outline name.
const MAX_CELLS: usize = 1000;

/// What contents say: every family with its cells.
pub(super) fn rows<'a>(atlas: &'a Atlas, volume: &Volume) -> Vec<Row<'a>> {
    let mut rows = Vec::new();
    for (before, chapter) in atlas.chapters_with_offset() {
        rows.push(Row::Heading {
            text: chapter.title.to_owned(),
            page: (chapter.page_count > 0).then_some(before + 1),
        });
        let (named, here) = listed_cells(before, chapter, volume);
        rows.push(Row::Note(chapter.format_counts(", ")));
        if named.len() < here {
            rows.push(Row::Note(format!("{} of {here} are named", named.len())));
        }
        rows.extend(named.iter().map(|cell| {
            Row::Entry(Entry {
                family: None,
                caption: &cell.caption,
                symbols: chapter.symbols,
                value: String::new(),
                curve: None,
                page: before + cell.page,
            })
        }));
    }
    rows
}

/// The cells of a family that are named in a volume, all or the first of every so many pages, and how many there are on
/// its pages.
pub(super) fn listed_cells<'c>(before: usize, chapter: &'c Chapter, volume: &Volume) -> (Vec<&'c CellEntry>, usize) {
    let here = |cell: &&CellEntry| volume.page_range().contains(&(before + cell.page));
    let cells: Vec<&CellEntry> = chapter.cells.iter().filter(here).collect();
    let count = cells.len();
    if count <= MAX_CELLS {
        return (cells, count);
    }
    let mut heads = cells;
    heads.dedup_by_key(|cell| cell.page);
    let step = heads.len().div_ceil(MAX_CELLS);
    (heads.into_iter().step_by(step).collect(), count)
}

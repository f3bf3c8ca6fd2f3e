use super::columns::{Entry, Row};
use super::{Atlas, Cell, Chapter, Volume};

/// The most cells of a family that contents and outline name.
const MOST: usize = 1000;

/// What contents say: every family with its cells.
pub(super) fn rows<'a>(atlas: &'a Atlas, volume: &Volume) -> Vec<Row<'a>> {
    let mut rows = Vec::new();
    for (before, chapter) in atlas.placed() {
        rows.push(Row::Heading { text: chapter.title.to_owned(), page: (chapter.pages > 0).then_some(before + 1) });
        let (named, here) = named(before, chapter, volume);
        rows.push(Row::Note(chapter.counts(", ")));
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
pub(super) fn named<'c>(before: usize, chapter: &'c Chapter, volume: &Volume) -> (Vec<&'c Cell>, usize) {
    let here = |cell: &&Cell| volume.range().contains(&(before + cell.page));
    let cells: Vec<&Cell> = chapter.cells.iter().filter(here).collect();
    let count = cells.len();
    if count <= MOST {
        return (cells, count);
    }
    let mut heads = cells;
    heads.dedup_by_key(|cell| cell.page);
    let step = heads.len().div_ceil(MOST);
    (heads.into_iter().step_by(step).collect(), count)
}

//! The contents of a volume.

use super::atlas::{Atlas, BackMatter, CHARTS_TITLE, CellEntry, Chapter, Volume, charts_in};
use super::columns::{Entry, Places, Row, Target};
use super::folio::are_labelled;
use super::how_to_read;

/// The most cells of a family that contents and outline list.
const MAX_CELLS: usize = 1000;

/// The rows of the contents: what a curve is found by, and every family with its cells.
pub(super) fn rows<'a>(atlas: &'a Atlas, volume: &'a Volume, back_matter: &'a [BackMatter]) -> Vec<Row<'a>> {
    let mut rows = Vec::new();
    if atlas.how_to_read.is_some() {
        rows.push(Row::Heading { text: how_to_read::TITLE.to_owned(), page: Some(Target::HowToRead) });
    }
    let plain = |caption: &'a str, symbols: &'a [String], page: Target| {
        Row::Entry(Entry { family: None, caption, symbols, value: String::new(), curve: None, page })
    };
    let charts: Vec<Row> = (0..)
        .zip(charts_in(atlas, volume))
        .filter(|(_, chart)| !chart.title.is_empty())
        .map(|(k, chart)| plain(&chart.title, &chart.symbols, Target::Chart(k)))
        .collect();
    if charts_in(atlas, volume).next().is_some() {
        rows.push(Row::Heading { text: CHARTS_TITLE.to_owned(), page: Some(Target::Chart(0)) });
        rows.extend(charts);
    }
    if let Some(first) = back_matter.first() {
        rows.push(Row::Heading { text: LISTS_TITLE.to_owned(), page: Some(Target::Page(first.first_page)) });
        rows.extend(back_matter.iter().map(|part| plain(&part.title, &[], Target::Page(part.first_page))));
    }
    for (pages_before, chapter) in atlas.chapters_with_offset() {
        rows.push(Row::Heading {
            text: chapter.title.to_owned(),
            page: (chapter.page_count > 0).then_some(Target::Page(pages_before + 1)),
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
                page: Target::Page(pages_before + cell.page),
            })
        }));
    }
    rows
}

/// The title of the back matter in the contents.
const LISTS_TITLE: &str = "Lists and index";

/// The ways to find a curve, in words, each with its pages.
pub(super) fn ways_to_find(atlas: &Atlas, volume: &Volume, back_matter: &[BackMatter], places: &Places) -> Vec<String> {
    let mut ways = Vec::new();
    let charts = charts_in(atlas, volume).count();
    if charts > 0 {
        let [first, last] = [0, charts - 1].map(|k| places.label(Target::Chart(k)));
        let pages = if first == last { format!("page {first}") } else { format!("pages {first} to {last}") };
        ways.push(format!(
            "By its shape: the finding charts, {pages}, have small drawings of curves over the dimensions of their linkages, each \
             with the number of its page."
        ));
    }
    let lists: Vec<String> = back_matter
        .iter()
        .filter(|part| !part.is_index)
        .map(|part| format!("{}, page {}", part.title, part.first_page))
        .collect();
    if !lists.is_empty() {
        ways.push(format!(
            "By its use: the lists have the best curves of the whole book by one measure, of those that the note under the title of \
             each admits, with a drawing, what is needed to choose, and their pages. {}.",
            lists.join("; ")
        ));
    }
    let by_dimensions = match &atlas.tabs[..] {
        [] => "By dimensions: the contents have every linkage with its page.".to_owned(),
        tabs if !are_labelled(tabs.len() + 2) => {
            "By dimensions: the contents have every linkage with its page, and the marks at the outer edges of the pages lead to its \
             chapter."
                .to_owned()
        }
        [first, ..] => format!(
            "By dimensions: the contents have every linkage with its page, and the marks at the outer edges of the pages, such as \
             {}, lead to it.",
            first.label
        ),
    };
    ways.push(by_dimensions);
    if let Some(index) = back_matter.iter().find(|part| part.is_index) {
        ways.push(format!(
            "By a measure: the index, page {}, has the linkages by straightness, transmission angle and symmetry.",
            index.first_page
        ));
    }
    ways
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

//! The contents of a volume.

use std::ops::Range;

use super::super::Options;
use super::super::theme::Theme;
use super::atlas::{Atlas, BackMatter, CHARTS_TITLE, CellEntry, Chapter, Volume, charts_in};
use super::columns::{self, Entry, ListHeader, Places, Row, Target};
use super::how_to_read;

/// The most cells of a family that the outline lists.
const MAX_CELLS: usize = 1000;

/// The title of the contents.
pub(super) fn header<'a>(atlas: &'a Atlas, volume: &'a Volume) -> ListHeader<'a> {
    ListHeader { title: "Contents", note: "", heads: &[], atlas, volume }
}

/// The number of pages of the contents.
pub(super) fn page_count(
    atlas: &Atlas,
    volume: &Volume,
    back_matter: &[BackMatter],
    options: &Options,
    theme: &Theme,
) -> usize {
    columns::page_count(&rows(atlas, volume, back_matter), &header(atlas, volume), options, theme)
}

/// The rows of the contents: what a curve is found by, and every chapter with its sections.
pub(super) fn rows<'a>(atlas: &'a Atlas, volume: &'a Volume, back_matter: &'a [BackMatter]) -> Vec<Row<'a>> {
    let mut rows = Vec::new();
    if atlas.how_to_read.is_some() {
        rows.push(Row::Heading { text: how_to_read::TITLE.to_owned(), page: Some(Target::HowToRead) });
    }
    let plain = |caption: &'a str, symbols: &'a [String], page: Target| {
        let (values, curve) = (Vec::new(), String::new());
        Row::Entry(Entry { family: None, caption, symbols, values, curve, page, last_page: None })
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
        for part in back_matter {
            rows.push(plain(&part.title, &[], Target::Page(part.first_page)));
            // Of a table in several pages, each has its part.
            let ranges = part.ranges.iter().filter(|_| part.ranges.len() > 1);
            rows.extend((part.first_page..).zip(ranges).map(|(page, range)| plain(range, &[], Target::Page(page))));
        }
    }
    for ((pages_before, chapter), number) in atlas.chapters_with_offset().zip(1..) {
        rows.push(Row::Heading {
            text: chapter.numbered_title(number, atlas),
            page: (chapter.page_count > 0).then_some(Target::Page(pages_before + 1)),
        });
        rows.push(Row::Note(chapter.format_counts(", ")));
        let is_in_volume = |(section, last): &&(CellEntry, usize)| {
            let Range { start, end } = volume.page_range();
            pages_before + section.page < end && pages_before + last >= start
        };
        rows.extend(chapter.sections.iter().filter(is_in_volume).map(|(section, last)| {
            let last_page = (*last > section.page).then_some(pages_before + last);
            Row::Entry(Entry {
                family: None,
                caption: &section.caption,
                symbols: chapter.symbols,
                values: Vec::new(),
                curve: String::new(),
                page: Target::Page(pages_before + section.page),
                last_page,
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
             with its page, and its figure where a page has several."
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
    let marks = match atlas.tabs.first() {
        None => String::new(),
        Some(first) => {
            format!(
                ", and the marks at the outer edges of the pages, such as {}, lead to its chapter",
                first.labels()[0]
            )
        }
    };
    ways.push(format!("By dimensions: the contents have every chapter with the ranges of its dimensions{marks}."));
    if let Some(index) = back_matter.iter().find(|part| part.is_index) {
        ways.push(format!(
            "By a measure: the index, page {}, has the linkages by straightness, transmission angle and symmetry.",
            index.first_page
        ));
    }
    ways
}

/// The cells of a family that the outline lists in a volume.
///
/// At most [`MAX_CELLS`] cells are listed: the first cells of pages at equal steps.
pub(super) fn listed_cells<'c>(pages_before: usize, chapter: &'c Chapter, volume: &Volume) -> Vec<&'c CellEntry> {
    let is_in_volume = |cell: &&CellEntry| volume.page_range().contains(&(pages_before + cell.page));
    let cells: Vec<&CellEntry> = chapter.cells.iter().filter(is_in_volume).collect();
    if cells.len() <= MAX_CELLS {
        return cells;
    }
    let mut first_cells = cells;
    first_cells.dedup_by_key(|cell| cell.page);
    let step = first_cells.len().div_ceil(MAX_CELLS);
    first_cells.into_iter().step_by(step).collect()
}

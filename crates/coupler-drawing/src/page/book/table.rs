//! Lists of curves that are tables: a line for each curve, sorted by its first column.

use super::super::Options;
use super::super::theme::Theme;
use super::atlas::{Atlas, CurveList, Volume};
use super::columns::{self, Entry, ListHeader, Places, Row, Target};
use super::reference::figure_words;
use crate::scene::Scene;

/// The rows of a table.
fn rows<'a>(list: &'a CurveList, atlas: &'a Atlas) -> Vec<Row<'a>> {
    let entry = |entry: &'a super::ListEntry| {
        let chapter = atlas.chapters.get(entry.chapter);
        let figure = figure_words(entry.figure);
        let curve = Some(entry.curve.clone()).filter(|curve| !curve.is_empty());
        Row::Entry(Entry {
            family: chapter.filter(|_| atlas.names_families).map(|chapter| chapter.title),
            caption: &entry.caption,
            symbols: chapter.map_or(&[], |chapter| chapter.symbols),
            values: entry.lines.clone(),
            curve: curve.into_iter().chain(figure).collect::<Vec<_>>().join(", "),
            page: Target::Page(entry.page),
            last_page: None,
        })
    };
    list.entries.iter().map(entry).collect()
}

fn header<'a>(list: &'a CurveList, atlas: &'a Atlas, volume: &'a Volume) -> ListHeader<'a> {
    ListHeader { title: &list.title, note: &list.note, heads: &list.columns, atlas, volume }
}

/// What is on each page: the first column from the first entry to the last.
pub(super) fn page_ranges(list: &CurveList, atlas: &Atlas, options: &Options, theme: &Theme) -> Vec<String> {
    let rows = rows(list, atlas);
    let value = |row: &Row| if let Row::Entry(entry) = row { entry.values.first().cloned() } else { None };
    let range = |ends: [&Row; 2]| {
        let [first, last] = ends.map(|row| value(row).unwrap_or_default());
        let head = list.columns.first().map_or("", String::as_str);
        if first == last { format!("{head} {first}") } else { format!("{head} {first} to {last}") }
    };
    columns::page_ends(&rows, &header(list, atlas, &Volume::NONE), options, theme).into_iter().map(range).collect()
}

/// Composes the pages of a table.
pub(super) fn compose(
    list: &CurveList,
    (atlas, volume): (&Atlas, &Volume),
    places: Places,
    options: &Options,
    theme: &Theme,
) -> Vec<Scene> {
    columns::compose_list(&rows(list, atlas), &header(list, atlas, volume), |_| places, options, theme)
}

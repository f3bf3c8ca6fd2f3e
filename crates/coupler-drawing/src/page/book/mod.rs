//! The parts of a book around the pages of an atlas: title page, contents, index and outline.
//!
//! A long atlas is divided into volumes. Each is a separate book, with links to its own pages only; pages are numbered
//! through all volumes. A volume is composed in three steps, in which at most one page has to be in memory:
//!
//! 1. Once the number of pages of every family is known, [`Atlas::volumes`] divides them, and [`compose_front_matter`]
//!    composes title page and contents.
//! 2. The pages are composed, in parallel and in any order, and [`draw_page_number`] draws their numbers.
//!    [`IndexEntry::from_solved_cell`] collects the index entry of each cell. The scenes are added to the book in
//!    order.
//! 3. [`compose_index`] composes the pages of the index, and [`outline`] gives the entries of the outline.
//!
//! [`Volume::page_index`] is the index of a page in the file of its volume, and [`page_number`] the label of a page.

mod columns;
mod contents;
mod index;
mod index_entry;
mod title;

use std::ops::Range;

pub use index_entry::IndexEntry;

use super::area::{self, Area};
use super::theme::Theme;
use super::{Options, PanelPage};
use crate::scene::{Anchor, OutlineEntry, PageNumber, Scene};
use columns::ListHeader;
use coupler_curves::geometry::Point;

/// An atlas as a book.
#[derive(Clone, Debug)]
pub struct Atlas<'a> {
    /// The title.
    pub title: &'a str,
    /// The program that writes the book, and its version.
    pub program: &'a str,
    /// The families, in order.
    pub chapters: Vec<Chapter<'a>>,
}

/// A chapter of a book: a family of an atlas.
#[derive(Clone, Debug)]
pub struct Chapter<'a> {
    /// The title.
    pub title: &'a str,
    /// The names of parameters, set in italics.
    pub symbols: &'a [String],
    /// The number of curves, if it is known.
    pub curve_count: Option<usize>,
    /// The number of pages.
    pub page_count: usize,
    /// The cells, in the order of the pages.
    pub cells: Vec<CellEntry>,
}

/// A cell of a family in the contents.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CellEntry {
    /// The caption of the cell.
    pub caption: String,
    /// The number of its first page within the family, from 1.
    pub page: usize,
}

/// A volume: the part of an atlas that is one file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Volume {
    /// The number of the volume, from 1.
    pub number: usize,
    /// The number of volumes.
    pub volume_count: usize,
    /// The number of the first page in the atlas, from 1.
    pub first_page: usize,
    /// The number of pages, without front matter and index.
    pub page_count: usize,
}

impl Atlas<'_> {
    /// The number of pages, without front matter and index.
    pub fn page_count(&self) -> usize {
        self.chapters.iter().map(|chapter| chapter.page_count).sum()
    }

    /// The volumes, of at most `most` pages each; all but the last are full. There is at least one.
    pub fn volumes(&self, most: usize) -> Vec<Volume> {
        let (pages, most) = (self.page_count(), most.max(1));
        let volume_count = pages.div_ceil(most).max(1);
        let volume = |k: usize| Volume {
            number: k + 1,
            volume_count,
            first_page: k * most + 1,
            page_count: most.min(pages - k * most),
        };
        (0..volume_count).map(volume).collect()
    }

    /// The chapters, each with the number of pages before it.
    fn chapters_with_offset(&self) -> impl Iterator<Item = (usize, &Chapter<'_>)> {
        self.chapters.iter().scan(0, |before, chapter| {
            *before += chapter.page_count;
            Some((*before - chapter.page_count, chapter))
        })
    }
}

impl Chapter<'_> {
    /// The numbers of geometries, curves and pages in words, as far as they are known.
    fn format_counts(&self, separator: &str) -> String {
        let cells = (!self.cells.is_empty()).then(|| format_count(self.cells.len(), "geometry", "geometries"));
        let curves = self.curve_count.map(|curves| format_count(curves, "curve", "curves"));
        let pages = format_count(self.page_count, "page", "pages");
        cells.into_iter().chain(curves).chain([pages]).collect::<Vec<_>>().join(separator)
    }
}

impl Volume {
    /// The numbers of its pages in the atlas, from 1.
    pub fn page_range(&self) -> Range<usize> {
        self.first_page..self.first_page + self.page_count
    }

    /// The index of a page of the atlas in the volume's file, after `front` pages of front matter; `None` if the page
    /// is in another volume. Pages of the atlas are counted from 1, and the index from 0.
    pub fn page_index(&self, page: usize, front: usize) -> Option<usize> {
        self.page_range().contains(&page).then(|| page - self.first_page + front)
    }

    /// The name of the volume, without the title of the atlas; `None` if it is the only one.
    fn name(&self) -> Option<String> {
        let Range { start, end } = self.page_range();
        (self.volume_count > 1)
            .then(|| format!("volume {} of {}, pages {start}–{}", self.number, self.volume_count, end - 1))
    }
}

/// Composes the title page and the contents of a volume. The title page shows the first panel of the frontispiece.
pub fn compose_front_matter(
    atlas: &Atlas,
    volume: &Volume,
    frontispiece: Option<&PanelPage>,
    options: &Options,
) -> Vec<Scene> {
    let theme = options.theme.for_paper(options.paper);
    let mut first = empty_scene(atlas.title.to_owned(), options, &theme);
    title::compose(&mut first, atlas, volume, frontispiece, (options, &theme));
    let rows = contents::rows(atlas, volume);
    let header = ListHeader { title: "Contents", atlas, volume, first_number: 2 };
    let pages = columns::compose_list(&rows, &header, |pages| 1 + pages, (options, &theme));
    std::iter::once(first).chain(pages).collect()
}

/// Composes the index of a volume, after `front` pages of front matter: the geometries on its pages by straightness, by
/// transmission angle and by symmetry. Without entries there are no pages.
pub fn compose_index(
    atlas: &Atlas,
    volume: &Volume,
    front: usize,
    entries: &[IndexEntry],
    options: &Options,
) -> Vec<Scene> {
    let theme = options.theme.for_paper(options.paper);
    let rows = index::rows(atlas, volume, entries);
    let header = ListHeader { title: "Index of geometries", atlas, volume, first_number: front + 1 };
    columns::compose_list(&rows, &header, |_| front, (options, &theme))
}

/// The outline of a volume: contents, each family with its cells, and the index.
///
/// `front` and `index` are the numbers of pages of front matter and of the index.
pub fn outline(atlas: &Atlas, volume: &Volume, [front, index]: [usize; 2]) -> Vec<OutlineEntry> {
    let entry = |title: &str, page| OutlineEntry { title: title.to_owned(), page_index: page, children: Vec::new() };
    let mut entries = vec![entry(atlas.title, 0)];
    if front > 1 {
        entries.push(entry("Contents", 1));
    }
    for (before, chapter) in atlas.chapters_with_offset() {
        let first = (before + 1).max(volume.first_page);
        let Some(page) = volume.page_index(first, front).filter(|_| first <= before + chapter.page_count) else {
            continue;
        };
        let (cells, _) = contents::listed_cells(before, chapter, volume);
        let child = |cell: &&CellEntry| Some(entry(&cell.caption, volume.page_index(before + cell.page, front)?));
        entries.push(OutlineEntry {
            title: chapter.title.to_owned(),
            page_index: page,
            children: cells.iter().filter_map(child).collect(),
        });
    }
    if index > 0 {
        entries.push(entry("Index of geometries", front + volume.page_count));
    }
    entries
}

/// The label of the page at an index of a volume's file, after `front` pages of front matter: the pages of the atlas
/// have their numbers, front matter and index Roman numerals.
pub fn page_number(volume: &Volume, front: usize, page_index: usize) -> PageNumber {
    let number = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
    match page_index.checked_sub(front) {
        None => PageNumber::Roman(number(page_index + 1)),
        Some(page) if page < volume.page_count => PageNumber::Arabic(number(volume.first_page + page)),
        Some(page) => PageNumber::Roman(number(front + 1 + page - volume.page_count)),
    }
}

/// Draws the number of a page in its book below the border.
pub fn draw_page_number(scene: &mut Scene, label: PageNumber, options: &Options) {
    let theme = options.theme.for_paper(options.paper);
    let text = match label {
        PageNumber::Roman(number) => to_roman(number),
        PageNumber::Arabic(number) => number.to_string(),
    };
    let root = area::whole_page(scene);
    let page = root.size();
    let at = Point::new(page.x / 2.0, page.y - 0.5 * theme.border + 0.35 * theme.source_size);
    root.record(&theme.text_line(&text, at, Anchor::Middle, theme.source_size, theme.grey));
}

fn empty_scene(title: String, options: &Options, theme: &Theme) -> Scene {
    let super::Paper { width, height } = options.paper;
    let (paper, typeface) = (theme.paper, theme.typeface);
    Scene { width, height, paper, typeface, title, items: Vec::new(), links: Vec::new() }
}

/// A number in lower-case Roman numerals; in Arabic ones from 4000.
fn to_roman(number: u32) -> String {
    const NUMERALS: [(u32, &str); 13] = [
        (1000, "m"),
        (900, "cm"),
        (500, "d"),
        (400, "cd"),
        (100, "c"),
        (90, "xc"),
        (50, "l"),
        (40, "xl"),
        (10, "x"),
        (9, "ix"),
        (5, "v"),
        (4, "iv"),
        (1, "i"),
    ];
    if number >= 4000 {
        return number.to_string();
    }
    let (mut rest, mut roman) = (number, String::new());
    for (value, numeral) in NUMERALS {
        while rest >= value {
            roman.push_str(numeral);
            rest -= value;
        }
    }
    roman
}

/// A count with its noun.
fn format_count(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_converted_to_roman_numerals() {
        let pairs = [(1, "i"), (4, "iv"), (9, "ix"), (14, "xiv"), (49, "xlix"), (1951, "mcmli"), (3999, "mmmcmxcix")];
        for (number, roman) in pairs {
            assert_eq!(to_roman(number), roman);
        }
    }
}

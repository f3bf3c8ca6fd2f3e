//! What stands round the pages of an atlas that is bound as a book: title page, contents, index and outline.
//!
//! A book of many pages is parted into volumes, each a book of its own that leads to its own pages only. Pages are
//! numbered through all volumes. A volume is made in this order, and no more than one page of it need be held:
//!
//! 1. As soon as the number of pages of every family is known, [`Atlas::volumes`] parts them, and [`compose_front_matter`] composes title
//!    page and contents.
//! 2. The pages are composed, in parallel and in any order; [`draw_page_number`] writes their numbers on them. Of each cell,
//!    [`IndexEntry::from_solved_cell`] keeps what the index will say. The scenes are handed to the book in order.
//! 3. [`index`] composes the pages of the index, and [`outline`] tells what leads where.
//!
//! The place of a page in a volume's file is that of its front matter and its place among the volume's pages:
//! [`Volume::page_index`]. Its with_label is [`page_number`]'s.

mod columns;
mod contents;
mod index;
mod index_entry;
mod title;

use std::ops::Range;

use plotters::drawing::IntoDrawingArea;

pub use index_entry::IndexEntry;

use super::element::{draw, size};
use super::theme::Theme;
use super::{Options, PanelPage};
use crate::scene::{Anchor, Canvas, OutlineEntry, PageNumber, Scene};
use columns::ListHeader;
use coupler_curves::geometry::Point;

/// An atlas as a book.
#[derive(Clone, Debug)]
pub struct Atlas<'a> {
    /// Its title.
    pub title: &'a str,
    /// The program that makes it, and its version.
    pub program: &'a str,
    /// Its families, in order.
    pub chapters: Vec<Chapter<'a>>,
}

/// A family of an atlas.
#[derive(Clone, Debug)]
pub struct Chapter<'a> {
    /// Its title.
    pub title: &'a str,
    /// Words that stand for values, set in italics.
    pub symbols: &'a [String],
    /// How many curves it has, if that is known.
    pub curve_count: Option<usize>,
    /// How many pages it has.
    pub page_count: usize,
    /// Its cells, in the order of its pages.
    pub cells: Vec<CellEntry>,
}

/// A cell of a family, as contents have it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CellEntry {
    /// The line under it.
    pub caption: String,
    /// Its first page among those of its family, from 1.
    pub page: usize,
}

/// A part of an atlas that is bound on its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Volume {
    /// Its number, from 1.
    pub number: usize,
    /// How many volumes there are.
    pub volume_count: usize,
    /// The number of its first page in the atlas, from 1.
    pub first_page: usize,
    /// How many pages it has, without what stands before and after them.
    pub page_count: usize,
}

impl Atlas<'_> {
    /// How many pages it has, without what stands before and after them.
    pub fn page_count(&self) -> usize {
        self.chapters.iter().map(|chapter| chapter.page_count).sum()
    }

    /// Its volumes, of `most` pages each but for the last; one, where all pages go into one.
    pub fn volumes(&self, most: usize) -> Vec<Volume> {
        let (pages, most) = (self.page_count(), most.max(1));
        let of = pages.div_ceil(most).max(1);
        let volume = |k: usize| Volume {
            number: k + 1,
            volume_count: of,
            first_page: k * most + 1,
            page_count: most.min(pages - k * most),
        };
        (0..of).map(volume).collect()
    }

    /// The chapters, each with how many pages stand before it.
    fn chapters_with_offset(&self) -> impl Iterator<Item = (usize, &Chapter<'_>)> {
        self.chapters.iter().scan(0, |before, chapter| {
            *before += chapter.page_count;
            Some((*before - chapter.page_count, chapter))
        })
    }
}

impl Chapter<'_> {
    /// How many geometries, curves and pages it has, as far as there are any and their number is known.
    fn format_counts(&self, separator: &str) -> String {
        let cells = (!self.cells.is_empty()).then(|| format_count(self.cells.len(), "geometry", "geometries"));
        let curves = self.curve_count.map(|curves| format_count(curves, "curve", "curves"));
        let pages = format_count(self.page_count, "page", "pages");
        cells.into_iter().chain(curves).chain([pages]).collect::<Vec<_>>().join(separator)
    }
}

impl Volume {
    /// The numbers of its pages in the atlas.
    pub fn page_range(&self) -> Range<usize> {
        self.first_page..self.first_page + self.page_count
    }

    /// The place of a page of the atlas in the volume's file, from 0, behind so much front matter; none where it is in
    /// another volume.
    pub fn page_index(&self, page: usize, front: usize) -> Option<usize> {
        self.page_range().contains(&page).then(|| page - self.first_page + front)
    }

    /// What it is called beside the atlas's title; nothing where it is the only one.
    fn name(&self) -> Option<String> {
        let Range { start, end } = self.page_range();
        (self.volume_count > 1)
            .then(|| format!("volume {} of {}, pages {start}–{}", self.number, self.volume_count, end - 1))
    }
}

/// Title page and contents of a volume. The title page shows the first cell of a sheet, if it is given one.
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
    let leaf = ListHeader { title: "Contents", atlas, volume, first_number: 2 };
    let pages = columns::compose_list(&rows, &leaf, |pages| 1 + pages, (options, &theme));
    std::iter::once(first).chain(pages).collect()
}

/// The index of a volume behind so much front matter: the geometries on its pages by straightness, by transmission angle
/// and by symmetry. Nothing, where there is none.
pub fn compose_index(
    atlas: &Atlas,
    volume: &Volume,
    front: usize,
    found: &[IndexEntry],
    options: &Options,
) -> Vec<Scene> {
    let theme = options.theme.for_paper(options.paper);
    let rows = index::rows(atlas, volume, found);
    let leaf = ListHeader { title: "Index of geometries", atlas, volume, first_number: front + 1 };
    columns::compose_list(&rows, &leaf, |_| front, (options, &theme))
}

/// The outline of a volume: contents, each family with its cells, the index; with so many pages before and after.
pub fn outline(atlas: &Atlas, volume: &Volume, [front, index]: [usize; 2]) -> Vec<OutlineEntry> {
    let leaf = |title: &str, page| OutlineEntry { title: title.to_owned(), page_index: page, children: Vec::new() };
    let mut entries = vec![leaf(atlas.title, 0)];
    if front > 1 {
        entries.push(leaf("Contents", 1));
    }
    for (before, chapter) in atlas.chapters_with_offset() {
        let first = (before + 1).max(volume.first_page);
        let Some(page) = volume.page_index(first, front).filter(|_| first <= before + chapter.page_count) else {
            continue;
        };
        let (cells, _) = contents::listed_cells(before, chapter, volume);
        let child = |cell: &&CellEntry| Some(leaf(&cell.caption, volume.page_index(before + cell.page, front)?));
        entries.push(OutlineEntry {
            title: chapter.title.to_owned(),
            page_index: page,
            children: cells.iter().filter_map(child).collect(),
        });
    }
    if index > 0 {
        entries.push(leaf("Index of geometries", front + volume.page_count));
    }
    entries
}

/// What the page at a place of a volume's file is called: the atlas's pages by their numbers, those before and after them
/// in Roman numerals.
pub fn page_number(volume: &Volume, front: usize, place: usize) -> PageNumber {
    let number = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
    match place.checked_sub(front) {
        None => PageNumber::Roman(number(place + 1)),
        Some(page) if page < volume.page_count => PageNumber::Arabic(number(volume.first_page + page)),
        Some(page) => PageNumber::Roman(number(front + 1 + page - volume.page_count)),
    }
}

/// Writes the number a page has in its book under its border.
pub fn draw_page_number(scene: &mut Scene, label: PageNumber, options: &Options) {
    let theme = options.theme.for_paper(options.paper);
    let says = match label {
        PageNumber::Roman(number) => to_roman(number),
        PageNumber::Arabic(number) => number.to_string(),
    };
    let root = Canvas::new(scene).into_drawing_area();
    let page = size(&root);
    let at = Point::new(page.x / 2.0, page.y - 0.5 * theme.border + 0.35 * theme.source_size);
    draw(&root, &theme.text_line(&says, at, Anchor::Middle, theme.source_size, theme.grey));
}

fn empty_scene(title: String, options: &Options, theme: &Theme) -> Scene {
    let super::Paper { width, height } = options.paper;
    let (paper, typeface) = (theme.paper, theme.typeface);
    Scene { width, height, paper, typeface, title, items: Vec::new(), links: Vec::new() }
}

/// A number in small Roman numerals; in Arabic ones from 4000.
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
    let (mut rest, mut said) = (number, String::new());
    for (value, sign) in NUMERALS {
        while rest >= value {
            said.push_str(sign);
            rest -= value;
        }
    }
    said
}

/// A count of things in words.
fn format_count(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roman_numerals() {
        let pairs = [(1, "i"), (4, "iv"), (9, "ix"), (14, "xiv"), (49, "xlix"), (1951, "mcmli"), (3999, "mmmcmxcix")];
        for (number, said) in pairs {
            assert_eq!(to_roman(number), said);
        }
    }
}

//! What is in a book.

use std::ops::Range;

use super::super::Layout;
use super::folio::Tab;
use super::index_entry::IndexEntry;
use super::miniature::Miniature;
use crate::scene::Scene;
use coupler_curves::family::LengthUnit;
use coupler_curves::text::pluralize;

/// An atlas as a book.
#[derive(Clone, Debug)]
pub struct Atlas<'a> {
    /// The title.
    pub title: &'a str,
    /// The program that writes the book, and its version.
    pub program: &'a str,
    /// The families, in order.
    pub chapters: Vec<Chapter<'a>>,
    /// Whether the chapters are of several families, so that entries name theirs.
    pub names_families: bool,
    /// How plates are read, if it is said.
    pub how_to_read: Option<HowToRead>,
    /// Whether it has its plates only: neither a title page nor contents, lists and index.
    pub plates_only: bool,
    /// The finding charts.
    pub charts: Vec<FindingChart>,
    /// The lists of curves.
    pub lists: Vec<CurveList>,
    /// The entries of the index.
    pub index: Vec<IndexEntry>,
    /// The parts of the book in the thumb index, without lists and index; empty if it has none.
    pub tabs: Vec<Tab>,
}

impl<'a> Atlas<'a> {
    /// An atlas of chapters, without anything to find a curve by.
    pub fn new(title: &'a str, program: &'a str, chapters: Vec<Chapter<'a>>) -> Atlas<'a> {
        Atlas {
            title,
            program,
            names_families: chapters.len() > 1,
            chapters,
            how_to_read: None,
            plates_only: false,
            charts: Vec::new(),
            lists: Vec::new(),
            index: Vec::new(),
            tabs: Vec::new(),
        }
    }

    /// The number of pages, without front and back matter.
    pub fn page_count(&self) -> usize {
        self.chapters.iter().map(|chapter| chapter.page_count).sum()
    }

    /// The marks of the thumb index.
    pub(super) fn all_tabs(&self, back_matter: &[BackMatter]) -> Vec<Tab> {
        let mut tabs = self.tabs.clone();
        if tabs.is_empty() {
            return tabs;
        }
        for (is_index, label) in [(false, "lists"), (true, "index")] {
            let first = back_matter.iter().find(|part| part.is_index == is_index);
            tabs.extend(first.map(|part| Tab { number: None, label: label.to_owned(), first_page: part.first_page }));
        }
        tabs
    }

    /// The chapters, each with the number of pages before it.
    pub(super) fn chapters_with_offset(&self) -> impl Iterator<Item = (usize, &Chapter<'_>)> {
        self.chapters.iter().scan(0, |before, chapter| {
            *before += chapter.page_count;
            Some((*before - chapter.page_count, chapter))
        })
    }
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
    /// What the contents list: ranges of the dimensions of cells that follow one another, each with its first and last page.
    pub sections: Vec<(CellEntry, usize)>,
}

impl Chapter<'_> {
    /// The title, with its number among the chapters of an atlas with marks that have numbers.
    pub(super) fn numbered_title(&self, number: usize, atlas: &Atlas) -> String {
        let is_numbered = atlas.tabs.iter().any(|tab| tab.number == Some(number));
        if is_numbered { format!("{number} · {}", self.title) } else { self.title.to_owned() }
    }

    /// The numbers of geometries, curves and pages in words, as far as they are known.
    pub(super) fn format_counts(&self, separator: &str) -> String {
        let cells = (!self.cells.is_empty()).then(|| pluralize(self.cells.len(), "geometry"));
        let curves = self.curve_count.map(|curves| pluralize(curves, "curve"));
        let pages = pluralize(self.page_count, "page");
        cells.into_iter().chain(curves).chain([pages]).collect::<Vec<_>>().join(separator)
    }
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
    /// The number of pages, without front and back matter.
    pub page_count: usize,
    /// The number of pages of back matter, which follows in the last volume.
    pub back_page_count: usize,
}

impl Volume {
    /// A volume without pages, for the number of pages of a list, which does not depend on its volume.
    pub(super) const NONE: Volume =
        Volume { number: 1, volume_count: 1, first_page: 1, page_count: 0, back_page_count: 0 };

    /// The numbers of its pages in the atlas, from 1.
    pub fn page_range(&self) -> Range<usize> {
        self.first_page..self.first_page + self.page_count
    }

    /// The index of a page of the atlas in the volume's file, after `front` pages of front matter; `None` if the page
    /// is in another volume. Pages of the atlas are counted from 1, with those of the back matter, and the index from 0.
    pub fn page_index(&self, page: usize, front: usize) -> Option<usize> {
        let Range { start, end } = self.page_range();
        (start..end + self.back_page_count).contains(&page).then(|| page - self.first_page + front)
    }

    /// The name of the volume, without the title of the atlas; `None` if it is the only one.
    pub(super) fn name(&self) -> Option<String> {
        let Range { start, end } = self.page_range();
        (self.volume_count > 1)
            .then(|| format!("volume {} of {}, pages {start}–{}", self.number, self.volume_count, end - 1))
    }
}

/// A part of the back matter.
pub(super) struct BackMatter {
    pub title: String,
    /// What is on each page, if it is a table: its first column from the first entry to the last.
    pub ranges: Vec<String>,
    /// Whether it is the index, or else a list.
    pub is_index: bool,
    /// The number of its first page in the atlas.
    pub first_page: usize,
    pub page_count: usize,
}

/// The title of the finding charts in contents and outline.
pub(super) const CHARTS_TITLE: &str = "Finding charts";

/// The finding charts of a volume: those with a page in it.
pub(super) fn charts_in<'c>(atlas: &'c Atlas, volume: &'c Volume) -> impl Iterator<Item = &'c FindingChart> {
    let pages = volume.page_range();
    let is_in_volume = move |chart: &&FindingChart| {
        chart.cells.iter().flat_map(|cell| &cell.pages).any(|(_, page)| pages.contains(page))
    };
    atlas.charts.iter().filter(is_in_volume)
}

/// What the two pages show and say.
#[derive(Clone, Debug)]
pub struct HowToRead {
    /// A plate of the book.
    pub plate: Scene,
    /// The layout of the plate.
    pub layout: Layout,
    /// What a dash and its gap span, as in "5° of input".
    pub dash: String,
    /// The name of a curve on the plate, as in "hrones-nelson:14.25"; empty if it has none.
    pub curve_name: String,
}

/// A finding chart: a page.
#[derive(Clone, Debug)]
pub struct FindingChart {
    /// What is the same on the whole page, as in "C = 2"; may be empty.
    pub title: String,
    /// What is shown; may be empty.
    pub note: String,
    /// The names of parameters, set in italics.
    pub symbols: Vec<String>,
    /// The values of the columns, as in "B = 2"; empty if they differ from row to row.
    pub columns: Vec<String>,
    /// The values of the rows, as in "A = 2".
    pub rows: Vec<String>,
    /// The cells.
    pub cells: Vec<FindingCell>,
}

/// A cell of a finding chart.
#[derive(Clone, Debug)]
pub struct FindingCell {
    /// Its row and column, from 0.
    pub place: [usize; 2],
    /// What it is, if the columns do not say it; may be empty.
    pub label: String,
    /// What varies in it, as in "p = 2", which stays where the label does not fit; may be empty.
    pub varying: Vec<String>,
    /// The curves of each page of the cell, with the number of the page in the atlas, from 1.
    pub pages: Vec<(Vec<FindingCurve>, usize)>,
    /// The number of its figure on the page, if that has several.
    pub figure: Option<usize>,
    /// What is drawn above them, at their scale.
    pub bar: ScaleBar,
}

/// A curve on a finding chart.
#[derive(Clone, Debug)]
pub struct FindingCurve {
    /// The drawing of the curve.
    pub drawing: Miniature,
    /// What traces it, as in "12", if the chart has several of a linkage; may be empty.
    pub label: String,
}

/// A scale bar of a finding chart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ScaleBar {
    /// As long as the crank, whose length this is.
    Crank(f64),
    /// A round length, which is written next to it; with its unit, if it has one.
    Round(Option<LengthUnit>),
}

/// A list of curves.
#[derive(Clone, Debug)]
pub struct CurveList {
    /// The title.
    pub title: String,
    /// What is listed and in what order; may be empty.
    pub note: String,
    /// The heads of its columns, if it is a table with a line for each entry; none if the entries have drawings.
    pub columns: Vec<String>,
    /// The entries, the best first.
    pub entries: Vec<ListEntry>,
}

/// An entry of a list.
#[derive(Clone, Debug)]
pub struct ListEntry {
    /// The drawing of the curve, unless the list is a table.
    pub drawing: Option<Miniature>,
    /// The index of its chapter.
    pub chapter: usize,
    /// The caption of its cell.
    pub caption: String,
    /// Which curve of the cell it is, as in "path of B"; may be empty.
    pub curve: String,
    /// What is said of it, a line each, or what is in the columns.
    pub lines: Vec<String>,
    /// The number of its page in the atlas, from 1.
    pub page: usize,
    /// The number of its figure on the page, if that has several.
    pub figure: Option<usize>,
}

//! Links, page labels and the outline of a book.

use coupler_curves::geometry::{Point, Vector};

/// A rectangle on a page of a book that links to another page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PageLink {
    /// The upper left corner.
    pub corner: Point,
    /// The width and height in millimetres.
    pub size: Vector,
    /// The index of the target page in the book.
    pub page_index: usize,
}

/// The label of a page of a book: its number, from 1, which may differ from its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PageNumber {
    /// Lower-case Roman numerals, for front matter and index.
    Roman(u32),
    /// Arabic numerals.
    Arabic(u32),
}

/// An entry of a book's outline.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OutlineEntry {
    /// The title.
    pub title: String,
    /// The index of the target page in the book.
    pub page_index: usize,
    /// The entries under this one, collapsed at first.
    pub children: Vec<OutlineEntry>,
}

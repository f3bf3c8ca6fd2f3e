use coupler_curves::geometry::{Point, Vector};

/// A part of a page of a book that leads to another page of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PageLink {
    /// Its upper left corner.
    pub corner: Point,
    /// Its width and height in millimetres.
    pub size: Vector,
    /// The page it leads to, by its place in the book, from 0.
    pub page_index: usize,
}

/// What a page of a book is called, beside its place: its number, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PageNumber {
    /// In small Roman numerals: what stands before and after the pages themselves.
    Roman(u32),
    /// In Arabic ones.
    Arabic(u32),
}

/// An entry of a book's outline.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OutlineEntry {
    /// What it says.
    pub title: String,
    /// The page it leads to, by its place in the book, from 0.
    pub page_index: usize,
    /// The entries under it, which are not shown before it is opened.
    pub children: Vec<OutlineEntry>,
}

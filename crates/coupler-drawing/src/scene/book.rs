//! Links, page labels and the outline of a book.

use std::fmt;

use coupler_curves::geometry::{Point, Vector};

/// A rectangle on a page of a book that is a link.
#[derive(Clone, Debug, PartialEq)]
pub struct PageLink {
    /// The upper left corner.
    pub corner: Point,
    /// The width and height in millimetres.
    pub size: Vector,
    /// What it leads to.
    pub target: LinkTarget,
    /// Where it leads to, in words.
    pub title: String,
    /// What it is a link of.
    pub kind: LinkKind,
}

/// What a link leads to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LinkTarget {
    /// A page of the book by its index.
    Page(usize),
    /// An address on the web.
    Address(String),
}

impl PageLink {
    /// The index of the page of the book that it leads to; `None` if that is none.
    pub fn page_index(&self) -> Option<usize> {
        match self.target {
            LinkTarget::Page(page) => Some(page),
            LinkTarget::Address(_) => None,
        }
    }
}

/// What a link is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkKind {
    /// A line of contents or of an index.
    Contents,
    /// An entry of a list or of a chart, with what is drawn and written in its rectangle.
    Entry,
    /// A code, which is in its rectangle.
    Code,
    /// A mark outside the text, such as that of the thumb index.
    Mark,
}

/// The label of a page of a book: its number, from 1, which may differ from its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PageNumber {
    /// Lower-case Roman numerals, for front matter.
    Roman(u32),
    /// Arabic numerals.
    Arabic(u32),
}

impl fmt::Display for PageNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            PageNumber::Roman(number) => f.write_str(&to_roman(*number)),
            PageNumber::Arabic(number) => write!(f, "{number}"),
        }
    }
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

/// An entry of a book's outline.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OutlineEntry {
    /// The title.
    pub title: String,
    /// The index of the target page in the book.
    pub page_index: usize,
    /// The entries under this one, collapsed at first if there are many.
    pub children: Vec<OutlineEntry>,
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

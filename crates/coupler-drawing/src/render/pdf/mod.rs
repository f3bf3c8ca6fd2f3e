//! A book in PDF, page after page.
//!
//! A [`Book`] takes finished scenes in the order of its pages. Each is drawn and compressed at once, on the thread that
//! adds it, about a millisecond to a page; no more is held of it than its compressed drawing, until the book is finished.
//! A book does not go from thread to thread: pages that are composed in parallel are added by one of them, in order.
//! Where a link or an entry of the outline leads may be a page that is still to come: that is looked up in the end.

mod drawing;
mod fonts;

use std::num::NonZeroU32;

use krilla::annotation::{LinkAnnotation, Target};
use krilla::destination::XyzDestination;
use krilla::geom::{self, Rect};
use krilla::metadata::Metadata;
use krilla::outline::{Outline, OutlineNode};
use krilla::page::{NumberingStyle, Page, PageLabel, PageSettings};
use krilla::{Document, SerializeSettings};

use crate::scene::{Entry, Label, Link, Scene};
use drawing::{Pen, points};
use fonts::Fonts;

/// Why a book cannot be written.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A page has no area.
    #[error("a page of {width} by {height} mm cannot be written")]
    Size {
        /// Millimetres across.
        width: f64,
        /// Millimetres down.
        height: f64,
    },
    /// A link or an entry of the outline leads to a page that is not in the book.
    #[error("something leads to page {to} of a book of {pages} pages")]
    NoPage {
        /// The page it leads to, from 1.
        to: usize,
        /// How many pages there are.
        pages: usize,
    },
    /// A face cannot be embedded, or a limit of the format is passed.
    #[error("the book cannot be written: {0}")]
    Writing(String),
}

/// A book that is being written.
pub struct Book {
    document: Document,
    metadata: Metadata,
    fonts: Fonts,
    pages: usize,
    /// The furthest page a link leads to.
    furthest: Option<usize>,
}

impl Book {
    /// An empty book: its title, and the program that writes it. There is no date and no name of a machine in it.
    pub fn new(title: &str, program: &str) -> Book {
        let settings = SerializeSettings { enable_tagging: false, ..SerializeSettings::default() };
        let program = plain(program);
        let metadata = Metadata::new().title(plain(title)).creator(program.clone()).producer(program);
        let metadata = metadata.language("en".to_owned());
        Book { document: Document::new_with(settings), metadata, fonts: Fonts::default(), pages: 0, furthest: None }
    }

    /// How many pages it has so far, which is the place of the next one.
    pub fn pages(&self) -> usize {
        self.pages
    }

    /// Adds a page.
    ///
    /// # Errors
    /// A page without area.
    pub fn add(&mut self, scene: &Scene, label: Label) -> Result<(), Error> {
        let Scene { width, height, .. } = *scene;
        let settings = PageSettings::from_wh(points(width), points(height)).ok_or(Error::Size { width, height })?;
        let (style, number) = match label {
            Label::Roman(number) => (NumberingStyle::LowerRoman, number),
            Label::Arabic(number) => (NumberingStyle::Arabic, number),
        };
        let label = PageLabel::new(Some(style), None, NonZeroU32::new(number));
        let mut page = self.document.start_page_with(settings.with_page_label(label));
        let mut pen = Pen::new(page.surface(), &mut self.fonts);
        pen.scene(scene);
        pen.finish();
        for link in &scene.links {
            self.furthest = self.furthest.max(Some(link.page));
            annotate(&mut page, link);
        }
        page.finish();
        self.pages += 1;
        Ok(())
    }

    /// The bytes of the book, with an outline.
    ///
    /// # Errors
    /// A link or an entry that leads to no page; a face that cannot be embedded.
    pub fn finish(mut self, outline: &[Entry]) -> Result<Vec<u8>, Error> {
        let furthest = outline.iter().map(furthest).max().max(self.furthest);
        if let Some(to) = furthest.filter(|&to| to >= self.pages) {
            return Err(Error::NoPage { to: to + 1, pages: self.pages });
        }
        if let Some(face) = self.fonts.unreadable() {
            return Err(Error::Writing(format!("the face {face:?} cannot be read")));
        }
        let mut root = Outline::new();
        outline.iter().for_each(|entry| root.push_child(node(entry)));
        self.document.set_outline(root);
        self.document.set_metadata(self.metadata);
        self.document.finish().map_err(|error| Error::Writing(error.to_string()))
    }
}

/// The furthest page that an entry or one under it leads to.
fn furthest(entry: &Entry) -> usize {
    entry.children.iter().map(furthest).fold(entry.page, usize::max)
}

fn node(entry: &Entry) -> OutlineNode {
    let mut node = OutlineNode::new(plain(&entry.title), top_of(entry.page));
    entry.children.iter().for_each(|child| node.push_child(self::node(child)));
    node
}

fn top_of(page: usize) -> XyzDestination {
    XyzDestination::new(page, geom::Point::from_xy(0.0, 0.0))
}

/// A box that is pressed and leads to a page; one without area cannot be pressed.
fn annotate(page: &mut Page, link: &Link) {
    let [left, top] = link.corner.coords.map(points).into();
    let [right, bottom] = (link.corner + link.size).coords.map(points).into();
    if let Some(area) = Rect::from_ltrb(left, top, right, bottom) {
        let target = Target::Destination(top_of(link.page).into());
        page.add_annotation(LinkAnnotation::new(area, target).into());
    }
}

/// A text without characters that a document's description has no place for.
fn plain(text: &str) -> String {
    let plain = |c: char| match c {
        '\t' | '\n' | '\r' => ' ',
        '\0'..='\x1f' | '\x7f' | '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
        c => c,
    };
    text.chars().map(plain).collect()
}

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

use crate::scene::{OutlineEntry, PageLink, PageNumber, Scene};
use drawing::{PagePainter, mm_to_points};
use fonts::FontCache;

/// Why a book cannot be written.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A page has no area.
    #[error("a page of {width} by {height} mm cannot be written")]
    InvalidSize {
        /// Millimetres across.
        width: f64,
        /// Millimetres down.
        height: f64,
    },
    /// A link or an entry of the outline leads to a page that is not in the book.
    #[error("something leads to page {page} of a book of {page_count} pages")]
    MissingPage {
        /// The page it leads to, from 1.
        page: usize,
        /// How many pages there are.
        page_count: usize,
    },
    /// A face cannot be embedded, or a limit of the format is passed.
    #[error("the book cannot be written: {0}")]
    Writing(String),
}

/// A book that is being written.
pub struct Book {
    document: Document,
    metadata: Metadata,
    fonts: FontCache,
    page_count: usize,
    /// The furthest page a link leads to.
    furthest_linked_page: Option<usize>,
}

impl Book {
    /// An empty book: its title, and the program that writes it. There is no date and no name of a machine in it.
    pub fn new(title: &str, program: &str) -> Book {
        let settings = SerializeSettings { enable_tagging: false, ..SerializeSettings::default() };
        let program = sanitize_text(program);
        let metadata = Metadata::new().title(sanitize_text(title)).creator(program.clone()).producer(program);
        let metadata = metadata.language("en".to_owned());
        Book {
            document: Document::new_with(settings),
            metadata,
            fonts: FontCache::default(),
            page_count: 0,
            furthest_linked_page: None,
        }
    }

    /// How many pages it has so far, which is the place of the next one.
    pub fn page_count(&self) -> usize {
        self.page_count
    }

    /// Adds a page.
    ///
    /// # Errors
    /// A page without area.
    pub fn add_page(&mut self, scene: &Scene, label: PageNumber) -> Result<(), Error> {
        let Scene { width, height, .. } = *scene;
        let settings = PageSettings::from_wh(mm_to_points(width), mm_to_points(height))
            .ok_or(Error::InvalidSize { width, height })?;
        let (style, number) = match label {
            PageNumber::Roman(number) => (NumberingStyle::LowerRoman, number),
            PageNumber::Arabic(number) => (NumberingStyle::Arabic, number),
        };
        let label = PageLabel::new(Some(style), None, NonZeroU32::new(number));
        let mut page = self.document.start_page_with(settings.with_page_label(label));
        let mut pen = PagePainter::new(page.surface(), &mut self.fonts);
        pen.draw_scene(scene);
        pen.finish();
        for link in &scene.links {
            self.furthest_linked_page = self.furthest_linked_page.max(Some(link.page_index));
            add_link_annotation(&mut page, link);
        }
        page.finish();
        self.page_count += 1;
        Ok(())
    }

    /// The bytes of the book, with an outline.
    ///
    /// # Errors
    /// A link or an entry that leads to no page; a face that cannot be embedded.
    pub fn finish(mut self, outline: &[OutlineEntry]) -> Result<Vec<u8>, Error> {
        let furthest = outline.iter().map(furthest_page).max().max(self.furthest_linked_page);
        if let Some(to) = furthest.filter(|&to| to >= self.page_count) {
            return Err(Error::MissingPage { page: to + 1, page_count: self.page_count });
        }
        if let Some(face) = self.fonts.first_unreadable() {
            return Err(Error::Writing(format!("the face {face:?} cannot be read")));
        }
        let mut root = Outline::new();
        outline.iter().for_each(|entry| root.push_child(outline_node(entry)));
        self.document.set_outline(root);
        self.document.set_metadata(self.metadata);
        self.document.finish().map_err(|error| Error::Writing(error.to_string()))
    }
}

/// The furthest page that an entry or one under it leads to.
fn furthest_page(entry: &OutlineEntry) -> usize {
    entry.children.iter().map(furthest_page).fold(entry.page_index, usize::max)
}

fn outline_node(entry: &OutlineEntry) -> OutlineNode {
    let mut node = OutlineNode::new(sanitize_text(&entry.title), top_of_page(entry.page_index));
    entry.children.iter().for_each(|child| node.push_child(self::outline_node(child)));
    node
}

fn top_of_page(page: usize) -> XyzDestination {
    XyzDestination::new(page, geom::Point::from_xy(0.0, 0.0))
}

/// A box that is pressed and leads to a page; one without area cannot be pressed.
fn add_link_annotation(page: &mut Page, link: &PageLink) {
    let [left, top] = link.corner.coords.map(mm_to_points).into();
    let [right, bottom] = (link.corner + link.size).coords.map(mm_to_points).into();
    if let Some(area) = Rect::from_ltrb(left, top, right, bottom) {
        let target = Target::Destination(top_of_page(link.page_index).into());
        page.add_annotation(LinkAnnotation::new(area, target).into());
    }
}

/// A text without characters that a document's description has no place for.
fn sanitize_text(text: &str) -> String {
    let plain = |c: char| match c {
        '\t' | '\n' | '\r' => ' ',
        '\0'..='\x1f' | '\x7f' | '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
        c => c,
    };
    text.chars().map(plain).collect()
}

//! Books in PDF, written page by page.
//!
//! A [`Book`] receives finished scenes in the order of its pages. Each is drawn and compressed at once on the thread
//! that adds it, which takes about a millisecond; only the compressed page is kept in memory until the book is
//! finished. A book cannot be sent to another thread: pages composed in parallel are added by one thread, in order.
//! Links and entries of the outline may refer to later pages; they are checked when the book is finished.

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

/// An error of writing a book.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A page without area.
    #[error("a page of {width} by {height} mm cannot be written")]
    InvalidSize {
        /// The width in millimetres.
        width: f64,
        /// The height in millimetres.
        height: f64,
    },
    /// A link or an entry of the outline refers to a page that is not in the book.
    #[error("a link refers to page {page}, but the book has {page_count} pages")]
    MissingPage {
        /// The target page, from 1.
        page: usize,
        /// The number of pages.
        page_count: usize,
    },
    /// A font that cannot be embedded, or an exceeded limit of the format.
    #[error("failed to write the book: {0}")]
    Writing(String),
}

/// A book that is being written.
pub struct Book {
    document: Document,
    metadata: Metadata,
    fonts: FontCache,
    page_count: usize,
    /// The greatest index of a page that a link refers to.
    furthest_linked_page: Option<usize>,
}

impl Book {
    /// An empty book with a title and the name of the program that writes it. It contains no date and no name of a
    /// machine.
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

    /// The number of pages so far, which is the index of the next page.
    pub fn page_count(&self) -> usize {
        self.page_count
    }

    /// Adds a page.
    ///
    /// # Errors
    /// If the page has no area.
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
        let mut painter = PagePainter::new(page.surface(), &mut self.fonts);
        painter.draw_scene(scene);
        painter.finish();
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
    /// If a link or an entry of the outline refers to a missing page, or if a font cannot be embedded.
    pub fn finish(mut self, outline: &[OutlineEntry]) -> Result<Vec<u8>, Error> {
        let furthest = outline.iter().map(furthest_page).max().max(self.furthest_linked_page);
        if let Some(index) = furthest.filter(|&index| index >= self.page_count) {
            return Err(Error::MissingPage { page: index + 1, page_count: self.page_count });
        }
        if let Some((face, file)) = self.fonts.first_unreadable() {
            let font = file.map_or_else(|| format!("{face:?}"), |file| format!("{file:?}"));
            return Err(Error::Writing(format!("the font {font} cannot be read")));
        }
        let mut root = Outline::new();
        outline.iter().for_each(|entry| root.push_child(outline_node(entry)));
        self.document.set_outline(root);
        self.document.set_metadata(self.metadata);
        self.document.finish().map_err(|error| Error::Writing(error.to_string()))
    }
}

/// The greatest index of a page that an entry or one under it refers to.
fn furthest_page(entry: &OutlineEntry) -> usize {
    entry.children.iter().map(furthest_page).fold(entry.page_index, usize::max)
}

fn outline_node(entry: &OutlineEntry) -> OutlineNode {
    let mut node = OutlineNode::new(sanitize_text(&entry.title), top_of_page(entry.page_index));
    entry.children.iter().for_each(|child| node.push_child(outline_node(child)));
    node
}

fn top_of_page(page_index: usize) -> XyzDestination {
    XyzDestination::new(page_index, geom::Point::from_xy(0.0, 0.0))
}

/// Adds a link to a page, unless its rectangle has no area.
fn add_link_annotation(page: &mut Page, link: &PageLink) {
    let [left, top] = link.corner.coords.map(mm_to_points).into();
    let [right, bottom] = (link.corner + link.size).coords.map(mm_to_points).into();
    if let Some(area) = Rect::from_ltrb(left, top, right, bottom) {
        let target = Target::Destination(top_of_page(link.page_index).into());
        page.add_annotation(LinkAnnotation::new(area, target).into());
    }
}

/// A text without control characters and noncharacters, which the metadata of a document cannot contain.
fn sanitize_text(text: &str) -> String {
    let sanitized = |c: char| match c {
        '\t' | '\n' | '\r' => ' ',
        '\0'..='\x1f' | '\x7f' | '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
        c => c,
    };
    text.chars().map(sanitized).collect()
}

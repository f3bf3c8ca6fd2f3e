//! Books in PDF, written page by page.
//!
//! A [`Book`] receives finished scenes in the order of its pages. Each is drawn and compressed at once on the thread
//! that adds it, which takes about a millisecond; only the compressed page is kept in memory until the book is
//! finished. A book cannot be sent to another thread: pages composed in parallel are added by one thread, in order.
//! Links and entries of the outline may refer to later pages; they are checked when the book is finished.

mod drawing;
mod fonts;
mod sheet;
mod structure;
mod words;

use std::num::{NonZeroU16, NonZeroU32};

use krilla::action::LinkAction;
use krilla::annotation::{Annotation, LinkAnnotation, Target};
use krilla::configure::{Accessibility, ConfigurationBuilder, ValidationError};
use krilla::destination::XyzDestination;
use krilla::error::KrillaError;
use krilla::geom::{self, Rect};
use krilla::metadata::{Metadata, PageLayout};
use krilla::outline::{Outline, OutlineNode};
use krilla::page::{NumberingStyle, Page, PageLabel};
use krilla::tagging::{Identifier, TagTree};
use krilla::{Document, SerializeSettings};

use crate::scene::{LinkTarget, OutlineEntry, PageLink, PageNumber, Scene};
use coupler_curves::geometry::Vector;
use drawing::PagePainter;
use fonts::FontCache;
pub use sheet::Sheet;
use sheet::mm_to_points;
use words::sanitize_text;

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
    sheet: Sheet,
    document: Document,
    metadata: Metadata,
    title: String,
    fonts: FontCache,
    /// The structure of all pages.
    structure: TagTree,
    /// Whether any page has a title.
    has_title: bool,
    page_count: usize,
    /// The greatest index of a page that a link refers to.
    furthest_linked_page: Option<usize>,
}

impl Book {
    /// An empty book with a title and the name of the program that writes it. It contains no date and no name of a
    /// machine.
    pub fn new(title: &str, program: &str) -> Book {
        let configuration = ConfigurationBuilder::new().with_accessibility_validator(Accessibility::UA1).finish();
        let configuration = configuration.expect("a single standard agrees with itself");
        let settings = SerializeSettings { configuration, ..SerializeSettings::default() };
        let program = sanitize_text(program);
        let title = if title.is_empty() { "An atlas".to_owned() } else { sanitize_text(title) };
        let metadata = Metadata::new().title(title.clone()).creator(program.clone()).producer(program);
        let metadata = metadata.language(LANGUAGE.to_owned()).page_layout(PageLayout::TwoPageRight);
        Book {
            sheet: Sheet::default(),
            document: Document::new_with(settings),
            metadata,
            title,
            fonts: FontCache::default(),
            structure: TagTree::new().with_lang(Some(LANGUAGE.to_owned())),
            has_title: false,
            page_count: 0,
            furthest_linked_page: None,
        }
    }

    /// The book on other sheets.
    pub fn with_sheet(self, sheet: Sheet) -> Book {
        Book { sheet, ..self }
    }

    /// The number of pages so far, which is the index of the next page.
    pub fn page_count(&self) -> usize {
        self.page_count
    }

    /// Adds a page. The first, third and so on are right-hand pages, bound at their left edges.
    ///
    /// # Errors
    /// If the page has no area.
    pub fn add_page(&mut self, scene: &Scene, label: PageNumber) -> Result<(), Error> {
        let Scene { width, height, .. } = *scene;
        let settings = self.sheet.settings(width, height).ok_or(Error::InvalidSize { width, height })?;
        let corner = self.sheet.page_corner(self.page_count.is_multiple_of(2));
        let (style, number) = match label {
            PageNumber::Roman(number) => (NumberingStyle::LowerRoman, number),
            PageNumber::Arabic(number) => (NumberingStyle::Arabic, number),
        };
        let label = PageLabel::new(Some(style), None, NonZeroU32::new(number));
        let mut page = self.document.start_page_with(settings.with_page_label(label));
        let mut painter = PagePainter::new(page.surface(), &mut self.fonts, self.page_count);
        let level = if self.has_title { LATER_TITLES } else { NonZeroU16::MIN };
        let structure = painter.draw_scene(scene, level, (self.sheet, corner));
        painter.finish();
        self.has_title |= structure.has_title;
        let mut annotations = Vec::with_capacity(scene.links.len());
        for link in &scene.links {
            self.furthest_linked_page = self.furthest_linked_page.max(link.page_index());
            annotations.push(add_link_annotation(&mut page, link, corner.coords));
        }
        page.finish();
        self.structure.push(structure.into_section(annotations));
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
        if outline.is_empty() {
            root.push_child(OutlineNode::new(self.title, top_of_page(0)));
        }
        self.document.set_outline(root);
        self.document.set_metadata(self.metadata);
        self.document.set_tag_tree(self.structure);
        let bytes = self.document.finish().map_err(|error| Error::Writing(describe(&error)))?;
        Ok(with_open_outline(bytes))
    }
}

/// A document that readers open with its outline: krilla has no setting for it. The catalog is the last object, so that only the
/// table of objects moves.
fn with_open_outline(mut bytes: Vec<u8>) -> Vec<u8> {
    const CATALOG: &[u8] = b"/Type/Catalog";
    const OUTLINE: &[u8] = b"/PageMode/UseOutlines";
    const TABLE: &[u8] = b"startxref\n";
    let last = |word: &[u8]| Some(bytes.windows(word.len()).rposition(|window| window == word)? + word.len());
    let (Some(catalog), Some(table)) = (last(CATALOG), last(TABLE)) else { return bytes };
    let digits = bytes[table..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let Some(at) = std::str::from_utf8(&bytes[table..table + digits]).ok().and_then(|text| text.parse::<usize>().ok())
    else {
        return bytes;
    };
    let is_last =
        bytes.get(catalog..at).is_some_and(|rest| rest.windows(6).filter(|word| word == b"endobj").count() == 1);
    if is_last {
        bytes.splice(table..table + digits, (at + OUTLINE.len()).to_string().into_bytes());
        bytes.splice(catalog..catalog, OUTLINE.iter().copied());
    }
    bytes
}

/// The language of what the program writes.
const LANGUAGE: &str = "en";

/// The level of the titles of pages after that of the book.
const LATER_TITLES: NonZeroU16 = NonZeroU16::MIN.saturating_add(1);

/// An error in words.
fn describe(error: &KrillaError) -> String {
    let KrillaError::Validation(errors) = error else { return error.to_string() };
    match errors.first() {
        Some((ValidationError::RestrictedLicense(_), _)) => {
            "the licence of the font of the theme does not allow it to be embedded in documents".to_owned()
        }
        first => format!("{error}: {first:?}"),
    }
}

/// The greatest index of a page that an entry or one under it refers to.
fn furthest_page(entry: &OutlineEntry) -> usize {
    entry.children.iter().map(furthest_page).fold(entry.page_index, usize::max)
}

fn outline_node(entry: &OutlineEntry) -> OutlineNode {
    /// More entries would hide the other parts of the book.
    const MOST_OPEN: usize = 12;
    let node = OutlineNode::new(sanitize_text(&entry.title), top_of_page(entry.page_index));
    let mut node = node.with_open(entry.children.len() <= MOST_OPEN);
    entry.children.iter().for_each(|child| node.push_child(outline_node(child)));
    node
}

fn top_of_page(page_index: usize) -> XyzDestination {
    XyzDestination::new(page_index, geom::Point::from_xy(0.0, 0.0))
}

/// Adds a link to a page, unless its rectangle has no area.
fn add_link_annotation(page: &mut Page, link: &PageLink, shift: Vector) -> Option<Identifier> {
    let [left, top] = (link.corner.coords + shift).map(mm_to_points).into();
    let [right, bottom] = (link.corner.coords + link.size + shift).map(mm_to_points).into();
    let area = Rect::from_ltrb(left, top, right, bottom)?;
    let target = match &link.target {
        LinkTarget::Page(page) => Target::Destination(top_of_page(*page).into()),
        LinkTarget::Address(address) => Target::Action(LinkAction::new(address.clone()).into()),
    };
    let title = if link.title.is_empty() { "link".to_owned() } else { sanitize_text(&link.title) };
    Some(page.add_tagged_annotation(Annotation::new_link(LinkAnnotation::new(area, target), Some(title))))
}

//! The structure of a page for those who do not see it: title, paragraphs, figures and links, in reading order.

use std::num::NonZeroU16;

use krilla::geom::Rect;
use krilla::tagging::{BBox, Identifier, ListNumbering, Node, Tag, TagGroup, TagKind};

use super::sheet::mm_to_points;
use super::words::sanitize_text;
use crate::scene::{LinkKind, PageLink, Text};
use coupler_curves::geometry::{Bounds, Point, Vector};

/// The structure of a page that is being drawn.
pub(super) struct PageStructure<'s> {
    links: &'s [PageLink],
    /// The index of the page, and how far it is moved on its sheet.
    place: (usize, Vector),
    parts: Vec<Part>,
    /// What is in each link.
    linked: Vec<Vec<Node>>,
    /// The last line, if it is the last of a paragraph that may have another.
    last_line: Option<&'s Text>,
    pub has_title: bool,
}

/// A part of a page.
enum Part {
    Node(Node),
    /// A link by its index, where its first content is.
    Link(usize),
}

impl<'s> PageStructure<'s> {
    pub fn new(links: &'s [PageLink], place: (usize, Vector)) -> PageStructure<'s> {
        let linked = links.iter().map(|_| Vec::new()).collect();
        PageStructure { links, place, parts: Vec::new(), linked, last_line: None, has_title: false }
    }

    /// The link whose rectangle a point is in.
    fn link_at(&self, at: Point) -> Option<usize> {
        let is_at = |link: &PageLink| {
            let [right, down] = (at - link.corner).into();
            link.kind != LinkKind::Mark && (0.0..=link.size.x).contains(&right) && (0.0..=link.size.y).contains(&down)
        };
        self.links.iter().position(is_at)
    }

    fn push(&mut self, at: Point, node: Node) {
        match self.link_at(at) {
            None => self.parts.push(Part::Node(node)),
            Some(k) => {
                if self.linked[k].is_empty() {
                    self.parts.push(Part::Link(k));
                }
                self.linked[k].push(node);
            }
        }
    }

    /// Adds a line of text to the paragraph that it continues, or else a paragraph.
    pub fn add_text(&mut self, text: &'s Text, content: Identifier) {
        let last = self.last_line.take();
        let at = text.start();
        if self.link_at(at).is_some() {
            return self.push(at, content.into());
        }
        self.last_line = Some(text);
        match self.parts.last_mut() {
            Some(Part::Node(Node::Group(paragraph))) if last.is_some_and(|last| continues(last, text)) => {
                paragraph.push(content);
            }
            _ => self.parts.push(Part::Node(TagGroup::with_children(Tag::P, vec![content.into()]).into())),
        }
    }

    /// Adds a figure with its bounds.
    pub fn add_figure(&mut self, bounds: Bounds, description: &str, content: Identifier) {
        self.last_line = None;
        let (page_index, shift) = self.place;
        let [left, top] = (bounds.min.coords + shift).map(mm_to_points).into();
        let [right, bottom] = (bounds.max.coords + shift).map(mm_to_points).into();
        let area = Rect::from_ltrb(left, top, right, bottom);
        let figure = Tag::Figure(Some(sanitize_text(description)));
        let figure = figure.with_bbox(area.map(|area| BBox::new(page_index, area)));
        self.push(bounds.centre(), TagGroup::with_children(figure, vec![content.into()]).into());
    }

    /// Adds a title, whose lines are `contents`.
    pub fn add_title(&mut self, words: &str, contents: Vec<Identifier>, level: NonZeroU16) {
        self.last_line = None;
        let children = contents.into_iter().map(Node::from).collect();
        let title = match words {
            "" => TagGroup::with_children(Tag::P, children),
            words => TagGroup::with_children(Tag::Hn(level, Some(sanitize_text(words))), children),
        };
        self.has_title |= !words.is_empty();
        self.parts.push(Part::Node(title.into()));
    }

    /// The page as a section; a link has an annotation, unless it has no area.
    pub fn into_section(self, annotations: Vec<Option<Identifier>>) -> TagGroup {
        let PageStructure { links, parts, mut linked, .. } = self;
        let mut annotations = annotations;
        let mut section = TagGroup::new(Tag::Section);
        for part in parts {
            match part {
                Part::Node(node) => section.push(node),
                Part::Link(k) => {
                    let contents = std::mem::take(&mut linked[k]);
                    match annotations[k].take() {
                        None => section.push(TagGroup::with_children(Tag::P, contents)),
                        Some(annotation) => {
                            let mut link = TagGroup::with_children(Tag::Link, contents);
                            link.push(annotation);
                            push_entry(&mut section, links[k].kind, link);
                        }
                    }
                }
            }
        }
        for (link, annotation) in links.iter().zip(annotations) {
            if let Some(annotation) = annotation {
                let tag = Tag::Link.with_alt_text(Some(sanitize_text(&link.title)));
                section.push(TagGroup::with_children(tag, vec![annotation.into()]));
            }
        }
        section
    }
}

/// Whether a line of text is next to the last one, or below it as in a paragraph.
fn continues(last: &Text, text: &Text) -> bool {
    /// The most distance of baselines, in ems.
    const LEADING: f64 = 1.6;
    let [right, down] = (text.position - last.position).into();
    let is_alike = last.size == text.size && last.quarter_turns == 0 && text.quarter_turns == 0;
    let is_below = right == 0.0 && last.anchor == text.anchor && (0.0..=LEADING * text.size).contains(&down);
    is_alike && (down == 0.0 || is_below)
}

/// Adds an entry with its link, to the table of contents or list that ends a section, or else to a new one.
fn push_entry(section: &mut TagGroup, kind: LinkKind, link: TagGroup) {
    let (entry, list) = match kind {
        LinkKind::Contents => (TagGroup::with_children(Tag::TOCI, vec![link.into()]), TagGroup::new(Tag::TOC)),
        LinkKind::Entry => {
            let body = TagGroup::with_children(Tag::LBody, vec![link.into()]);
            (TagGroup::with_children(Tag::LI, vec![body.into()]), TagGroup::new(Tag::L(ListNumbering::None)))
        }
        LinkKind::Code | LinkKind::Mark => return section.push(link),
    };
    match section.children.last_mut() {
        Some(Node::Group(last)) if is_same_kind(&last.tag, &list.tag) => last.push(entry),
        _ => {
            let mut list = list;
            list.push(entry);
            section.push(list);
        }
    }
}

fn is_same_kind(a: &TagKind, b: &TagKind) -> bool {
    matches!((a, b), (TagKind::TOC(_), TagKind::TOC(_)) | (TagKind::L(_), TagKind::L(_)))
}

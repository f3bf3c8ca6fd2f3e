//! The frame of every page: border, title, source line and folio.

use super::area::Area;
use super::theme::Theme;
use crate::scene::Anchor;
use coupler_curves::geometry::Point;

/// The texts around the contents of a page: title, source line and folio.
///
/// [`Heading::new`] needs the title only; everything else is optional.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Heading<'a> {
    /// The title of the page, which is the family's.
    pub family_title: &'a str,
    /// The prefix of the ids of the page's groups, which is the family's id.
    pub family_id: &'a str,
    /// The atlas's title, written before the folio; may be empty.
    pub atlas_title: &'a str,
    /// The line under the title: where the linkage comes from and what its letters mean; may be empty.
    pub source: String,
    /// The line at the foot, before the atlas's title and the folio; may be empty.
    pub foot: String,
    /// The names of parameters, set in italics.
    pub symbols: &'a [String],
    /// The page's number in the family, from 1.
    pub page: usize,
    /// The number of pages of the family.
    pub page_count: usize,
}

impl<'a> Heading<'a> {
    /// The heading of a single page with a title; ids begin with `page`, and the other texts are empty.
    pub fn new(title: &'a str) -> Heading<'a> {
        Heading {
            family_title: title,
            family_id: "page",
            atlas_title: "",
            source: String::new(),
            foot: String::new(),
            symbols: &[],
            page: 1,
            page_count: 1,
        }
    }

    /// The heading with another prefix for the ids of the page's groups.
    pub fn with_family_id(self, family_id: &'a str) -> Heading<'a> {
        Heading { family_id, ..self }
    }

    /// The heading with the title of an atlas.
    pub fn with_atlas_title(self, atlas_title: &'a str) -> Heading<'a> {
        Heading { atlas_title, ..self }
    }

    /// The heading with a line under its title.
    pub fn with_source(self, source: impl Into<String>) -> Heading<'a> {
        Heading { source: source.into(), ..self }
    }

    /// The heading with a line at the foot.
    pub fn with_foot(self, foot: impl Into<String>) -> Heading<'a> {
        Heading { foot: foot.into(), ..self }
    }

    /// The heading with the names of parameters, which are set in italics.
    pub fn with_symbols(self, symbols: &'a [String]) -> Heading<'a> {
        Heading { symbols, ..self }
    }

    /// The heading of a page by its number, from 1, and the number of pages.
    pub fn with_page(self, page: usize, page_count: usize) -> Heading<'a> {
        Heading { page, page_count, ..self }
    }

    /// The title of the document the page is written to.
    pub(super) fn page_title(&self) -> String {
        let page = format!("{}, page {} of {}", self.family_title, self.page, self.page_count);
        if self.atlas_title.is_empty() { page } else { format!("{page}: {}", self.atlas_title) }
    }

    /// The title of the atlas and that of the family, as far as they are not empty.
    pub(super) fn titles(&self) -> String {
        let titles = [self.atlas_title, self.family_title];
        titles.into_iter().filter(|title| !title.is_empty()).collect::<Vec<_>>().join(" · ")
    }

    /// Draws border, title, source line and folio.
    pub(super) fn draw(&self, root: &impl Area, theme: &Theme) {
        draw_border(root, theme);
        let page = root.size();
        let mut at = draw_title(root, self.family_title, theme);
        let (left, right) = (at.x, page.x - at.x);
        let source_line = |text: &str, at| {
            theme.text_line(text, at, Anchor::Start, theme.source_size, theme.grey).with_italics(self.symbols)
        };
        // A source too long for one line is broken at a separator; there is no space for a third line.
        let fits = |text: &str| source_line(text, at).text.width() <= right - left;
        let (first, second) = split_at_separator(&self.source, fits);
        for line in [first, second].into_iter().filter(|line| !line.is_empty()) {
            root.record(&source_line(line, at).fit_width(right - left));
            at.y += 1.35 * theme.source_size;
        }
        let foot_height = page.y - theme.border - 0.6 * theme.margin;
        let foot = source_line(&self.foot, Point::new(left, foot_height)).fit_width(MAX_FOOT * (right - left));
        let foot_width = foot.text.width();
        let left = if foot_width > 0.0 { left + foot_width + 2.0 * theme.source_size } else { left };
        if foot_width > 0.0 {
            root.record(&foot);
        }
        let at = Point::new(right, foot_height);
        let atlas = theme.text_line(self.atlas_title, at, Anchor::End, theme.source_size, theme.grey);
        let folio = self.folio();
        let folio = if self.atlas_title.is_empty() { folio.trim_start_matches(SEPARATOR) } else { &folio };
        root.record(&atlas.fit_width_with_suffix(folio, right - left));
    }

    /// The page number, which ends the last line of the page, with a separator before it.
    pub(super) fn folio(&self) -> String {
        format!("{SEPARATOR}page {} of {}", self.page, self.page_count)
    }
}

/// The part of the width that the line at the foot may take at most.
const MAX_FOOT: f64 = 0.65;

/// Separates the parts of a line.
const SEPARATOR: &str = " · ";

/// Draws the border of a page.
pub(super) fn draw_border(root: &impl Area, theme: &Theme) {
    let page = root.size();
    let corners = [Point::new(theme.border, theme.border), Point::new(page.x - theme.border, page.y - theme.border)];
    root.record_rectangle(corners, theme.stroke(theme.ink, theme.fine_width));
}

/// Draws the title of a page; the position at which the line under it starts.
pub(super) fn draw_title(root: &impl Area, title: &str, theme: &Theme) -> Point {
    let left = theme.border + theme.margin;
    let at = Point::new(left, theme.border + 1.9 * theme.title_size);
    let line = theme.text_line(title, at, Anchor::Start, theme.title_size, theme.ink);
    root.record(&line.fit_width(root.size().x - 2.0 * left));
    Point::new(left, at.y + 1.85 * theme.source_size)
}

/// The margins above, below and on both sides of the contents, in millimetres.
pub(super) fn margins(theme: &Theme) -> [f64; 3] {
    let top = theme.border + 2.3 * theme.title_size + 3.2 * theme.source_size;
    let bottom = theme.border + theme.margin + theme.source_size;
    [top, bottom, theme.border + 0.5 * theme.margin]
}

/// A text that does not fit as a whole, split at the last separator before which it fits.
fn split_at_separator(text: &str, fits: impl Fn(&str) -> bool) -> (&str, &str) {
    if fits(text) {
        return (text, "");
    }
    let separators: Vec<usize> = text.match_indices(SEPARATOR).map(|(at, _)| at).collect();
    let fitting = separators.partition_point(|&at| fits(&text[..at]));
    let at = fitting.checked_sub(1).map(|last| separators[last]);
    at.map_or((text, ""), |at| (&text[..at], &text[at + SEPARATOR.len()..]))
}

//! What every page has round its contents: border, title, source line and folio.

use plotters::element::Rectangle;
use plotters::style::{RGBColor, ShapeStyle};

use super::element::{Area, draw, size};
use super::theme::Theme;
use crate::scene::{Anchor, Canvas, Color};
use coupler_curves::geometry::Point;

/// What is said round the contents of a page.
#[derive(Clone, Debug)]
pub struct Heading<'a> {
    /// The atlas's title.
    pub atlas_title: &'a str,
    /// The family's id.
    pub family_id: &'a str,
    /// The family's title.
    pub family_title: &'a str,
    /// Where the linkage comes from and what its letters mean.
    pub source: String,
    /// Words that stand for values, set in italics.
    pub symbols: &'a [String],
    /// The page's number in the family, from 1.
    pub page: usize,
    /// How many pages the family has.
    pub page_count: usize,
}

impl Heading<'_> {
    /// The name of the whole page.
    pub(super) fn page_title(&self) -> String {
        format!("{}, page {} of {}: {}", self.family_title, self.page, self.page_count, self.atlas_title)
    }

    /// Draws border, title, source line and folio.
    pub(super) fn draw(&self, root: &Area, theme: &Theme) {
        draw_border(root, theme);
        let page = size(root);
        let mut at = draw_title(root, self.family_title, theme);
        let (left, right) = (at.x, page.x - at.x);
        let words = |text: &str, at| {
            theme.text_line(text, at, Anchor::Start, theme.source_size, theme.grey).with_italics(self.symbols)
        };
        // What is too long for one line is parted between two of its parts; there is no room for a third line.
        let (first, second) = split_at_separator(&self.source, |text| words(text, at).text.width() <= right - left);
        for line in [first, second].into_iter().filter(|line| !line.is_empty()) {
            draw(root, &words(line, at).fit_width(right - left));
            at.y += 1.35 * theme.source_size;
        }
        let at = Point::new(right, page.y - theme.border - 0.6 * theme.margin);
        let atlas = theme.text_line(self.atlas_title, at, Anchor::End, theme.source_size, theme.grey);
        draw(root, &atlas.fit_width_with_suffix(&self.folio(), right - left));
    }

    /// What ends the last line of the page.
    pub(super) fn folio(&self) -> String {
        format!(" · page {} of {}", self.page, self.page_count)
    }
}

/// The border of a page.
pub(super) fn draw_border(root: &Area, theme: &Theme) {
    let page = size(root);
    let Color(r, g, b) = theme.ink;
    let corner = |x: f64, y: f64| (Canvas::to_pixels(x), Canvas::to_pixels(y));
    let border = [corner(theme.border, theme.border), corner(page.x - theme.border, page.y - theme.border)];
    let stroke_width = Canvas::to_pixels(theme.fine_width) as u32;
    let style = ShapeStyle { color: RGBColor(r, g, b).into(), filled: false, stroke_width };
    draw(root, &Rectangle::new(border, style));
}

/// The title of a page, and where the line under it begins.
pub(super) fn draw_title(root: &Area, title: &str, theme: &Theme) -> Point {
    let left = theme.border + theme.margin;
    let at = Point::new(left, theme.border + 1.9 * theme.title_size);
    let words = theme.text_line(title, at, Anchor::Start, theme.title_size, theme.ink);
    draw(root, &words.fit_width(size(root).x - 2.0 * left));
    Point::new(left, at.y + 1.85 * theme.source_size)
}

/// What is left free above, below and beside the contents.
pub(super) fn margins(theme: &Theme) -> [f64; 3] {
    let top = theme.border + 2.3 * theme.title_size + 3.2 * theme.source_size;
    let bottom = theme.border + theme.margin + theme.source_size;
    [top, bottom, theme.border + 0.5 * theme.margin]
}

/// A text in two, parted at the last ` · ` before which it fits; if it does not fit whole.
fn split_at_separator(text: &str, fits: impl Fn(&str) -> bool) -> (&str, &str) {
    const SEPARATOR: &str = " · ";
    if fits(text) {
        return (text, "");
    }
    let at = text.rmatch_indices(SEPARATOR).map(|(at, _)| at).find(|&at| fits(&text[..at]));
    at.map_or((text, ""), |at| (&text[..at], &text[at + SEPARATOR.len()..]))
}

//! The foot of a page: the proportions in large type, the facts and the folio; and the source in the column.

use super::super::CouplerGridPage;
use super::super::area::Area;
use super::super::element::TextLine;
use super::super::rect::Rect;
use super::super::symbols::{self, Symbol};
use super::super::theme::Theme;
use crate::scene::group_class::TITLE;
use crate::scene::{Anchor, Group};
use coupler_curves::geometry::{Point, Vector};

/// Draws the foot; the result is its height from the edge of the paper.
pub(super) fn draw(area: &impl Area, page: &CouplerGridPage, theme: &Theme) -> f64 {
    let paper = area.size();
    let (left, right) = (theme.border + theme.margin, paper.x - theme.border - theme.margin);
    let half = 0.49 * (right - left);
    let baseline = paper.y - theme.border - 0.65 * theme.margin;
    // A page on which nothing varies has the title in place of the proportions.
    let [large, titles] = match page.panel.caption.as_str() {
        "" => [page.heading.family_title.to_owned(), page.heading.atlas_title.to_owned()],
        // Some SVG viewers collapse consecutive spaces, but not an em space.
        caption => [caption.replace("  ", "\u{2003}"), page.heading.titles()],
    };
    let large = large_lines(&large, half, page, theme);
    // The class and the range of the transmission angle, and the note.
    let facts = [page.panel.facts[0].as_str(), &page.panel.note];
    let facts = facts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" · ");
    let facts = theme.text_line(&facts, Point::origin(), Anchor::End, theme.source_size, theme.grey).fit_or_wrap(half);
    let facts = facts.into_iter().filter(|line| line.text.width() > 0.0);
    let small: Vec<TextLine> = facts.chain(page.heading.folio_lines(&titles, paper, theme)).collect();
    let draw = |lines: Vec<TextLine>, x: f64, leading: f64| {
        let height: f64 = lines.iter().map(|line| leading * line.text.size).sum();
        // The last line is on the baseline.
        let mut y = baseline - height;
        for line in lines {
            y += leading * line.text.size;
            area.record(line.moved_to(Point::new(x, y)));
        }
        height
    };
    let mut large_height = 0.0;
    area.grouped(Group::of_class(TITLE), || large_height = draw(large, left, 1.25));
    let heights = [large_height, draw(small, right, 1.5)];
    theme.border + 0.65 * theme.margin + heights.into_iter().fold(1.5 * theme.title_size, f64::max)
}

/// The proportions of the linkage in large type; where they are too long for that, in lines half as large.
fn large_lines(text: &str, width: f64, page: &CouplerGridPage, theme: &Theme) -> Vec<TextLine> {
    /// The least part of its size that a single line may have, as of [`TextLine::fit_width`].
    const MIN_PART: f64 = 2.0 / 3.0;
    let symbols = page.heading.symbols;
    let line = |text: &str, size| theme.text_line(text, Point::origin(), Anchor::Start, size, theme.ink);
    let single = line(text, theme.title_size).with_italics(symbols);
    if MIN_PART * single.text.width() <= width {
        return vec![single.fit_width(width)];
    }
    let size = (0.5 * theme.title_size).max(theme.source_size);
    let lines = line(text, size).wrap_at_separators(width);
    lines.iter().map(|words| line(words, size).with_italics(symbols).fit_width(width)).collect()
}

/// Draws the symbols of the figure at the foot of a panel, in as many lines as needed; the result is the rest of the panel.
pub(super) fn draw_symbols(area: &impl Area, panel: Rect, symbols: &[Symbol], theme: &Theme) -> Rect {
    let lines = symbols::lines(symbols, panel.size.x, theme);
    let step = 1.6 * theme.note_size;
    let height = step * lines.len().saturating_sub(1) as f64;
    let first = panel.corner.y + panel.size.y - height;
    for (k, line) in lines.iter().enumerate() {
        symbols::draw(area, line, Point::new(panel.corner.x, first + step * k as f64), theme);
    }
    let above = if lines.is_empty() { 0.0 } else { height + 1.5 * step };
    Rect { size: panel.size - Vector::new(0.0, above), ..panel }
}

/// Draws the source, if there is one, at the foot of a panel, in as many lines as needed; the result is the rest of the
/// panel.
pub(super) fn draw_source(area: &impl Area, panel: Rect, page: &CouplerGridPage, theme: &Theme) -> Rect {
    let symbols = page.heading.symbols;
    if page.heading.source.is_empty() {
        return panel;
    }
    let lines = theme
        .text_line(&page.heading.source, Point::origin(), Anchor::End, theme.note_size, theme.grey)
        .wrap_at_separators(panel.size.x);
    let right = panel.corner.x + panel.size.x;
    let step = 1.45 * theme.note_size;
    let height = step * lines.len() as f64;
    let first = panel.corner.y + panel.size.y - height;
    for (k, line) in lines.iter().enumerate() {
        let at = Point::new(right, first + step * k as f64);
        let line = theme.text_line(line, at, Anchor::End, theme.note_size, theme.grey);
        area.record(line.with_italics(symbols).fit_width(panel.size.x));
    }
    Rect { size: panel.size - Vector::new(0.0, height + 1.6 * step), ..panel }
}

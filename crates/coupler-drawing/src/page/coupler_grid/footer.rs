//! The foot of a page: the proportions in large type, the facts and the folio; and the source in the column.

use super::super::CouplerGridPage;
use super::super::area::Area;
use super::super::rect::Rect;
use super::super::symbols::{self, Symbol};
use super::super::theme::Theme;
use crate::scene::Anchor;
use coupler_curves::geometry::{Point, Vector};

/// Draws the foot; the result is its height from the edge of the paper.
pub(super) fn draw(area: &impl Area, page: &CouplerGridPage, theme: &Theme) -> f64 {
    let paper = area.size();
    let (left, right) = (theme.border + theme.margin, paper.x - theme.border - theme.margin);
    let half = 0.49 * (right - left);
    let at = Point::new(left, paper.y - theme.border - 0.65 * theme.margin);
    // Some SVG viewers collapse consecutive spaces, but not an em space.
    let proportions = page.panel.caption.replace("  ", "\u{2003}");
    let proportions = theme.text_line(&proportions, at, Anchor::Start, theme.title_size, theme.ink);
    area.record(&proportions.with_italics(page.heading.symbols).fit_width(half));
    let line =
        |text: &str, y: f64| theme.text_line(text, Point::new(right, y), Anchor::End, theme.source_size, theme.grey);
    area.record(&line(&page.heading.titles(), at.y).fit_width_with_suffix(&page.heading.folio(), half));
    // The class and the range of the transmission angle, and the note.
    let facts = [page.panel.facts[0].as_str(), &page.panel.note];
    let facts = facts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" · ");
    if !facts.is_empty() {
        area.record(&line(&facts, at.y - 1.5 * theme.source_size).fit_width(half));
    }
    theme.border + 0.65 * theme.margin + 1.5 * theme.title_size
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
        .wrap(panel.size.x);
    let right = panel.corner.x + panel.size.x;
    let step = 1.45 * theme.note_size;
    let height = step * lines.len() as f64;
    let first = panel.corner.y + panel.size.y - height;
    for (k, line) in lines.iter().enumerate() {
        let at = Point::new(right, first + step * k as f64);
        let line = theme.text_line(line, at, Anchor::End, theme.note_size, theme.grey);
        area.record(&line.with_italics(symbols).fit_width(panel.size.x));
    }
    Rect { size: panel.size - Vector::new(0.0, height + 1.6 * step), ..panel }
}

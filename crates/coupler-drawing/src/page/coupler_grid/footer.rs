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

/// The distances of the lines of symbols and of those of the source, in ems.
const SYMBOL_LEADING: f64 = 1.6;
const SOURCE_LEADING: f64 = 1.45;

/// The height of the symbols at the foot of a panel of a width, with the space above them.
pub(super) fn symbols_height(symbols: &[Symbol], width: f64, theme: &Theme) -> f64 {
    let lines = symbols::lines(symbols, width, theme).len();
    if lines == 0 { 0.0 } else { SYMBOL_LEADING * theme.note_size * (lines as f64 + 0.5) }
}

/// Draws the symbols of the figure at the foot of a panel, in as many lines as needed; the result is the rest of the panel.
pub(super) fn draw_symbols(area: &impl Area, panel: Rect, symbols: &[Symbol], theme: &Theme) -> Rect {
    let lines = symbols::lines(symbols, panel.size.x, theme);
    let step = SYMBOL_LEADING * theme.note_size;
    let first = panel.corner.y + panel.size.y - step * lines.len().saturating_sub(1) as f64;
    for (k, line) in lines.iter().enumerate() {
        symbols::draw(area, line, Point::new(panel.corner.x, first + step * k as f64), theme);
    }
    Rect { size: panel.size - Vector::new(0.0, symbols_height(symbols, panel.size.x, theme)), ..panel }
}

/// The lines of the source, if there is one.
fn source_lines(page: &CouplerGridPage, width: f64, theme: &Theme) -> Vec<TextLine> {
    let line = |text: &str| theme.text_line(text, Point::origin(), Anchor::End, theme.note_size, theme.grey);
    let words = line(&page.heading.source).wrap_at_separators(width);
    words.iter().map(|words| line(words).with_italics(page.heading.symbols).fit_width(width)).collect()
}

/// The height of the source at the foot of a panel of a width, with the space above it.
pub(super) fn source_height(page: &CouplerGridPage, width: f64, theme: &Theme) -> f64 {
    let lines = source_lines(page, width, theme).len();
    if lines == 0 { 0.0 } else { SOURCE_LEADING * theme.note_size * (lines as f64 + 1.6) }
}

/// Draws the source, if there is one, at the foot of a panel, in as many lines as needed; the result is the rest of the
/// panel.
pub(super) fn draw_source(area: &impl Area, panel: Rect, page: &CouplerGridPage, theme: &Theme) -> Rect {
    let lines = source_lines(page, panel.size.x, theme);
    let step = SOURCE_LEADING * theme.note_size;
    let first = panel.corner + panel.size - Vector::new(0.0, step * lines.len() as f64);
    for (k, line) in lines.into_iter().enumerate() {
        area.record(line.moved_to(first + Vector::new(0.0, step * k as f64)));
    }
    Rect { size: panel.size - Vector::new(0.0, source_height(page, panel.size.x, theme)), ..panel }
}

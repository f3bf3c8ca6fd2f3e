//! The `panels` layout: a grid of cells, each with its figure, number and caption.

use super::area::Area;
use super::arrangement::{Arrangement, Extents, Rect};
use super::element::Drawing;
use super::figure::Figure;
use super::heading::margins;
use super::theme::Theme;
use super::{Options, Panel, PanelPage, Paper};
use crate::scene::{Anchor, Color, Item};
use coupler_curves::geometry::{Point, Vector};
use coupler_curves::solve::SolvedCell;

pub(super) fn compose(root: &impl Area, page: &PanelPage, options: &Options, theme: &Theme) {
    page.heading.draw(root, theme);
    draw_panels(root, page, options, theme);
}

fn draw_panels<A: Area>(root: &A, page: &PanelPage, options: &Options, theme: &Theme) {
    let [top, bottom, side] = margins(theme);
    let [columns, rows] = page.layout.grid();
    let areas = root.without_margins([top, bottom, side, side]).grid_cells(rows, columns);
    let theme = &theme.for_panel_size(areas[0].size());
    let figures: Vec<Option<Figure>> = page.panels.iter().map(Figure::from_panel).collect();
    let facts = FactsLayout::for_page(page, areas[0].size().x - 1.2 * theme.caption_size, theme);
    let has_notes =
        page.panels.iter().any(|panel| !panel.note.is_empty() || panel.solved_cell.motion.assembly_error.is_some());
    let lines = f64::from(u8::from(has_notes) + facts.line_count());
    let foot = theme.caption_size * 1.5 + lines * theme.note_size * 1.5 + 2.2 * theme.caption_size;
    // One arrangement fits all panels: a page is split to within a hundredth of a millimetre.
    let figure_rect = |area: &A| {
        let gap = 1.2 * theme.caption_size;
        let size = area.size() - Vector::new(gap, 0.0) - Vector::new(gap, foot);
        Rect { corner: Point::new(gap, 0.0), size: size.sup(&Vector::new(1.0, 1.0)) }
    };
    let extents: Vec<Extents> = figures.iter().flatten().map(|figure| figure.extents).collect();
    let arrangement = Arrangement::best(figure_rect(&areas[0]), 2.0 * theme.joint_radius, &extents);
    for ((panel, figure), area) in page.panels.iter().zip(&figures).zip(&areas) {
        let frame = figure_rect(area);
        match figure {
            Some(figure) => figure.draw(area, frame, arrangement, page, (options, theme)),
            None => {
                draw_not_assembled(area, frame, panel.solved_cell, theme);
            }
        }
        draw_caption(area, (foot, facts), panel, page.heading.symbols, theme);
    }
}

/// The number of lines for the facts of a cell, the same for all cells of a page.
#[derive(Clone, Copy, PartialEq, Eq)]
enum FactsLayout {
    None,
    OneLine,
    TwoLines,
}

impl FactsLayout {
    /// One line if the facts of every panel fit `width` at no less than 85 % of their size; otherwise two.
    fn for_page(page: &PanelPage, width: f64, theme: &Theme) -> FactsLayout {
        const MIN_SCALE: f64 = 0.85;
        let texts = || page.panels.iter().flat_map(|panel| FactsLayout::OneLine.panel_lines(panel));
        let natural = |text: String| {
            theme.text_line(&text, Point::origin(), Anchor::Middle, theme.note_size, theme.grey).text.width()
        };
        match texts().map(natural).fold(0.0, f64::max) {
            0.0 => FactsLayout::None,
            widest if MIN_SCALE * widest <= width => FactsLayout::OneLine,
            _ => FactsLayout::TwoLines,
        }
    }

    fn line_count(self) -> u8 {
        match self {
            FactsLayout::None => 0,
            FactsLayout::OneLine => 1,
            FactsLayout::TwoLines => 2,
        }
    }

    /// The lines of facts under a panel.
    fn panel_lines(self, panel: &Panel) -> Vec<String> {
        let parts = panel.facts.iter().filter(|part| !part.is_empty()).cloned();
        match self {
            FactsLayout::None => Vec::new(),
            FactsLayout::OneLine => vec![parts.collect::<Vec<_>>().join(" · ")],
            FactsLayout::TwoLines => parts.collect(),
        }
    }
}

/// The most columns and rows of panels on a page: at its smallest, a panel has four lines of text under a figure five
/// lines high.
pub(super) fn max_grid(paper: Paper, theme: &Theme) -> [usize; 2] {
    let [top, bottom, side] = margins(theme);
    let theme = theme.for_panel_size(Vector::zeros());
    let fit = |length: f64, least: f64| ((length / least).floor() as usize).max(1);
    [
        fit(paper.width - 2.0 * side, 5.0 * theme.caption_size),
        fit(paper.height - top - bottom, 10.5 * theme.caption_size),
    ]
}

/// Draws the cell's number at the upper left, and its lines of text at the foot.
fn draw_caption(area: &impl Area, (foot, facts): (f64, FactsLayout), panel: &Panel, symbols: &[String], theme: &Theme) {
    let panel_size = area.size();
    let number = panel.solved_cell.cell.number.to_string();
    let at = Point::new(0.8 * theme.caption_size, theme.note_size);
    area.record(&theme.text_line(&number, at, Anchor::Start, theme.note_size, theme.grey));
    let width = panel_size.x - 1.2 * theme.caption_size;
    let mut y = panel_size.y - foot + 1.5 * theme.caption_size;
    let mut line = |text: &str, size: f64, color, symbols: &[String]| {
        let line = theme.text_line(text, Point::new(panel_size.x / 2.0, y), Anchor::Middle, size, color);
        area.record(&line.with_italics(symbols).fit_width(width));
        y += 1.45 * theme.note_size;
    };
    line(&panel.caption, theme.caption_size, theme.ink, symbols);
    if !panel.note.is_empty() {
        line(&panel.note, theme.note_size, theme.grey, symbols);
    }
    for text in facts.panel_lines(panel) {
        line(&text, theme.note_size, theme.grey, &[]);
    }
    let motion = &panel.solved_cell.motion;
    if let Some(error) = motion.assembly_error.as_ref().filter(|_| motion.is_assembled()) {
        line(&error.to_string(), theme.note_size, theme.curve_ink(0), &[]);
    }
}

/// Draws a message in place of a figure: the cell is not assembled, and the reason.
pub(super) fn draw_not_assembled(area: &impl Area, frame: Rect, cell: &SolvedCell, theme: &Theme) {
    let reason = cell.motion.assembly_error.as_ref().map_or("it has no curve".to_owned(), ToString::to_string);
    let centre = frame.centre();
    let text_line = |text: &str, size: f64, color: Color| {
        theme.text_line(text, Point::new(centre.x, 0.0), Anchor::Middle, size, color)
    };
    let mut lines = vec![text_line("not assembled", theme.caption_size, theme.curve_ink(0)).text];
    let reason = text_line(&reason, theme.note_size, theme.grey).wrap(0.9 * frame.size.x);
    lines.extend(reason.iter().map(|line| text_line(line, theme.note_size, theme.grey).text));
    let step = 1.5 * theme.note_size;
    let first = centre.y - step * (lines.len() - 1) as f64 / 2.0;
    for (k, text) in lines.iter_mut().enumerate() {
        text.position.y = first + step * k as f64;
    }
    let items = lines.into_iter().map(Item::Text).collect();
    area.record(&Drawing { class: "not-assembled", title: String::new(), items });
}

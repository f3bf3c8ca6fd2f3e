//! The `panels` layout: a grid of cells, each with its figure, its number and its caption.

use plotters::drawing::IntoDrawingArea;

use super::arrangement::{Arrangement, Extents, Frame};
use super::element::{Area, Drawing, draw, size};
use super::figure::Figure;
use super::heading::margins;
use super::theme::Theme;
use super::{Options, Panel, Paper, Sheet};
use crate::scene::{Anchor, Canvas, Color, Item, Scene};
use coupler_curves::geometry::{Point, Vector};

pub(super) fn compose(scene: &mut Scene, sheet: &Sheet, grid: (usize, usize), options: &Options, theme: &Theme) {
    let root = Canvas::new(scene).into_drawing_area();
    sheet.heading.draw(&root, theme);
    panels(&root, sheet, grid, options, theme);
}

fn panels(root: &Area, sheet: &Sheet, (columns, rows): (usize, usize), options: &Options, theme: &Theme) {
    let [top, bottom, side] = margins(theme).map(Canvas::pixels);
    let areas = root.margin(top, bottom, side, side).split_evenly((rows, columns));
    let theme = &theme.for_panels(size(&areas[0]));
    let figures: Vec<Option<Figure>> = sheet.panels.iter().map(Figure::of).collect();
    let facts = Facts::of(sheet, size(&areas[0]).x - 1.2 * theme.caption, theme);
    let has_notes = sheet.panels.iter().any(|panel| !panel.note.is_empty() || panel.solved.motion.shortfall.is_some());
    let lines = f64::from(u8::from(has_notes) + facts.lines());
    let foot = theme.caption * 1.5 + lines * theme.note * 1.5 + 2.2 * theme.caption;
    // The figure's frame is that of any panel: plotters splits a page to within a hundredth of a millimetre.
    let room = |area: &Area| {
        let gap = 1.2 * theme.caption;
        let size = size(area) - Vector::new(gap, 0.0) - Vector::new(gap, foot);
        Frame { corner: Point::new(gap, 0.0), size: size.sup(&Vector::new(1.0, 1.0)) }
    };
    let extents: Vec<Extents> = figures.iter().flatten().map(|figure| figure.extents).collect();
    let arrangement = Arrangement::best(room(&areas[0]), 2.0 * theme.joint, &extents);
    for ((panel, figure), area) in sheet.panels.iter().zip(&figures).zip(&areas) {
        let frame = room(area);
        match figure {
            Some(figure) => figure.draw(area, frame, arrangement, sheet, (options, theme)),
            None => {
                let reason = panel.solved.motion.shortfall.as_deref().unwrap_or("no curve is kept");
                draw_reason(area, frame, reason, theme);
            }
        }
        caption(area, (foot, facts), panel, sheet.heading.symbols, theme);
    }
}

/// How the facts of the cells of a page are set: all in as many lines.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Facts {
    None,
    OneLine,
    TwoLines,
}

impl Facts {
    /// One line, if every panel's fits a width without being set much smaller.
    fn of(sheet: &Sheet, width: f64, theme: &Theme) -> Facts {
        const SMALLER: f64 = 0.85;
        let texts = || sheet.panels.iter().flat_map(|panel| Facts::OneLine.texts(panel));
        let natural =
            |text: String| theme.words(&text, Point::origin(), Anchor::Middle, theme.note, theme.grey).text.width();
        match texts().map(natural).fold(0.0, f64::max) {
            0.0 => Facts::None,
            widest if SMALLER * widest <= width => Facts::OneLine,
            _ => Facts::TwoLines,
        }
    }

    fn lines(self) -> u8 {
        match self {
            Facts::None => 0,
            Facts::OneLine => 1,
            Facts::TwoLines => 2,
        }
    }

    /// The lines of a panel.
    fn texts(self, panel: &Panel) -> Vec<String> {
        let parts = panel.facts.iter().filter(|part| !part.is_empty()).cloned();
        match self {
            Facts::None => Vec::new(),
            Facts::OneLine => vec![parts.collect::<Vec<_>>().join(" · ")],
            Facts::TwoLines => parts.collect(),
        }
    }
}

/// The most columns and rows: set as small as it may be, a panel has four lines under a figure of five.
pub(super) fn most(paper: Paper, theme: &Theme) -> [usize; 2] {
    let [top, bottom, side] = margins(theme);
    let theme = theme.for_panels(Vector::zeros());
    let fit = |room: f64, least: f64| ((room / least).floor() as usize).max(1);
    [fit(paper.width - 2.0 * side, 5.0 * theme.caption), fit(paper.height - top - bottom, 10.5 * theme.caption)]
}

/// The cell's number at its upper left, and its lines below.
fn caption(area: &Area, (foot, facts): (f64, Facts), panel: &Panel, symbols: &[String], theme: &Theme) {
    let page = size(area);
    let number = panel.solved.cell.number.to_string();
    let at = Point::new(0.8 * theme.caption, theme.note);
    draw(area, &theme.words(&number, at, Anchor::Start, theme.note, theme.grey));
    let width = page.x - 1.2 * theme.caption;
    let mut y = page.y - foot + 1.5 * theme.caption;
    let mut line = |text: &str, size: f64, color, symbols: &[String]| {
        let words = theme.words(text, Point::new(page.x / 2.0, y), Anchor::Middle, size, color);
        draw(area, &words.italic(symbols).fitted(width));
        y += 1.45 * theme.note;
    };
    line(&panel.caption, theme.caption, theme.ink, symbols);
    if !panel.note.is_empty() {
        line(&panel.note, theme.note, theme.grey, symbols);
    }
    for text in facts.texts(panel) {
        line(&text, theme.note, theme.grey, &[]);
    }
    if let (Some(reason), true) = (&panel.solved.motion.shortfall, panel.solved.motion.is_assembled()) {
        line(reason, theme.note, theme.curve_ink(0), &[]);
    }
}

/// Where there is no curve to draw: that it cannot be assembled, and why.
pub(super) fn draw_reason(area: &Area, frame: Frame, reason: &str, theme: &Theme) {
    let centre = frame.centre();
    let words =
        |text: &str, size: f64, color: Color| theme.words(text, Point::new(centre.x, 0.0), Anchor::Middle, size, color);
    let mut lines = vec![words("not assembled", theme.caption, theme.curve_ink(0)).text];
    let reason = words(reason, theme.note, theme.grey).wrapped(0.9 * frame.size.x);
    lines.extend(reason.iter().map(|line| words(line, theme.note, theme.grey).text));
    let step = 1.5 * theme.note;
    let first = centre.y - step * (lines.len() - 1) as f64 / 2.0;
    for (k, text) in lines.iter_mut().enumerate() {
        text.at.y = first + step * k as f64;
    }
    let items = lines.into_iter().map(Item::Text).collect();
    draw(area, &Drawing { class: "not-assembled", title: String::new(), items });
}

//! The division of a page: the figure, and next to it or below it the panel with the key, the table and the graphs.

use super::super::rect::Rect;
use super::super::theme::Theme;
use coupler_curves::geometry::Vector;

/// The frames of a page between its margins and its foot.
pub(super) struct PageLayout {
    pub figure: Rect,
    pub panel: Rect,
}

/// The width of the panel next to the figure in ems of its notes, with which all columns and graphs fit.
const PANEL_WIDTH: f64 = 57.5;

/// The greatest part of the width that the panel has next to the figure.
const MAX_PANEL_WIDTH_PART: f64 = 0.455;

/// The part of the height that the panel has below the figure, at least, and at most where its table needs more.
const PANEL_HEIGHT_PARTS: [f64; 2] = [0.46, 0.64];

/// The ratio of width to height from which the panel is next to the figure.
const MIN_SIDE_BY_SIDE: f64 = 1.15;

/// The gap between figure and panel, in ems of a note: it separates the dashes of curves from those in the table.
const GUTTER: f64 = 2.0;

impl PageLayout {
    /// The division of a frame; `theme` is that of the panel, which needs a height where it is below the figure.
    pub fn new(whole: Rect, panel_height: impl Fn(f64) -> f64, theme: &Theme) -> PageLayout {
        let gutter = GUTTER * theme.note_size;
        let split = if is_side_by_side(whole.size) {
            let panel = (PANEL_WIDTH * theme.note_size).min(MAX_PANEL_WIDTH_PART * whole.size.x);
            Vector::new(whole.size.x - panel, 0.0)
        } else {
            let [least, most] = PANEL_HEIGHT_PARTS.map(|part| part * whole.size.y);
            Vector::new(0.0, whole.size.y - panel_height(whole.size.x).clamp(least, most))
        };
        let is_beside = split.x > 0.0;
        let figure_size = if is_beside {
            Vector::new(split.x - gutter, whole.size.y)
        } else {
            Vector::new(whole.size.x, split.y - gutter)
        };
        PageLayout {
            figure: Rect { size: figure_size, ..whole },
            panel: Rect { corner: whole.corner + split, size: whole.size - split },
        }
    }

    /// The greatest width of the panel on a page of a size, about.
    pub fn max_panel_width(page: Vector) -> f64 {
        if is_side_by_side(page) { MAX_PANEL_WIDTH_PART * page.x } else { page.x }
    }
}

fn is_side_by_side(size: Vector) -> bool {
    size.x >= MIN_SIDE_BY_SIDE * size.y
}

/// The parts of the panel, from top to bottom; its source is below them.
pub(super) struct PanelLayout {
    /// The key, with the description of the linkage.
    pub key: Rect,
    /// The table with its heads.
    pub table: Rect,
    /// The height of a row of the table.
    pub row_height: f64,
    /// The transmission angle, and next to it the notes; as high as both need, or nothing if there is no space.
    pub foot: Rect,
}

/// Heights in ems of a note.
const KEY_HEIGHTS: [f64; 2] = [8.0, 22.0];
const ROW_HEIGHTS: [f64; 2] = [1.35, 4.8];
/// The heads of the table, in two lines.
pub(super) const HEAD_HEIGHT: f64 = 3.6;
/// The numbers under the graphs.
pub(super) const AXIS_HEIGHT: f64 = 1.9;
/// The least height of the transmission angle.
pub(super) const STRIP_HEIGHT: f64 = 8.0;

impl PanelLayout {
    /// The height of a key and a table of some rows, at least.
    pub fn least_height(row_count: usize, theme: &Theme) -> f64 {
        (KEY_HEIGHTS[0] + HEAD_HEIGHT + AXIS_HEIGHT + ROW_HEIGHTS[0] * row_count as f64) * theme.note_size
    }

    /// The division of a panel for a table of some rows, with a description next to the key and a foot of these heights, if there is
    /// space.
    pub fn new(panel: Rect, row_count: usize, [description, foot_height]: [f64; 2], theme: &Theme) -> PanelLayout {
        let em = theme.note_size;
        let rows = row_count.max(1) as f64;
        let key = (0.25 * panel.size.y).clamp(KEY_HEIGHTS[0] * em, KEY_HEIGHTS[1] * em);
        let least_table = (HEAD_HEIGHT + AXIS_HEIGHT + ROW_HEIGHTS[0] * rows) * em;
        // The description is as high as it needs to be, at the expense of the table.
        let spare = panel.size.y - foot_height - least_table;
        let key = key.max(description.min(spare)).min(0.5 * panel.size.y);
        let rest = panel.size.y - key;
        let foot = if least_table + foot_height <= rest { foot_height } else { 0.0 };
        let row = (rest - foot - (HEAD_HEIGHT + AXIS_HEIGHT) * em) / rows;
        let row = row.clamp(ROW_HEIGHTS[0] * em, ROW_HEIGHTS[1] * em);
        let table = ((HEAD_HEIGHT + AXIS_HEIGHT) * em + row * rows).min(rest - foot);
        let part = |from: f64, height: f64| Rect {
            corner: panel.corner + Vector::new(0.0, from),
            size: Vector::new(panel.size.x, height),
        };
        PanelLayout { key: part(0.0, key), table: part(key, table), row_height: row, foot: part(key + table, foot) }
    }
}

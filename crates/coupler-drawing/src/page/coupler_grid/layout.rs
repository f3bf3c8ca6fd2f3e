//! The division of a page: the figure, and next to it or below it the panel with the key, the table and the graphs.

use super::super::rect::Rect;
use super::super::theme::Theme;
use super::table::Table;
use coupler_curves::geometry::Vector;

/// The frames of a page between its margins and its foot.
pub(super) struct PageLayout {
    pub figure: Rect,
    pub panel: Rect,
}

/// The width of the panel next to the figure in ems of its notes, with which all columns and graphs fit.
const PANEL_WIDTH: f64 = 57.5;

/// The greatest part of the width that the panel has next to the figure; and that on small paper, where it would be narrower than
/// some ems.
const MAX_PANEL_WIDTH_PARTS: [f64; 2] = [0.455, 0.5];
const MIN_PANEL_WIDTH: f64 = 24.0;

/// The part of the height that the panel has below the figure, at least, and at most where its table needs more.
const PANEL_HEIGHT_PARTS: [f64; 2] = [0.46, 0.7];

/// The ratio of width to height from which the panel is next to the figure; and that on paper of fewer ems than this, where a panel
/// below it would leave no room to the figure.
const MIN_SIDE_BY_SIDE: [f64; 2] = [1.15, 1.0];
const SMALL_WIDTH: f64 = 60.0;

/// The gap between figure and panel, in ems of a note: it separates the dashes of curves from those in the table.
const GUTTER: f64 = 2.0;

impl PageLayout {
    /// The width of the panel in a frame of a size.
    pub fn panel_width(whole: Vector, theme: &Theme) -> f64 {
        let em = theme.note_size;
        if !is_side_by_side(whole, theme) {
            return whole.x;
        }
        let [usual, most] = MAX_PANEL_WIDTH_PARTS.map(|part| part * whole.x);
        (PANEL_WIDTH * em).min(usual.max((MIN_PANEL_WIDTH * em).min(most)))
    }

    /// The division of a frame; `theme` is that of the panel, which needs a height where it is below the figure.
    pub fn new(whole: Rect, panel_height: f64, theme: &Theme) -> PageLayout {
        let gutter = GUTTER * theme.note_size;
        let beside = whole.size.x - PageLayout::panel_width(whole.size, theme);
        let is_beside = beside > 0.0;
        let split = if is_beside {
            Vector::new(beside, 0.0)
        } else {
            let [least, most] = PANEL_HEIGHT_PARTS.map(|part| part * whole.size.y);
            Vector::new(0.0, whole.size.y - panel_height.clamp(least, most))
        };
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
}

fn is_side_by_side(size: Vector, theme: &Theme) -> bool {
    let [usual, on_small_paper] = MIN_SIDE_BY_SIDE;
    let is_small = size.x < SMALL_WIDTH * theme.note_size;
    size.x >= size.y * if is_small { on_small_paper } else { usual }
}

/// The parts of the panel, from top to bottom; its source is below them.
pub(super) struct PanelLayout {
    /// The key, with the description of the linkage.
    pub key: Rect,
    /// The table with its heads.
    pub table: Rect,
    /// The height of a row of the table.
    pub row_height: f64,
    /// The transmission angle, and next to it the notes; as high as both need, or what is left.
    pub foot: Rect,
}

/// Heights in ems of a note.
const KEY_HEIGHTS: [f64; 2] = [8.0, 22.0];
const MAX_ROW_HEIGHT: f64 = 4.8;
/// The least height of the transmission angle.
pub(super) const STRIP_HEIGHT: f64 = 8.0;

impl PanelLayout {
    /// The width of the description next to the key in a panel of a width.
    pub fn description_width(panel_width: f64, theme: &Theme) -> f64 {
        0.5 * panel_width - theme.note_size
    }

    /// The height of a key next to a description of a height, and a table of a least height.
    pub fn least_height(description: f64, table: f64, theme: &Theme) -> f64 {
        description.max(KEY_HEIGHTS[0] * theme.note_size) + table
    }

    /// The division of a panel for a table, with a description next to the key of a height, and a foot that is as high as it needs to
    /// be if there is space, or else has what is left.
    pub fn new(panel: Rect, table: &Table, [description, foot_height]: [f64; 2], theme: &Theme) -> PanelLayout {
        let em = theme.note_size;
        let rows = table.row_count() as f64;
        let [around_rows, least_table] = [table.height_around_rows(theme), table.least_height(theme)];
        let key = (0.25 * panel.size.y).clamp(KEY_HEIGHTS[0] * em, KEY_HEIGHTS[1] * em);
        // The description is as high as it needs to be, at the expense of the rows, and then of the foot.
        let key = key.max(description.min(panel.size.y - least_table)).min(0.5 * panel.size.y);
        let rest = panel.size.y - key;
        let foot = foot_height.min((rest - least_table).max(0.0));
        let least_row = (least_table - around_rows) / rows;
        let row = ((rest - foot - around_rows) / rows).clamp(least_row, MAX_ROW_HEIGHT * em);
        let table = (around_rows + row * rows).min(rest - foot);
        let part = |from: f64, height: f64| Rect {
            corner: panel.corner + Vector::new(0.0, from),
            size: Vector::new(panel.size.x, height),
        };
        PanelLayout { key: part(0.0, key), table: part(key, table), row_height: row, foot: part(key + table, foot) }
    }
}

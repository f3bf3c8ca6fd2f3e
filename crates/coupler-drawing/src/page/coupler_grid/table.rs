//! The table of the points of a page: their coordinates on the link, what is measured of their curves, and graphs of
//! their speeds.

use super::super::CouplerGridPage;
use super::super::area::Area;
use super::super::element::Drawing;
use super::super::rect::Rect;
use super::super::theme::Theme;
use super::columns::{ColumnGroup, column_groups, fitting_columns};
use super::shown_curve::ShownCurve;
use crate::scene::{Anchor, Circle, Item, Path, Polyline, Stroke};
use coupler_curves::geometry::{Point, Vector};

/// The table of a page, with the positions of its columns.
pub(super) struct Table {
    /// The groups of columns, each with its left edge relative to that of the table.
    groups: Vec<(f64, ColumnGroup)>,
    /// The left edge of the graphs, relative to that of the table; `None` if there is no space for them.
    graph_left: Option<f64>,
    row_count: usize,
}

/// The heights of the heads, in two lines or one, of the numbers under the graphs, and of a row at least, in ems of a note.
const HEAD_HEIGHTS: [f64; 2] = [3.6, 2.25];
pub(super) const AXIS_HEIGHT: f64 = 1.9;
const MIN_ROW_HEIGHT: f64 = 1.35;

/// The length of a swatch, and the least width of the graphs, in ems.
const SWATCH_LENGTH: f64 = 2.4;
const MIN_GRAPH_WIDTH: f64 = 8.0;

impl Table {
    /// The table of a page that fits a width.
    pub fn new(page: &CouplerGridPage, width: f64, theme: &Theme) -> Table {
        let groups = column_groups(page, theme);
        let em = theme.note_size;
        let (groups, graph_left) = fitting_columns(groups, SWATCH_LENGTH * em, width, MIN_GRAPH_WIDTH * em, theme);
        Table { groups, graph_left, row_count: page.curve_indices.len() }
    }

    pub fn row_count(&self) -> usize {
        self.row_count.max(1)
    }

    fn head_height(&self, theme: &Theme) -> f64 {
        let is_double = self.graph_left.is_some() || self.groups.iter().any(|(_, group)| !group.title.is_empty());
        let [double, single] = HEAD_HEIGHTS;
        theme.note_size * if is_double { double } else { single }
    }

    /// The height of the heads, and of the numbers under the graphs.
    pub fn height_around_rows(&self, theme: &Theme) -> f64 {
        let axis = if self.graph_left.is_some() { AXIS_HEIGHT } else { 0.0 };
        self.head_height(theme) + axis * theme.note_size
    }

    /// The least height with all rows.
    pub fn least_height(&self, theme: &Theme) -> f64 {
        self.height_around_rows(theme) + MIN_ROW_HEIGHT * theme.note_size * self.row_count() as f64
    }

    /// The left edge of the graphs, relative to that of the table; `None` if there is no space for them.
    pub fn graph_left(&self) -> Option<f64> {
        self.graph_left
    }

    /// Whether there is a group of columns with a title.
    pub fn has_group(&self, title: &str) -> bool {
        self.groups.iter().any(|(_, group)| group.title == title)
    }

    /// Draws the table; the result is the frames of the graphs of the rows that are shown, in order.
    pub fn draw(
        &self,
        area: &impl Area,
        frame: Rect,
        row_height: f64,
        shown: &[ShownCurve],
        theme: &Theme,
    ) -> Vec<Rect> {
        let em = theme.note_size;
        let top = frame.corner.y + self.head_height(theme);
        self.draw_heads(area, Point::new(frame.corner.x, top), theme);
        let rule = [frame.corner.x, frame.corner.x + frame.size.x].map(|x| Point::new(x, top));
        let rule = Item::Path(Path::stroked(rule.to_vec(), theme.stroke(theme.hairline, theme.hair_width)));
        area.record(Drawing { class: "rule", title: String::new(), items: vec![rule] });
        let row_count = ((frame.corner.y + frame.size.y - top) / row_height + 1e-9).floor().max(1.0) as usize;
        let mut graphs = Vec::new();
        for (k, s) in shown.iter().enumerate() {
            let row = Rect {
                corner: Point::new(frame.corner.x, top + row_height * k as f64),
                size: Vector::new(frame.size.x, row_height),
            };
            // The capitals are in the middle of the row.
            let y = row.centre().y + 0.36 * em;
            if k + 1 >= row_count && k + 1 < shown.len() {
                let rest = format!("and {} more", shown.len() - k);
                area.record(theme.text_line(&rest, Point::new(row.corner.x, y), Anchor::Start, em, theme.grey));
                break;
            }
            area.record(swatch(Point::new(row.corner.x, row.centre().y), s, theme));
            self.draw_row(area, k, s, Point::new(row.corner.x, y), theme);
            graphs.extend(self.graph_left.map(|left| Rect {
                corner: row.corner + Vector::new(left, 0.0),
                size: row.size - Vector::new(left, 0.0),
            }));
        }
        graphs
    }

    /// Draws the heads above a corner.
    fn draw_heads(&self, area: &impl Area, corner: Point, theme: &Theme) {
        let em = theme.note_size;
        let text = |text: &str, x: f64, line: f64, anchor: Anchor| {
            let at = Point::new(corner.x + x, corner.y - (0.55 + 1.35 * (1.0 - line)) * em);
            area.record(theme.text_line(text, at, anchor, em, theme.grey));
        };
        for (left, group) in &self.groups {
            if !group.title.is_empty() {
                text(&group.title, left + group.width(), 0.0, Anchor::End);
            }
            for column in &group.columns {
                text(column.head, left + column.right, 1.0, Anchor::End);
            }
        }
    }

    fn draw_row(&self, area: &impl Area, row: usize, shown: &ShownCurve, at: Point, theme: &Theme) {
        for (k, (left, group)) in self.groups.iter().enumerate() {
            let color = if k == 0 { shown.text_ink(theme) } else { theme.grey };
            for column in &group.columns {
                let at = at + Vector::new(left + column.right, 0.0);
                area.record(theme.text_line(&column.texts[row], at, Anchor::End, theme.note_size, color));
            }
        }
    }
}

/// Two dashes of the curve, and its point.
fn swatch(at: Point, shown: &ShownCurve, theme: &Theme) -> Drawing {
    let ink = shown.ink(theme);
    let length = SWATCH_LENGTH * theme.note_size;
    let line = |from: f64, to: f64| Polyline {
        points: vec![at + Vector::new(from * length, 0.0), at + Vector::new(to * length, 0.0)],
        is_closed: false,
    };
    let drawn = 0.5 * theme.curve_dash_fraction(shown.point_index);
    let lines = vec![line(0.0, drawn), line(0.5, 0.5 + drawn)];
    let path =
        |polylines: Vec<Polyline>, stroke: Stroke| Item::Path(Path { polylines, stroke: Some(stroke), fill: None });
    let mut items =
        vec![path(vec![line(0.0, 1.0)], shown.hairline(theme)), path(lines, theme.curve_stroke(shown.point_index))];
    let fill = Some(if shown.has_underline(theme) { ink } else { theme.paper });
    let centre = at + Vector::new(length, 0.0);
    let stroke = Some(theme.stroke(ink, theme.fine_width));
    items.push(Item::Circle(Circle { centre, radius: 0.8 * theme.joint_radius, stroke, fill }));
    Drawing { class: "swatch", title: String::new(), items }
}

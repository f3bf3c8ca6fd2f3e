//! The key: the bare linkage in its pose, small, with the letters of its links.

use super::super::GridSheet;
use super::super::arrangement::Frame;
use super::super::element::{Area, Drawing, draw as put};
use super::super::mechanism::Mechanism;
use super::super::theme::Theme;
use crate::geometry::{Bounds, Point, Similarity, Vector, cross, left_normal};
use crate::linkage::JointId;
use crate::scene::{Anchor, Item, Line, Path};

/// Draws it at the head of a column, and gives what is left of the column.
pub(super) fn draw(area: &Area, side: Frame, sheet: &GridSheet, mechanism: &Mechanism, theme: &Theme) -> Frame {
    let labels = sheet.labels;
    if labels.is_empty() {
        return side;
    }
    let pose = |joint: JointId| mechanism.pose[joint];
    let bounds = Bounds::of(labels.iter().flat_map(|label| label.ends.map(pose)));
    let letter = 1.1 * theme.note;
    let height = 0.19 * side.size.y;
    // Letters stand outside the links, all round.
    let room = Frame { corner: side.corner, size: Vector::new(side.size.x, height) }.inset(1.4 * letter);
    let page_from_plane = Similarity::page_from_plane(bounds, room.centre(), room.scale(bounds));
    let at = |joint: JointId| page_from_plane.apply(pose(joint));
    let centre = page_from_plane.apply(bounds.centre());
    let mut items = Vec::new();
    let mut letters = Vec::new();
    let ground = sheet.panel.solved.linkage.ground();
    for label in labels {
        let [a, b] = label.ends.map(at);
        let is_frame = label.ends.iter().all(|&joint| ground.place(joint).is_some());
        let lines = if is_frame { dashed(a, b, 0.5 * letter) } else { vec![line(a, b)] };
        let stroke = Some(theme.stroke(theme.grey, theme.fine));
        items.push(Item::Path(Path { lines, stroke, fill: None }));
        // On the side that is away from the middle of the linkage.
        let middle = nalgebra::center(&a, &b);
        let normal = left_normal(b - a).try_normalize(0.0).unwrap_or(Vector::new(0.0, -1.0));
        let outward = if cross(b - a, centre - a) > 0.0 { -normal } else { normal };
        let baseline = middle + outward * (0.95 * letter) + Vector::new(0.0, 0.36 * letter);
        letters.push(theme.words(&label.text, baseline, Anchor::Middle, letter, theme.grey));
    }
    put(area, &Drawing { class: "key", title: String::new(), items });
    for letter in letters {
        put(area, &letter.italic(sheet.heading.symbols));
    }
    Frame { corner: side.corner + Vector::new(0.0, height), size: side.size - Vector::new(0.0, height) }
}

fn line(a: Point, b: Point) -> Line {
    Line { points: vec![a, b], closed: false }
}

/// A dashed line that begins and ends with a dash.
fn dashed(a: Point, b: Point, dash: f64) -> Vec<Line> {
    let dashes = (((b - a).norm() / dash).ceil().clamp(1.0, 200.0) / 2.0).floor() * 2.0 + 1.0;
    let at = |k: f64| a + (b - a) * (k / dashes);
    (0..dashes as usize).step_by(2).map(|k| line(at(k as f64), at(k as f64 + 1.0))).collect()
}

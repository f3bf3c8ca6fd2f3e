//! The key: a small drawing of the linkage in its pose, with the names of its links.

use super::super::area::Area;
use super::super::arrangement::Rect;
use super::super::element::{Drawing, TextLine};
use super::super::labels::{self, LabelBox, Obstacles};
use super::super::mechanism::PosedMechanism;
use super::super::theme::Theme;
use super::super::{CouplerGridPage, LinkLabel};
use crate::scene::{Anchor, Item, Path, Polyline};
use coupler_curves::geometry::{Bounds, Point, Similarity, Vector, cross, left_normal};
use coupler_curves::linkage::{JointId, is_plate};

/// Draws the key at the head of a column; the result is the rest of the column.
pub(super) fn draw(
    area: &impl Area,
    side: Rect,
    page: &CouplerGridPage,
    mechanism: &PosedMechanism,
    theme: &Theme,
) -> Rect {
    let linkage = &page.panel.solved_cell.linkage;
    let pose = |joint: &JointId| mechanism.pose[*joint];
    let (links, pivots) = (linkage.link_outlines(), linkage.pivots());
    let bounds = Bounds::from_points(links.iter().flat_map(|outline| &outline.joints).chain(&pivots).map(pose));
    let letter = 1.1 * theme.note_size;
    let height = 0.19 * side.size.y;
    // Labels need space outside the links on all sides.
    let widest = page.labels.iter().map(|label| label_text(label, theme, letter).text.width()).fold(letter, f64::max);
    let frame = Rect { corner: side.corner, size: Vector::new(side.size.x, height) };
    let frame = Rect {
        corner: frame.corner + Vector::new(widest + 0.6 * letter, 1.4 * letter),
        size: (frame.size - Vector::new(2.0 * widest + 1.2 * letter, 2.8 * letter)).sup(&Vector::repeat(letter)),
    };
    let page_from_plane = Similarity::page_from_plane(bounds, frame.centre(), frame.fit_scale(bounds));
    let at = |joint: &JointId| page_from_plane.apply(pose(joint));
    let stroke = Some(theme.stroke(theme.grey, theme.fine_width));
    let path = |lines| Item::Path(Path { polylines: lines, stroke, fill: None });
    let pairs = |joints: &[JointId]| joints.windows(2).map(|pair| [at(&pair[0]), at(&pair[1])]).collect::<Vec<_>>();
    let ground = pairs(&pivots).into_iter().flat_map(|[a, b]| dashed_line(a, b, 0.5 * letter)).collect();
    let mut items = vec![path(ground)];
    items.extend(links.iter().map(|link| {
        let points: Vec<Point> = link.joints.iter().map(at).collect();
        let closed = is_plate(&points);
        path(vec![Polyline { points, is_closed: closed }])
    }));
    let mut obstacles = Obstacles::default();
    obstacles.add(&items, false);
    area.record(&Drawing { class: "key", title: String::new(), items });

    let centre = page_from_plane.apply(bounds.centre());
    let is_fixed = |joint: &JointId| linkage.ground().position(*joint).is_some();
    // On the frame, only a label between two pivots names a link.
    let is_link =
        |label: &&LinkLabel| !label.joints.iter().all(is_fixed) || label.joints.iter().all(|end| pivots.contains(end));
    let mut placed: Vec<LabelBox> = Vec::new();
    for label in page.labels.iter().filter(is_link) {
        let ends = [at(&label.joints[0]), at(&label.joints[1])];
        let mut text = label_text(label, theme, letter).with_italics(page.heading.symbols);
        let half = Vector::new(text.text.width() / 2.0, 0.36 * letter);
        let is_free = |spot: &LabelBox| placed.iter().all(|other| spot.distance_to_box(other) > 0.25 * letter);
        let spots = label_boxes(ends, centre, half, 0.45 * letter).filter(is_free);
        // A label is left out if it would overlap another one everywhere.
        if let Some((_, spot)) = labels::clearest_box(spots, |spot| obstacles.clearance(spot, 0.3 * letter)) {
            placed.push(spot);
            text.text.position = spot.centre + Vector::new(0.0, half.y);
            area.record(&text);
        }
    }
    Rect { corner: side.corner + Vector::new(0.0, height), size: side.size - Vector::new(0.0, height) }
}

/// The candidate positions of a label next to a link, the best first: at the middle of the link, on the side away from
/// the `centre` of the linkage. The nearest corner or side of the box is at the distance `gap` from the link.
fn label_boxes([a, b]: [Point; 2], centre: Point, half: Vector, gap: f64) -> impl Iterator<Item = LabelBox> {
    let normal = left_normal(b - a).try_normalize(0.0).unwrap_or(Vector::new(0.0, -1.0));
    let outward = if cross(b - a, centre - a) > 0.0 { -normal } else { normal };
    let away = outward * (half.x * outward.x.abs() + half.y * outward.y.abs() + gap);
    let spot = move |(part, away): (f64, Vector)| LabelBox { centre: a + (b - a) * part + away, half_size: half };
    [0.5, 0.35, 0.65, 0.2, 0.8].into_iter().flat_map(move |part| [(part, away), (part, -away)]).map(spot)
}

fn label_text(label: &LinkLabel, theme: &Theme, size: f64) -> TextLine {
    theme.text_line(&label.text, Point::origin(), Anchor::Middle, size, theme.grey)
}

fn line(a: Point, b: Point) -> Polyline {
    Polyline { points: vec![a, b], is_closed: false }
}

/// A dashed line that starts and ends with a dash.
fn dashed_line(a: Point, b: Point, dash: f64) -> Vec<Polyline> {
    let dashes = (((b - a).norm() / dash).ceil().clamp(1.0, 200.0) / 2.0).floor() * 2.0 + 1.0;
    let at = |k: f64| a + (b - a) * (k / dashes);
    (0..dashes as usize).step_by(2).map(|k| line(at(k as f64), at(k as f64 + 1.0))).collect()
}

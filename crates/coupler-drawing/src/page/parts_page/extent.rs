//! How much of the page items take.

use super::super::labels::LabelBox;
use crate::scene::{Anchor, Item, Text};
use coupler_curves::geometry::{Bounds, Point, Vector};

/// The bounds of items, with their texts.
pub(super) fn bounds(items: &[Item]) -> Bounds {
    let item_bounds = |item: &Item| match item {
        Item::Path(path) => Bounds::from_points(path.polylines.iter().flat_map(|line| line.points.iter().copied())),
        Item::Circle(circle) => {
            let radius = Vector::repeat(circle.radius);
            Bounds::from_points([circle.centre - radius, circle.centre + radius])
        }
        Item::Text(text) => Bounds::from_points(text_corners(text)),
        Item::Group(group) => bounds(&group.items),
        Item::Curve(_) | Item::Animation(_) => Bounds::EMPTY,
    };
    items.iter().map(item_bounds).fold(Bounds::EMPTY, Bounds::union)
}

/// The box of a text; `None` if an item is none.
pub(super) fn text_box(item: &Item) -> Option<LabelBox> {
    let Item::Text(text) = item else { return None };
    let [a, c] = text_corners(text);
    Some(LabelBox { centre: a + (c - a) / 2.0, half_size: (c - a) / 2.0 })
}

/// Two opposite corners of a text, which is upright or reads upwards.
pub(super) fn text_corners(text: &Text) -> [Point; 2] {
    /// How far letters are above and below their baseline, in ems.
    const EXTENT: [f64; 2] = [0.76, 0.24];
    let width = text.width();
    let start = match text.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => -width / 2.0,
        Anchor::End => -width,
    };
    let [above, below] = EXTENT.map(|part| part * text.size);
    match text.quarter_turns {
        0 => [text.position + Vector::new(start, -above), text.position + Vector::new(start + width, below)],
        _ => [text.position + Vector::new(-above, -start - width), text.position + Vector::new(below, -start)],
    }
}

//! The view of a part: its outline, holes and slots, their centre lines, letters and dimensions, under its name.

use super::super::element::translated;
use super::super::labels::{LabelPlacer, Obstacles};
use super::super::rect::Rect;
use super::super::theme::Theme;
use super::dimension::{Dimension, Direction, PITCH, length_text};
use super::extent::{bounds, text_box};
use super::group::Group;
use crate::scene::{Anchor, Circle, Item, Path, Polyline, Stroke};
use coupler_curves::geometry::{Bounds, Point, Similarity, Vector, trig};
use coupler_curves::parts::{Hole, Outline, Part, Sizes};

/// A view, whose upper left corner is the origin.
pub(super) struct PartView {
    pub size: Vector,
    items: Vec<Item>,
}

impl PartView {
    /// Its items, with its upper left corner at a point.
    pub fn placed(self, corner: Point) -> Vec<Item> {
        self.items.into_iter().map(|item| translated(item, corner.coords)).collect()
    }
}

/// The view of parts of one shape at a scale in millimetres to a unit.
pub(super) fn view(group: &Group, sizes: Sizes, scale: f64, theme: &Theme) -> PartView {
    let page_from_part = Similarity::with_y_down(scale, Point::origin());
    let part = group.part;
    let mut items = cut_items(part, sizes, &page_from_part, theme);
    // Those across are under the numbers of the others, too.
    for direction in [Direction::Up, Direction::Across] {
        let around = bounds(&items);
        let dimensions = dimensions(part, direction, around, &page_from_part, theme);
        items.extend(dimensions.iter().flat_map(|dimension| dimension.items(theme)));
    }
    let with_dimensions = bounds(&items);
    let size = theme.caption_size;
    // Letters may be around the outline.
    let room = Vector::repeat(1.5 * theme.note_size);
    let frame = Rect { corner: with_dimensions.min - room, size: with_dimensions.size() + room * 2.0 };
    items.extend(letters((part, sizes), &items, frame, &page_from_part, theme));
    let all = bounds(&items);
    let count = if group.names.len() > 1 { format!(" ({}×)", group.names.len()) } else { String::new() };
    let title = format!("{}{count}", group.names.join(", "));
    let at = Point::new(all.centre().x, all.min.y - 0.6 * size);
    items.push(Item::Text(theme.text_line(&title, at, Anchor::Middle, size, theme.ink).text));
    let all = bounds(&items);
    let items = items.into_iter().map(|item| translated(item, -all.min.coords)).collect();
    PartView { size: all.size(), items }
}

/// What is cut, with centre lines.
fn cut_items(part: &Part, sizes: Sizes, page_from_part: &Similarity, theme: &Theme) -> Vec<Item> {
    let heavy = theme.stroke(theme.ink, theme.fine_width);
    let fine = theme.stroke(theme.grey, theme.hair_width);
    let slots = part.slots.iter().map(|slot| slot.outline(sizes.hole));
    let radius = sizes.hole / 2.0;
    let holes = part.holes.iter().map(|hole| Outline::Circle { centre: hole.centre, radius });
    let cuts = std::iter::once(part.outline.clone()).chain(slots).chain(holes);
    let mut items: Vec<Item> = cuts.map(|outline| outline_item(&outline, page_from_part, heavy)).collect();
    let arm = 1.6 * radius;
    let cross = |p: Point| [Vector::x(), Vector::y()].map(|axis| [p - axis * arm, p + axis * arm]);
    let marks = part.holes.iter().flat_map(|hole| cross(hole.centre)).chain(part.slots.iter().map(|slot| slot.ends));
    let polylines =
        marks.map(|ends| Polyline { points: ends.map(|p| page_from_part.apply(p)).to_vec(), is_closed: false });
    items.push(Item::Path(Path { polylines: polylines.collect(), stroke: Some(fine), fill: None }));
    items
}

/// An outline on the page.
fn outline_item(outline: &Outline, page_from_part: &Similarity, stroke: Stroke) -> Item {
    match outline {
        Outline::Circle { centre, radius } => Item::Circle(Circle {
            centre: page_from_part.apply(*centre),
            radius: radius * page_from_part.scale(),
            stroke: Some(stroke),
            fill: None,
        }),
        Outline::Path(_) => {
            let points = outline_points(outline).into_iter().map(|p| page_from_part.apply(p)).collect();
            let polylines = vec![Polyline { points, is_closed: true }];
            Item::Path(Path { polylines, stroke: Some(stroke), fill: None })
        }
    }
}

/// The vertices of an outline, with points on its arcs, which chords of 5 degrees leave by a thousandth of the radius.
fn outline_points(outline: &Outline) -> Vec<Point> {
    const STEP_DEG: f64 = 5.0;
    let Outline::Path(vertices) = outline else { return Vec::new() };
    let mut arcs = outline.arcs().into_iter();
    let mut points = Vec::new();
    for vertex in vertices {
        points.push(vertex.at);
        let Some((centre, _)) = (vertex.bulge != 0.0).then(|| arcs.next()).flatten() else { continue };
        let angle_deg = 4.0 * trig::degrees(trig::atan2(vertex.bulge, 1.0));
        let steps = (angle_deg / STEP_DEG).ceil();
        let arm = vertex.at - centre;
        for k in 1..steps as usize {
            let (cos, sin) = trig::cos_sin_deg(angle_deg * k as f64 / steps);
            points.push(centre + Vector::new(cos * arm.x - sin * arm.y, sin * arm.x + cos * arm.y));
        }
    }
    points
}

/// The dimensions in a direction of the holes and of the ends of slots: how far each is from the first hole, the shortest next to the view.
fn dimensions(
    part: &Part,
    direction: Direction,
    around: Bounds,
    page_from_part: &Similarity,
    theme: &Theme,
) -> Vec<Dimension> {
    let mut places: Vec<Point> = part.holes.iter().map(|hole| hole.centre).collect();
    places.extend(part.slots.iter().flat_map(|slot| slot.ends));
    let Some(first) = places.first().copied() else { return Vec::new() };
    let from_first = |p: &Point| if direction == Direction::Across { p.x - first.x } else { p.y - first.y };
    // Coordinates that differ by rounding are one.
    let rounding = 1e-9 * places.iter().map(|p| (p - first).norm()).fold(0.0, f64::max);
    places.retain(|p| from_first(p).abs() > rounding);
    places.sort_by(|a, b| from_first(a).total_cmp(&from_first(b)));
    places.dedup_by(|a, b| (from_first(a) - from_first(b)).abs() <= rounding);
    places.sort_by(|a, b| from_first(a).abs().total_cmp(&from_first(b).abs()));
    let dimension = |(row, p): (usize, &Point)| {
        let away = PITCH * (row as f64 + 1.0) * theme.small_size();
        Dimension {
            direction,
            ends: [first, *p].map(|p| page_from_part.apply(p)),
            at: if direction == Direction::Across { around.max.y + away } else { around.min.x - away },
            text: length_text(from_first(p).abs()),
        }
    };
    places.iter().enumerate().map(dimension).collect()
}

/// The letters of the holes, which are not in the holes.
fn letters(
    (part, sizes): (&Part, Sizes),
    items: &[Item],
    frame: Rect,
    page_from_part: &Similarity,
    theme: &Theme,
) -> Vec<Item> {
    let mut obstacles = Obstacles::default();
    obstacles.add(items, false);
    let numbers = items.iter().filter_map(text_box);
    let radius = sizes.hole / 2.0 * page_from_part.scale();
    let disk = |hole: &Hole| {
        let centre = page_from_part.apply(hole.centre);
        Item::Circle(Circle { centre, radius, stroke: None, fill: Some(theme.paper) })
    };
    obstacles.add(&numbers.chain(part.holes.iter().map(disk)).collect::<Vec<_>>(), false);
    let mut placer = LabelPlacer::new(&obstacles, frame, theme);
    let named = part.holes.iter().filter(|hole| !hole.name.is_empty());
    let size = theme.note_size;
    let letter = |hole: &Hole| {
        let text = theme.text_line(&hole.name, Point::origin(), Anchor::Middle, size, theme.ink).text;
        let centre = page_from_part.apply(hole.centre);
        let around = |deg: f64| {
            let (cos, sin) = trig::cos_sin_deg(deg);
            centre + Vector::new(cos, -sin) * (radius + 0.5 * size)
        };
        let clear = DIRECTIONS_DEG.iter().find_map(|deg| placer.place_if_clear(around(*deg), text.clone()));
        clear.or_else(|| placer.place_at_point(centre, text))
    };
    named.filter_map(letter).collect()
}

/// Where letters are sought around a hole: first where no dimension leads away from it.
const DIRECTIONS_DEG: [f64; 8] = [45.0, 135.0, 0.0, 90.0, 180.0, 315.0, 225.0, 270.0];

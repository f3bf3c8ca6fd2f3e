//! The view of a part: its outline, holes and slots, their centre lines, letters and dimensions, under its name.

use super::super::element::translated;
use super::super::labels::{LabelBox, LabelPlacer, Obstacles};
use super::super::rect::Rect;
use super::super::scales::{format_scale, usual_scale_below};
use super::super::theme::Theme;
use super::dimension::{Dimension, Direction, PITCH, length_text};
use super::extent::{bounds, text_box};
use super::group::Group;
use crate::scene::{Anchor, Circle, Item, Path, Polyline, Stroke, Text};
use coupler_curves::family::LengthUnit;
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

/// What the views of a page are of.
pub(super) struct Views<'a> {
    pub groups: &'a [Group<'a>],
    pub sizes: Sizes,
    pub unit: Option<LengthUnit>,
    pub theme: &'a Theme,
}

impl Views<'_> {
    /// The extent of the greatest part.
    pub fn extent(&self) -> f64 {
        self.groups.iter().map(extent).fold(0.0, f64::max)
    }

    /// The views of all at a scale in millimetres to a unit.
    pub fn all(&self, scale: f64) -> Vec<PartView> {
        self.groups.iter().map(|group| self.view(group, scale)).collect()
    }

    /// The view of parts of one shape at a scale in millimetres to a unit; a part that would be too small to be seen has a greater one of its own.
    fn view(&self, group: &Group, scale: f64) -> PartView {
        let &Views { sizes, theme, .. } = self;
        let own_scale = self.scale_of_small(group, scale);
        let page_from_part = Similarity::with_y_down(own_scale.unwrap_or(scale), Point::origin());
        let part = group.part;
        let mut items = cut_items(part, sizes, &page_from_part, theme);
        // Those across are under the numbers of the others, too.
        for direction in [Direction::Up, Direction::Across] {
            let around = bounds(&items);
            let dimensions = dimensions(part, direction, around, &page_from_part, theme);
            // The extension lines of those further out pass the others.
            let extensions: Vec<[f64; 2]> = dimensions.iter().map(Dimension::extensions).collect();
            let passing = |k: usize| extensions[k + 1..].as_flattened();
            items.extend(dimensions.iter().enumerate().flat_map(|(k, dimension)| dimension.items(passing(k), theme)));
        }
        let with_dimensions = bounds(&items);
        items.extend(letters((part, sizes), &items, with_dimensions, &page_from_part, theme));
        let scale = own_scale.map(|scale| format_scale(scale, self.unit));
        items.extend(title_items((group, scale), bounds(&items), theme));
        let all = bounds(&items);
        let items = items.into_iter().map(|item| translated(item, -all.min.coords)).collect();
        PartView { size: all.size(), items }
    }

    /// The scale at which a part can be seen that cannot at that of the page, and is small next to the others.
    fn scale_of_small(&self, group: &Group, scale: f64) -> Option<f64> {
        /// What is too small, and how large it becomes at most, in ems of a note.
        const SIZES: [f64; 2] = [3.0, 10.0];
        /// How large it becomes at most, as a part of the greatest part.
        const MOST: f64 = 0.3;
        let [small, large] = SIZES.map(|size| size * self.theme.note_size);
        let own = usual_scale_below(large.min(MOST * self.extent() * scale) / extent(group), self.unit);
        (extent(group) * scale < small && own >= 2.0 * scale).then_some(own)
    }
}

/// The extent of a part.
fn extent(group: &Group) -> f64 {
    group.part.outline.bounds().size().max()
}

/// The names of the parts, how many there are and their scale if it is not that of the page, over what is drawn of them.
fn title_items((group, scale): (&Group, Option<String>), drawn: Bounds, theme: &Theme) -> Vec<Item> {
    /// The width that lines may have however small the view is, in ems.
    const MIN_WIDTH: f64 = 12.0;
    let size = theme.caption_size;
    let count = if group.names.len() > 1 { format!(" ({}×)", group.names.len()) } else { String::new() };
    let line = |words: &str, at: Point| theme.text_line(words, at, Anchor::Middle, size, theme.ink);
    let scale = scale.map_or(String::new(), |scale| format!(", scale {scale}"));
    let title = format!("{}{count}{scale}", group.names.join(", "));
    let lines = line(&title, Point::origin()).wrap(drawn.size().x.max(MIN_WIDTH * size));
    let foot = Point::new(drawn.centre().x, drawn.min.y - 0.6 * size);
    let at = |k: usize| foot - Vector::new(0.0, 1.2 * size * (lines.len() - 1 - k) as f64);
    lines.iter().enumerate().map(|(k, words)| Item::Text(line(words, at(k)).text)).collect()
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
    let pitch_line = part.pitch_line.map(|line| line.ends.map(|p| page_from_part.apply(p)));
    items.extend(pitch_line.map(|ends| chain_line(ends, theme)));
    items
}

/// A line of long and short dashes, with a long one at both ends.
fn chain_line([from, to]: [Point; 2], theme: &Theme) -> Item {
    /// The lengths of a dash, a gap, a short dash and a gap, in ems of a note.
    const LENGTHS: [f64; 4] = [1.6, 0.3, 0.3, 0.3];
    let [dash, period] = [LENGTHS[0], LENGTHS.iter().sum()].map(|ems: f64| ems * theme.note_size);
    let length = (to - from).norm();
    let count = ((length - dash) / period).round().max(0.0);
    let unit = (to - from) / (dash + count * period);
    let gap = LENGTHS[1] * theme.note_size;
    let long = (0..=count as usize).map(|k| [k as f64 * period, k as f64 * period + dash]);
    let short = (0..count as usize).map(|k| k as f64 * period + dash + gap).map(|start| [start, start + gap]);
    let line = |ends: [f64; 2]| Polyline { points: ends.map(|at| from + unit * at).to_vec(), is_closed: false };
    let polylines = long.chain(short).map(line).collect();
    Item::Path(Path { polylines, stroke: Some(theme.stroke(theme.ink, theme.hair_width)), fill: None })
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

/// The dimensions in a direction of the holes and of the ends of slots and of a pitch line: how far each is from the first hole, the shortest next to the view.
fn dimensions(
    part: &Part,
    direction: Direction,
    around: Bounds,
    page_from_part: &Similarity,
    theme: &Theme,
) -> Vec<Dimension> {
    let mut places: Vec<Point> = part.holes.iter().map(|hole| hole.centre).collect();
    places
        .extend(part.slots.iter().flat_map(|slot| slot.ends).chain(part.pitch_line.iter().flat_map(|line| line.ends)));
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

/// The names of the holes and of a pitch line, each beside its hole where it overlaps nothing, and otherwise at the end of a line from there.
fn letters(
    (part, sizes): (&Part, Sizes),
    items: &[Item],
    drawn: Bounds,
    page_from_part: &Similarity,
    theme: &Theme,
) -> Vec<Item> {
    let mut obstacles = Obstacles::default();
    obstacles.add(items, false);
    let radius = sizes.hole / 2.0 * page_from_part.scale();
    let disk = |hole: &Hole| {
        let centre = page_from_part.apply(hole.centre);
        Item::Circle(Circle { centre, radius, stroke: None, fill: Some(theme.paper) })
    };
    obstacles.add(&part.holes.iter().map(disk).collect::<Vec<_>>(), false);
    let size = theme.note_size;
    let named = part.holes.iter().filter(|hole| !hole.name.is_empty());
    let of_holes = named.map(|hole| (hole.centre, hole.name.as_str()));
    let pitch_line = part.pitch_line.iter().map(|line| (line.ends[1], "pitch line"));
    let text = |(at, name): (Point, &str)| {
        let text = theme.text_line(name, Point::origin(), Anchor::Middle, size, theme.ink).text;
        (page_from_part.apply(at), text)
    };
    let named: Vec<(Point, Text)> = of_holes.chain(pitch_line).map(text).collect();
    let centres: Vec<Point> = part.holes.iter().map(|hole| page_from_part.apply(hole.centre)).collect();
    // Names may be around everything else.
    let widest = named.iter().map(|(_, text)| text.width()).fold(0.0, f64::max);
    let room = Vector::new(widest + 3.0 * size, 4.0 * size);
    let frame = Rect { corner: drawn.min - room, size: drawn.size() + room * 2.0 };
    let numbers = items.iter().filter_map(text_box).collect();
    let mut placer = LabelPlacer::new(&obstacles, frame, theme).with_placed(numbers, 0.0);
    let mut out = Vec::new();
    for (centre, text) in named {
        let around = |deg: f64| {
            let (cos, sin) = trig::cos_sin_deg(deg);
            centre + Vector::new(cos, -sin) * (radius + 0.5 * size)
        };
        // Nearer to its own hole than to any other.
        let is_nearest = |spot: &LabelBox| {
            let reach = NEAREST * spot.distance_to_point(centre);
            centres.iter().all(|other| *other == centre || spot.distance_to_point(*other) > reach)
        };
        let beside =
            DIRECTIONS_DEG.iter().find_map(|deg| placer.place_if_clear_where(is_nearest, around(*deg), text.clone()));
        if let Some(name) = beside {
            out.push(name);
            continue;
        }
        let apart =
            DISTANCES.iter().find_map(|distance| placer.place_apart((centre, radius), distance * size, text.clone()));
        match apart {
            Some((name, line)) => {
                let stroke = theme.stroke(theme.grey, theme.hair_width);
                out.extend([Item::Path(Path::stroked(line.to_vec(), stroke)), name]);
            }
            None => out.extend(placer.place_at_point(centre, text)),
        }
    }
    out
}

/// Where names are sought around a hole: first where no dimension leads away from it.
const DIRECTIONS_DEG: [f64; 8] = [45.0, 135.0, 0.0, 90.0, 180.0, 315.0, 225.0, 270.0];

/// How much further than its own hole all others are from a name without a line.
const NEAREST: f64 = 1.3;

/// How far from their hole names with a line are sought, in ems.
const DISTANCES: [f64; 10] = [1.5, 2.5, 4.0, 6.0, 9.0, 13.0, 18.0, 26.0, 38.0, 54.0];

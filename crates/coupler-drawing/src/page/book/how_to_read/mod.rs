//! Two facing pages that say how plates are read, and how a curve is found: a plate with numbers, and what is at them.

mod parts;
mod text;

pub(super) use parts::TITLE;

use super::super::area::{self, Area};
use super::super::element::Drawing;
use super::super::empty_scene::empty_scene;
use super::super::heading;
use super::super::theme::Theme;
use super::super::{Layout, Options};
use super::atlas::{Atlas, HowToRead};
use super::free_space::FreeSpace;
use crate::scene::{Anchor, Circle, Color, Curve, Group, Item, Path, Polyline, Scene, Stroke, Text};
use coupler_curves::geometry::{Point, Vector, distance_to_segment, trig};
use parts::{LARGEST_TEXT, PARTS, Part};

/// The part of the width and height that the plate takes on its page, at most.
const PLATE_PART: f64 = 0.84;

/// The part of the width and height of a page that the plate takes, which is composed for such a paper: no text of it is reduced.
pub fn plate_part(options: &Options) -> f64 {
    let theme = &options.theme.for_paper(options.paper);
    let [top, bottom, _] = heading::margins(theme);
    PLATE_PART.min((options.paper.height - top - bottom) / options.paper.height)
}

/// Composes the page with the plate, and the one that faces it; more follow on paper that is too small for the text.
pub(super) fn compose(how: &HowToRead, atlas: &Atlas, find: &[String], options: &Options) -> Vec<Scene> {
    let theme = &options.theme.for_paper(options.paper);
    let shown = shown_parts(how);
    let mut pages = vec![compose_plate(how, atlas, &shown, options, theme)];
    pages.extend(text::compose(how, atlas, &shown, find, options, theme));
    pages
}

/// The number of pages.
pub(super) fn page_count(how: &HowToRead, find: &[String], options: &Options) -> usize {
    let theme = &options.theme.for_paper(options.paper);
    1 + text::page_count(how, &shown_parts(how), find, options, theme)
}

/// The parts of the plate that are explained, with the places that their numbers point to.
fn shown_parts(how: &HowToRead) -> Vec<(&'static Part, Point)> {
    let parts = PARTS.iter().filter(|part| part.layouts[layout_index(how.layout)]);
    let places = parts.filter_map(|part| Some((part, part_places(part, &how.plate)?)));
    let places: Vec<(&'static Part, Vec<Point>)> = places.collect();
    let mut anchors: Vec<Point> = places.iter().filter_map(|(part, places)| furthest(places, part.side)).collect();
    // A curve and its ticks are pointed to away from everything else: the traced point is on its curve as well.
    for (k, (_, places)) in places.iter().enumerate().filter(|(_, (part, _))| part.is_long) {
        let others = |p: &Point| {
            (0..anchors.len())
                .filter(|other| *other != k)
                .map(|other| (anchors[other] - p).norm())
                .fold(f64::INFINITY, f64::min)
        };
        let side = |turn: u32| {
            let (cos, sin) = trig::cos_sin_deg(22.5 * f64::from(turn));
            Vector::new(cos, sin)
        };
        let ends = (0..16).filter_map(|turn| furthest(places, side(turn)));
        if let Some(clearest) = ends.max_by(|a, b| others(a).total_cmp(&others(b))) {
            anchors[k] = clearest;
        }
    }
    places.into_iter().map(|(part, _)| part).zip(anchors).collect()
}

/// The point that is furthest to a side.
fn furthest(points: &[Point], side: Vector) -> Option<Point> {
    let reach = |p: &Point| p.coords.dot(&side);
    points.iter().copied().reduce(|a, b| if reach(&b) > reach(&a) { b } else { a })
}

fn layout_index(layout: Layout) -> usize {
    match layout {
        Layout::Panels { .. } | Layout::Poses | Layout::Drawing => 0,
        Layout::CouplerGrid => 1,
        Layout::Chart { .. } => 2,
    }
}

/// The points of the first group of a part on the plate.
fn part_places(part: &Part, plate: &Scene) -> Option<Vec<Point>> {
    if part.class == LARGEST_TEXT {
        let mut texts = Vec::new();
        collect_texts(&plate.items, &mut texts);
        return Some(text_corners(texts.into_iter().reduce(|a, b| if b.size > a.size { b } else { a })?));
    }
    let mut found = Vec::new();
    collect_groups(&plate.items, part.class, &mut found);
    found.into_iter().map(group_points).find(|points| !points.is_empty())
}

fn collect_groups<'s>(items: &'s [Item], class: &str, found: &mut Vec<&'s [Item]>) {
    for item in items {
        if let Item::Group(group) = item {
            if group.class == class {
                found.push(&group.items);
            }
            collect_groups(&group.items, class, found);
        }
    }
}

fn collect_texts<'s>(items: &'s [Item], found: &mut Vec<&'s Text>) {
    for item in items {
        match item {
            Item::Group(group) => collect_texts(&group.items, found),
            Item::Text(text) => found.push(text),
            _ => {}
        }
    }
}

/// The middle of the upper edge, and the ends of the baseline.
fn text_corners(text: &Text) -> Vec<Point> {
    let start = text.start();
    let corner = |x: f64, y: f64| start + Vector::new(x * text.width(), -0.7 * y * text.size);
    vec![corner(0.5, 1.0), corner(0.0, 0.0), corner(1.0, 0.0)]
}

/// Points of the lines of a group, or of its texts where it has no lines.
fn group_points(items: &[Item]) -> Vec<Point> {
    let lines: Vec<Item> = items.iter().filter(|item| !matches!(item, Item::Text(_))).cloned().collect();
    Some(items_points(&lines)).filter(|points| !points.is_empty()).unwrap_or_else(|| items_points(items))
}

/// Points of items: ends and corners of lines, and of circles those in four directions.
fn items_points(items: &[Item]) -> Vec<Point> {
    let of_item = |item: &Item| -> Vec<Point> {
        match item {
            Item::Group(group) => items_points(&group.items),
            Item::Path(path) => path.polylines.iter().flat_map(|line| line.points.iter().copied()).collect(),
            Item::Curve(curve) => curve.splines.iter().flat_map(|spline| spline.points()).collect(),
            Item::Circle(circle) => {
                let reach = [Vector::x(), -Vector::x(), Vector::y(), -Vector::y()].map(|unit| unit * circle.radius);
                reach.map(|reach| circle.centre + reach).to_vec()
            }
            Item::Text(text) => text_corners(text),
            Item::Animation(animation) => animation.frames.first().map(|frame| items_points(frame)).unwrap_or_default(),
        }
    };
    items.iter().flat_map(of_item).collect()
}

/// An item at a scale, moved.
fn scaled(item: &Item, scale: f64, shift: Vector) -> Item {
    let at = |p: Point| Point::from(p.coords * scale + shift);
    let thin = |stroke: Stroke| Stroke { width: stroke.width * scale, ..stroke };
    match item {
        Item::Group(group) => Item::Group(Group {
            // Ids are those of the plate itself.
            id: String::new(),
            items: group.items.iter().map(|item| scaled(item, scale, shift)).collect(),
            ..group.clone()
        }),
        Item::Path(path) => Item::Path(Path {
            polylines: path
                .polylines
                .iter()
                .map(|line| Polyline { points: line.points.iter().map(|p| at(*p)).collect(), ..line.clone() })
                .collect(),
            stroke: path.stroke.map(thin),
            fill: path.fill,
        }),
        Item::Curve(curve) => Item::Curve(Curve {
            splines: curve.splines.iter().map(|spline| spline.map(at)).collect(),
            stroke: thin(curve.stroke),
        }),
        Item::Circle(circle) => Item::Circle(Circle {
            centre: at(circle.centre),
            radius: circle.radius * scale,
            stroke: circle.stroke.map(thin),
            fill: circle.fill,
        }),
        Item::Text(text) => Item::Text(Text { position: at(text.position), size: text.size * scale, ..text.clone() }),
        Item::Animation(animation) => {
            let items = animation.frames.first().map(Vec::as_slice).unwrap_or_default();
            Item::Group(Group {
                items: items.iter().map(|item| scaled(item, scale, shift)).collect(),
                ..Group::default()
            })
        }
    }
}

/// The page with the plate.
fn compose_plate(how: &HowToRead, atlas: &Atlas, shown: &[(&Part, Point)], options: &Options, theme: &Theme) -> Scene {
    let mut scene = empty_scene(format!("{TITLE}: {}", atlas.title), options, theme);
    let root = area::whole_page(&mut scene);
    heading::draw_border(&root, theme);
    let at = heading::draw_title(&root, TITLE, theme);
    let page = root.size();
    let subtitle = "A plate as in this book. The numbers are explained on the facing page.";
    root.record(
        theme.text_line(subtitle, at, Anchor::Start, theme.source_size, theme.grey).fit_width(page.x - 2.0 * at.x),
    );
    let [top, bottom, _] = heading::margins(theme);
    let plate = Vector::new(how.plate.width, how.plate.height);
    let space = page.y - top - bottom;
    // That of a caller who has not asked for its part is reduced.
    let scale = (PLATE_PART * page.x / plate.x).min(space / plate.y).min(1.0);
    let shift = Vector::new(0.5 * (page.x - scale * plate.x), top + 0.5 * (space - scale * plate.y));
    let items: Vec<Item> = how.plate.items.iter().map(|item| scaled(item, scale, shift)).collect();
    let says: Vec<&str> = how.plate.figures().iter().map(|figure| figure.description.as_str()).collect();
    root.grouped(Group::figure("plate", format!("A plate, reduced: {}", says.join(". "))), || {
        items.into_iter().for_each(|item| root.record(item));
    });
    drop(root);
    let anchors = shown.iter().map(|(part, anchor)| (Point::from(anchor.coords * scale + shift), part.side));
    let anchors: Vec<(Point, Vector)> = anchors.collect();
    let radius = 1.1 * theme.source_size;
    let edge = theme.border + 1.5 * radius;
    let centres = number_places(&anchors, radius, edge, &FreeSpace::of_page(&scene), page);
    let root = area::whole_page(&mut scene);
    let ink = theme.text_ink(theme.curve_ink(0));
    for (k, ((anchor, _), centre)) in anchors.into_iter().zip(centres).enumerate() {
        draw_number(&root, (k + 1, anchor, centre), radius, ink, theme);
    }
    drop(root);
    scene
}

/// The centres of the numbers of a plate, of a radius and at least so far from the edges of the page: each near its anchor, as far as possible to
/// its side, where its circle covers nothing and its line little.
fn number_places(anchors: &[(Point, Vector)], radius: f64, edge: f64, space: &FreeSpace, page: Vector) -> Vec<Point> {
    /// The directions and distances that are tried, in radii.
    const TURNS: u32 = 32;
    const DISTANCES: [f64; 12] = [2.0, 2.4, 2.8, 3.4, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 14.0];
    /// What a covered square of a millimetre costs in radii of distance, one that a line passes, and a turn to the opposite side.
    const COVERED: f64 = 20.0;
    const PASSED: f64 = 1.5;
    const TURNED: f64 = 1.5;
    let mut placed: Vec<[Point; 2]> = Vec::new();
    for &(anchor, side) in anchors {
        let direction = side.try_normalize(0.0).unwrap_or(Vector::new(0.0, -1.0));
        let candidates = DISTANCES.iter().flat_map(|distance| (0..TURNS).map(move |turn| (*distance, turn)));
        let candidates = candidates.map(|(distance, turn)| {
            let (cos, sin) = trig::cos_sin_deg(360.0 / f64::from(TURNS) * f64::from(turn));
            let turned = Vector::new(direction.x * cos - direction.y * sin, direction.x * sin + direction.y * cos);
            (distance + TURNED * (1.0 - cos), anchor + turned * (distance * radius))
        });
        let is_allowed = |at: &Point| {
            let is_apart = |[other, end]: &[Point; 2]| {
                (other - at).norm() > 2.3 * radius
                    && distance_to_segment(*at, *other, *end) > 1.2 * radius
                    && distance_to_segment(*other, *at, anchor) > 1.2 * radius
            };
            (edge..page.x - edge).contains(&at.x)
                && (edge..page.y - edge).contains(&at.y)
                && placed.iter().all(is_apart)
        };
        let cost = |(cost, at): (f64, Point)| {
            let line = anchor - at;
            // What is at the anchor is what the number is of.
            let steps = ((line.norm() - radius).floor() as usize).saturating_sub(1);
            let on_line = |k: usize| at + line.normalize() * (radius + k as f64);
            let passed = (0..steps).filter(|k| space.used_around(on_line(*k), 0.0) > 0).count();
            let covered = f64::from(space.used_around(at, 1.1 * radius));
            (cost + COVERED * covered + PASSED * passed as f64, at)
        };
        let best = candidates.filter(|(_, at)| is_allowed(at)).map(cost).min_by(|a, b| a.0.total_cmp(&b.0));
        let centre = best.map_or(anchor + direction * (2.4 * radius), |(_, at)| at);
        placed.push([centre, anchor]);
    }
    placed.into_iter().map(|[centre, _]| centre).collect()
}

/// Draws a number in a circle with a line to what it is the number of.
fn draw_number(
    root: &impl Area,
    (number, anchor, centre): (usize, Point, Point),
    radius: f64,
    ink: Color,
    theme: &Theme,
) {
    let stroke = theme.stroke(ink, theme.fine_width);
    let towards = (anchor - centre).try_normalize(0.0).unwrap_or(Vector::new(0.0, 1.0));
    let line = Path::stroked(vec![centre + towards * radius, anchor], stroke);
    let circle = Circle { centre, radius, stroke: Some(stroke), fill: Some(theme.paper) };
    root.record(Drawing {
        class: "callout",
        title: String::new(),
        items: vec![Item::Path(line), Item::Circle(circle)],
    });
    let at = centre + Vector::new(0.0, 0.36 * theme.source_size);
    root.record(theme.text_line(&number.to_string(), at, Anchor::Middle, theme.source_size, ink));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_cover_nothing_that_is_drawn() {
        let options = Options::for_paper(super::super::super::Paper { width: 148.0, height: 105.0 });
        let theme = &options.theme.for_paper(options.paper);
        let mut scene = empty_scene(String::new(), &options, theme);
        let anchors = [(40.0, 60.0), (46.0, 60.0), (100.0, 60.0)].map(|(x, y)| (Point::new(x, y), Vector::y()));
        let radius = 1.1 * theme.source_size;
        // A text below each anchor, where its number is as a rule, and a line above two of them.
        for (at, _) in anchors {
            let below = at + Vector::new(0.0, 2.0 * radius);
            scene.items.push(Item::Text(theme.text_line("0.5", below, Anchor::Middle, 3.0, theme.ink).text));
        }
        let line = vec![Point::new(20.0, 60.0 - 2.2 * radius), Point::new(60.0, 60.0 - 2.2 * radius)];
        scene.items.push(Item::Path(Path::stroked(line, theme.stroke(theme.ink, 0.3))));
        let space = FreeSpace::of_page(&scene);
        let page = Vector::new(scene.width, scene.height);
        let centres = number_places(&anchors, radius, 10.0, &space, page);
        for (k, (centre, (anchor, _))) in centres.iter().zip(anchors).enumerate() {
            assert_eq!(space.used_around(*centre, radius), 0, "{centre}");
            assert!((centre - anchor).norm() < 6.0 * radius, "{centre}");
            assert!(centres[..k].iter().all(|other| (other - centre).norm() > 2.0 * radius));
        }
    }
}

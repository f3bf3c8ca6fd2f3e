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
use crate::scene::{Anchor, Circle, Color, Curve, Group, Item, Path, Polyline, Scene, Stroke, Text};
use coupler_curves::geometry::{Point, Vector};
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

/// The parts of the plate that are explained, with the places of their numbers.
fn shown_parts(how: &HowToRead) -> Vec<(&'static Part, Point)> {
    let parts = PARTS.iter().filter(|part| part.layouts[layout_index(how.layout)]);
    parts.filter_map(|part| Some((part, part_anchor(part, &how.plate)?))).collect()
}

fn layout_index(layout: Layout) -> usize {
    match layout {
        Layout::Panels { .. } | Layout::Poses | Layout::Drawing => 0,
        Layout::CouplerGrid => 1,
        Layout::Chart { .. } => 2,
    }
}

/// The place on the plate at which a part has its number: the point of its first group that is furthest to one side.
fn part_anchor(part: &Part, plate: &Scene) -> Option<Point> {
    let points = if part.class == LARGEST_TEXT {
        let mut texts = Vec::new();
        collect_texts(&plate.items, &mut texts);
        text_corners(texts.into_iter().reduce(|a, b| if b.size > a.size { b } else { a })?)
    } else {
        let mut found = Vec::new();
        collect_groups(&plate.items, part.class, &mut found);
        found.into_iter().map(items_points).find(|points| !points.is_empty())?
    };
    let reach = |p: &Point| p.coords.dot(&part.side);
    points.into_iter().reduce(|a, b| if reach(&b) > reach(&a) { b } else { a })
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

/// The upper left and the lower right corner of a text.
fn text_box(text: &Text) -> [Point; 2] {
    let start = text.start();
    [start + Vector::new(0.0, -0.75 * text.size), start + Vector::new(text.width(), 0.25 * text.size)]
}

/// The middle of the upper edge, and the ends of the baseline.
fn text_corners(text: &Text) -> Vec<Point> {
    let start = text.start();
    let corner = |x: f64, y: f64| start + Vector::new(x * text.width(), -0.7 * y * text.size);
    vec![corner(0.5, 1.0), corner(0.0, 0.0), corner(1.0, 0.0)]
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
    let radius = 1.1 * theme.source_size;
    let ink = theme.text_ink(theme.curve_ink(0));
    let mut texts = Vec::new();
    collect_texts(&how.plate.items, &mut texts);
    // The corners of texts on the page.
    let texts: Vec<[Point; 2]> =
        texts.into_iter().map(|text| text_box(text).map(|corner| Point::from(corner.coords * scale + shift))).collect();
    let covers = |centre: Point, [low, high]: &[Point; 2]| {
        let nearest = Point::new(centre.x.clamp(low.x, high.x), centre.y.clamp(low.y, high.y));
        (centre - nearest).norm() < 1.1 * radius
    };
    let edge = theme.border + 1.5 * radius;
    let mut placed: Vec<Point> = Vec::new();
    for (k, (part, anchor)) in shown.iter().enumerate() {
        let anchor = Point::from(anchor.coords * scale + shift);
        let direction = part.side.try_normalize(0.0).unwrap_or(Vector::new(0.0, -1.0));
        let around = |turn: u32| {
            let (cos, sin) = coupler_curves::geometry::trig::cos_sin_deg(22.5 * f64::from(turn));
            let turned = Vector::new(direction.x * cos - direction.y * sin, direction.x * sin + direction.y * cos);
            anchor + turned * (2.4 + f64::from(turn / 16)) * radius
        };
        // Out of the way of the numbers before it, and of text.
        let is_free = |at: &Point| {
            placed.iter().all(|other| (other - at).norm() > 2.3 * radius)
                && !texts.iter().any(|text| covers(*at, text))
                && (edge..page.x - edge).contains(&at.x)
                && (edge..page.y - edge).contains(&at.y)
        };
        let centre = (0..80).map(around).find(is_free).unwrap_or_else(|| around(0));
        placed.push(centre);
        draw_number(&root, (k + 1, anchor, centre), radius, ink, theme);
    }
    drop(root);
    scene
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

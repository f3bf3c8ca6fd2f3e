//! The numbers of coupler points, each beside its point where it is furthest from all that is drawn.

use super::super::arrangement::Frame;
use super::super::mechanism::{drawn_links, ground};
use super::super::plot::Plot;
use super::super::theme::Theme;
use super::Shown;
use crate::geometry::{Point, Vector, distance_to_segment, trig};
use crate::scene::{Anchor, Item};
use crate::sweep::Solved;

/// The numbers of the points of a page; `lines` are its curves, on the page.
pub(super) fn place(
    pose: &[Point],
    shown: &[Shown],
    lines: &[&[Point]],
    plot: &Plot,
    (solved, frame): (&Solved, Frame),
    theme: &Theme,
) -> Vec<Item> {
    let size = 0.85 * theme.note;
    let on_page = |p: Point| plot.page_from_plane.apply(p);
    let links: Vec<Vec<Point>> = drawn_links(&solved.linkage)
        .into_iter()
        .chain([ground(&solved.linkage)])
        .map(|link| link.into_iter().map(|joint| on_page(pose[joint])).collect())
        .collect();
    let centres: Vec<Point> = shown.iter().map(|s| on_page(pose[s.curve.joint])).collect();
    let mut placed: Vec<Point> = Vec::new();
    let mut items = Vec::new();
    for (k, s) in shown.iter().enumerate() {
        if shown[..k].iter().any(|other| other.place == s.place) {
            continue;
        }
        let text = theme.words(&s.curve.trace.to_string(), Point::origin(), Anchor::Middle, size, s.ink(theme)).text;
        let half = Vector::new(text.width() / 2.0, 0.36 * size);
        let near = Near::of(centres[k], 5.0 * theme.joint + 3.0 * half.x, lines, &links);
        let others = || centres.iter().chain(&placed).filter(|other| (*other - centres[k]).norm() < 8.0 * size);
        // What is that far from everything is as good as what is further.
        let enough = 0.6 * theme.joint;
        let clearance = |middle: Point| {
            let to = |other: &Point| off(half, other - middle);
            let circles = others().map(to).fold(f64::INFINITY, f64::min) - theme.joint;
            circles.min(near.clearance(middle, half, enough))
        };
        let Some(middle) = best(centres[k], half, (theme.joint, enough, frame), clearance) else { continue };
        placed.push(middle);
        items.push(Item::Text(crate::scene::Text { at: middle + Vector::new(0.0, half.y), ..text }));
    }
    items
}

/// The first of the places round a point, near ones before far ones, that is clear enough; or the clearest.
fn best(
    centre: Point,
    half: Vector,
    (joint, enough, frame): (f64, f64, Frame),
    clearance: impl Fn(Point) -> f64,
) -> Option<Point> {
    const DIRECTIONS: i32 = 16;
    let far = frame.corner + frame.size;
    let is_inside = |p: &Point| {
        p.x - half.x >= frame.corner.x
            && p.y - half.y >= frame.corner.y
            && p.x + half.x <= far.x
            && p.y + half.y <= far.y
    };
    let mut best: Option<(f64, Point)> = None;
    for ring in [1.0, 1.9, 3.2] {
        for direction in 0..DIRECTIONS {
            let (cos, sin) = trig::cos_sin_deg(360.0 / f64::from(DIRECTIONS) * f64::from(direction));
            let reach = Vector::new(half.x + ring * 1.6 * joint, half.y + ring * 1.6 * joint);
            let middle = centre + Vector::new(cos * reach.x, -sin * reach.y);
            let clear = clearance(middle);
            if is_inside(&middle) && best.is_none_or(|(most, _)| clear > most) {
                best = Some((clear, middle));
            }
        }
        if best.is_some_and(|(clear, _)| clear >= enough) {
            break;
        }
    }
    best.map(|(_, middle)| middle)
}

/// How far a place is from a box about the origin.
fn off(half: Vector, place: Vector) -> f64 {
    Vector::new((place.x.abs() - half.x).max(0.0), (place.y.abs() - half.y).max(0.0)).norm()
}

/// The lines that pass a point.
struct Near {
    segments: Vec<[Point; 2]>,
}

impl Near {
    /// Those of some lines that come as near to a point as `within`, or nearly so.
    fn of(centre: Point, within: f64, curves: &[&[Point]], links: &[Vec<Point>]) -> Near {
        let lines = curves.iter().copied().chain(links.iter().map(Vec::as_slice));
        let pairs = lines.flat_map(|line| line.windows(2)).map(|pair| [pair[0], pair[1]]);
        Near { segments: pairs.filter(|segment| is_near(segment, centre, Vector::repeat(within))).collect() }
    }

    /// The least distance of the lines from seven places of a box; no less than `enough` where none is that near.
    fn clearance(&self, middle: Point, half: Vector, enough: f64) -> f64 {
        let corners = [(0.0, 0.0), (1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (1.0, 0.0), (-1.0, 0.0)];
        let places = corners.map(|(x, y)| middle + Vector::new(x * half.x, y * half.y));
        let reach = half + Vector::repeat(enough);
        let near = self.segments.iter().filter(|segment| is_near(segment, middle, reach));
        let to = |[a, b]: &[Point; 2]| places.iter().map(|p| distance_to_segment(*p, *a, *b)).fold(enough, f64::min);
        near.map(to).fold(enough, f64::min)
    }
}

/// Whether the box round a segment meets one about a point.
fn is_near([a, b]: &[Point; 2], middle: Point, half: Vector) -> bool {
    let (low, high) = (middle - half, middle + half);
    a.x.min(b.x) <= high.x && a.x.max(b.x) >= low.x && a.y.min(b.y) <= high.y && a.y.max(b.y) >= low.y
}

//! The placement of labels: each next to its point, where it is clearest of everything that is drawn.

use std::sync::LazyLock;

use super::rect::Rect;
use super::theme::Theme;
use crate::scene::{Circle, Item, Polyline, Text};
use coupler_curves::geometry::{Bounds, Point, Vector, cross, distance_to_segment, trig};
use coupler_curves::path::JointPath;

/// The line of a path on the page for the placement of labels: through all of its splines, to a twentieth of a millimetre.
pub(super) fn label_line(path: &JointPath) -> Vec<Point> {
    const FLATNESS: f64 = 0.05;
    path.whole.iter().flat_map(|spline| spline.flatten(FLATNESS)).collect()
}

/// The lines and circles that labels avoid.
#[derive(Default)]
pub(super) struct Obstacles {
    segments: Vec<Segment>,
    /// The boxes around runs of segments, each with the end of its run.
    runs: Vec<(Bounds, usize)>,
    circles: Vec<(Point, f64)>,
}

/// A segment of a line.
#[derive(Clone, Copy, Default)]
struct Segment {
    ends: [Point; 2],
    /// Half the weight of the line.
    half_width: f64,
    /// Whether a label may overlap it if there is no better position.
    is_light: bool,
    /// The index of the curve it belongs to, if it does.
    curve: Option<usize>,
}

impl Obstacles {
    /// Adds the lines and circles of some items.
    pub fn add(&mut self, items: &[Item], is_light: bool) {
        for item in items {
            match item {
                Item::Path(path) => {
                    let weight = path.stroke.map_or(0.0, |stroke| stroke.width);
                    path.polylines.iter().for_each(|line| self.add_line(line, weight, is_light));
                }
                // A circle that is not filled, such as that of a gear, may have a label inside.
                Item::Circle(circle) => match (circle.fill, circle.stroke) {
                    (None, stroke) => {
                        let weight = stroke.map_or(0.0, |stroke| stroke.width);
                        self.add_points(&circle_points(circle), weight, is_light);
                    }
                    (Some(_), stroke) => {
                        let half = stroke.map_or(0.0, |stroke| stroke.width / 2.0);
                        self.circles.push((circle.centre, circle.radius + half));
                    }
                },
                Item::Group(_) | Item::Curve(_) | Item::Text(_) | Item::Animation(_) => {}
            }
        }
    }

    fn add_line(&mut self, Polyline { points, is_closed: closed }: &Polyline, weight: f64, is_light: bool) {
        self.add_points(points, weight, is_light);
        if let (Some(first), Some(last), true) = (points.first(), points.last(), closed) {
            self.add_points(&[*last, *first], weight, is_light);
        }
    }

    /// Adds a polyline with a weight in millimetres.
    pub fn add_points(&mut self, points: &[Point], weight: f64, is_light: bool) {
        self.add_segments(points, Segment { half_width: weight / 2.0, is_light, ..Segment::default() });
    }

    /// Adds a curve by its index, with a weight in millimetres.
    pub fn add_curve(&mut self, curve: usize, points: &[Point], weight: f64) {
        self.add_segments(points, Segment { half_width: weight / 2.0, curve: Some(curve), ..Segment::default() });
    }

    fn add_segments(&mut self, mut points: &[Point], like: Segment) {
        /// The points of a run.
        const RUN: usize = 9;
        while points.len() > 1 {
            let run = &points[..points.len().min(RUN)];
            self.segments.extend(run.windows(2).map(|p| Segment { ends: [p[0], p[1]], ..like }));
            self.runs.push((Bounds::from_points(run.iter().copied()), self.segments.len()));
            points = &points[run.len() - 1..];
        }
    }

    /// The obstacles within a distance of a point, and some that are a little further away.
    fn nearby(&self, centre: Point, within: f64) -> Obstacles {
        let reach = Vector::repeat(within);
        let mut near = Obstacles::default();
        let mut start = 0;
        for &(bounds, end) in &self.runs {
            let run = &self.segments[start..end];
            start = end;
            if meets([bounds.min, bounds.max], centre, reach) {
                near.segments.extend(run.iter().filter(|segment| segment.is_near(centre, reach)));
                near.runs.push((bounds, near.segments.len()));
            }
        }
        let circles = self.circles.iter().filter(|(at, radius)| (at - centre).norm() < 2.0 * within + radius);
        near.circles.extend(circles);
        near
    }

    /// The clearance of a box: its distance from obstacles that are not light plus a quarter of that from light ones,
    /// each at most `enough`.
    pub fn clearance(&self, spot: LabelBox, enough: f64) -> f64 {
        let circles =
            self.circles.iter().map(|(at, radius)| spot.distance_to_point(*at) - radius).fold(enough, f64::min);
        let (mut heavy, mut light) = (circles, enough);
        for segment in &self.segments {
            let least = if segment.is_light { &mut light } else { &mut heavy };
            // One that is not nearer than the nearest so far makes no difference.
            let reach = spot.half_size + Vector::repeat(*least + segment.half_width);
            if segment.is_near(spot.centre, reach) {
                *least = least.min(spot.distance_to_segment(segment.ends) - segment.half_width);
            }
        }
        heavy + 0.25 * light
    }

    /// The distance of a box from all curves other than its own, at most `enough`.
    fn distance_to_other_curves(&self, spot: LabelBox, own: usize, enough: f64) -> f64 {
        let others = self.segments.iter().filter(|segment| segment.curve.is_some_and(|curve| curve != own));
        others.map(|segment| spot.distance_to_segment(segment.ends)).fold(enough, f64::min)
    }
}

/// A circle as a closed polyline.
fn circle_points(circle: &Circle) -> Vec<Point> {
    const SIDES: u32 = 72;
    let at = |k: u32| {
        let (cos, sin) = trig::cos_sin_deg(360.0 / f64::from(SIDES) * f64::from(k));
        circle.centre + Vector::new(cos, sin) * circle.radius
    };
    (0..=SIDES).map(at).collect()
}

impl Segment {
    /// Whether its bounding box meets the box with a centre and half size.
    fn is_near(&self, centre: Point, half_size: Vector) -> bool {
        let [a, b] = self.ends;
        meets([a.inf(&b), a.sup(&b)], centre, half_size)
    }
}

/// Whether the box between two corners meets the one with a centre and half size.
#[inline]
fn meets([min, max]: [Point; 2], centre: Point, half_size: Vector) -> bool {
    let (low, high) = (centre - half_size, centre + half_size);
    min.x <= high.x && max.x >= low.x && min.y <= high.y && max.y >= low.y
}

/// A possible box of a label.
#[derive(Clone, Copy)]
pub(super) struct LabelBox {
    pub centre: Point,
    /// Half the width and height.
    pub half_size: Vector,
}

impl LabelBox {
    fn corner(&self, x: f64, y: f64) -> Point {
        self.centre + Vector::new(x * self.half_size.x, y * self.half_size.y)
    }

    /// The distance of a point; 0 inside.
    pub fn distance_to_point(&self, p: Point) -> f64 {
        let off = p - self.centre;
        Vector::new((off.x.abs() - self.half_size.x).max(0.0), (off.y.abs() - self.half_size.y).max(0.0)).norm()
    }

    /// The distance of a segment; 0 if it passes through the box.
    fn distance_to_segment(&self, [a, b]: [Point; 2]) -> f64 {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| self.corner(x, y));
        let crosses = |[c, d]: [Point; 2]| {
            let sides = |o: Point, u: Vector, p: Point, q: Point| cross(u, p - o) * cross(u, q - o) <= 0.0;
            sides(a, b - a, c, d) && sides(c, d - c, a, b)
        };
        // A segment through a box crosses one of its diagonals or ends inside.
        if crosses([corners[0], corners[2]]) || crosses([corners[1], corners[3]]) {
            return 0.0;
        }
        let ends = self.distance_to_point(a).min(self.distance_to_point(b));
        corners.iter().map(|corner| distance_to_segment(*corner, a, b)).fold(ends, f64::min)
    }

    /// Whether it is in a frame.
    pub fn is_inside(&self, frame: Rect) -> bool {
        let (low, high, far) = (self.corner(-1.0, -1.0), self.corner(1.0, 1.0), frame.corner + frame.size);
        low.x >= frame.corner.x && low.y >= frame.corner.y && high.x <= far.x && high.y <= far.y
    }

    /// The distance of another box; 0 if they overlap.
    pub fn distance_to_box(&self, other: &LabelBox) -> f64 {
        LabelBox { half_size: self.half_size + other.half_size, ..*self }.distance_to_point(other.centre)
    }
}

/// Places labels within a frame, so that none overlaps another one. A label that would everywhere is left out.
pub(super) struct LabelPlacer<'a> {
    obstacles: &'a Obstacles,
    frame: Rect,
    joint_radius: f64,
    /// The least distance of two labels.
    gap: f64,
    placed: Vec<LabelBox>,
}

impl<'a> LabelPlacer<'a> {
    /// A placer without labels.
    pub fn new(obstacles: &'a Obstacles, frame: Rect, theme: &Theme) -> LabelPlacer<'a> {
        LabelPlacer { obstacles, frame, joint_radius: theme.joint_radius, gap: 0.0, placed: Vec::new() }
    }

    /// The placer with labels that are placed already, and a least distance of labels.
    pub fn with_placed(self, placed: Vec<LabelBox>, gap: f64) -> LabelPlacer<'a> {
        LabelPlacer { placed, gap, ..self }
    }

    /// A greater clearance than this is no improvement.
    fn enough(&self) -> f64 {
        0.6 * self.joint_radius
    }

    fn is_free(&self, spot: &LabelBox) -> bool {
        spot.is_inside(self.frame) && self.placed.iter().all(|other| spot.distance_to_box(other) > self.gap)
    }

    fn add(&mut self, spot: LabelBox, text: Text) -> Item {
        self.placed.push(spot);
        let baseline = spot.half_size.y - descent(&text);
        Item::Text(Text { position: spot.centre + Vector::new(0.0, baseline), ..text })
    }

    /// Places a label at a point, where it is clearest of everything.
    pub fn place_at_point(&mut self, centre: Point, text: Text) -> Option<Item> {
        let (_, spot) = self.clearest_at_point(|_| true, centre, &text)?;
        Some(self.add(spot, text))
    }

    /// Places a label at a point if it overlaps nothing there.
    pub fn place_if_clear(&mut self, centre: Point, text: Text) -> Option<Item> {
        self.place_if_clear_where(|_| true, centre, text)
    }

    /// Places a label at a point in a box that is allowed if it overlaps nothing there.
    pub fn place_if_clear_where(
        &mut self,
        is_allowed: impl Fn(&LabelBox) -> bool,
        centre: Point,
        text: Text,
    ) -> Option<Item> {
        let (clearance, spot) = self.clearest_at_point(is_allowed, centre, &text)?;
        self.is_clear(clearance).then(|| self.add(spot, text))
    }

    /// Whether a label with a clearance does not touch a line.
    fn is_clear(&self, clearance: f64) -> bool {
        /// The least part of enough clearance.
        const LEAST: f64 = 0.4;
        clearance >= LEAST * self.enough()
    }

    /// Places a label at a distance from the circle of a radius around its point if it overlaps nothing there, with a line from the circle to just before it
    /// that passes no other label and no disk; the label and the ends of the line.
    pub fn place_apart(
        &mut self,
        (centre, radius): (Point, f64),
        distance: f64,
        text: Text,
    ) -> Option<(Item, [Point; 2])> {
        /// How far the line ends before the label, in ems: it touches no letter.
        const GAP: f64 = 0.1;
        let (half, enough) = (half_size(&text), self.enough());
        let near = self.obstacles.nearby(centre, radius + distance + 2.0 * half.x + enough);
        let mut spots = boxes_around(centre, half, radius + distance).filter(|spot| self.is_free(spot));
        let (spot, line) = spots.find_map(|spot| {
            let end = centre.sup(&spot.corner(-1.0, -1.0)).inf(&spot.corner(1.0, 1.0));
            let unit = (end - centre).try_normalize(0.0)?;
            let line = [centre + unit * radius, end - unit * (GAP * text.size)];
            let passes = |(at, radius): &(Point, f64)| {
                (at - centre).norm() > 0.0 && distance_to_segment(*at, line[0], line[1]) < *radius
            };
            let is_free = self.placed.iter().all(|other| other.distance_to_segment(line) > 0.0)
                && !near.circles.iter().any(passes);
            (is_free && self.is_clear(near.clearance(spot, enough))).then_some((spot, line))
        })?;
        Some((self.add(spot, text), line))
    }

    /// The clearest box for a label at a point, with its clearance.
    fn clearest_at_point(
        &self,
        is_allowed: impl Fn(&LabelBox) -> bool,
        centre: Point,
        text: &Text,
    ) -> Option<(f64, LabelBox)> {
        let (half, enough) = (half_size(text), self.enough());
        let within = |radii: f64| (radii + 1.0) * self.joint_radius + 2.0 * half.x;
        let around = self.obstacles.nearby(centre, within(RING_RADII[RING_RADII.len() - 1]));
        let ring = |radii: f64| {
            // Most labels are placed on the first rings, so only the obstacles near the ring are considered.
            let near = around.nearby(centre, within(radii));
            let clearance = |spot: LabelBox| {
                let others = self.placed.iter().map(|other| spot.distance_to_box(other)).fold(enough, f64::min);
                near.clearance(spot, enough).min(1.25 * others)
            };
            let boxes = boxes_around(centre, half, radii * self.joint_radius);
            clearest_box(boxes.filter(|spot| self.is_free(spot) && is_allowed(spot)), clearance)
        };
        best_box(ring, 1.25 * enough)
    }

    /// Places a label on a curve by its index as far as possible from a point, where it is clear of everything and
    /// nearer to its curve than to any other.
    pub fn place_far_from(&mut self, from: Point, curve: usize, points: &[Point], text: Text) -> Option<Item> {
        let (half, distance) = (half_size(&text), RING_RADII[0] * self.joint_radius);
        let spot = far_positions(from, points).into_iter().find_map(|at| {
            let near = self.obstacles.nearby(at, 3.0 * distance + 2.0 * half.x);
            let is_clear = |spot: &LabelBox| {
                let others = self.placed.iter().map(|other| spot.distance_to_box(other)).fold(f64::INFINITY, f64::min);
                others >= distance
                    && self.is_free(spot)
                    && near.clearance(*spot, self.enough()) >= 1.25 * self.enough() * (1.0 - 1e-9)
                    && near.distance_to_other_curves(*spot, curve, 2.0 * distance) >= 2.0 * distance
            };
            boxes_around(at, half, distance).find(is_clear)
        })?;
        Some(self.add(spot, text))
    }

    /// Places a label beside a bundle of curves, as far as possible from a point, and a line to it from its own curve; the label
    /// and the ends of the line, the first of which is on the curve.
    pub fn place_with_leader(&mut self, from: Point, points: &[Point], text: Text) -> Option<(Item, [Point; 2])> {
        /// The distances of labels from their curve, in radii of a joint.
        const RADII: [f64; 6] = [4.0, 6.0, 9.0, 12.0, 16.0, 20.0];
        let (half, enough) = (half_size(&text), self.enough());
        let places = far_positions(from, points).into_iter().step_by(4);
        let distances = RADII.map(|radii| radii * self.joint_radius);
        let mut spots = distances.into_iter().flat_map(|distance| places.clone().map(move |at| (at, distance)));
        let (at, spot) = spots.find_map(|(at, distance)| {
            let near = self.obstacles.nearby(at, 2.0 * distance + 2.0 * half.x);
            let is_clear = |spot: &LabelBox| {
                let others = self.placed.iter().map(|other| spot.distance_to_box(other)).fold(f64::INFINITY, f64::min);
                others >= enough && self.is_free(spot) && near.clearance(*spot, enough) >= enough
            };
            boxes_around(at, half, distance).find(is_clear).map(|spot| (at, spot))
        })?;
        // The line ends at the edge of the label.
        let along = spot.centre - at;
        let [x, y] = [half.x / along.x.abs().max(1e-9), half.y / along.y.abs().max(1e-9)];
        let end = spot.centre - along * (1.3 * x.min(y)).min(1.0);
        Some((self.add(spot, text), [at, end]))
    }
}

/// Positions of a curve that are far from a point, the furthest first.
fn far_positions(from: Point, points: &[Point]) -> Vec<Point> {
    /// The most positions.
    const MOST_POSITIONS: usize = 48;
    /// The part of the greatest distance that is far.
    const FAR: f64 = 0.6;
    let stride = points.len().div_ceil(2 * MOST_POSITIONS).max(1);
    let mut positions: Vec<(f64, Point)> = points.iter().step_by(stride).map(|p| ((p - from).norm(), *p)).collect();
    positions.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let least = FAR * positions.first().map_or(0.0, |(distance, _)| *distance);
    let far = positions.into_iter().take_while(|(distance, _)| *distance >= least);
    far.map(|(_, at)| at).take(MOST_POSITIONS).collect()
}

/// Half the width and height of a text: of a number or a capital, with what its letters have under their line.
fn half_size(text: &Text) -> Vector {
    Vector::new(text.width() / 2.0, 0.37 * text.size + 0.5 * descent(text))
}

/// How far letters of a text are under their line.
fn descent(text: &Text) -> f64 {
    /// In ems.
    const DESCENT: f64 = 0.22;
    let descends = |c: char| "gjpqyQJ,;()[]_βγζημξρφχψ".contains(c);
    if text.runs.iter().any(|run| run.text.contains(descends)) { DESCENT * text.size } else { 0.0 }
}

/// The distances of labels from their points, in radii of a joint.
const RING_RADII: [f64; 6] = [1.6, 2.2, 3.0, 4.0, 5.2, 6.8];

/// The clearest box of the nearest ring that has a clear enough one, with its clearance; if there is none, the clearest of
/// all rings.
fn best_box(ring: impl Fn(f64) -> Option<(f64, LabelBox)>, enough: f64) -> Option<(f64, LabelBox)> {
    let mut best: Option<(f64, LabelBox)> = None;
    for radii in RING_RADII {
        best = [best, ring(radii)].into_iter().flatten().reduce(clearer_box);
        if best.is_some_and(|(clearance, _)| clearance >= enough * (1.0 - 1e-9)) {
            break;
        }
    }
    best
}

/// The first box with the greatest clearance, with its clearance.
pub(super) fn clearest_box(
    boxes: impl IntoIterator<Item = LabelBox>,
    clearance: impl Fn(LabelBox) -> f64,
) -> Option<(f64, LabelBox)> {
    boxes.into_iter().map(|spot| (clearance(spot), spot)).reduce(clearer_box)
}

fn clearer_box(first: (f64, LabelBox), second: (f64, LabelBox)) -> (f64, LabelBox) {
    if second.0 > first.0 { second } else { first }
}

/// The boxes around a point at a distance, in 16 directions counterclockwise, starting on the right.
fn boxes_around(centre: Point, half: Vector, distance: f64) -> impl Iterator<Item = LabelBox> {
    const COUNT: usize = 16;
    static DIRECTIONS: LazyLock<[(f64, f64); COUNT]> =
        LazyLock::new(|| std::array::from_fn(|k| trig::cos_sin_deg(360.0 / COUNT as f64 * k as f64)));
    let reach = half + Vector::repeat(distance);
    DIRECTIONS.iter().map(move |(cos, sin)| {
        let centre = centre + Vector::new(cos * reach.x, -sin * reach.y);
        LabelBox { centre, half_size: half }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Color, Stroke};

    #[test]
    fn a_label_may_be_inside_a_circle_that_is_not_filled() {
        let stroke = Some(Stroke { color: Color(0, 0, 0), width: 0.1, has_round_ends: false });
        let circle = |fill| Item::Circle(Circle { centre: Point::origin(), radius: 10.0, stroke, fill });
        let spot = LabelBox { centre: Point::origin(), half_size: Vector::new(1.0, 1.0) };
        let clearance = |fill| {
            let mut obstacles = Obstacles::default();
            obstacles.add(&[circle(fill)], false);
            obstacles.clearance(spot, 1.0)
        };
        assert!(clearance(Some(Color(0, 0, 0))) < 0.0);
        assert_eq!(clearance(None), 1.25);
        let on_line = LabelBox { centre: Point::new(10.0, 0.0), ..spot };
        let mut obstacles = Obstacles::default();
        obstacles.add(&[circle(None)], false);
        assert!(obstacles.clearance(on_line, 1.0) < 0.25);
    }
}

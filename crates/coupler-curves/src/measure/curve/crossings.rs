//! Where a curve crosses itself.

use super::{Arc, Place, SmoothCurve, Stop, StopKind};
use crate::geometry::{Chebyshev, Point, Vector, cross, in_rising_order, left_normal, rising_order};
use crate::measure::budget::MAX_PAIRS;

/// The points at which a curve crosses itself.
#[derive(Clone, Debug, Default)]
pub struct Crossings {
    /// The points, each once however often the curve passes it.
    pub points: Vec<Point>,
    /// The number of places where two parts of the curve come so close, or touch at so small an angle, that it is not
    /// known whether they cross twice or not at all.
    pub doubtful: usize,
    /// Whether more than [`MAX_PAIRS`] pairs of parts would have to be examined, and not all crossings are known.
    pub is_cut_short: bool,
}

/// A part of a curve that turns by less than 60 degrees, and so does not cross itself.
#[derive(Clone, Debug)]
struct Span {
    piece: usize,
    /// The parameters of its ends on the piece.
    from: f64,
    to: f64,
    arc: Arc,
    low: [f64; 2],
    high: [f64; 2],
    direction: Vector,
    /// The sine of the greatest angle of a tangent with the direction; 1 or more if it is not known to be less than a
    /// right angle.
    spread: f64,
}

impl Span {
    fn new(piece: usize, [from, to]: [f64; 2], arc: Arc) -> Span {
        let [[x0, x1], [y0, y1]] = arc.position.each_ref().map(Chebyshev::range);
        let (direction, along, across) = arc.cone();
        let spread = if along > 0.0 { across / (along * along + across * across).sqrt() } else { 1.0 };
        Span { piece, from, to, arc, low: [x0, y0], high: [x1, y1], direction, spread }
    }

    fn halves(&self) -> [Span; 2] {
        let middle = (self.from + self.to) / 2.0;
        let [left, right] = self.arc.halves();
        [Span::new(self.piece, [self.from, middle], left), Span::new(self.piece, [middle, self.to], right)]
    }

    fn width(&self) -> f64 {
        self.to - self.from
    }

    fn place(&self, u: f64) -> Place {
        Place { piece: self.piece, u: self.from + (u + 1.0) / 2.0 * self.width() }
    }

    /// Whether a line along an axis, or along the direction of one of them, passes between both.
    fn is_apart(&self, other: &Span, margin: f64) -> bool {
        let is_between = |[low, high]: [f64; 2], [other_low, other_high]: [f64; 2]| {
            low > other_high + margin || other_low > high + margin
        };
        (0..2).any(|k| is_between([self.low[k], self.high[k]], [other.low[k], other.high[k]]))
            || [self.direction, other.direction].into_iter().any(|along| {
                let [own, others] = [self, other].map(|span| span.arc.heights(left_normal(along)).range());
                is_between(own, others)
            })
    }

    /// Whether no tangent of one is parallel to one of the other.
    fn is_transversal(&self, other: &Span) -> bool {
        let sine = cross(self.direction, other.direction).abs();
        // sin(a + b) of the half angles of both cones.
        let cosine = |sine: f64| (1.0 - sine * sine).max(0.0).sqrt();
        self.spread < 0.7
            && other.spread < 0.7
            && self.spread * cosine(other.spread) + other.spread * cosine(self.spread) < sine
    }
}

/// The sine of the greatest angle of a tangent of a [`Span`] with its direction.
const MAX_SPREAD: f64 = 0.5;

/// Spans narrower than this part of a piece are not divided: 1e-9 of a turn.
const NARROWEST: f64 = 1.6e-8;

impl SmoothCurve {
    /// The points at which the curve crosses itself, apart from the places where it `stops`.
    pub fn crossings(&self, stops: &[Stop]) -> Crossings {
        if self.is_straight() {
            return Crossings::default();
        }
        let mut spans = Vec::with_capacity(2 * self.arcs.len());
        for (piece, arc) in self.arcs.iter().enumerate() {
            divide(Span::new(piece, [-1.0, 1.0], arc.clone()), self.derivative_rounding()[0], &mut spans);
        }
        let size = spans.iter().flat_map(|s| s.high.into_iter().zip(s.low)).map(|(h, l)| h - l).fold(0.0, f64::max);
        let mut search = CrossingSearch {
            curve: self,
            margin: 4.0 * self.rounding,
            found: Vec::new(),
            doubtful: Vec::new(),
            pairs: 0,
            size,
        };
        let (count, margin) = (spans.len(), search.margin);
        let order = rising_order(&spans.iter().map(|span| span.low[0]).collect::<Vec<f64>>());
        for (k, &i) in order.iter().enumerate() {
            for &j in order[k + 1..].iter().take_while(|&&j| spans[j].low[0] <= spans[i].high[0] + margin) {
                let (first, second) = (i.min(j), i.max(j));
                let is_next = second == first + 1 && !self.is_break(&spans[first], &spans[second]);
                let is_last = self.is_closed
                    && first == 0
                    && second + 1 == count
                    && !self.is_break(&spans[second], &spans[first]);
                match (is_next, is_last) {
                    (true, _) => search.examine_neighbours(&spans[first], &spans[second]),
                    (_, true) => search.examine_neighbours(&spans[second], &spans[first]),
                    _ => search.examine(&spans[first], &spans[second]),
                }
            }
        }
        // Around a cusp and where the path returns on itself both parts are one, to rounding.
        let is_at_stop = |p: Point| {
            let near = |stop: &Stop| size * if stop.kind == StopKind::Cusp { 1e-9 } else { 1e-6 };
            stops.iter().any(|stop| (self.point(stop.place) - p).norm() <= near(stop))
        };
        let doubtful = search.doubtful.iter().filter(|place| !is_at_stop(self.point(**place))).count();
        let mut crossings = Crossings { points: Vec::new(), doubtful, is_cut_short: search.pairs > MAX_PAIRS };
        for place in in_rising_order(search.found, |place| 4.0 * place.piece as f64 + place.u) {
            let point = self.point(place);
            if !is_at_stop(point) && crossings.points.iter().all(|other| (other - point).norm() > 1e-9 * size) {
                crossings.points.push(point);
            }
        }
        crossings
    }

    /// Whether the curve is a line, as that of a slider, which is passed again and again and does not cross itself.
    fn is_straight(&self) -> bool {
        /// The greatest distance from the line, relative to the length: less than the error of a long chain of joints.
        const EXACT: f64 = 1e-10;
        let ends = || self.arcs.iter().flat_map(|arc| [arc.point(-1.0), arc.point(0.0)]);
        let Some(first) = ends().next() else { return true };
        let along = ends().map(|point| point - first).fold(Vector::zeros(), |longest, offset| {
            if offset.norm_squared() > longest.norm_squared() { offset } else { longest }
        });
        let length = along.norm();
        let is_on_line = |arc: &Arc| {
            let [x, y] = &arc.position;
            let across = Chebyshev(std::array::from_fn(|k| along.x * y.0[k] - along.y * x.0[k]));
            let offset = cross(along, Vector::new(x.0[0], y.0[0]) - first.coords).abs();
            offset + across.radius() <= EXACT * length * length
        };
        self.arcs.iter().all(is_on_line)
    }

    /// Whether the curve is not smooth from one span to the next, because positions are undefined between them.
    fn is_break(&self, before: &Span, after: &Span) -> bool {
        let gap = before.arc.point(1.0) - after.arc.point(-1.0);
        gap.norm() > 1e-6 * (self.rounding / f64::EPSILON)
    }
}

/// Divides a span into spans that turn little, without those on which the curve is at rest. `rounding` is that of the
/// velocity on a piece.
fn divide(span: Span, rounding: f64, out: &mut Vec<Span>) {
    if span.spread <= MAX_SPREAD || span.width() <= NARROWEST {
        out.push(span);
    } else if span.arc.greatest_speed() > rounding * span.width() / 2.0 {
        let [left, right] = span.halves();
        divide(left, rounding, out);
        divide(right, rounding, out);
    }
}

struct CrossingSearch<'a> {
    curve: &'a SmoothCurve,
    margin: f64,
    found: Vec<Place>,
    doubtful: Vec<Place>,
    pairs: usize,
    size: f64,
}

impl CrossingSearch<'_> {
    /// Finds crossings of a span with the one that continues it.
    fn examine_neighbours(&mut self, before: &Span, after: &Span) {
        // A path that turns by less than a straight angle does not cross itself.
        let turns_little = before.spread < 0.7 && after.spread < 0.7 && before.direction.dot(&after.direction) > 0.0;
        if turns_little || before.width().max(after.width()) <= NARROWEST {
            return;
        }
        let ([b0, b1], [a0, a1]) = (before.halves(), after.halves());
        self.examine_neighbours(&b1, &a0);
        self.examine(&b0, &a0);
        self.examine(&b0, &a1);
        self.examine(&b1, &a1);
    }

    /// Finds crossings of two spans.
    fn examine(&mut self, a: &Span, b: &Span) {
        if a.is_apart(b, self.margin) {
            return;
        }
        self.pairs += 1;
        if self.pairs > MAX_PAIRS {
            return;
        }
        if a.is_transversal(b) {
            // At most one crossing.
            if let Some(found) = self.solve(a, b) {
                self.found.extend(found);
                return;
            }
        } else if self.are_same(a, b) || self.continue_each_other(a, b) {
            return;
        }
        if a.width().max(b.width()) <= NARROWEST {
            if self.doubtful.iter().all(|other| (self.curve.point(*other) - a.arc.point(0.0)).norm() > 1e-6 * self.size)
            {
                self.doubtful.push(a.place(0.0));
            }
            return;
        }
        if a.width() >= b.width() {
            let [left, right] = a.halves();
            self.examine(&left, b);
            self.examine(&right, b);
        } else {
            let [left, right] = b.halves();
            self.examine(a, &left);
            self.examine(a, &right);
        }
    }

    /// The crossing of two transversal spans, if there is one; `None` if Newton's method does not tell.
    fn solve(&self, a: &Span, b: &Span) -> Option<Option<Place>> {
        const BEYOND: f64 = 1.5;
        let (mut u, mut w) = (0.0, 0.0);
        let mut outside = 0;
        for _ in 0..20 {
            let gap = b.arc.point(w) - a.arc.point(u);
            let (va, vb) = (a.arc.velocity(u), b.arc.velocity(w));
            let area = cross(va, vb);
            let (du, dw) = (cross(gap, vb) / area, cross(gap, va) / area);
            if !(du.is_finite() && dw.is_finite()) {
                return None;
            }
            let is_beyond = |at: f64, step: f64| (at + step).abs() > BEYOND;
            if is_beyond(u, du) || is_beyond(w, dw) {
                outside += 1;
                if outside > 3 {
                    return Some(None);
                }
            }
            (u, w) = ((u + du).clamp(-BEYOND, BEYOND), (w + dw).clamp(-BEYOND, BEYOND));
            if du.abs().max(dw.abs()) < 1e-13 {
                // A crossing at the end of both spans is found in both, and counted once.
                let is_inside = |at: f64| at.abs() <= 1.0 + 1e-9;
                return Some((is_inside(u) && is_inside(w)).then(|| a.place(u)));
            }
        }
        None
    }

    /// Whether one span goes on where the other ends, as on a path that is passed again, with hardly a turn: a path that
    /// turns by less than a straight angle does not cross itself.
    fn continue_each_other(&self, a: &Span, b: &Span) -> bool {
        if a.spread >= 0.7 || b.spread >= 0.7 {
            return false;
        }
        let goes_on = |end: f64, start: f64| {
            let gap = (a.arc.point(end) - b.arc.point(start)).norm();
            // Towards the end of the one, and away from the start of the other.
            (a.direction * end).dot(&(b.direction * -start)) > 0.0 && gap <= self.same_distance()
        };
        [(1.0, -1.0), (1.0, 1.0), (-1.0, -1.0), (-1.0, 1.0)].into_iter().any(|(end, start)| goes_on(end, start))
    }

    /// The distance up to which points are the same.
    fn same_distance(&self) -> f64 {
        1e-11 * self.size + 8.0 * self.curve.rounding
    }

    /// Whether two spans are parts of the same path, where both are near each other.
    fn are_same(&self, a: &Span, b: &Span) -> bool {
        let mut met = 0;
        for (one, other) in [(a, b), (b, a)] {
            for u in [-0.6, 0.1, 0.7] {
                let point = one.arc.point(u);
                let Some(foot) = other.arc.foot(point) else { continue };
                let distance = (other.arc.point(foot) - point).norm();
                if distance > self.same_distance() {
                    return false;
                }
                met += 1;
            }
        }
        met > 1
    }
}

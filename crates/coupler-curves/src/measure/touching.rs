//! The points of portions of a curve, and where they touch a line or a circle.

use super::row::Row;
use super::strip::min_max;
use crate::geometry::{Point, Vector};

/// A family of parallel lines or concentric circles.
pub(super) trait Levels {
    /// The height of a point: which line or circle it is on.
    fn height(&self, point: Point) -> f64;

    /// The first and the second derivative of the height of a moving point, from its velocity and its acceleration.
    fn height_rates(&self, point: Point, velocity: Vector, acceleration: Vector) -> [f64; 2];
}

/// A point of a portion where the curve touches a line or a circle, or one of its ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    /// The index of the point in the portion.
    pub index: usize,
    point: Point,
    /// The velocity and the acceleration there; `None` for an end.
    rates: Option<[Vector; 2]>,
}

impl Contact {
    /// The point, moved to where the curve touches one of the levels.
    pub fn touching(&self, levels: &impl Levels) -> Point {
        let Some([velocity, acceleration]) = self.rates else { return self.point };
        let step = self.step(levels);
        self.point + velocity * step + acceleration * (step * step / 2.0)
    }

    /// The height of the level that the curve touches.
    pub fn height(&self, levels: &impl Levels) -> f64 {
        let height = levels.height(self.point);
        let Some([velocity, acceleration]) = self.rates else { return height };
        // The height of the vertex of a parabola is that of its tangent halfway to it.
        height + levels.height_rates(self.point, velocity, acceleration)[0] * self.step(levels) / 2.0
    }

    /// Whether the curve is as good as a parabola up to where it touches one of the levels. It is not where it is so flat
    /// that the place moves far as the levels turn.
    pub fn is_close(&self, levels: &impl Levels) -> bool {
        let step = |[velocity, acceleration]: [Vector; 2]| vertex(levels, self.point, velocity, acceleration);
        self.rates.is_none_or(|rates| step(rates).abs() < CLOSE)
    }

    /// How far it is to where the curve touches one of the levels; 0 if it is not near.
    fn step(&self, levels: &impl Levels) -> f64 {
        let Some([velocity, acceleration]) = self.rates else { return 0.0 };
        let step = vertex(levels, self.point, velocity, acceleration);
        if step.abs() <= 1.0 { step } else { 0.0 }
    }
}

/// The part of the distance of two points over which the curve is as good as a parabola.
const CLOSE: f64 = 0.02;

/// How far it is to where the height of a moving point is stationary.
fn vertex(levels: &impl Levels, point: Point, velocity: Vector, acceleration: Vector) -> f64 {
    let [first, second] = levels.height_rates(point, velocity, acceleration);
    let step = -first / second;
    if step.is_finite() { step } else { 0.0 }
}

/// The points of portions of a row's curve near each other: the ends, and evenly spaced points between them.
#[derive(Clone, Debug)]
pub(super) struct PortionPoints<'a> {
    row: &'a Row,
    /// The distance of the points, as a difference of positions.
    spacing: f64,
    /// The index of the first of `all`: the number of spacings from position 0.
    first: i64,
    all: Vec<Point>,
    /// The points of the portion.
    pub points: Vec<Point>,
    /// Its ends, in units of the spacing, and the velocities there in them.
    positions: [f64; 2],
    velocities: [Vector; 2],
    /// The index of the first point between the ends.
    begin: i64,
    heights: Vec<f64>,
}

impl<'a> PortionPoints<'a> {
    /// For portions about as long as the one between two positions, with about this many points.
    pub fn new(row: &'a Row, [from, to]: [f64; 2], count: usize) -> PortionPoints<'a> {
        /// The least spacing for which the points of the row are used: they need not be computed.
        const FINE: f64 = 0.25;
        let spacing = (to - from) / count as f64;
        PortionPoints {
            row,
            spacing: if spacing >= FINE { spacing.floor().max(1.0) } else { spacing },
            first: 0,
            all: Vec::new(),
            points: Vec::with_capacity(2 * count),
            positions: [0.0; 2],
            velocities: [Vector::zeros(); 2],
            begin: 0,
            heights: Vec::with_capacity(2 * count),
        }
    }

    /// Turns to the portion between two positions.
    pub fn turn_to(&mut self, ends: [f64; 2]) {
        /// A point closer to an end than this part of the spacing says nothing that the end does not.
        const TOO_CLOSE: f64 = 0.3;
        self.positions = ends.map(|position| position / self.spacing);
        let [from, to] = self.positions;
        self.begin = (from + TOO_CLOSE).ceil() as i64;
        let end = ((to - TOO_CLOSE).floor() as i64 + 1).max(self.begin);
        self.prepare([self.begin, end]);
        let [first, last] = ends.map(|position| self.row.point_and_velocity_at(position));
        self.velocities = [first.1, last.1].map(|velocity| velocity * self.spacing);
        self.points.clear();
        self.points.push(first.0);
        let [begin, end] = [self.begin, end].map(|k| (k - self.first) as usize);
        self.points.extend_from_slice(&self.all[begin..end]);
        self.points.push(last.0);
    }

    /// Makes sure that there are the points from one index to before another.
    fn prepare(&mut self, [from, to]: [i64; 2]) {
        /// So many points more, for the portions that come next.
        const MARGIN: i64 = 4;
        let between = |row: &Row, from: i64, to: i64| match self.spacing {
            spacing if spacing >= 1.0 => (from..=to).map(|k| row.nth_point(k * spacing as i64)).collect(),
            spacing => row.points_between([from, to].map(|k| k as f64 * spacing), (to - from) as usize),
        };
        if self.all.is_empty() {
            self.first = from - MARGIN;
            self.all = between(self.row, self.first, to + MARGIN);
        }
        if from < self.first {
            let before = between(self.row, from - MARGIN, self.first);
            self.all.splice(..1, before);
            self.first = from - MARGIN;
        }
        let last = self.first + self.all.len() as i64 - 1;
        if to > last {
            let after = between(self.row, last, to + MARGIN);
            self.all.extend_from_slice(&after[1..]);
        }
    }

    /// The index of the last point of the portion.
    pub fn last(&self) -> usize {
        self.points.len() - 1
    }

    /// The derivatives of the start and of the end with respect to their positions in the row.
    pub fn end_velocities(&self) -> [Vector; 2] {
        self.velocities.map(|velocity| velocity / self.spacing)
    }

    /// A number of a point of the portion that a similar portion has, too: the least for the start and the greatest for
    /// the end.
    pub fn label(&self, index: usize) -> i64 {
        match index {
            0 => i64::MIN,
            k if k == self.last() => i64::MAX,
            k => self.begin + k as i64,
        }
    }

    /// Collects the ends and the points near which the curve touches the outer ones of the levels of the portion, or
    /// nearly does, and those of given indices.
    pub fn collect_contacts(&mut self, levels: &impl Levels, kept: &[usize], contacts: &mut Vec<Contact>) {
        /// An extreme is higher than the points next to it by less than this part of the range.
        const NEAR: f64 = 0.05;
        let points = &self.points;
        let last = points.len() - 1;
        self.heights.clear();
        self.heights.extend(points.iter().map(|&p| levels.height(p)));
        let heights = &self.heights;
        let [low, high] = min_max(heights, |height| *height);
        let near = NEAR * (high - low);
        let is_near = |k: usize| heights[k] >= high - near || heights[k] <= low + near;
        let is_extreme = |k: usize| (heights[k] - heights[k - 1]) * (heights[k + 1] - heights[k]) <= 0.0;
        let extreme = |index, at, rates, bounds| self.extreme(levels, index, at, rates, bounds);
        // The distances of the ends from the points next to them; those of all others are 1.
        let [from, to] = self.positions;
        let gaps = [self.begin as f64 - from, to - (self.begin + last as i64 - 2) as f64];
        // The extreme between an end and the point next to it, if neither is it.
        let next_to_end = |end: usize, next: usize, at: f64, velocity: Vector, gap: f64| {
            if last < 2 || !is_near(end) || is_extreme(next) {
                return None;
            }
            let slope = (points[next] - points[end]) / gap;
            let rate = |point: Point, velocity: Vector| levels.height_rates(point, velocity, Vector::zeros())[0];
            let is_between = rate(points[end], velocity) * rate(points[next], slope * 2.0 - velocity) < 0.0;
            let acceleration = (slope - velocity) * (2.0 / gap);
            is_between.then(|| extreme(next, (at, points[end]), [velocity, acceleration], [gap.min(0.0), gap.max(0.0)]))
        };
        contacts.clear();
        contacts.push(Contact { index: 0, point: points[0], rates: None });
        contacts.extend(next_to_end(0, 1, from, self.velocities[0], gaps[0]));
        for k in 1..last {
            let may_touch = is_extreme(k) && is_near(k);
            if !may_touch && !kept.contains(&k) {
                continue;
            }
            // The parabola through the point and its neighbours.
            let before = if k == 1 { gaps[0] } else { 1.0 };
            let after = if k + 1 == last { gaps[1] } else { 1.0 };
            let slopes = [(points[k] - points[k - 1]) / before, (points[k + 1] - points[k]) / after];
            let acceleration = (slopes[1] - slopes[0]) * (2.0 / (before + after));
            let velocity = (slopes[0] * after + slopes[1] * before) / (before + after);
            let at = (self.begin + k as i64 - 1) as f64;
            contacts.push(extreme(k, (at, points[k]), [velocity, acceleration], [-before, after]));
        }
        contacts.extend(next_to_end(last, last.max(1) - 1, to, self.velocities[1], -gaps[1]));
        contacts.push(Contact { index: last, point: points[last], rates: None });
    }

    /// The extreme height near that of the parabola with a velocity and an acceleration at a position, by Newton's
    /// method, to where the curve is as good as a parabola.
    fn extreme(
        &self,
        levels: &impl Levels,
        index: usize,
        (at, point): (f64, Point),
        [velocity, acceleration]: [Vector; 2],
        [least, most]: [f64; 2],
    ) -> Contact {
        const ROUNDS: usize = 6;
        const SMALL: f64 = 1e-3;
        let mut step = vertex(levels, point, velocity, acceleration).clamp(least, most);
        let mut round = 1;
        loop {
            let (point, [velocity, acceleration]) = self.row.point_and_rates_at((at + step) * self.spacing);
            let rates = [velocity * self.spacing, acceleration * (self.spacing * self.spacing)];
            let next = (step + vertex(levels, point, rates[0], rates[1])).clamp(least, most);
            if (next - step).abs() < SMALL || round == ROUNDS {
                return Contact { index, point, rates: Some(rates) };
            }
            step = next;
            round += 1;
        }
    }
}

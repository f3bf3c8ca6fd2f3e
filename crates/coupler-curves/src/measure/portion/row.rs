//! A row of points along a curve, in which straight and circular portions are searched for.

use std::cell::OnceCell;
use std::rc::Rc;

use super::every_nth::EveryNth;
use super::longest_near::Limits;
use crate::geometry::{Point, Vector};
use crate::measure::curve::{Place, SmoothCurve};
use crate::numerical::{Bracket, border, partition_point};

/// Points of a curve, in order, no further apart than a given length.
///
/// A *position* is a fractional index of the points: position 2.5 is between points 2 and 3. Points at any position are
/// those of the curve. The points of a closed curve are repeated once, so that a portion across its first point is a row
/// of points too.
#[derive(Clone, Debug)]
pub struct Row {
    curve: Rc<SmoothCurve>,
    /// The points.
    pub points: Vec<Point>,
    /// The total travel of the input, forward and backward, up to each point.
    pub input_travel: Vec<f64>,
    /// The number of points at which a portion may begin.
    pub start_count: usize,
    /// Whether its first point follows its last.
    pub is_closed: bool,
    /// The length of the polyline up to each point.
    pub cumulative_length: Vec<f64>,
    /// The place of each point of the first round, and the parameter from it to the next.
    places: Vec<(Place, f64)>,
    /// The points of the first round that are points of every portion, in order: where there may be a corner, where the curve
    /// stops, and where it bends sharply. The ends of an open curve are none.
    bends: Vec<usize>,
    /// Every point, every second, every fourth and so on, as far as they have been asked for.
    every_nth: [OnceCell<EveryNth>; Row::MAX_POINTS.ilog2() as usize + 1],
}

impl Row {
    /// No more points than about this, for a curve that is very long compared with the spacing.
    const MAX_POINTS: usize = 50_000;

    /// Points of a whole curve, no further apart than `spacing`; `None` if the curve has no length. `bends` are places that are
    /// points of every portion, in order.
    pub fn new(curve: &Rc<SmoothCurve>, bends: &[Place], spacing: f64) -> Option<Row> {
        let lengths: Vec<f64> = curve.arcs.iter().map(|arc| 2.0 * arc.greatest_speed()).collect();
        let spacing = spacing.max(lengths.iter().sum::<f64>() / Row::MAX_POINTS as f64);
        if !(spacing > 0.0 && spacing.is_finite()) {
            return None;
        }
        let parts = |length: f64| (length / spacing).ceil().max(2.0) as usize;
        let count = lengths.iter().map(|length| parts(*length)).sum::<usize>() + 2 * bends.len() + 1;
        let (mut places, mut travel) = (Vec::with_capacity(count), Vec::with_capacity(2 * count));
        let mut indices = Vec::new();
        let mut before = 0.0;
        for (piece, length) in lengths.iter().enumerate() {
            let bends = || bends.iter().filter(|bend| bend.piece == piece).map(|bend| bend.u);
            let is_corner = curve.corners[piece] || bends().any(|u| u == -1.0);
            let cuts: Vec<f64> = [-1.0].into_iter().chain(bends().filter(|u| *u > -1.0)).chain([1.0]).collect();
            for (k, ends) in cuts.windows(2).enumerate() {
                if k > 0 || (is_corner && (curve.is_closed || piece > 0)) {
                    indices.push(places.len());
                }
                let width = ends[1] - ends[0];
                let parts = parts(*length * width / 2.0);
                let step = width / parts as f64;
                for part in 0..parts {
                    let u = ends[0] + step * part as f64;
                    places.push((Place { piece, u }, step));
                    travel.push(before + curve.pieces[piece].input_travel_to(u));
                }
            }
            before += curve.pieces[piece].input_travel();
        }
        if !curve.is_closed {
            // The end is approached at the speed of the interval before it.
            let step = places.last().map_or(0.0, |(_, step)| *step);
            places.push((Place { piece: curve.arcs.len() - 1, u: 1.0 }, step));
            travel.push(before);
        }
        let mut points = curve.points(&places.iter().map(|(place, _)| *place).collect::<Vec<Place>>());
        let count = points.len();
        if curve.is_closed {
            points.extend_from_within(..);
            travel.extend_from_within(..);
            travel[count..].iter_mut().for_each(|travel| *travel += before);
        }
        let mut total = 0.0;
        let steps = points.windows(2).map(|pair| {
            total += (pair[1] - pair[0]).norm();
            total
        });
        let cumulative_length: Vec<f64> = std::iter::once(0.0).chain(steps).collect();
        let start_count = if curve.is_closed { count } else { count - 1 };
        (cumulative_length[cumulative_length.len() - 1] > 0.0).then_some(Row {
            curve: curve.clone(),
            points,
            input_travel: travel,
            start_count,
            is_closed: curve.is_closed,
            cumulative_length,
            places,
            bends: indices,
            every_nth: Default::default(),
        })
    }

    /// Every nth point; n is a power of two.
    pub fn every_nth(&self, n: usize) -> &EveryNth {
        self.every_nth[n.ilog2() as usize].get_or_init(|| EveryNth::new(self, n))
    }

    /// The last point at which a portion that begins at a point may end.
    pub fn last_end(&self, from: usize) -> usize {
        if self.is_closed { from + self.start_count - 1 } else { self.points.len() - 1 }
    }

    /// The first point after another that is further along the polyline than a distance, searched for from a `guess`.
    pub fn first_point_beyond(&self, from: usize, distance: f64, guess: usize) -> usize {
        let far = self.cumulative_length[from] + distance;
        partition_point(from + 1..self.cumulative_length.len(), guess, |to| self.cumulative_length[to] <= far)
    }

    /// The positions that a portion may not leave, and the positions it may span.
    pub fn limits(&self) -> Limits {
        match self.is_closed {
            true => Limits { low: f64::NEG_INFINITY, high: f64::INFINITY, span: self.start_count as f64 },
            false => Limits { low: 0.0, high: self.start_count as f64, span: self.start_count as f64 },
        }
    }

    /// The positions that a portion may not leave when it is extended from one between two positions.
    pub fn bounds(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        let Limits { low, high, span } = self.limits();
        [from.max(low), to.min(high).min(from + span)]
    }

    /// Whether the curve may go back along itself, so that the points of a portion are not in their order around a centre.
    pub fn is_folded(&self) -> bool {
        !self.bends.is_empty()
    }

    /// The points of the first round that are points of every portion: corners, stops and sharp bends.
    pub fn bends(&self) -> &[usize] {
        &self.bends
    }

    /// Those strictly between two positions, in order; on a closed curve they may be negative.
    pub fn bends_between(&self, [from, to]: [f64; 2]) -> Vec<i64> {
        let mut found = Vec::new();
        if self.bends.is_empty() {
            return found;
        }
        let round = self.start_count as i64;
        let rounds = if self.is_closed { from as i64 / round - 1..=to as i64 / round } else { 0..=0 };
        for first in rounds.map(|k| k * round) {
            for bend in self.bends.iter().map(|bend| first + *bend as i64) {
                if from < bend as f64 && (bend as f64) < to {
                    found.push(bend);
                }
            }
        }
        found
    }

    /// The derivatives of the point with respect to the position before and after a corner.
    pub fn velocities_at_corner(&self, corner: i64) -> [Vector; 2] {
        let index = corner.rem_euclid(self.start_count as i64) as usize;
        let [(before, before_step), (after, after_step)] =
            [(index + self.start_count - 1) % self.start_count, index].map(|k| self.places[k]);
        let arcs = &self.curve.arcs;
        let end = (before.u + before_step).min(1.0);
        [arcs[before.piece].velocity(end) * before_step, arcs[after.piece].velocity(after.u) * after_step]
    }

    /// A point of the row; on a closed curve its index may be negative, on others the last is repeated.
    pub fn nth_point(&self, index: i64) -> Point {
        if self.is_closed {
            return self.points[index.rem_euclid(self.start_count as i64) as usize];
        }
        self.points[index.clamp(0, self.points.len() as i64 - 1) as usize]
    }

    /// The place at a position; on a closed curve it may be negative.
    pub fn place(&self, position: f64) -> Place {
        self.place_and_step(position).0
    }

    /// The place at a position, and the parameter from one position to the next there.
    fn place_and_step(&self, position: f64) -> (Place, f64) {
        // Whole numbers are several times as fast as the functions of f64, which call the library of C.
        let truncated = position as i64;
        let whole = truncated - i64::from(truncated as f64 > position);
        let count = self.start_count as i64;
        let index = match self.is_closed {
            true if !(0..count).contains(&whole) => whole.rem_euclid(count),
            _ => whole.max(0),
        };
        let (place, step) = self.places[(index as usize).min(self.places.len() - 1)];
        (Place { u: (place.u + step * (position - whole as f64)).min(1.0), ..place }, step)
    }

    /// The point at a position.
    pub fn point_at(&self, position: f64) -> Point {
        match position {
            _ if position >= 0.0 && position.fract() == 0.0 && (position as usize) < self.points.len() => {
                self.points[position as usize]
            }
            _ => self.curve.point(self.place(position)),
        }
    }

    /// The point at a position, and its derivative with respect to the position.
    pub fn point_and_velocity_at(&self, position: f64) -> (Point, Vector) {
        let (place, step) = self.place_and_step(position);
        let arc = &self.curve.arcs[place.piece];
        (arc.point(place.u), arc.velocity(place.u) * step)
    }

    /// The point at a position, and its first and its second derivative with respect to the position.
    pub fn point_and_rates_at(&self, position: f64) -> (Point, [Vector; 2]) {
        let (place, step) = self.place_and_step(position);
        let (point, [velocity, acceleration]) = self.curve.arcs[place.piece].point_and_rates(place.u);
        (point, [velocity * step, acceleration * (step * step)])
    }

    /// The input at a position.
    pub fn input_at(&self, position: f64) -> f64 {
        self.curve.input(self.place(position))
    }

    /// The input that the portion between two positions spans.
    pub fn input_span(&self, [from, to]: [f64; 2]) -> f64 {
        self.input_travel_at(to) - self.input_travel_at(from)
    }

    /// The travel of the input, forward and backward, from position 0 to another.
    pub fn input_travel_at(&self, position: f64) -> f64 {
        let round = self.start_count as f64;
        if self.is_closed && !(0.0..2.0 * round).contains(&position) {
            let rounds = (position / round).floor();
            return self.input_travel_at(position - rounds * round) + rounds * self.input_travel[self.start_count];
        }
        let index = (position as usize).min(self.points.len() - 1);
        let (place, step) = self.places[index % self.places.len()];
        let piece = &self.curve.pieces[place.piece];
        let part = position - index as f64;
        self.input_travel[index] + piece.input_travel_to((place.u + step * part).min(1.0))
            - piece.input_travel_to(place.u)
    }

    /// The derivative of the travel of the input with respect to the position.
    pub fn input_travel_rate_at(&self, position: f64) -> f64 {
        let (place, step) = self.place_and_step(position);
        (self.curve.pieces[place.piece].map.input_rate(place.u) * step).abs()
    }

    /// The position that is a span of input after another.
    pub fn end_after_input(&self, from: f64, span: f64) -> Option<f64> {
        let first = from as usize;
        let start = self.input_travel_at(from);
        // The whole of a closed curve ends where it begins.
        let last = if self.is_closed { first + self.start_count } else { self.last_end(first) };
        let last = last.min(self.points.len() - 1);
        let span = span * (1.0 - 1e-12);
        let beyond = first + self.input_travel[first..=last].partition_point(|&travel| travel - start < span);
        if beyond > last {
            return None;
        }
        let before = beyond.saturating_sub(1);
        let travel = if from < before as f64 { self.input_travel[before] } else { start };
        let ends = [from.max(before as f64), beyond as f64];
        let excess = |at: f64| self.input_travel_at(at) - start - span;
        let excesses = [travel, self.input_travel[beyond]].map(|travel| travel - start - span);
        let end = if excesses[0] < 0.0 { ends[1] } else { ends[0] };
        Some(Bracket::new(ends, excesses).map_or(end, |bracket| bracket.zero(0.0, excess)))
    }

    /// The first position after another whose point is at a distance from that of the other.
    pub fn end_after_length(&self, from: f64, length: f64) -> Option<f64> {
        let start = self.point_at(from);
        let first = from as usize;
        let mut to = first + 1;
        let last = self.last_end(first).min(self.points.len() - 1);
        while to <= last {
            let far = (self.points[to] - start).norm();
            if far >= length {
                break;
            }
            to = self.first_point_beyond(to, length - far, to + 1);
        }
        if to > last {
            return None;
        }
        let ends = [(to as f64 - 1.0).max(from), to as f64];
        let [_, end] = border(ends, 4.0 * f64::EPSILON, |to| (self.point_at(to) - start).norm() < length);
        Some(end)
    }

    /// The signed distance of a point from the curve near a position, positive to the left and beyond an end, and the direction
    /// in which it grows: the curve's normal, but beyond an end.
    pub fn signed_distance(&self, point: Point, mut position: f64) -> Option<(f64, Vector)> {
        /// Most feet are found in three rounds; at a sharp bend, where the curve is slow, more are needed.
        const ROUNDS: usize = 16;
        let mut nearest: Option<(f64, Vector, Vector)> = None;
        for _ in 0..ROUNDS {
            let (place, step) = self.place_and_step(position);
            let offset = point - self.curve.point(place);
            let velocity = self.curve.arcs[place.piece].velocity(place.u) * step;
            let distance = offset.norm();
            if nearest.is_none_or(|(least, ..)| distance < least) {
                nearest = Some((distance, offset, velocity));
            }
            let correction = offset.dot(&velocity) / velocity.norm_squared();
            if correction.is_nan() || correction.abs() <= 1e-9 {
                break;
            }
            position += correction.clamp(-0.5, 0.5);
            if !self.is_closed {
                position = position.clamp(0.0, (self.places.len() - 1) as f64);
            }
        }
        let (distance, offset, velocity) = nearest?;
        // Beyond the end of a path, and at a cusp, the nearest point is not at the foot of a perpendicular: the distance
        // grows away from that point.
        let perpendicular = Vector::new(-velocity.y, velocity.x)
            .try_normalize(0.0)
            .filter(|normal| distance <= 1.001 * normal.dot(&offset).abs());
        match perpendicular {
            Some(normal) => Some((normal.dot(&offset), normal)),
            None => offset.try_normalize(0.0).map(|away| (distance, away)),
        }
    }

    /// The points at some positions.
    pub fn points_at(&self, positions: &[f64]) -> Vec<Point> {
        self.curve.points(&positions.iter().map(|&position| self.place(position)).collect::<Vec<Place>>())
    }

    /// The points between two positions, inclusive: `parts` intervals of equal size.
    pub fn points_between(&self, [from, to]: [f64; 2], parts: usize) -> Vec<Point> {
        self.points_at(&(0..=parts).map(|k| from + (to - from) * (k as f64 / parts as f64)).collect::<Vec<f64>>())
    }
}

impl EveryNth {
    /// Of a row.
    pub fn new(row: &Row, stride: usize) -> EveryNth {
        let positions: Vec<usize> = (0..row.points.len()).collect();
        let start_count = row.start_count.div_ceil(stride);
        EveryNth {
            points: every_nth_of_round(&row.points, row.start_count, stride),
            lengths: every_nth_of_round(&row.cumulative_length, row.start_count, stride),
            travel: every_nth_of_round(&row.input_travel, row.start_count, stride),
            start_count,
            is_closed: row.is_closed,
            positions: every_nth_of_round(&positions, row.start_count, stride),
            stride,
        }
    }
}

/// Every nth of the values of one round, and of those after it.
fn every_nth_of_round<T: Copy>(values: &[T], round: usize, stride: usize) -> Vec<T> {
    if stride == 1 {
        return values.to_vec();
    }
    let (first, second) = values.split_at(round);
    first.iter().step_by(stride).chain(second.iter().step_by(stride)).copied().collect()
}

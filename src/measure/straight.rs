//! The straightest portion of a curve.
//!
//! A portion lies in a *strip*: the narrowest band between two parallel lines that holds it, so that the line in the
//! strip's middle is the minimax line of the portion. Its *length* is that of its projection on that line, and its
//! *deviation* half the strip's width: no point of it is further from the line.
//!
//! Of a tolerance, the longest portion is wanted whose strip is no wider than that part of its length. What fits a strip
//! of some width fits with any part of it, so that the longest portion for a given width is found by moving both ends
//! along the curve once. The width allowed goes with the length found: begun with the curve's whole extent, which nothing
//! exceeds, lengths and widths fall to the greatest length that allows itself. That is exact for the samples; then both
//! ends are moved between them. A portion may go over sample 0 of a closed curve, and over limits.

use super::trail::Trail;
use super::{Measure, Subject, Value};
use crate::geometry::{Point, Vector, cross};

/// What is asked of the straight portion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Straight {
    /// The longest whose strip is no wider than this part of its length.
    Tolerance(f64),
    /// The straightest that spans this much input, in degrees or as a length.
    Input(f64),
    /// The straightest of this length.
    Length(f64),
}

impl Default for Straight {
    fn default() -> Straight {
        Straight::Tolerance(0.001)
    }
}

/// A straight portion.
#[derive(Clone, Debug, PartialEq)]
pub struct Portion {
    /// The length of its projection on its line.
    pub length: f64,
    /// The greatest distance of its points from that line.
    pub deviation: f64,
    /// The input at which it begins.
    pub start: f64,
    /// How much input it spans, there and back over limits.
    pub input: f64,
    /// Its points: the samples, and between them its ends.
    pub points: Vec<Point>,
}

/// Its length.
pub const LENGTH: Measure = Measure {
    name: "straight_length",
    unit: "",
    is_word: false,
    definition: "length of the straightest portion, projected on its line, in the manifest's unit: the longest in a strip no wider than 0.001 of it, or as the family's `straight` has it",
    take: |subject: &Subject| of(subject, |portion| portion.length),
};

/// Its deviation.
pub const DEVIATION: Measure = Measure {
    name: "straight_deviation",
    unit: "",
    is_word: false,
    definition: "greatest distance of the straightest portion from its line, half the width of its strip, in the manifest's unit",
    take: |subject: &Subject| of(subject, |portion| portion.deviation),
};

/// Where it begins.
pub const START: Measure = Measure {
    name: "straight_start_deg",
    unit: "deg",
    is_word: false,
    definition: "input at which the straightest portion begins; of an actuator a length",
    take: |subject: &Subject| of(subject, |portion| portion.start),
};

/// What it spans.
pub const INPUT: Measure = Measure {
    name: "straight_input_deg",
    unit: "deg",
    is_word: false,
    definition: "input the straightest portion spans; of an actuator a length",
    take: |subject: &Subject| of(subject, |portion| portion.input),
};

fn of(subject: &Subject, value: fn(&Portion) -> f64) -> Value {
    subject.straight().map_or(Value::Missing, |portion| Value::Number(value(portion)))
}

/// The portion asked for, of a curve with the input of each of its points; `None` where there is none so long.
pub(super) fn portion(trail: &Trail, inputs: &[f64], asked: Straight) -> Option<Portion> {
    if trail.points.len() < 3 {
        return None;
    }
    let inputs = steps(inputs);
    let curve = Curve::of(trail, &inputs);
    let ends = match asked {
        Straight::Tolerance(tolerance) => curve.longest(tolerance)?,
        Straight::Input(span) => curve.straightest(|from| curve.after_input(from, span))?,
        Straight::Length(length) => curve.straightest(|from| curve.after_length(from, length))?,
    };
    Some(curve.portion(ends))
}

/// A curve, or a piece of one, by places on it: place 2.5 is between points 2 and 3, and on a closed curve places go on
/// after the last.
struct Curve<'a> {
    trail: &'a Trail,
    /// Where its first point is among the samples, and how far its points are apart there.
    first: f64,
    apart: f64,
    closed: bool,
    points: Vec<Point>,
    /// The input at each sample, and how far it goes to the next.
    inputs: &'a [[f64; 2]],
}

/// The narrowest band between two parallel lines that holds some points.
#[derive(Clone, Copy)]
struct Strip {
    width: f64,
    /// How far the points reach along it.
    length: f64,
}

impl Curve<'_> {
    /// The whole curve, by two points to a sample or more: a portion's width is that of its points.
    fn of<'a>(trail: &'a Trail, inputs: &'a [[f64; 2]]) -> Curve<'a> {
        const POINTS: usize = 720;
        let fold = POINTS.div_ceil(trail.points.len());
        let count = trail.intervals() * fold + usize::from(!trail.closed);
        Curve::sampled(trail, inputs, (0.0, 1.0 / fold as f64), (count, trail.closed))
    }

    fn sampled<'a>(
        trail: &'a Trail,
        inputs: &'a [[f64; 2]],
        (first, apart): (f64, f64),
        (count, closed): (usize, bool),
    ) -> Curve<'a> {
        let points = (0..count).map(|k| at(trail, first + k as f64 * apart)).collect();
        Curve { trail, first, apart, closed, points, inputs }
    }

    /// A piece of it, by many points.
    fn piece(&self, [from, to]: [f64; 2]) -> Curve<'_> {
        const INTERVALS: usize = 256;
        let apart = (to - from) * self.apart / INTERVALS as f64;
        let first = self.first + from * self.apart;
        Curve::sampled(self.trail, self.inputs, (first, apart), (INTERVALS + 1, false))
    }

    fn len(&self) -> usize {
        self.points.len()
    }

    /// The greatest number a place of a portion that begins at a sample may have.
    fn last(&self, from: usize) -> usize {
        if self.closed { from + self.len() - 1 } else { self.len() - 1 }
    }

    fn sample(&self, k: usize) -> Point {
        self.points[k % self.len()]
    }

    /// The point at a place.
    fn point(&self, place: f64) -> Point {
        if place.fract() == 0.0 {
            return self.sample(place as usize);
        }
        at(self.trail, self.first + place * self.apart)
    }

    /// The points of a portion, its ends among them; more between them where they are few.
    fn points(&self, [from, to]: [f64; 2]) -> Vec<Point> {
        const POINTS: f64 = 48.0;
        let parts = (POINTS / (to - from)).ceil().max(1.0);
        let first = (from * parts).floor() as usize + 1;
        let inside = (first..).map(|k| k as f64 / parts).take_while(|&place| place < to).map(|place| self.point(place));
        std::iter::once(self.point(from)).chain(inside).chain(std::iter::once(self.point(to))).collect()
    }

    /// How far the input goes, there and back, from a point to the next.
    fn step(&self, k: usize) -> f64 {
        self.spanned([k as f64, k as f64 + 1.0])
    }

    /// How much the input goes, there and back, from one place to another.
    fn spanned(&self, ends: [f64; 2]) -> f64 {
        let [from, to] = ends.map(|place| self.first + place * self.apart);
        let step = |k: usize| self.inputs[k % self.inputs.len()][1].abs();
        let whole: f64 = (from.floor() as usize..to.floor() as usize).map(step).sum();
        let part = |place: f64| if place.fract() > 0.0 { place.fract() * step(place as usize) } else { 0.0 };
        whole - part(from) + part(to)
    }

    fn input(&self, place: f64) -> f64 {
        let place = self.first + place * self.apart;
        let [at, step] = self.inputs[place.floor() as usize % self.inputs.len()];
        at + step * place.fract()
    }

    fn portion(&self, ends: [f64; 2]) -> Portion {
        let points = self.points(ends);
        let Strip { width, length } = strip(&hull(points.clone()));
        Portion { length, deviation: width / 2.0, start: self.input(ends[0]), input: self.spanned(ends), points }
    }

    /// The ends of the longest portion with a strip no wider than a part of its length. One of few points is looked for
    /// again among many, about there.
    fn longest(&self, tolerance: f64) -> Option<[f64; 2]> {
        const FEW: f64 = 12.0;
        const ABOUT: f64 = 2.0;
        let [from, to] = self.longest_by_points(tolerance)?;
        if to - from >= FEW {
            return Some([from, to]);
        }
        let whole = self.len() as f64;
        let [mut from, mut to] = [from - ABOUT, to + ABOUT];
        if self.closed {
            // Places are not negative.
            (from, to) = if from < 0.0 { (from + whole, to + whole) } else { (from, to) };
        } else {
            (from, to) = (from.max(0.0), to.min(whole - 1.0));
        }
        let piece = self.piece([from, to]);
        let part = (to - from) / (piece.len() - 1) as f64;
        Some(piece.longest_by_points(tolerance)?.map(|place| from + place * part))
    }

    fn longest_by_points(&self, tolerance: f64) -> Option<[f64; 2]> {
        let origin = self.points[0];
        let reach = self.points.iter().fold(0.0, |reach: f64, p| reach.max((p - origin).norm()));
        let mut width = tolerance * 2.0 * reach;
        let mut found = self.longest_within(width)?;
        loop {
            let own = strip(&hull(self.points(found.map(|k| k as f64))));
            let allowed = tolerance * own.length;
            if allowed >= width || own.width <= allowed {
                break;
            }
            width = allowed;
            found = self.longest_within(width)?;
        }
        Some(self.drawn_out(found, tolerance))
    }

    /// The samples at the ends of the longest portion in a strip of some width.
    fn longest_within(&self, width: f64) -> Option<[usize; 2]> {
        let longest_chord =
            (0..self.last(0)).map(|k| (self.sample(k + 1) - self.sample(k)).norm()).fold(f64::MIN_POSITIVE, f64::max);
        let mut best = 0.0;
        let mut found = None;
        for from in 0..self.len() {
            let distance = |to: usize| (self.sample(to) - self.sample(from)).norm();
            let mut to = from + 1;
            while to <= self.last(from) {
                let far = distance(to);
                if far <= best {
                    // So many samples at least until it is as far as the best.
                    to += (((best - far) / longest_chord) as usize).max(1);
                } else if self.fits([from, to], width) {
                    (best, found) = (far, Some([from, to]));
                    to += 1;
                } else {
                    break;
                }
            }
        }
        found
    }

    /// Whether a portion, by the samples at its ends, lies in a strip of some width.
    fn fits(&self, [from, to]: [usize; 2], width: f64) -> bool {
        if to < from + 4 {
            // Of so few points the strip is known by what is between them.
            let between = (0..=8).map(|k| self.point(from as f64 + (to - from) as f64 * f64::from(k) / 8.0));
            return strip(&hull(between.collect())).width <= width;
        }
        let (start, chord) = (self.sample(from), self.sample(to) - self.sample(from));
        let length = chord.norm();
        let height = |k: usize| cross(chord, self.sample(k) - start) / length;
        // Coarsely first: three points in a strip make a triangle no higher than it is wide, over its longest side.
        let stride = ((to - from) / 4).max(1);
        let is_beyond = |k: usize| {
            let along = chord.dot(&(self.sample(k) - start));
            (0.0..=length * length).contains(&along) && height(k).abs() > width
        };
        if (from + 1..to).step_by(stride).any(is_beyond) {
            return false;
        }
        let [low, high] = (from + 1..to).map(height).fold([0.0f64; 2], |[low, high], h| [low.min(h), high.max(h)]);
        high - low <= width
            || (from + 1..to).all(|k| !is_beyond(k))
                && strip(&hull((from..=to).map(|k| self.sample(k)).collect())).width <= width
    }

    /// The ends of a portion moved out between samples, as far as its own length allows.
    fn drawn_out(&self, [from, to]: [usize; 2], tolerance: f64) -> [f64; 2] {
        /// Parts of the way between samples, in each of two rounds.
        const PARTS: usize = 16;
        let whole = [from as f64, to as f64];
        if to < from + 3 {
            return whole;
        }
        let core = hull(self.points([from as f64 + 1.0, to as f64 - 1.0]));
        // What is passed on the way out is in the portion too.
        let measured = |ends: [f64; 2]| {
            let mut points = core.clone();
            for end in [[ends[0], from as f64 + 1.0], [to as f64 - 1.0, ends[1]]] {
                points.extend([0.0, 0.25, 0.5, 0.75, 1.0].map(|part| self.point(end[0] + part * (end[1] - end[0]))));
            }
            strip(&hull(points))
        };
        let bounds = if self.closed {
            // Both ends may not meet, and places are not negative.
            [
                if from > 0 { from as f64 - 1.0 } else { from as f64 },
                (to as f64 + 1.0).min(whole[0] + self.len() as f64 - 1.0),
            ]
        } else {
            [(from as f64 - 1.0).max(0.0), (to as f64 + 1.0).min(self.len() as f64 - 1.0)]
        };
        let mut best = (measured(whole).length, whole);
        let mut centre = whole[0];
        let mut reach = 1.0;
        for _ in 0..2 {
            for part in 0..=2 * PARTS {
                let start = (centre + reach * (part as f64 / PARTS as f64 - 1.0)).clamp(bounds[0], from as f64 + 1.0);
                let allowed = |end: f64| {
                    let Strip { width, length } = measured([start, end]);
                    (width <= tolerance * length).then_some(length)
                };
                let (mut low, mut high) = (to as f64 - 1.0, bounds[1]);
                let Some(mut length) = allowed(low) else { continue };
                if let Some(whole) = allowed(high) {
                    (low, length) = (high, whole);
                }
                while high - low > 1e-4 {
                    let middle = (low + high) / 2.0;
                    match allowed(middle) {
                        Some(longer) => (low, length) = (middle, longer),
                        None => high = middle,
                    }
                }
                if length > best.0 {
                    best = (length, [start, low]);
                }
            }
            centre = best.1[0];
            reach /= PARTS as f64;
        }
        best.1
    }

    /// The place a span of input after another.
    fn after_input(&self, from: f64, span: f64) -> Option<f64> {
        let mut left = span + from.fract() * self.step(from as usize);
        for k in from as usize..self.last(from as usize) {
            let step = self.step(k);
            if left <= step {
                return Some(k as f64 + left / step);
            }
            left -= step;
        }
        None
    }

    /// The first place a distance away from another.
    fn after_length(&self, from: f64, length: f64) -> Option<f64> {
        let start = self.point(from);
        let far = |place: f64| (self.point(place) - start).norm();
        let beyond = (from as usize + 1..=self.last(from as usize)).find(|&k| far(k as f64) >= length)?;
        let (mut low, mut high) = ((beyond as f64 - 1.0).max(from), beyond as f64);
        while high - low > 1e-9 {
            let middle = (low + high) / 2.0;
            if far(middle) < length { low = middle } else { high = middle }
        }
        Some(high)
    }

    /// The ends of the portion with the narrowest strip, of those that begin anywhere and end where `end` has it.
    fn straightest(&self, end: impl Fn(f64) -> Option<f64>) -> Option<[f64; 2]> {
        let width = |from: f64| end(from).map_or(f64::INFINITY, |to| strip(&hull(self.points([from, to]))).width);
        let widths: Vec<f64> = (0..self.len()).map(|k| width(k as f64)).collect();
        let best = (0..widths.len()).min_by(|&a, &b| widths[a].total_cmp(&widths[b]))?;
        if !widths[best].is_finite() {
            return None;
        }
        let (mut a, mut b) = ((best as f64 - 1.0).max(0.0), (best as f64 + 1.0).min(self.len() as f64 - 1.0));
        for _ in 0..40 {
            let (c, d) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
            if width(c) < width(d) { b = d } else { a = c }
        }
        let from = if width(a) < widths[best] { a } else { best as f64 };
        Some([from, end(from)?])
    }
}

/// The point at a place among the samples.
fn at(trail: &Trail, place: f64) -> Point {
    let k = place.floor() as usize % trail.points.len();
    if place.fract() == 0.0 { trail.points[k] } else { trail.between(k, place.fract()) }
}

/// How far the input goes from each sample to the next, beside the input there.
fn steps(inputs: &[f64]) -> Vec<[f64; 2]> {
    let step = |k: usize| match inputs.get(k + 1) {
        Some(next) => next - inputs[k],
        // From the last sample of a closed curve to the first, a few turns on perhaps.
        None => {
            let over = (inputs[0] - inputs[k]).rem_euclid(360.0);
            if over > 180.0 { over - 360.0 } else { over }
        }
    };
    (0..inputs.len()).map(|k| [inputs[k], step(k)]).collect()
}

/// The corners of the convex hull of some points, counter-clockwise.
fn hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && cross(b - a, p - b) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut corners = half(&mut points.iter().copied());
    corners.extend(half(&mut points.iter().rev().copied()));
    corners
}

/// The narrowest strip of a convex polygon: one of its sides lies along one of the sides of the polygon.
fn strip(corners: &[Point]) -> Strip {
    let n = corners.len();
    let mut best = Strip { width: f64::INFINITY, length: 0.0 };
    let mut along = Vector::zeros();
    let mut far = 1;
    for k in 0..n {
        let (a, side) = (corners[k], corners[(k + 1) % n] - corners[k]);
        let length = side.norm();
        if length == 0.0 {
            continue;
        }
        let height = |i: usize| cross(side, corners[i % n] - a) / length;
        far = far.max(k + 1);
        while height(far + 1) > height(far) {
            far += 1;
        }
        if height(far) < best.width {
            best.width = height(far).max(0.0);
            along = side / length;
        }
    }
    // Two corners, or one: a line, or a point.
    if n <= 2 || best.width == f64::INFINITY {
        let length = corners.first().zip(corners.last()).map_or(0.0, |(a, b)| (b - a).norm());
        return Strip { width: 0.0, length };
    }
    let reach = |p: &Point| along.dot(&p.coords);
    let [low, high] =
        corners.iter().map(reach).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], s| [low.min(s), high.max(s)]);
    Strip { length: high - low, ..best }
}

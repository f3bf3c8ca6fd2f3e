//! The best circular arc of a curve: where a link from the coupler point to the arc's centre would let its far end dwell.
//!
//! A portion is such an arc if it lies in an *annulus*, the ring between two circles about one centre, no wider than 0.001
//! of the curve's greatest extent, about a circle of a radius no larger than the curve is long: a straight portion is none,
//! or a little of it. Of all the one that spans the most input is the best. What fits an annulus fits with any part of it, so that it is found by moving both
//! ends along the curve once, and then between samples.

use std::cell::RefCell;

use super::annulus::{Annulus, Turns};
use super::course::{Course, Fit};
use super::strip::{diameter, hull};
use super::{Measure, Subject, Value};
use crate::geometry::Point;

/// How wide the annulus may be, by the curve's greatest extent.
const TOLERANCE: f64 = 0.001;

/// A circular portion.
#[derive(Clone, Debug, PartialEq)]
pub struct Dwell {
    /// The centre of its circle.
    pub centre: Point,
    /// The radius of its circle.
    pub radius: f64,
    /// The greatest distance of its points from that circle.
    pub deviation: f64,
    /// The input at which it begins.
    pub start: f64,
    /// How much input it spans, there and back over limits.
    pub input: f64,
    /// Its points: the samples, and between them its ends.
    pub points: Vec<Point>,
}

/// What is told of it.
pub const MEASURES: [Measure; 6] = [
    Measure::number(
        "dwell_input_deg",
        "deg",
        "input that the best circular portion spans: the most within 0.0005 of the curve's greatest extent of a circle; of an actuator a length",
        |subject| of(subject, |dwell| dwell.input),
    ),
    Measure::number(
        "dwell_radius",
        "",
        "radius of that circle, no more than the curve's length, in the manifest's unit",
        |subject| of(subject, |dwell| dwell.radius),
    ),
    Measure::number("dwell_deviation", "", "greatest distance of the circular portion from its circle", |subject| {
        of(subject, |dwell| dwell.deviation)
    }),
    Measure::number(
        "dwell_start_deg",
        "deg",
        "input at which the circular portion begins; of an actuator a length",
        |subject| of(subject, |dwell| dwell.start),
    ),
    Measure::number("dwell_x", "", "x of the circle's centre", |subject| of(subject, |dwell| dwell.centre.x)),
    Measure::number("dwell_y", "", "y of the circle's centre", |subject| of(subject, |dwell| dwell.centre.y)),
];

fn of(subject: &Subject, value: fn(&Dwell) -> f64) -> Value {
    subject.dwell().map_or(Value::Missing, |dwell| Value::Number(value(dwell)))
}

/// The best circular portion of a curve; `None` of a point or a straight line.
pub(super) fn dwell(course: &Course) -> Option<Dwell> {
    let extent = diameter(&hull(course.points[..=course.starts].to_vec()));
    let search =
        Search { course, width: TOLERANCE * extent, largest: course.way[course.starts], fitting: RefCell::default() };
    let ends = search.longest()?;
    let points = course.portion(ends);
    // On a long arc the exchange of points may end at a ring that is not the narrowest: then the portion has a better one,
    // by which it was found to fit.
    let anew = Turns::default().within(&points, f64::INFINITY, search.largest);
    let found = search.fitting.borrow().iter().rev().find(|(other, _)| *other == ends).map(|(_, centre)| *centre);
    let rings = anew.into_iter().chain(found.map(|centre| Annulus::round(centre, &points)));
    let Annulus { centre, radius, width } = rings.min_by(|a, b| a.width.total_cmp(&b.width))?;
    let (start, input) = (course.input(ends[0]), course.spanned(ends));
    Some(Dwell { centre, radius, deviation: width / 2.0, start, input, points })
}

/// For the portion that spans the most input in an annulus of some width.
struct Search<'a> {
    course: &'a Course,
    width: f64,
    largest: f64,
    /// The ends and the centres of portions that were found to fit between points.
    fitting: RefCell<Vec<([f64; 2], Point)>>,
}

impl Search<'_> {
    fn longest(&self) -> Option<[f64; 2]> {
        const MOVES: usize = 4;
        let course = self.course;
        let [from, to] = self.longest_by_points()?;
        // All of a closed curve is a portion that ends where it begins.
        if course.is_closed && to == course.last(from) {
            return Some([0.0, course.starts as f64]);
        }
        let found = [from as f64, to as f64];
        let longer = self.nearest_to_longer(course.travel[to] - course.travel[from]);
        let is_apart = longer.is_none_or(|longer| (longer[0] - found[0]).abs() > 1.0);
        let drawn = longer.and_then(|ends| self.drawn_out(ends));
        let other = if is_apart || drawn.is_none() { self.drawn_out(found) } else { None };
        let mut best = drawn.into_iter().chain(other).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, found));
        for _ in 0..MOVES {
            // Drawn out from where it has come to it may go further the same way.
            match self.drawn_out(best.1) {
                Some(further) if further.0 > best.0 * (1.0 + 1e-6) => best = further,
                _ => break,
            }
        }
        Some(best.1)
    }

    /// How much input a portion spans, and its ends, drawn out between points.
    fn drawn_out(&self, ends: [f64; 2]) -> Option<(f64, [f64; 2])> {
        let course = self.course;
        let [from, to] = course.clamp(ends);
        let core = course.portion([from + 1.0, to - 1.0]);
        // What is passed on the way out is in the portion too.
        let passed = |end: f64, inner: f64| [0.0, 0.5].map(|part| course.point(end + part * (inner - end)));
        let beginning = |start: f64| {
            let mut points = Vec::with_capacity(core.len() + 4);
            points.extend(passed(start, from + 1.0));
            points.extend_from_slice(&core);
            let kept = points.len();
            let (before, mut turns) = (course.spanned([start, from + 1.0]), Turns::default());
            move |end: f64| {
                points.truncate(kept);
                points.extend(passed(end, to - 1.0).into_iter().rev());
                let ring = turns.within(&points, f64::INFINITY, self.largest);
                let excess = ring.map_or(f64::INFINITY, |ring| ring.width) - self.width;
                if let Some(ring) = ring.filter(|_| excess <= 0.0) {
                    self.fitting.borrow_mut().push(([start, end], ring.centre));
                }
                Fit { size: before + course.spanned([from + 1.0, end]), excess }
            }
        };
        course.drawn_out([from, to], beginning)
    }

    /// The points at the ends of the portion that spans the most input.
    fn longest_by_points(&self) -> Option<[usize; 2]> {
        let course = self.course;
        let mut best: Option<(f64, [usize; 2])> = None;
        for from in 0..course.starts {
            let Some(beyond) = self.end_beyond(from, best.map_or(0.0, |(span, _)| span)) else { continue };
            if let Some(to) = furthest([beyond, course.last(from)], |to| self.ring([from, to], self.width).is_some()) {
                best = Some((course.travel[to] - course.travel[from], [from, to]));
            }
        }
        best.map(|(_, ends)| ends)
    }

    /// The ends, between points, of a portion that spans a little more than `span` and lies in the narrowest annulus of
    /// those: as every portion from point to point that fits spans no more, this one comes nearest to it.
    fn nearest_to_longer(&self, span: f64) -> Option<[f64; 2]> {
        let mut narrowest = f64::INFINITY;
        let mut found = None;
        for from in 0..self.course.starts {
            if let Some(to) = self.end_beyond(from, span)
                && let Some(ring) = self.ring([from, to], narrowest)
            {
                narrowest = ring.width;
                found = Some([from as f64 + 0.5, to as f64 - 0.5]);
            }
        }
        found
    }

    /// The first point that portions from another may end at which span more than some input.
    fn end_beyond(&self, from: usize, span: f64) -> Option<usize> {
        /// Fewer points lie on a circle, or nearly so, whatever the curve does between them.
        const FEW: usize = 5;
        let travel = &self.course.travel;
        let (first, last) = (from + FEW, self.course.last(from));
        let beyond = first + travel.get(first..=last)?.partition_point(|at| at - travel[from] <= span * (1.0 + 1e-9));
        (beyond <= last).then_some(beyond)
    }

    fn ring(&self, [from, to]: [usize; 2], most: f64) -> Option<Annulus> {
        Turns::default().within(&self.course.points[from..=to], most, self.largest)
    }
}

/// The furthest of some places up to which something holds; `None` where it does not at the first.
fn furthest([first, last]: [usize; 2], holds: impl Fn(usize) -> bool) -> Option<usize> {
    if !holds(first) {
        return None;
    }
    // In longer and longer steps, and then between the last two.
    let (mut low, mut step) = (first, 1);
    while low + step <= last && holds(low + step) {
        low += step;
        step *= 2;
    }
    let mut high = (low + step).min(last + 1);
    while high - low > 1 {
        let middle = (low + high) / 2;
        if holds(middle) { low = middle } else { high = middle }
    }
    Some(low)
}

//! The best circular arc of a curve: where a link from the coupler point to the arc's centre would let its far end dwell.
//!
//! A portion is such an arc if it lies in an *annulus*, the ring between two circles about one centre, no wider than 0.001
//! of the curve's greatest extent, about a circle of a radius no larger than the curve is long: a straight portion is none,
//! or a little of it. Of all the one that spans the most input is the best. What fits an annulus fits with any part of it, so that it is found by moving both
//! ends along the curve once, and then between samples.

use std::cell::RefCell;

use super::annulus::{AlternatingPoints, Annulus};
use super::curve_segment::{CurveSegment, PortionFit};
use super::strip::{convex_hull, diameter};
use super::{Measure, TracedCurve, Value};
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
    pub start_input: f64,
    /// How much input it spans, there and back over limits.
    pub input_span: f64,
    /// Its points: the samples, and between them its ends.
    pub points: Vec<Point>,
}

/// What is told of it.
pub const MEASURES: [Measure; 6] = [
    Measure::number(
        "dwell_input_deg",
        "deg",
        "input that the best circular portion spans: the most within 0.0005 of the curve's greatest extent of a circle; of an actuator a length",
        |subject| dwell_value(subject, |dwell| dwell.input_span),
    ),
    Measure::number(
        "dwell_radius",
        "",
        "radius of that circle, no more than the curve's length, in the manifest's unit",
        |subject| dwell_value(subject, |dwell| dwell.radius),
    ),
    Measure::number("dwell_deviation", "", "greatest distance of the circular portion from its circle", |subject| {
        dwell_value(subject, |dwell| dwell.deviation)
    }),
    Measure::number(
        "dwell_start_deg",
        "deg",
        "input at which the circular portion begins; of an actuator a length",
        |subject| dwell_value(subject, |dwell| dwell.start_input),
    ),
    Measure::number("dwell_x", "", "x of the circle's centre", |subject| dwell_value(subject, |dwell| dwell.centre.x)),
    Measure::number("dwell_y", "", "y of the circle's centre", |subject| dwell_value(subject, |dwell| dwell.centre.y)),
];

fn dwell_value(subject: &TracedCurve, value: fn(&Dwell) -> f64) -> Value {
    subject.dwell().map_or(Value::Missing, |dwell| Value::Number(value(dwell)))
}

/// The best circular portion of a curve; `None` of a point or a straight line.
pub(super) fn find_dwell(course: &CurveSegment) -> Option<Dwell> {
    let extent = diameter(&convex_hull(course.points[..=course.start_count].to_vec()));
    let search = DwellSearch {
        segment: course,
        max_width: TOLERANCE * extent,
        max_radius: course.cumulative_length[course.start_count],
        fitting_portions: RefCell::default(),
    };
    let ends = search.longest()?;
    let points = course.portion_points(ends);
    // On a long arc the exchange of points may end at a ring that is not the narrowest: then the portion has a better one,
    // by which it was found to fit.
    let anew = AlternatingPoints::default().narrowest_annulus_within(&points, f64::INFINITY, search.max_radius);
    let found =
        search.fitting_portions.borrow().iter().rev().find(|(other, _)| *other == ends).map(|(_, centre)| *centre);
    let rings = anew.into_iter().chain(found.map(|centre| Annulus::enclosing(centre, &points)));
    let Annulus { centre, radius, width } = rings.min_by(|a, b| a.width.total_cmp(&b.width))?;
    let (start, input) = (course.input_at(ends[0]), course.input_span(ends));
    Some(Dwell { centre, radius, deviation: width / 2.0, start_input: start, input_span: input, points })
}

/// For the portion that spans the most input in an annulus of some width.
struct DwellSearch<'a> {
    segment: &'a CurveSegment,
    max_width: f64,
    max_radius: f64,
    /// The ends and the centres of portions that were found to fit between points.
    fitting_portions: RefCell<Vec<([f64; 2], Point)>>,
}

impl DwellSearch<'_> {
    fn longest(&self) -> Option<[f64; 2]> {
        const MOVES: usize = 4;
        let course = self.segment;
        let [from, to] = self.longest_between_points()?;
        // All of a closed curve is a portion that ends where it begins.
        if course.is_closed && to == course.last_end(from) {
            return Some([0.0, course.start_count as f64]);
        }
        let found = [from as f64, to as f64];
        let longer = self.narrowest_longer(course.input_travel[to] - course.input_travel[from]);
        let is_apart = longer.is_none_or(|longer| (longer[0] - found[0]).abs() > 1.0);
        let drawn = longer.and_then(|ends| self.extend(ends));
        let other = if is_apart || drawn.is_none() { self.extend(found) } else { None };
        let mut best = drawn.into_iter().chain(other).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, found));
        for _ in 0..MOVES {
            // Drawn out from where it has come to it may go further the same way.
            match self.extend(best.1) {
                Some(further) if further.0 > best.0 * (1.0 + 1e-6) => best = further,
                _ => break,
            }
        }
        Some(best.1)
    }

    /// How much input a portion spans, and its ends, drawn out between points.
    fn extend(&self, ends: [f64; 2]) -> Option<(f64, [f64; 2])> {
        let course = self.segment;
        let [from, to] = course.clamp(ends);
        let core = course.portion_points([from + 1.0, to - 1.0]);
        // What is passed on the way out is in the portion too.
        let passed = |end: f64, inner: f64| [0.0, 0.5].map(|part| course.point_at(end + part * (inner - end)));
        let beginning = |start: f64| {
            let mut points = Vec::with_capacity(core.len() + 4);
            points.extend(passed(start, from + 1.0));
            points.extend_from_slice(&core);
            let kept = points.len();
            let (before, mut turns) = (course.input_span([start, from + 1.0]), AlternatingPoints::default());
            move |end: f64| {
                points.truncate(kept);
                points.extend(passed(end, to - 1.0).into_iter().rev());
                let ring = turns.narrowest_annulus_within(&points, f64::INFINITY, self.max_radius);
                let excess = ring.map_or(f64::INFINITY, |ring| ring.width) - self.max_width;
                if let Some(ring) = ring.filter(|_| excess <= 0.0) {
                    self.fitting_portions.borrow_mut().push(([start, end], ring.centre));
                }
                PortionFit { size: before + course.input_span([from + 1.0, end]), excess }
            }
        };
        course.extend([from, to], beginning)
    }

    /// The points at the ends of the portion that spans the most input.
    fn longest_between_points(&self) -> Option<[usize; 2]> {
        let course = self.segment;
        let mut best: Option<(f64, [usize; 2])> = None;
        for from in 0..course.start_count {
            let Some(beyond) = self.first_end_beyond(from, best.map_or(0.0, |(span, _)| span)) else { continue };
            if let Some(to) =
                last_holding([beyond, course.last_end(from)], |to| self.annulus([from, to], self.max_width).is_some())
            {
                best = Some((course.input_travel[to] - course.input_travel[from], [from, to]));
            }
        }
        best.map(|(_, ends)| ends)
    }

    /// The ends, between points, of a portion that spans a little more than `span` and lies in the narrowest annulus of
    /// those: as every portion from point to point that fits spans no more, this one comes nearest to it.
    fn narrowest_longer(&self, span: f64) -> Option<[f64; 2]> {
        let mut narrowest = f64::INFINITY;
        let mut found = None;
        for from in 0..self.segment.start_count {
            if let Some(to) = self.first_end_beyond(from, span)
                && let Some(ring) = self.annulus([from, to], narrowest)
            {
                narrowest = ring.width;
                found = Some([from as f64 + 0.5, to as f64 - 0.5]);
            }
        }
        found
    }

    /// The first point that portions from another may end at which span more than some input.
    fn first_end_beyond(&self, from: usize, span: f64) -> Option<usize> {
        /// Fewer points lie on a circle, or nearly so, whatever the curve does between them.
        const FEW: usize = 5;
        let travel = &self.segment.input_travel;
        let (first, last) = (from + FEW, self.segment.last_end(from));
        let beyond = first + travel.get(first..=last)?.partition_point(|at| at - travel[from] <= span * (1.0 + 1e-9));
        (beyond <= last).then_some(beyond)
    }

    fn annulus(&self, [from, to]: [usize; 2], most: f64) -> Option<Annulus> {
        AlternatingPoints::default().narrowest_annulus_within(&self.segment.points[from..=to], most, self.max_radius)
    }
}

/// The furthest of some places up to which something holds; `None` where it does not at the first.
fn last_holding([first, last]: [usize; 2], holds: impl Fn(usize) -> bool) -> Option<usize> {
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

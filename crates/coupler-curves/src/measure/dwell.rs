//! The best circular portion of a curve: the far end of a link that is as long as its radius dwells at its centre while
//! the coupler point traverses it.
//!
//! A portion is circular if it lies in an *annulus*, the ring between two concentric circles, no wider than 0.001 of
//! the curve's greatest extent, and the mean radius is no greater than the length of the curve, which excludes straight
//! portions. The best one spans the most input. Any part of a portion that fits an annulus fits it too, so the best is
//! found by moving both ends along the curve once, and is then extended between samples.

use std::cell::RefCell;

use super::annulus::{AlternatingPoints, Annulus};
use super::curve_segment::{CurveSegment, PortionFit};
use super::strip::{convex_hull, diameter};
use super::{Measure, TracedCurve, Value};
use crate::geometry::Point;

/// The greatest width of the annulus, relative to the curve's greatest extent.
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
    /// The input it spans, which is counted forward and backward at limits.
    pub input_span: f64,
    /// Its points: the samples and its ends.
    pub points: Vec<Point>,
}

/// The measures of the dwell.
pub const MEASURES: [Measure; 6] = [
    Measure::number(
        "dwell_input_deg",
        "deg",
        "greatest input span of a portion within 0.0005 of the curve's greatest extent of a circle; a length for an actuator",
        |curve| dwell_value(curve, |dwell| dwell.input_span),
    ),
    Measure::number(
        "dwell_radius",
        "",
        "radius of that circle, no more than the curve's length, in the manifest's unit",
        |curve| dwell_value(curve, |dwell| dwell.radius),
    ),
    Measure::number("dwell_deviation", "", "greatest distance of the circular portion from its circle", |curve| {
        dwell_value(curve, |dwell| dwell.deviation)
    }),
    Measure::number(
        "dwell_start_deg",
        "deg",
        "input at which the circular portion begins; a length for an actuator",
        |curve| dwell_value(curve, |dwell| dwell.start_input),
    ),
    Measure::number("dwell_x", "", "x of the circle's centre", |curve| dwell_value(curve, |dwell| dwell.centre.x)),
    Measure::number("dwell_y", "", "y of the circle's centre", |curve| dwell_value(curve, |dwell| dwell.centre.y)),
];

fn dwell_value(curve: &TracedCurve, value: fn(&Dwell) -> f64) -> Value {
    curve.dwell().map_or(Value::Missing, |dwell| Value::Number(value(dwell)))
}

/// The best circular portion of a curve; `None` for a point or a straight line.
pub(super) fn find_dwell(curve: &CurveSegment) -> Option<Dwell> {
    let extent = diameter(&convex_hull(curve.points[..=curve.start_count].to_vec()));
    let search = DwellSearch {
        segment: curve,
        max_width: TOLERANCE * extent,
        max_radius: curve.cumulative_length[curve.start_count],
        fitting_portions: RefCell::default(),
    };
    let ends = search.longest()?;
    let points = curve.portion_points(ends);
    // On a long arc the exchange algorithm may end at an annulus that is not the narrowest. The annulus in which the
    // search found that the portion fits is then better.
    let narrowest = AlternatingPoints::default().narrowest_annulus_within(&points, f64::INFINITY, search.max_radius);
    let known_centre =
        search.fitting_portions.borrow().iter().rev().find(|(other, _)| *other == ends).map(|(_, centre)| *centre);
    let rings = narrowest.into_iter().chain(known_centre.map(|centre| Annulus::enclosing(centre, &points)));
    let Annulus { centre, radius, width } = rings.min_by(|a, b| a.width.total_cmp(&b.width))?;
    let (start, input) = (curve.input_at(ends[0]), curve.input_span(ends));
    Some(Dwell { centre, radius, deviation: width / 2.0, start_input: start, input_span: input, points })
}

/// The search for the portion that spans the most input in an annulus of at most a given width and radius.
struct DwellSearch<'a> {
    segment: &'a CurveSegment,
    max_width: f64,
    max_radius: f64,
    /// The ends and the annulus centres of portions that were found to fit when extended between points.
    fitting_portions: RefCell<Vec<([f64; 2], Point)>>,
}

impl DwellSearch<'_> {
    /// The ends of the portion that spans the most input.
    fn longest(&self) -> Option<[f64; 2]> {
        const MOVES: usize = 4;
        let curve = self.segment;
        let [from, to] = self.longest_between_points()?;
        // The whole of a closed curve is a portion that ends where it begins.
        if curve.is_closed && to == curve.last_end(from) {
            return Some([0.0, curve.start_count as f64]);
        }
        let found = [from as f64, to as f64];
        let longer = self.narrowest_longer(curve.input_travel[to] - curve.input_travel[from]);
        let is_apart = longer.is_none_or(|longer| (longer[0] - found[0]).abs() > 1.0);
        let extended = longer.and_then(|ends| self.extend(ends));
        let other = if is_apart || extended.is_none() { self.extend(found) } else { None };
        let mut best = extended.into_iter().chain(other).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, found));
        for _ in 0..MOVES {
            // It may be possible to extend the result further.
            match self.extend(best.1) {
                Some(further) if further.0 > best.0 * (1.0 + 1e-6) => best = further,
                _ => break,
            }
        }
        Some(best.1)
    }

    /// Moves the ends of a portion outwards, between points, as far as it fits; the input span and the ends of the
    /// result.
    fn extend(&self, ends: [f64; 2]) -> Option<(f64, [f64; 2])> {
        let curve = self.segment;
        let [from, to] = curve.clamp(ends);
        let core = curve.portion_points([from + 1.0, to - 1.0]);
        // The points between the core and the moved ends.
        let outer = |end: f64, inner: f64| [0.0, 0.5].map(|part| curve.point_at(end + part * (inner - end)));
        let fit_from = |start: f64| {
            let mut points = Vec::with_capacity(core.len() + 4);
            points.extend(outer(start, from + 1.0));
            points.extend_from_slice(&core);
            let kept = points.len();
            let (before, mut alternating) = (curve.input_span([start, from + 1.0]), AlternatingPoints::default());
            move |end: f64| {
                points.truncate(kept);
                points.extend(outer(end, to - 1.0).into_iter().rev());
                let ring = alternating.narrowest_annulus_within(&points, f64::INFINITY, self.max_radius);
                let excess = ring.map_or(f64::INFINITY, |ring| ring.width) - self.max_width;
                if let Some(ring) = ring.filter(|_| excess <= 0.0) {
                    self.fitting_portions.borrow_mut().push(([start, end], ring.centre));
                }
                PortionFit { size: before + curve.input_span([from + 1.0, end]), excess }
            }
        };
        curve.extend([from, to], fit_from)
    }

    /// The points at the ends of the portion that spans the most input, of those that begin and end at points.
    fn longest_between_points(&self) -> Option<[usize; 2]> {
        let curve = self.segment;
        let mut best: Option<(f64, [usize; 2])> = None;
        for from in 0..curve.start_count {
            let Some(beyond) = self.first_end_beyond(from, best.map_or(0.0, |(span, _)| span)) else { continue };
            if let Some(to) =
                last_holding([beyond, curve.last_end(from)], |to| self.annulus([from, to], self.max_width).is_some())
            {
                best = Some((curve.input_travel[to] - curve.input_travel[from], [from, to]));
            }
        }
        best.map(|(_, ends)| ends)
    }

    /// The ends, between points, of the portion in the narrowest annulus among those that span a little more than
    /// `span`. No portion from point to point that spans more fits, and this one comes closest to it.
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

    /// The first point at which a portion from another point ends that spans more input than `span`.
    fn first_end_beyond(&self, from: usize, span: f64) -> Option<usize> {
        /// A portion of fewer intervals is always close to a circle.
        const MIN_INTERVALS: usize = 5;
        let travel = &self.segment.input_travel;
        let (first, last) = (from + MIN_INTERVALS, self.segment.last_end(from));
        let beyond = first + travel.get(first..=last)?.partition_point(|at| at - travel[from] <= span * (1.0 + 1e-9));
        (beyond <= last).then_some(beyond)
    }

    /// The narrowest annulus around the points of a portion, if it is no wider than `most`.
    fn annulus(&self, [from, to]: [usize; 2], most: f64) -> Option<Annulus> {
        AlternatingPoints::default().narrowest_annulus_within(&self.segment.points[from..=to], most, self.max_radius)
    }
}

/// The last index up to which a monotonic condition holds; `None` if it does not hold at the first.
fn last_holding([first, last]: [usize; 2], holds: impl Fn(usize) -> bool) -> Option<usize> {
    if !holds(first) {
        return None;
    }
    // Double the step, then bisect.
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

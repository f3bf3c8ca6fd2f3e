//! The curve of a joint by one parameter.

use super::fit::{AT_POINTS, fit_cubic};
use super::polyline::{MAX_NODES, refined_lines};
use super::quintic::{Quintic, quintic_error};
use crate::geometry::{Point, Spline, SplineSegment, TERMS, Vector, distance_to_segment};
use crate::linkage::{JointId, Linkage};
use crate::measure::curve::{Arc, Place, SmoothCurve};
use crate::motion::{Circuit, Pass};

/// The curve of a joint on a circuit, by a parameter `t`: `k` at the beginning of piece `k` of the curve, and `k + 1` at
/// its end.
pub(super) struct Trajectory<'a> {
    pub linkage: &'a Linkage,
    pub circuit: &'a Circuit,
    joint: JointId,
    pub curve: SmoothCurve,
    tolerance: f64,
    /// The greatest extent along x or y.
    pub extent: f64,
    /// Where the tangent may jump, or the curve stops, or pieces that are resolved meet others; rising.
    pub knots: Vec<f64>,
    /// Whether the curve is a polynomial on a piece, to a small part of the tolerance.
    is_resolved: Vec<bool>,
    /// How far each piece is from its quintics, see [`quintic_error`].
    quintic_errors: Vec<f64>,
    /// The input travelled from the beginning of the circuit to that of each piece.
    piece_starts: Vec<f64>,
    /// The input travelled from the beginning of the circuit to that of each pass.
    pass_starts: Vec<f64>,
}

/// The parameter at a place. Next to the end of a piece it is that end, so that nothing is left of the piece.
pub(super) fn parameter(place: Place) -> f64 {
    /// More than the rounding of inputs relative to the width of a piece.
    const NEXT_TO_END: f64 = 1e-9;
    let t = place.piece as f64 + (place.u + 1.0) / 2.0;
    let nearest_end = (t + 0.5) as usize as f64;
    if (t - nearest_end).abs() <= NEXT_TO_END { nearest_end } else { t }
}

/// Where a curve is, and how it moves there.
#[derive(Clone, Copy)]
struct Station {
    point: Point,
    /// The first and the second derivative with respect to the parameter of the piece.
    rates: [Vector; 2],
    /// The direction of motion, if that is known.
    direction: Option<Vector>,
}

/// A side of a place.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Before,
    After,
}

impl<'a> Trajectory<'a> {
    pub fn new(linkage: &'a Linkage, circuit: &'a Circuit, joint: JointId, tolerance: f64) -> Trajectory<'a> {
        /// The last terms of the series of a resolved piece, relative to the tolerance.
        const RESOLVED: f64 = 0.05;
        let curve = SmoothCurve::new(circuit.pieces(linkage), joint, circuit.is_closed);
        let mut travel = 0.0;
        let pass_start = |pass: &Pass| {
            travel += pass.input_length();
            travel - pass.input_length()
        };
        let is_resolved = |arc: &Arc| {
            let terms = arc.position.iter().flat_map(|series| &series.0[TERMS - 2..]);
            terms.fold(0.0f64, |tail, term| tail.max(term.abs())) <= RESOLVED * tolerance
        };
        let mut out = Trajectory {
            linkage,
            circuit,
            joint,
            tolerance,
            extent: extent(&curve),
            knots: Vec::new(),
            is_resolved: curve.arcs.iter().map(is_resolved).collect(),
            quintic_errors: curve.arcs.iter().map(|arc| quintic_error(&arc.position)).collect(),
            piece_starts: Vec::new(),
            pass_starts: circuit.passes.iter().map(pass_start).collect(),
            curve,
        };
        let starts = out.curve.pieces.iter().map(|piece| out.travel_on_pass(piece.passes[0], piece.map.input(-1.0)));
        out.piece_starts = starts.collect();
        out.knots = out.find_knots();
        out
    }

    /// The input travelled from the beginning of the circuit to an input of a pass.
    fn travel_on_pass(&self, pass: usize, input: f64) -> f64 {
        self.pass_starts[pass] + (input - self.circuit.passes[pass].from.input.value).abs()
    }

    fn find_knots(&self) -> Vec<f64> {
        let is_knot = |k: &usize| self.curve.corners[*k] || self.is_resolved[*k] != self.is_resolved[k - 1];
        let mut knots: Vec<f64> = (1..self.curve.arcs.len()).filter(is_knot).map(|k| k as f64).collect();
        knots.extend(self.curve.stops().iter().map(|stop| parameter(stop.place)));
        knots.sort_by(f64::total_cmp);
        knots
    }

    /// The whole range of the parameter.
    pub fn range(&self) -> [f64; 2] {
        [0.0, self.curve.arcs.len() as f64]
    }

    /// The parameter at an input of a pass; next to a range of undefined positions if the input lies in it.
    pub fn parameter(&self, pass: usize, input: f64) -> f64 {
        let travel = self.travel_on_pass(pass, input);
        let after = self.piece_starts.partition_point(|start| *start <= travel);
        let Some(k) = after.checked_sub(1) else { return 0.0 };
        self.curve.pieces[k].parameter_at(pass, input).map_or(after as f64, |u| parameter(Place { piece: k, u }))
    }

    /// The input travelled from the beginning of the circuit.
    pub fn travel(&self, t: f64) -> f64 {
        let Place { piece, u } = self.place(t, Side::Before);
        self.piece_starts.get(piece).map_or(0.0, |start| start + self.curve.pieces[piece].input_travel_to(u))
    }

    /// The place at a parameter: where two pieces meet, on the piece of the given side.
    fn place(&self, t: f64, side: Side) -> Place {
        let after = t as usize;
        let is_before = side == Side::Before && after as f64 == t;
        let piece = if is_before { after.saturating_sub(1) } else { after };
        let piece = piece.min(self.curve.arcs.len().saturating_sub(1));
        Place { piece, u: 2.0 * (t - piece as f64) - 1.0 }
    }

    /// Where the curve is at a parameter, and how it moves there.
    fn station(&self, t: f64, side: Side) -> Station {
        /// Of the acceleration, in the parameter of the piece: a curve that is slower stops here, to the accuracy to
        /// which such places are found.
        const AT_REST: f64 = 1e-6;
        let Place { piece, u } = self.place(t, side);
        let (point, rates) = self.curve.arcs[piece].point_and_rates(u);
        let [velocity, acceleration] = rates;
        // From rest it moves with the acceleration, and it comes to rest against it.
        let along = match side {
            _ if velocity.norm() > AT_REST * acceleration.norm() => velocity,
            Side::After => acceleration,
            Side::Before => -acceleration,
        };
        Station { point, rates, direction: along.try_normalize(0.0) }
    }

    /// The position.
    pub fn point(&self, t: f64) -> Point {
        self.curve.point(self.place(t, Side::After))
    }

    /// The positions at evenly spaced parameters between two stations, on pieces between these.
    fn points_between(&self, [from, to]: [f64; 2], stations: [&Station; 2], count: usize) -> Vec<Point> {
        /// Of the tolerance: far less than pages are rounded to.
        const NEGLIGIBLE: f64 = 1e-6;
        let share = |k: usize| k as f64 / (count + 1) as f64;
        let [start, end] = [self.place(from, Side::After), self.place(to, Side::Before)];
        let step = end.u - start.u;
        let sixth = step * step * step * step * step * step;
        if start.piece == end.piece && self.quintic_errors[start.piece] * sixth <= NEGLIGIBLE * self.tolerance {
            let quintic = Quintic::between(stations.map(|station| (station.point, station.rates)), step);
            return (1..=count).map(|k| quintic.point(share(k))).collect();
        }
        let places: Vec<Place> = (1..=count).map(|k| self.place(from + (to - from) * share(k), Side::After)).collect();
        self.curve.points(&places)
    }

    /// The curve between two parameters. Parts that deviate from a line by no more than `straightness` are lines.
    pub fn splines(&self, [from, to]: [f64; 2], straightness: f64) -> Vec<Spline> {
        /// A part that is shorter is a point.
        const SHORTEST: f64 = 1e-6;
        let knots = self.knots.iter().copied().filter(|knot| from + SHORTEST < *knot && *knot < to - SHORTEST);
        // Most parts are in one spline.
        let mut out = Vec::with_capacity(1);
        let mut start = from;
        for end in knots.chain([to]) {
            let part = [std::mem::replace(&mut start, end), end];
            let Place { piece, .. } = self.place(part[0], Side::After);
            if part[0] >= part[1] {
                continue;
            } else if self.is_resolved[piece] {
                self.append(&mut out, self.fitted(part, straightness));
            } else {
                self.refined(part).into_iter().for_each(|spline| self.append(&mut out, spline));
            }
        }
        out
    }

    /// Appends a spline to the last one if it begins where that ends.
    fn append(&self, splines: &mut Vec<Spline>, spline: Spline) {
        /// Of the tolerance: a smaller gap is not seen.
        const NO_GAP: f64 = 1e-3;
        match splines.last_mut() {
            Some(last) if (last.end() - spline.start).norm() <= self.tolerance => {
                if (last.end() - spline.start).norm() > NO_GAP * self.tolerance {
                    last.segments.push(SplineSegment::Line(spline.start));
                }
                last.segments.extend(spline.segments);
            }
            _ => splines.push(spline),
        }
    }

    /// A spline fitted to the curve between neighbouring knots.
    fn fitted(&self, [from, to]: [f64; 2], straightness: f64) -> Spline {
        /// A cubic spans no more pieces, of at most an eighth of a turn each.
        const MAX_PIECES: f64 = 3.0;
        let start = self.station(from, Side::After);
        let parts = ((to - from) / MAX_PIECES).ceil().max(1.0);
        let mut segments = Vec::with_capacity(parts as usize);
        for k in 0..parts as usize {
            let at = |k: usize| from + (to - from) * (k as f64 / parts);
            let start = if k == 0 { start } else { self.station(at(k), Side::After) };
            self.fit([at(k), at(k + 1)], &start, straightness, &mut segments);
        }
        Spline { start: start.point, segments }
    }

    /// Appends segments from one parameter, where the curve is at `start`, to another: one, or those of both halves.
    fn fit(&self, [from, to]: [f64; 2], start: &Station, straightness: f64, out: &mut Vec<SplineSegment>) {
        /// Points with which a segment is compared: some, and more on each piece, which has 16 terms.
        const POINTS: [f64; 2] = [5.0, 10.0];
        let end = self.station(to, Side::Before);
        let count = (POINTS[0] + POINTS[1] * (to - from)) as usize;
        let points = self.points_between([from, to], [start, &end], count);
        let ends = [start.point, end.point];
        let is_on_line = |point: &Point| distance_to_segment(*point, ends[0], ends[1]) <= AT_POINTS * straightness;
        if points.iter().all(is_on_line) {
            return out.push(SplineSegment::Line(end.point));
        }
        let tangents = start.direction.zip(end.direction);
        let cubic = tangents.and_then(|(a, b)| fit_cubic(ends, [a, b], &points, self.tolerance));
        let middle = (from + to) / 2.0;
        match cubic {
            Some([a, b]) => out.push(SplineSegment::Cubic([a, b, end.point])),
            None if from < middle && middle < to => {
                self.fit([from, middle], start, straightness, out);
                self.fit([middle, to], &self.station(middle, Side::After), straightness, out);
            }
            None => out.push(SplineSegment::Line(end.point)),
        }
    }

    /// The curve between two parameters in lines through positions, where it is not resolved.
    fn refined(&self, [from, to]: [f64; 2]) -> Vec<Spline> {
        /// The fewest nodes that a piece may have.
        const LEAST: usize = 64;
        // Where many pieces are not resolved, they are rounding.
        let unresolved = self.is_resolved.iter().filter(|is_resolved| !**is_resolved).count();
        let max_nodes = (MAX_NODES / unresolved.max(1)).max(LEAST);
        let mut out = Vec::new();
        for k in from.floor() as usize..to.ceil() as usize {
            let piece = &self.curve.pieces[k];
            let [a, b] = [from, to].map(|t| (2.0 * (t - k as f64) - 1.0).clamp(-1.0, 1.0));
            let split = piece.split.clamp(a, b);
            for (pass, [a, b]) in piece.passes.into_iter().zip([[a, split], [split, b]]).filter(|(_, [a, b])| a < b) {
                let ends = [a, b].map(|u| piece.map.input(u));
                let pass = &self.circuit.passes[pass];
                for line in refined_lines(self.linkage, pass, ends, self.joint, self.tolerance, max_nodes) {
                    let segments = line[1..].iter().map(|point| SplineSegment::Line(*point)).collect();
                    self.append(&mut out, Spline { start: line[0], segments });
                }
            }
        }
        out
    }
}

/// The greatest extent of a curve along x or y, or a little more.
fn extent(curve: &SmoothCurve) -> f64 {
    let span = |axis: usize| {
        let ranges = curve.arcs.iter().map(|arc| arc.position[axis].range());
        let [low, high] =
            ranges.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [a, b]| [low.min(a), high.max(b)]);
        high - low
    };
    span(0).max(span(1)).max(0.0)
}

//! A curve as polynomials: what is measured is the curve, not samples of it.
//!
//! On each piece of the circuit ([`CircuitPiece`]) the coordinates of the joint are Chebyshev series in a parameter in
//! which the motion is regular, exact to the rounding of positions. Extremes, inflections, cusps and crossings are
//! isolated as zeros of such series; lengths and areas are integrals of them.

mod arc_length;
mod crossings;
mod extent;
mod sharpest;
mod stops;

pub use arc_length::ArcLength;
pub use crossings::Crossings;
pub use stops::{Stop, StopKind};

use crate::geometry::{Chebyshev, Point, TERMS, Vector, cross, rising_order};
use crate::linkage::JointId;
use crate::motion::{CircuitPiece, CircuitPieces};

/// A place on a curve: a piece and the parameter on it, from -1 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The index of the piece.
    pub piece: usize,
    /// The parameter.
    pub u: f64,
}

/// A polynomial part of a curve.
#[derive(Clone, Debug)]
pub struct Arc {
    /// The coordinates.
    pub position: [Chebyshev; 2],
    /// Their derivatives with respect to the parameter.
    pub velocity: [Chebyshev; 2],
}

impl Arc {
    /// The arc with these coordinates.
    pub fn new(position: [Chebyshev; 2]) -> Arc {
        Arc { velocity: position.each_ref().map(Chebyshev::derivative), position }
    }

    /// The position at a parameter.
    pub fn point(&self, u: f64) -> Point {
        Point::new(self.position[0].at(u), self.position[1].at(u))
    }

    /// The derivative of the position with respect to the parameter.
    pub fn velocity(&self, u: f64) -> Vector {
        Vector::new(self.velocity[0].at(u), self.velocity[1].at(u))
    }

    /// The position and its first and second derivative with respect to the parameter, by Clenshaw's recurrence and its
    /// derivatives, for both coordinates at once.
    pub fn point_and_rates(&self, u: f64) -> (Point, [Vector; 2]) {
        let [x, y] = &self.position;
        let twice = 2.0 * u;
        let step =
            |above: [f64; 2], b1: [f64; 2], b2: [f64; 2]| [0, 1].map(|lane| above[lane] - b2[lane] + twice * b1[lane]);
        let mut b = [[0.0; 2]; 2];
        let (mut d, mut e) = (b, b);
        for k in (1..TERMS).rev() {
            e = [step(d[0].map(|d| 4.0 * d), e[0], e[1]), e[0]];
            d = [step(b[0].map(|b| 2.0 * b), d[0], d[1]), d[0]];
            b = [step([x.0[k], y.0[k]], b[0], b[1]), b[0]];
        }
        let value = |lane: usize, first: f64| first - b[1][lane] + u * b[0][lane];
        let velocity = |lane: usize| b[0][lane] - d[1][lane] + u * d[0][lane];
        let acceleration = |lane: usize| 2.0 * d[0][lane] - e[1][lane] + u * e[0][lane];
        (
            Point::new(value(0, x.0[0]), value(1, y.0[0])),
            [Vector::new(velocity(0), velocity(1)), Vector::new(acceleration(0), acceleration(1))],
        )
    }

    /// How far it is in a direction, as a function of the parameter.
    pub fn heights(&self, direction: Vector) -> Chebyshev {
        let [x, y] = &self.position;
        Chebyshev(std::array::from_fn(|k| direction.x * x.0[k] + direction.y * y.0[k]))
    }

    /// The parameter of the foot of the perpendicular from a point, if it is on the arc.
    pub fn foot(&self, point: Point) -> Option<f64> {
        let mut u = 0.0f64;
        for _ in 0..8 {
            let (offset, v) = (self.point(u) - point, self.velocity(u));
            let step = offset.dot(&v) / v.norm_squared();
            u -= step;
            if u.is_nan() || u.abs() > 1.5 {
                return None;
            }
            if step.abs() < 1e-12 {
                break;
            }
        }
        (u.abs() <= 1.0).then_some(u)
    }

    /// The greatest speed at the nodes.
    pub fn greatest_speed(&self) -> f64 {
        let [x, y] = self.velocity.each_ref().map(Chebyshev::values);
        x.iter().zip(&y).map(|(x, y)| (x * x + y * y).sqrt()).fold(0.0, f64::max)
    }

    /// The part between two parameters, on [-1, 1].
    fn restricted(&self, ends: [f64; 2]) -> Arc {
        Arc::new(self.position.each_ref().map(|series| series.restricted(ends)))
    }

    /// Both halves, each on [-1, 1].
    pub fn halves(&self) -> [Arc; 2] {
        let [[x0, x1], [y0, y1]] = self.position.each_ref().map(Chebyshev::halves);
        [Arc::new([x0, y0]), Arc::new([x1, y1])]
    }

    /// The mean direction, and a lower bound of the velocity along it and an upper bound of that across it: the bounds
    /// of a cone that contains all tangents if the first is positive.
    pub fn cone(&self) -> (Vector, f64, f64) {
        let [x, y] = &self.velocity;
        let mean = Vector::new(x.0[0], y.0[0]);
        let Some(unit) = mean.try_normalize(0.0) else { return (Vector::x(), f64::NEG_INFINITY, f64::INFINITY) };
        let (mut along, mut across) = (mean.norm(), 0.0);
        for k in 1..TERMS {
            let term = Vector::new(x.0[k], y.0[k]);
            along -= unit.dot(&term).abs();
            across += cross(unit, term).abs();
        }
        (unit, along, across)
    }

    /// The first to the third derivative at the nodes.
    pub fn derivatives_at_nodes(&self) -> [[Vector; TERMS]; 3] {
        let second = self.velocity.each_ref().map(Chebyshev::derivative);
        let third = second.each_ref().map(Chebyshev::derivative);
        [&self.velocity, &second, &third].map(|[x, y]| {
            let (x, y) = (x.values(), y.values());
            std::array::from_fn(|j| Vector::new(x[j], y[j]))
        })
    }
}

/// The curve of a joint on a circuit.
#[derive(Clone, Debug)]
pub struct SmoothCurve {
    /// Its pieces, in the order of the motion; without those on which the position is undefined.
    pub arcs: Vec<Arc>,
    /// The pieces of the circuit that they are on.
    pub pieces: Vec<CircuitPiece>,
    /// Whether there may be a corner between each piece and the one before it, or before the first the last.
    pub corners: Vec<bool>,
    /// Whether the end of the last piece is the beginning of the first.
    pub is_closed: bool,
    /// An absolute bound of the rounding of coordinates.
    pub rounding: f64,
}

impl SmoothCurve {
    /// The curve of a joint on a circuit in pieces.
    pub fn new(circuit: &CircuitPieces, joint: JointId, is_closed: bool) -> SmoothCurve {
        let mut curve = SmoothCurve {
            arcs: Vec::new(),
            pieces: Vec::new(),
            corners: Vec::new(),
            is_closed,
            rounding: LEAST_ROUNDING,
        };
        let mut has_gap = false;
        for (k, piece) in circuit.pieces.iter().enumerate() {
            let position = circuit.series(k, joint);
            if position.iter().flat_map(|series| series.0).any(|c| !c.is_finite()) {
                has_gap = true;
                continue;
            }
            let magnitude = position.iter().map(Chebyshev::bound).fold(0.0, f64::max);
            let tail =
                position.iter().flat_map(|series| series.0[TERMS - 2..].iter()).fold(0.0f64, |t, c| t.max(c.abs()));
            curve.rounding = curve.rounding.max(tail).max(f64::EPSILON * magnitude);
            curve.arcs.push(Arc::new(position));
            curve.pieces.push(*piece);
            curve.corners.push(circuit.corners[k] || std::mem::take(&mut has_gap));
        }
        curve
    }

    /// Whether two places are one, up to a difference of the parameter; those of a closed curve also across its start.
    pub fn are_near(&self, a: Place, b: Place, difference: f64) -> bool {
        let [a, b] = [a, b].map(|place| place.piece as f64 * 2.0 + place.u);
        let apart = (a - b).abs();
        let round = 2.0 * self.arcs.len() as f64;
        apart <= difference || (self.is_closed && round - apart <= difference)
    }

    /// The place at an input of a pass, searched for from a piece on.
    pub fn find(&self, pass: usize, input: f64, from: usize) -> Option<Place> {
        let count = self.pieces.len();
        let at = |k: usize| {
            let piece = k % count;
            Some(Place { piece, u: self.pieces[piece].parameter_at(pass, input)? })
        };
        (from..from + count).find_map(at)
    }

    /// The position at a place.
    pub fn point(&self, place: Place) -> Point {
        self.arcs[place.piece].point(place.u)
    }

    /// The positions at places.
    pub fn points(&self, places: &[Place]) -> Vec<Point> {
        let mut out = Vec::with_capacity(places.len());
        for on_piece in places.chunk_by(|a, b| a.piece == b.piece) {
            let [x, y] = &self.arcs[on_piece[0].piece].position;
            for four in on_piece.chunks(4) {
                // The last places of a piece are filled up with the last of them.
                let u = std::array::from_fn(|lane| four[lane.min(four.len() - 1)].u);
                let (x, y) = (x.at_four(u), y.at_four(u));
                out.extend((0..four.len()).map(|lane| Point::new(x[lane], y[lane])));
            }
        }
        out
    }

    /// The input at a place, in degrees or units of length.
    pub fn input(&self, place: Place) -> f64 {
        self.pieces[place.piece].map.input(place.u)
    }

    /// The greatest value of a function that is a series on each piece, and its place; `None` if there are no pieces.
    pub fn greatest(&self, series: impl Fn(usize) -> Chebyshev) -> Option<(f64, Place)> {
        let all: Vec<Chebyshev> = (0..self.arcs.len()).map(series).collect();
        let mut best: Option<(f64, Place)> = None;
        let offer = |value: f64, place: Place, best: &mut Option<(f64, Place)>| {
            if best.is_none_or(|(most, _)| value > most) {
                *best = Some((value, place));
            }
        };
        for (piece, series) in all.iter().enumerate() {
            offer(series.at_start(), Place { piece, u: -1.0 }, &mut best);
            offer(series.at_end(), Place { piece, u: 1.0 }, &mut best);
        }
        // The pieces that may be greatest, the most promising first.
        let bounds: Vec<f64> = all.iter().map(|series| -series.range()[1]).collect();
        for piece in rising_order(&bounds) {
            if best.is_none_or(|(value, _)| -bounds[piece] > value) {
                for u in all[piece].derivative().zeros(0.0, NARROW).places {
                    offer(all[piece].at(u), Place { piece, u }, &mut best);
                }
            }
        }
        best
    }

    /// The extent furthest in a direction and its place.
    pub fn furthest(&self, direction: Vector) -> Option<(f64, Place)> {
        self.greatest(|k| self.arcs[k].heights(direction))
    }

    /// The area enclosed, positive counter-clockwise; `None` for an open curve.
    pub fn area(&self) -> Option<f64> {
        let first = self.arcs.first().filter(|_| self.is_closed)?.point(-1.0);
        let part = |arc: &Arc| {
            let [x, y] = arc.position.each_ref().map(Chebyshev::values);
            let [vx, vy] = arc.velocity.each_ref().map(Chebyshev::values);
            let rate = |j: usize| (x[j] - first.x) * vy[j] - (y[j] - first.y) * vx[j];
            Chebyshev::from_values(&std::array::from_fn(rate)).total() / 2.0
        };
        Some(self.arcs.iter().map(part).sum())
    }

    /// Whether the curve is a straight line to the accuracy of positions, 1e-12 of the size of the linkage, and to 1e-9 of its own
    /// extent; a point is none.
    pub fn is_line(&self) -> bool {
        const ROUNDING: f64 = 1e-12;
        const STRAIGHT: f64 = 1e-9;
        let Some(from) = self.arcs.first().map(|arc| arc.point(-1.0)) else { return false };
        let ends = self.arcs.iter().flat_map(|arc| [arc.point(-1.0), arc.point(0.0), arc.point(1.0)]);
        let far = ends.map(|p| p - from).reduce(|far, p| if p.norm_squared() > far.norm_squared() { p } else { far });
        let Some(along) = far.and_then(|far| far.try_normalize(0.0)) else { return false };
        let coordinates = self.arcs.iter().flat_map(|arc| &arc.position);
        let size = coordinates.map(Chebyshev::bound).fold(0.0, f64::max);
        let wide = (ROUNDING * size).min(STRAIGHT * far.map_or(0.0, |far| far.norm()));
        self.arcs.iter().all(|arc| {
            let [x, y] = arc.position.each_ref().map(Chebyshev::values);
            x.iter().zip(&y).all(|(x, y)| cross(along, Point::new(*x, *y) - from).abs() <= wide)
        })
    }

    /// Rounding of the first three derivatives on an arc, for the signs of functions of them.
    pub fn derivative_rounding(&self) -> [f64; 3] {
        // Differentiation of a series of n terms magnifies the rounding of its values by up to n^2 at the ends, twice by
        // up to n^4 / 3, three times by up to n^6 / 15.
        let n2 = (TERMS * TERMS) as f64;
        [self.rounding * n2, self.rounding * n2 * n2 / 3.0, self.rounding * n2 * n2 * n2 / 15.0]
    }
}

/// Less than the rounding of the smallest linkages. A curve of this size is a point: fourth powers of lengths on it would underflow.
const LEAST_ROUNDING: f64 = 1e-77;

/// Zeros closer than this part of a piece are not told from a double one: 1e-9 of a turn in pieces of an eighth.
const NARROW: f64 = 8e-9;

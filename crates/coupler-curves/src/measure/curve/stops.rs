//! Where a curve stops, and where it changes the side it bends to.

use super::{Arc, NARROW, Place, SmoothCurve};
use crate::geometry::{Chebyshev, TERMS, Vector, cross};

/// What a curve does where it stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopKind {
    /// It goes on from a cusp, on another path.
    Cusp,
    /// It returns on the same path.
    Reversal,
}

/// A place at which a curve stops: its velocity is zero, to rounding, in a parameter in which the motion is regular.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Where.
    pub place: Place,
    /// What it does there.
    pub kind: StopKind,
}

impl Stop {
    /// The difference of the parameter within which the side that the curve bends to is not known: at a cusp the turning
    /// has a double zero, where the path returns a triple one, whose places rounding spreads further. There the curve is so
    /// slow that it moves by the square of it.
    pub(super) fn width(&self) -> f64 {
        match self.kind {
            StopKind::Cusp => 1e-4,
            StopKind::Reversal => 1e-2,
        }
    }
}

impl SmoothCurve {
    /// The places at which the curve stops.
    pub fn stops(&self) -> Vec<Stop> {
        let mut found: Vec<Stop> = Vec::new();
        let [rounding, ..] = self.derivative_rounding();
        for (piece, arc) in self.arcs.iter().enumerate() {
            let (_, along, _) = arc.cone();
            if along > rounding {
                continue;
            }
            self.stops_on(arc, piece, [-1.0, 1.0], &mut found);
        }
        found
    }

    fn stops_on(&self, arc: &Arc, piece: usize, [from, to]: [f64; 2], found: &mut Vec<Stop>) {
        let [rounding, ..] = self.derivative_rounding();
        let half = (to - from) / 2.0;
        // Velocities are with respect to the parameter of the part.
        let rounding = rounding * half;
        let (_, along, _) = arc.cone();
        if along > rounding {
            return;
        }
        let is_slow = arc.greatest_speed() <= rounding;
        if is_slow && half > REST_WIDTH {
            return;
        }
        if half > STOP_WIDTH && !is_slow {
            let middle = (from + to) / 2.0;
            let [left, right] = arc.halves();
            self.stops_on(&left, piece, [from, middle], found);
            self.stops_on(&right, piece, [middle, to], found);
            return;
        }
        let whole = &self.arcs[piece];
        // The least speed nearby, by Newton's method for the zero of v . a.
        let acceleration = whole.velocity.each_ref().map(Chebyshev::derivative);
        let jerk = acceleration.each_ref().map(Chebyshev::derivative);
        let vector = |[x, y]: &[Chebyshev; 2], u: f64| Vector::new(x.at(u), y.at(u));
        let mut u = (from + to) / 2.0;
        for _ in 0..8 {
            let (v, a, j) = (whole.velocity(u), vector(&acceleration, u), vector(&jerk, u));
            let step = v.dot(&a) / (a.norm_squared() + v.dot(&j));
            u = if step.is_finite() { (u - step).clamp(-1.0, 1.0) } else { u };
        }
        if whole.velocity(u).norm() > self.derivative_rounding()[0] {
            return;
        }
        let (a, j) = (vector(&acceleration, u), vector(&jerk, u));
        // At a cusp the next derivative leaves the tangent; where the path returns, positions are even in the parameter.
        let [_, of_a, of_j] = self.derivative_rounding();
        let turns = cross(a, j).abs() - (of_j * a.norm() + of_a * j.norm());
        let is_cusp = turns > 1e-6 * a.norm_squared() && j.norm() > 1e-6 * a.norm();
        let kind = if is_cusp { StopKind::Cusp } else { StopKind::Reversal };
        // Between two pieces it is on both.
        let place = Place { piece, u };
        if found.iter().all(|stop| !self.are_near(stop.place, place, 4.0 * STOP_WIDTH)) {
            found.push(Stop { place, kind });
        }
    }

    /// The number of sign changes of the curvature, and the places where it is not known whether there are two or none.
    ///
    /// Where the path stops or has a corner, the direction of motion reverses, and no sign change is counted. A path that
    /// returns on itself passes each of its inflections twice.
    pub fn inflections(&self, stops: &[Stop]) -> (usize, usize) {
        /// If all terms of a series are off by its rounding, its derivatives at the ends are off by up to as many times
        /// more than if only the last is: the sum of the squares of 1 to 15 is 4.8 times the square of 16.
        const ALL_TERMS: f64 = 5.0;
        let stop_near = |place: Place| stops.iter().position(|stop| self.are_near(stop.place, place, stop.width()));
        // The sides to which the curve bends, in order, and `None` where it stops or has a corner.
        let mut bends: Vec<Option<bool>> = Vec::new();
        let mut doubtful = 0;
        let [first_rounding, second_rounding, _] = self.derivative_rounding();
        for (piece, arc) in self.arcs.iter().enumerate() {
            if self.corners[piece] {
                bends.push(None);
            }
            let [v, a, _] = arc.derivatives_at_nodes();
            let values: [f64; TERMS] = std::array::from_fn(|j| cross(v[j], a[j]));
            let rounding = first_rounding * greatest(&a) + second_rounding * greatest(&v);
            if values.iter().all(|value| value.abs() <= ALL_TERMS * rounding) {
                // Straight to rounding: it bends to neither side.
                if stops.iter().any(|stop| stop.place.piece == piece) {
                    bends.push(None);
                }
                continue;
            }
            let turning = Chebyshev::from_values(&values);
            let zeros = turning.zeros(rounding, NARROW);
            // Also where it is rounding from the stop to there.
            let is_spread = |stop: &Stop, u: f64| {
                stop.place.piece == piece && turning.at((u + stop.place.u) / 2.0).abs() <= rounding
            };
            let stop_at =
                |u: f64| stop_near(Place { piece, u }).or_else(|| stops.iter().position(|stop| is_spread(stop, u)));
            doubtful += zeros.doubtful.iter().filter(|u| stop_at(**u).is_none()).count();
            // The signs between the zeros; next to the ends of the piece a value may be rounding.
            let cuts: Vec<f64> = [-1.0].into_iter().chain(zeros.places).chain([1.0]).collect();
            for (k, ends) in cuts.windows(2).enumerate() {
                let value = turning.at((ends[0] + ends[1]) / 2.0);
                let is_inner = k > 0 && k + 2 < cuts.len();
                let around = [ends[0], ends[1]].map(stop_at);
                if around[0].is_some() {
                    bends.push(None);
                }
                // Around a stop the sign is rounding.
                let is_at_stop = around[0].is_some() && around[0] == around[1];
                if !is_at_stop && (is_inner || value.abs() > rounding) {
                    bends.push(Some(value > 0.0));
                }
            }
        }
        if self.is_closed {
            // On from the end, to the first bend, or to where the direction reverses before it.
            let on = bends.iter().position(Option::is_some).map_or(0, |first| first + 1);
            bends.extend_from_within(..on);
        }
        let changes = bends.windows(2).filter(|pair| matches!(pair, [Some(before), Some(after)] if before != after));
        (changes.count(), doubtful)
    }
}

/// The magnitude of the greatest of some vectors.
pub(super) fn greatest(vectors: &[Vector; TERMS]) -> f64 {
    vectors.iter().map(|vector| vector.norm()).fold(0.0, f64::max)
}

/// Half the width, as a parameter, of a part on which a curve that does not move to rounding is at rest and not at a
/// stop.
const REST_WIDTH: f64 = 1e-2;

/// Half the width, as a parameter, at which the place of a stop is refined by Newton's method.
pub(super) const STOP_WIDTH: f64 = 1e-5;

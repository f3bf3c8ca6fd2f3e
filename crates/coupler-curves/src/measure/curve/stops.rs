//! Where a curve stops, bends most, and changes the side it bends to.

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
        let turns = cross(a, j).abs();
        let is_cusp = turns > 1e-6 * a.norm_squared() && j.norm() > 1e-6 * a.norm();
        let kind = if is_cusp { StopKind::Cusp } else { StopKind::Reversal };
        let is_new = found.iter().all(|stop| {
            let [a, b] = [stop.place, Place { piece, u }].map(|place| place.piece as f64 * 2.0 + place.u);
            (a - b).abs() > 4.0 * STOP_WIDTH
        });
        if is_new {
            found.push(Stop { place: Place { piece, u }, kind });
        }
    }

    /// The number of sign changes of the curvature, and the places where it is not known whether there are two or none.
    ///
    /// Where the path stops or has a corner, the direction of motion reverses, and no sign change is counted.
    pub fn inflections(&self, stops: &[Stop]) -> (usize, usize) {
        /// If all terms of a series are off by its rounding, its derivatives at the ends are off by up to as many times
        /// more than if only the last is: the sum of the squares of 1 to 15 is 4.8 times the square of 16.
        const ALL_TERMS: f64 = 5.0;
        let (mut count, mut doubtful) = (0, 0);
        let mut last_sign: Option<bool> = None;
        let mut first_sign: Option<bool> = None;
        let [first_rounding, second_rounding, _] = self.derivative_rounding();
        for (piece, arc) in self.arcs.iter().enumerate() {
            if self.corners[piece] {
                last_sign = None;
            }
            let [v, a, _] = arc.derivatives_at_nodes();
            let values: [f64; TERMS] = std::array::from_fn(|j| cross(v[j], a[j]));
            let rounding = first_rounding * greatest(&a) + second_rounding * greatest(&v);
            if values.iter().all(|value| value.abs() <= ALL_TERMS * rounding) {
                // Straight to rounding: it bends to neither side.
                if stops.iter().any(|stop| stop.place.piece == piece) {
                    last_sign = None;
                }
                continue;
            }
            let turning = Chebyshev::from_values(&values);
            let zeros = turning.zeros(rounding, NARROW);
            let is_stop =
                |u: f64| stops.iter().any(|stop| stop.place.piece == piece && (stop.place.u - u).abs() < 1e-4);
            doubtful += zeros.doubtful.iter().filter(|u| !is_stop(**u)).count();
            // The signs between the zeros; next to the ends of the piece a value may be rounding.
            let cuts: Vec<f64> = [-1.0].into_iter().chain(zeros.places).chain([1.0]).collect();
            for (k, ends) in cuts.windows(2).enumerate() {
                let value = turning.at((ends[0] + ends[1]) / 2.0);
                let is_inner = k > 0 && k + 2 < cuts.len();
                if k > 0 && is_stop(ends[0]) {
                    last_sign = None;
                }
                if is_inner || value.abs() > rounding {
                    let sign = value > 0.0;
                    count += usize::from(last_sign.is_some_and(|last| last != sign));
                    first_sign = first_sign.or(Some(sign));
                    last_sign = Some(sign);
                }
            }
        }
        if let (true, false, Some(last), Some(first)) =
            (self.is_closed, self.corners.first().copied().unwrap_or(false), last_sign, first_sign)
            && last != first
        {
            count += 1;
        }
        (count, doubtful)
    }

    /// The place of the greatest curvature and the curvature there; `None` for a curve without pieces.
    pub fn sharpest(&self) -> Option<(f64, Place)> {
        /// A change of the curvature, relative to it, that is less than the accuracy promised.
        const SAME: f64 = 1e-10;
        let [_, second_rounding, third_rounding] = self.derivative_rounding();
        let mut best: Option<(f64, Place)> = None;
        let mut pending: Vec<(f64, usize, [f64; 2], Arc)> = Vec::new();
        for (piece, arc) in self.arcs.iter().enumerate() {
            pending.push((f64::INFINITY, piece, [-1.0, 1.0], arc.clone()));
        }
        // First the values at the nodes, so that most pieces are excluded by their bounds.
        for (piece, arc) in self.arcs.iter().enumerate() {
            let [v, a, _] = arc.derivatives_at_nodes();
            for (j, u) in Chebyshev::nodes().iter().enumerate() {
                offer_curvature(v[j], a[j], Place { piece, u: *u }, &mut best);
            }
        }
        while let Some((_, piece, [from, to], arc)) = pending.pop() {
            let derivatives = arc.derivatives_at_nodes();
            let [v, a, j] = &derivatives;
            let (_, along, _) = arc.cone();
            let turning = Chebyshev::from_values(&std::array::from_fn(|k| cross(v[k], a[k])));
            if along > 0.0 && best.is_some_and(|(most, _)| turning.bound() <= most * along * along * along) {
                continue;
            }
            // The numerator of the curvature's derivative.
            let rate = |k: usize| {
                let (v, a, j) = (v[k], a[k], j[k]);
                cross(v, j) * v.norm_squared() - 3.0 * cross(v, a) * v.dot(&a)
            };
            let rate = Chebyshev::from_values(&std::array::from_fn(rate));
            // Over the part the curvature changes by no more than this, or by nothing but rounding: as on a circle.
            let change = 2.0 * rate.bound() / (along * along * along * along * along);
            let is_same = along > 0.0 && best.is_some_and(|(most, _)| change <= SAME * most);
            let [speed, acceleration] = [v, a].map(greatest);
            let rounding = speed * speed * (speed * third_rounding + 6.0 * acceleration * second_rounding);
            if is_same || rate.bound() <= rounding {
                for (k, u) in Chebyshev::nodes().iter().enumerate() {
                    offer_curvature(v[k], a[k], Place { piece, u: (from + to + (to - from) * u) / 2.0 }, &mut best);
                }
                continue;
            }
            let (middle, half) = ((from + to) / 2.0, (to - from) / 2.0);
            let is_resolved = rate.0[TERMS - 2].abs().max(rate.0[TERMS - 1].abs()) <= 1e-7 * rate.bound();
            if is_resolved || half < STOP_WIDTH {
                let whole = &self.arcs[piece];
                let acceleration = whole.velocity.each_ref().map(Chebyshev::derivative);
                let mut places = rate.zeros(0.0, NARROW / half).places;
                places.extend([-1.0, 1.0]);
                for u in places {
                    let place = Place { piece, u: middle + half * u };
                    let a = Vector::new(acceleration[0].at(place.u), acceleration[1].at(place.u));
                    offer_curvature(whole.velocity(place.u), a, place, &mut best);
                }
                continue;
            }
            let [left, right] = arc.halves();
            pending.push((0.0, piece, [from, middle], left));
            pending.push((0.0, piece, [middle, to], right));
        }
        best
    }
}

/// The magnitude of the greatest of some vectors.
fn greatest(vectors: &[Vector; TERMS]) -> f64 {
    vectors.iter().map(|vector| vector.norm()).fold(0.0, f64::max)
}

fn offer_curvature(v: Vector, a: Vector, place: Place, best: &mut Option<(f64, Place)>) {
    let speed = v.norm();
    let curvature = (cross(v, a) / (speed * speed * speed)).abs();
    if curvature.is_finite() && best.is_none_or(|(most, _)| curvature > most) {
        *best = Some((curvature, place));
    }
}

/// Half the width, as a parameter, of a part on which a curve that does not move to rounding is at rest and not at a
/// stop.
const REST_WIDTH: f64 = 1e-2;

/// Half the width, as a parameter, at which the place of a stop is refined by Newton's method.
const STOP_WIDTH: f64 = 1e-5;

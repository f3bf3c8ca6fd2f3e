//! A curve between its samples: about each, the polynomial of the fourth degree through it and two on either side.

use super::sampled_curve::SampledCurve;
use crate::geometry::{Point, Vector, cross};

impl SampledCurve {
    /// The point a part of the way along, in samples from the first, and the input there; round a closed curve, on which a
    /// place may be a little less than nothing.
    pub fn point_and_input_at(&self, place: f64) -> (Point, f64) {
        let n = self.points.len();
        if place < 0.0 {
            let (point, input) = self.point_and_input_at(place + n as f64);
            return (point, input - self.net_input);
        }
        let whole = place as usize;
        let (i, part, rounds) = (whole % n, place - whole as f64, (whole / n) as f64 * self.net_input);
        if part == 0.0 {
            return (self.points[i], self.inputs[i] + rounds);
        }
        let next = self.neighbour(i, 1).unwrap_or(i);
        let (step, chord) = (self.points[next] - self.points[i], self.chords[i]);
        let input = self.inputs[next] + if next < i { self.net_input } else { 0.0 };
        // An arc over the chord, as flat as the curve is at the flatter end; of a turning back the other end tells.
        let bend = match [self.is_sharp[i], self.is_sharp[next]] {
            [true, _] => self.curvatures[next],
            [_, true] => self.curvatures[i],
            _ if self.curvatures[i].abs() < self.curvatures[next].abs() => self.curvatures[i],
            _ => self.curvatures[next],
        };
        let height = (bend * chord * part * (1.0 - part) / 2.0).clamp(-0.2, 0.2);
        let over_chord = self.points[i] + step * part + Vector::new(step.y, -step.x) * height;
        let straight = (over_chord, self.inputs[i] + (input - self.inputs[i]) * part);
        // Where the path turns back its samples on the other side do not tell of it; and where they lie too unevenly, a
        // polynomial through them strays further from their chord than a curve that is known by its samples does.
        let about = |k: usize, u: f64, from: f64| {
            let (by, further) = self.local_polynomial(k).filter(|near| near.is_smooth)?.point_and_input_at(u);
            let found = (self.points[k] + by, from + further);
            let strayed = (found.0 - straight.0).norm();
            (strayed <= 0.2 * chord && found.1.is_finite()).then_some(found)
        };
        // About the sample that is nearer, by the length of the chords; halfway the one goes over into the other.
        let over = ((part - 0.25) * 2.0).clamp(0.0, 1.0);
        let before = || about(i, part * chord, self.inputs[i]).unwrap_or(straight);
        let after = || about(next, (part - 1.0) * chord, input).unwrap_or(straight);
        let (point, at) = match over {
            0.0 => before(),
            1.0 => after(),
            _ => {
                let (a, b) = (before(), after());
                (a.0 + (b.0 - a.0) * over, a.1 + (b.1 - a.1) * over)
            }
        };
        let [low, high] = [self.inputs[i].min(input), self.inputs[i].max(input)];
        (point, at.clamp(low, high) + rounds)
    }

    /// How far the input has gone, there and back, from the first sample to a place.
    pub fn input_travel_at(&self, place: f64) -> f64 {
        self.point_and_travel_at(place).1
    }

    /// The point at a place, and how far the input has gone, there and back, from the first sample to it.
    pub fn point_and_travel_at(&self, place: f64) -> (Point, f64) {
        let n = self.points.len();
        if place < 0.0 {
            let (point, travelled) = self.point_and_travel_at(place + n as f64);
            return (point, travelled - self.input_travel[n]);
        }
        let (whole, part) = (place as usize, place - (place as usize) as f64);
        let (i, rounds) = (whole % n, (whole / n) as f64);
        let (from, to) = (self.input_travel[i], self.input_travel[i + 1]);
        let (point, input) = self.point_and_input_at(i as f64 + part);
        (point, rounds * self.input_travel[n] + from + (input - self.inputs[i]).abs().min(to - from))
    }

    /// The greatest extent in a direction, about the point that is furthest.
    pub fn max_extent(&self, direction: Vector, top: usize) -> f64 {
        let height = |i: usize| direction.dot(&self.points[i].coords);
        let Some(near) = self.local_polynomial(top) else { return height(top) };
        let rise = near.maximum(|near, u| direction.dot(&near.derivatives_at(u)[0]));
        // A curve does not rise above its furthest sample by more than a part of the way to the next.
        if rise > 0.0 && rise < 0.5 * (near.range[1] - near.range[0]) { height(top) + rise } else { height(top) }
    }

    /// The greatest curvature about a sample.
    pub fn max_curvature_near(&self, i: usize) -> f64 {
        let curvature = |near: &LocalPolynomial, u: f64| {
            let [_, v, a] = near.derivatives_at(u);
            (cross(v, a) / (v.norm_squared() * v.norm())).abs()
        };
        self.local_polynomial(i).map_or(self.curvatures[i].abs(), |near| near.maximum(curvature))
    }

    /// How far a point near a sample is from the curve there, positive to the left, and the curve's normal.
    pub fn signed_distance(&self, point: Point, i: usize) -> Option<(f64, Vector)> {
        let near = self.local_polynomial(i)?;
        let mut u = 0.0;
        // Newton's steps to where the way from the curve is square to it.
        for _ in 0..4 {
            let [p, v, a] = near.derivatives_at(u);
            let by = self.points[i] + p - point;
            let step = by.dot(&v) / (v.norm_squared() + by.dot(&a));
            if !step.is_finite() {
                return None;
            }
            u = (u - step).clamp(near.range[0], near.range[1]);
        }
        let [p, v, _] = near.derivatives_at(u);
        let normal = Vector::new(-v.y, v.x).try_normalize(0.0)?;
        Some((normal.dot(&(point - self.points[i] - p)), normal))
    }

    /// The curve about a sample that two others stand on either side of; of fewer than five samples there is none.
    fn local_polynomial(&self, i: usize) -> Option<&LocalPolynomial> {
        (self.points.len() >= 5).then(|| self.local_polynomials[i].get_or_init(|| self.fit_local_polynomial(i)))
    }

    fn fit_local_polynomial(&self, i: usize) -> LocalPolynomial {
        let n = self.points.len() as isize;
        // Near the end of an open curve the five are those next to the end.
        let shift = if self.is_closed { 0 } else { (2 - i as isize).max(0) + (n - 3 - i as isize).min(0) };
        let own = self.points[i];
        let mut s = [0.0; 5];
        let mut divided = [PointAndInput::zeros(); 5];
        let mut before = own;
        for k in 0..5 {
            let at = i as isize + k as isize - 2 + shift;
            let (sample, over) = match at {
                _ if at < 0 => (at + n, -self.net_input),
                _ if at >= n => (at - n, self.net_input),
                _ => (at, 0.0),
            };
            let point = self.points[sample as usize];
            s[k] = if k == 0 { 0.0 } else { s[k - 1] + (point - before).norm() };
            let by = point - own;
            divided[k] = PointAndInput::new(by.x, by.y, self.inputs[sample as usize] + over - self.inputs[i]);
            before = point;
        }
        let at_own = s[(2 - shift) as usize];
        let s = s.map(|s| s - at_own);
        for order in 1..5 {
            for k in (order..5).rev() {
                divided[k] = (divided[k] - divided[k - 1]) * (1.0 / (s[k] - s[k - order]));
            }
        }
        // From products of (u - s) to powers of u.
        let mut powers = [PointAndInput::zeros(); 5];
        for k in (0..5).rev() {
            for n in (1..5).rev() {
                powers[n] = powers[n - 1] - powers[n] * s[k];
            }
            powers[0] = divided[k] - powers[0] * s[k];
        }
        let ends = [1, 3].map(|k| s[(k - shift).clamp(0, 4) as usize]);
        let is_smooth = (-2..=2).all(|off| self.neighbour(i, off).is_none_or(|k| !self.turns_sharply(k)));
        LocalPolynomial { coefficients: powers, range: ends, is_smooth }
    }
}

/// What changes along the curve: x, y and the input.
type PointAndInput = nalgebra::Vector3<f64>;

/// A curve about a sample: polynomials in the length of the chords, through five samples.
#[derive(Clone, Debug)]
pub(super) struct LocalPolynomial {
    /// From the sample, by powers.
    coefficients: [PointAndInput; 5],
    /// At the samples before and after.
    range: [f64; 2],
    /// Whether no sample within two of it is a turning back of the path.
    is_smooth: bool,
}

impl LocalPolynomial {
    /// The place and the input, from those of the sample.
    fn point_and_input_at(&self, u: f64) -> (Vector, f64) {
        let [a, b, c, d, e] = &self.coefficients;
        let at = (((e * u + d) * u + c) * u + b) * u + a;
        (at.xy(), at.z)
    }

    /// The place, from the sample, and its first two derivatives.
    fn derivatives_at(&self, u: f64) -> [Vector; 3] {
        let powers = self.coefficients.iter().rev().map(|power| power.xy());
        powers.fold([Vector::zeros(); 3], |[p, v, a], c| [p * u + c, v * u + p, a * u + v * 2.0])
    }

    /// The greatest value between the samples before and after.
    fn maximum(&self, of: impl Fn(&LocalPolynomial, f64) -> f64) -> f64 {
        let [mut a, mut b] = self.range;
        // To 1e-7 of the way between samples: what is flat there is known to the square of that.
        for _ in 0..40 {
            let (c, d) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
            if of(self, c) > of(self, d) { b = d } else { a = c }
        }
        of(self, a)
    }
}

//! Interpolation between samples: at each sample, the polynomial of the fourth degree through it and two on either
//! side.

use super::local_polynomial::{LocalPolynomial, PointAndInput};
use super::sampled_curve::SampledCurve;
use crate::geometry::{Point, Vector, cross};

impl SampledCurve {
    /// The point and the input at a position, which is a fractional sample index; on a closed curve it may be a little
    /// negative, or beyond the last sample.
    pub fn point_and_input_at(&self, position: f64) -> (Point, f64) {
        let n = self.points.len();
        if position < 0.0 {
            let (point, input) = self.point_and_input_at(position + n as f64);
            return (point, input - self.net_input);
        }
        let whole = position as usize;
        let (i, part, rounds) = (whole % n, position - whole as f64, (whole / n) as f64 * self.net_input);
        if part == 0.0 {
            return (self.points[i], self.inputs[i] + rounds);
        }
        let next = self.neighbour(i, 1).unwrap_or(i);
        let (step, chord) = (self.points[next] - self.points[i], self.chords[i]);
        let input = self.inputs[next] + if next < i { self.net_input } else { 0.0 };
        // An arc over the chord, with the lesser curvature of its ends, or that of the other end if one is a cusp.
        let curvature = match [self.is_sharp[i], self.is_sharp[next]] {
            [true, _] => self.curvatures[next],
            [_, true] => self.curvatures[i],
            _ if self.curvatures[i].abs() < self.curvatures[next].abs() => self.curvatures[i],
            _ => self.curvatures[next],
        };
        let height = (curvature * chord * part * (1.0 - part) / 2.0).clamp(-0.2, 0.2);
        let over_chord = self.points[i] + step * part + Vector::new(step.y, -step.x) * height;
        let straight = (over_chord, self.inputs[i] + (input - self.inputs[i]) * part);
        // A polynomial through samples on both sides of a cusp is not used; nor is one that is far from the chord
        // because its samples are too uneven.
        let interpolated = |k: usize, u: f64, from: f64| {
            let (by, further) = self.local_polynomial(k).filter(|near| near.is_smooth)?.point_and_input_at(u);
            let found = (self.points[k] + by, from + further);
            let deviation = (found.0 - straight.0).norm();
            (deviation <= 0.2 * chord && found.1.is_finite()).then_some(found)
        };
        // The polynomial of the nearer sample; around the middle of the interval the two are blended.
        let weight = ((part - 0.25) * 2.0).clamp(0.0, 1.0);
        let before = || interpolated(i, part * chord, self.inputs[i]).unwrap_or(straight);
        let after = || interpolated(next, (part - 1.0) * chord, input).unwrap_or(straight);
        let (point, at) = match weight {
            0.0 => before(),
            1.0 => after(),
            _ => {
                let (a, b) = (before(), after());
                (a.0 + (b.0 - a.0) * weight, a.1 + (b.1 - a.1) * weight)
            }
        };
        let [low, high] = [self.inputs[i].min(input), self.inputs[i].max(input)];
        (point, at.clamp(low, high) + rounds)
    }

    /// The travel of the input, forward and backward, from the first sample to a position.
    pub fn input_travel_at(&self, position: f64) -> f64 {
        self.point_and_travel_at(position).1
    }

    /// The point at a position, and the travel of the input, forward and backward, from the first sample to it.
    pub fn point_and_travel_at(&self, position: f64) -> (Point, f64) {
        let n = self.points.len();
        if position < 0.0 {
            let (point, travel) = self.point_and_travel_at(position + n as f64);
            return (point, travel - self.input_travel[n]);
        }
        let (whole, part) = (position as usize, position - (position as usize) as f64);
        let (i, rounds) = (whole % n, (whole / n) as f64);
        let (from, to) = (self.input_travel[i], self.input_travel[i + 1]);
        let (point, input) = self.point_and_input_at(i as f64 + part);
        (point, rounds * self.input_travel[n] + from + (input - self.inputs[i]).abs().min(to - from))
    }

    /// The greatest extent in a direction, interpolated around the sample `top`, which is the furthest.
    pub fn max_extent(&self, direction: Vector, top: usize) -> f64 {
        let height = |i: usize| direction.dot(&self.points[i].coords);
        let Some(near) = self.local_polynomial(top) else { return height(top) };
        let rise = near.maximum(|near, u| direction.dot(&near.derivatives_at(u)[0]));
        // The curve does not rise above its furthest sample by more than a part of the distance to the next.
        if rise > 0.0 && rise < 0.5 * (near.range[1] - near.range[0]) { height(top) + rise } else { height(top) }
    }

    /// The greatest curvature around a sample.
    pub fn max_curvature_near(&self, i: usize) -> f64 {
        let curvature = |near: &LocalPolynomial, u: f64| {
            let [_, v, a] = near.derivatives_at(u);
            (cross(v, a) / (v.norm_squared() * v.norm())).abs()
        };
        self.local_polynomial(i).map_or(self.curvatures[i].abs(), |near| near.maximum(curvature))
    }

    /// The signed distance of a point from the curve around a sample, positive to the left, and the curve's normal.
    pub fn signed_distance(&self, point: Point, i: usize) -> Option<(f64, Vector)> {
        let near = self.local_polynomial(i)?;
        let mut u = 0.0;
        // Newton's method for the foot of the perpendicular from the point.
        for _ in 0..4 {
            let [p, v, a] = near.derivatives_at(u);
            let offset = self.points[i] + p - point;
            let step = offset.dot(&v) / (v.norm_squared() + offset.dot(&a));
            if !step.is_finite() {
                return None;
            }
            u = (u - step).clamp(near.range[0], near.range[1]);
        }
        let [p, v, _] = near.derivatives_at(u);
        let normal = Vector::new(-v.y, v.x).try_normalize(0.0)?;
        Some((normal.dot(&(point - self.points[i] - p)), normal))
    }

    /// The polynomial around a sample; `None` if there are fewer than five samples.
    fn local_polynomial(&self, i: usize) -> Option<&LocalPolynomial> {
        (self.points.len() >= 5).then(|| self.local_polynomials[i].get_or_init(|| self.fit_local_polynomial(i)))
    }

    fn fit_local_polynomial(&self, i: usize) -> LocalPolynomial {
        let n = self.points.len() as isize;
        // At the ends of an open curve the five samples are the first or the last ones.
        let shift = if self.is_closed { 0 } else { (2 - i as isize).max(0) + (n - 3 - i as isize).min(0) };
        let own = self.points[i];
        let mut s = [0.0; 5];
        let mut divided = [PointAndInput::zeros(); 5];
        let mut previous = own;
        for k in 0..5 {
            let at = i as isize + k as isize - 2 + shift;
            let (sample, input_offset) = match at {
                _ if at < 0 => (at + n, -self.net_input),
                _ if at >= n => (at - n, self.net_input),
                _ => (at, 0.0),
            };
            let point = self.points[sample as usize];
            s[k] = if k == 0 { 0.0 } else { s[k - 1] + (point - previous).norm() };
            let offset = point - own;
            divided[k] =
                PointAndInput::new(offset.x, offset.y, self.inputs[sample as usize] + input_offset - self.inputs[i]);
            previous = point;
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

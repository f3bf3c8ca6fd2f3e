//! Portions of curves that are like an open path.
//!
//! A path is described by nine points at equal distances along it. A window of a curve, nine of its points at equal distances,
//! is compared with them by one correlation in all positions, sizes and directions, and by another one in reflection; but only if
//! the distances of its ends and of its middle are about as long in parts of its length as those of the path.

use super::complex::{Complex, closed_length, length, mean, open_length, unit};
use super::spectrum::{HARMONICS, resampled};
use std::f64::consts::TAU;

/// The points of a window.
const POINTS: usize = 9;

/// The intervals of a window.
const INTERVALS: usize = POINTS - 1;

/// The points of a curve in the index, at equal distances.
const CURVE_POINTS: usize = 64;

/// A path, described for comparison.
#[derive(Clone, Debug)]
pub(super) struct Stroke {
    /// In both directions: with centroid 0 and a sum of squares of 1.
    directions: [[[f32; POINTS]; 2]; 2],
    /// The distances of the ends, of the start from the middle, and of the middle from the end, in parts of the length.
    spans: [[f32; 3]; 2],
    /// The centroid of the points at equal distances, and the root of the sum of their squares from it.
    centre: Complex,
    size: f64,
}

/// A window of a curve that is like a stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Window {
    /// The part of the stroke's sum of squares that remains where it is placed best.
    pub residual: f32,
    /// Whether the curve is mirrored in the x-axis before it is placed.
    pub is_mirrored: bool,
    /// Its first point, the distance to the next, in points of the curve, and whether the stroke is reversed.
    first: usize,
    stride: usize,
    is_reversed: bool,
}

impl Stroke {
    /// The description of an open polyline.
    pub fn new(points: &[Complex]) -> Stroke {
        let points = spaced_evenly(points);
        let centre = mean(&points);
        let size = points.iter().map(|z| (z - centre).norm_sqr()).sum::<f64>().sqrt();
        let whole = open_length(&points);
        let normalized: Vec<Complex> = points.iter().map(|z| (z - centre) / size.max(f64::MIN_POSITIVE)).collect();
        let coordinates = |at: &dyn Fn(usize) -> usize| {
            [std::array::from_fn(|k| normalized[at(k)].re as f32), std::array::from_fn(|k| normalized[at(k)].im as f32)]
        };
        let span = |a: usize, b: usize| (length(points[a] - points[b]) / whole.max(f64::MIN_POSITIVE)) as f32;
        let [ends, first, second] = [span(0, INTERVALS), span(0, INTERVALS / 2), span(INTERVALS / 2, INTERVALS)];
        Stroke {
            directions: [coordinates(&|k| k), coordinates(&|k| INTERVALS - k)],
            spans: [[ends, first, second], [ends, second, first]],
            centre,
            size,
        }
    }

    /// The window of a closed curve that is most like the stroke. The curve is given by points at equal distances, repeated once,
    /// and its length; every `step`-th point may be the first, and every multiple of `stride` the distance of its points. `None` if no
    /// window has about the stroke's spans.
    fn best_window(&self, [xs, ys]: [&[f32]; 2], curve_length: f32, step: usize) -> Option<Window> {
        /// The greatest difference of spans.
        const TOLERANCE: f32 = 0.1;
        let count = xs.len() / 2;
        let mut best: Option<Window> = None;
        for stride in 1..=count / INTERVALS {
            let whole = curve_length * (INTERVALS * stride) as f32 / count as f32;
            // Bounds of the squares of distances, in the unit of the curve.
            let bounds = self.spans.map(|spans| {
                spans
                    .map(|span| [(span - TOLERANCE).max(0.0), span + TOLERANCE].map(|span| span * whole * span * whole))
            });
            for first in (0..count).step_by(step) {
                let [a, b, c] = [0, INTERVALS / 2, INTERVALS].map(|k| (xs[first + k * stride], ys[first + k * stride]));
                let square = |p: (f32, f32), q: (f32, f32)| (p.0 - q.0) * (p.0 - q.0) + (p.1 - q.1) * (p.1 - q.1);
                let squares = [square(a, c), square(a, b), square(b, c)];
                for (direction, bounds) in bounds.iter().enumerate() {
                    let is_within =
                        squares.iter().zip(bounds).all(|(square, [low, high])| (low..=high).contains(&square));
                    if !is_within {
                        continue;
                    }
                    let window = self.compare([&xs[first..], &ys[first..]], stride, direction);
                    if best.is_none_or(|best| window.residual < best.residual) {
                        best = Some(Window { first, ..window });
                    }
                }
            }
        }
        best
    }

    /// The window from the first of some points on.
    fn compare(&self, [xs, ys]: [&[f32]; 2], stride: usize, direction: usize) -> Window {
        let [us, vs] = &self.directions[direction];
        let (mut x_sum, mut y_sum, mut squares) = (0.0, 0.0, 0.0);
        let (mut ux, mut uy, mut vx, mut vy) = (0.0, 0.0, 0.0, 0.0);
        for k in 0..POINTS {
            let (x, y) = (xs[k * stride], ys[k * stride]);
            (x_sum, y_sum, squares) = (x_sum + x, y_sum + y, squares + x * x + y * y);
            (ux, uy) = (ux + us[k] * x, uy + us[k] * y);
            (vx, vy) = (vx + vs[k] * x, vy + vs[k] * y);
        }
        let spread = (squares - (x_sum * x_sum + y_sum * y_sum) / POINTS as f32).max(f32::MIN_POSITIVE);
        let same = (ux + vy) * (ux + vy) + (uy - vx) * (uy - vx);
        let mirrored = (ux - vy) * (ux - vy) + (uy + vx) * (uy + vx);
        let residual = 1.0 - same.max(mirrored) / spread;
        Window { residual, is_mirrored: mirrored > same, first: 0, stride, is_reversed: direction == 1 }
    }

    /// The window of a closed curve that is most like the stroke, and the factor and the shift of the similarity that places the curve, after
    /// its reflection, on the stroke.
    pub fn placement(&self, curve: &[Complex]) -> Option<(Window, Complex, Complex)> {
        const COUNT: usize = 2 * CURVE_POINTS;
        let points = resampled(curve, COUNT);
        let twice = |coordinate: fn(&Complex) -> f64| -> Vec<f32> {
            points.iter().chain(&points).map(|z| coordinate(z) as f32).collect()
        };
        let (xs, ys) = (twice(|z| z.re), twice(|z| z.im));
        let whole = closed_length(&points) as f32;
        let window = self.best_window([&xs, &ys], whole, 1)?;
        let at = |k: usize| {
            let k = if window.is_reversed { INTERVALS - k } else { k };
            let z = points[(window.first + k * window.stride) % COUNT];
            if window.is_mirrored { z.conj() } else { z }
        };
        let own: Vec<Complex> = (0..POINTS).map(at).collect();
        let own_centre = mean(&own);
        let [us, vs] = &self.directions[0];
        let stroke = |k: usize| Complex::new(us[k].into(), vs[k].into());
        let product: Complex = (0..POINTS).map(|k| (own[k] - own_centre).conj() * stroke(k)).sum();
        let spread: f64 = own.iter().map(|z| (z - own_centre).norm_sqr()).sum();
        let factor = product / spread.max(f64::MIN_POSITIVE) * self.size;
        (factor.norm_sqr() > 0.0).then(|| (window, factor, self.centre - factor * own_centre))
    }
}

/// Points at equal distances along an open polyline, with both ends.
fn spaced_evenly(points: &[Complex]) -> Vec<Complex> {
    let lengths: Vec<f64> = points.windows(2).map(|pair| length(pair[1] - pair[0])).collect();
    let step = lengths.iter().sum::<f64>() / INTERVALS as f64;
    let (mut segment, mut before) = (0, 0.0);
    let point = |k: usize| {
        let at = step * k as f64;
        while segment + 1 < lengths.len() && before + lengths[segment] < at {
            before += lengths[segment];
            segment += 1;
        }
        let part = if lengths[segment] > 0.0 { ((at - before) / lengths[segment]).min(1.0) } else { 0.0 };
        points[segment] + (points[segment + 1] - points[segment]) * part
    };
    (0..POINTS).map(point).collect()
}

/// Computes the points of curves from their harmonics.
pub(super) struct Synthesis {
    /// The cosines and the sines of the multiples of the angles of the first half of the points.
    cosines: [[f32; CURVE_POINTS / 2]; HARMONICS],
    sines: [[f32; CURVE_POINTS / 2]; HARMONICS],
}

impl Synthesis {
    pub fn new() -> Synthesis {
        let direction = |k: usize, n: usize| unit(TAU * (((k + 1) * n) % CURVE_POINTS) as f64 / CURVE_POINTS as f64);
        Synthesis {
            cosines: std::array::from_fn(|k| std::array::from_fn(|n| direction(k, n).re as f32)),
            sines: std::array::from_fn(|k| std::array::from_fn(|n| direction(k, n).im as f32)),
        }
    }

    /// The window of a curve that is most like a stroke: the curve is given by its harmonics of order 1 to 10 and then of -1 to -10, and by its
    /// length.
    pub fn best_window(&self, harmonics: &[[f32; 2]; 2 * HARMONICS], length: f32, stroke: &Stroke) -> Option<Window> {
        const HALF: usize = CURVE_POINTS / 2;
        let mut even = [[0.0f32; HALF]; 2];
        let mut odd = [[0.0f32; HALF]; 2];
        let mut opposite = [0.0f32; 2];
        for k in 0..HARMONICS {
            let ([a, b], [c, d]) = (harmonics[k], harmonics[HARMONICS + k]);
            let (sum, difference) = ([a + c, b + d], [d - b, a - c]);
            for axis in 0..2 {
                for n in 0..HALF {
                    even[axis][n] += sum[axis] * self.cosines[k][n];
                    odd[axis][n] += difference[axis] * self.sines[k][n];
                }
                opposite[axis] += if k % 2 == 0 { -sum[axis] } else { sum[axis] };
            }
        }
        let coordinates: [[f32; 2 * CURVE_POINTS]; 2] = std::array::from_fn(|axis| {
            let at = |n: usize| match n {
                HALF => opposite[axis],
                n if n < HALF => even[axis][n] + odd[axis][n],
                n => even[axis][CURVE_POINTS - n] - odd[axis][CURVE_POINTS - n],
            };
            std::array::from_fn(|n| at(n % CURVE_POINTS))
        });
        let [xs, ys] = &coordinates;
        stroke.best_window([xs, ys], length, 2)
    }
}

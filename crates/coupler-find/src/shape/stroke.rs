//! Portions of curves that are like an open path.
//!
//! A path is described by nine points at equal distances along it. A window of a curve, nine of its points at equal distances,
//! is compared with them by one correlation in all positions, sizes and directions, and by another one in reflection; but only if
//! the distances of its ends and of its middle are about as long in parts of its length as those of the path.

use crate::complex::{Complex, closed_length, length, mean, open_length};
use crate::shape::spectrum::{resampled, without_noise};
use coupler_curves::geometry::Similarity;

/// The points of a window.
const POINTS: usize = 9;

/// The intervals of a window.
const INTERVALS: usize = POINTS - 1;

/// The points of a curve in the index, at equal distances.
pub(crate) const CURVE_POINTS: usize = 64;

/// The points of a curve between which the windows of [`Stroke::windows`] are.
const WINDOW_POINTS: usize = 256;

/// The greatest difference of spans in parts of the length, and that where windows are compared more closely afterwards: it allows for
/// portions between the windows.
pub(crate) const TOLERANCE: f32 = 0.1;
pub(crate) const LOOSE_TOLERANCE: f32 = 0.25;

/// A path, described for comparison.
#[derive(Clone, Debug)]
pub(crate) struct Stroke {
    /// In both directions: with centroid 0 and a sum of squares of 1.
    directions: [[[f32; POINTS]; 2]; 2],
    /// The distances of the ends, of the start from the middle, and of the middle from the end, in parts of the length.
    spans: [[f32; 3]; 2],
    /// Whether windows of other spans are left out.
    has_spans: bool,
    /// The centroid of the points at equal distances, and the root of the sum of their squares from it.
    centre: Complex,
    size: f64,
}

/// A window of a curve that is like a stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Window {
    /// The part of the stroke's sum of squares that remains where it is placed best.
    pub residual: f32,
    /// Whether the curve is mirrored in the x-axis before it is placed.
    pub is_mirrored: bool,
    /// Its first point, the distance to the next, in points of the curve, and whether the stroke is reversed.
    pub first: usize,
    stride: usize,
    pub is_reversed: bool,
}

impl Window {
    /// Where a window of [`Stroke::windows`] begins and ends, in parts of the curve; the second is greater, and may be in the second round.
    pub fn ends(&self) -> [f64; 2] {
        let ends = [self.first, self.first + INTERVALS * self.stride];
        ends.map(|end| end as f64 / WINDOW_POINTS as f64)
    }
}

/// The windows of a curve that are tried.
pub(crate) struct Windows {
    /// Every so many-th point may be the first.
    pub step: usize,
    /// The least part of the curve that a window is.
    pub least: f64,
    /// By how much its spans may differ from those of the stroke, as parts of its length.
    pub tolerance: f32,
}

impl Stroke {
    /// The description of an open polyline.
    pub fn new(points: &[Complex]) -> Stroke {
        let points: [Complex; POINTS] = spaced_evenly(&without_noise(points));
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
            has_spans: true,
            centre,
            size,
        }
    }

    /// Compares windows whatever their spans are from now on; false if it has done so before.
    pub fn ignore_spans(&mut self) -> bool {
        std::mem::replace(&mut self.has_spans, false)
    }

    /// The window of a closed curve that is most like the stroke. The curve is given by points at equal distances, repeated once,
    /// and its length. `None` if no window has about the stroke's spans.
    pub fn best_window(&self, curve: [&[f32]; 2], curve_length: f32, tried: &Windows) -> Option<Window> {
        let mut best: Option<Window> = None;
        self.for_each_window(curve, curve_length, tried, |both| {
            let window = likelier(both);
            if best.is_none_or(|best| window.residual < best.residual) {
                best = Some(window);
            }
        });
        best
    }

    /// Calls a function with the windows of those that are tried that have about the stroke's spans, each with its mirror image.
    pub fn for_each_window(
        &self,
        [xs, ys]: [&[f32]; 2],
        curve_length: f32,
        &Windows { step, least, tolerance }: &Windows,
        mut receive: impl FnMut([Window; 2]),
    ) {
        let count = xs.len() / 2;
        let least = (least * count as f64 / INTERVALS as f64) as usize;
        let tolerance = if self.has_spans { tolerance } else { f32::INFINITY };
        for stride in least.max(1)..=count / INTERVALS {
            let whole = curve_length * (INTERVALS * stride) as f32 / count as f32;
            // Bounds of the squares of distances, in the unit of the curve.
            let bounds = self.spans.map(|spans| {
                spans
                    .map(|span| [(span - tolerance).max(0.0), span + tolerance].map(|span| span * whole * span * whole))
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
                    let [same, mirrored] = self.residuals([&xs[first..], &ys[first..]], stride, direction);
                    let as_it_is =
                        Window { residual: same, is_mirrored: false, first, stride, is_reversed: direction == 1 };
                    receive([as_it_is, Window { residual: mirrored, is_mirrored: true, ..as_it_is }]);
                }
            }
        }
    }

    /// The part of the stroke's sum of squares that remains for the window from the first of some points on, and for its mirror image.
    fn residuals(&self, [xs, ys]: [&[f32]; 2], stride: usize, direction: usize) -> [f32; 2] {
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
        [same, mirrored].map(|square| 1.0 - square / spread)
    }

    /// The residual of the best portion near a window of a curve of [`CURVE_POINTS`] points that are repeated once, at least a part of the curve:
    /// its ends move to where a paraboloid through the residuals around them is least, by less and less. One that seems to remain above `most`
    /// is left.
    pub fn least_residual_near(
        &self,
        [xs, ys]: &[[f32; 2 * CURVE_POINTS]; 2],
        window: &Window,
        (least, most): (f32, f32),
    ) -> f32 {
        /// How far from the ends the residuals are taken, in points of the curve; how many times as far they move at most.
        const REACHES: [f32; 3] = [2.0, 0.7, 0.25];
        const FARTHEST: f32 = 3.0;
        /// By what factor and by how much a residual falls from there on, at most, as far as is seen: of forty parts of random four-bars, as many
        /// have their own curve among the nearest 460 of 20,000 as without this, 18.
        const FALLS: [(f32, f32); 3] = [(4.0, 0.01), (3.0, 0.002), (3.0, 0.002)];
        const WHOLE: f32 = CURVE_POINTS as f32;
        let residual = |[from, to]: [f32; 2]| -> f32 {
            if to - from > WHOLE || to - from < least * WHOLE || to - from < 1.0 {
                return f32::INFINITY;
            }
            let from_first_round = from.rem_euclid(WHOLE);
            let mut points = [[0.0f32; POINTS]; 2];
            for k in 0..POINTS {
                let at = from_first_round + (to - from) * (k as f32 / INTERVALS as f32);
                let (n, part) = (at as usize, at.fract());
                for (points, values) in points.iter_mut().zip([xs, ys]) {
                    let next = values[(n + 1) % values.len()];
                    points[k] = values[n % values.len()] + (next - values[n % values.len()]) * part;
                }
            }
            let [xs, ys] = &points;
            let [same, mirrored] = self.residuals([xs, ys], 1, usize::from(window.is_reversed));
            same.min(mirrored)
        };
        let mut best = (window.residual, [window.first as f32, (window.first + INTERVALS * window.stride) as f32]);
        for (reach, (factor, fall)) in REACHES.into_iter().zip(FALLS) {
            let (here, [from, to]) = best;
            if here > factor * most + fall {
                break;
            }
            let mut at = |by: [f32; 2]| {
                let ends = [from + by[0] * reach, to + by[1] * reach];
                let there = residual(ends);
                if there < best.0 {
                    best = (there, ends);
                }
                there
            };
            let [after, before, later, earlier, both] =
                [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [1.0, 1.0]].map(&mut at);
            let gradient = [(after - before) / 2.0, (later - earlier) / 2.0];
            let second = [after + before - 2.0 * here, later + earlier - 2.0 * here];
            let mixed = both - after - later + here;
            let determinant = second[0] * second[1] - mixed * mixed;
            // Where an end cannot move so far, the residual there is infinite, and this is not.
            if second[0] > 0.0 && determinant > 0.0 && determinant.is_finite() {
                let step =
                    [mixed * gradient[1] - second[1] * gradient[0], mixed * gradient[0] - second[0] * gradient[1]];
                let step = step.map(|by| by / determinant);
                let farthest = step[0].abs().max(step[1].abs()).max(FARTHEST);
                at(step.map(|by| by * FARTHEST / farthest));
            }
        }
        best.0
    }

    /// The similarity that places a closed curve on the stroke where it is most like it, and the residual there.
    pub fn placement(&self, curve: &[Complex]) -> Option<(f32, Similarity)> {
        let (points, coordinates, whole) = repeated(curve, 2 * CURVE_POINTS);
        let window = self.best_window(
            coordinates.each_ref().map(|values| &values[..]),
            whole,
            &Windows { step: 1, least: 0.0, tolerance: TOLERANCE },
        )?;
        Some((window.residual, self.similarity(&window, &points)?))
    }

    /// Windows of a closed curve that are like the stroke and are at least a part of the curve, the likeliest first, in different places or
    /// directions, with and without a reflection, as far as `may_begin` allows.
    pub fn windows(
        &self,
        curve: &[Complex],
        (least, most): (f64, usize),
        may_begin: impl Fn(&Window) -> bool,
    ) -> Vec<Window> {
        /// Of the curve, an end of windows in different places.
        const APART: f64 = 1.0 / 20.0;
        /// Every so many-th point may be the first.
        const STEP: usize = 4;
        let (_, coordinates, whole) = repeated(curve, WINDOW_POINTS);
        let coordinates = coordinates.each_ref().map(|values| &values[..]);
        let mut windows: Vec<Window> = Vec::new();
        let tried = Windows { step: STEP, least, tolerance: LOOSE_TOLERANCE };
        self.for_each_window(coordinates, whole, &tried, |both| windows.extend(both.into_iter().filter(&may_begin)));
        windows.sort_by(|a, b| a.residual.total_cmp(&b.residual));
        let are_apart = |a: f64, b: f64| {
            let difference = (a - b).rem_euclid(1.0);
            difference.min(1.0 - difference) > APART
        };
        let mut found: Vec<Window> = Vec::new();
        for window in windows {
            let is_new = |other: &Window| {
                (window.is_mirrored, window.is_reversed) != (other.is_mirrored, other.is_reversed)
                    || window.ends().iter().zip(other.ends()).any(|(a, b)| are_apart(*a, b))
            };
            if found.iter().all(is_new) {
                found.push(window);
            }
            if found.len() == most {
                break;
            }
        }
        found
    }

    /// The similarity that places a window of a curve of [`repeated`] points on the stroke.
    fn similarity(&self, window: &Window, points: &[Complex]) -> Option<Similarity> {
        let at = |k: usize| {
            let k = if window.is_reversed { INTERVALS - k } else { k };
            let z = points[(window.first + k * window.stride) % points.len()];
            if window.is_mirrored { z.conj() } else { z }
        };
        let own: Vec<Complex> = (0..POINTS).map(at).collect();
        let own_centre = mean(&own);
        let [us, vs] = &self.directions[0];
        let stroke = |k: usize| Complex::new(us[k].into(), vs[k].into());
        let product: Complex = (0..POINTS).map(|k| (own[k] - own_centre).conj() * stroke(k)).sum();
        let spread: f64 = own.iter().map(|z| (z - own_centre).norm_sqr()).sum();
        let factor = product / spread.max(f64::MIN_POSITIVE) * self.size;
        let shift = self.centre - factor * own_centre;
        (factor.norm_sqr() > 0.0).then_some(Similarity { is_mirrored: window.is_mirrored, factor, shift })
    }
}

/// That of a window and its mirror image that is more like the stroke.
pub(crate) fn likelier([window, mirrored]: [Window; 2]) -> Window {
    if mirrored.residual < window.residual { mirrored } else { window }
}

/// Points of a closed curve at equal distances, their coordinates repeated once, and its length.
fn repeated(curve: &[Complex], count: usize) -> (Vec<Complex>, [Vec<f32>; 2], f32) {
    let points = resampled(curve, count);
    let twice = |coordinate: fn(&Complex) -> f64| -> Vec<f32> {
        points.iter().chain(&points).map(|z| coordinate(z) as f32).collect()
    };
    let coordinates = [twice(|z| z.re), twice(|z| z.im)];
    let whole = closed_length(&points) as f32;
    (points, coordinates, whole)
}

/// Points at equal distances along an open polyline, with both ends.
pub(crate) fn spaced_evenly<const COUNT: usize>(points: &[Complex]) -> [Complex; COUNT] {
    let lengths: Vec<f64> = points.windows(2).map(|pair| length(pair[1] - pair[0])).collect();
    let step = lengths.iter().sum::<f64>() / (COUNT - 1) as f64;
    let (mut segment, mut before) = (0, 0.0);
    std::array::from_fn(|k| {
        let at = step * k as f64;
        while segment + 1 < lengths.len() && before + lengths[segment] < at {
            before += lengths[segment];
            segment += 1;
        }
        let part = if lengths[segment] > 0.0 { ((at - before) / lengths[segment]).min(1.0) } else { 0.0 };
        points[segment] + (points[segment + 1] - points[segment]) * part
    })
}

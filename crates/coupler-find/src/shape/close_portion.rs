//! Portions of a given curve that are like an open path and begin and end anywhere on the curve.

use crate::complex::{Complex, dot, mean};
use crate::curve_fit_options::CurveFitOptions;
use crate::shape::spectrum::without_noise;
use crate::shape::stroke::{Stroke, Window, spaced_evenly};
use nalgebra::{Matrix2, Vector2};

/// The points of the path and of a portion, at equal distances.
const POINTS: usize = 33;

/// A path, described by points at equal distances along it.
#[derive(Clone, Debug)]
pub(crate) struct CloseStroke {
    /// Forward and backward: with centroid 0 and a sum of squares of 1.
    directions: [[Complex; POINTS]; 2],
    /// The centroid of the points, and the root of the sum of the squares of their distances from it.
    centre: Complex,
    size: f64,
}

/// A portion of a curve that is like a path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portion {
    /// The part of the path's sum of squares that remains where the portion is placed best.
    pub residual: f64,
    /// Whether the curve is mirrored in the x-axis before it is placed, and whether the path follows it backward.
    pub is_mirrored: bool,
    pub is_reversed: bool,
    /// Where it begins and ends, in parts of the curve; the second is greater, and may be in the second round.
    pub ends: [f64; 2],
    /// The similarity that places the curve, after its reflection, on the path.
    pub factor: Complex,
    pub shift: Complex,
}

/// The windows of a curve near which portions are looked for.
const WINDOWS: usize = 12;

/// The steps towards the path near all windows, and those of the likeliest portions.
const FIRST_STEPS: usize = 3;
const LAST_STEPS: usize = 12;

/// The portions of a curve that are most like a path, the likeliest first. The curve is given by points at equal distances; one that is open is
/// passed there and back.
pub(crate) fn portions(
    (stroke, close_stroke): (&Stroke, &CloseStroke),
    (curve, is_open): (&[Complex], bool),
    options: &CurveFitOptions,
    most: usize,
) -> Vec<Portion> {
    // An open curve is half as long as the closed one. Its way back is its way there in the opposite direction.
    let least = options.least_portion * if is_open { 0.5 } else { 1.0 };
    let is_new = |window: &Window| match window.ends() {
        [_, to] if to <= 0.5 => true,
        [from, to] if 0.5 <= from && to <= 1.0 => false,
        _ => !window.is_reversed,
    };
    let may_begin = |window: &Window| (options.may_be_mirrored || !window.is_mirrored) && (!is_open || is_new(window));
    let windows = stroke.windows(curve, (least, WINDOWS), may_begin);
    let near = |window: &Window| {
        // The distances of a window's points are whole, so that it may be a little shorter than the least portion.
        let [from, to] = window.ends();
        let ends = [from, to.max(from + least)];
        let portion = close_stroke.placed(curve, (window.is_mirrored, window.is_reversed), ends);
        close_stroke.nearest(curve, portion, (FIRST_STEPS, least))
    };
    let mut portions: Vec<Portion> = windows.iter().map(near).collect();
    portions.sort_by(|a, b| a.residual.total_cmp(&b.residual));
    portions.truncate(most);
    portions.iter_mut().for_each(|portion| *portion = close_stroke.nearest(curve, *portion, (LAST_STEPS, least)));
    portions.sort_by(|a, b| a.residual.total_cmp(&b.residual));
    portions
}

impl CloseStroke {
    /// The description of an open polyline.
    pub fn new(points: &[Complex]) -> CloseStroke {
        let points: [Complex; POINTS] = spaced_evenly(&without_noise(points));
        let centre = mean(&points);
        let size = points.iter().map(|z| (z - centre).norm_sqr()).sum::<f64>().sqrt();
        let forward = points.map(|z| (z - centre) / size.max(f64::MIN_POSITIVE));
        let mut backward = forward;
        backward.reverse();
        CloseStroke { directions: [forward, backward], centre, size }
    }

    /// The portion of a closed curve near another one that is most like the path, and at least a part of the curve, after some steps of
    /// Levenberg and Marquardt's method.
    fn nearest(&self, curve: &[Complex], portion: Portion, (steps, least): (usize, f64)) -> Portion {
        /// Relative to the sum of squares, a gain that is no progress.
        const NO_GAIN: f64 = 1e-3;
        let mut best = portion;
        let mut damping = 1e-3;
        let mut equations = self.normal_equations(curve, &best);
        for _ in 0..steps {
            let (normal, gradient) = equations;
            let damped = normal + Matrix2::from_diagonal(&(normal.diagonal() * damping));
            let Some(by) = damped.cholesky().map(|matrix| matrix.solve(&gradient)) else { break };
            let ends = [best.ends[0] + by[0], best.ends[1] + by[1]];
            let is_possible = (least.max(f64::EPSILON)..=1.0).contains(&(ends[1] - ends[0]));
            let other = is_possible.then(|| self.placed(curve, (best.is_mirrored, best.is_reversed), ends));
            if let Some(other) = other.filter(|other| other.residual < best.residual) {
                let gain = best.residual - other.residual;
                best = other;
                if gain <= NO_GAIN * best.residual {
                    break;
                }
                damping *= 0.1;
                equations = self.normal_equations(curve, &best);
            } else {
                damping = (10.0 * damping).max(1e-2);
            }
        }
        let round = best.ends[0].floor();
        Portion { ends: best.ends.map(|end| end - round), ..best }
    }

    /// The normal equations of the distances of a portion, placed best, from the path, for its ends: the similarity follows them (variable
    /// projection after Golub and Pereyra, with the Jacobian of Kaufman).
    fn normal_equations(&self, curve: &[Complex], portion: &Portion) -> (Matrix2<f64>, Vector2<f64>) {
        let path = &self.directions[usize::from(portion.is_reversed)];
        let places = self.places(curve, portion.ends);
        let seen = |z: Complex| if portion.is_mirrored { z.conj() } else { z };
        let points = places.map(|(point, _)| seen(point));
        let centre = mean(&points);
        let points = points.map(|z| z - centre);
        let spread = points.iter().map(|z| z.norm_sqr()).sum::<f64>().max(f64::MIN_POSITIVE);
        let factor = portion.factor / self.size;
        let across = |vectors: [Complex; POINTS]| {
            let centre = mean(&vectors);
            let along: Complex =
                points.iter().zip(&vectors).map(|(z, vector)| z.conj() * vector).sum::<Complex>() / spread;
            let mut vectors = vectors;
            vectors.iter_mut().zip(&points).for_each(|(vector, z)| *vector -= centre + along * z);
            vectors
        };
        let moved = |weight: &dyn Fn(f64) -> f64| {
            across(std::array::from_fn(|k| factor * seen(places[k].1) * weight(k as f64 / (POINTS - 1) as f64)))
        };
        let by_ends = [moved(&|part| 1.0 - part), moved(&|part| part)];
        let product = |a: &[Complex], b: &[Complex]| a.iter().zip(b).map(|(a, b)| dot(*a, *b)).sum::<f64>();
        let off: [Complex; POINTS] = std::array::from_fn(|k| path[k] - factor * points[k]);
        let [a, b] = &by_ends;
        let mixed = product(a, b);
        (Matrix2::new(product(a, a), mixed, mixed, product(b, b)), Vector2::new(product(a, &off), product(b, &off)))
    }

    /// The points of a portion at equal distances, and their derivatives by the part of the curve.
    fn places(&self, curve: &[Complex], [from, to]: [f64; 2]) -> [(Complex, Complex); POINTS] {
        let count = curve.len() as f64;
        std::array::from_fn(|k| {
            let at = (from + (to - from) * k as f64 / (POINTS - 1) as f64).rem_euclid(1.0) * count;
            let (n, part) = (at as usize % curve.len(), at.fract());
            let chord = curve[if n + 1 < curve.len() { n + 1 } else { 0 }] - curve[n];
            (curve[n] + chord * part, chord * count)
        })
    }

    /// A portion between two ends, placed best.
    fn placed(&self, curve: &[Complex], way: (bool, bool), ends: [f64; 2]) -> Portion {
        let (is_mirrored, is_reversed) = way;
        let path = &self.directions[usize::from(is_reversed)];
        let mut sum = Complex::new(0.0, 0.0);
        let (mut product, mut squares) = (sum, 0.0);
        for ((z, _), at_path) in self.places(curve, ends).into_iter().zip(path) {
            let z = if is_mirrored { z.conj() } else { z };
            sum += z;
            squares += z.norm_sqr();
            product += z.conj() * at_path;
        }
        let centre = sum / POINTS as f64;
        let spread = (squares - POINTS as f64 * centre.norm_sqr()).max(f64::MIN_POSITIVE);
        let factor = product / spread * self.size;
        Portion {
            residual: 1.0 - product.norm_sqr() / spread,
            is_mirrored,
            is_reversed,
            ends,
            factor,
            shift: self.centre - factor * centre,
        }
    }
}

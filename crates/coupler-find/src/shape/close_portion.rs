//! Portions of a given curve that are like an open path and begin and end anywhere on the curve.

use crate::complex::{Complex, mean};
use crate::curve_fit_options::CurveFitOptions;
use crate::descent::{Candidate, Descent, Equations};
use crate::shape::spectrum::without_noise;
use crate::shape::stroke::{Stroke, Window, spaced_evenly};
use coupler_curves::geometry::Similarity;
use nalgebra::{Const, Vector2};

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
    /// Whether the path follows it backward.
    pub is_reversed: bool,
    /// Where it begins and ends, in parts of the curve; the second is greater, and may be in the second round.
    pub ends: [f64; 2],
    /// The similarity that places the curve on the path.
    pub placed: Similarity,
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

    /// The portion of a closed curve near another one that is most like the path, and at least a part of the curve, after some steps.
    fn nearest(&self, curve: &[Complex], mut portion: Portion, (steps, least): (usize, f64)) -> Portion {
        let mut descent = Descent::default();
        (0..steps).for_each(|_| descent.step(&mut portion, &Aim { stroke: self, curve, least }));
        let round = portion.ends[0].floor();
        Portion { ends: portion.ends.map(|end| end - round), ..portion }
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
        let identity = Similarity { is_mirrored, ..Similarity::IDENTITY };
        let path = &self.directions[usize::from(is_reversed)];
        let mut sum = Complex::new(0.0, 0.0);
        let (mut product, mut squares) = (sum, 0.0);
        for ((z, _), at_path) in self.places(curve, ends).into_iter().zip(path) {
            let z = identity.reflected(z);
            sum += z;
            squares += z.norm_sqr();
            product += z.conj() * at_path;
        }
        let centre = sum / POINTS as f64;
        let spread = (squares - POINTS as f64 * centre.norm_sqr()).max(f64::MIN_POSITIVE);
        let factor = product / spread * self.size;
        Portion {
            residual: 1.0 - product.norm_sqr() / spread,
            is_reversed,
            ends,
            placed: Similarity { is_mirrored, factor, shift: self.centre - factor * centre },
        }
    }
}

/// The path that a portion is to be like, the curve, and the least portion of it.
pub(crate) struct Aim<'a> {
    stroke: &'a CloseStroke,
    curve: &'a [Complex],
    least: f64,
}

impl Candidate for Portion {
    type Unknowns = Const<2>;
    type Aim<'a> = Aim<'a>;
    const NO_GAIN: f64 = 1e-3;

    fn objective(&self) -> f64 {
        self.residual
    }

    /// Those of the distances of the portion, placed best, from the path, for its ends: the similarity follows them (variable projection after
    /// Golub and Pereyra, with the Jacobian of Kaufman).
    fn equations(&self, &Aim { stroke, curve, .. }: &Aim<'_>) -> Option<Equations<Const<2>>> {
        let path = &stroke.directions[usize::from(self.is_reversed)];
        let places = stroke.places(curve, self.ends);
        let points = places.map(|(point, _)| self.placed.reflected(point));
        let centre = mean(&points);
        let points = points.map(|z| z - centre);
        let spread = points.iter().map(|z| z.norm_sqr()).sum::<f64>().max(f64::MIN_POSITIVE);
        let factor = self.placed.factor / stroke.size;
        let across = |vectors: [Complex; POINTS]| {
            let centre = mean(&vectors);
            let along: Complex =
                points.iter().zip(&vectors).map(|(z, vector)| z.conj() * vector).sum::<Complex>() / spread;
            let mut vectors = vectors;
            vectors.iter_mut().zip(&points).for_each(|(vector, z)| *vector -= centre + along * z);
            vectors
        };
        let moved = |weight: &dyn Fn(f64) -> f64| {
            across(std::array::from_fn(|k| {
                factor * self.placed.reflected(places[k].1) * weight(k as f64 / (POINTS - 1) as f64)
            }))
        };
        let by_ends = [moved(&|part| 1.0 - part), moved(&|part| part)];
        let mut equations = Equations::new(Const::<2>);
        for k in 0..POINTS {
            let off = path[k] - factor * points[k];
            for axis in [|z: Complex| z.re, |z: Complex| z.im] {
                equations.add(&by_ends.map(|moved| axis(moved[k])), axis(off), 1.0);
            }
        }
        Some(equations)
    }

    fn moved(&self, &Aim { stroke, curve, least }: &Aim<'_>, by: &Vector2<f64>) -> Option<Portion> {
        let ends = [self.ends[0] + by[0], self.ends[1] + by[1]];
        let is_possible = (least.max(f64::EPSILON)..=1.0).contains(&(ends[1] - ends[0]));
        is_possible.then(|| stroke.placed(curve, (self.placed.is_mirrored, self.is_reversed), ends))
    }
}

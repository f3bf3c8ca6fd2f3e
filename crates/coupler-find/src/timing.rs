//! Where a row of points at equal steps of the input is nearest to a timed target.

use crate::complex::{Complex, mean};
use coupler_curves::geometry::Similarity;

/// Some points of a timed target, and the input at each from that at the first, in degrees.
#[derive(Clone, Debug)]
pub(crate) struct TimedPoints {
    points: Vec<Complex>,
    angles_deg: Vec<f64>,
    /// The least and the greatest angle of all points.
    range: [f64; 2],
}

/// Points of a curve at equal steps of the input; those where the linkage cannot be assembled are not numbers.
pub(crate) struct TimedRow<'a> {
    pub points: &'a [Complex],
    pub step_deg: f64,
    /// Whether the last point is followed by the first.
    pub is_whole: bool,
}

/// A place on a row.
pub(crate) struct TimedPlace {
    /// The sum of the squares of the distances of the points that count.
    pub sum: f64,
    /// The similarity that is best there.
    pub placed: Similarity,
    /// Whether the input falls where the angles of the target rise.
    pub is_reversed: bool,
    /// The index of the point of the row that is at the first of the target.
    pub first: usize,
}

impl TimedPoints {
    /// Those of a target that count, with angles from any zero.
    pub fn new(points: &[Complex], angles_deg: &[f64]) -> TimedPoints {
        const MOST: usize = 16;
        let stride = points.len().div_ceil(MOST).max(1);
        let first = angles_deg.first().copied().unwrap_or(0.0);
        let angles = || angles_deg.iter().map(|angle| angle - first);
        TimedPoints {
            points: points.iter().step_by(stride).copied().collect(),
            angles_deg: angles().step_by(stride).collect(),
            range: [angles().fold(0.0, f64::min), angles().fold(0.0, f64::max)],
        }
    }

    /// The place of a row where the sum is least, in either direction, with any similarity.
    pub fn best_place(&self, row: &TimedRow) -> Option<TimedPlace> {
        let count = row.points.len() as i64;
        let target_mean = mean(&self.points);
        let target_square: f64 = self.points.iter().map(|z| (z - target_mean).norm_sqr()).sum();
        let [low, high] = self.range;
        let mut best: Option<TimedPlace> = None;
        for is_reversed in [false, true] {
            let sign = if is_reversed { -1.0 } else { 1.0 };
            let shifts: Vec<i64> =
                self.angles_deg.iter().map(|angle| (sign * angle / row.step_deg).round() as i64).collect();
            let needed = if is_reversed { [-high, -low] } else { [low, high] };
            let [before, after] = needed.map(|angle| angle / row.step_deg);
            for first in 0..count {
                let is_within = first as f64 + before >= 0.0 && first as f64 + after <= (count - 1) as f64;
                if !row.is_whole && !is_within {
                    continue;
                }
                let place = |shift: &i64| match row.is_whole {
                    true => (first + shift).rem_euclid(count),
                    false => (first + shift).clamp(0, count - 1),
                };
                let curve: Vec<Complex> = shifts.iter().map(|shift| row.points[place(shift) as usize]).collect();
                let curve_mean = mean(&curve);
                let square: f64 = curve.iter().map(|z| (z - curve_mean).norm_sqr()).sum();
                if !square.is_normal() {
                    continue;
                }
                for is_mirrored in [false, true] {
                    let reflected = |z: Complex| if is_mirrored { z.conj() } else { z };
                    let products = curve
                        .iter()
                        .zip(&self.points)
                        .map(|(z, w)| reflected(z - curve_mean).conj() * (w - target_mean));
                    let product: Complex = products.sum();
                    let sum = target_square - product.norm_sqr() / square;
                    if best.as_ref().is_none_or(|best| sum < best.sum) && product.norm_sqr().is_normal() {
                        let factor = product / square;
                        let shift = target_mean - factor * reflected(curve_mean);
                        let placed = Similarity { is_mirrored, factor, shift };
                        best = Some(TimedPlace { sum, placed, is_reversed, first: first as usize });
                    }
                }
            }
        }
        best
    }
}

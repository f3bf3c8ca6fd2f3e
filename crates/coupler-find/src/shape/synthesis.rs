//! Portions of curves that are given by their harmonics.

use crate::complex::unit;
use crate::shape::spectrum::HARMONICS;
use crate::shape::stroke::{CURVE_POINTS, LOOSE_TOLERANCE, Stroke, TOLERANCE, Window, Windows, likelier};
use std::f64::consts::TAU;

/// Computes the points of curves from their harmonics.
pub(crate) struct Synthesis {
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
        let coordinates = self.coordinates(harmonics);
        let [xs, ys] = &coordinates;
        stroke.best_window([xs, ys], length, &Windows { step: 2, least: 0.0, tolerance: TOLERANCE })
    }

    /// The coordinates of points of a curve, repeated once.
    fn coordinates(&self, harmonics: &[[f32; 2]; 2 * HARMONICS]) -> [[f32; 2 * CURVE_POINTS]; 2] {
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
        std::array::from_fn(|axis| {
            let at = |n: usize| match n {
                HALF => opposite[axis],
                n if n < HALF => even[axis][n] + odd[axis][n],
                n => even[axis][CURVE_POINTS - n] - odd[axis][CURVE_POINTS - n],
            };
            std::array::from_fn(|n| at(n % CURVE_POINTS))
        })
    }

    /// The part of a stroke's sum of squares that remains for the portion of a curve that is most like it: between the windows of
    /// [`Synthesis::best_window`], which are eighths of the curve and more. It is found as far as it may be below `most`.
    pub fn least_residual(
        &self,
        harmonics: &[[f32; 2]; 2 * HARMONICS],
        length: f32,
        (stroke, least): (&Stroke, f64),
        most: f32,
    ) -> Option<f32> {
        let coordinates = self.coordinates(harmonics);
        let [xs, ys] = &coordinates;
        // The best window of each quarter, in both directions.
        let mut best: [Option<Window>; 8] = [None; 8];
        stroke.for_each_window([xs, ys], length, &Windows { step: 2, least, tolerance: LOOSE_TOLERANCE }, |both| {
            let window = likelier(both);
            let place = &mut best[2 * (4 * window.first / CURVE_POINTS) + usize::from(window.is_reversed)];
            if place.is_none_or(|best| window.residual < best.residual) {
                *place = Some(window);
            }
        });
        let least_residual = best.iter().flatten().map(|window| window.residual).fold(f32::INFINITY, f32::min);
        let is_near = |window: &&Window| window.residual <= 4.0 * least_residual + 0.01;
        let near = best.iter().flatten().filter(is_near);
        near.map(|window| stroke.least_residual_near(&coordinates, window, (least as f32, most))).reduce(f32::min)
    }
}

//! Where a curve is nearest to a timed target at the inputs of its points.

use super::aim::Aim;
use super::circuit::Traced;
use crate::complex::{Complex, mean};
use coupler_curves::geometry::Similarity;

/// A curve at the inputs of a target.
pub(super) struct Timed {
    /// The sum of the squares of the distances of some of the points.
    pub sum: f64,
    pub placed: Similarity,
    /// Whether the input falls where the angles of the target rise.
    pub is_reversed: bool,
    /// The pass, and the input at the first point.
    pub start: (usize, f64),
}

/// The place on one pass, of those at multiples of a step of the input, where the similarity that is best for it is best.
pub(super) fn best(aim: &Aim, traced: &Traced) -> Option<Timed> {
    /// The steps of a turn, or of the range of a pass, and the points of the target that count.
    const STEPS: usize = 96;
    const POINTS: usize = 16;
    let angles = aim.angles_deg.as_ref()?;
    let points = aim.points_of(false);
    let stride = points.len().div_ceil(POINTS);
    let chosen: Vec<usize> = (0..points.len()).step_by(stride).collect();
    let target: Vec<Complex> = chosen.iter().map(|k| points[*k]).collect();
    let target_mean = mean(&target);
    let target_square: f64 = target.iter().map(|z| (z - target_mean).norm_sqr()).sum();
    let [low, high] = [angles.iter().copied().fold(0.0, f64::min), angles.iter().copied().fold(0.0, f64::max)];
    let mut best: Option<Timed> = None;
    for (number, pass) in traced.circuit.passes.iter().enumerate() {
        let is_whole = traced.is_regular() && traced.is_full_turn();
        let range = pass.input_range();
        let step = if is_whole { 360.0 / STEPS as f64 } else { (range[1] - range[0]) / STEPS as f64 };
        let count = if is_whole { (pass.input_length() / step).round() as usize } else { STEPS + 1 };
        let inputs: Vec<f64> = (0..count).map(|k| range[0] + step * k as f64).collect();
        let inputs: Vec<f64> = inputs.into_iter().map(|input| input.min(range[1])).collect();
        let places = traced.places_at_inputs(number, &inputs);
        let Some(samples) = places.and_then(|places| traced.points_at(&places)) else { continue };
        for is_reversed in [false, true] {
            let sign = if is_reversed { -1.0 } else { 1.0 };
            let shifts: Vec<i64> = chosen.iter().map(|k| (sign * angles[*k] / step).round() as i64).collect();
            let needed = if is_reversed { [-high, -low] } else { [low, high] };
            for (first, &input) in inputs.iter().enumerate() {
                if !is_whole && (input + needed[0] < range[0] || input + needed[1] > range[1]) {
                    continue;
                }
                let at = |shift: &i64| {
                    let place = first as i64 + shift;
                    let place =
                        if is_whole { place.rem_euclid(count as i64) } else { place.clamp(0, count as i64 - 1) };
                    samples[place as usize]
                };
                let curve: Vec<Complex> = shifts.iter().map(at).collect();
                let curve_mean = mean(&curve);
                let square: f64 = curve.iter().map(|z| (z - curve_mean).norm_sqr()).sum();
                if !square.is_normal() {
                    continue;
                }
                for is_mirrored in [false, true] {
                    let reflected = |z: Complex| if is_mirrored { z.conj() } else { z };
                    let product: Complex = curve
                        .iter()
                        .zip(&target)
                        .map(|(z, w)| reflected(z - curve_mean).conj() * (w - target_mean))
                        .sum();
                    let sum = target_square - product.norm_sqr() / square;
                    if best.as_ref().is_none_or(|best| sum < best.sum) && product.norm_sqr().is_normal() {
                        let factor = product / square;
                        let shift = target_mean - factor * reflected(curve_mean);
                        let placed = Similarity { is_mirrored, factor, shift };
                        best = Some(Timed { sum, placed, is_reversed, start: (number, input) });
                    }
                }
            }
        }
    }
    best
}

//! Real zeros of periodic functions.

use crate::geometry::trig;
use crate::numerical::{Bracket, maximum};

/// The zeros of a function of period 2 pi that has few of them, including those where it touches zero.
pub(super) fn periodic_zeros(f: impl Fn(f64) -> f64) -> Vec<f64> {
    const STEPS: usize = 720;
    // The offset avoids round angles, at which the function may have a pole.
    let at = |k: usize| trig::radians(0.5 * (k as f64 - 360.0) + 0.123_456_789);
    let values: Vec<f64> = (0..=STEPS).map(|k| f(at(k))).collect();
    let size = values.iter().copied().filter(|v| v.is_finite()).fold(0.0, |a: f64, v| a.max(v.abs()));
    let mut found = Vec::new();
    for k in 0..STEPS {
        if let Some(bracket) = Bracket::new([at(k), at(k + 1)], [values[k], values[k + 1]]) {
            found.push(bracket.zero(0.0, &f));
        } else if k > 0 && values[k].abs() <= values[k - 1].abs() && values[k].abs() < values[k + 1].abs() {
            // The function may touch zero here.
            let nearest = maximum([at(k - 1), at(k + 1)], 0.0, |t| -f(t).abs());
            if -nearest.value <= 1e-12 * size {
                found.push(nearest.place);
            }
        }
    }
    found
}

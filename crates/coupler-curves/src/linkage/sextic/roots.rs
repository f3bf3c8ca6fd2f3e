//! Real zeros of polynomials and of periodic functions.

use crate::geometry::trig;
use crate::numerical::{Bracket, maximum};

/// The real roots of a polynomial, given by ascending powers, in ascending order. There is at most one between two
/// roots of the derivative; a root of even order is a root of both.
pub(super) fn real_roots(coefficients: &[f64]) -> Vec<f64> {
    let size = coefficients.iter().fold(0.0, |a: f64, c| a.max(c.abs()));
    let degree = coefficients.iter().rposition(|c| c.abs() > 1e-14 * size).unwrap_or(0);
    let coefficients = &coefficients[..=degree];
    let value = |t: f64| coefficients.iter().rev().fold([0.0; 2], |[v, s], c| [v * t + c, s * t.abs() + c.abs()]);
    if degree == 0 {
        return Vec::new();
    }
    let lead = coefficients[degree];
    // Cauchy's bound on the roots.
    let bound = 1.0 + coefficients[..degree].iter().fold(0.0, |a: f64, c| a.max((c / lead).abs()));
    let derivative: Vec<f64> = (1..=degree).map(|n| n as f64 * coefficients[n]).collect();
    let extrema = real_roots(&derivative);
    let mut breaks = vec![-bound];
    breaks.extend(extrema.iter().copied().filter(|t| t.abs() < bound));
    breaks.push(bound);
    let mut roots: Vec<f64> = Vec::new();
    for pair in breaks.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let ([fa, sa], [fb, _]) = (value(a), value(b));
        // At an extremum a value within its rounding error is a root of even order.
        if extrema.contains(&a) && fa.abs() <= 1e-13 * sa {
            roots.push(a);
        } else if let Some(bracket) = Bracket::new([a, b], [fa, fb]) {
            roots.push(bracket.zero(0.0, |t| value(t)[0]));
        }
    }
    roots.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * bound);
    roots
}

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

//! Short parts of a curve as polynomials of degree 5, whose points are found in a fraction of the time.

use crate::geometry::{Chebyshev, Point, TERMS, Vector};

/// The polynomial of degree 5 with the position, velocity and acceleration of a curve at two places: its coefficients in the
/// share of the way from one to the other.
pub(super) struct Quintic([Vector; 6]);

impl Quintic {
    /// The polynomial from one place to another, each with the position and the derivatives with respect to a parameter, which
    /// grows by `step`.
    pub fn between([start, end]: [(Point, [Vector; 2]); 2], step: f64) -> Quintic {
        let [(p, [v, a]), (q, [w, b])] =
            [start, end].map(|(at, [velocity, acceleration])| (at, [velocity * step, acceleration * (step * step)]));
        let way = q - p;
        Quintic([
            p.coords,
            v,
            a * 0.5,
            way * 10.0 - v * 6.0 - w * 4.0 - a * 1.5 + b * 0.5,
            way * -15.0 + v * 8.0 + w * 7.0 + a * 1.5 - b,
            way * 6.0 - (v + w) * 3.0 + (b - a) * 0.5,
        ])
    }

    /// The position at a share of the way.
    pub fn point(&self, share: f64) -> Point {
        Point::from(self.0.iter().rev().fold(Vector::zeros(), |sum, term| sum * share + term))
    }
}

/// How far at most a curve that is a series is from its quintic between two places, for a step of 1 between these; it grows with
/// the sixth power of the step.
pub(super) fn quintic_error(position: &[Chebyshev; 2]) -> f64 {
    /// Of the product of the distances from the two places, each to the third power, over the factorial of 6.
    const GREATEST: f64 = 1.0 / (64.0 * 720.0);
    /// The greatest sixth derivatives of the Chebyshev polynomials, which they have at 1.
    const SIXTH_DERIVATIVES: [f64; TERMS] = {
        let mut out = [1.0; TERMS];
        let mut k = 0;
        while k < TERMS {
            let mut j = 0;
            while j < 6 {
                out[k] *= (k * k) as f64 - (j * j) as f64;
                out[k] /= (2 * j + 1) as f64;
                j += 1;
            }
            k += 1;
        }
        out
    };
    let bound =
        |series: &Chebyshev| series.0.iter().zip(SIXTH_DERIVATIVES).map(|(c, most)| c.abs() * most).sum::<f64>();
    GREATEST * (bound(&position[0]) + bound(&position[1]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::curve::Arc;

    #[test]
    fn a_curve_is_near_its_quintics() {
        let terms = |frequency: f64| {
            let values = Chebyshev::nodes().map(|u| crate::geometry::trig::cos(frequency * u + 0.3));
            Chebyshev::from_values(&values)
        };
        let arc = Arc::new([terms(0.8), terms(1.7)]);
        let error = quintic_error(&arc.position);
        for (from, step) in [(-1.0, 0.1), (-0.3, 0.4), (0.2, 0.8), (-1.0, 2.0)] {
            let quintic = Quintic::between([from, from + step].map(|u| arc.point_and_rates(u)), step);
            let distance = |k: i32| {
                let share = f64::from(k) / 50.0;
                (quintic.point(share) - arc.point(from + share * step)).norm()
            };
            let greatest = (0..=50).map(distance).fold(0.0, f64::max);
            let sixth = step * step * step * step * step * step;
            assert!(greatest <= error * sixth + 1e-15, "{greatest} {}", error * sixth);
            assert!(greatest >= 1e-3 * error * sixth - 1e-15, "{greatest} {}", error * sixth);
        }
    }
}

//! The motions of an axis that bring the mirror image of a curve closer to it.

use super::features::SymmetryAxis;
use crate::geometry::{Point, Vector, cross};

/// The rates at which the distance of a mirror image from a curve falls as the axis shifts and turns.
fn rates(axis: SymmetryAxis, image: Point, normal: Vector) -> Vector {
    let across = Vector::new(-axis.direction.y, axis.direction.x);
    -Vector::new(2.0 * normal.dot(&across), 2.0 * cross(image - axis.point, normal))
}

/// The shift and the rotation of an axis by which the sum of the squares of some distances of mirror images from a curve
/// becomes least, to the first order.
pub(super) fn least_squares_motion(axis: SymmetryAxis, distances: &[(Point, f64, Vector)]) -> Option<(f64, f64)> {
    let (mut a, mut b, mut c, mut u, mut v) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (image, distance, normal) in distances {
        let rate = rates(axis, *image, *normal);
        a += rate.x * rate.x;
        b += rate.x * rate.y;
        c += rate.y * rate.y;
        u += rate.x * distance;
        v += rate.y * distance;
    }
    let det = a * c - b * b;
    (det > 1e-12 * a * c).then(|| ((c * u - b * v) / det, (a * v - b * u) / det))
}

/// The shift and the rotation of an axis by which the greatest of some distances of mirror images from a curve becomes
/// least, to the first order.
///
/// # Source
/// Stiefel's exchange (1959): the least greatest residual of linear equations in two unknowns is that of three of them,
/// whose residual is the greatest of all threes.
pub(super) fn minimax_motion(axis: SymmetryAxis, distances: &[(Point, f64, Vector)]) -> Option<(f64, f64)> {
    const ROUNDS: usize = 40;
    let row = |(image, distance, normal): &(Point, f64, Vector)| (rates(axis, *image, *normal), *distance);
    let rows: Vec<(Vector, f64)> = distances.iter().map(row).collect();
    if rows.len() < 3 {
        return None;
    }
    // The least residual of three equations, and the unknowns.
    let level = |three: [usize; 3]| {
        let [(g0, d0), (g1, d1), (g2, d2)] = three.map(|k| rows[k]);
        // The rates of the three are linearly dependent with these factors.
        let factors = [cross(g1, g2), cross(g2, g0), cross(g0, g1)];
        let sum: f64 = factors.iter().map(|factor| factor.abs()).sum();
        let residual = (factors[0] * d0 + factors[1] * d1 + factors[2] * d2) / sum;
        let [e0, e1, e2] = factors.map(|factor| residual.copysign(residual * factor));
        // The two equations whose rates are least parallel.
        let [(g, d, e), (h, f, k)] = match () {
            () if factors[2].abs() >= factors[0].abs().max(factors[1].abs()) => [(g0, d0, e0), (g1, d1, e1)],
            () if factors[0].abs() >= factors[1].abs() => [(g1, d1, e1), (g2, d2, e2)],
            () => [(g2, d2, e2), (g0, d0, e0)],
        };
        let area = cross(g, h);
        let (d, f) = (d - e, f - k);
        let motion = Vector::new(d * h.y - f * g.y, f * g.x - d * h.x) / area;
        (residual.abs(), motion)
    };
    let mut three = [0, rows.len() / 3, 2 * rows.len() / 3];
    let mut best = level(three);
    for _ in 0..ROUNDS {
        let (residual, motion) = best;
        let rest = |k: usize| (rows[k].1 - rows[k].0.dot(&motion)).abs();
        let worst = (0..rows.len()).max_by(|&a, &b| rest(a).total_cmp(&rest(b)))?;
        if rest(worst) <= residual * (1.0 + 1e-9) {
            break;
        }
        let exchanged = (0..3).map(|k| {
            let mut other = three;
            other[k] = worst;
            (level(other), other)
        });
        let (next, other) = exchanged.max_by(|a, b| a.0.0.total_cmp(&b.0.0))?;
        if next.0.is_nan() || next.0 <= residual {
            break;
        }
        (best, three) = (next, other);
    }
    let motion = best.1;
    (motion.x.is_finite() && motion.y.is_finite()).then_some((motion.x, motion.y))
}

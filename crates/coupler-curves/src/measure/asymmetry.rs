//! A lower bound of the distance of a curve from its mirror image about any line.
//!
//! The support function of a curve, `h(t)`, is how far it reaches in the direction t. Where no point of the mirror image is further
//! than r from the curve, nor so any point of the curve from the mirror image, which is the same, their support functions differ by at
//! most r in every direction, and so does the root of the mean of the squares. That of the image about a line in the direction a is
//! `h(2a - t)`, and a term of the first order that depends on where the line is. So, with `c_k = m_k e^(i p_k)` the Fourier
//! coefficients of h, for any line `r^2 >= 8 sum m_k^2 sin^2(k a + p_k)` over any k of 2 and more (Parseval).

use std::f64::consts::PI;
use std::sync::LazyLock;

use super::portion::min_max;
use crate::geometry::{Point, Vector, complex_product, cross, trig};

/// The directions in which the support function is taken.
const COUNT: usize = 128;

/// The orders of the coefficients, from 2 on.
const ORDERS: usize = 7;

/// The error of a coefficient, relative to the extent. By `h + h''`, the radius of curvature of the hull, which is never negative and
/// has the hull's perimeter, at most pi times the extent, as its integral, coefficient n is at most `1 / (2 (n^2 - 1))`; of 128
/// samples the coefficients up to 8 err by those of the orders 120, 136, 248, 264 and so on.
const ALIASED: f64 = 1e-4;

/// The directions, evenly spaced.
static DIRECTIONS: LazyLock<[Vector; COUNT]> = LazyLock::new(|| {
    std::array::from_fn(|k| {
        let (cos, sin) = trig::cos_sin_deg(360.0 * k as f64 / COUNT as f64);
        Vector::new(cos, sin)
    })
});

/// Whether the mirror image of a curve of a given extent is further from it than a distance, about any line: by points of it, no further apart
/// than a `gap`. If that is not known, it may be further all the same.
pub(super) fn is_asymmetrical(points: &[Point], gap: f64, extent: f64, distance: f64) -> bool {
    let coefficients = support_coefficients(points);
    // Between two points of the row the curve reaches further by at most half of what is between them; and how far it and its mirror
    // image are known to reach differs by at most as much.
    let errors = gap / 2.0 + 2.0 * ALIASED * extent * (2.0 * ORDERS as f64).sqrt();
    let limit = distance + errors;
    let squares = |weight: fn(f64) -> f64| -> f64 {
        (2u32..).zip(&coefficients).map(|(k, c)| weight(f64::from(k)) * 8.0 * c.norm_squared()).sum()
    };
    // How fast the bound changes with the direction of the line, at most.
    let rate = squares(|k| k * k).sqrt();
    if squares(|_| 1.0).sqrt() <= limit {
        return false;
    }
    let bound = |direction: f64| {
        let turn = Vector::new(trig::cos(direction), trig::sin(direction));
        let mut power = turn;
        let square = coefficients.iter().map(|c| {
            power = complex_product(power, turn);
            let sine = cross(Vector::new(power.x, -power.y), *c);
            8.0 * sine * sine
        });
        square.sum::<f64>().sqrt()
    };
    /// The parts of half a turn, which are halved where the bound is not known to exceed the limit all over them.
    const PARTS: usize = 16;
    /// The narrowest, relative to these.
    const NARROWEST: f64 = 1.0 / 1024.0;
    let half = PI / (2 * PARTS) as f64;
    let mut parts: Vec<(f64, f64)> = (0..PARTS).map(|k| ((2 * k + 1) as f64 * half, half)).collect();
    let least = NARROWEST * half;
    while let Some((middle, half)) = parts.pop() {
        let at_middle = bound(middle);
        if at_middle <= limit || half < least {
            return false;
        }
        if at_middle - rate * half <= limit {
            parts.extend([-0.5, 0.5].map(|part| (middle + part * half, half / 2.0)));
        }
    }
    true
}

/// The Fourier coefficients of the support function of some points, from that of order 2 on, as complex numbers.
fn support_coefficients(points: &[Point]) -> [Vector; ORDERS] {
    let directions = &*DIRECTIONS;
    let mut out = [Vector::zeros(); ORDERS];
    for (j, direction) in directions[..COUNT / 2].iter().enumerate() {
        let [low, high] = min_max(points, |p| direction.dot(&p.coords));
        for (k, sum) in (2..).zip(&mut out) {
            let factor = directions[k * j % COUNT];
            // In the opposite direction the factors of odd orders are opposite, too.
            let support = if k % 2 == 0 { high - low } else { high + low };
            *sum += Vector::new(factor.x, -factor.y) * (support / COUNT as f64);
        }
    }
    out
}

//! Vectors of the plane as complex numbers.

pub(crate) use coupler_curves::geometry::Complex;
use coupler_curves::geometry::trig;

/// The scalar product of two vectors.
pub(crate) fn dot(a: Complex, b: Complex) -> f64 {
    a.re * b.re + a.im * b.im
}

/// The length of a vector, with the same bits on every machine, which those of `hypot` are not.
pub(crate) fn length(a: Complex) -> f64 {
    a.norm_sqr().sqrt()
}

/// A vector turned by a quarter turn to the left.
pub(crate) fn times_i(a: Complex) -> Complex {
    Complex::new(-a.im, a.re)
}

/// The vector of length 1 at an angle in radians.
pub(crate) fn unit(angle: f64) -> Complex {
    Complex::new(trig::cos(angle), trig::sin(angle))
}

/// A vector of length 1 turned by the angle whose tangent is `tan`, without a loss of length.
pub(crate) fn turned(unit: Complex, tan: f64) -> Complex {
    let turned = unit * Complex::new(1.0, tan);
    turned / length(turned)
}

/// The mean of some points.
pub(crate) fn mean(points: &[Complex]) -> Complex {
    points.iter().sum::<Complex>() / points.len().max(1) as f64
}

/// The length of the polyline through some points.
pub(crate) fn open_length(points: &[Complex]) -> f64 {
    points.windows(2).map(|pair| length(pair[1] - pair[0])).sum()
}

/// The length of the closed polyline through some points.
pub(crate) fn closed_length(points: &[Complex]) -> f64 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(a, b)| length(b - a)).sum()
}

//! Truncated Taylor series in the input, over numbers or over enclosures of numbers.
//!
//! Sums, products, quotients and roots of series are exact to their order, so that their coefficients are derivatives
//! in closed form and not differences; over [`super::enclosure::Enclosure`]s they are bounds on those derivatives.

use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::geometry::{Vector, trig};

/// The angle in degrees of a crank geared to the input.
pub(super) fn geared_angle(input_deg: f64, [turns, per]: [i64; 2], phase_deg: f64) -> f64 {
    // Whole periods are removed first: the product of the remainder and the ratio is more accurate.
    input_deg % (360.0 * per as f64) * turns as f64 / per as f64 + phase_deg
}

/// The operations on the coefficients of a series.
pub(super) trait Scalar:
    Copy
    + From<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The square.
    fn square(self) -> Self;

    /// The square root; 0 for a number that is negative by rounding.
    fn sqrt(self) -> Self;

    /// The angle in degrees of one in radians.
    fn to_degrees(self) -> Self;

    /// The cosine and the sine of an angle in degrees.
    fn cos_sin_deg(self) -> [Self; 2];

    /// The angle in degrees of a crank that turns `ratio[0]` times to `ratio[1]` turns of this angle.
    fn geared_angle(self, ratio: [i64; 2], phase_deg: f64) -> Self;
}

impl Scalar for f64 {
    fn square(self) -> f64 {
        self * self
    }

    fn sqrt(self) -> f64 {
        self.max(0.0).sqrt()
    }

    fn to_degrees(self) -> f64 {
        trig::degrees(self)
    }

    fn cos_sin_deg(self) -> [f64; 2] {
        trig::cos_sin_deg(self).into()
    }

    fn geared_angle(self, ratio: [i64; 2], phase_deg: f64) -> f64 {
        geared_angle(self, ratio, phase_deg)
    }
}

/// The coefficients of 1, t, t^2 and so on: `N` of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Series<T, const N: usize>(pub [T; N]);

impl<T: Scalar, const N: usize> Series<T, N> {
    pub fn constant(value: impl Into<T>) -> Self {
        let value = value.into();
        Series(from_fn(|n| if n == 0 { value } else { T::from(0.0) }))
    }

    /// The variable at this value.
    pub fn variable(value: T) -> Self {
        Series(from_fn(|n| if n == 0 { value } else { T::from(if n == 1 { 1.0 } else { 0.0 }) }))
    }

    /// The coefficient of `t^n` in the product.
    fn product_coefficient(self, other: Self, n: usize) -> T {
        let terms = (1..=n).map(|k| self.0[k] * other.0[n - k]);
        terms.fold(self.0[0] * other.0[n], |sum, term| sum + term)
    }

    pub fn square(self) -> Self {
        let mut product = self * self;
        product.0[0] = self.0[0].square();
        product
    }

    pub fn sqrt(self) -> Self {
        let mut root = [self.0[0].sqrt(); N];
        for n in 1..N {
            let remainder = (1..n).fold(self.0[n], |sum, k| sum - root[k] * root[n - k]);
            root[n] = remainder / (T::from(2.0) * root[0]);
        }
        Series(root)
    }

    pub fn scaled(self, factor: f64) -> Self {
        Series(self.0.map(|c| c * T::from(factor)))
    }
}

impl<T: Scalar, const N: usize> Neg for Series<T, N> {
    type Output = Self;
    fn neg(self) -> Self {
        Series(self.0.map(|c| -c))
    }
}

impl<T: Scalar, const N: usize> Add for Series<T, N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Series(from_fn(|n| self.0[n] + other.0[n]))
    }
}

impl<T: Scalar, const N: usize> Sub for Series<T, N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Series(from_fn(|n| self.0[n] - other.0[n]))
    }
}

impl<T: Scalar, const N: usize> Mul for Series<T, N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Series(from_fn(|n| self.product_coefficient(other, n)))
    }
}

impl<T: Scalar, const N: usize> Div for Series<T, N> {
    type Output = Self;
    fn div(self, divisor: Self) -> Self {
        let mut quotient = [self.0[0] / divisor.0[0]; N];
        for n in 1..N {
            let remainder = (1..=n).fold(self.0[n], |sum, k| sum - divisor.0[k] * quotient[n - k]);
            quotient[n] = remainder / divisor.0[0];
        }
        Series(quotient)
    }
}

/// A position, or a difference of positions, as a series in the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct VectorSeries<T, const N: usize> {
    pub x: Series<T, N>,
    pub y: Series<T, N>,
}

impl<T: Scalar, const N: usize> VectorSeries<T, N> {
    pub fn constant(v: Vector) -> Self {
        VectorSeries { x: Series::constant(v.x), y: Series::constant(v.y) }
    }

    /// A unit vector that rotates by `ratio` radians per radian of input.
    pub fn rotating_unit([cos, sin]: [T; 2], ratio: f64) -> Self {
        let (mut x, mut y) = ([cos; N], [sin; N]);
        for n in 1..N {
            let rate = T::from(ratio) / T::from(n as f64);
            (x[n], y[n]) = (-(rate * y[n - 1]), rate * x[n - 1]);
        }
        VectorSeries { x: Series(x), y: Series(y) }
    }

    pub fn minus(self, other: Self) -> Self {
        VectorSeries { x: self.x - other.x, y: self.y - other.y }
    }

    /// This position, moved by `along` times a vector and by `across` times its left normal.
    pub fn moved(self, v: Self, along: Series<T, N>, across: Series<T, N>) -> Self {
        VectorSeries { x: self.x + along * v.x - across * v.y, y: self.y + along * v.y + across * v.x }
    }

    pub fn dot(self, other: Self) -> Series<T, N> {
        self.x * other.x + self.y * other.y
    }

    pub fn cross(self, other: Self) -> Series<T, N> {
        self.x * other.y - self.y * other.x
    }

    /// The square of the length.
    pub fn norm_squared(self) -> Series<T, N> {
        self.x.square() + self.y.square()
    }

    /// The unit vector in this direction.
    pub fn unit(self) -> Self {
        let length = self.norm_squared().sqrt();
        VectorSeries { x: self.x / length, y: self.y / length }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_multiply_divide_and_take_roots() {
        let t = Series::<f64, 4>([2.0, 1.0, 0.0, 0.0]);
        assert_eq!((t * t * t).0, [8.0, 12.0, 6.0, 1.0]);
        assert_eq!((t.square() / t).0, t.0);
        assert_eq!(t.square().sqrt().0, t.0);
        // 1 / t = 1/2 - (t-2)/4 + (t-2)^2/8 - (t-2)^3/16
        assert_eq!((Series::constant(1.0) / t).0, [0.5, -0.25, 0.125, -0.0625]);
    }
}

//! Dual numbers: numbers that carry their exact derivative.

use std::ops::{Add, Div, Mul, Neg, Sub};

use coupler_curves::geometry::trig;

/// A number and its derivative; nested, its second derivative too, and so on.
#[derive(Clone, Copy, Debug)]
pub struct Dual<T>(pub T, pub T);

/// The arithmetic that the components of dual numbers need, and dual numbers have in turn.
pub trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    fn from_f64(x: f64) -> Self;
    fn sqrt(self) -> Self;
    fn cos_sin(self) -> [Self; 2];
}

impl Real for f64 {
    fn from_f64(x: f64) -> f64 {
        x
    }
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }
    fn cos_sin(self) -> [f64; 2] {
        [trig::cos(self), trig::sin(self)]
    }
}

impl<T: Real> Add for Dual<T> {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Dual(self.0 + o.0, self.1 + o.1)
    }
}
impl<T: Real> Sub for Dual<T> {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Dual(self.0 - o.0, self.1 - o.1)
    }
}
impl<T: Real> Neg for Dual<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Dual(-self.0, -self.1)
    }
}
impl<T: Real> Mul for Dual<T> {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Dual(self.0 * o.0, self.0 * o.1 + self.1 * o.0)
    }
}
impl<T: Real> Div for Dual<T> {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        Dual(self.0 / o.0, (self.1 * o.0 - self.0 * o.1) / (o.0 * o.0))
    }
}
impl<T: Real> Real for Dual<T> {
    fn from_f64(x: f64) -> Self {
        Dual(T::from_f64(x), T::from_f64(0.0))
    }
    fn sqrt(self) -> Self {
        let root = self.0.sqrt();
        Dual(root, self.1 / (T::from_f64(2.0) * root))
    }
    fn cos_sin(self) -> [Self; 2] {
        let [cos, sin] = self.0.cos_sin();
        [Dual(cos, -(self.1 * sin)), Dual(sin, self.1 * cos)]
    }
}

pub type Third = Dual<Dual<Dual<f64>>>;

/// The variable by which everything is differentiated, three times.
pub fn variable(x: f64) -> Third {
    Dual(Dual(Dual(x, 1.0), Dual(1.0, 0.0)), Dual(Dual(1.0, 0.0), Dual(0.0, 0.0)))
}

/// The value and the three derivatives.
pub fn orders(x: Third) -> [f64; 4] {
    [x.0.0.0, x.1.0.0, x.1.1.0, x.1.1.1]
}

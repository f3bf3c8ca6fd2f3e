//! Interval arithmetic.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::series::Scalar;
use crate::geometry::trig;

/// All numbers from `low` to `high`: bounds on the result of a computation. Each operation is rounded outwards to the
/// next floating-point number, so that the bounds hold for exact arithmetic. (The crates for interval arithmetic need
/// processors beyond the baseline, or a system library.)
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Enclosure {
    pub low: f64,
    pub high: f64,
}

/// All numbers.
const ENTIRE: Enclosure = Enclosure { low: f64::NEG_INFINITY, high: f64::INFINITY };

/// The absolute error of a computed sine or cosine: libm's are within an ulp, and angles are converted to radians.
const TRIG_ERROR: f64 = 4.0 * f64::EPSILON;

impl Enclosure {
    /// Two numbers, in any order, and all between them.
    pub fn between(a: f64, b: f64) -> Enclosure {
        Enclosure { low: a.min(b), high: a.max(b) }
    }

    /// Bounds rounded outwards; all numbers if a bound is NaN.
    fn rounded_outwards(low: f64, high: f64) -> Enclosure {
        if low.is_nan() || high.is_nan() { ENTIRE } else { Enclosure { low: low.next_down(), high: high.next_up() } }
    }

    /// The intersection of both; this enclosure where rounding has made it empty.
    pub fn intersection(self, other: Enclosure) -> Enclosure {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        if low <= high { Enclosure { low, high } } else { self }
    }

    /// The greatest magnitude of a number in it.
    pub fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// Whether it contains a number.
    pub fn contains(self, x: f64) -> bool {
        self.low <= x && x <= self.high
    }

    /// The cosines of all angles in it, in degrees.
    fn cos_deg(self) -> Enclosure {
        let [a, b] = [self.low, self.high].map(|deg| trig::cos_sin_deg(deg).0);
        let mut out = Enclosure::rounded_outwards(a.min(b) - TRIG_ERROR, a.max(b) + TRIG_ERROR);
        // Every half turn the cosine is 1 or -1.
        let (first, last) = ((self.low / 180.0).ceil(), (self.high / 180.0).floor());
        for half in [first, first + 1.0].into_iter().filter(|half| *half <= last) {
            if half.rem_euclid(2.0) == 0.0 { out.high = 1.0 } else { out.low = -1.0 }
        }
        Enclosure { low: out.low.max(-1.0), high: out.high.min(1.0) }
    }
}

impl From<f64> for Enclosure {
    fn from(x: f64) -> Enclosure {
        Enclosure { low: x, high: x }
    }
}

impl Add for Enclosure {
    type Output = Enclosure;
    fn add(self, other: Enclosure) -> Enclosure {
        Enclosure::rounded_outwards(self.low + other.low, self.high + other.high)
    }
}

impl Sub for Enclosure {
    type Output = Enclosure;
    fn sub(self, other: Enclosure) -> Enclosure {
        Enclosure::rounded_outwards(self.low - other.high, self.high - other.low)
    }
}

impl Neg for Enclosure {
    type Output = Enclosure;
    fn neg(self) -> Enclosure {
        Enclosure { low: -self.high, high: -self.low }
    }
}

impl Mul for Enclosure {
    type Output = Enclosure;
    fn mul(self, other: Enclosure) -> Enclosure {
        let products = [self.low * other.low, self.low * other.high, self.high * other.low, self.high * other.high];
        if products.iter().any(|product| product.is_nan()) {
            return ENTIRE;
        }
        let [a, b, c, d] = products;
        Enclosure::rounded_outwards(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }
}

impl Div for Enclosure {
    type Output = Enclosure;
    fn div(self, divisor: Enclosure) -> Enclosure {
        if divisor.contains(0.0) {
            return ENTIRE;
        }
        self * Enclosure::rounded_outwards(1.0 / divisor.high, 1.0 / divisor.low)
    }
}

impl Scalar for Enclosure {
    fn square(self) -> Enclosure {
        let (low, high) = (self.low * self.low, self.high * self.high);
        let least = if self.contains(0.0) { 0.0 } else { low.min(high).next_down() };
        Enclosure { low: least, ..Enclosure::rounded_outwards(least, low.max(high)) }
    }

    fn sqrt(self) -> Enclosure {
        let [low, high] = [self.low, self.high].map(|x| x.max(0.0).sqrt());
        Enclosure { low: low.next_down().max(0.0), ..Enclosure::rounded_outwards(low, high) }
    }

    fn to_degrees(self) -> Enclosure {
        let degrees = trig::degrees(1.0);
        self * Enclosure { low: degrees.next_down(), high: degrees.next_up() }
    }

    fn cos_sin_deg(self) -> [Enclosure; 2] {
        [self.cos_deg(), (self - Enclosure::from(90.0)).cos_deg()]
    }

    fn geared_angle(self, [turns, per]: [i64; 2], phase_deg: f64) -> Enclosure {
        self * Enclosure::from(turns as f64) / Enclosure::from(per as f64) + Enclosure::from(phase_deg)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn span() -> impl Strategy<Value = (Enclosure, f64)> {
        (-400.0f64..400.0, 0.0f64..100.0, 0.0f64..=1.0).prop_map(|(low, width, part)| {
            let inside = (low + part * width).clamp(low, low + width);
            (Enclosure { low, high: low + width }, inside)
        })
    }

    proptest! {
        #[test]
        fn results_are_enclosed((a, x) in span(), (b, y) in span()) {
            prop_assert!((a + b).contains(x + y) && (a - b).contains(x - y) && (a * b).contains(x * y));
            prop_assert!((a / b).contains(x / y) && a.square().contains(x * x) && (-a).contains(-x));
            prop_assert!(a.sqrt().contains(x.max(0.0).sqrt()));
            let (cos, sin) = trig::cos_sin_deg(x);
            let [c, s] = a.cos_sin_deg();
            prop_assert!(c.contains(cos) && s.contains(sin), "{a:?} {x}: {c:?} {s:?}");
        }
    }
}

//! Linkages near another one, at random.

use super::complex::length;
use super::parameters::{COUNT, Parameters};
use crate::geometry::trig;

/// A sequence of random numbers, the same on every machine (xorshift, Marsaglia 2003).
pub(super) struct Scatter(u64);

impl Scatter {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Scatter {
        // Any number but 0.
        Scatter(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    /// A number from -0.5 to 0.5.
    fn even(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }

    /// A number with a nearly normal distribution, as the sum of four even ones, and the standard deviation `spread`.
    pub fn normal(&mut self, spread: f64) -> f64 {
        let sum: f64 = std::iter::repeat_with(|| self.even()).take(4).sum();
        spread * 3f64.sqrt() * sum
    }

    /// A linkage near another one.
    pub fn near(&mut self, from: &Parameters) -> Parameters {
        /// The spread of the logarithms of lengths.
        const SPREAD: f64 = 0.3;
        let mut scaled = |length: f64| length * trig::exp(self.normal(SPREAD));
        let [frame, crank, coupler, rocker] = [from.frame, from.crank, from.coupler, from.rocker].map(&mut scaled);
        let mut by = [0.0; COUNT];
        by[0] = 0.3 * self.normal(SPREAD);
        by[1] = 0.3 * self.normal(SPREAD);
        by[2] = 0.5 * self.normal(SPREAD);
        by[7] = length(from.point) * self.normal(SPREAD);
        by[8] = length(from.point) * self.normal(SPREAD);
        Parameters { frame, crank, coupler, rocker, ..from.moved(&by) }
    }
}

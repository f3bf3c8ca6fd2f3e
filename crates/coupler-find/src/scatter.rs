//! Random numbers.

/// A sequence of random numbers, the same on every machine (xorshift, Marsaglia 2003).
#[derive(Clone, Debug)]
pub(crate) struct Scatter(u64);

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
}

//! The polynomial through five neighbouring samples of a curve.

use crate::geometry::Vector;

/// x, y and the input.
pub(super) type PointAndInput = nalgebra::Vector3<f64>;

/// The curve around a sample: polynomials in the length of the chords, through five samples.
#[derive(Clone, Debug)]
pub(super) struct LocalPolynomial {
    /// The coefficients of the powers of the length, relative to the sample.
    pub coefficients: [PointAndInput; 5],
    /// The lengths at the previous and the next sample.
    pub range: [f64; 2],
    /// Whether the path does not turn sharply at any sample within two of it.
    pub is_smooth: bool,
}

impl LocalPolynomial {
    /// The point and the input, relative to those of the sample.
    pub fn point_and_input_at(&self, u: f64) -> (Vector, f64) {
        let [a, b, c, d, e] = &self.coefficients;
        let at = (((e * u + d) * u + c) * u + b) * u + a;
        (at.xy(), at.z)
    }

    /// The point, relative to the sample, and its first two derivatives.
    pub fn derivatives_at(&self, u: f64) -> [Vector; 3] {
        let powers = self.coefficients.iter().rev().map(|power| power.xy());
        powers.fold([Vector::zeros(); 3], |[p, v, a], c| [p * u + c, v * u + p, a * u + v * 2.0])
    }

    /// The greatest value of a function between the previous and the next sample.
    pub fn maximum(&self, value: impl Fn(&LocalPolynomial, f64) -> f64) -> f64 {
        let [mut a, mut b] = self.range;
        // To 1e-7 of the distance between samples: the error of the maximum is of the order of its square.
        for _ in 0..40 {
            let (c, d) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
            if value(self, c) > value(self, d) { b = d } else { a = c }
        }
        value(self, a)
    }
}

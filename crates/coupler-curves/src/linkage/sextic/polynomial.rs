//! Polynomials of degree up to 6 in two variables.

/// A polynomial in x and y: `self.0[i][j]` is the coefficient of `x^i y^j`; terms of degree above 6 are zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Polynomial(pub(super) [[f64; 7]; 7]);

impl Polynomial {
    const ZERO: Polynomial = Polynomial([[0.0; 7]; 7]);

    /// `c + x X + y Y + q (x^2 + y^2)`.
    pub fn circle(c: f64, [x, y]: [f64; 2], q: f64) -> Polynomial {
        let mut p = Polynomial::ZERO;
        (p.0[0][0], p.0[1][0], p.0[0][1], p.0[2][0], p.0[0][2]) = (c, x, y, q, q);
        p
    }

    pub fn plus(&self, other: &Polynomial) -> Polynomial {
        Polynomial(std::array::from_fn(|i| std::array::from_fn(|j| self.0[i][j] + other.0[i][j])))
    }

    pub fn scaled(&self, by: f64) -> Polynomial {
        Polynomial(self.0.map(|row| row.map(|c| c * by)))
    }

    pub fn times(&self, other: &Polynomial) -> Polynomial {
        let mut product = Polynomial::ZERO;
        for (i, j) in exponents(6) {
            for (k, l) in exponents(6 - i - j) {
                product.0[i + k][j + l] += self.0[i][j] * other.0[k][l];
            }
        }
        product
    }
}

/// The pairs of exponents whose sum is at most a degree.
pub(super) fn exponents(degree: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..=degree).flat_map(move |i| (0..=degree - i).map(move |j| (i, j)))
}

/// The powers of `x` from 0 to 6.
pub(super) fn monomials(x: f64) -> [f64; 7] {
    let mut powers = [1.0; 7];
    for n in 1..7 {
        powers[n] = powers[n - 1] * x;
    }
    powers
}

/// The coefficients of the powers of `a + b t` from 0 to 6, each by ascending powers of t.
pub(super) fn binomial_powers(a: f64, b: f64) -> [[f64; 7]; 7] {
    let mut powers = [[0.0; 7]; 7];
    powers[0][0] = 1.0;
    for n in 1..7 {
        for k in 0..=n {
            powers[n][k] = a * powers[n - 1][k] + if k > 0 { b * powers[n - 1][k - 1] } else { 0.0 };
        }
    }
    powers
}

/// Whether a form, given by ascending powers of y, has the factor (x^2 + y^2)^times.
pub(super) fn has_circular_factor(form: &[f64], times: usize) -> bool {
    let size = form.iter().fold(0.0, |a: f64, c| a.max(c.abs()));
    let mut remainder = form.to_vec();
    for _ in 0..times {
        // By synthetic division: y^2 = -x^2.
        if remainder.len() < 3 {
            return remainder.iter().all(|c| c.abs() <= 1e-9 * size);
        }
        let mut quotient = vec![0.0; remainder.len() - 2];
        for j in (2..remainder.len()).rev() {
            quotient[j - 2] = remainder[j];
            remainder[j - 2] -= remainder[j];
        }
        if remainder[..2].iter().any(|c| c.abs() > 1e-9 * size) {
            return false;
        }
        remainder = quotient;
    }
    true
}

//! Polynomials on [-1, 1] as sums of Chebyshev polynomials.

use std::f64::consts::PI;
use std::sync::LazyLock;

use super::trig;
use crate::numerical::Bracket;

/// The number of terms of a [`Chebyshev`] series, and of the nodes that determine it.
pub const TERMS: usize = 16;

const HALF: usize = TERMS / 2;

/// A polynomial of degree [`TERMS`] - 1 on [-1, 1]: the coefficients of the Chebyshev polynomials `T_0`, `T_1` and so on.
///
/// # Source
/// Trefethen, *Approximation Theory and Approximation Practice*, chapters 3, 18 and 19.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chebyshev(pub [f64; TERMS]);

/// Half of a square matrix of order [`TERMS`] that maps even terms to even ones and odd terms to odd ones.
type Parity = [[[f64; HALF]; HALF]; 2];

struct Tables {
    nodes: [f64; TERMS],
    /// From the sums and the differences of the values at opposite nodes to the even and the odd coefficients.
    from_values: Parity,
    /// From the even and the odd coefficients to their sums at the nodes above 0.
    to_values: Parity,
    /// Column by column, the coefficients on the left half of the interval.
    left_half: [[f64; TERMS]; TERMS],
}

static TABLES: LazyLock<Tables> = LazyLock::new(|| {
    let angle = |j: usize| PI * (2 * j + 1) as f64 / (2 * TERMS) as f64;
    let mut nodes = [0.0; TERMS];
    for j in 0..HALF {
        // Opposite nodes are exactly opposite.
        nodes[j] = -trig::cos(angle(j));
        nodes[TERMS - 1 - j] = trig::cos(angle(j));
    }
    let mut from_values = [[[0.0; HALF]; HALF]; 2];
    for (parity, rows) in from_values.iter_mut().enumerate() {
        for (j, row) in rows.iter_mut().enumerate() {
            for (n, entry) in row.iter_mut().enumerate() {
                let k = 2 * n + parity;
                // Node j is at the angle of the node opposite.
                let weight = if k == 0 { 1.0 } else { 2.0 } / TERMS as f64;
                *entry = weight * trig::cos(k as f64 * angle(j));
            }
        }
    }
    let to_values = from_values.map(|_| [[0.0; HALF]; HALF]);
    let mut tables = Tables { nodes, from_values, to_values, left_half: [[0.0; TERMS]; TERMS] };
    for parity in 0..2 {
        for n in 0..HALF {
            for j in 0..HALF {
                tables.to_values[parity][n][j] = trig::cos((2 * n + parity) as f64 * angle(HALF - 1 - j));
            }
        }
    }
    for n in 0..TERMS {
        let mut unit = Chebyshev([0.0; TERMS]);
        unit.0[n] = 1.0;
        let values = nodes.map(|u| unit.at((u - 1.0) / 2.0));
        let mut column = Chebyshev::from_values_with(&tables.from_values, &values).0;
        // The polynomial of degree n has no higher terms.
        column[n + 1..].fill(0.0);
        tables.left_half[n] = column;
    }
    tables
});

impl Chebyshev {
    /// The places at which [`Chebyshev::from_values`] takes the values, rising, none of them at an end or at 0.
    pub fn nodes() -> &'static [f64; TERMS] {
        &TABLES.nodes
    }

    /// The constant polynomial.
    pub fn constant(value: f64) -> Chebyshev {
        let mut out = [0.0; TERMS];
        out[0] = value;
        Chebyshev(out)
    }

    /// The polynomial with these values at the nodes.
    pub fn from_values(values: &[f64; TERMS]) -> Chebyshev {
        Chebyshev::from_values_with(&TABLES.from_values, values)
    }

    fn from_values_with([even, odd]: &Parity, values: &[f64; TERMS]) -> Chebyshev {
        let mut sums = [[0.0; HALF]; 2];
        for j in 0..HALF {
            let (sum, difference) = (values[j] + values[TERMS - 1 - j], values[TERMS - 1 - j] - values[j]);
            for n in 0..HALF {
                sums[0][n] += even[j][n] * sum;
                sums[1][n] += odd[j][n] * difference;
            }
        }
        let mut out = [0.0; TERMS];
        for n in 0..HALF {
            (out[2 * n], out[2 * n + 1]) = (sums[0][n], sums[1][n]);
        }
        Chebyshev(out)
    }

    /// The greater of the last two coefficients of the polynomial with these values at the nodes, as a magnitude: what
    /// is lacking of a smooth function is no greater.
    pub fn tail_of(values: &[f64; TERMS]) -> f64 {
        let [even, odd] = &TABLES.from_values;
        let (mut last_even, mut last_odd) = (0.0, 0.0);
        for j in 0..HALF {
            last_even += even[j][HALF - 1] * (values[j] + values[TERMS - 1 - j]);
            last_odd += odd[j][HALF - 1] * (values[TERMS - 1 - j] - values[j]);
        }
        last_even.abs().max(last_odd.abs())
    }

    /// The values at the nodes.
    pub fn values(&self) -> [f64; TERMS] {
        let [even, odd] = &TABLES.to_values;
        let mut sums = [[0.0; HALF]; 2];
        for n in 0..HALF {
            for j in 0..HALF {
                sums[0][j] += even[n][j] * self.0[2 * n];
                sums[1][j] += odd[n][j] * self.0[2 * n + 1];
            }
        }
        let mut out = [0.0; TERMS];
        for j in 0..HALF {
            (out[HALF + j], out[HALF - 1 - j]) = (sums[0][j] + sums[1][j], sums[0][j] - sums[1][j]);
        }
        out
    }

    /// The value at a place of [-1, 1], by Clenshaw's recurrence.
    #[inline]
    pub fn at(&self, u: f64) -> f64 {
        let twice = 2.0 * u;
        let (mut b1, mut b2) = (0.0, 0.0);
        for k in (1..TERMS).rev() {
            // In this order only one product and one sum wait for the step before.
            (b1, b2) = (self.0[k] - b2 + twice * b1, b1);
        }
        self.0[0] + u * b1 - b2
    }

    /// The values at four places.
    pub fn at_four(&self, u: [f64; 4]) -> [f64; 4] {
        let twice = u.map(|u| 2.0 * u);
        let (mut b1, mut b2) = ([0.0; 4], [0.0; 4]);
        for k in (1..TERMS).rev() {
            let next = std::array::from_fn(|lane| self.0[k] - b2[lane] + twice[lane] * b1[lane]);
            (b1, b2) = (next, b1);
        }
        std::array::from_fn(|lane| self.0[0] + u[lane] * b1[lane] - b2[lane])
    }

    /// The value at -1.
    pub fn at_start(&self) -> f64 {
        (0..TERMS).rev().fold(0.0, |sum, k| if k % 2 == 0 { sum + self.0[k] } else { sum - self.0[k] })
    }

    /// The value at 1.
    pub fn at_end(&self) -> f64 {
        self.0.iter().rev().sum()
    }

    /// The derivative.
    pub fn derivative(&self) -> Chebyshev {
        let mut out = [0.0; TERMS];
        for k in (1..TERMS).rev() {
            out[k - 1] = 2.0 * k as f64 * self.0[k] + if k + 1 < TERMS { out[k + 1] } else { 0.0 };
        }
        out[0] /= 2.0;
        Chebyshev(out)
    }

    /// The integral from -1, without its last term.
    pub fn integral(&self) -> Chebyshev {
        let at = |k: usize| self.0.get(k).copied().unwrap_or(0.0);
        let mut out = [0.0; TERMS];
        for (k, value) in out.iter_mut().enumerate().skip(1) {
            let before = if k == 1 { 2.0 * at(0) } else { at(k - 1) };
            *value = (before - at(k + 1)) / (2 * k) as f64;
        }
        let mut integral = Chebyshev(out);
        integral.0[0] = -integral.at_start();
        integral
    }

    /// The integral over [-1, 1].
    pub fn total(&self) -> f64 {
        (0..TERMS).step_by(2).map(|k| self.0[k] * 2.0 / (1.0 - (k * k) as f64)).sum()
    }

    /// The sum of the magnitudes of all terms but the first: the polynomial is within it of its first coefficient.
    #[inline]
    pub fn radius(&self) -> f64 {
        self.0[1..].iter().map(|c| c.abs()).sum()
    }

    /// An upper bound of the magnitude.
    pub fn bound(&self) -> f64 {
        self.0[0].abs() + self.radius()
    }

    /// An enclosure of the values: `[lower, upper]`.
    pub fn range(&self) -> [f64; 2] {
        let radius = self.radius();
        [self.0[0] - radius, self.0[0] + radius]
    }

    /// The polynomial on the left and on the right half of the interval, each on [-1, 1].
    pub fn halves(&self) -> [Chebyshev; 2] {
        [self.left_half(), self.reversed().left_half().reversed()]
    }

    fn left_half(&self) -> Chebyshev {
        let mut out = [0.0; TERMS];
        for (column, c) in TABLES.left_half.iter().zip(self.0) {
            for (value, entry) in out.iter_mut().zip(column) {
                *value += entry * c;
            }
        }
        Chebyshev(out)
    }

    /// The polynomial in `-u`.
    pub fn reversed(&self) -> Chebyshev {
        let mut out = self.0;
        out.iter_mut().skip(1).step_by(2).for_each(|c| *c = -*c);
        Chebyshev(out)
    }

    /// The polynomial on a part of the interval, on [-1, 1].
    pub fn restricted(&self, [from, to]: [f64; 2]) -> Chebyshev {
        let (middle, half) = ((from + to) / 2.0, (to - from) / 2.0);
        Chebyshev::from_values(&TABLES.nodes.map(|u| self.at(middle + half * u)))
    }
}

/// The zeros of a function on [-1, 1].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Zeros {
    /// Where its sign changes, rising.
    pub places: Vec<f64>,
    /// Where it comes so close to zero that it is not known whether it has two zeros there or none.
    pub doubtful: Vec<f64>,
}

impl Chebyshev {
    /// The zeros in (-1, 1) at which the polynomial changes its sign.
    ///
    /// They are isolated by halving: on a part the sum of the other terms against the first tells that there is none,
    /// and the same of the derivative that there is at most one. Values up to `rounding` are not told from zero; where
    /// they do not change the sign, they are doubtful if they are in a part narrower than `narrow`.
    pub fn zeros(&self, rounding: f64, narrow: f64) -> Zeros {
        let mut search = ZeroSearch { whole: self, rounding, narrow, found: Zeros::default(), examined: 0 };
        let radius = self.radius();
        if radius.is_finite() && self.0[0].abs() <= radius && self.0[0].abs() + radius > rounding {
            search.examine(self, [-1.0, 1.0], [-1.0, 1.0].map(|u| self.at(u)));
        }
        search.found
    }
}

/// The search for the zeros of a polynomial.
struct ZeroSearch<'a> {
    whole: &'a Chebyshev,
    rounding: f64,
    narrow: f64,
    found: Zeros,
    /// The number of parts so far; after [`ZeroSearch::MAX_EXAMINED`] of them none is halved.
    examined: usize,
}

impl ZeroSearch<'_> {
    /// Simple zeros take a few hundred; a zero of a high order, which is flat around, would take millions.
    const MAX_EXAMINED: usize = 20_000;

    /// Finds the zeros on a `part`, from its ends and the values of the whole there: neighbouring parts agree about the sign at the
    /// end they share.
    fn examine(&mut self, part: &Chebyshev, [from, to]: [f64; 2], values: [f64; 2]) {
        self.examined += 1;
        let (mean, radius) = (part.0[0].abs(), part.radius());
        let bracket = Bracket::new([from, to], values);
        if bracket.is_none() && (mean > radius || mean + radius <= self.rounding) {
            return;
        }
        let slope = part.derivative();
        let is_monotonic = slope.0[0].abs() > slope.radius();
        let middle = (from + to) / 2.0;
        if is_monotonic || to - from <= self.narrow || self.examined >= ZeroSearch::MAX_EXAMINED {
            match bracket {
                Some(bracket) => self.found.places.push(bracket.zero(f64::EPSILON, |u| self.whole.at(u))),
                None if !is_monotonic => self.found.doubtful.push(middle),
                None => {}
            }
            return;
        }
        let [left, right] = part.halves();
        let cut = self.whole.at(middle);
        self.examine(&left, [from, middle], [values[0], cut]);
        self.examine(&right, [middle, to], [cut, values[1]]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(f: impl Fn(f64) -> f64) -> Chebyshev {
        Chebyshev::from_values(&Chebyshev::nodes().map(f))
    }

    #[test]
    fn values_derivatives_and_integrals_are_those_of_the_function() {
        let sine = series(|u| trig::sin(1.3 * u + 0.2));
        let (slope, integral) = (sine.derivative(), sine.integral());
        for k in 0..=20 {
            let u = -1.0 + f64::from(k) / 10.0;
            let angle = 1.3 * u + 0.2;
            assert!((sine.at(u) - trig::sin(angle)).abs() < 1e-15, "{u}");
            assert!((slope.at(u) - 1.3 * trig::cos(angle)).abs() < 1e-12, "{u}");
            let area = (trig::cos(-1.1) - trig::cos(angle)) / 1.3;
            assert!((integral.at(u) - area).abs() < 1e-15, "{u}");
        }
        assert!((sine.total() - integral.at_end()).abs() < 1e-15);
        assert_eq!(
            [sine.at_start(), sine.at_end()].map(|v| (v * 1e12).round()),
            [-1.1, 1.5].map(|a| (trig::sin(a) * 1e12).round())
        );
    }

    #[test]
    fn parts_are_the_same_polynomial() {
        let f = series(|u| trig::exp(u) * trig::cos(2.0 * u));
        let [left, right] = f.halves();
        for k in 0..=10 {
            let u = -1.0 + f64::from(k) / 5.0;
            assert!((left.at(u) - f.at((u - 1.0) / 2.0)).abs() < 4e-15);
            assert!((right.at(u) - f.at((u + 1.0) / 2.0)).abs() < 4e-15);
            assert!((f.restricted([0.2, 0.6]).at(u) - f.at(0.4 + 0.2 * u)).abs() < 4e-15);
        }
        let [lower, upper] = f.range();
        assert!(f.values().iter().all(|v| (lower..=upper).contains(v)));
    }

    #[test]
    fn zeros_are_isolated_however_close() {
        let zeros = |gap: f64| series(|u| (u - 0.3) * (u - 0.3 - gap) * (u + 0.7)).zeros(0.0, 1e-9);
        for gap in [0.5, 1e-3, 1e-6] {
            let found = zeros(gap).places;
            assert_eq!(found.len(), 3, "{gap}: {found:?}");
            assert!((found[2] - found[1] - gap).abs() < 1e-9, "{gap}: {found:?}");
        }
        assert_eq!(series(|u| u * u + 1e-5).zeros(0.0, 1e-9), Zeros::default());
        assert_eq!(series(|u| 1e-17 * u).zeros(1e-16, 1e-9), Zeros::default());
        assert_eq!(zeros(0.0).places.len() % 2, 1);
    }
}

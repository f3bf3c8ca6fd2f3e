//! The equation of a coupler curve: a polynomial of degree 6 in the coordinates of the coupler point.

mod change_points;
mod double_point;
mod double_points;
mod polynomial;
mod roots;

pub use double_point::{DoublePoint, DoublePointKind};

use crate::geometry::{Point, Vector, cross};
use crate::linkage::FourBar;
use crate::numerical::real_roots;
use change_points::change_points;
use polynomial::{Polynomial, binomial_powers, exponents, has_circular_factor, monomials};

/// The coupler curve of a four-bar as an algebraic curve, in the frame with its origin at the crank's pivot and x
/// towards the rocker's. It includes all circuits and branches.
///
/// # Source
/// Samuel Roberts; Natesan (6.5) and (7.1), with the sign of y^2 on the right side corrected, and with the sides of the
/// coupler triangle in place of the sines of its angles, so that it also holds for points on the line of the pins.
#[derive(Clone, Debug, PartialEq)]
pub struct Sextic {
    equation: Polynomial,
    terms: EquationTerms,
    four_bar: FourBar,
    /// The coupler point, along the coupler and across it.
    point: Vector,
    /// The positions of the coupler point when all links lie on one line.
    change_points: Vec<DoublePoint>,
}

/// The terms of the equation: with u and v from the crank pin and the rocker pin to the coupler point, `|u|^2` and
/// `|v|^2`, the products `u . v` and `u x v`, and the lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
struct EquationTerms {
    frame: f64,
    dot: f64,
    cross: f64,
    /// `|u|^2`, from the crank pin, and `|u|^2 - crank^2`.
    u: [f64; 2],
    /// `|v|^2`, from the rocker pin, and `|v|^2 - rocker^2`.
    v: [f64; 2],
}

impl EquationTerms {
    /// The equation in the frame with its origin at (`origin`, 0), with 1 as the coefficient of `x^6`.
    fn equation(&self, origin: f64) -> Polynomial {
        let equation = combine(&self.factors(origin), -4.0 * self.u[0]);
        // Divided by the coefficient of (x^2 + y^2)^3: the square of the coupler's length, times |u|^2.
        equation.scaled(1.0 / equation.0[6][0])
    }

    /// For each coefficient of [`EquationTerms::equation`], the sum of the magnitudes of its terms.
    fn equation_sizes(&self, origin: f64) -> Polynomial {
        let lead = combine(&self.factors(origin), -4.0 * self.u[0]).0[6][0];
        let mut factors = self.factors(origin).map(|factor| Polynomial(factor.0.map(|row| row.map(f64::abs))));
        // The constants of E1 and E2 are differences themselves: of these squares and the square of a crank.
        let far = self.frame - origin;
        factors[0].0[0][0] += 2.0 * (origin * origin + self.u[0]);
        factors[1].0[0][0] += 2.0 * (far * far + self.v[0]);
        combine(&factors, 4.0 * self.u[0]).scaled(1.0 / lead)
    }

    /// The polynomials that the equation is combined from.
    fn factors(&self, origin: f64) -> [Polynomial; 7] {
        let EquationTerms { frame, dot, cross: sine, u: [u2, u_difference], v: [_, v_difference] } = *self;
        let far = frame - origin;
        let line = |c, x, y| Polynomial::circle(c, [x, y], 0.0);
        [
            // E1 and E2 of (6.4): x cos t + y sin t = E1 / 2b, and the same about the rocker's pivot, turned by gamma.
            Polynomial::circle(origin * origin + u_difference, [2.0 * origin, 0.0], 1.0),
            Polynomial::circle(far * far + v_difference, [-2.0 * far, 0.0], 1.0),
            line(-far * sine, sine, -dot),
            line(0.0, 0.0, u2),
            line(-far * dot, dot, sine),
            line(-u2 * origin, -u2, 0.0),
            Polynomial::circle(-sine * origin * far, [sine * (origin - far), -frame * dot], sine),
        ]
    }
}

/// The sum of the squares of both sums of products, and the square of the last factor times `right`.
fn combine([e1, e2, sine1, sine2, cosine1, cosine2, last]: &[Polynomial; 7], right: f64) -> Polynomial {
    let first = sine1.times(e1).plus(&sine2.times(e2));
    let second = cosine1.times(e1).plus(&cosine2.times(e2));
    let squares = first.times(&first).plus(&second.times(&second));
    squares.plus(&last.times(last).scaled(right))
}

impl Sextic {
    /// The equation of the curve of a coupler point, given along the coupler from the crank pin towards the rocker
    /// pin, and to its left.
    ///
    /// `None` for the pins themselves, which trace circles.
    pub fn from_four_bar(four_bar: FourBar, point: Vector) -> Option<Sextic> {
        let FourBar { frame, crank, coupler, rocker } = four_bar;
        let (u, v) = (point, point - Vector::new(coupler, 0.0));
        if u == Vector::zeros() || v == Vector::zeros() {
            return None;
        }
        let (u2, v2) = (u.norm_squared(), v.norm_squared());
        let difference = |length2: f64, length: f64| (length2.sqrt() - length) * (length2.sqrt() + length);
        let parts = EquationTerms {
            frame,
            dot: u.dot(&v),
            cross: cross(u, v),
            u: [u2, difference(u2, crank)],
            v: [v2, difference(v2, rocker)],
        };
        let equation = parts.equation(0.0);
        Some(Sextic { equation, terms: parts, four_bar, point, change_points: change_points(four_bar, point) })
    }

    /// The coefficient of `x^i y^j`; that of `x^6` is 1.
    ///
    /// # Panics
    /// If `i` or `j` is above 6.
    pub fn coefficient(&self, i: usize, j: usize) -> f64 {
        self.equation.0[i][j]
    }

    /// The coefficients in the frame with its origin in the middle of the line of the pivots, by the powers of
    /// X = x - frame / 2 and of y, as [`Sextic::coefficient`] gives them about the crank's pivot. Those that are not
    /// larger than the rounding errors of their terms are 0; for a curve that is symmetrical about X = 0 these are all
    /// those of odd powers of X.
    ///
    /// # Source
    /// Natesan (7.6), and (7.7) for a symmetrical four-bar, times the square of the sine of 2 beta. In (7.5) `- y^2` is
    /// `+ y^2`, as in (6.5), and in (7.7) the bracket after `sin^2 beta (1 + sin^2 beta` is missing.
    pub fn centred_coefficients(&self) -> [[f64; 7]; 7] {
        // Some twenty products and sums in each coefficient.
        const ROUNDING: f64 = 32.0 * f64::EPSILON;
        let middle = self.terms.frame / 2.0;
        let (equation, sizes) = (self.terms.equation(middle).0, self.terms.equation_sizes(middle).0);
        std::array::from_fn(|i| {
            std::array::from_fn(|j| if equation[i][j].abs() <= ROUNDING * sizes[i][j] { 0.0 } else { equation[i][j] })
        })
    }

    /// The left side of the equation at a point, and the sum of the magnitudes of its terms, to which its rounding
    /// error is proportional.
    pub fn evaluate(&self, point: Point) -> [f64; 2] {
        let (xs, ys) = (monomials(point.x), monomials(point.y));
        exponents(6).fold([0.0; 2], |[sum, size], (i, j)| {
            let term = self.equation.0[i][j] * xs[i] * ys[j];
            [sum + term, size + term.abs()]
        })
    }

    /// Its first derivatives at a point.
    pub fn gradient(&self, point: Point) -> Vector {
        let (xs, ys) = (monomials(point.x), monomials(point.y));
        exponents(6).fold(Vector::zeros(), |sum, (i, j)| {
            let c = self.equation.0[i][j];
            let x = if i > 0 { i as f64 * xs[i - 1] * ys[j] } else { 0.0 };
            let y = if j > 0 { j as f64 * xs[i] * ys[j - 1] } else { 0.0 };
            sum + Vector::new(x, y) * c
        })
    }

    /// Its second derivatives at a point: xx, xy and yy.
    pub fn second_derivatives(&self, point: Point) -> [f64; 3] {
        let (xs, ys) = (monomials(point.x), monomials(point.y));
        let second = |n: usize, powers: &[f64; 7]| if n > 1 { (n * (n - 1)) as f64 * powers[n - 2] } else { 0.0 };
        let first = |n: usize, powers: &[f64; 7]| if n > 0 { n as f64 * powers[n - 1] } else { 0.0 };
        exponents(6).fold([0.0; 3], |[xx, xy, yy], (i, j)| {
            let c = self.equation.0[i][j];
            [xx + c * second(i, &xs) * ys[j], xy + c * first(i, &xs) * first(j, &ys), yy + c * xs[i] * second(j, &ys)]
        })
    }

    /// The slope dy/dx of the curve at one of its points, and d2y/dx2 there; not finite where the tangent is
    /// vertical, or at a double point.
    ///
    /// # Source
    /// Natesan (8.4) and (8.7): the equation differentiated once and twice with respect to x.
    pub fn y_derivatives(&self, point: Point) -> [f64; 2] {
        let [by_x, by_y] = [self.gradient(point).x, self.gradient(point).y];
        let [xx, xy, yy] = self.second_derivatives(point);
        let slope = -by_x / by_y;
        [slope, -(xx + slope * (2.0 * xy + slope * yy)) / by_y]
    }

    /// The intersections of the curve with a line through a point in a direction: at most six, in order along the line.
    pub fn line_intersections(&self, point: Point, direction: Vector) -> Vec<Point> {
        // The polynomial in t of point + t direction, by powers of both coordinates.
        let mut along = [0.0; 7];
        let (x, y) = (binomial_powers(point.x, direction.x), binomial_powers(point.y, direction.y));
        for (i, j) in exponents(6) {
            for (k, a) in x[i].iter().enumerate().take(i + 1) {
                for (l, b) in y[j].iter().enumerate().take(j + 1) {
                    along[k + l] += self.equation.0[i][j] * a * b;
                }
            }
        }
        real_roots(&along).into_iter().map(|t| point + direction * t).collect()
    }

    /// The number of times the curve passes through each of the two circular points at infinity: three.
    pub fn circularity(&self) -> usize {
        // For multiplicity m the form of degree 6 - k has the factor (x^2 + y^2)^(m - k).
        let holds = |m: usize| (0..m).all(|k| has_circular_factor(&self.homogeneous_part(6 - k), m - k));
        (0..=3).rev().find(|&m| holds(m)).unwrap_or(0)
    }

    /// The coefficients of the terms of one degree, by ascending powers of y.
    fn homogeneous_part(&self, degree: usize) -> Vec<f64> {
        (0..=degree).map(|j| self.equation.0[degree - j][j]).collect()
    }
}

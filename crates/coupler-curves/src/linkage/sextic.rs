//! The equation of a coupler curve: a polynomial of the sixth degree in the coordinates of the coupler point.

use super::FourBar;
use crate::geometry::{Point, Vector, cross, left_normal, trig};

/// A polynomial in x and y: `self.0[i][j]` is the coefficient of `x^i y^j`; those of degrees above 6 are zero.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Polynomial([[f64; 7]; 7]);

impl Polynomial {
    const ZERO: Polynomial = Polynomial([[0.0; 7]; 7]);

    /// `c + x X + y Y + q (x^2 + y^2)`.
    fn circle(c: f64, [x, y]: [f64; 2], q: f64) -> Polynomial {
        let mut p = Polynomial::ZERO;
        (p.0[0][0], p.0[1][0], p.0[0][1], p.0[2][0], p.0[0][2]) = (c, x, y, q, q);
        p
    }

    fn plus(&self, other: &Polynomial) -> Polynomial {
        Polynomial(std::array::from_fn(|i| std::array::from_fn(|j| self.0[i][j] + other.0[i][j])))
    }

    fn scaled(&self, by: f64) -> Polynomial {
        Polynomial(self.0.map(|row| row.map(|c| c * by)))
    }

    fn times(&self, other: &Polynomial) -> Polynomial {
        let mut product = Polynomial::ZERO;
        for (i, j) in exponents(6) {
            for (k, l) in exponents(6 - i - j) {
                product.0[i + k][j + l] += self.0[i][j] * other.0[k][l];
            }
        }
        product
    }
}

/// The pairs of powers up to a degree.
fn exponents(degree: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..=degree).flat_map(move |i| (0..=degree - i).map(move |j| (i, j)))
}

/// The coupler curve of a four-bar as an algebraic curve, in the frame with its origin at the crank's pivot and x towards
/// the rocker's. It holds for both circuits and both branches.
///
/// # Source
/// Samuel Roberts; Natesan (6.5) and (7.1), with the sign of y^2 on the right put right, and with the sides of the coupler
/// triangle for the sines of its angles, so that it holds for points on the line of the pins too.
#[derive(Clone, Debug, PartialEq)]
pub struct Sextic {
    equation: Polynomial,
    terms: EquationTerms,
    /// Where the coupler point is when all links lie on one line.
    change_points: Vec<Point>,
}

/// What the equation is made of: with u and v from the pins to the coupler point, `|u|^2` and `|v|^2`, their products
/// `u . v` and `u x v`, and the lengths.
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

/// A double point of a coupler curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoublePoint {
    /// Where it is.
    pub point: Point,
    /// What it is.
    pub kind: DoublePointKind,
}

/// The kinds of double points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DoublePointKind {
    /// Two branches of the curve cross.
    Crunode,
    /// The branches touch, or form a cusp.
    Cusp,
    /// An isolated point: the equation holds there, and no pose of the linkage has its coupler point there.
    Acnode,
}

impl DoublePointKind {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            DoublePointKind::Crunode => "crunode",
            DoublePointKind::Cusp => "cusp",
            DoublePointKind::Acnode => "acnode",
        }
    }
}

impl Sextic {
    /// The equation of the curve of a point of the coupler, which is so far along the coupler from the crank pin towards
    /// the rocker pin, and to the left of it.
    ///
    /// `None` for the pins themselves, which go on circles.
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
        let EquationTerms { dot, cross: sine, .. } = parts;
        // From (6.4): x cos t + y sin t = E1 / 2b, and the same about the rocker's pivot, turned by gamma.
        let e1 = Polynomial::circle(parts.u[1], [0.0, 0.0], 1.0);
        let e2 = Polynomial::circle(frame * frame + parts.v[1], [-2.0 * frame, 0.0], 1.0);
        let line = |c, x, y| Polynomial::circle(c, [x, y], 0.0);
        let first = line(-frame * sine, sine, -dot).times(&e1).plus(&line(0.0, 0.0, u2).times(&e2));
        let second = line(-frame * dot, dot, sine).times(&e1).plus(&line(0.0, -u2, 0.0).times(&e2));
        let right = Polynomial::circle(0.0, [-frame * sine, -frame * dot], sine);
        let squares = first.times(&first).plus(&second.times(&second));
        let equation = squares.plus(&right.times(&right).scaled(-4.0 * u2));
        // Divided by what stands before (x^2 + y^2)^3: the square of the coupler's length, times |u|^2.
        let equation = equation.scaled(1.0 / equation.0[6][0]);
        Some(Sextic { equation, terms: parts, change_points: change_points(four_bar, point) })
    }

    /// The coefficient of `x^i y^j`; that of `x^6` is 1.
    ///
    /// # Panics
    /// If `i` or `j` is above 6.
    pub fn coefficient(&self, i: usize, j: usize) -> f64 {
        self.equation.0[i][j]
    }

    /// The left side of the equation at a point, and the sum of the magnitudes of its terms, against which rounding is to
    /// be seen.
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

    /// Its second derivatives at a point: by x twice, by x and y, by y twice.
    pub fn second_derivatives(&self, point: Point) -> [f64; 3] {
        let (xs, ys) = (monomials(point.x), monomials(point.y));
        let second = |n: usize, powers: &[f64; 7]| if n > 1 { (n * (n - 1)) as f64 * powers[n - 2] } else { 0.0 };
        let first = |n: usize, powers: &[f64; 7]| if n > 0 { n as f64 * powers[n - 1] } else { 0.0 };
        exponents(6).fold([0.0; 3], |[xx, xy, yy], (i, j)| {
            let c = self.equation.0[i][j];
            [xx + c * second(i, &xs) * ys[j], xy + c * first(i, &xs) * first(j, &ys), yy + c * xs[i] * second(j, &ys)]
        })
    }

    /// The slope dy/dx of the curve at one of its points, and d2y/dx2 there; not numbers where it goes along y, or at a
    /// double point.
    ///
    /// # Source
    /// Natesan (8.4) and (8.7): the equation differentiated by x once and twice.
    pub fn y_derivatives(&self, point: Point) -> [f64; 2] {
        let [by_x, by_y] = [self.gradient(point).x, self.gradient(point).y];
        let [xx, xy, yy] = self.second_derivatives(point);
        let slope = -by_x / by_y;
        [slope, -(xx + slope * (2.0 * xy + slope * yy)) / by_y]
    }

    /// The determinant of its second derivatives at a point, and the size of its terms.
    fn hessian_determinant(&self, point: Point) -> [f64; 2] {
        let [xx, xy, yy] = self.second_derivatives(point);
        [xx * yy - xy * xy, (xx * yy).abs() + xy * xy]
    }

    /// Where the curve meets a line through a point in a direction: at most six points, in the order along the line.
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

    /// The real double points: at most three, and one for each change point of the linkage. The three lie on the circle through both pivots and the third singular focus,
    /// and on the line of pivots where the coupler point is on the line of pins.
    ///
    /// # Source
    /// There the two equations for the coupler's direction are one (Natesan 6.4): the right side of (6.5) vanishes.
    pub fn double_points(&self) -> Vec<DoublePoint> {
        let EquationTerms { frame, dot, cross: sine, u, v } = self.terms;
        // Where the normals of both equations are parallel, and both distances agree.
        let agreement = |p: Point| {
            let e1 = p.coords.norm_squared() + u[1];
            let e2 = (p - Point::new(frame, 0.0)).norm_squared() + v[1];
            let far = p - Point::new(frame, 0.0);
            // The second normal is the first times this over |p|^2; taken about whichever pivot is further off.
            let turned = far * dot + left_normal(far) * -sine;
            if p.coords.norm_squared() > far.norm_squared() {
                e1 * turned.dot(&p.coords) - e2 * u[0] * p.coords.norm_squared()
            } else {
                let back = p.coords * dot + left_normal(p.coords) * sine;
                e1 * v[0] * far.norm_squared() - e2 * back.dot(&far)
            }
        };
        let is_line = sine.abs() <= 1e-12 * dot.abs();
        let at = |t: f64| {
            if is_line {
                // The whole line, by the tangent of half the angle.
                Point::new(frame * (0.5 + trig::tan(t / 2.0)), 0.0)
            } else {
                let centre = Point::new(frame / 2.0, frame * dot / (2.0 * sine));
                let radius = (centre.coords).norm();
                Point::new(centre.x + radius * trig::cos(t), centre.y + radius * trig::sin(t))
            }
        };
        let mut found: Vec<DoublePoint> = Vec::new();
        for point in periodic_zeros(|t| agreement(at(t))).into_iter().map(at).chain(self.change_points.iter().copied())
        {
            let [determinant, size] = self.hessian_determinant(point);
            let kind = match determinant / size {
                d if d.abs() < 1e-7 => DoublePointKind::Cusp,
                d if d < 0.0 => DoublePointKind::Crunode,
                _ => DoublePointKind::Acnode,
            };
            let is_new = found.iter().all(|other| (other.point - point).norm() > 1e-6 * (frame + point.coords.norm()));
            // The pivots are on the circle too, and are double points only where the curve goes through them.
            let [value, terms] = self.evaluate(point);
            if is_new && point.x.is_finite() && value.abs() <= 1e-9 * terms {
                found.push(DoublePoint { point, kind });
            }
        }
        found
    }

    /// How often the curve goes through each of the two circular points at infinity: three times.
    pub fn circularity(&self) -> usize {
        // The form of degree 6 - k has the factor (x^2 + y^2) as often as m - k times.
        let holds = |m: usize| (0..m).all(|k| has_circular_factor(&self.homogeneous_part(6 - k), m - k));
        (0..=3).rev().find(|&m| holds(m)).unwrap_or(0)
    }

    /// The terms of one degree, by the power of y.
    fn homogeneous_part(&self, degree: usize) -> Vec<f64> {
        (0..=degree).map(|j| self.equation.0[degree - j][j]).collect()
    }
}

/// Where the coupler point of a four-bar is at its change points: there the linkage may go on in two ways.
fn change_points(four_bar: FourBar, point: Vector) -> Vec<Point> {
    let FourBar { frame, crank, coupler, rocker } = four_bar;
    let tolerance = super::length_tolerance(frame + crank + coupler + rocker);
    let lines = (0..8).map(|k| [1, 2, 4].map(|bit| if k & bit == 0 { 1.0 } else { -1.0 }));
    let flat = lines.filter(|[a, b, c]| (a * crank + b * coupler - c * rocker - frame).abs() <= tolerance);
    flat.map(|[a, b, _]| Point::new(a * crank, 0.0) + point * b).collect()
}

/// Whether a form, by the powers of y, has the factor x^2 + y^2 so many times.
fn has_circular_factor(form: &[f64], times: usize) -> bool {
    let size = form.iter().fold(0.0, |a: f64, c| a.max(c.abs()));
    let mut left = form.to_vec();
    for _ in 0..times {
        // By synthetic division: y^2 = -x^2.
        if left.len() < 3 {
            return left.iter().all(|c| c.abs() <= 1e-9 * size);
        }
        let mut quotient = vec![0.0; left.len() - 2];
        for j in (2..left.len()).rev() {
            quotient[j - 2] = left[j];
            left[j - 2] -= left[j];
        }
        if left[..2].iter().any(|c| c.abs() > 1e-9 * size) {
            return false;
        }
        left = quotient;
    }
    true
}

/// The powers from 0 to 6.
fn monomials(x: f64) -> [f64; 7] {
    let mut powers = [1.0; 7];
    for n in 1..7 {
        powers[n] = powers[n - 1] * x;
    }
    powers
}

/// The powers of `a + b t`, each by its coefficients.
fn binomial_powers(a: f64, b: f64) -> [[f64; 7]; 7] {
    let mut powers = [[0.0; 7]; 7];
    powers[0][0] = 1.0;
    for n in 1..7 {
        for k in 0..=n {
            powers[n][k] = a * powers[n - 1][k] + if k > 0 { b * powers[n - 1][k - 1] } else { 0.0 };
        }
    }
    powers
}

/// The real roots of a polynomial by its coefficients, in order: between the roots of its derivative there is one at
/// most, and where it touches zero that is a root of both.
fn real_roots(coefficients: &[f64]) -> Vec<f64> {
    let size = coefficients.iter().fold(0.0, |a: f64, c| a.max(c.abs()));
    let degree = coefficients.iter().rposition(|c| c.abs() > 1e-14 * size).unwrap_or(0);
    let coefficients = &coefficients[..=degree];
    let value = |t: f64| coefficients.iter().rev().fold([0.0; 2], |[v, s], c| [v * t + c, s * t.abs() + c.abs()]);
    if degree == 0 {
        return Vec::new();
    }
    let lead = coefficients[degree];
    // Cauchy's bound on the roots.
    let bound = 1.0 + coefficients[..degree].iter().fold(0.0, |a: f64, c| a.max((c / lead).abs()));
    let derivative: Vec<f64> = (1..=degree).map(|n| n as f64 * coefficients[n]).collect();
    let turning = real_roots(&derivative);
    let mut stations = vec![-bound];
    stations.extend(turning.iter().copied().filter(|t| t.abs() < bound));
    stations.push(bound);
    let mut roots: Vec<f64> = Vec::new();
    for pair in stations.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let ([fa, sa], [fb, _]) = (value(a), value(b));
        // At a turning point a value within its rounding is a root of even order.
        if turning.contains(&a) && fa.abs() <= 1e-13 * sa {
            roots.push(a);
        } else if fa * fb < 0.0 {
            roots.push(bisect(|t| value(t)[0], a, b));
        }
    }
    roots.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * bound);
    roots
}

/// The zero of a function between two places at which its signs differ.
pub(super) fn bisect(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let rises = f(b) > 0.0;
    loop {
        let middle = a + (b - a) / 2.0;
        if middle == a || middle == b {
            return middle;
        }
        if (f(middle) > 0.0) == rises { b = middle } else { a = middle }
    }
}

/// The zeros of a function of period 2 pi with a few of them, those included where it touches zero.
fn periodic_zeros(f: impl Fn(f64) -> f64) -> Vec<f64> {
    const STEPS: usize = 720;
    // Off the round angles, at which the function may have a pole.
    let at = |k: usize| trig::radians(0.5 * (k as f64 - 360.0) + 0.123_456_789);
    let values: Vec<f64> = (0..=STEPS).map(|k| f(at(k))).collect();
    let size = values.iter().copied().filter(|v| v.is_finite()).fold(0.0, |a: f64, v| a.max(v.abs()));
    let mut found = Vec::new();
    for k in 0..STEPS {
        if values[k] * values[k + 1] < 0.0 {
            found.push(bisect(&f, at(k), at(k + 1)));
        } else if k > 0 && values[k].abs() <= values[k - 1].abs() && values[k].abs() < values[k + 1].abs() {
            // A touch: the least value nearby, by thirds.
            let (mut a, mut b) = (at(k - 1), at(k + 1));
            for _ in 0..80 {
                let (c, d) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
                if f(c).abs() < f(d).abs() { b = d } else { a = c }
            }
            if f(a).abs() <= 1e-12 * size {
                found.push(a);
            }
        }
    }
    found
}

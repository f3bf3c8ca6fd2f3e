//! All poses of a group at one input, by continuation from a system whose solutions are known.
//!
//! Positions are complex numbers z and their conjugates w, which are taken as independent: each equation is of the first degree in the z and of
//! the first in the w. So a system of m unknown joints has at most (2m over m) solutions: 6 for the triad of class III, with two, which is its bound.
//!
//! # Source
//! Wampler, Solving the kinematics of planar mechanisms, *Journal of Mechanical Design* 121 (1999), 387-391 (isotropic coordinates); Sommese and
//! Wampler, *The Numerical Solution of Systems of Polynomials* (2005), chapters 2 and 8 (multihomogeneous start systems).

use nalgebra::{Complex, DMatrix, DVector};

use super::equations::{Equations, Form};
use crate::geometry::{Vector, trig};

type Number = Complex<f64>;

/// The most joints: 924 paths are followed for 6 of them, 12 unknowns.
pub(super) const MAX_JOINTS: usize = 6;

/// Solutions farther than this, relative to the size of the linkage, are at infinity.
const INFINITY: f64 = 1e6;

/// The steps of a path are between these; a path that would need shorter ones ends at infinity, or where solutions coincide.
const STEPS: [f64; 2] = [1e-10, 0.05];

/// The most steps of a path: those that end at a solution take some hundreds.
const MAX_STEPS: usize = 10_000;

/// Of the predicted to the corrected position, relative to the size: below the distance of paths, so that none is left for another.
const MAX_CORRECTION: f64 = 1e-3;

/// The start system: for each equation a product of a linear function of the z and one of the w.
struct StartSystem {
    /// For each equation the coefficients of the z and of the w, with the constants last.
    factors: Vec<[DVector<Number>; 2]>,
}

impl Equations {
    /// The states at an input, real solutions of the equations; `None` if there are too many unknowns.
    pub fn poses_at(&self, input: f64) -> Option<Vec<Vec<f64>>> {
        let m = self.joints.len();
        if m > MAX_JOINTS {
            return None;
        }
        let start = StartSystem::new(m);
        let own = self.input_in_state(input);
        let mut found: Vec<Vec<f64>> = Vec::new();
        for subset in subsets(2 * m, m) {
            let Some(from) = start.solution(&subset) else { continue };
            let Some(end) = self.follow_path(&start, from, own) else { continue };
            // Real positions are those with w the conjugate of z.
            /// A pair that misses by more is not real; where it does not, it is corrected.
            const REAL: f64 = 1e-6;
            if (0..m).any(|k| (end[k] - end[m + k].conj()).norm() > REAL) {
                continue;
            }
            let state: Vec<f64> = (0..m).flat_map(|k| [end[k].re, end[k].im]).chain([own]).collect();
            let Some(state) = self.corrected(state, 2 * m) else { continue };
            let is_known = |other: &Vec<f64>| other.iter().zip(&state).all(|(a, b)| (a - b).abs() < REAL);
            if !found.iter().any(is_known) {
                found.push(state);
            }
        }
        Some(found)
    }

    /// The end of the path from a solution of the start system; `None` if it is at infinity, or where solutions coincide.
    fn follow_path(&self, start: &StartSystem, from: DVector<Number>, input: f64) -> Option<DVector<Number>> {
        let (mut at, mut t, mut step) = (from, 0.0, STEPS[1]);
        let mut good = 0;
        for _ in 0..MAX_STEPS {
            if t >= 1.0 {
                return Some(at);
            }
            let next = (t + step).min(1.0);
            let accepted = self.predicted(start, &at, [t, next], input).and_then(|guess| {
                let corrected = self.corrected_on_path(start, guess.clone(), next, input)?;
                ((&corrected - guess).amax_norm() <= MAX_CORRECTION * (1.0 + corrected.amax_norm()))
                    .then_some(corrected)
            });
            match accepted {
                Some(state) => {
                    (at, t, good) = (state, next, good + 1);
                    if at.amax_norm() > INFINITY {
                        return None;
                    }
                    if good >= 3 {
                        (step, good) = ((2.0 * step).min(STEPS[1]), 0);
                    }
                }
                None => {
                    (step, good) = (step / 2.0, 0);
                    if step < STEPS[0] {
                        return None;
                    }
                }
            }
        }
        None
    }

    /// The state at the next value of the parameter, by the method of Runge and Kutta of the fourth order.
    fn predicted(
        &self,
        start: &StartSystem,
        at: &DVector<Number>,
        [t, next]: [f64; 2],
        input: f64,
    ) -> Option<DVector<Number>> {
        let h = Number::from(next - t);
        let half = Number::from((next - t) / 2.0);
        let rate = |state: &DVector<Number>, t: f64| {
            let (_, jacobian, in_t) = self.between(start, state, t, input);
            jacobian.lu().solve(&-in_t)
        };
        let a = rate(at, t)?;
        let b = rate(&(at + &a * half), (t + next) / 2.0)?;
        let c = rate(&(at + &b * half), (t + next) / 2.0)?;
        let d = rate(&(at + &c * h), next)?;
        let two = Number::from(2.0);
        Some(at + (a + b * two + c * two + d) * (h / Number::from(6.0)))
    }

    fn corrected_on_path(
        &self,
        start: &StartSystem,
        mut at: DVector<Number>,
        t: f64,
        input: f64,
    ) -> Option<DVector<Number>> {
        for _ in 0..4 {
            let (values, jacobian, _) = self.between(start, &at, t, input);
            let change = jacobian.lu().solve(&values)?;
            at -= &change;
            if change.amax_norm() <= 1e-12 * (1.0 + at.amax_norm()) {
                return Some(at);
            }
        }
        None
    }

    /// The system between the start system, at 0, and the equations, at 1: its values, its derivatives, and those with respect to the parameter.
    fn between(
        &self,
        start: &StartSystem,
        at: &DVector<Number>,
        t: f64,
        input: f64,
    ) -> (DVector<Number>, DMatrix<Number>, DVector<Number>) {
        let (own, own_jacobian) = self.isotropic(at.as_slice(), input);
        let (other, other_jacobian) = start.values(at);
        let (one, parameter) = (Number::from(1.0 - t), Number::from(t));
        let values = &other * one + &own * parameter;
        let jacobian = other_jacobian * one + own_jacobian * parameter;
        (values, jacobian, own - other)
    }
}

impl Equations {
    /// The equations at an input, and their derivatives, for positions z and their conjugates w as independent numbers, in this order. Each is of
    /// the first degree in the z and in the w.
    fn isotropic(&self, at: &[Number], input: f64) -> (DVector<Number>, DMatrix<Number>) {
        let m = self.joints.len();
        let complex = |v: Vector| Number::new(v.x, v.y);
        let [direction, squared] = if self.is_angle {
            let (cos, sin) = trig::cos_sin_deg(trig::degrees(input));
            [Number::new(cos, sin), Number::from(0.0)]
        } else {
            [Number::from(input), Number::from(input * input)]
        };
        // A form, and that of the conjugate positions.
        let pair = |form: &Form| {
            let known = complex(form.constant) + complex(form.input) * direction;
            let sum = |from: usize, of: &dyn Fn(Number) -> Number| {
                form.terms.iter().fold(of(known), |sum, &(k, factor)| sum + of(complex(factor)) * at[from + k])
            };
            [sum(0, &|c| c), sum(m, &|c| c.conj())]
        };
        let mut values = DVector::zeros(2 * m);
        let mut jacobian = DMatrix::zeros(2 * m, 2 * m);
        for (row, equation) in self.equations.iter().enumerate() {
            let ([e, e_bar], [f, f_bar]) = (pair(&equation.e), pair(&equation.f));
            // Half the sum of both products, or half their difference over i.
            let [plus, minus] = if equation.is_cross {
                [Number::new(0.0, -0.5), Number::new(0.0, 0.5)]
            } else {
                [Number::from(0.5); 2]
            };
            let factor = Number::from(equation.factor);
            let [value, of_square] = equation.value;
            let known = Number::from(value) + squared * of_square;
            values[row] = (plus * e_bar * f + minus * e * f_bar - known) * factor;
            let mut add = |form: &Form, [of_z, of_w]: [Number; 2]| {
                for &(k, own) in &form.terms {
                    jacobian[(row, k)] += complex(own) * of_z * factor;
                    jacobian[(row, m + k)] += complex(own).conj() * of_w * factor;
                }
            };
            add(&equation.f, [plus * e_bar, minus * e]);
            add(&equation.e, [minus * f_bar, plus * f]);
        }
        (values, jacobian)
    }
}

/// The greatest magnitude of a component.
trait GreatestNorm {
    fn amax_norm(&self) -> f64;
}

impl GreatestNorm for DVector<Number> {
    fn amax_norm(&self) -> f64 {
        self.iter().fold(0.0, |most: f64, value| most.max(value.norm()))
    }
}

impl StartSystem {
    /// Factors on the unit circle that look random: almost all keep paths from meeting.
    fn new(m: usize) -> StartSystem {
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let (cos, sin) = trig::cos_sin_deg((state >> 11) as f64 / (1u64 << 53) as f64 * 360.0);
            Number::new(cos, sin)
        };
        let factors = (0..2 * m).map(|_| [(); 2].map(|()| DVector::from_fn(m + 1, |_, _| next()))).collect();
        StartSystem { factors }
    }

    /// The solution at which the first factors of some equations vanish, and the second ones of the others.
    fn solution(&self, of_z: &[usize]) -> Option<DVector<Number>> {
        let m = of_z.len();
        let solve = |rows: Vec<&DVector<Number>>| {
            let matrix = DMatrix::from_fn(m, m, |row, column| rows[row][column]);
            matrix.lu().solve(&DVector::from_fn(m, |row, _| -rows[row][m]))
        };
        let z = solve(of_z.iter().map(|&row| &self.factors[row][0]).collect())?;
        let w = solve((0..2 * m).filter(|row| !of_z.contains(row)).map(|row| &self.factors[row][1]).collect())?;
        Some(DVector::from_iterator(2 * m, z.iter().chain(w.iter()).copied()))
    }

    fn values(&self, at: &DVector<Number>) -> (DVector<Number>, DMatrix<Number>) {
        let m = at.len() / 2;
        let factor = |row: usize, part: usize| {
            let own = &self.factors[row][part];
            (0..m).fold(own[m], |sum, k| sum + own[k] * at[part * m + k])
        };
        let of_z: Vec<Number> = (0..2 * m).map(|row| factor(row, 0)).collect();
        let of_w: Vec<Number> = (0..2 * m).map(|row| factor(row, 1)).collect();
        let values = DVector::from_fn(2 * m, |row, _| of_z[row] * of_w[row]);
        let jacobian = DMatrix::from_fn(2 * m, 2 * m, |row, column| match column.checked_sub(m) {
            None => self.factors[row][0][column] * of_w[row],
            Some(column) => self.factors[row][1][column] * of_z[row],
        });
        (values, jacobian)
    }
}

/// All subsets of so many of the numbers below `count`.
fn subsets(count: usize, size: usize) -> Vec<Vec<usize>> {
    let of_bits = |bits: u32| (0..count).filter(|k| bits >> k & 1 == 1).collect::<Vec<usize>>();
    (0..1u32 << count).filter(|bits| bits.count_ones() as usize == size).map(of_bits).collect()
}

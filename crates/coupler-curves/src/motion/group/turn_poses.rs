//! The poses of a full turn of a group, by Newton's method alone: for searches, which look at millions of linkages and prove what they find in the end.

use std::sync::Arc;

use super::equations::{Equations, Linearization};
use super::step::Factors;
use crate::geometry::trig;
use crate::motion::joint_series::SeriesInput;
use crate::motion::series::{Series, VectorSeries};

/// The longest step, the first, and the shortest, in radians.
const LONGEST: f64 = 0.3;
const FIRST: f64 = 0.05;
const SHORTEST: f64 = 0.01;

/// A pose may be this far from where the first two derivatives lead, in sizes of the linkage, or the step is shortened. What is between two poses
/// is then known to about the square of it, by the sixth part: a function that is analytic within a distance d of a step h misses its second
/// Taylor polynomial by (h/d)³, and the quintic of both ends by (h/d)⁶/64.
const CLOSE: f64 = 3e-4;

/// On the shortest step it may be this many times as far as the step is long.
const FARTHEST: f64 = 0.25;

/// Newton's method has found a pose when its correction is this small: what is left is of the order of the square.
const FOUND: f64 = 1e-8;
const MOST_CORRECTIONS: usize = 6;

/// The pose after a turn is that before it, to this part of the linkage's size.
const SAME: f64 = 1e-6;

/// The poses of a full turn of the input of a group, as a quintic in the input from each of its nodes to the next.
pub(super) struct Turn {
    pub equations: Arc<Equations>,
    /// In radians, rising; the last is a turn after the first.
    inputs: Vec<f64>,
    /// Of each node the unknowns, their first derivatives by the input, and their second.
    nodes: Vec<f64>,
}

impl Turn {
    /// The turn from a state on.
    pub fn from(equations: Equations, mut state: Vec<f64>) -> Option<Turn> {
        let n = equations.unknown_count();
        let mut at = Linearization::default();
        equations.linearized(&state, &mut at);
        let factors = equations.factors(&at, n);
        let mut turn = Turn { equations: Arc::new(equations), inputs: Vec::new(), nodes: Vec::new() };
        turn.push(&state, &at, &factors)?;
        let origin = state.clone();
        let end = origin[n] + std::f64::consts::TAU;
        let mut step = FIRST;
        while state[n] < end {
            // The last two are of the same length.
            let rest = end - state[n];
            let own = if rest <= step { rest } else { step.min(rest / 2.0) };
            let to = if own == rest { end } else { state[n] + own };
            let (found, off) = turn.step_to(to, &mut at, own <= SHORTEST);
            let factor = libm::cbrt(0.7 * CLOSE / off).clamp(0.25, 2.0);
            step = (own * factor).clamp(SHORTEST, LONGEST);
            let Some((next, factors)) = found else {
                if own <= SHORTEST {
                    return None;
                }
                step = step.min(own / 2.0).max(SHORTEST);
                continue;
            };
            turn.push(&next, &at, &factors)?;
            state = next;
        }
        let is_same = (0..n).all(|k| (state[k] - origin[k]).abs() < SAME);
        is_same.then_some(turn)
    }

    /// The state at an input after the last node, with the factors of the derivatives next to it, if it is where that leads; and how far it is from
    /// there.
    fn step_to(&self, to: f64, at: &mut Linearization, is_last: bool) -> (Option<(Vec<f64>, Factors)>, f64) {
        let n = self.equations.unknown_count();
        let [x, rate, curvature] = self.node(self.inputs.len() - 1);
        let by = to - self.inputs[self.inputs.len() - 1];
        let ahead = (0..n).map(|k| x[k] + by * (rate[k] + 0.5 * by * curvature[k]));
        let mut state: Vec<f64> = ahead.chain([to]).collect();
        let mut correction = Vec::with_capacity(n);
        let mut off = f64::NAN;
        for round in 0..MOST_CORRECTIONS {
            self.equations.linearized(&state, at);
            let factors = self.equations.factors(at, n);
            correction.clone_from(&at.residuals);
            if factors.solve(&mut correction).is_none() {
                return (None, f64::INFINITY);
            }
            let change = correction.iter().fold(0.0, |most: f64, change| most.max(change.abs()));
            if round == 0 {
                off = change;
                let longest = rate.iter().fold(1.0, |most: f64, rate| most.max(rate.abs()));
                let most = if is_last { FARTHEST * by * longest } else { CLOSE };
                if off.is_nan() || off > most {
                    return (None, off);
                }
            }
            state.iter_mut().zip(&correction).for_each(|(own, change)| *own -= change);
            if change <= FOUND {
                return (Some((state, factors)), off);
            }
        }
        (None, f64::INFINITY)
    }

    /// Adds a node, with the derivatives of the equations in it or next to it.
    fn push(&mut self, state: &[f64], at: &Linearization, factors: &Factors) -> Option<()> {
        let Equations { equations, .. } = &*self.equations;
        let n = self.equations.unknown_count();
        let mut first: Vec<f64> = (0..equations.len()).map(|row| -at.jacobian[row * (n + 1) + n]).collect();
        factors.solve(&mut first)?;
        let series = |k: usize| Series([state[k], first[k], 0.0]);
        let unknowns: Vec<VectorSeries<f64, 3>> =
            (0..n / 2).map(|k| VectorSeries { x: series(2 * k), y: series(2 * k + 1) }).collect();
        let value = trig::degrees(state[n]);
        let (cos, sin) = trig::cos_sin_deg(value);
        let residuals = self.equations.in_input(unknowns, SeriesInput { value, direction: [cos, sin] });
        let mut second: Vec<f64> = residuals.iter().map(|series| -2.0 * series.0[2]).collect();
        factors.solve(&mut second)?;
        self.inputs.push(state[n]);
        self.nodes.extend(state[..n].iter().chain(&first).chain(&second));
        Some(())
    }

    /// The unknowns of a node, and their derivatives.
    fn node(&self, number: usize) -> [&[f64]; 3] {
        let n = self.equations.unknown_count();
        std::array::from_fn(|order| &self.nodes[(3 * number + order) * n..][..n])
    }

    /// An input in degrees as it is on the nodes.
    pub fn own_input(&self, input: f64) -> f64 {
        let low = self.inputs[0];
        low + (trig::radians(input) - low).rem_euclid(std::f64::consts::TAU)
    }

    /// The state at an input of the turn, in radians.
    pub fn state(&self, input: f64) -> Vec<f64> {
        let next = self.inputs.partition_point(|own| *own < input).clamp(1, self.inputs.len() - 1);
        let ([a, da, dda], [b, db, ddb]) = (self.node(next - 1), self.node(next));
        let h = self.inputs[next] - self.inputs[next - 1];
        let u = (input - self.inputs[next - 1]) / h;
        // Hermite's polynomials.
        let (v, cube) = (1.0 - u, u * u * u);
        let to = cube * (10.0 + u * (6.0 * u - 15.0));
        let to_rate = h * cube * (-4.0 + u * (7.0 - 3.0 * u));
        let to_curvature = h * h * 0.5 * cube * v * v;
        let from_rate = h * u * (1.0 + u * u * (-6.0 + u * (8.0 - 3.0 * u)));
        let from_curvature = h * h * 0.5 * u * u * v * v * v;
        let quintic = |k: usize| {
            a[k] + to * (b[k] - a[k])
                + (from_rate * da[k] + to_rate * db[k])
                + (from_curvature * dda[k] + to_curvature * ddb[k])
        };
        (0..a.len()).map(quintic).chain([input]).collect()
    }

    /// The pose at an input of the turn, in radians.
    pub fn base(&self, input: f64) -> Base {
        let state = self.state(input);
        let mut at = Linearization::default();
        self.equations.linearized(&state, &mut at);
        let factors = self.equations.factors(&at, self.equations.unknown_count());
        Base { state, residuals: at.residuals, factors }
    }
}

/// A pose of a turn, with what the poses of all linkages that differ next to nothing from its are found by.
pub(super) struct Base {
    state: Vec<f64>,
    /// Rounding, and how far the quintic is off: the same of all.
    residuals: Vec<f64>,
    factors: Factors,
}

impl Base {
    /// The input, in radians.
    pub fn input(&self) -> f64 {
        self.state[self.state.len() - 1]
    }

    /// The state of such a linkage, from that of the turn's, to the square of the difference.
    pub fn state_of_neighbour(&self, own: &Equations, other: &Equations) -> Vec<f64> {
        let mut state = other.state_of(own, self.state.clone());
        let mut correction = other.residuals_in(&state);
        correction.iter_mut().zip(&self.residuals).for_each(|(there, here)| *there -= here);
        if self.factors.solve(&mut correction).is_some() {
            state.iter_mut().zip(&correction).for_each(|(own, change)| *own -= change);
        }
        state
    }
}

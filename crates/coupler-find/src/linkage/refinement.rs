//! The linkage near another one whose curve, placed by a similarity, is nearest to a target: Levenberg and Marquardt's method on the
//! free parameters and the similarity.

use nalgebra::{DMatrix, DVector};

use super::aim::{Aim, WEIGHT};
use super::circuit::Traced;
use super::space::LinkageSpace;
use super::state::State;
use crate::complex::{Complex, dot, length, times_i};
use coupler_curves::geometry::{Similarity, trig};

/// A linkage on its way to the target.
#[derive(Clone, Debug)]
pub struct LinkageRefinement {
    pub(super) values: Vec<f64>,
    /// The number of the traced joint, from 0.
    pub(super) trace: usize,
    /// Whether the target is followed against the positions on the curve.
    pub(super) is_reversed: bool,
    pub(super) state: State,
    /// Whether no step improves it.
    pub is_done: bool,
    damping: f64,
}

/// The damping at first.
const DAMPING: f64 = 1e-2;

/// Those at which a linkage is checked to be assembled in a step.
const CHECKED: usize = 64;

/// The rounds in which feet follow the curve in a step, and in the end.
const ROUNDS: usize = 6;
pub(super) const FINAL_ROUNDS: usize = 30;

impl LinkageRefinement {
    /// Begins with a curve that is placed on the target. `None` if it cannot be matched with it.
    pub(super) fn new(
        aim: &Aim,
        values: Vec<f64>,
        (trace, traced): (usize, Traced),
        placed: Similarity,
    ) -> Option<LinkageRefinement> {
        let (is_reversed, state) = aim.matched_either_way(&traced, placed, ROUNDS)?;
        Some(LinkageRefinement { values, trace, is_reversed, state, is_done: false, damping: DAMPING })
    }

    /// Begins with a curve at the inputs of a timed target.
    pub(super) fn timed(
        aim: &Aim,
        values: Vec<f64>,
        (trace, traced): (usize, Traced),
        placed: Similarity,
        (is_reversed, start): (bool, (usize, f64)),
    ) -> Option<LinkageRefinement> {
        let state = aim.timed_state(traced, placed, is_reversed, start)?;
        Some(LinkageRefinement { values, trace, is_reversed, state, is_done: false, damping: DAMPING })
    }

    /// The sum of the squares of the distances, in sizes of the target.
    pub fn sum(&self) -> f64 {
        self.state.sum
    }

    /// Takes some steps that move the curve and leave the parameters as they are.
    pub(super) fn place(&mut self, space: &LinkageSpace, aim: &Aim, steps: usize) {
        for _ in 0..steps {
            if !self.is_done {
                self.step((space, 0), aim);
            }
        }
        (self.is_done, self.damping) = (false, DAMPING);
    }

    /// Takes some steps; none of them, if the circuit is another one then.
    pub(super) fn advance(&mut self, space: &LinkageSpace, aim: &Aim, steps: usize) {
        if self.is_done {
            return;
        }
        let before = (self.values.clone(), self.state.clone());
        for _ in 0..steps {
            if self.is_done {
                break;
            }
            self.step((space, space.dimension()), aim);
        }
        let traced = &self.state.traced;
        let is_kept = |found: Traced| found.circuit.passes == traced.circuit.passes;
        if traced.has_fixed_passes() && !traced.followed(traced.linkage.clone()).is_some_and(is_kept) {
            (self.values, self.state) = before;
            self.is_done = true;
        }
    }

    /// Matches the target with the whole curve again, where its points may have found nearer places.
    pub(super) fn match_again(&mut self, aim: &Aim, rounds: usize) {
        if self.state.start.is_some() {
            return;
        }
        let state = aim.matched(self.state.traced.clone(), self.state.placed, self.is_reversed, rounds);
        if let Some(state) = state.filter(|state| state.objective < self.state.objective) {
            self.is_done &= self.state.objective - state.objective <= 1e-9 * state.objective;
            self.state = state;
        }
    }

    fn step(&mut self, (space, free): (&LinkageSpace, usize), aim: &Aim) {
        /// The most trials with more and more damping.
        const TRIALS: usize = 8;
        const MAX_DAMPING: f64 = 1e8;
        /// A relative gain that is no progress, and the mean square of distances that are rounding.
        const NO_GAIN: f64 = 1e-9;
        const EXACT: f64 = 1e-26;
        let Some((normal, gradient)) = self.normal_equations((space, free), aim) else {
            self.is_done = true;
            return;
        };
        let count = gradient.len();
        let trace = normal.trace().max(f64::MIN_POSITIVE);
        for _ in 0..TRIALS {
            let mut damped = normal.clone();
            for k in 0..count {
                // A parameter that moves no point is held by a small part of what holds the others.
                damped[(k, k)] += self.damping * normal[(k, k)].max(1e-9 * trace);
            }
            if let Some(matrix) = damped.cholesky() {
                let motion = matrix.solve(&gradient);
                let promised = 2.0 * gradient.dot(&motion) - motion.dot(&(&normal * &motion));
                if let Some((values, state)) = self.tried(&motion, space, aim) {
                    let gain = self.state.objective - state.objective;
                    self.is_done = gain <= NO_GAIN * self.state.objective || state.sum <= EXACT * aim.count();
                    match gain / promised.max(f64::MIN_POSITIVE) {
                        kept if kept > 0.75 => self.damping = (0.2 * self.damping).max(1e-12),
                        kept if kept < 0.25 => self.damping *= 3.0,
                        _ => {}
                    }
                    (self.values, self.state) = (values, state);
                    return;
                }
            }
            self.damping *= 6.0;
            if self.damping > MAX_DAMPING {
                break;
            }
        }
        self.is_done = true;
    }

    /// The values and the curve after a motion, if that satisfies what is asked of it and is nearer to the target.
    fn tried(&self, motion: &DVector<f64>, space: &LinkageSpace, aim: &Aim) -> Option<(Vec<f64>, State)> {
        let by: Vec<f64> = motion.iter().copied().collect();
        let free = by.len() - self.other_count();
        let values = if free == 0 { self.values.clone() } else { space.moved(&self.values, &by[..free]) };
        let other = &by[free..];
        let placed = Similarity {
            factor: self.state.placed.factor + Complex::new(other[0], other[1]),
            shift: self.state.placed.shift + Complex::new(other[2], other[3]),
            ..self.state.placed
        };
        let traced = match free {
            0 => Some(self.state.traced.clone()),
            _ => {
                let linkage = space.template.linkage(&values).ok().filter(|_| space.are_valid(&values))?;
                // All circuits are found in the end of several steps only: of a chain of dyads that takes long.
                let traced = self.state.traced.perturbed(linkage)?;
                let is_closed = !traced.has_fixed_passes() || traced.is_closed_at(&traced.positions(CHECKED));
                is_closed.then_some(traced)
            }
        }?;
        if aim.full_turn && !traced.is_full_turn() {
            return None;
        }
        let state = match self.state.start {
            Some((pass, input)) => {
                aim.timed_state(traced, placed, self.is_reversed, (pass, input + trig::degrees(other[4])))
            }
            None => {
                let near: Vec<f64> =
                    self.state.blocks.iter().flat_map(|block| block.points.clone().map(|_| block.position)).collect();
                aim.state(traced, placed, self.is_reversed, (near, ROUNDS))
            }
        }?;
        (state.objective < self.state.objective && aim.meets_condition(&values, &state.traced))
            .then_some((values, state))
    }

    /// The number of unknowns other than parameters: the similarity, and the input at the first point of a timed target.
    fn other_count(&self) -> usize {
        if self.state.start.is_some() { 5 } else { 4 }
    }

    /// The normal equations of the distances across the curve, or in both directions of the plane if the target is timed. The curves of
    /// other parameters are compared at the same positions, in which they are regular.
    fn normal_equations(
        &self,
        (space, free): (&LinkageSpace, usize),
        aim: &Aim,
    ) -> Option<(DMatrix<f64>, DVector<f64>)> {
        /// The change of a parameter in its unit.
        const STEP: f64 = 1e-6;
        let State { traced, placed, blocks, start, .. } = &self.state;
        let count = free + self.other_count();
        let positions: Vec<f64> = blocks.iter().map(|block| block.position).collect();
        let at = aim.points(traced, &positions, *start)?;
        let velocities = aim.velocities(traced, &positions, *start)?;
        let excesses = aim.excesses(traced, placed);
        // The motion of the points, and of the excesses, by each parameter.
        let mut columns: Vec<(Vec<Complex>, Vec<f64>)> = Vec::with_capacity(free);
        for k in 0..free {
            let motion = |step: f64| {
                let mut by = vec![0.0; free];
                by[k] = step;
                let values = space.moved(&self.values, &by);
                if values == self.values {
                    return None;
                }
                let linkage = space.template.linkage(&values).ok()?;
                let other = traced.perturbed(linkage)?;
                let points = aim.points(&other, &positions, *start)?;
                let moved = points.iter().zip(&at).map(|(b, a)| (b - a) / step).collect();
                let excess = aim.excesses(&other, placed).iter().zip(&excesses).map(|(b, a)| (b - a) / step).collect();
                Some((moved, excess))
            };
            let none = || (vec![Complex::new(0.0, 0.0); at.len()], vec![0.0; excesses.len()]);
            columns.push(motion(STEP).or_else(|| motion(-STEP)).unwrap_or_else(none));
        }
        let (mut normal, mut gradient) = (DMatrix::zeros(count, count), DVector::zeros(count));
        let mut add = |row: &[f64], distance: f64, weight: f64| {
            for j in 0..count {
                gradient[j] += weight * row[j] * distance;
                for k in 0..=j {
                    normal[(j, k)] += weight * row[j] * row[k];
                }
            }
        };
        let mut row = vec![0.0; count];
        for (n, block) in blocks.iter().enumerate() {
            let own = placed.reflected(at[n]);
            let velocity = placed.direction(velocities[n]);
            let offset = block.mean - placed.image(at[n]);
            let speed = length(velocity);
            let weight = block.points.len() as f64;
            let both = [Complex::new(1.0, 0.0), Complex::new(0.0, 1.0)];
            let axes: &[Complex] = match start.is_some() || speed <= 1e-9 * placed.scale() {
                // At a cusp the foot does not move along the curve.
                true => &both,
                false => &[times_i(velocity) / speed],
            };
            for axis in axes {
                for (entry, (moved, _)) in row.iter_mut().zip(&columns) {
                    *entry = dot(*axis, placed.direction(moved[n]));
                }
                row[free..free + 4].copy_from_slice(&[dot(*axis, own), dot(*axis, times_i(own)), axis.re, axis.im]);
                if start.is_some() {
                    row[free + 4] = dot(*axis, velocity);
                }
                add(&row, dot(*axis, offset), weight);
            }
        }
        let weight = WEIGHT * WEIGHT * aim.count();
        for (n, excess) in excesses.iter().enumerate().filter(|(_, excess)| **excess > 0.0) {
            for (entry, (_, moved)) in row.iter_mut().zip(&columns) {
                *entry = moved[n];
            }
            for (k, entry) in row[free..].iter_mut().enumerate() {
                let mut other = *placed;
                match k {
                    0 => other.factor.re += STEP,
                    1 => other.factor.im += STEP,
                    2 => other.shift.re += STEP,
                    3 => other.shift.im += STEP,
                    _ => {}
                }
                *entry = (aim.excesses(traced, &other)[n] - excess) / STEP;
            }
            add(&row, -excess, weight);
        }
        normal.fill_upper_triangle_with_lower_triangle();
        Some((normal, gradient))
    }
}

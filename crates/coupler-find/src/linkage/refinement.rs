//! The linkage near another one whose curve, placed by a similarity, is nearest to a target: Levenberg and Marquardt's method on the
//! free parameters and the similarity.

use nalgebra::{DVector, Dyn};

use super::aim::{Aim, WEIGHT};
use super::circuit::Traced;
use super::space::LinkageSpace;
use super::state::State;
use crate::complex::{Complex, dot, length};
use crate::curve::alignment::{axes, moved_similarity, similarity_rates};
use crate::descent::{Candidate, Descent, Equations};
use coupler_curves::geometry::{Similarity, trig};

/// A linkage on its way to the target.
#[derive(Clone, Debug)]
pub(super) struct LinkageRefinement {
    pub(super) values: Vec<f64>,
    /// The number of the traced joint, from 0.
    pub(super) trace: usize,
    /// Whether the target is followed against the positions on the curve.
    pub(super) is_reversed: bool,
    pub(super) state: State,
    /// Whether its distances are those of few points of the target.
    pub(super) has_few_points: bool,
    descent: Descent,
}

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
        let has_few_points = aim.has_few_points;
        Some(LinkageRefinement { values, trace, is_reversed, state, has_few_points, descent: Descent::default() })
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
        let has_few_points = aim.has_few_points;
        Some(LinkageRefinement { values, trace, is_reversed, state, has_few_points, descent: Descent::default() })
    }

    /// The mean of the squares of the distances, in sizes of the target.
    pub fn mean_square(&self) -> f64 {
        let count = self.state.blocks.last().map_or(1, |block| block.points.end);
        self.state.sum / count as f64
    }

    /// The same curve on all points of the target. `None` if it cannot be matched with them.
    pub(super) fn on_all_points(self, aim: &Aim) -> Option<LinkageRefinement> {
        let State { traced, placed, .. } = self.state;
        let state = aim.matched(traced, placed, self.is_reversed, ROUNDS)?;
        Some(LinkageRefinement { state, has_few_points: false, descent: Descent::default(), ..self })
    }

    /// Whether no step improves it.
    pub fn is_done(&self) -> bool {
        self.descent.is_done
    }

    /// Takes some steps that move the curve and leave the parameters as they are.
    pub(super) fn place(&mut self, space: &LinkageSpace, aim: &Aim, steps: usize) {
        for _ in 0..steps {
            self.step((space, 0), aim);
        }
        self.descent = Descent::default();
    }

    /// Takes some steps; none of them, if the circuit is another one then.
    pub(super) fn advance(&mut self, space: &LinkageSpace, aim: &Aim, steps: usize) {
        if self.descent.is_done {
            return;
        }
        let before = (self.values.clone(), self.state.clone());
        for _ in 0..steps {
            if self.descent.is_done {
                break;
            }
            self.step((space, space.dimension()), aim);
        }
        let traced = &self.state.traced;
        let is_kept = |found: Traced| traced.is_on(&found.circuit.passes);
        if traced.has_fixed_passes()
            && !traced.is_followed()
            && !traced.followed(traced.linkage.clone()).is_some_and(is_kept)
        {
            (self.values, self.state) = before;
            self.descent.is_done = true;
        }
    }

    /// Matches the target with the whole curve again, where its points may have found nearer places.
    pub(super) fn match_again(&mut self, aim: &Aim, rounds: usize) {
        if self.state.start.is_some() {
            return;
        }
        let state = aim.matched(self.state.traced.clone(), self.state.placed, self.is_reversed, rounds);
        if let Some(state) = state.filter(|state| state.objective < self.state.objective) {
            self.descent.is_done &= self.state.objective - state.objective <= 1e-9 * state.objective;
            self.state = state;
        }
    }

    fn step(&mut self, (space, free): (&LinkageSpace, usize), aim: &Aim) {
        let mut descent = self.descent;
        descent.step(self, &Task { space, free, aim });
        self.descent = descent;
    }

    /// The number of unknowns other than parameters: the similarity, and the input at the first point of a timed target.
    fn other_count(&self) -> usize {
        if self.state.start.is_some() { 5 } else { 4 }
    }
}

/// What a refinement aims at: the first of the free parameters that move, all or none.
pub(crate) struct Task<'a> {
    space: &'a LinkageSpace,
    free: usize,
    aim: &'a Aim,
}

impl Candidate for LinkageRefinement {
    type Unknowns = Dyn;
    type Aim<'a> = Task<'a>;
    const NO_GAIN: f64 = 1e-9;

    fn objective(&self) -> f64 {
        self.state.objective
    }

    fn is_exact(&self, Task { aim, .. }: &Task<'_>) -> bool {
        /// The mean square of distances that are rounding.
        const EXACT: f64 = 1e-26;
        self.state.sum <= EXACT * aim.count()
    }

    /// Those of the distances across the curve, or in both directions of the plane if the target is timed. The curves of other parameters are
    /// compared at the same positions, in which they are regular.
    fn equations(&self, &Task { space, free, aim }: &Task<'_>) -> Option<Equations<Dyn>> {
        /// The change of a parameter in its unit.
        const STEP: f64 = 1e-6;
        let State { traced, placed, blocks, start, .. } = &self.state;
        let count = free + self.other_count();
        let positions = self.state.positions();
        // Those of all linkages, where they do not depend on the dimensions.
        let places = traced.has_fixed_passes().then(|| aim.places(traced, &positions, *start)).flatten();
        let rates = self.state.rates(aim)?;
        let excesses = aim.excesses(traced, placed);
        let known = places.as_ref().filter(|_| free > 0);
        let base = known.map_or_else(|| traced.clone(), |places| traced.based_at(places));
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
                let other = base.perturbed(linkage)?;
                let points = match &places {
                    Some(places) => other.points_at(places)?,
                    None => other.points_at(&aim.places(&other, &positions, *start)?)?,
                };
                let moved = points.iter().zip(blocks).map(|(moved, block)| (moved - block.foot.at) / step).collect();
                let excess = aim.excesses(&other, placed).iter().zip(&excesses).map(|(b, a)| (b - a) / step).collect();
                Some((moved, excess))
            };
            let none = || (vec![Complex::new(0.0, 0.0); blocks.len()], vec![0.0; excesses.len()]);
            columns.push(motion(STEP).or_else(|| motion(-STEP)).unwrap_or_else(none));
        }
        let mut equations = Equations::new(Dyn(count));
        let mut row = vec![0.0; count];
        for (n, block) in blocks.iter().enumerate() {
            let at = block.foot.at;
            let velocity = placed.direction(rates[n].velocity);
            let offset = block.mean - placed.image(at);
            let speed = length(velocity);
            let weight = block.points.len() as f64;
            // At a cusp the foot does not move along the curve.
            let is_foot = start.is_none() && speed > 1e-9 * placed.scale();
            for axis in axes(velocity, is_foot) {
                for (entry, (moved, _)) in row.iter_mut().zip(&columns) {
                    *entry = dot(axis, placed.direction(moved[n]));
                }
                row[free..free + 4].copy_from_slice(&similarity_rates(axis, placed.reflected(at)));
                if start.is_some() {
                    row[free + 4] = dot(axis, velocity);
                }
                equations.add(&row, dot(axis, offset), weight);
            }
        }
        let weight = WEIGHT * WEIGHT * aim.count();
        for (n, excess) in excesses.iter().enumerate().filter(|(_, excess)| **excess > 0.0) {
            for (entry, (_, moved)) in row.iter_mut().zip(&columns) {
                *entry = moved[n];
            }
            for (k, entry) in row[free..].iter_mut().enumerate() {
                let by = std::array::from_fn(|n| if n == k { STEP } else { 0.0 });
                let other = moved_similarity(placed, by);
                *entry = (aim.excesses(traced, &other)[n] - excess) / STEP;
            }
            equations.add(&row, -excess, weight);
        }
        Some(equations)
    }

    fn moved(&self, &Task { space, free, aim }: &Task<'_>, motion: &DVector<f64>) -> Option<LinkageRefinement> {
        let by = motion.as_slice();
        let values = if free == 0 { self.values.clone() } else { space.moved(&self.values, &by[..free]) };
        let other = &by[free..];
        let placed = moved_similarity(&self.state.placed, [other[0], other[1], other[2], other[3]]);
        let traced = match free {
            0 => Some(self.state.traced.clone()),
            _ => {
                let linkage = space.template.linkage(&values).ok().filter(|_| space.are_valid(&values))?;
                // All circuits are found in the end of several steps only: of a chain of dyads that takes long.
                let traced = self.state.traced.moved(linkage)?;
                let are_closed =
                    || traced.poses(&traced.places(&traced.positions(CHECKED))).are_closed(&traced.linkage);
                let is_closed = !traced.has_fixed_passes() || are_closed();
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
            None => aim.state(traced, placed, self.is_reversed, self.state.near(aim, ROUNDS)),
        }?;
        let is_nearer = state.objective < self.state.objective && aim.meets_condition(&values, &state.traced);
        is_nearer.then_some(LinkageRefinement { values, state, ..*self })
    }
}

//! The linkage near another one whose curve, placed by a similarity, is nearest to a target: Levenberg and Marquardt's method on the
//! free parameters and the similarity.

use nalgebra::{DMatrix, DVector};

use super::aim::{Aim, Placed, WEIGHT};
use super::circuit::Traced;
use super::space::LinkageSpace;
use crate::find::complex::{Complex, dot, length, mean, times_i};
use crate::find::matching::match_places;

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

/// A curve on the target.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub traced: Traced,
    pub placed: Placed,
    /// The points of the target in order, in blocks that share a position.
    pub blocks: Vec<Block>,
    /// If the target is timed, the pass, and the input at its first point.
    pub start: Option<(usize, f64)>,
    /// The sum of the squares of the distances.
    pub sum: f64,
    /// The sum with what the limits add to it.
    objective: f64,
}

/// Points that follow each other and share a position on the curve, the foot of their mean. If the target is timed, the position is
/// the input.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub points: std::ops::Range<usize>,
    pub mean: Complex,
    pub position: f64,
}

/// The damping at first.
const DAMPING: f64 = 1e-2;

/// The samples of a curve with which a target is matched.
const SAMPLES: usize = 180;

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
        placed: Placed,
    ) -> Option<LinkageRefinement> {
        let matched = [false, true].into_iter().filter_map(|is_reversed| {
            let state = aim.matched(traced.clone(), placed, is_reversed, ROUNDS)?;
            Some((is_reversed, state))
        });
        let (is_reversed, state) = matched.min_by(|a, b| a.1.sum.total_cmp(&b.1.sum))?;
        Some(LinkageRefinement { values, trace, is_reversed, state, is_done: false, damping: DAMPING })
    }

    /// Begins with a curve at the inputs of a timed target.
    pub(super) fn timed(
        aim: &Aim,
        values: Vec<f64>,
        (trace, traced): (usize, Traced),
        placed: Placed,
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
        let placed = Placed {
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
                aim.timed_state(traced, placed, self.is_reversed, (pass, input + trig_degrees(other[4])))
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
            let velocity = placed.factor * placed.reflected(velocities[n]);
            let offset = block.mean - placed.apply(at[n]);
            let speed = length(velocity);
            let weight = block.points.len() as f64;
            let both = [Complex::new(1.0, 0.0), Complex::new(0.0, 1.0)];
            let axes: &[Complex] = match start.is_some() || speed <= 1e-9 * length(placed.factor) {
                // At a cusp the foot does not move along the curve.
                true => &both,
                false => &[times_i(velocity) / speed],
            };
            for axis in axes {
                for (entry, (moved, _)) in row.iter_mut().zip(&columns) {
                    *entry = dot(*axis, placed.factor * placed.reflected(moved[n]));
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

fn trig_degrees(radians: f64) -> f64 {
    crate::geometry::trig::degrees(radians)
}

impl Aim {
    /// A curve that is matched with the target in order, anywhere on it.
    pub(super) fn matched(&self, traced: Traced, placed: Placed, is_reversed: bool, rounds: usize) -> Option<State> {
        let positions = traced.positions(SAMPLES);
        let samples: Vec<Complex> = traced.points(&positions)?.into_iter().map(|z| placed.apply(z)).collect();
        let points = self.points_of(is_reversed);
        let (_, path) = match_places((points.len(), 4), samples.len(), |k, j| (samples[j] - points[k]).norm_sqr())?;
        let count = positions.len();
        let near = path.iter().map(|k| positions[k % count] + traced.period() * (k / count) as f64).collect();
        self.state(traced, placed, is_reversed, (near, rounds))
    }

    /// A curve with the feet of the target's points near some positions, in their order.
    pub(super) fn state(
        &self,
        traced: Traced,
        placed: Placed,
        is_reversed: bool,
        (near, rounds): (Vec<f64>, usize),
    ) -> Option<State> {
        let points = self.points_of(is_reversed);
        let blocks = blocks(&traced, &placed, (points, near), rounds)?;
        let positions: Vec<f64> = blocks.iter().map(|block| block.position).collect();
        let at = traced.points(&positions)?;
        let squares = blocks.iter().zip(&at).flat_map(|(block, z)| {
            let image = placed.apply(*z);
            points[block.points.clone()].iter().map(move |point| (point - image).norm_sqr())
        });
        let sum = squares.sum();
        let objective = sum + self.penalty(&traced, &placed);
        Some(State { traced, placed, blocks, start: None, sum, objective })
    }

    /// A curve at the inputs of a timed target.
    pub(super) fn timed_state(
        &self,
        traced: Traced,
        placed: Placed,
        is_reversed: bool,
        (pass, input): (usize, f64),
    ) -> Option<State> {
        let angles = self.angles_deg.as_ref()?;
        let sign = if is_reversed { -1.0 } else { 1.0 };
        let inputs: Vec<f64> = angles.iter().map(|angle| input + sign * angle).collect();
        let at = traced.points_at_inputs(pass, &inputs)?;
        let points = self.points_of(false);
        let sum = points.iter().zip(&at).map(|(point, z)| (point - placed.apply(*z)).norm_sqr()).sum();
        let block = |(k, position): (usize, f64)| Block { points: k..k + 1, mean: points[k], position };
        let blocks = inputs.into_iter().enumerate().map(block).collect();
        let objective = sum + self.penalty(&traced, &placed);
        Some(State { traced, placed, blocks, start: Some((pass, input)), sum, objective })
    }

    fn penalty(&self, traced: &Traced, placed: &Placed) -> f64 {
        let squares: f64 = self.excesses(traced, placed).iter().map(|excess| excess * excess).sum();
        WEIGHT * WEIGHT * self.count() * squares
    }

    /// The points at positions, which are inputs if the target is timed.
    pub(super) fn points(
        &self,
        traced: &Traced,
        positions: &[f64],
        start: Option<(usize, f64)>,
    ) -> Option<Vec<Complex>> {
        match start {
            Some((pass, _)) => traced.points_at_inputs(pass, positions),
            None => traced.points(positions),
        }
    }

    /// The derivatives of the points by the position, or by the input in radians if the target is timed.
    fn velocities(&self, traced: &Traced, positions: &[f64], start: Option<(usize, f64)>) -> Option<Vec<Complex>> {
        /// Of an angle in radians.
        const STEP: f64 = 1e-5;
        let (step, unit) = if start.is_some() { (trig_degrees(STEP), STEP) } else { (STEP, STEP) };
        let [before, after] = [-step, step].map(|step| {
            let moved: Vec<f64> = positions.iter().map(|position| position + step).collect();
            self.points(traced, &moved, start)
        });
        Some(after?.iter().zip(&before?).map(|(b, a)| (b - a) / (2.0 * unit)).collect())
    }
}

/// The feet of points in their order. Where those of neighbours would change it, these share the foot of their mean: of all common
/// feet it has the least sum of squares (pool adjacent violators).
fn blocks(
    traced: &Traced,
    placed: &Placed,
    (points, mut near): (&[Complex], Vec<f64>),
    rounds: usize,
) -> Option<Vec<Block>> {
    feet(traced, placed, points, &mut near, rounds)?;
    let mut blocks: Vec<Block> = Vec::with_capacity(points.len());
    for (k, position) in near.into_iter().enumerate() {
        let mut block = Block { points: k..k + 1, mean: points[k], position };
        while let Some(last) = blocks.pop() {
            if last.position <= block.position {
                blocks.push(last);
                break;
            }
            let of = last.points.start..block.points.end;
            let (mean, mut position) = ([mean(&points[of.clone()])], [last.position]);
            feet(traced, placed, &mean, &mut position, rounds)?;
            block = Block { points: of, mean: mean[0], position: position[0] };
        }
        blocks.push(block);
    }
    Some(blocks)
}

/// Moves positions to where the distances from points are least among their neighbours: Newton's method for all of them at once, each
/// step of which comes nearer.
fn feet(traced: &Traced, placed: &Placed, points: &[Complex], positions: &mut [f64], rounds: usize) -> Option<()> {
    /// The interval of positions from which derivatives are computed.
    const STEP: f64 = 1e-4;
    /// The greatest step.
    const MOST: f64 = 0.1;
    /// A foot is found when the sine of the angle between the perpendicular and the curve is this small; the distance is then exact to
    /// rounding.
    const PERPENDICULAR: f64 = 1e-10;
    let scale = length(placed.factor);
    let own: Vec<Complex> = points.iter().map(|point| placed.inverse(*point)).collect();
    let mut best = vec![f64::INFINITY; points.len()];
    let mut steps = vec![0.0; points.len()];
    let mut open: Vec<usize> = (0..points.len()).collect();
    for _ in 0..=rounds {
        let trial = |n: &usize| positions[*n] + steps[*n];
        let all: Vec<f64> =
            open.iter().map(trial).flat_map(|position| [position - STEP, position, position + STEP]).collect();
        let at = traced.points(&all)?;
        let mut still_open = Vec::with_capacity(open.len());
        for (n, at) in open.iter().zip(at.as_chunks::<3>().0) {
            let offset = own[*n] - at[1];
            let square = offset.norm_sqr();
            if square >= best[*n] {
                steps[*n] *= 0.25;
                if steps[*n].abs() > 1e-12 {
                    still_open.push(*n);
                }
                continue;
            }
            positions[*n] += steps[*n];
            best[*n] = square;
            let velocity = (at[2] - at[0]) / (2.0 * STEP);
            let acceleration = (at[2] - at[1] * 2.0 + at[0]) / (STEP * STEP);
            let (slope, speed) = (dot(offset, velocity), velocity.norm_sqr());
            if slope * slope <= PERPENDICULAR * PERPENDICULAR * speed * square || square * scale * scale <= 1e-32 {
                continue;
            }
            let newton = speed - dot(offset, acceleration);
            let step = slope / if newton > 0.1 * speed { newton } else { speed };
            steps[*n] = step.clamp(-MOST, MOST);
            still_open.push(*n);
        }
        open = still_open;
        if open.is_empty() {
            break;
        }
    }
    Some(())
}

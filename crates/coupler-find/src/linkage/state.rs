//! A curve on the target: the points of the target in their order, each with its place on the curve.

use super::aim::{Aim, WEIGHT};
use super::circuit::Traced;
use crate::complex::{Complex, dot};
use crate::matching::{Block, feet_in_order, match_places, squares};
use coupler_curves::geometry::{Similarity, trig};

/// A curve on the target.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub traced: Traced,
    pub placed: Similarity,
    /// The points of the target in order, in blocks that share a position.
    pub blocks: Vec<Block<f64>>,
    /// If the target is timed, the pass, and the input at its first point.
    pub start: Option<(usize, f64)>,
    /// The sum of the squares of the distances.
    pub sum: f64,
    /// The sum with what the limits add to it.
    pub objective: f64,
}

/// The samples of a curve with which a target is matched.
const SAMPLES: usize = 180;

impl Aim {
    /// A curve that is matched with the target in order, anywhere on it.
    pub(super) fn matched(
        &self,
        traced: Traced,
        placed: Similarity,
        is_reversed: bool,
        rounds: usize,
    ) -> Option<State> {
        let positions = traced.positions(SAMPLES);
        let samples: Vec<Complex> = traced.points(&positions)?.into_iter().map(|z| placed.image(z)).collect();
        let points = self.points_of(is_reversed);
        let (_, path) = match_places((points.len(), 4), samples.len(), |k, j| (samples[j] - points[k]).norm_sqr())?;
        let count = positions.len();
        let near = path.iter().map(|k| positions[k % count] + traced.period() * (k / count) as f64).collect();
        self.state(traced, placed, is_reversed, (near, rounds))
    }

    /// The same in the direction in which it is nearer to the target: whether the target is reversed, and the curve.
    pub(super) fn matched_either_way(
        &self,
        traced: &Traced,
        placed: Similarity,
        rounds: usize,
    ) -> Option<(bool, State)> {
        let matched = [false, true].into_iter().filter_map(|is_reversed| {
            let state = self.matched(traced.clone(), placed, is_reversed, rounds)?;
            Some((is_reversed, state))
        });
        matched.min_by(|a, b| a.1.sum.total_cmp(&b.1.sum))
    }

    /// A curve with the feet of the target's points near some positions, in their order.
    pub(super) fn state(
        &self,
        traced: Traced,
        placed: Similarity,
        is_reversed: bool,
        (near, rounds): (Vec<f64>, usize),
    ) -> Option<State> {
        let points = self.points_of(is_reversed);
        let mut first = near;
        feet(&traced, &placed, points, &mut first, rounds)?;
        let foot_near = |mean, near| {
            let mut foot = [near];
            feet(&traced, &placed, &[mean], &mut foot, rounds)?;
            Some(foot[0])
        };
        let blocks = feet_in_order(points, first, |position| *position, foot_near)?;
        let positions: Vec<f64> = blocks.iter().map(|block| block.foot).collect();
        let at: Vec<Complex> = traced.points(&positions)?.into_iter().map(|z| placed.image(z)).collect();
        let sum = squares(points, &blocks, &at).iter().sum();
        let objective = sum + self.penalty(&traced, &placed);
        Some(State { traced, placed, blocks, start: None, sum, objective })
    }

    /// A curve at the inputs of a timed target.
    pub(super) fn timed_state(
        &self,
        traced: Traced,
        placed: Similarity,
        is_reversed: bool,
        (pass, input): (usize, f64),
    ) -> Option<State> {
        let angles = self.angles_deg.as_ref()?;
        let sign = if is_reversed { -1.0 } else { 1.0 };
        let inputs: Vec<f64> = angles.iter().map(|angle| input + sign * angle).collect();
        let at = traced.points_at_inputs(pass, &inputs)?;
        let points = self.points_of(false);
        let sum = points.iter().zip(&at).map(|(point, z)| (point - placed.image(*z)).norm_sqr()).sum();
        let block = |(k, position): (usize, f64)| Block { points: k..k + 1, mean: points[k], foot: position };
        let blocks = inputs.into_iter().enumerate().map(block).collect();
        let objective = sum + self.penalty(&traced, &placed);
        Some(State { traced, placed, blocks, start: Some((pass, input)), sum, objective })
    }

    fn penalty(&self, traced: &Traced, placed: &Similarity) -> f64 {
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
    pub(super) fn velocities(
        &self,
        traced: &Traced,
        positions: &[f64],
        start: Option<(usize, f64)>,
    ) -> Option<Vec<Complex>> {
        /// Of an angle in radians.
        const STEP: f64 = 1e-5;
        let (step, unit) = if start.is_some() { (trig::degrees(STEP), STEP) } else { (STEP, STEP) };
        let [before, after] = [-step, step].map(|step| {
            let moved: Vec<f64> = positions.iter().map(|position| position + step).collect();
            self.points(traced, &moved, start)
        });
        Some(after?.iter().zip(&before?).map(|(b, a)| (b - a) / (2.0 * unit)).collect())
    }
}

/// Moves positions to where the distances from points are least among their neighbours: Newton's method for all of them at once, each
/// step of which comes nearer.
fn feet(traced: &Traced, placed: &Similarity, points: &[Complex], positions: &mut [f64], rounds: usize) -> Option<()> {
    /// The interval of positions from which derivatives are computed.
    const STEP: f64 = 1e-4;
    /// The greatest step.
    const MOST: f64 = 0.1;
    /// A foot is found when the sine of the angle between the perpendicular and the curve is this small; the distance is then exact to
    /// rounding.
    const PERPENDICULAR: f64 = 1e-10;
    let scale = placed.scale();
    let own: Vec<Complex> = points.iter().map(|point| placed.preimage(*point)).collect();
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

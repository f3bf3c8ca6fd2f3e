//! A curve on the target: the points of the target in their order, each with its place on the curve.

use std::sync::OnceLock;

use super::aim::{Aim, WEIGHT};
use super::circuit::Traced;
use super::feet::{Foot, Near, Rates, feet};
use super::poses::Places;
use crate::complex::Complex;
use crate::matching::{Block, feet_in_order, feet_of_points, match_places, squares};
use coupler_curves::geometry::{Similarity, trig};

/// A curve on the target.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub traced: Traced,
    pub placed: Similarity,
    /// The points of the target in order, in blocks that share a place.
    pub blocks: Vec<Block<Foot>>,
    /// The derivatives at the places of the blocks, once they are needed.
    rates: OnceLock<Option<Vec<Rates>>>,
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
        self.state(traced, placed, is_reversed, Near { positions: near, rates: None, rounds })
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
    pub(super) fn state(&self, traced: Traced, placed: Similarity, is_reversed: bool, near: Near) -> Option<State> {
        let points = self.points_of(is_reversed);
        let rounds = near.rounds;
        let first = feet(&traced, &placed, points, near)?;
        let foot_near = |mean, last: Foot| {
            let near = Near { positions: vec![last.position], rates: None, rounds };
            Some(feet(&traced, &placed, &[mean], near)?[0])
        };
        let blocks = feet_in_order(points, first, |foot| foot.position, foot_near)?;
        let at: Vec<Complex> = blocks.iter().map(|block| placed.image(block.foot.at)).collect();
        let sum = squares(points, &blocks, &at).iter().sum();
        let objective = sum + self.penalty(&traced, &placed);
        Some(State { traced, placed, blocks, rates: OnceLock::new(), start: None, sum, objective })
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
        let at = traced.points_at(&traced.places_at_inputs(pass, &inputs)?)?;
        let points = self.points_of(false);
        let sum = points.iter().zip(&at).map(|(point, z)| (point - placed.image(*z)).norm_sqr()).sum();
        let block =
            |k: usize| Block { points: k..k + 1, mean: points[k], foot: Foot { position: inputs[k], at: at[k] } };
        let blocks = (0..inputs.len()).map(block).collect();
        let objective = sum + self.penalty(&traced, &placed);
        Some(State { traced, placed, blocks, rates: OnceLock::new(), start: Some((pass, input)), sum, objective })
    }

    fn penalty(&self, traced: &Traced, placed: &Similarity) -> f64 {
        let squares: f64 = self.excesses(traced, placed).iter().map(|excess| excess * excess).sum();
        WEIGHT * WEIGHT * self.count() * squares
    }

    /// The places of positions, which are inputs if the target is timed.
    pub(super) fn places(&self, traced: &Traced, positions: &[f64], start: Option<(usize, f64)>) -> Option<Places> {
        match start {
            Some((pass, _)) => traced.places_at_inputs(pass, positions),
            None => Some(traced.places(positions)),
        }
    }
}

impl State {
    /// The positions of the blocks, which are inputs if the target is timed.
    pub fn positions(&self) -> Vec<f64> {
        self.blocks.iter().map(|block| block.foot.position).collect()
    }

    /// The derivatives at the places of the blocks, by the position, or by the input in radians if the target is timed.
    pub fn rates(&self, aim: &Aim) -> Option<&[Rates]> {
        /// Of an angle in radians.
        const STEP: f64 = 1e-5;
        let compute = || {
            let step = if self.start.is_some() { trig::degrees(STEP) } else { STEP };
            let moved = |by: f64| {
                let positions: Vec<f64> = self.blocks.iter().map(|block| block.foot.position + by).collect();
                self.traced.points_at(&aim.places(&self.traced, &positions, self.start)?)
            };
            let (before, after) = (moved(-step)?, moved(step)?);
            let both = before.iter().zip(&after).zip(&self.blocks);
            Some(both.map(|((before, after), block)| Rates::new([*before, block.foot.at, *after], STEP)).collect())
        };
        self.rates.get_or_init(compute).as_deref()
    }

    /// Where the points are near on a curve that differs little.
    pub fn near(&self, aim: &Aim, rounds: usize) -> Near {
        let positions = feet_of_points(&self.blocks).map(|foot| foot.position).collect();
        let each = |rates: &[Rates]| {
            let of_blocks = self.blocks.iter().zip(rates);
            of_blocks.flat_map(|(block, rates)| std::iter::repeat_n(*rates, block.points.len())).collect()
        };
        // Where limits move, what is at a position does not change little.
        let rates = self.rates(aim).filter(|_| self.traced.has_fixed_passes());
        Near { positions, rates: rates.map(each), rounds }
    }
}

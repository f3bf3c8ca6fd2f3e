//! The linkage near another one whose curve is nearest to a target: Levenberg and Marquardt's method on nine parameters.

use crate::complex::{Complex, dot, length, times_i};
use crate::descent::{Candidate, Descent, Equations};
use crate::four_bar::limits::Limits;
use crate::four_bar::nearest_pose::PoseRates;
use crate::four_bar::parameters::{COUNT, Motion, Parameters};
use crate::four_bar::pose::Pose;
use crate::four_bar::timing::{self, Timing};
use nalgebra::{Cholesky, Const};

/// A linkage on its way to the target.
#[derive(Clone, Debug)]
pub(crate) struct Refinement {
    pub linkage: Parameters,
    /// The pose for each point of the target.
    pub poses: Vec<Pose>,
    /// The sum of the squares of the distances.
    pub sum: f64,
    pub descent: Descent,
    is_frame_longer: bool,
    /// Whether the limit of the curve's length has been met.
    is_long: bool,
    /// If the target is timed.
    timing: Option<Timing>,
}

/// The number of Newton rounds in which a foot follows its curve.
const FOOT_ROUNDS: usize = 4;

impl Refinement {
    /// Begins with a linkage that satisfies the limits, and a pose for each point of the target.
    pub fn new(linkage: Parameters, poses: &[Pose], target: &[Complex], timing: Option<Timing>) -> Option<Refinement> {
        let (poses, sum) = feet(&linkage, poses, target, timing.as_ref())?;
        let is_frame_longer = linkage.frame >= linkage.crank;
        Some(Refinement { linkage, poses, sum, descent: Descent::default(), is_frame_longer, is_long: false, timing })
    }

    /// The timing in the direction that it follows, if the target is timed.
    pub fn timing(&self) -> Option<&Timing> {
        self.timing.as_ref()
    }

    /// Takes one step.
    pub fn step(&mut self, target: &[Complex], limits: &Limits) {
        let mut descent = self.descent;
        descent.step(self, &(target, limits));
        self.descent = descent;
    }

    /// The normal equations of the distances across the curve: along it, the feet move by themselves.
    fn free_equations(&self, target: &[Complex]) -> Equations<Const<COUNT>> {
        /// Slower than this part of a radian's motion, the point is at a cusp, and its offset is the direction that counts.
        const CUSP: f64 = 1e-6;
        let small = 1e-7 * (self.sum / target.len() as f64).sqrt();
        let linkage = &self.linkage;
        let mut equations = Equations::new(Const::<COUNT>);
        for (pose, point) in self.poses.iter().zip(target) {
            let rates = PoseRates::new(linkage, pose);
            let (offset, velocity) = (point - rates.at, rates.velocity());
            let (distance, speed) = (length(offset), length(velocity));
            let across = match speed > CUSP || distance <= small {
                true => times_i(velocity) / speed.max(f64::MIN_POSITIVE),
                false => offset / distance,
            };
            equations.add(&rates.row_of_curve(linkage, pose, across), dot(across, offset), 1.0);
        }
        equations
    }

    /// The normal equations of the distances of a timed target, in both directions of the plane: the offset of the input moves by
    /// itself (variable projection).
    fn timed_equations(&self, target: &[Complex]) -> Equations<Const<COUNT>> {
        let linkage = &self.linkage;
        let mut equations = Equations::new(Const::<COUNT>);
        // By the offset: its products with the rows, with itself and with the distances.
        let (mut mixed, mut square, mut slope) = ([0.0; COUNT], 0.0, 0.0);
        for (pose, point) in self.poses.iter().zip(target) {
            let rates = PoseRates::new(linkage, pose);
            let (offset, velocity) = (point - rates.at, timing::velocity(&rates));
            for axis in [Complex::new(1.0, 0.0), Complex::new(0.0, 1.0)] {
                // At a given angle of the crank the coupler closes the linkage.
                let closing = dot(axis, rates.by_angles[1]) / timing::closure_rate(&rates);
                let row = rates.row(linkage, pose, axis, closing);
                let (distance, rate) = (dot(axis, offset), dot(axis, velocity));
                equations.add(&row, distance, 1.0);
                mixed.iter_mut().zip(&row).for_each(|(sum, entry)| *sum += entry * rate);
                square += rate * rate;
                slope += rate * distance;
            }
        }
        equations.add(&mixed, slope, -1.0 / square.max(f64::MIN_POSITIVE));
        equations
    }
}

impl Candidate for Refinement {
    type Unknowns = Const<COUNT>;
    type Aim<'a> = (&'a [Complex], &'a Limits);
    const NO_GAIN: f64 = 1e-9;

    fn objective(&self) -> f64 {
        self.sum
    }

    fn equations(&self, (target, _): &Self::Aim<'_>) -> Option<Equations<Const<COUNT>>> {
        Some(if self.timing.is_some() { self.timed_equations(target) } else { self.free_equations(target) })
    }

    fn limited(&self, (_, limits): &Self::Aim<'_>, matrix: &Cholesky<f64, Const<COUNT>>, free: Motion) -> Motion {
        let step = |length| limits.constrained_step(&self.linkage, self.is_frame_longer, length, (matrix, free));
        let Some(limit) = &limits.length else { return step(None) };
        let length = || Some(limit.constraint(&self.linkage, &self.poses[0]));
        if self.is_long {
            return step(length().as_ref());
        }
        // A step along the limit is nearer than one that crosses it and is shortened.
        let motion = step(None);
        let moved = self.linkage.moved(&motion.into());
        if limit.shortened(&moved, &self.poses[0]).is_some() { step(length().as_ref()) } else { motion }
    }

    fn moved(&self, (target, limits): &Self::Aim<'_>, motion: &Motion) -> Option<Refinement> {
        let moved = self.linkage.moved(&(*motion).into());
        let mut linkage = limits.nearest(&moved, self.is_frame_longer)?;
        let shortened = limits.length.as_ref().and_then(|limit| limit.shortened(&linkage, &self.poses[0]));
        let is_long = self.is_long || shortened.is_some();
        if let Some(shortened) = shortened {
            linkage = Some(shortened).filter(|shortened| limits.are_satisfied(shortened))?;
        }
        let (poses, sum) = feet(&linkage, &self.poses, target, self.timing.as_ref())?;
        let is_nearer = sum < self.sum && limits.meets_condition(&linkage, &poses[0]);
        is_nearer.then(|| Refinement { linkage, poses, sum, is_long, timing: self.timing.clone(), ..*self })
    }
}

/// The feet of the target's points on the curve of a linkage near some poses, or where it is at their inputs if they are timed, and
/// the sum of the squares of the distances.
fn feet(linkage: &Parameters, poses: &[Pose], target: &[Complex], timing: Option<&Timing>) -> Option<(Vec<Pose>, f64)> {
    if let Some(timing) = timing {
        return timing.feet(linkage, poses, target);
    }
    let mut feet = Vec::with_capacity(poses.len());
    let mut sum = 0.0;
    for (pose, point) in poses.iter().zip(target) {
        let (foot, square) = linkage.nearest(linkage.settle(*pose)?, *point, FOOT_ROUNDS);
        feet.push(foot);
        sum += square;
    }
    Some((feet, sum))
}

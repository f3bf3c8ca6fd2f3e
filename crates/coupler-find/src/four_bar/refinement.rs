//! The linkage near another one whose curve is nearest to a target: Levenberg and Marquardt's method on nine parameters.

use crate::complex::{Complex, dot, length, times_i};
use crate::four_bar::limits::{Limits, Motion, Normal};
use crate::four_bar::nearest_pose::PoseRates;
use crate::four_bar::parameters::{COUNT, Parameters};
use crate::four_bar::pose::Pose;
use crate::four_bar::timing::{self, Timing};

/// A linkage on its way to the target.
#[derive(Clone, Debug)]
pub(crate) struct Refinement {
    pub linkage: Parameters,
    /// The pose for each point of the target.
    pub poses: Vec<Pose>,
    /// The sum of the squares of the distances.
    pub sum: f64,
    /// Whether no step improves it.
    pub is_done: bool,
    damping: f64,
    is_frame_longer: bool,
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
        Some(Refinement { linkage, poses, sum, is_done: false, damping: 1e-2, is_frame_longer, timing })
    }

    /// The timing in the direction that it follows, if the target is timed.
    pub fn timing(&self) -> Option<&Timing> {
        self.timing.as_ref()
    }

    /// Takes one step.
    pub fn step(&mut self, target: &[Complex], limits: &Limits) {
        /// The most trials with more and more damping.
        const TRIALS: usize = 8;
        const MAX_DAMPING: f64 = 1e8;
        /// A relative gain that is no progress.
        const NO_GAIN: f64 = 1e-9;
        if self.is_done {
            return;
        }
        let (normal, gradient) = match self.timing {
            None => self.normal_equations(target),
            Some(_) => self.timed_normal_equations(target),
        };
        let trace = normal.trace().max(f64::MIN_POSITIVE);
        for _ in 0..TRIALS {
            let mut damped = normal;
            for k in 0..COUNT {
                // A parameter that moves no point is held by a small part of what holds the others.
                damped[(k, k)] += self.damping * normal[(k, k)].max(1e-9 * trace);
            }
            if let Some(matrix) = damped.cholesky() {
                let free = matrix.solve(&gradient);
                let motion = limits.constrained_step(&self.linkage, self.is_frame_longer, (&matrix, free));
                let promised = 2.0 * gradient.dot(&motion) - motion.dot(&(normal * motion));
                if let Some((linkage, poses, sum)) = self.tried(&motion, target, limits) {
                    let gain = self.sum - sum;
                    self.is_done = gain <= NO_GAIN * self.sum;
                    match gain / promised.max(f64::MIN_POSITIVE) {
                        kept if kept > 0.75 => self.damping = (0.2 * self.damping).max(1e-12),
                        kept if kept < 0.25 => self.damping *= 3.0,
                        _ => {}
                    }
                    (self.linkage, self.poses, self.sum) = (linkage, poses, sum);
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

    /// The linkage after a motion, if it satisfies the limits and is nearer to the target.
    fn tried(&self, motion: &Motion, target: &[Complex], limits: &Limits) -> Option<(Parameters, Vec<Pose>, f64)> {
        let moved = self.linkage.moved(&(*motion).into());
        let linkage = limits.nearest(&moved, self.is_frame_longer)?;
        let (poses, sum) = feet(&linkage, &self.poses, target, self.timing.as_ref())?;
        (sum < self.sum && limits.meets_condition(&linkage, &poses[0])).then_some((linkage, poses, sum))
    }

    /// The normal equations of the distances across the curve: along it, the feet move by themselves.
    fn normal_equations(&self, target: &[Complex]) -> (Normal, Motion) {
        /// Slower than this part of a radian's motion, the point is at a cusp, and its offset is the direction that counts.
        const CUSP: f64 = 1e-6;
        let small = 1e-7 * (self.sum / target.len() as f64).sqrt();
        let linkage = &self.linkage;
        let (mut normal, mut gradient) = (Normal::zeros(), Motion::zeros());
        for (pose, point) in self.poses.iter().zip(target) {
            let rates = PoseRates::new(linkage, pose);
            let (offset, velocity) = (point - rates.at, rates.velocity());
            let (distance, speed) = (length(offset), length(velocity));
            let across = match speed > CUSP || distance <= small {
                true => times_i(velocity) / speed.max(f64::MIN_POSITIVE),
                false => offset / distance,
            };
            // If a parameter opens the linkage, its angles close it by the shortest motion, which is regular at limits.
            let [crank, coupler] = [0, 1].map(|k| dot(across, rates.by_angles[k]) * rates.closure[k]);
            let closing = (crank + coupler) / rates.square;
            let row = row(linkage, pose, &rates, across, closing);
            add_square(&mut normal, &row, 1.0);
            gradient += row * dot(across, offset);
        }
        normal.fill_upper_triangle_with_lower_triangle();
        (normal, gradient)
    }

    /// The normal equations of the distances of a timed target, in both directions of the plane: the offset of the input moves by
    /// itself (variable projection).
    fn timed_normal_equations(&self, target: &[Complex]) -> (Normal, Motion) {
        let linkage = &self.linkage;
        let (mut normal, mut gradient) = (Normal::zeros(), Motion::zeros());
        // By the offset: its products with the rows, with itself and with the distances.
        let (mut mixed, mut square, mut slope) = (Motion::zeros(), 0.0, 0.0);
        for (pose, point) in self.poses.iter().zip(target) {
            let rates = PoseRates::new(linkage, pose);
            let (offset, velocity) = (point - rates.at, timing::velocity(&rates));
            for axis in [Complex::new(1.0, 0.0), Complex::new(0.0, 1.0)] {
                // At a given angle of the crank the coupler closes the linkage.
                let closing = dot(axis, rates.by_angles[1]) / timing::closure_rate(&rates);
                let row = row(linkage, pose, &rates, axis, closing);
                let (distance, rate) = (dot(axis, offset), dot(axis, velocity));
                add_square(&mut normal, &row, 1.0);
                gradient += row * distance;
                mixed += row * rate;
                square += rate * rate;
                slope += rate * distance;
            }
        }
        let part = 1.0 / square.max(f64::MIN_POSITIVE);
        add_square(&mut normal, &mixed, -part);
        gradient -= mixed * (slope * part);
        normal.fill_upper_triangle_with_lower_triangle();
        (normal, gradient)
    }
}

/// The derivatives of the coupler point's coordinate in a direction by the parameters, if the linkage is closed by `closing` for
/// each unit of its closure.
fn row(linkage: &Parameters, pose: &Pose, rates: &PoseRates, axis: Complex, closing: f64) -> Motion {
    let by = |at: f64, closure: f64| at - closing * closure;
    Motion::from([
        axis.re,
        axis.im,
        by(0.0, -linkage.frame * dot(rates.arm, times_i(linkage.direction))),
        by(0.0, -dot(rates.arm, linkage.direction)),
        by(dot(axis, pose.crank), dot(rates.arm, pose.crank)),
        by(0.0, dot(rates.arm, pose.coupler)),
        by(0.0, -linkage.rocker),
        dot(axis, pose.coupler),
        dot(axis, times_i(pose.coupler)),
    ])
}

/// Adds a multiple of the products of a row with itself to the lower triangle.
fn add_square(normal: &mut Normal, row: &Motion, factor: f64) {
    for j in 0..COUNT {
        for k in 0..=j {
            normal[(j, k)] += factor * row[j] * row[k];
        }
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

//! The pose of a four-bar whose coupler point is nearest to another point.
//!
//! Crank and coupler angle are the two coordinates of a pose; the poses of a linkage are a curve in their plane, on which the
//! closure of the linkage is zero. Along that curve nothing is singular at a limit of the crank, as it would be along the
//! crank's angle; only at a change point is it not smooth.

use crate::complex::{Complex, dot, times_i};
use crate::four_bar::parameters::{COUNT, Parameters};
use crate::four_bar::pose::Pose;

/// A linkage in a pose with its first derivatives.
pub(crate) struct PoseRates {
    /// From the rocker's pivot to the rocker pin.
    pub arm: Complex,
    /// The coupler point, and its derivatives with respect to the angles of crank and coupler.
    pub at: Complex,
    pub by_angles: [Complex; 2],
    /// The derivatives of the closure with respect to these angles, and the sum of their squares.
    pub closure: [f64; 2],
    pub square: f64,
}

impl PoseRates {
    pub fn new(linkage: &Parameters, pose: &Pose) -> PoseRates {
        let arm = linkage.arm(pose);
        let closure = linkage.closure_rates(pose, arm);
        let [crank, point] = [linkage.crank * pose.crank, linkage.point * pose.coupler];
        PoseRates {
            arm,
            at: linkage.crank_pivot + crank + point,
            by_angles: [times_i(crank), times_i(point)],
            closure,
            square: (closure[0] * closure[0] + closure[1] * closure[1]).max(f64::MIN_POSITIVE),
        }
    }

    /// The derivatives of the coupler point's coordinate in a direction by the parameters, if the linkage is closed by `closing` for
    /// each unit of its closure.
    pub fn row(&self, linkage: &Parameters, pose: &Pose, axis: Complex, closing: f64) -> [f64; COUNT] {
        let by = |at: f64, closure: f64| at - closing * closure;
        [
            axis.re,
            axis.im,
            by(0.0, -linkage.frame * dot(self.arm, times_i(linkage.direction))),
            by(0.0, -dot(self.arm, linkage.direction)),
            by(dot(axis, pose.crank), dot(self.arm, pose.crank)),
            by(0.0, dot(self.arm, pose.coupler)),
            by(0.0, -linkage.rocker),
            dot(axis, pose.coupler),
            dot(axis, times_i(pose.coupler)),
        ]
    }

    /// The same where the curve passes, whatever the place of the point on it: if a parameter opens the linkage, its angles close it by the
    /// shortest motion, which is regular at limits.
    pub fn row_of_curve(&self, linkage: &Parameters, pose: &Pose, axis: Complex) -> [f64; COUNT] {
        let [crank, coupler] = [0, 1].map(|k| dot(axis, self.by_angles[k]) * self.closure[k]);
        self.row(linkage, pose, axis, (crank + coupler) / self.square)
    }

    /// The direction of the curve of poses, of length 1.
    pub fn along(&self) -> [f64; 2] {
        let norm = self.square.sqrt();
        [-self.closure[1] / norm, self.closure[0] / norm]
    }

    /// The velocity of the coupler point along the curve of poses.
    pub fn velocity(&self) -> Complex {
        let [crank, coupler] = self.along();
        self.by_angles[0] * crank + self.by_angles[1] * coupler
    }

    /// The acceleration of the coupler point along the curve of poses.
    fn acceleration(&self, linkage: &Parameters, pose: &Pose) -> Complex {
        let [crank, coupler] = [linkage.crank * pose.crank, linkage.coupler * pose.coupler];
        let [by_crank, by_coupler] = self.along();
        let second =
            [crank.norm_sqr() - dot(self.arm, crank), coupler.norm_sqr() - dot(self.arm, coupler), dot(crank, coupler)];
        let bend = second[0] * by_crank * by_crank
            + second[1] * by_coupler * by_coupler
            + 2.0 * second[2] * by_crank * by_coupler;
        let toward = -bend / self.square;
        let turning = (self.by_angles[0] * self.closure[0] + self.by_angles[1] * self.closure[1]) * toward;
        turning - crank * (by_crank * by_crank) - linkage.point * pose.coupler * (by_coupler * by_coupler)
    }
}

impl Parameters {
    /// The pose near another one whose coupler point is nearest to a target, and the square of the distance: at most
    /// `rounds` of Newton's method, each of which comes closer.
    pub fn nearest(&self, mut pose: Pose, target: Complex, rounds: usize) -> (Pose, f64) {
        /// The greatest step, in radians of both angles together.
        const MAX_STEP: f64 = 0.3;
        /// The foot of a perpendicular is found when the sine of its angle with the curve is this small; the distance is
        /// then exact to rounding.
        const PERPENDICULAR: f64 = 1e-10;
        let mut rates = PoseRates::new(self, &pose);
        let mut best = (target - rates.at).norm_sqr();
        for _ in 0..rounds {
            let (offset, velocity) = (target - rates.at, rates.velocity());
            let (slope, square) = (dot(offset, velocity), velocity.norm_sqr());
            if slope * slope <= PERPENDICULAR * PERPENDICULAR * square * best || square == 0.0 {
                break;
            }
            let newton = square - dot(offset, rates.acceleration(self, &pose));
            let mut step = slope / if newton > 0.1 * square { newton } else { square };
            step = step.clamp(-MAX_STEP, MAX_STEP);
            let along = rates.along();
            let mut gain = 0.0;
            for _ in 0..6 {
                if let Some(next) = self.settle(pose.turned(along.map(|part| part * step))) {
                    let next_rates = PoseRates::new(self, &next);
                    let square = (target - next_rates.at).norm_sqr();
                    if square < best {
                        gain = best - square;
                        (pose, rates, best) = (next, next_rates, square);
                        break;
                    }
                }
                step *= 0.25;
            }
            if gain <= 1e-13 * best {
                break;
            }
        }
        (pose, best)
    }
}

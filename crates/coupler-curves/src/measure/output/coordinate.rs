//! The coordinate of the output link, and its rate.

use std::f64::consts::TAU;

use crate::geometry::{Orientation, Vector, cross, trig};
use crate::linkage::{JointId, OutputLink};
use crate::measure::circuit_function::{Pose, Quantity};
use crate::motion::JointDerivatives;

/// The angle of a link in radians from the x-axis of the linkage before its placement, or the displacement of a slider
/// along its line.
#[derive(Clone, Copy, Debug)]
pub(super) struct OutputCoordinate {
    pub output: OutputLink,
    pub placement: Orientation,
}

impl OutputCoordinate {
    /// Whether it is a displacement.
    pub fn is_slider(&self) -> bool {
        self.output.is_slider()
    }

    /// Its derivative with respect to the input: per radian, or per unit of an actuator's length. Infinite where the
    /// output moves while the input reverses.
    pub fn rate(&self, derivatives: &JointDerivatives) -> f64 {
        let arm = |from: JointId, to: JointId| derivatives.position(to) - derivatives.position(from);
        let arm_rate = |from: JointId, to: JointId| derivatives.velocity(to) - derivatives.velocity(from);
        let turning = |from: JointId, to: JointId| {
            let arm = arm(from, to);
            cross(arm, arm_rate(from, to)) / arm.norm_squared()
        };
        let rate = match self.output {
            OutputLink::Link([from, to]) | OutputLink::Slot { base: [from, to], .. } => {
                self.placement.handedness() * turning(from, to)
            }
            OutputLink::Slider { joint, line: [from, to] } => {
                // The derivative of the line's direction is its left normal times its angular velocity.
                let unit = arm(from, to).normalize();
                unit.dot(&arm_rate(from, joint)) + turning(from, to) * cross(unit, arm(from, joint))
            }
        };
        if rate.is_nan() { f64::INFINITY } else { rate }
    }
}

impl Quantity for OutputCoordinate {
    fn joints(&self) -> Vec<JointId> {
        self.output.joints()
    }

    fn value(&self, pose: &Pose) -> f64 {
        let arm = |from: JointId, to: JointId| pose.at(to) - pose.at(from);
        // The linkage may be mirrored and rotated on the page; angles are those before that.
        let angle = |v: Vector| {
            let [x, y] =
                [Vector::new(1.0, 0.0), Vector::new(0.0, 1.0)].map(|axis| self.placement.transform_vector(axis));
            trig::atan2(y.dot(&v), x.dot(&v))
        };
        match self.output {
            OutputLink::Link([from, to]) => angle(arm(from, to)),
            OutputLink::Slot { base: [from, to], dyad } => angle(arm(from, to) * -f64::from(pose.mode.sign(dyad))),
            OutputLink::Slider { joint, line: [from, to] } => arm(from, to).normalize().dot(&arm(from, joint)),
        }
    }

    fn sensitivity(&self, pose: &Pose) -> f64 {
        let length = |from: JointId, to: JointId| (pose.at(to) - pose.at(from)).norm();
        match self.output {
            OutputLink::Link([from, to]) | OutputLink::Slot { base: [from, to], .. } => 2.0 / length(from, to),
            OutputLink::Slider { joint, line: [from, to] } => 2.0 + 2.0 * length(from, joint) / length(from, to),
        }
    }

    fn period(&self) -> Option<f64> {
        (!self.is_slider()).then_some(TAU)
    }
}

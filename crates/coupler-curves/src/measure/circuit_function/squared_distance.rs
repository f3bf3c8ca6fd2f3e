//! The distance of two joints, as a quantity that is smooth also where they meet.

use super::{Pose, Quantity};
use crate::linkage::JointId;

/// The square of the distance of two joints.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SquaredDistance(pub [JointId; 2]);

impl Quantity for SquaredDistance {
    fn joints(&self) -> Vec<JointId> {
        self.0.to_vec()
    }

    fn value(&self, pose: &Pose) -> f64 {
        let [from, to] = self.0;
        (pose.at(to) - pose.at(from)).norm_squared()
    }

    fn sensitivity(&self, pose: &Pose) -> f64 {
        let [from, to] = self.0;
        4.0 * (pose.at(to) - pose.at(from)).norm()
    }
}

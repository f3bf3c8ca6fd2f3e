//! A force on a joint, against which the input moves a linkage.

use super::JointId;
use crate::geometry::{Orientation, Vector, trig};

/// A force on a joint, given by its id or, as `J`, by something else. Its unit may be any: a torque is in that unit times the unit of lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load<J = JointId> {
    /// The joint.
    pub joint: J,
    /// The magnitude, greater than 0.
    pub force: f64,
    /// The direction that it keeps, in degrees from the x-axis of the frame that the linkage is seen from, before its placement; `None` for
    /// a force that opposes the motion of the joint.
    pub direction_deg: Option<f64>,
}

impl<J> Load<J> {
    /// The same force on a joint that is given otherwise.
    pub fn map_joint<K>(self, joint: impl FnOnce(J) -> K) -> Load<K> {
        Load { joint: joint(self.joint), force: self.force, direction_deg: self.direction_deg }
    }

    /// The force of a load that keeps its direction, as a vector in the plane that a linkage is placed in.
    pub(crate) fn vector(&self, placement: Orientation) -> Option<Vector> {
        let (cos, sin) = trig::cos_sin_deg(self.direction_deg?);
        Some(placement.transform_vector(Vector::new(cos, sin)) * self.force)
    }

    /// The torque, or the force of an input that is a length, with which the drive holds or moves the linkage against the load, by virtual
    /// work: positive where it acts in the direction in which the input rises. Friction and masses are left out.
    ///
    /// `velocity` is that of the joint per radian, or unit of length, of the input, and `input_direction` 1 where the linkage moves with a
    /// rising input, -1 where with a falling one: only a load that opposes the motion depends on it. Infinite where the joint moves while the
    /// input reverses. `rounding` is that of the velocity: a force across the motion does no work.
    pub fn torque(&self, velocity: Vector, rounding: f64, placement: Orientation, input_direction: f64) -> f64 {
        let torque = match self.vector(placement) {
            // However fast the motion is.
            Some(force) => {
                let power = |force: f64, velocity: f64| if force == 0.0 { 0.0 } else { force * velocity };
                let power = power(force.x, velocity.x) + power(force.y, velocity.y);
                if power.abs() <= rounding * self.force { 0.0 } else { -power }
            }
            None => self.force * velocity.norm() * input_direction,
        };
        if torque.is_nan() { f64::INFINITY } else { torque }
    }
}

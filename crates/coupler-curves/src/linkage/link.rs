//! A rigid body of a linkage.

use super::JointId;
use crate::geometry::Vector;

/// A rigid body: joints at constant distances from one another.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Its joints, each with its position in the link's own frame.
    pub joints: Vec<(JointId, Vector)>,
}

impl Link {
    /// The position of a joint in the link's own frame; `None` for a joint that is not on the link.
    pub fn position(&self, joint: JointId) -> Option<Vector> {
        self.joints.iter().find(|(j, _)| *j == joint).map(|&(_, position)| position)
    }
}

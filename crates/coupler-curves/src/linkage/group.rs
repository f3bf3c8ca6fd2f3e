//! Groups of links that no dyads solve: the joints that are placed together, and the equations that place them.

use super::JointId;
use crate::geometry::Point;

/// An Assur group of a class higher than the dyads', or several with the dyads between them: joints that are placed
/// together, from the input and the fixed joints, by as many equations as they have coordinates.
///
/// The other joints of its links are [`super::JointKind::Rigid`].
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// The joints, [`super::JointKind::Grouped`], and where each is in the pose at the start, in the frame of the fixed
    /// joints: the equations have several solutions, and the motion is that through this one.
    pub joints: Vec<(JointId, Point)>,
    /// The equations.
    pub closures: Vec<Closure>,
}

/// What closes a loop of links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Closure {
    /// Two joints are at a distance: one equation.
    Distance {
        /// The joints.
        joints: [JointId; 2],
        /// Their distance, positive.
        length: f64,
    },
    /// The distance of two joints is the input, the length of an actuator: one equation.
    Driven {
        /// The joints.
        joints: [JointId; 2],
    },
    /// A joint is on a link, as a [`super::JointKind::Rigid`] is: two equations.
    OnLink {
        /// The joint.
        joint: JointId,
        /// Two joints of the link.
        base: [JointId; 2],
        /// The position along the line of the two, in units of their distance.
        along: f64,
        /// The position to the left of that line, in units of their distance.
        across: f64,
    },
    /// A joint is on a line that is parallel to that of two joints of a link: one equation.
    OnLine {
        /// The joint.
        joint: JointId,
        /// Two joints of the link.
        line: [JointId; 2],
        /// The distance of the two.
        length: f64,
        /// The distance of the line to the left of the two.
        offset: f64,
    },
}

impl Closure {
    /// The joints it refers to.
    pub fn joints(&self) -> Vec<JointId> {
        match *self {
            Closure::Distance { joints, .. } | Closure::Driven { joints } => joints.to_vec(),
            Closure::OnLink { joint, base: [a, b], .. } | Closure::OnLine { joint, line: [a, b], .. } => {
                vec![joint, a, b]
            }
        }
    }
}

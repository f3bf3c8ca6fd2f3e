//! The closed loops of a group of links, with dimensions that are expressions.

use crate::expression::CompiledExpression;

/// What closes the loops of joints that are [`super::JointKindTemplate::Grouped`]; joints are given by their indices in
/// [`super::Template::joints`].
#[derive(Clone, Debug)]
pub enum ClosureTemplate {
    /// A link through two joints; further joints are points of it.
    Bar {
        /// The joints.
        joints: [usize; 2],
        /// Their distance.
        length: CompiledExpression,
    },
    /// A joint that is placed already is on the link through two others.
    Hold {
        /// The joint.
        joint: usize,
        /// The two joints of the link.
        base: [usize; 2],
        /// Its distances along the line of the two, and to the left of it.
        place: [CompiledExpression; 2],
    },
    /// A joint slides on a line.
    Guide {
        /// The joint.
        joint: usize,
        /// Two joints that the line is parallel to.
        line: [usize; 2],
        /// The distance of the line to the left of them.
        offset: CompiledExpression,
    },
    /// An actuator is between two joints; its length is the input.
    Drive {
        /// The joints.
        joints: [usize; 2],
    },
    /// A joint that an actuator drives is in the group, and at these coordinates at the start.
    Start {
        /// The joint.
        joint: usize,
        /// Its coordinates.
        at: [CompiledExpression; 2],
    },
}

impl ClosureTemplate {
    /// The joints it refers to.
    pub fn joints(&self) -> Vec<usize> {
        match self {
            ClosureTemplate::Bar { joints, .. } | ClosureTemplate::Drive { joints } => joints.to_vec(),
            ClosureTemplate::Hold { joint, base: [a, b], .. } | ClosureTemplate::Guide { joint, line: [a, b], .. } => {
                vec![*joint, *a, *b]
            }
            ClosureTemplate::Start { joint, .. } => vec![*joint],
        }
    }

    /// Replaces the indices of joints.
    #[must_use]
    pub fn map_joints(mut self, new_index: impl Fn(usize) -> usize) -> ClosureTemplate {
        match &mut self {
            ClosureTemplate::Bar { joints, .. } | ClosureTemplate::Drive { joints } => {
                *joints = joints.map(new_index);
            }
            ClosureTemplate::Hold { joint, base, .. } | ClosureTemplate::Guide { joint, line: base, .. } => {
                (*joint, *base) = (new_index(*joint), base.map(new_index));
            }
            ClosureTemplate::Start { joint, .. } => *joint = new_index(*joint),
        }
        self
    }
}

//! The output link: the link or slider whose motion a linkage is built for.

use super::{DyadId, JointId};

/// The link or slider whose motion relative to the ground is the output of a linkage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputLink {
    /// A link that turns; its angle is that of the line from the first of two of its joints to the second.
    Link([JointId; 2]),
    /// The link that carries the line of a slot without offset; its angle is that of the line.
    Slot {
        /// The pivot, and the joint that the line slides through.
        base: [JointId; 2],
        /// The slot's dyad. On its right side the line points from the pivot towards the joint.
        dyad: DyadId,
    },
    /// A slider or a yoke; its displacement is measured along its line, from the foot of the line's first joint.
    Slider {
        /// The joint on the line.
        joint: JointId,
        /// Two joints that the line is parallel to.
        line: [JointId; 2],
    },
}

impl OutputLink {
    /// The joints that its position is computed from.
    pub fn joints(self) -> Vec<JointId> {
        match self {
            OutputLink::Link(joints) => joints.to_vec(),
            OutputLink::Slot { base, .. } => base.to_vec(),
            OutputLink::Slider { joint, line: [from, to] } => vec![joint, from, to],
        }
    }

    /// Whether it slides on a line rather than turns.
    pub fn is_slider(self) -> bool {
        matches!(self, OutputLink::Slider { .. })
    }
}

//! Links that slide.

use crate::linkage::{JointId, LineDirection, LinkId};

/// A link identified by a joint and a line: a slider, a yoke, an actuator, or a link that a joint slides along.
#[derive(Clone, Copy, Debug)]
pub(super) struct SlidingBody {
    /// The joint its points are measured from, and another that identifies the line.
    pub base: [JointId; 2],
    /// How its points are placed.
    pub reference: BodyReference,
    /// Its index among the links.
    pub link: LinkId,
    /// Whether its points are measured against the direction of its line.
    pub is_backward: bool,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum BodyReference {
    /// By the foot of its line and the foot's distance from the pivot; positive where the direction of the line is
    /// that of pivot -> foot turned a quarter to the left.
    Foot { foot: JointId, offset: f64 },
    /// By the direction of a line, as in [`JointKind::Aligned`].
    Line { line: [JointId; 2], offset: f64, direction: LineDirection },
    /// By the direction of a line that slides through its joint, which is that from the line's pivot to its foot, turned as in
    /// [`BodyReference::Foot`].
    Block { line: [JointId; 2], offset: f64 },
}

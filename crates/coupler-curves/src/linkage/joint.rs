//! Joints, and how each is placed from those before it.

use super::{DyadId, JointId};
use crate::geometry::{Point, Vector};

/// A named point of a linkage.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Its name, which the points of a grid share.
    pub name: String,
    /// How it is placed.
    pub kind: JointKind,
}

/// How a joint is placed from joints before it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum JointKind {
    /// At a fixed point of the frame.
    Fixed(Point),
    /// On a crank that turns about `pivot`; its angle is the linkage's input.
    Crank {
        /// The crank's pivot.
        pivot: JointId,
        /// Its length, positive.
        length: f64,
    },
    /// On a second crank, geared to the first: it turns `ratio[0]` times while the first turns `ratio[1]` times.
    Gear {
        /// The crank's pivot.
        pivot: JointId,
        /// Its length, positive.
        length: f64,
        /// The turns of this crank and of the first, in lowest terms; the second is positive.
        ratio: [i64; 2],
        /// Its angle in degrees when the first crank's is 0.
        phase_deg: f64,
    },
    /// On a rack, a gear of infinite radius, that a pinion on the crank moves along a line: by the pitch radius times the crank's angle.
    Rack {
        /// Two joints of one link that the line is parallel to; it points from the first to the second.
        line: [JointId; 2],
        /// The distance of the line to the left of the two.
        offset: f64,
        /// The pitch radius of the pinion; negative where the rack moves against the line as the crank's angle rises.
        radius: f64,
        /// The distance from the first joint of the line, along it, where the crank's angle is 0.
        start: f64,
    },
    /// On a crank driven by a linear actuator, whose length s is the linkage's input (McCarthy 2.43).
    Piston {
        /// The actuator's pivot, and the crank's.
        base: [JointId; 2],
        /// The crank's length, positive.
        length: f64,
        /// The distance of the actuator's line from its pivot.
        offset: f64,
        /// Its dyad.
        dyad: DyadId,
    },
    /// On a slider that is driven along a line; its distance from the first joint of the line, along it, is the linkage's input.
    DrivenSlider {
        /// Two joints of one link that the line is parallel to; it points from the first to the second.
        line: [JointId; 2],
        /// The distance of the line to the left of the two.
        offset: f64,
    },
    /// At the common pin of two links, each connected to one base joint (the RRR dyad).
    Dyad {
        /// The joints the links are connected to.
        base: [JointId; 2],
        /// Their lengths, positive.
        lengths: [f64; 2],
        /// Its dyad.
        dyad: DyadId,
    },
    /// At the end of a link that slides on a line (the RRP dyad); the point is on the line.
    Slide {
        /// The joint at the link's other end.
        from: JointId,
        /// The link's length, positive.
        length: f64,
        /// Two joints that the line is parallel to.
        line: [JointId; 2],
        /// The distance of the line to the left of the two.
        offset: f64,
        /// Its dyad, whose sign is 1 ahead of `from` and -1 behind it.
        dyad: DyadId,
    },
    /// At the foot of the line that slides through a joint (the RPR dyad, McCarthy's inverted slider-crank): the line
    /// from the foot to `base[1]` is perpendicular to the one from `base[0]` to the foot, which is `offset` long.
    /// Without offset the foot is the pivot, and the side gives the direction of the line: on the right side it
    /// points from the pivot towards the joint.
    Slot {
        /// The pivot of the link that carries the line, and the joint the line slides through.
        base: [JointId; 2],
        /// The line's distance from the pivot; negative on the other side.
        offset: f64,
        /// Its dyad.
        dyad: DyadId,
    },
    /// On the guide of a yoke that slides along a line, its slot through a joint at an angle to the guide (the RPP
    /// dyad): where the slot's line meets the guide.
    Yoke {
        /// The joint that slides in the slot.
        from: JointId,
        /// Two joints that the guide is parallel to.
        line: [JointId; 2],
        /// The distance of the guide to the left of the two.
        offset: f64,
        /// The slot's direction in the guide's frame: a unit vector whose y is not 0.
        slot_direction: Vector,
    },
    /// On a link that keeps the direction of a line, at a given distance along the line and to its left from a joint.
    Aligned {
        /// The joint of the link that it is measured from.
        from: JointId,
        /// A joint at the distance `offset` from the line, and one on the line.
        line: [JointId; 2],
        /// The distance of the line to the left of the first of them; at most their distance.
        offset: f64,
        /// How the second joint's position along the line is determined.
        direction: LineDirection,
        /// The distance along the line.
        along: f64,
        /// The distance to the left of the line.
        across: f64,
    },
    /// In a group, whose joints are placed together by the equations of [`super::Group`].
    Grouped {
        /// The group as a dyad, which all its joints have in common. Its side is the sign of the determinant of the
        /// equations' derivatives, left at the start; it is flat where that is 0.
        dyad: DyadId,
    },
    /// At the fourth corner of a parallelogram: `corners[0] + corners[2] - corners[1]`.
    Parallelogram {
        /// The other corners, in order around it; the last two are on one link.
        corners: [JointId; 3],
    },
    /// On a link: `base[0] + along (base[1] - base[0]) + across n`, where `n` is `base[1] - base[0]` turned a quarter
    /// to the left.
    Rigid {
        /// Two joints of the link.
        base: [JointId; 2],
        /// The position along the line of the two, in units of their distance.
        along: f64,
        /// The position to the left of that line, in units of their distance.
        across: f64,
    },
}

/// How the direction of a line that passes through one joint, at an offset from another, is determined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineDirection {
    /// It points towards the joint it passes through.
    Towards,
    /// It points towards that joint while this dyad, a slot without offset, is on its right side, and away
    /// from it on the left.
    BySide(DyadId),
    /// The distance of the two joints along the line is the input, an actuator's length.
    Actuator,
}

impl JointKind {
    /// The two joints whose direction, that of a base or a line, the joint is placed in; `None` if it needs none or, as
    /// joints of one link, they always have one.
    pub(crate) fn base(&self) -> Option<[JointId; 2]> {
        match *self {
            JointKind::Dyad { base, .. } | JointKind::Slot { base, .. } | JointKind::Piston { base, .. } => Some(base),
            JointKind::Slide { line, .. }
            | JointKind::Yoke { line, .. }
            | JointKind::DrivenSlider { line, .. }
            | JointKind::Rack { line, .. }
            | JointKind::Aligned { line, .. } => Some(line),
            JointKind::Fixed(_)
            | JointKind::Crank { .. }
            | JointKind::Gear { .. }
            | JointKind::Grouped { .. }
            | JointKind::Parallelogram { .. }
            | JointKind::Rigid { .. } => None,
        }
    }

    /// The two joints of the line on which the joint is a slider, a yoke, a rack or a driven slider; `None` if it is none of these.
    pub fn slider_line(&self) -> Option<[JointId; 2]> {
        match *self {
            JointKind::Slide { line, .. }
            | JointKind::Yoke { line, .. }
            | JointKind::Rack { line, .. }
            | JointKind::DrivenSlider { line, .. } => Some(line),
            _ => None,
        }
    }

    /// The joint's dyad; `None` for a joint with only one position for each input.
    pub fn dyad(&self) -> Option<DyadId> {
        match *self {
            JointKind::Dyad { dyad, .. }
            | JointKind::Slide { dyad, .. }
            | JointKind::Slot { dyad, .. }
            | JointKind::Grouped { dyad }
            | JointKind::Piston { dyad, .. } => Some(dyad),
            JointKind::Fixed(_)
            | JointKind::Crank { .. }
            | JointKind::Gear { .. }
            | JointKind::Rack { .. }
            | JointKind::DrivenSlider { .. }
            | JointKind::Yoke { .. }
            | JointKind::Parallelogram { .. }
            | JointKind::Aligned { .. }
            | JointKind::Rigid { .. } => None,
        }
    }
}

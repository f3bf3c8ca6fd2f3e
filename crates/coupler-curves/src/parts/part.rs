//! A part.

use super::anchor::Anchor;
use super::body::Body;
use super::hole::{Hole, Slot};
use super::outline::{Outline, rounded_hull};
use super::sizes::Sizes;
use crate::geometry::{Point, Similarity};
use crate::linkage::Linkage;

/// A part, in coordinates of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Its name, that of no other: `frame`, the names of its holes as `OA`, or what it is and a joint as `block S` and `gear O`.
    pub name: String,
    /// Its holes, those of joints first.
    pub holes: Vec<Hole>,
    /// Its slots.
    pub slots: Vec<Slot>,
    /// What it is cut along.
    pub outline: Outline,
    pub(super) anchor: Anchor,
}

impl Part {
    /// The part of a body.
    pub(super) fn from_body(body: &Body, linkage: &Linkage, sizes: Sizes) -> Part {
        let frame = body.part_frame();
        let hole = |hole: &Hole| Hole { name: hole.name.clone(), centre: frame.coordinates(hole.centre) };
        let slot = |slot: &Slot| Slot { name: slot.name.clone(), ends: slot.ends.map(|end| frame.coordinates(end)) };
        let holes: Vec<Hole> = body.holes.iter().map(hole).collect();
        let slots: Vec<Slot> = body.slots.iter().map(slot).collect();
        let ends = slots.iter().flat_map(|slot| slot.ends);
        let points: Vec<Point> = holes.iter().map(|hole| hole.centre).chain(ends).collect();
        Part {
            name: body.name(linkage),
            outline: rounded_hull(&points, sizes.width / 2.0),
            anchor: body.anchor.in_frame(&frame),
            holes,
            slots,
        }
    }

    /// Where it is in a pose, which has the positions of all joints.
    pub fn plane_from_part(&self, pose: &[Point]) -> Similarity {
        self.anchor.plane_from_body(&|joint| pose[joint])
    }

    /// Whether it has the same holes, slots and outline as another.
    pub fn is_same_shape(&self, other: &Part) -> bool {
        let centres = |part: &Part| part.holes.iter().map(|hole| hole.centre).collect::<Vec<_>>();
        let ends = |part: &Part| part.slots.iter().map(|slot| slot.ends).collect::<Vec<_>>();
        centres(self) == centres(other) && ends(self) == ends(other) && self.outline == other.outline
    }
}

//! A part.

use super::anchor::Anchor;
use super::body::Body;
use super::hole::{Hole, Slot};
use super::outline::{Outline, rounded_hull};
use super::pitch_line::PitchLine;
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
    /// The pitch line of a rack.
    pub pitch_line: Option<PitchLine>,
    /// What has to be known of it besides, in words.
    pub notes: Vec<String>,
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
        let pitch_line =
            body.pitch_line.map(|line| PitchLine { ends: line.ends.map(|p| frame.coordinates(p)), ..line });
        let ends = slots.iter().flat_map(|slot| slot.ends).chain(pitch_line.iter().flat_map(|line| line.ends));
        let points: Vec<Point> = holes.iter().map(|hole| hole.centre).chain(ends).collect();
        Part {
            name: body.name(linkage),
            outline: rounded_hull(&points, sizes.width / 2.0),
            anchor: body.anchor.in_frame(&frame),
            holes,
            slots,
            pitch_line,
            notes: body.notes.clone(),
        }
    }

    /// Notes the holes that meet another hole or a slot, which one plate cannot have.
    pub(super) fn note_overlaps(&mut self, sizes: Sizes) {
        let name = |hole: &Hole| if hole.name.is_empty() { "of a pin" } else { &hole.name }.to_owned();
        let mut notes = Vec::new();
        for (k, hole) in self.holes.iter().enumerate() {
            let near = self.holes[..k].iter().filter(|other| (other.centre - hole.centre).norm() <= sizes.hole);
            notes.extend(near.map(|other| format!("the holes {} and {} overlap", name(other), name(hole))));
            let slots = self.slots.iter().filter(|slot| slot.distance_to(hole.centre) <= sizes.hole);
            notes.extend(slots.map(|slot| {
                let hole = name(hole);
                format!("the hole {hole} is in the slot {}: one plate cannot have both", slot.name)
            }));
        }
        self.notes.extend(notes);
    }

    /// Where it is in a pose, which has the positions of all joints.
    pub fn plane_from_part(&self, pose: &[Point]) -> Similarity {
        self.anchor.plane_from_body(&|joint| pose[joint])
    }

    /// Whether it has the same holes, slots, pitch line, outline and notes as another.
    pub fn is_same_shape(&self, other: &Part) -> bool {
        let centres = |part: &Part| part.holes.iter().map(|hole| hole.centre).collect::<Vec<_>>();
        let ends = |part: &Part| part.slots.iter().map(|slot| slot.ends).collect::<Vec<_>>();
        let is_like = self.pitch_line == other.pitch_line && self.notes == other.notes;
        is_like && centres(self) == centres(other) && ends(self) == ends(other) && self.outline == other.outline
    }
}

//! Holes and slots.

use super::outline::{Outline, rounded_hull};
use crate::geometry::{Point, distance_to_segment};

/// A hole.
#[derive(Clone, Debug, PartialEq)]
pub struct Hole {
    /// The names of the joints whose pin is in it, one after the other; empty for a pin that only guides or holds.
    pub name: String,
    /// Its centre.
    pub centre: Point,
}

/// A slot.
#[derive(Clone, Debug, PartialEq)]
pub struct Slot {
    /// The names of the joints whose pins slide in it.
    pub name: String,
    /// The ends of its centre line; it ends in half circles around them.
    pub ends: [Point; 2],
}

impl Slot {
    /// How far a point is from its centre line.
    pub(super) fn distance_to(&self, p: Point) -> f64 {
        distance_to_segment(p, self.ends[0], self.ends[1])
    }

    /// What it is cut along, if it is as wide as a hole of a diameter.
    pub fn outline(&self, hole: f64) -> Outline {
        rounded_hull(&self.ends, hole / 2.0)
    }
}

/// The names of joints, one after the other: `ABM`, or `A1-B2` where one has several letters.
pub(super) fn join_names<'n>(names: impl IntoIterator<Item = &'n str>) -> String {
    let names: Vec<&str> = names.into_iter().filter(|name| !name.is_empty()).collect();
    let is_letter = |name: &&str| name.chars().count() == 1;
    names.join(if names.iter().all(is_letter) { "" } else { "-" })
}

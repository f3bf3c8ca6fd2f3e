//! How near a curve is to a target, in numbers.

use crate::quality::Quality;

/// How near a curve is to a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// E: the root of the mean square of the distances of the target's points from the continuous curve, in their order along one
    /// circuit and within one turn, in the unit of the target.
    pub rms: f64,
    /// E relative to the size of the target.
    pub rms_relative: f64,
    /// The greatest of these distances.
    pub greatest: f64,
    /// Whether the points of the curve that are nearest to those of the target are in their order.
    pub is_in_order: bool,
    /// The length of the curve relative to that of the polygon of a closed target; of an open one, of the portion from the first point to the
    /// last relative to that of the target.
    pub length_ratio: f64,
}

impl Deviation {
    /// How near the curve is, in a word.
    pub fn quality(&self) -> Quality {
        Quality::of(self.rms_relative)
    }
}

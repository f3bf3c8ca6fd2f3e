//! What a search finds.

use crate::linkage::{PlacedFourBar, Side};

/// A four-bar whose coupler curve is near a target.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// The linkage, in the unit and axes of the target.
    pub linkage: PlacedFourBar,
    /// The side of the line from the crank pin to the rocker's pivot on which the rocker pin is at the first point of the
    /// target.
    pub side: Side,
    /// E: the root of the mean square of the distances of the target's points from the curve, in the unit of the target.
    pub rms: f64,
    /// E relative to the size of the target.
    pub rms_relative: f64,
    /// The greatest of these distances.
    pub greatest: f64,
    /// Whether the points of the curve that are nearest to those of the target are in their order.
    pub is_in_order: bool,
    /// Whether the curve passes the target backwards as the crank turns counterclockwise.
    pub is_reversed: bool,
    /// The length of the curve relative to that of the polygon of the target.
    pub length_ratio: f64,
}

/// The lengths that the curve of an answer may have, relative to that of the target's polygon: others have excursions between
/// its points, or cut them off.
pub const LENGTH_RATIOS: [f64; 2] = [0.87, 1.15];

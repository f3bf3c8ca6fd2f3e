//! Why the parts of a linkage cannot be made.

/// Why the parts of a linkage cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PartsError {
    /// No material is left around the holes.
    #[error("a hole of {hole} is not smaller than the width {width} of the links")]
    HoleTooWide {
        /// The diameter of holes.
        hole: f64,
        /// The width of links.
        width: f64,
    },
    /// Two holes overlap.
    #[error("the holes {} and {} are {distance} apart, and {hole} wide", .names[0], .names[1])]
    HolesOverlap {
        /// The names of the holes.
        names: [String; 2],
        /// The distance of their centres.
        distance: String,
        /// Their diameter.
        hole: f64,
    },
    /// A hole is wider than a gear.
    #[error("a gear has a pitch radius of {radius}, and a hole that is {hole} wide")]
    GearTooSmall {
        /// The pitch radius.
        radius: String,
        /// The diameter of its hole.
        hole: f64,
    },
    /// A line is that of no part.
    #[error("`{joint}` slides on a line that is on no part: through two joints of different links")]
    NoGuide {
        /// The joint that slides.
        joint: String,
    },
}

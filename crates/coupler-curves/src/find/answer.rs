//! What a search finds.

use super::mechanism::Mechanism;

/// A coupler curve near a target, and the four-bars that trace it.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// The four-bar to build: of those that meet the constraints the one with the best transmission angle.
    pub mechanism: Mechanism,
    /// Its cognates: the other four-bars that trace the same curve (Roberts and Chebyshev); none if the coupler point is a pin.
    pub cognates: Vec<Mechanism>,
    /// E: the root of the mean square of the distances of the target's points from the curve, in the unit of the target.
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

/// How near a curve is to a target, in a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quality {
    /// E is at most 0.0001 of the target's size: no difference is seen in a drawing.
    Exact,
    /// At most 0.01: a line's width in a drawing as large as a hand.
    Close,
    /// At most 0.05.
    Fair,
    /// More than that.
    Poor,
}

impl Quality {
    /// The word for a deviation relative to the size of the target.
    pub fn of(rms_relative: f64) -> Quality {
        match rms_relative {
            ..=1e-4 => Quality::Exact,
            ..=0.01 => Quality::Close,
            ..=0.05 => Quality::Fair,
            _ => Quality::Poor,
        }
    }

    /// The word.
    pub fn name(self) -> &'static str {
        match self {
            Quality::Exact => "exact",
            Quality::Close => "close",
            Quality::Fair => "fair",
            Quality::Poor => "poor",
        }
    }
}

impl Answer {
    /// How near the curve is.
    pub fn quality(&self) -> Quality {
        Quality::of(self.rms_relative)
    }

    /// The four-bar to build, and its cognates.
    pub fn mechanisms(&self) -> impl Iterator<Item = &Mechanism> {
        std::iter::once(&self.mechanism).chain(&self.cognates)
    }
}

/// The greatest length that the curve of an answer, or its portion, may have relative to that of the target without its noise: longer ones
/// have detours between its points. One that is shorter cuts corners, which its deviation tells.
pub const MAX_LENGTH_RATIO: f64 = 1.15;

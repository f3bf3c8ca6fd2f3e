//! What a search finds.

use crate::four_bar::mechanism::Mechanism;
use crate::quality::Quality;

/// A coupler curve near a target, and the four-bars that trace it.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// The four-bar to build: of those that meet the constraints the one with the best transmission angle, and of two
    /// with the same the one with shorter links.
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

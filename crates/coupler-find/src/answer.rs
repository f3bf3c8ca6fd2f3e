//! What a search finds.

use crate::deviation::Deviation;
use crate::four_bar::mechanism::Mechanism;

/// A coupler curve near a target, and the four-bars that trace it.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// The four-bar to build: of those that meet the constraints the one with the best transmission angle, and of two
    /// with the same the one with shorter links.
    pub mechanism: Mechanism,
    /// Its cognates: the other four-bars that trace the same curve (Roberts and Chebyshev); none if the coupler point is a pin.
    pub cognates: Vec<Mechanism>,
    /// How near the curve is.
    pub deviation: Deviation,
}

impl Answer {
    /// The four-bar to build, and its cognates.
    pub fn mechanisms(&self) -> impl Iterator<Item = &Mechanism> {
        std::iter::once(&self.mechanism).chain(&self.cognates)
    }
}

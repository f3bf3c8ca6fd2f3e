//! A pose of a four-bar.

use crate::complex::{Complex, turned};

/// The directions of crank and coupler, of length 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose {
    pub crank: Complex,
    pub coupler: Complex,
}

impl Pose {
    /// The pose with both links turned by small angles.
    pub fn turned(&self, by: [f64; 2]) -> Pose {
        Pose { crank: turned(self.crank, by[0]), coupler: turned(self.coupler, by[1]) }
    }
}

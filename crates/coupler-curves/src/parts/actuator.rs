//! The linear actuator that drives a linkage: it is bought, not cut.

use crate::linkage::Linkage;
use crate::measure::circuit_function::{SquaredDistance, range_over};
use crate::motion::Circuit;

/// A linear actuator between two pins.
#[derive(Clone, Debug, PartialEq)]
pub struct Actuator {
    /// The names of the joints at its ends.
    pub joints: [String; 2],
    /// The least and the greatest distance of its pins.
    pub lengths: [f64; 2],
}

impl Actuator {
    /// That of a linkage, as long as a circuit needs; `None` if it has none.
    pub(super) fn new(linkage: &Linkage, circuit: &Circuit) -> Option<Actuator> {
        let ends = *linkage.actuators().first()?;
        let lengths = range_over(circuit, linkage, &SquaredDistance(ends))?.map(|squared| squared.max(0.0).sqrt());
        Some(Actuator { joints: ends.map(|joint| linkage.joints[joint].name.clone()), lengths })
    }
}

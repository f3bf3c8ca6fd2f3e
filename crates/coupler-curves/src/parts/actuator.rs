//! The linear actuator that drives a linkage: it is bought, not cut.

use crate::linkage::Linkage;
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
        let distance = |sample: usize| {
            let [a, b] = ends.map(|joint| circuit.positions.point(joint, sample));
            (b - a).norm()
        };
        let distances = || (0..circuit.len()).map(distance).filter(|distance| distance.is_finite());
        let lengths = [distances().reduce(f64::min)?, distances().reduce(f64::max)?];
        Some(Actuator { joints: ends.map(|joint| linkage.joints[joint].name.clone()), lengths })
    }
}

//! The limit of the length of a curve: a closed path is not that of a curve with long detours from it.

use crate::complex::{Complex, closed_length, length};
use crate::four_bar::nearest_pose::PoseRates;
use crate::four_bar::parameters::{Constraint, Motion, Parameters};
use crate::four_bar::pose::Pose;
use coupler_curves::geometry::Similarity;

/// The greatest length of the whole curve of a linkage.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LengthLimit {
    max_length: f64,
    /// The directions of the cranks of sampled circuits.
    directions: Vec<Complex>,
}

impl LengthLimit {
    pub fn new(max_length: f64, directions: &[Complex]) -> LengthLimit {
        LengthLimit { max_length, directions: directions.to_vec() }
    }

    /// The linkage as much smaller, with the target's centroid in its place, as its curve on the circuit of a pose is too long; `None` if it is not.
    pub fn shortened(&self, linkage: &Parameters, pose: &Pose) -> Option<Parameters> {
        /// What keeps the curve within the limit in spite of rounding.
        const WITHIN: f64 = 1.0 - 1e-12;
        let length = closed_length(&linkage.curve(&linkage.circuit_of(pose, &self.directions)));
        let factor = WITHIN * self.max_length / length;
        (length > self.max_length)
            .then(|| linkage.transformed(&Similarity { factor: Complex::new(factor, 0.0), ..Similarity::IDENTITY }))
    }

    /// By how much the curve on the circuit of a pose is shorter than the limit.
    pub fn constraint(&self, linkage: &Parameters, pose: &Pose) -> Constraint {
        let circuit = linkage.circuit_of(pose, &self.directions);
        let curve = linkage.curve(&circuit);
        let count = curve.len();
        let chord = |k: usize| {
            let chord = curve[(k + 1) % count] - curve[k % count];
            chord / length(chord).max(f64::MIN_POSITIVE)
        };
        let mut rates = Motion::zeros();
        for (k, pose) in circuit.iter().enumerate() {
            // A motion of the point along the chord to it makes the curve longer, and one along the chord from it shorter.
            let axis = chord(k) - chord(k + count - 1);
            rates += Motion::from(PoseRates::new(linkage, pose).row_of_curve(linkage, pose, axis));
        }
        (self.max_length - closed_length(&curve), rates)
    }
}

impl Parameters {
    /// The samples of the circuit that a pose is on, see [`Parameters::circuits`].
    pub fn circuit_of(&self, pose: &Pose, directions: &[Complex]) -> Vec<Pose> {
        let distance = |circuit: &Vec<Pose>| {
            let square =
                |other: &Pose| (other.crank - pose.crank).norm_sqr() + (other.coupler - pose.coupler).norm_sqr();
            circuit.iter().map(square).fold(f64::INFINITY, f64::min)
        };
        let circuits = self.circuits(directions).into_iter();
        circuits.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::four_bar::sequence::four_bar_of_sequence;
    use crate::shape::spectrum::directions;

    /// On all classes the rates of the length are those of differences.
    #[test]
    fn the_rates_of_the_length_are_those_of_differences() {
        const STEP: f64 = 1e-6;
        let limit = LengthLimit::new(1.0, &directions(2000));
        let mut compared = 0;
        for number in 0..60 {
            let linkage = four_bar_of_sequence(number);
            let Some(pose) = linkage.circuits(&limit.directions).first().map(|circuit| circuit[circuit.len() / 3])
            else {
                continue;
            };
            let (value, rates) = limit.constraint(&linkage, &pose);
            // At a cusp or next to a change point the length is not smooth.
            for k in 0..rates.len() {
                let shorter = |step: f64| {
                    let mut by = [0.0; 9];
                    by[k] = step;
                    limit.constraint(&linkage.moved(&by), &pose).0
                };
                let difference = (shorter(STEP) - shorter(-STEP)) / (2.0 * STEP);
                let error = (difference - rates[k]).abs();
                compared += usize::from(error <= 1e-3 * (1.0 + rates[k].abs()) * (1.0 - value));
            }
        }
        assert!(compared >= 9 * 56, "{compared}");
    }
}

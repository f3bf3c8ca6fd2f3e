//! Positions: where a linkage can go, and where its joints are on the way.
//!
//! [`Motion::solve`] finds the circuits of a linkage and samples them. A *circuit* is a maximal motion that keeps the
//! assembly. It is a chain of [`Pass`]es: on a pass the input goes one way and no dyad changes its side. A pass ends
//! at a *limit*, where a dyad lies flat and the input turns round while that dyad changes its side; at a *change
//! point*, where a dyad lies flat and the input goes on; at the end of the range asked for; or, on a full turn, at
//! input 0.
//!
//! Dyads that lie flat at one input change their sides together, or one of them alone, as the linkage's
//! [`crate::linkage::CoincidentDyads`] has it. A dyad whose base vanishes takes its place by continuity; where there is none
//! its joint has no place there, and is not a number.
//!
//! Limits of dyads on crank and frame are in closed form. Of all others it is certain that none is missed, down to 1e-12
//! of a turn, or of an actuator's stroke, by enclosures of the chain and of its rate; where a dyad misses by no more than
//! rounding, 64 units in the last place of its lengths, it has a change point and no limit.
//!
//! Positions come from kernels over columns (one joint, all samples). At the end of a pass the flat dyad's height is
//! multiplied by exactly 0, and a limit of a dyad on crank and frame is carried as its cosine, not its angle. Rates come
//! from Taylor series through the same chain.

mod circuit;
mod derivatives;
mod dyad_limits;
mod enclosure;
mod instantaneous_motion;
mod interval;
mod joint_series;
mod pass_ends;
mod path;
mod positions;
mod refinement;
mod sampling;
mod series;
mod spacing;

pub use circuit::{InputPosition, Pass, PassEnd};
pub use derivatives::JointDerivatives;
pub use instantaneous_motion::InstantaneousMotion;
pub use path::{Dash, DashPattern, JointPath, joint_paths};
pub use positions::{DyadSigns, InputSlices, JointPositions, place_leading_joints};
pub use sampling::{Circuit, MAX_SAMPLES, Sampler, Sampling};

use crate::geometry::Point;
use crate::linkage::{JointId, Linkage};

/// Why a linkage is not assembled whose places, or their squares, are beyond all numbers.
const OUT_OF_RANGE_REASON: &str = "its lengths are too large or too small for double precision";

/// All that a linkage does as its input travels.
#[derive(Clone, Debug)]
pub struct Motion {
    /// The circuits wanted: those that start on branch 1 first, then by least input. Empty where the linkage cannot
    /// be assembled.
    pub circuits: Vec<Circuit>,
    /// Why the linkage is not assembled at all, or not over the whole range asked for.
    pub incomplete_reason: Option<String>,
}

impl Motion {
    /// Finds and samples the circuits of a linkage.
    pub fn solve(linkage: &Linkage, sampler: &Sampler) -> Motion {
        let found = circuit::find_circuits(linkage);
        if let Some(reason) = found.circuits.iter().find_map(|route| sampler.excess_reason(route)) {
            return Motion { circuits: Vec::new(), incomplete_reason: Some(reason) };
        }
        let circuits: Vec<Circuit> =
            found.circuits.into_iter().map(|route| sampler.sample_circuit(linkage, route)).collect();
        let is_lost = |circuit: &Circuit| {
            linkage.traced.iter().any(|&joint| circuit.points(joint).all(|p| !p.x.is_finite() || !p.y.is_finite()))
        };
        if circuits.iter().any(is_lost) {
            return Motion { circuits: Vec::new(), incomplete_reason: Some(OUT_OF_RANGE_REASON.to_owned()) };
        }
        Motion { circuits, incomplete_reason: found.incomplete_reason }
    }

    /// Whether there is any motion.
    pub fn is_assembled(&self) -> bool {
        !self.circuits.is_empty()
    }
}

/// Where every joint is at inputs of a pass, as seen from the linkage's own view.
pub fn poses(linkage: &Linkage, pass: &Pass, inputs: &[f64]) -> JointPositions {
    path::positions_at_inputs(linkage, pass, inputs)
}

/// Where every joint is at one input of a pass, as seen from the linkage's own view.
pub fn pose(linkage: &Linkage, pass: &Pass, input: f64) -> Vec<Point> {
    let columns = path::positions_at_inputs(linkage, pass, &[input]);
    (0..linkage.joints.len()).map(|joint: JointId| columns.point(joint, 0)).collect()
}

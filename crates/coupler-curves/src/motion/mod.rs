//! The motion of a linkage: its circuits, and the positions and derivatives of its joints along them.
//!
//! [`Motion::solve`] finds the circuits of a linkage and samples them. A *circuit* is a maximal motion without
//! disassembly. It is a chain of [`Pass`]es: on a pass the input is monotonic and the assembly mode is constant. A dyad
//! is *flat* where it is fully stretched or folded. A pass ends at a *limit*, where a dyad is flat and the input
//! reverses while that dyad changes its side; at a *change point*, where a dyad is flat and the input continues in its
//! direction; at the end of the requested range; or, on a full turn, at input 0.
//!
//! Of several dyads that are flat at one input, all change their sides or only one, as the linkage's
//! [`crate::linkage::CoincidentDyads`] says. The joint of a dyad whose base vanishes is placed in the limit along the
//! motion, and is afterwards on the side on which it does not jump; where it would jump on either, the motion ends.
//!
//! Limits of dyads on crank and frame are computed in closed form. All others are searched for with enclosures of the
//! dyad's extent and of its derivative, so that none is missed down to 1e-12 of a turn, or of an actuator's stroke; a
//! dyad that misses by no more than rounding, 64 units in the last place of its lengths, has a change point and no
//! limit.
//!
//! Positions are computed by kernels over columns (one joint, all samples). At the end of a pass the flat dyad's height
//! is multiplied by exactly 0, and a limit of a dyad on crank and frame is represented by its cosine and sine, not by
//! its angle. Derivatives are computed by Taylor series through the same chain.

mod assembly_error;
mod circuit;
mod derivatives;
mod dyad_limits;
mod enclosure;
mod end_series;
mod group;
mod input_columns;
mod instantaneous_motion;
mod interval;
mod interval_search;
mod joint_series;
mod length_rates;
mod limits;
mod link_rotation;
mod memory;
mod pass;
mod pass_ends;
mod pass_positions;
mod pieces;
mod positions;
mod sampling;
mod series;
mod spacing;

pub use assembly_error::AssemblyError;
pub use derivatives::JointDerivatives;
pub use instantaneous_motion::InstantaneousMotion;
pub use pass::{InputPosition, Pass, PassEnd};
pub use positions::JointPositions;
pub use sampling::{Circuit, Sampler, Sampling};

// For the other crates of the workspace only.
#[doc(hidden)]
pub use self::{
    circuit::{CircuitSet, UnsampledCircuit, find_circuits},
    group::{GroupTrack, follow_full_turn},
    input_columns::{InputColumns, InputSlices},
    length_rates::{LengthRates, NeighbourLinkages},
    limits::{MAX_ASSEMBLY_MODES, MAX_CIRCUIT_BYTES, MAX_SAMPLES, SIZES},
    link_rotation::LinkRotation,
    memory::estimate_bytes,
    pieces::{CircuitPiece, CircuitPieces, InputMap},
    positions::{DyadSigns, place_leading_joints},
    spacing::{eased_fraction, eased_input},
};

use crate::geometry::Point;
use crate::linkage::{Joint, JointId, JointKind, Linkage};

/// The circuits of a linkage, sampled.
#[derive(Clone, Debug)]
pub struct Motion {
    /// The requested circuits: those that start on branch 1 first, then by least input. Empty if the linkage cannot
    /// be assembled.
    pub circuits: Vec<Circuit>,
    /// Why the linkage cannot be assembled at all, or not over the whole input range requested.
    pub assembly_error: Option<AssemblyError>,
}

impl Motion {
    /// Finds and samples the circuits of a linkage.
    pub fn solve(linkage: &Linkage, sampler: &Sampler) -> Motion {
        let found = find_circuits(linkage);
        if let Some(error) = found.circuits.iter().find_map(|circuit| sampler.excess_error(circuit)) {
            return Motion { circuits: Vec::new(), assembly_error: Some(error) };
        }
        if let Some(error) = memory::memory_error(linkage, &found.circuits, sampler) {
            return Motion { circuits: Vec::new(), assembly_error: Some(error) };
        }
        let circuits: Vec<Circuit> =
            found.circuits.into_iter().map(|circuit| sampler.sample_circuit(linkage, circuit)).collect();
        let is_undefined = |circuit: &Circuit| {
            linkage.traced.iter().any(|&joint| circuit.points(joint).all(|p| !p.x.is_finite() || !p.y.is_finite()))
        };
        let size = circuits.iter().map(|circuit| circuit.positions.greatest_coordinate()).fold(0.0, f64::max);
        let is_beyond = !circuits.is_empty() && !SIZES.contains(&size);
        if is_beyond || circuits.iter().any(is_undefined) {
            return Motion { circuits: Vec::new(), assembly_error: Some(AssemblyError::BeyondDoublePrecision) };
        }
        let assembly_error = found.assembly_error.or_else(|| circuits.iter().find_map(|c| undefined_error(linkage, c)));
        Motion { circuits, assembly_error }
    }

    /// Whether there is at least one circuit.
    pub fn is_assembled(&self) -> bool {
        !self.circuits.is_empty()
    }
}

/// Why a joint has no position at a sample, the first of these.
fn undefined_error(linkage: &Linkage, circuit: &Circuit) -> Option<AssemblyError> {
    let has_line = |joint: &Joint| {
        matches!(joint.kind, JointKind::Slide { .. } | JointKind::Yoke { .. } | JointKind::Aligned { .. })
    };
    let has_vanishing_base = |pass: &Pass| !pass.from.vanishing_dyads.union(pass.to.vanishing_dyads).is_empty();
    if !linkage.joints.iter().any(has_line) && !circuit.passes.iter().any(has_vanishing_base) {
        return None;
    }
    let find = |joint: JointId| {
        let is_undefined = |p: Point| !p.x.is_finite() || !p.y.is_finite();
        circuit.points(joint).position(is_undefined).map(|sample| (joint, sample))
    };
    let (joint, sample) = linkage.joint_ids().find_map(find)?;
    Some(AssemblyError::NoLimit { joint: linkage.joints[joint].name.clone(), input: circuit.inputs[sample] })
}

/// The positions of all joints at inputs of a pass, in the frame the linkage is seen from.
pub fn poses(linkage: &Linkage, pass: &Pass, inputs: &[f64]) -> JointPositions {
    poses_in_columns(linkage, pass, &InputColumns::from_values(linkage.input(), inputs.iter().copied()))
}

/// The same at inputs that are in columns already: for several linkages at the same inputs.
#[doc(hidden)]
pub fn poses_in_columns(linkage: &Linkage, pass: &Pass, inputs: &InputColumns) -> JointPositions {
    pass_positions::positions_at_inputs(linkage, pass, inputs)
}

/// The positions of all joints at one input of a pass, in the frame the linkage is seen from.
pub fn pose(linkage: &Linkage, pass: &Pass, input: f64) -> Vec<Point> {
    let columns = poses(linkage, pass, &[input]);
    linkage.joint_ids().map(|joint| columns.point(joint, 0)).collect()
}

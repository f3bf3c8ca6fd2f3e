//! What a linkage is recognized by among others that differ from it in their traced points only.

use std::hash::{DefaultHasher, Hash, Hasher};

use coupler_curves::linkage::{JointId, JointKind};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// A number that is the same for all linkages of a family with the same motion on the circuit of a curve, and different for others, whatever
/// points on its links are traced.
pub fn linkage_identity(solved: &SolvedCell, curve: &MeasuredCurve) -> u64 {
    let (linkage, circuit) = (&solved.linkage, solved.circuit(curve));
    let is_traced_point = |joint: &JointId| {
        linkage.traced.contains(joint) && matches!(linkage.joints[*joint].kind, JointKind::Rigid { .. })
    };
    let mut hasher = DefaultHasher::new();
    // Two poses have all lengths, and those of a circuit no other circuit has.
    for sample in [0, circuit.inputs.len() / 3] {
        for joint in linkage.joint_ids().filter(|joint| !is_traced_point(joint)) {
            let at = circuit.positions.point(joint, sample);
            [at.x, at.y].map(|coordinate| (coordinate + 0.0).to_bits()).hash(&mut hasher);
        }
    }
    hasher.finish()
}

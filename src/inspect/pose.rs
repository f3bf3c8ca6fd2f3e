//! The poses of a linkage at one input, and the motion of its links there.

use coupler_curves::linkage::{DyadId, JointId};
use coupler_curves::measure::input_torque;
use coupler_curves::motion::{InstantaneousMotion, JointDerivatives, Pass};
use coupler_curves::solve::SolvedCell;

/// The linkage at one input, on one pass.
pub(super) struct Pose {
    /// The number of the circuit, from 1.
    pub circuit: usize,
    pub pass: Pass,
    /// The input, in the turn in which the pass has it.
    pub input: f64,
    pub jets: JointDerivatives,
}

impl Pose {
    /// The input torque against the load of its linkage, if it has one.
    pub fn torque(&self, solved: &SolvedCell) -> Option<f64> {
        input_torque(&solved.linkage, &self.pass, &self.jets)
    }
}

/// Every pose at an input, circuit by circuit; with `branch`, only those whose first dyad is on that side.
pub(super) fn poses(solved: &SolvedCell, at: f64, branch: Option<i8>) -> Vec<Pose> {
    let input = solved.linkage.input();
    let mut poses = Vec::new();
    for (number, circuit) in (1..).zip(&solved.motion.circuits) {
        for pass in &circuit.passes {
            let (from, to) = (pass.from.input.value, pass.to.input.value);
            let [low, high] = [from.min(to), from.max(to)];
            // The given input may be some full turns from that of the pass.
            let offset = (at - low).rem_euclid(input.period());
            let is_branch = branch.is_none_or(|branch| pass.mode.sign(DyadId::FIRST) == branch);
            // The end of a full turn is the pose at its beginning.
            let is_seam = circuit.is_closed && circuit.passes.len() == 1 && low + offset == high;
            if low + offset <= high && is_branch && !is_seam {
                let jets = JointDerivatives::on_pass(&solved.linkage, pass, low + offset);
                poses.push(Pose { circuit: number, pass: pass.clone(), input: low + offset, jets });
            }
        }
    }
    poses
}

/// The instantaneous motion of the link of each traced joint; `None` where the link does not rotate.
pub(super) fn instant_geometries<'a>(
    solved: &'a SolvedCell,
    pose: &'a Pose,
) -> impl Iterator<Item = (JointId, Option<InstantaneousMotion>)> + use<'a> {
    let linkage = &solved.linkage;
    linkage.traced.iter().map(move |&joint| (joint, InstantaneousMotion::from_joint(linkage, &pose.jets, joint)))
}

//! Racks as long as their pinions roll on them.

use super::body::Body;
use super::pitch_line::{PitchLine, RackMesh, rack_mesh};
use super::sizes::Sizes;
use crate::geometry::{Point, Vector, left_normal};
use crate::linkage::{JointKind, Linkage};
use crate::motion::Circuit;

/// Adds the pitch lines of the racks among bodies.
pub(super) fn add(bodies: &mut [Body], (linkage, circuit): (&Linkage, &Circuit), sizes: Sizes) {
    for body in bodies {
        let Some((joint, axis)) = body.block.map(|block| (block.joint, block.axis)) else { continue };
        let JointKind::Rack { radius, .. } = linkage.joints[joint].kind else { continue };
        let centre = body.position(joint).unwrap_or(Point::origin());
        let line = |mesh: RackMesh| {
            let margin = sizes.width / 2.0;
            let [from, to] = [mesh.contact[0] - margin, mesh.contact[1] + margin];
            let across: Vector = left_normal(axis) * mesh.offset;
            PitchLine { ends: [from, to].map(|at| centre + axis * at + across), radius: radius.abs() }
        };
        body.pitch_line = rack_mesh(linkage, circuit, joint).map(line);
        if body.pitch_line.is_none() {
            body.notes.push("no pitch line: its pinion is not on the part on which it slides".to_owned());
        }
    }
}

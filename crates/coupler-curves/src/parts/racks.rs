//! Racks as long as their pinions roll on them.

use super::body::{Block, Body};
use super::pitch_line::{PitchLine, pitch_line_offset};
use super::sizes::Sizes;
use super::travel::travel;
use crate::geometry::{Point, Vector, left_normal};
use crate::linkage::{JointKind, Linkage};
use crate::motion::Circuit;

/// Adds the pitch lines of the racks among bodies.
pub(super) fn add(bodies: &mut [Body], (linkage, circuit): (&Linkage, &Circuit), sizes: Sizes) {
    for body in bodies {
        let Some(Block { joint, axis, .. }) = body.block else { continue };
        let JointKind::Rack { radius, .. } = linkage.joints[joint].kind else { continue };
        let ends = pitch_line_offset(linkage, circuit, joint)
            .and_then(|offset| pitch_line_ends(body, (axis, offset), (linkage, circuit), sizes));
        body.pitch_line = ends.map(|ends| PitchLine { ends, radius: radius.abs() });
        if body.pitch_line.is_none() {
            body.notes.push("no pitch line: its pinion is not on the part on which it slides".to_owned());
        }
    }
}

/// The ends of the pitch line of a rack, which is parallel to an axis through its joint, so far to the left of it.
fn pitch_line_ends(
    rack: &Body,
    (axis, offset): (Vector, f64),
    (linkage, circuit): (&Linkage, &Circuit),
    sizes: Sizes,
) -> Option<[Point; 2]> {
    let centre = rack.position(rack.block?.joint)?;
    let [pivot, _] = linkage.crank()?;
    let margin = axis * (sizes.width / 2.0);
    let [from, to] = travel(rack, (pivot, axis), (linkage, circuit))?;
    let on_line = |p: Point| centre + axis * axis.dot(&(p - centre)) + left_normal(axis) * offset;
    Some([from - margin, to + margin].map(on_line))
}

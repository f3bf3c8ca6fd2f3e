//! The lines of racks on which their pinions roll.

use crate::geometry::{Point, left_normal};
use crate::linkage::{JointId, JointKind, Linkage};
use crate::motion::Circuit;

/// The pitch line of a rack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PitchLine {
    /// Its ends: what the pinion rolls on, and half the width of a link more on both sides.
    pub ends: [Point; 2],
    /// The pitch radius of the pinion.
    pub radius: f64,
}

/// How far the pitch line of a joint that is a rack is to the left of the joint, seen along the line on which it slides. `None` of others, and where no link
/// has both the pinion's pivot and the line of the rack: they do not mesh.
pub fn pitch_line_offset(linkage: &Linkage, circuit: &Circuit, joint: JointId) -> Option<f64> {
    let JointKind::Rack { line: [p, q], radius, .. } = linkage.joints[joint].kind else { return None };
    let [pivot, _] = linkage.crank()?;
    linkage.links.iter().find(|link| [pivot, p, q].iter().all(|joint| link.position(*joint).is_some()))?;
    // Where the rack moves along its line as the pinion turns counter-clockwise, it is to the right of the pivot; the mirror image of a linkage turns
    // clockwise.
    let radius = radius * linkage.placement.handedness();
    let offset = |sample: usize| {
        let [p, q, pivot, joint] = [p, q, pivot, joint].map(|joint| circuit.positions.point(joint, sample));
        Some(left_normal((q - p).try_normalize(0.0)?).dot(&(pivot - joint)) - radius)
            .filter(|offset| offset.is_finite())
    };
    /// The part of the radius up to which a joint is on the pitch line: what rounding leaves of an offset like it.
    const ROUNDING: f64 = 1e-9;
    let offset = (0..circuit.len()).find_map(offset)?;
    Some(if offset.abs() > ROUNDING * radius.abs() { offset } else { 0.0 })
}

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

/// How a pinion meets a rack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RackMesh {
    /// How far the pitch line is to the left of the rack's joint, seen along the line on which it slides.
    pub offset: f64,
    /// The least and the greatest distance along the line from the joint to where the pinion meets the rack.
    pub contact: [f64; 2],
}

/// How the pinion meets a joint that is a rack; `None` of others, and where no link has both the pinion's pivot and the line of the rack: they do not mesh.
pub fn rack_mesh(linkage: &Linkage, circuit: &Circuit, joint: JointId) -> Option<RackMesh> {
    let JointKind::Rack { line: [p, q], radius, .. } = linkage.joints[joint].kind else { return None };
    let [pivot, _] = linkage.crank()?;
    linkage.links.iter().find(|link| [pivot, p, q].iter().all(|joint| link.position(*joint).is_some()))?;
    // Where the rack moves along its line as the pinion turns counter-clockwise, it is to the right of the pivot; the mirror image of a linkage turns
    // clockwise.
    let radius = radius * linkage.placement.handedness();
    let place = |sample: usize| {
        let [p, q, pivot, joint] = [p, q, pivot, joint].map(|joint| circuit.positions.point(joint, sample));
        let along = (q - p).try_normalize(0.0)?;
        let arm = pivot - joint;
        Some((along.dot(&arm), left_normal(along).dot(&arm) - radius)).filter(|place| place.0.is_finite())
    };
    let places: Vec<(f64, f64)> = (0..circuit.len()).filter_map(place).collect();
    let contact = [f64::min, f64::max].map(|choose| places.iter().map(|place| place.0).reduce(choose));
    /// The part of the radius up to which a joint is on the pitch line: what rounding leaves of an offset like it.
    const ROUNDING: f64 = 1e-9;
    let offset = places.first().map(|place| place.1).filter(|offset| offset.abs() > ROUNDING * radius.abs());
    Some(RackMesh { offset: offset.unwrap_or(0.0), contact: [contact[0]?, contact[1]?] })
}

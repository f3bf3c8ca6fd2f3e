//! The path of an exported curve.

use super::SelectedCurve;
use crate::geometry::{Bounds, Point};
use crate::path::joint_polyline;

/// The curve's path, whose chords are no further from the curve than `chord` times its extent, and whether it is closed.
pub(super) fn curve_path(selected: &SelectedCurve, chord: f64) -> (Vec<Point>, bool) {
    let (circuit, joint) = (selected.circuit(), selected.curve().joint);
    let extent = Bounds::from_points(circuit.points(joint)).size().max();
    let (alone, joint) = selected.solved.linkage.with_one_point(joint);
    (joint_polyline(&alone, circuit, joint, chord * extent), circuit.is_closed)
}

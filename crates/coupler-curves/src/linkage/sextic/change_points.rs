//! The points of a coupler curve at which all links lie on one line.

use crate::geometry::{Point, Vector};
use crate::linkage::{FourBar, length_tolerance};

/// The positions of the coupler point at the change points of a four-bar, where its motion may continue on either
/// branch.
pub(super) fn change_points(four_bar: FourBar, point: Vector) -> Vec<Point> {
    let FourBar { frame, crank, coupler, rocker } = four_bar;
    let tolerance = length_tolerance(frame + crank + coupler + rocker);
    let lines = (0..8).map(|k| [1, 2, 4].map(|bit| if k & bit == 0 { 1.0 } else { -1.0 }));
    let flat = lines.filter(|[a, b, c]| (a * crank + b * coupler - c * rocker - frame).abs() <= tolerance);
    flat.map(|[a, b, _]| Point::new(a * crank, 0.0) + point * b).collect()
}

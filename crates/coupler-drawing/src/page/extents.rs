//! What a panel has to show: the bounds of its curves and of its linkage.

use super::arrangement::Extents;
use super::tolerance_band;
use coupler_curves::geometry::Bounds;
use coupler_curves::motion::{self, Pass};
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// The extents of a panel: the bounds of its curves in groups of `circuit_groups`, and those of a linkage with the curves, as of poses and
/// of a body.
pub(super) fn of_groups(groups: &[(Vec<usize>, Bounds)], with_linkage: impl FnOnce(Bounds) -> Bounds) -> Extents {
    let curves = groups.iter().fold(Bounds::EMPTY, |whole, (_, bounds)| whole.union(*bounds));
    let linkage = with_linkage(curves);
    let curves = groups.iter().map(|(_, bounds)| without_rounding(*bounds, linkage)).collect();
    Extents { curves, linkage }
}

/// The bounds of a curve, or only their centre if the curve is so small, compared with the coordinates of its linkage,
/// that rounding would be visible at the scale at which it fills a page.
fn without_rounding(curve: Bounds, linkage: Bounds) -> Bounds {
    /// The rounding of a position is about 1e-16 of the coordinates it is computed from: a millionth of the page.
    const LEAST_SIZE: f64 = 1e-10;
    let coordinates = [linkage.min.x, linkage.min.y, linkage.max.x, linkage.max.y];
    let greatest = coordinates.into_iter().map(f64::abs).fold(0.0, f64::max);
    let is_visible = curve.size().max() > LEAST_SIZE * greatest;
    if is_visible { curve } else { Bounds::from_points([curve.centre()]) }
}

/// The circuits of a cell with the bounds of their curves, each in a group of its own if there are not too many.
pub(super) fn circuit_groups(solved: &SolvedCell) -> Vec<(Vec<usize>, Bounds)> {
    /// With more groups than this, the frames are too small to enlarge anything.
    const MAX_GROUPS: usize = 4;
    let mut groups: Vec<(Vec<usize>, Bounds)> = Vec::new();
    for curve in &solved.curves {
        let bounds = curve_bounds(solved, curve);
        let bounds = bounds.union(tolerance_band::bounds(solved, curve));
        match groups.iter_mut().find(|(circuits, _)| circuits.contains(&curve.circuit)) {
            Some((_, whole)) => *whole = whole.union(bounds),
            None => groups.push((vec![curve.circuit], bounds)),
        }
    }
    if groups.len() > MAX_GROUPS {
        let whole = groups.iter().fold(Bounds::EMPTY, |whole, (_, bounds)| whole.union(*bounds));
        return vec![(groups.into_iter().flat_map(|(circuits, _)| circuits).collect(), whole)];
    }
    groups
}

/// The bounds of a curve. Those of its samples are a part of a thousand less at most, unless there are few: then it has more poses.
fn curve_bounds(solved: &SolvedCell, curve: &MeasuredCurve) -> Bounds {
    /// The samples that are enough, as of a curve with turns of 10 degrees between them; and the poses of a pass of which there are fewer.
    const ENOUGH: usize = 180;
    const POSES: u32 = 90;
    let circuit = solved.circuit(curve);
    let sampled = Bounds::from_points(circuit.points(curve.joint));
    if circuit.len() >= ENOUGH {
        return sampled;
    }
    let of_pass = |pass: &Pass| {
        let inputs: Vec<f64> =
            (0..=POSES).map(|k| motion::eased_input(pass, f64::from(k) / f64::from(POSES))).collect();
        let positions = motion::poses(&solved.linkage, pass, &inputs);
        Bounds::from_points((0..inputs.len()).map(|k| positions.point(curve.joint, k)))
    };
    circuit.passes.iter().fold(sampled, |bounds, pass| bounds.union(of_pass(pass)))
}

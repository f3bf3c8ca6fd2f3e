//! The pose a linkage is drawn in: one in which it can be read.

use super::figure::drawn_links;
use crate::geometry::{Point, distance_to_segment};
use crate::linkage::Linkage;
use crate::motion::Circuit;

/// The places of all joints in the clearest pose of a circuit.
///
/// The clearest pose is the one in which the nearest two of its joints, or the nearest joint and link, are furthest
/// apart. Poses within a hundredth of the clearest are as good; the first of them is taken.
pub(super) fn clearest(linkage: &Linkage, circuit: &Circuit) -> (usize, Vec<Point>) {
    /// More samples than this make no difference to the eye.
    const CANDIDATES: usize = 360;
    let stride = circuit.len().div_ceil(CANDIDATES).max(1);
    let links = drawn_links(linkage);
    let pose = |sample: usize| -> Vec<Point> {
        (0..linkage.joints.len()).map(|joint| circuit.places.point(joint, sample)).collect()
    };
    let clearances: Vec<(usize, f64)> =
        (0..circuit.len()).step_by(stride).map(|sample| (sample, clearance(&links, &pose(sample)))).collect();
    let best = clearances.iter().map(|(_, clearance)| *clearance).fold(0.0, f64::max);
    let sample = clearances.iter().find(|(_, clearance)| *clearance >= 0.99 * best).map_or(0, |(sample, _)| *sample);
    (sample, pose(sample))
}

fn clearance(links: &[Vec<usize>], at: &[Point]) -> f64 {
    let mut joints: Vec<usize> = links.iter().flatten().copied().collect();
    joints.sort_unstable();
    joints.dedup();
    let mut least = f64::INFINITY;
    for (k, &joint) in joints.iter().enumerate() {
        for &other in &joints[..k] {
            least = least.min((at[joint] - at[other]).norm());
        }
        for link in links.iter().filter(|link| !link.contains(&joint)) {
            for pair in link.windows(2) {
                least = least.min(distance_to_segment(at[joint], at[pair[0]], at[pair[1]]));
            }
        }
    }
    if least.is_nan() { 0.0 } else { least }
}

//! Bounds on the distance of two joints in every pose, from the lengths of the links between them.

use crate::geometry::Vector;
use crate::linkage::{JointId, Linkage};

/// The least and the greatest distance that two joints can have by the triangle inequality, in any pose of the first
/// `placed` joints.
///
/// The bounds hold at every input, in every assembly mode; they are not the extremes of a motion. The greatest is the
/// length of the shortest chain of links from one joint to the other. The least is what a pair of joints of one link
/// leaves of its distance after the shortest chains from it to both joints.
pub(super) fn distance_bounds(linkage: &Linkage, placed: usize, [from, to]: [JointId; 2]) -> [f64; 2] {
    let links = link_distances(linkage, placed, [from, to]);
    let [from_chains, to_chains] = [from, to].map(|joint| shortest_chains(&links, placed, joint));
    let least = links.iter().map(|&([a, b], distance)| {
        let chains = (from_chains[a] + to_chains[b]).min(from_chains[b] + to_chains[a]);
        distance - chains
    });
    [least.fold(0.0, f64::max), from_chains[to]]
}

/// Two joints of a link, and their distance.
type LinkDistance = ([JointId; 2], f64);

/// The distances of the joints of links; only joints that chains can go through, which are on several links, and the
/// two ends of the chains.
fn link_distances(linkage: &Linkage, placed: usize, ends: [JointId; 2]) -> Vec<LinkDistance> {
    let mut link_counts = vec![0; placed];
    let is_placed = |joint: JointId| joint.index() < placed;
    for (joint, _) in linkage.links.iter().flat_map(|link| &link.joints).filter(|(joint, _)| is_placed(*joint)) {
        link_counts[joint.index()] += 1;
    }
    let is_relevant = |joint: JointId| is_placed(joint) && (link_counts[joint.index()] > 1 || ends.contains(&joint));
    let mut distances = Vec::new();
    for link in &linkage.links {
        let relevant: Vec<(JointId, Vector)> = link.joints.iter().copied().filter(|(a, _)| is_relevant(*a)).collect();
        for (k, (a, a_position)) in relevant.iter().enumerate() {
            distances
                .extend(relevant[k + 1..].iter().map(|(b, b_position)| ([*a, *b], (b_position - a_position).norm())));
        }
    }
    distances
}

/// The length of the shortest chain of links from a joint to each joint; infinite where there is none.
fn shortest_chains(links: &[LinkDistance], placed: usize, from: JointId) -> Vec<f64> {
    let mut lengths = vec![f64::INFINITY; placed];
    lengths[from] = 0.0;
    loop {
        let mut is_shortened = false;
        for &([a, b], distance) in links {
            for [a, b] in [[a, b], [b, a]] {
                if lengths[a] + distance < lengths[b] {
                    lengths[b] = lengths[a] + distance;
                    is_shortened = true;
                }
            }
        }
        if !is_shortened {
            return lengths;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use crate::linkage::{LinkageBuilder, MotionOptions, Side};

    #[test]
    fn bounds_are_those_of_the_triangle_inequality() {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", Point::new(0.0, 0.0));
        let c = builder.fixed("C", Point::new(10.0, 0.0));
        let a = builder.crank("A", o, 1.0).unwrap();
        let b = builder.dyad("B", [a, c], [9.0, 5.0], Side::Left).unwrap();
        let linkage = builder.build(vec![b], None, MotionOptions::default()).unwrap();
        let all = linkage.joints.len();
        assert_eq!(distance_bounds(&linkage, all, [o, c]), [10.0, 10.0], "on one link");
        assert_eq!(distance_bounds(&linkage, all, [a, c]), [9.0, 11.0], "by the frame and the crank");
        assert_eq!(distance_bounds(&linkage, all, [b, o]), [8.0, 10.0], "by the coupler and the crank");
        let without_dyad = b.index();
        assert_eq!(distance_bounds(&linkage, without_dyad, [c, a]), [9.0, 11.0], "without the links of B");
    }
}

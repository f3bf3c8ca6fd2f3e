use super::{Bounds, Point, distance_to_segment};

/// The points within a distance `radius` of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// The ends of the segment.
    pub ends: [Point; 2],
    /// The radius, not negative.
    pub radius: f64,
}

/// A set of capsules, indexed for the distance of a point from the nearest of them.
///
/// The index is a binary tree of bounds over runs of consecutive capsules. A query takes logarithmic time if
/// consecutive capsules are neighbours; its result is correct in any order.
#[derive(Clone, Debug)]
pub struct CapsuleTree {
    capsules: Vec<Capsule>,
    /// The root is at 1, the children of node `k` at `2k` and `2k + 1`, the leaves last; empty bounds pad the last row.
    nodes: Vec<Node>,
}

/// The bounds of the segments of some capsules, and their greatest radius.
#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    radius: f64,
}

impl CapsuleTree {
    /// The number of capsules in a leaf of the tree.
    const LEAF_SIZE: usize = 4;

    /// Builds the tree; neighbouring capsules should be consecutive.
    pub fn new(capsules: Vec<Capsule>) -> CapsuleTree {
        let leaves = capsules.len().div_ceil(Self::LEAF_SIZE).next_power_of_two();
        let mut nodes = vec![Node { bounds: Bounds::EMPTY, radius: 0.0 }; 2 * leaves];
        for (node, run) in nodes[leaves..].iter_mut().zip(capsules.chunks(Self::LEAF_SIZE)) {
            let bounds = Bounds::from_points(run.iter().flat_map(|capsule| capsule.ends));
            *node = Node { bounds, radius: run.iter().map(|capsule| capsule.radius).fold(0.0, f64::max) };
        }
        for k in (1..leaves).rev() {
            let [a, b] = [nodes[2 * k], nodes[2 * k + 1]];
            nodes[k] = Node { bounds: a.bounds.union(b.bounds), radius: a.radius.max(b.radius) };
        }
        CapsuleTree { capsules, nodes }
    }

    /// The distance of a point from the nearest capsule, negative inside one; infinite if there is no capsule.
    ///
    /// The search ends as soon as the distance is known to be at most `enough`; the result is then at most `enough`,
    /// but need not be the least.
    pub fn signed_distance(&self, point: Point, enough: f64) -> f64 {
        let mut least = f64::INFINITY;
        self.search(1, point, enough, &mut least);
        least
    }

    fn search(&self, k: usize, point: Point, enough: f64, least: &mut f64) {
        let leaves = self.nodes.len() / 2;
        if k >= leaves {
            let from = (k - leaves) * Self::LEAF_SIZE;
            for capsule in self.capsules.iter().skip(from).take(Self::LEAF_SIZE) {
                let distance = distance_to_segment(point, capsule.ends[0], capsule.ends[1]) - capsule.radius;
                // NaN, which overflow may give, is ignored.
                if distance < *least {
                    *least = distance;
                }
            }
            return;
        }
        let mut children = [2 * k, 2 * k + 1].map(|child| (self.nodes[child].lower_bound(point), child));
        if children[1].0 < children[0].0 {
            children.swap(0, 1);
        }
        for (bound, child) in children {
            if *least > enough && bound < *least {
                self.search(child, point, enough, least);
            }
        }
    }
}

impl Node {
    /// A lower bound of the distances from the capsules of the node.
    fn lower_bound(&self, p: Point) -> f64 {
        let Bounds { min, max } = self.bounds;
        let x = (min.x - p.x).max(p.x - max.x).max(0.0);
        let y = (min.y - p.y).max(p.y - max.y).max(0.0);
        (x * x + y * y).sqrt() - self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::trig;

    /// Consecutive chords of a rose curve, as capsules of several radii.
    fn capsules(count: u32) -> Vec<Capsule> {
        let at = |k: u32| {
            let (cos, sin) = trig::cos_sin_deg(f64::from(k) * 0.72);
            let (petal, _) = trig::cos_sin_deg(f64::from(k) * 2.88);
            Point::new(30.0 * petal * cos, 30.0 * petal * sin)
        };
        (0..count).map(|k| Capsule { ends: [at(k), at(k + 1)], radius: 0.01 * f64::from(k % 7) }).collect()
    }

    #[test]
    fn the_tree_agrees_with_a_linear_search() {
        for count in [1, 2, 4, 5, 31, 500] {
            let capsules = capsules(count);
            let tree = CapsuleTree::new(capsules.clone());
            for k in 0..400 {
                let point = Point::new(f64::from(k % 20) * 4.0 - 38.0, f64::from(k / 20) * 4.0 - 37.0);
                let each = capsules.iter().map(|t| distance_to_segment(point, t.ends[0], t.ends[1]) - t.radius);
                let least = each.fold(f64::INFINITY, f64::min);
                assert_eq!(tree.signed_distance(point, f64::NEG_INFINITY), least);
                let early = tree.signed_distance(point, 3.0);
                assert!(early == least || (least..=3.0).contains(&early));
            }
        }
    }

    #[test]
    fn the_distance_from_no_capsules_or_overflowing_ones_is_infinite() {
        let far = Capsule { ends: [Point::new(1e200, 0.0), Point::new(-1e200, f64::NAN)], radius: 0.0 };
        for capsules in [vec![], vec![far; 9]] {
            assert_eq!(CapsuleTree::new(capsules).signed_distance(Point::origin(), 0.0), f64::INFINITY);
        }
    }
}

use super::{Bounds, Point, distance_to_segment};

/// All points that are no further than `radius` from a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// The ends of the segment.
    pub ends: [Point; 2],
    /// The radius, not negative.
    pub radius: f64,
}

/// Many tubes, ready to be asked how far points lie outside of all of them.
///
/// Tubes that follow each other are taken for neighbours: a binary tree of boxes stands over runs of them. An answer
/// takes about the logarithm of their number where they do follow each other, and is right in any order.
#[derive(Clone, Debug)]
pub struct CapsuleTree {
    capsules: Vec<Capsule>,
    /// The root at 1, the children of node `k` at `2k` and `2k + 1`, the leaves last; empty boxes fill up the last row.
    nodes: Vec<Node>,
}

/// The box round the segments of some tubes, and their largest radius.
#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    radius: f64,
}

impl CapsuleTree {
    /// How many tubes a leaf of the tree has.
    const LEAF_SIZE: usize = 4;

    /// Tubes, best in the order in which they hang together.
    pub fn new(tubes: Vec<Capsule>) -> CapsuleTree {
        let leaves = tubes.len().div_ceil(Self::LEAF_SIZE).next_power_of_two();
        let mut nodes = vec![Node { bounds: Bounds::EMPTY, radius: 0.0 }; 2 * leaves];
        for (node, run) in nodes[leaves..].iter_mut().zip(tubes.chunks(Self::LEAF_SIZE)) {
            let bounds = Bounds::from_points(run.iter().flat_map(|tube| tube.ends));
            *node = Node { bounds, radius: run.iter().map(|tube| tube.radius).fold(0.0, f64::max) };
        }
        for k in (1..leaves).rev() {
            let [a, b] = [nodes[2 * k], nodes[2 * k + 1]];
            nodes[k] = Node { bounds: a.bounds.union(b.bounds), radius: a.radius.max(b.radius) };
        }
        CapsuleTree { capsules: tubes, nodes }
    }

    /// How far a point is outside of the tube that is nearest, negative inside of one; infinite where there is none.
    ///
    /// The search ends as soon as it is known to be no more than `enough`: what is returned is then no more than that,
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
            for tube in self.capsules.iter().skip(from).take(Self::LEAF_SIZE) {
                let outside = distance_to_segment(point, tube.ends[0], tube.ends[1]) - tube.radius;
                // What is not a number, of places beyond all numbers, is near to nothing.
                if outside < *least {
                    *least = outside;
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
    /// No tube of the node is nearer than this.
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

    /// A rose of 500 chords in tubes of several radii.
    fn tubes(count: u32) -> Vec<Capsule> {
        let at = |k: u32| {
            let (cos, sin) = trig::cos_sin_deg(f64::from(k) * 0.72);
            let (petal, _) = trig::cos_sin_deg(f64::from(k) * 2.88);
            Point::new(30.0 * petal * cos, 30.0 * petal * sin)
        };
        (0..count).map(|k| Capsule { ends: [at(k), at(k + 1)], radius: 0.01 * f64::from(k % 7) }).collect()
    }

    #[test]
    fn the_tree_finds_what_a_look_at_each_finds() {
        for count in [1, 2, 4, 5, 31, 500] {
            let tubes = tubes(count);
            let tree = CapsuleTree::new(tubes.clone());
            for k in 0..400 {
                let point = Point::new(f64::from(k % 20) * 4.0 - 38.0, f64::from(k / 20) * 4.0 - 37.0);
                let each = tubes.iter().map(|t| distance_to_segment(point, t.ends[0], t.ends[1]) - t.radius);
                let least = each.fold(f64::INFINITY, f64::min);
                assert_eq!(tree.signed_distance(point, f64::NEG_INFINITY), least);
                let soon = tree.signed_distance(point, 3.0);
                assert!(soon == least || (least..=3.0).contains(&soon));
            }
        }
    }

    #[test]
    fn nothing_is_near_to_nothing_and_to_places_beyond_all_numbers() {
        let far = Capsule { ends: [Point::new(1e200, 0.0), Point::new(-1e200, f64::NAN)], radius: 0.0 };
        for tubes in [vec![], vec![far; 9]] {
            assert_eq!(CapsuleTree::new(tubes).signed_distance(Point::origin(), 0.0), f64::INFINITY);
        }
    }
}

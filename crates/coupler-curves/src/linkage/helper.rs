//! Joints that are no pins: points of links and of the frame that only serve to place others.

use super::{Closure, JointId, JointKind, Linkage};

impl Linkage {
    /// Whether a joint only serves to place others: it is a point of one link that nothing is connected to and nothing slides by, that is not
    /// traced or loaded or a part of a chain, and that others are placed by. A fixed point that only defines the direction of a line is one, too; two points of a
    /// moving link on whose line another joint slides are its guide.
    pub fn is_helper(&self, joint: JointId) -> bool {
        self.places_as_mere_point(joint, matches!(self.joints[joint].kind, JointKind::Fixed(_))) == Some(true)
    }

    /// Whether a joint is a point of one link that nothing is connected to, and that is not traced or loaded or a part of a chain; others may slide on a
    /// line through it.
    pub fn is_mere_point(&self, joint: JointId) -> bool {
        self.places_as_mere_point(joint, true).is_some()
    }

    /// Whether others are placed by a joint; `None` if it is not a mere point, on whose lines others may slide if `has_line`.
    fn places_as_mere_point(&self, joint: JointId, has_line: bool) -> Option<bool> {
        match self.joints[joint].kind {
            JointKind::Fixed(_)
            | JointKind::Rigid { .. }
            | JointKind::Aligned { .. }
            | JointKind::Parallelogram { .. } => {}
            _ => return None,
        }
        let is_shown = self.traced.contains(&joint)
            || self.chains.iter().flatten().any(|shown| *shown == joint)
            || self.load.is_some_and(|load| load.joint == joint);
        if self.link_count(joint) > 1 || is_shown {
            return None;
        }
        let mut places_another = false;
        for other in &self.joints {
            match self.use_by(&other.kind, joint) {
                Some(Use::Connection) => return None,
                Some(Use::Line) if !has_line => return None,
                Some(_) => places_another = true,
                None => {}
            }
        }
        for closure in self.group.iter().flat_map(|group| &group.closures) {
            match closure {
                Closure::OnLine { line, .. } if has_line && line.contains(&joint) => places_another = true,
                closure if closure.joints().contains(&joint) => return None,
                _ => {}
            }
        }
        Some(places_another)
    }

    /// Whether a joint that is drawn is a pin: the foot of a slot's line, a yoke and a rack are none, unless another link is on them.
    pub fn is_pin(&self, joint: JointId) -> bool {
        let is_place =
            matches!(self.joints[joint].kind, JointKind::Slot { .. } | JointKind::Yoke { .. } | JointKind::Rack { .. });
        !is_place || self.link_count(joint) > 1
    }

    /// The number of links that a joint is on.
    fn link_count(&self, joint: JointId) -> usize {
        self.links.iter().filter(|link| link.position(joint).is_some()).count()
    }

    /// What a joint is for another one that is placed in this way.
    fn use_by(&self, kind: &JointKind, joint: JointId) -> Option<Use> {
        let (connected, line, reference): (&[JointId], &[JointId], &[JointId]) = match kind {
            JointKind::Fixed(_) | JointKind::Grouped { .. } => (&[], &[], &[]),
            JointKind::Crank { pivot, .. } | JointKind::Gear { pivot, .. } => (std::slice::from_ref(pivot), &[], &[]),
            JointKind::Piston { base, .. } | JointKind::Dyad { base, .. } | JointKind::Slot { base, .. } => {
                (base, &[], &[])
            }
            JointKind::Slide { from, line, .. } | JointKind::Yoke { from, line, .. } => {
                (std::slice::from_ref(from), line, &[])
            }
            JointKind::Rack { line, .. } | JointKind::DrivenSlider { line, .. } => (&[], line, &[]),
            JointKind::Aligned { from, line, .. } => {
                (&[], &[], if line.contains(&joint) { line } else { std::slice::from_ref(from) })
            }
            JointKind::Parallelogram { corners } => (&[], &[], corners),
            JointKind::Rigid { base, .. } => (&[], &[], base),
        };
        match joint {
            _ if connected.contains(&joint) => Some(Use::Connection),
            _ if line.contains(&joint) => Some(Use::Line),
            _ if reference.contains(&joint) => Some(Use::Reference),
            _ => None,
        }
    }
}

/// What a joint is for another one.
enum Use {
    /// A link or a slot of the other one is connected to it.
    Connection,
    /// The other one slides along a line through it.
    Line,
    /// Coordinates are measured from it.
    Reference,
}

#[cfg(test)]
mod tests {
    use crate::catalogue;
    use crate::linkage::{Linkage, LinkageBuilder, MotionOptions, Side};

    fn helpers(linkage: &Linkage) -> Vec<&str> {
        let helpers = linkage.joint_ids().filter(|&joint| linkage.is_helper(joint));
        helpers.map(|joint| linkage.joints[joint].name.as_str()).collect()
    }

    #[test]
    fn points_of_reference_are_helpers_and_pins_are_not() {
        for (id, expected) in [
            ("evans", vec![]),
            ("cognates", vec![]),
            ("jansen", vec![]),
            ("whitworth", vec!["X"]),
            ("rack-steering", vec!["X"]),
            ("gripper", vec!["B", "T"]),
        ] {
            assert_eq!(helpers(&catalogue::find(id).unwrap().structure().unwrap()), expected, "{id}");
        }
    }

    /// The coupler of an inverted slider-crank by a parallelogram: N is a point of the arm, and U is where nothing is.
    #[test]
    fn a_direction_by_a_parallelogram_has_helpers() {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", [0.0, 0.0].into());
        let c = builder.fixed("C", [2.0, 0.0].into());
        let a = builder.crank("A", o, 1.0).unwrap();
        let b = builder.slot("B", [c, a], 0.5, Side::Right).unwrap();
        let n = builder.point("N", [c, a], 0.5, -0.5).unwrap();
        let u = builder.parallelogram("U", [a, b, n]).unwrap();
        let m = builder.point("M", [a, u], -3.0, 0.0).unwrap();
        let linkage = |traced| builder.clone().build(traced, None, MotionOptions::default()).unwrap();
        assert_eq!(helpers(&linkage(vec![m])), ["N", "U"]);
        assert_eq!(helpers(&linkage(vec![m, u])), ["N"]);
    }
}

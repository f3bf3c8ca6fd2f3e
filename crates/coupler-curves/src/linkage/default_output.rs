//! The output link of a linkage that states none.

use super::{Closure, JointId, JointKind, Linkage, OutputLink};

impl Linkage {
    /// The output link: the one stated, or else the last driven link on the ground. Of the links that are pivoted on
    /// the [ground](Linkage::ground) or slide along it, that is the one whose joint is placed last; neither the crank
    /// that is the input nor an actuator is one of them. `None` if there is no such link.
    pub fn output(&self) -> Option<OutputLink> {
        self.output_link
            .or_else(|| self.group_link_on_ground())
            .or_else(|| self.joint_ids().rev().find_map(|joint| self.driven_link_on_ground(joint)))
    }

    /// The last link of the group that turns about a joint of the ground, or slides on a line of it.
    fn group_link_on_ground(&self) -> Option<OutputLink> {
        let is_on_ground = |joint: JointId| self.ground().position(joint).is_some();
        self.group.as_ref()?.closures.iter().rev().find_map(|closure| match *closure {
            Closure::Distance { joints: [a, b], .. } => match [a, b].map(is_on_ground) {
                [true, false] => Some(OutputLink::Link([a, b])),
                [false, true] => Some(OutputLink::Link([b, a])),
                _ => None,
            },
            Closure::OnLine { joint, line, .. } => {
                line.into_iter().all(is_on_ground).then_some(OutputLink::Slider { joint, line })
            }
            Closure::OnLink { .. } | Closure::Driven { .. } => None,
        })
    }

    /// The link on the ground that a joint was placed with.
    fn driven_link_on_ground(&self, joint: JointId) -> Option<OutputLink> {
        let is_on_ground = |joint: JointId| self.ground().position(joint).is_some();
        // A bar that turns about the one of its ends that is on the ground.
        let bar = |from: JointId, to: JointId| match (is_on_ground(from), is_on_ground(to)) {
            (true, false) => Some(OutputLink::Link([from, to])),
            (false, true) => Some(OutputLink::Link([to, from])),
            _ => None,
        };
        match self.joints[joint].kind {
            JointKind::Dyad { base: [p, q], .. } => bar(q, joint).or_else(|| bar(p, joint)),
            JointKind::Parallelogram { corners: [p, _, r] } => bar(p, joint).or_else(|| bar(r, joint)),
            JointKind::Gear { pivot, .. } => bar(pivot, joint),
            JointKind::Piston { base: [_, pivot], .. } => bar(pivot, joint),
            JointKind::Slide { from, line, .. } => {
                let slides_on_ground = line.into_iter().all(is_on_ground);
                let slider = slides_on_ground.then_some(OutputLink::Slider { joint, line });
                slider.or_else(|| bar(from, joint))
            }
            JointKind::Yoke { line, .. } | JointKind::Rack { line, .. } => {
                line.into_iter().all(is_on_ground).then_some(OutputLink::Slider { joint, line })
            }
            JointKind::Slot { base: [pivot, _], offset, .. } if offset != 0.0 => bar(pivot, joint),
            JointKind::Slot { base, dyad, .. } => is_on_ground(base[0]).then_some(OutputLink::Slot { base, dyad }),
            JointKind::Fixed(_)
            | JointKind::Crank { .. }
            | JointKind::DrivenSlider { .. }
            | JointKind::Aligned { .. }
            | JointKind::Grouped { .. }
            | JointKind::Rigid { .. } => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::linkage::{Error, LinkageBuilder, MotionOptions, OutputLink, Side};

    #[test]
    fn the_default_is_the_last_driven_link_on_the_ground() {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", [0.0, 0.0].into());
        let c = builder.fixed("C", [4.0, 0.0].into());
        let a = builder.crank("A", o, 1.0).unwrap();
        let only_crank = builder.clone().build(vec![a], None, MotionOptions::default()).unwrap();
        assert_eq!(only_crank.output(), None);
        let b = builder.dyad("B", [a, c], [3.0, 3.5], Side::Left).unwrap();
        let m = builder.point("M", [a, b], 1.0, 1.0).unwrap();
        let four_bar = builder.clone().build(vec![m], None, MotionOptions::default()).unwrap();
        assert_eq!(four_bar.output(), Some(OutputLink::Link([c, b])));
        // Seen from its coupler, the rocker is the link on the ground that is not driven.
        let seen = builder.clone().build(vec![m], Some([a, b]), MotionOptions::default()).unwrap();
        assert_eq!(seen.output(), Some(OutputLink::Link([b, c])));
        let s = builder.slide("S", (b, 5.0), ([o, c], 0.5), Side::Left).unwrap();
        let slider = builder.clone().build(vec![m], None, MotionOptions::default()).unwrap();
        assert_eq!(slider.output(), Some(OutputLink::Slider { joint: s, line: [o, c] }));
        builder.set_output_link([c, b]).unwrap();
        let stated = builder.clone().build(vec![m], None, MotionOptions::default()).unwrap();
        assert_eq!(stated.output(), Some(OutputLink::Link([c, b])));
        // Another moving link, a slider by its joint, and what is neither.
        builder.set_output_link([b, a]).unwrap();
        builder.set_output_slider(s).unwrap();
        assert!(matches!(builder.clone().set_output_slider(b), Err(Error::NotASlider { .. })));
        assert!(matches!(builder.clone().set_output_link([o, b]), Err(Error::NoCommonLink { .. })));
        builder.set_output_link([o, c]).unwrap();
        let at_rest = builder.build(vec![m], None, MotionOptions::default());
        assert!(matches!(at_rest, Err(Error::OutputAtRest { .. })));
    }
}

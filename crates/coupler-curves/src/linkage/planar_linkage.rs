//! A linkage as a list of joints and links.

use super::{
    Closure, DwellBand, DyadId, Error, Group, Input, Joint, JointId, JointKind, Link, Load, MotionOptions, OutputLink,
};
use crate::geometry::{Orientation, Point, trig};

/// A linkage with numeric dimensions. All lengths are in one unit, which may be any.
#[derive(Clone, Debug, PartialEq)]
pub struct Linkage {
    /// The joints in the order they are placed: each refers to earlier joints only, but for those of the group.
    pub joints: Vec<Joint>,
    /// The links; the first is the frame, which carries the fixed joints.
    pub links: Vec<Link>,
    /// The joints that no dyads place, if there are any, and the equations that do.
    pub group: Option<Group>,
    /// The same linkage driven elsewhere, so that dyads place all joints of the group, by their names: its circuits are those of this one. `None` if
    /// there is no such input, or only the circuit through the start is asked for.
    pub driven_elsewhere: Option<Box<Linkage>>,
    /// The joints whose curves are traced, in the order of the curves.
    pub traced: Vec<JointId>,
    /// Two joints of the link in whose frame everything is reported: the one at its origin and one on its positive
    /// x-axis; `None` for the fixed frame.
    pub seen_from: Option<[JointId; 2]>,
    /// The output link that is stated; where there is none, [`Linkage::output`] is the default.
    pub output_link: Option<OutputLink>,
    /// The force that it moves against, if there is one.
    pub load: Option<Load>,
    /// How far each of its lengths may be off, if that is to be measured: positive.
    pub tolerance: Option<f64>,
    /// How far its output may move while it dwells.
    pub dwell: DwellBand,
    /// The chains it is composed of in addition to the first, such as the cognates of a four-bar, each by its joints: the
    /// links between them are a part of the linkage that a figure distinguishes.
    pub chains: Vec<Vec<JointId>>,
    /// The orientation applied to everything reported, after `seen_from`.
    pub placement: Orientation,
    /// The start of the motion, its input range and its circuits.
    pub motion_options: MotionOptions,
}

impl Linkage {
    /// The kind of input that drives it.
    pub fn input(&self) -> Input {
        if self.driven_distance().is_some() {
            return Input::Length;
        }
        let mut turns = 1;
        let mut has_rack = false;
        for joint in &self.joints {
            match joint.kind {
                JointKind::Piston { .. } | JointKind::DrivenSlider { .. } => return Input::Length,
                JointKind::Gear { ratio: [_, crank_turns], .. } => {
                    // Several gears repeat together after the least common multiple of their turns.
                    let crank_turns = crank_turns.unsigned_abs() as u32;
                    turns = turns / gcd(turns, crank_turns) * crank_turns;
                }
                // It never is back; the range of the input, which is less than these turns, does without a period.
                JointKind::Rack { .. } => has_rack = true,
                _ => {}
            }
        }
        Input::Angle { turns: if has_rack { turns.max(Error::MAX_RACK_TURNS) } else { turns } }
    }

    /// The two joints of a group between which an actuator drives it, if one does.
    pub fn driven_distance(&self) -> Option<[JointId; 2]> {
        self.group.as_ref()?.closures.iter().find_map(|closure| match *closure {
            Closure::Driven { joints } => Some(joints),
            _ => None,
        })
    }

    /// The joints at the ends of the linear actuators that drive it by their length.
    pub fn actuators(&self) -> Vec<[JointId; 2]> {
        let piston = |joint: JointId| match self.joints[joint].kind {
            JointKind::Piston { base: [pivot, _], .. } => Some([pivot, joint]),
            _ => None,
        };
        self.joint_ids().filter_map(piston).chain(self.driven_distance()).collect()
    }

    /// Whether a slider drives it.
    pub fn is_driven_by_slider(&self) -> bool {
        self.joints.iter().any(|joint| matches!(joint.kind, JointKind::DrivenSlider { .. }))
    }

    /// The two joints of the line on which a joint slides: of a slider, a yoke, a driven slider, or a joint of the group; `None` if it is
    /// none of these.
    pub fn slider_line(&self, joint: JointId) -> Option<[JointId; 2]> {
        let in_group = || {
            self.group.as_ref()?.closures.iter().find_map(|closure| match *closure {
                Closure::OnLine { joint: own, line, .. } if own == joint => Some(line),
                _ => None,
            })
        };
        self.joints[joint].kind.slider_line().or_else(in_group)
    }

    /// The turns of its fastest crank for a turn of the driven one, at least 1.
    pub fn fastest_crank_ratio(&self) -> f64 {
        let ratio = |joint: &Joint| match joint.kind {
            JointKind::Gear { ratio: [turns, crank_turns], .. } => (turns as f64 / crank_turns as f64).abs(),
            _ => 1.0,
        };
        self.joints.iter().map(ratio).fold(1.0, f64::max)
    }

    /// The ids of the joints, in the order of [`Linkage::joints`].
    pub fn joint_ids(&self) -> impl DoubleEndedIterator<Item = JointId> + Clone + use<> {
        (0..self.joints.len()).map(JointId::new)
    }

    /// The ids of the dyads, in the order of their joints.
    pub fn dyad_ids(&self) -> impl DoubleEndedIterator<Item = DyadId> + Clone + use<> {
        (0..self.dyad_count()).map(DyadId::new)
    }

    /// The first joint with a name.
    pub fn find_joint(&self, name: &str) -> Option<JointId> {
        self.joints.iter().position(|joint| joint.name == name).map(JointId::new)
    }

    /// The linkage with only one of the rigid points at the end of the list of joints, and that joint's index in it.
    ///
    /// Of the trailing rigid points that no other joint refers to, only `joint` is kept, so that a computation for
    /// one point of a grid does not place the others. All joints before them keep their indices.
    pub fn with_one_point(&self, joint: JointId) -> (Linkage, JointId) {
        let mut first = self.joints.len();
        let output_joints = self.output().map(OutputLink::joints).unwrap_or_default();
        let closures = self.group.iter().flat_map(|group| &group.closures);
        let of_group = closures.flat_map(|closure| closure.joints());
        let loaded = self.load.map(|load| load.joint);
        let kept_joints = self.seen_from.into_iter().flatten().chain(output_joints).chain(of_group).chain(loaded);
        let mut base_of_all = kept_joints.map(JointId::index).max().unwrap_or(0);
        while let Some(JointKind::Rigid { base: [p, q], .. }) = first.checked_sub(1).map(|last| self.joints[last].kind)
        {
            base_of_all = base_of_all.max(p.index()).max(q.index());
            if base_of_all >= first - 1 {
                break;
            }
            first -= 1;
        }
        let kept: Vec<JointId> =
            self.joint_ids().take(first).chain((joint.index() >= first).then_some(joint)).collect();
        let new_id = |old: JointId| kept.iter().position(|&kept| kept == old).map(JointId::new);
        let link = |link: &Link| Link {
            joints: link.joints.iter().filter_map(|&(joint, position)| Some((new_id(joint)?, position))).collect(),
        };
        let linkage = Linkage {
            joints: kept.iter().map(|&joint| self.joints[joint].clone()).collect(),
            links: self.links.iter().map(link).collect(),
            group: self.group.clone(),
            driven_elsewhere: self.driven_elsewhere.clone(),
            traced: new_id(joint).into_iter().collect(),
            seen_from: self.seen_from,
            output_link: self.output_link,
            load: self.load,
            tolerance: self.tolerance,
            dwell: self.dwell,
            chains: Vec::new(),
            placement: self.placement,
            motion_options: self.motion_options.clone(),
        };
        (linkage, joint.min(JointId::new(first)))
    }

    /// The number of dyads; a group counts as one.
    pub fn dyad_count(&self) -> usize {
        match self.group {
            Some(_) => 1,
            None => self.joints.iter().filter(|joint| joint.kind.dyad().is_some()).count(),
        }
    }

    /// The input in a pose, in the frame of the fixed joints: an angle in degrees, or a length.
    pub(crate) fn input_of_pose(&self, at: impl Fn(JointId) -> Point) -> Option<f64> {
        if let Some([a, b]) = self.driven_distance() {
            return Some((at(b) - at(a)).norm());
        }
        self.joint_ids().find_map(|joint| match self.joints[joint].kind {
            JointKind::Crank { pivot, .. } => {
                let arm = at(joint) - at(pivot);
                Some(trig::degrees(trig::atan2(arm.y, arm.x)))
            }
            JointKind::Piston { base: [from, _], .. } => Some((at(joint) - at(from)).norm()),
            JointKind::DrivenSlider { line: [p, q], .. } => Some((at(q) - at(p)).normalize().dot(&(at(joint) - at(p)))),
            _ => None,
        })
    }

    /// The pivot and the pin of the crank whose angle is the input; `None` if an actuator drives the linkage.
    pub fn crank(&self) -> Option<[JointId; 2]> {
        self.joint_ids().find_map(|pin| match self.joints[pin].kind {
            JointKind::Crank { pivot, .. } => Some([pivot, pin]),
            _ => None,
        })
    }

    /// The length of that crank.
    pub fn crank_length(&self) -> Option<f64> {
        self.joints.iter().find_map(|joint| match joint.kind {
            JointKind::Crank { length, .. } => Some(length),
            _ => None,
        })
    }

    /// The link that is at rest in the reported frame: that of `seen_from`, or the frame.
    pub fn ground(&self) -> &Link {
        let seen =
            |link: &&Link| self.seen_from.is_some_and(|joints| joints.iter().all(|&j| link.position(j).is_some()));
        self.links.iter().find(seen).unwrap_or(&self.links[0])
    }
}

/// The greatest common divisor of two numbers that are not both zero.
pub(crate) fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

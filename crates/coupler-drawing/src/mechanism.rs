//! The parts of a linkage that are drawn: links as bars and plates, pivots, sliders with their guides, slots, actuators
//! and gears.
//!
//! The parts are those of a linkage on a circuit; where they are in a pose is for the drawing to compute.

use coupler_curves::geometry::{Bounds, Point, Vector, cross, left_normal};
use coupler_curves::linkage::{JointId, JointKind, LinkOutline, Linkage};
use coupler_curves::motion::Circuit;
use coupler_curves::parts::{Idler, idlers, pitch_circles, pitch_line_offset};

/// The parts of a linkage on a circuit.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism {
    /// The moving links, each with its joints in the order of its outline.
    pub links: Vec<LinkOutline>,
    /// The joints that only serve to place others, which no link is drawn through.
    pub helpers: Vec<JointId>,
    /// The joints that the frame shares with moving links.
    pub pivots: Vec<JointId>,
    /// The sliders on lines of the frame or of a link.
    pub blocks: Vec<Block>,
    /// The slots in moving links.
    pub slots: Vec<Slot>,
    /// The actuators, from the pivot of the cylinder to the joint of the rod.
    pub actuators: Vec<[JointId; 2]>,
    /// The guides of sliders and yokes on the frame.
    pub guides: Vec<Guide>,
    /// The pitch circles of gears, with those of idlers.
    pub gears: Vec<Gear>,
}

/// The pitch circle of a gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gear {
    /// The joint at its centre, or of an idler the pivots of both gears that it is between.
    pub pivots: [JointId; 2],
    /// How far the centre is from the first pivot towards the second.
    pub distance: f64,
    /// The radius.
    pub radius: f64,
}

impl Gear {
    /// The centre in a pose.
    pub fn centre_in(&self, pose: &[Point]) -> Point {
        let [from, to] = self.pivots.map(|pivot| pose[pivot]);
        from + (to - from).try_normalize(0.0).unwrap_or(Vector::zeros()) * self.distance
    }
}

/// A sliding block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// The joint at its centre.
    pub joint: JointId,
    /// Two joints on the line that it slides along.
    pub line: [JointId; 2],
}

/// A guide on the frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guide {
    /// The joint of the slider or yoke.
    pub joint: JointId,
    /// The ends of the part that the joint uses.
    pub ends: [Point; 2],
}

/// A slot in a moving link: the part of the line that the joint in it uses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slot {
    /// The foot of the line, or the joint of the yoke, or the first joint of the line of a slider.
    pub foot: JointId,
    /// The joint that slides in it.
    pub through: JointId,
    /// Two joints, in whose direction the slot turns.
    pub base: [JointId; 2],
    /// The ends of the slot relative to its foot, along and across the direction of the base.
    pub ends: [Vector; 2],
}

impl Mechanism {
    /// The parts of a linkage on a circuit.
    pub fn new(linkage: &Linkage, circuit: &Circuit) -> Mechanism {
        let block = |joint: JointId| linkage.slider_line(joint).map(|line| Block { joint, line });
        Mechanism {
            links: circuit.link_outlines(linkage),
            helpers: circuit.helpers(linkage),
            pivots: linkage.pivots(),
            blocks: linkage.joint_ids().filter_map(block).collect(),
            slots: linkage.joint_ids().flat_map(|joint| find_slots(linkage, circuit, joint)).collect(),
            actuators: linkage.actuators(),
            guides: linkage.joint_ids().flat_map(|joint| find_guides(linkage, circuit, joint)).collect(),
            gears: gears(linkage, circuit),
        }
    }

    /// The joints that are drawn: those of links, and the pivots, each once and in order. The foot of a slot without
    /// offset is its pivot, and is left out.
    pub fn drawn_joints(&self, linkage: &Linkage) -> Vec<JointId> {
        let mut joints: Vec<JointId> = self.links.iter().flat_map(|outline| outline.joints.iter().copied()).collect();
        joints.extend(&self.pivots);
        joints.sort_unstable();
        joints.dedup();
        joints.retain(|&joint| !matches!(linkage.joints[joint].kind, JointKind::Slot { offset: 0.0, .. }));
        joints
    }

    /// The bounds of everything that is drawn of the linkage in a pose.
    pub fn bounds(&self, pose: &[Point]) -> Bounds {
        let gears = self.gears.iter().flat_map(|gear| {
            let (centre, radius) = (gear.centre_in(pose), Vector::repeat(gear.radius));
            [centre - radius, centre + radius]
        });
        let joints = self.links.iter().flat_map(|outline| &outline.joints).chain(&self.pivots);
        let joints = joints.map(|&joint| pose[joint]);
        let slots = self.slots.iter().flat_map(|slot| slot.ends_in(pose));
        Bounds::from_points(joints.chain(self.guides.iter().flat_map(|guide| guide.ends)).chain(gears).chain(slots))
    }
}

impl Slot {
    /// The ends of the slot in a pose.
    pub fn ends_in(&self, pose: &[Point]) -> [Point; 2] {
        let [from, to] = self.base;
        let unit = (pose[to] - pose[from]).normalize();
        self.ends.map(|end| pose[self.foot] + unit * end.x + left_normal(unit) * end.y)
    }
}

/// The gears and the idlers between them.
fn gears(linkage: &Linkage, circuit: &Circuit) -> Vec<Gear> {
    let gears = pitch_circles(linkage, circuit).into_iter();
    let gears = gears.map(|circle| Gear { pivots: [circle.centre; 2], distance: 0.0, radius: circle.radius });
    let idlers = idlers(linkage, circuit).into_iter();
    gears.chain(idlers.map(|Idler { pivots, distance, radius, .. }| Gear { pivots, distance, radius })).collect()
}

/// The guide on the frame of a slider, a yoke or a rack, and the pitch line of a rack that is not on its guide.
fn find_guides(linkage: &Linkage, circuit: &Circuit, joint: JointId) -> Vec<Guide> {
    let guide = || {
        let along = fixed_line_direction(linkage, circuit, linkage.slider_line(joint)?)?;
        let by = |a: &Point, b: &Point| along.dot(&a.coords).total_cmp(&along.dot(&b.coords));
        Some(([circuit.points(joint).min_by(by)?, circuit.points(joint).max_by(by)?], along))
    };
    let Some((ends, along)) = guide() else { return Vec::new() };
    let pitch_line = || {
        let offset = pitch_line_offset(linkage, circuit, joint).filter(|offset| *offset != 0.0)?;
        let aside = left_normal(along.try_normalize(0.0)?) * offset;
        Some(ends.map(|end| end + aside))
    };
    [Some(ends), pitch_line()].into_iter().flatten().map(|ends| Guide { joint, ends }).collect()
}

/// The direction of a line through two joints; `None` if it is not on the frame.
fn fixed_line_direction(linkage: &Linkage, circuit: &Circuit, [p, q]: [JointId; 2]) -> Option<Vector> {
    let ground = linkage.ground();
    (ground.position(p).is_some() && ground.position(q).is_some()).then_some(())?;
    Some(circuit.positions.point(q, 0) - circuit.positions.point(p, 0))
}

/// The slots that a joint is the foot or the yoke of, and that it slides in on a moving link.
fn find_slots(linkage: &Linkage, circuit: &Circuit, joint: JointId) -> impl Iterator<Item = Slot> {
    // The line turns with a base: the pivot and the foot of a slot, the guide of a yoke, or the line itself of a slot
    // without offset and of a slider.
    let own = match linkage.joints[joint].kind {
        JointKind::Slot { base: [pivot, through], offset: 0.0, .. } => Some((joint, [pivot, through], through)),
        JointKind::Slot { base: [pivot, through], .. } => Some((joint, [pivot, joint], through)),
        JointKind::Yoke { from, line, .. } => Some((joint, line, from)),
        _ => None,
    };
    let line = linkage.slider_line(joint).filter(|line| fixed_line_direction(linkage, circuit, *line).is_none());
    let of_line = line.map(|line| (line[0], line, joint));
    [own, of_line].into_iter().flatten().filter_map(|slot| used_slot(circuit, slot))
}

/// The slot of a foot and a base that a joint uses.
fn used_slot(circuit: &Circuit, (foot, [from, to], through): (JointId, [JointId; 2], JointId)) -> Option<Slot> {
    let in_base = |base: Vector, arm: Vector| Vector::new(base.dot(&arm), cross(base, arm)) / base.norm();
    let point = |joint, sample| circuit.positions.point(joint, sample);
    let arm = |i: usize| in_base(point(to, i) - point(from, i), point(through, i) - point(foot, i));
    let arms: Vec<Vector> = (0..circuit.len()).map(arm).filter(|arm| arm.x.is_finite() && arm.y.is_finite()).collect();
    let longest = arms.iter().max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))?;
    let by = |a: &&Vector, b: &&Vector| longest.dot(a).total_cmp(&longest.dot(b));
    let ends = [*arms.iter().min_by(by)?, *arms.iter().max_by(by)?];
    Some(Slot { foot, through, base: [from, to], ends })
}

#[cfg(test)]
mod tests {
    use super::*;
    use coupler_curves::catalogue;
    use coupler_curves::family::{Family, Sampling};
    use coupler_curves::linkage::{LinkageBuilder, MotionOptions, Side};
    use coupler_curves::motion::{Motion, Sampler};
    use coupler_curves::solve::Solver;

    #[test]
    fn a_rack_meets_its_pinion_on_the_side_that_moves_with_it() {
        for (radius, offset, expected) in
            [(1.0, -1.0, None), (-1.0, 1.0, None), (1.0, 3.0, Some(-1.0)), (-1.5, -1.0, Some(1.5))]
        {
            let mut builder = LinkageBuilder::default();
            let [o, x] = [0.0, 5.0].map(|x| builder.fixed(&format!("P{x}"), Point::new(x, 0.0)));
            let crank = builder.crank("A", o, 2.0).unwrap();
            let rack = builder.rack("R", ([o, x], offset), (radius, 0.5)).unwrap();
            let options = MotionOptions { range: Some([-90.0, 90.0]), ..MotionOptions::default() };
            let linkage = builder.build(vec![crank, rack], None, options).unwrap();
            let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(12)));
            let guides = Mechanism::new(&linkage, &motion.circuits[0]).guides;
            let heights: Vec<f64> = guides.iter().map(|guide| guide.ends[0].y).collect();
            let expected: Vec<f64> = std::iter::once(offset).chain(expected).collect();
            assert!(heights.len() == expected.len(), "{heights:?}");
            assert!(heights.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-12), "{heights:?}");
        }
    }

    #[test]
    fn a_slider_on_a_moving_link_has_the_slot_that_it_uses() {
        let mut builder = LinkageBuilder::default();
        let [o, c] = [0.0, 7.0].map(|x| builder.fixed(&format!("P{x}"), Point::new(x, 0.0)));
        let a = builder.crank("A", o, 2.0).unwrap();
        let b = builder.dyad("B", [a, c], [6.0, 4.5], Side::Left).unwrap();
        let s = builder.slide("S", (a, 8.0), ([c, b], 0.5), Side::Left).unwrap();
        let linkage = builder.build(vec![s], None, MotionOptions::default()).unwrap();
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(36)));
        let circuit = &motion.circuits[0];
        let mechanism = Mechanism::new(&linkage, circuit);
        let [slot] = mechanism.slots[..] else { panic!("{:?}", mechanism.slots) };
        assert_eq!((slot.foot, slot.through, mechanism.guides.len()), (c, s, 0));
        for k in 0..circuit.len() {
            let pose: Vec<Point> = linkage.joint_ids().map(|joint| circuit.positions.point(joint, k)).collect();
            let [from, to] = slot.ends_in(&pose);
            let part = (pose[s] - from).dot(&(to - from)) / (to - from).norm_squared();
            assert!((-1e-12..=1.0 + 1e-12).contains(&part), "{part}");
            assert!(cross(to - from, pose[s] - from).abs() < 1e-9);
        }
    }

    #[test]
    fn a_yoke_on_a_moving_link_has_the_slot_that_guides_it() {
        let mut builder = LinkageBuilder::default();
        let [o, c] = [0.0, 5.0].map(|x| builder.fixed(&format!("P{x}"), Point::new(x, 0.0)));
        let a = builder.crank("A", o, 1.0).unwrap();
        let b = builder.dyad("B", [a, c], [4.0, 3.0], Side::Left).unwrap();
        let y = builder.yoke("Y", a, ([c, b], 0.5), 80.0).unwrap();
        let linkage = builder.build(vec![y], None, MotionOptions::default()).unwrap();
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Samples(36)));
        let slots = Mechanism::new(&linkage, &motion.circuits[0]).slots;
        assert_eq!(slots.iter().map(|slot| (slot.foot, slot.through)).collect::<Vec<_>>(), [(y, a), (c, y)]);
        assert!(slots[1].ends.iter().all(|end| (end.y - 0.5).abs() < 1e-12), "{:?}", slots[1].ends);
    }

    #[test]
    fn an_idler_meets_both_gears_that_turn_the_same_way() {
        let gears = |turns: f64| {
            let template = catalogue::find("geared-five-bar").unwrap();
            let family = Family::single_cell(template, &[("n".to_owned(), turns)], Sampling::Samples(12)).unwrap();
            let solved = Solver::new(&family).solve(0).unwrap();
            let (linkage, circuit) = (&solved.linkage, solved.circuit(&solved.curves[0]));
            let start: Vec<Point> = linkage.joint_ids().map(|joint| circuit.positions.point(joint, 0)).collect();
            let gears = Mechanism::new(linkage, circuit).gears;
            gears.iter().map(|gear| (gear.centre_in(&start), gear.radius)).collect::<Vec<_>>()
        };
        assert_eq!(gears(-1.0).len(), 2);
        let [own, first, idler] = gears(1.0)[..] else { panic!() };
        for gear in [own, first] {
            assert!(((gear.0 - idler.0).norm() - gear.1 - idler.1).abs() < 1e-12);
        }
    }
}

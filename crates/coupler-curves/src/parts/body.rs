//! The rigid bodies of a linkage, each in coordinates of its own, before anything is cut.

use super::anchor::{Anchor, Frame};
use super::hole::{Hole, Slot, join_names};
use super::pitch_line::PitchLine;
use crate::geometry::{Bounds, Point, Vector, cross};
use crate::linkage::{JointId, JointKind, Linkage};
use crate::motion::Circuit;

/// A rigid body: the frame, a link, or a block that slides without turning.
#[derive(Clone, Debug)]
pub(super) struct Body {
    /// Whether it is at rest where the linkage is seen from.
    pub is_ground: bool,
    /// All its joints.
    pub joints: Vec<(JointId, Point)>,
    pub anchor: Anchor,
    pub holes: Vec<Hole>,
    /// The centres of holes that are at mere points: they are none where a slot is on a line through them.
    pub mere_points: Vec<Point>,
    pub slots: Vec<Slot>,
    /// That of a rack.
    pub pitch_line: Option<PitchLine>,
    /// What its views do not show.
    pub notes: Vec<String>,
    /// What makes it a block; `None` if it is none.
    pub block: Option<Block>,
    /// The name that its traced points share, if they are a grid.
    pub grid_name: Option<String>,
}

/// What makes a body a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    /// The joint that slides.
    pub joint: JointId,
    /// What it is called.
    pub noun: &'static str,
    /// The direction of its line, a unit vector.
    pub axis: Vector,
}

impl Body {
    /// Where a joint is on it.
    pub fn position(&self, joint: JointId) -> Option<Point> {
        self.joints.iter().find(|(own, _)| *own == joint).map(|(_, p)| *p)
    }

    /// Whether it is the block on a joint.
    pub fn is_block_of(&self, joint: JointId) -> bool {
        self.block.is_some_and(|block| block.joint == joint)
    }

    /// Adds a hole, or the name of its joint to the hole that is there.
    pub fn add_hole(&mut self, name: &str, centre: Point) {
        /// Of positions, relative to the body.
        const ROUNDING: f64 = 1e-9;
        let extent = Bounds::from_points(self.joints.iter().map(|(_, p)| *p)).size().norm();
        match self.holes.iter_mut().find(|hole| (hole.centre - centre).norm() <= ROUNDING * extent) {
            Some(hole) => hole.name = join_names([hole.name.as_str(), name]),
            None => self.holes.push(Hole { name: name.to_owned(), centre }),
        }
    }

    /// Leaves out holes at mere points on the lines of slots: the points only give the line.
    pub fn remove_points_of_slots(&mut self) {
        /// Of positions, relative to the body.
        const ROUNDING: f64 = 1e-9;
        let rounding = ROUNDING * Bounds::from_points(self.joints.iter().map(|(_, p)| *p)).size().norm();
        let is_on = |slot: &Slot, p: Point| {
            let along = slot.ends[1] - slot.ends[0];
            cross(along, p - slot.ends[0]).abs() <= rounding * along.norm()
        };
        let Body { holes, mere_points, slots, .. } = self;
        holes.retain(|hole| !mere_points.contains(&hole.centre) || !slots.iter().any(|slot| is_on(slot, hole.centre)));
    }

    /// Takes the holes of a block that are nearer than a distance to the centre line of a slot off it, to a plate over the slot that the guide pins hold on the block.
    pub fn take_bridge(&mut self, clearance: f64) -> Option<Body> {
        let block = self.block.filter(|_| self.holes.iter().any(|hole| hole.name.is_empty()))?;
        let is_over = |hole: &Hole| self.slots.iter().any(|slot| slot.distance_to(hole.centre) < clearance);
        let holes: Vec<Hole> =
            self.holes.iter().filter(|hole| hole.name.is_empty() || is_over(hole)).cloned().collect();
        if holes.iter().all(|hole| hole.name.is_empty()) {
            return None;
        }
        self.holes.retain(|hole| hole.name.is_empty() || !holes.contains(hole));
        let block = Some(Block { noun: "bridge", ..block });
        Some(Body { holes, slots: Vec::new(), mere_points: Vec::new(), notes: Vec::new(), block, ..self.clone() })
    }

    /// Whether there is something to be cut.
    pub fn is_part(&self) -> bool {
        let least = if self.is_ground || self.block.is_some() { 1 } else { 2 };
        self.holes.len() + self.slots.len() >= least
    }

    /// What it is called.
    pub fn name(&self, linkage: &Linkage) -> String {
        let number = |hole: &str| hole.strip_prefix(self.grid_name.as_deref()?)?.parse::<usize>().ok();
        let of_joints = self.holes.iter().map(|hole| hole.name.as_str()).filter(|hole| number(hole).is_none());
        let names: Vec<&str> = of_joints.chain(self.grid_name.as_deref()).collect();
        let holes = || names.iter().copied();
        match self.block {
            _ if self.is_ground => "frame".to_owned(),
            Some(Block { joint, noun, .. }) => format!("{noun} {}", linkage.joints[joint].name),
            None if self.holes.len() > 1 => join_names(holes()),
            None => join_names(holes().chain(self.slots.iter().map(|slot| slot.name.as_str()))),
        }
    }

    /// The frame whose origin is the first hole, and whose x-axis goes through the second or has the direction of the first slot.
    pub fn part_frame(&self) -> Frame {
        let slot_ends = || self.slots.iter().flat_map(|slot| slot.ends);
        let origin = self.holes.iter().map(|hole| hole.centre).chain(slot_ends()).next().unwrap_or(Point::origin());
        let along_slot = || self.slots.first().map(|slot| slot.ends[1] - slot.ends[0]);
        let direction = self.holes.get(1).map(|hole| hole.centre - origin).or_else(along_slot);
        Frame { origin, axis: direction.and_then(|v| v.try_normalize(0.0)).unwrap_or(Vector::x()) }
    }
}

/// The bodies of a linkage with the holes of their joints: the frame, the links, the blocks. A joint that slides on a line has a block of its own.
pub(super) fn bodies(linkage: &Linkage, circuit: &Circuit, traced: &[JointId]) -> Vec<Body> {
    let [helpers, mere_points] = [circuit.helpers(linkage), circuit.mere_points(linkage)];
    let outlines = linkage.link_outlines();
    let pivots = linkage.pivots();
    let mut bodies: Vec<Body> = Vec::new();
    for (index, link) in linkage.links.iter().enumerate() {
        let is_ground = std::ptr::eq(link, linkage.ground());
        let place = |v: Vector| Point::new(v.x, v.y * linkage.placement.handedness());
        let joints: Vec<(JointId, Point)> = link.joints.iter().map(|&(joint, v)| (joint, place(v))).collect();
        let block =
            find_block(linkage, &joints).filter(|block| bodies.iter().all(|body| !body.is_block_of(block.joint)));
        let Some(anchor) = find_anchor(linkage, &joints) else { continue };
        // A link with a single joint that is no block, such as the cylinder of an actuator, is nothing to be cut.
        if joints.len() == 1 && block.is_none() && !is_ground {
            continue;
        }
        let outline = outlines.iter().find(|outline| outline.link.index() == index);
        let is_on_part = |joint: JointId| match outline {
            _ if is_ground => pivots.contains(&joint),
            Some(outline) => outline.joints.contains(&joint),
            None => joints[0].0 == joint,
        };
        let has_hole = |joint: JointId| {
            let is_shown = is_on_part(joint) && !helpers.contains(&joint) && linkage.is_pin(joint);
            is_shown || (traced.contains(&joint) && !is_ground)
        };
        let mut own: Vec<(JointId, Point)> = joints.iter().copied().filter(|(joint, _)| has_hole(*joint)).collect();
        own.sort_by_key(|(joint, _)| *joint);
        let names: Vec<(String, bool)> = own.iter().map(|(joint, _)| hole_name(linkage, *joint)).collect();
        let grid = own.iter().zip(&names).find(|(_, (_, is_in_grid))| *is_in_grid);
        let grid_name = grid.map(|((joint, _), _)| linkage.joints[*joint].name.clone());
        let mere_points = own.iter().filter(|(joint, _)| mere_points.contains(joint)).map(|(_, p)| *p).collect();
        let (holes, slots) = (Vec::new(), Vec::new());
        let joints = joints.clone();
        let (pitch_line, notes) = (None, Vec::new());
        let mut body =
            Body { is_ground, joints, anchor, holes, mere_points, slots, pitch_line, notes, block, grid_name };
        own.iter().zip(&names).for_each(|((_, p), (name, _))| body.add_hole(name, *p));
        bodies.push(body);
    }
    for joint in linkage.joint_ids() {
        let Some(line) = linkage.slider_line(joint) else { continue };
        if bodies.iter().any(|body| body.is_block_of(joint)) {
            continue;
        }
        let name = linkage.joints[joint].name.clone();
        let (own, axis) = ((joint, Point::origin()), Vector::x());
        bodies.push(Body {
            is_ground: false,
            joints: vec![own],
            anchor: Anchor::Line { joint: own, axis, line },
            holes: vec![Hole { name, centre: Point::origin() }],
            mere_points: Vec::new(),
            slots: Vec::new(),
            pitch_line: None,
            notes: Vec::new(),
            block: Some(Block { joint, noun: "block", axis }),
            grid_name: None,
        });
    }
    bodies.sort_by_key(|body| (!body.is_ground, body.block.is_some()));
    bodies
}

/// The name of the hole of a joint: with its number among the curves if it is a point of a grid, which all have one name, and whether it is.
fn hole_name(linkage: &Linkage, joint: JointId) -> (String, bool) {
    let name = &linkage.joints[joint].name;
    let is_in_grid = linkage.joints.iter().filter(|other| other.name == *name).count() > 1;
    match linkage.traced.iter().position(|traced| *traced == joint) {
        Some(k) if is_in_grid => (format!("{name}{}", k + 1), true),
        _ => (name.clone(), false),
    }
}

/// The block that a link with these joints is: its first joint slides, and all others are points that keep the direction of its line.
fn find_block(linkage: &Linkage, joints: &[(JointId, Point)]) -> Option<Block> {
    let (&(joint, _), points) = joints.split_first()?;
    let keeps_direction_of = |lines: &[[JointId; 2]]| {
        points.iter().all(|(point, _)| match linkage.joints[*point].kind {
            JointKind::Aligned { from, line, .. } => from == joint && lines.contains(&line),
            _ => false,
        })
    };
    if linkage.slider_line(joint).is_some_and(|line| keeps_direction_of(&[line])) {
        let noun = match linkage.joints[joint].kind {
            JointKind::Yoke { .. } => "yoke",
            JointKind::Rack { .. } => "rack",
            _ => "block",
        };
        return Some(Block { joint, noun, axis: Vector::x() });
    }
    // The block on a pin through which the line of a slot slides, where it has points.
    linkage.joint_ids().filter(|_| !points.is_empty()).find_map(|foot| match linkage.joints[foot].kind {
        JointKind::Slot { base: [pivot, through], offset, .. } if through == joint => {
            let axis = if offset == 0.0 { Vector::x() } else { Vector::y() };
            keeps_direction_of(&[[pivot, through], [pivot, foot]]).then_some(Block { joint, noun: "block", axis })
        }
        _ => None,
    })
}

/// What says where a link with these joints is; `None` if only one of its points is known.
fn find_anchor(linkage: &Linkage, joints: &[(JointId, Point)]) -> Option<Anchor> {
    let &first = joints.first()?;
    let distance = |joint: &(JointId, Point)| (joint.1 - first.1).norm();
    let farthest = joints.iter().max_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    if distance(farthest) > 0.0 {
        return Some(Anchor::Joints([first, *farthest]));
    }
    let slot_line = || {
        joints.iter().find_map(|(foot, _)| match linkage.joints[*foot].kind {
            JointKind::Slot { base, .. } => Some(base),
            _ => None,
        })
    };
    let line = slot_line().or_else(|| linkage.slider_line(first.0))?;
    Some(Anchor::Line { joint: first, axis: Vector::x(), line })
}

//! Slots, as long as what slides in them needs, and the guide pins of blocks.

use super::body::{Block, Body};
use super::error::PartsError;
use super::hole::{Hole, Slot, join_names};
use super::sizes::Sizes;
use super::travel::travel;
use crate::geometry::{Point, Vector, cross, distance_to_segment, left_normal};
use crate::linkage::{JointId, JointKind, Linkage};
use crate::motion::Circuit;

/// A pin that slides in the slot of a body.
struct Slide {
    pin: JointId,
    /// The index of the body with the slot.
    carrier: usize,
    /// The direction of the slot on it.
    direction: Vector,
    /// Whether the guide pins of the block on the pin slide in it, too, if there is such a block.
    is_guide: bool,
}

/// Adds guide pins to blocks, and slots to all bodies that something slides in; what is over the slot of a block becomes a body of its own.
pub(super) fn add(
    bodies: &mut Vec<Body>,
    (linkage, circuit): (&Linkage, &Circuit),
    sizes: Sizes,
) -> Result<(), PartsError> {
    for slide in find_slides(bodies, linkage)? {
        let Slide { pin, carrier, direction, is_guide } = slide;
        let Some(way) = travel(&bodies[carrier], (pin, direction), (linkage, circuit)) else { continue };
        let block = bodies.iter().position(|body| is_guide && body.is_block_of(pin));
        let sides = match block {
            Some(block) => {
                let distance = guide_distance((&bodies[block], &bodies[carrier]), (way, direction), linkage, sizes);
                add_guide_pins(&mut bodies[block], distance);
                vec![-distance, distance]
            }
            None => vec![0.0],
        };
        for side in sides {
            let name = linkage.joints[pin].name.clone();
            let ends = slot_ends(way, (direction, side), sizes);
            add_slot(&mut bodies[carrier].slots, Slot { name, ends });
        }
    }
    bodies.iter_mut().for_each(Body::remove_points_of_slots);
    let bridges: Vec<Body> = bodies.iter_mut().filter_map(|body| body.take_bridge(sizes.clearance())).collect();
    bodies.extend(bridges);
    Ok(())
}

/// The centre line of the slot for a pin at a distance along a way from what goes this way: half a hole longer at each end.
fn slot_ends([from, to]: [Point; 2], (direction, side): (Vector, f64), sizes: Sizes) -> [Point; 2] {
    let margin = sizes.hole / 2.0;
    [from + direction * (side - margin), to + direction * (side + margin)]
}

/// What slides, and in what: sliders and yokes on their lines, and pins in the slots of arms and of yokes.
fn find_slides(bodies: &[Body], linkage: &Linkage) -> Result<Vec<Slide>, PartsError> {
    let mut slides = Vec::new();
    for joint in linkage.joint_ids() {
        if let Some(line) = linkage.slider_line(joint) {
            let (carrier, direction) = find_line(bodies, linkage, line)
                .ok_or_else(|| PartsError::NoGuide { joint: linkage.joints[joint].name.clone() })?;
            slides.push(Slide { pin: joint, carrier, direction, is_guide: true });
        }
        let slot = match linkage.joints[joint].kind {
            JointKind::Slot { base: [pivot, through], offset, .. } => {
                let carrier =
                    bodies.iter().position(|body| body.position(joint).is_some() && body.position(pivot).is_some());
                carrier.map(|carrier| (through, carrier, arm_direction(&bodies[carrier], [pivot, joint], offset)))
            }
            JointKind::Yoke { from, slot_direction, .. } => {
                let carrier = bodies.iter().position(|body| body.is_block_of(joint));
                let y = slot_direction.y * linkage.placement.handedness();
                carrier.map(|carrier| (from, carrier, Vector::new(slot_direction.x, y)))
            }
            _ => None,
        };
        // The block on a pin that slides on a line of its own is guided there.
        let is_arm = matches!(linkage.joints[joint].kind, JointKind::Slot { .. });
        let slide = |(pin, carrier, direction)| Slide {
            pin,
            carrier,
            direction,
            is_guide: is_arm && linkage.slider_line(pin).is_none(),
        };
        slides.extend(slot.map(slide));
    }
    Ok(slides)
}

/// The direction of the slot in an arm: across the line from its pivot to its foot, or without an offset that of the arm's x-axis.
fn arm_direction(arm: &Body, [pivot, foot]: [JointId; 2], offset: f64) -> Vector {
    let across = || Some(left_normal(arm.position(foot)? - arm.position(pivot)?).normalize());
    if offset == 0.0 { Vector::x() } else { across().unwrap_or(Vector::x()) }
}

/// The body with a line, and the direction of the line on it: that with both joints, or the arm whose slot it is.
fn find_line(bodies: &[Body], linkage: &Linkage, line: [JointId; 2]) -> Option<(usize, Vector)> {
    let through_joints = |body: &Body| (body.position(line[1])? - body.position(line[0])?).try_normalize(0.0);
    let on_body = |(k, body): (usize, &Body)| Some((k, through_joints(body)?));
    let slot = || {
        linkage.joint_ids().find_map(|foot| match linkage.joints[foot].kind {
            JointKind::Slot { base, offset: 0.0, .. } if base == line => {
                let k = bodies.iter().position(|body| body.position(foot).is_some())?;
                Some((k, Vector::x()))
            }
            _ => None,
        })
    };
    bodies.iter().enumerate().find_map(on_body).or_else(slot)
}

/// How far the two guide pins of a block are from its joint: so far that they are clear of its other holes and of its slot, and their own slots of the
/// holes of the body that they slide in, if possible.
fn guide_distance(
    (block, carrier): (&Body, &Body),
    (way, direction): ([Point; 2], Vector),
    linkage: &Linkage,
    sizes: Sizes,
) -> f64 {
    /// In widths of links: as far as a long way from a hole in its middle needs.
    const MOST: usize = 200;
    let Some(Block { joint, axis, .. }) = block.block else { return 0.0 };
    let step = match linkage.joints[joint].kind {
        JointKind::Yoke { slot_direction, .. } => sizes.width / slot_direction.y.abs(),
        _ => sizes.width,
    };
    let centre = block.position(joint).unwrap_or(Point::origin());
    let is_clear = |distance: &f64| {
        let is_apart =
            |pin: Point| block.holes.iter().all(|hole| (hole.centre - pin).norm() >= sizes.width.min(*distance));
        [-1.0, 1.0].into_iter().all(|side| is_apart(centre + axis * (side * distance)))
    };
    let is_clear_on_carrier = |distance: &f64| {
        [-1.0, 1.0].into_iter().all(|side| {
            let [a, b] = slot_ends(way, (direction, side * distance), sizes);
            carrier.holes.iter().all(|hole| distance_to_segment(hole.centre, a, b) >= sizes.clearance())
        })
    };
    let clear = || (1..=MOST).map(|k| k as f64 * step).filter(is_clear);
    clear().find(is_clear_on_carrier).or_else(|| clear().next()).unwrap_or(step)
}

/// Adds the two guide pins of a block.
fn add_guide_pins(body: &mut Body, distance: f64) {
    let Some((block, centre)) = body.block.and_then(|block| Some((block, body.position(block.joint)?))) else { return };
    let pins = [-distance, distance].map(|at| centre + block.axis * at);
    body.holes.extend(pins.map(|centre| Hole { name: String::new(), centre }));
}

/// Adds a slot; one that overlaps another on the same line becomes one with it.
fn add_slot(slots: &mut Vec<Slot>, new: Slot) {
    /// Of positions, relative to the length of a slot.
    const ROUNDING: f64 = 1e-9;
    let length = (new.ends[1] - new.ends[0]).norm();
    let along = (new.ends[1] - new.ends[0]) / length;
    let on_line = |slot: &Slot| slot.ends.map(|end| along.dot(&(end - new.ends[0])));
    let overlaps = |slot: &Slot| {
        let is_on = |end: &Point| cross(along, end - new.ends[0]).abs() <= ROUNDING * length;
        let [a, b] = on_line(slot);
        slot.ends.iter().all(is_on) && a.min(b) <= length && a.max(b) >= 0.0
    };
    match slots.iter_mut().find(|slot| overlaps(slot)) {
        Some(slot) => {
            let [a, b] = on_line(slot);
            let (from, to) = (a.min(b).min(0.0), a.max(b).max(length));
            slot.ends = [from, to].map(|at| new.ends[0] + along * at);
            if slot.name != new.name {
                slot.name = join_names([slot.name.as_str(), new.name.as_str()]);
            }
        }
        None => slots.push(new),
    }
}

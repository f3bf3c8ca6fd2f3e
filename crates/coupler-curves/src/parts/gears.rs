//! Gears as the circles on which they roll, without teeth.

use super::anchor::{Anchor, Frame};
use super::body::Body;
use super::hole::Hole;
use super::outline::Outline;
use super::part::Part;
use super::pitch_circle::{Idler, PitchCircle};
use super::sizes::Sizes;
use crate::geometry::{Point, Vector};
use crate::linkage::{JointId, JointKind, Linkage};

/// The gears of bodies as parts, with a hole at the centre and one of the crank that a gear turns with: its pin, or where that is outside, a pin that holds
/// both together. An idler has its hole in the body with both pivots. Gears whose pivots are on no common body do not mesh, and are none.
pub(super) fn add(
    bodies: &mut [Body],
    linkage: &Linkage,
    (circles, idlers): (&[PitchCircle], &[Idler]),
    sizes: Sizes,
) -> Vec<Part> {
    let mut parts = Vec::new();
    for circle in circles {
        let crank_pivot = linkage.crank().map(|[pivot, _]| pivot);
        if let (JointKind::Gear { pivot, .. }, Some(first)) = (&linkage.joints[circle.pin].kind, crank_pivot) {
            let is_on = |body: &Body| body.position(*pivot).is_some() && body.position(first).is_some();
            let Some(carrier) = bodies.iter_mut().find(|body| is_on(body)) else { return Vec::new() };
            let idler = idlers.iter().find(|idler| idler.pin == circle.pin);
            parts.extend(idler.and_then(|idler| add_idler(carrier, idler)));
        }
        parts.extend(gear(bodies, linkage, circle, sizes));
    }
    parts
}

/// The gear of a pitch circle.
fn gear(bodies: &mut [Body], linkage: &Linkage, circle: &PitchCircle, sizes: Sizes) -> Option<Part> {
    let PitchCircle { centre, pin, radius } = *circle;
    let is_crank =
        |body: &&mut Body| !body.is_ground && body.position(centre).is_some() && body.position(pin).is_some();
    let crank = bodies.iter_mut().find(is_crank)?;
    let (origin, arm) = (crank.position(centre)?, crank.position(pin)? - crank.position(centre)?);
    let axis = arm.try_normalize(0.0)?;
    let name = |joint: JointId| linkage.joints[joint].name.clone();
    let mut holes = vec![Hole { name: name(centre), centre: Point::origin() }];
    let held_at = radius.min(arm.norm()) / 2.0;
    if arm.norm() + sizes.width / 2.0 <= radius {
        holes.push(Hole { name: name(pin), centre: Point::new(arm.norm(), 0.0) });
    } else if held_at > sizes.hole {
        let hole = Hole { name: String::new(), centre: origin + axis * held_at };
        if crank.holes.iter().all(|other| (other.centre - hole.centre).norm() > sizes.hole) {
            crank.holes.push(hole);
        }
        holes.push(Hole { name: String::new(), centre: Point::new(held_at, 0.0) });
    }
    Some(Part {
        name: format!("gear {}", name(centre)),
        holes,
        slots: Vec::new(),
        outline: Outline::Circle { centre: Point::origin(), radius },
        anchor: Anchor::Joints([(centre, Point::origin()), (pin, Point::new(arm.norm(), 0.0))]),
    })
}

/// An idler, with its hole on the body that has the pivots of both gears.
fn add_idler(carrier: &mut Body, idler: &Idler) -> Option<Part> {
    let [from, to] = idler.pivots.map(|pivot| carrier.position(pivot));
    let centre = from? + (to? - from?).try_normalize(0.0)? * idler.distance;
    carrier.add_hole("idler", centre);
    Some(Part {
        name: "gear idler".to_owned(),
        holes: vec![Hole { name: "idler".to_owned(), centre: Point::origin() }],
        slots: Vec::new(),
        outline: Outline::Circle { centre: Point::origin(), radius: idler.radius },
        anchor: carrier.anchor.in_frame(&Frame { origin: centre, axis: Vector::x() }),
    })
}

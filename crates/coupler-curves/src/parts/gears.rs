//! Gears as the circles on which they roll, without teeth.

use super::anchor::{Anchor, Frame};
use super::body::Body;
use super::hole::Hole;
use super::outline::Outline;
use super::part::Part;
use super::pitch_circle::{Idler, PitchCircle};
use super::sizes::Sizes;
use crate::geometry::{Point, Vector};
use crate::linkage::{JointKind, Linkage};

/// The gears of bodies as parts, with a hole at the centre and those of the crank that a gear turns with that it has room for, or else one of a pin that holds
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
    let reach = |hole: &Hole| (hole.centre - origin).norm();
    let mut notes = Vec::new();
    let mut on_gear: Vec<Hole> = Vec::new();
    for hole in crank.holes.iter().filter(|hole| reach(hole) > sizes.hole) {
        if reach(hole) + sizes.hole <= radius {
            on_gear.push(hole.clone());
        } else if reach(hole) - sizes.hole / 2.0 < radius && !hole.name.is_empty() {
            notes.push(format!("no room for the hole {} at its rim", hole.name));
        }
    }
    if on_gear.is_empty() {
        match holding_pin(crank, (origin, axis), radius.min(arm.norm()), sizes) {
            Some(hole) => {
                crank.holes.push(hole.clone());
                on_gear.push(hole);
            }
            None => notes.push(format!("no room for a second hole: fasten it to {}", crank.name(linkage))),
        }
    }
    let axis = on_gear.first().map_or(axis, |hole| (hole.centre - origin).normalize());
    let frame = Frame { origin, axis };
    let own = |hole: Hole| Hole { centre: frame.coordinates(hole.centre), ..hole };
    let name = linkage.joints[centre].name.clone();
    let first = Hole { name: name.clone(), centre: Point::origin() };
    Some(Part {
        name: format!("gear {name}"),
        holes: std::iter::once(first).chain(on_gear.into_iter().map(own)).collect(),
        slots: Vec::new(),
        pitch_line: None,
        notes,
        outline: Outline::Circle { centre: Point::origin(), radius },
        anchor: Anchor::Joints([(centre, Point::origin()), (pin, frame.coordinates(origin + arm))]),
    })
}

/// The hole for a pin that holds a gear and its crank together, on the arm of the crank as far as both reach, clear of all holes; `None` if there is no
/// room.
fn holding_pin(crank: &Body, (origin, axis): (Point, Vector), reach: f64, sizes: Sizes) -> Option<Hole> {
    /// Where it is sought, as parts of the reach.
    const PLACES: [f64; 5] = [0.5, 0.4, 0.6, 0.3, 0.7];
    let hole = |part: f64| Hole { name: String::new(), centre: origin + axis * (part * reach) };
    let is_clear = |hole: &Hole| {
        let from_centre = (hole.centre - origin).norm();
        from_centre > sizes.hole
            && from_centre + sizes.hole <= reach
            && crank.holes.iter().all(|other| (other.centre - hole.centre).norm() > sizes.hole)
    };
    PLACES.into_iter().map(hole).find(is_clear)
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
        pitch_line: None,
        notes: Vec::new(),
        outline: Outline::Circle { centre: Point::origin(), radius: idler.radius },
        anchor: carrier.anchor.in_frame(&Frame { origin: centre, axis: Vector::x() }),
    })
}

//! A study as JSON, for the page to show.

use serde_json::{Value, json};

use coupler_curves::geometry::{Bounds, Point};
use coupler_curves::linkage::{DyadId, FourBar, Input, JointId, LinkId, Linkage, is_plate};
use coupler_curves::motion::{Pass, UnsampledCircuit};
use coupler_curves::solve::MovablePoint;
use coupler_drawing::mechanism::{Block, Gear, Guide, Mechanism, Slot};

use crate::family::OpenFamily;
use crate::overlays::cognates;
use crate::request::CurveRequest;
use crate::response::Numbers;
use crate::study::{Opened, Study};

/// An opened curve without its study: the values of names, the traced point, and circuits.
pub(crate) fn opened_json(family: &OpenFamily, request: &CurveRequest, opened: &Opened) -> Value {
    let names = &family.planned.family.names;
    let values: serde_json::Map<String, Value> =
        names.iter().zip(&opened.values).map(|(name, value)| (name.clone(), json!(value))).collect();
    let template = &family.planned.family.template;
    let parameters = &opened.values[..template.parameters.len().min(opened.values.len())];
    let point = MovablePoint::of_trace(template, request.curve[0], parameters);
    let dyads = opened.linkage.as_ref().map_or(0, Linkage::dyad_count);
    json!({
        "values": values,
        "point": point.map(|point| point_json(&point)),
        "circuits": opened.circuits.iter().map(|circuit| circuit_json(circuit, dyads)).collect::<Vec<_>>(),
        "home": opened.home,
        "shortfall": opened.shortfall,
        "reason": opened.study.as_ref().err(),
    })
}

fn point_json(point: &MovablePoint) -> Value {
    let [along, across] = point.coordinates.map(|coordinate| {
        json!({
            "value": coordinate.value,
            "is_constant": coordinate.is_constant,
            "is_parameter": coordinate.is_parameter,
        })
    });
    json!({ "name": point.name, "along": along, "across": across })
}

/// A circuit of a linkage with this number of dyads.
fn circuit_json(circuit: &UnsampledCircuit, dyads: usize) -> Value {
    let pass = |pass: &Pass| {
        let sides: Vec<i8> = (0..dyads).map(|dyad| pass.mode.sign(DyadId::new(dyad))).collect();
        json!({
            "from": pass.from.input.value,
            "to": pass.to.input.value,
            "from_is_flat": !pass.from.flat_dyads.is_empty(),
            "to_is_flat": !pass.to.flat_dyads.is_empty(),
            "sides": sides,
        })
    };
    json!({ "passes": circuit.passes.iter().map(pass).collect::<Vec<_>>(), "closed": circuit.is_closed })
}

/// A study.
pub(crate) fn study_json(study: &Study, numbers: &mut Numbers) -> Value {
    let Study { linkage, joint, .. } = study;
    let joints: Vec<&str> = linkage.joints.iter().map(|joint| joint.name.as_str()).collect();
    let others: Vec<Value> = study
        .other_joints()
        .map(|other| json!({ "joint": other.index(), "points": numbers.points(study.circuit.points(other)) }))
        .collect();
    let four_bar = FourBar::from_linkage(linkage);
    let rotates = study.passes().iter().any(|pass| {
        let [from, to] = [pass.from.input.value, pass.to.input.value];
        [0.3, 0.5, 0.7].iter().any(|part| study.instant(pass, from + (to - from) * part).is_some())
    });
    json!({
        "shown": study.shown,
        "joints": joints,
        "joint": joint.index(),
        "traced": linkage.traced.iter().map(|joint| joint.index()).collect::<Vec<_>>(),
        "others": others,
        "is_length": linkage.input() == Input::Length,
        "is_mirrored": linkage.placement.handedness() < 0.0,
        "crank": crank_json(study, numbers),
        "four_bar": four_bar.map(|four_bar| {
            json!({ "class": four_bar.class().name(), "transmission_range": study.transmission_range() })
        }),
        "has_cognates": cognates(study).is_some(),
        "has_pole": rotates,
        "mechanism": mechanism_json(study, numbers),
        "box": bounds_json(study.bounds(&[*joint])),
        "others_box": bounds_json(study.bounds(&linkage.traced)),
        "curve_box": bounds_json(study.curve_bounds()),
    })
}

fn bounds_json(Bounds { min, max }: Bounds) -> Value {
    json!([min.x, min.y, max.x, max.y])
}

/// The crank on a fixed pivot that the page may turn, with the arc of its pin where it has limits.
fn crank_json(study: &Study, numbers: &mut Numbers) -> Option<Value> {
    let Study { linkage, circuit, mechanism, .. } = study;
    let [pivot, pin] = linkage.crank().filter(|[pivot, _]| mechanism.pivots.contains(pivot))?;
    let (mut arc, mut limits) = (Vec::new(), Vec::new());
    if !circuit.is_full_turn() {
        let by = |a: &usize, b: &usize| circuit.inputs[*a].total_cmp(&circuit.inputs[*b]);
        let (least, most) = ((0..circuit.len()).min_by(by)?, (0..circuit.len()).max_by(by)?);
        let at = |sample: usize| circuit.positions.point(pin, sample);
        // From one limit to the other, on one pass.
        arc = (least.min(most)..=least.max(most)).map(at).collect();
        limits = vec![at(least), at(most)];
    }
    let arc = numbers.points(arc);
    let limits = numbers.points(limits);
    let is_view = linkage.seen_from.is_some();
    Some(json!({ "pivot": pivot.index(), "pin": pin.index(), "arc": arc, "limits": limits, "can_turn": !is_view }))
}

fn mechanism_json(study: &Study, numbers: &mut Numbers) -> Value {
    let Study { linkage, circuit, mechanism, joint, .. } = study;
    let Mechanism { links, pivots, blocks, slots, actuators, guides, gears, helpers: _ } = mechanism;
    let indices = |joints: &[JointId]| json!(joints.iter().map(|joint| joint.index()).collect::<Vec<_>>());
    let is_body = |joints: &[JointId], link| is_plate(&positions_on_link(linkage, joints, link));
    let outlines = |plates: bool| -> Vec<Value> {
        let chosen = links.iter().filter(|outline| is_body(&outline.joints, outline.link) == plates);
        chosen.map(|outline| indices(&outline.joints)).collect()
    };
    let drawn = mechanism.drawn_joints(linkage);
    let (fixed, pins): (Vec<JointId>, Vec<JointId>) = drawn.into_iter().partition(|joint| pivots.contains(joint));
    let at_start =
        |joints: &[JointId]| joints.iter().map(|&joint| circuit.positions.point(joint, 0)).collect::<Vec<_>>();
    let on_slots = slots.iter().map(|slot| Block { joint: slot.through, line: [slot.foot, slot.through] });
    let block = |Block { joint, line }: Block| json!({ "at": joint.index(), "line": indices(&line) });
    let slot = |Slot { foot, through, base, ends }: &Slot| {
        json!({
            "foot": foot.index(),
            "through": through.index(),
            "base": indices(base),
            "near": [ends[0].x, ends[0].y],
            "far": [ends[1].x, ends[1].y],
        })
    };
    let start: Vec<Point> = linkage.joint_ids().map(|joint| circuit.positions.point(joint, 0)).collect();
    let wheel = |gear: &Gear| {
        let centre = gear.centre_in(&start);
        [centre.x, centre.y, gear.radius]
    };
    json!({
        "bars": outlines(false),
        "plates": outlines(true),
        "frame": indices(pivots),
        "fixed": indices(&fixed),
        "fixed_at": numbers.points(at_start(&fixed)),
        "frame_at": numbers.points(at_start(pivots)),
        "pins": indices(&pins.into_iter().filter(|pin| pin != joint).collect::<Vec<_>>()),
        "blocks": blocks.iter().copied().chain(on_slots).map(block).collect::<Vec<_>>(),
        "slots": slots.iter().map(slot).collect::<Vec<_>>(),
        "actuators": actuators.iter().map(|ends| indices(ends)).collect::<Vec<_>>(),
        "guides": guides.iter().map(|Guide { ends: [a, b], .. }| [a.x, a.y, b.x, b.y]).collect::<Vec<_>>(),
        "wheels": gears.iter().map(wheel).collect::<Vec<_>>(),
    })
}

/// The positions of joints on a link.
fn positions_on_link(linkage: &Linkage, joints: &[JointId], link: LinkId) -> Vec<Point> {
    joints.iter().filter_map(|&joint| linkage.links[link].position(joint)).map(Point::from).collect()
}

//! The pose at the end of a pass, where dyads are flat and bases may vanish.

use std::ops::Range;

use super::end_series::EndSeries;
use super::input_columns::{InputColumns, InputSlices};
use super::pass::{Pass, PassEnd};
use super::positions::{DyadSigns, JointPositions, place_joints, place_leading_joints};
use crate::geometry::trig;
use crate::linkage::{DyadSet, Input, JointKind, Linkage};

/// Places every joint at one sample where a pass begins or ends, in the frame of the fixed joints.
///
/// A flat dyad is placed with the exact length of its first link. Where a base vanishes, its joint is placed in the limit
/// along the pass. Where there is none, the position is undefined.
pub(super) fn place_at_end(linkage: &Linkage, pass: &Pass, begins: bool, out: &mut JointPositions, sample: usize) {
    let (end, inwards) = pass.ends()[usize::from(!begins)];
    let PassEnd { input, flat_dyads: flat, vanishing_dyads: vanishing } = end;
    let signs = DyadSigns::new(pass.mode, flat.without(vanishing));
    let inputs = InputColumns::new(&[input]);
    if let Some(track) = &pass.track {
        track.positions(input.value, |(joint, at)| out.set_point(joint, sample, at));
    }
    place_leading_joints(linkage, linkage.joints.len(), inputs.as_slices(), &signs, out, sample..sample + 1);
    if flat.is_empty() || pass.track.is_some() {
        return;
    }
    let series = (!vanishing.is_empty()).then(|| EndSeries::new(linkage, &end, pass.mode, inwards));
    for (id, joint) in linkage.joint_ids().zip(&linkage.joints) {
        let at = |j| out.point(j, sample);
        let limit = series.as_ref().filter(|series| series.is_by_continuity(id)).map(|series| series.limit(id));
        let placed = match joint.kind {
            _ if let Some(limit) = limit => limit,
            JointKind::Dyad { base: [p, q], lengths, dyad } if flat.contains(dyad) => {
                let base = at(q) - at(p);
                at(p) + base * (flat_foot(lengths, base.norm()) / base.norm())
            }
            // Joints that depend on one placed here are placed again.
            _ => {
                place_joints(linkage, id.index()..id.index() + 1, inputs.as_slices(), &signs, out, sample..sample + 1);
                continue;
            }
        };
        out.set_point(id, sample, placed);
    }
}

/// The position of a flat dyad's joint along its base, from the base's first joint.
fn flat_foot([l0, l1]: [f64; 2], base: f64) -> f64 {
    if l0 < l1 && base < l1 { -l0 } else { l0 }
}

/// Places the joints of a range of samples of a pass, each with its input, again where a base is so short that its direction is
/// rounding. At the ends of the pass it places no joints.
pub(super) fn place_near_ends(
    linkage: &Linkage,
    pass: &Pass,
    inputs: InputSlices,
    out: &mut JointPositions,
    range: Range<usize>,
) {
    for (end, inwards) in pass.ends().into_iter().filter(|(end, _)| !end.vanishing_dyads.is_empty()) {
        let period = linkage.input().period();
        let distance = |value: &f64| {
            let distance = (value - end.input.value) * inwards;
            match linkage.input() {
                Input::Length => distance,
                Input::Angle { .. } => trig::radians(distance - period * (distance / period).round()),
            }
        };
        let is_near = |value: &f64| (f64::MIN_POSITIVE..NEAR).contains(&distance(value));
        let mut series = None;
        for (i, value) in inputs.values.iter().enumerate().filter(|(_, value)| is_near(value)) {
            let series = series.get_or_insert_with(|| EndSeries::new(linkage, &end, pass.mode, inwards));
            let signs = DyadSigns::new(pass.mode, DyadSet::EMPTY);
            let sample = range.start + i;
            for id in linkage.joint_ids() {
                match series.position(id, distance(value)).filter(|_| series.is_by_continuity(id)) {
                    Some(position) => out.set_point(id, sample, position),
                    None => {
                        place_joints(linkage, id.index()..id.index() + 1, inputs.at(i), &signs, out, sample..sample + 1)
                    }
                }
            }
        }
    }
}

/// Within this of an end, in radians or units of length, the direction of a base that vanishes there has lost digits.
const NEAR: f64 = 0.01;

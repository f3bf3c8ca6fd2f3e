use super::extreme::extremes;
use super::{Measure, TracedCurve, Value};
use crate::geometry::{Point, cross, trig};
use crate::linkage::{FourBar, JointId, JointKind, Linkage, length_tolerance};

/// The measure `mu_min_deg`.
pub const MU_MIN: Measure = Measure {
    name: "mu_min_deg",
    unit: "deg",
    is_word: false,
    definition: "least transmission angle of a four-bar over the circuit, 0 to 180; if the coupler is driven, at both pins (McCarthy 2.3.3)",
    compute: |curve: &TracedCurve| {
        curve.transmission_angles().map_or(Value::Missing, |[least, _]| Value::Number(least))
    },
};

/// The measure `mu_max_deg`.
pub const MU_MAX: Measure = Measure {
    name: "mu_max_deg",
    unit: "deg",
    is_word: false,
    definition: "greatest transmission angle of a four-bar over the circuit, 0 to 180; if the coupler is driven, at both pins",
    compute: |curve: &TracedCurve| curve.transmission_angles().map_or(Value::Missing, |[_, most]| Value::Number(most)),
};

/// The angle opposite a side of a triangle, in degrees; exactly 0 or 180 if the triangle is degenerate.
fn opposite_angle(side: f64, [x, y]: [f64; 2]) -> f64 {
    // Sine and cosine of half the angle, from the factors of Heron's formula. At a limit one of them is zero apart from
    // the rounding of the positions that the side is computed from.
    let rounding = 4.0 * length_tolerance(side + x + y);
    let clear = |gap: f64| if gap.abs() <= rounding { 0.0 } else { gap };
    let sine = clear(side - (x - y).abs()) * (side + (x - y).abs());
    let cosine = clear(x + y - side) * (x + y + side);
    2.0 * trig::degrees(trig::atan2(sine.max(0.0).sqrt(), cosine.max(0.0).sqrt()))
}

/// The least and the greatest transmission angle over the circuit, in degrees.
pub(super) fn transmission_angles(curve: &TracedCurve) -> Option<[f64; 2]> {
    let linkage = curve.linkage;
    let FourBar { frame, crank, coupler, rocker } = FourBar::from_linkage(linkage)?;
    if linkage.seen_from.is_none() {
        // From the distance of the crank's pin from the rocker's pivot, which is extreme where the crank is on the
        // frame line.
        let [o, a, _, c] = FourBar::pins(linkage)?;
        let [least, greatest] = pin_distance_range(curve, [o, a, c], [frame, crank]);
        return Some([least, greatest].map(|d| opposite_angle(d, [coupler, rocker])));
    }
    let [o, a, b, c] = FourBar::pins(linkage)?;
    let angle = |[from, to]: [JointId; 2], sides: [f64; 2]| {
        extremes(curve, |position| (position(from) - position(to)).norm()).map(|side| opposite_angle(side, sides))
    };
    let at_rocker = angle([a, c], [coupler, rocker]);
    if !is_driven(linkage, [a, b]) {
        return Some(at_rocker);
    }
    let at_crank = angle([o, b], [crank, coupler]);
    Some([at_rocker[0].min(at_crank[0]), at_rocker[1].max(at_crank[1])])
}

/// The transmission angle of the four-bar in a linkage in a pose, in degrees from 0 to 180; where the coupler is driven,
/// that of the two pins which is further from 90 degrees. `None` if the linkage is not a four-bar.
pub fn transmission_angle(linkage: &Linkage, pose: &[Point]) -> Option<f64> {
    let FourBar { crank, coupler, rocker, .. } = FourBar::from_linkage(linkage)?;
    let [o, a, b, c] = FourBar::pins(linkage)?;
    let angle = |[from, to]: [JointId; 2], sides: [f64; 2]| opposite_angle((pose[from] - pose[to]).norm(), sides);
    let at_rocker = angle([a, c], [coupler, rocker]);
    if linkage.seen_from.is_none() || !is_driven(linkage, [a, b]) {
        return Some(at_rocker);
    }
    let at_crank = angle([o, b], [crank, coupler]);
    Some(if (at_crank - 90.0).abs() > (at_rocker - 90.0).abs() { at_crank } else { at_rocker })
}

/// Whether the link through two pins is the driven one: the crank of the linkage as it was built.
fn is_driven(linkage: &Linkage, pins: [JointId; 2]) -> bool {
    linkage.joint_ids().zip(&linkage.joints).any(|(id, joint)| match joint.kind {
        JointKind::Crank { pivot, .. } => pins == [pivot, id] || pins == [id, pivot],
        _ => false,
    })
}

/// The least and the greatest distance of the crank's pin from the other fixed pivot over a circuit.
fn pin_distance_range(curve: &TracedCurve, [o, a, c]: [JointId; 3], [frame, crank]: [f64; 2]) -> [f64; 2] {
    let circuit = curve.circuit;
    let at = |joint, i| circuit.positions.point(joint, i);
    // The input at which the crank points along the frame line.
    let along = at(c, 0) - at(o, 0);
    let arm = at(a, 0) - at(o, 0);
    let angle_sine = cross(arm, along) * curve.linkage.placement.handedness();
    let turn = trig::degrees(trig::atan2(angle_sine, arm.dot(&along)));
    let towards = circuit.inputs[0] + turn;
    let is_reached = |deg: f64| {
        circuit.passes.iter().any(|pass| {
            let [low, high] = pass.input_range();
            (deg - low + 1e-9).rem_euclid(360.0) <= high - low + 2e-9
        })
    };
    let samples = (0..circuit.len()).map(|i| (at(a, i) - at(c, i)).norm());
    let [mut least, mut greatest] =
        samples.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, greatest], d| [least.min(d), greatest.max(d)]);
    if is_reached(towards) {
        least = (frame - crank).abs();
    }
    if is_reached(towards + 180.0) {
        greatest = frame + crank;
    }
    [least, greatest]
}

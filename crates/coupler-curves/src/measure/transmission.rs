//! Transmission angles.

use super::circuit_function::{Pose, Quantity, SquaredDistance};
use super::{Measure, Subject, TracedCurve, Value};
use crate::geometry::{Point, Vector, cross, trig};
use crate::linkage::{FourBar, JointId, JointKind, Linkage, length_tolerance};

/// The measure `mu_min_deg`.
pub const MU_MIN: Measure = Measure::number(
    "mu_min_deg",
    "least transmission angle",
    "deg",
    "least transmission angle of a four-bar over the circuit, 0 to 180; if the coupler is driven, at both pins (McCarthy 2.3.3)",
    |curve: &TracedCurve| curve.transmission_angles().map_or(Value::Missing, |[least, _]| Value::Number(least)),
).of(Subject::FourBar).more_is_better();

/// The measure `mu_max_deg`.
pub const MU_MAX: Measure = Measure::number(
    "mu_max_deg",
    "greatest transmission angle",
    "deg",
    "greatest transmission angle of a four-bar over the circuit, 0 to 180; if the coupler is driven, at both pins",
    |curve: &TracedCurve| curve.transmission_angles().map_or(Value::Missing, |[_, most]| Value::Number(most)),
)
.of(Subject::FourBar);

/// The measure `mu_worst_deg`.
pub const MU_WORST: Measure = Measure::number(
    "mu_worst_deg",
    "worst transmission angle",
    "deg",
    "worst transmission angle over the circuit, the least distance from 0 and 180, 0 to 90: of a four-bar as mu_min_deg and mu_max_deg, otherwise of all dyads, at a slider 90 minus the pressure angle",
    |curve| curve.worst_transmission_angle().map_or(Value::Missing, Value::Number),
).of(Subject::WithDyad).more_is_better();

impl TracedCurve<'_> {
    /// The least and the greatest transmission angle, in degrees.
    fn transmission_angles(&self) -> Option<[f64; 2]> {
        *self.transmission_angles.get_or_init(|| transmission_angles(self))
    }

    /// The worst transmission angle, in degrees.
    pub(super) fn worst_transmission_angle(&self) -> Option<f64> {
        *self.circuit_results.0.worst_transmission_angle.get_or_init(|| worst_angle(self))
    }
}

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
        let [o, _, _, c] = FourBar::pins(linkage)?;
        let [least, greatest] = pin_distance_range(curve, [o, c], [frame, crank])?;
        return Some([least, greatest].map(|d| opposite_angle(d, [coupler, rocker])));
    }
    let [o, a, b, c] = FourBar::pins(linkage)?;
    let angle = |ends: [JointId; 2], sides: [f64; 2]| {
        Some(distance_range(curve, ends)?.map(|side| opposite_angle(side, sides)))
    };
    let at_rocker = angle([a, c], [coupler, rocker])?;
    if !is_driven(linkage, [a, b]) {
        return Some(at_rocker);
    }
    let at_crank = angle([o, b], [crank, coupler])?;
    Some([at_rocker[0].min(at_crank[0]), at_rocker[1].max(at_crank[1])])
}

/// The least distance of a transmission angle from 0 and 180 degrees over the circuit; `None` for a linkage in which
/// no joint has one, and where a position is undefined.
fn worst_angle(curve: &TracedCurve) -> Option<f64> {
    if let Some([least, greatest]) = curve.transmission_angles() {
        return Some(least.min(180.0 - greatest));
    }
    let ids = curve.linkage.joint_ids().zip(&curve.linkage.joints);
    let joints = ids.filter(|(_, joint)| joint.kind.dyad().is_some() || matches!(joint.kind, JointKind::Yoke { .. }));
    let angles = joints.map(|(id, joint)| worst_angle_of_joint(curve, id, joint.kind));
    angles.reduce(|worst, angle| Some(worst?.min(angle?)))?
}

/// The worst transmission angle over the circuit of a joint that is a dyad's or a yoke's, from 0 to 90 degrees; `None`
/// where it is undefined.
///
/// At the pin of two links it is the angle between them, and likewise that between an actuator, which has a pin at each
/// end, and the crank it drives. A slider is pushed along its link, and a slot's link at right angles to its line: there
/// it is the complement of the pressure angle, the one between the force and the velocity of the point it acts on. A
/// yoke is pushed at right angles to its slot.
///
/// # Source
/// Balli and Chand, Transmission angle in mechanisms, *Mechanism and Machine Theory* 37 (2002), 175-195.
fn worst_angle_of_joint(curve: &TracedCurve, id: JointId, kind: JointKind) -> Option<f64> {
    let is_flat = || {
        let passes = &curve.circuit.passes;
        passes.iter().any(|pass| [pass.from, pass.to].iter().any(|end| end.is_extended_or_folded(kind)))
    };
    match kind {
        JointKind::Slot { offset: 0.0, .. } => Some(90.0),
        _ if is_flat() => Some(0.0),
        JointKind::Dyad { base, lengths, .. } => {
            let [least, greatest] = distance_range(curve, base)?;
            Some(opposite_angle(least, lengths).min(180.0 - opposite_angle(greatest, lengths)))
        }
        JointKind::Slide { from, length, line, offset, .. } => {
            let handedness = curve.linkage.placement.handedness();
            let range = range_of(curve, &DistanceFromLine { from, line, offset, handedness })?;
            Some(acute_angle(range[0].abs().max(range[1].abs()), length))
        }
        JointKind::Slot { base, offset, .. } => Some(acute_angle(offset.abs(), distance_range(curve, base)?[0])),
        JointKind::Piston { base: [from, pivot], .. } => {
            let [least, greatest] = range_of(curve, &AngleAt([from, id, pivot]))?.map(trig::degrees);
            // The angle is 0 or 180 somewhere if a whole number of half turns is in its range.
            let above = |deg: f64| deg - 180.0 * (deg / 180.0).floor();
            let is_flat = greatest - least >= 180.0 - above(least);
            Some(if is_flat { 0.0 } else { above(least).min(180.0 - above(greatest)) })
        }
        JointKind::Yoke { slot_direction: slot, .. } => Some(trig::degrees(trig::atan2(slot.y.abs(), slot.x.abs()))),
        _ => None,
    }
}

/// The angle between a link of a length and a direction along which it extends by `share`, in degrees; exactly 0 if
/// they are equal.
fn acute_angle(share: f64, length: f64) -> f64 {
    let gap = length - share;
    let gap = if gap <= 4.0 * length_tolerance(length) { 0.0 } else { gap };
    trig::degrees(trig::atan2((gap * (length + share)).sqrt(), share))
}

/// The least and the greatest value of a quantity over the circuit; `None` where it is undefined.
fn range_of(curve: &TracedCurve, quantity: &dyn Quantity) -> Option<[f64; 2]> {
    Some(curve.circuit_function(quantity)?.range())
}

/// The least and the greatest distance of two joints over the circuit.
fn distance_range(curve: &TracedCurve, joints: [JointId; 2]) -> Option<[f64; 2]> {
    Some(range_of(curve, &SquaredDistance(joints))?.map(|squared| squared.max(0.0).sqrt()))
}

/// The distance of a slider's line to the left of the joint at the other end of its link.
struct DistanceFromLine {
    from: JointId,
    line: [JointId; 2],
    offset: f64,
    /// -1 if the linkage is mirrored, and its left is on the right.
    handedness: f64,
}

impl Quantity for DistanceFromLine {
    fn joints(&self) -> Vec<JointId> {
        vec![self.from, self.line[0], self.line[1]]
    }

    fn value(&self, pose: &Pose) -> f64 {
        let [p, q] = self.line.map(|joint| pose.at(joint));
        self.offset - self.handedness * cross((q - p).normalize(), pose.at(self.from) - p)
    }

    fn sensitivity(&self, pose: &Pose) -> f64 {
        let [p, q] = self.line.map(|joint| pose.at(joint));
        2.0 + 2.0 * (pose.at(self.from) - p).norm() / (q - p).norm()
    }
}

/// The angle at the second of three joints from the first to the third, in radians.
struct AngleAt([JointId; 3]);

impl Quantity for AngleAt {
    fn joints(&self) -> Vec<JointId> {
        self.0.to_vec()
    }

    fn value(&self, pose: &Pose) -> f64 {
        let [from, pin, to] = self.0.map(|joint| pose.at(joint));
        let [from, to]: [Vector; 2] = [from - pin, to - pin];
        trig::atan2(cross(from, to), from.dot(&to))
    }

    fn sensitivity(&self, pose: &Pose) -> f64 {
        let [from, pin, to] = self.0.map(|joint| pose.at(joint));
        2.0 / (from - pin).norm() + 2.0 / (to - pin).norm()
    }

    fn period(&self) -> Option<f64> {
        Some(std::f64::consts::TAU)
    }
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

/// The least and the greatest distance of the crank's pin from the other fixed pivot over a circuit: at the ends of the
/// passes, and where the crank points along the frame line.
fn pin_distance_range(curve: &TracedCurve, [o, c]: [JointId; 2], [frame, crank]: [f64; 2]) -> Option<[f64; 2]> {
    let fixed = |joint: JointId| match curve.linkage.joints[joint].kind {
        JointKind::Fixed(at) => Some(at),
        _ => None,
    };
    let along = fixed(c)? - fixed(o)?;
    let towards = trig::degrees(trig::atan2(along.y, along.x));
    let passes = &curve.circuit.passes;
    let is_reached = |deg: f64| {
        passes.iter().any(|pass| {
            let [low, high] = pass.input_range();
            (deg - low + 1e-9).rem_euclid(360.0) <= high - low + 2e-9
        })
    };
    let ends = passes.iter().flat_map(|pass| [pass.from.input, pass.to.input]);
    let distances = ends.map(|input| (Vector::new(input.cos, input.sin) * crank - along).norm());
    let [mut least, mut greatest] =
        distances.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, greatest], d| [least.min(d), greatest.max(d)]);
    if is_reached(towards) {
        least = (frame - crank).abs();
    }
    if is_reached(towards + 180.0) {
        greatest = frame + crank;
    }
    Some([least, greatest])
}

//! The pose at the end of a pass, where dyads are flat and bases may vanish.

use super::derivatives::JointDerivatives;
use super::pass::{InputPosition, Pass, PassEnd};
use super::positions::{DyadSigns, InputColumns, JointPositions, place_joints, place_leading_joints};
use crate::geometry::{Point, Vector, cross, left_normal};
use crate::linkage::{AssemblyMode, DyadSet, JointId, JointKind, LineDirection, Linkage};

/// Places every joint at one sample where a pass begins or ends, in the frame of the fixed joints.
///
/// A flat dyad is placed with the exact length of its first link. Where a base vanishes, its joint is placed by
/// continuity along the pass: the base then points along its derivative, or, where that is infinite at a limit, along
/// the derivative with respect to the root of the input. Where there is no such direction, the position is undefined.
pub(super) fn place_at_end(linkage: &Linkage, pass: &Pass, begins: bool, out: &mut JointPositions, sample: usize) {
    let (end, inwards) = if begins { (pass.from, pass.input_direction()) } else { (pass.to, -pass.input_direction()) };
    let PassEnd { input, flat_dyads: flat } = end;
    let signs = DyadSigns::new(pass.mode, flat);
    let inputs = InputColumns::new(&[input]);
    place_leading_joints(linkage, linkage.joints.len(), inputs.as_slices(), &signs, out, sample..sample + 1);
    if flat.is_empty() {
        return;
    }
    for (id, joint) in linkage.joint_ids().zip(&linkage.joints) {
        let at = |j: JointId| out.point(j, sample);
        let placed = match joint.kind {
            JointKind::Dyad { base: [p, q], lengths, dyad } if flat.contains(dyad) => {
                let base = at(q) - at(p);
                if base.norm() <= VANISHING_BASE * lengths[0] {
                    let pose =
                        EndPose { linkage, positions: out, sample, input, mode: pass.mode, flat_dyads: flat, inwards };
                    // On a base of no length the two links are equally long and collinear, perpendicular to the base.
                    let sign = f64::from(pass.mode.sign(dyad));
                    let across = pose.base_direction([p, q]).map(|d| left_normal(d) * (sign * lengths[0]));
                    across.map_or(Point::new(f64::NAN, f64::NAN), |across| at(p) + across)
                } else {
                    at(p) + base * (flat_foot(lengths, base.norm()) / base.norm())
                }
            }
            // A slot without offset whose joint is on its pivot: the line keeps its direction.
            JointKind::Aligned { from, line, direction: LineDirection::BySide(dyad), along, across, .. }
                if flat.contains(dyad) =>
            {
                let pose =
                    EndPose { linkage, positions: out, sample, input, mode: pass.mode, flat_dyads: flat, inwards };
                let sense = -f64::from(pass.mode.sign(dyad));
                let arm = pose.base_direction(line).map(|d| (d * along + left_normal(d) * across) * sense);
                arm.map_or(Point::new(f64::NAN, f64::NAN), |arm| at(from) + arm)
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

/// The direction of a base shorter than this part of its dyad's links is only rounding.
const VANISHING_BASE: f64 = 1e-12;

/// The position of a flat dyad's joint along its base, from the base's first joint.
fn flat_foot([l0, l1]: [f64; 2], base: f64) -> f64 {
    if l0 < l1 && base < l1 { -l0 } else { l0 }
}

/// The pose at an end of a pass.
struct EndPose<'a> {
    linkage: &'a Linkage,
    positions: &'a JointPositions,
    sample: usize,
    input: InputPosition,
    mode: AssemblyMode,
    flat_dyads: DyadSet,
    /// 1 where the pass lies at greater inputs, -1 where it lies at smaller ones.
    inwards: f64,
}

impl EndPose<'_> {
    /// The direction of a vanishing base in the pass, in the limit towards its end.
    fn base_direction(&self, [p, q]: [JointId; 2]) -> Option<Vector> {
        let derivatives = JointDerivatives::in_fixed_frame(self.linkage, self.input, self.mode, self.flat_dyads);
        let rate = (derivatives.velocity(q) - derivatives.velocity(p)) * self.inwards;
        let rate = if rate.norm().is_finite() {
            rate
        } else {
            self.root_rate(q, &derivatives)? - self.root_rate(p, &derivatives)?
        };
        (rate.norm() > 0.0 && rate.norm().is_finite()).then(|| rate.normalize())
    }

    /// The derivative of a joint's position with respect to the root of the input, by which it changes near a limit.
    fn root_rate(&self, joint: JointId, derivatives: &JointDerivatives) -> Option<Vector> {
        let point = |j| self.positions.point(j, self.sample);
        match self.linkage.joints[joint].kind {
            JointKind::Fixed(_) | JointKind::Crank { .. } | JointKind::Gear { .. } => Some(Vector::zeros()),
            JointKind::Rigid { base: [p, q], along, across } => {
                let (p, q) = (self.root_rate(p, derivatives)?, self.root_rate(q, derivatives)?);
                Some(p + (q - p) * along + left_normal(q - p) * across)
            }
            JointKind::Parallelogram { corners: [p, q, r] } => Some(
                self.root_rate(p, derivatives)? + self.root_rate(r, derivatives)? - self.root_rate(q, derivatives)?,
            ),
            JointKind::Dyad { base: [p, q], lengths: [l0, l1], dyad } if self.flat_dyads.contains(dyad) => {
                // The square of the height is l0^2 - foot^2, with foot = (d^2 + l0^2 - l1^2) / 2d: its derivative is
                // finite.
                let base = point(q) - point(p);
                let d = base.norm();
                let d_rate = base.dot(&(derivatives.velocity(q) - derivatives.velocity(p))) / d;
                let foot_rate = (0.5 - (l0 - l1) * (l0 + l1) / (2.0 * d * d)) * d_rate;
                let factor = (2.0 * flat_foot([l0, l1], d) * foot_rate).abs().sqrt();
                let sign = f64::from(self.mode.sign(dyad));
                factor.is_finite().then(|| left_normal(base) * (sign * factor / d))
            }
            JointKind::Slot { base: [p, q], offset, dyad } if self.flat_dyads.contains(dyad) && offset != 0.0 => {
                // The square of the slide is d^2 - e^2, and at the limit the foot moves as the slide does.
                let base = point(q) - point(p);
                let rate = base.dot(&(derivatives.velocity(q) - derivatives.velocity(p)));
                let factor = (2.0 * rate).abs().sqrt() * f64::from(self.mode.sign(dyad)) * offset.signum();
                factor.is_finite().then(|| left_normal(base) * (factor / base.norm()))
            }
            JointKind::Dyad { base: [p, q], .. } => {
                // Both links keep their lengths: u . v = u . vp and w . v = w . vq.
                let (u, w) = (point(joint) - point(p), point(joint) - point(q));
                let (a, b) = (u.dot(&self.root_rate(p, derivatives)?), w.dot(&self.root_rate(q, derivatives)?));
                Some(Vector::new(a * w.y - b * u.y, b * u.x - a * w.x) / cross(u, w))
            }
            _ => None,
        }
    }
}

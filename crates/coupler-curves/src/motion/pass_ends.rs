//! The pose at the end of a pass, where dyads lie flat and bases may vanish.

use super::circuit::{InputPosition, Pass, PassEnd};
use super::derivatives::JointDerivatives;
use super::positions::{DyadSigns, InputColumns, JointPositions, place_joints, place_leading_joints};
use crate::geometry::{Point, Vector, cross, left_normal};
use crate::linkage::{AssemblyMode, DyadSet, JointId, JointKind, LineDirection, Linkage};

/// Places every joint at one sample where a pass begins or ends, in the frame of the fixed joints.
///
/// A flat dyad is laid out by its first link's own length. Where a base vanishes its joint is placed by continuity,
/// as the pass comes to it or leaves it: the base then points along its rate of change, or, where that is infinite at
/// a limit, along the rate of its parts with the root of the input. Where there is no such direction the joint stays
/// undefined.
pub(super) fn place_at_end(linkage: &Linkage, pass: &Pass, begins: bool, out: &mut JointPositions, sample: usize) {
    let (end, inwards) = if begins { (pass.from, pass.input_direction()) } else { (pass.to, -pass.input_direction()) };
    let PassEnd { input: stop, flat_dyads: flat } = end;
    let modes = DyadSigns::new(pass.mode, flat);
    let inputs = InputColumns::new(&[stop]);
    place_leading_joints(linkage, linkage.joints.len(), inputs.as_slices(), &modes, out, sample..sample + 1);
    if flat.is_empty() {
        return;
    }
    for (id, joint) in linkage.joints.iter().enumerate() {
        let at = |j: JointId| out.point(j, sample);
        let placed = match joint.kind {
            JointKind::Dyad { base: [p, q], lengths, index } if flat.contains(index) => {
                let base = at(q) - at(p);
                if base.norm() <= VANISHING_BASE * lengths[0] {
                    let pose = EndPose {
                        linkage,
                        positions: out,
                        sample,
                        input: stop,
                        mode: pass.mode,
                        flat_dyads: flat,
                        inwards,
                    };
                    // On a base of no length the two links have one length and lie on one line, square to the base.
                    let mode = f64::from(pass.mode.sign(index));
                    let across = pose.base_direction([p, q]).map(|d| left_normal(d) * (mode * lengths[0]));
                    across.map_or(Point::new(f64::NAN, f64::NAN), |across| at(p) + across)
                } else {
                    at(p) + base * (flat_foot(lengths, base.norm()) / base.norm())
                }
            }
            // A slot without offset whose joint is on its pivot: the line goes on as it comes.
            JointKind::Aligned { from, line, direction: LineDirection::BySide(index), along, across, .. }
                if flat.contains(index) =>
            {
                let pose = EndPose {
                    linkage,
                    positions: out,
                    sample,
                    input: stop,
                    mode: pass.mode,
                    flat_dyads: flat,
                    inwards,
                };
                let sense = -f64::from(pass.mode.sign(index));
                let moved = pose.base_direction(line).map(|d| (d * along + left_normal(d) * across) * sense);
                moved.map_or(Point::new(f64::NAN, f64::NAN), |moved| at(from) + moved)
            }
            // What hangs on a joint that was placed here is placed anew.
            _ => {
                place_joints(linkage, id..id + 1, inputs.as_slices(), &modes, out, sample..sample + 1);
                continue;
            }
        };
        out.set_point(id, sample, placed);
    }
}

/// A base shorter than this part of its dyad's links has no direction left but its rounding.
const VANISHING_BASE: f64 = 1e-12;

/// Where the joint of a flat dyad lies on its base, from the base's first joint.
fn flat_foot([l0, l1]: [f64; 2], base: f64) -> f64 {
    if l0 < l1 && base < l1 { -l0 } else { l0 }
}

/// A pose at an end of a pass.
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
    /// The direction that a vanished base has in the pass, just beside its end.
    fn base_direction(&self, [p, q]: [JointId; 2]) -> Option<Vector> {
        let jets = JointDerivatives::in_fixed_frame(self.linkage, self.input, self.mode, self.flat_dyads);
        let rate = (jets.velocity(q) - jets.velocity(p)) * self.inwards;
        let rate = if rate.norm().is_finite() { rate } else { self.root_rate(q, &jets)? - self.root_rate(p, &jets)? };
        (rate.norm() > 0.0 && rate.norm().is_finite()).then(|| rate.normalize())
    }

    /// How a joint leaves a limit: its place goes with the root of the input, and this is the factor.
    fn root_rate(&self, joint: JointId, jets: &JointDerivatives) -> Option<Vector> {
        let point = |j| self.positions.point(j, self.sample);
        match self.linkage.joints[joint].kind {
            JointKind::Fixed(_) | JointKind::Crank { .. } | JointKind::Gear { .. } => Some(Vector::zeros()),
            JointKind::Rigid { base: [p, q], along, across } => {
                let (p, q) = (self.root_rate(p, jets)?, self.root_rate(q, jets)?);
                Some(p + (q - p) * along + left_normal(q - p) * across)
            }
            JointKind::Parallelogram { corners: [p, q, r] } => {
                Some(self.root_rate(p, jets)? + self.root_rate(r, jets)? - self.root_rate(q, jets)?)
            }
            JointKind::Dyad { base: [p, q], lengths: [l0, l1], index } if self.flat_dyads.contains(index) => {
                // The square of the height is l0^2 - foot^2, with foot = (d^2 + l0^2 - l1^2) / 2d: its rate is finite.
                let base = point(q) - point(p);
                let d = base.norm();
                let d_rate = base.dot(&(jets.velocity(q) - jets.velocity(p))) / d;
                let foot_rate = (0.5 - (l0 - l1) * (l0 + l1) / (2.0 * d * d)) * d_rate;
                let factor = (2.0 * flat_foot([l0, l1], d) * foot_rate).abs().sqrt();
                let mode = f64::from(self.mode.sign(index));
                factor.is_finite().then(|| left_normal(base) * (mode * factor / d))
            }
            JointKind::Slot { base: [p, q], offset, index } if self.flat_dyads.contains(index) && offset != 0.0 => {
                // The square of the slide is d^2 - e^2, and at the limit the foot goes as the slide does.
                let base = point(q) - point(p);
                let rate = base.dot(&(jets.velocity(q) - jets.velocity(p)));
                let factor = (2.0 * rate).abs().sqrt() * f64::from(self.mode.sign(index)) * offset.signum();
                factor.is_finite().then(|| left_normal(base) * (factor / base.norm()))
            }
            JointKind::Dyad { base: [p, q], .. } => {
                // Both links keep their lengths: u . v = u . vp and w . v = w . vq.
                let (u, w) = (point(joint) - point(p), point(joint) - point(q));
                let (a, b) = (u.dot(&self.root_rate(p, jets)?), w.dot(&self.root_rate(q, jets)?));
                Some(Vector::new(a * w.y - b * u.y, b * u.x - a * w.x) / cross(u, w))
            }
            _ => None,
        }
    }
}

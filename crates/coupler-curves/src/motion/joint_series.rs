//! The kernels of [`super::positions`] over Taylor series.

use std::f64::consts::PI;

use super::series::{Scalar, Series, VectorSeries};
use crate::geometry::Vector;
use crate::linkage::{DyadId, JointId, JointKind, LineDirection, Linkage};

/// A value of the input and, for an angle, its direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct SeriesInput<T> {
    /// The angle in degrees, or the length.
    pub value: T,
    /// The cosine and the sine of the angle; not used for a length.
    pub direction: [T; 2],
}

/// Places the first `joints` joints as series in the input, each from those before it, in the frame of the fixed
/// joints.
///
/// The series are in radians of an angle, or in units of a length. `sign` is the factor of a dyad's height. `adjust` is called with each joint's series and those of the joints
/// before it, and returns the series that later joints are placed from.
///
/// # Source
/// The constraints of each dyad as [`super::positions::place_leading_joints`] solves them, written so that each
/// variable occurs as few times as possible: that makes enclosures narrow.
pub(super) fn place_as_series<T: Scalar, const N: usize>(
    linkage: &Linkage,
    joints: usize,
    input: SeriesInput<T>,
    sign: impl Fn(DyadId) -> f64,
    mut adjust: impl FnMut(JointId, VectorSeries<T, N>, &[VectorSeries<T, N>]) -> VectorSeries<T, N>,
) -> Vec<VectorSeries<T, N>> {
    let mut at: Vec<VectorSeries<T, N>> = Vec::with_capacity(joints);
    for (id, joint) in linkage.joints[..joints].iter().enumerate() {
        let position = place_joint_as_series(joint.kind, &at, input, &sign);
        let position = adjust(JointId::new(id), position, &at);
        at.push(position);
    }
    at
}

/// Places a joint as [`place_as_series`] does, from the joints before it.
pub(super) fn place_joint_as_series<T: Scalar, const N: usize>(
    kind: JointKind,
    at: &[VectorSeries<T, N>],
    input: SeriesInput<T>,
    sign: impl Fn(DyadId) -> f64,
) -> VectorSeries<T, N> {
    let constant = |value: f64| Series::constant(value);
    let zero = constant(0.0);
    match kind {
        JointKind::Fixed(point) => VectorSeries::constant(point.coords),
        JointKind::Crank { pivot, length } => {
            at[pivot].moved(VectorSeries::rotating_unit(input.direction, 1.0), constant(length), zero)
        }
        JointKind::Gear { pivot, length, ratio, phase_deg } => {
            let direction = input.value.geared_angle(ratio, phase_deg).cos_sin_deg();
            let ratio = ratio[0] as f64 / ratio[1] as f64;
            at[pivot].moved(VectorSeries::rotating_unit(direction, ratio), constant(length), zero)
        }
        JointKind::Piston { base, length, offset, dyad } => {
            let b = (Series::variable(input.value).square() + constant(offset * offset)).sqrt();
            dyad_position(base.map(|j| at[j]), [b, constant(length)], sign(dyad))
        }
        JointKind::Rack { line: [p, q], offset, radius, start } => {
            let turn = Series::variable(input.value * T::from(PI / 180.0));
            at[p].moved(at[q].minus(at[p]).unit(), turn.scaled(radius) + constant(start), constant(offset))
        }
        JointKind::DrivenSlider { line: [p, q], offset } => {
            at[p].moved(at[q].minus(at[p]).unit(), Series::variable(input.value), constant(offset))
        }
        JointKind::Dyad { base, lengths, dyad } => {
            dyad_position(base.map(|j| at[j]), lengths.map(constant), sign(dyad))
        }
        JointKind::Slide { from, length, line: [p, q], offset, dyad } => {
            let unit = at[q].minus(at[p]).unit();
            let h = constant(offset) - unit.cross(at[from].minus(at[p]));
            let along = (constant(length) - h) * (constant(length) + h);
            let along = along.sqrt().scaled(sign(dyad));
            at[from].moved(unit, along, h)
        }
        JointKind::Slot { base: [p, _], offset: 0.0, .. } => at[p],
        JointKind::Slot { base: [p, q], offset, dyad } => {
            let base = at[q].minus(at[p]);
            let d2 = base.norm_squared();
            let along = constant(offset * offset) / d2;
            let across = d2 - constant(offset * offset);
            let across = across.sqrt().scaled(offset * sign(dyad)) / d2;
            at[p].moved(base, along, across)
        }
        JointKind::Rigid { base: [p, q], along, across } => {
            at[p].moved(at[q].minus(at[p]), constant(along), constant(across))
        }
        // The caller has the positions of a group, and puts them in place of these.
        JointKind::Grouped { .. } => VectorSeries::constant(Vector::zeros()),
        JointKind::Parallelogram { corners: [p, q, r] } => at[p].moved(at[r].minus(at[q]), constant(1.0), zero),
        JointKind::Yoke { from, line: [p, q], offset, slot_direction: slot } => {
            let unit = at[q].minus(at[p]).unit();
            let pin = at[from].minus(at[p]);
            let along = unit.dot(pin) - (unit.cross(pin) - constant(offset)).scaled(slot.x / slot.y);
            at[p].moved(unit, along, constant(offset))
        }
        JointKind::Aligned { from, line: [p, q], offset, direction: line_direction, along, across } => {
            let base = at[q].minus(at[p]);
            let d2 = base.norm_squared();
            let sense = if let LineDirection::BySide(dyad) = line_direction { -sign(dyad) } else { 1.0 };
            let s = match line_direction {
                LineDirection::Actuator => Series::variable(input.value),
                _ if offset == 0.0 => d2.sqrt(),
                _ => (d2 - constant(offset * offset)).sqrt(),
            };
            // The line's direction is the base's, rotated clockwise by the angle whose sine is offset / d.
            let (along, across) = (constant(along * sense), constant(across * sense));
            let e = constant(offset);
            at[from].moved(base, (along * s + across * e) / d2, (across * s - along * e) / d2)
        }
    }
}

/// The joint of an RRR dyad, as the kernel places it.
fn dyad_position<T: Scalar, const N: usize>(
    [p, q]: [VectorSeries<T, N>; 2],
    [l0, l1]: [Series<T, N>; 2],
    sign: f64,
) -> VectorSeries<T, N> {
    let base = q.minus(p);
    let d2 = base.norm_squared();
    let d = d2.sqrt();
    let (sum, difference) = (l0 + l1, l0 - l1);
    let discriminant = (sum - d) * (sum + d) * ((d - difference) * (d + difference));
    let along = Series::constant(0.5) + (sum * difference).scaled(0.5) / d2;
    let across = discriminant.sqrt().scaled(0.5 * sign) / d2;
    p.moved(base, along, across)
}

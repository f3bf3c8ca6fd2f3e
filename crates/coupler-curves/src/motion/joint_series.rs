use super::series::{Scalar, Series, VectorSeries};
use crate::linkage::{JointId, JointKind, LineDirection, Linkage};

/// An input, as a value and, of an angle, as a direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct SeriesInput<T> {
    /// The angle in degrees, or the length.
    pub value: T,
    /// The cosine and the sine of the angle; of no meaning for a length.
    pub direction: [T; 2],
}

/// Places the first `joints` joints as series in the input, each from those before it, in the frame of the fixed joints.
///
/// Angles of input are in radians, lengths in their unit. `mode` is what a dyad's height is multiplied by; of one that is
/// multiplied by 0 the height is left out, with its rates. Each joint is handed to `settle`, with those before it, before
/// others are placed on it.
///
/// # Source
/// The constraints of each dyad as [`super::positions::place_leading_joints`] solves them, written so that each variable stands as few
/// times as may be: that makes enclosures narrow.
pub(super) fn place_as_series<T: Scalar, const N: usize>(
    linkage: &Linkage,
    joints: usize,
    drive: SeriesInput<T>,
    mode: impl Fn(usize) -> f64,
    mut settle: impl FnMut(JointId, VectorSeries<T, N>, &[VectorSeries<T, N>]) -> VectorSeries<T, N>,
) -> Vec<VectorSeries<T, N>> {
    let constant = |value: f64| Series::constant(value);
    let none = constant(0.0);
    let mut at: Vec<VectorSeries<T, N>> = Vec::with_capacity(joints);
    for (id, joint) in linkage.joints[..joints].iter().enumerate() {
        let place = match joint.kind {
            JointKind::Fixed(place) => VectorSeries::constant(place.coords),
            JointKind::Crank { pivot, length } => {
                at[pivot].moved(VectorSeries::rotating_unit(drive.direction, 1.0), constant(length), none)
            }
            JointKind::Gear { pivot, length, ratio, phase_deg } => {
                let direction = drive.value.geared_angle(ratio, phase_deg).cos_sin_deg();
                let by = ratio[0] as f64 / ratio[1] as f64;
                at[pivot].moved(VectorSeries::rotating_unit(direction, by), constant(length), none)
            }
            JointKind::Piston { base, length, offset, index } => {
                let b = (Series::variable(drive.value).square() + constant(offset * offset)).sqrt();
                dyad_position(base.map(|j| at[j]), [b, constant(length)], mode(index))
            }
            JointKind::Dyad { base, lengths, index } => {
                dyad_position(base.map(|j| at[j]), lengths.map(constant), mode(index))
            }
            JointKind::Slide { from, length, line: [p, q], offset, index } => {
                let unit = at[q].minus(at[p]).unit();
                let h = constant(offset) - unit.cross(at[from].minus(at[p]));
                let along = (constant(length) - h) * (constant(length) + h);
                let along = if mode(index) == 0.0 { none } else { along.sqrt().scaled(mode(index)) };
                at[from].moved(unit, along, h)
            }
            JointKind::Slot { base: [p, _], offset: 0.0, .. } => at[p],
            JointKind::Slot { base: [p, q], offset, index } => {
                let base = at[q].minus(at[p]);
                let d2 = base.norm_squared();
                let along = constant(offset * offset) / d2;
                let across = d2 - constant(offset * offset);
                let across = if mode(index) == 0.0 { none } else { across.sqrt().scaled(offset * mode(index)) / d2 };
                at[p].moved(base, along, across)
            }
            JointKind::Rigid { base: [p, q], along, across } => {
                at[p].moved(at[q].minus(at[p]), constant(along), constant(across))
            }
            JointKind::Parallelogram { corners: [p, q, r] } => at[p].moved(at[r].minus(at[q]), constant(1.0), none),
            JointKind::Yoke { from, line: [p, q], offset, slot_direction: slot } => {
                let unit = at[q].minus(at[p]).unit();
                let pin = at[from].minus(at[p]);
                let along = unit.dot(pin) - (unit.cross(pin) - constant(offset)).scaled(slot.x / slot.y);
                at[p].moved(unit, along, constant(offset))
            }
            JointKind::Aligned { from, line: [p, q], offset, direction: line_is, along, across } => {
                let base = at[q].minus(at[p]);
                let d2 = base.norm_squared();
                let sense = if let LineDirection::BySide(index) = line_is { -mode(index) } else { 1.0 };
                let s = match line_is {
                    LineDirection::Actuator => Series::variable(drive.value),
                    _ if offset == 0.0 => d2.sqrt(),
                    _ => (d2 - constant(offset * offset)).sqrt(),
                };
                // The line's direction is the base's, turned to the right by the angle whose sine is offset / d.
                let (along, across) = (constant(along * sense), constant(across * sense));
                let e = constant(offset);
                at[from].moved(base, (along * s + across * e) / d2, (across * s - along * e) / d2)
            }
        };
        let place = settle(id, place, &at);
        at.push(place);
    }
    at
}

/// The third corner of a triangle of two links on a base, as the kernel places it.
fn dyad_position<T: Scalar, const N: usize>(
    [p, q]: [VectorSeries<T, N>; 2],
    [l0, l1]: [Series<T, N>; 2],
    mode: f64,
) -> VectorSeries<T, N> {
    let base = q.minus(p);
    let d2 = base.norm_squared();
    let d = d2.sqrt();
    let (sum, difference) = (l0 + l1, l0 - l1);
    let discriminant = (sum - d) * (sum + d) * ((d - difference) * (d + difference));
    let along = Series::constant(0.5) + (sum * difference).scaled(0.5) / d2;
    let across = if mode == 0.0 { Series::constant(0.0) } else { discriminant.sqrt().scaled(0.5 * mode) / d2 };
    p.moved(base, along, across)
}

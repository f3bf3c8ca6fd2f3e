//! Positions of all joints by columns, and the kernels that place each kind of joint.

use std::ops::Range;

use pulp::{Arch, Simd, WithSimd};

use super::input_columns::InputSlices;
use super::series::geared_angle;
use crate::geometry::{Orientation, Point, cross, trig};
use crate::linkage::{AssemblyMode, DyadId, DyadSet, JointId, JointKind, LineDirection, Linkage, MAX_DYADS};

/// Positions of all joints at all samples, joint by joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointPositions {
    len: usize,
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
}

impl JointPositions {
    /// Zeros for `joints` joints and `len` samples.
    pub fn new(joints: usize, len: usize) -> JointPositions {
        JointPositions { len, x: vec![0.0; joints * len], y: vec![0.0; joints * len] }
    }

    /// The number of samples.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are no samples.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The x coordinates of a joint, sample by sample.
    pub fn x(&self, joint: JointId) -> &[f64] {
        &self.x[joint.index() * self.len..][..self.len]
    }

    /// The y coordinates of a joint, sample by sample.
    pub fn y(&self, joint: JointId) -> &[f64] {
        &self.y[joint.index() * self.len..][..self.len]
    }

    /// The position of a joint at a sample; NaN where it is undefined.
    #[inline]
    pub fn point(&self, joint: JointId, sample: usize) -> Point {
        Point::new(self.x(joint)[sample], self.y(joint)[sample])
    }

    /// The greatest magnitude of a coordinate of any joint at any sample, apart from undefined ones; 0 if there is none.
    pub fn greatest_coordinate(&self) -> f64 {
        self.x.iter().chain(&self.y).fold(0.0, |most: f64, value| most.max(value.abs()))
    }

    /// Whether all links keep their lengths, to a part of the longest of each: where a linkage cannot be assembled, its joints are placed otherwise.
    pub fn keep_lengths(&self, linkage: &Linkage, part: f64) -> bool {
        linkage.links.iter().all(|link| {
            let Some((first, from)) = link.joints.first() else { return true };
            let lengths = || link.joints[1..].iter().map(|(joint, to)| (joint, (to - from).norm()));
            let most = part * lengths().fold(0.0, |most: f64, (_, length)| most.max(length));
            lengths().all(|(joint, own)| {
                let [from, to] = [first, joint].map(|joint| self.x(*joint).iter().zip(self.y(*joint)));
                from.zip(to).all(|((ax, ay), (bx, by))| {
                    let (dx, dy) = (bx - ax, by - ay);
                    ((dx * dx + dy * dy).sqrt() - own).abs() <= most
                })
            })
        })
    }

    pub(super) fn set_point(&mut self, joint: JointId, sample: usize, at: Point) {
        self.x[joint.index() * self.len + sample] = at.x;
        self.y[joint.index() * self.len + sample] = at.y;
    }
}

/// The factor of each dyad's height: 1 to the left of its base, -1 to the right, 0 where it is flat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DyadSigns([f64; MAX_DYADS]);

impl DyadSigns {
    /// The signs of an assembly mode in which the dyads in `flat` are flat.
    pub fn new(mode: AssemblyMode, flat: DyadSet) -> DyadSigns {
        let mut signs = [0.0; MAX_DYADS];
        for (dyad, sign) in (0..).map(DyadId::new).zip(&mut signs) {
            *sign = if flat.contains(dyad) { 0.0 } else { f64::from(mode.sign(dyad)) };
        }
        DyadSigns(signs)
    }
}

/// Places the first `joints` joints at the samples of `range`, in the frame of the fixed joints; those of a group are there already.
///
/// `inputs` has one value for each sample of `range`. A dyad whose base is longer or shorter than it can span is placed
/// flat; one whose base has no length is placed at NaN.
pub fn place_leading_joints(
    linkage: &Linkage,
    joints: usize,
    inputs: InputSlices,
    signs: &DyadSigns,
    out: &mut JointPositions,
    range: Range<usize>,
) {
    place_joints(linkage, 0..joints, inputs, signs, out, range);
}

/// Places a range of joints from those before them, as [`place_leading_joints`] does.
///
/// The loops are compiled for several levels of instructions, of which the processor's is taken. No level adds in another order, or
/// multiplies and adds in one step: positions are the same bits on all.
pub(super) fn place_joints(
    linkage: &Linkage,
    joints: Range<usize>,
    inputs: InputSlices,
    signs: &DyadSigns,
    out: &mut JointPositions,
    range: Range<usize>,
) {
    Arch::new().dispatch(Placement { linkage, joints, inputs, signs, out, range });
}

/// The arguments of [`place_joints`].
struct Placement<'a> {
    linkage: &'a Linkage,
    joints: Range<usize>,
    inputs: InputSlices<'a>,
    signs: &'a DyadSigns,
    out: &'a mut JointPositions,
    range: Range<usize>,
}

impl WithSimd for Placement<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Placement { linkage, joints, inputs, signs, out, range } = self;
        let len = out.len;
        for id in joints {
            let joint = &linkage.joints[id];
            let (x_before, x_after) = out.x.split_at_mut(id * len);
            let (y_before, y_after) = out.y.split_at_mut(id * len);
            let (x, y) = (&mut x_after[range.clone()], &mut y_after[range.clone()]);
            let columns =
                |j: JointId| (&x_before[j.index() * len..][range.clone()], &y_before[j.index() * len..][range.clone()]);
            match joint.kind {
                JointKind::Fixed(at) => {
                    x.fill(at.x);
                    y.fill(at.y);
                }
                JointKind::Crank { pivot, length } => {
                    place_crank(columns(pivot), length, (inputs.cos, inputs.sin), x, y)
                }
                JointKind::Gear { pivot, length, ratio, phase_deg } => {
                    let angle = |at: &f64| trig::cos_sin_deg(geared_angle(*at, ratio, phase_deg));
                    let (cos, sin): (Vec<f64>, Vec<f64>) = inputs.values.iter().map(angle).unzip();
                    place_crank(columns(pivot), length, (&cos, &sin), x, y);
                }
                // In a group, joints are placed before all others.
                JointKind::Grouped { .. } => {}
                JointKind::Piston { .. } if linkage.group.is_some() => {}
                JointKind::Piston { base, length, offset, dyad } => {
                    place_piston(
                        (columns(base[0]), columns(base[1])),
                        (inputs.values, length, offset),
                        signs.0[dyad],
                        x,
                        y,
                    );
                }
                JointKind::Rack { line, offset, radius, start } => {
                    let ways: Vec<f64> = inputs.values.iter().map(|at| start + radius * trig::radians(*at)).collect();
                    place_driven_slider((columns(line[0]), columns(line[1])), &ways, offset, x, y);
                }
                JointKind::DrivenSlider { line, offset } => {
                    place_driven_slider((columns(line[0]), columns(line[1])), inputs.values, offset, x, y);
                }
                JointKind::Dyad { base, lengths, dyad } => {
                    place_dyad(columns(base[0]), columns(base[1]), lengths, signs.0[dyad], x, y)
                }
                JointKind::Slide { from, length, line, offset, dyad } => {
                    let line = (columns(line[0]), columns(line[1]));
                    place_slide(columns(from), length, line, offset, signs.0[dyad], x, y);
                }
                JointKind::Slot { base, offset: 0.0, .. } => {
                    let (px, py) = columns(base[0]);
                    x.copy_from_slice(px);
                    y.copy_from_slice(py);
                }
                JointKind::Slot { base, offset, dyad } => {
                    place_slot(columns(base[0]), columns(base[1]), offset, signs.0[dyad], x, y)
                }
                JointKind::Rigid { base, along, across } => {
                    place_rigid(columns(base[0]), columns(base[1]), along, across, x, y)
                }
                JointKind::Parallelogram { corners: [p, q, r] } => {
                    place_parallelogram(columns(p), columns(q), columns(r), x, y)
                }
                JointKind::Yoke { from, line, offset, slot_direction: slot } => {
                    place_yoke(columns(from), (columns(line[0]), columns(line[1])), offset, slot.x / slot.y, x, y);
                }
                JointKind::Aligned { from, line, offset, direction: line_is, along, across } => {
                    let line = (columns(line[0]), columns(line[1]));
                    match line_is {
                        LineDirection::Towards => {
                            place_aligned(columns(from), line, (offset, None), [along, across], x, y)
                        }
                        LineDirection::Actuator => {
                            place_aligned(columns(from), line, (offset, Some(inputs.values)), [along, across], x, y)
                        }
                        LineDirection::BySide(dyad) => {
                            place_aligned(
                                columns(from),
                                line,
                                (offset, None),
                                [along, across].map(|c| c * -signs.0[dyad]),
                                x,
                                y,
                            );
                        }
                    }
                }
            }
        }
    }
}

type PointColumn<'a> = (&'a [f64], &'a [f64]);

// In each kernel the slices are first cut to one length, so that the loop has no bounds checks and vectorises; it is inlined, so that
// it does at each level.

#[inline(always)]
fn place_crank((ox, oy): PointColumn, length: f64, (cos, sin): PointColumn, x: &mut [f64], y: &mut [f64]) {
    let n = x.len();
    let (ox, oy, cos, sin, y) = (&ox[..n], &oy[..n], &cos[..n], &sin[..n], &mut y[..n]);
    for i in 0..n {
        x[i] = ox[i] + length * cos[i];
        y[i] = oy[i] + length * sin[i];
    }
}

/// The RRR dyad: with d the length of the base, the foot of its height is `(d^2 + l0^2 - l1^2) / 2d` along it, and
/// the height `sqrt((l0+l1+d)(l0+l1-d)(d+l0-l1)(d-l0+l1)) / 2d` (Natesan 5.7-5.10, with the root factored: the
/// factors lose no digits where the dyad is nearly flat, and keep a short link's length on a long base).
#[inline(always)]
fn place_dyad(
    (px, py): PointColumn,
    (qx, qy): PointColumn,
    [l0, l1]: [f64; 2],
    sign: f64,
    x: &mut [f64],
    y: &mut [f64],
) {
    let n = x.len();
    let (px, py, qx, qy, y) = (&px[..n], &py[..n], &qx[..n], &qy[..n], &mut y[..n]);
    let (sum, difference) = (l0 + l1, l0 - l1);
    for i in 0..n {
        let (dx, dy) = (qx[i] - px[i], qy[i] - py[i]);
        let d2 = dx * dx + dy * dy;
        let d = d2.sqrt();
        let discriminant = (sum - d) * (sum + d) * ((d - difference) * (d + difference));
        let half = 0.5 / d2;
        let along = (d2 + sum * difference) * half;
        let across = sign * (discriminant.max(0.0).sqrt() * half);
        x[i] = px[i] + along * dx - across * dy;
        y[i] = py[i] + along * dy + across * dx;
    }
}

/// The RRP dyad: with h the distance of the line from the joint that a link of length l starts at, the end of the link
/// is h across and `sqrt((l - h)(l + h))` along the line from that joint.
#[inline(always)]
fn place_slide(
    (ax, ay): PointColumn,
    length: f64,
    ((px, py), (qx, qy)): (PointColumn, PointColumn),
    offset: f64,
    sign: f64,
    x: &mut [f64],
    y: &mut [f64],
) {
    let n = x.len();
    let (ax, ay, px, py, qx, qy, y) = (&ax[..n], &ay[..n], &px[..n], &py[..n], &qx[..n], &qy[..n], &mut y[..n]);
    for i in 0..n {
        let (dx, dy) = (qx[i] - px[i], qy[i] - py[i]);
        let d = (dx * dx + dy * dy).sqrt();
        let (ux, uy) = (dx / d, dy / d);
        let h = offset - (ux * (ay[i] - py[i]) - uy * (ax[i] - px[i]));
        let along = sign * ((length - h) * (length + h)).max(0.0).sqrt();
        x[i] = ax[i] + along * ux - h * uy;
        y[i] = ay[i] + along * uy + h * ux;
    }
}

/// A crank driven by a linear actuator: an RRR dyad whose first link is `b = sqrt(s^2 + e^2)` long (McCarthy 2.40).
#[inline(always)]
fn place_piston(
    ((px, py), (qx, qy)): (PointColumn, PointColumn),
    (s, length, offset): (&[f64], f64, f64),
    sign: f64,
    x: &mut [f64],
    y: &mut [f64],
) {
    for (i, s) in s.iter().enumerate() {
        let b = (s * s + offset * offset).sqrt();
        let one = i..i + 1;
        let base = ((&px[one.clone()], &py[one.clone()]), (&qx[one.clone()], &qy[one.clone()]));
        place_dyad(base.0, base.1, [b, length], sign, &mut x[one.clone()], &mut y[one]);
    }
}

/// A slider at a distance s along a line from its first joint, and to its left.
#[inline(always)]
fn place_driven_slider(
    ((px, py), (qx, qy)): (PointColumn, PointColumn),
    s: &[f64],
    offset: f64,
    x: &mut [f64],
    y: &mut [f64],
) {
    let n = x.len();
    let (px, py, qx, qy, s, y) = (&px[..n], &py[..n], &qx[..n], &qy[..n], &s[..n], &mut y[..n]);
    for i in 0..n {
        let (dx, dy) = (qx[i] - px[i], qy[i] - py[i]);
        let d = (dx * dx + dy * dy).sqrt();
        let (ux, uy) = (dx / d, dy / d);
        x[i] = px[i] + s[i] * ux - offset * uy;
        y[i] = py[i] + s[i] * uy + offset * ux;
    }
}

/// The RPR dyad: pivot, foot and joint are a right triangle with the base for hypotenuse (McCarthy 2.40-2.42).
#[inline(always)]
fn place_slot((px, py): PointColumn, (qx, qy): PointColumn, offset: f64, sign: f64, x: &mut [f64], y: &mut [f64]) {
    let n = x.len();
    let (px, py, qx, qy, y) = (&px[..n], &py[..n], &qx[..n], &qy[..n], &mut y[..n]);
    for i in 0..n {
        let (dx, dy) = (qx[i] - px[i], qy[i] - py[i]);
        let d2 = dx * dx + dy * dy;
        let d = d2.sqrt();
        let along = offset * offset / d2;
        let across = sign * (offset * ((d - offset) * (d + offset)).max(0.0).sqrt() / d2);
        x[i] = px[i] + along * dx - across * dy;
        y[i] = py[i] + along * dy + across * dx;
    }
}

/// The RPP dyad: as far along the guide as the joint in the slot, less what the slot's lean contributes up to there.
#[inline(always)]
fn place_yoke(
    (ax, ay): PointColumn,
    ((px, py), (qx, qy)): (PointColumn, PointColumn),
    offset: f64,
    lean: f64,
    x: &mut [f64],
    y: &mut [f64],
) {
    let n = x.len();
    let (ax, ay, px, py, qx, qy, y) = (&ax[..n], &ay[..n], &px[..n], &py[..n], &qx[..n], &qy[..n], &mut y[..n]);
    for i in 0..n {
        let (dx, dy) = (qx[i] - px[i], qy[i] - py[i]);
        let d = (dx * dx + dy * dy).sqrt();
        let (ux, uy) = (dx / d, dy / d);
        let (vx, vy) = (ax[i] - px[i], ay[i] - py[i]);
        let along = ux * vx + uy * vy - lean * (ux * vy - uy * vx - offset);
        x[i] = px[i] + along * ux - offset * uy;
        y[i] = py[i] + along * uy + offset * ux;
    }
}

/// A point of a body that is aligned with a line. The line passes through q and at the distance `offset` from p: its
/// direction is that from p to q, rotated clockwise by the angle whose sine is offset / d. `known` is the distance of q
/// along the line, if that is known.
#[inline(always)]
fn place_aligned(
    (ax, ay): PointColumn,
    ((px, py), (qx, qy)): (PointColumn, PointColumn),
    (offset, known): (f64, Option<&[f64]>),
    [along, across]: [f64; 2],
    x: &mut [f64],
    y: &mut [f64],
) {
    let n = x.len();
    let (ax, ay, px, py, qx, qy, y) = (&ax[..n], &ay[..n], &px[..n], &py[..n], &qx[..n], &qy[..n], &mut y[..n]);
    for i in 0..n {
        let (dx, dy) = (qx[i] - px[i], qy[i] - py[i]);
        let d2 = dx * dx + dy * dy;
        let d = d2.sqrt();
        let s = known.map_or_else(|| ((d - offset) * (d + offset)).max(0.0).sqrt(), |s| s[i]);
        let (forward, left) = ((along * s + across * offset) / d2, (across * s - along * offset) / d2);
        x[i] = ax[i] + forward * dx - left * dy;
        y[i] = ay[i] + forward * dy + left * dx;
    }
}

#[inline(always)]
fn place_parallelogram(
    (px, py): PointColumn,
    (qx, qy): PointColumn,
    (rx, ry): PointColumn,
    x: &mut [f64],
    y: &mut [f64],
) {
    let n = x.len();
    let (px, py, qx, qy, rx, ry, y) = (&px[..n], &py[..n], &qx[..n], &qy[..n], &rx[..n], &ry[..n], &mut y[..n]);
    for i in 0..n {
        x[i] = px[i] + (rx[i] - qx[i]);
        y[i] = py[i] + (ry[i] - qy[i]);
    }
}

#[inline(always)]
fn place_rigid((px, py): PointColumn, (qx, qy): PointColumn, along: f64, across: f64, x: &mut [f64], y: &mut [f64]) {
    let n = x.len();
    let (px, py, qx, qy, y) = (&px[..n], &py[..n], &qx[..n], &qy[..n], &mut y[..n]);
    for i in 0..n {
        let (dx, dy) = (qx[i] - px[i], qy[i] - py[i]);
        x[i] = px[i] + along * dx - across * dy;
        y[i] = py[i] + along * dy + across * dx;
    }
}

/// Transforms positions into the frame they are reported in: that of the link the linkage is seen from, with its origin
/// at one joint and x towards another, rotated or reflected as the linkage is placed.
pub(super) fn convert_to_view_frame(linkage: &Linkage, out: &mut JointPositions) {
    if let Some([origin, end]) = linkage.seen_from {
        // The link is rigid: division by its known length keeps all other lengths exact as well.
        let ground = linkage.ground();
        let length = match (ground.position(origin), ground.position(end)) {
            (Some(from), Some(to)) => (to - from).norm(),
            _ => return,
        };
        for i in 0..out.len {
            let (o, e) = (out.point(origin, i), out.point(end, i));
            let axis = (e - o) / length;
            for joint in linkage.joint_ids() {
                let v = out.point(joint, i) - o;
                out.set_point(joint, i, Point::new(axis.dot(&v), cross(axis, v)));
            }
        }
    }
    if linkage.placement != Orientation::default() {
        for (x, y) in out.x.iter_mut().zip(&mut out.y) {
            let placed = linkage.placement.transform_point(Point::new(*x, *y));
            (*x, *y) = (placed.x, placed.y);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without its feature for it, `pulp` stays at the lowest level in silence.
    #[test]
    #[cfg(target_arch = "x86_64")]
    fn a_processor_with_avx2_is_dispatched_to_it() {
        let has_avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
        assert_eq!(matches!(Arch::new(), Arch::V3(_)), has_avx2, "{:?}", Arch::new());
    }
}

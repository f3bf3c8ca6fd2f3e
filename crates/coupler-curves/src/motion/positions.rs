use std::ops::Range;

use super::circuit::InputPosition;
use crate::geometry::{Orientation, Point, cross, trig};
use crate::linkage::{AssemblyMode, DyadSet, JointId, JointKind, LineDirection, Linkage, MAX_DYADS};

/// Positions of all joints at all samples, joint by joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointPositions {
    len: usize,
    x: Vec<f64>,
    y: Vec<f64>,
}

impl JointPositions {
    /// Room for `joints` columns of `len` samples.
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

    /// The abscissas of a joint.
    pub fn x(&self, joint: JointId) -> &[f64] {
        &self.x[joint * self.len..][..self.len]
    }

    /// The ordinates of a joint.
    pub fn y(&self, joint: JointId) -> &[f64] {
        &self.y[joint * self.len..][..self.len]
    }

    /// Where a joint is at a sample; not a number where the pose is undefined.
    pub fn point(&self, joint: JointId, sample: usize) -> Point {
        Point::new(self.x(joint)[sample], self.y(joint)[sample])
    }

    pub(super) fn set_point(&mut self, joint: JointId, sample: usize, at: Point) {
        self.x[joint * self.len + sample] = at.x;
        self.y[joint * self.len + sample] = at.y;
    }
}

/// What each dyad's height is multiplied by: 1 to the left of its base, -1 to the right, 0 where it lies flat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DyadSigns([f64; MAX_DYADS]);

impl DyadSigns {
    /// The modes of an assembly, with some of its dyads flat.
    pub fn new(signs: AssemblyMode, flat: DyadSet) -> DyadSigns {
        let mut modes = [0.0; MAX_DYADS];
        for (dyad, mode) in modes.iter_mut().enumerate() {
            *mode = if flat.contains(dyad) { 0.0 } else { f64::from(signs.sign(dyad)) };
        }
        DyadSigns(modes)
    }
}

/// Values of the input, in columns.
#[derive(Clone, Copy, Debug)]
pub struct InputSlices<'a> {
    /// The angles in degrees, or the lengths.
    pub values: &'a [f64],
    /// Their cosines; of lengths, nothing.
    pub cos: &'a [f64],
    /// Their sines; of lengths, nothing.
    pub sin: &'a [f64],
}

/// Values of the input, by columns that are their own.
#[derive(Clone, Debug, Default)]
pub(super) struct InputColumns {
    values: Vec<f64>,
    cos: Vec<f64>,
    sin: Vec<f64>,
}

impl InputColumns {
    pub fn new(stops: &[InputPosition]) -> InputColumns {
        InputColumns {
            values: stops.iter().map(|stop| stop.value).collect(),
            cos: stops.iter().map(|stop| stop.cos).collect(),
            sin: stops.iter().map(|stop| stop.sin).collect(),
        }
    }

    pub fn slice(&self, range: Range<usize>) -> InputSlices<'_> {
        InputSlices { values: &self.values[range.clone()], cos: &self.cos[range.clone()], sin: &self.sin[range] }
    }

    pub fn as_slices(&self) -> InputSlices<'_> {
        self.slice(0..self.values.len())
    }
}

/// Places the first `joints` joints at the samples of `range`, in the frame of the fixed joints.
///
/// `inputs` are those of the samples of `range` alone. A dyad whose base is longer
/// or shorter than it can reach is laid flat; one whose base has no length is not a number.
pub fn place_leading_joints(
    linkage: &Linkage,
    joints: usize,
    inputs: InputSlices,
    modes: &DyadSigns,
    out: &mut JointPositions,
    range: Range<usize>,
) {
    place_joints(linkage, 0..joints, inputs, modes, out, range);
}

/// Places some of the joints from those before them, as [`place_leading_joints`] does.
pub(super) fn place_joints(
    linkage: &Linkage,
    joints: Range<JointId>,
    inputs: InputSlices,
    modes: &DyadSigns,
    out: &mut JointPositions,
    range: Range<usize>,
) {
    let len = out.len;
    for id in joints {
        let joint = &linkage.joints[id];
        let (x_before, x_after) = out.x.split_at_mut(id * len);
        let (y_before, y_after) = out.y.split_at_mut(id * len);
        let (x, y) = (&mut x_after[range.clone()], &mut y_after[range.clone()]);
        let of = |j: JointId| (&x_before[j * len..][range.clone()], &y_before[j * len..][range.clone()]);
        match joint.kind {
            JointKind::Fixed(at) => {
                x.fill(at.x);
                y.fill(at.y);
            }
            JointKind::Crank { pivot, length } => place_crank(of(pivot), length, (inputs.cos, inputs.sin), x, y),
            JointKind::Gear { pivot, length, ratio, phase_deg } => {
                let angle = |at: &f64| trig::cos_sin_deg(geared_angle(*at, ratio, phase_deg));
                let (cos, sin): (Vec<f64>, Vec<f64>) = inputs.values.iter().map(angle).unzip();
                place_crank(of(pivot), length, (&cos, &sin), x, y);
            }
            JointKind::Piston { base, length, offset, index } => {
                place_piston((of(base[0]), of(base[1])), (inputs.values, length, offset), modes.0[index], x, y);
            }
            JointKind::Dyad { base, lengths, index } => {
                place_dyad(of(base[0]), of(base[1]), lengths, modes.0[index], x, y)
            }
            JointKind::Slide { from, length, line, offset, index } => {
                let line = (of(line[0]), of(line[1]));
                place_slide(of(from), length, line, offset, modes.0[index], x, y);
            }
            JointKind::Slot { base, offset: 0.0, .. } => {
                let (px, py) = of(base[0]);
                x.copy_from_slice(px);
                y.copy_from_slice(py);
            }
            JointKind::Slot { base, offset, index } => {
                place_slot(of(base[0]), of(base[1]), offset, modes.0[index], x, y)
            }
            JointKind::Rigid { base, along, across } => place_rigid(of(base[0]), of(base[1]), along, across, x, y),
            JointKind::Parallelogram { corners: [p, q, r] } => place_parallelogram(of(p), of(q), of(r), x, y),
            JointKind::Yoke { from, line, offset, slot_direction: slot } => {
                place_yoke(of(from), (of(line[0]), of(line[1])), offset, slot.x / slot.y, x, y);
            }
            JointKind::Aligned { from, line, offset, direction: line_is, along, across } => {
                let line = (of(line[0]), of(line[1]));
                match line_is {
                    LineDirection::Towards => place_aligned(of(from), line, (offset, None), [along, across], x, y),
                    LineDirection::Actuator => {
                        place_aligned(of(from), line, (offset, Some(inputs.values)), [along, across], x, y)
                    }
                    LineDirection::BySide(index) => {
                        place_aligned(
                            of(from),
                            line,
                            (offset, None),
                            [along, across].map(|c| c * -modes.0[index]),
                            x,
                            y,
                        );
                    }
                }
            }
        }
    }
}

type PointColumn<'a> = (&'a [f64], &'a [f64]);

// In each kernel the slices are first cut to one length, so that the loop has no bounds checks and vectorises.

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
/// factors lose no digits where the dyad is nearly flat, and keep a short link's length beside a long base).
fn place_dyad(
    (px, py): PointColumn,
    (qx, qy): PointColumn,
    [l0, l1]: [f64; 2],
    mode: f64,
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
        let across = mode * (discriminant.max(0.0).sqrt() * half);
        x[i] = px[i] + along * dx - across * dy;
        y[i] = py[i] + along * dy + across * dx;
    }
}

/// The RRP dyad: the end of a link of length l is as far off the line as the line's distance h from the joint it
/// hangs on, and `sqrt((l - h)(l + h))` along it.
fn place_slide(
    (ax, ay): PointColumn,
    length: f64,
    ((px, py), (qx, qy)): (PointColumn, PointColumn),
    offset: f64,
    mode: f64,
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
        let along = mode * ((length - h) * (length + h)).max(0.0).sqrt();
        x[i] = ax[i] + along * ux - h * uy;
        y[i] = ay[i] + along * uy + h * ux;
    }
}

/// The angle in degrees of a crank geared to the input.
pub(super) fn geared_angle(input_deg: f64, [turns, of]: [i64; 2], phase_deg: f64) -> f64 {
    // Whole periods are taken off first: the ratio of what is left is the more exact.
    input_deg % (360.0 * of as f64) * turns as f64 / of as f64 + phase_deg
}

/// A crank driven by a linear actuator: an RRR dyad whose first link is `b = sqrt(s^2 + e^2)` long (McCarthy 2.40).
fn place_piston(
    ((px, py), (qx, qy)): (PointColumn, PointColumn),
    (s, length, offset): (&[f64], f64, f64),
    mode: f64,
    x: &mut [f64],
    y: &mut [f64],
) {
    for (i, s) in s.iter().enumerate() {
        let b = (s * s + offset * offset).sqrt();
        let one = i..i + 1;
        let base = ((&px[one.clone()], &py[one.clone()]), (&qx[one.clone()], &qy[one.clone()]));
        place_dyad(base.0, base.1, [b, length], mode, &mut x[one.clone()], &mut y[one]);
    }
}

/// The RPR dyad: pivot, foot and joint are a right triangle with the base for hypotenuse (McCarthy 2.40-2.42).
fn place_slot((px, py): PointColumn, (qx, qy): PointColumn, offset: f64, mode: f64, x: &mut [f64], y: &mut [f64]) {
    let n = x.len();
    let (px, py, qx, qy, y) = (&px[..n], &py[..n], &qx[..n], &qy[..n], &mut y[..n]);
    for i in 0..n {
        let (dx, dy) = (qx[i] - px[i], qy[i] - py[i]);
        let d2 = dx * dx + dy * dy;
        let d = d2.sqrt();
        let along = offset * offset / d2;
        let across = mode * (offset * ((d - offset) * (d + offset)).max(0.0).sqrt() / d2);
        x[i] = px[i] + along * dx - across * dy;
        y[i] = py[i] + along * dy + across * dx;
    }
}

/// The RPP dyad: as far along the guide as the joint in the slot, less what the slot leans over up to there.
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

/// A point of a body that keeps a line's direction. The line goes through q and beside p: its direction is that from p
/// to q, turned to the right by the angle whose sine is offset / d. How far along it q is may be known.
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

fn place_rigid((px, py): PointColumn, (qx, qy): PointColumn, along: f64, across: f64, x: &mut [f64], y: &mut [f64]) {
    let n = x.len();
    let (px, py, qx, qy, y) = (&px[..n], &py[..n], &qx[..n], &qy[..n], &mut y[..n]);
    for i in 0..n {
        let (dx, dy) = (qx[i] - px[i], qy[i] - py[i]);
        x[i] = px[i] + along * dx - across * dy;
        y[i] = py[i] + along * dy + across * dx;
    }
}

/// Puts the poses into the plane they are reported in: that of the link the linkage is seen from, with its origin at a
/// joint and x towards another, and laid as the linkage is placed.
pub(super) fn convert_to_view_frame(linkage: &Linkage, out: &mut JointPositions) {
    if let Some([origin, end]) = linkage.seen_from {
        // The link is rigid: its length is known, and dividing by it keeps every other length too.
        let ground = linkage.ground();
        let length = match (ground.position(origin), ground.position(end)) {
            (Some(from), Some(to)) => (to - from).norm(),
            _ => return,
        };
        for i in 0..out.len {
            let (o, e) = (out.point(origin, i), out.point(end, i));
            let axis = (e - o) / length;
            for joint in 0..linkage.joints.len() {
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

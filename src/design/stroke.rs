//! The motion of a linkage along its straight portion.

use coupler_curves::geometry::{Point, Vector, cross, trig};
use coupler_curves::linkage::{FourBar, JointId};
use coupler_curves::measure::{StraightPortion, TracedCurve};

/// The poses of a linkage along a straight portion, from its beginning to its end.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stroke {
    /// The pins of the four-bar: crank pivot, crank pin, rocker pin, rocker pivot; and the coupler point.
    pub poses: Vec<[Point; 5]>,
    /// The input of each pose, measured from the first and increasing also where the input turns back.
    inputs: Vec<f64>,
    /// The indices in the circuit of those poses that are samples.
    pub sample_indices: Vec<usize>,
}

/// The link that is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputLink {
    /// The crank, at the frame's origin.
    Crank,
    /// The rocker.
    Rocker,
    /// The coupler, rotated relative to the crank.
    Coupler,
}

impl InputLink {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            InputLink::Crank => "crank",
            InputLink::Rocker => "rocker",
            InputLink::Coupler => "coupler",
        }
    }
}

impl Stroke {
    /// The poses at the samples of a portion, and interpolated at its ends; `None` if the linkage is not a four-bar or
    /// the portion is not on the curve.
    pub fn from_portion(curve: &TracedCurve, portion: &StraightPortion) -> Option<Stroke> {
        let circuit = curve.circuit;
        let [o, a, b, c] = FourBar::pins(curve.linkage)?;
        let joints: [JointId; 5] = [o, a, b, c, curve.joint];
        let n = circuit.len();
        let step = |k: usize| {
            if k + 1 < n {
                return circuit.inputs[k + 1] - circuit.inputs[k];
            }
            let step = (circuit.inputs[0] - circuit.inputs[k]).rem_euclid(360.0);
            if step > 180.0 { step - 360.0 } else { step }
        };
        let pose = |k: usize| joints.map(|joint| circuit.positions.point(joint, k % n));
        let interpolated_pose = |k: usize, fraction: f64| {
            let (from, to) = (pose(k), pose(k + 1));
            std::array::from_fn(|i| from[i] + (to[i] - from[i]) * fraction)
        };
        let start = *portion.points.first()?;
        // The input of the beginning may occur in both directions, and in several turns; the nearest point decides.
        let fraction = |k: usize| {
            let offset = portion.start_input - circuit.inputs[k];
            let offset = offset - 360.0 * (offset / 360.0).round();
            let fraction = offset / step(k);
            (-1e-6..=1.0 + 1e-6).contains(&fraction).then(|| fraction.clamp(0.0, 1.0))
        };
        let distance = |&(k, fraction): &(usize, f64)| {
            let pins: [Point; 5] = interpolated_pose(k, fraction);
            (pins[4] - start).norm()
        };
        let intervals = if circuit.is_closed { n } else { n.saturating_sub(1) };
        let candidates = (0..intervals).filter_map(|k| Some((k, fraction(k)?)));
        let (first, fraction) = candidates.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let mut stroke =
            Stroke { poses: vec![interpolated_pose(first, fraction)], inputs: vec![0.0], sample_indices: Vec::new() };
        let mut travelled = (1.0 - fraction) * step(first).abs();
        let mut k = first + 1;
        while travelled < portion.input_span && k < first + n && (circuit.is_closed || k + 1 < n) {
            stroke.poses.push(pose(k));
            stroke.inputs.push(travelled);
            stroke.sample_indices.push(k % n);
            travelled += step(k % n).abs();
            k += 1;
        }
        let last = step((k - 1) % n).abs();
        let fraction = if last > 0.0 { (1.0 - (travelled - portion.input_span) / last).clamp(0.0, 1.0) } else { 1.0 };
        stroke.poses.push(interpolated_pose(k - 1, fraction));
        stroke.inputs.push(portion.input_span);
        Some(stroke)
    }

    /// The least transmission angle over the stroke, in degrees, if this link is driven; of an angle over 90 the
    /// supplement counts.
    pub fn min_transmission_angle(&self, driven: InputLink) -> f64 {
        let least = |pin: usize, neighbours: [usize; 2]| {
            let angle = |pose: &[Point; 5]| {
                let [u, v] = neighbours.map(|other| pose[other] - pose[pin]);
                let angle = trig::degrees(trig::atan2(cross(u, v).abs(), u.dot(&v)));
                angle.min(180.0 - angle)
            };
            self.poses.iter().map(angle).fold(90.0, f64::min)
        };
        match driven {
            InputLink::Crank => least(2, [1, 3]),
            InputLink::Rocker => least(1, [0, 2]),
            InputLink::Coupler => least(1, [0, 2]).min(least(2, [1, 3])),
        }
    }

    /// The rotation of the driven link from pose to pose, in degrees.
    fn rotation_steps(&self, driven: InputLink) -> Vec<f64> {
        let arm = |pose: &[Point; 5]| match driven {
            InputLink::Crank => pose[1] - pose[0],
            _ => pose[2] - pose[3],
        };
        let angle = |from: Vector, to: Vector| trig::degrees(trig::atan2(cross(from, to), from.dot(&to))).abs();
        match driven {
            // The rotation relative to the crank is the input itself.
            InputLink::Coupler => self.inputs.windows(2).map(|pair| pair[1] - pair[0]).collect(),
            _ => self.poses.windows(2).map(|pair| angle(arm(&pair[0]), arm(&pair[1]))).collect(),
        }
    }

    /// The rotation of the driven link over the stroke, in degrees.
    pub fn swing(&self, driven: InputLink) -> f64 {
        self.rotation_steps(driven).iter().sum()
    }

    /// The ratio of the greatest to the least speed of the coupler point, at constant speed of the driven link. Speeds
    /// are averages between samples; the partial intervals at the ends are ignored. Infinite if the point or the link
    /// stops.
    pub fn speed_ratio(&self, driven: InputLink) -> f64 {
        let turned = self.rotation_steps(driven);
        let speed = |k: usize| (self.poses[k + 1][4] - self.poses[k][4]).norm() / turned[k];
        let inside = if turned.len() > 4 { 1..turned.len() - 1 } else { 0..turned.len() };
        let [least, most] =
            inside.map(speed).fold([f64::INFINITY, 0.0f64], |[least, most], v| [least.min(v), most.max(v)]);
        if most.is_finite() && least > 0.0 { most / least } else { f64::INFINITY }
    }
}

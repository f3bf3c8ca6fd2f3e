//! What a linkage goes through along its straight portion.

use coupler_curves::geometry::{Point, Vector, cross, trig};
use coupler_curves::linkage::{FourBar, JointId};
use coupler_curves::measure::{StraightPortion, TracedCurve};

/// The poses of a straight portion, from its beginning to its end.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stroke {
    /// The pins of the four-bar: crank pivot, crank pin, rocker pin, rocker pivot; and the coupler point.
    pub poses: Vec<[Point; 5]>,
    /// The input at each, there and back on one scale.
    inputs: Vec<f64>,
    /// The samples among them, by their places in the circuit.
    pub sample_indices: Vec<usize>,
}

/// The link that is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputLink {
    /// The crank, at the frame's origin.
    Crank,
    /// The rocker.
    Rocker,
    /// The coupler, turned against the crank.
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
    /// The samples of a portion, and between samples its ends; `None` where the linkage is no four-bar or the portion is
    /// not on the subject's curve.
    pub fn from_portion(subject: &TracedCurve, portion: &StraightPortion) -> Option<Stroke> {
        let circuit = subject.circuit;
        let [o, a, b, c] = FourBar::pins(subject.linkage)?;
        let joints: [JointId; 5] = [o, a, b, c, subject.joint];
        let n = circuit.len();
        let step = |k: usize| {
            if k + 1 < n {
                return circuit.inputs[k + 1] - circuit.inputs[k];
            }
            let over = (circuit.inputs[0] - circuit.inputs[k]).rem_euclid(360.0);
            if over > 180.0 { over - 360.0 } else { over }
        };
        let pose = |k: usize| joints.map(|joint| circuit.positions.point(joint, k % n));
        let between = |k: usize, part: f64| {
            let (from, to) = (pose(k), pose(k + 1));
            std::array::from_fn(|i| from[i] + (to[i] - from[i]) * part)
        };
        let begins = *portion.points.first()?;
        // The input of the beginning may be met there and back, and a few turns on: the place tells which it is.
        let part = |k: usize| {
            let off = portion.start_input - circuit.inputs[k];
            let off = off - 360.0 * (off / 360.0).round();
            let part = off / step(k);
            (-1e-6..=1.0 + 1e-6).contains(&part).then(|| part.clamp(0.0, 1.0))
        };
        let away = |&(k, part): &(usize, f64)| {
            let at: [Point; 5] = between(k, part);
            (at[4] - begins).norm()
        };
        let intervals = if circuit.is_closed { n } else { n.saturating_sub(1) };
        let all = (0..intervals).filter_map(|k| Some((k, part(k)?)));
        let (first, part) = all.min_by(|a, b| away(a).total_cmp(&away(b)))?;
        let mut stroke = Stroke { poses: vec![between(first, part)], inputs: vec![0.0], sample_indices: Vec::new() };
        let mut gone = (1.0 - part) * step(first).abs();
        let mut k = first + 1;
        while gone < portion.input_span && k < first + n && (circuit.is_closed || k + 1 < n) {
            stroke.poses.push(pose(k));
            stroke.inputs.push(gone);
            stroke.sample_indices.push(k % n);
            gone += step(k % n).abs();
            k += 1;
        }
        let last = step((k - 1) % n).abs();
        let part = if last > 0.0 { (1.0 - (gone - portion.input_span) / last).clamp(0.0, 1.0) } else { 1.0 };
        stroke.poses.push(between(k - 1, part));
        stroke.inputs.push(portion.input_span);
        Some(stroke)
    }

    /// The least transmission angle over it, in degrees, where one of the links on the frame is driven; an angle over 90
    /// counts as its supplement.
    pub fn min_transmission_angle(&self, driven: InputLink) -> f64 {
        let least = |pin: usize, beside: [usize; 2]| {
            let angle = |pose: &[Point; 5]| {
                let [u, v] = beside.map(|other| pose[other] - pose[pin]);
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

    /// How far the driven link goes from pose to pose, in degrees.
    fn rotation_steps(&self, driven: InputLink) -> Vec<f64> {
        let arm = |pose: &[Point; 5]| match driven {
            InputLink::Crank => pose[1] - pose[0],
            _ => pose[2] - pose[3],
        };
        let angle = |from: Vector, to: Vector| trig::degrees(trig::atan2(cross(from, to), from.dot(&to))).abs();
        match driven {
            // Turned against the crank, it is the input itself.
            InputLink::Coupler => self.inputs.windows(2).map(|pair| pair[1] - pair[0]).collect(),
            _ => self.poses.windows(2).map(|pair| angle(arm(&pair[0]), arm(&pair[1]))).collect(),
        }
    }

    /// How far the driven link goes, in degrees.
    pub fn swing(&self, driven: InputLink) -> f64 {
        self.rotation_steps(driven).iter().sum()
    }

    /// The coupler point's greatest speed over its least while the driven link turns evenly, from sample to sample; the
    /// cut intervals at the ends are left out. Unbounded where it, or the driven link, stands still.
    pub fn speed_ratio(&self, driven: InputLink) -> f64 {
        let turned = self.rotation_steps(driven);
        let speed = |k: usize| (self.poses[k + 1][4] - self.poses[k][4]).norm() / turned[k];
        let inside = if turned.len() > 4 { 1..turned.len() - 1 } else { 0..turned.len() };
        let [least, most] =
            inside.map(speed).fold([f64::INFINITY, 0.0f64], |[least, most], v| [least.min(v), most.max(v)]);
        if most.is_finite() && least > 0.0 { most / least } else { f64::INFINITY }
    }
}

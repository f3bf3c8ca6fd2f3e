//! A curve as a list of samples, with its arc lengths, area and curvatures.

use std::cell::OnceCell;

use super::local_polynomial::LocalPolynomial;
use crate::geometry::{Point, Vector, cross, distance_to_segment, trig};
use crate::linkage::{Input, JointId};
use crate::motion::Circuit;

/// A curve as a list of samples.
///
/// Between two samples the curve is approximated by an arc whose curvature is the mean of those at both; a circle is
/// measured exactly, and any smooth curve with an error of the fourth order in the distance between samples. That is
/// true across limits too, where the curve is smooth though the input reverses.
#[derive(Clone, Debug)]
pub(super) struct SampledCurve {
    /// The positions of the samples whose position is defined.
    pub points: Vec<Point>,
    /// The index of each sample in its circuit.
    pub sample_indices: Vec<usize>,
    /// The input at each sample.
    pub inputs: Vec<f64>,
    /// Whether the last sample is followed by the first.
    pub is_closed: bool,
    /// The change of the input over one round of a closed curve: whole turns, or zero.
    pub net_input: f64,
    /// The total travel of the input, forward and backward, up to each sample and then to the first again.
    pub input_travel: Vec<f64>,
    /// The distance of each sample from the next; 0 for the last of an open curve.
    pub chords: Vec<f64>,
    /// The signed curvature at each sample, that of the circle through it and its neighbours.
    pub curvatures: Vec<f64>,
    arcs: OnceCell<Vec<Arc>>,
    /// The samples at which the path may have a corner.
    corners: Vec<usize>,
    /// Whether the path turns sharply at each sample.
    pub is_sharp: Vec<bool>,
    /// The polynomial around each sample, computed on first use.
    pub local_polynomials: Vec<OnceCell<LocalPolynomial>>,
}

/// An arc of a circle over a chord.
#[derive(Clone, Copy, Debug)]
struct Arc {
    length: f64,
    /// The area between it and its chord; positive if it curves to the left.
    area: f64,
}

impl Arc {
    /// The arc over a chord with a curvature.
    fn over_chord(chord: f64, curvature: f64) -> Arc {
        // The sine of half the arc's angle. If the samples are too far apart for the curvature, at a cusp, the chord is
        // used.
        let sine = curvature * chord / 2.0;
        if sine.abs() > 0.5 || chord == 0.0 {
            return Arc { length: chord, area: 0.0 };
        }
        let square = sine * sine;
        if square < 1e-4 {
            // The formulas below as series in the sine, accurate to 1e-16 in this range.
            let length = chord * (1.0 + square / 6.0 * (1.0 + square * 9.0 / 20.0 * (1.0 + square * 25.0 / 42.0)));
            let area = chord * chord * sine / 6.0 * (1.0 + square * 3.0 / 10.0 * (1.0 + square * 25.0 / 28.0));
            return Arc { length, area };
        }
        let angle = 2.0 * trig::asin(sine);
        Arc { length: angle / curvature, area: (angle - trig::sin(angle)) / (2.0 * curvature * curvature) }
    }
}

impl SampledCurve {
    /// The curve of a joint on a circuit.
    pub fn from_circuit(circuit: &Circuit, joint: JointId, input: Input) -> SampledCurve {
        let is_defined = |(p, _): &(Point, usize)| p.x.is_finite() && p.y.is_finite();
        let (points, samples): (Vec<Point>, Vec<usize>) = circuit.points(joint).zip(0..).filter(is_defined).unzip();
        let inputs: Vec<f64> = samples.iter().map(|&sample| circuit.inputs[sample]).collect();
        let period = if input == Input::Length { f64::INFINITY } else { 360.0 };
        let corners = (0..samples.len()).filter(|&k| circuit.is_corner(samples[k])).collect();
        SampledCurve { corners, ..SampledCurve::new((points, samples), inputs, circuit.is_closed.then_some(period)) }
    }

    /// The curve through points with sample indices and inputs. It is closed if `period`, the period of its input, is
    /// given.
    fn new((points, samples): (Vec<Point>, Vec<usize>), inputs: Vec<f64>, period: Option<f64>) -> SampledCurve {
        let net_input = match (period, &inputs[..]) {
            // The last step is less than half a turn.
            (Some(period), [first, .., last]) if period.is_finite() => ((last - first) / period).round() * period,
            _ => 0.0,
        };
        let mut travel = vec![0.0];
        let next = inputs.iter().skip(1).copied().chain(period.and(inputs.first()).map(|first| first + net_input));
        for (from, to) in inputs.iter().zip(next) {
            travel.push(travel[travel.len() - 1] + (to - from).abs());
        }
        // An open curve ends at its last sample.
        travel.resize(inputs.len() + 1, travel[travel.len() - 1]);
        let mut curve = SampledCurve {
            points,
            sample_indices: samples,
            inputs,
            is_closed: period.is_some(),
            net_input,
            input_travel: travel,
            chords: Vec::new(),
            curvatures: Vec::new(),
            corners: Vec::new(),
            arcs: OnceCell::new(),
            is_sharp: Vec::new(),
            local_polynomials: Vec::new(),
        };
        curve.local_polynomials = vec![OnceCell::new(); curve.points.len()];
        curve.chords = (0..curve.points.len()).map(|i| curve.chord(i)).collect();
        curve.curvatures = (0..curve.points.len()).map(|i| curve.curvature(i)).collect();
        curve.is_sharp = (0..curve.points.len()).map(|i| curve.turns_beyond(i, 0.5)).collect();
        curve
    }

    /// The number of intervals between samples.
    pub fn interval_count(&self) -> usize {
        match self.points.len() {
            0 | 1 => 0,
            n if self.is_closed => n,
            n => n - 1,
        }
    }

    /// The index of the sample at an offset from another; cyclic on a closed curve.
    pub fn neighbour(&self, i: usize, offset: isize) -> Option<usize> {
        let n = self.points.len() as isize;
        let k = i as isize + offset;
        if self.is_closed { Some(k.rem_euclid(n) as usize) } else { (0..n).contains(&k).then_some(k as usize) }
    }

    /// The sample with the greatest curvature, excluding those within two samples of a corner.
    pub fn sharpest_sample(&self) -> Option<usize> {
        let is_by_corner =
            |i: usize| (-2..=2).any(|offset| self.neighbour(i, offset).is_some_and(|k| self.corners.contains(&k)));
        let candidates = (0..self.points.len()).filter(|&i| self.corners.is_empty() || !is_by_corner(i));
        candidates.max_by(|&a, &b| self.curvatures[a].abs().total_cmp(&self.curvatures[b].abs()))
    }

    /// Whether the path turns by more than 60 degrees at a sample, as at a cusp.
    pub fn turns_sharply(&self, i: usize) -> bool {
        self.is_sharp[i]
    }

    /// Whether the path reverses at a sample.
    pub fn doubles_back(&self, i: usize) -> bool {
        self.turns_beyond(i, -0.9)
    }

    /// Whether the path turns at a sample by more than the angle with the given cosine.
    fn turns_beyond(&self, i: usize, cosine: f64) -> bool {
        let (Some(a), Some(b)) = (self.neighbour(i, -1), self.neighbour(i, 1)) else { return false };
        let (before, after) = (self.points[i] - self.points[a], self.points[b] - self.points[i]);
        before.dot(&after) < cosine * before.norm() * after.norm()
    }

    /// The number of sign changes of the curvature. Samples are ignored where the path turns sharply, or where it is so
    /// straight, to a part in ten million or to the rounding of the points, that the sign is not known.
    pub fn inflection_count(&self) -> usize {
        let size = self.points.iter().fold(0.0, |size: f64, p| size.max((p - self.points[0]).norm()));
        let has_known_sign = |&i: &usize| {
            let curvature = self.curvatures[i].abs();
            curvature * size > 1e-7
                && curvature * self.chords[i] * self.previous_chord(i) > 1e-12 * size
                && !self.turns_sharply(i)
        };
        let are_left: Vec<bool> =
            (0..self.points.len()).filter(has_known_sign).map(|i| self.curvatures[i] > 0.0).collect();
        let changes = are_left.windows(2).filter(|pair| pair[0] != pair[1]).count();
        changes + usize::from(self.is_closed && are_left.first() != are_left.last())
    }

    fn chord(&self, i: usize) -> f64 {
        self.neighbour(i, 1).map_or(0.0, |next| (self.points[next] - self.points[i]).norm())
    }

    fn previous_chord(&self, i: usize) -> f64 {
        self.neighbour(i, -1).map_or(0.0, |k| self.chords[k])
    }

    fn curvature(&self, i: usize) -> f64 {
        // At the end of an open curve the circle is that through its last three samples.
        let (before, after) = match (self.neighbour(i, -1), self.neighbour(i, 1)) {
            (Some(a), Some(b)) => (a, b),
            (None, Some(b)) => (b, self.neighbour(i, 2).unwrap_or(b)),
            (Some(a), None) => (self.neighbour(i, -2).unwrap_or(a), a),
            (None, None) => return 0.0,
        };
        let mut three = [before, i, after];
        three.sort_unstable();
        let [a, b, c] = if self.is_closed { [before, i, after] } else { three }.map(|k| self.points[k]);
        let curvature = 2.0 * cross(b - a, c - b) / ((b - a).norm() * (c - b).norm() * (c - a).norm());
        if curvature.is_finite() { curvature } else { 0.0 }
    }

    /// The arc from each sample to the next.
    fn arcs(&self) -> &[Arc] {
        self.arcs.get_or_init(|| (0..self.interval_count()).map(|i| self.arc(i)).collect())
    }

    fn arc(&self, i: usize) -> Arc {
        let next = self.neighbour(i, 1).unwrap_or(i);
        Arc::over_chord(self.chords[i], (self.curvatures[i] + self.curvatures[next]) / 2.0)
    }

    /// The length of the path from each sample to the next.
    pub fn arc_lengths(&self) -> Vec<f64> {
        self.arcs().iter().map(|arc| arc.length).collect()
    }

    /// The length of the path from the first sample to a point on it at which the input has travelled by `travelled`;
    /// `lengths` are those up to each sample.
    pub fn length_at(&self, point: Point, travelled: f64, lengths: &[f64]) -> f64 {
        let i = self.input_travel[..self.points.len()].partition_point(|&travel| travel <= travelled).max(1) - 1;
        let next = self.neighbour(i, 1).unwrap_or(i);
        lengths[i]
            + Arc::over_chord((point - self.points[i]).norm(), (self.curvatures[i] + self.curvatures[next]) / 2.0)
                .length
    }

    /// The area it encloses, positive counter-clockwise; `None` for an open curve.
    pub fn area(&self) -> Option<f64> {
        let first = *self.points.first().filter(|_| self.is_closed)?;
        let part = |i: usize| {
            let (a, b) = (self.points[i] - first, self.points[self.neighbour(i, 1).unwrap_or(i)] - first);
            cross(a, b) / 2.0 + self.arcs()[i].area
        };
        Some((0..self.interval_count()).map(part).sum())
    }

    /// The sample that is furthest in a direction.
    pub fn furthest_sample(&self, direction: Vector) -> Option<usize> {
        let height = |i: usize| direction.dot(&self.points[i].coords);
        (0..self.points.len()).max_by(|&a, &b| height(a).total_cmp(&height(b)))
    }

    /// The greatest distance of the curve from the chords between its samples, except at cusps.
    pub fn max_sagitta(&self) -> f64 {
        let height = |i: usize| {
            let chord = self.chords[i];
            (chord * chord * self.curvatures[i].abs() / 8.0).min(chord / 2.0)
        };
        (0..self.points.len()).map(height).fold(0.0, f64::max)
    }

    /// The length that each sample represents: half the distance to either neighbour.
    pub fn sample_weights(&self) -> Vec<f64> {
        (0..self.points.len()).map(|i| (self.previous_chord(i) + self.chords[i]) / 2.0).collect()
    }

    /// The distance of a point from the chords at a sample.
    pub fn distance_to_chords(&self, point: Point, i: usize) -> f64 {
        let distance_to = |offset| {
            let next = self.neighbour(i, offset).unwrap_or(i);
            distance_to_segment(point, self.points[i], self.points[next])
        };
        distance_to(-1).min(distance_to(1))
    }
}

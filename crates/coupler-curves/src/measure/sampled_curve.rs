use std::cell::OnceCell;

use super::interpolation::LocalPolynomial;
use crate::geometry::{Point, Vector, cross, distance_to_segment, trig};
use crate::linkage::Input;
use crate::motion::Circuit;

/// A curve as the row of its samples, and what is known of it between them.
///
/// Between two samples the curve is taken for an arc of the circle that bends as the curve does at both; a circle itself
/// is measured exactly, and any smooth curve to the fourth order of the distance of its samples. That holds over limits
/// too, where the curve goes on smoothly though the input turns.
#[derive(Clone, Debug)]
pub(super) struct SampledCurve {
    /// The samples that have a place.
    pub points: Vec<Point>,
    /// The number of each in its circuit.
    pub sample_indices: Vec<usize>,
    /// The input at each.
    pub inputs: Vec<f64>,
    /// Whether the last is followed by the first.
    pub is_closed: bool,
    /// How much the input has changed after once round a closed curve: whole turns, or nothing.
    pub net_input: f64,
    /// How far the input has gone, there and back, up to each sample and then to the first again.
    pub input_travel: Vec<f64>,
    /// How far each sample is from the next, where there is one.
    pub chords: Vec<f64>,
    /// The signed curvature at each sample, of the circle through it and its neighbours.
    pub curvatures: Vec<f64>,
    arcs: OnceCell<Vec<Arc>>,
    /// At which of them the path may have a corner.
    corners: Vec<usize>,
    /// Whether the path turns sharply about each sample.
    pub is_sharp: Vec<bool>,
    /// What is known of the curve about each sample, once it is asked for.
    pub local_polynomials: Vec<OnceCell<LocalPolynomial>>,
}

/// An arc of a circle over a chord.
#[derive(Clone, Copy, Debug)]
struct Arc {
    length: f64,
    /// Between it and its chord; positive where it bends to the left.
    area: f64,
}

impl Arc {
    /// Over a chord, of some curvature.
    fn over_chord(chord: f64, bend: f64) -> Arc {
        // The sine of half the arc's angle. Where the samples are too far apart for their bend, at a cusp, the chord does.
        let sine = bend * chord / 2.0;
        if sine.abs() > 0.5 || chord == 0.0 {
            return Arc { length: chord, area: 0.0 };
        }
        let square = sine * sine;
        if square < 1e-4 {
            // asin(x)/x and (d - sin d)/(2 k^2) by their series, good to 1e-16 below this.
            let length = chord * (1.0 + square / 6.0 * (1.0 + square * 9.0 / 20.0 * (1.0 + square * 25.0 / 42.0)));
            let area = chord * chord * sine / 6.0 * (1.0 + square * 3.0 / 10.0 * (1.0 + square * 25.0 / 28.0));
            return Arc { length, area };
        }
        let angle = 2.0 * trig::asin(sine);
        Arc { length: angle / bend, area: (angle - trig::sin(angle)) / (2.0 * bend * bend) }
    }
}

impl SampledCurve {
    pub fn from_circuit(circuit: &Circuit, joint: usize, input: Input) -> SampledCurve {
        let kept = |(p, _): &(Point, usize)| p.x.is_finite() && p.y.is_finite();
        let (points, samples): (Vec<Point>, Vec<usize>) = circuit.points(joint).zip(0..).filter(kept).unzip();
        let inputs: Vec<f64> = samples.iter().map(|&sample| circuit.inputs[sample]).collect();
        let round = if input == Input::Length { f64::INFINITY } else { 360.0 };
        let corners = (0..samples.len()).filter(|&k| circuit.is_corner(samples[k])).collect();
        SampledCurve { corners, ..SampledCurve::new((points, samples), inputs, circuit.is_closed.then_some(round)) }
    }

    /// A curve; a closed one is driven by an input of some period.
    fn new((points, samples): (Vec<Point>, Vec<usize>), inputs: Vec<f64>, period: Option<f64>) -> SampledCurve {
        let turn = match (period, &inputs[..]) {
            // The last step is less than half a turn.
            (Some(period), [first, .., last]) if period.is_finite() => ((last - first) / period).round() * period,
            _ => 0.0,
        };
        let mut travel = vec![0.0];
        let next = inputs.iter().skip(1).copied().chain(period.and(inputs.first()).map(|first| first + turn));
        for (from, to) in inputs.iter().zip(next) {
            travel.push(travel[travel.len() - 1] + (to - from).abs());
        }
        // An open curve goes no further than its last sample.
        travel.resize(inputs.len() + 1, travel[travel.len() - 1]);
        let mut trail = SampledCurve {
            points,
            sample_indices: samples,
            inputs,
            is_closed: period.is_some(),
            net_input: turn,
            input_travel: travel,
            chords: Vec::new(),
            curvatures: Vec::new(),
            corners: Vec::new(),
            arcs: OnceCell::new(),
            is_sharp: Vec::new(),
            local_polynomials: Vec::new(),
        };
        trail.local_polynomials = vec![OnceCell::new(); trail.points.len()];
        trail.chords = (0..trail.points.len()).map(|i| trail.chord(i)).collect();
        trail.curvatures = (0..trail.points.len()).map(|i| trail.curvature(i)).collect();
        trail.is_sharp = (0..trail.points.len()).map(|i| trail.turns_beyond(i, 0.5)).collect();
        trail
    }

    /// How many intervals there are between samples.
    pub fn interval_count(&self) -> usize {
        match self.points.len() {
            0 | 1 => 0,
            n if self.is_closed => n,
            n => n - 1,
        }
    }

    /// The sample that many after another; round a closed curve.
    pub fn neighbour(&self, i: usize, off: isize) -> Option<usize> {
        let n = self.points.len() as isize;
        let k = i as isize + off;
        if self.is_closed { Some(k.rem_euclid(n) as usize) } else { (0..n).contains(&k).then_some(k as usize) }
    }

    /// The sample at which it bends most, but for corners: what two samples on either side tell of the bend.
    pub fn sharpest_sample(&self) -> Option<usize> {
        let is_by_corner =
            |i: usize| (-2..=2).any(|off| self.neighbour(i, off).is_some_and(|k| self.corners.contains(&k)));
        let bent = (0..self.points.len()).filter(|&i| self.corners.is_empty() || !is_by_corner(i));
        bent.max_by(|&a, &b| self.curvatures[a].abs().total_cmp(&self.curvatures[b].abs()))
    }

    /// Whether the path turns through more than a right angle about a sample, as at a cusp.
    pub fn turns_sharply(&self, i: usize) -> bool {
        self.is_sharp[i]
    }

    /// Whether the path goes back about a sample the way it came.
    pub fn doubles_back(&self, i: usize) -> bool {
        self.turns_beyond(i, -0.9)
    }

    /// Whether the path turns about a sample through more than the angle of some cosine.
    fn turns_beyond(&self, i: usize, cosine: f64) -> bool {
        let (Some(a), Some(b)) = (self.neighbour(i, -1), self.neighbour(i, 1)) else { return false };
        let (before, after) = (self.points[i] - self.points[a], self.points[b] - self.points[i]);
        before.dot(&after) < cosine * before.norm() * after.norm()
    }

    /// How often it begins to bend the other way. Where it is straight to a part in ten million, or to what places are
    /// rounded to, or turns sharply, its samples do not tell which way it bends.
    pub fn inflection_count(&self) -> usize {
        let size = self.points.iter().fold(0.0, |size: f64, p| size.max((p - self.points[0]).norm()));
        let tells = |&i: &usize| {
            let bend = self.curvatures[i].abs();
            bend * size > 1e-7
                && bend * self.chords[i] * self.previous_chord(i) > 1e-12 * size
                && !self.turns_sharply(i)
        };
        let bends: Vec<bool> = (0..self.points.len()).filter(tells).map(|i| self.curvatures[i] > 0.0).collect();
        let changes = bends.windows(2).filter(|pair| pair[0] != pair[1]).count();
        changes + usize::from(self.is_closed && bends.first() != bends.last())
    }

    fn chord(&self, i: usize) -> f64 {
        self.neighbour(i, 1).map_or(0.0, |next| (self.points[next] - self.points[i]).norm())
    }

    fn previous_chord(&self, i: usize) -> f64 {
        self.neighbour(i, -1).map_or(0.0, |k| self.chords[k])
    }

    fn curvature(&self, i: usize) -> f64 {
        // At an open end the circle is that through the end and the next two.
        let (before, after) = match (self.neighbour(i, -1), self.neighbour(i, 1)) {
            (Some(a), Some(b)) => (a, b),
            (None, Some(b)) => (b, self.neighbour(i, 2).unwrap_or(b)),
            (Some(a), None) => (self.neighbour(i, -2).unwrap_or(a), a),
            (None, None) => return 0.0,
        };
        let mut three = [before, i, after];
        three.sort_unstable();
        let [a, b, c] = if self.is_closed { [before, i, after] } else { three }.map(|k| self.points[k]);
        let bend = 2.0 * cross(b - a, c - b) / ((b - a).norm() * (c - b).norm() * (c - a).norm());
        if bend.is_finite() { bend } else { 0.0 }
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

    /// The length of the path from the first sample to a point on it, which the input reaches after going some way there
    /// and back; `lengths` are those up to each sample.
    pub fn length_at(&self, point: Point, travelled: f64, lengths: &[f64]) -> f64 {
        let i = self.input_travel[..self.points.len()].partition_point(|&travel| travel <= travelled).max(1) - 1;
        let next = self.neighbour(i, 1).unwrap_or(i);
        lengths[i]
            + Arc::over_chord((point - self.points[i]).norm(), (self.curvatures[i] + self.curvatures[next]) / 2.0)
                .length
    }

    /// The area it goes round, positive counter-clockwise; none of an open curve.
    pub fn area(&self) -> Option<f64> {
        let first = *self.points.first().filter(|_| self.is_closed)?;
        let part = |i: usize| {
            let (a, b) = (self.points[i] - first, self.points[self.neighbour(i, 1).unwrap_or(i)] - first);
            cross(a, b) / 2.0 + self.arcs()[i].area
        };
        Some((0..self.interval_count()).map(part).sum())
    }

    /// The point that is furthest in a direction.
    pub fn furthest_sample(&self, direction: Vector) -> Option<usize> {
        let height = |i: usize| direction.dot(&self.points[i].coords);
        (0..self.points.len()).max_by(|&a, &b| height(a).total_cmp(&height(b)))
    }

    /// How far the curve is from the lines between its samples at most, but for cusps.
    pub fn max_sagitta(&self) -> f64 {
        let height = |i: usize| {
            let chord = self.chords[i];
            (chord * chord * self.curvatures[i].abs() / 8.0).min(chord / 2.0)
        };
        (0..self.points.len()).map(height).fold(0.0, f64::max)
    }

    /// How much of the length each sample stands for: half the way to either neighbour.
    pub fn sample_weights(&self) -> Vec<f64> {
        (0..self.points.len()).map(|i| (self.previous_chord(i) + self.chords[i]) / 2.0).collect()
    }

    /// How far a point is from the lines to the neighbours of a sample.
    pub fn distance_to_chords(&self, point: Point, i: usize) -> f64 {
        let to = |way| {
            let next = self.neighbour(i, way).unwrap_or(i);
            distance_to_segment(point, self.points[i], self.points[next])
        };
        to(-1).min(to(1))
    }
}

use std::cell::OnceCell;

use crate::geometry::{Point, Vector, cross, distance_to_segment, times, trig};
use crate::linkage::Input;
use crate::motion::Circuit;

/// A curve as the row of its samples, and what is known of it between them.
///
/// Between two samples the curve is taken for an arc of the circle that bends as the curve does at both; a circle itself
/// is measured exactly, and any smooth curve to the fourth order of the distance of its samples. That holds over limits
/// too, where the curve goes on smoothly though the input turns.
#[derive(Clone, Debug)]
pub(super) struct Trail {
    /// The samples that have a place.
    pub points: Vec<Point>,
    /// The number of each in its circuit.
    pub samples: Vec<usize>,
    /// The input at each.
    pub inputs: Vec<f64>,
    /// Whether the last is followed by the first.
    pub closed: bool,
    /// How much the input has changed after once round a closed curve: whole turns, or nothing.
    pub turn: f64,
    /// How far the input has gone, there and back, up to each sample and then to the first again.
    travel: Vec<f64>,
    /// The signed curvature at each sample, of the circle through it and its neighbours.
    bends: Vec<f64>,
    arcs: OnceCell<Vec<Arc>>,
    /// Whether the path turns sharply about each sample.
    sharp: Vec<bool>,
}

/// An arc of a circle over a chord.
#[derive(Clone, Copy, Debug)]
struct Arc {
    length: f64,
    /// Between it and its chord; positive where it bends to the left.
    area: f64,
}

impl Trail {
    pub fn of(circuit: &Circuit, joint: usize, input: Input) -> Trail {
        let kept = |(p, _): &(Point, usize)| p.x.is_finite() && p.y.is_finite();
        let (points, samples): (Vec<Point>, Vec<usize>) = circuit.points(joint).zip(0..).filter(kept).unzip();
        let inputs: Vec<f64> = samples.iter().map(|&sample| circuit.input[sample]).collect();
        let round = if input == Input::Length { f64::INFINITY } else { 360.0 };
        Trail::new((points, samples), inputs, circuit.closed.then_some(round))
    }

    /// A curve; a closed one is driven by an input of some period.
    fn new((points, samples): (Vec<Point>, Vec<usize>), inputs: Vec<f64>, period: Option<f64>) -> Trail {
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
        let mut trail = Trail {
            points,
            samples,
            inputs,
            closed: period.is_some(),
            turn,
            travel,
            bends: Vec::new(),
            arcs: OnceCell::new(),
            sharp: Vec::new(),
        };
        trail.bends = (0..trail.points.len()).map(|i| trail.bend(i)).collect();
        trail.sharp = (0..trail.points.len()).map(|i| trail.turns_about(i)).collect();
        trail
    }

    /// How many intervals there are between samples.
    pub fn intervals(&self) -> usize {
        match self.points.len() {
            0 | 1 => 0,
            n if self.closed => n,
            n => n - 1,
        }
    }

    /// The sample that many after another; round a closed curve.
    pub fn at(&self, i: usize, off: isize) -> Option<usize> {
        let n = self.points.len() as isize;
        let k = i as isize + off;
        if self.closed { Some(k.rem_euclid(n) as usize) } else { (0..n).contains(&k).then_some(k as usize) }
    }

    /// The sample at which it bends most.
    pub fn sharpest(&self) -> Option<usize> {
        (0..self.points.len()).max_by(|&a, &b| self.bends[a].abs().total_cmp(&self.bends[b].abs()))
    }

    /// Whether the path turns through more than a right angle about a sample, as at a cusp.
    pub fn turns_sharply(&self, i: usize) -> bool {
        self.sharp[i]
    }

    fn turns_about(&self, i: usize) -> bool {
        let (Some(a), Some(b)) = (self.at(i, -1), self.at(i, 1)) else { return false };
        let (before, after) = (self.points[i] - self.points[a], self.points[b] - self.points[i]);
        before.dot(&after) < 0.5 * before.norm() * after.norm()
    }

    /// How often it begins to bend the other way. Where it is straight to a part in ten million, or turns sharply, its
    /// samples do not tell which way it bends.
    pub fn inflections(&self) -> usize {
        let size = self.points.iter().fold(0.0, |size: f64, p| size.max((p - self.points[0]).norm()));
        let tells = |i: &usize| self.bends[*i].abs() * size > 1e-7 && !self.turns_sharply(*i);
        let bends: Vec<bool> = (0..self.points.len()).filter(tells).map(|i| self.bends[i] > 0.0).collect();
        let changes = bends.windows(2).filter(|pair| pair[0] != pair[1]).count();
        changes + usize::from(self.closed && bends.first() != bends.last())
    }

    fn bend(&self, i: usize) -> f64 {
        // At an open end the circle is that through the end and the next two.
        let (before, after) = match (self.at(i, -1), self.at(i, 1)) {
            (Some(a), Some(b)) => (a, b),
            (None, Some(b)) => (b, self.at(i, 2).unwrap_or(b)),
            (Some(a), None) => (self.at(i, -2).unwrap_or(a), a),
            (None, None) => return 0.0,
        };
        let mut three = [before, i, after];
        three.sort_unstable();
        let [a, b, c] = if self.closed { [before, i, after] } else { three }.map(|k| self.points[k]);
        let bend = 2.0 * cross(b - a, c - b) / ((b - a).norm() * (c - b).norm() * (c - a).norm());
        if bend.is_finite() { bend } else { 0.0 }
    }

    /// The arc from each sample to the next.
    fn arcs(&self) -> &[Arc] {
        self.arcs.get_or_init(|| (0..self.intervals()).map(|i| self.arc(i)).collect())
    }

    fn arc(&self, i: usize) -> Arc {
        let next = self.at(i, 1).unwrap_or(i);
        let chord = (self.points[next] - self.points[i]).norm();
        let bend = (self.bends[i] + self.bends[next]) / 2.0;
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

    /// The length of the path from each sample to the next.
    pub fn lengths(&self) -> Vec<f64> {
        self.arcs().iter().map(|arc| arc.length).collect()
    }

    /// The area it goes round, positive counter-clockwise; none of an open curve.
    pub fn area(&self) -> Option<f64> {
        let first = *self.points.first().filter(|_| self.closed)?;
        let part = |i: usize| {
            let (a, b) = (self.points[i] - first, self.points[self.at(i, 1).unwrap_or(i)] - first);
            cross(a, b) / 2.0 + self.arcs()[i].area
        };
        Some((0..self.intervals()).map(part).sum())
    }

    /// The point that is furthest in a direction.
    pub fn top(&self, direction: Vector) -> Option<usize> {
        let height = |i: usize| direction.dot(&self.points[i].coords);
        (0..self.points.len()).max_by(|&a, &b| height(a).total_cmp(&height(b)))
    }

    /// The greatest extent in a direction, about the point that is furthest.
    pub fn reach(&self, direction: Vector, top: usize) -> f64 {
        let height = |i: usize| direction.dot(&self.points[i].coords);
        let Some(near) = self.near(top) else { return height(top) };
        let rise = near.most(|near, u| direction.dot(&near.at(u)[0]));
        // A curve does not rise above its furthest sample by more than a part of the way to the next.
        if rise > 0.0 && rise < 0.5 * (near.ends[1] - near.ends[0]) { height(top) + rise } else { height(top) }
    }

    /// The greatest curvature about a sample.
    pub fn curvature_near(&self, i: usize) -> f64 {
        let curvature = |near: &Near, u: f64| {
            let [_, v, a] = near.at(u);
            (cross(v, a) / (v.norm_squared() * v.norm())).abs()
        };
        self.near(i).map_or(self.bends[i].abs(), |near| near.most(curvature))
    }

    /// The point a part of the way along, in samples from the first, and the input there; round a closed curve, on which a
    /// place may be a little less than nothing.
    pub fn place(&self, place: f64) -> (Point, f64) {
        let n = self.points.len();
        if place < 0.0 {
            let (point, input) = self.place(place + n as f64);
            return (point, input - self.turn);
        }
        let (whole, part) = (place.floor(), place.fract());
        let (i, rounds) = (whole as usize % n, (whole as usize / n) as f64 * self.turn);
        if part == 0.0 {
            return (self.points[i], self.inputs[i] + rounds);
        }
        let next = self.at(i, 1).unwrap_or(i);
        let step = self.points[next] - self.points[i];
        let input = self.inputs[next] + if next < i { self.turn } else { 0.0 };
        // An arc over the chord, as flat as the curve is at the flatter end; of a turning back the other end tells.
        let bend = match [self.sharp[i], self.sharp[next]] {
            [true, _] => self.bends[next],
            [_, true] => self.bends[i],
            _ if self.bends[i].abs() < self.bends[next].abs() => self.bends[i],
            _ => self.bends[next],
        };
        let height = (bend * step.norm() * part * (1.0 - part) / 2.0).clamp(-0.2, 0.2);
        let over_chord = self.points[i] + step * part + Vector::new(step.y, -step.x) * height;
        let straight = (over_chord, self.inputs[i] + (input - self.inputs[i]) * part);
        // Where the path turns back its samples on the other side do not tell of it; and where they lie too unevenly, a
        // polynomial through them strays further from their chord than a curve that is known by its samples does.
        let about = |k: usize, u: f64, from: f64| {
            let near = if self.is_smooth_about(k) { self.near(k)? } else { return None };
            let found = (self.points[k] + near.at(u)[0], from + near.input(u));
            let strayed = (found.0 - straight.0).norm();
            (strayed <= 0.2 * step.norm() && found.1.is_finite()).then_some(found)
        };
        // About the sample that is nearer, by the length of the chords; halfway the one goes over into the other.
        let over = ((part - 0.25) * 2.0).clamp(0.0, 1.0);
        let chord = step.norm();
        let before = || about(i, part * chord, self.inputs[i]).unwrap_or(straight);
        let after = || about(next, (part - 1.0) * chord, input).unwrap_or(straight);
        let (point, at) = match over {
            0.0 => before(),
            1.0 => after(),
            _ => {
                let (a, b) = (before(), after());
                (a.0 + (b.0 - a.0) * over, a.1 + (b.1 - a.1) * over)
            }
        };
        let [low, high] = [self.inputs[i].min(input), self.inputs[i].max(input)];
        (point, at.clamp(low, high) + rounds)
    }

    /// How far the curve is from the lines between its samples at most, but for cusps.
    pub fn sagitta(&self) -> f64 {
        let height = |i: usize| {
            let chord = (self.points[self.at(i, 1).unwrap_or(i)] - self.points[i]).norm();
            (chord * chord * self.bends[i].abs() / 8.0).min(chord / 2.0)
        };
        (0..self.points.len()).map(height).fold(0.0, f64::max)
    }

    /// How much of the length each sample stands for: half the way to either neighbour.
    pub fn weights(&self) -> Vec<f64> {
        let chord = |i: usize| self.at(i, 1).map_or(0.0, |next| (self.points[next] - self.points[i]).norm());
        let before = |i: usize| self.at(i, -1).map_or(0.0, chord);
        (0..self.points.len()).map(|i| (before(i) + chord(i)) / 2.0).collect()
    }

    /// How far a point is from the lines to the neighbours of a sample.
    pub fn distance(&self, point: Point, i: usize) -> f64 {
        let to = |way| {
            let next = self.at(i, way).unwrap_or(i);
            distance_to_segment(point, self.points[i], self.points[next])
        };
        to(-1).min(to(1))
    }

    /// How far a point near a sample is from the curve there, positive to the left, and the curve's normal.
    pub fn offset(&self, point: Point, i: usize) -> Option<(f64, Vector)> {
        let near = self.near(i)?;
        let mut u = 0.0;
        // Newton's steps to where the way from the curve is square to it.
        for _ in 0..4 {
            let [p, v, a] = near.at(u);
            let by = self.points[i] + p - point;
            let step = by.dot(&v) / (v.norm_squared() + by.dot(&a));
            if !step.is_finite() {
                return None;
            }
            u = (u - step).clamp(near.ends[0], near.ends[1]);
        }
        let [p, v, _] = near.at(u);
        let normal = Vector::new(-v.y, v.x).try_normalize(0.0)?;
        Some((normal.dot(&(point - self.points[i] - p)), normal))
    }

    /// How far the input has gone, there and back, from the first sample to a place.
    pub fn travelled(&self, place: f64) -> f64 {
        let n = self.points.len();
        if place < 0.0 {
            return self.travelled(place + n as f64) - self.travel[n];
        }
        let (i, rounds) = (place.floor() as usize % n, (place.floor() as usize / n) as f64);
        let (from, to) = (self.travel[i], self.travel[i + 1]);
        let part =
            if place.fract() > 0.0 { (self.place(i as f64 + place.fract()).1 - self.inputs[i]).abs() } else { 0.0 };
        rounds * self.travel[n] + from + part.min(to - from)
    }

    /// Whether no sample within two of one is a turning back of the path.
    fn is_smooth_about(&self, i: usize) -> bool {
        (-2..=2).all(|off| self.at(i, off).is_none_or(|k| !self.sharp[k]))
    }

    /// The curve about a sample that two others stand on either side of.
    fn near(&self, i: usize) -> Option<Near> {
        let n = self.points.len() as isize;
        if n < 5 {
            return None;
        }
        // Near the end of an open curve the five are those next to the end.
        let shift = if self.closed { 0 } else { (2 - i as isize).max(0) + (n - 3 - i as isize).min(0) };
        let offs: [isize; 5] = std::array::from_fn(|k| k as isize - 2 + shift);
        let around: [usize; 5] = offs.map(|off| (i as isize + off).rem_euclid(n) as usize);
        let mut s = [0.0; 5];
        for k in 1..5 {
            s[k] = s[k - 1] + (self.points[around[k]] - self.points[around[k - 1]]).norm();
        }
        let own = s[(2 - shift) as usize];
        let s = s.map(|s| s - own);
        let over = |k: usize| {
            let at = i as isize + offs[k];
            if at < 0 {
                -self.turn
            } else if at >= n {
                self.turn
            } else {
                0.0
            }
        };
        let mut divided: [(Vector, f64); 5] = std::array::from_fn(|k| {
            (self.points[around[k]] - self.points[i], self.inputs[around[k]] + over(k) - self.inputs[i])
        });
        for order in 1..5 {
            for k in (order..5).rev() {
                let by = 1.0 / (s[k] - s[k - order]);
                let (here, before) = (divided[k], divided[k - 1]);
                divided[k] = ((here.0 - before.0) * by, (here.1 - before.1) * by);
            }
        }
        // From products of (u - s) to powers of u.
        let (mut powers, mut inputs) = ([Vector::zeros(); 5], [0.0; 5]);
        for k in (0..5).rev() {
            for n in (1..5).rev() {
                powers[n] = powers[n - 1] - powers[n] * s[k];
                inputs[n] = inputs[n - 1] - inputs[n] * s[k];
            }
            powers[0] = divided[k].0 - powers[0] * s[k];
            inputs[0] = divided[k].1 - inputs[0] * s[k];
        }
        let beside = [1, 3].map(|k| (k - shift).clamp(0, 4) as usize);
        Some(Near { powers, inputs, ends: beside.map(|k| s[k]) })
    }

    /// The places where the curve crosses itself, in the order of the first time it goes there.
    pub fn crossings(&self) -> Vec<Point> {
        let n = self.intervals();
        let end = |i: usize| self.points[self.at(i, 1).unwrap_or(i)];
        let spans: Vec<[f64; 2]> =
            (0..n).map(|i| [self.points[i].x.min(end(i).x), self.points[i].x.max(end(i).x)]).collect();
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&a, &b| spans[a][0].total_cmp(&spans[b][0]));
        let mut found: Vec<(usize, Point)> = Vec::new();
        for (k, &i) in order.iter().enumerate() {
            for &j in order[k + 1..].iter().take_while(|&&j| spans[j][0] <= spans[i][1]) {
                let are_neighbours = self.at(i, 1) == Some(j) || self.at(j, 1) == Some(i);
                if !are_neighbours
                    && let Some((at, parts)) = crossing([self.points[i], end(i)], [self.points[j], end(j)])
                    && self.cross_at([i, j], parts)
                {
                    found.push((i.min(j), at));
                }
            }
        }
        found.sort_by_key(|(i, _)| *i);
        let mut places: Vec<Point> = Vec::new();
        let size = (0..n).map(|i| (end(i) - self.points[i]).norm()).fold(0.0, f64::max);
        for (_, at) in found {
            // A sample that the curve goes through twice is the end of four chords.
            if places.iter().all(|other| (other - at).norm() > 1e-9 * size) {
                places.push(at);
            }
        }
        places
    }
}

impl Trail {
    /// Whether the curve goes through the crossing of two chords in two directions. Where it goes there and back on one
    /// path, as a rocker's pin does, chords of that path cross too.
    fn cross_at(&self, chords: [usize; 2], parts: [f64; 2]) -> bool {
        let [a, b] = [0, 1].map(|k| {
            let (i, next) = (chords[k], self.at(chords[k], 1).unwrap_or(chords[k]));
            let chord = self.points[next] - self.points[i];
            let turned = (self.bends[i] + self.bends[next]) / 2.0 * chord.norm() * (parts[k] - 0.5);
            let (cos, sin) = (trig::cos(turned), trig::sin(turned));
            times(Vector::new(cos, sin), chord)
        });
        cross(a, b).abs() > 1e-3 * a.norm() * b.norm()
    }
}

/// A curve about a sample: the polynomial of the fourth degree in the length of the chords, through five samples.
struct Near {
    /// From the sample, by powers.
    powers: [Vector; 5],
    /// How the input goes on from there, by powers too.
    inputs: [f64; 5],
    /// At the samples before and after.
    ends: [f64; 2],
}

impl Near {
    /// The place, from the sample, and its first two derivatives.
    fn at(&self, u: f64) -> [Vector; 3] {
        self.powers.iter().rev().fold([Vector::zeros(); 3], |[p, v, a], c| [p * u + c, v * u + p, a * u + v * 2.0])
    }

    /// The input, from that of the sample.
    fn input(&self, u: f64) -> f64 {
        self.inputs.iter().rev().fold(0.0, |input, c| input * u + c)
    }

    /// The greatest value between the samples before and after.
    fn most(&self, of: impl Fn(&Near, f64) -> f64) -> f64 {
        let [mut a, mut b] = self.ends;
        // To 1e-7 of the way between samples: what is flat there is known to the square of that.
        for _ in 0..40 {
            let (c, d) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
            if of(self, c) > of(self, d) { b = d } else { a = c }
        }
        of(self, a)
    }
}

/// Where two chords cross, and what part of each is before that. One that ends on the other counts as to its left, so
/// that a crossing at a sample counts once.
fn crossing([a, b]: [Point; 2], [c, d]: [Point; 2]) -> Option<(Point, [f64; 2])> {
    let [ab, cd] = [b - a, d - c];
    let is_left = |from: Point, along: Vector, p: Point| cross(along, p - from) >= 0.0;
    if is_left(a, ab, c) == is_left(a, ab, d) || is_left(c, cd, a) == is_left(c, cd, b) {
        return None;
    }
    let parts = [cross(c - a, cd), cross(c - a, ab)].map(|area| area / cross(ab, cd));
    parts[0].is_finite().then(|| (a + ab * parts[0], parts))
}

use crate::geometry::{Point, Vector, cross, trig};
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
    /// Whether the last is followed by the first.
    pub closed: bool,
    /// The signed curvature at each sample, of the circle through it and its neighbours.
    bends: Vec<f64>,
}

/// An arc of a circle over a chord.
struct Arc {
    length: f64,
    /// Between it and its chord; positive where it bends to the left.
    area: f64,
}

impl Trail {
    pub fn of(circuit: &Circuit, joint: usize) -> Trail {
        let kept = |(p, _): &(Point, usize)| p.x.is_finite() && p.y.is_finite();
        let (points, samples): (Vec<Point>, Vec<usize>) = circuit.points(joint).zip(0..).filter(kept).unzip();
        Trail::new(points, samples, circuit.closed)
    }

    /// An open curve through points.
    pub fn through(points: Vec<Point>) -> Trail {
        let samples = (0..points.len()).collect();
        Trail::new(points, samples, false)
    }

    fn new(points: Vec<Point>, samples: Vec<usize>, closed: bool) -> Trail {
        let mut trail = Trail { points, samples, closed, bends: Vec::new() };
        trail.bends = (0..trail.points.len()).map(|i| trail.bend(i)).collect();
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
        (0..self.intervals()).map(|i| self.arc(i).length).collect()
    }

    /// The area it goes round, positive counter-clockwise; none of an open curve.
    pub fn area(&self) -> Option<f64> {
        let first = *self.points.first().filter(|_| self.closed)?;
        let part = |i: usize| {
            let (a, b) = (self.points[i] - first, self.points[self.at(i, 1).unwrap_or(i)] - first);
            cross(a, b) / 2.0 + self.arc(i).area
        };
        Some((0..self.intervals()).map(part).sum())
    }

    /// The greatest extent in a direction.
    pub fn reach(&self, direction: Vector) -> f64 {
        let height = |i: usize| direction.dot(&self.points[i].coords);
        let Some(top) = (0..self.points.len()).max_by(|&a, &b| height(a).total_cmp(&height(b))) else {
            return f64::NAN;
        };
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

    /// The point a part of the way from a sample to the next.
    pub fn between(&self, i: usize, part: f64) -> Point {
        let next = self.at(i, 1).unwrap_or(i);
        // About the sample that is nearer, by the length of the chords.
        let near = |k: usize, u: f64| self.near(k).map(|near| self.points[k] + near.at(u)[0]);
        let chord = (self.points[next] - self.points[i]).norm();
        let found = if part < 0.5 { near(i, part * chord) } else { near(next, (part - 1.0) * chord) };
        found.unwrap_or_else(|| self.points[i] + (self.points[next] - self.points[i]) * part)
    }

    /// The curve about a sample; none near the end of an open curve.
    fn near(&self, i: usize) -> Option<Near> {
        let around: Vec<usize> = [-2, -1, 0, 1, 2].iter().map(|&off| self.at(i, off)).collect::<Option<_>>()?;
        let chord = |k: usize| (self.points[around[k + 1]] - self.points[around[k]]).norm();
        let s = [-chord(1) - chord(0), -chord(1), 0.0, chord(2), chord(2) + chord(3)];
        let mut divided: [Vector; 5] = std::array::from_fn(|k| self.points[around[k]] - self.points[i]);
        for order in 1..5 {
            for k in (order..5).rev() {
                divided[k] = (divided[k] - divided[k - 1]) / (s[k] - s[k - order]);
            }
        }
        // From products of (u - s) to powers of u.
        let mut powers = [Vector::zeros(); 5];
        for k in (0..5).rev() {
            for n in (1..5).rev() {
                powers[n] = powers[n - 1] - powers[n] * s[k];
            }
            powers[0] = divided[k] - powers[0] * s[k];
        }
        Some(Near { powers, ends: [s[1], s[3]] })
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
            Vector::new(cos * chord.x - sin * chord.y, sin * chord.x + cos * chord.y)
        });
        cross(a, b).abs() > 1e-3 * a.norm() * b.norm()
    }
}

/// A curve about a sample: the polynomial of the fourth degree in the length of the chords, through five samples.
struct Near {
    /// From the sample, by powers.
    powers: [Vector; 5],
    /// At the samples before and after.
    ends: [f64; 2],
}

impl Near {
    /// The place, from the sample, and its first two derivatives.
    fn at(&self, u: f64) -> [Vector; 3] {
        self.powers.iter().rev().fold([Vector::zeros(); 3], |[p, v, a], c| [p * u + c, v * u + p, a * u + v * 2.0])
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

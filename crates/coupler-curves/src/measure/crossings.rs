//! The crunodes of a curve, from the chords between its samples.

use super::sampled_curve::SampledCurve;
use crate::geometry::{Point, Vector, complex_product, cross, trig};

impl SampledCurve {
    /// The points at which the curve crosses itself, in the order in which it first passes them.
    pub fn crunodes(&self) -> Vec<Point> {
        let n = self.interval_count();
        let end = |i: usize| self.points[self.neighbour(i, 1).unwrap_or(i)];
        let spans: Vec<[f64; 2]> =
            (0..n).map(|i| [self.points[i].x.min(end(i).x), self.points[i].x.max(end(i).x)]).collect();
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&a, &b| spans[a][0].total_cmp(&spans[b][0]));
        let mut found: Vec<(usize, Point)> = Vec::new();
        for (k, &i) in order.iter().enumerate() {
            for &j in order[k + 1..].iter().take_while(|&&j| spans[j][0] <= spans[i][1]) {
                let are_neighbours = self.neighbour(i, 1) == Some(j) || self.neighbour(j, 1) == Some(i);
                if !are_neighbours
                    && let Some((at, parts)) = chord_crossing([self.points[i], end(i)], [self.points[j], end(j)])
                    && self.is_crossing([i, j], parts)
                {
                    found.push((i.min(j), at));
                }
            }
        }
        found.sort_by_key(|(i, _)| *i);
        let mut crunodes: Vec<Point> = Vec::new();
        let size = (0..n).map(|i| (end(i) - self.points[i]).norm()).fold(0.0, f64::max);
        for (_, at) in found {
            // A sample that the curve passes twice is the end of four chords.
            if crunodes.iter().all(|other| (other - at).norm() > 1e-9 * size) {
                crunodes.push(at);
            }
        }
        crunodes
    }

    /// Whether the curve passes the crossing of two chords in two directions. If it retraces its path in reverse, as a
    /// rocker's pin does, chords cross without a crunode.
    fn is_crossing(&self, chords: [usize; 2], parts: [f64; 2]) -> bool {
        let [a, b] = [0, 1].map(|k| {
            let (i, next) = (chords[k], self.neighbour(chords[k], 1).unwrap_or(chords[k]));
            let chord = self.points[next] - self.points[i];
            let angle = (self.curvatures[i] + self.curvatures[next]) / 2.0 * chord.norm() * (parts[k] - 0.5);
            let (cos, sin) = (trig::cos(angle), trig::sin(angle));
            complex_product(Vector::new(cos, sin), chord)
        });
        cross(a, b).abs() > 1e-3 * a.norm() * b.norm()
    }
}

/// The point at which two chords cross, and the fraction of each chord before it. The end of a chord on the other is
/// taken to be to its left, so that a crossing at a sample counts once.
fn chord_crossing([a, b]: [Point; 2], [c, d]: [Point; 2]) -> Option<(Point, [f64; 2])> {
    let [ab, cd] = [b - a, d - c];
    let is_left = |from: Point, along: Vector, p: Point| cross(along, p - from) >= 0.0;
    if is_left(a, ab, c) == is_left(a, ab, d) || is_left(c, cd, a) == is_left(c, cd, b) {
        return None;
    }
    let parts = [cross(c - a, cd), cross(c - a, ab)].map(|area| area / cross(ab, cd));
    parts[0].is_finite().then(|| (a + ab * parts[0], parts))
}

//! The axis about which a curve is most nearly symmetrical, and the distance of the curve from its mirror image.

use super::asymmetry::is_asymmetrical;
use super::axis_motion::{least_squares_motion, minimax_motion};
use super::features::SymmetryAxis;
use super::portion::Row;
use crate::geometry::{Point, Vector, complex_product, cross, in_rising_order, trig};
use crate::numerical::maximum_with_ends;

/// The mirror images of a curve, given by a row of points.
pub(super) struct MirrorImages<'a> {
    row: &'a Row,
    /// The points of one round.
    points: &'a [Point],
    /// The greatest distance of neighbouring points.
    spacing: f64,
    /// Bounding boxes of consecutive points.
    boxes: Vec<[Point; 2]>,
}

/// The axes that a curve may have.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum AxisCandidates {
    /// Every line through the centre of a circle.
    AnyDiameter,
    /// These, the most likely first.
    Lines(Vec<SymmetryAxis>),
}

impl<'a> MirrorImages<'a> {
    const BOX_SIZE: usize = 16;

    /// Of the curve with these points.
    pub fn new(row: &'a Row) -> MirrorImages<'a> {
        let points = &row.points[..if row.is_closed { row.start_count } else { row.points.len() }];
        let corners = |points: &[Point]| points.iter().fold([points[0]; 2], |[low, high], p| [low.inf(p), high.sup(p)]);
        let spacing = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).fold(0.0, f64::max);
        MirrorImages { row, points, spacing, boxes: points.chunks(Self::BOX_SIZE).map(corners).collect() }
    }

    /// Whether they are further from the curve, of a given extent, than a distance, about any axis; if not, they may be all the same.
    pub fn are_far(&self, extent: f64, distance: f64) -> bool {
        is_asymmetrical(self.points, self.spacing, extent, distance)
    }

    /// The axes about which the mirror image comes closest to the curve in the mean, when both are passed at one speed
    /// from any start and in either direction.
    ///
    /// With z the curve as a function of its length, as complex numbers from its centroid, the image about the line
    /// through the centroid in direction a, started at s, is `e^(2ia) conj z`: it comes closest where the magnitude of
    /// the correlation of z with itself is greatest, and 2a is the angle of the correlation.
    pub fn candidates(&self) -> AxisCandidates {
        /// Points of equal distance along the curve.
        const COUNT: usize = 64;
        /// The number of greatest correlations that are returned.
        const MOST: usize = 4;
        /// Axes whose directions differ by less than this angle, in radians, are refined to the same.
        const SAME_DIRECTION: f64 = 0.02;
        let (is_closed, row) = (self.row.is_closed, self.row);
        let round = if is_closed { row.start_count } else { row.points.len() - 1 };
        let total = row.cumulative_length[round];
        let intervals = if is_closed { COUNT } else { COUNT - 1 };
        let mut at = 0;
        let mut z: Vec<Vector> = Vec::with_capacity(COUNT);
        for k in 0..COUNT {
            let length = total * k as f64 / intervals as f64;
            while at + 1 < round && row.cumulative_length[at + 1] <= length {
                at += 1;
            }
            let [from, to] = [row.cumulative_length[at], row.cumulative_length[at + 1]];
            let part = if to > from { ((length - from) / (to - from)).min(1.0) } else { 0.0 };
            z.push((row.points[at] + (row.points[at + 1] - row.points[at]) * part).coords);
        }
        let centre = z.iter().sum::<Vector>() / COUNT as f64;
        z.iter_mut().for_each(|z| *z -= centre);
        let energy: f64 = z.iter().map(Vector::norm_squared).sum();
        let sum = |other: &dyn Fn(usize) -> usize| {
            (0..COUNT).map(|j| complex_product(z[j], z[other(j)])).fold(Vector::zeros(), |sum, term| sum + term)
        };
        // An open curve is passed from either end.
        let backward: Vec<Vector> = match is_closed {
            true => (0..COUNT).map(|m| sum(&|j| (m + COUNT - j) % COUNT)).collect(),
            false => vec![sum(&|j| COUNT - 1 - j)],
        };
        let forward: Vec<Vector> = match is_closed {
            true => (0..COUNT).map(|m| sum(&|j| (j + m) % COUNT)).collect(),
            false => vec![sum(&|j| j)],
        };
        let [least, greatest] = backward
            .iter()
            .map(|f| f.norm())
            .fold([f64::INFINITY, 0.0f64], |[least, greatest], f| [least.min(f), greatest.max(f)]);
        if is_closed && greatest - least <= 1e-9 * energy && greatest >= (1.0 - 1e-3) * energy {
            return AxisCandidates::AnyDiameter;
        }
        let mut peaks: Vec<(f64, SymmetryAxis)> = Vec::new();
        for correlation in [&backward, &forward] {
            let count = correlation.len();
            for m in 0..count {
                let [before, here, after] = [m + count - 1, m, m + 1].map(|k| correlation[k % count]);
                if here.norm() < before.norm() || here.norm() < after.norm() || here.norm() <= 1e-12 * energy {
                    continue;
                }
                let rise = before.norm() - 2.0 * here.norm() + after.norm();
                let shift = if rise < 0.0 { (before.norm() - after.norm()) / (2.0 * rise) } else { 0.0 };
                let toward = if shift > 0.0 { after } else { before };
                let value = here + (toward - here) * shift.abs();
                let (cos, sin) = trig::cos_sin_deg(trig::degrees(trig::atan2(value.y, value.x)) / 2.0);
                if let Some(axis) = SymmetryAxis::new(Point::from(centre), Vector::new(cos, sin)) {
                    peaks.push((here.norm(), axis));
                }
            }
        }
        let mut lines: Vec<SymmetryAxis> = Vec::new();
        for (_, axis) in in_rising_order(peaks, |peak| -peak.0) {
            // A curve that returns on itself has each axis in both directions.
            let is_new = lines.iter().all(|other| cross(other.direction, axis.direction).abs() > SAME_DIRECTION);
            if is_new && lines.len() < MOST {
                lines.push(axis);
            }
        }
        AxisCandidates::Lines(lines)
    }

    /// The indices of every nth point, and of those whose images are often furthest away: the end of an open curve, and where
    /// the curve stops or bends sharply.
    fn every_nth(&self, n: usize) -> impl Iterator<Item = usize> {
        let end = (!self.row.is_closed).then(|| self.points.len() - 1);
        (0..self.points.len()).step_by(n).chain(end).chain(self.row.bends().iter().copied())
    }

    /// The greatest distance of the mirror images of about `count` points of the row from the curve, unless it is more than `most`.
    pub fn residual(&self, axis: SymmetryAxis, count: usize, most: f64) -> Option<f64> {
        let (residual, _) = self.greatest_distance(axis, count, most);
        (residual <= most).then_some(residual)
    }

    /// That distance, and the index of the point whose image is so far away; of the first that is further than `enough`.
    fn greatest_distance(&self, axis: SymmetryAxis, count: usize, enough: f64) -> (f64, usize) {
        let mut near = 0;
        let mut most = (0.0, 0);
        for k in self.every_nth((self.points.len() / count).max(1)) {
            let image = axis.mirror(self.points[k]);
            near = self.nearest(image, near);
            // The curve is no further away than its nearest point of the row.
            if (self.points[near] - image).norm_squared() > most.0 * most.0
                && let Some((distance, _)) = self.signed_distance(image, near)
                && distance.abs() > most.0
            {
                most = (distance.abs(), k);
                if most.0 > enough {
                    break;
                }
            }
        }
        most
    }

    /// The greatest distance of the mirror image from the curve.
    pub fn exact_residual(&self, axis: SymmetryAxis) -> f64 {
        /// As many points locate the greatest distance, which is then searched for between them.
        const COUNT: usize = 128;
        let (most, k) = self.greatest_distance(axis, COUNT, f64::INFINITY);
        let reach = (self.points.len() / COUNT).max(1) as f64;
        let distance = |position: f64| {
            let image = axis.mirror(self.row.point_at(position));
            let near = self.nearest(image, k.min(self.points.len() - 1));
            self.signed_distance(image, near).map_or(f64::NEG_INFINITY, |(distance, _)| distance.abs())
        };
        let ends = self.row.bounds([k as f64 - reach, k as f64 + reach]);
        maximum_with_ends(ends, 0.05 * reach, distance).value.max(most)
    }

    /// Moves an axis to where the greatest distance of the mirror image from the curve is least, to a hundredth; the
    /// axis and that distance. `rough` is the residual of the axis for a part of the points.
    pub fn refine(&self, mut axis: SymmetryAxis, rough: f64) -> (SymmetryAxis, f64) {
        const LEAST_SQUARES_ROUNDS: usize = 2;
        const ROUNDS: usize = 8;
        const SMALL: f64 = 1e-4;
        /// As many points are enough to move the axis.
        const COUNT: usize = 128;
        let stride = (self.points.len() / COUNT).max(1);
        // Each point, and the one nearest to its image: as the axis moves, it moves along the curve.
        let mut near = 0;
        let nearest = |k: usize| {
            near = self.nearest(axis.mirror(self.points[k]), near);
            (k, near)
        };
        let mut pairs: Vec<(usize, usize)> = self.every_nth(stride).map(nearest).collect();
        let start = axis;
        // Least squares first: a few points that are compared with the wrong one of two neighbouring parts of the curve
        // do not hold them up.
        for _ in 0..LEAST_SQUARES_ROUNDS {
            let distances = self.distances(axis, &mut pairs, false);
            let Some((shift, turn)) = least_squares_motion(axis, &distances) else { break };
            axis = axis.moved(shift, turn).unwrap_or(axis);
        }
        for (k, near) in &mut pairs {
            *near = self.nearest(axis.mirror(self.points[*k]), *near);
        }
        let mut best = (axis, f64::INFINITY);
        let mut step = Vector::zeros();
        let mut is_small = false;
        for _ in 0..=ROUNDS {
            let distances = self.distances(axis, &mut pairs, is_small);
            let most = distances.iter().map(|(_, distance, _)| distance.abs()).fold(0.0, f64::max);
            if most < best.1 {
                let gain = best.1 - most;
                best = (axis, most);
                // Of a nearly symmetrical curve the parabolas' own error counts.
                is_small |= most <= SMALL * self.row.cumulative_length[self.points.len() - 1];
                if gain <= 1e-3 * most {
                    break;
                }
                let Some((shift, turn)) = minimax_motion(axis, &distances) else { break };
                step = Vector::new(shift, turn);
            } else {
                // The distances are not linear in so great a motion.
                step /= 3.0;
            }
            let Some(moved) = best.0.moved(step.x, step.y) else { break };
            axis = moved;
        }
        let residual = self.exact_residual(best.0);
        // Of all points the residual is no less than of a part of them.
        if residual <= rough {
            return (best.0, residual);
        }
        let before = self.exact_residual(start);
        if residual <= before { (best.0, residual) } else { (start, before) }
    }

    /// The mirror images of points, their distances from the parabolas through neighbouring points of the row, positive
    /// to the left of the curve, and the normals there; if they are to be exact, from the curve. `pairs` are the points
    /// and those nearest to their images.
    fn distances(&self, axis: SymmetryAxis, pairs: &mut [(usize, usize)], is_exact: bool) -> Vec<(Point, f64, Vector)> {
        let distance = |(k, near): &mut (usize, usize)| {
            let image = axis.mirror(self.points[*k]);
            *near = self.descend(image, *near).0;
            let (distance, normal) = match is_exact {
                true => self.signed_distance(image, *near)?,
                false => self.distance_to_parabola(image, *near)?,
            };
            Some((image, distance, normal))
        };
        pairs.iter_mut().filter_map(distance).collect()
    }

    /// The signed distance of a point from the curve and its normal there, of all parts of the curve that may be nearest;
    /// `near` is the nearest point of the row.
    fn signed_distance(&self, point: Point, near: usize) -> Option<(f64, Vector)> {
        let count = self.points.len();
        let nearer =
            |found: (f64, Vector), other: (f64, Vector)| if other.0.abs() < found.0.abs() { other } else { found };
        let mut found = self.row.signed_distance(point, near as f64)?;
        // Next to a cusp, which is between two corners, the curve is near on both its sides.
        let reach = found.0.abs() + self.spacing;
        let is_near = |corner: &&usize| (self.points[**corner] - point).norm() <= reach;
        for corner in self.row.bends().iter().filter(is_near) {
            for beside in [corner + count - 1, corner + 1] {
                found = nearer(found, self.row.signed_distance(point, (beside % count) as f64)?);
            }
        }
        // Between two points of the row the curve may be nearer than at both by half their distance.
        for (k, [low, high]) in self.boxes.iter().enumerate() {
            let reach = found.0.abs() + self.spacing;
            let outside = |low: f64, at: f64, high: f64| (low - at).max(at - high).max(0.0);
            let (x, y) = (outside(low.x, point.x, high.x), outside(low.y, point.y, high.y));
            if x * x + y * y >= reach * reach {
                continue;
            }
            for j in k * Self::BOX_SIZE..((k + 1) * Self::BOX_SIZE).min(count) {
                let square = |j: usize| (self.points[j % count] - point).norm_squared();
                let is_near = square(j) < reach * reach && j.abs_diff(near) > 1;
                if is_near && square(j) <= square(j + 1) && square(j) <= square(j + count - 1) {
                    found = nearer(found, self.row.signed_distance(point, j as f64)?);
                }
            }
        }
        Some(found)
    }

    /// The signed distance of a point from the parabola through three points of the row, and its normal there.
    fn distance_to_parabola(&self, point: Point, near: usize) -> Option<(f64, Vector)> {
        let count = self.points.len();
        let neighbours = match near {
            _ if self.row.is_closed => [(near + count - 1) % count, near, (near + 1) % count],
            0 => [0, 1.min(count - 1), 2.min(count - 1)],
            _ if near + 1 == count => [count.saturating_sub(3), count.saturating_sub(2), near],
            _ => [near - 1, near, near + 1],
        };
        let [a, b, c] = neighbours.map(|k| self.points[k]);
        let (slope, bend) = ((c - a) / 2.0, (c - b) - (b - a));
        let mut t = 0.0f64;
        for _ in 0..2 {
            let (offset, velocity) = (point - b - slope * t - bend * (t * t / 2.0), slope + bend * t);
            t += offset.dot(&velocity) / (velocity.norm_squared() - offset.dot(&bend));
            // At a sharp bend the foot is on no parabola.
            if t.is_nan() || t.abs() > 1.0 {
                return None;
            }
        }
        let (offset, velocity) = (point - b - slope * t - bend * (t * t / 2.0), slope + bend * t);
        let normal = Vector::new(-velocity.y, velocity.x).try_normalize(0.0)?;
        Some((normal.dot(&offset), normal))
    }

    /// The point that is locally nearest to another, reached from a `guess` along the curve, and the square of the
    /// distance.
    fn descend(&self, point: Point, guess: usize) -> (usize, f64) {
        let square = |k: usize| (self.points[k] - point).norm_squared();
        let (mut near, mut best) = (guess, square(guess));
        for step in [1, self.points.len() - 1] {
            while let next = (near + step) % self.points.len()
                && square(next) < best
            {
                (best, near) = (square(next), next);
            }
        }
        (near, best)
    }

    /// The point of the row nearest to a point, searched for from a `guess`.
    fn nearest(&self, point: Point, guess: usize) -> usize {
        // Most boxes are further away than the local minimum.
        let (mut near, mut best) = self.descend(point, guess);
        for (k, [low, high]) in self.boxes.iter().enumerate() {
            let outside = |low: f64, at: f64, high: f64| (low - at).max(at - high).max(0.0);
            let (x, y) = (outside(low.x, point.x, high.x), outside(low.y, point.y, high.y));
            if x * x + y * y < best {
                let first = k * Self::BOX_SIZE;
                for (j, q) in self.points[first..].iter().take(Self::BOX_SIZE).enumerate() {
                    let square = (q - point).norm_squared();
                    if square < best {
                        (best, near) = (square, first + j);
                    }
                }
            }
        }
        near
    }
}

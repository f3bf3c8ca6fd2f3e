//! Strips, convex hulls and diameters of points.

use super::remez::exchange_point;
use crate::geometry::{Point, Vector, cross};

/// The narrowest band between two parallel lines that contains some points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strip {
    /// The distance of the two lines.
    pub width: f64,
    /// The extent of the points along the lines.
    pub length: f64,
    /// The direction of the lines, of length 1.
    pub direction: Vector,
}

impl Strip {
    /// The strip of at least one point.
    pub fn enclosing(points: Vec<Point>) -> Strip {
        Strip::from_hull(&convex_hull(points))
    }

    /// The strip of a row of points along a nearly straight path; `None` if it is wider than `most`, and a wider strip
    /// than the narrowest if that is enough.
    ///
    /// One line passes through two of three points, and the other through the one between them; points are exchanged
    /// until none is outside. `three` are the indices to begin with, and afterwards those of the strip.
    pub fn by_exchange(points: &[Point], three: &mut [usize; 3], most: f64) -> Option<Strip> {
        const ROUNDS: usize = 12;
        /// The greatest ratio of width to length for which the exchange is certain to find the narrowest strip.
        const THIN: f64 = 1.0 / 300.0;
        for _ in 0..ROUNDS {
            let corners = three.map(|k| points[k]);
            let least = triangle_height(corners);
            if least > most {
                return None;
            }
            let [a, b, c] = corners;
            let (side, length) = (c - a, (c - a).norm());
            let area = |p: &Point| cross(side, p - a);
            let [low, high] = min_max(points, area);
            let width = (high - low) / length;
            if width <= least * (1.0 + 1e-12) || (most.is_finite() && width <= most) {
                let along = side / length;
                let [near, far] = min_max(points, |p| along.dot(&(p - a)));
                if width > THIN * (far - near) {
                    break;
                }
                return Some(Strip { width, length: far - near, direction: along });
            }
            // The point that is furthest outside.
            let own = area(&b);
            let outside = if high - own.max(0.0) > own.min(0.0) - low { high } else { low };
            let Some(new) = points.iter().position(|p| area(p) == outside) else { break };
            *three = exchange_point(*three, new, |k| (k == 1) == ((outside > 0.0) == (own > 0.0)));
        }
        Some(Strip::enclosing(points.to_vec())).filter(|strip| strip.width <= most)
    }

    /// The strip of a convex polygon: one of its sides is on an edge of the strip.
    pub fn from_hull(corners: &[Point]) -> Strip {
        let n = corners.len();
        let first = corners.first().copied().unwrap_or_default();
        let direct = corners.last().copied().unwrap_or_default() - first;
        if n <= 2 {
            // A line, or a point.
            let along = direct.try_normalize(0.0).unwrap_or_else(Vector::x);
            return Strip { width: 0.0, length: direct.norm(), direction: along };
        }
        let next = |i: usize| if i + 1 < n { i + 1 } else { 0 };
        let mut best = Strip { width: f64::INFINITY, length: 0.0, direction: Vector::x() };
        let mut far = 1;
        for k in 0..n {
            let (a, side) = (corners[k], corners[next(k)] - corners[k]);
            let height = |i: usize| cross(side, corners[i] - a);
            if far == k {
                far = next(k);
            }
            while height(next(far)) > height(far) {
                far = next(far);
            }
            let length = side.norm();
            let width = height(far).max(0.0) / length;
            // Sides of a hull are longer than 0.
            if width < best.width {
                best = Strip { width, direction: side / length, ..best };
            }
        }
        let reach = corners.iter().map(|p| best.direction.dot(&(p - first)));
        let [low, high] = reach.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], s| [low.min(s), high.max(s)]);
        Strip { length: high - low, ..best }
    }
}

/// The least height of a triangle; 0 if its corners coincide.
pub(super) fn triangle_height([a, b, c]: [Point; 3]) -> f64 {
    let longest = (b - a).norm_squared().max((c - b).norm_squared()).max((a - c).norm_squared());
    let area = cross(b - a, c - a);
    if longest > 0.0 { area.abs() / longest.sqrt() } else { 0.0 }
}

/// The least and the greatest value of a function of points.
pub(super) fn min_max(points: &[Point], value_at: impl Fn(&Point) -> f64) -> [f64; 2] {
    // Four at a time, so that the compiler vectorizes the loop.
    let (mut low, mut high) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
    let (fours, rest) = points.as_chunks::<4>();
    let mut update = |k: usize, value: f64| {
        low[k] = if value < low[k] { value } else { low[k] };
        high[k] = if value > high[k] { value } else { high[k] };
    };
    for four in fours {
        let values = [value_at(&four[0]), value_at(&four[1]), value_at(&four[2]), value_at(&four[3])];
        (0..4).for_each(|k| update(k, values[k]));
    }
    rest.iter().for_each(|p| update(0, value_at(p)));
    [low.into_iter().fold(f64::INFINITY, f64::min), high.into_iter().fold(f64::NEG_INFINITY, f64::max)]
}

/// The corners of the convex hull of some points, counter-clockwise.
pub(super) fn convex_hull(mut points: Vec<Point>) -> Vec<Point> {
    // The points of a nearly straight portion are already in order along x or y, so that sorting is fast.
    let ends = points.last().zip(points.first()).map_or(Vector::zeros(), |(last, first)| last - first);
    if ends.x.abs() >= ends.y.abs() {
        points.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    } else {
        points.sort_unstable_by(|a, b| a.y.total_cmp(&b.y).then(b.x.total_cmp(&a.x)));
    }
    let mut corners: Vec<Point> = Vec::with_capacity(points.len() + 1);
    let mut half = |points: &mut dyn Iterator<Item = &Point>| {
        let start = corners.len();
        for p in points {
            while corners.len() >= start + 2
                && let [.., a, b] = corners[..]
                && cross(b - a, p - b) <= 0.0
            {
                corners.pop();
            }
            corners.push(*p);
        }
        corners.pop();
    };
    half(&mut points.iter());
    half(&mut points.iter().rev());
    if corners.is_empty() { points.into_iter().take(1).collect() } else { corners }
}

/// The greatest distance between two corners of a convex polygon.
pub(super) fn diameter(corners: &[Point]) -> f64 {
    let n = corners.len();
    let next = |i: usize| if i + 1 < n { i + 1 } else { 0 };
    let mut far = next(0);
    let mut most = 0.0f64;
    for k in 0..n {
        let (a, side) = (corners[k], corners[next(k)] - corners[k]);
        // Only the corners that are furthest from a side can be furthest from its ends.
        for _ in 0..n {
            most = most.max((corners[far] - a).norm_squared()).max((corners[far] - a - side).norm_squared());
            if cross(side, corners[next(far)] - corners[far]) <= 0.0 {
                break;
            }
            far = next(far);
        }
    }
    most.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_is_as_wide_as_its_least_height() {
        let points = [(0.0, 0.0), (4.0, 0.0), (0.0, 3.0), (1.0, 1.0)].map(|(x, y)| Point::new(x, y));
        let strip = Strip::enclosing(points.to_vec());
        assert!((strip.width - 2.4).abs() < 1e-15 && (strip.length - 5.0).abs() < 1e-15, "{strip:?}");
    }

    #[test]
    fn the_diameter_is_that_of_the_furthest_pair() {
        let mut state = 1_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24)
        };
        for n in 1..40 {
            let points: Vec<Point> = (0..n).map(|_| Point::new(random(), random() * random())).collect();
            let furthest = points.iter().flat_map(|a| points.iter().map(move |b| (a - b).norm())).fold(0.0, f64::max);
            assert!((diameter(&convex_hull(points)) - furthest).abs() < 1e-15, "{n}");
        }
    }

    #[test]
    fn few_points_and_equal_points_have_no_width() {
        let p = Point::new(1.0, 2.0);
        for points in [vec![p], vec![p; 5], vec![p, Point::new(2.0, 2.0), p, Point::new(1.5, 2.0)]] {
            let strip = Strip::enclosing(points.clone());
            assert!(strip.width == 0.0 && (0.0..=1.0).contains(&strip.length), "{points:?} {strip:?}");
        }
    }
}

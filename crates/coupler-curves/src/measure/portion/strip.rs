//! Strips and convex hulls of points.

use super::remez::exchange_point;
use crate::geometry::{Point, Vector, cross, rising_order};

/// The narrowest band between two parallel lines that contains some points.
#[derive(Clone, Copy, Debug)]
pub struct Strip {
    /// The distance of the two lines.
    pub width: f64,
    /// The extent of the points along the lines.
    pub length: f64,
    /// The direction of the lines, of length 1.
    pub direction: Vector,
    /// The indices of the points that the lines pass through: the first and the last on one, the second on the other.
    pub contacts: [usize; 3],
}

impl Strip {
    /// The strip of at least one point.
    pub fn enclosing(points: &[Point]) -> Strip {
        Strip::from_hull(points, &convex_hull(points))
    }

    /// The strip of a row of points, most of which are along a nearly straight path: by exchange from `three` of them,
    /// which are afterwards those of the strip.
    pub fn of_row(points: &[Point], three: &mut [usize; 3]) -> Strip {
        Strip::by_exchange(points, three, f64::INFINITY).unwrap_or_else(|| Strip::enclosing(points))
    }

    /// The strip of a row of points along a nearly straight path; `None` if it is wider than `max_width`, and a wider strip
    /// than the narrowest if that is no wider.
    ///
    /// One line passes through two of three points, and the other through the one between them; points are exchanged
    /// until none is outside. `three` are the indices to begin with, and afterwards those of the strip.
    pub fn by_exchange(points: &[Point], three: &mut [usize; 3], max_width: f64) -> Option<Strip> {
        const ROUNDS: usize = 12;
        /// The greatest ratio of width to length for which the strip of the exchange, which is the narrowest across its
        /// own direction, is as narrow as any to the square of this.
        const THIN: f64 = 1.0 / 60.0;
        for _ in 0..ROUNDS {
            let corners = three.map(|k| points[k]);
            let least = triangle_height(corners);
            if least > max_width {
                return None;
            }
            let [a, b, c] = corners;
            let (side, length) = (c - a, (c - a).norm());
            let area = |p: &Point| cross(side, p - a);
            let [low, high] = min_max(points, area);
            let width = (high - low) / length;
            if width <= least * (1.0 + 1e-12) || (max_width.is_finite() && width <= max_width) {
                let along = side / length;
                let [near, far] = min_max(points, |p| along.dot(&(p - a)));
                if width > THIN * (far - near) {
                    break;
                }
                return Some(Strip { width, length: far - near, direction: along, contacts: *three });
            }
            // The point that is furthest outside.
            let own = area(&b);
            let outside = if high - own.max(0.0) > own.min(0.0) - low { high } else { low };
            let Some(new) = points.iter().position(|p| area(p) == outside) else { break };
            *three = exchange_point(*three, new, |k| (k == 1) == ((outside > 0.0) == (own > 0.0)));
        }
        Some(Strip::enclosing(points)).filter(|strip| strip.width <= max_width)
    }

    /// The strip of points whose convex hull has these corners: one of its sides is on an edge of the strip.
    fn from_hull(points: &[Point], hull: &[usize]) -> Strip {
        let n = hull.len();
        let corner = |i: usize| points[hull[i]];
        let next = |i: usize| if i + 1 < n { i + 1 } else { 0 };
        if n <= 2 {
            // A line, or a point.
            let [first, last] = [hull.first(), hull.last()].map(|k| k.copied().unwrap_or_default());
            let direct = points.get(last).zip(points.get(first)).map_or(Vector::zeros(), |(last, first)| last - first);
            let direction = direct.try_normalize(0.0).unwrap_or_else(Vector::x);
            return Strip { width: 0.0, length: direct.norm(), direction, contacts: [first, first, last] };
        }
        let none = Strip { width: f64::INFINITY, length: 0.0, direction: Vector::x(), contacts: [0; 3] };
        let mut best = none;
        let mut far = 1;
        for k in 0..n {
            let (a, side) = (corner(k), corner(next(k)) - corner(k));
            let height = |i: usize| cross(side, corner(i) - a);
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
                let edge = [hull[k], hull[next(k)]];
                best = Strip { width, direction: side / length, contacts: [edge[0], hull[far], edge[1]], ..best };
            }
        }
        let [low, high] = min_max(points, |p| best.direction.dot(&p.coords));
        Strip { length: high - low, ..best }
    }
}

/// A band between two parallel lines, not necessarily the narrowest, that grows with the points in it.
#[derive(Clone, Copy, Debug)]
pub struct Band {
    direction: Vector,
    low: f64,
    high: f64,
}

impl Band {
    /// The width of the band in a direction, of length 1, that contains some points.
    fn around(points: &[Point], direction: Vector) -> Band {
        let [low, high] = min_max(points, |p| cross(direction, p.coords));
        Band { direction, low, high }
    }

    /// Widens the band so that it contains a point, too; its width.
    pub fn extend(&mut self, point: Point) -> f64 {
        let height = cross(self.direction, point.coords);
        (self.low, self.high) = (self.low.min(height), self.high.max(height));
        self.high - self.low
    }
}

/// A band of a width of at most `max_width` that contains a row of points.
///
/// # Errors
/// A lower bound of the width of any, if there is none.
pub fn check_width(points: &[Point], max_width: f64) -> Result<Band, f64> {
    if points.len() < 3 {
        let along = points.last().zip(points.first()).and_then(|(last, first)| (last - first).try_normalize(0.0));
        return Ok(Band::around(points, along.unwrap_or_else(Vector::x)));
    }
    let last = points.len() - 1;
    // Triangles first: the least height of a triangle in a strip is no greater than the width of the strip.
    let quarters = [0, last / 4, last / 2, last - last / 4, last].map(|k| points[k]);
    for corners in [[0, 2, 4], [0, 1, 3], [1, 3, 4]] {
        let height = triangle_height(corners.map(|k| quarters[k]));
        if height > max_width {
            return Err(height);
        }
    }
    let mut three = [0, last / 2, last];
    match Strip::by_exchange(points, &mut three, max_width) {
        Some(strip) => Ok(Band::around(points, strip.direction)),
        None => Err(triangle_height(three.map(|k| points[k])).max(max_width)),
    }
}

/// The least height of a triangle; 0 if its corners coincide.
pub fn triangle_height([a, b, c]: [Point; 3]) -> f64 {
    let longest = (b - a).norm_squared().max((c - b).norm_squared()).max((a - c).norm_squared());
    let area = cross(b - a, c - a);
    if longest > 0.0 { area.abs() / longest.sqrt() } else { 0.0 }
}

/// The least and the greatest value of a function of points.
pub fn min_max<T>(points: &[T], value_at: impl Fn(&T) -> f64) -> [f64; 2] {
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

/// The indices of the points at the corners of the convex hull of some points, counter-clockwise.
pub fn convex_hull(points: &[Point]) -> Vec<usize> {
    // In a direction that few points share: those of a row along an axis would be in no order.
    let ends = points.last().zip(points.first()).map_or(Vector::zeros(), |(last, first)| last - first);
    let along = if ends.x.abs() >= ends.y.abs() { Vector::new(1.0, 1e-3) } else { Vector::new(-1e-3, 1.0) };
    let order = rising_order(&points.iter().map(|p| along.dot(&p.coords)).collect::<Vec<f64>>());
    let mut corners: Vec<usize> = Vec::with_capacity(points.len() + 1);
    let mut half = |order: &mut dyn Iterator<Item = &usize>| {
        let start = corners.len();
        for &k in order {
            while corners.len() >= start + 2
                && let [.., a, b] = corners[..]
                && cross(points[b] - points[a], points[k] - points[b]) <= 0.0
            {
                corners.pop();
            }
            corners.push(k);
        }
        corners.pop();
    };
    half(&mut order.iter());
    half(&mut order.iter().rev());
    if corners.is_empty() { order.into_iter().take(1).collect() } else { corners }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_is_as_wide_as_its_least_height() {
        let points = [(0.0, 0.0), (4.0, 0.0), (0.0, 3.0), (1.0, 1.0)].map(|(x, y)| Point::new(x, y));
        let strip = Strip::enclosing(&points);
        assert!((strip.width - 2.4).abs() < 1e-15 && (strip.length - 5.0).abs() < 1e-15, "{strip:?}");
    }

    #[test]
    fn few_points_and_equal_points_have_no_width() {
        let p = Point::new(1.0, 2.0);
        for points in [vec![p], vec![p; 5], vec![p, Point::new(2.0, 2.0), p, Point::new(1.5, 2.0)]] {
            let strip = Strip::enclosing(&points);
            assert!(strip.width == 0.0 && (0.0..=1.0).contains(&strip.length), "{points:?} {strip:?}");
        }
    }
}

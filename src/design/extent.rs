//! The extent of a linkage.

use coupler_curves::geometry::{Point, Vector, trig};

/// The greatest distance between any two of some points. The pair that is furthest apart along each of 60 directions is
/// found; from the best pair the search continues in the direction of the pair itself. Points that are not finite are
/// ignored.
pub(super) fn greatest_distance(points: &[Point]) -> f64 {
    const DIRECTIONS: usize = 60;
    let furthest = |along: Vector| {
        let mut low = (f64::INFINITY, Point::origin());
        let mut high = (f64::NEG_INFINITY, Point::origin());
        for p in points.iter().filter(|p| p.x.is_finite() && p.y.is_finite()) {
            let position = along.dot(&p.coords);
            if position < low.0 {
                low = (position, *p);
            }
            if position > high.0 {
                high = (position, *p);
            }
        }
        high.1 - low.1
    };
    let direction = |k: usize| {
        let (cos, sin) = trig::cos_sin_deg(180.0 * k as f64 / DIRECTIONS as f64);
        furthest(Vector::new(cos, sin))
    };
    let mut pair = Vector::zeros();
    for found in (0..DIRECTIONS).map(direction) {
        if found.norm() > pair.norm() {
            pair = found;
        }
    }
    loop {
        let next = furthest(pair);
        if next.norm() <= pair.norm() {
            return pair.norm();
        }
        pair = next;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_furthest_pair_is_found() {
        let spiral = |k: usize| {
            let (cos, sin) = trig::cos_sin_deg(37.0 * k as f64);
            Point::new(k as f64 * cos + 0.3 * k as f64, k as f64 * sin)
        };
        for n in [1, 2, 5, 40, 300] {
            let points: Vec<Point> = (0..n).map(spiral).collect();
            let all = points.iter().flat_map(|a| points.iter().map(move |b| (a - b).norm())).fold(0.0, f64::max);
            assert!(
                (greatest_distance(&points) - all).abs() <= 1e-12 * all,
                "{n}: {} {all}",
                greatest_distance(&points)
            );
        }
    }
}

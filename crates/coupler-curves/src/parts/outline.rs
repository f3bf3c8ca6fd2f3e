//! Outlines of lines and arcs: what is within a distance of some points and of all that is between them.

use crate::geometry::{Bounds, Complex, Point, Similarity, Vector, cross};

/// A closed line.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// A circle.
    Circle {
        /// Its centre.
        centre: Point,
        /// Its radius.
        radius: f64,
    },
    /// Lines and arcs, counter-clockwise; the last vertex is followed by the first.
    Path(Vec<Vertex>),
}

/// A vertex of an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Where it is.
    pub at: Point,
    /// The bulge of what leads to the next vertex: the tangent of a quarter of the angle of an arc, positive to the left; 0 for a line.
    pub bulge: f64,
}

/// What is within a distance of some points and of all that is between them: a capsule of two points, a circle of one.
pub fn rounded_hull(points: &[Point], radius: f64) -> Outline {
    let hull = convex_hull(points);
    let [first, _, ..] = &hull[..] else {
        return Outline::Circle { centre: hull.first().copied().unwrap_or(Point::origin()), radius };
    };
    let next = |k: usize| hull.get(k + 1).unwrap_or(first);
    let direction = |k: usize| (next(k) - hull[k]).normalize();
    // To the right of the way around, which is outside.
    let outward = |direction: Vector| Vector::new(direction.y, -direction.x) * radius;
    let mut vertices = Vec::new();
    for k in 0..hull.len() {
        let (along, after) = (direction(k), direction((k + 1) % hull.len()));
        vertices.push(Vertex { at: hull[k] + outward(along), bulge: 0.0 });
        vertices.push(Vertex { at: next(k) + outward(along), bulge: bulge_between(along, after) });
    }
    Outline::Path(vertices)
}

/// The tangent of a quarter of the angle by which one unit vector is turned to the left to become another.
fn bulge_between(from: Vector, to: Vector) -> f64 {
    // Twice the sine and the cosine of half the angle, each to its last digits.
    let (sin, cos) = ((to - from).norm(), (to + from).norm());
    sin / (cos + (sin * sin + cos * cos).sqrt())
}

/// The corners of the convex hull, counter-clockwise; points on its sides are none, nor are points that coincide.
fn convex_hull(points: &[Point]) -> Vec<Point> {
    /// Of points on a line, relative to their extent.
    const ROUNDING: f64 = 1e-12;
    let extent = Bounds::from_points(points.iter().copied()).size().norm();
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    sorted.dedup_by(|a, b| (*a - *b).norm() <= ROUNDING * extent);
    if sorted.len() < 3 {
        return sorted;
    }
    let half = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for p in points {
            let turns_left = |chain: &[Point]| match chain {
                [.., a, b] => cross(b - a, p - b) > ROUNDING * extent * extent,
                _ => true,
            };
            while !turns_left(&chain) {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut sorted.iter().copied());
    hull.extend(half(&mut sorted.iter().rev().copied()));
    hull
}

impl Outline {
    /// The same outline elsewhere; the transform neither mirrors nor scales.
    pub fn transformed(&self, transform: &Similarity) -> Outline {
        match self {
            Outline::Circle { centre, radius } => Outline::Circle { centre: transform.apply(*centre), radius: *radius },
            Outline::Path(vertices) => Outline::Path(
                vertices.iter().map(|vertex| Vertex { at: transform.apply(vertex.at), bulge: vertex.bulge }).collect(),
            ),
        }
    }

    /// Its bounds, which also contain what an arc has beyond its ends.
    pub fn bounds(&self) -> Bounds {
        let around = |centre: Point, radius: f64| [centre - Vector::repeat(radius), centre + Vector::repeat(radius)];
        match self {
            Outline::Circle { centre, radius } => Bounds::from_points(around(*centre, *radius)),
            Outline::Path(vertices) => {
                let mut bounds = Bounds::from_points(vertices.iter().map(|vertex| vertex.at));
                // The arcs are around the corners of a convex hull: its circles are within the outline.
                for (centre, radius) in self.arcs().into_iter().map(|arc| (arc.0, arc.1)) {
                    around(centre, radius).into_iter().for_each(|p| bounds.include(p));
                }
                bounds
            }
        }
    }

    /// The centre and the radius of each arc.
    pub fn arcs(&self) -> Vec<(Point, f64)> {
        let Outline::Path(vertices) = self else { return Vec::new() };
        let arc = |k: usize| {
            let (from, bulge) = (vertices[k].at, vertices[k].bulge);
            let chord = vertices[(k + 1) % vertices.len()].at - from;
            let to_centre = Complex::new(0.5, (1.0 - bulge * bulge) / (4.0 * bulge)) * Complex::new(chord.x, chord.y);
            let centre = from + Vector::new(to_centre.re, to_centre.im);
            (centre, (from - centre).norm())
        };
        (0..vertices.len()).filter(|&k| vertices[k].bulge != 0.0).map(arc).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::trig;

    #[test]
    fn a_bar_is_a_capsule_a_point_a_circle_and_a_plate_has_round_corners() {
        let [a, b, c] = [Point::new(0.0, 0.0), Point::new(4.0, 0.0), Point::new(4.0, 3.0)];
        assert_eq!(rounded_hull(&[a], 0.5), Outline::Circle { centre: a, radius: 0.5 });
        let Outline::Path(capsule) = rounded_hull(&[b, a, Point::new(2.0, 0.0)], 0.5) else { panic!("a capsule") };
        let vertex = |x: f64, y: f64, bulge: f64| Vertex { at: Point::new(x, y), bulge };
        assert_eq!(
            capsule,
            [vertex(0.0, -0.5, 0.0), vertex(4.0, -0.5, 1.0), vertex(4.0, 0.5, 0.0), vertex(0.0, 0.5, 1.0)]
        );
        let plate = rounded_hull(&[a, b, c, Point::new(3.0, 1.0)], 0.5);
        let Outline::Path(vertices) = &plate else { panic!("a plate") };
        let angles: f64 = vertices.iter().map(|vertex| 4.0 * trig::atan2(vertex.bulge, 1.0)).sum();
        assert!(
            (angles - std::f64::consts::TAU).abs() < 1e-14,
            "the arcs of a convex outline are a full turn together"
        );
        for ((centre, radius), corner) in plate.arcs().into_iter().zip([b, c, a]) {
            assert!((centre - corner).norm() < 1e-14 && (radius - 0.5).abs() < 1e-14, "{centre}");
        }
        let bounds = plate.bounds();
        assert!(
            (bounds.min - Point::new(-0.5, -0.5)).norm() < 1e-14 && (bounds.max - Point::new(4.5, 3.5)).norm() < 1e-14
        );
    }
}

//! Products, normals and distances.

use super::{Point, Vector};

/// The vector rotated a quarter turn counter-clockwise: the positive normal of its direction, with the same length.
#[inline]
pub fn left_normal(v: Vector) -> Vector {
    Vector::new(-v.y, v.x)
}

/// The curvature of the path of a point with a velocity and an acceleration, positive to the left; not finite where the velocity
/// is zero.
#[inline]
pub fn curvature(velocity: Vector, acceleration: Vector) -> f64 {
    let speed = velocity.norm();
    cross(velocity, acceleration) / (speed * speed * speed)
}

/// The product of two vectors as complex numbers: `b` rotated by the angle of `a` and scaled by its length.
#[inline]
pub fn complex_product(a: Vector, b: Vector) -> Vector {
    Vector::new(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x)
}

/// The cross product `a.x b.y - a.y b.x`: positive when `b` points to the left of `a`.
#[inline]
pub fn cross(a: Vector, b: Vector) -> f64 {
    a.x * b.y - a.y * b.x
}

/// The distance of `p` from the segment `a b`; from `a` if the segment has length 0.
#[inline]
pub fn distance_to_segment(p: Point, a: Point, b: Point) -> f64 {
    let direction = b - a;
    let length_squared = direction.norm_squared();
    if length_squared == 0.0 {
        return (p - a).norm();
    }
    let t = ((p - a).dot(&direction) / length_squared).clamp(0.0, 1.0);
    (p - (a + direction * t)).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn left_is_the_side_of_the_positive_normal() {
        let east = Vector::new(1.0, 0.0);
        assert_eq!(left_normal(east), Vector::new(0.0, 1.0));
        assert!(cross(east, Vector::new(0.0, 1.0)) > 0.0);
    }

    #[test]
    fn the_nearest_point_of_a_segment_may_be_an_end() {
        let (a, b) = (Point::new(0.0, 0.0), Point::new(2.0, 0.0));
        assert_eq!(distance_to_segment(Point::new(1.0, 3.0), a, b), 3.0);
        assert_eq!(distance_to_segment(Point::new(5.0, 4.0), a, b), 5.0);
        assert_eq!(distance_to_segment(Point::new(3.0, 4.0), a, a), 5.0);
    }
}

use super::{Point, Vector, trig};

/// Where a drawing is laid in the plane: mirrored about the x-axis or not, then turned about the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orientation {
    is_mirrored: bool,
    /// Where the x-axis goes.
    axis: Vector,
}

impl Default for Orientation {
    /// As it is.
    fn default() -> Orientation {
        Orientation { is_mirrored: false, axis: Vector::new(1.0, 0.0) }
    }
}

impl Orientation {
    /// Mirrored about the x-axis or not, then turned counter-clockwise by so many degrees.
    pub fn new(mirrored: bool, turned_deg: f64) -> Orientation {
        let (cos, sin) = trig::cos_sin_deg(turned_deg);
        Orientation { is_mirrored: mirrored, axis: Vector::new(cos, sin) }
    }

    /// Where a vector goes.
    pub fn transform_vector(&self, v: Vector) -> Vector {
        let (cos, sin) = (self.axis.x, self.axis.y);
        let y = if self.is_mirrored { -v.y } else { v.y };
        Vector::new(cos * v.x - sin * y, sin * v.x + cos * y)
    }

    /// Where a point goes.
    pub fn transform_point(&self, p: Point) -> Point {
        Point::from(self.transform_vector(p.coords))
    }

    /// 1, or -1 where left becomes right: what angles are multiplied by.
    pub fn handedness(&self) -> f64 {
        if self.is_mirrored { -1.0 } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_mirrored_first_and_then_turned() {
        let p = Point::new(2.0, 1.0);
        assert_eq!(Orientation::default().transform_point(p), p);
        assert_eq!(Orientation::new(false, 90.0).transform_point(p), Point::new(-1.0, 2.0));
        assert_eq!(Orientation::new(true, 90.0).transform_point(p), Point::new(1.0, 2.0));
    }
}

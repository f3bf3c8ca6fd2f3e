use super::{Point, Vector, trig};

/// The orientation of a linkage in the plane: mirrored about the x-axis or not, then rotated about the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orientation {
    is_mirrored: bool,
    /// The image of the unit vector along x.
    axis: Vector,
}

impl Default for Orientation {
    /// Neither mirrored nor rotated.
    fn default() -> Orientation {
        Orientation { is_mirrored: false, axis: Vector::new(1.0, 0.0) }
    }
}

impl Orientation {
    /// Mirrored about the x-axis or not, then rotated counter-clockwise by an angle in degrees.
    pub fn new(is_mirrored: bool, rotation_deg: f64) -> Orientation {
        let (cos, sin) = trig::cos_sin_deg(rotation_deg);
        Orientation { is_mirrored, axis: Vector::new(cos, sin) }
    }

    /// The image of a vector.
    #[inline]
    pub fn transform_vector(&self, v: Vector) -> Vector {
        let (cos, sin) = (self.axis.x, self.axis.y);
        let y = if self.is_mirrored { -v.y } else { v.y };
        Vector::new(cos * v.x - sin * y, sin * v.x + cos * y)
    }

    /// The vector whose image this is.
    pub(crate) fn original_vector(&self, image: Vector) -> Vector {
        let (cos, sin) = (self.axis.x, self.axis.y);
        let (x, y) = (cos * image.x + sin * image.y, cos * image.y - sin * image.x);
        Vector::new(x, if self.is_mirrored { -y } else { y })
    }

    /// The image of a point.
    #[inline]
    pub fn transform_point(&self, p: Point) -> Point {
        Point::from(self.transform_vector(p.coords))
    }

    /// The rotation in degrees, above -180 up to 180, to nine decimal places if that gives the same orientation: these are likely the
    /// digits that it was made from.
    pub fn rotation_deg(&self) -> f64 {
        // The sine of half a turn may be -0.
        let deg = trig::degrees(trig::atan2(self.axis.y + 0.0, self.axis.x));
        let rounded = (deg * 1e9).round() / 1e9 + 0.0;
        if Orientation::new(self.is_mirrored, rounded) == *self { rounded } else { deg }
    }

    /// The factor of angles: 1, or -1 if mirrored.
    pub fn handedness(&self) -> f64 {
        if self.is_mirrored { -1.0 } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mirroring_precedes_rotation() {
        let p = Point::new(2.0, 1.0);
        assert_eq!(Orientation::default().transform_point(p), p);
        assert_eq!(Orientation::new(false, 90.0).transform_point(p), Point::new(-1.0, 2.0));
        assert_eq!(Orientation::new(true, 90.0).transform_point(p), Point::new(1.0, 2.0));
        let turned = Orientation::new(true, 30.0);
        assert!((turned.original_vector(turned.transform_vector(p.coords)) - p.coords).norm() < 1e-15);
        for deg in [0.0, 90.0, -30.1, 123.456789, 180.0] {
            assert_eq!(Orientation::new(true, deg).rotation_deg(), deg);
        }
    }
}

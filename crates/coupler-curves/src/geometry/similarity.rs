use super::{Bounds, Point, Vector, trig};

/// A point or a vector of the plane as a complex number.
pub type Complex = nalgebra::Complex<f64>;

/// A similarity of the plane: a reflection in the x-axis or none, then a rotation with a scale, then a translation.
///
/// A transform is named by its two spaces, target first: `page_from_plane` maps plane units to millimetres on paper,
/// and is the only place where y up (plane) becomes y down (page).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Similarity {
    /// Whether y changes its sign first.
    pub is_mirrored: bool,
    /// What 1 becomes then, but for the translation: the scale in the direction of the rotation.
    pub factor: Complex,
    /// The image of the origin, in target units.
    pub shift: Complex,
}

impl Similarity {
    /// That which leaves everything in its place.
    pub const IDENTITY: Similarity =
        Similarity { is_mirrored: false, factor: Complex::new(1.0, 0.0), shift: Complex::new(0.0, 0.0) };

    /// The transform to a plane with y down, at `scale` target units per source unit, with the image of the source's origin.
    pub fn with_y_down(scale: f64, origin: Point) -> Similarity {
        Similarity { is_mirrored: true, factor: Complex::new(scale, 0.0), shift: Complex::new(origin.x, origin.y) }
    }

    /// The transform that maps the centre of `plane` (y up) to `centre` on the page (y down), at `scale` mm per unit.
    pub fn page_from_plane(plane: Bounds, centre: Point, scale: f64) -> Similarity {
        let c = plane.centre();
        Similarity::with_y_down(scale, centre - Vector::new(c.x, -c.y) * scale)
    }

    /// Target units per source unit, not negative.
    #[inline]
    pub fn scale(&self) -> f64 {
        self.factor.norm_sqr().sqrt()
    }

    /// The rotation after the reflection, in degrees, counter-clockwise, from -180 to 180.
    pub fn rotation_deg(&self) -> f64 {
        trig::degrees(trig::atan2(self.factor.im, self.factor.re))
    }

    /// The image of the source's origin.
    pub fn origin(&self) -> Point {
        Point::new(self.shift.re, self.shift.im)
    }

    /// The image of a point.
    #[inline]
    pub fn apply(&self, p: Point) -> Point {
        let z = self.image(Complex::new(p.x, p.y));
        Point::new(z.re, z.im)
    }

    /// The image of a point.
    #[inline]
    pub fn image(&self, z: Complex) -> Complex {
        self.direction(z) + self.shift
    }

    /// The image of a vector.
    #[inline]
    pub fn direction(&self, z: Complex) -> Complex {
        self.factor * self.reflected(z)
    }

    /// The point whose image another one is.
    #[inline]
    pub fn preimage(&self, z: Complex) -> Complex {
        self.reflected((z - self.shift) / self.factor)
    }

    /// The similarity that takes images back.
    pub fn inverse(&self) -> Similarity {
        let factor = self.reflected(self.factor.inv());
        Similarity { is_mirrored: self.is_mirrored, factor, shift: -self.reflected(self.shift / self.factor) }
    }

    /// Another similarity, and then this one.
    pub fn after(&self, first: &Similarity) -> Similarity {
        Similarity {
            is_mirrored: self.is_mirrored != first.is_mirrored,
            factor: self.direction(first.factor),
            shift: self.image(first.shift),
        }
    }

    /// A vector after the reflection.
    #[inline]
    pub fn reflected(&self, z: Complex) -> Complex {
        if self.is_mirrored { z.conj() } else { z }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_has_y_down_and_keeps_the_centre() {
        let plane = Bounds::from_points([Point::new(1.0, 1.0), Point::new(3.0, 5.0)]);
        let page_from_plane = Similarity::page_from_plane(plane, Point::new(100.0, 50.0), 10.0);
        assert_eq!(page_from_plane.apply(Point::new(2.0, 3.0)), Point::new(100.0, 50.0));
        assert_eq!(page_from_plane.apply(Point::new(3.0, 5.0)), Point::new(110.0, 30.0));
    }

    #[test]
    fn a_point_is_reflected_turned_scaled_and_moved() {
        let similarity =
            Similarity { is_mirrored: true, factor: Complex::new(0.0, 2.0), shift: Complex::new(10.0, 20.0) };
        assert_eq!(similarity.apply(Point::new(3.0, 4.0)), Point::new(18.0, 26.0));
        assert_eq!(similarity.preimage(Complex::new(18.0, 26.0)), Complex::new(3.0, 4.0));
        assert_eq!((similarity.scale(), similarity.rotation_deg()), (2.0, 90.0));
        assert_eq!(similarity.inverse().apply(Point::new(18.0, 26.0)), Point::new(3.0, 4.0));
        assert_eq!(similarity.after(&similarity.inverse()), Similarity::IDENTITY);
        let other = Similarity { factor: Complex::new(1.0, -1.0), ..similarity };
        for one in [similarity, other] {
            let p = Point::new(-2.0, 5.0);
            assert_eq!(one.after(&other).apply(p), one.apply(other.apply(p)));
        }
    }
}

use super::{Point, Vector};

/// The smallest axis-parallel rectangle around some points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The lower left corner.
    pub min: Point,
    /// The upper right corner.
    pub max: Point,
}

impl Bounds {
    /// The bounds of no points, to be extended by [`Bounds::include`].
    pub const EMPTY: Bounds =
        Bounds { min: Point::new(f64::INFINITY, f64::INFINITY), max: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY) };

    /// The bounds of all finite points of `points`.
    pub fn from_points(points: impl IntoIterator<Item = Point>) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        for p in points {
            bounds.include(p);
        }
        bounds
    }

    /// Extends the bounds to contain `p`; a point that is not finite is ignored.
    #[inline]
    pub fn include(&mut self, p: Point) {
        if p.x.is_finite() && p.y.is_finite() {
            self.min = self.min.inf(&p);
            self.max = self.max.sup(&p);
        }
    }

    /// The bounds of both.
    #[inline]
    pub fn union(self, other: Bounds) -> Bounds {
        Bounds { min: self.min.inf(&other.min), max: self.max.sup(&other.max) }
    }

    /// Whether no point was included.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.min.x > self.max.x
    }

    /// The width and the height; zero if empty.
    #[inline]
    pub fn size(&self) -> Vector {
        if self.is_empty() { Vector::zeros() } else { self.max - self.min }
    }

    /// The centre; the origin if empty.
    #[inline]
    pub fn centre(&self) -> Point {
        if self.is_empty() { Point::origin() } else { nalgebra::center(&self.min, &self.max) }
    }
}

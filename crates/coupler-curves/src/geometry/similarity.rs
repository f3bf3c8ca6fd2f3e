use super::{Bounds, Point, Vector};

/// A similarity without rotation: a scale, optionally a reflection of y, and a translation.
///
/// A transform is named by its two spaces, target first: `page_from_plane` maps plane units to millimetres on paper,
/// and is the only place where y up (plane) becomes y down (page).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Similarity {
    /// Target units per source unit, positive.
    pub scale: f64,
    /// Whether y changes sign.
    pub flips_y: bool,
    /// The image of the source's origin.
    pub origin: Point,
}

impl Similarity {
    /// The transform that maps the centre of `plane` (y up) to `centre` on the page (y down), at `scale` mm per unit.
    pub fn page_from_plane(plane: Bounds, centre: Point, scale: f64) -> Similarity {
        let c = plane.centre();
        Similarity { scale, flips_y: true, origin: centre - Vector::new(c.x, -c.y) * scale }
    }

    /// The image of a point.
    #[inline]
    pub fn apply(&self, p: Point) -> Point {
        let y = if self.flips_y { -p.y } else { p.y };
        self.origin + Vector::new(p.x, y) * self.scale
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
}

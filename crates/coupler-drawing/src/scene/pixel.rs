//! Pixels: the unit of a scene's layout, 1/100 mm.

use coupler_curves::geometry::Point;

/// A position in pixels.
pub(crate) type Pixel = (i32, i32);

/// Pixels per millimetre.
pub(crate) const PER_MM: f64 = 100.0;

/// A length in millimetres in pixels, rounded.
pub(crate) fn from_millimetres(mm: f64) -> i32 {
    (mm * PER_MM).round() as i32
}

/// A position in pixels in millimetres.
pub(crate) fn to_millimetres((x, y): Pixel) -> Point {
    Point::new(f64::from(x) / PER_MM, f64::from(y) / PER_MM)
}

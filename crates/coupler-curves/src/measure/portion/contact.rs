//! Where a curve touches a line or a circle of a family.

use crate::geometry::{Point, Vector};

/// A family of parallel lines or concentric circles.
pub trait Levels {
    /// The height of a point: which line or circle it is on.
    fn height(&self, point: Point) -> f64;

    /// Replaces `heights` with those of points.
    fn collect_heights(&self, points: &[Point], heights: &mut Vec<f64>) {
        heights.clear();
        heights.extend(points.iter().map(|point| self.height(*point)));
    }

    /// The first and the second derivative of the height of a moving point, from its velocity and its acceleration.
    fn height_rates(&self, point: Point, velocity: Vector, acceleration: Vector) -> [f64; 2];
}

/// A point of a portion where the curve touches a line or a circle: an extreme, a corner or an end.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// The index of the point in the portion.
    pub index: usize,
    /// Its position, in units of the spacing.
    pub at: f64,
    pub point: Point,
    /// The velocity and the acceleration there; `None` for an end or a corner, which stays where it is.
    pub rates: Option<[Vector; 2]>,
}

impl Contact {
    /// The point, moved to where the curve touches one of the levels.
    pub fn touching(&self, levels: &dyn Levels) -> Point {
        self.touching_and_height(levels).0
    }

    /// The point, moved to where the curve touches one of the levels, and the height of that level.
    pub fn touching_and_height(&self, levels: &dyn Levels) -> (Point, f64) {
        let height = levels.height(self.point);
        let Some([velocity, acceleration]) = self.rates else { return (self.point, height) };
        let rates = levels.height_rates(self.point, velocity, acceleration);
        let step = stationary(rates);
        // It is not near if the step is long.
        let step = if step.abs() <= 1.0 { step } else { 0.0 };
        // The height of the vertex of a parabola is that of its tangent halfway to it.
        (self.point + velocity * step + acceleration * (step * step / 2.0), height + rates[0] * step / 2.0)
    }

    /// Whether it is less than a part of the distance of two points to where the curve touches one of the levels.
    pub fn is_within(&self, part: f64, levels: &dyn Levels) -> bool {
        let step = |[velocity, acceleration]: [Vector; 2]| vertex(levels, self.point, velocity, acceleration);
        self.rates.is_none_or(|rates| step(rates).abs() < part)
    }
}

/// How far it is to where the height of a moving point is stationary.
pub fn vertex(levels: &dyn Levels, point: Point, velocity: Vector, acceleration: Vector) -> f64 {
    stationary(levels.height_rates(point, velocity, acceleration))
}

/// How far it is to where a height with a first and a second derivative is stationary; 0 if that is nowhere.
fn stationary([first, second]: [f64; 2]) -> f64 {
    let step = -first / second;
    if step.is_finite() { step } else { 0.0 }
}

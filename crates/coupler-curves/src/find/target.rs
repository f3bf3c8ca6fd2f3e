//! The path that a linkage is searched for.

use super::complex::{Complex, closed_length, mean};
use crate::geometry::Point;

/// The points that a closed curve is to pass, in their order, round and round.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    points: Vec<Point>,
    size: f64,
    centre: Complex,
}

/// Why points are no target.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TargetError {
    /// A coordinate is not finite.
    #[error("point {number} of the target is ({x}, {y}), which is not finite")]
    NotFinite {
        /// The number of the point, from 1.
        number: usize,
        /// Its first coordinate.
        x: f64,
        /// Its second coordinate.
        y: f64,
    },
    /// There are too few points.
    #[error("the target has {distinct} distinct points, and needs at least {}", Target::MIN_POINTS)]
    TooFew {
        /// The number of distinct points.
        distinct: usize,
    },
    /// All points are in one place, to rounding.
    #[error("the target has no extent: its points are within rounding of ({x}, {y})")]
    NoExtent {
        /// The first coordinate of that place.
        x: f64,
        /// The second coordinate.
        y: f64,
    },
}

impl Target {
    /// The least number of distinct points.
    pub const MIN_POINTS: usize = 5;

    /// A target with points in any unit and axes. Of points that follow each other in one place the first is kept, also round
    /// the end.
    ///
    /// # Errors
    /// A coordinate is not finite, there are fewer than [`Target::MIN_POINTS`] distinct points, or they have no extent.
    pub fn new(points: &[Point]) -> Result<Target, TargetError> {
        /// Coordinates are known to this part of their greatest.
        const ROUNDING: f64 = 1e-13;
        if let Some(k) = points.iter().position(|p| !(p.x.is_finite() && p.y.is_finite())) {
            return Err(TargetError::NotFinite { number: k + 1, x: points[k].x, y: points[k].y });
        }
        let mut points = points.to_vec();
        points.dedup();
        while points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        let mut sorted: Vec<[f64; 2]> = points.iter().map(|p| [p.x + 0.0, p.y + 0.0]).collect();
        sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        sorted.dedup();
        if sorted.len() < Target::MIN_POINTS {
            return Err(TargetError::TooFew { distinct: sorted.len() });
        }
        let values: Vec<Complex> = points.iter().map(|p| Complex::new(p.x, p.y)).collect();
        let centre = mean(&values);
        let size = (values.iter().map(|z| (z - centre).norm_sqr()).sum::<f64>() / values.len() as f64).sqrt();
        let greatest = values.iter().map(|z| z.re.abs().max(z.im.abs())).fold(0.0, f64::max);
        if size.is_nan() || size <= ROUNDING * greatest || !size.is_normal() {
            return Err(TargetError::NoExtent { x: centre.re, y: centre.im });
        }
        Ok(Target { points, size, centre })
    }

    /// The points.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// The size S: the root of the mean square of the distances from the centroid, in the unit of the points.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// The factor and the shift of the similarity from the normalized points, of centroid 0 and size 1, to the points.
    pub(super) fn placement(&self) -> (f64, Complex) {
        (self.size, self.centre)
    }

    /// The points with centroid 0 and size 1.
    pub(super) fn normalized(&self) -> Vec<Complex> {
        self.points.iter().map(|p| (Complex::new(p.x, p.y) - self.centre) / self.size).collect()
    }

    /// The length of the closed polyline through the points, in sizes of the target.
    pub(super) fn polygon_length(&self) -> f64 {
        closed_length(&self.normalized())
    }
}

//! The path that a linkage is searched for.

use crate::complex::{Complex, closed_length, mean, open_length};
use crate::shape::spectrum::{Transform, smooth_open_length};
use coupler_curves::geometry::{Point, Similarity};

/// What a curve has in common with a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathKind {
    /// The curve passes the closed path without long detours.
    Closed,
    /// The curve passes the points in their order, whatever it does between them and elsewhere.
    Open,
    /// A part of the curve passes the open path without long detours.
    Part,
}

impl PathKind {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            PathKind::Closed => "closed",
            PathKind::Open => "open",
            PathKind::Part => "part",
        }
    }
}

/// The points that a curve is to pass, in their order.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    points: Vec<Point>,
    kind: PathKind,
    size: f64,
    centre: Complex,
    /// The angle of the crank at each point, up to an offset and the direction, if they are timed.
    angles_deg: Option<Vec<f64>>,
}

/// Why points are no target.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TargetError {
    /// A coordinate is not finite.
    #[error("point {number} of the path is ({x}, {y}), which is not finite")]
    NotFinite {
        /// The number of the point, from 1.
        number: usize,
        /// Its first coordinate.
        x: f64,
        /// Its second coordinate.
        y: f64,
    },
    /// There are too few points.
    #[error(
        "the path needs at least {} distinct points, and has {distinct}: through fewer pass the curves of infinitely many four-bars; add points between them, in their order",
        Target::MIN_POINTS
    )]
    TooFew {
        /// The number of distinct points.
        distinct: usize,
    },
    /// An angle is not finite.
    #[error("the angle of point {number} of the path is {angle}, which is not finite")]
    AngleNotFinite {
        /// The number of the point, from 1.
        number: usize,
        /// The angle in degrees.
        angle: f64,
    },
    /// There is not an angle for each point.
    #[error("the path has {points} points and {angles} angles")]
    AnglesMissing {
        /// The number of points.
        points: usize,
        /// The number of angles.
        angles: usize,
    },
    /// All points have one angle.
    #[error("all points of the path have the angle {angle}°: the crank does not move")]
    SameAngle {
        /// The angle in degrees.
        angle: f64,
    },
    /// All points are in one place, to rounding.
    #[error("the path has no extent: its points are within rounding of ({x}, {y})")]
    NoExtent {
        /// The first coordinate of that place.
        x: f64,
        /// The second coordinate.
        y: f64,
    },
}

/// The greatest length that the curve of an answer, or its portion, may have relative to that of the target without its noise: longer ones
/// have detours between its points. One that is shorter cuts corners, which its deviation tells.
pub const MAX_LENGTH_RATIO: f64 = 1.15;

impl Target {
    /// The least number of distinct points.
    pub const MIN_POINTS: usize = 5;

    /// A target with points in any unit and axes. Of points that follow each other in one place the first is kept, in a closed
    /// path also round the end.
    ///
    /// # Errors
    /// A coordinate is not finite, there are fewer than [`Target::MIN_POINTS`] distinct points, or they have no extent.
    pub fn new(points: &[Point], kind: PathKind) -> Result<Target, TargetError> {
        /// Coordinates are known to this part of their greatest.
        const ROUNDING: f64 = 1e-13;
        if let Some(k) = points.iter().position(|p| !(p.x.is_finite() && p.y.is_finite())) {
            return Err(TargetError::NotFinite { number: k + 1, x: points[k].x, y: points[k].y });
        }
        let mut points = points.to_vec();
        points.dedup();
        while kind == PathKind::Closed && points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        let mut sorted: Vec<[f64; 2]> = points.iter().map(|p| [p.x + 0.0, p.y + 0.0]).collect();
        sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        sorted.dedup();
        if sorted.len() < Target::MIN_POINTS {
            return Err(TargetError::TooFew { distinct: sorted.len() });
        }
        let values: Vec<Complex> = points.iter().map(|p| Complex::new(p.x, p.y)).collect();
        let (size, centre) = size_and_centre(&values);
        let greatest = values.iter().map(|z| z.re.abs().max(z.im.abs())).fold(0.0, f64::max);
        if size.is_nan() || size <= ROUNDING * greatest || !size.is_normal() {
            return Err(TargetError::NoExtent { x: centre.re, y: centre.im });
        }
        Ok(Target { points, kind, size, centre, angles_deg: None })
    }

    /// A target that a curve passes without long detours and that ends where it begins, see [`Target::new`].
    ///
    /// # Errors
    /// As of [`Target::new`].
    pub fn closed(points: &[Point]) -> Result<Target, TargetError> {
        Target::new(points, PathKind::Closed)
    }

    /// A target of which a curve passes the points in their order, whatever it does between them, see [`Target::new`].
    ///
    /// # Errors
    /// As of [`Target::new`].
    pub fn open(points: &[Point]) -> Result<Target, TargetError> {
        Target::new(points, PathKind::Open)
    }

    /// A target that a portion of a curve passes without long detours, see [`Target::new`].
    ///
    /// # Errors
    /// As of [`Target::new`].
    pub fn part(points: &[Point]) -> Result<Target, TargetError> {
        Target::new(points, PathKind::Part)
    }

    /// A timed target: the angle in degrees by which the crank has turned at each point, up to a common offset and the direction. All
    /// points are kept.
    ///
    /// # Errors
    /// As of [`Target::new`], or there is not a finite angle for each point, or all are the same.
    pub fn timed(points: &[Point], kind: PathKind, angles_deg: &[f64]) -> Result<Target, TargetError> {
        let distinct = Target::new(points, kind)?;
        if points.len() != angles_deg.len() {
            return Err(TargetError::AnglesMissing { points: points.len(), angles: angles_deg.len() });
        }
        if let Some(k) = angles_deg.iter().position(|angle| !angle.is_finite()) {
            return Err(TargetError::AngleNotFinite { number: k + 1, angle: angles_deg[k] });
        }
        if angles_deg.iter().all(|angle| *angle == angles_deg[0]) {
            return Err(TargetError::SameAngle { angle: angles_deg[0] });
        }
        let values: Vec<Complex> = points.iter().map(|p| Complex::new(p.x, p.y)).collect();
        let (size, centre) = size_and_centre(&values);
        Ok(Target { points: points.to_vec(), size, centre, angles_deg: Some(angles_deg.to_vec()), ..distinct })
    }

    /// The angles of the crank at the points in degrees, up to a common offset and the direction, if they are timed.
    pub fn angles_deg(&self) -> Option<&[f64]> {
        self.angles_deg.as_deref()
    }

    /// What a curve is to have in common with it.
    pub fn kind(&self) -> PathKind {
        self.kind
    }

    /// The same points in the same order, of which the curve is to pass only these.
    pub fn opened(&self) -> Target {
        Target { kind: PathKind::Open, ..self.clone() }
    }

    /// The points.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// The size S: the root of the mean square of the distances from the centroid, in the unit of the points.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// The similarity from the normalized points, of centroid 0 and size 1, to the points.
    pub(crate) fn placement(&self) -> Similarity {
        Similarity { is_mirrored: false, factor: Complex::new(self.size, 0.0), shift: self.centre }
    }

    /// The points with centroid 0 and size 1.
    pub(crate) fn normalized(&self) -> Vec<Complex> {
        self.points.iter().map(|p| (Complex::new(p.x, p.y) - self.centre) / self.size).collect()
    }

    /// The length of the polyline through the points, in sizes of the target.
    pub(crate) fn polyline_length(&self) -> f64 {
        match self.kind {
            PathKind::Closed => closed_length(&self.normalized()),
            PathKind::Open | PathKind::Part => open_length(&self.normalized()),
        }
    }

    /// The greatest length of a curve, or of its portion, that has no long detours from the path, in sizes of the target; infinite if
    /// only the points count.
    pub(crate) fn greatest_length(&self) -> f64 {
        if self.kind == PathKind::Open { f64::INFINITY } else { MAX_LENGTH_RATIO * self.smooth_length() }
    }

    /// The length of the path without its noise, in sizes of the target: that of the lowest harmonics of the polyline through its points. Noise is spread over all harmonics, of which the higher ones are most of the length of a noisy polyline.
    pub(crate) fn smooth_length(&self) -> f64 {
        match self.kind {
            PathKind::Closed => Transform::new().length(&self.normalized()),
            PathKind::Open | PathKind::Part => smooth_open_length(&self.normalized()),
        }
    }
}

/// The root of the mean square of the distances of some points from their centroid, and that.
fn size_and_centre(points: &[Complex]) -> (f64, Complex) {
    let centre = mean(points);
    let square = points.iter().map(|z| (z - centre).norm_sqr()).sum::<f64>() / points.len() as f64;
    (square.sqrt(), centre)
}

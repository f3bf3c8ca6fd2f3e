//! The poses that a body is to pass.

use crate::complex::{Complex, unit};
use coupler_curves::geometry::{Point, trig};

/// A pose of a body: the place of its point, and the angle by which it is turned from the x-axis, in degrees, counterclockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyPose {
    /// Where the body's point is.
    pub point: Point,
    /// How far the body is turned, in degrees, of any number of turns.
    pub angle_deg: f64,
}

/// Poses of a body, in the order in which it is to pass them: 2 to [`PoseSet::MAX`], all different.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseSet {
    poses: Vec<BodyPose>,
    centre: Complex,
    size: f64,
    placed: Vec<Placed>,
}

/// What is wrong with some poses. They are numbered from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PoseError {
    /// There are none, or one.
    #[error("it has {}: give 2 or more", if *count == 0 { "no pose".to_owned() } else { format!("{count} pose") })]
    TooFew {
        /// How many there are.
        count: usize,
    },
    /// There are more than [`PoseSet::MAX`].
    #[error("it has {count} poses: give at most {}", PoseSet::MAX)]
    TooMany {
        /// How many there are.
        count: usize,
    },
    /// A number is infinite or not a number.
    #[error(
        "pose {number} is {x}, {y}, {angle_deg}°: its numbers must be finite, and its angle at most {MAX_ANGLE}° in size"
    )]
    NotFinite {
        /// The number of the pose.
        number: usize,
        /// Its place.
        x: f64,
        /// Its place.
        y: f64,
        /// Its angle in degrees.
        angle_deg: f64,
    },
    /// A pose is repeated.
    #[error("poses {} and {} are the same: leave one out", numbers[0], numbers[1])]
    Equal {
        /// Their numbers.
        numbers: [usize; 2],
    },
    /// All points are in one place.
    #[error(
        "the point of the body is at the same place in all poses, so that the body only turns about it: a pivot there does it; or choose another point of the body"
    )]
    OnlyTurns,
    /// Lengths are so great or so small that their squares are beyond double precision.
    #[error("the poses are {size:e} apart: choose another unit")]
    Size {
        /// The root mean square distance of the points from their middle.
        size: f64,
    },
}

/// The greatest angle in degrees: beyond it the last digits of an angle are coarser than its equations are solved.
const MAX_ANGLE: f64 = 1e6;

/// A pose as the displacement of the body's frame, in sizes of the set from its middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Placed {
    /// Where the body's point is.
    pub point: Complex,
    /// The direction of the body's x-axis, of length 1.
    pub direction: Complex,
}

impl Placed {
    /// Where a point of the body is.
    pub fn apply(&self, of_body: Complex) -> Complex {
        self.point + self.direction * of_body
    }

    /// The point of the body that is at a place.
    pub fn of_body(&self, place: Complex) -> Complex {
        self.direction.conj() * (place - self.point)
    }
}

impl PoseSet {
    /// The most poses.
    pub const MAX: usize = 1000;

    /// Checks poses.
    ///
    /// # Errors
    /// All that is wrong with them.
    pub fn new(poses: &[BodyPose]) -> Result<PoseSet, Vec<PoseError>> {
        /// Lengths whose fourth powers, which the equations have, are in double precision.
        const SIZES: std::ops::RangeInclusive<f64> = 1e-60..=1e60;
        let count = poses.len();
        if count < 2 {
            return Err(vec![PoseError::TooFew { count }]);
        }
        if count > PoseSet::MAX {
            return Err(vec![PoseError::TooMany { count }]);
        }
        let is_finite =
            |pose: &BodyPose| pose.point.x.is_finite() && pose.point.y.is_finite() && pose.angle_deg.abs() <= MAX_ANGLE;
        let mut errors: Vec<PoseError> = (1..)
            .zip(poses)
            .filter(|(_, pose)| !is_finite(pose))
            .map(|(number, BodyPose { point, angle_deg })| PoseError::NotFinite {
                number,
                x: point.x,
                y: point.y,
                angle_deg: *angle_deg,
            })
            .collect();
        errors.extend(equal_pairs(poses).into_iter().map(|numbers| PoseError::Equal { numbers }));
        if !errors.is_empty() {
            return Err(errors);
        }
        let points: Vec<Complex> = poses.iter().map(|pose| Complex::new(pose.point.x, pose.point.y)).collect();
        let centre = points.iter().map(|p| p / count as f64).sum::<Complex>();
        // In units of the greatest distance, whose squares are in double precision.
        let greatest = points.iter().flat_map(|p| [(p - centre).re.abs(), (p - centre).im.abs()]).fold(0.0, f64::max);
        let extent = points.iter().flat_map(|p| [p.re.abs(), p.im.abs()]).fold(0.0, f64::max);
        // Places that differ in the last digits only are the same.
        if greatest <= 1e-14 * extent || greatest == 0.0 {
            return Err(vec![PoseError::OnlyTurns]);
        }
        let squares = points.iter().map(|p| ((p - centre) / greatest).norm_sqr()).sum::<f64>() / count as f64;
        let size = greatest * squares.sqrt();
        if !SIZES.contains(&size) {
            return Err(vec![PoseError::Size { size }]);
        }
        let placed = points.iter().zip(poses).map(|(p, pose)| Placed {
            point: (p - centre) / size,
            direction: unit(trig::radians(pose.angle_deg.rem_euclid(360.0))),
        });
        Ok(PoseSet { placed: placed.collect(), poses: poses.to_vec(), centre, size })
    }

    /// The poses.
    pub fn poses(&self) -> &[BodyPose] {
        &self.poses
    }

    /// The size S: the root mean square distance of the points from their middle.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// The poses in sizes of the set from its middle.
    pub(crate) fn placed(&self) -> &[Placed] {
        &self.placed
    }

    /// A place of the plane from one in sizes of the set from its middle.
    pub(crate) fn place(&self, z: Complex) -> Point {
        let z = self.centre + z * self.size;
        Point::new(z.re, z.im)
    }

    /// A place in sizes of the set from its middle.
    pub(crate) fn relative(&self, p: Point) -> Complex {
        (Complex::new(p.x, p.y) - self.centre) / self.size
    }
}

/// The numbers of poses that are the same.
fn equal_pairs(poses: &[BodyPose]) -> Vec<[usize; 2]> {
    let are_equal = |a: &BodyPose, b: &BodyPose| {
        let turn = (a.angle_deg - b.angle_deg).rem_euclid(360.0);
        // Angles of a few turns are exact to some 1e-13 of a degree.
        a.point == b.point && turn.min(360.0 - turn) <= 1e-10
    };
    let later = |k: usize| (k + 1..poses.len()).map(move |m| [k, m]);
    let pairs = (0..poses.len()).flat_map(later).filter(|[k, m]| are_equal(&poses[*k], &poses[*m]));
    pairs.map(|pair| pair.map(|k| k + 1)).collect()
}

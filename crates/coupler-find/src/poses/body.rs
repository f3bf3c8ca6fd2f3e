//! The poses that a body is to pass.

use crate::complex::{Complex, unit};
use coupler_curves::exchange::format_significant;
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
    /// The body only turns about a point, which no coupler does.
    #[error(
        "the body only turns about ({}, {}), from each pose to the others: a pivot there does it, and no coupler",
        format_significant(about.x, 6, 0.0),
        format_significant(about.y, 6, 0.0)
    )]
    OnlyTurns {
        /// The point.
        about: Point,
    },
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

/// The pole of two poses: the place about which the body turns from one to the other; `None` if it does not turn.
pub(super) fn pole([a, b]: [&Placed; 2]) -> Option<Complex> {
    /// The pole of a smaller turn is as good as at infinity.
    const NO_TURN: f64 = 1e-9;
    let turn = b.direction * a.direction.conj();
    let rest = Complex::new(1.0, 0.0) - turn;
    (rest.norm_sqr() > NO_TURN * NO_TURN).then(|| (b.point - turn * a.point) / rest)
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
            return Err(vec![PoseError::OnlyTurns { about: poses[0].point }]);
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
        let set = PoseSet { placed: placed.collect(), poses: poses.to_vec(), centre, size };
        match set.common_pole() {
            Some(about) => Err(vec![PoseError::OnlyTurns { about }]),
            None => Ok(set),
        }
    }

    /// The point about which the body turns from each pose to all others, if there are three or more.
    fn common_pole(&self) -> Option<Point> {
        /// In sizes of the poses.
        const SAME: f64 = 1e-9;
        let first = self.placed.first().filter(|_| self.placed.len() > 2)?;
        let turned = self.placed.iter().map(|pose| (pose.direction - first.direction).norm_sqr());
        let farthest = turned.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?.0;
        let about = pole([first, &self.placed[farthest]])?;
        let of_body = first.of_body(about);
        let rests = |pose: &Placed| (pose.apply(of_body) - about).norm_sqr() <= SAME * SAME;
        // What is 0 but for rounding is 0, for people to read.
        let rounded = |value: f64| if value.abs() <= SAME * self.size { 0.0 } else { value };
        let place = self.place(about);
        self.placed.iter().all(rests).then(|| Point::new(rounded(place.x), rounded(place.y)))
    }

    /// Whether the body has one direction in all poses.
    pub fn is_translation(&self) -> bool {
        /// In radians.
        const SAME: f64 = 1e-9;
        let first = self.placed[0].direction;
        self.placed.iter().all(|pose| (pose.direction - first).norm_sqr() <= SAME * SAME)
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

/// Poses of random four-bars.
#[cfg(test)]
pub(super) mod random {
    use super::{BodyPose, PoseSet};
    use crate::complex::{Complex, length, unit};
    use crate::scatter::Scatter;
    use coupler_curves::geometry::{Point, trig};

    /// Poses of the coupler of a random four-bar on one branch, at rising angles of its crank; and its two dyads, each the pivot and the pin
    /// in the first pose, in sizes of the poses.
    pub fn random_poses(count: usize, seed: u64) -> (PoseSet, [[Complex; 2]; 2]) {
        let mut scatter = Scatter::new(seed);
        loop {
            let mut point = || Complex::new(scatter.normal(1.0), scatter.normal(1.0));
            let pivots = [point(), point()];
            let [across, of_body] = [point(), point()];
            let lengths = point();
            let (crank, rocker, coupler) = (0.3 + lengths.re.abs(), 0.5 + lengths.im.abs(), 0.5 + length(across));
            let start = scatter.normal(3.0);
            let step = 0.3 + scatter.normal(0.4).abs();
            let pose = |k: f64| {
                let a = pivots[0] + unit(start + step * k) * crank;
                let base = pivots[1] - a;
                let square = base.norm_sqr();
                let along = (coupler * coupler - rocker * rocker + square) / (2.0 * square);
                let height = coupler * coupler / square - along * along;
                (height > 0.01).then(|| {
                    let b = a + base * Complex::new(along, height.sqrt());
                    [a, b]
                })
            };
            // Assembled between the poses, too.
            const BETWEEN: usize = 40;
            let all = (0..=BETWEEN * (count - 1)).map(|k| pose(k as f64 / BETWEEN as f64));
            let Some(all) = all.collect::<Option<Vec<_>>>() else { continue };
            if step * count as f64 > 6.0 {
                continue;
            }
            let pins: Vec<[Complex; 2]> = all.into_iter().step_by(BETWEEN).collect();
            let body = |[a, b]: &[Complex; 2]| {
                let along = (b - a) / coupler;
                let p = a + along * of_body;
                BodyPose { point: Point::new(p.re, p.im), angle_deg: trig::degrees(trig::atan2(along.im, along.re)) }
            };
            let poses: Vec<BodyPose> = pins.iter().map(body).collect();
            let set = PoseSet::new(&poses).expect("they differ");
            let relative = |z: Complex| set.relative(Point::new(z.re, z.im));
            let dyads = [0, 1].map(|k| [relative(pivots[k]), relative(pins[0][k])]);
            return (set, dyads);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn errors(poses: &[[f64; 3]]) -> Vec<String> {
        let poses = poses.iter().map(|[x, y, angle_deg]| BodyPose { point: Point::new(*x, *y), angle_deg: *angle_deg });
        let result = PoseSet::new(&poses.collect::<Vec<_>>());
        result.map_or_else(|errors| errors.iter().map(ToString::to_string).collect(), |_| Vec::new())
    }

    #[test]
    fn poses_that_cannot_be_searched_for_are_named() {
        assert_eq!(errors(&[]), ["it has no pose: give 2 or more"]);
        assert_eq!(errors(&[[1.0, 2.0, 3.0]]), ["it has 1 pose: give 2 or more"]);
        assert_eq!(errors(&[[0.0, 0.0, 0.0]; 1001]), ["it has 1001 poses: give at most 1000"]);
        let several = [[1.0, 2.0, 3.0], [1.0, 2.0, 723.0], [f64::NAN, 0.0, 0.0], [0.0, 0.0, 1e7]];
        let found = errors(&several);
        assert_eq!(found.len(), 3, "{found:?}");
        assert!(found[0].starts_with("pose 3 is NaN") && found[1].starts_with("pose 4 is"), "{found:?}");
        assert_eq!(found[2], "poses 1 and 2 are the same: leave one out");
        let turns =
            "the body only turns about (1, 2), from each pose to the others: a pivot there does it, and no coupler";
        assert_eq!(errors(&[[1.0, 2.0, 0.0], [1.0, 2.0, 40.0], [1.0, 2.0, 70.0]]), [turns]);
        assert_eq!(errors(&[[4.0, 2.0, 0.0], [1.0, 5.0, 90.0], [-2.0, 2.0, 180.0]]), [turns]);
        assert!(errors(&[[4.0, 2.0, 0.0], [1.0, 5.0, 90.0], [-2.0, 2.0, 181.0]]).is_empty());
        assert!(errors(&[[1e70, 0.0, 0.0], [-1e70, 0.0, 90.0]])[0].contains("choose another unit"));
    }
}

//! Timed targets: points that the coupler point reaches at given angles of the crank, up to an offset and the direction.

use std::sync::Arc;

use crate::complex::{Complex, dot, length, mean, open_length, turned, unit};
use crate::four_bar::matching::Matching;
use crate::four_bar::nearest_pose::PoseRates;
use crate::four_bar::parameters::Parameters;
use crate::four_bar::pose::Pose;
use crate::timing::{TimedPlace, TimedPoints, TimedRow};
use coupler_curves::geometry::{Point, Vector, cross};

/// The angles from the crank at the first point of a target to that at each.
#[derive(Clone, Debug)]
pub(crate) struct Timing {
    /// In radians; in the other direction they have the other sign.
    angles: Arc<[f64]>,
    /// The same as vectors of length 1.
    turns: Arc<[Complex]>,
}

/// The number of rounds in which the offset follows a linkage.
const OFFSET_ROUNDS: usize = 4;

/// That for the final offset.
const FINAL_ROUNDS: usize = 20;

impl Timing {
    /// The timing of angles in degrees, forward and backward.
    pub fn both(angles_deg: &[f64]) -> [Timing; 2] {
        let first = angles_deg.first().copied().unwrap_or(0.0);
        [1.0, -1.0].map(|sign| {
            let angles: Vec<f64> = angles_deg.iter().map(|angle| sign * (angle - first).to_radians()).collect();
            let turns = angles.iter().map(|angle| unit(*angle)).collect();
            Timing { angles: angles.into(), turns }
        })
    }

    /// The poses of a linkage with its crank in a direction at the first point, all on one side; `None` if it does not reach one of
    /// them.
    fn poses(&self, linkage: &Parameters, first: Complex, side: f64) -> Option<Vec<Pose>> {
        self.turns.iter().map(|turn| linkage.assemble(first * turn, side)).collect()
    }

    /// A linkage where it is nearest to a target, of those with the crank near one of some directions, which are equally spaced over a turn; with
    /// its poses.
    pub fn placed_best(
        [forward, backward]: &[Timing; 2],
        target: &TimedPoints,
        linkage: &Parameters,
        directions: &[Complex],
    ) -> Option<(Timing, Parameters, Vec<Pose>)> {
        let step_deg = 360.0 / directions.len() as f64;
        let of_side = |side: f64| {
            let missing = Complex::new(f64::NAN, f64::NAN);
            let at =
                |crank: &Complex| linkage.assemble(*crank, side).map_or(missing, |pose| linkage.coupler_point(&pose));
            let points: Vec<Complex> = directions.iter().map(at).collect();
            let place = target.best_place(&TimedRow { points: &points, step_deg, is_whole: true })?;
            Some((side, place))
        };
        let found = [1.0, -1.0].into_iter().filter_map(of_side);
        let (side, TimedPlace { placed, is_reversed, first, .. }) =
            found.reduce(|best, other| if other.1.sum < best.1.sum { other } else { best })?;
        // A reflection exchanges the sides, and the directions of turning.
        let side = if placed.is_mirrored { -side } else { side };
        let timing = if is_reversed == placed.is_mirrored { forward } else { backward };
        let linkage = linkage.transformed(&placed);
        let crank = placed.direction(directions[first]) / placed.scale();
        let poses = timing.poses(&linkage, crank, side)?;
        Some((timing.clone(), linkage, poses))
    }

    /// The poses in which a linkage is nearest to a target, near those of a linkage like it, and the sum of the squares of the
    /// distances.
    pub fn feet(&self, linkage: &Parameters, near: &[Pose], target: &[Complex]) -> Option<(Vec<Pose>, f64)> {
        self.nearest(linkage, near, target, OFFSET_ROUNDS)
    }

    fn nearest(
        &self,
        linkage: &Parameters,
        near: &[Pose],
        target: &[Complex],
        rounds: usize,
    ) -> Option<(Vec<Pose>, f64)> {
        let mut first = near.first()?.crank;
        let side = side_of(linkage, &near[0]);
        let sum_of = |poses: &[Pose]| -> f64 {
            poses.iter().zip(target).map(|(pose, point)| (point - linkage.coupler_point(pose)).norm_sqr()).sum()
        };
        let mut poses = self.poses(linkage, first, side)?;
        let mut sum = sum_of(&poses);
        for _ in 0..rounds {
            let (mut slope, mut square) = (0.0, 0.0);
            for (pose, point) in poses.iter().zip(target) {
                let rates = PoseRates::new(linkage, pose);
                let velocity = velocity(&rates);
                slope += dot(point - rates.at, velocity);
                square += velocity.norm_sqr();
            }
            let next = turned(first, slope / square.max(f64::MIN_POSITIVE));
            let Some(moved) = self.poses(linkage, next, side) else { break };
            let less = sum_of(&moved);
            if less.is_nan() || less >= sum {
                break;
            }
            (first, poses, sum) = (next, moved, less);
        }
        Some((poses, sum))
    }

    /// The points of the curve at which a linkage reaches those of a target.
    pub fn matching(&self, linkage: &Parameters, near: &[Pose], target: &[Complex]) -> Option<Matching> {
        /// The parts of the motion between two points, to measure its length.
        const PARTS: usize = 16;
        let (poses, sum) = self.nearest(linkage, near, target, FINAL_ROUNDS)?;
        let side = side_of(linkage, &poses[0]);
        let between = self.angles.windows(2).flat_map(|pair| {
            let [from, to] = [pair[0], pair[1]];
            (0..=PARTS).map(move |part| from + (to - from) * part as f64 / PARTS as f64)
        });
        let passed = between.filter_map(|angle| linkage.assemble(poses[0].crank * unit(angle), side));
        let portion_length = open_length(&passed.map(|pose| linkage.coupler_point(&pose)).collect::<Vec<_>>());
        let squares = poses.iter().zip(target).map(|(pose, point)| (point - linkage.coupler_point(pose)).norm_sqr());
        let greatest = squares.fold(0.0, f64::max).sqrt();
        Some(Matching { means: target.to_vec(), poses, portion_length, sum, greatest, is_in_order: true })
    }

    /// Whether a crank with its pivot at a point has this timing, in either direction, if its pin is at these points.
    pub fn is_kept(&self, pivot: Point, pins: impl Iterator<Item = Point>) -> bool {
        /// In radians: a cognate's crank turns as this one or not at all as fast.
        const ROUNDING: f64 = 1e-6;
        let arms: Vec<Complex> = pins.map(|pin| pin - pivot).map(|v: Vector| Complex::new(v.x, v.y)).collect();
        let keeps = |is_backward: bool| {
            let turn = |turn: &Complex| if is_backward { turn.conj() } else { *turn };
            let firsts: Vec<Complex> =
                arms.iter().zip(self.turns.iter()).map(|(arm, t)| arm * turn(t).conj() / length(*arm)).collect();
            let mean = mean(&firsts);
            firsts.iter().all(|first| length(first - mean) <= ROUNDING)
        };
        keeps(false) || keeps(true)
    }
}

/// The side of the line from the crank pin to the rocker's pivot on which the rocker pin is, 1 for the left and -1 for the right.
fn side_of(linkage: &Parameters, pose: &Pose) -> f64 {
    let to_pivot = linkage.frame * linkage.direction - linkage.crank * pose.crank;
    let [a, b] = [to_pivot, pose.coupler].map(|z| Vector::new(z.re, z.im));
    if cross(a, b) < 0.0 { -1.0 } else { 1.0 }
}

/// The velocity of the coupler point per radian of the crank.
pub(crate) fn velocity(rates: &PoseRates) -> Complex {
    rates.by_angles[0] - rates.by_angles[1] * (rates.closure[0] / closure_rate(rates))
}

/// The derivative of the closure with respect to the coupler's angle, which vanishes at a limit of the crank, where the linkage
/// cannot keep its timing.
pub(crate) fn closure_rate(rates: &PoseRates) -> f64 {
    let rate = rates.closure[1];
    if rate == 0.0 { f64::MIN_POSITIVE } else { rate }
}

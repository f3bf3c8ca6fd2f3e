//! The matching of a target with the curve of a four-bar: each point has its own point of the curve, in order.

use crate::complex::{self, Complex, open_length};
use crate::four_bar::parameters::Parameters;
use crate::four_bar::pose::Pose;
use crate::matching::{feet_in_order, feet_of_points, match_places};

/// The points of a closed row of samples that are nearest to the points of a target in the mean square, see [`match_places`].
fn match_in_order(target: &[Complex], samples: &[Complex]) -> Option<(f64, Vec<usize>)> {
    match_places((target.len(), usize::MAX), samples.len(), |k, j| (samples[j] - target[k]).norm_sqr())
}

/// The samples of a circuit that are matched with a target in order, and the sum of the squares of their distances.
pub(crate) fn nearest_samples(linkage: &Parameters, circuit: &[Pose], target: &[Complex]) -> Option<(f64, Vec<Pose>)> {
    let (sum, path) = match_in_order(target, &linkage.curve(circuit))?;
    Some((sum, path.iter().map(|k| circuit[k % circuit.len()]).collect()))
}

/// The points of a curve that are matched with those of a target.
pub(crate) struct Matching {
    /// The pose for each point of the target.
    pub poses: Vec<Pose>,
    /// For each point the mean of those that share its pose: the sum of the squares of the distances from it differs from that of
    /// the points by a constant.
    pub means: Vec<Complex>,
    /// The length of the curve from the first of the poses to the last.
    pub portion_length: f64,
    /// The sum of the squares of the distances.
    pub sum: f64,
    /// The greatest distance.
    pub greatest: f64,
    /// Whether each point is matched with the nearest part of the curve, without the order keeping it from there.
    pub is_in_order: bool,
}

/// A point of a curve that is nearest to another point: its pose, near which of the samples, and its position in samples.
#[derive(Clone, Copy)]
struct Foot {
    pose: Pose,
    near: usize,
    position: f64,
}

/// The number of Newton rounds for a foot of a perpendicular.
const ROUNDS: usize = 20;

impl Matching {
    /// The matching of a target with a circuit of a linkage, given by samples of it.
    pub fn new(linkage: &Parameters, circuit: &[Pose], target: &[Complex]) -> Option<Matching> {
        let (_, path) = match_in_order(target, &linkage.curve(circuit))?;
        Matching::in_order(linkage, circuit, (target, &path))
    }

    /// The matching from a path of samples.
    fn in_order(linkage: &Parameters, circuit: &[Pose], (target, path): (&[Complex], &[usize])) -> Option<Matching> {
        let foot = |point: Complex, pose: Pose, near: usize| {
            let (pose, _) = linkage.nearest(pose, point, ROUNDS);
            Foot { pose, near, position: position(circuit, near, &pose) }
        };
        let first = target.iter().zip(path).map(|(point, near)| foot(*point, circuit[near % circuit.len()], *near));
        let near = |mean, last: Foot| Some(foot(mean, last.pose, last.near));
        let blocks = feet_in_order(target, first, |foot| foot.position, near)?;
        let is_in_order = blocks.len() == target.len();
        let poses: Vec<Pose> = feet_of_points(&blocks).map(|foot| foot.pose).collect();
        let means = blocks.iter().flat_map(|block| std::iter::repeat_n(block.mean, block.points.len())).collect();
        let squares = poses.iter().zip(target).map(|(pose, point)| (point - linkage.coupler_point(pose)).norm_sqr());
        let (sum, greatest) = squares.fold((0.0, 0.0f64), |(sum, most), square| (sum + square, most.max(square)));
        let ends = [&blocks[0], &blocks[blocks.len() - 1]].map(|block| block.foot.position);
        let portion_length = portion_length(&linkage.curve(circuit), ends);
        Some(Matching { poses, means, portion_length, sum, greatest: greatest.sqrt(), is_in_order })
    }
}

/// The length of the closed polyline through samples between two positions, of which the second is at most a round after the first.
fn portion_length(samples: &[Complex], [from, to]: [f64; 2]) -> f64 {
    let at = |position: f64| {
        let (sample, part) = (position.floor(), position - position.floor());
        let point = |k: f64| samples[(k as i64).rem_euclid(samples.len() as i64) as usize];
        point(sample) + (point(sample + 1.0) - point(sample)) * part
    };
    let between = (from.ceil() as i64..=to.floor() as i64).map(|k| at(k as f64));
    let points: Vec<Complex> = std::iter::once(at(from)).chain(between).chain([at(to)]).collect();
    open_length(&points)
}

/// The position of a pose along a circuit near one of its samples, in samples.
fn position(circuit: &[Pose], near: usize, pose: &Pose) -> f64 {
    let count = circuit.len();
    let offset = |from: &Pose, to: &Pose| [to.crank - from.crank, to.coupler - from.coupler];
    let dot = |a: &[Complex; 2], b: &[Complex; 2]| -> f64 { a.iter().zip(b).map(|(a, b)| complex::dot(*a, *b)).sum() };
    // From sample to sample towards the pose, which is beyond one and before the next.
    let mut at = near + count;
    for _ in 0..count {
        let here = &circuit[at % count];
        let [ahead, behind] = [at + 1, at + count - 1].map(|k| offset(here, &circuit[k % count]));
        let to = offset(here, pose);
        let forward = dot(&to, &ahead) / dot(&ahead, &ahead).max(f64::MIN_POSITIVE);
        let backward = dot(&to, &behind) / dot(&behind, &behind).max(f64::MIN_POSITIVE);
        if forward > 1.0 {
            at += 1;
        } else if backward > 1.0 {
            at -= 1;
        } else {
            let part = if forward >= backward { forward.max(0.0) } else { -backward.max(0.0) };
            return at as f64 - count as f64 + part;
        }
    }
    near as f64
}

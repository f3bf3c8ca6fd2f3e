//! Linkages that differ.

use super::answer::PoseAnswer;
use super::body::PoseSet;
use crate::complex::{Complex, length};

/// The pins at the first pose and the pivots of an answer, in sizes of the poses.
pub(super) fn joints(set: &PoseSet, answer: &PoseAnswer) -> Vec<Complex> {
    let points = answer.pins[0].into_iter().chain(answer.guide.pivots());
    points.map(|p| set.relative(p)).collect()
}

/// Whether two answers are of different forms, or have different joints.
pub(super) fn are_different(set: &PoseSet, a: &PoseAnswer, b: &PoseAnswer) -> bool {
    a.guide.form() != b.guide.form() || are_apart(&joints(set, a), &joints(set, b))
}

/// Whether joints of linkages are not all near each other, also if the crank of one is the rocker of the other.
pub(super) fn are_apart(a: &[Complex], b: &[Complex]) -> bool {
    /// In sizes of the poses, and in parts of the distance of the joints.
    const APART: f64 = 0.25;
    const PART: f64 = 0.15;
    let extent = a.iter().map(|z| length(z - a[0])).fold(0.0, f64::max);
    let apart = APART.max(PART * extent);
    let is_near = |order: [usize; 4]| {
        let pairs = order.iter().enumerate().take(a.len());
        pairs.into_iter().all(|(k, m)| length(a[k] - b[*m]) < apart)
    };
    a.len() != b.len() || !(is_near([0, 1, 2, 3]) || a.len() == 4 && is_near([1, 0, 3, 2]))
}

//! The matching of points with a row of places, and with a curve: each has its own place, in order.

use std::ops::Range;

use crate::complex::{Complex, mean};

/// The places of a closed row that are nearest to points in the mean square, in their order and within one round: indices that do
/// not fall, of which the last is at most a round after the first; they may be in the second round. With the sum of the squares, each of
/// which `square` gives for a point and a place; `None` without places.
pub(crate) fn match_places(
    (points, most_starts): (usize, usize),
    count: usize,
    square: impl Fn(usize, usize) -> f64,
) -> Option<(f64, Vec<usize>)> {
    let (sum, free) = best_path((points, count, 2 * count), &square, 0..count)?;
    let (first, last) = (*free.first()?, *free.last()?);
    if last <= first + count {
        return Some((sum, free));
    }
    // Rarely the best path is longer than a round. Then each start is tried that is nearest to the first point among its
    // neighbours.
    let first_square = |k: usize| square(0, k % count);
    let is_near =
        |k: &usize| first_square(*k) <= first_square(k + 1) && first_square(*k) <= first_square(k + count - 1);
    let mut starts: Vec<usize> = (0..count).filter(is_near).collect();
    starts.sort_by(|a, b| first_square(*a).total_cmp(&first_square(*b)));
    starts.truncate(most_starts);
    let from = |start: usize| best_path((points, count, 2 * count), &square, start..start + 1);
    let paths = starts.into_iter().filter_map(from);
    paths.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// The same for a row that is open.
pub(crate) fn match_open_places(
    points: usize,
    count: usize,
    square: impl Fn(usize, usize) -> f64,
) -> Option<(f64, Vec<usize>)> {
    best_path((points, count, count), square, 0..count)
}

/// The indices that do not fall and have the least sum of squares, the first of which is in a range; if that is a single
/// index, they end at most a round after it. With that sum. Where places are as near but for rounding, as on a straight portion that is
/// passed there and back, they are those that are least apart.
fn best_path(
    (points, count, rounds): (usize, usize, usize),
    square: impl Fn(usize, usize) -> f64,
    starts: std::ops::Range<usize>,
) -> Option<(f64, Vec<usize>)> {
    /// Sums that differ by less are equal but for rounding: points have a mean square of 1.
    const ROUNDING: f64 = 1e-14;
    let end = if starts.len() == 1 { starts.start + count } else { rounds.checked_sub(1)? };
    let place = |j: usize| if j < count { j } else { j - count };
    // In each row, for each place, the least sum of squares of the points before the row's that are at it or before; in the first, where the
    // first point may be.
    let mut least = vec![f64::INFINITY; (points + 1) * rounds];
    least[starts].fill(0.0);
    let mut squares = vec![0.0; count];
    for k in 0..points {
        squares.iter_mut().enumerate().for_each(|(j, value)| *value = square(k, j));
        let (before, after) = least[k * rounds..(k + 2) * rounds].split_at_mut(rounds);
        let mut best = f64::INFINITY;
        for (j, (before, after)) in before.iter().zip(after).enumerate() {
            best = best.min(before + squares[place(j)]);
            *after = best;
        }
    }
    let row = |k: usize| &least[k * rounds..(k + 1) * rounds];
    let is_best = |k: usize, j: usize, best: f64| row(k)[j] + square(k, place(j)) <= best + ROUNDING;
    let mut best = row(points)[end];
    let last = points.checked_sub(1).filter(|_| best.is_finite())?;
    let mut path = vec![0; points];
    path[last] = (0..=end).find(|j| is_best(last, *j, best))?;
    let sum = row(last)[path[last]] + square(last, place(path[last]));
    for k in (0..last).rev() {
        best = row(k + 1)[path[k + 1]];
        path[k] = (0..=path[k + 1]).rev().find(|j| is_best(k, *j, best))?;
    }
    Some((sum, path))
}

/// Points that follow each other and share a place on a curve, the foot of their mean.
#[derive(Clone, Debug)]
pub(crate) struct Block<F> {
    pub points: Range<usize>,
    pub mean: Complex,
    pub foot: F,
}

/// The feet of points in their order, from the foot of each. Where those of neighbours would change it, these share the foot of their mean: of
/// all common feet it has the least sum of squares (pool adjacent violators).
///
/// `position` is how far along the curve a foot is, and `foot_near` the foot of a mean near another one.
pub(crate) fn feet_in_order<F>(
    points: &[Complex],
    feet: impl IntoIterator<Item = F>,
    position: impl Fn(&F) -> f64,
    mut foot_near: impl FnMut(Complex, F) -> Option<F>,
) -> Option<Vec<Block<F>>> {
    let mut blocks: Vec<Block<F>> = Vec::with_capacity(points.len());
    for (k, foot) in feet.into_iter().enumerate() {
        let mut block = Block { points: k..k + 1, mean: points[k], foot };
        while let Some(last) = blocks.pop_if(|last| position(&last.foot) > position(&block.foot)) {
            let points_of = last.points.start..block.points.end;
            let mean = mean(&points[points_of.clone()]);
            block = Block { points: points_of, mean, foot: foot_near(mean, last.foot)? };
        }
        blocks.push(block);
    }
    Some(blocks)
}

/// The foot of each point.
pub(crate) fn feet_of_points<F: Clone>(blocks: &[Block<F>]) -> impl Iterator<Item = F> {
    blocks.iter().flat_map(|block| std::iter::repeat_n(block.foot.clone(), block.points.len()))
}

/// The squares of the distances of points from the points of a curve at the feet of their blocks.
pub(crate) fn squares<F>(points: &[Complex], blocks: &[Block<F>], at: &[Complex]) -> Vec<f64> {
    let mut squares = Vec::with_capacity(points.len());
    for (block, at) in blocks.iter().zip(at) {
        squares.extend(points[block.points.clone()].iter().map(|point| (point - at).norm_sqr()));
    }
    squares
}

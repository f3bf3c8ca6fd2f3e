//! The search for the portions of a curve that are longest, of those that are as straight or as circular as is required.
//!
//! The longest portion contains one from point to point of the curve, which satisfies what is required too, and is
//! shorter by no more than the curve from the points before and after it. So the longest of these from each point, so
//! extended, is a bound of all portions that begin there; where the bound is greatest the ends are moved along the curve
//! to where the portion is longest, until no bound is greater than what has been found. The points are as far apart as
//! the portion found allows.

use super::every_nth::EveryNth;
use super::longest_near::Reached;
use super::row::Row;
use crate::geometry::in_rising_order;
use crate::measure::budget::{Steps, TooManySteps};
use crate::measure::rounding::within_period;

/// A requirement of portions, and what of them is to be greatest.
pub trait Requirement {
    /// An upper bound of the size of the portions that begin at a point or between it and the one before, and the last
    /// point of the longest; `None` if it is less than `least`. That of the start before is where it is likely.
    fn longest_from(&self, points: &EveryNth, from: usize, least: f64, likely: usize) -> Option<(f64, usize)>;

    /// Whether the bounds are certain for any points, so that what a few of them rule out need not be looked at again, and
    /// vary so smoothly that the longest portion begins next to a start with a greater bound than its neighbours.
    const HAS_CERTAIN_BOUNDS: bool;

    /// Points between the ends of a portion, at least, where bounds are not much greater than what they bound.
    const FEW: f64;

    /// Two portions whose sizes differ by less than this part are equally long: more than the error of either.
    const EQUAL: f64;

    /// What a portion has the more of the longer it is, up to each point.
    fn quantity<'p>(&self, points: &'p EveryNth) -> &'p [f64];

    /// The longest portion near one between two positions of the row, unless it is certainly shorter than `least`; no
    /// further away than `reach`.
    fn longest_near(&self, ends: [f64; 2], reach: f64, least: f64) -> Reached;

    /// The ends of a portion without what may be cut off at them while its size remains.
    fn without_excess(&self, ends: [f64; 2]) -> [f64; 2] {
        ends
    }
}

/// The ends of the longest portions that are longer than `least`: of several equally long ones, which do not overlap,
/// all, in the order of the input at which they begin. `steps` are those that the requirement takes.
///
/// # Errors
/// It has taken too many.
pub fn longest<R: Requirement>(
    row: &Row,
    requirement: &R,
    least: f64,
    steps: &Steps,
) -> Result<Vec<[f64; 2]>, TooManySteps> {
    /// Every so many points are enough for a first guess, or as many as leave [`MOST`] of them.
    const COARSE: usize = 8;
    /// The most candidates. Only of a curve that is mostly rounding are there more.
    const MOST: usize = 256;
    let mut search = Search { requirement, best: least, found: Vec::new() };
    let coarse = COARSE.max((row.start_count / MOST).next_power_of_two());
    let mut points = row.every_nth(coarse);
    let mut starts: Vec<usize> = (0..points.start_count).collect();
    loop {
        // The longer the portion that has been found, the fewer points there need be.
        let span = search.found.last().map_or(0.0, |(_, [from, to])| to - from);
        let fewest = 1 << ((span / R::FEW).max(1.0) as usize).ilog2().min(coarse.ilog2());
        let is_last = points.stride <= fewest;
        let candidates = search.candidates(points, &starts);
        search.extend_candidates(points, &candidates, if is_last { MOST } else { 1 });
        steps.check()?;
        if is_last {
            break;
        }
        let finer = row.every_nth(if R::HAS_CERTAIN_BOUNDS { points.stride / 2 } else { fewest });
        starts = (0..finer.start_count).collect();
        if R::HAS_CERTAIN_BOUNDS {
            // Where a portion may still be longer, the bounds of more starts are less.
            let mut may_begin = vec![false; points.start_count];
            let remaining = candidates.iter().filter(|(bound, _)| *bound >= search.least());
            remaining.for_each(|(_, [from, _])| may_begin[*from] = true);
            let after = |start: usize| finer.positions[start].div_ceil(points.stride) % points.start_count;
            starts.retain(|start| may_begin[after(*start)]);
        }
        points = finer;
    }
    let Search { best, found, .. } = search;
    let longest = found.into_iter().filter(|(size, _)| *size >= best * (1.0 - R::EQUAL)).map(|(_, ends)| ends);
    Ok(distinct(row, different(longest).into_iter().map(|ends| requirement.without_excess(ends)).collect()))
}

struct Search<'a, R> {
    requirement: &'a R,
    /// The size of the longest so far, or what it must exceed.
    best: f64,
    /// The portions so far, with their sizes.
    found: Vec<(f64, [f64; 2])>,
}

impl<R: Requirement> Search<'_, R> {
    /// The size that portions must have.
    fn least(&self) -> f64 {
        self.best * (1.0 - R::EQUAL)
    }

    /// The bounds of the portions that begin at some points, and the points of the longest, the greatest first.
    fn candidates(&self, points: &EveryNth, starts: &[usize]) -> Vec<(f64, [usize; 2])> {
        let mut likely = 0;
        let candidate = |from: &usize| {
            let (bound, to) = self.requirement.longest_from(points, *from, self.least(), likely)?;
            likely = to;
            Some((bound, [*from, to]))
        };
        in_rising_order(starts.iter().filter_map(candidate).collect(), |candidate| -candidate.0)
    }

    /// Moves the ends of the most promising portions from point to point, no more than `limit`, to where they are longest.
    fn extend_candidates(&mut self, points: &EveryNth, candidates: &[(f64, [usize; 2])], limit: usize) {
        let mut is_covered = vec![false; points.start_count];
        let quantity = self.requirement.quantity(points);
        let mean_step = quantity[points.start_count] / points.start_count as f64;
        let mut bounds = vec![0.0; points.start_count];
        candidates.iter().for_each(|(bound, [from, _])| bounds[*from] = *bound);
        let is_peak = |from: usize| {
            let n = points.start_count;
            !R::HAS_CERTAIN_BOUNDS
                || (bounds[from] >= bounds[(from + 1) % n] && bounds[from] >= bounds[(from + n - 1) % n])
        };
        for &(bound, [from, to]) in candidates.iter().filter(|(_, [from, _])| is_peak(*from)).take(limit) {
            let least = self.least();
            // Nothing is longer than the whole curve.
            if bound < least || self.best >= (quantity[points.start_count] - quantity[0]) * (1.0 - R::EQUAL) {
                break;
            }
            if is_covered[from] {
                continue;
            }
            let first = [from, to].map(|k| points.positions[k] as f64);
            let (start, extra) = match self.requirement.longest_near(first, 2.0 * points.stride as f64, least) {
                Reached::Longest { size, ends, .. } => {
                    self.best = self.best.max(size);
                    self.found.push((size, ends));
                    (ends[0], 0.0)
                }
                // A portion that begins and ends a step further on is longer by no more than two steps.
                Reached::Shorter { ends, bound } => (ends[0], (least - bound) / (2.0 * mean_step)),
                Reached::Nothing => (first[0], 0.0),
            };
            // From the starts that have been passed nothing else would be found.
            let extra = extra.floor() * points.stride as f64;
            points.cover(&mut is_covered, [first[0].min(start) - extra, first[0].max(start) + extra]);
        }
    }
}

/// Portions without those that are one of the others.
fn different(portions: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    /// The difference of the ends of one portion that was reached twice, relative to its span.
    const SAME: f64 = 1e-6;
    portions.fold(Vec::new(), |mut out, ends| {
        let is_near = |other: &[f64; 2]| (0..2).all(|k| (ends[k] - other[k]).abs() <= SAME * (ends[1] - ends[0]));
        if !out.iter().any(is_near) {
            out.push(ends);
        }
        out
    })
}

/// Portions that do not overlap, in the order of the input at which they begin.
fn distinct(row: &Row, portions: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    /// More than the error of the ends, where the length hardly depends on them.
    const OVERLAP: f64 = 0.01;
    let round = if row.is_closed { row.start_count as f64 } else { 0.0 };
    let mut out: Vec<[f64; 2]> = Vec::new();
    for [from, to] in in_rising_order(portions, |ends| within_period(row.input_at(ends[0]), 360.0)) {
        let overlaps = |other: &[f64; 2]| {
            let common = |shift: f64| (to + shift).min(other[1]) - (from + shift).max(other[0]);
            [-round, 0.0, round].iter().any(|&shift| common(shift) > OVERLAP * (to - from))
        };
        if !out.iter().any(overlaps) {
            out.push([from, to]);
        }
    }
    out
}

/// The part of the curve's greatest extent that a portion to a tolerance is at least as long as: any curve is straight
/// over a short enough length.
pub const LEAST_SHARE: f64 = 0.05;

/// The distance of the points in which portions are searched for, relative to the extent: the shortest portion has ten.
pub const SPACING: f64 = LEAST_SHARE / 10.0;

/// The deviation of a portion that is straight to rounding, relative to its length, or that is circular, relative to its
/// radius; it is reported as 0.
pub const EXACT: f64 = 1e-9;

/// Intervals between the points of a portion that is reported: enough to draw it.
pub const INTERVALS: usize = 96;

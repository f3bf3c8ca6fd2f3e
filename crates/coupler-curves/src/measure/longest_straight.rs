//! The longest portion of a curve that is straight to a tolerance.
//!
//! A portion that begins at the same point and ends further on is at least as wide. So a portion that is too wide for
//! its length rules out all ends closer than the length that its width requires: from each sample the search skips to
//! the end at which that length may be reached, and most samples need only a triangle or two. The longest portion from
//! sample to sample, and those that might become longer than it, are then extended between samples; short ones are
//! resampled first.

use super::curve_segment::{CurveSegment, PortionFit};
use super::strip::{Strip, triangle_height};

/// The greatest number of nested resamplings: each finds portions about thirty times as short.
const MAX_DEPTH: usize = 4;

/// The strip of fewer points than this says little about the curve between them.
const FEW_POINTS: usize = 8;

/// The factor of the tolerance for portions between points, so that those which fit only with ends between points are
/// found.
const LOOSER_FACTOR: f64 = 1.02;

/// The ends of the longest portion in a strip no wider than `tolerance` times its length.
pub(super) fn longest(segment: &CurveSegment, tolerance: f64) -> Option<[f64; 2]> {
    StraightSearch { segment, tolerance, min_intervals: 1 }.longest()
}

/// The search for the longest portion in a strip no wider than `tolerance` times its length.
struct StraightSearch<'a> {
    segment: &'a CurveSegment,
    tolerance: f64,
    /// The least number of intervals in a portion between points: a single chord is always straight.
    min_intervals: usize,
}

impl StraightSearch<'_> {
    /// The ends of the longest portion of the segment.
    fn longest(&self) -> Option<[f64; 2]> {
        /// The number of other portions that are extended because they might become the longest.
        const RIVALS: usize = 2;
        let flattest = || {
            let each = self
                .segment
                .flattest_points()
                .into_iter()
                .take(RIVALS + 1)
                .filter_map(|k| self.longest_around(k as f64));
            each.reduce(longer)
        };
        let Some((found, width)) = self.longest_with_tolerance_factor(LOOSER_FACTOR) else {
            return flattest().map(|(_, ends)| ends);
        };
        // A portion of few points may be long only because they are far apart. Better candidates are portions where the
        // curve is flattest, and those of more points.
        if found[1] - found[0] < FEW_POINTS {
            let of_more_points = || {
                StraightSearch { min_intervals: FEW_POINTS, ..*self }
                    .longest_with_tolerance_factor(LOOSER_FACTOR)
                    .and_then(|(ends, _)| self.refine(ends, MAX_DEPTH))
            };
            let all = [flattest(), self.refine(found, MAX_DEPTH), of_more_points()].into_iter().flatten();
            return all.reduce(longer).map(|(_, ends)| ends);
        }
        let longest = self.refine(found, MAX_DEPTH).or_else(|| self.longest_at_stricter_tolerance(MAX_DEPTH));
        // If nothing is straight between points, the portion from point to point is the result.
        let mut best = longest.unwrap_or_else(|| (self.segment.distance(found), found.map(|k| k as f64)));
        for rival in self.rivals(width, best.0, found).into_iter().take(RIVALS) {
            let [from, to] = rival.map(|k| k as f64);
            let other =
                self.refine(rival, MAX_DEPTH).or_else(|| self.longest_resampled([from - 1.0, to + 1.0], MAX_DEPTH));
            best = other.into_iter().fold(best, longer);
        }
        Some(best.1)
    }

    /// The longest portion between points for a part of the tolerance, as [`StraightSearch::longest_between_points`].
    fn longest_with_tolerance_factor(&self, factor: f64) -> Option<([usize; 2], f64)> {
        StraightSearch { tolerance: self.tolerance * factor, ..*self }.longest_between_points()
    }

    /// The length and the ends of the longest portion that leaves a part of the tolerance for the curve between points.
    fn longest_at_stricter_tolerance(&self, depth: usize) -> Option<(f64, [f64; 2])> {
        [1.0, 0.99, 0.95, 0.85, 0.7]
            .into_iter()
            .find_map(|factor| self.refine(self.longest_with_tolerance_factor(factor)?.0, depth))
    }

    /// The length and the ends of the longest portion around a point.
    fn longest_around(&self, point: f64) -> Option<(f64, [f64; 2])> {
        let mut found: Option<(f64, [f64; 2])> = None;
        let mut round = 1.0;
        while round <= FEW_POINTS as f64 {
            let window = [point - round, point + round];
            let Some((length, ends)) = self.longest_resampled(window, MAX_DEPTH) else { break };
            found = found.into_iter().chain([(length, ends)]).reduce(longer);
            let [from, to] = self.segment.clamp(window);
            // A portion that fills the window may continue outside.
            let margin = 0.05 * round;
            if ends[0] > from + margin && ends[1] < to - margin {
                break;
            }
            round *= 2.0;
        }
        found
    }

    /// The points at the ends of the longest portion, and an upper bound for the width of any longer portion.
    fn longest_between_points(&self) -> Option<([usize; 2], f64)> {
        /// Points this far apart are tried first: the sooner a long portion is found, the more can be skipped.
        const STRIDE: usize = 16;
        let CurveSegment { points, start_count: starts, longest_chord, .. } = self.segment;
        let reach = points.iter().take(starts + 1).fold(0.0, |reach: f64, p| reach.max((p - points[0]).norm()));
        let widest = self.tolerance * 2.0 * reach;
        let (mut best, mut found, mut intervals) = (0.0, None, self.min_intervals);
        for from in (0..*starts).step_by(STRIDE).chain(0..*starts) {
            // A portion is no longer than its polyline.
            let to = self.segment.first_point_beyond(from, best, from + intervals);
            intervals = to - from;
            if let Some((to, length)) =
                self.longest_from_point([from, to.max(from + self.min_intervals)], |_| 0.0, widest, best)
            {
                (best, found) = (length, Some([from, to]));
            }
        }
        let found = found?;
        let strip = Strip::enclosing(points[found[0]..=found[1]].to_vec());
        // Extended between points it may be longer by a chord at either end.
        Some((found, widest.min(self.tolerance * (strip.length + 2.0 * longest_chord))))
    }

    /// The end and the length of the longest portion from a point, if it is longer than `best`; it ends at `to` or
    /// later, and is narrower than `widest`. `further` is the length by which the portion to a point may still be
    /// extended, and which counts when its width is compared with its length.
    fn longest_from_point(
        &self,
        [from, mut to]: [usize; 2],
        further: impl Fn(usize) -> f64,
        widest: f64,
        mut best: f64,
    ) -> Option<(usize, f64)> {
        let segment = self.segment;
        let mut found = None;
        while to <= segment.last_end(from) {
            let far = segment.distance([from, to]);
            if far <= best {
                to = segment.first_point_beyond(to, best - far, to + 1);
                continue;
            }
            let further = further(to);
            match self.check_width([from, to], self.tolerance * (far + further)) {
                Ok(()) => {
                    (best, found) = (far, Some((to, far)));
                    to += 1;
                }
                Err(width) if width >= widest => break,
                // A longer portion is at least as wide, and needs the length that this width requires.
                Err(width) => {
                    to = segment.first_point_beyond(from, width / self.tolerance - further, to + 1).max(to + 1)
                }
            }
        }
        found
    }

    /// Portions that might become longer than `best` when extended between points, the longest first, without overlaps.
    fn rivals(&self, width: f64, best: f64, found: [usize; 2]) -> Vec<[usize; 2]> {
        let segment = self.segment;
        let least = best - 2.0 * segment.longest_chord;
        // It is extended to the neighbouring points at most.
        let further = |from: usize, to: usize| {
            let before = if from > 0 { segment.distance([from - 1, from]) } else { segment.longest_chord };
            let after = if to + 1 < segment.points.len() { segment.distance([to, to + 1]) } else { 0.0 };
            before + after
        };
        let mut intervals = found[1] - found[0];
        let from = (0..segment.start_count).filter_map(|from| {
            let to = segment.first_point_beyond(from, least, from + intervals);
            intervals = to - from;
            let first = to.max(from + self.min_intervals);
            let (to, length) = self.longest_from_point([from, first], |to| further(from, to), width, least)?;
            (length + further(from, to) > best).then_some((length, [from, to]))
        });
        let mut all: Vec<(f64, [usize; 2])> = from.collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut kept = vec![found];
        let round = segment.start_count;
        for (_, [from, to]) in all {
            let middle = |ends: &[usize; 2]| (ends[0] + ends[1]) / 2 % round;
            let half = ((to - from) / 2).max(1);
            let overlaps = |other: &[usize; 2]| {
                let distance = middle(&[from, to]).abs_diff(middle(other));
                distance.min(round - distance) < half
            };
            if !kept.iter().any(overlaps) {
                kept.push([from, to]);
            }
        }
        kept.split_off(1)
    }

    /// Checks whether the portion between two points lies in a strip of a width of at most `most`.
    ///
    /// # Errors
    /// A lower bound for its width, if it does not.
    fn check_width(&self, [from, to]: [usize; 2], most: f64) -> Result<(), f64> {
        let points = &self.segment.points[from..=to];
        let last = points.len() - 1;
        let no_wider = |width| if width > most { Err(width) } else { Ok(()) };
        if last < FEW_POINTS {
            no_wider(self.segment.strip_width_bound([from, to]))?;
            return if last < 2 { Ok(()) } else { no_wider(Strip::enclosing(points.to_vec()).width) };
        }
        // Triangles first: the least height of a triangle in a strip is no greater than the width of the strip.
        let quarters = [0, last / 4, last / 2, last - last / 4, last].map(|k| points[k]);
        for corners in [[0, 2, 4], [0, 1, 3], [1, 3, 4]] {
            no_wider(triangle_height(corners.map(|k| quarters[k])))?;
        }
        let mut three = [0, last / 2, last];
        if Strip::by_exchange(points, &mut three, most).is_some() {
            return Ok(());
        }
        Err(triangle_height(three.map(|k| points[k])).max(most))
    }

    /// The length and the ends of a portion, refined between points.
    fn refine(&self, ends: [usize; 2], depth: usize) -> Option<(f64, [f64; 2])> {
        let whole = ends.map(|k| k as f64);
        if ends[1] - ends[0] >= FEW_POINTS || depth == 0 {
            return self.extend_repeatedly(whole);
        }
        self.longest_resampled([whole[0] - 1.0, whole[1] + 1.0], depth)
    }

    /// The length and the ends of a portion, extended repeatedly while an end moves nearly as far as one extension
    /// allows.
    fn extend_repeatedly(&self, mut ends: [f64; 2]) -> Option<(f64, [f64; 2])> {
        const MOVES: usize = 4;
        const FAR: f64 = 0.95;
        let mut best = self.extend(ends)?;
        for _ in 0..MOVES {
            if (best.1[0] - ends[0]).abs().max((best.1[1] - ends[1]).abs()) < FAR {
                break;
            }
            ends = best.1;
            match self.extend(ends) {
                Some(further) if further.0 > best.0 * (1.0 + 1e-6) => best = further,
                _ => break,
            }
        }
        Some(best)
    }

    /// The length and the ends of the longest portion between two positions, with many more points.
    fn longest_resampled(&self, ends: [f64; 2], depth: usize) -> Option<(f64, [f64; 2])> {
        let [from, to] = self.segment.clamp(ends);
        let piece = self.segment.resample([from, to]);
        let spacing = (to - from) / (piece.points.len() - 1) as f64;
        let depth = depth.checked_sub(1)?;
        let search = StraightSearch { segment: &piece, tolerance: self.tolerance, min_intervals: 1 };
        let (length, ends) = match search.longest_with_tolerance_factor(LOOSER_FACTOR) {
            Some((found, _)) => search.refine(found, depth).or_else(|| search.longest_at_stricter_tolerance(depth))?,
            None => {
                let k = *piece.flattest_points().first()? as f64;
                search.longest_resampled([k - 1.0, k + 1.0], depth)?
            }
        };
        Some((length, ends.map(|position| from + position * spacing)))
    }

    /// The length and the ends of a portion whose ends are moved, by a point at most, as far as the tolerance allows.
    fn extend(&self, ends: [f64; 2]) -> Option<(f64, [f64; 2])> {
        let [from, to] = self.segment.clamp(ends);
        let core = self.segment.portion_points([from + 1.0, to - 1.0]);
        // The points between the core and the moved ends.
        let outer = |end: f64, inner: f64| {
            [0.0, 1.0 / 3.0, 2.0 / 3.0].map(|fraction| self.segment.point_at(end + fraction * (inner - end)))
        };
        let fit_from = |start: f64| {
            let mut points = Vec::with_capacity(core.len() + 6);
            points.extend(outer(start, from + 1.0));
            points.extend_from_slice(&core);
            let kept = points.len();
            let mut three = [0, kept / 2, kept + 2];
            move |end: f64| {
                points.truncate(kept);
                points.extend(outer(end, to - 1.0).into_iter().rev());
                let strip = Strip::by_exchange(&points, &mut three, f64::INFINITY);
                let strip = strip.unwrap_or_else(|| Strip::enclosing(points.clone()));
                PortionFit { size: strip.length, excess: strip.width - self.tolerance * strip.length }
            }
        };
        self.segment.extend([from, to], fit_from)
    }
}

/// The longer of two portions, given as lengths and ends; the first if they are equal.
fn longer(one: (f64, [f64; 2]), other: (f64, [f64; 2])) -> (f64, [f64; 2]) {
    if other.0 > one.0 { other } else { one }
}

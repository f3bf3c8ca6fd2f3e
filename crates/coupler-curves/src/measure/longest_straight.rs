//! The longest portion of a curve that is straight to a tolerance.
//!
//! A portion that is too wide for its length asks for a length that goes with its width, and any that begins there and goes
//! further is as wide at least: so from each sample the search leaps to where that length may be, and most samples are done
//! with after a triangle or two. The longest by samples, and whatever might come to be longer than it, is then drawn out
//! between them, a short one among many more points.

use super::curve_segment::{CurveSegment, PortionFit};
use super::strip::{Strip, triangle_height};

/// How often a portion of few points is looked for again among many: each time shows what is some thirty times as short.
const MAX_DEPTH: usize = 4;

/// The strip of so few points says little of the curve between them.
const FEW_POINTS: usize = 8;

/// What fits only between two points is found by asking the points for a little less.
const LOOSER_FACTOR: f64 = 1.02;

/// The ends of the longest portion in a strip no wider than a part of its length.
pub(super) fn longest(course: &CurveSegment, tolerance: f64) -> Option<[f64; 2]> {
    StraightSearch { segment: course, tolerance, min_intervals: 1 }.longest()
}

/// For the longest portion in a strip no wider than a part of its length.
struct StraightSearch<'a> {
    segment: &'a CurveSegment,
    tolerance: f64,
    /// By points a portion goes at least so many points on: a single chord is always straight.
    min_intervals: usize,
}

impl StraightSearch<'_> {
    /// The ends of the longest portion anywhere.
    fn longest(&self) -> Option<[f64; 2]> {
        /// So many portions are drawn out that might come to be the longest.
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
        // So few points say little: they may only be far apart. Likelier is a portion where the curve is flattest, or one of
        // more points that is shorter than those seem.
        if found[1] - found[0] < FEW_POINTS {
            let by_more = || {
                StraightSearch { min_intervals: FEW_POINTS, ..*self }
                    .longest_with_tolerance_factor(LOOSER_FACTOR)
                    .and_then(|(ends, _)| self.refine(ends, MAX_DEPTH))
            };
            let all = [flattest(), self.refine(found, MAX_DEPTH), by_more()].into_iter().flatten();
            return all.reduce(longer).map(|(_, ends)| ends);
        }
        let longest = self.refine(found, MAX_DEPTH).or_else(|| self.longest_at_stricter_tolerance(MAX_DEPTH));
        // Where nothing is straight between points, those are all that is known.
        let mut best = longest.unwrap_or_else(|| (self.segment.distance(found), found.map(|k| k as f64)));
        for rival in self.rivals(width, best.0, found).into_iter().take(RIVALS) {
            let [from, to] = rival.map(|k| k as f64);
            let other =
                self.refine(rival, MAX_DEPTH).or_else(|| self.longest_resampled([from - 1.0, to + 1.0], MAX_DEPTH));
            best = other.into_iter().fold(best, longer);
        }
        Some(best.1)
    }

    /// The longest portion by points, for a part of the tolerance.
    fn longest_with_tolerance_factor(&self, part: f64) -> Option<([usize; 2], f64)> {
        StraightSearch { tolerance: self.tolerance * part, ..*self }.longest_between_points()
    }

    /// The length and the ends of a portion that leaves something of the tolerance to the curve between its points.
    fn longest_at_stricter_tolerance(&self, depth: usize) -> Option<(f64, [f64; 2])> {
        [1.0, 0.99, 0.95, 0.85, 0.7]
            .into_iter()
            .find_map(|part| self.refine(self.longest_with_tolerance_factor(part)?.0, depth))
    }

    /// The length and the ends of the longest portion about a point, as far as it goes.
    fn longest_around(&self, point: f64) -> Option<(f64, [f64; 2])> {
        let mut found: Option<(f64, [f64; 2])> = None;
        let mut round = 1.0;
        while round <= FEW_POINTS as f64 {
            let window = [point - round, point + round];
            let Some((length, ends)) = self.longest_resampled(window, MAX_DEPTH) else { break };
            found = found.into_iter().chain([(length, ends)]).reduce(longer);
            let [from, to] = self.segment.clamp(window);
            // What fills the window may go on outside.
            let near = 0.05 * round;
            if ends[0] > from + near && ends[1] < to - near {
                break;
            }
            round *= 2.0;
        }
        found
    }

    /// The points at the ends of the longest portion, and the width no portion may have more of.
    fn longest_between_points(&self) -> Option<([usize; 2], f64)> {
        /// The sooner something long is found, the less has to be looked at: first from points so far apart.
        const STRIDE: usize = 16;
        let CurveSegment { points, start_count: starts, longest_chord, .. } = self.segment;
        let reach = points.iter().take(starts + 1).fold(0.0, |reach: f64, p| reach.max((p - points[0]).norm()));
        let widest = self.tolerance * 2.0 * reach;
        let (mut best, mut found, mut on) = (0.0, None, self.min_intervals);
        for from in (0..*starts).step_by(STRIDE).chain(0..*starts) {
            // However straight, a portion is not as long before its way is.
            let to = self.segment.first_point_beyond(from, best, from + on);
            on = to - from;
            if let Some((to, length)) =
                self.longest_from_point([from, to.max(from + self.min_intervals)], |_| 0.0, widest, best)
            {
                (best, found) = (length, Some([from, to]));
            }
        }
        let found = found?;
        let own = Strip::enclosing(points[found[0]..=found[1]].to_vec());
        // Between points it may be longer by the way to the next at either end.
        Some((found, widest.min(self.tolerance * (own.length + 2.0 * longest_chord))))
    }

    /// The end and the length of the longest portion from a point, if it is longer than `best`; it ends no sooner than at
    /// another point, and is not `widest` or wider. It is as wide as it may be if it goes `further` than the point at its
    /// end by so much.
    fn longest_from_point(
        &self,
        [from, mut to]: [usize; 2],
        further: impl Fn(usize) -> f64,
        widest: f64,
        mut best: f64,
    ) -> Option<(usize, f64)> {
        let course = self.segment;
        let mut found = None;
        while to <= course.last_end(from) {
            let far = course.distance([from, to]);
            if far <= best {
                to = course.first_point_beyond(to, best - far, to + 1);
                continue;
            }
            let further = further(to);
            match self.check_width([from, to], self.tolerance * (far + further)) {
                Ok(()) => {
                    (best, found) = (far, Some((to, far)));
                    to += 1;
                }
                Err(width) if width >= widest => break,
                // What goes further is as wide at least, and has to be as long as that asks for.
                Err(width) => {
                    to = course.first_point_beyond(from, width / self.tolerance - further, to + 1).max(to + 1)
                }
            }
        }
        found
    }

    /// Portions that might come to be longer than `best` between points, the longest first, none upon another.
    fn rivals(&self, width: f64, best: f64, found: [usize; 2]) -> Vec<[usize; 2]> {
        let course = self.segment;
        let least = best - 2.0 * course.longest_chord;
        // Drawn out it reaches no further than the next points, and is as much longer at most.
        let further = |from: usize, to: usize| {
            let before = if from > 0 { course.distance([from - 1, from]) } else { course.longest_chord };
            let after = if to + 1 < course.points.len() { course.distance([to, to + 1]) } else { 0.0 };
            before + after
        };
        let mut on = found[1] - found[0];
        let from = (0..course.start_count).filter_map(|from| {
            let to = course.first_point_beyond(from, least, from + on);
            on = to - from;
            let first = to.max(from + self.min_intervals);
            let (to, length) = self.longest_from_point([from, first], |to| further(from, to), width, least)?;
            (length + further(from, to) > best).then_some((length, [from, to]))
        });
        let mut all: Vec<(f64, [usize; 2])> = from.collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut kept = vec![found];
        let round = course.start_count;
        for (_, [from, to]) in all {
            let middle = |ends: &[usize; 2]| (ends[0] + ends[1]) / 2 % round;
            let half = ((to - from) / 2).max(1);
            let is_upon = |other: &[usize; 2]| {
                let apart = middle(&[from, to]).abs_diff(middle(other));
                apart.min(round - apart) < half
            };
            if !kept.iter().any(is_upon) {
                kept.push([from, to]);
            }
        }
        kept.split_off(1)
    }

    /// Whether a portion, by the points at its ends, may lie in a strip of some width; otherwise how wide it is at least.
    fn check_width(&self, [from, to]: [usize; 2], most: f64) -> Result<(), f64> {
        let points = &self.segment.points[from..=to];
        let last = points.len() - 1;
        let no_wider = |width| if width > most { Err(width) } else { Ok(()) };
        if last < FEW_POINTS {
            no_wider(self.segment.strip_width_bound([from, to]))?;
            return if last < 2 { Ok(()) } else { no_wider(Strip::enclosing(points.to_vec()).width) };
        }
        // First by triangles: one in a strip is no higher, over its longest side, than the strip is wide.
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

    /// The length and the ends of a portion drawn out between points.
    fn refine(&self, ends: [usize; 2], depth: usize) -> Option<(f64, [f64; 2])> {
        let whole = ends.map(|k| k as f64);
        if ends[1] - ends[0] >= FEW_POINTS || depth == 0 {
            return self.extend_repeatedly(whole);
        }
        self.longest_resampled([whole[0] - 1.0, whole[1] + 1.0], depth)
    }

    /// The length and the ends of a portion drawn out, and again from where it has come to while an end of it has gone nearly
    /// as far as it may.
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

    /// The length and the ends of the longest portion between two places, by many more points.
    fn longest_resampled(&self, ends: [f64; 2], depth: usize) -> Option<(f64, [f64; 2])> {
        let [from, to] = self.segment.clamp(ends);
        let piece = self.segment.resample([from, to]);
        let part = (to - from) / (piece.points.len() - 1) as f64;
        let depth = depth.checked_sub(1)?;
        let search = StraightSearch { segment: &piece, tolerance: self.tolerance, min_intervals: 1 };
        let (length, ends) = match search.longest_with_tolerance_factor(LOOSER_FACTOR) {
            Some((found, _)) => search.refine(found, depth).or_else(|| search.longest_at_stricter_tolerance(depth))?,
            None => {
                let k = *piece.flattest_points().first()? as f64;
                search.longest_resampled([k - 1.0, k + 1.0], depth)?
            }
        };
        Some((length, ends.map(|place| from + place * part)))
    }

    /// The length and the ends of a portion whose ends are moved, by a point at most, as far as its own length allows.
    fn extend(&self, ends: [f64; 2]) -> Option<(f64, [f64; 2])> {
        let [from, to] = self.segment.clamp(ends);
        let core = self.segment.portion_points([from + 1.0, to - 1.0]);
        // What is passed on the way out is in the portion too.
        let passed = |end: f64, inner: f64| {
            [0.0, 1.0 / 3.0, 2.0 / 3.0].map(|part| self.segment.point_at(end + part * (inner - end)))
        };
        let beginning = |start: f64| {
            let mut points = Vec::with_capacity(core.len() + 6);
            points.extend(passed(start, from + 1.0));
            points.extend_from_slice(&core);
            let kept = points.len();
            let mut three = [0, kept / 2, kept + 2];
            move |end: f64| {
                points.truncate(kept);
                points.extend(passed(end, to - 1.0).into_iter().rev());
                let strip = Strip::by_exchange(&points, &mut three, f64::INFINITY);
                let strip = strip.unwrap_or_else(|| Strip::enclosing(points.clone()));
                PortionFit { size: strip.length, excess: strip.width - self.tolerance * strip.length }
            }
        };
        self.segment.extend([from, to], beginning)
    }
}

/// The longer of two portions, by their lengths; the first of equals.
fn longer(one: (f64, [f64; 2]), other: (f64, [f64; 2])) -> (f64, [f64; 2]) {
    if other.0 > one.0 { other } else { one }
}

//! The longest portion of a curve that is straight to a tolerance.
//!
//! A portion that is too wide for its length asks for a length that goes with its width, and any that begins there and goes
//! further is as wide at least: so from each sample the search leaps to where that length may be, and most samples are done
//! with after a triangle or two. The longest by samples, and whatever might come to be longer than it, is then drawn out
//! between them, a short one among many more points.

use super::course::{Course, Fit};
use super::strip::{Strip, height};

/// How often a portion of few points is looked for again among many: each time shows what is some thirty times as short.
const DEPTH: usize = 4;

/// The strip of so few points says little of the curve between them.
const FEW: usize = 8;

/// What fits only between two points is found by asking the points for a little less.
const LOOSER: f64 = 1.02;

/// The ends of the longest portion in a strip no wider than a part of its length.
pub(super) fn longest(course: &Course, tolerance: f64) -> Option<[f64; 2]> {
    Search { course, tolerance, least: 1 }.longest_of_all()
}

/// For the longest portion in a strip no wider than a part of its length.
struct Search<'a> {
    course: &'a Course,
    tolerance: f64,
    /// By points a portion goes at least so many points on: a single chord is always straight.
    least: usize,
}

impl Search<'_> {
    /// The ends of the longest portion anywhere.
    fn longest_of_all(&self) -> Option<[f64; 2]> {
        /// So many portions are drawn out that might come to be the longest.
        const RIVALS: usize = 2;
        let flattest = || {
            let each = self.course.flattest().into_iter().take(RIVALS + 1).filter_map(|k| self.about(k as f64));
            each.reduce(longer)
        };
        let Some((found, width)) = self.by_points(LOOSER) else {
            return flattest().map(|(_, ends)| ends);
        };
        // So few points say little: they may only be far apart. Likelier is a portion where the curve is flattest, or one of
        // more points that is shorter than those seem.
        if found[1] - found[0] < FEW {
            let by_more =
                || Search { least: FEW, ..*self }.by_points(LOOSER).and_then(|(ends, _)| self.refined(ends, DEPTH));
            let all = [flattest(), self.refined(found, DEPTH), by_more()].into_iter().flatten();
            return all.reduce(longer).map(|(_, ends)| ends);
        }
        let longest = self.refined(found, DEPTH).or_else(|| self.stricter(DEPTH));
        // Where nothing is straight between points, those are all that is known.
        let mut best = longest.unwrap_or_else(|| (self.course.distance(found), found.map(|k| k as f64)));
        for rival in self.rivals(width, best.0, found).into_iter().take(RIVALS) {
            let [from, to] = rival.map(|k| k as f64);
            let other = self.refined(rival, DEPTH).or_else(|| self.finely([from - 1.0, to + 1.0], DEPTH));
            best = other.into_iter().fold(best, longer);
        }
        Some(best.1)
    }

    /// The longest portion by points, for a part of the tolerance.
    fn by_points(&self, part: f64) -> Option<([usize; 2], f64)> {
        Search { tolerance: self.tolerance * part, ..*self }.longest_by_points()
    }

    /// The length and the ends of a portion that leaves something of the tolerance to the curve between its points.
    fn stricter(&self, depth: usize) -> Option<(f64, [f64; 2])> {
        [1.0, 0.99, 0.95, 0.85, 0.7].into_iter().find_map(|part| self.refined(self.by_points(part)?.0, depth))
    }

    /// The length and the ends of the longest portion about a point, as far as it goes.
    fn about(&self, point: f64) -> Option<(f64, [f64; 2])> {
        let mut found: Option<(f64, [f64; 2])> = None;
        let mut round = 1.0;
        while round <= FEW as f64 {
            let window = [point - round, point + round];
            let Some((length, ends)) = self.finely(window, DEPTH) else { break };
            found = found.into_iter().chain([(length, ends)]).reduce(longer);
            let [from, to] = self.course.clamp(window);
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
    fn longest_by_points(&self) -> Option<([usize; 2], f64)> {
        /// The sooner something long is found, the less has to be looked at: first from points so far apart.
        const STRIDE: usize = 16;
        let Course { points, starts, longest_chord, .. } = self.course;
        let reach = points.iter().take(starts + 1).fold(0.0, |reach: f64, p| reach.max((p - points[0]).norm()));
        let widest = self.tolerance * 2.0 * reach;
        let (mut best, mut found, mut on) = (0.0, None, self.least);
        for from in (0..*starts).step_by(STRIDE).chain(0..*starts) {
            // However straight, a portion is not as long before its way is.
            let to = self.course.way_beyond(from, best, from + on);
            on = to - from;
            if let Some((to, length)) = self.longest_from([from, to.max(from + self.least)], |_| 0.0, widest, best) {
                (best, found) = (length, Some([from, to]));
            }
        }
        let found = found?;
        let own = Strip::of(points[found[0]..=found[1]].to_vec());
        // Between points it may be longer by the way to the next at either end.
        Some((found, widest.min(self.tolerance * (own.length + 2.0 * longest_chord))))
    }

    /// The end and the length of the longest portion from a point, if it is longer than `best`; it ends no sooner than at
    /// another point, and is not `widest` or wider. It is as wide as it may be if it goes `further` than the point at its
    /// end by so much.
    fn longest_from(
        &self,
        [from, mut to]: [usize; 2],
        further: impl Fn(usize) -> f64,
        widest: f64,
        mut best: f64,
    ) -> Option<(usize, f64)> {
        let course = self.course;
        let mut found = None;
        while to <= course.last(from) {
            let far = course.distance([from, to]);
            if far <= best {
                to = course.way_beyond(to, best - far, to + 1);
                continue;
            }
            let further = further(to);
            match self.fits([from, to], self.tolerance * (far + further)) {
                Ok(()) => {
                    (best, found) = (far, Some((to, far)));
                    to += 1;
                }
                Err(width) if width >= widest => break,
                // What goes further is as wide at least, and has to be as long as that asks for.
                Err(width) => to = course.way_beyond(from, width / self.tolerance - further, to + 1).max(to + 1),
            }
        }
        found
    }

    /// Portions that might come to be longer than `best` between points, the longest first, none upon another.
    fn rivals(&self, width: f64, best: f64, found: [usize; 2]) -> Vec<[usize; 2]> {
        let course = self.course;
        let least = best - 2.0 * course.longest_chord;
        // Drawn out it reaches no further than the next points, and is as much longer at most.
        let further = |from: usize, to: usize| {
            let before = if from > 0 { course.distance([from - 1, from]) } else { course.longest_chord };
            let after = if to + 1 < course.points.len() { course.distance([to, to + 1]) } else { 0.0 };
            before + after
        };
        let mut on = found[1] - found[0];
        let from = (0..course.starts).filter_map(|from| {
            let to = course.way_beyond(from, least, from + on);
            on = to - from;
            let first = to.max(from + self.least);
            let (to, length) = self.longest_from([from, first], |to| further(from, to), width, least)?;
            (length + further(from, to) > best).then_some((length, [from, to]))
        });
        let mut all: Vec<(f64, [usize; 2])> = from.collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut kept = vec![found];
        let round = course.starts;
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
    fn fits(&self, [from, to]: [usize; 2], most: f64) -> Result<(), f64> {
        let points = &self.course.points[from..=to];
        let last = points.len() - 1;
        let no_wider = |width| if width > most { Err(width) } else { Ok(()) };
        if last < FEW {
            no_wider(self.course.bend_between([from, to]))?;
            return if last < 2 { Ok(()) } else { no_wider(Strip::of(points.to_vec()).width) };
        }
        // First by triangles: one in a strip is no higher, over its longest side, than the strip is wide.
        let quarters = [0, last / 4, last / 2, last - last / 4, last].map(|k| points[k]);
        for corners in [[0, 2, 4], [0, 1, 3], [1, 3, 4]] {
            no_wider(height(corners.map(|k| quarters[k])))?;
        }
        let mut three = [0, last / 2, last];
        if Strip::of_row(points, &mut three, most).is_some() {
            return Ok(());
        }
        Err(height(three.map(|k| points[k])).max(most))
    }

    /// The length and the ends of a portion drawn out between points.
    fn refined(&self, ends: [usize; 2], depth: usize) -> Option<(f64, [f64; 2])> {
        let whole = ends.map(|k| k as f64);
        if ends[1] - ends[0] >= FEW || depth == 0 {
            return self.drawn_furthest(whole);
        }
        self.finely([whole[0] - 1.0, whole[1] + 1.0], depth)
    }

    /// The length and the ends of a portion drawn out, and again from where it has come to while an end of it has gone nearly
    /// as far as it may.
    fn drawn_furthest(&self, mut ends: [f64; 2]) -> Option<(f64, [f64; 2])> {
        const MOVES: usize = 4;
        const FAR: f64 = 0.95;
        let mut best = self.drawn_out(ends)?;
        for _ in 0..MOVES {
            if (best.1[0] - ends[0]).abs().max((best.1[1] - ends[1]).abs()) < FAR {
                break;
            }
            ends = best.1;
            match self.drawn_out(ends) {
                Some(further) if further.0 > best.0 * (1.0 + 1e-6) => best = further,
                _ => break,
            }
        }
        Some(best)
    }

    /// The length and the ends of the longest portion between two places, by many more points.
    fn finely(&self, ends: [f64; 2], depth: usize) -> Option<(f64, [f64; 2])> {
        let [from, to] = self.course.clamp(ends);
        let piece = self.course.piece([from, to]);
        let part = (to - from) / (piece.points.len() - 1) as f64;
        let depth = depth.checked_sub(1)?;
        let search = Search { course: &piece, tolerance: self.tolerance, least: 1 };
        let (length, ends) = match search.by_points(LOOSER) {
            Some((found, _)) => search.refined(found, depth).or_else(|| search.stricter(depth))?,
            None => {
                let k = *piece.flattest().first()? as f64;
                search.finely([k - 1.0, k + 1.0], depth)?
            }
        };
        Some((length, ends.map(|place| from + place * part)))
    }

    /// The length and the ends of a portion whose ends are moved, by a point at most, as far as its own length allows.
    fn drawn_out(&self, ends: [f64; 2]) -> Option<(f64, [f64; 2])> {
        let [from, to] = self.course.clamp(ends);
        let core = self.course.portion([from + 1.0, to - 1.0]);
        // What is passed on the way out is in the portion too.
        let passed = |end: f64, inner: f64| {
            [0.0, 1.0 / 3.0, 2.0 / 3.0].map(|part| self.course.point(end + part * (inner - end)))
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
                let strip = Strip::of_row(&points, &mut three, f64::INFINITY);
                let strip = strip.unwrap_or_else(|| Strip::of(points.clone()));
                Fit { size: strip.length, excess: strip.width - self.tolerance * strip.length }
            }
        };
        self.course.drawn_out([from, to], beginning)
    }
}

/// The longer of two portions, by their lengths; the first of equals.
fn longer(one: (f64, [f64; 2]), other: (f64, [f64; 2])) -> (f64, [f64; 2]) {
    if other.0 > one.0 { other } else { one }
}

//! A curve, or a piece of one, in which straight and circular portions are searched for.

use std::rc::Rc;

use super::annulus::GOLDEN_SECTION;
use super::sampled_curve::SampledCurve;
use crate::geometry::{Point, cross};

/// The size of a portion and how well it fits its shape.
#[derive(Clone, Copy, Debug)]
pub(super) struct PortionFit {
    /// The quantity to be maximized.
    pub size: f64,
    /// By how much it exceeds its tolerance; it fits where this is negative or zero.
    pub excess: f64,
}

/// A curve, or a piece of one, as a row of points.
///
/// A *position* on it is a fractional index of its points: position 2.5 is between points 2 and 3. The points of a
/// closed curve are repeated once, so that a portion across its first point is a row of points too.
#[derive(Clone, Debug)]
pub(super) struct CurveSegment {
    sampled_curve: Rc<SampledCurve>,
    /// The position of its first point on the sampled curve, and the distance of its points in samples.
    start: f64,
    spacing: f64,
    /// The points.
    pub points: Vec<Point>,
    /// The total travel of the input, forward and backward, up to each point.
    pub input_travel: Vec<f64>,
    /// The number of points at which a portion may begin.
    pub start_count: usize,
    /// Whether its first point follows its last.
    pub is_closed: bool,
    /// The length of the polyline up to each point.
    pub cumulative_length: Vec<f64>,
    /// The greatest distance between neighbouring points.
    pub longest_chord: f64,
}

impl CurveSegment {
    /// The whole of a sampled curve.
    pub fn whole(curve: Rc<SampledCurve>) -> CurveSegment {
        let (intervals, is_closed) = (curve.interval_count(), curve.is_closed);
        let mut segment = CurveSegment::evenly_spaced(curve, [0.0, 1.0], intervals + usize::from(!is_closed));
        if is_closed {
            segment.append_second_round();
        }
        segment
    }

    /// The piece between two positions, with many more points.
    pub fn resample(&self, [from, to]: [f64; 2]) -> CurveSegment {
        const INTERVALS: usize = 96;
        let spacing = (to - from) * self.spacing / INTERVALS as f64;
        CurveSegment::evenly_spaced(
            self.sampled_curve.clone(),
            [self.start + from * self.spacing, spacing],
            INTERVALS + 1,
        )
    }

    /// An open segment of `count` points of a sampled curve, from a first position and with a spacing in samples.
    fn evenly_spaced(curve: Rc<SampledCurve>, [first, spacing]: [f64; 2], count: usize) -> CurveSegment {
        let start = curve.input_travel_at(first);
        let (mut points, mut travel) = (Vec::with_capacity(2 * count), Vec::with_capacity(2 * count));
        for k in 0..count {
            let (point, travel_at) = curve.point_and_travel_at(first + k as f64 * spacing);
            points.push(point);
            travel.push(travel_at - start);
        }
        let mut cumulative_length = Vec::with_capacity(2 * count);
        cumulative_length.push(0.0);
        let mut longest_chord = f64::MIN_POSITIVE;
        for pair in points.windows(2) {
            let chord = (pair[1] - pair[0]).norm();
            longest_chord = longest_chord.max(chord);
            cumulative_length.push(cumulative_length[cumulative_length.len() - 1] + chord);
        }
        let start_count = count.saturating_sub(1);
        CurveSegment {
            sampled_curve: curve,
            start: first,
            spacing,
            points,
            input_travel: travel,
            start_count,
            is_closed: false,
            cumulative_length,
            longest_chord,
        }
    }

    /// Closes the row and repeats its points.
    fn append_second_round(&mut self) {
        let count = self.points.len();
        let round_travel = self.sampled_curve.input_travel[self.sampled_curve.points.len()];
        let closing = (self.points[0] - self.points[count - 1]).norm();
        let round_length = self.cumulative_length[count - 1] + closing;
        self.points.extend_from_within(..);
        self.input_travel.extend_from_within(..);
        self.cumulative_length.extend_from_within(..);
        self.input_travel[count..].iter_mut().for_each(|travel| *travel += round_travel);
        self.cumulative_length[count..].iter_mut().for_each(|length| *length += round_length);
        (self.start_count, self.is_closed) = (count, true);
        self.longest_chord = self.longest_chord.max(closing);
    }

    /// The signed curvature at a point, from its neighbours.
    fn curvature(&self, k: usize) -> f64 {
        let count = self.points.len();
        let k = k.clamp(1, count.max(3) - 2);
        let [a, b, c] = [k - 1, k, k + 1].map(|k| self.points[k.min(count - 1)]);
        let curvature = 2.0 * cross(b - a, c - b) / ((b - a).norm() * (c - b).norm() * (c - a).norm());
        if curvature.is_finite() { curvature } else { 0.0 }
    }

    /// The last point at which a portion that begins at a point may end.
    pub fn last_end(&self, from: usize) -> usize {
        if self.is_closed { from + self.start_count - 1 } else { self.points.len() - 1 }
    }

    /// The distance of two of its points.
    pub fn distance(&self, [from, to]: [usize; 2]) -> f64 {
        (self.points[to] - self.points[from]).norm()
    }

    /// The first point after another that is further along the polyline than a distance, searched for from a `guess`.
    pub fn first_point_beyond(&self, from: usize, distance: f64, guess: usize) -> usize {
        let (far, last) = (self.cumulative_length[from] + distance, self.cumulative_length.len());
        let is_beyond = |to: usize| to >= last || self.cumulative_length[to] > far;
        let mut to = guess.clamp(from + 1, last);
        // Gallop in one direction, then bisect.
        let mut step = 1;
        let (low, high) = if is_beyond(to) {
            while to > from + step && is_beyond(to - step) {
                to -= step;
                step *= 2;
            }
            ((from + 1).max(to.saturating_sub(step)), to)
        } else {
            while !is_beyond(to + step) {
                to += step;
                step *= 2;
            }
            (to + 1, (to + step).min(last))
        };
        low + self.cumulative_length[low..high].partition_point(|&length| length <= far)
    }

    /// The ends of a portion, moved by a round of a closed curve, or to the ends of an open one, so that they are
    /// positions of the segment.
    pub fn clamp(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        let round = self.start_count as f64;
        if !self.is_closed {
            return [from.max(0.0), to.min((self.points.len() - 1) as f64)];
        }
        let shift = if from < 0.0 { round } else { 0.0 };
        [from + shift, (to + shift).min(from + shift + round - 1.0)]
    }

    /// The point at a position.
    pub fn point_at(&self, position: f64) -> Point {
        let whole = position as usize;
        if whole as f64 == position
            && let Some(point) = self.points.get(whole)
        {
            return *point;
        }
        self.sampled_curve.point_and_input_at(self.start + position * self.spacing).0
    }

    /// The input at a position.
    pub fn input_at(&self, position: f64) -> f64 {
        self.sampled_curve.point_and_input_at(self.start + position * self.spacing).1
    }

    /// The travel of the input, forward and backward, from one position to another.
    pub fn input_span(&self, ends: [f64; 2]) -> f64 {
        let [from, to] = ends.map(|position| self.sampled_curve.input_travel_at(self.start + position * self.spacing));
        (to - from).max(0.0)
    }

    /// The position that is a span of input after another.
    pub fn end_after_input(&self, from: f64, span: f64) -> Option<f64> {
        let round = self.start_count as f64;
        if self.is_closed && from >= round {
            return Some(self.end_after_input(from - round, span)? + round);
        }
        let first = from as usize;
        let start = self.input_span([0.0, from]);
        // The whole of a closed curve ends where it begins.
        let last = if self.is_closed { first + self.start_count } else { self.last_end(first) };
        let span = span * (1.0 - 1e-12);
        let beyond = first + self.input_travel[first..=last].partition_point(|&travel| travel - start < span);
        if beyond > last {
            return None;
        }
        let (mut low, mut high) = ((beyond as f64 - 1.0).max(from), beyond as f64);
        for _ in 0..40 {
            let middle = (low + high) / 2.0;
            if self.input_span([0.0, middle]) - start < span { low = middle } else { high = middle }
        }
        Some(high)
    }

    /// The first position after another whose point is at a distance from that of the other.
    pub fn end_after_length(&self, from: f64, length: f64) -> Option<f64> {
        let round = self.start_count as f64;
        if self.is_closed && from >= round {
            return Some(self.end_after_length(from - round, length)? + round);
        }
        let start = self.point_at(from);
        let first = from as usize;
        let mut to = first + 1;
        let last = self.last_end(first);
        while to <= last {
            let far = (self.points[to] - start).norm();
            if far >= length {
                break;
            }
            to = self.first_point_beyond(to, length - far, to + 1);
        }
        if to > last {
            return None;
        }
        let (mut low, mut high) = ((to as f64 - 1.0).max(from), to as f64);
        for _ in 0..50 {
            let middle = (low + high) / 2.0;
            if (self.point_at(middle) - start).norm() < length { low = middle } else { high = middle }
        }
        Some(high)
    }

    /// The points of a portion, including its ends; more of them are interpolated if they are few.
    pub fn portion_points(&self, [from, to]: [f64; 2]) -> Vec<Point> {
        const POINTS: f64 = 48.0;
        if to <= from {
            return vec![self.point_at(from)];
        }
        let parts = (POINTS / (to - from)).ceil().max(1.0);
        let first = (from * parts).floor() as i64 + 1;
        let inside = (first..)
            .map(|k| k as f64 / parts)
            .take_while(|&position| position < to)
            .map(|position| self.point_at(position));
        std::iter::once(self.point_at(from)).chain(inside).chain(std::iter::once(self.point_at(to))).collect()
    }

    /// A lower bound for the width of the narrowest strip around the portion between two points: that of an arc with
    /// the least curvature of the portion.
    pub fn strip_width_bound(&self, [from, to]: [usize; 2]) -> f64 {
        let chord = self.distance([from, to]);
        let (mut least, mut left_count) = (f64::INFINITY, 0);
        for curvature in (from..=to).map(|k| self.curvature(k)) {
            least = least.min(curvature.abs());
            left_count += usize::from(curvature > 0.0);
        }
        if left_count == 0 || left_count == to - from + 1 { least * chord * chord / 8.0 } else { 0.0 }
    }

    /// The points with the locally least curvature, the flattest first.
    pub fn flattest_points(&self) -> Vec<usize> {
        let n = self.start_count;
        let curvatures: Vec<f64> = (0..=n.min(self.points.len() - 1)).map(|k| self.curvature(k).abs()).collect();
        let curvature = |k: usize| curvatures[k];
        let is_least = |&k: &usize| {
            let before = if k > 0 { curvature(k - 1) } else { curvature(if self.is_closed { n - 1 } else { 1 }) };
            curvature(k) <= before && curvature(k) <= curvature((k + 1).min(curvatures.len() - 1))
        };
        let mut found: Vec<usize> = (0..n).filter(is_least).collect();
        found.sort_by(|&a, &b| curvature(a).total_cmp(&curvature(b)));
        found
    }

    /// Moves the ends of a portion, by a point at most, to where it is largest and still fits. Returns its size and its
    /// ends; `None` if nothing fits. `fit_from` returns, for the position at which a portion begins, a function of the
    /// position at which it ends.
    pub fn extend<F: FnMut(f64) -> PortionFit>(
        &self,
        ends: [f64; 2],
        fit_from: impl Fn(f64) -> F,
    ) -> Option<(f64, [f64; 2])> {
        /// Golden section steps for the beginning: to a tenth of the distance between points. Around the maximum the
        /// size changes by the square of that.
        const ROUNDS: usize = 6;
        /// Tolerances for the end, in distances between points: during the search for the beginning, and of the result.
        const END_TOLERANCES: [f64; 2] = [1e-2, 1e-5];
        let whole = fit_from(ends[0])(ends[1]);
        let whole = (whole.excess <= 0.0).then_some((whole.size, ends));
        if ends[1] - ends[0] < 3.0 {
            return whole;
        }
        let [low, high] = self.clamp([ends[0] - 1.0, ends[1] + 1.0]);
        let shift = if low > ends[0] { self.start_count as f64 } else { 0.0 };
        let [from, to] = ends.map(|position| position + shift);
        let end_of = |start: f64, tolerance| {
            let mut fit = fit_from(start - shift);
            furthest_fit(tolerance, [to - 1.0, high], |end| fit(end - shift))
        };
        let (mut a, mut b) = (low, from + 1.0);
        let (mut c, mut d) = (b - GOLDEN_SECTION * (b - a), a + GOLDEN_SECTION * (b - a));
        let (mut at_c, mut at_d) = (end_of(c, END_TOLERANCES[0]), end_of(d, END_TOLERANCES[0]));
        let mut best = (f64::NEG_INFINITY, from);
        for _ in 0..ROUNDS {
            for (start, (_, size)) in [(c, at_c), (d, at_d)] {
                if size > best.0 {
                    best = (size, start);
                }
            }
            if at_c.1 > at_d.1 {
                (b, d, at_d) = (d, c, at_c);
                c = b - GOLDEN_SECTION * (b - a);
                at_c = end_of(c, END_TOLERANCES[0]);
            } else {
                (a, c, at_c) = (c, d, at_d);
                d = a + GOLDEN_SECTION * (b - a);
                at_d = end_of(d, END_TOLERANCES[0]);
            }
        }
        let (end, size) = end_of(best.1, END_TOLERANCES[1]);
        let found = (size > 0.0).then_some((size, [best.1, end].map(|position| position - shift)));
        if found.is_some_and(|found| whole.is_none_or(|whole| found.0 > whole.0)) { found } else { whole }
    }
}

/// The furthest end between two at which a portion fits, and its size there; if there is none, the end at which it fits
/// best and, instead of the size, the negative excess.
fn furthest_fit(tolerance: f64, [mut low, mut high]: [f64; 2], mut fit: impl FnMut(f64) -> PortionFit) -> (f64, f64) {
    let (mut first, last) = (fit(low), fit(high));
    if last.excess <= 0.0 {
        return (high, last.size);
    }
    if first.excess > 0.0 {
        // A portion that is too wide for its length may fit when it is longer.
        for end in [0.25, 0.5, 0.75].map(|part| low + (high - low) * part) {
            let other = fit(end);
            if other.excess < first.excess {
                (low, first) = (end, other);
            }
        }
        if first.excess > 0.0 {
            return (low, -first.excess);
        }
    }
    let (mut below, mut above, mut size) = (first.excess, last.excess, first.size);
    // The secant method, with a bisection in every third round.
    for round in 0..20 {
        if high - low < tolerance {
            break;
        }
        let part = if round % 3 == 2 || !above.is_finite() { 0.5 } else { (below / (below - above)).clamp(0.02, 0.98) };
        let middle = low + part * (high - low);
        let fit = fit(middle);
        if fit.excess > 0.0 {
            (high, above) = (middle, fit.excess);
        } else {
            (low, below, size) = (middle, fit.excess, fit.size);
        }
    }
    (low, size)
}

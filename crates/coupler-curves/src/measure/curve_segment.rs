use std::rc::Rc;

use super::annulus::GOLDEN_SECTION;
use super::sampled_curve::SampledCurve;
use crate::geometry::{Point, cross};

/// What a portion comes to.
#[derive(Clone, Copy, Debug)]
pub(super) struct PortionFit {
    /// What there should be much of.
    pub size: f64,
    /// By how much it does not fit where it should; none where that is negative.
    pub excess: f64,
}

/// A curve, or a piece of one, as a row of points between which portions of it are looked for.
///
/// A *place* on it is a number: place 2.5 is between points 2 and 3. A closed curve is gone round twice, so that a portion
/// that goes over its first point is a row of points too.
#[derive(Clone, Debug)]
pub(super) struct CurveSegment {
    sampled_curve: Rc<SampledCurve>,
    /// Where its first point is among the trail's, and how far its points are apart there.
    start: f64,
    spacing: f64,
    /// The points.
    pub points: Vec<Point>,
    /// How far the input has gone, there and back, at each point.
    pub input_travel: Vec<f64>,
    /// At how many points a portion may begin.
    pub start_count: usize,
    /// Whether it goes on at its first point after its last.
    pub is_closed: bool,
    /// How long the way by straight lines from point to point is, up to each.
    pub cumulative_length: Vec<f64>,
    /// The longest way from a point to the next.
    pub longest_chord: f64,
}

impl CurveSegment {
    /// A whole curve, by its samples.
    pub fn whole(trail: Rc<SampledCurve>) -> CurveSegment {
        let (once, is_closed) = (trail.interval_count(), trail.is_closed);
        let mut course = CurveSegment::evenly_spaced(trail, [0.0, 1.0], once + usize::from(!is_closed));
        if is_closed {
            course.append_second_round();
        }
        course
    }

    /// A piece of it, by many points.
    pub fn resample(&self, [from, to]: [f64; 2]) -> CurveSegment {
        const INTERVALS: usize = 96;
        let apart = (to - from) * self.spacing / INTERVALS as f64;
        CurveSegment::evenly_spaced(
            self.sampled_curve.clone(),
            [self.start + from * self.spacing, apart],
            INTERVALS + 1,
        )
    }

    /// So many points, as far apart, of an open row.
    fn evenly_spaced(trail: Rc<SampledCurve>, [first, apart]: [f64; 2], count: usize) -> CurveSegment {
        let start = trail.input_travel_at(first);
        let (mut points, mut travel) = (Vec::with_capacity(2 * count), Vec::with_capacity(2 * count));
        for k in 0..count {
            let (point, travelled) = trail.point_and_travel_at(first + k as f64 * apart);
            points.push(point);
            travel.push(travelled - start);
        }
        let mut way = Vec::with_capacity(2 * count);
        way.push(0.0);
        let mut longest_chord = f64::MIN_POSITIVE;
        for pair in points.windows(2) {
            let chord = (pair[1] - pair[0]).norm();
            longest_chord = longest_chord.max(chord);
            way.push(way[way.len() - 1] + chord);
        }
        let starts = count.saturating_sub(1);
        CurveSegment {
            sampled_curve: trail,
            start: first,
            spacing: apart,
            points,
            input_travel: travel,
            start_count: starts,
            is_closed: false,
            cumulative_length: way,
            longest_chord,
        }
    }

    /// Closes the row, and goes round a second time.
    fn append_second_round(&mut self) {
        let once = self.points.len();
        let turn = self.sampled_curve.input_travel[self.sampled_curve.points.len()];
        let closing = (self.points[0] - self.points[once - 1]).norm();
        let round = self.cumulative_length[once - 1] + closing;
        self.points.extend_from_within(..);
        self.input_travel.extend_from_within(..);
        self.cumulative_length.extend_from_within(..);
        self.input_travel[once..].iter_mut().for_each(|travel| *travel += turn);
        self.cumulative_length[once..].iter_mut().for_each(|way| *way += round);
        (self.start_count, self.is_closed) = (once, true);
        self.longest_chord = self.longest_chord.max(closing);
    }

    /// The signed curvature at a point, by its neighbours.
    fn curvature(&self, k: usize) -> f64 {
        let count = self.points.len();
        let k = k.clamp(1, count.max(3) - 2);
        let [a, b, c] = [k - 1, k, k + 1].map(|k| self.points[k.min(count - 1)]);
        let bend = 2.0 * cross(b - a, c - b) / ((b - a).norm() * (c - b).norm() * (c - a).norm());
        if bend.is_finite() { bend } else { 0.0 }
    }

    /// The last point a portion may end at that begins at a place.
    pub fn last_end(&self, from: usize) -> usize {
        if self.is_closed { from + self.start_count - 1 } else { self.points.len() - 1 }
    }

    /// How far two of its points are apart.
    pub fn distance(&self, [from, to]: [usize; 2]) -> f64 {
        (self.points[to] - self.points[from]).norm()
    }

    /// The first point after another that is further on along the way than some distance, likely near a `guess`.
    pub fn first_point_beyond(&self, from: usize, distance: f64, guess: usize) -> usize {
        let (far, last) = (self.cumulative_length[from] + distance, self.cumulative_length.len());
        let is_beyond = |to: usize| to >= last || self.cumulative_length[to] > far;
        let mut to = guess.clamp(from + 1, last);
        // In longer and longer steps one way, and then between the last two.
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
        low + self.cumulative_length[low..high].partition_point(|&way| way <= far)
    }

    /// A place, moved round a closed curve, or to the end of an open one, so that it is one of its own.
    pub fn clamp(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        let round = self.start_count as f64;
        if !self.is_closed {
            return [from.max(0.0), to.min((self.points.len() - 1) as f64)];
        }
        let turn = if from < 0.0 { round } else { 0.0 };
        [from + turn, (to + turn).min(from + turn + round - 1.0)]
    }

    /// The point at a place.
    pub fn point_at(&self, place: f64) -> Point {
        let whole = place as usize;
        if whole as f64 == place
            && let Some(point) = self.points.get(whole)
        {
            return *point;
        }
        self.sampled_curve.point_and_input_at(self.start + place * self.spacing).0
    }

    /// The input at a place.
    pub fn input_at(&self, place: f64) -> f64 {
        self.sampled_curve.point_and_input_at(self.start + place * self.spacing).1
    }

    /// How far the input goes, there and back, from one place to another.
    pub fn input_span(&self, ends: [f64; 2]) -> f64 {
        let [from, to] = ends.map(|place| self.sampled_curve.input_travel_at(self.start + place * self.spacing));
        (to - from).max(0.0)
    }

    /// The place a span of input after another.
    pub fn end_after_input(&self, from: f64, span: f64) -> Option<f64> {
        let round = self.start_count as f64;
        if self.is_closed && from >= round {
            return Some(self.end_after_input(from - round, span)? + round);
        }
        let first = from as usize;
        let start = self.input_span([0.0, from]);
        // All of a closed curve ends where it begins.
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

    /// The first place a distance away from another.
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

    /// The points of a portion, its ends among them; more between them where they are few.
    pub fn portion_points(&self, [from, to]: [f64; 2]) -> Vec<Point> {
        const POINTS: f64 = 48.0;
        if to <= from {
            return vec![self.point_at(from)];
        }
        let parts = (POINTS / (to - from)).ceil().max(1.0);
        let first = (from * parts).floor() as i64 + 1;
        let inside =
            (first..).map(|k| k as f64 / parts).take_while(|&place| place < to).map(|place| self.point_at(place));
        std::iter::once(self.point_at(from)).chain(inside).chain(std::iter::once(self.point_at(to))).collect()
    }

    /// No more than the width of the narrowest strip of the portion between two points: that of a circle which bends as
    /// little as any part of it does.
    pub fn strip_width_bound(&self, [from, to]: [usize; 2]) -> f64 {
        let chord = self.distance([from, to]);
        let (mut least, mut left) = (f64::INFINITY, 0);
        for bend in (from..=to).map(|k| self.curvature(k)) {
            least = least.min(bend.abs());
            left += usize::from(bend > 0.0);
        }
        if left == 0 || left == to - from + 1 { least * chord * chord / 8.0 } else { 0.0 }
    }

    /// The points at which it bends less than at their neighbours, the straightest first.
    pub fn flattest_points(&self) -> Vec<usize> {
        let n = self.start_count;
        let bends: Vec<f64> = (0..=n.min(self.points.len() - 1)).map(|k| self.curvature(k).abs()).collect();
        let bend = |k: usize| bends[k];
        let is_least = |&k: &usize| {
            let before = if k > 0 { bend(k - 1) } else { bend(if self.is_closed { n - 1 } else { 1 }) };
            bend(k) <= before && bend(k) <= bend((k + 1).min(bends.len() - 1))
        };
        let mut found: Vec<usize> = (0..n).filter(is_least).collect();
        found.sort_by(|&a, &b| bend(a).total_cmp(&bend(b)));
        found
    }

    /// The size and the ends of a portion whose ends are moved, by a point at most, to where it is largest and still fits;
    /// `None` where nothing fits. What begins at a place is asked how it fits up to some ends.
    pub fn extend<F: FnMut(f64) -> PortionFit>(
        &self,
        ends: [f64; 2],
        beginning: impl Fn(f64) -> F,
    ) -> Option<(f64, [f64; 2])> {
        /// Golden sections of the two points between which it begins: to a tenth of the way between points. About the
        /// largest the size changes by the square of that.
        const ROUNDS: usize = 6;
        /// How near to its furthest its end is taken, by the way between points, on the way and at last.
        const NEAR: [f64; 2] = [1e-2, 1e-5];
        let whole = beginning(ends[0])(ends[1]);
        let whole = (whole.excess <= 0.0).then_some((whole.size, ends));
        if ends[1] - ends[0] < 3.0 {
            return whole;
        }
        let [low, high] = self.clamp([ends[0] - 1.0, ends[1] + 1.0]);
        let shift = if low > ends[0] { self.start_count as f64 } else { 0.0 };
        let [from, to] = ends.map(|place| place + shift);
        let end_of = |start: f64, near| {
            let mut fit = beginning(start - shift);
            furthest_fit(near, [to - 1.0, high], |end| fit(end - shift))
        };
        let (mut a, mut b) = (low, from + 1.0);
        let (mut c, mut d) = (b - GOLDEN_SECTION * (b - a), a + GOLDEN_SECTION * (b - a));
        let (mut at_c, mut at_d) = (end_of(c, NEAR[0]), end_of(d, NEAR[0]));
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
                at_c = end_of(c, NEAR[0]);
            } else {
                (a, c, at_c) = (c, d, at_d);
                d = a + GOLDEN_SECTION * (b - a);
                at_d = end_of(d, NEAR[0]);
            }
        }
        let (end, size) = end_of(best.1, NEAR[1]);
        let found = (size > 0.0).then_some((size, [best.1, end].map(|place| place - shift)));
        if found.is_some_and(|found| whole.is_none_or(|whole| found.0 > whole.0)) { found } else { whole }
    }
}

/// The furthest end, of those between two, up to which a portion fits, and its size there; where none does, the end at
/// which it fits best, and for its size by how much it does not, less than nothing.
fn furthest_fit(near: f64, [mut low, mut high]: [f64; 2], mut fit: impl FnMut(f64) -> PortionFit) -> (f64, f64) {
    let (mut first, last) = (fit(low), fit(high));
    if last.excess <= 0.0 {
        return (high, last.size);
    }
    if first.excess > 0.0 {
        // What is too wide for its length may not be when it is longer.
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
    // By secants, and halves where those are slow.
    for round in 0..20 {
        if high - low < near {
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

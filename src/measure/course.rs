use super::annulus::GOLDEN;
use super::trail::Trail;
use crate::geometry::{Point, cross};

/// What a portion comes to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
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
pub(super) struct Course<'a> {
    trail: &'a Trail,
    /// Where its first point is among the trail's, and how far its points are apart there.
    first: f64,
    apart: f64,
    /// The points.
    pub points: Vec<Point>,
    /// How far the input has gone, there and back, at each point.
    pub travel: Vec<f64>,
    /// The curvature at each point.
    bends: Vec<f64>,
    /// At how many points a portion may begin.
    pub starts: usize,
    /// Whether it goes on at its first point after its last.
    pub is_closed: bool,
    /// How long the way by straight lines from point to point is, up to each.
    pub way: Vec<f64>,
    /// The longest way from a point to the next.
    pub longest_chord: f64,
}

impl<'a> Course<'a> {
    /// A whole curve, by its samples or, where they are few, more points.
    pub fn of(trail: &'a Trail) -> Course<'a> {
        /// Portions are found between so many points, and then between those.
        const POINTS: usize = 360;
        let fold = POINTS.div_ceil(trail.points.len().max(1));
        let once = trail.intervals() * fold;
        let count = if trail.closed { 2 * once } else { once + 1 };
        Course::sampled(trail, [0.0, 1.0 / fold as f64], count, trail.closed.then_some(once))
    }

    /// A piece of it, by many points.
    pub fn piece(&self, [from, to]: [f64; 2]) -> Course<'a> {
        const INTERVALS: usize = 96;
        let apart = (to - from) * self.apart / INTERVALS as f64;
        Course::sampled(self.trail, [self.first + from * self.apart, apart], INTERVALS + 1, None)
    }

    fn sampled(trail: &'a Trail, [first, apart]: [f64; 2], count: usize, round: Option<usize>) -> Course<'a> {
        let once = round.unwrap_or(count);
        let place = |k: usize| first + k as f64 * apart;
        let mut points: Vec<Point> = (0..once).map(|k| trail.place(place(k)).0).collect();
        for k in once..count {
            points.push(points[k - once]);
        }
        let travel = (0..count).map(|k| trail.travelled(place(k)) - trail.travelled(first)).collect();
        let mut way = Vec::with_capacity(count);
        way.push(0.0);
        let mut longest_chord = f64::MIN_POSITIVE;
        for pair in points.windows(2) {
            let chord = (pair[1] - pair[0]).norm();
            longest_chord = longest_chord.max(chord);
            way.push(way[way.len() - 1] + chord);
        }
        let bend = |k: usize| {
            let k = k.clamp(1, count.max(3) - 2);
            let [a, b, c] = [k - 1, k, k + 1].map(|k| points[k.min(count - 1)]);
            let bend = 2.0 * cross(b - a, c - b) / ((b - a).norm() * (c - b).norm() * (c - a).norm());
            if bend.is_finite() { bend } else { 0.0 }
        };
        let bends = (0..count).map(bend).collect();
        let starts = round.unwrap_or(count - 1);
        Course { trail, first, apart, points, travel, bends, starts, is_closed: round.is_some(), way, longest_chord }
    }

    /// The last point a portion may end at that begins at a place.
    pub fn last(&self, from: usize) -> usize {
        if self.is_closed { from + self.starts - 1 } else { self.points.len() - 1 }
    }

    /// How far two of its points are apart.
    pub fn distance(&self, [from, to]: [usize; 2]) -> f64 {
        (self.points[to] - self.points[from]).norm()
    }

    /// The last point no further on than some way, of those after another.
    pub fn way_on(&self, from: usize, way: f64) -> usize {
        let mut to = from;
        while to + 1 < self.way.len() && self.way[to + 1] - self.way[from] <= way {
            to += 1;
        }
        to
    }

    /// A place, moved round a closed curve, or to the end of an open one, so that it is one of its own.
    pub fn clamp(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        let round = self.starts as f64;
        if !self.is_closed {
            return [from.max(0.0), to.min((self.points.len() - 1) as f64)];
        }
        let turn = if from < 0.0 { round } else { 0.0 };
        [from + turn, (to + turn).min(from + turn + round - 1.0)]
    }

    /// The point at a place.
    pub fn point(&self, place: f64) -> Point {
        if place >= 0.0
            && place.fract() == 0.0
            && let Some(point) = self.points.get(place as usize)
        {
            return *point;
        }
        self.trail.place(self.first + place * self.apart).0
    }

    /// The input at a place.
    pub fn input(&self, place: f64) -> f64 {
        self.trail.place(self.first + place * self.apart).1
    }

    /// How far the input goes, there and back, from one place to another.
    pub fn spanned(&self, ends: [f64; 2]) -> f64 {
        let [from, to] = ends.map(|place| self.trail.travelled(self.first + place * self.apart));
        (to - from).max(0.0)
    }

    /// The place a span of input after another.
    pub fn after_input(&self, from: f64, span: f64) -> Option<f64> {
        let first = from.floor() as usize;
        let start = self.spanned([0.0, from]);
        // All of a closed curve ends where it begins.
        let last = if self.is_closed { first + self.starts } else { self.last(first) };
        let span = span * (1.0 - 1e-12);
        let beyond = first + self.travel[first..=last].partition_point(|&travel| travel - start < span);
        if beyond > last {
            return None;
        }
        let (mut low, mut high) = ((beyond as f64 - 1.0).max(from), beyond as f64);
        for _ in 0..40 {
            let middle = (low + high) / 2.0;
            if self.spanned([0.0, middle]) - start < span { low = middle } else { high = middle }
        }
        Some(high)
    }

    /// The first place a distance away from another.
    pub fn after_length(&self, from: f64, length: f64) -> Option<f64> {
        let start = self.point(from);
        let first = from as usize;
        let mut to = first + 1;
        let last = self.last(first);
        while to <= last {
            let far = (self.points[to] - start).norm();
            if far >= length {
                break;
            }
            to = self.way_on(to, length - far).max(to + 1);
        }
        if to > last {
            return None;
        }
        let (mut low, mut high) = ((to as f64 - 1.0).max(from), to as f64);
        for _ in 0..50 {
            let middle = (low + high) / 2.0;
            if (self.point(middle) - start).norm() < length { low = middle } else { high = middle }
        }
        Some(high)
    }

    /// The points of a portion, its ends among them; more between them where they are few.
    pub fn portion(&self, [from, to]: [f64; 2]) -> Vec<Point> {
        const POINTS: f64 = 48.0;
        if to <= from {
            return vec![self.point(from)];
        }
        let parts = (POINTS / (to - from)).ceil().max(1.0);
        let first = (from * parts).floor() as i64 + 1;
        let inside = (first..).map(|k| k as f64 / parts).take_while(|&place| place < to).map(|place| self.point(place));
        std::iter::once(self.point(from)).chain(inside).chain(std::iter::once(self.point(to))).collect()
    }

    /// No more than the width of the narrowest strip of the portion between two points: that of a circle which bends as
    /// little as any part of it does.
    pub fn bend_between(&self, [from, to]: [usize; 2]) -> f64 {
        let chord = self.distance([from, to]);
        let bends = &self.bends[from..=to];
        let least = bends.iter().fold(f64::INFINITY, |least, bend| least.min(bend.abs()));
        let is_one_way = bends.iter().all(|bend| (*bend > 0.0) == (bends[0] > 0.0));
        if is_one_way { least * chord * chord / 8.0 } else { 0.0 }
    }

    /// The points at which it bends less than at their neighbours, the straightest first.
    pub fn flattest(&self) -> Vec<usize> {
        let bend = |k: usize| self.bends[k].abs();
        let n = self.starts;
        let is_least = |&k: &usize| {
            let before = if k > 0 { bend(k - 1) } else { bend(if self.is_closed { n - 1 } else { 1 }) };
            bend(k) <= before && bend(k) <= bend((k + 1).min(self.bends.len() - 1))
        };
        let mut found: Vec<usize> = (0..n).filter(is_least).collect();
        found.sort_by(|&a, &b| bend(a).total_cmp(&bend(b)));
        found
    }

    /// The size and the ends of a portion whose ends are moved, by a point at most, to where it is largest and still fits;
    /// `None` where nothing fits.
    pub fn drawn_out(&self, ends: [f64; 2], fit: impl Fn([f64; 2]) -> Fit) -> Option<(f64, [f64; 2])> {
        /// Golden sections of the two points between which it begins: to a tenth of the way between points. About the
        /// largest the size changes by the square of that.
        const ROUNDS: usize = 6;
        /// How near to its furthest its end is taken, by the way between points, on the way and at last.
        const NEAR: [f64; 2] = [1e-2, 1e-5];
        let whole = fit(ends);
        let whole = (whole.excess <= 0.0).then_some((whole.size, ends));
        if ends[1] - ends[0] < 3.0 {
            return whole;
        }
        let [low, high] = self.clamp([ends[0] - 1.0, ends[1] + 1.0]);
        let shift = if low > ends[0] { self.starts as f64 } else { 0.0 };
        let [from, to] = ends.map(|place| place + shift);
        let end_of = |start: f64, near| furthest(near, [to - 1.0, high], |end| fit([start - shift, end - shift]));
        let (mut a, mut b) = (low, from + 1.0);
        let (mut c, mut d) = (b - GOLDEN * (b - a), a + GOLDEN * (b - a));
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
                c = b - GOLDEN * (b - a);
                at_c = end_of(c, NEAR[0]);
            } else {
                (a, c, at_c) = (c, d, at_d);
                d = a + GOLDEN * (b - a);
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
fn furthest(near: f64, [mut low, mut high]: [f64; 2], fit: impl Fn(f64) -> Fit) -> (f64, f64) {
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

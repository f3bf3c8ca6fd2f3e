//! Limits by sampling: zeros of what is left to stretch or fold are bracketed and refined to the last bit.

use super::Dyad;
use crate::linkage::{Flat, Input, Linkage, Signs, Step};
use crate::motion::circuit::Stop;
use crate::motion::interval::{Cause, IntervalEnd, Span};
use crate::motion::jet::Jets;
use crate::motion::kernel::{Columns, Modes, OwnInputs, place};

/// Samples to a turn when zeros are bracketed.
const SAMPLES: usize = 720;

/// A dyad whose reach is sampled along a span.
pub(super) struct Sampled<'a> {
    pub linkage: &'a Linkage,
    pub dyad: &'a Dyad,
    pub span: Span,
    pub signs: Signs,
}

impl Sampled<'_> {
    /// The extent at each input; the ends of the span with the dyad flat that ends it.
    fn extents(&self, degs: &[f64]) -> Vec<f64> {
        let input = self.linkage.input();
        let stops: Vec<Stop> = degs.iter().map(|&at| Stop::of(input, at)).collect();
        let mut out = Columns::new(self.linkage.joints.len(), degs.len());
        let joints = self.dyad.joint;
        let modes = Modes::new(self.signs, Flat::NONE);
        let inputs = OwnInputs::new(&stops);
        place(self.linkage, joints, inputs.all(), &modes, &mut out, 0..degs.len());
        if let Span::Arc { lower, upper } = self.span {
            for (i, deg) in degs.iter().enumerate() {
                for end in [lower, upper].into_iter().filter(|end| end.stop.at == *deg) {
                    let modes = Modes::new(self.signs, end.flat);
                    let inputs = OwnInputs::new(&[end.stop]);
                    place(self.linkage, joints, inputs.all(), &modes, &mut out, i..i + 1);
                }
            }
        }
        (0..degs.len()).map(|i| self.dyad.extent(|joint| out.point(joint, i))).collect()
    }

    /// What is left to stretch or to fold at an input, whichever is less; negative where the dyad does not close.
    fn room(&self, deg: f64) -> f64 {
        self.room_of(self.extents(&[deg])[0])
    }

    fn room_of(&self, extent: f64) -> f64 {
        let [low, high] = self.dyad.bounds();
        let room = (high - extent).min(extent - low);
        if room.is_nan() { -1.0 } else { room }
    }

    fn grid(&self) -> Vec<f64> {
        let (from, to) = match self.span {
            Span::Turn => (0.0, self.linkage.input().period()),
            Span::Arc { lower, upper } => (lower.stop.at, upper.stop.at),
        };
        let turns = if self.linkage.input() == Input::Length { 1.0 } else { (to - from) / 360.0 };
        let n = (turns * SAMPLES as f64).ceil() as usize + 4;
        let at = |i: usize| if i == n { to } else { from + (to - from) * i as f64 / n as f64 };
        (0..=n).map(at).collect()
    }

    /// The least and the greatest extent.
    pub fn range(&self) -> [f64; 2] {
        let extents = self.extents(&self.grid());
        let fold = |pick: fn(f64, f64) -> f64, start| extents.iter().copied().fold(start, pick);
        [fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY)]
    }

    pub fn spans(&self, next_id: &mut usize) -> Vec<Span> {
        let mut degs = self.grid();
        let extents = self.extents(&degs);
        let tolerance = self.tolerance(&extents);
        if matches!(self.dyad.step, Step::Dyad { .. }) && extents.iter().all(|extent| *extent <= tolerance) {
            // Two joints that are one point throughout leave their dyad free to turn: it has no place.
            return Vec::new();
        }
        let mut rooms: Vec<f64> = extents.iter().map(|&extent| self.room_of(extent)).collect();
        let touched = self.look_between(&mut degs, &mut rooms, tolerance);
        let open: Vec<bool> = rooms.iter().map(|room| *room >= -tolerance).collect();
        let mut end = |inside: f64, outside: f64| {
            *next_id += 1;
            let stop = Stop::of(self.linkage.input(), self.refine(inside, outside));
            IntervalEnd::flat(stop, Cause::Limit, self.dyad.index, *next_id)
        };
        let mut arcs: Vec<(Option<IntervalEnd>, Option<IntervalEnd>)> = Vec::new();
        let mut lower = open[0].then_some(None);
        for i in 1..degs.len() {
            match (open[i - 1], open[i]) {
                (false, true) => lower = Some(Some(end(degs[i], degs[i - 1]))),
                (true, false) => arcs.extend(lower.take().map(|from| (from, Some(end(degs[i - 1], degs[i]))))),
                _ => {}
            }
        }
        arcs.extend(lower.map(|from| (from, None)));
        let spans = self.joined(arcs, tolerance);
        touched.into_iter().fold(spans, |spans, at| {
            *next_id += 1;
            let stop = Stop::of(self.linkage.input(), at);
            parted(spans, IntervalEnd::flat(stop, Cause::Change, self.dyad.index, *next_id), self.linkage.input())
        })
    }

    /// Extents that differ by no more than their rounding: what is within this of a bound touches it.
    fn tolerance(&self, extents: &[f64]) -> f64 {
        let [low, high] = self.dyad.bounds();
        let finite = if high.is_finite() { high.abs() } else { 0.0 };
        let greatest = extents.iter().copied().filter(|e| e.is_finite()).fold(0.0, |a: f64, b| a.max(b.abs()));
        64.0 * f64::EPSILON * (low.abs() + finite + greatest)
    }

    /// The end of the span, where this dyad lies flat too if there is no room left.
    fn at_end(&self, end: IntervalEnd, tolerance: f64) -> IntervalEnd {
        let extent = self.extents(&[end.stop.at])[0];
        if end.cause == Cause::Asked || self.room_of(extent).abs() > tolerance {
            return end;
        }
        end.with(self.dyad.index, matches!(self.dyad.step, Step::Dyad { .. }) && extent <= tolerance)
    }

    /// Gives the arcs that reach the ends of the span those ends; on a whole turn, joins them over input 0.
    fn joined(&self, mut arcs: Vec<(Option<IntervalEnd>, Option<IntervalEnd>)>, tolerance: f64) -> Vec<Span> {
        match self.span {
            Span::Turn => {
                let over_zero = arcs.len() > 1 && arcs[0].0.is_none() && arcs[arcs.len() - 1].1.is_none();
                if over_zero {
                    let (_, upper) = arcs.remove(0);
                    let last = arcs.len() - 1;
                    arcs[last].1 = upper.map(|end| end.turned(self.linkage.input().period()));
                }
                let span = |arc| match arc {
                    (Some(lower), Some(upper)) => Span::Arc { lower, upper },
                    _ => Span::Turn,
                };
                arcs.into_iter().map(span).collect()
            }
            Span::Arc { lower, upper } => arcs
                .into_iter()
                .map(|(from, to)| Span::Arc {
                    lower: from.unwrap_or_else(|| self.at_end(lower, tolerance)),
                    upper: to.unwrap_or_else(|| self.at_end(upper, tolerance)),
                })
                .filter(|span| matches!(span, Span::Arc { lower, upper } if lower.stop.at < upper.stop.at))
                .collect(),
        }
    }

    /// Inserts the bottom of a dip, or the top of a rise, that passes a bound between samples. The inputs at which a
    /// bound is touched and not passed are returned.
    fn look_between(&self, degs: &mut Vec<f64>, rooms: &mut Vec<f64>, tolerance: f64) -> Vec<f64> {
        let mut found = Vec::new();
        let mut touched = Vec::new();
        for i in 1..degs.len() - 1 {
            let (before, here, after) = (rooms[i - 1], rooms[i], rooms[i + 1]);
            let is_open = here >= -tolerance;
            let sign = if is_open { 1.0 } else { -1.0 };
            let is_turning = sign * before >= sign * here && sign * here <= sign * after;
            // Between samples the room changes by no more than a few times what it changed to the next one.
            let is_near = here.abs() <= 4.0 * (before - here).abs().max((after - here).abs());
            if is_turning && is_near {
                let deg = golden(degs[i - 1], degs[i + 1], |deg| sign * self.room(deg));
                let room = self.room(deg);
                // Near where a bound is touched the room is as flat as its rounding: the slope tells the place.
                let at = self.level(degs[i - 1], degs[i + 1]).unwrap_or(deg);
                let clear = before.min(after) > 1e3 * tolerance;
                if is_open && room < -tolerance || !is_open && room >= -tolerance {
                    found.push((deg, room));
                } else if is_open && clear && self.room(at) <= tolerance {
                    touched.push(at);
                }
            }
        }
        for (deg, room) in found {
            let at = degs.partition_point(|d| *d < deg);
            degs.insert(at, deg);
            rooms.insert(at, room);
        }
        touched
    }

    /// Where the length of the base is least or greatest between two inputs, by bisection of its rate.
    fn level(&self, a: f64, b: f64) -> Option<f64> {
        let (Step::Dyad { base: [p, q], .. } | Step::Slot { base: [p, q], .. }) = self.dyad.step else { return None };
        let rate = |at: f64| {
            let stop = Stop::of(self.linkage.input(), at);
            let jets = Jets::in_fixed_frame(self.linkage, stop, self.signs, Flat::NONE);
            (jets.place(q) - jets.place(p)).dot(&(jets.velocity(q) - jets.velocity(p)))
        };
        let (mut a, mut b) = (a, b);
        let rises = rate(b) > 0.0;
        if (rate(a) > 0.0) == rises {
            return None;
        }
        loop {
            let middle = a + (b - a) / 2.0;
            if middle == a || middle == b {
                return Some(middle);
            }
            if (rate(middle) > 0.0) == rises { b = middle } else { a = middle }
        }
    }

    /// The last input, going from `inside` towards `outside`, at which the dyad still closes.
    fn refine(&self, mut inside: f64, mut outside: f64) -> f64 {
        let floor = self.room(inside).min(0.0);
        loop {
            let middle = inside + (outside - inside) / 2.0;
            if middle == inside || middle == outside {
                return inside;
            }
            if self.room(middle) >= floor { inside = middle } else { outside = middle }
        }
    }
}

/// The spans with the one that an end lies inside of parted there.
fn parted(spans: Vec<Span>, end: IntervalEnd, input: Input) -> Vec<Span> {
    let mut out = Vec::new();
    for span in spans {
        match (span, span.turns_to(end.stop.at, input.period())) {
            (Span::Turn, _) => out.push(Span::Arc { lower: end, upper: end.turned(input.period()) }),
            (Span::Arc { lower, upper }, Some(at)) if lower.stop.at < at && at < upper.stop.at => {
                let end = end.turned(at - end.stop.at);
                out.extend([Span::Arc { lower, upper: end }, Span::Arc { lower: end, upper }]);
            }
            _ => out.push(span),
        }
    }
    out
}

/// Where `f` is least between `a` and `b`, by golden section.
fn golden(mut a: f64, mut b: f64, f: impl Fn(f64) -> f64) -> f64 {
    const RATIO: f64 = 0.618_033_988_749_894_9;
    let (mut x, mut y) = (b - RATIO * (b - a), a + RATIO * (b - a));
    let (mut fx, mut fy) = (f(x), f(y));
    // 0.618^40 of a sample is below the rounding of an angle.
    for _ in 0..40 {
        if fx < fy {
            (b, y, fy) = (y, x, fx);
            x = b - RATIO * (b - a);
            fx = f(x);
        } else {
            (a, x, fx) = (x, y, fy);
            y = a + RATIO * (b - a);
            fy = f(y);
        }
    }
    if fx < fy { x } else { y }
}

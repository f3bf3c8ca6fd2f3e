//! Limits by search: pieces that are certain to have one at most, and bisection to the last bit.

use super::Dyad;
use super::monotone_pieces::{Piece, cut_into_pieces};
use crate::linkage::{AssemblyMode, DyadSet, Input, Linkage};
use crate::motion::circuit::InputPosition;
use crate::motion::interval::{EndCause, Interval, IntervalEnd, Span};
use crate::motion::joint_series::{SeriesInput, place_as_series};
use crate::motion::pass_ends::place_at_end;
use crate::motion::positions::{DyadSigns, InputColumns, JointPositions, place_leading_joints};
use crate::motion::series::{Series, VectorSeries};

/// A dyad whose limits are searched for along a span.
pub(super) struct LimitSearch<'a> {
    pub linkage: &'a Linkage,
    pub dyad: &'a Dyad,
    pub span: Span,
    pub mode: AssemblyMode,
}

impl LimitSearch<'_> {
    /// The extent at each input; the ends of the span with the dyad flat that ends it.
    fn extents(&self, degs: &[f64]) -> Vec<f64> {
        let input = self.linkage.input();
        let stops: Vec<InputPosition> = degs.iter().map(|&at| InputPosition::new(input, at)).collect();
        let mut out = JointPositions::new(self.linkage.joints.len(), degs.len());
        let joints = self.dyad.joint;
        let modes = DyadSigns::new(self.mode, DyadSet::EMPTY);
        let inputs = InputColumns::new(&stops);
        place_leading_joints(self.linkage, joints, inputs.as_slices(), &modes, &mut out, 0..degs.len());
        let pass = Interval { span: self.span, mode: self.mode }.to_pass(true, input.period());
        for (i, deg) in degs.iter().enumerate() {
            for (end, begins) in [(pass.from, true), (pass.to, false)] {
                if end.input.value == *deg && self.span != Span::FullTurn {
                    // Where the base of an earlier dyad vanishes, this one hangs on what goes on there.
                    place_at_end(self.linkage, &pass, begins, &mut out, i);
                }
            }
        }
        let extent = |i: usize| {
            let Series([extent]) =
                self.dyad.extent(|joint| VectorSeries::<f64, 1>::constant(out.point(joint, i).coords));
            extent
        };
        (0..degs.len()).map(extent).collect()
    }

    /// What is left to stretch or to fold at an input, whichever is less; negative where the dyad does not close.
    fn margin(&self, deg: f64) -> f64 {
        self.extent_margin(self.extents(&[deg])[0])
    }

    fn extent_margin(&self, extent: f64) -> f64 {
        let [low, high] = self.dyad.extent_bounds();
        let room = (high - extent).min(extent - low);
        if room.is_nan() { -1.0 } else { room }
    }

    /// Where the span begins and ends.
    fn ends(&self) -> [f64; 2] {
        match self.span {
            Span::FullTurn => [0.0, self.linkage.input().period()],
            Span::Range { lower, upper } => [lower.input.value, upper.input.value],
        }
    }

    /// The extents at so many inputs, evenly over the span.
    fn sample_extents(&self) -> Vec<f64> {
        const INPUTS: usize = 128;
        let [from, to] = self.ends();
        let at = |i: usize| if i == INPUTS { to } else { from + (to - from) * i as f64 / INPUTS as f64 };
        self.extents(&(0..=INPUTS).map(at).collect::<Vec<f64>>())
    }

    /// About the least and the greatest extent.
    pub fn extent_range(&self) -> [f64; 2] {
        let extents = self.sample_extents();
        let fold = |pick: fn(f64, f64) -> f64, start| extents.iter().copied().fold(start, pick);
        [fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY)]
    }

    pub fn closing_spans(&self, next_id: &mut usize) -> Vec<Span> {
        let survey = self.sample_extents();
        let tolerance = self.tolerance(&survey);
        let may_vanish = self.dyad.base_can_vanish();
        if may_vanish && survey.iter().all(|extent| *extent <= tolerance) {
            // Two joints that are one point throughout leave their dyad free to turn: it has no place.
            return Vec::new();
        }
        let (degs, touched) = self.bracket_limits(tolerance);
        let is_open = |extent: f64| self.extent_margin(extent) >= -tolerance;
        let extents = self.extents(&degs);
        // Where an earlier joint has no place, at an end, this dyad is as it is beside that.
        let beside = |i: usize| if i == 0 { 1 } else { i - 1 };
        let known = |i: usize| if extents[i].is_nan() { extents[beside(i)] } else { extents[i] };
        let open: Vec<bool> = (0..degs.len()).map(|i| is_open(known(i))).collect();
        let mut end = |inside: f64, outside: f64| {
            *next_id += 1;
            let stop = InputPosition::new(self.linkage.input(), self.bisect_limit(inside, outside));
            IntervalEnd::from_flat_dyad(stop, EndCause::Limit, self.dyad.index, *next_id)
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
        let spans = self.join_arcs(arcs, tolerance);
        touched.into_iter().fold(spans, |spans, at| {
            *next_id += 1;
            let stop = InputPosition::new(self.linkage.input(), at);
            let end = IntervalEnd::from_flat_dyad(stop, EndCause::ChangePoint, self.dyad.index, *next_id);
            let vanishes = may_vanish && self.extents(&[at])[0] <= tolerance;
            split_spans(spans, end.with_flat_dyad(self.dyad.index, vanishes), self.linkage.input())
        })
    }

    /// Inputs between neighbours of which there is one limit at most; and those at which a bound is touched and not
    /// passed.
    fn bracket_limits(&self, tolerance: f64) -> (Vec<f64>, Vec<f64>) {
        let pieces = cut_into_pieces(self.linkage, self.dyad, self.mode, self.ends());
        let mut degs: Vec<f64> = pieces.iter().map(|piece| piece.from).chain(pieces.last().map(|p| p.to)).collect();
        let mut touched = Vec::new();
        for run in pieces.chunk_by(|a, b| !a.is_certain && !b.is_certain).filter(|run| !run[0].is_certain) {
            match self.inspect_run(run, tolerance) {
                Some(Extremum::Crossing(at)) => degs.push(at),
                Some(Extremum::Touching(at)) => touched.push(at),
                None => {}
            }
        }
        degs.sort_by(f64::total_cmp);
        (degs, touched)
    }

    /// What a run of uncertain pieces hides: a dip or a rise that passes a bound, or one that touches it.
    fn inspect_run(&self, run: &[Piece], tolerance: f64) -> Option<Extremum> {
        let [from, to] = [run[0].from, run[run.len() - 1].to];
        let rooms: Vec<f64> = run.iter().map(|piece| piece.from).chain([to]).map(|at| self.margin(at)).collect();
        let is_open = rooms[0] >= -tolerance;
        if rooms.iter().any(|room| (*room >= -tolerance) != is_open) {
            // Limits are seen between the pieces already.
            return None;
        }
        let sign = if is_open { 1.0 } else { -1.0 };
        // Near where a bound is touched the room is as flat as its rounding: the rate tells the place.
        let level = self.stationary_input(from, to);
        let at = level.unwrap_or_else(|| golden_section_minimum(from, to, |at| sign * self.margin(at)));
        let room = self.margin(at);
        if is_open && room < -tolerance || !is_open && room >= -tolerance {
            return Some(Extremum::Crossing(at));
        }
        // On both sides of a touch the room grows; where it does not, the extent lies along the bound.
        let [start, end] = self.ends();
        let aside = 1e-5 * (end - start);
        let grows = |at: f64| (start..=end).contains(&at) && self.margin(at) > 1e2 * tolerance;
        (is_open && level.is_some() && room <= tolerance && grows(at - aside) && grows(at + aside))
            .then_some(Extremum::Touching(at))
    }

    /// Extents that differ by no more than their rounding: what is within this of a bound touches it.
    fn tolerance(&self, extents: &[f64]) -> f64 {
        let [low, high] = self.dyad.extent_bounds();
        let finite = if high.is_finite() { high.abs() } else { 0.0 };
        let greatest = extents.iter().copied().filter(|e| e.is_finite()).fold(0.0, |a: f64, b| a.max(b.abs()));
        64.0 * f64::EPSILON * (low.abs() + finite + greatest)
    }

    /// The end of the span, where this dyad lies flat too if there is no room left.
    fn end_with_dyad(&self, end: IntervalEnd, tolerance: f64) -> IntervalEnd {
        let extent = self.extents(&[end.input.value])[0];
        if end.cause == EndCause::RangeEnd || self.extent_margin(extent).abs() > tolerance {
            return end;
        }
        end.with_flat_dyad(self.dyad.index, self.dyad.base_can_vanish() && extent <= tolerance)
    }

    /// Gives the arcs that reach the ends of the span those ends; on a whole turn, joins them over input 0.
    fn join_arcs(&self, mut arcs: Vec<(Option<IntervalEnd>, Option<IntervalEnd>)>, tolerance: f64) -> Vec<Span> {
        match self.span {
            Span::FullTurn => {
                let over_zero = arcs.len() > 1 && arcs[0].0.is_none() && arcs[arcs.len() - 1].1.is_none();
                if over_zero {
                    let (_, upper) = arcs.remove(0);
                    let last = arcs.len() - 1;
                    arcs[last].1 = upper.map(|end| end.shifted(self.linkage.input().period()));
                }
                let span = |arc| match arc {
                    (Some(lower), Some(upper)) => Span::Range { lower, upper },
                    _ => Span::FullTurn,
                };
                arcs.into_iter().map(span).collect()
            }
            Span::Range { lower, upper } => arcs
                .into_iter()
                .map(|(from, to)| Span::Range {
                    lower: from.unwrap_or_else(|| self.end_with_dyad(lower, tolerance)),
                    upper: to.unwrap_or_else(|| self.end_with_dyad(upper, tolerance)),
                })
                .filter(|span| matches!(span, Span::Range { lower, upper } if lower.input.value < upper.input.value))
                .collect(),
        }
    }

    /// Where the extent is least or greatest between two inputs, by bisection of its rate.
    fn stationary_input(&self, mut a: f64, mut b: f64) -> Option<f64> {
        let rate = |at: f64| {
            let InputPosition { value: at, cos, sin } = InputPosition::new(self.linkage.input(), at);
            let mode = |dyad: usize| f64::from(self.mode.sign(dyad));
            let drive = SeriesInput { value: at, direction: [cos, sin] };
            let places: Vec<VectorSeries<f64, 2>> =
                place_as_series(self.linkage, self.dyad.joint, drive, mode, |_, place, _| place);
            let Series([_, rate]) = self.dyad.extent(|joint| places[joint]);
            rate
        };
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
    fn bisect_limit(&self, mut inside: f64, mut outside: f64) -> f64 {
        let floor = self.margin(inside).min(0.0);
        loop {
            let middle = inside + (outside - inside) / 2.0;
            if middle == inside || middle == outside {
                return inside;
            }
            if self.margin(middle) >= floor { inside = middle } else { outside = middle }
        }
    }
}

/// What a run of uncertain pieces hides.
enum Extremum {
    /// An input on the other side of the bound.
    Crossing(f64),
    /// The input at which the bound is touched.
    Touching(f64),
}

/// The spans with the one that an end lies inside of parted there.
fn split_spans(spans: Vec<Span>, end: IntervalEnd, input: Input) -> Vec<Span> {
    let mut out = Vec::new();
    for span in spans {
        match (span, span.wrap(end.input.value, input.period())) {
            (Span::FullTurn, _) => out.push(Span::Range { lower: end, upper: end.shifted(input.period()) }),
            (Span::Range { lower, upper }, Some(at)) if lower.input.value < at && at < upper.input.value => {
                let end = end.shifted(at - end.input.value);
                out.extend([Span::Range { lower, upper: end }, Span::Range { lower: end, upper }]);
            }
            _ => out.push(span),
        }
    }
    out
}

/// Where `f` is least between `a` and `b`, by golden section.
fn golden_section_minimum(mut a: f64, mut b: f64, f: impl Fn(f64) -> f64) -> f64 {
    const RATIO: f64 = 0.618_033_988_749_894_9;
    let (mut x, mut y) = (b - RATIO * (b - a), a + RATIO * (b - a));
    let (mut fx, mut fy) = (f(x), f(y));
    // 0.618^60 of a whole turn is below the rounding of an angle.
    for _ in 0..60 {
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

//! Limits by search: on pieces with one limit at most, by bisection to the last bit.

use super::dyad::Dyad;
use super::monotone_pieces::{Piece, cut_into_pieces};
use crate::geometry::{Vector, trig};
use crate::linkage::{AssemblyMode, DyadId, DyadSet, Input, Linkage};
use crate::motion::input_columns::InputColumns;
use crate::motion::interval::{COINCIDENCE_TOLERANCE, EndCause, Interval, IntervalEnd, Span};
use crate::motion::joint_series::{SeriesInput, place_as_series};
use crate::motion::pass::InputPosition;
use crate::motion::pass_ends::place_at_end;
use crate::motion::positions::{DyadSigns, JointPositions, place_leading_joints};
use crate::motion::series::{Series, VectorSeries};
use crate::numerical::{border, maximum};

/// The search for the limits of a dyad on a span.
pub(super) struct LimitSearch<'a> {
    pub linkage: &'a Linkage,
    pub dyad: &'a Dyad,
    pub span: Span,
    pub mode: AssemblyMode,
}

impl LimitSearch<'_> {
    /// The extent at each input; at the ends of the span, with the flat dyads that end it.
    fn extents(&self, values: &[f64]) -> Vec<f64> {
        let input = self.linkage.input();
        let inputs: Vec<InputPosition> = values.iter().map(|&value| InputPosition::new(input, value)).collect();
        let mut out = JointPositions::new(self.linkage.joints.len(), values.len());
        let joints = self.dyad.joint.index();
        let signs = DyadSigns::new(self.mode, DyadSet::EMPTY);
        let inputs = InputColumns::new(&inputs);
        place_leading_joints(self.linkage, joints, inputs.as_slices(), &signs, &mut out, 0..values.len());
        let pass = Interval { span: self.span, mode: self.mode, track: None }.to_pass(true, input.period());
        let mut is_unknown = vec![false; values.len()];
        for (i, value) in values.iter().enumerate() {
            for (end, begins) in [(pass.from, true), (pass.to, false)] {
                if end.input.value == *value && self.span != Span::FullTurn {
                    // Where the base of an earlier dyad vanishes, this dyad depends on a joint placed by continuity.
                    place_at_end(self.linkage, &pass, begins, &mut out, i);
                    // So does the distance from a line whose joints coincide there.
                    is_unknown[i] |= end.vanishing_dyads.contains(self.dyad.id);
                }
            }
        }
        let extent = |i: usize| {
            if is_unknown[i] {
                return f64::NAN;
            }
            let Series([extent]) =
                self.dyad.extent(|joint| VectorSeries::<f64, 1>::constant(out.point(joint, i).coords));
            extent
        };
        (0..values.len()).map(extent).collect()
    }

    /// The distance of the extent at an input from the nearer bound; negative where the dyad does not close.
    fn margin(&self, input: f64) -> f64 {
        self.extent_margin(self.extents(&[input])[0])
    }

    fn extent_margin(&self, extent: f64) -> f64 {
        let [low, high] = self.dyad.extent_bounds();
        let margin = (high - extent).min(extent - low);
        if margin.is_nan() { -1.0 } else { margin }
    }

    /// The inputs at which the span begins and ends.
    fn ends(&self) -> [f64; 2] {
        match self.span {
            Span::FullTurn => [0.0, self.linkage.input().period()],
            Span::Range { lower, upper } => [lower.input.value, upper.input.value],
        }
    }

    /// The extents at evenly spaced inputs of the span.
    fn sample_extents(&self) -> Vec<f64> {
        const INPUTS: usize = 128;
        let [from, to] = self.ends();
        let at = |i: usize| if i == INPUTS { to } else { from + (to - from) * i as f64 / INPUTS as f64 };
        self.extents(&(0..=INPUTS).map(at).collect::<Vec<f64>>())
    }

    /// The least and the greatest extent, approximately.
    pub fn extent_range(&self) -> [f64; 2] {
        let extents = self.sample_extents();
        let fold = |pick: fn(f64, f64) -> f64, start| extents.iter().copied().fold(start, pick);
        [fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY)]
    }

    /// The parts of the span on which the dyad closes.
    pub fn closing_spans(&self, next_id: &mut usize) -> Vec<Span> {
        let samples = self.sample_extents();
        let tolerance = self.tolerance(&samples);
        let may_vanish = self.dyad.base_can_vanish();
        if may_vanish && samples.iter().all(|extent| *extent <= tolerance) {
            // If the two joints of the base coincide throughout, the dyad is free to turn and its joint is not
            // determined.
            return Vec::new();
        }
        let (inputs, touched) = self.bracket_limits(tolerance);
        let is_open = |extent: f64| self.extent_margin(extent) >= -tolerance;
        let extents = self.extents(&inputs);
        // At an end where the position of an earlier joint is undefined, the neighbouring extent is used.
        let neighbour = |i: usize| if i == 0 { 1 } else { i - 1 };
        let known = |i: usize| if extents[i].is_nan() { extents[neighbour(i)] } else { extents[i] };
        let open: Vec<bool> = (0..inputs.len()).map(|i| is_open(known(i))).collect();
        let mut end = |inside: f64, outside: f64| {
            *next_id += 1;
            // The last input, going outwards, at which the dyad still closes.
            let floor = self.margin(inside).min(0.0);
            let [last, _] = border([inside, outside], 0.0, |at| self.margin(at) >= floor);
            let input = InputPosition::new(self.linkage.input(), last);
            IntervalEnd::from_flat_dyad(input, EndCause::Limit, self.dyad.id, *next_id)
        };
        let mut arcs: Vec<(Option<IntervalEnd>, Option<IntervalEnd>)> = Vec::new();
        let mut lower = open[0].then_some(None);
        for i in 1..inputs.len() {
            match (open[i - 1], open[i]) {
                (false, true) => lower = Some(Some(end(inputs[i], inputs[i - 1]))),
                (true, false) => arcs.extend(lower.take().map(|from| (from, Some(end(inputs[i - 1], inputs[i]))))),
                _ => {}
            }
        }
        arcs.extend(lower.map(|from| (from, None)));
        let spans = self.join_arcs(arcs, tolerance);
        touched.into_iter().fold(spans, |spans, at| {
            *next_id += 1;
            let input = InputPosition::new(self.linkage.input(), at);
            let end = IntervalEnd::from_flat_dyad(input, EndCause::ChangePoint, self.dyad.id, *next_id);
            let vanishes = may_vanish && self.extents(&[at])[0] <= tolerance;
            split_spans(spans, end.with_flat_dyad(self.dyad.id, vanishes), self.linkage.input())
        })
    }

    /// Inputs between neighbours of which there is one limit at most, and the inputs at which a bound is touched and
    /// not crossed.
    fn bracket_limits(&self, tolerance: f64) -> (Vec<f64>, Vec<f64>) {
        let is_flat = match self.span {
            Span::FullTurn => [false; 2],
            Span::Range { .. } => self.ends().map(|end| self.margin(end).abs() <= tolerance),
        };
        let pieces = cut_into_pieces(self.linkage, self.dyad, self.mode, self.ends(), is_flat);
        let mut inputs: Vec<f64> = pieces.iter().map(|piece| piece.from).chain(pieces.last().map(|p| p.to)).collect();
        let mut touched = Vec::new();
        for run in self.uncertain_runs(&pieces) {
            match self.inspect_run(&run, tolerance) {
                Some(Extremum::Crossing(at)) if self.span == Span::FullTurn => inputs.push(at.rem_euclid(360.0)),
                Some(Extremum::Crossing(at)) => inputs.push(at),
                Some(Extremum::Touching(at)) => touched.push(at),
                None => {}
            }
        }
        inputs.sort_by(f64::total_cmp);
        (inputs, touched)
    }

    /// The runs of uncertain pieces, one after the other; on a full turn, a run through input 0 is one.
    fn uncertain_runs(&self, pieces: &[Piece]) -> Vec<Vec<Piece>> {
        let runs = pieces.chunk_by(|a, b| !a.is_certain && !b.is_certain).filter(|run| !run[0].is_certain);
        let mut runs: Vec<Vec<Piece>> = runs.map(<[Piece]>::to_vec).collect();
        let [from, to] = self.ends();
        let is_through_zero = self.span == Span::FullTurn
            && runs.len() > 1
            && runs[0][0].from == from
            && runs.last().and_then(|run| run.last()).is_some_and(|piece| piece.to == to);
        if let Some(last) = runs.pop_if(|_| is_through_zero) {
            let before = last.iter().map(|piece| Piece { from: piece.from - to, to: piece.to - to, ..*piece });
            runs[0].splice(0..0, before);
        }
        runs
    }

    /// Searches a run of uncertain pieces for an extremum of the extent that crosses or touches a bound.
    fn inspect_run(&self, run: &[Piece], tolerance: f64) -> Option<Extremum> {
        let [from, to] = [run[0].from, run[run.len() - 1].to];
        let margins: Vec<f64> = run.iter().map(|piece| piece.from).chain([to]).map(|at| self.margin(at)).collect();
        let is_open = margins[0] >= -tolerance;
        if margins.iter().any(|margin| (*margin >= -tolerance) != is_open) {
            // The limits are between the ends of these pieces already.
            return None;
        }
        let sign = if is_open { 1.0 } else { -1.0 };
        // Where a bound is touched, the margin is constant within its rounding: the zero of its derivative is more
        // accurate.
        let stationary = self.stationary_input(from, to);
        let accuracy = 2e-13 * (to - from);
        let at = stationary.unwrap_or_else(|| maximum([from, to], accuracy, |at| -sign * self.margin(at)).place);
        let margin = self.margin(at);
        if is_open && margin < -tolerance || !is_open && margin >= -tolerance {
            return Some(Extremum::Crossing(at));
        }
        // On both sides of a touch the margin grows; if it does not, the extent stays at the bound.
        let [start, end] = self.ends();
        let step = 1e-5 * (end - start);
        let is_inside = |at: f64| self.span == Span::FullTurn || (start..=end).contains(&at);
        let grows = |at: f64| is_inside(at) && self.margin(at) > 1e2 * tolerance;
        let is_touched = is_open && stationary.is_some() && margin <= tolerance && grows(at - step) && grows(at + step);
        // The start of a turn is exact.
        let at = if at.abs() <= COINCIDENCE_TOLERANCE && self.span == Span::FullTurn { 0.0 } else { at };
        is_touched.then_some(Extremum::Touching(at))
    }

    /// The rounding of the extent: an extreme within this distance of a bound touches it.
    fn tolerance(&self, extents: &[f64]) -> f64 {
        let [low, high] = self.dyad.extent_bounds();
        let finite = if high.is_finite() { high.abs() } else { 0.0 };
        let greatest = extents.iter().copied().filter(|e| e.is_finite()).fold(0.0, |a: f64, b| a.max(b.abs()));
        64.0 * f64::EPSILON * (low.abs() + finite + greatest)
    }

    /// An end of the span, with this dyad flat too if its extent is at a bound there.
    fn end_with_dyad(&self, end: IntervalEnd, tolerance: f64) -> IntervalEnd {
        let extent = self.extents(&[end.input.value])[0];
        if self.extent_margin(extent).abs() > tolerance {
            return end;
        }
        end.with_flat_dyad(self.dyad.id, self.dyad.base_can_vanish() && extent <= tolerance)
    }

    /// Completes the arcs that reach the ends of the span with those ends; on a full turn, joins arcs across input 0.
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

    /// The input between two inputs at which the extent is least or greatest, by bisection of its derivative.
    fn stationary_input(&self, a: f64, b: f64) -> Option<f64> {
        let rate = |at: f64| {
            let Series([_, rate]) = self.dyad.extent(|joint| self.joint_series::<2>(at)[joint]);
            rate
        };
        let rises = rate(b) > 0.0;
        if (rate(a) > 0.0) == rises {
            return None;
        }
        // The last input at which the extent falls, or rises, going from one where it does.
        let edge = |ends: [f64; 2], is_rising: bool| {
            let [last, _] = border(ends, 0.0, |at| if is_rising { rate(at) > 0.0 } else { rate(at) < 0.0 });
            last
        };
        // Where a base vanishes with its derivative, rounding leaves neither sign nearby.
        let [low, high] = [edge([a, b], !rises), edge([b, a], rises)];
        let at = low + (high - low) / 2.0;
        Some(if self.dyad.base_can_vanish() { self.twice_vanishing_input(at) } else { at })
    }

    /// An input at which a base vanishes with its derivative, from one nearby; that itself where there is none. It is where the
    /// derivative of the base is least.
    fn twice_vanishing_input(&self, mut at: f64) -> f64 {
        /// The rounding of such an input, in radians or relative to a length.
        const NEAR: f64 = 1e-6;
        let Some(base) = self.dyad.kind.base() else { return at };
        let is_length = self.linkage.input() == Input::Length;
        for _ in 0..3 {
            let series = self.joint_series::<3>(at);
            let [p, q] = base.map(|joint| series[joint]);
            let VectorSeries { x, y } = q.minus(p);
            let [first, second] = [1, 2].map(|n| Vector::new(x.0[n], y.0[n]) * n as f64);
            let near = if is_length { NEAR * at.abs() } else { NEAR };
            let is_least_nearby = first.norm() < near * second.norm();
            if !is_least_nearby {
                return at;
            }
            let distance = -first.dot(&second) / second.norm_squared();
            at += if is_length { distance } else { trig::degrees(distance) };
        }
        at
    }

    /// The joints that the dyad depends on as series in the input.
    fn joint_series<const N: usize>(&self, at: f64) -> Vec<VectorSeries<f64, N>> {
        let InputPosition { value, cos, sin } = InputPosition::new(self.linkage.input(), at);
        let sign = |dyad: DyadId| f64::from(self.mode.sign(dyad));
        let input = SeriesInput { value, direction: [cos, sin] };
        place_as_series(self.linkage, self.dyad.joint.index(), input, sign, |_, position, _| position)
    }
}

/// An extremum of the extent on a run of uncertain pieces.
enum Extremum {
    /// An input on the other side of the bound.
    Crossing(f64),
    /// The input at which the bound is touched.
    Touching(f64),
}

/// Splits the span that contains an end at that end.
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

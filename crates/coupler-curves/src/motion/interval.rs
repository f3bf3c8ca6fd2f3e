//! Where a linkage can be assembled: for each assembly mode, the intervals of the input.
//!
//! The dyads are taken in the order they are placed. Each cuts the intervals left by those before it to where its
//! base is within its reach; both of its sides then share what is left. So an end of an interval belongs to one
//! dyad, and has one number by which the intervals that meet there are recognised.

use std::collections::HashMap;

use super::circuit::{InputPosition, Pass, PassEnd};
use super::dyad_limits;
use crate::linkage::{
    AssemblyMode, CircuitSelection, CoincidentDyads, Continuation, DyadSet, Input, Linkage, MotionOptions,
};

/// Why an interval ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum EndCause {
    /// A dyad is fully stretched or folded and cannot go on.
    Limit,
    /// A dyad is stretched or folded and can go on.
    ChangePoint,
    /// The range asked for ends.
    RangeEnd,
}

/// An end of an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct IntervalEnd {
    pub input: InputPosition,
    pub cause: EndCause,
    /// The dyads that lie flat there.
    pub flat_dyads: DyadSet,
    /// Those of them that change their sides when the motion goes on smoothly.
    pub flipping_dyads: DyadSet,
    /// Those of them that can do nothing else, for their bases vanish.
    pub vanishing_dyads: DyadSet,
    /// Intervals that meet have ends of one number.
    pub id: usize,
}

impl IntervalEnd {
    /// An end of the range asked for.
    pub fn range_end(stop: InputPosition, id: usize) -> IntervalEnd {
        IntervalEnd {
            input: stop,
            cause: EndCause::RangeEnd,
            flat_dyads: DyadSet::EMPTY,
            flipping_dyads: DyadSet::EMPTY,
            vanishing_dyads: DyadSet::EMPTY,
            id,
        }
    }

    /// An end where one dyad lies flat.
    pub fn from_flat_dyad(stop: InputPosition, cause: EndCause, dyad: usize, id: usize) -> IntervalEnd {
        let dyad = DyadSet::single(dyad);
        IntervalEnd { input: stop, cause, flat_dyads: dyad, flipping_dyads: dyad, vanishing_dyads: DyadSet::EMPTY, id }
    }

    /// The same end where another dyad lies flat too; it changes its side together with the others.
    #[must_use]
    pub fn with_flat_dyad(self, dyad: usize, vanishes: bool) -> IntervalEnd {
        let dyad = DyadSet::single(dyad);
        let bound = if vanishes { self.vanishing_dyads.union(dyad) } else { self.vanishing_dyads };
        IntervalEnd {
            flat_dyads: self.flat_dyads.union(dyad),
            flipping_dyads: self.flipping_dyads.union(dyad),
            vanishing_dyads: bound,
            ..self
        }
    }

    /// This end and one at the same input. Where one of them is a limit the motion turns round, and the dyads that
    /// would have gone on keep their sides.
    #[must_use]
    pub fn merged(self, other: IntervalEnd) -> IntervalEnd {
        let (cause, flips) = match (self.cause, other.cause) {
            (EndCause::RangeEnd, _) => (other.cause, other.flipping_dyads),
            (_, EndCause::RangeEnd) => (self.cause, self.flipping_dyads),
            (a, b) if a == b => (a, self.flipping_dyads.union(other.flipping_dyads)),
            (EndCause::Limit, _) => (EndCause::Limit, self.flipping_dyads),
            _ => (EndCause::Limit, other.flipping_dyads),
        };
        IntervalEnd {
            cause,
            flipping_dyads: flips,
            flat_dyads: self.flat_dyads.union(other.flat_dyads),
            vanishing_dyads: self.vanishing_dyads.union(other.vanishing_dyads),
            ..self
        }
    }

    /// The sides with which a motion goes on that comes here with a rising or falling input, and whether the input then
    /// rises; none where it ends.
    pub fn next_mode(&self, signs: AssemblyMode, rising: bool, travel: &MotionOptions) -> Option<(AssemblyMode, bool)> {
        let flips = match travel.coincident {
            CoincidentDyads::Together => self.flipping_dyads,
            CoincidentDyads::First => self.flipping_dyads.first().union(self.vanishing_dyads),
            CoincidentDyads::Last => self.flipping_dyads.last().union(self.vanishing_dyads),
        };
        match self.cause {
            EndCause::RangeEnd => None,
            EndCause::Limit => Some((signs.flipped(flips), !rising)),
            EndCause::ChangePoint if travel.continuation == Continuation::Branch => {
                Some((signs.flipped(self.vanishing_dyads), rising))
            }
            EndCause::ChangePoint => Some((signs.flipped(flips), rising)),
        }
    }

    /// The same end with an angle that many degrees greater, a whole number of turns.
    pub fn shifted(self, deg: f64) -> IntervalEnd {
        IntervalEnd { input: InputPosition { value: self.input.value + deg, ..self.input }, ..self }
    }
}

/// A stretch of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Span {
    /// The whole turn.
    FullTurn,
    /// From a lower end to an upper, at most a turn apart.
    Range { lower: IntervalEnd, upper: IntervalEnd },
}

impl Span {
    /// The input that differs from `deg` by whole periods and lies in the span.
    pub fn wrap(&self, deg: f64, period: f64) -> Option<f64> {
        let Span::Range { lower, upper } = self else { return Some(deg.rem_euclid(period)) };
        let over = (deg - lower.input.value).rem_euclid(period);
        let length = upper.input.value - lower.input.value;
        // At a change point the start pose is that of the interval above.
        let inside = over < length || (over == length && upper.cause != EndCause::ChangePoint);
        inside.then_some(lower.input.value + over)
    }
}

/// A stretch of the input on which one assembly mode is possible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    pub span: Span,
    pub mode: AssemblyMode,
}

impl Interval {
    /// The end that a rising or falling input comes to; none on a full turn.
    pub fn end(&self, rising: bool) -> Option<IntervalEnd> {
        match self.span {
            Span::FullTurn => None,
            Span::Range { lower, upper } => Some(if rising { upper } else { lower }),
        }
    }

    /// The interval traversed with a rising or falling input; a full turn from 0 to its period.
    pub fn to_pass(self, rising: bool, period: f64) -> Pass {
        let end = |end: IntervalEnd| PassEnd { input: end.input, flat_dyads: end.flat_dyads };
        let (from, to) = match self.span {
            Span::FullTurn => {
                let seam = |at| PassEnd { input: InputPosition::from_degrees(at), flat_dyads: DyadSet::EMPTY };
                (seam(0.0), seam(period))
            }
            Span::Range { lower, upper } => (end(lower), end(upper)),
        };
        if rising { Pass { from, to, mode: self.mode } } else { Pass { from: to, to: from, mode: self.mode } }
    }
}

/// What [`find_intervals`] finds.
pub(super) struct ReachableIntervals {
    pub intervals: Vec<Interval>,
    /// Why there are none of the mode asked for, where a dyad of it closes nowhere.
    pub incomplete_reason: Option<String>,
}

/// The intervals within the range asked for: of all assembly modes, or, where only the circuit through the start pose
/// is wanted, of those that can be reached from it.
pub(super) fn find_intervals(linkage: &Linkage) -> ReachableIntervals {
    let mut tree = SpanCache { linkage, spans_by_mode: HashMap::new(), next_id: 2, incomplete_reason: None };
    let travel = &linkage.motion_options;
    let mut modes = match travel.circuits {
        CircuitSelection::Start => vec![travel.mode],
        CircuitSelection::All => AssemblyMode::all(linkage.dyad_count()).collect(),
    };
    let mut intervals = Vec::new();
    let mut done = 0;
    while let Some(&signs) = modes.get(done) {
        done += 1;
        for span in tree.spans(linkage.dyad_count(), signs) {
            let interval = Interval { span, mode: signs };
            for rising in [true, false] {
                let onward = interval.end(rising).and_then(|end| end.next_mode(signs, rising, travel));
                modes.extend(onward.map(|(signs, _)| signs).filter(|signs| !modes.contains(signs)));
            }
            intervals.push(interval);
        }
    }
    ReachableIntervals { intervals, incomplete_reason: tree.incomplete_reason }
}

/// The whole range of the input that is asked for.
fn requested_span(linkage: &Linkage) -> Span {
    let input = linkage.input();
    let asked = |at: f64, id| IntervalEnd::range_end(InputPosition::new(input, at), id);
    match linkage.motion_options.range {
        Some([from, to]) if to - from < input.period() => Span::Range { lower: asked(from, 0), upper: asked(to, 1) },
        _ if input == Input::Length => Span::Range { lower: asked(0.0, 0), upper: asked(f64::MAX / 16.0, 1) },
        _ => Span::FullTurn,
    }
}

/// The spans that the first few dyads leave, by their number and their sides: modes that share these share the spans,
/// and the numbers of their ends.
struct SpanCache<'a> {
    linkage: &'a Linkage,
    spans_by_mode: HashMap<(usize, AssemblyMode), Vec<Span>>,
    next_id: usize,
    incomplete_reason: Option<String>,
}

impl SpanCache<'_> {
    /// The spans on which the first `dyads` dyads close, with the sides of all but the last of them given.
    fn spans(&mut self, dyads: usize, signs: AssemblyMode) -> Vec<Span> {
        let Some(last) = dyads.checked_sub(1) else { return vec![requested_span(self.linkage)] };
        let before = signs.truncated(last);
        if let Some(known) = self.spans_by_mode.get(&(dyads, before)) {
            return known.clone();
        }
        let mut spans = Vec::new();
        for span in self.spans(last, signs) {
            match dyad_limits::closing_spans(self.linkage, last, span, before, &mut self.next_id) {
                Ok(parts) => spans.extend(parts),
                Err(reason) if before == self.linkage.motion_options.mode.truncated(last) => {
                    self.incomplete_reason.get_or_insert(reason);
                }
                Err(_) => {}
            }
        }
        self.spans_by_mode.insert((dyads, before), spans.clone());
        spans
    }
}

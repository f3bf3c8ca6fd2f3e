//! Intervals of the input on which a linkage can be assembled in an assembly mode, and how a motion continues at their
//! ends.

use super::group::GroupTrack;
use super::pass::{Heading, InputPosition, Pass, PassEnd};
use crate::linkage::{AssemblyMode, CoincidentDyads, Continuation, DyadId, DyadSet, MotionOptions};

/// Ends closer than this, in degrees or relative to a length, are at one input: the rounding of an angle near 360.
pub(super) const COINCIDENCE_TOLERANCE: f64 = 1e-12;

/// Why an interval ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum EndCause {
    /// A dyad is fully stretched or folded and the input cannot continue.
    Limit,
    /// A dyad is fully stretched or folded and the input can continue.
    ChangePoint,
    /// The requested range ends.
    RangeEnd,
}

/// An end of an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct IntervalEnd {
    pub input: InputPosition,
    pub cause: EndCause,
    /// The dyads that are flat there.
    pub flat_dyads: DyadSet,
    /// The flat dyads that change their sides when the motion continues smoothly.
    pub flipping_dyads: DyadSet,
    /// The flat dyads whose bases vanish: continuity alone decides their sides.
    pub vanishing_dyads: DyadSet,
    /// The same for the ends of all intervals that meet here.
    pub id: usize,
}

impl IntervalEnd {
    /// An end of the requested range.
    pub fn range_end(input: InputPosition, id: usize) -> IntervalEnd {
        IntervalEnd {
            input,
            cause: EndCause::RangeEnd,
            flat_dyads: DyadSet::EMPTY,
            flipping_dyads: DyadSet::EMPTY,
            vanishing_dyads: DyadSet::EMPTY,
            id,
        }
    }

    /// An end where one dyad is flat.
    pub fn from_flat_dyad(input: InputPosition, cause: EndCause, dyad: DyadId, id: usize) -> IntervalEnd {
        let dyad = DyadSet::single(dyad);
        IntervalEnd { input, cause, flat_dyads: dyad, flipping_dyads: dyad, vanishing_dyads: DyadSet::EMPTY, id }
    }

    /// The same end where another dyad is flat too; it changes its side together with the others.
    #[must_use]
    pub fn with_flat_dyad(self, dyad: DyadId, vanishes: bool) -> IntervalEnd {
        let dyad = DyadSet::single(dyad);
        let vanishing = if vanishes { self.vanishing_dyads.union(dyad) } else { self.vanishing_dyads };
        IntervalEnd {
            flat_dyads: self.flat_dyads.union(dyad),
            flipping_dyads: self.flipping_dyads.union(dyad),
            vanishing_dyads: vanishing,
            ..self
        }
    }

    /// This end combined with another one at the same input. If one of them is a limit, the input reverses, and the
    /// dyads at a change point keep their sides.
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

    /// How a motion continues that arrives here; `None` if it ends. The sides of dyads whose bases vanish are not yet decided.
    pub fn next_heading(&self, Heading { mode, rises }: Heading, options: &MotionOptions) -> Option<Heading> {
        let flips = match options.coincident {
            CoincidentDyads::Together => self.flipping_dyads,
            CoincidentDyads::First => self.flipping_dyads.first(),
            CoincidentDyads::Last => self.flipping_dyads.last(),
        };
        match self.cause {
            EndCause::RangeEnd => None,
            EndCause::Limit => Some(Heading { mode: mode.flipped(flips), rises: !rises }),
            EndCause::ChangePoint if options.continuation == Continuation::Branch => Some(Heading { mode, rises }),
            EndCause::ChangePoint => Some(Heading { mode: mode.flipped(flips), rises }),
        }
    }

    /// The end of the passes that lie next to it.
    pub fn to_pass_end(self) -> PassEnd {
        let IntervalEnd { input, flat_dyads, vanishing_dyads, .. } = self;
        PassEnd { input, flat_dyads, vanishing_dyads }
    }

    /// The same end with an angle that many degrees greater, a whole number of turns.
    pub fn shifted(self, deg: f64) -> IntervalEnd {
        IntervalEnd { input: InputPosition { value: self.input.value + deg, ..self.input }, ..self }
    }
}

/// A connected part of the input range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Span {
    /// The full turn.
    FullTurn,
    /// From a lower end to an upper, at most a turn apart.
    Range { lower: IntervalEnd, upper: IntervalEnd },
}

impl Span {
    /// The input in the span that differs from `deg` by whole periods, if there is one.
    pub fn wrap(&self, deg: f64, period: f64) -> Option<f64> {
        let Span::Range { lower, upper } = self else { return Some(deg.rem_euclid(period)) };
        let offset = (deg - lower.input.value).rem_euclid(period);
        let length = upper.input.value - lower.input.value;
        // A start pose at a change point belongs to the interval above it.
        let is_inside = offset < length || (offset == length && upper.cause != EndCause::ChangePoint);
        is_inside.then_some(lower.input.value + offset)
    }
}

/// A span of the input on which the linkage can be assembled in an assembly mode.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Interval {
    pub span: Span,
    pub mode: AssemblyMode,
    /// The poses of the joints that no dyads place, if there are any.
    pub track: Option<GroupTrack>,
}

impl Interval {
    /// The end that a rising or falling input reaches; `None` on a full turn.
    pub fn end(&self, rising: bool) -> Option<IntervalEnd> {
        match self.span {
            Span::FullTurn => None,
            Span::Range { lower, upper } => Some(if rising { upper } else { lower }),
        }
    }

    /// The interval traversed with a rising or falling input; a full turn from 0 to its period.
    pub fn to_pass(&self, rising: bool, period: f64) -> Pass {
        let (from, to) = match self.span {
            Span::FullTurn => {
                let period_end = |at| PassEnd::regular(InputPosition::from_degrees(at));
                (period_end(0.0), period_end(period))
            }
            Span::Range { lower, upper } => (lower.to_pass_end(), upper.to_pass_end()),
        };
        let pass = Pass { from, to, mode: self.mode, track: self.track.clone() };
        if rising { pass } else { pass.reversed() }
    }
}

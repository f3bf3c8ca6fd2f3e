//! Where a linkage can be assembled: for each assembly mode, the intervals of the input.
//!
//! The dyads are taken in the order they are placed. Each cuts the intervals left by those before it to where its
//! base is within its reach; both of its sides then share what is left. So an end of an interval belongs to one
//! dyad, and has one number by which the intervals that meet there are recognised.

use super::circuit::{End, Pass, Stop};
use super::reach;
use crate::linkage::{Flat, Input, Linkage, Side, Signs};

/// Why an interval ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Cause {
    /// A dyad is fully stretched or folded and cannot go on.
    Limit,
    /// A dyad is stretched or folded and can go on.
    Change,
    /// The range asked for ends.
    Asked,
}

/// An end of an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct IntervalEnd {
    pub stop: Stop,
    pub cause: Cause,
    /// The dyads that lie flat there.
    pub flat: Flat,
    /// Those of them that change their sides when the motion goes on smoothly.
    pub flips: Flat,
    /// Those of them that can do nothing else, for their bases vanish.
    pub bound: Flat,
    /// Intervals that meet have ends of one number.
    pub id: usize,
}

impl IntervalEnd {
    /// An end of the range asked for.
    pub fn asked(stop: Stop, id: usize) -> IntervalEnd {
        IntervalEnd { stop, cause: Cause::Asked, flat: Flat::NONE, flips: Flat::NONE, bound: Flat::NONE, id }
    }

    /// An end where one dyad lies flat.
    pub fn flat(stop: Stop, cause: Cause, dyad: usize, id: usize) -> IntervalEnd {
        let dyad = Flat::one(dyad);
        IntervalEnd { stop, cause, flat: dyad, flips: dyad, bound: Flat::NONE, id }
    }

    /// The same end where another dyad lies flat too; it changes its side together with the others.
    #[must_use]
    pub fn with(self, dyad: usize, vanishes: bool) -> IntervalEnd {
        let dyad = Flat::one(dyad);
        let bound = if vanishes { self.bound.and(dyad) } else { self.bound };
        IntervalEnd { flat: self.flat.and(dyad), flips: self.flips.and(dyad), bound, ..self }
    }

    /// This end and one at the same input. Where one of them is a limit the motion turns round, and the dyads that
    /// would have gone on keep their sides.
    #[must_use]
    pub fn merged(self, other: IntervalEnd) -> IntervalEnd {
        let (cause, flips) = match (self.cause, other.cause) {
            (Cause::Asked, _) => (other.cause, other.flips),
            (_, Cause::Asked) => (self.cause, self.flips),
            (a, b) if a == b => (a, self.flips.and(other.flips)),
            (Cause::Limit, _) => (Cause::Limit, self.flips),
            _ => (Cause::Limit, other.flips),
        };
        IntervalEnd { cause, flips, flat: self.flat.and(other.flat), bound: self.bound.and(other.bound), ..self }
    }

    /// The same end with an angle that many degrees greater, a whole number of turns.
    pub fn turned(self, deg: f64) -> IntervalEnd {
        IntervalEnd { stop: Stop { at: self.stop.at + deg, ..self.stop }, ..self }
    }
}

/// A stretch of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Span {
    /// The whole turn.
    Turn,
    /// From a lower end to an upper, at most a turn apart.
    Arc { lower: IntervalEnd, upper: IntervalEnd },
}

impl Span {
    /// The input that differs from `deg` by whole periods and lies in the span.
    pub fn turns_to(&self, deg: f64, period: f64) -> Option<f64> {
        let Span::Arc { lower, upper } = self else { return Some(deg.rem_euclid(period)) };
        let over = (deg - lower.stop.at).rem_euclid(period);
        let length = upper.stop.at - lower.stop.at;
        // At a change point the start pose is that of the interval above.
        let inside = over < length || (over == length && upper.cause != Cause::Change);
        inside.then_some(lower.stop.at + over)
    }
}

/// A stretch of the input on which one assembly mode is possible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    pub span: Span,
    pub signs: Signs,
}

impl Interval {
    /// The end that a rising or falling input comes to; none on a full turn.
    pub fn end(&self, rising: bool) -> Option<IntervalEnd> {
        match self.span {
            Span::Turn => None,
            Span::Arc { lower, upper } => Some(if rising { upper } else { lower }),
        }
    }

    /// The interval traversed with a rising or falling input; a full turn from 0 to its period.
    pub fn pass(&self, rising: bool, period: f64) -> Pass {
        let end = |end: IntervalEnd| End { stop: end.stop, flat: end.flat };
        let (from, to) = match self.span {
            Span::Turn => {
                let seam = |at| End { stop: Stop::angle(at), flat: Flat::NONE };
                (seam(0.0), seam(period))
            }
            Span::Arc { lower, upper } => (end(lower), end(upper)),
        };
        if rising { Pass { from, to, signs: self.signs } } else { Pass { from: to, to: from, signs: self.signs } }
    }
}

/// What [`intervals`] finds.
pub(super) struct Reach {
    pub intervals: Vec<Interval>,
    /// Why there are none of the mode asked for, where a dyad of it closes nowhere.
    pub shortfall: Option<String>,
}

/// All intervals of all assembly modes, within the range asked for.
pub(super) fn intervals(linkage: &Linkage) -> Reach {
    let input = linkage.input();
    let asked = |at: f64, id| IntervalEnd::asked(Stop::of(input, at), id);
    let span = match linkage.travel.range {
        Some([from, to]) if to - from < input.period() => Span::Arc { lower: asked(from, 0), upper: asked(to, 1) },
        _ if input == Input::Length => Span::Arc { lower: asked(0.0, 0), upper: asked(f64::MAX / 16.0, 1) },
        _ => Span::Turn,
    };
    let mut explorer = Explorer { linkage, dyads: linkage.dyads(), next_id: 2, out: Vec::new(), shortfall: None };
    explorer.explore(0, span, Signs::default());
    Reach { intervals: explorer.out, shortfall: explorer.shortfall }
}

struct Explorer<'a> {
    linkage: &'a Linkage,
    dyads: usize,
    next_id: usize,
    out: Vec<Interval>,
    shortfall: Option<String>,
}

impl Explorer<'_> {
    fn explore(&mut self, dyad: usize, span: Span, signs: Signs) {
        if dyad == self.dyads {
            self.out.push(Interval { span, signs });
            return;
        }
        let spans = match reach::cut(self.linkage, dyad, span, signs, &mut self.next_id) {
            Ok(spans) => spans,
            Err(reason) => {
                let asked = self.linkage.travel.signs;
                if (0..dyad).all(|k| signs.get(k) == asked.get(k)) {
                    self.shortfall.get_or_insert(reason);
                }
                return;
            }
        };
        for side in [Side::Left, Side::Right] {
            for &span in &spans {
                self.explore(dyad + 1, span, signs.with(dyad, side));
            }
        }
    }
}

//! Where a linkage can be assembled: for each assembly mode, the intervals of the input.
//!
//! The dyads are taken in the order they are placed. Each cuts the intervals left by those before it to where its
//! base is within its reach; both of its sides then share what is left. So an end of an interval belongs to one
//! dyad, and has one number by which the intervals that meet there are recognised.

use std::collections::HashMap;

use super::circuit::{End, Pass, Stop};
use super::reach;
use crate::linkage::{Circuits, Coincident, Continuation, Flat, Input, Linkage, Signs, Travel};

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

    /// The sides with which a motion goes on that comes here with a rising or falling input, and whether the input then
    /// rises; none where it ends.
    pub fn onward(&self, signs: Signs, rising: bool, travel: &Travel) -> Option<(Signs, bool)> {
        let flips = match travel.coincident {
            Coincident::Together => self.flips,
            Coincident::First => self.flips.first().and(self.bound),
            Coincident::Last => self.flips.last().and(self.bound),
        };
        match self.cause {
            Cause::Asked => None,
            Cause::Limit => Some((signs.flipped(flips), !rising)),
            Cause::Change if travel.continuation == Continuation::Branch => Some((signs.flipped(self.bound), rising)),
            Cause::Change => Some((signs.flipped(flips), rising)),
        }
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

/// The intervals within the range asked for: of all assembly modes, or, where only the circuit through the start pose
/// is wanted, of those that can be reached from it.
pub(super) fn intervals(linkage: &Linkage) -> Reach {
    let mut tree = Tree { linkage, left: HashMap::new(), next_id: 2, shortfall: None };
    let travel = &linkage.travel;
    let mut modes = match travel.circuits {
        Circuits::Start => vec![travel.signs],
        Circuits::All => Signs::all(linkage.dyads()).collect(),
    };
    let mut intervals = Vec::new();
    let mut done = 0;
    while let Some(&signs) = modes.get(done) {
        done += 1;
        for span in tree.spans(linkage.dyads(), signs) {
            let interval = Interval { span, signs };
            for rising in [true, false] {
                let onward = interval.end(rising).and_then(|end| end.onward(signs, rising, travel));
                modes.extend(onward.map(|(signs, _)| signs).filter(|signs| !modes.contains(signs)));
            }
            intervals.push(interval);
        }
    }
    Reach { intervals, shortfall: tree.shortfall }
}

/// The whole range of the input that is asked for.
fn whole(linkage: &Linkage) -> Span {
    let input = linkage.input();
    let asked = |at: f64, id| IntervalEnd::asked(Stop::of(input, at), id);
    match linkage.travel.range {
        Some([from, to]) if to - from < input.period() => Span::Arc { lower: asked(from, 0), upper: asked(to, 1) },
        _ if input == Input::Length => Span::Arc { lower: asked(0.0, 0), upper: asked(f64::MAX / 16.0, 1) },
        _ => Span::Turn,
    }
}

/// The spans that the first few dyads leave, by their number and their sides: modes that share these share the spans,
/// and the numbers of their ends.
struct Tree<'a> {
    linkage: &'a Linkage,
    left: HashMap<(usize, Signs), Vec<Span>>,
    next_id: usize,
    shortfall: Option<String>,
}

impl Tree<'_> {
    /// The spans on which the first `dyads` dyads close, with the sides of all but the last of them given.
    fn spans(&mut self, dyads: usize, signs: Signs) -> Vec<Span> {
        let Some(last) = dyads.checked_sub(1) else { return vec![whole(self.linkage)] };
        let before = signs.of_first(last);
        if let Some(known) = self.left.get(&(dyads, before)) {
            return known.clone();
        }
        let mut spans = Vec::new();
        for span in self.spans(last, signs) {
            match reach::cut(self.linkage, last, span, before, &mut self.next_id) {
                Ok(parts) => spans.extend(parts),
                Err(reason) if before == self.linkage.travel.signs.of_first(last) => {
                    self.shortfall.get_or_insert(reason);
                }
                Err(_) => {}
            }
        }
        self.left.insert((dyads, before), spans.clone());
        spans
    }
}

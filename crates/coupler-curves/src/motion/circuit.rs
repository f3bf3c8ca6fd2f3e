//! From intervals to circuits: which interval follows which, where a circuit starts, and in what order they come.

use crate::geometry::trig;

use super::interval::{Interval, Span, intervals};
use crate::linkage::{Circuits, Flat, Input, Linkage, Signs};

/// A value of the input: an angle with its direction, which is the more exact of the two at a limit, or a length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// The angle in degrees, continuous along a circuit, or the length.
    pub at: f64,
    /// The angle's cosine; of a length, 0.
    pub cos: f64,
    /// The angle's sine; of a length, 0.
    pub sin: f64,
}

impl Stop {
    /// The input at an angle in degrees.
    pub fn angle(deg: f64) -> Stop {
        let (cos, sin) = trig::cos_sin_deg(deg);
        Stop { at: deg, cos, sin }
    }

    /// The value `at` of a linkage's input.
    pub fn of(input: Input, at: f64) -> Stop {
        match input {
            Input::Angle { .. } => Stop::angle(at),
            Input::Length => Stop { at, cos: 0.0, sin: 0.0 },
        }
    }
}

/// Where a pass begins or ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// The input there.
    pub stop: Stop,
    /// The dyads that lie flat there, at a limit or a change point; none at the end of a range or a period.
    pub flat: Flat,
}

/// A part of a circuit on which the input goes one way and every dyad keeps its side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pass {
    /// Where it begins.
    pub from: End,
    /// Where it ends.
    pub to: End,
    /// The sides of the dyads.
    pub signs: Signs,
}

impl Pass {
    /// 1 where the input rises, -1 where it falls.
    pub fn heading(&self) -> f64 {
        if self.to.stop.at >= self.from.stop.at { 1.0 } else { -1.0 }
    }

    /// How far the input goes, in degrees.
    pub fn length(&self) -> f64 {
        (self.to.stop.at - self.from.stop.at).abs()
    }

    /// The least and the greatest input on it.
    pub fn range(&self) -> [f64; 2] {
        [self.from.stop.at.min(self.to.stop.at), self.from.stop.at.max(self.to.stop.at)]
    }

    fn reversed(&self) -> Pass {
        Pass { from: self.to, to: self.from, signs: self.signs }
    }

    fn shifted(&self, deg: f64) -> Pass {
        let moved = |end: End| End { stop: Stop { at: end.stop.at + deg, ..end.stop }, ..end };
        Pass { from: moved(self.from), to: moved(self.to), signs: self.signs }
    }
}

/// A circuit before it is sampled.
#[derive(Clone, Debug)]
pub(super) struct Route {
    pub passes: Vec<Pass>,
    pub closed: bool,
}

impl Route {
    /// What it lacks of the range asked for, from and to in degrees.
    fn falls_short(&self, [from, to]: [f64; 2], input: Input) -> Option<String> {
        let [low, high] = extent(&self.passes);
        let whole = (low <= from && high >= to) || high - low >= input.period();
        let unit = if input == Input::Length { "" } else { " deg" };
        let short = |deg: f64| (deg * 1e4).round() / 1e4 + 0.0;
        (!whole).then(|| {
            let (low, high) = (short(low), short(high));
            format!("the input goes from {low} to {high}{unit} only, of the {from} to {to}{unit} asked for")
        })
    }
}

/// The least and the greatest input of a chain of passes, in degrees.
fn extent(passes: &[Pass]) -> [f64; 2] {
    let ends = || passes.iter().flat_map(|pass| [pass.from.stop.at, pass.to.stop.at]);
    [ends().fold(f64::INFINITY, f64::min), ends().fold(f64::NEG_INFINITY, f64::max)]
}

pub(super) struct Found {
    pub circuits: Vec<Route>,
    pub shortfall: Option<String>,
}

/// The circuits that the linkage's [`crate::linkage::Travel`] asks for, in order.
pub(super) fn find(linkage: &Linkage) -> Found {
    let reach = intervals(linkage);
    let all = &reach.intervals;
    let mut left: Vec<usize> = (0..all.len()).collect();
    let mut shortfall = reach.shortfall.clone().filter(|_| all.is_empty());
    if linkage.travel.circuits == Circuits::Start {
        match start(linkage, all) {
            Ok(interval) => left = vec![interval],
            Err(reason) => {
                left.clear();
                shortfall = Some(reach.shortfall.clone().unwrap_or(reason));
            }
        }
    }
    let mut seen = vec![false; all.len()];
    let mut circuits = Vec::new();
    for interval in left {
        if !seen[interval] {
            circuits.push(walk(linkage, all, interval, &mut seen));
        }
    }
    if let (Some(range), None) = (linkage.travel.range, &shortfall) {
        shortfall = circuits.iter().find_map(|route: &Route| route.falls_short(range, linkage.input()));
    }
    circuits.sort_by(|a, b| {
        let key = |route: &Route| (route.passes[0].signs.get(0) < 0, route.passes[0].from.stop.at);
        let (a, b) = (key(a), key(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    Found { circuits, shortfall }
}

/// The interval of the start pose.
fn start(linkage: &Linkage, all: &[Interval]) -> Result<usize, String> {
    let signs = linkage.travel.signs;
    let ours: Vec<usize> = (0..all.len()).filter(|&k| all[k].signs == signs).collect();
    let period = linkage.input().period();
    let at = match linkage.travel.start {
        Some(at) => at,
        None => middle_of_first_range(all, &ours, period).ok_or("no input allows the sides asked for")?,
    };
    let within = |k: &usize| all[*k].span.turns_to(at, period).is_some();
    if let (Some(start), Some([from, to])) = (linkage.travel.start, linkage.travel.range)
        && (start - from).rem_euclid(period) > to - from
    {
        return Err(format!("its start, an input of {start}, is not in the range asked for, from {from} to {to}"));
    }
    ours.into_iter().find(within).ok_or_else(|| format!("it cannot be assembled at the start, an input of {at}"))
}

/// The middle of the first assemblable range met from 0 upward; change points do not part a range.
fn middle_of_first_range(all: &[Interval], ours: &[usize], period: f64) -> Option<f64> {
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    for &k in ours {
        match all[k].span {
            Span::Turn => return Some(period / 2.0),
            Span::Arc { lower, upper } => ranges.push([lower.stop.at, upper.stop.at]),
        }
    }
    let joined = |a: [f64; 2], b: [f64; 2]| ((b[0] - a[1]) % period).abs() < 1e-9;
    while let Some((i, j)) = pairs(ranges.len()).find(|&(i, j)| joined(ranges[i], ranges[j])) {
        ranges[i][1] += ranges[j][1] - ranges[j][0];
        ranges.remove(j);
    }
    let met = |range: &[f64; 2]| {
        let lower = range[0].rem_euclid(period);
        if lower + (range[1] - range[0]) >= period || lower == 0.0 { 0.0 } else { lower }
    };
    let first = ranges.iter().min_by(|a, b| met(a).total_cmp(&met(b)))?;
    Some((first[0] + first[1]) / 2.0)
}

fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (0..n).map(move |j| (i, j))).filter(|(i, j)| i != j)
}

/// The circuit through an interval: on to what follows its upper end, and, where that ends, back from its lower.
fn walk(linkage: &Linkage, all: &[Interval], first: usize, seen: &mut [bool]) -> Route {
    seen[first] = true;
    let period = linkage.input().period();
    if all[first].span == Span::Turn {
        return Route { passes: vec![all[first].pass(true, period)], closed: true };
    }
    let mut passes = vec![all[first].pass(true, period)];
    let closed = follow(linkage, all, (first, true), &mut passes, seen);
    if !closed {
        let mut before = vec![all[first].pass(false, period)];
        follow(linkage, all, (first, false), &mut before, seen);
        before.reverse();
        before.pop();
        passes = before.iter().map(Pass::reversed).chain(passes).collect();
    }
    let asked = linkage.travel.range.is_some();
    Route { passes: normal(passes, closed, asked, period), closed }
}

/// Appends the passes that follow `(interval, rising)`; whether they come back to where they began.
fn follow(
    linkage: &Linkage,
    all: &[Interval],
    begun: (usize, bool),
    passes: &mut Vec<Pass>,
    seen: &mut [bool],
) -> bool {
    let mut at = begun;
    while let Some(next) = after(linkage, all, at) {
        if next == begun {
            return true;
        }
        if seen[next.0] {
            // Only where several dyads lie flat at once does a third interval meet two that are already joined.
            return false;
        }
        seen[next.0] = true;
        passes.push(all[next.0].pass(next.1, linkage.input().period()));
        at = next;
    }
    false
}

/// The interval that follows, and whether the input rises on it.
fn after(linkage: &Linkage, all: &[Interval], (interval, rising): (usize, bool)) -> Option<(usize, bool)> {
    let from = &all[interval];
    let end = from.end(rising)?;
    let (signs, rises) = end.onward(from.signs, rising, &linkage.travel)?;
    // It begins where this one ends: falling from the same upper end, or rising from the same lower one.
    let begins = |k: &usize| all[*k].signs == signs && all[*k].end(!rises).is_some_and(|e| e.id == end.id);
    (0..all.len()).find(begins).map(|k| (k, rises))
}

/// The passes with a continuous input, started where a circuit starts.
fn normal(passes: Vec<Pass>, closed: bool, asked: bool, period: f64) -> Vec<Pass> {
    let backward: Vec<Pass> = passes.iter().rev().map(Pass::reversed).collect();
    let turns = passes.iter().any(|pass| pass.heading() != passes[0].heading());
    let mut best: Option<Vec<Pass>> = None;
    for direction in [passes, backward] {
        let direction = if closed && !turns { cut_at_zero(direction, period) } else { direction };
        let starts = if closed { direction.len() } else { 1 };
        for start in 0..starts {
            let n = direction.len();
            let rotated: Vec<Pass> = (0..n).map(|k| direction[(start + k) % n]).collect();
            let candidate = continuous(joined(rotated), turns, asked, period);
            if closed && candidate[0].heading() < 0.0 && candidate.iter().any(|pass| pass.heading() > 0.0) {
                continue;
            }
            if best.as_ref().is_none_or(|best| precedes(&candidate, best)) {
                best = Some(candidate);
            }
        }
    }
    best.unwrap_or_default()
}

/// Whether a circuit that starts as `a` does is to be preferred: rising, from a lower input, on branch 1.
fn precedes(a: &[Pass], b: &[Pass]) -> bool {
    let key = |passes: &[Pass]| (passes[0].heading() < 0.0, passes[0].from.stop.at);
    let (ka, kb) = (key(a), key(b));
    ka.0.cmp(&kb.0).then(ka.1.total_cmp(&kb.1)).then(a[0].signs.cmp(&b[0].signs)).is_lt()
}

/// A motion that never turns round starts at input 0: a pass over it is cut in two there.
fn cut_at_zero(passes: Vec<Pass>, period: f64) -> Vec<Pass> {
    let mut cut = Vec::new();
    for pass in passes {
        let [low, high] = pass.range();
        let zero = (high / period).ceil() * period - period;
        if zero > low {
            let at = End { stop: Stop::angle(zero), flat: Flat::NONE };
            cut.push(Pass { to: at, ..pass });
            cut.push(Pass { from: at, ..pass });
        } else {
            cut.push(pass);
        }
    }
    cut
}

/// The passes with those made one that [`cut_at_zero`] parted and a circuit does not start at.
fn joined(passes: Vec<Pass>) -> Vec<Pass> {
    let mut out: Vec<Pass> = Vec::new();
    for pass in passes {
        match out.last_mut() {
            Some(last) if last.to == pass.from && last.to.flat.is_none() && last.signs == pass.signs => {
                last.to = pass.to
            }
            _ => out.push(pass),
        }
    }
    out
}

/// Shifts passes by whole turns so that each begins where the one before ends, and the whole lies where it should:
/// the middle of a rocking circuit in (-180, 180], the start of a turning one in the first period, a range asked for as asked.
fn continuous(mut passes: Vec<Pass>, turns: bool, asked: bool, period: f64) -> Vec<Pass> {
    for k in 1..passes.len() {
        let gap = passes[k - 1].to.stop.at - passes[k].from.stop.at;
        passes[k] = passes[k].shifted((gap / period).round() * period);
    }
    let [low, high] = extent(&passes);
    let whole = if asked {
        0.0
    } else if turns || high - low < period {
        (0.5 - (low + high) / (2.0 * period)).floor()
    } else {
        -(passes[0].from.stop.at / period).floor()
    };
    passes.into_iter().map(|pass| pass.shifted(whole * period)).collect()
}

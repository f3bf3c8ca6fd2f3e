//! From intervals to circuits: which interval follows which, where a circuit starts, and in what order they come.

use crate::geometry::trig;

use super::interval::{Interval, Span, find_intervals};
use crate::linkage::{AssemblyMode, CircuitSelection, DyadSet, Input, Linkage};

/// A value of the input: an angle with its direction, which is the more exact of the two at a limit, or a length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InputPosition {
    /// The angle in degrees, continuous along a circuit, or the length.
    pub value: f64,
    /// The angle's cosine; of a length, 0.
    pub cos: f64,
    /// The angle's sine; of a length, 0.
    pub sin: f64,
}

impl InputPosition {
    /// The input at an angle in degrees.
    pub fn from_degrees(deg: f64) -> InputPosition {
        let (cos, sin) = trig::cos_sin_deg(deg);
        InputPosition { value: deg, cos, sin }
    }

    /// The value `at` of a linkage's input.
    pub fn new(input: Input, at: f64) -> InputPosition {
        match input {
            Input::Angle { .. } => InputPosition::from_degrees(at),
            Input::Length => InputPosition { value: at, cos: 0.0, sin: 0.0 },
        }
    }
}

/// Where a pass begins or ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PassEnd {
    /// The input there.
    pub input: InputPosition,
    /// The dyads that lie flat there, at a limit or a change point; none at the end of a range or a period.
    pub flat_dyads: DyadSet,
}

/// A part of a circuit on which the input goes one way and every dyad keeps its side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pass {
    /// Where it begins.
    pub from: PassEnd,
    /// Where it ends.
    pub to: PassEnd,
    /// The sides of the dyads.
    pub mode: AssemblyMode,
}

impl Pass {
    /// 1 where the input rises, -1 where it falls.
    pub fn input_direction(&self) -> f64 {
        if self.to.input.value >= self.from.input.value { 1.0 } else { -1.0 }
    }

    /// How far the input goes, in degrees.
    pub fn input_length(&self) -> f64 {
        (self.to.input.value - self.from.input.value).abs()
    }

    /// The least and the greatest input on it.
    pub fn input_range(&self) -> [f64; 2] {
        [self.from.input.value.min(self.to.input.value), self.from.input.value.max(self.to.input.value)]
    }

    fn reversed(&self) -> Pass {
        Pass { from: self.to, to: self.from, mode: self.mode }
    }

    fn shifted(&self, deg: f64) -> Pass {
        let moved =
            |end: PassEnd| PassEnd { input: InputPosition { value: end.input.value + deg, ..end.input }, ..end };
        Pass { from: moved(self.from), to: moved(self.to), mode: self.mode }
    }
}

/// A circuit before it is sampled.
#[derive(Clone, Debug)]
pub(super) struct UnsampledCircuit {
    pub passes: Vec<Pass>,
    pub is_closed: bool,
}

impl UnsampledCircuit {
    /// What it lacks of the range asked for, from and to in degrees.
    fn incomplete_reason(&self, [from, to]: [f64; 2], input: Input) -> Option<String> {
        let [low, high] = input_range(&self.passes);
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
fn input_range(passes: &[Pass]) -> [f64; 2] {
    let ends = || passes.iter().flat_map(|pass| [pass.from.input.value, pass.to.input.value]);
    [ends().fold(f64::INFINITY, f64::min), ends().fold(f64::NEG_INFINITY, f64::max)]
}

pub(super) struct CircuitSet {
    pub circuits: Vec<UnsampledCircuit>,
    pub incomplete_reason: Option<String>,
}

/// The circuits that the linkage's [`crate::linkage::MotionOptions`] asks for, in order.
pub(super) fn find_circuits(linkage: &Linkage) -> CircuitSet {
    let reach = find_intervals(linkage);
    let all = &reach.intervals;
    let mut left: Vec<usize> = (0..all.len()).collect();
    let mut shortfall = reach.incomplete_reason.clone().filter(|_| all.is_empty());
    if linkage.motion_options.circuits == CircuitSelection::Start {
        match start_interval(linkage, all) {
            Ok(interval) => left = vec![interval],
            Err(reason) => {
                left.clear();
                shortfall = Some(reach.incomplete_reason.clone().unwrap_or(reason));
            }
        }
    }
    let mut seen = vec![false; all.len()];
    let mut circuits = Vec::new();
    for interval in left {
        if !seen[interval] {
            circuits.push(trace_circuit(linkage, all, interval, &mut seen));
        }
    }
    if let (Some(range), None) = (linkage.motion_options.range, &shortfall) {
        shortfall =
            circuits.iter().find_map(|route: &UnsampledCircuit| route.incomplete_reason(range, linkage.input()));
    }
    circuits.sort_by(|a, b| {
        let key = |route: &UnsampledCircuit| (route.passes[0].mode.sign(0) < 0, route.passes[0].from.input.value);
        let (a, b) = (key(a), key(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    CircuitSet { circuits, incomplete_reason: shortfall }
}

/// The interval of the start pose.
fn start_interval(linkage: &Linkage, all: &[Interval]) -> Result<usize, String> {
    let signs = linkage.motion_options.mode;
    let ours: Vec<usize> = (0..all.len()).filter(|&k| all[k].mode == signs).collect();
    let period = linkage.input().period();
    let at = match linkage.motion_options.start {
        Some(at) => at,
        None => middle_of_first_range(all, &ours, period).ok_or("no input allows the sides asked for")?,
    };
    let within = |k: &usize| all[*k].span.wrap(at, period).is_some();
    if let (Some(start), Some([from, to])) = (linkage.motion_options.start, linkage.motion_options.range)
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
            Span::FullTurn => return Some(period / 2.0),
            Span::Range { lower, upper } => ranges.push([lower.input.value, upper.input.value]),
        }
    }
    let joined = |a: [f64; 2], b: [f64; 2]| ((b[0] - a[1]) % period).abs() < 1e-9;
    while let Some((i, j)) = ordered_pairs(ranges.len()).find(|&(i, j)| joined(ranges[i], ranges[j])) {
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

fn ordered_pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (0..n).map(move |j| (i, j))).filter(|(i, j)| i != j)
}

/// The circuit through an interval: on to what follows its upper end, and, where that ends, back from its lower.
fn trace_circuit(linkage: &Linkage, all: &[Interval], first: usize, seen: &mut [bool]) -> UnsampledCircuit {
    seen[first] = true;
    let period = linkage.input().period();
    if all[first].span == Span::FullTurn {
        return UnsampledCircuit { passes: vec![all[first].to_pass(true, period)], is_closed: true };
    }
    let mut passes = vec![all[first].to_pass(true, period)];
    let closed = append_following(linkage, all, (first, true), &mut passes, seen);
    if !closed {
        let mut before = vec![all[first].to_pass(false, period)];
        append_following(linkage, all, (first, false), &mut before, seen);
        before.reverse();
        before.pop();
        passes = before.iter().map(Pass::reversed).chain(passes).collect();
    }
    let asked = linkage.motion_options.range.is_some();
    UnsampledCircuit { passes: normalize_passes(passes, closed, asked, period), is_closed: closed }
}

/// Appends the passes that follow `(interval, rising)`; whether they come back to where they began.
fn append_following(
    linkage: &Linkage,
    all: &[Interval],
    begun: (usize, bool),
    passes: &mut Vec<Pass>,
    seen: &mut [bool],
) -> bool {
    let mut at = begun;
    while let Some(next) = next_interval(linkage, all, at) {
        if next == begun {
            return true;
        }
        if seen[next.0] {
            // Only where several dyads lie flat at once does a third interval meet two that are already joined.
            return false;
        }
        seen[next.0] = true;
        passes.push(all[next.0].to_pass(next.1, linkage.input().period()));
        at = next;
    }
    false
}

/// The interval that follows, and whether the input rises on it.
fn next_interval(linkage: &Linkage, all: &[Interval], (interval, rising): (usize, bool)) -> Option<(usize, bool)> {
    let from = &all[interval];
    let end = from.end(rising)?;
    let (signs, rises) = end.next_mode(from.mode, rising, &linkage.motion_options)?;
    // It begins where this one ends: falling from the same upper end, or rising from the same lower one.
    let begins = |k: &usize| all[*k].mode == signs && all[*k].end(!rises).is_some_and(|e| e.id == end.id);
    (0..all.len()).find(begins).map(|k| (k, rises))
}

/// The passes with a continuous input, started where a circuit starts.
fn normalize_passes(passes: Vec<Pass>, closed: bool, asked: bool, period: f64) -> Vec<Pass> {
    let backward: Vec<Pass> = passes.iter().rev().map(Pass::reversed).collect();
    let turns = passes.iter().any(|pass| pass.input_direction() != passes[0].input_direction());
    let mut best: Option<Vec<Pass>> = None;
    for direction in [passes, backward] {
        let direction = if closed && !turns { cut_at_zero(direction, period) } else { direction };
        let starts = if closed { direction.len() } else { 1 };
        for start in 0..starts {
            let n = direction.len();
            let rotated: Vec<Pass> = (0..n).map(|k| direction[(start + k) % n]).collect();
            let candidate = make_continuous(join_passes(rotated), turns, asked, period);
            if closed
                && candidate[0].input_direction() < 0.0
                && candidate.iter().any(|pass| pass.input_direction() > 0.0)
            {
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
    let key = |passes: &[Pass]| (passes[0].input_direction() < 0.0, passes[0].from.input.value);
    let (ka, kb) = (key(a), key(b));
    ka.0.cmp(&kb.0).then(ka.1.total_cmp(&kb.1)).then(a[0].mode.cmp(&b[0].mode)).is_lt()
}

/// A motion that never turns round starts at input 0: a pass over it is cut in two there.
fn cut_at_zero(passes: Vec<Pass>, period: f64) -> Vec<Pass> {
    let mut cut = Vec::new();
    for pass in passes {
        let [low, high] = pass.input_range();
        let zero = (high / period).ceil() * period - period;
        if zero > low {
            let at = PassEnd { input: InputPosition::from_degrees(zero), flat_dyads: DyadSet::EMPTY };
            cut.push(Pass { to: at, ..pass });
            cut.push(Pass { from: at, ..pass });
        } else {
            cut.push(pass);
        }
    }
    cut
}

/// The passes with those made one that [`cut_at_zero`] parted and a circuit does not start at.
fn join_passes(passes: Vec<Pass>) -> Vec<Pass> {
    let mut out: Vec<Pass> = Vec::new();
    for pass in passes {
        match out.last_mut() {
            Some(last) if last.to == pass.from && last.to.flat_dyads.is_empty() && last.mode == pass.mode => {
                last.to = pass.to
            }
            _ => out.push(pass),
        }
    }
    out
}

/// Shifts passes by whole turns so that each begins where the one before ends, and the whole lies where it should:
/// the middle of a rocking circuit in (-180, 180], the start of a turning one in the first period, a range asked for as asked.
fn make_continuous(mut passes: Vec<Pass>, turns: bool, asked: bool, period: f64) -> Vec<Pass> {
    for k in 1..passes.len() {
        let gap = passes[k - 1].to.input.value - passes[k].from.input.value;
        passes[k] = passes[k].shifted((gap / period).round() * period);
    }
    let [low, high] = input_range(&passes);
    let whole = if asked {
        0.0
    } else if turns || high - low < period {
        (0.5 - (low + high) / (2.0 * period)).floor()
    } else {
        -(passes[0].from.input.value / period).floor()
    };
    passes.into_iter().map(|pass| pass.shifted(whole * period)).collect()
}

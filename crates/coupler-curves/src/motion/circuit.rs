//! Circuits from intervals: which interval follows which, where a circuit starts, and the order of the circuits.

use std::collections::HashSet;
use std::ops::Range;

use super::AssemblyError;
use super::end_series::continuous_mode;
use super::group::NamedPose;
use super::input_columns::InputColumns;
use super::interval::{Interval, Span};
use super::interval_search::IntervalSearch;
use super::pass::{Heading, InputPosition, Pass, PassEnd};
use super::pass_positions::positions_at_inputs;
use crate::linkage::{CircuitSelection, DyadId, Group, Input, JointId, Linkage};

/// A circuit that is not yet sampled; see [`super::Sampler::sample_circuit`].
#[derive(Clone, Debug)]
pub struct UnsampledCircuit {
    /// Its passes, in order, at least one.
    pub passes: Vec<Pass>,
    /// Whether it ends where it begins.
    pub is_closed: bool,
}

impl UnsampledCircuit {
    /// What it lacks of the requested range, from and to in degrees or lengths.
    fn missing_range(&self, [from, to]: [f64; 2], input: Input) -> Option<AssemblyError> {
        let [low, high] = input_range(&self.passes);
        let is_whole = (low <= from && high >= to) || high - low >= input.period();
        let in_degrees = input != Input::Length;
        let error = AssemblyError::RangeNotReached { reached: [low, high], requested: [from, to], in_degrees };
        (!is_whole).then_some(error)
    }
}

/// The least and the greatest input of a chain of passes.
fn input_range(passes: &[Pass]) -> [f64; 2] {
    let ends = || passes.iter().flat_map(|pass| [pass.from.input.value, pass.to.input.value]);
    [ends().fold(f64::INFINITY, f64::min), ends().fold(f64::NEG_INFINITY, f64::max)]
}

/// The circuits of a linkage; see [`find_circuits`].
#[derive(Clone, Debug)]
pub struct CircuitSet {
    /// The circuits, in the order of [`super::Motion::circuits`].
    pub circuits: Vec<UnsampledCircuit>,
    /// Why the linkage cannot be assembled at all, or not over the whole requested range.
    pub assembly_error: Option<AssemblyError>,
}

/// Finds the circuits that the linkage's [`crate::linkage::MotionOptions`] select, without sampling them.
pub fn find_circuits(linkage: &Linkage) -> CircuitSet {
    let mut search = IntervalSearch::new(linkage);
    let traced = match linkage.motion_options.circuits {
        _ if let Some(group) = &linkage.group => trace_group(&mut search, group),
        CircuitSelection::Start => trace_start_circuit(&mut search),
        CircuitSelection::All => trace_all_circuits(&mut search),
    };
    let mut circuits = match traced {
        Ok(circuits) => circuits,
        Err(error) => return CircuitSet { circuits: Vec::new(), assembly_error: Some(error) },
    };
    let mut assembly_error = search.assembly_error().filter(|_| circuits.is_empty()).cloned();
    if let (Some(range), None) = (linkage.motion_options.range, &assembly_error) {
        assembly_error =
            circuits.iter().find_map(|circuit: &UnsampledCircuit| circuit.missing_range(range, linkage.input()));
    }
    let assembly_error = assembly_error.or_else(|| search.motion_end().cloned());
    circuits.sort_by(|a, b| {
        let key = |circuit: &UnsampledCircuit| {
            (circuit.passes[0].mode.sign(DyadId::FIRST) < 0, circuit.passes[0].from.input.value)
        };
        let (a, b) = (key(a), key(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    CircuitSet { circuits, assembly_error }
}

/// Traces the circuit through the start pose. Only the assembly modes that it passes through are searched.
pub(super) fn trace_start_circuit(search: &mut IntervalSearch) -> Result<Vec<UnsampledCircuit>, AssemblyError> {
    let of_mode = search.intervals_of(search.linkage.motion_options.mode)?;
    let start = start_interval(search.linkage, search.intervals(), of_mode)
        .map_err(|error| search.assembly_error().cloned().unwrap_or(error))?;
    Ok(vec![trace_circuit(search, start, &mut HashSet::new())?])
}

/// Traces the circuits of a linkage with a group.
fn trace_group(search: &mut IntervalSearch, group: &Group) -> Result<Vec<UnsampledCircuit>, AssemblyError> {
    let (linkage, all) = (search.linkage, CircuitSelection::All);
    let poses = match &linkage.driven_elsewhere {
        Some(other) if linkage.motion_options.circuits == all => poses_of_circuits(other)?,
        _ => Vec::new(),
    };
    let start = search.add_group(group, &poses)?;
    let mut seen = HashSet::new();
    let mut circuits = vec![trace_circuit(search, start, &mut seen)?];
    let others = if linkage.motion_options.circuits == all { 0..search.intervals().len() } else { 0..0 };
    for interval in others {
        if !seen.contains(&interval) {
            circuits.push(trace_circuit(search, interval, &mut seen)?);
        }
    }
    Ok(circuits)
}

/// A pose on each circuit of a linkage that dyads place.
fn poses_of_circuits(linkage: &Linkage) -> Result<Vec<NamedPose<'_>>, AssemblyError> {
    let CircuitSet { circuits, assembly_error } = find_circuits(linkage);
    if let (true, Some(error)) = (circuits.is_empty(), assembly_error) {
        return Err(error);
    }
    let pose_of = |circuit: &UnsampledCircuit| {
        let pass = &circuit.passes[0];
        // Not in the middle, where symmetrical linkages have poses that are not regular.
        let input = pass.from.input.value + (pass.to.input.value - pass.from.input.value) * 0.381_966;
        let positions = positions_at_inputs(linkage, pass, &InputColumns::from_values(linkage.input(), [input]));
        let point = |joint: JointId| (linkage.joints[joint].name.as_str(), positions.point(joint, 0));
        linkage.joint_ids().map(point).collect()
    };
    Ok(circuits.iter().map(pose_of).collect())
}

/// Traces every circuit.
fn trace_all_circuits(search: &mut IntervalSearch) -> Result<Vec<UnsampledCircuit>, AssemblyError> {
    search.find_all()?;
    let mut seen = HashSet::new();
    let mut circuits = Vec::new();
    for interval in 0..search.intervals().len() {
        if !seen.contains(&interval) {
            circuits.push(trace_circuit(search, interval, &mut seen)?);
        }
    }
    Ok(circuits)
}

/// The index of the interval that contains the start pose; `of_mode` are those of the mode at the start.
fn start_interval(linkage: &Linkage, all: &[Interval], mut of_mode: Range<usize>) -> Result<usize, AssemblyError> {
    let period = linkage.input().period();
    let at = match linkage.motion_options.start {
        Some(at) => at,
        None => middle_of_first_range(&all[of_mode.clone()], period).ok_or(AssemblyError::NoStart)?,
    };
    if let (Some(start), Some([from, to])) = (linkage.motion_options.start, linkage.motion_options.range)
        && (start - from).rem_euclid(period) > to - from
    {
        return Err(AssemblyError::StartOutOfRange { start, range: [from, to] });
    }
    of_mode.find(|&k| all[k].span.wrap(at, period).is_some()).ok_or(AssemblyError::OpenAtStart { start: at })
}

/// The middle of the first range of the input, from 0 upward, in which the linkage can be assembled; change points do
/// not divide a range.
fn middle_of_first_range(of_mode: &[Interval], period: f64) -> Option<f64> {
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    for interval in of_mode {
        match interval.span {
            Span::FullTurn => return Some(period / 2.0),
            Span::Range { lower, upper } => ranges.push([lower.input.value, upper.input.value]),
        }
    }
    let are_adjacent = |a: [f64; 2], b: [f64; 2]| ((b[0] - a[1]) % period).abs() < 1e-9;
    while let Some((i, j)) = ordered_pairs(ranges.len()).find(|&(i, j)| are_adjacent(ranges[i], ranges[j])) {
        ranges[i][1] += ranges[j][1] - ranges[j][0];
        ranges.remove(j);
    }
    let first_input = |range: &[f64; 2]| {
        let lower = range[0].rem_euclid(period);
        if lower + (range[1] - range[0]) >= period || lower == 0.0 { 0.0 } else { lower }
    };
    let first = ranges.iter().min_by(|a, b| first_input(a).total_cmp(&first_input(b)))?;
    Some((first[0] + first[1]) / 2.0)
}

/// All pairs of different indices below `n`, in both orders.
fn ordered_pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (0..n).map(move |j| (i, j))).filter(|(i, j)| i != j)
}

/// Traces the circuit through an interval: forward from its upper end and, if the motion ends there, backward from its
/// lower end.
fn trace_circuit(
    search: &mut IntervalSearch,
    first: usize,
    seen: &mut HashSet<usize>,
) -> Result<UnsampledCircuit, AssemblyError> {
    seen.insert(first);
    let period = search.linkage.input().period();
    let first_interval = search.intervals()[first].clone();
    let mut passes = vec![first_interval.to_pass(true, period)];
    if first_interval.span == Span::FullTurn {
        return Ok(UnsampledCircuit { passes, is_closed: true });
    }
    let closed = append_following(search, Step { interval: first, rises: true }, &mut passes, seen)?;
    if !closed {
        let mut before = vec![first_interval.to_pass(false, period)];
        append_following(search, Step { interval: first, rises: false }, &mut before, seen)?;
        before.reverse();
        before.pop();
        passes = before.iter().map(Pass::reversed).chain(passes).collect();
    }
    Ok(UnsampledCircuit { passes: normalize_passes(search.linkage, passes, closed), is_closed: closed })
}

/// An interval, by its index, and whether the input rises on it.
#[derive(Clone, Copy, PartialEq)]
struct Step {
    interval: usize,
    rises: bool,
}

/// Appends the passes that follow `start`. Returns whether they lead back to it.
fn append_following(
    search: &mut IntervalSearch,
    start: Step,
    passes: &mut Vec<Pass>,
    seen: &mut HashSet<usize>,
) -> Result<bool, AssemblyError> {
    let mut current = start;
    while let Some(next) = next_interval(search, current)? {
        if next == start {
            return Ok(true);
        }
        if !seen.insert(next.interval) {
            // This interval belongs to a circuit already: only where several dyads are flat at one input can three
            // intervals meet.
            return Ok(false);
        }
        passes.push(search.intervals()[next.interval].to_pass(next.rises, search.linkage.input().period()));
        current = next;
    }
    Ok(false)
}

/// The step that follows.
fn next_interval(search: &mut IntervalSearch, step: Step) -> Result<Option<Step>, AssemblyError> {
    let from = &search.intervals()[step.interval];
    let Some(end) = from.end(step.rises) else { return Ok(None) };
    let before = Heading { mode: from.mode, rises: step.rises };
    let Some(after) = end.next_heading(before, &search.linkage.motion_options) else { return Ok(None) };
    let rises = after.rises;
    let mode = match continuous_mode(search.linkage, &end.to_pass_end(), before, after) {
        Ok(mode) => mode,
        Err(error) => {
            search.end_motion(error);
            return Ok(None);
        }
    };
    let mut of_mode = search.intervals_of(mode)?;
    // The next interval begins at this end: falling from the same upper end, or rising from the same lower one.
    let begins = |&k: &usize| search.intervals()[k].end(!rises).is_some_and(|e| e.id == end.id);
    Ok(of_mode.find(begins).map(|interval| Step { interval, rises }))
}

/// Rotates, and if necessary reverses, a chain of passes so that the circuit starts at its normal start, and makes the
/// input continuous.
fn normalize_passes(linkage: &Linkage, passes: Vec<Pass>, closed: bool) -> Vec<Pass> {
    let (period, has_range) = (linkage.input().period(), linkage.motion_options.range.is_some());
    let backward: Vec<Pass> = passes.iter().rev().map(Pass::reversed).collect();
    let reverses = passes.iter().any(|pass| pass.input_direction() != passes[0].input_direction());
    let mut best: Option<Vec<Pass>> = None;
    let directions = match gain(linkage, &passes) {
        gain if closed && reverses && gain > 0.0 => vec![passes],
        gain if closed && reverses && gain < 0.0 => vec![backward],
        _ => vec![passes, backward],
    };
    for direction in directions {
        let direction = if closed && !reverses { cut_at_zero(direction, period) } else { direction };
        let starts = if closed { direction.len() } else { 1 };
        for start in 0..starts {
            let n = direction.len();
            let rotated: Vec<Pass> = (0..n).map(|k| direction[(start + k) % n].clone()).collect();
            let candidate = make_continuous(join_passes(rotated), reverses, has_range, period);
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

/// What tells the two ways round a closed circuit apart wherever it begins, positive for the way in which it is traced: what the input
/// gains; where it gains nothing, how much further it rises with the first dyad on the left and falls with it on the right than the
/// other way round; and so on for the other dyads. 0 if nothing does.
fn gain(linkage: &Linkage, passes: &[Pass]) -> f64 {
    /// Of a sum of differences, relative to that of their sizes.
    const ROUNDING: f64 = 1e-9;
    let gained = |sign: &dyn Fn(&Pass) -> f64| -> f64 {
        passes.iter().map(|pass| sign(pass) * pass.input_direction() * pass.input_length()).sum()
    };
    let length: f64 = passes.iter().map(Pass::input_length).sum();
    let of_dyads = linkage.dyad_ids().map(|dyad| gained(&|pass| f64::from(pass.mode.sign(dyad))));
    let mut gains = std::iter::once(gained(&|_| 1.0)).chain(of_dyads);
    gains.find(|gain| gain.abs() > ROUNDING * length).unwrap_or(0.0)
}

/// Whether the start of `a` is preferred to that of `b`: rising, from a lower input, on branch 1.
fn precedes(a: &[Pass], b: &[Pass]) -> bool {
    let key = |passes: &[Pass]| (passes[0].input_direction() < 0.0, passes[0].from.input.value);
    let (ka, kb) = (key(a), key(b));
    ka.0.cmp(&kb.0).then(ka.1.total_cmp(&kb.1)).then(a[0].mode.cmp(&b[0].mode)).is_lt()
}

/// Cuts a pass through input 0 in two there: a motion that never reverses starts at input 0.
fn cut_at_zero(passes: Vec<Pass>, period: f64) -> Vec<Pass> {
    let mut cut = Vec::new();
    for pass in passes {
        let [low, high] = pass.input_range();
        let zeros =
            (0..).map(|k| ((low / period).floor() + 1.0 + f64::from(k)) * period).take_while(|zero| *zero < high);
        let ends = zeros.map(|zero| PassEnd::regular(InputPosition::from_degrees(zero)));
        let mut ends: Vec<PassEnd> = ends.collect();
        if pass.input_direction() < 0.0 {
            ends.reverse();
        }
        let mut rest = pass;
        for end in ends {
            cut.push(Pass { to: end, ..rest.clone() });
            rest = Pass { from: end, ..rest };
        }
        cut.push(rest);
    }
    cut
}

/// Joins the passes again that [`cut_at_zero`] divided, except where the circuit starts.
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

/// Shifts passes by whole periods so that each begins where the previous one ends, and normalizes the input: the middle
/// of a rocking circuit is in (-180, 180], the start of a rotating one in the first period; a requested range is kept.
fn make_continuous(mut passes: Vec<Pass>, reverses: bool, has_range: bool, period: f64) -> Vec<Pass> {
    for k in 1..passes.len() {
        let gap = passes[k - 1].to.input.value - passes[k].from.input.value;
        passes[k] = passes[k].shifted((gap / period).round() * period);
    }
    let [low, high] = input_range(&passes);
    let whole = if has_range {
        0.0
    } else if reverses || high - low < period {
        (0.5 - (low + high) / (2.0 * period)).floor()
    } else {
        -(passes[0].from.input.value / period).floor()
    };
    passes.into_iter().map(|pass| pass.shifted(whole * period)).collect()
}

//! A recorded curve held against the one that comes out now.

use super::curve_samples::{CurveSamples, point_distance};
use super::finding::{Change, Displacement, coordinates};
use super::hausdorff::hausdorff_distance;
use crate::manifest::Tolerances;
use coupler_curves::geometry::Point;
use coupler_curves::motion::Circuit;
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// A curve as it comes out now.
#[derive(Clone, Copy)]
pub(super) struct CurrentCurve<'a> {
    pub samples: &'a CurveSamples,
    pub solved: &'a SolvedCell,
    pub curve: &'a MeasuredCurve,
}

impl CurrentCurve<'_> {
    fn circuit(&self) -> &Circuit {
        self.solved.circuit(self.curve)
    }
}

/// In what a recorded curve differs; `missing` are the numbers of samples that its rows leave out.
pub(super) fn compare_curves(
    was: &CurveSamples,
    is: CurrentCurve,
    (missing, names): (Vec<usize>, &[(String, usize)]),
    tolerances: &Tolerances,
) -> Vec<Change> {
    let size = is.samples.size();
    let allowed = tolerances.atol.max(tolerances.rtol * size);
    // Inputs are compared by their own size, and that of a degree, or of the unit.
    let is_same_input = |was: f64, is: f64| (was - is).abs() <= tolerances.rtol * was.abs().max(is.abs()).max(1.0);
    let apart = || hausdorff_distance(was, is.samples, (is.solved, is.curve.joint, is.circuit()));
    let inputs = || was.inputs.iter().zip(&is.samples.inputs);
    if was.len() == is.samples.len() && missing.is_empty() && inputs().all(|(was, is)| is_same_input(*was, *is)) {
        return compare_samples(was, is.samples, (size, allowed), names, tolerances, apart);
    }
    let is_same = |was: Point, is: Point| point_distance(was, is) <= allowed.max(1e-9 * size);
    if let Some(change) = find_reordering(was, is.samples, is.circuit().is_closed, is_same) {
        return vec![change];
    }
    let mut changes =
        vec![Change::Samples { recorded: was.len(), current: is.samples.len(), missing, hausdorff_distance: apart() }];
    // Those at the same input, one after the other, tell of the rest.
    let pairs = match_inputs(was, is.samples, is_same_input);
    if !pairs.is_empty() {
        let (mut ours, mut theirs) = (is.samples.clone(), was.clone());
        theirs.select(&pairs.iter().map(|pair| pair.0).collect::<Vec<_>>());
        ours.select(&pairs.iter().map(|pair| pair.1).collect::<Vec<_>>());
        changes.extend(compare_samples(&theirs, &ours, (size, allowed), names, tolerances, apart));
    }
    changes
}

/// In what samples differ that stand against each other, one by one.
fn compare_samples(
    was: &CurveSamples,
    is: &CurveSamples,
    (size, allowed): (f64, f64),
    names: &[(String, usize)],
    tolerances: &Tolerances,
    apart: impl Fn() -> f64,
) -> Vec<Change> {
    let mut changes = Vec::new();
    for (was, now) in was.branches.iter().zip(&is.branches) {
        let differing: Vec<usize> = (0..now.len()).filter(|&k| was[k] != now[k]).collect();
        if let Some(&sample) = differing.first() {
            let (samples, input) = (differing.len(), is.inputs[sample]);
            changes.push(Change::Branch {
                sample: is.sample_numbers[sample],
                input,
                samples,
                recorded: was[sample],
                current: now[sample],
            });
        }
    }
    let far: Vec<f64> = was.points.iter().zip(&is.points).map(|(was, is)| point_distance(*was, *is)).collect();
    let moved = far.iter().filter(|&&far| far > allowed).count();
    if let Some(furthest) = (0..far.len()).max_by(|&a, &b| far[a].total_cmp(&far[b])).filter(|_| moved > 0) {
        changes.push(Change::Moved(Displacement {
            distance: far[furthest],
            relative: far[furthest] / size,
            sample: is.sample_numbers[furthest],
            input: is.inputs[furthest],
            recorded: coordinates(was.points[furthest]),
            current: coordinates(is.points[furthest]),
            moved_samples: moved,
            total_samples: far.len(),
            hausdorff_distance: apart(),
        }));
    }
    for ((name, _), (was, now)) in names.iter().zip(was.further_columns.iter().zip(&is.further_columns)) {
        let off = |k: usize| relative_difference([was[k], now[k]], 1.0);
        let worst = (0..now.len()).max_by(|&a, &b| off(a).total_cmp(&off(b)));
        if let Some(k) = worst.filter(|&k| off(k) > tolerances.measure_rtol) {
            changes.push(Change::Column {
                name: name.clone(),
                sample: is.sample_numbers[k],
                recorded: was[k],
                current: now[k],
            });
        }
    }
    changes
}

/// By how much two values differ, in parts of the greater, or of `least` if that is more; infinitely if one is missing.
pub(super) fn relative_difference([was, is]: [f64; 2], least: f64) -> f64 {
    match (was.is_nan(), is.is_nan()) {
        (true, true) => 0.0,
        (false, false) if was == is => 0.0,
        (false, false) => {
            let by = (was - is).abs() / was.abs().max(is.abs()).max(least);
            if by.is_nan() { f64::INFINITY } else { by }
        }
        _ => f64::INFINITY,
    }
}

/// Whether a curve has the same points in the other direction, or from another on.
fn find_reordering(
    was: &CurveSamples,
    is: &CurveSamples,
    closed: bool,
    is_same: impl Fn(Point, Point) -> bool,
) -> Option<Change> {
    let n = is.len();
    if was.len() != n || n < 3 {
        return None;
    }
    let all = |place: &dyn Fn(usize) -> usize| (0..n).all(|k| is_same(was.points[k], is.points[place(k)]));
    if all(&|k| k) {
        return None;
    }
    if all(&|k| n - 1 - k) || closed && all(&|k| (n - k) % n) {
        return Some(Change::CircuitReversed);
    }
    let by = (1..n).find(|&by| closed && all(&|k| (k + by) % n));
    by.map(|by| Change::CircuitShifted { by })
}

/// The places of samples that have one input, in order, in both curves.
fn match_inputs(
    was: &CurveSamples,
    is: &CurveSamples,
    is_same_input: impl Fn(f64, f64) -> bool,
) -> Vec<(usize, usize)> {
    /// A sample that was put in or left out puts the others off by no more than this.
    const MAX_SHIFT: usize = 64;
    let mut pairs = Vec::new();
    let mut next = 0;
    for k in 0..was.len() {
        let ahead = next..is.len().min(next + MAX_SHIFT);
        if let Some(at) = ahead.into_iter().find(|&at| is_same_input(was.inputs[k], is.inputs[at])) {
            pairs.push((k, at));
            next = at + 1;
        }
    }
    pairs
}

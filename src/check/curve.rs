//! Compares a recorded curve with the current one.

use super::curve_samples::{CurveSamples, point_distance};
use super::finding::{Change, Displacement};
use super::hausdorff::hausdorff_distance;
use crate::manifest::Tolerances;
use coupler_curves::geometry::Point;
use coupler_curves::motion::Circuit;
use coupler_curves::solve::{MeasuredCurve, SolvedCell};

/// A curve of a freshly solved cell.
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

/// The changes from a recorded curve to the current one.
///
/// `missing` are the numbers of samples that its rows leave out; `names` are the further columns to compare.
pub(super) fn compare_curves(
    recorded: &CurveSamples,
    current: CurrentCurve,
    (missing, names): (Vec<usize>, &[(String, usize)]),
    tolerances: &Tolerances,
) -> Vec<Change> {
    let size = current.samples.size();
    let allowed = tolerances.atol.max(tolerances.rtol * size);
    // Inputs are compared relative to themselves, and at least to one degree or unit of length.
    let is_same_input = |recorded: f64, current: f64| {
        (recorded - current).abs() <= tolerances.rtol * recorded.abs().max(current.abs()).max(1.0)
    };
    let distance =
        || hausdorff_distance(recorded, current.samples, (current.solved, current.curve.joint, current.circuit()));
    let inputs = || recorded.inputs.iter().zip(&current.samples.inputs);
    if recorded.len() == current.samples.len()
        && missing.is_empty()
        && inputs().all(|(recorded, current)| is_same_input(*recorded, *current))
    {
        return compare_samples(recorded, current.samples, (size, allowed), names, tolerances, distance);
    }
    let is_same = |recorded: Point, current: Point| point_distance(recorded, current) <= allowed.max(1e-9 * size);
    if let Some(change) = find_reordering(recorded, current.samples, current.circuit().is_closed, is_same) {
        return vec![change];
    }
    let mut changes = vec![Change::Samples {
        recorded: recorded.len(),
        current: current.samples.len(),
        missing,
        hausdorff_distance: distance(),
    }];
    // The samples at common inputs show what else has changed.
    let pairs = match_inputs(recorded, current.samples, is_same_input);
    if !pairs.is_empty() {
        let (mut common_recorded, mut common_current) = (recorded.clone(), current.samples.clone());
        common_recorded.select(&pairs.iter().map(|pair| pair.0).collect::<Vec<_>>());
        common_current.select(&pairs.iter().map(|pair| pair.1).collect::<Vec<_>>());
        changes.extend(compare_samples(
            &common_recorded,
            &common_current,
            (size, allowed),
            names,
            tolerances,
            distance,
        ));
    }
    changes
}

/// The changes from each recorded sample to the current sample of the same index.
///
/// `size` is that of the current curve; a point that moves by more than `allowed` has changed.
fn compare_samples(
    recorded: &CurveSamples,
    current: &CurveSamples,
    (size, allowed): (f64, f64),
    names: &[(String, usize)],
    tolerances: &Tolerances,
    distance: impl Fn() -> f64,
) -> Vec<Change> {
    let mut changes = Vec::new();
    for (recorded, branches) in recorded.branches.iter().zip(&current.branches) {
        let differing: Vec<usize> = (0..branches.len()).filter(|&k| recorded[k] != branches[k]).collect();
        if let Some(&sample) = differing.first() {
            let (samples, input) = (differing.len(), current.inputs[sample]);
            changes.push(Change::Branch {
                sample: current.sample_numbers[sample],
                input,
                samples,
                recorded: recorded[sample],
                current: branches[sample],
            });
        }
    }
    let moves: Vec<f64> = recorded
        .points
        .iter()
        .zip(&current.points)
        .map(|(recorded, current)| point_distance(*recorded, *current))
        .collect();
    let moved_samples = moves.iter().filter(|&&distance| distance > allowed).count();
    let farthest = (0..moves.len()).max_by(|&a, &b| moves[a].total_cmp(&moves[b]));
    if let Some(farthest) = farthest.filter(|_| moved_samples > 0) {
        let coordinates = |p: Point| [p.x, p.y];
        changes.push(Change::Moved(Displacement {
            distance: moves[farthest],
            relative: moves[farthest] / size,
            sample: current.sample_numbers[farthest],
            input: current.inputs[farthest],
            recorded: coordinates(recorded.points[farthest]),
            current: coordinates(current.points[farthest]),
            moved_samples,
            total_samples: moves.len(),
            hausdorff_distance: distance(),
        }));
    }
    for ((name, _), (recorded, values)) in
        names.iter().zip(recorded.further_columns.iter().zip(&current.further_columns))
    {
        let difference = |k: usize| relative_difference([recorded[k], values[k]], 1.0);
        let worst = (0..values.len()).max_by(|&a, &b| difference(a).total_cmp(&difference(b)));
        if let Some(k) = worst.filter(|&k| difference(k) > tolerances.of(name)) {
            changes.push(Change::Column {
                name: name.clone(),
                sample: current.sample_numbers[k],
                recorded: recorded[k],
                current: values[k],
            });
        }
    }
    changes
}

/// The difference of two values relative to the greater in magnitude, or to `least` if that is more; infinite if one of
/// them is NaN, 0 if both are.
pub(super) fn relative_difference([recorded, current]: [f64; 2], least: f64) -> f64 {
    match (recorded.is_nan(), current.is_nan()) {
        (true, true) => 0.0,
        (false, false) if recorded == current => 0.0,
        (false, false) => {
            let difference = (recorded - current).abs() / recorded.abs().max(current.abs()).max(least);
            if difference.is_nan() { f64::INFINITY } else { difference }
        }
        _ => f64::INFINITY,
    }
}

/// Finds out whether a curve has the same points in the opposite direction, or from another first sample.
fn find_reordering(
    recorded: &CurveSamples,
    current: &CurveSamples,
    closed: bool,
    is_same: impl Fn(Point, Point) -> bool,
) -> Option<Change> {
    let n = current.len();
    if recorded.len() != n || n < 3 {
        return None;
    }
    let matches =
        |index: &dyn Fn(usize) -> usize| (0..n).all(|k| is_same(recorded.points[k], current.points[index(k)]));
    if matches(&|k| k) {
        return None;
    }
    if matches(&|k| n - 1 - k) || closed && matches(&|k| (n - k) % n) {
        return Some(Change::CircuitReversed);
    }
    let by = (1..n).find(|&by| closed && matches(&|k| (k + by) % n));
    by.map(|by| Change::CircuitShifted { by })
}

/// The indices of the samples with the same input in both curves, in order.
fn match_inputs(
    recorded: &CurveSamples,
    current: &CurveSamples,
    is_same_input: impl Fn(f64, f64) -> bool,
) -> Vec<(usize, usize)> {
    /// At most this many samples are inserted between two common ones.
    const MAX_SHIFT: usize = 64;
    let mut pairs = Vec::new();
    let mut next = 0;
    for k in 0..recorded.len() {
        let ahead = next..current.len().min(next + MAX_SHIFT);
        if let Some(at) = ahead.into_iter().find(|&at| is_same_input(recorded.inputs[k], current.inputs[at])) {
            pairs.push((k, at));
            next = at + 1;
        }
    }
    pairs
}

//! Matches recorded curves with current ones.

use super::curve_samples::CurveSamples;
use super::finding::Change;
use coupler_curves::geometry::Point;

/// A matching of the recorded curves of a traced joint with the current ones.
pub(super) struct Matching {
    /// The matched pairs: the indices of the recorded and of the current curve.
    pub pairs: Vec<[usize; 2]>,
    /// The changes of recorded circuits, by the indices of their curves.
    pub recorded_changes: Vec<(usize, Change)>,
    /// The changes of current circuits, by the indices of their curves.
    pub current_changes: Vec<(usize, Change)>,
}

/// Matches curves by their numbers if that pairs all of them and each pair overlaps, otherwise by position.
pub(super) fn match_curves(recorded: &[CurveSamples], current: &[CurveSamples]) -> Matching {
    let by_number: Vec<[usize; 2]> = (0..recorded.len())
        .filter_map(|k| Some([k, current.iter().position(|curve| curve.circuit == recorded[k].circuit)?]))
        .collect();
    let is_complete = by_number.len() == recorded.len() && recorded.len() == current.len();
    let is_near = |&[a, b]: &[usize; 2]| current.len() == 1 || overlap([&recorded[a], &current[b]]) > MIN_MATCH_SHARE;
    if is_complete && by_number.iter().all(is_near) {
        return Matching { pairs: by_number, recorded_changes: Vec::new(), current_changes: Vec::new() };
    }
    match_by_position(recorded, current)
}

/// Two curves of the same number match if more than this share of one lies on the other.
const MIN_MATCH_SHARE: f64 = 0.5;

/// Two curves are related if more than this share of one lies on the other.
const MIN_PIECE_SHARE: f64 = 0.1;

fn match_by_position(recorded: &[CurveSamples], current: &[CurveSamples]) -> Matching {
    // The share of each recorded curve that lies on each current one, and of each current one on each recorded one.
    let recorded_shares: Vec<Vec<f64>> = recorded.iter().map(|curve| overlaps(curve, current)).collect();
    let current_shares: Vec<Vec<f64>> = current.iter().map(|curve| overlaps(curve, recorded)).collect();
    let is_related =
        |a: usize, b: usize| recorded_shares[a][b] > MIN_PIECE_SHARE || current_shares[b][a] > MIN_PIECE_SHARE;
    let (mut pairs, mut recorded_changes, mut current_changes) = (Vec::new(), Vec::new(), Vec::new());
    for a in 0..recorded.len() {
        let into: Vec<usize> = (0..current.len()).filter(|&b| is_related(a, b)).collect();
        match into[..] {
            [] => recorded_changes.push((a, Change::CircuitLost)),
            [b] => {
                let from: Vec<usize> = (0..recorded.len()).filter(|&other| is_related(other, b)).collect();
                if let [_] = from[..] {
                    pairs.push([a, b]);
                    if recorded[a].circuit != current[b].circuit {
                        current_changes.push((b, Change::CircuitRenumbered { recorded: recorded[a].circuit }));
                    }
                }
            }
            _ => {
                let into = into.iter().map(|&b| current[b].circuit).collect();
                recorded_changes.push((a, Change::CircuitSplit { into }));
            }
        }
    }
    for b in 0..current.len() {
        let from: Vec<usize> = (0..recorded.len()).filter(|&a| is_related(a, b)).collect();
        match from.len() {
            0 => current_changes.push((b, Change::CircuitAdded)),
            1 => {}
            _ => {
                let from = from.iter().map(|&a| recorded[a].circuit).collect();
                current_changes.push((b, Change::CircuitJoined { from }));
            }
        }
    }
    Matching { pairs, recorded_changes, current_changes }
}

/// The share of a curve that lies on another, estimated from a few of its samples.
fn overlap([curve, other]: [&CurveSamples; 2]) -> f64 {
    overlaps(curve, std::slice::from_ref(other))[0]
}

/// The share of a curve that lies on each of some others; a sample counts for the curve it is nearest to, if that is
/// near.
fn overlaps(curve: &CurveSamples, others: &[CurveSamples]) -> Vec<f64> {
    /// At most this many samples of the curve are tested.
    const MAX_PROBES: usize = 40;
    let mut shares = vec![0.0; others.len()];
    let step = curve.len().div_ceil(MAX_PROBES).max(1);
    let probes: Vec<usize> = (0..curve.len()).step_by(step).collect();
    for &k in &probes {
        let branch = curve.branches.first().map(|branches| branches[k]);
        let distances = others.iter().map(|other| nearest_sample_distance(curve.points[k], branch, other)).enumerate();
        let nearest = distances.min_by(|(_, a), (_, b)| a.total_cmp(b));
        // A sample farther from all of them than a tenth of their size is on none of them.
        if let Some((index, distance)) = nearest
            && distance <= 0.1 * others[index].size().max(curve.size())
        {
            shares[index] += 1.0 / probes.len() as f64;
        }
    }
    shares
}

/// The distance of a point from the nearest sample of a curve; samples on another branch count as farther away.
fn nearest_sample_distance(point: Point, branch: Option<i64>, curve: &CurveSamples) -> f64 {
    let branch_penalty = 1e-3 * curve.size();
    let distance = |k: usize| {
        let is_other = branch.is_some_and(|branch| curve.branches.first().is_some_and(|all| all[k] != branch));
        (curve.points[k] - point).norm() + if is_other { branch_penalty } else { 0.0 }
    };
    (0..curve.len()).map(distance).filter(|distance| !distance.is_nan()).fold(f64::INFINITY, f64::min)
}

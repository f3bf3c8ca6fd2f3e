//! Which recorded curve is which of those that come out now.

use super::curve_samples::CurveSamples;
use super::finding::Change;
use coupler_curves::geometry::Point;

/// The recorded curves of one traced joint, and those that come out now.
pub(super) struct Matching {
    /// Pairs that are held against each other, by their places among both.
    pub pairs: Vec<[usize; 2]>,
    /// What has become of circuits: of recorded ones, and of present ones.
    pub recorded_changes: Vec<(usize, Change)>,
    pub current_changes: Vec<(usize, Change)>,
}

/// Finds them: by their numbers, where that leaves none over and none far from where it was; else by where they are.
pub(super) fn match_curves(was: &[CurveSamples], is: &[CurveSamples]) -> Matching {
    let by_number: Vec<[usize; 2]> = (0..was.len())
        .filter_map(|k| Some([k, is.iter().position(|track| track.circuit == was[k].circuit)?]))
        .collect();
    let all_there = by_number.len() == was.len() && was.len() == is.len();
    let is_near = |&[a, b]: &[usize; 2]| is.len() == 1 || overlap([&was[a], &is[b]]) > MIN_MATCH_SHARE;
    if all_there && by_number.iter().all(is_near) {
        return Matching { pairs: by_number, recorded_changes: Vec::new(), current_changes: Vec::new() };
    }
    match_by_position(was, is)
}

/// More than this part of a curve's probes are on another if it is that one, or part of it.
const MIN_MATCH_SHARE: f64 = 0.5;

/// A piece of a curve that is at least this part of it counts.
const MIN_PIECE_SHARE: f64 = 0.1;

fn match_by_position(was: &[CurveSamples], is: &[CurveSamples]) -> Matching {
    // What part of each recorded curve lies on each present one, and the other way round.
    let out: Vec<Vec<f64>> = was.iter().map(|track| overlaps(track, is)).collect();
    let back: Vec<Vec<f64>> = is.iter().map(|track| overlaps(track, was)).collect();
    let related = |a: usize, b: usize| out[a][b] > MIN_PIECE_SHARE || back[b][a] > MIN_PIECE_SHARE;
    let (mut pairs, mut lost, mut found) = (Vec::new(), Vec::new(), Vec::new());
    for a in 0..was.len() {
        let into: Vec<usize> = (0..is.len()).filter(|&b| related(a, b)).collect();
        match into[..] {
            [] => lost.push((a, Change::CircuitLost)),
            [b] => {
                let from: Vec<usize> = (0..was.len()).filter(|&other| related(other, b)).collect();
                if let [_] = from[..] {
                    pairs.push([a, b]);
                    if was[a].circuit != is[b].circuit {
                        found.push((b, Change::CircuitRenumbered { recorded: was[a].circuit }));
                    }
                }
            }
            _ => lost.push((a, Change::CircuitSplit { into: into.iter().map(|&b| is[b].circuit).collect() })),
        }
    }
    for b in 0..is.len() {
        let from: Vec<usize> = (0..was.len()).filter(|&a| related(a, b)).collect();
        match from.len() {
            0 => found.push((b, Change::CircuitAdded)),
            1 => {}
            _ => found.push((b, Change::CircuitJoined { from: from.iter().map(|&a| was[a].circuit).collect() })),
        }
    }
    Matching { pairs, recorded_changes: lost, current_changes: found }
}

/// What part of a curve lies on another, as far as a few of its samples tell.
fn overlap([track, other]: [&CurveSamples; 2]) -> f64 {
    overlaps(track, std::slice::from_ref(other))[0]
}

/// What part of a curve lies on each of some others: each of its probes on the one that is nearest to it, if that is near.
fn overlaps(track: &CurveSamples, others: &[CurveSamples]) -> Vec<f64> {
    /// So many of a curve's samples are looked for.
    const MAX_PROBES: usize = 40;
    let mut found = vec![0.0; others.len()];
    let step = track.len().div_ceil(MAX_PROBES).max(1);
    let probes: Vec<usize> = (0..track.len()).step_by(step).collect();
    for &k in &probes {
        let branch = track.branches.first().map(|branches| branches[k]);
        let each = others.iter().map(|other| nearest_sample_distance(track.points[k], branch, other)).enumerate();
        let best = each.min_by(|(_, a), (_, b)| a.total_cmp(b));
        // No nearer than this it may be on none of them: a tenth of their size.
        if let Some((at, far)) = best
            && far <= 0.1 * others[at].size().max(track.size())
        {
            found[at] += 1.0 / probes.len() as f64;
        }
    }
    found
}

/// How far a place is from the samples of a curve, those on another branch counting as further off.
fn nearest_sample_distance(point: Point, branch: Option<i64>, track: &CurveSamples) -> f64 {
    let other_branch = 1e-3 * track.size();
    let far = |k: usize| {
        let is_other = branch.is_some_and(|branch| track.branches.first().is_some_and(|all| all[k] != branch));
        (track.points[k] - point).norm() + if is_other { other_branch } else { 0.0 }
    };
    (0..track.len()).map(far).filter(|far| !far.is_nan()).fold(f64::INFINITY, f64::min)
}

//! A recorded curve held against the one that comes out now.

use super::apart::apart;
use super::finding::{Change, Move, coordinates};
use super::track::{Track, distance};
use crate::manifest::Tolerances;
use coupler_curves::geometry::Point;
use coupler_curves::motion::Circuit;
use coupler_curves::solve::{Curve, Solved};

/// A curve as it comes out now.
#[derive(Clone, Copy)]
pub(super) struct Fresh<'a> {
    pub track: &'a Track,
    pub solved: &'a Solved,
    pub curve: &'a Curve,
}

impl Fresh<'_> {
    fn circuit(&self) -> &Circuit {
        self.solved.circuit(self.curve)
    }
}

/// In what a recorded curve differs; `missing` are the numbers of samples that its rows leave out.
pub(super) fn compare(
    was: &Track,
    is: Fresh,
    (missing, names): (Vec<usize>, &[(String, usize)]),
    tolerances: &Tolerances,
) -> Vec<Change> {
    let size = is.track.size();
    let allowed = tolerances.atol.max(tolerances.rtol * size);
    // Inputs are compared by their own size, and that of a degree, or of the unit.
    let is_same_input = |was: f64, is: f64| (was - is).abs() <= tolerances.rtol * was.abs().max(is.abs()).max(1.0);
    let apart = || apart(was, is.track, (is.solved, is.curve.joint, is.circuit()));
    let inputs = || was.input.iter().zip(&is.track.input);
    if was.len() == is.track.len() && missing.is_empty() && inputs().all(|(was, is)| is_same_input(*was, *is)) {
        return samples(was, is.track, (size, allowed), names, tolerances, apart);
    }
    let is_same = |was: Point, is: Point| distance(was, is) <= allowed.max(1e-9 * size);
    if let Some(change) = turned(was, is.track, is.circuit().closed, is_same) {
        return vec![change];
    }
    let mut changes = vec![Change::Samples { was: was.len(), is: is.track.len(), missing, apart: apart() }];
    // Those at the same input, one after the other, tell of the rest.
    let pairs = common(was, is.track, is_same_input);
    if !pairs.is_empty() {
        let (mut ours, mut theirs) = (is.track.clone(), was.clone());
        theirs.keep(&pairs.iter().map(|pair| pair.0).collect::<Vec<_>>());
        ours.keep(&pairs.iter().map(|pair| pair.1).collect::<Vec<_>>());
        changes.extend(samples(&theirs, &ours, (size, allowed), names, tolerances, apart));
    }
    changes
}

/// In what samples differ that stand against each other, one by one.
fn samples(
    was: &Track,
    is: &Track,
    (size, allowed): (f64, f64),
    names: &[(String, usize)],
    tolerances: &Tolerances,
    apart: impl Fn() -> f64,
) -> Vec<Change> {
    let mut changes = Vec::new();
    for (was, now) in was.branches.iter().zip(&is.branches) {
        let differing: Vec<usize> = (0..now.len()).filter(|&k| was[k] != now[k]).collect();
        if let Some(&sample) = differing.first() {
            let (samples, input) = (differing.len(), is.input[sample]);
            changes.push(Change::Branch {
                sample: is.samples[sample],
                input,
                samples,
                was: was[sample],
                is: now[sample],
            });
        }
    }
    let far: Vec<f64> = was.points.iter().zip(&is.points).map(|(was, is)| distance(*was, *is)).collect();
    let moved = far.iter().filter(|&&far| far > allowed).count();
    if let Some(furthest) = (0..far.len()).max_by(|&a, &b| far[a].total_cmp(&far[b])).filter(|_| moved > 0) {
        changes.push(Change::Moved(Move {
            distance: far[furthest],
            relative: far[furthest] / size,
            sample: is.samples[furthest],
            input: is.input[furthest],
            was: coordinates(was.points[furthest]),
            is: coordinates(is.points[furthest]),
            moved,
            of: far.len(),
            apart: apart(),
        }));
    }
    for ((name, _), (was, now)) in names.iter().zip(was.further.iter().zip(&is.further)) {
        let off = |k: usize| difference([was[k], now[k]], 1.0);
        let worst = (0..now.len()).max_by(|&a, &b| off(a).total_cmp(&off(b)));
        if let Some(k) = worst.filter(|&k| off(k) > tolerances.measure_rtol) {
            changes.push(Change::Column { name: name.clone(), sample: is.samples[k], was: was[k], is: now[k] });
        }
    }
    changes
}

/// By how much two values differ, in parts of the greater, or of `least` if that is more; infinitely if one is missing.
pub(super) fn difference([was, is]: [f64; 2], least: f64) -> f64 {
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
fn turned(was: &Track, is: &Track, closed: bool, is_same: impl Fn(Point, Point) -> bool) -> Option<Change> {
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
fn common(was: &Track, is: &Track, is_same_input: impl Fn(f64, f64) -> bool) -> Vec<(usize, usize)> {
    /// A sample that was put in or left out puts the others off by no more than this.
    const FURTHEST: usize = 64;
    let mut pairs = Vec::new();
    let mut next = 0;
    for k in 0..was.len() {
        let ahead = next..is.len().min(next + FURTHEST);
        if let Some(at) = ahead.into_iter().find(|&at| is_same_input(was.input[k], is.input[at])) {
            pairs.push((k, at));
            next = at + 1;
        }
    }
    pairs
}

//! Linkages that are exact at fewer precision points than determine them: the best for starts over their whole range.

use std::f64::consts::PI;

use super::candidates::{Candidates, DISTANCE, TRANSMISSION_DEG, apart, sorted};
use super::generator::{Generator, GeneratorKind};
use super::precision::{GivenStarts, exact};
use super::problem::Problem;
use crate::workers::Workers;
use coupler_curves::geometry::trig;

/// The part of the starts that is searched: the input, the output, or both.
type Place = Vec<f64>;

/// A linkage with its cost and its place.
type Placed = (f64, Place, Generator);

/// The linkages that are looked at, if the best do not meet a condition.
const KEPT: usize = 2000;

/// A transmission angle is kept with a margin, in radians, so that a condition on it holds whatever it is rounded to.
const MARGIN: f64 = 1e-6;

/// The best linkages where one or both starts are open: those of a grid, and those that are best near the best of them; of a condition,
/// which may ask for a transmission angle, for several of these in turn.
pub(super) fn with_open_starts(problem: &Problem, open: usize, workers: &impl Workers) -> Candidates {
    /// The steps of a grid over a turn, if one start is open, and if both are.
    const STEPS: [usize; 2] = [360, 72];
    /// The places from which the best nearby is searched, and how far they are apart.
    const REFINED: usize = 16;
    const APART: f64 = 0.2;
    let steps = STEPS[open - 1];
    let axes: Vec<usize> = (0..2).filter(|k| problem.starts[*k].is_none()).take(open).collect();
    let values = |axis: usize| grid(problem, axis, steps);
    let places: Vec<Place> = match axes[..] {
        [one] => values(one).into_iter().map(|value| vec![value]).collect(),
        _ => {
            let second = values(1);
            values(0).into_iter().flat_map(|a| second.iter().map(move |b| vec![a, *b])).collect()
        }
    };
    let found = workers.map(places, |place| {
        let at = |linkage: Generator| (problem.cost(&linkage), place.clone(), linkage);
        linkages_at(problem, &place, 0.0).map(at).collect::<Vec<Placed>>()
    });
    let mut found: Vec<Placed> = found.into_iter().flatten().collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let levels = if problem.options.condition.is_some() { TRANSMISSION_DEG } else { &TRANSMISSION_DEG[..1] };
    let mut begun: Vec<(f64, Placed)> = Vec::new();
    for level in levels {
        let least = if *level > 0.0 { trig::radians(*level) + MARGIN } else { 0.0 };
        let first = begun.len();
        for candidate in found.iter().filter(|(_, _, linkage)| problem.transmission(linkage) >= least) {
            let is_apart = |(_, other): &(f64, Placed)| other.2.distance_to(&candidate.2) >= APART;
            if begun.len() < first + REFINED && begun[first..].iter().all(is_apart) {
                begun.push((least, candidate.clone()));
            }
        }
    }
    let step = 2.0 * PI / steps as f64;
    let refined = workers.map(begun, |(least, placed)| refined(problem, placed, least, step));
    let on_grid = found.into_iter().take(KEPT).map(|(cost, _, linkage)| (cost, linkage));
    let linkages = sorted(refined.into_iter().chain(on_grid).collect());
    Candidates {
        linkages: apart(linkages, DISTANCE, KEPT),
        near: problem.points[0],
        distance: DISTANCE,
        ..Candidates::default()
    }
}

/// The linkages of a place to which there is no objection, with a transmission angle.
fn linkages_at<'a>(problem: &'a Problem, place: &[f64], least: f64) -> impl Iterator<Item = Generator> + 'a {
    let mut searched = place.iter();
    // The input is searched first; where one is searched and points are left over, the output follows from them.
    let starts: GivenStarts = problem.starts.map(|start| start.or_else(|| searched.next().copied()));
    let found = exact(problem.options.kind, &problem.points, starts).linkages.into_iter();
    found.filter(move |linkage| problem.objection(linkage).is_none() && problem.transmission(linkage) >= least)
}

/// Values of a start: angles over a turn, or ways of a slider on both sides of the crank's pivot, closer together near it.
fn grid(problem: &Problem, axis: usize, steps: usize) -> Vec<f64> {
    let centred = (0..steps).map(|k| (2 * k + 1) as f64 / steps as f64 - 1.0);
    match (axis, problem.options.kind) {
        (1, GeneratorKind::SliderCrank) => centred.map(|part| part / (1.0 - part * part)).collect(),
        // From 0 on, so that round angles are among them.
        _ => (0..steps).map(|k| 2.0 * PI * k as f64 / steps as f64).collect(),
    }
}

/// The best linkage near one, by steps of the open starts in each direction, which become shorter.
fn refined(problem: &Problem, (mut cost, mut place, mut linkage): Placed, least: f64, step: f64) -> (f64, Generator) {
    /// The last step, in radians or sizes.
    const LAST: f64 = 1e-5;
    /// The most rounds, where it goes on and on in one direction.
    const ROUNDS: usize = 100;
    let mut step = 0.5 * step;
    for _ in 0..ROUNDS {
        let mut has_moved = false;
        for axis in 0..place.len() {
            for by in [step, -step] {
                let mut next = place.clone();
                next[axis] += by;
                let better = linkages_at(problem, &next, least).map(|linkage| (problem.cost(&linkage), linkage));
                let better = better.min_by(|a, b| a.0.total_cmp(&b.0));
                if let Some((less, better)) = better.filter(|(less, _)| *less < cost) {
                    (cost, place, linkage) = (less, next, better);
                    has_moved = true;
                    break;
                }
            }
        }
        if !has_moved {
            step *= 0.5;
        }
        if step < LAST {
            break;
        }
    }
    (cost, linkage)
}

//! Searches proportions: by a sweep over a grid, refined from its best points by the simplex method.

use rayon::prelude::*;

use super::requirements::TOLERANCE_RANGE;
use super::simplex::{self, Options};
use super::trial::{Goal, Objective, Trial, UNMET_PENALTY, next_tolerance, proportion_distance};
use coupler_curves::motion::{Sampler, Sampling};

/// The samplers of a search.
pub(super) struct Samplers {
    /// The sampler of the sweep.
    pub coarse: Sampler,
    /// The sampler of results.
    pub fine: Sampler,
}

/// Linkages whose proportions are nearer than this count as alike.
const MIN_DISTANCE: f64 = 0.12;

/// The number of samples by which results are measured.
pub(super) const FINE_SAMPLES: usize = 360;

impl Default for Samplers {
    fn default() -> Samplers {
        const COARSE: usize = 90;
        let sampler = |samples| Sampler::new(Sampling::Samples(samples));
        Samplers { coarse: sampler(COARSE), fine: sampler(FINE_SAMPLES) }
    }
}

/// The best linkages of a kind, the best first, each from another region of proportions; empty if none meets the
/// requirements.
pub(super) fn best_trials(objective: &Objective, samplers: &Samplers) -> Vec<Trial> {
    /// Factors of the tolerance for further sweeps: linkages that barely meet the requirements may be missed by a
    /// sweep, but be found from linkages that meet looser ones.
    const LOOSER: [f64; 2] = [2.0, 5.0];
    let found = sweep_and_refine(objective, samplers);
    if !found.is_empty() {
        return found;
    }
    let looser =
        LOOSER.into_iter().map(|part| objective.tolerance * part).filter(|tolerance| *tolerance <= TOLERANCE_RANGE[1]);
    let mut found = looser.map(|tolerance| {
        let near = sweep_and_refine(&Objective { tolerance, ..*objective }, samplers);
        let refined = near.iter().map(|trial| refine(objective, &trial.proportions, samplers)).collect();
        rank_trials(refined)
    });
    found.find(|found| !found.is_empty()).unwrap_or_default()
}

/// Sorts the refined trials that meet the requirements, the best first, and removes those that are alike.
fn rank_trials(refined: Vec<(f64, Option<Trial>)>) -> Vec<Trial> {
    let mut found: Vec<(f64, Trial)> = refined
        .into_iter()
        .filter_map(|(value, trial)| Some((value, trial?)))
        .filter(|(v, _)| *v < UNMET_PENALTY)
        .collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    distinct_trials(found.into_iter().map(|(_, trial)| trial).collect())
}

/// Refines the best points of a sweep.
fn sweep_and_refine(objective: &Objective, samplers: &Samplers) -> Vec<Trial> {
    /// The number of points that are refined.
    const STARTS: usize = 5;
    let fixed = fixed_p(objective);
    let grid = start_grid(objective, fixed);
    let swept: Vec<f64> =
        grid.par_iter().map(|proportions| objective.evaluate(proportions, &samplers.coarse).0).collect();
    let mut order: Vec<usize> = (0..grid.len()).collect();
    order.sort_by(|&a, &b| swept[a].total_cmp(&swept[b]));
    let mut starts: Vec<&[f64]> = Vec::new();
    for k in order {
        if starts.len() < STARTS && starts.iter().all(|other| proportion_distance(other, &grid[k]) > MIN_DISTANCE) {
            starts.push(&grid[k]);
        }
    }
    // The closed condition is a starting point too, so the result is never worse.
    let closed = fixed.map(|p| objective.driven_linkage.kind.closed_proportions(p)).unwrap_or_default();
    let value_at = |proportions: &Vec<f64>| objective.evaluate(proportions, &samplers.fine).0;
    let closed = closed.iter().min_by(|a, b| value_at(a).total_cmp(&value_at(b)));
    starts.extend(closed.map(Vec::as_slice));
    rank_trials(starts.par_iter().map(|proportions| refine(objective, proportions, samplers)).collect())
}

/// Keeps the first of trials that are alike.
pub(super) fn distinct_trials(trials: Vec<Trial>) -> Vec<Trial> {
    let mut distinct: Vec<Trial> = Vec::new();
    for trial in trials {
        if distinct.iter().all(|other| proportion_distance(&other.proportions, &trial.proportions) > MIN_DISTANCE / 2.0)
        {
            distinct.push(trial);
        }
    }
    distinct
}

/// The `p` that a search keeps fixed.
fn fixed_p(objective: &Objective) -> Option<f64> {
    objective.requirements.p.filter(|_| !matches!(objective.goal, Goal::Frame { .. }))
}

/// Every combination of start values, the last proportion varying fastest.
fn start_grid(objective: &Objective, fixed: Option<f64>) -> Vec<Vec<f64>> {
    let mut grid: Vec<Vec<f64>> = vec![Vec::new()];
    for (axis, free) in objective.driven_linkage.kind.free_proportions(objective.tolerance).iter().enumerate() {
        let values = fixed.filter(|_| axis == 0).map_or(free.start_values.clone(), |p| vec![p]);
        let longer = |start: Vec<f64>| values.iter().map(move |&value| [start.as_slice(), &[value]].concat());
        grid = grid.into_iter().flat_map(longer).collect();
    }
    grid
}

/// Refines a starting point, first with coarse samples and then with fine ones.
fn refine(objective: &Objective, start: &[f64], samplers: &Samplers) -> (f64, Option<Trial>) {
    const ROUGH: Options = Options { initial_step: 1.0, max_evaluations: 100 };
    let rough = minimize_from(objective, start, &samplers.coarse, ROUGH);
    let found = refine_near(objective, rough.1.as_ref().map_or(start, |trial| &trial.proportions), samplers);
    prefer_symmetric(objective, found, samplers)
}

/// Replaces a trial by the nearest symmetric linkage if that is as good to within 0.3 %.
fn prefer_symmetric(objective: &Objective, found: (f64, Option<Trial>), samplers: &Samplers) -> (f64, Option<Trial>) {
    const RELATIVE_TOLERANCE: f64 = 0.003;
    let kind = objective.driven_linkage.kind;
    let Some(proportions) = found.1.as_ref().and_then(|trial| kind.symmetric_proportions(&trial.proportions)) else {
        return found;
    };
    let symmetric = objective.evaluate(&proportions, &samplers.fine);
    if symmetric.1.is_some() && symmetric.0 <= found.0 + RELATIVE_TOLERANCE * found.0.abs() { symmetric } else { found }
}

/// Refines a starting point in its close neighbourhood, with fine samples.
fn refine_near(objective: &Objective, start: &[f64], samplers: &Samplers) -> (f64, Option<Trial>) {
    const CLOSE: Options = Options { initial_step: 0.3, max_evaluations: 50 };
    minimize_from(objective, start, &samplers.fine, CLOSE)
}

/// Minimizes an objective over the logarithms of the free proportions, from a starting point.
fn minimize_from(objective: &Objective, start: &[f64], sampler: &Sampler, options: Options) -> (f64, Option<Trial>) {
    use coupler_curves::geometry::trig::{exp, ln};
    let free = objective.driven_linkage.kind.free_proportions(objective.tolerance);
    let fixed_count = usize::from(fixed_p(objective).is_some());
    let place: Vec<f64> = (fixed_count..start.len()).map(|k| ln(start[k]) / free[k].relative_step).collect();
    let proportions = |place: &[f64]| -> Vec<f64> {
        let moved = place.iter().zip(&free[fixed_count..]).map(|(x, free)| exp(x * free.relative_step));
        start[..fixed_count].iter().copied().chain(moved).collect()
    };
    let (_, value, trial) =
        simplex::minimize(&place, options, |place| objective.evaluate(&proportions(place), sampler));
    // The starting point itself has no rounding from logarithms.
    let at_start = objective.evaluate(start, sampler);
    if at_start.0 <= value { at_start } else { (value, trial) }
}

/// From a trial on, the linkage whose straight portion is a given fraction of its size at the least tolerance; `None`
/// if no tolerance is large enough. Only if `free` are the proportions varied.
pub(super) fn straightest_at_ratio(
    objective: &Objective,
    from: &Trial,
    ratio: f64,
    free: bool,
    samplers: &Samplers,
) -> Option<Trial> {
    const ROUNDS: usize = 8;
    /// The greatest factor of the tolerance in one step; the best proportions cannot be followed further.
    const STRIDE: f64 = 30.0;
    /// The margin by which the required fraction is exceeded.
    const MARGIN: f64 = 1.0 + 1e-6;
    const NEAR_ENOUGH: f64 = 1e-4;
    let kind = objective.driven_linkage.kind;
    let mut best = (from.length_to_size() >= ratio).then(|| from.clone());
    let mut previous: Option<[f64; 2]> = None;
    let mut current = from.clone();
    for _ in 0..ROUNDS {
        let point = [current.tolerance, current.length_to_size()];
        let [least, most] = TOLERANCE_RANGE;
        let stride = [current.tolerance / STRIDE, current.tolerance * STRIDE];
        let tolerance = next_tolerance(ratio * MARGIN, point, previous).clamp(stride[0], stride[1]).clamp(least, most);
        if (current.length_to_size() >= ratio && current.length_to_size() < ratio * (1.0 + NEAR_ENOUGH))
            || tolerance == current.tolerance
        {
            break;
        }
        previous = Some(point);
        let next_objective = Objective { tolerance, goal: Goal::Longest, ..*objective };
        let next = if free {
            let extrapolated = kind.proportions_at_tolerance(&current.proportions, [current.tolerance, tolerance]);
            let a = prefer_symmetric(&next_objective, refine_near(&next_objective, &extrapolated, samplers), samplers);
            let b = next_objective.evaluate(&current.proportions, &samplers.fine);
            if a.0 <= b.0 { a } else { b }
        } else {
            next_objective.evaluate(&current.proportions, &samplers.fine)
        };
        let (value, Some(trial)) = next else { break };
        if value >= UNMET_PENALTY {
            break;
        }
        if trial.length_to_size() >= ratio && best.as_ref().is_none_or(|best| trial.tolerance < best.tolerance) {
            best = Some(trial.clone());
        }
        current = trial;
    }
    best
}

//! The search: a sweep over the free proportions, and from the best places on by simplex.

use rayon::prelude::*;

use super::requirements::TOLERANCE_RANGE;
use super::simplex::{self, Options};
use super::trial::{Goal, Objective, Trial, UNMET_PENALTY, next_tolerance, proportion_distance};
use coupler_curves::motion::{Sampler, Sampling};

/// The samplers of a search.
pub(super) struct Samplers {
    /// Of the sweep.
    pub coarse: Sampler,
    /// Of what is shown.
    pub fine: Sampler,
}

/// Linkages whose proportions are no further apart are much alike.
const MIN_DISTANCE: f64 = 0.12;

/// The samples a found linkage is measured by.
pub(super) const FINE_SAMPLES: usize = 360;

impl Default for Samplers {
    fn default() -> Samplers {
        const COARSE: usize = 90;
        let sampler = |samples| Sampler::new(Sampling::Samples(samples));
        Samplers { coarse: sampler(COARSE), fine: sampler(FINE_SAMPLES) }
    }
}

/// The best linkages of a kind, the best first, each of another region of proportions; none where nothing meets the
/// wishes.
pub(super) fn best_trials(question: &Objective, samplers: &Samplers) -> Vec<Trial> {
    /// What meets the wishes only just may be missed by a sweep, and found from what meets them with more to spare.
    const LOOSER: [f64; 2] = [2.0, 5.0];
    let found = sweep_and_refine(question, samplers);
    if !found.is_empty() {
        return found;
    }
    let looser =
        LOOSER.into_iter().map(|part| question.tolerance * part).filter(|tolerance| *tolerance <= TOLERANCE_RANGE[1]);
    let mut found = looser.map(|tolerance| {
        let near = sweep_and_refine(&Objective { tolerance, ..*question }, samplers);
        let refined = near.iter().map(|trial| refine(question, &trial.proportions, samplers)).collect();
        rank_trials(refined)
    });
    found.find(|found| !found.is_empty()).unwrap_or_default()
}

/// What has been refined and meets the wishes, the best first.
fn rank_trials(refined: Vec<(f64, Option<Trial>)>) -> Vec<Trial> {
    let mut found: Vec<(f64, Trial)> = refined
        .into_iter()
        .filter_map(|(value, trial)| Some((value, trial?)))
        .filter(|(v, _)| *v < UNMET_PENALTY)
        .collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    distinct_trials(found.into_iter().map(|(_, trial)| trial).collect())
}

/// The best linkages of a kind from the best places of a sweep on.
fn sweep_and_refine(question: &Objective, samplers: &Samplers) -> Vec<Trial> {
    /// Places the refinement begins with.
    const STARTS: usize = 5;
    let fixed = fixed_p(question);
    let grid = start_grid(question, fixed);
    let swept: Vec<f64> = grid.par_iter().map(|of| question.evaluate(of, &samplers.coarse).0).collect();
    let mut order: Vec<usize> = (0..grid.len()).collect();
    order.sort_by(|&a, &b| swept[a].total_cmp(&swept[b]));
    let mut starts: Vec<&[f64]> = Vec::new();
    for k in order {
        if starts.len() < STARTS && starts.iter().all(|other| proportion_distance(other, &grid[k]) > MIN_DISTANCE) {
            starts.push(&grid[k]);
        }
    }
    // The closed condition is a start too: what is found is never worse.
    let closed = fixed.map(|p| question.driven_linkage.kind.closed_proportions(p)).unwrap_or_default();
    let ask = |of: &Vec<f64>| question.evaluate(of, &samplers.fine).0;
    let closed = closed.iter().min_by(|a, b| ask(a).total_cmp(&ask(b)));
    starts.extend(closed.map(Vec::as_slice));
    rank_trials(starts.par_iter().map(|of| refine(question, of, samplers)).collect())
}

/// The first of those that are much alike.
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

/// The `p` a search keeps to.
fn fixed_p(question: &Objective) -> Option<f64> {
    question.requirements.p.filter(|_| !matches!(question.goal, Goal::Frame { .. }))
}

/// Every combination of the first values, the last proportion fastest.
fn start_grid(question: &Objective, fixed: Option<f64>) -> Vec<Vec<f64>> {
    let mut grid: Vec<Vec<f64>> = vec![Vec::new()];
    for (axis, free) in question.driven_linkage.kind.free_proportions(question.tolerance).iter().enumerate() {
        let values = fixed.filter(|_| axis == 0).map_or(free.start_values.clone(), |p| vec![p]);
        let longer = |of: Vec<f64>| values.iter().map(move |&value| [of.as_slice(), &[value]].concat());
        grid = grid.into_iter().flat_map(longer).collect();
    }
    grid
}

/// The best near a start: by the sweep's samples first, then by those of the result.
fn refine(question: &Objective, start: &[f64], samplers: &Samplers) -> (f64, Option<Trial>) {
    const ROUGH: Options = Options { initial_step: 1.0, max_evaluations: 100 };
    let rough = minimize_from(question, start, &samplers.coarse, ROUGH);
    let found = refine_near(question, rough.1.as_ref().map_or(start, |trial| &trial.proportions), samplers);
    prefer_symmetric(question, found, samplers)
}

/// What was found, or the symmetric linkage next to it where that is as good but for what nobody would notice.
fn prefer_symmetric(question: &Objective, found: (f64, Option<Trial>), samplers: &Samplers) -> (f64, Option<Trial>) {
    const UNNOTICED: f64 = 0.003;
    let kind = question.driven_linkage.kind;
    let Some(of) = found.1.as_ref().and_then(|trial| kind.symmetric_proportions(&trial.proportions)) else {
        return found;
    };
    let even = question.evaluate(&of, &samplers.fine);
    if even.1.is_some() && even.0 <= found.0 + UNNOTICED * found.0.abs() { even } else { found }
}

/// The best very near a start.
fn refine_near(question: &Objective, start: &[f64], samplers: &Samplers) -> (f64, Option<Trial>) {
    const CLOSE: Options = Options { initial_step: 0.3, max_evaluations: 50 };
    minimize_from(question, start, &samplers.fine, CLOSE)
}

fn minimize_from(question: &Objective, start: &[f64], sampler: &Sampler, effort: Options) -> (f64, Option<Trial>) {
    use coupler_curves::geometry::trig::{exp, ln};
    let free = question.driven_linkage.kind.free_proportions(question.tolerance);
    let held = usize::from(fixed_p(question).is_some());
    let place: Vec<f64> = (held..start.len()).map(|k| ln(start[k]) / free[k].relative_step).collect();
    let of = |place: &[f64]| -> Vec<f64> {
        let moved = place.iter().zip(&free[held..]).map(|(x, free)| exp(x * free.relative_step));
        start[..held].iter().copied().chain(moved).collect()
    };
    let (_, value, trial) = simplex::minimize(&place, effort, |place| question.evaluate(&of(place), sampler));
    // The start itself has not been through the logarithms.
    let own = question.evaluate(start, sampler);
    if own.0 <= value { own } else { (value, trial) }
}

/// From a trial on, the linkage whose straight portion is a given part of its size at the least tolerance, or one that
/// comes as near as `free` proportions let it; `None` where no tolerance is wide enough.
pub(super) fn straightest_at_ratio(
    question: &Objective,
    from: &Trial,
    part: f64,
    free: bool,
    samplers: &Samplers,
) -> Option<Trial> {
    const ROUNDS: usize = 8;
    /// Further than this at once the best proportions cannot be followed.
    const STRIDE: f64 = 30.0;
    /// What is found is so little inside of what is wanted.
    const INSIDE: f64 = 1.0 + 1e-6;
    const NEAR_ENOUGH: f64 = 1e-4;
    let kind = question.driven_linkage.kind;
    let mut best = (from.length_to_size() >= part).then(|| from.clone());
    let mut last: Option<[f64; 2]> = None;
    let mut current = from.clone();
    for _ in 0..ROUNDS {
        let here = [current.tolerance, current.length_to_size()];
        let [least, most] = TOLERANCE_RANGE;
        let stride = [current.tolerance / STRIDE, current.tolerance * STRIDE];
        let wanted = next_tolerance(part * INSIDE, here, last).clamp(stride[0], stride[1]).clamp(least, most);
        if (current.length_to_size() >= part && current.length_to_size() < part * (1.0 + NEAR_ENOUGH))
            || wanted == current.tolerance
        {
            break;
        }
        last = Some(here);
        let again = Objective { tolerance: wanted, goal: Goal::Longest, ..*question };
        let next = if free {
            let carried = kind.proportions_at_tolerance(&current.proportions, [current.tolerance, wanted]);
            let a = prefer_symmetric(&again, refine_near(&again, &carried, samplers), samplers);
            let b = again.evaluate(&current.proportions, &samplers.fine);
            if a.0 <= b.0 { a } else { b }
        } else {
            again.evaluate(&current.proportions, &samplers.fine)
        };
        let (value, Some(trial)) = next else { break };
        if value >= UNMET_PENALTY {
            break;
        }
        if trial.length_to_size() >= part && best.as_ref().is_none_or(|best| trial.tolerance < best.tolerance) {
            best = Some(trial.clone());
        }
        current = trial;
    }
    best
}

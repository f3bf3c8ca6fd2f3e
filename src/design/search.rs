//! The search: a sweep over the free proportions, and from the best places on by simplex.

use rayon::prelude::*;

use super::simplex::{self, Effort};
use super::trial::{Goal, Question, Trial, UNMET, apart, next_tolerance};
use super::wishes::TOLERANCES;
use coupler_curves::motion::{Sampler, Sampling};

/// The samplers of a search.
pub(super) struct Samplers {
    /// Of the sweep.
    pub coarse: Sampler,
    /// Of what is shown.
    pub fine: Sampler,
}

/// Linkages whose proportions are no further apart are much alike.
const APART: f64 = 0.12;

/// The samples a found linkage is measured by.
pub(super) const SAMPLES: usize = 360;

impl Default for Samplers {
    fn default() -> Samplers {
        const COARSE: usize = 90;
        let sampler = |samples| Sampler::new(Sampling::Samples(samples));
        Samplers { coarse: sampler(COARSE), fine: sampler(SAMPLES) }
    }
}

/// The best linkages of a kind, the best first, each of another region of proportions; none where nothing meets the
/// wishes.
pub(super) fn search(question: &Question, samplers: &Samplers) -> Vec<Trial> {
    /// What meets the wishes only just may be missed by a sweep, and found from what meets them with more to spare.
    const LOOSER: [f64; 2] = [2.0, 5.0];
    let found = swept(question, samplers);
    if !found.is_empty() {
        return found;
    }
    let looser =
        LOOSER.into_iter().map(|part| question.tolerance * part).filter(|tolerance| *tolerance <= TOLERANCES[1]);
    let mut found = looser.map(|tolerance| {
        let near = swept(&Question { tolerance, ..*question }, samplers);
        let refined = near.iter().map(|trial| refine(question, &trial.of, samplers)).collect();
        ranked(refined)
    });
    found.find(|found| !found.is_empty()).unwrap_or_default()
}

/// What has been refined and meets the wishes, the best first.
fn ranked(refined: Vec<(f64, Option<Trial>)>) -> Vec<Trial> {
    let mut found: Vec<(f64, Trial)> =
        refined.into_iter().filter_map(|(value, trial)| Some((value, trial?))).filter(|(v, _)| *v < UNMET).collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    distinct(found.into_iter().map(|(_, trial)| trial).collect())
}

/// The best linkages of a kind from the best places of a sweep on.
fn swept(question: &Question, samplers: &Samplers) -> Vec<Trial> {
    /// Places the refinement begins with.
    const STARTS: usize = 5;
    let fixed = fixed_p(question);
    let grid = grid(question, fixed);
    let swept: Vec<f64> = grid.par_iter().map(|of| question.ask(of, &samplers.coarse).0).collect();
    let mut order: Vec<usize> = (0..grid.len()).collect();
    order.sort_by(|&a, &b| swept[a].total_cmp(&swept[b]));
    let mut starts: Vec<&[f64]> = Vec::new();
    for k in order {
        if starts.len() < STARTS && starts.iter().all(|other| apart(other, &grid[k]) > APART) {
            starts.push(&grid[k]);
        }
    }
    // The closed condition is a start too: what is found is never worse.
    let closed = fixed.map(|p| question.arrangement.kind.closed(p)).unwrap_or_default();
    let ask = |of: &Vec<f64>| question.ask(of, &samplers.fine).0;
    let closed = closed.iter().min_by(|a, b| ask(a).total_cmp(&ask(b)));
    starts.extend(closed.map(Vec::as_slice));
    ranked(starts.par_iter().map(|of| refine(question, of, samplers)).collect())
}

/// The first of those that are much alike.
pub(super) fn distinct(trials: Vec<Trial>) -> Vec<Trial> {
    let mut distinct: Vec<Trial> = Vec::new();
    for trial in trials {
        if distinct.iter().all(|other| apart(&other.of, &trial.of) > APART / 2.0) {
            distinct.push(trial);
        }
    }
    distinct
}

/// The `p` a search keeps to.
fn fixed_p(question: &Question) -> Option<f64> {
    question.wishes.p.filter(|_| !matches!(question.goal, Goal::Frame { .. }))
}

/// Every combination of the first values, the last proportion fastest.
fn grid(question: &Question, fixed: Option<f64>) -> Vec<Vec<f64>> {
    let mut grid: Vec<Vec<f64>> = vec![Vec::new()];
    for (axis, free) in question.arrangement.kind.proportions(question.tolerance).iter().enumerate() {
        let values = fixed.filter(|_| axis == 0).map_or(free.values.clone(), |p| vec![p]);
        let longer = |of: Vec<f64>| values.iter().map(move |&value| [of.as_slice(), &[value]].concat());
        grid = grid.into_iter().flat_map(longer).collect();
    }
    grid
}

/// The best near a start: by the sweep's samples first, then by those of the result.
fn refine(question: &Question, start: &[f64], samplers: &Samplers) -> (f64, Option<Trial>) {
    const ROUGH: Effort = Effort { reach: 1.0, evaluations: 100 };
    let rough = descend(question, start, &samplers.coarse, ROUGH);
    let found = near(question, rough.1.as_ref().map_or(start, |trial| &trial.of), samplers);
    symmetric(question, found, samplers)
}

/// What was found, or the symmetric linkage next to it where that is as good but for what nobody would notice.
fn symmetric(question: &Question, found: (f64, Option<Trial>), samplers: &Samplers) -> (f64, Option<Trial>) {
    const UNNOTICED: f64 = 0.003;
    let kind = question.arrangement.kind;
    let Some(of) = found.1.as_ref().and_then(|trial| kind.symmetric(&trial.of)) else { return found };
    let even = question.ask(&of, &samplers.fine);
    if even.1.is_some() && even.0 <= found.0 + UNNOTICED * found.0.abs() { even } else { found }
}

/// The best very near a start.
fn near(question: &Question, start: &[f64], samplers: &Samplers) -> (f64, Option<Trial>) {
    const CLOSE: Effort = Effort { reach: 0.3, evaluations: 50 };
    descend(question, start, &samplers.fine, CLOSE)
}

fn descend(question: &Question, start: &[f64], sampler: &Sampler, effort: Effort) -> (f64, Option<Trial>) {
    use coupler_curves::geometry::trig::{exp, ln};
    let free = question.arrangement.kind.proportions(question.tolerance);
    let held = usize::from(fixed_p(question).is_some());
    let place: Vec<f64> = (held..start.len()).map(|k| ln(start[k]) / free[k].step).collect();
    let of = |place: &[f64]| -> Vec<f64> {
        let moved = place.iter().zip(&free[held..]).map(|(x, free)| exp(x * free.step));
        start[..held].iter().copied().chain(moved).collect()
    };
    let (_, value, trial) = simplex::least(&place, effort, |place| question.ask(&of(place), sampler));
    // The start itself has not been through the logarithms.
    let own = question.ask(start, sampler);
    if own.0 <= value { own } else { (value, trial) }
}

/// From a trial on, the linkage whose straight portion is a given part of its size at the least tolerance, or one that
/// comes as near as `free` proportions let it; `None` where no tolerance is wide enough.
pub(super) fn straightest(
    question: &Question,
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
    let kind = question.arrangement.kind;
    let mut best = (from.part() >= part).then(|| from.clone());
    let mut last: Option<[f64; 2]> = None;
    let mut current = from.clone();
    for _ in 0..ROUNDS {
        let here = [current.tolerance, current.part()];
        let [least, most] = TOLERANCES;
        let stride = [current.tolerance / STRIDE, current.tolerance * STRIDE];
        let wanted = next_tolerance(part * INSIDE, here, last).clamp(stride[0], stride[1]).clamp(least, most);
        if (current.part() >= part && current.part() < part * (1.0 + NEAR_ENOUGH)) || wanted == current.tolerance {
            break;
        }
        last = Some(here);
        let again = Question { tolerance: wanted, goal: Goal::Longest, ..*question };
        let next = if free {
            let carried = kind.carried(&current.of, [current.tolerance, wanted]);
            let a = symmetric(&again, near(&again, &carried, samplers), samplers);
            let b = again.ask(&current.of, &samplers.fine);
            if a.0 <= b.0 { a } else { b }
        } else {
            again.ask(&current.of, &samplers.fine)
        };
        let (value, Some(trial)) = next else { break };
        if value >= UNMET {
            break;
        }
        if trial.part() >= part && best.as_ref().is_none_or(|best| trial.tolerance < best.tolerance) {
            best = Some(trial.clone());
        }
        current = trial;
    }
    best
}

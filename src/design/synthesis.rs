//! The search for the linkages that meet requirements.

use std::sync::Arc;

use rayon::prelude::*;

use super::kind::{DrivenLinkage, Driver, LinkageKind};
use super::requirements::Requirements;
use super::result::{RejectedLinkage, SynthesisResult};
use super::rounding::round_to_four_digits;
use super::scaled_design::{Design, ProportionOrigin};
use super::search::{self, Samplers};
use super::trial::{self, Goal, Objective, Trial};
use coupler_curves::template::Template;

/// Finds the linkages that meet the requirements, and those that meet all but the length within the size.
pub(super) fn synthesize_all(requirements: &Requirements, samplers: &Samplers) -> (SynthesisResult, Vec<Trial>) {
    let mut found = SynthesisResult { rejected: rejected_by_type(requirements), ..SynthesisResult::default() };
    let mut short: Vec<Trial> = Vec::new();
    let mut kept: Vec<(ProportionOrigin, Trial)> = Vec::new();
    let candidates: Vec<Candidates> = feasible_linkages(requirements)
        .collect::<Vec<_>>()
        .par_iter()
        .filter_map(|driven_linkage| find_candidates(*driven_linkage, requirements, samplers))
        .collect();
    for candidates in candidates {
        found.rejected.extend(candidates.rejected);
        kept.extend(candidates.accepted);
        short.extend(candidates.too_short);
    }
    let (kept, duplicates) = remove_duplicates(kept);
    found.rejected.extend(duplicates);
    let kept = select_best(kept, requirements);
    found.designs =
        kept.iter().filter_map(|(origin, trial)| Design::from_trial(*origin, trial, requirements)).collect();
    (found, short)
}

/// The results for one linkage and driver.
#[derive(Default)]
struct Candidates {
    accepted: Vec<(ProportionOrigin, Trial)>,
    /// The linkages that meet every requirement, the length within the size left aside.
    too_short: Vec<Trial>,
    rejected: Vec<RejectedLinkage>,
}

/// The linkages and drivers that can meet the requirements at all.
pub(super) fn feasible_linkages(requirements: &Requirements) -> impl Iterator<Item = DrivenLinkage> + '_ {
    requirements.driven_linkages().filter(|driven_linkage| infeasibility(*driven_linkage, requirements).is_none())
}

/// Why a linkage and driver cannot meet the requirements, whatever the proportions.
fn infeasibility(driven_linkage: DrivenLinkage, requirements: &Requirements) -> Option<&'static str> {
    match (driven_linkage.kind, driven_linkage.input) {
        (_, Driver::Rocker) if requirements.quick_return => {
            Some("a rocker has no quick return: it retraces its motion")
        }
        (LinkageKind::Chebyshev, Driver::Motor) if requirements.mu_min > 0.0 => Some(
            "its rockers reach limits in each turn of the coupler, where the transmission angle is 0; Evans's linkage \
             traces the same curves at twice the size, driven by a crank",
        ),
        _ => None,
    }
}

/// The linkages that type synthesis rejects.
fn rejected_by_type(requirements: &Requirements) -> Vec<RejectedLinkage> {
    let rejection_reason = |driven_linkage: DrivenLinkage| -> Option<String> {
        if !requirements.kinds.contains(&driven_linkage.kind) {
            return None;
        }
        let reason = match requirements.input {
            Some(Driver::Motor)
                if driven_linkage.input == Driver::Rocker && driven_linkage.kind != LinkageKind::Chebyshev =>
            {
                Some("no link that could be driven turns fully (Natesan 4.3, 4.4)")
            }
            Some(Driver::Rocker)
                if driven_linkage.input == Driver::Motor && driven_linkage.kind != LinkageKind::Chebyshev =>
            {
                Some("it is driven by a crank that turns fully (Natesan 4.1)")
            }
            Some(input) if driven_linkage.input != input => None,
            _ => infeasibility(driven_linkage, requirements),
        };
        reason.map(str::to_owned)
    };
    let rejected = |driven_linkage| {
        Some(RejectedLinkage { driven_linkage, is_closed_form: false, reason: rejection_reason(driven_linkage)? })
    };
    DrivenLinkage::ALL.into_iter().filter_map(rejected).collect()
}

/// The objective of a search over the proportions of a linkage.
pub(super) fn new_objective<'a>(
    driven_linkage: DrivenLinkage,
    template: &'a Arc<Template>,
    requirements: &'a Requirements,
    goal: Goal,
) -> Objective<'a> {
    Objective { driven_linkage, template, requirements, tolerance: requirements.tolerance, goal }
}

/// Searches the proportions of a linkage, and evaluates its closed condition; `None` if the catalogue lacks it.
fn find_candidates(
    driven_linkage: DrivenLinkage,
    requirements: &Requirements,
    samplers: &Samplers,
) -> Option<Candidates> {
    let template = driven_linkage.kind.template()?;
    let objective = new_objective(driven_linkage, &template, requirements, Goal::Longest);
    let mut found = Candidates::default();
    let trials = search::best_trials(&objective, samplers);
    let rejected = |is_closed_form, reason: String| RejectedLinkage { driven_linkage, is_closed_form, reason };
    if trials.is_empty() {
        found.rejected.push(rejected(false, "none of the proportions tried meet the requirements".to_owned()));
    }
    found.too_short = trials.clone();
    let fits = |trial: &Trial| requirements.length_to_size().is_none_or(|ratio| trial.length_to_size() >= ratio);
    let straightest = |trial: &Trial, free: bool| match requirements.length_to_size() {
        Some(ratio) => search::straightest_at_ratio(&objective, trial, ratio, free, samplers),
        None => Some(trial.clone()),
    };
    let closed_form = closed_form_trial(&objective, samplers);
    match &closed_form {
        Some(Ok(trial)) if fits(trial) => {
            found.accepted.extend(straightest(trial, false).map(|trial| (ProportionOrigin::ClosedCondition, trial)));
        }
        Some(Ok(trial)) => found.rejected.push(rejected(true, too_short_reason(trial, requirements))),
        Some(Err(reason)) => found.rejected.push(rejected(true, reason.clone())),
        None => {}
    }
    let fitting = trials.par_iter().filter(|trial| fits(trial)).filter_map(|trial| straightest(trial, true));
    let mut fitting: Vec<Trial> = fitting.collect();
    fitting.sort_by(|a, b| a.tolerance.total_cmp(&b.tolerance));
    if let (true, Some(longest)) = (fitting.is_empty(), trials.first()) {
        found.rejected.push(rejected(false, too_short_reason(longest, requirements)));
    }
    // If the search returned to the closed condition, only the latter is kept.
    let is_closed_form = |trial: &Trial| found.accepted.iter().any(|(_, closed_form)| *closed_form == *trial);
    let searched: Vec<Trial> = fitting.into_iter().filter(|trial| !is_closed_form(trial)).collect();
    found.accepted.extend(search::distinct_trials(searched).into_iter().map(|trial| (ProportionOrigin::Search, trial)));
    Some(found)
}

/// Why a trial is rejected whose straight portion is too short for the size.
fn too_short_reason(trial: &Trial, requirements: &Requirements) -> String {
    let longest = trial.length_to_size() * requirements.size.unwrap_or(1.0);
    format!("within this size the length of its straight portion is at most {}", round_to_four_digits(longest, false))
}

/// The best linkage by the closed condition for the required `p`, or why it does not meet the requirements; `None` if
/// no `p` is required, or the linkage has no closed condition for it.
fn closed_form_trial(objective: &Objective, samplers: &Samplers) -> Option<Result<Trial, String>> {
    let all = objective.driven_linkage.kind.closed_proportions(objective.requirements.p?);
    let evaluated = all.iter().map(|proportions| objective.evaluate(proportions, &samplers.fine));
    let (value, trial) = evaluated.min_by(|a, b| a.0.total_cmp(&b.0))?;
    if let (true, Some(trial)) = (value < trial::UNMET_PENALTY, trial) {
        return Some(Ok(trial));
    }
    // Evaluate again without the requirements, to find which of them is not met.
    let line_only =
        Requirements { mu_min: 0.0, double_point: None, quick_return: false, ..objective.requirements.clone() };
    let plain = Objective { requirements: &line_only, ..*objective };
    let best = all.iter().filter_map(|proportions| plain.evaluate(proportions, &samplers.fine).1).next();
    Some(Err(match best {
        None => "the closed condition gives no such linkage".to_owned(),
        Some(trial) if trial.performance.mu_min < objective.requirements.mu_min => {
            format!("its transmission angle is as low as {}°", round_to_four_digits(trial.performance.mu_min, false))
        }
        Some(_) => "it does not meet the requirement for the return or the double point".to_owned(),
    }))
}

/// Hoeken's linkage is Evans's with `s = a` and `k = 2`: if both results are the same linkage, only the better is kept.
fn remove_duplicates(all: Vec<(ProportionOrigin, Trial)>) -> (Vec<(ProportionOrigin, Trial)>, Vec<RejectedLinkage>) {
    const MAX_DISTANCE: f64 = 0.02;
    let as_evans = |trial: &Trial| match trial.driven_linkage.kind {
        LinkageKind::Evans => Some(trial.proportions.clone()),
        LinkageKind::Hoeken => Some([trial.proportions.as_slice(), &[2.0]].concat()),
        _ => None,
    };
    let are_duplicates = |a: &(ProportionOrigin, Trial), b: &(ProportionOrigin, Trial)| {
        let is_other = a.0 == b.0 && a.1.driven_linkage != b.1.driven_linkage;
        is_other
            && as_evans(&a.1)
                .zip(as_evans(&b.1))
                .is_some_and(|(a, b)| trial::proportion_distance(&a, &b) < MAX_DISTANCE)
    };
    let is_better = |a: &Trial, b: &Trial| {
        let order = a.tolerance.total_cmp(&b.tolerance).then(b.length_to_size().total_cmp(&a.length_to_size()));
        order.then(a.driven_linkage.cmp(&b.driven_linkage)).is_lt()
    };
    let mut rejected = Vec::new();
    let mut kept = Vec::new();
    for one in &all {
        match all.iter().find(|other| are_duplicates(one, other) && is_better(&other.1, &one.1)) {
            None => kept.push(one.clone()),
            Some((origin, better)) => rejected.push(RejectedLinkage {
                driven_linkage: one.1.driven_linkage,
                is_closed_form: *origin == ProportionOrigin::ClosedCondition,
                reason: format!("it is the same linkage as {}: s = a and k = 2", better.driven_linkage.kind.id()),
            }),
        }
    }
    (kept, rejected)
}

/// Selects the required number of designs: the best of each linkage and driver before the second of any. The linkages
/// of the closed conditions are added for those selected. The result is sorted, the best first.
fn select_best(mut all: Vec<(ProportionOrigin, Trial)>, requirements: &Requirements) -> Vec<(ProportionOrigin, Trial)> {
    // Of equally straight linkages the smaller is better.
    let merit = |trial: &Trial| {
        [if requirements.length_to_size().is_some() { trial.tolerance } else { 0.0 }, -trial.length_to_size()]
    };
    let order = |a: &(ProportionOrigin, Trial), b: &(ProportionOrigin, Trial)| {
        let ([a, smaller_a], [b, smaller_b]) = (merit(&a.1), merit(&b.1));
        a.total_cmp(&b).then(smaller_a.total_cmp(&smaller_b))
    };
    all.sort_by(order);
    let by_search =
        |driven_linkage| all.iter().any(|(o, t)| *o == ProportionOrigin::Search && t.driven_linkage == driven_linkage);
    // If no search found another linkage, that of the closed condition counts as found.
    let (closed_form, found): (Vec<_>, Vec<_>) = all
        .iter()
        .cloned()
        .partition(|(origin, trial)| *origin == ProportionOrigin::ClosedCondition && by_search(trial.driven_linkage));
    let (mut firsts, mut rest) = (Vec::new(), Vec::new());
    for one in found {
        let is_first =
            firsts.iter().all(|(_, first): &(ProportionOrigin, Trial)| first.driven_linkage != one.1.driven_linkage);
        if is_first { firsts.push(one) } else { rest.push(one) }
    }
    firsts.extend(rest);
    firsts.truncate(requirements.max_designs);
    let is_shown = |trial: &Trial| firsts.iter().any(|(_, shown)| shown.driven_linkage == trial.driven_linkage);
    let closed_form: Vec<_> = closed_form.into_iter().filter(|(_, trial)| is_shown(trial)).collect();
    firsts.extend(closed_form);
    firsts.sort_by(order);
    firsts
}

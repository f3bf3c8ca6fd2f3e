//! Chapter 10 of the thesis: from what a designer wishes to linkages with a straight line.
//!
//! *Type synthesis* (10.1.1) asks what moves the linkage. A motor wants a link that turns fully: the crank of Evans's and of
//! Hoeken's linkage, or the coupler of Chebyshev's; a rocker moves Watt's, Roberts's and Chebyshev's. *Dimensional
//! synthesis* (10.1.2) finds the proportions: not by the closed condition only, (8.10) or (8.19), but by a sweep over all
//! that is free, and from its best places on by simplex. Every number is measured as `cells.csv` has it.
//!
//! What is best depends on what is given. Of a straight length, or of a size, or of neither: the longest straight portion
//! for the size at the tolerance. Of both: the straightest linkage that has that length within that size. Where a motor
//! drives, size and transmission angle are those of the whole turn; where a rocker does, of the straight stroke, which is all
//! that the linkage need go through.

mod extent;
mod kind;
mod relaxation;
mod requirements;
mod scaled_design;
mod search;
mod simplex;
mod stroke;
mod trial;

pub use kind::{DrivenLinkage, Driver, LinkageKind};
pub use relaxation::Relaxation;
pub use requirements::{P_RANGE, Requirement, Requirements, TOLERANCE_RANGE};
pub use scaled_design::{Design, ProportionOrigin};
pub use stroke::InputLink;
pub use trial::Performance;

use std::sync::Arc;

use rayon::prelude::*;

use coupler_curves::template::Template;
use search::Samplers;
use trial::{Goal, Objective, Trial};

/// What a design has come to.
#[derive(Clone, Debug, Default)]
pub struct SynthesisResult {
    /// The linkages that meet the wishes, the best first.
    pub designs: Vec<Design>,
    /// What is left out, and why.
    pub rejected: Vec<RejectedLinkage>,
    /// Where nothing meets the wishes: for each of them, what it would have to be, all others kept.
    pub relaxations: Vec<Relaxation>,
}

/// A linkage that is not among what was found, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct RejectedLinkage {
    /// The linkage and what would move it.
    pub driven_linkage: DrivenLinkage,
    /// Whether it is the one by the closed condition.
    pub is_closed_form: bool,
    /// Why.
    pub reason: String,
}

/// The linkages with a straight line that meet some wishes; their [`Requirements::errors`] are to be none.
///
/// The result does not depend on the number of threads.
pub fn straight_line(wishes: &Requirements) -> SynthesisResult {
    let samplers = Samplers::default();
    let (mut found, short) = synthesize_all(wishes, &samplers);
    if found.designs.is_empty() {
        found.relaxations = relaxation::find_relaxations(wishes, &short, &samplers);
    }
    found
}

/// What meets the wishes, and what meets all of them but the length within the size.
fn synthesize_all(wishes: &Requirements, samplers: &Samplers) -> (SynthesisResult, Vec<Trial>) {
    let mut found = SynthesisResult { rejected: rejected_by_type(wishes), ..SynthesisResult::default() };
    let mut short: Vec<Trial> = Vec::new();
    let mut kept: Vec<(ProportionOrigin, Trial)> = Vec::new();
    let candidates: Vec<Candidates> = feasible_linkages(wishes)
        .collect::<Vec<_>>()
        .par_iter()
        .filter_map(|arrangement| find_candidates(*arrangement, wishes, samplers))
        .collect();
    for of_kind in candidates {
        found.rejected.extend(of_kind.rejected);
        kept.extend(of_kind.accepted);
        short.extend(of_kind.too_short);
    }
    let (kept, twins) = remove_duplicates(kept);
    found.rejected.extend(twins);
    let kept = select_best(kept, wishes);
    found.designs =
        kept.iter().filter_map(|(origin, trial)| Design::from_trial(*origin, trial, wishes, &samplers.fine)).collect();
    (found, short)
}

/// What a search has found of an arrangement.
#[derive(Default)]
struct Candidates {
    accepted: Vec<(ProportionOrigin, Trial)>,
    /// What meets every wish but the length within the size.
    too_short: Vec<Trial>,
    rejected: Vec<RejectedLinkage>,
}

/// The arrangements that can meet the wishes at all.
fn feasible_linkages(wishes: &Requirements) -> impl Iterator<Item = DrivenLinkage> + '_ {
    wishes.driven_linkages().filter(|arrangement| infeasibility(*arrangement, wishes).is_none())
}

/// Why an arrangement can meet none of the wishes whatever its proportions.
fn infeasibility(arrangement: DrivenLinkage, wishes: &Requirements) -> Option<&'static str> {
    match (arrangement.kind, arrangement.input) {
        (_, Driver::Rocker) if wishes.quick_return => Some("a rocker goes back as it came, no quicker"),
        (LinkageKind::Chebyshev, Driver::Motor) if wishes.mu_min > 0.0 => Some(
            "its rockers have limits in each turn of the coupler, where the transmission angle is 0; Evans's linkage traces \
             the same curves at twice the size by a crank",
        ),
        _ => None,
    }
}

/// What type synthesis leaves out.
fn rejected_by_type(wishes: &Requirements) -> Vec<RejectedLinkage> {
    let why = |arrangement: DrivenLinkage| -> Option<String> {
        if !wishes.kinds.contains(&arrangement.kind) {
            return None;
        }
        let wanted = match wishes.input {
            Some(Driver::Motor)
                if arrangement.input == Driver::Rocker && arrangement.kind != LinkageKind::Chebyshev =>
            {
                Some("no link that could be driven turns fully (Natesan 4.3, 4.4)")
            }
            Some(Driver::Rocker)
                if arrangement.input == Driver::Motor && arrangement.kind != LinkageKind::Chebyshev =>
            {
                Some("it is driven by a crank that turns fully (Natesan 4.1)")
            }
            Some(input) if arrangement.input != input => None,
            _ => infeasibility(arrangement, wishes),
        };
        wanted.map(str::to_owned)
    };
    let left_out = |arrangement| {
        Some(RejectedLinkage { driven_linkage: arrangement, is_closed_form: false, reason: why(arrangement)? })
    };
    DrivenLinkage::ALL.into_iter().filter_map(left_out).collect()
}

/// The question what is the longest straight portion of an arrangement.
fn objective<'a>(
    arrangement: DrivenLinkage,
    template: &'a Arc<Template>,
    wishes: &'a Requirements,
    goal: Goal,
) -> Objective<'a> {
    Objective { driven_linkage: arrangement, template, requirements: wishes, tolerance: wishes.tolerance, goal }
}

fn find_candidates(arrangement: DrivenLinkage, wishes: &Requirements, samplers: &Samplers) -> Option<Candidates> {
    let template = arrangement.kind.template()?;
    let question = objective(arrangement, &template, wishes, Goal::Longest);
    let mut found = Candidates::default();
    let trials = search::best_trials(&question, samplers);
    let left_out = |is_closed, why: String| RejectedLinkage {
        driven_linkage: arrangement,
        is_closed_form: is_closed,
        reason: why,
    };
    if trials.is_empty() {
        found.rejected.push(left_out(false, "no proportions that were tried meet the wishes".to_owned()));
    }
    found.too_short = trials.clone();
    let fits = |trial: &Trial| wishes.length_to_size().is_none_or(|part| trial.length_to_size() >= part);
    let straightest = |trial: &Trial, free: bool| match wishes.length_to_size() {
        Some(part) => search::straightest_at_ratio(&question, trial, part, free, samplers),
        None => Some(trial.clone()),
    };
    let closed = closed_form_trial(&question, samplers);
    match &closed {
        Some(Ok(trial)) if fits(trial) => {
            found.accepted.extend(straightest(trial, false).map(|trial| (ProportionOrigin::ClosedCondition, trial)));
        }
        Some(Ok(trial)) => found.rejected.push(left_out(true, too_short_reason(trial, wishes))),
        Some(Err(why)) => found.rejected.push(left_out(true, why.clone())),
        None => {}
    }
    let fitting = trials.par_iter().filter(|trial| fits(trial)).filter_map(|trial| straightest(trial, true));
    let mut fitting: Vec<Trial> = fitting.collect();
    fitting.sort_by(|a, b| a.tolerance.total_cmp(&b.tolerance));
    if let (true, Some(longest)) = (fitting.is_empty(), trials.first()) {
        found.rejected.push(left_out(false, too_short_reason(longest, wishes)));
    }
    // Where the search has come back to the closed condition, that is shown.
    let is_closed = |trial: &Trial| found.accepted.iter().any(|(_, closed)| *closed == *trial);
    let searched: Vec<Trial> = fitting.into_iter().filter(|trial| !is_closed(trial)).collect();
    found.accepted.extend(search::distinct_trials(searched).into_iter().map(|trial| (ProportionOrigin::Search, trial)));
    Some(found)
}

fn too_short_reason(trial: &Trial, wishes: &Requirements) -> String {
    let longest = trial.length_to_size() * wishes.size.unwrap_or(1.0);
    format!(
        "within this size its straight portion is at most {} long",
        relaxation::round_to_four_digits(longest, false)
    )
}

/// The best by the closed condition for the `p` that is wished, or why it does not meet the wishes.
fn closed_form_trial(question: &Objective, samplers: &Samplers) -> Option<Result<Trial, String>> {
    let all = question.driven_linkage.kind.closed_proportions(question.requirements.p?);
    let asked = all.iter().map(|of| question.evaluate(of, &samplers.fine));
    let (value, trial) = asked.min_by(|a, b| a.0.total_cmp(&b.0))?;
    if let (true, Some(trial)) = (value < trial::UNMET_PENALTY, trial) {
        return Some(Ok(trial));
    }
    // Once more, with nothing asked but the line itself, to say what it is that it lacks.
    let asks_nothing =
        Requirements { mu_min: 0.0, double_point: None, quick_return: false, ..question.requirements.clone() };
    let plain = Objective { requirements: &asks_nothing, ..*question };
    let best = all.iter().filter_map(|of| plain.evaluate(of, &samplers.fine).1).next();
    Some(Err(match best {
        None => "it makes no such linkage".to_owned(),
        Some(trial) if trial.performance.mu_min < question.requirements.mu_min => {
            format!(
                "its transmission angle falls to {}°",
                relaxation::round_to_four_digits(trial.performance.mu_min, false)
            )
        }
        Some(_) => "it does not meet the wish for the return or the double point".to_owned(),
    }))
}

/// Hoeken's linkage is Evans's with `s = a` and `k = 2`: where both are found to be one linkage, only the better is kept.
fn remove_duplicates(all: Vec<(ProportionOrigin, Trial)>) -> (Vec<(ProportionOrigin, Trial)>, Vec<RejectedLinkage>) {
    const ONE: f64 = 0.02;
    let as_evans = |trial: &Trial| match trial.driven_linkage.kind {
        LinkageKind::Evans => Some(trial.proportions.clone()),
        LinkageKind::Hoeken => Some([trial.proportions.as_slice(), &[2.0]].concat()),
        _ => None,
    };
    let are_twins = |a: &(ProportionOrigin, Trial), b: &(ProportionOrigin, Trial)| {
        let is_other = a.0 == b.0 && a.1.driven_linkage != b.1.driven_linkage;
        is_other && as_evans(&a.1).zip(as_evans(&b.1)).is_some_and(|(a, b)| trial::proportion_distance(&a, &b) < ONE)
    };
    let is_better = |a: &Trial, b: &Trial| {
        let order = a.tolerance.total_cmp(&b.tolerance).then(b.length_to_size().total_cmp(&a.length_to_size()));
        order.then(a.driven_linkage.cmp(&b.driven_linkage)).is_lt()
    };
    let mut left_out = Vec::new();
    let mut kept = Vec::new();
    for one in &all {
        match all.iter().find(|other| are_twins(one, other) && is_better(&other.1, &one.1)) {
            None => kept.push(one.clone()),
            Some((origin, better)) => left_out.push(RejectedLinkage {
                driven_linkage: one.1.driven_linkage,
                is_closed_form: *origin == ProportionOrigin::ClosedCondition,
                reason: format!("it comes to the same as {}: s = a and k = 2", better.driven_linkage.kind.id()),
            }),
        }
    }
    (kept, left_out)
}

/// As many as are wanted, in order: the best of each arrangement before the second of any. What the closed conditions give
/// for these is shown beside them.
fn select_best(mut all: Vec<(ProportionOrigin, Trial)>, wishes: &Requirements) -> Vec<(ProportionOrigin, Trial)> {
    // Of equally straight ones the smaller.
    let merit = |trial: &Trial| {
        [if wishes.length_to_size().is_some() { trial.tolerance } else { 0.0 }, -trial.length_to_size()]
    };
    let order = |a: &(ProportionOrigin, Trial), b: &(ProportionOrigin, Trial)| {
        let ([a, smaller_a], [b, smaller_b]) = (merit(&a.1), merit(&b.1));
        a.total_cmp(&b).then(smaller_a.total_cmp(&smaller_b))
    };
    all.sort_by(order);
    let by_search =
        |arrangement| all.iter().any(|(o, t)| *o == ProportionOrigin::Search && t.driven_linkage == arrangement);
    // Where no search found another, the closed condition's is what was found.
    let (beside, found): (Vec<_>, Vec<_>) = all
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
    firsts.truncate(wishes.max_designs);
    let is_shown = |trial: &Trial| firsts.iter().any(|(_, shown)| shown.driven_linkage == trial.driven_linkage);
    let beside: Vec<_> = beside.into_iter().filter(|(_, trial)| is_shown(trial)).collect();
    firsts.extend(beside);
    firsts.sort_by(order);
    firsts
}

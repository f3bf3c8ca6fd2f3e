//! Relaxes requirements that cannot be met: finds for each what it would have to be, all others unchanged.

use rayon::prelude::*;

use super::kind::{DrivenLinkage, LinkageKind, P_RANGE};
use super::requirements::{Requirement, Requirements};
use super::result::Relaxation;
use super::rounding::round_to_four_digits;
use super::scaled_design::{Design, ProportionOrigin};
use super::search::{self, Samplers};
use super::synthesis::{feasible_linkages, new_objective, synthesize_all};
use super::trial::{Goal, Trial};

/// The factor by which a relaxed value is looser than the result, so that a search with it finds the linkage again.
const MARGIN: f64 = 1.002;

/// Finds every requirement that could be changed alone. `too_short` are the linkages that meet all but the length
/// within the size.
pub(super) fn find_relaxations(
    requirements: &Requirements,
    too_short: &[Trial],
    samplers: &Samplers,
) -> Vec<Relaxation> {
    let mut found: Vec<Relaxation> = Vec::new();
    found.extend(relax_lengths(requirements, too_short, samplers).into_iter().flatten());
    found.extend(relax_transmission(requirements, samplers));
    found.extend(relax_frame(requirements, samplers));
    found.extend(relax_by_dropping(requirements, samplers));
    found
}

/// The relaxation of a requirement to a value, with the design of a trial.
fn relax_to(requirement: Requirement, value: f64, trial: &Trial, requirements: &Requirements) -> Option<Relaxation> {
    let design = Design::from_trial(ProportionOrigin::Search, trial, requirements)?;
    Some(Relaxation { requirement, value: Some(value), design })
}

/// The least size, the greatest length and the least tolerance that can be met.
fn relax_lengths(requirements: &Requirements, too_short: &[Trial], samplers: &Samplers) -> [Option<Relaxation>; 3] {
    let longest = too_short.iter().max_by(|a, b| a.length_to_size().total_cmp(&b.length_to_size()));
    let (Some(length), Some(size), Some(longest)) = (requirements.length, requirements.size, longest) else {
        return [None, None, None];
    };
    let ratio = length / size;
    let least_size = round_to_four_digits(length / longest.length_to_size() * MARGIN, true);
    let most_length = round_to_four_digits(size * longest.length_to_size() / MARGIN, false);
    let straightest = |trial: &Trial| {
        let template = trial.driven_linkage.kind.template()?;
        let objective = new_objective(trial.driven_linkage, &template, requirements, Goal::Longest);
        search::straightest_at_ratio(&objective, trial, ratio, true, samplers)
    };
    let all: Vec<Trial> = too_short.par_iter().filter_map(straightest).collect();
    let straightest = all.iter().min_by(|a, b| a.tolerance.total_cmp(&b.tolerance));
    let shorter = Requirements { length: Some(most_length), ..requirements.clone() };
    [
        relax_to(Requirement::Size, least_size, longest, requirements),
        relax_to(Requirement::Length, most_length, longest, &shorter),
        straightest.and_then(|trial| {
            relax_to(Requirement::Tolerance, round_to_four_digits(trial.tolerance * MARGIN, true), trial, requirements)
        }),
    ]
}

/// The greatest transmission angle that can be met.
fn relax_transmission(requirements: &Requirements, samplers: &Samplers) -> Option<Relaxation> {
    let goal = Goal::Transmission { min_length_to_size: requirements.length_to_size().unwrap_or(0.0) };
    let any = Requirements { mu_min: 0.0, ..requirements.clone() };
    let best = best_trial(&any, goal, samplers, |trial| -trial.performance.mu_min)?;
    let value = round_to_four_digits(best.performance.mu_min / MARGIN, false);
    (value < requirements.mu_min).then(|| relax_to(Requirement::MuMin, value, &best, requirements)).flatten()
}

/// The nearest `p` that can be met.
fn relax_frame(requirements: &Requirements, samplers: &Samplers) -> Option<Relaxation> {
    let p = requirements.p?;
    let goal = Goal::Frame { p, min_length_to_size: requirements.length_to_size().unwrap_or(0.0) };
    let best =
        best_trial(requirements, goal, samplers, |trial| (trial.proportions[0] / p).max(p / trial.proportions[0]))?;
    let found = best.proportions[0];
    let value = if found > p {
        round_to_four_digits(found * MARGIN, true)
    } else {
        round_to_four_digits(found / MARGIN, false)
    };
    relax_to(Requirement::P, value.clamp(P_RANGE[0], P_RANGE[1]), &best, requirements)
}

/// The best trial of all linkages and drivers for another goal; the one with the least `merit`.
fn best_trial(
    requirements: &Requirements,
    goal: Goal,
    samplers: &Samplers,
    merit: impl Fn(&Trial) -> f64,
) -> Option<Trial> {
    let driven_linkages: Vec<DrivenLinkage> = feasible_linkages(requirements).collect();
    let search = |driven_linkage: &DrivenLinkage| {
        let template = driven_linkage.kind.template()?;
        search::best_trials(&new_objective(*driven_linkage, &template, requirements, goal), samplers).into_iter().next()
    };
    let all: Vec<Trial> = driven_linkages.par_iter().filter_map(search).collect();
    all.into_iter().min_by(|a, b| merit(a).total_cmp(&merit(b)))
}

/// The designs without one of the requirements that have no scale.
fn relax_by_dropping(requirements: &Requirements, samplers: &Samplers) -> Vec<Relaxation> {
    let without = [
        (Requirement::Input, requirements.input.is_some(), Requirements { input: None, ..requirements.clone() }),
        (
            Requirement::DoublePoint,
            requirements.double_point.is_some(),
            Requirements { double_point: None, ..requirements.clone() },
        ),
        (
            Requirement::QuickReturn,
            requirements.quick_return,
            Requirements { quick_return: false, ..requirements.clone() },
        ),
        (
            Requirement::Kinds,
            requirements.kinds.len() < LinkageKind::ALL.len(),
            Requirements { kinds: LinkageKind::ALL.to_vec(), ..requirements.clone() },
        ),
    ];
    let given = without.into_iter().filter(|(_, is_given, _)| *is_given);
    let found = given.filter_map(|(requirement, _, requirements)| {
        let design =
            synthesize_all(&Requirements { max_designs: 1, ..requirements }, samplers).0.designs.into_iter().next()?;
        Some(Relaxation { requirement, value: None, design })
    });
    found.collect()
}

#[cfg(test)]
mod tests {
    use super::round_to_four_digits;

    #[test]
    fn numbers_are_rounded_up_or_down_to_four_digits() {
        assert_eq!((round_to_four_digits(38.2167, false), round_to_four_digits(38.2167, true)), (38.21, 38.22));
        assert_eq!(
            (round_to_four_digits(0.001_234_51, false), round_to_four_digits(0.001_234_51, true)),
            (0.001_234, 0.001_235)
        );
        assert_eq!(
            (round_to_four_digits(123_456.0, false), round_to_four_digits(123_456.0, true)),
            (123_400.0, 123_500.0)
        );
        assert_eq!(round_to_four_digits(0.0, true), 0.0);
    }
}

//! Where nothing meets the wishes: what each of them would have to be, all others kept.

use rayon::prelude::*;

use super::kind::{DrivenLinkage, LinkageKind, P_RANGE};
use super::requirements::{Requirement, Requirements};
use super::scaled_design::{Design, ProportionOrigin};
use super::search::{self, Samplers};
use super::trial::{Goal, Objective, Trial};
use super::{feasible_linkages, synthesize_all};

/// A wish that, changed, leaves all others met.
#[derive(Clone, Debug)]
pub struct Relaxation {
    /// The wish.
    pub requirement: Requirement,
    /// What it would have to be, to four digits; `None` where it would have to be given up.
    pub value: Option<f64>,
    /// The linkage that meets the wishes then.
    pub design: Design,
}

/// What is asked for in place of what was found is wider by this, so that a search for it finds it too.
const MARGIN: f64 = 1.002;

/// Each wish that could be changed alone. `short` are the linkages that meet all but the length within the size.
pub(super) fn find_relaxations(wishes: &Requirements, short: &[Trial], samplers: &Samplers) -> Vec<Relaxation> {
    let mut found: Vec<Relaxation> = Vec::new();
    found.extend(relax_lengths(wishes, short, samplers).into_iter().flatten());
    found.extend(relax_transmission(wishes, samplers));
    found.extend(relax_frame(wishes, samplers));
    found.extend(relax_by_dropping(wishes, samplers));
    found
}

/// The design of a trial under changed wishes.
fn relax_to(
    wish: Requirement,
    to: f64,
    trial: &Trial,
    wishes: &Requirements,
    samplers: &Samplers,
) -> Option<Relaxation> {
    let design = Design::from_trial(ProportionOrigin::Search, trial, wishes, &samplers.fine)?;
    Some(Relaxation { requirement: wish, value: Some(to), design })
}

/// The least size, the greatest length and the least tolerance.
fn relax_lengths(wishes: &Requirements, short: &[Trial], samplers: &Samplers) -> [Option<Relaxation>; 3] {
    let longest = short.iter().max_by(|a, b| a.length_to_size().total_cmp(&b.length_to_size()));
    let (Some(length), Some(size), Some(longest)) = (wishes.length, wishes.size, longest) else {
        return [None, None, None];
    };
    let part = length / size;
    let least_size = round_to_four_digits(length / longest.length_to_size() * MARGIN, true);
    let most_length = round_to_four_digits(size * longest.length_to_size() / MARGIN, false);
    let straightest = |trial: &Trial| {
        let template = trial.driven_linkage.kind.template()?;
        let question = objective(trial.driven_linkage, &template, wishes, Goal::Longest);
        search::straightest_at_ratio(&question, trial, part, true, samplers)
    };
    let all: Vec<Trial> = short.par_iter().filter_map(straightest).collect();
    let straightest = all.iter().min_by(|a, b| a.tolerance.total_cmp(&b.tolerance));
    let shorter = Requirements { length: Some(most_length), ..wishes.clone() };
    [
        relax_to(Requirement::Size, least_size, longest, wishes, samplers),
        relax_to(Requirement::Length, most_length, longest, &shorter, samplers),
        straightest.and_then(|trial| {
            relax_to(
                Requirement::Tolerance,
                round_to_four_digits(trial.tolerance * MARGIN, true),
                trial,
                wishes,
                samplers,
            )
        }),
    ]
}

/// The greatest transmission angle there is.
fn relax_transmission(wishes: &Requirements, samplers: &Samplers) -> Option<Relaxation> {
    let goal = Goal::Transmission { min_length_to_size: wishes.length_to_size().unwrap_or(0.0) };
    let any = Requirements { mu_min: 0.0, ..wishes.clone() };
    let best = best_trial(&any, goal, samplers, |trial| -trial.performance.mu_min)?;
    let to = round_to_four_digits(best.performance.mu_min / MARGIN, false);
    (to < wishes.mu_min).then(|| relax_to(Requirement::MuMin, to, &best, wishes, samplers)).flatten()
}

/// The nearest `p`.
fn relax_frame(wishes: &Requirements, samplers: &Samplers) -> Option<Relaxation> {
    let p = wishes.p?;
    let goal = Goal::Frame { p, min_length_to_size: wishes.length_to_size().unwrap_or(0.0) };
    let best = best_trial(wishes, goal, samplers, |trial| (trial.proportions[0] / p).max(p / trial.proportions[0]))?;
    let found = best.proportions[0];
    let to = if found > p {
        round_to_four_digits(found * MARGIN, true)
    } else {
        round_to_four_digits(found / MARGIN, false)
    };
    relax_to(Requirement::P, to.clamp(P_RANGE[0], P_RANGE[1]), &best, wishes, samplers)
}

/// The best of all arrangements for another goal, by what is least.
fn best_trial(wishes: &Requirements, goal: Goal, samplers: &Samplers, least: impl Fn(&Trial) -> f64) -> Option<Trial> {
    let arrangements: Vec<DrivenLinkage> = feasible_linkages(wishes).collect();
    let search = |arrangement: &DrivenLinkage| {
        let template = arrangement.kind.template()?;
        search::best_trials(&objective(*arrangement, &template, wishes, goal), samplers).into_iter().next()
    };
    let all: Vec<Trial> = arrangements.par_iter().filter_map(search).collect();
    all.into_iter().min_by(|a, b| least(a).total_cmp(&least(b)))
}

fn objective<'a>(
    arrangement: DrivenLinkage,
    template: &'a std::sync::Arc<coupler_curves::template::Template>,
    wishes: &'a Requirements,
    goal: Goal,
) -> Objective<'a> {
    Objective { driven_linkage: arrangement, template, requirements: wishes, tolerance: wishes.tolerance, goal }
}

/// What there is without one of the wishes that are met or not.
fn relax_by_dropping(wishes: &Requirements, samplers: &Samplers) -> Vec<Relaxation> {
    let without = [
        (Requirement::Input, wishes.input.is_some(), Requirements { input: None, ..wishes.clone() }),
        (
            Requirement::DoublePoint,
            wishes.double_point.is_some(),
            Requirements { double_point: None, ..wishes.clone() },
        ),
        (Requirement::QuickReturn, wishes.quick_return, Requirements { quick_return: false, ..wishes.clone() }),
        (
            Requirement::Kinds,
            wishes.kinds.len() < LinkageKind::ALL.len(),
            Requirements { kinds: LinkageKind::ALL.to_vec(), ..wishes.clone() },
        ),
    ];
    let asked = without.into_iter().filter(|(_, is_asked, _)| *is_asked);
    let found = asked.filter_map(|(wish, _, others)| {
        let design =
            synthesize_all(&Requirements { max_designs: 1, ..others }, samplers).0.designs.into_iter().next()?;
        Some(Relaxation { requirement: wish, value: None, design })
    });
    found.collect()
}

/// A number to four digits, no less than it is, or no more.
pub(super) fn round_to_four_digits(value: f64, up: bool) -> f64 {
    let power: i32 = format!("{value:e}").split('e').nth(1).and_then(|power| power.parse().ok()).unwrap_or(0);
    let digits = |power: i32| format!("1e{power}").parse::<f64>().unwrap_or(1.0);
    let units = value / digits(power - 3);
    let units = if up { units.ceil() } else { units.floor() };
    format!("{units}e{}", power - 3).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::round_to_four_digits;

    #[test]
    fn four_digits_on_the_safe_side() {
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

//! Where nothing meets the wishes: what each of them would have to be, all others kept.

use rayon::prelude::*;

use super::dimension::{Design, Origin};
use super::kind::{Arrangement, Kind};
use super::search::{self, Samplers};
use super::trial::{Goal, Question, Trial};
use super::wishes::{FRAMES, Wish, Wishes};
use super::{able, meeting};

/// A wish that, changed, leaves all others met.
#[derive(Clone, Debug)]
pub struct Relaxation {
    /// The wish.
    pub wish: Wish,
    /// What it would have to be, to four digits; `None` where it would have to be given up.
    pub to: Option<f64>,
    /// The linkage that meets the wishes then.
    pub design: Design,
}

/// What is asked for in place of what was found is wider by this, so that a search for it finds it too.
const WIDER: f64 = 1.002;

/// Each wish that could be changed alone. `short` are the linkages that meet all but the length within the size.
pub(super) fn relax(wishes: &Wishes, short: &[Trial], samplers: &Samplers) -> Vec<Relaxation> {
    let mut found: Vec<Relaxation> = Vec::new();
    found.extend(lengths(wishes, short, samplers).into_iter().flatten());
    found.extend(transmission(wishes, samplers));
    found.extend(frame(wishes, samplers));
    found.extend(given_up(wishes, samplers));
    found
}

/// The design of a trial under changed wishes.
fn relaxed(wish: Wish, to: f64, trial: &Trial, wishes: &Wishes, samplers: &Samplers) -> Option<Relaxation> {
    let design = Design::of(Origin::Search, trial, wishes, &samplers.fine)?;
    Some(Relaxation { wish, to: Some(to), design })
}

/// The least size, the greatest length and the least tolerance.
fn lengths(wishes: &Wishes, short: &[Trial], samplers: &Samplers) -> [Option<Relaxation>; 3] {
    let longest = short.iter().max_by(|a, b| a.part().total_cmp(&b.part()));
    let (Some(length), Some(size), Some(longest)) = (wishes.length, wishes.size, longest) else {
        return [None, None, None];
    };
    let part = length / size;
    let least_size = rounded(length / longest.part() * WIDER, true);
    let most_length = rounded(size * longest.part() / WIDER, false);
    let straightest = |trial: &Trial| {
        let template = trial.arrangement.kind.template()?;
        let question = question(trial.arrangement, &template, wishes, Goal::Longest);
        search::straightest(&question, trial, part, true, samplers)
    };
    let all: Vec<Trial> = short.par_iter().filter_map(straightest).collect();
    let straightest = all.iter().min_by(|a, b| a.tolerance.total_cmp(&b.tolerance));
    let shorter = Wishes { length: Some(most_length), ..wishes.clone() };
    [
        relaxed(Wish::Size, least_size, longest, wishes, samplers),
        relaxed(Wish::Length, most_length, longest, &shorter, samplers),
        straightest.and_then(|trial| {
            relaxed(Wish::Tolerance, rounded(trial.tolerance * WIDER, true), trial, wishes, samplers)
        }),
    ]
}

/// The greatest transmission angle there is.
fn transmission(wishes: &Wishes, samplers: &Samplers) -> Option<Relaxation> {
    let goal = Goal::Transmission { part: wishes.part().unwrap_or(0.0) };
    let any = Wishes { mu_min: 0.0, ..wishes.clone() };
    let best = best(&any, goal, samplers, |trial| -trial.figures.mu_min)?;
    let to = rounded(best.figures.mu_min / WIDER, false);
    (to < wishes.mu_min).then(|| relaxed(Wish::MuMin, to, &best, wishes, samplers)).flatten()
}

/// The nearest `p`.
fn frame(wishes: &Wishes, samplers: &Samplers) -> Option<Relaxation> {
    let p = wishes.p?;
    let goal = Goal::Frame { p, part: wishes.part().unwrap_or(0.0) };
    let best = best(wishes, goal, samplers, |trial| (trial.of[0] / p).max(p / trial.of[0]))?;
    let found = best.of[0];
    let to = if found > p { rounded(found * WIDER, true) } else { rounded(found / WIDER, false) };
    relaxed(Wish::P, to.clamp(FRAMES[0], FRAMES[1]), &best, wishes, samplers)
}

/// The best of all arrangements for another goal, by what is least.
fn best(wishes: &Wishes, goal: Goal, samplers: &Samplers, least: impl Fn(&Trial) -> f64) -> Option<Trial> {
    let arrangements: Vec<Arrangement> = able(wishes).collect();
    let search = |arrangement: &Arrangement| {
        let template = arrangement.kind.template()?;
        search::search(&question(*arrangement, &template, wishes, goal), samplers).into_iter().next()
    };
    let all: Vec<Trial> = arrangements.par_iter().filter_map(search).collect();
    all.into_iter().min_by(|a, b| least(a).total_cmp(&least(b)))
}

fn question<'a>(
    arrangement: Arrangement,
    template: &'a std::sync::Arc<coupler_curves::template::Template>,
    wishes: &'a Wishes,
    goal: Goal,
) -> Question<'a> {
    Question { arrangement, template, wishes, tolerance: wishes.tolerance, goal }
}

/// What there is without one of the wishes that are met or not.
fn given_up(wishes: &Wishes, samplers: &Samplers) -> Vec<Relaxation> {
    let without = [
        (Wish::Input, wishes.input.is_some(), Wishes { input: None, ..wishes.clone() }),
        (Wish::DoublePoint, wishes.double_point.is_some(), Wishes { double_point: None, ..wishes.clone() }),
        (Wish::QuickReturn, wishes.quick_return, Wishes { quick_return: false, ..wishes.clone() }),
        (Wish::Kinds, wishes.kinds.len() < Kind::ALL.len(), Wishes { kinds: Kind::ALL.to_vec(), ..wishes.clone() }),
    ];
    let asked = without.into_iter().filter(|(_, is_asked, _)| *is_asked);
    let found = asked.filter_map(|(wish, _, others)| {
        let design = meeting(&Wishes { best: 1, ..others }, samplers).0.designs.into_iter().next()?;
        Some(Relaxation { wish, to: None, design })
    });
    found.collect()
}

/// A number to four digits, no less than it is, or no more.
pub(super) fn rounded(value: f64, up: bool) -> f64 {
    let power: i32 = format!("{value:e}").split('e').nth(1).and_then(|power| power.parse().ok()).unwrap_or(0);
    let digits = |power: i32| format!("1e{power}").parse::<f64>().unwrap_or(1.0);
    let units = value / digits(power - 3);
    let units = if up { units.ceil() } else { units.floor() };
    format!("{units}e{}", power - 3).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::rounded;

    #[test]
    fn four_digits_on_the_safe_side() {
        assert_eq!((rounded(38.2167, false), rounded(38.2167, true)), (38.21, 38.22));
        assert_eq!((rounded(0.001_234_51, false), rounded(0.001_234_51, true)), (0.001_234, 0.001_235));
        assert_eq!((rounded(123_456.0, false), rounded(123_456.0, true)), (123_400.0, 123_500.0));
        assert_eq!(rounded(0.0, true), 0.0);
    }
}

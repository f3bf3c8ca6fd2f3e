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

mod dimension;
mod extent;
mod kind;
mod relax;
mod search;
mod simplex;
mod stroke;
mod trial;
mod wishes;

pub use dimension::{Design, Origin};
pub use kind::{Arrangement, Input, Kind};
pub use relax::Relaxation;
pub use stroke::Driven;
pub use trial::Figures;
pub use wishes::{FRAMES, TOLERANCES, Wish, Wishes};

use std::sync::Arc;

use rayon::prelude::*;

use coupler_curves::template::Template;
use search::Samplers;
use trial::{Goal, Question, Trial};

/// What a design has come to.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// The linkages that meet the wishes, the best first.
    pub designs: Vec<Design>,
    /// What is left out, and why.
    pub left_out: Vec<LeftOut>,
    /// Where nothing meets the wishes: for each of them, what it would have to be, all others kept.
    pub relaxations: Vec<Relaxation>,
}

/// A linkage that is not among what was found, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOut {
    /// The linkage and what would move it.
    pub arrangement: Arrangement,
    /// Whether it is the one by the closed condition.
    pub is_closed: bool,
    /// Why.
    pub why: String,
}

/// The linkages with a straight line that meet some wishes; their [`Wishes::objections`] are to be none.
///
/// The result does not depend on the number of threads.
pub fn straight_line(wishes: &Wishes) -> Found {
    let samplers = Samplers::default();
    let (mut found, short) = meeting(wishes, &samplers);
    if found.designs.is_empty() {
        found.relaxations = relax::relax(wishes, &short, &samplers);
    }
    found
}

/// What meets the wishes, and what meets all of them but the length within the size.
fn meeting(wishes: &Wishes, samplers: &Samplers) -> (Found, Vec<Trial>) {
    let mut found = Found { left_out: by_type(wishes), ..Found::default() };
    let mut short: Vec<Trial> = Vec::new();
    let mut kept: Vec<(Origin, Trial)> = Vec::new();
    let candidates: Vec<Candidates> = able(wishes)
        .collect::<Vec<_>>()
        .par_iter()
        .filter_map(|arrangement| candidates(*arrangement, wishes, samplers))
        .collect();
    for of_kind in candidates {
        found.left_out.extend(of_kind.left_out);
        kept.extend(of_kind.met);
        short.extend(of_kind.short);
    }
    let (kept, twins) = without_twins(kept);
    found.left_out.extend(twins);
    let kept = ranked(kept, wishes);
    found.designs =
        kept.iter().filter_map(|(origin, trial)| Design::of(*origin, trial, wishes, &samplers.fine)).collect();
    (found, short)
}

/// What a search has found of an arrangement.
#[derive(Default)]
struct Candidates {
    met: Vec<(Origin, Trial)>,
    /// What meets every wish but the length within the size.
    short: Vec<Trial>,
    left_out: Vec<LeftOut>,
}

/// The arrangements that can meet the wishes at all.
fn able(wishes: &Wishes) -> impl Iterator<Item = Arrangement> + '_ {
    wishes.arrangements().filter(|arrangement| unable(*arrangement, wishes).is_none())
}

/// Why an arrangement can meet none of the wishes whatever its proportions.
fn unable(arrangement: Arrangement, wishes: &Wishes) -> Option<&'static str> {
    match (arrangement.kind, arrangement.input) {
        (_, Input::Rocker) if wishes.quick_return => Some("a rocker goes back as it came, no quicker"),
        (Kind::Chebyshev, Input::Motor) if wishes.mu_min > 0.0 => Some(
            "its rockers have limits in each turn of the coupler, where the transmission angle is 0; Evans's linkage traces \
             the same curves at twice the size by a crank",
        ),
        _ => None,
    }
}

/// What type synthesis leaves out.
fn by_type(wishes: &Wishes) -> Vec<LeftOut> {
    let why = |arrangement: Arrangement| -> Option<String> {
        if !wishes.kinds.contains(&arrangement.kind) {
            return None;
        }
        let wanted = match wishes.input {
            Some(Input::Motor) if arrangement.input == Input::Rocker && arrangement.kind != Kind::Chebyshev => {
                Some("no link that could be driven turns fully (Natesan 4.3, 4.4)")
            }
            Some(Input::Rocker) if arrangement.input == Input::Motor && arrangement.kind != Kind::Chebyshev => {
                Some("it is driven by a crank that turns fully (Natesan 4.1)")
            }
            Some(input) if arrangement.input != input => None,
            _ => unable(arrangement, wishes),
        };
        wanted.map(str::to_owned)
    };
    let left_out = |arrangement| Some(LeftOut { arrangement, is_closed: false, why: why(arrangement)? });
    Arrangement::ALL.into_iter().filter_map(left_out).collect()
}

/// The question what is the longest straight portion of an arrangement.
fn question<'a>(arrangement: Arrangement, template: &'a Arc<Template>, wishes: &'a Wishes, goal: Goal) -> Question<'a> {
    Question { arrangement, template, wishes, tolerance: wishes.tolerance, goal }
}

fn candidates(arrangement: Arrangement, wishes: &Wishes, samplers: &Samplers) -> Option<Candidates> {
    let template = arrangement.kind.template()?;
    let question = question(arrangement, &template, wishes, Goal::Longest);
    let mut found = Candidates::default();
    let trials = search::search(&question, samplers);
    let left_out = |is_closed, why: String| LeftOut { arrangement, is_closed, why };
    if trials.is_empty() {
        found.left_out.push(left_out(false, "no proportions that were tried meet the wishes".to_owned()));
    }
    found.short = trials.clone();
    let fits = |trial: &Trial| wishes.part().is_none_or(|part| trial.part() >= part);
    let straightest = |trial: &Trial, free: bool| match wishes.part() {
        Some(part) => search::straightest(&question, trial, part, free, samplers),
        None => Some(trial.clone()),
    };
    let closed = closed(&question, samplers);
    match &closed {
        Some(Ok(trial)) if fits(trial) => {
            found.met.extend(straightest(trial, false).map(|trial| (Origin::Condition, trial)));
        }
        Some(Ok(trial)) => found.left_out.push(left_out(true, too_short(trial, wishes))),
        Some(Err(why)) => found.left_out.push(left_out(true, why.clone())),
        None => {}
    }
    let fitting = trials.par_iter().filter(|trial| fits(trial)).filter_map(|trial| straightest(trial, true));
    let mut fitting: Vec<Trial> = fitting.collect();
    fitting.sort_by(|a, b| a.tolerance.total_cmp(&b.tolerance));
    if let (true, Some(longest)) = (fitting.is_empty(), trials.first()) {
        found.left_out.push(left_out(false, too_short(longest, wishes)));
    }
    // Where the search has come back to the closed condition, that is shown.
    let is_closed = |trial: &Trial| found.met.iter().any(|(_, closed)| *closed == *trial);
    let searched: Vec<Trial> = fitting.into_iter().filter(|trial| !is_closed(trial)).collect();
    found.met.extend(search::distinct(searched).into_iter().map(|trial| (Origin::Search, trial)));
    Some(found)
}

fn too_short(trial: &Trial, wishes: &Wishes) -> String {
    let longest = trial.part() * wishes.size.unwrap_or(1.0);
    format!("within this size its straight portion is at most {} long", relax::rounded(longest, false))
}

/// The best by the closed condition for the `p` that is wished, or why it does not meet the wishes.
fn closed(question: &Question, samplers: &Samplers) -> Option<Result<Trial, String>> {
    let all = question.arrangement.kind.closed(question.wishes.p?);
    let asked = all.iter().map(|of| question.ask(of, &samplers.fine));
    let (value, trial) = asked.min_by(|a, b| a.0.total_cmp(&b.0))?;
    if let (true, Some(trial)) = (value < trial::UNMET, trial) {
        return Some(Ok(trial));
    }
    // Once more, with nothing asked but the line itself, to say what it is that it lacks.
    let asks_nothing = Wishes { mu_min: 0.0, double_point: None, quick_return: false, ..question.wishes.clone() };
    let plain = Question { wishes: &asks_nothing, ..*question };
    let best = all.iter().filter_map(|of| plain.ask(of, &samplers.fine).1).next();
    Some(Err(match best {
        None => "it makes no such linkage".to_owned(),
        Some(trial) if trial.figures.mu_min < question.wishes.mu_min => {
            format!("its transmission angle falls to {}°", relax::rounded(trial.figures.mu_min, false))
        }
        Some(_) => "it does not meet the wish for the return or the double point".to_owned(),
    }))
}

/// Hoeken's linkage is Evans's with `s = a` and `k = 2`: where both are found to be one linkage, only the better is kept.
fn without_twins(all: Vec<(Origin, Trial)>) -> (Vec<(Origin, Trial)>, Vec<LeftOut>) {
    const ONE: f64 = 0.02;
    let as_evans = |trial: &Trial| match trial.arrangement.kind {
        Kind::Evans => Some(trial.of.clone()),
        Kind::Hoeken => Some([trial.of.as_slice(), &[2.0]].concat()),
        _ => None,
    };
    let are_twins = |a: &(Origin, Trial), b: &(Origin, Trial)| {
        let is_other = a.0 == b.0 && a.1.arrangement != b.1.arrangement;
        is_other && as_evans(&a.1).zip(as_evans(&b.1)).is_some_and(|(a, b)| trial::apart(&a, &b) < ONE)
    };
    let is_better = |a: &Trial, b: &Trial| {
        let order = a.tolerance.total_cmp(&b.tolerance).then(b.part().total_cmp(&a.part()));
        order.then(a.arrangement.cmp(&b.arrangement)).is_lt()
    };
    let mut left_out = Vec::new();
    let mut kept = Vec::new();
    for one in &all {
        match all.iter().find(|other| are_twins(one, other) && is_better(&other.1, &one.1)) {
            None => kept.push(one.clone()),
            Some((origin, better)) => left_out.push(LeftOut {
                arrangement: one.1.arrangement,
                is_closed: *origin == Origin::Condition,
                why: format!("it comes to the same as {}: s = a and k = 2", better.arrangement.kind.id()),
            }),
        }
    }
    (kept, left_out)
}

/// As many as are wanted, in order: the best of each arrangement before the second of any. What the closed conditions give
/// for these is shown beside them.
fn ranked(mut all: Vec<(Origin, Trial)>, wishes: &Wishes) -> Vec<(Origin, Trial)> {
    // Of equally straight ones the smaller.
    let merit = |trial: &Trial| [if wishes.part().is_some() { trial.tolerance } else { 0.0 }, -trial.part()];
    let order = |a: &(Origin, Trial), b: &(Origin, Trial)| {
        let ([a, smaller_a], [b, smaller_b]) = (merit(&a.1), merit(&b.1));
        a.total_cmp(&b).then(smaller_a.total_cmp(&smaller_b))
    };
    all.sort_by(order);
    let by_search = |arrangement| all.iter().any(|(o, t)| *o == Origin::Search && t.arrangement == arrangement);
    // Where no search found another, the closed condition's is what was found.
    let (beside, found): (Vec<_>, Vec<_>) =
        all.iter().cloned().partition(|(origin, trial)| *origin == Origin::Condition && by_search(trial.arrangement));
    let (mut firsts, mut rest) = (Vec::new(), Vec::new());
    for one in found {
        let is_first = firsts.iter().all(|(_, first): &(Origin, Trial)| first.arrangement != one.1.arrangement);
        if is_first { firsts.push(one) } else { rest.push(one) }
    }
    firsts.extend(rest);
    firsts.truncate(wishes.best);
    let is_shown = |trial: &Trial| firsts.iter().any(|(_, shown)| shown.arrangement == trial.arrangement);
    let beside: Vec<_> = beside.into_iter().filter(|(_, trial)| is_shown(trial)).collect();
    firsts.extend(beside);
    firsts.sort_by(order);
    firsts
}

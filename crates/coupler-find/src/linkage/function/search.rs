//! The search for the dimensions of a linkage whose output is a function.

use super::super::aim::link_ratio;
use super::super::circuit::Traced;
use super::super::sampled_space::SampledSpace;
use super::super::space::LinkageSpace;
use super::answer::LinkageFunctionAnswer;
use super::fitting::{LinkageAim, LinkageFit, Rough};
use super::track::Track;
use crate::condition::Condition;
use crate::function::FunctionTarget;
use crate::options::Effort;
use crate::scatter::Scatter;
use crate::workers::Workers;
use coupler_curves::geometry::trig;

/// What is asked of a linkage that generates a function.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkageFunctionOptions {
    /// Whether the greatest error is made least, and not the mean square.
    pub minimax: bool,
    /// The number of precision points at which all answers are exact: of a law in Chebyshev's spacing, or all rows. At most as many as
    /// [`most_precision_points`].
    pub points: Option<usize>,
    /// The input at the start in degrees, if it is given.
    pub input_start_deg: Option<f64>,
    /// The output at the start in degrees or as a length, if it is given.
    pub output_start: Option<f64>,
    /// Whether the input must turn fully.
    pub full_turn: bool,
    /// How many times the longest link may be as long as the shortest; may be infinite.
    pub max_ratio: f64,
    /// A condition over the parameters and the measures, over the range of the input.
    pub condition: Option<Condition>,
    /// How many linkages are tried.
    pub effort: Effort,
    /// The number from which the linkages follow that are tried near those that have been found.
    pub seed: u64,
    /// The most answers.
    pub most: usize,
}

/// Why a linkage generates no functions of this kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LinkageFunctionError {
    /// Its input is a length.
    #[error("its input is a length, and that of a function is an angle")]
    LengthInput,
    /// It has no output.
    #[error("it has no output link: state one with `output_link`")]
    NoOutput,
    /// Its output is a length, and that of the function an angle.
    #[error("its output is a length, and that of the function is an angle: give a length")]
    LengthOutput,
    /// Its output is an angle, and that of the function a length.
    #[error("its output is an angle, and that of the function is a length: give an angle")]
    AngleOutput,
}

/// The most precision points at which a linkage can be exact in general: as many as unknowns, its free parameters and the starts that are not given;
/// the size of a linkage does not change the angle of its output.
pub fn most_precision_points(space: &LinkageSpace, target: &FunctionTarget, open_starts: usize) -> usize {
    let idle = usize::from(space.is_scalable && !target.is_length());
    (space.dimension() + open_starts).saturating_sub(idle)
}

/// Finds the dimensions of a linkage whose output is a function of its input: samples of its parameters are compared with the function from inputs all
/// around, the nearest refined by Levenberg and Marquardt's method, and linkages at random near the best again. The best of many local minima; the same with
/// any number of threads. With precision points those that are exact there, the least error elsewhere first. `progress` is called with the part that is done.
///
/// # Errors
/// The linkage has no such output or input.
pub fn generate_function_by(
    space: &LinkageSpace,
    target: &FunctionTarget,
    options: &LinkageFunctionOptions,
    workers: &impl Workers,
    mut progress: impl FnMut(f64),
) -> Result<Vec<LinkageFunctionAnswer>, LinkageFunctionError> {
    check(space, target)?;
    /// The linkages that are refined, and those from which others begin, with how many near each.
    const REFINED: usize = 40;
    const RESTARTED: usize = 6;
    const NEAR: usize = 6;
    const STEPS: usize = 60;
    /// In how many steps samples are compared, and about which part of the time that, and refining the nearest, takes.
    const BATCHES: usize = 20;
    const SAMPLED: f64 = 0.4;
    const NEAREST: f64 = 0.7;
    let samples = compared(target, options.points);
    let travels: Vec<f64> = samples.iter().map(|[x, _]| trig::degrees(*x)).collect();
    let wanted: Vec<f64> = samples.iter().map(|[_, y]| *y).collect();
    let track = Track::new(&travels);
    let output_start = options.output_start.map(|start| if target.is_length() { start } else { trig::radians(start) });
    let aim = LinkageAim {
        space,
        track: &track,
        wanted: &wanted,
        given: [options.input_start_deg, output_start],
        full_turn: options.full_turn,
        power: 2.0,
        reference: target.size(),
    };
    let sampled = SampledSpace::new(space, options.full_turn);
    let count = sample_count(&sampled, options.effort);
    let travel = trig::degrees(target.travel());
    let mut found = Vec::new();
    for batch in 0..BATCHES {
        let numbers = (batch * count / BATCHES..(batch + 1) * count / BATCHES).collect();
        found.extend(workers.map(numbers, |number| best_of_sample(&aim, &sampled, number, travel)));
        progress(SAMPLED * (batch + 1) as f64 / BATCHES as f64);
    }
    let is_admitted = |fit: &LinkageFit| link_ratio(&fit.traced.linkage) <= options.max_ratio;
    let begun = nearest(found.into_iter().flatten().filter(is_admitted).collect(), REFINED);
    let refine = |fit: LinkageFit| fit.refined(&aim, STEPS);
    let mut refined = nearest(workers.map(begun, refine), REFINED);
    refined.retain(is_admitted);
    progress(NEAREST);
    let mut scatter = Scatter::new(options.seed);
    let mut near = Vec::new();
    for fit in refined.iter().take(RESTARTED) {
        near.extend((0..NEAR).map(|_| (fit.clone(), space.near(&fit.values, &mut scatter, 0.15))));
    }
    let again = workers.map(near, |(fit, values)| {
        let linkage = space.template().linkage(&values).ok()?;
        let traced = fit.traced.followed(linkage)?;
        Some(aim.begun(values, traced, fit.pass, fit.starts[0])?.refined(&aim, STEPS))
    });
    refined.extend(again.into_iter().flatten().filter(is_admitted));
    progress(1.0);
    let mut fits = nearest(refined, REFINED);
    if options.minimax {
        fits = workers.map(fits, |fit| least_greatest(fit, &aim));
        fits.retain(is_admitted);
        fits.sort_by(|a, b| a.greatest().total_cmp(&b.greatest()));
    }
    if options.points.is_some() {
        fits.retain(|fit| fit.greatest() <= EXACT * target.size());
    }
    let mut answers: Vec<LinkageFunctionAnswer> = Vec::new();
    for fit in fits {
        if answers.len() == options.most && options.points.is_none() {
            break;
        }
        if answers.iter().all(|other| !is_same(&other.fit, &fit)) {
            answers.extend(LinkageFunctionAnswer::new(fit, space.template(), target, options.condition.as_ref()));
        }
    }
    if options.points.is_some() {
        answers.sort_by(|a, b| a.error.greatest.abs().total_cmp(&b.error.greatest.abs()));
        answers.truncate(options.most);
    }
    Ok(answers)
}

/// The error at precision points that is rounding, in sizes of the function.
const EXACT: f64 = 1e-9;

/// The samples of a target that are compared in the search: its precision points, or others all over it.
fn compared(target: &FunctionTarget, points: Option<usize>) -> Vec<[f64; 2]> {
    const SAMPLES: usize = 41;
    if let Some(count) = points {
        return target.precision_points(count);
    }
    let all = target.samples();
    let stride = all.len().div_ceil(SAMPLES);
    let last = all.len() - 1;
    (0..all.len()).filter(|k| k % stride == 0 || *k == last).map(|k| all[k]).collect()
}

fn check(space: &LinkageSpace, target: &FunctionTarget) -> Result<(), LinkageFunctionError> {
    let template = space.template();
    if template.is_driven_by_length() {
        return Err(LinkageFunctionError::LengthInput);
    }
    let output =
        template.structure().ok().and_then(|linkage| linkage.output()).ok_or(LinkageFunctionError::NoOutput)?;
    match (output.is_slider(), target.is_length()) {
        (true, false) => Err(LinkageFunctionError::LengthOutput),
        (false, true) => Err(LinkageFunctionError::AngleOutput),
        _ => Ok(()),
    }
}

fn sample_count(sampled: &SampledSpace, effort: Effort) -> usize {
    let (part, times) = match effort {
        Effort::Quick => (3, 1),
        Effort::Normal => (1, 1),
        Effort::Thorough => (1, 4),
    };
    times * sampled.default_count().min(2000) / part
}

/// The best linkage of a sample, on any circuit and from any input.
fn best_of_sample(aim: &LinkageAim, sampled: &SampledSpace, number: usize, travel_deg: f64) -> Option<LinkageFit> {
    /// The starts that are tried over a turn, and over what a range leaves.
    const TURN: usize = 24;
    const RANGE: usize = 9;
    let values = aim.space.sample(number)?;
    let mut best: Option<(Rough, Traced, usize, f64)> = None;
    // All traced joints have the same circuits.
    let circuits = sampled.traced(&values).into_iter().filter(|on| on.trace == 0);
    for traced in circuits.map(|on| on.traced) {
        for (pass, of) in traced.circuit.passes.iter().enumerate() {
            let [low, high] = of.input_range();
            let starts: Vec<f64> = match aim.given[0] {
                Some(given) => vec![given],
                None if traced.is_full_turn() && traced.is_regular() => {
                    (0..TURN).map(|k| low + (high - low) * k as f64 / TURN as f64).collect()
                }
                None => {
                    let [least, most] = [low - travel_deg.min(0.0), high - travel_deg.max(0.0)];
                    let part = |k: usize| (k as f64 + 0.5) / RANGE as f64;
                    (0..RANGE).map(|k| least + (most - least) * part(k)).take_while(|_| most > least).collect()
                }
            };
            for start in starts {
                if let Some(rough) = aim.rough(&traced, pass, start)
                    && best.as_ref().is_none_or(|(best, ..)| rough.mean_square < best.mean_square)
                {
                    best = Some((rough, traced.clone(), pass, start));
                }
            }
        }
    }
    let (rough, traced, pass, start) = best?;
    if rough.scale == 1.0 {
        return aim.begun(values, traced, pass, start);
    }
    let values = aim.space.scaled(&values, rough.scale);
    let linkage = aim.space.template().linkage(&values).ok()?;
    aim.begun(values, traced.followed(linkage)?, pass, start)
}

/// The nearest that are not alike, at most so many.
fn nearest(mut fits: Vec<LinkageFit>, most: usize) -> Vec<LinkageFit> {
    fits.sort_by(|a, b| a.mean_square().total_cmp(&b.mean_square()));
    let mut kept: Vec<LinkageFit> = Vec::new();
    for fit in fits {
        if kept.len() < most && kept.iter().all(|other| !is_same(other, &fit)) {
            kept.push(fit);
        }
    }
    kept
}

/// Whether two linkages have the same errors to a thousandth, and inputs that differ by less than a tenth of a degree: parameters that do not move the
/// output, as those of a coupler point, may differ.
fn is_same(a: &LinkageFit, b: &LinkageFit) -> bool {
    const SAME: f64 = 1e-3;
    const DEGREES: f64 = 0.1;
    /// Radians, or lengths: the rounding of errors that are none.
    const ROUNDING: f64 = 1e-9;
    let turn = (a.starts[0] - b.starts[0] + 180.0).rem_euclid(360.0) - 180.0;
    let most = SAME * (a.greatest() + b.greatest()) + ROUNDING;
    turn.abs() < DEGREES && a.errors.iter().zip(&b.errors).all(|(a, b)| (a - b).abs() <= most)
}

/// The linkage near another one whose greatest error is nearly least, by sums of higher and higher powers.
fn least_greatest(fit: LinkageFit, aim: &LinkageAim) -> LinkageFit {
    const STEPS: usize = 20;
    const MAX_POWER: f64 = 256.0;
    let mut best = fit.clone();
    let mut last = fit;
    let mut power = 4.0;
    while power <= MAX_POWER && last.greatest() > 0.0 {
        let powered = LinkageAim { power, reference: last.greatest(), ..*aim };
        // The objective is another one.
        let Some(begun) = powered.again(&last) else { break };
        last = begun.refined(&powered, STEPS);
        if last.greatest() < best.greatest() {
            best = last.clone();
        }
        power *= 2.0;
    }
    best
}

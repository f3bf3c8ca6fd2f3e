//! The search for linkages that generate a function.

use super::answer::FunctionAnswer;
use super::by_fit::by_fit;
use super::by_points::by_points;
use super::candidates::Candidates;
use super::options::{FunctionMethod, FunctionOptions, LeftOut};
use super::target::FunctionTarget;
use crate::condition::Condition;
use crate::workers::Workers;
use coupler_curves::geometry::trig;
use coupler_curves::measure::MeasureSet;
use coupler_curves::solve::Solver;

/// What has been found for a function.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FunctionFindings {
    /// The answers, the best first.
    pub answers: Vec<FunctionAnswer>,
    /// Of all solutions of precision points, how many there are; `None` for a search among infinitely many.
    pub solutions: Option<usize>,
    /// What is left out, and how many of each kind.
    pub left_out: Vec<(LeftOut, usize)>,
    /// Whether the precision points have no isolated solutions: their equations depend on each other.
    pub is_degenerate: bool,
}

/// The solved linkages of a condition that are looked at, at most: of more that do not meet it a search says that there is none.
const MAX_SOLVED: usize = 400;

/// The mean error beyond which a fit is no answer beside a better one, in sizes of the output, as for paths.
const POOR: f64 = 0.05;

/// Finds linkages whose output is a function of their input. The answer is the same with any number of threads.
pub fn generate_function(
    target: &FunctionTarget,
    options: &FunctionOptions,
    workers: &impl Workers,
) -> FunctionFindings {
    let unit = if target.is_length() { target.size() } else { 1.0 };
    let scaled = target.scaled(1.0 / unit);
    let output_start =
        options.output_start.map(|start| if target.is_length() { start / unit } else { trig::radians(start) });
    let starts = [options.input_start_deg.map(trig::radians), output_start];
    let given = starts.iter().flatten().count();
    let Candidates { linkages, near, distance, mut left_out, solutions, is_degenerate } = match options.method {
        FunctionMethod::Points(count) if count + given <= 5 => {
            by_points(&scaled, options, scaled.precision_points(count), starts, workers)
        }
        _ => by_fit(&scaled, options, starts, workers),
    };
    let mut leave_out = |why: LeftOut| match left_out.iter_mut().find(|(other, _)| *other == why) {
        Some((_, count)) => *count += 1,
        None => left_out.push((why, 1)),
    };
    let mut answers: Vec<FunctionAnswer> = Vec::new();
    let mut solved = 0;
    for linkage in linkages {
        let linkage = linkage.with_starts_near(starts);
        if answers.len() == options.most || solved == MAX_SOLVED {
            break;
        }
        if answers.iter().any(|other| other.output_function.generator.distance_to(&linkage) < distance) {
            continue;
        }
        let Some(answer) = FunctionAnswer::new(linkage, &scaled, unit, near) else { continue };
        // Fits far from the function are other linkages' starts; the best is shown in any case.
        if solutions.is_none() && !answers.is_empty() && answer.error.rms > POOR * target.size_in_units() {
            continue;
        }
        if let Some(condition) = &options.condition {
            solved += 1;
            if !is_met(condition, &answer) {
                leave_out(LeftOut::Condition);
                continue;
            }
        }
        answers.push(answer);
    }
    left_out.sort_unstable();
    FunctionFindings { answers, solutions, left_out, is_degenerate }
}

/// Whether a linkage meets a condition over the range of its input.
fn is_met(condition: &Condition, answer: &FunctionAnswer) -> bool {
    let Some(mut family) = answer.family() else { return false };
    let used = MeasureSet::EMPTY | family.measures_in(condition.compiled());
    let Some(solved) = Solver::new(&family).measuring(used).solve(0) else { return false };
    family.filter = Some(condition.compiled().clone());
    solved.curves.first().is_some_and(|curve| family.keeps(&solved.cell, &curve.values))
}

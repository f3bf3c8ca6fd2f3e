//! Linkages that are exact at precision points: all, or where the points leave starts open, the best for starts over their whole range.

use super::candidates::{Candidates, sorted};
use super::generator::UNKNOWNS;
use super::open_starts::with_open_starts;
use super::options::{FunctionOptions, LeftOut};
use super::precision::{GivenStarts, exact};
use super::problem::Problem;
use super::target::FunctionTarget;
use crate::workers::Workers;

/// The linkages that are exact at some points with some starts given, together no more than five.
pub(super) fn by_points(
    target: &FunctionTarget,
    options: &FunctionOptions,
    points: Vec<[f64; 2]>,
    starts: GivenStarts,
    workers: &impl Workers,
) -> Candidates {
    let problem = Problem { target, options, points, starts, samples: target.samples() };
    let open = UNKNOWNS - problem.points.len() - starts.iter().flatten().count();
    if open == 0 { all(&problem) } else { with_open_starts(&problem, open, workers) }
}

/// All linkages of the points.
fn all(problem: &Problem) -> Candidates {
    /// Roots of the same form differ by more, but for double roots.
    const SAME: f64 = 1e-6;
    let found = exact(problem.options.kind, &problem.points, problem.starts);
    let solutions = found.linkages.len() + found.imaginary + found.infinite;
    let mut left_out: Vec<(LeftOut, usize)> = Vec::new();
    let mut leave_out = |why: LeftOut, times: usize| match left_out.iter_mut().find(|(other, _)| *other == why) {
        Some((_, count)) => *count += times,
        None => left_out.push((why, times)),
    };
    for (why, count) in [(LeftOut::Imaginary, found.imaginary), (LeftOut::Infinite, found.infinite)] {
        if count > 0 {
            leave_out(why, count);
        }
    }
    let mut kept = Vec::new();
    for linkage in found.linkages {
        match problem.objection(&linkage) {
            Some(why) => leave_out(why, 1),
            None => kept.push((problem.cost(&linkage), linkage)),
        }
    }
    Candidates {
        linkages: sorted(kept),
        near: problem.points[0],
        distance: SAME,
        left_out,
        solutions: Some(solutions),
        is_degenerate: found.is_degenerate,
    }
}

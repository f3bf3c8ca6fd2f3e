//! The error of a linkage made equally great at its extremes: Remez's exchange.

use nalgebra::{DMatrix, DVector};

use super::generator::Generator;
use super::structural_error::{ErrorCurve, Extreme};
use super::target::FunctionTarget;

/// The linkage near another one whose error has extremes of one magnitude and alternating sign, one more than the unknowns that move; the linkage itself if
/// it does not have so many, or if that does not lessen the greatest error.
///
/// The errors at the extremes are equal by Newton's method, and the extremes follow.
pub(super) fn equalized(linkage: Generator, target: &FunctionTarget, free: &[usize]) -> Generator {
    const STEPS: usize = 12;
    let greatest =
        |linkage: &Generator| Some(ErrorCurve::new(linkage, target, first(target))?.measure().greatest.abs());
    let Some(mut least) = greatest(&linkage) else { return linkage };
    let mut best = linkage;
    let mut current = linkage;
    for _ in 0..STEPS {
        let Some(next) = step(&current, target, free) else { break };
        let Some(error) = greatest(&next).filter(|error| error.is_finite()) else { break };
        current = next;
        if error < least {
            (best, least) = (next, error);
        }
    }
    best
}

fn first(target: &FunctionTarget) -> [f64; 2] {
    target.samples()[0]
}

fn step(linkage: &Generator, target: &FunctionTarget, free: &[usize]) -> Option<Generator> {
    let curve = ErrorCurve::new(linkage, target, first(target))?;
    let extremes = alternating(curve.extremes(), free.len() + 1)?;
    let unknowns = free.len() + 1;
    let mut matrix = DMatrix::zeros(unknowns, unknowns);
    let mut right = DVector::zeros(unknowns);
    for (k, [travel, error]) in extremes.iter().enumerate() {
        let output = linkage.output(linkage.starts[0] + travel)?;
        let slopes = linkage.slopes(*travel, output);
        free.iter().enumerate().for_each(|(column, place)| matrix[(k, column)] = slopes[*place]);
        matrix[(k, free.len())] = -error.signum();
        right[k] = -error;
    }
    let motion = matrix.lu().solve(&right)?;
    // A step that is no longer near is of no use.
    let is_near = motion.iter().take(free.len()).all(|by| by.abs() < 0.5);
    is_near.then(|| linkage.moved(free, motion.iter().copied()))
}

/// The greatest extremes that alternate in sign, as many as are asked for; `None` if there are fewer.
fn alternating(extremes: Vec<Extreme>, count: usize) -> Option<Vec<Extreme>> {
    let mut runs: Vec<Extreme> = Vec::new();
    for extreme in extremes {
        if !extreme[1].is_finite() {
            return None;
        }
        match runs.last_mut() {
            Some(last) if (last[1] < 0.0) == (extreme[1] < 0.0) => {
                if extreme[1].abs() > last[1].abs() {
                    *last = extreme;
                }
            }
            _ => runs.push(extreme),
        }
    }
    // Those at the ends that are less are left out.
    while runs.len() > count {
        let is_first = runs[0][1].abs() < runs[runs.len() - 1][1].abs();
        if is_first {
            runs.remove(0);
        } else {
            runs.pop();
        }
    }
    (runs.len() == count).then_some(runs)
}

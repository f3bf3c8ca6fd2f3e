//! Linkages whose error is least over a whole function, by refinement from many starts.

use std::f64::consts::PI;

use super::candidates::{Candidates, DISTANCE, TRANSMISSION_DEG, apart, sorted};
use super::exchange::equalized;
use super::fit::{FitAim, Limits, fitted, free_unknowns, least_greatest, mean_square};
use super::generator::{Generator, GeneratorKind, UNKNOWNS};
use super::options::{FunctionMethod, FunctionOptions};
use super::precision::{GivenStarts, exact, nearest};
use super::structural_error::ErrorCurve;
use super::target::FunctionTarget;
use crate::scatter::Scatter;
use crate::workers::Workers;
use coupler_curves::geometry::trig;

/// The linkages whose error is least near each of many starts, in mean square or of the greatest magnitude.
pub(super) fn by_fit(
    target: &FunctionTarget,
    options: &FunctionOptions,
    starts: GivenStarts,
    workers: &impl Workers,
) -> Candidates {
    /// Fits that differ by less have ended in the same minimum.
    const SAME: f64 = 1e-3;
    /// The linkages that are refined, those that are made minimax, and the steps of each.
    const REFINED: usize = 80;
    const MINIMAX: usize = 16;
    /// How many times fewer with a least transmission angle, of which there are many.
    const FEWER: usize = 3;
    const STEPS: usize = 200;
    /// Starts that differ by less lead to the same minimum, mostly.
    const APART: f64 = 0.05;
    /// The linkages that conditions are tried on.
    const MOST: usize = 400;
    let samples = target.samples();
    let limits = Limits { max_ratio: options.max_ratio, full_turn: options.full_turn, least_transmission: 0.0 };
    let aim = FitAim { samples: &samples, free: free_unknowns(starts), limits, power: 2.0, reference: target.size() };
    let mut begun = grid_starts(&aim, options.kind, starts, workers);
    begun.extend(exact_starts(&aim, options.kind, starts));
    begun.extend(other_starts(&aim, options.kind, starts));
    let begun = sorted(begun);
    // What a condition asks for besides may hold far from all minima.
    let mut found = if options.condition.is_some() { apart(begun.clone(), DISTANCE, MOST) } else { Vec::new() };
    let begun = apart(begun, APART, REFINED);
    // A condition may ask for a transmission angle, which the nearest linkages do not have.
    let levels = if options.condition.is_some() { TRANSMISSION_DEG } else { &TRANSMISSION_DEG[..1] };
    for level in levels {
        let limits = Limits { least_transmission: trig::radians(*level), ..limits };
        let aim = FitAim { limits, ..aim.clone() };
        let fewer = if *level > 0.0 { FEWER } else { 1 };
        let some: Vec<Generator> = begun.iter().copied().take(REFINED / fewer).collect();
        let refined = workers.map(some, |linkage| {
            let linkage = fitted(linkage, &aim, STEPS)?;
            Some((mean_square(linkage, &aim)?, linkage))
        });
        let mut linkages = apart(sorted(refined.into_iter().flatten().collect()), SAME, REFINED);
        if options.method == FunctionMethod::Minimax {
            linkages.truncate(MINIMAX / fewer);
            let near = |linkage| least_greatest(linkage, &aim);
            let nearest: Vec<Generator> = workers.map(linkages, near).into_iter().flatten().collect();
            // What an exchange makes equal may be beyond the limits.
            linkages = workers.map(nearest.clone(), |linkage| equalized(linkage, target, &aim.free));
            linkages.extend(nearest);
        }
        found.extend(linkages);
    }
    found.retain(|linkage| linkage.ratio() <= limits.max_ratio && (!limits.full_turn || linkage.is_full_turn()));
    let error = |linkage: Generator| {
        let error = ErrorCurve::new(&linkage, target, samples[0])?.measure();
        Some((if options.method == FunctionMethod::Minimax { error.greatest.abs() } else { error.rms }, linkage))
    };
    let linkages = sorted(workers.map(found, error).into_iter().flatten().collect());
    Candidates { linkages: apart(linkages, SAME, MOST), near: samples[0], distance: DISTANCE, ..Candidates::default() }
}

/// A linkage on each side, if it can be assembled there, with its mean square error.
fn on_both_sides(linkage: Generator, aim: &FitAim) -> impl Iterator<Item = (f64, Generator)> {
    [1.0, -1.0].into_iter().filter_map(move |side| {
        let linkage = Generator { side, ..linkage };
        Some((mean_square(linkage, aim)?, linkage))
    })
}

/// Linkages of a grid of starts, with the lengths that their equations ask for.
fn grid_starts(
    aim: &FitAim,
    kind: GeneratorKind,
    [input, output]: GivenStarts,
    workers: &impl Workers,
) -> Vec<(f64, Generator)> {
    const STEPS: usize = 36;
    /// The samples whose equations are solved.
    const SAMPLES: usize = 31;
    let stride = aim.samples.len().div_ceil(SAMPLES);
    let samples: Vec<[f64; 2]> = aim.samples.iter().step_by(stride).copied().collect();
    let angles = || (0..STEPS).map(|k| 2.0 * PI * k as f64 / STEPS as f64);
    let ways = || (0..STEPS).map(|k| (2 * k + 1) as f64 / STEPS as f64 - 1.0).map(|part| part / (1.0 - part * part));
    let inputs: Vec<f64> = input.map_or_else(|| angles().collect(), |input| vec![input]);
    let outputs: Vec<f64> = match (output, kind) {
        (Some(output), _) => vec![output],
        (None, GeneratorKind::FourBar) => angles().collect(),
        (None, GeneratorKind::SliderCrank) => ways().collect(),
    };
    let found = workers.map(inputs, |input| {
        let linkages = outputs.iter().filter_map(|output| nearest(kind, &samples, [input, *output]));
        linkages.flat_map(|linkage| on_both_sides(linkage, aim)).collect::<Vec<_>>()
    });
    found.into_iter().flatten().collect()
}

/// Linkages that are exact at some of the samples: near the zeros of Chebyshev's polynomials, and at others.
fn exact_starts(aim: &FitAim, kind: GeneratorKind, starts: GivenStarts) -> Vec<(f64, Generator)> {
    let count = UNKNOWNS - starts.iter().flatten().count();
    let last = aim.samples.len() - 1;
    if last + 1 < count {
        return Vec::new();
    }
    let spacings: [&dyn Fn(f64) -> f64; 3] =
        [&|part| 0.5 - 0.5 * trig::cos(PI * part), &|part| part, &|part| 0.25 + 0.5 * part];
    let mut found = Vec::new();
    for spacing in spacings {
        let mut places: Vec<usize> = (0..count)
            .map(|k| (spacing((2 * k + 1) as f64 / (2 * count) as f64) * last as f64).round() as usize)
            .collect();
        places.dedup();
        if places.len() == count {
            let points: Vec<[f64; 2]> = places.iter().map(|place| aim.samples[*place]).collect();
            let linkages = exact(kind, &points, starts).linkages;
            found.extend(linkages.into_iter().flat_map(|linkage| on_both_sides(linkage, aim)));
        }
    }
    found
}

/// Random linkages, and parallelograms, which no equation leads to where the output is the input: with the output at the start that is best.
fn other_starts(aim: &FitAim, kind: GeneratorKind, [input, output]: GivenStarts) -> Vec<(f64, Generator)> {
    const RANDOM: usize = 400;
    const PARALLELOGRAMS: usize = 36;
    /// The deviation of the logarithms of lengths and of offsets in sizes of the output.
    const SPREAD: f64 = 0.7;
    let mut scatter = Scatter::new(1);
    let mut lengths: Vec<([f64; 3], f64)> = Vec::new();
    for _ in 0..RANDOM {
        let mut length = || trig::exp(scatter.normal(SPREAD));
        let [a, b, c] = [length(), length(), length()];
        let third = if kind == GeneratorKind::SliderCrank { scatter.normal(SPREAD) } else { c };
        lengths.push(([a, a.max(b), third], scatter.normal(PI)));
    }
    if kind == GeneratorKind::FourBar {
        let angles = (0..PARALLELOGRAMS).map(|k| 2.0 * PI * k as f64 / PARALLELOGRAMS as f64);
        lengths.extend(angles.map(|angle| ([0.8, 1.0, 0.8], angle)));
    }
    let placed = |([a, b, third], angle): ([f64; 3], f64), side: f64| {
        let start = input.unwrap_or(angle);
        let linkage = Generator { kind, lengths: [a, b, third], starts: [start, 0.0], side };
        let outputs: Option<Vec<f64>> = aim.samples.iter().map(|[x, y]| Some(linkage.output(start + x)? - y)).collect();
        let outputs = outputs?;
        let best = outputs.iter().sum::<f64>() / outputs.len() as f64;
        let linkage = Generator { starts: [start, output.unwrap_or(best)], ..linkage };
        Some((mean_square(linkage, aim)?, linkage))
    };
    let both = lengths.into_iter().flat_map(|linkage| [(linkage, 1.0), (linkage, -1.0)]);
    both.filter_map(|(linkage, side)| placed(linkage, side)).collect()
}

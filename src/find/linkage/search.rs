//! The search for dimensions on all threads.

use std::sync::atomic::{AtomicBool, Ordering};

use coupler_curves::family::{Family, Sampling};
use coupler_curves::solve::{SolvedCell, Solver};
use coupler_find::{
    Effort, LinkageFit, LinkageRefinement, LinkageSearch, LinkageSpace, Options, PathKind, SampleCurve, SampleIndex,
    SampleShape, Target,
};
use rayon::prelude::*;

use super::super::Error;
use super::super::placed_curve::{PlacedCurve, REPORTED, distinct};
use super::answer::LinkageAnswer;

/// The most curves of all parameter sets together.
const MAX_CURVES: usize = 8_000_000;

/// Linkages whose circuits are found slowly have so many times fewer starts.
const SLOWER: usize = 3;

/// The curves of a piece of work, and how many parameter sets are tried for each that is wanted: others cannot be assembled, or their input
/// does not turn.
const PIECE: usize = 1024;
const TRIES: usize = 8;
const SLOW_TRIES: usize = 2;

/// The parts of the starts that are refined in each round, and the steps of a round.
const ROUNDS: [(usize, usize); 4] = [(2, 6), (4, 12), (8, 40), (20, 150)];

/// The steps in which the curves are placed before.
const PLACING_STEPS: usize = 10;

/// The samples of a circuit of an answer, as a family has them.
const SAMPLES: usize = 360;

/// The dimensions of a linkage for which its curves are nearest to a target, the nearest first, and the number of curves in which it
/// was looked up.
///
/// # Errors
/// `interrupt` is true.
pub(super) fn search_linkage(
    space: &LinkageSpace,
    target: &Target,
    options: &Options,
    samples: Option<usize>,
    interrupt: &AtomicBool,
) -> Result<(Vec<LinkageAnswer>, usize), Error> {
    let search = LinkageSearch::new(space, target, options);
    let samples = samples.unwrap_or_else(|| search.default_samples());
    let (index, curves) = build_index(&search, samples, interrupt)?;
    // Few parameters have few minima.
    let starts = start_count(target, options).min(samples / 10);
    let starts = if search.is_slow() { starts.div_ceil(SLOWER) } else { starts };
    // Many do not satisfy a condition.
    let most = if options.condition.is_some() { 20 * starts } else { starts };
    let candidates = search.most_alike(&index, most);
    drop(index);
    let mut refinements = begin(&search, &candidates, starts, interrupt)?;
    refinements.par_iter_mut().for_each(|refinement| {
        if !is_interrupted(interrupt) {
            search.place(refinement, PLACING_STEPS);
        }
    });
    let rounds = if options.refine { &ROUNDS[..] } else { &[] };
    for &(part, steps) in rounds {
        keep_nearest(&mut refinements, (starts / part).max(2 * options.most));
        advance(&search, &mut refinements, steps, interrupt)?;
    }
    if options.refine {
        restart(&search, &mut refinements, options, starts / 5, target.points().len(), interrupt)?;
    }
    refinements.sort_by(|a, b| a.sum().total_cmp(&b.sum()));
    let fits: Vec<LinkageFit> = refinements.par_iter().filter_map(|refinement| search.fit(refinement)).collect();
    Ok((ranked(fits, space, target, options.most), curves))
}

fn is_interrupted(interrupt: &AtomicBool) -> bool {
    interrupt.load(Ordering::Relaxed)
}

/// Ends a search that is interrupted.
pub(super) fn proceed(interrupt: &AtomicBool) -> Result<(), Error> {
    if is_interrupted(interrupt) { Err(Error::Interrupted) } else { Ok(()) }
}

fn build_index(search: &LinkageSearch, samples: usize, interrupt: &AtomicBool) -> Result<(SampleIndex, usize), Error> {
    let tries = samples * if search.is_slow() { SLOW_TRIES } else { TRIES };
    let piece = (PIECE / search.space().template().curve_count().max(1)).max(1);
    let mut index = SampleIndex::default();
    let mut found = 0;
    for start in (0..tries).step_by(piece) {
        proceed(interrupt)?;
        let numbers = start..(start + piece).min(tries);
        let curves: Vec<Vec<(SampleCurve, SampleShape)>> =
            numbers.into_par_iter().map(|sample| search.curves(sample)).collect();
        for curves in curves {
            if found < samples && index.len() < MAX_CURVES {
                found += usize::from(!curves.is_empty());
                index.extend(curves);
            }
        }
        if found >= samples || index.len() >= MAX_CURVES {
            break;
        }
    }
    let curves = index.len();
    Ok((index, curves))
}

fn start_count(target: &Target, options: &Options) -> usize {
    /// The number of points for which an effort is measured; paths of fewer points have more minima that are not the least.
    const POINTS_OF_EFFORT: usize = 100;
    const MAX_MORE: usize = 4;
    let count = match options.effort {
        Effort::Quick => 100,
        Effort::Normal => 300,
        Effort::Thorough => 1200,
    };
    let count = if target.kind() == PathKind::Closed { count } else { 2 * count };
    count * (POINTS_OF_EFFORT / target.points().len()).clamp(1, MAX_MORE)
}

/// Begins with the likeliest curves that satisfy the condition, as many as are wanted.
fn begin(
    search: &LinkageSearch,
    candidates: &[SampleCurve],
    starts: usize,
    interrupt: &AtomicBool,
) -> Result<Vec<LinkageRefinement>, Error> {
    let mut begun: Vec<LinkageRefinement> = Vec::new();
    for piece in candidates.chunks(64) {
        proceed(interrupt)?;
        let piece: Vec<Option<LinkageRefinement>> = piece.par_iter().map(|curve| search.begin(*curve)).collect();
        begun.extend(piece.into_iter().flatten());
        if begun.len() >= starts {
            break;
        }
    }
    begun.truncate(starts);
    Ok(begun)
}

/// Takes steps of all refinements, and leaves out those whose curves have not the length of the target.
fn advance(
    search: &LinkageSearch,
    refinements: &mut Vec<LinkageRefinement>,
    steps: usize,
    interrupt: &AtomicBool,
) -> Result<(), Error> {
    let is_valid: Vec<bool> = refinements
        .par_iter_mut()
        .map(|refinement| {
            if is_interrupted(interrupt) {
                return false;
            }
            search.advance(refinement, steps);
            search.has_valid_length(refinement)
        })
        .collect();
    proceed(interrupt)?;
    let mut is_valid = is_valid.into_iter();
    refinements.retain(|_| is_valid.next().unwrap_or_default());
    Ok(())
}

/// Keeps the nearest that are not alike.
fn keep_nearest(refinements: &mut Vec<LinkageRefinement>, most: usize) {
    /// Refinements that have found the same linkage differ by less than this.
    const ALIKE: f64 = 1e-6;
    refinements.sort_by(|a, b| a.sum().total_cmp(&b.sum()));
    refinements.dedup_by(|a, b| a.sum() - b.sum() <= ALIKE * b.sum() && a.is_done() && b.is_done());
    refinements.truncate(most.max(1));
}

/// Begins again near the best, in some rounds, as long as that finds something nearer.
fn restart(
    search: &LinkageSearch,
    refinements: &mut Vec<LinkageRefinement>,
    options: &Options,
    count: usize,
    points: usize,
    interrupt: &AtomicBool,
) -> Result<(), Error> {
    /// The rounds, the spreads in turn, and the nearest that are begun from.
    const ROUNDS: u64 = 3;
    const SPREADS: [f64; 3] = [0.1, 0.25, 0.5];
    const NEAREST: usize = 6;
    /// The steps, and those after which it must be near the best.
    const STEPS: usize = 60;
    const PROMISING_STEPS: usize = 16;
    const PROMISING_SUM: f64 = 30.0;
    /// The mean square of the distances at which a target is met to rounding.
    const EXACT: f64 = 1e-16;
    for round in 0..ROUNDS {
        keep_nearest(refinements, refinements.len());
        let Some(best) = refinements.first().map(LinkageRefinement::sum) else { return Ok(()) };
        if best <= EXACT * points as f64 {
            return Ok(());
        }
        let from = &refinements[..NEAREST.min(refinements.len())];
        let begun = |k: usize| {
            if is_interrupted(interrupt) {
                return None;
            }
            let seed =
                options.seed.wrapping_add((round * count as u64 + k as u64 + 1).wrapping_mul(0x5851_F42D_4C95_7F2D));
            let mut refinement = search.begin_near(&from[k % from.len()], seed, SPREADS[k % SPREADS.len()])?;
            search.advance(&mut refinement, PROMISING_STEPS);
            if refinement.sum() > PROMISING_SUM * best {
                return None;
            }
            search.advance(&mut refinement, STEPS - PROMISING_STEPS);
            search.has_valid_length(&refinement).then_some(refinement)
        };
        let found: Vec<Option<LinkageRefinement>> = (0..count).into_par_iter().map(begun).collect();
        refinements.extend(found.into_iter().flatten());
        proceed(interrupt)?;
    }
    Ok(())
}

/// The answers of fits, the nearest first, without those whose curves are the same.
fn ranked(mut fits: Vec<LinkageFit>, space: &LinkageSpace, target: &Target, most: usize) -> Vec<LinkageAnswer> {
    fits.sort_by(|a, b| a.fit.rms.total_cmp(&b.fit.rms));
    distinct(fits.into_iter().filter_map(|fit| answer(fit, space)), |answer| &answer.curve, target, most)
}

fn answer(fit: LinkageFit, space: &LinkageSpace) -> Option<LinkageAnswer> {
    let template = space.template();
    let names = template.parameters.iter().map(|parameter| parameter.name.clone());
    let given: Vec<(String, f64)> = names.zip(fit.values.iter().copied()).collect();
    let family = Family::single_cell(template.clone(), &given, Sampling::Samples(SAMPLES)).ok()?;
    let solved: SolvedCell = Solver::new(&family).measuring(REPORTED).solve(0)?;
    let curve = solved.curves.iter().find(|curve| [curve.trace, curve.circuit] == fit.curve)?;
    let mut curve = PlacedCurve::new(&family, &solved, curve, fit.fit);
    curve.is_scalable = space.is_scalable();
    Some(LinkageAnswer { curve, branch: fit.branch, inputs: fit.inputs, family })
}

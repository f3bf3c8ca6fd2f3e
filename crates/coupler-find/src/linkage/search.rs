//! The search for dimensions: from the curves of samples that are most like the target to the linkages whose curves are nearest to it.

use super::answer::LinkageAnswer;
use super::fitting::{LinkageFit, LinkageFitting};
use super::placed_curve::PlacedCurve;
use super::refinement::LinkageRefinement;
use super::samples::{SampleCurve, SampleIndex, SampleShape};
use super::space::LinkageSpace;
use crate::distinct::distinct;
use crate::options::{Effort, Options};
use crate::target::{PathKind, Target};
use crate::workers::Workers;
use coupler_curves::family::{Family, Sampling};
use coupler_curves::solve::{SolvedCell, Solver};

/// A search for the dimensions of a linkage for which its curve is nearest to a target, in steps. The answers do not depend on how many
/// parts are done at once.
///
/// ```
/// use coupler_curves::catalogue;
/// use coupler_find::{LinkageSearch, LinkageSpace, OneAtATime, Options, Target};
///
/// let at = |k: i32| f64::from(6 * k).to_radians();
/// let points: Vec<_> = (0..60).map(at).map(|t| [2.0 * t.cos(), 0.8 * t.sin()].into()).collect();
/// let target = Target::closed(&points).unwrap();
/// let space = LinkageSpace::new(catalogue::find("slider-crank").unwrap(), &[]).unwrap();
/// let mut search = LinkageSearch::new(&space, &target, &Options::default(), Some(200));
/// while search.step(&OneAtATime) {}
/// println!("{:.4} of the path's size", search.answers(&OneAtATime)[0].curve.fit.deviation.rms_relative);
/// ```
pub struct LinkageSearch {
    fitting: LinkageFitting,
    options: Options,
    /// The parameter sets that are wanted, and those that are found to have a curve.
    samples: usize,
    found: usize,
    index: SampleIndex,
    curves: usize,
    starts: usize,
    refinements: Vec<LinkageRefinement>,
    stage: Stage,
}

/// What the next step does.
enum Stage {
    /// Takes samples, from a number on.
    Sample {
        next: usize,
    },
    /// Begins with the curves that are most like the target.
    Begin {
        candidates: Vec<SampleCurve>,
        next: usize,
    },
    /// Places the curves of refinements, from one on.
    Place {
        next: usize,
    },
    /// Refines them in a round; in the last place those that have been.
    Refine {
        round: usize,
        next: usize,
        refined: Vec<LinkageRefinement>,
    },
    /// Begins again near the best in a round.
    Restart {
        round: u64,
        next: usize,
        from: Vec<LinkageRefinement>,
        best: f64,
    },
    Done,
}

/// The most curves of all parameter sets together.
const MAX_CURVES: usize = 8_000_000;

/// Linkages whose circuits are found slowly have so many times fewer starts.
const SLOWER: usize = 3;

/// The curves that are found in a step at most, and how many parameter sets are tried for each that is wanted: others cannot be assembled, or
/// their input does not turn.
const CURVES_PER_STEP: usize = 1024;
const TRIES: usize = 8;
const SLOW_TRIES: usize = 2;

/// The curves with which refinements are begun in a step at most.
const BEGUN_PER_STEP: usize = 64;

/// The parts of the starts that are refined in each round, and the steps of a round.
const ROUNDS: [(usize, usize); 4] = [(2, 6), (4, 12), (8, 40), (20, 150)];

/// The steps in which the curves are placed before.
const PLACING_STEPS: usize = 6;

/// The rounds of restarts, the part of the starts in each, and the nearest that are begun from.
const RESTART_ROUNDS: u64 = 3;
const RESTART_PART: usize = 5;
const NEAREST: usize = 6;

/// The samples of a circuit of an answer, as a family has them.
const SAMPLES: usize = 360;

impl LinkageSearch {
    /// The most parameter sets in which a path is looked up.
    pub const MAX_SAMPLES: usize = 1_000_000;

    /// Begins a search in a number of parameter sets, or in one that depends on the linkage. The condition of the options must be one of
    /// the linkage's.
    pub fn new(space: &LinkageSpace, target: &Target, options: &Options, samples: Option<usize>) -> LinkageSearch {
        let fitting = LinkageFitting::new(space, target, options);
        let samples = samples.unwrap_or_else(|| fitting.sampled.default_count()).min(LinkageSearch::MAX_SAMPLES);
        // Few parameters have few minima.
        let starts = start_count(target, options).min(samples / 10);
        LinkageSearch {
            starts: if fitting.sampled.is_slow() { starts.div_ceil(SLOWER) } else { starts },
            options: options.clone(),
            samples,
            found: 0,
            index: SampleIndex::default(),
            curves: 0,
            refinements: Vec::new(),
            stage: Stage::Sample { next: 0 },
            fitting,
        }
    }

    /// Takes a step, of some milliseconds for each part; false if nothing is left to do.
    pub fn step(&mut self, workers: &impl Workers) -> bool {
        self.stage = match std::mem::replace(&mut self.stage, Stage::Done) {
            Stage::Sample { next } => self.sample(next, workers),
            Stage::Begin { candidates, next } => self.begin(candidates, next, workers),
            Stage::Place { next } => self.place(next, workers),
            Stage::Refine { round, next, refined } => self.refine(round, next, refined, workers),
            Stage::Restart { round, next, from, best } => self.restart((round, next), from, best, workers),
            Stage::Done => Stage::Done,
        };
        !matches!(self.stage, Stage::Done)
    }

    /// About which part of the search is done, from 0 to 1. It may end sooner.
    pub fn part_done(&self) -> f64 {
        /// Where the stages begin: of linkages whose circuits are found slowly, most of the time goes to samples and the last.
        const STAGES: [f64; 6] = [0.0, 0.4, 0.5, 0.55, 0.8, 1.0];
        let part = |done: usize, of: usize| done as f64 / of.max(1) as f64;
        let (stage, within) = match &self.stage {
            Stage::Sample { next } => (0, part(self.found, self.samples).max(part(*next, self.tries()))),
            Stage::Begin { candidates, next } => {
                (1, part(*next, candidates.len()).max(part(self.refinements.len(), self.starts)))
            }
            Stage::Place { next } => (2, part(*next, self.refinements.len())),
            Stage::Refine { round, next, .. } => {
                (3, (*round as f64 + part(*next, self.refinements.len())) / ROUNDS.len() as f64)
            }
            Stage::Restart { round, next, .. } => {
                (4, (*round as f64 + part(*next, self.starts / RESTART_PART)) / RESTART_ROUNDS as f64)
            }
            Stage::Done => return 1.0,
        };
        let [from, to] = [STAGES[stage], STAGES[stage + 1]];
        from + (to - from) * within.min(1.0)
    }

    /// How many parameter sets are tried at most.
    fn tries(&self) -> usize {
        self.samples * if self.fitting.sampled.is_slow() { SLOW_TRIES } else { TRIES }
    }

    /// The number of curves in which the target has been looked up.
    pub fn curve_count(&self) -> usize {
        self.curves
    }

    /// The answers that have been found so far, the nearest first. Those whose curves are the same to a thousandth of the target's size are one.
    pub fn answers(&self, workers: &impl Workers) -> Vec<LinkageAnswer> {
        let mut refinements: Vec<&LinkageRefinement> = self.refinements.iter().collect();
        refinements.sort_by(|a, b| a.sum().total_cmp(&b.sum()));
        let fits = workers.map(refinements, |refinement| self.fitting.fit(refinement));
        let mut fits: Vec<LinkageFit> = fits.into_iter().flatten().collect();
        fits.sort_by(|a, b| a.fit.deviation.rms.total_cmp(&b.fit.deviation.rms));
        let answers = fits.into_iter().filter_map(|fit| answer(fit, self.fitting.space()));
        distinct(answers, |answer| &answer.curve.outline, self.fitting.target().size(), self.options.most)
    }

    fn sample(&mut self, next: usize, workers: &impl Workers) -> Stage {
        let tries = self.tries();
        if next < tries && self.found < self.samples && self.index.len() < MAX_CURVES {
            let most = (CURVES_PER_STEP / self.fitting.space().template().curve_count().max(1)).max(1);
            let end = (next + most.min(workers.most_at_once())).min(tries);
            let curves: Vec<Vec<(SampleCurve, SampleShape)>> =
                workers.map((next..end).collect(), |sample| self.fitting.curves(sample));
            for curves in curves {
                if self.found < self.samples && self.index.len() < MAX_CURVES {
                    self.found += usize::from(!curves.is_empty());
                    self.index.extend(curves);
                }
            }
            return Stage::Sample { next: end };
        }
        // Many do not satisfy a condition.
        let most = if self.options.condition.is_some() { 20 * self.starts } else { self.starts };
        let index = std::mem::take(&mut self.index);
        self.curves = index.len();
        Stage::Begin { candidates: self.fitting.most_alike(&index, most), next: 0 }
    }

    /// Begins with the likeliest curves that satisfy the condition, as many as are wanted.
    fn begin(&mut self, candidates: Vec<SampleCurve>, next: usize, workers: &impl Workers) -> Stage {
        if next == candidates.len() || self.refinements.len() >= self.starts {
            self.refinements.truncate(self.starts);
            return Stage::Place { next: 0 };
        }
        let end = (next + BEGUN_PER_STEP.min(workers.most_at_once())).min(candidates.len());
        let begun = workers.map(candidates[next..end].to_vec(), |curve| self.fitting.begin(curve));
        self.refinements.extend(begun.into_iter().flatten());
        Stage::Begin { candidates, next: end }
    }

    fn place(&mut self, next: usize, workers: &impl Workers) -> Stage {
        if next == self.refinements.len() {
            return if self.options.refine { self.next_round(0) } else { Stage::Done };
        }
        let end = self.refinements.len().min(next.saturating_add(workers.most_at_once()));
        let placed = workers.map(self.refinements.drain(next..end).collect(), |mut refinement: LinkageRefinement| {
            self.fitting.place(&mut refinement, PLACING_STEPS);
            refinement
        });
        self.refinements.splice(next..next, placed);
        Stage::Place { next: end.min(self.refinements.len()) }
    }

    fn next_round(&mut self, round: usize) -> Stage {
        match ROUNDS.get(round) {
            Some((part, _)) => {
                keep_nearest(&mut self.refinements, (self.starts / part).max(2 * self.options.most));
                Stage::Refine { round, next: 0, refined: Vec::new() }
            }
            None => self.next_restart(0),
        }
    }

    /// Takes steps of refinements, and leaves out those whose curves have not the length of the target.
    fn refine(
        &mut self,
        round: usize,
        next: usize,
        mut refined: Vec<LinkageRefinement>,
        workers: &impl Workers,
    ) -> Stage {
        if next == self.refinements.len() {
            self.refinements = refined;
            return self.next_round(round + 1);
        }
        let end = self.refinements.len().min(next.saturating_add(workers.most_at_once()));
        let (_, steps) = ROUNDS[round];
        let advanced = workers.map(self.refinements[next..end].to_vec(), |mut refinement| {
            self.fitting.advance(&mut refinement, steps);
            self.fitting.has_valid_length(&refinement).then_some(refinement)
        });
        refined.extend(advanced.into_iter().flatten());
        Stage::Refine { round, next: end, refined }
    }

    /// Begins again near the best, as long as that finds something nearer.
    fn next_restart(&mut self, round: u64) -> Stage {
        /// The mean square of the distances at which a target is met to rounding.
        const EXACT: f64 = 1e-16;
        let count = self.refinements.len();
        keep_nearest(&mut self.refinements, count);
        match self.refinements.first().map(LinkageRefinement::sum) {
            Some(best) if round < RESTART_ROUNDS && best > EXACT * self.fitting.target().points().len() as f64 => {
                let from = self.refinements.iter().take(NEAREST).cloned().collect();
                Stage::Restart { round, next: 0, from, best }
            }
            _ => Stage::Done,
        }
    }

    fn restart(
        &mut self,
        (round, next): (u64, usize),
        from: Vec<LinkageRefinement>,
        best: f64,
        workers: &impl Workers,
    ) -> Stage {
        /// The spreads in turn.
        const SPREADS: [f64; 3] = [0.1, 0.25, 0.5];
        /// The steps, and those after which it must be near the best.
        const STEPS: usize = 60;
        const PROMISING_STEPS: usize = 16;
        const PROMISING_SUM: f64 = 30.0;
        let count = self.starts / RESTART_PART;
        if next == count {
            return self.next_restart(round + 1);
        }
        let begun = |k: usize| {
            let number = round * count as u64 + k as u64 + 1;
            let seed = self.options.seed.wrapping_add(number.wrapping_mul(0x5851_F42D_4C95_7F2D));
            let mut refinement = self.fitting.begin_near(&from[k % from.len()], seed, SPREADS[k % SPREADS.len()])?;
            self.fitting.advance(&mut refinement, PROMISING_STEPS);
            if refinement.sum() > PROMISING_SUM * best {
                return None;
            }
            self.fitting.advance(&mut refinement, STEPS - PROMISING_STEPS);
            self.fitting.has_valid_length(&refinement).then_some(refinement)
        };
        let end = count.min(next.saturating_add(workers.most_at_once()));
        let found = workers.map((next..end).collect(), begun);
        self.refinements.extend(found.into_iter().flatten());
        Stage::Restart { round, next: end, from, best }
    }
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

/// Keeps the nearest that are not alike.
fn keep_nearest(refinements: &mut Vec<LinkageRefinement>, most: usize) {
    /// Refinements that have found the same linkage differ by less than this.
    const ALIKE: f64 = 1e-6;
    refinements.sort_by(|a, b| a.sum().total_cmp(&b.sum()));
    refinements.dedup_by(|a, b| a.sum() - b.sum() <= ALIKE * b.sum() && a.is_done() && b.is_done());
    refinements.truncate(most.max(1));
}

fn answer(fit: LinkageFit, space: &LinkageSpace) -> Option<LinkageAnswer> {
    let template = space.template();
    let names = template.parameters.iter().map(|parameter| parameter.name.clone());
    let given: Vec<(String, f64)> = names.zip(fit.values.iter().copied()).collect();
    let family = Family::single_cell(template.clone(), &given, Sampling::Samples(SAMPLES)).ok()?;
    let solved: SolvedCell = Solver::new(&family).measuring(PlacedCurve::MEASURES).solve(0)?;
    let curve = solved.curves.iter().find(|curve| [curve.trace, curve.circuit] == fit.curve)?;
    let mut curve = PlacedCurve::new(&family, &solved, curve, fit.fit);
    curve.is_scalable = space.is_scalable();
    Some(LinkageAnswer { curve, branch: fit.branch, inputs: fit.inputs, family })
}

//! The search for dimensions: from the curves of samples that are most like the target to the linkages whose curves are nearest to it.

use super::answer::LinkageAnswer;
use super::fitting::{LinkageFit, LinkageFitting};
use super::index::LinkageIndex;
use super::placed_curve::PlacedCurve;
use super::ranking::ranked;
use super::refinements::{Refinement, keep_nearest};
use super::restarts::Restarts;
use super::samples::{SampleCurve, SampleIndex, SampleShape};
use super::space::LinkageSpace;
use crate::distinct::distinct;
use crate::options::{Effort, Options};
use crate::target::{PathKind, Target};
use crate::workers::Workers;
use coupler_curves::family::{Family, Sampling};
use coupler_curves::geometry::{Complex, Similarity};
use coupler_curves::linkage::{FourBar, PlacedFourBar};
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
    target: Target,
    /// One for each linkage; at least one.
    fittings: Vec<LinkageFitting>,
    options: Options,
    /// The parameter sets of each linkage that are wanted, and those of the present one that are found to have a curve.
    samples: Vec<usize>,
    found: usize,
    index: SampleIndex,
    curves: usize,
    starts: usize,
    refinements: Vec<Refinement>,
    stage: Stage,
}

/// What the next step does.
enum Stage {
    /// Takes samples of a linkage, from a number on.
    Sample {
        linkage: usize,
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
        refined: Vec<Refinement>,
    },
    /// Begins again near the best in a round.
    Restart {
        round: u64,
        next: usize,
        from: Vec<Refinement>,
        best: f64,
        /// The rounds since one has found something nearer.
        fruitless: u64,
    },
    Done,
}

/// Which of several linkages are searched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Searched {
    /// All of them.
    All,
    /// Those with transmission angles, none of which is less than this, in degrees.
    Transmitting(f64),
    /// Those without: linkages with a group.
    Groups,
}

/// Of several linkages, the nearest that are ranked.
const MOST_RANKED: usize = 150;

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

/// The samples of a circuit of an answer, as a family has them.
const SAMPLES: usize = 360;

impl LinkageSearch {
    /// The most parameter sets in which a path is looked up.
    pub const MAX_SAMPLES: usize = 1_000_000;

    /// Begins a search in a number of parameter sets, or in one that depends on the linkage. The condition of the options must be one of
    /// the linkage's.
    pub fn new(space: &LinkageSpace, target: &Target, options: &Options, samples: Option<usize>) -> LinkageSearch {
        let fitting = LinkageFitting::new(0, space, target, options);
        let samples = samples.unwrap_or_else(|| fitting.sampled.default_count()).min(LinkageSearch::MAX_SAMPLES);
        // Few parameters have few minima.
        let starts = start_count(target, options).min(samples / 10);
        let starts = if fitting.sampled.is_slow() { starts.div_ceil(SLOWER) } else { starts };
        LinkageSearch::with(vec![fitting], vec![samples], starts, target, options)
    }

    /// Begins a search among several linkages, whose refinements all compete. The condition of the options may be one of several of them, and those that it
    /// does not apply to are left out. Curves are those of an index, of a path without angles, and of `samples` parameter sets of each linkage that it does not
    /// have. If `least_mu_deg` is not 0, all have transmission angles, and none is less.
    pub fn among(
        spaces: &[LinkageSpace],
        index: Option<&LinkageIndex>,
        (target, options): (&Target, &Options),
        samples: usize,
        searched: Searched,
    ) -> LinkageSearch {
        let applies = |space: &LinkageSpace| {
            let meets = options.condition.as_ref().is_none_or(|condition| condition.on(&space.template().id).is_some());
            meets && (searched == Searched::All || (searched == Searched::Groups) == space.is_group())
        };
        let least_mu_deg = if let Searched::Transmitting(least_deg) = searched { least_deg } else { 0.0 };
        let index = index.filter(|_| target.angles_deg().is_none());
        let has = |space: usize| index.is_some_and(|index| space < index.linkage_count());
        let kept: Vec<usize> = (0..spaces.len()).filter(|space| applies(&spaces[*space])).collect();
        let begin = |(number, space): (usize, &usize)| {
            LinkageFitting::new(number, &spaces[*space], target, options).beginning_roughly(least_mu_deg)
        };
        let fittings: Vec<LinkageFitting> = kept.iter().enumerate().map(begin).collect();
        let wanted = |(space, fitting): (&usize, &LinkageFitting)| {
            let own = fitting.sampled.default_count().min(samples).min(LinkageSearch::MAX_SAMPLES);
            if has(*space) { 0 } else { own }
        };
        let samples = kept.iter().zip(&fittings).map(wanted).collect();
        let starts = start_count(target, options);
        let mut search = LinkageSearch::with(fittings, samples, starts, target, options);
        if let Some(index) = index {
            let number_of = |space: usize| kept.iter().position(|kept| *kept == space);
            let curves: Vec<(SampleCurve, SampleShape)> = index
                .curves()
                .filter_map(|(curve, shape)| {
                    let linkage = number_of(curve.linkage as usize)?;
                    let trace = search.fittings[linkage].space().trace.unwrap_or(0);
                    let [linkage, trace] = [linkage, trace].map(|number| number as u32);
                    Some((SampleCurve { linkage, trace, ..curve }, SampleShape::Free(shape)))
                })
                .collect();
            search.index.extend(curves);
        }
        search
    }

    fn with(
        fittings: Vec<LinkageFitting>,
        samples: Vec<usize>,
        starts: usize,
        target: &Target,
        options: &Options,
    ) -> LinkageSearch {
        LinkageSearch {
            target: target.clone(),
            fittings,
            options: options.clone(),
            samples,
            found: 0,
            index: SampleIndex::default(),
            curves: 0,
            starts,
            refinements: Vec::new(),
            stage: Stage::Sample { linkage: 0, next: 0 },
        }
    }

    /// Begins, besides, with a four-bar that another search has found, if the catalogue's is among the linkages.
    pub fn add_four_bar(&mut self, four_bar: &PlacedFourBar) {
        let is_four_bar = |fitting: &LinkageFitting| fitting.space().template().id == "four-bar";
        let Some(linkage) = self.fittings.iter().position(is_four_bar) else { return };
        let FourBar { frame, crank, coupler, rocker } = four_bar.lengths;
        let at = four_bar.coupler_point;
        let [from, to] = four_bar.pivots.map(|pivot| Complex::new(pivot.x, pivot.y));
        // With the rocker pin on either side at first.
        let begun = [false, true].into_iter().filter_map(|is_mirrored| {
            let own = Similarity { is_mirrored, factor: (to - from) / frame, shift: from };
            let placed = self.target.placement().inverse().after(&own);
            let across = if is_mirrored { -at.y } else { at.y };
            self.fittings[linkage].begin_at(&[frame, crank, coupler, rocker, at.x, across], placed)
        });
        let nearest = begun.min_by(|a, b| a.mean_square().total_cmp(&b.mean_square()));
        self.refinements.extend(nearest.map(|own| Refinement { linkage, own }));
    }

    /// Takes a step, of some milliseconds for each part; false if nothing is left to do.
    pub fn step(&mut self, workers: &impl Workers) -> bool {
        self.stage = match std::mem::replace(&mut self.stage, Stage::Done) {
            Stage::Sample { linkage, next } => self.sample((linkage, next), workers),
            Stage::Begin { candidates, next } => self.begin(candidates, next, workers),
            Stage::Place { next } => self.place(next, workers),
            Stage::Refine { round, next, refined } => self.refine(round, next, refined, workers),
            Stage::Restart { round, next, from, best, fruitless } => {
                self.restart((round, next), from, (best, fruitless), workers)
            }
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
            Stage::Sample { linkage, next } => {
                let within = match self.samples.get(*linkage) {
                    Some(samples) => part(self.found, *samples).max(part(*next, self.tries(*linkage))),
                    None => 0.0,
                };
                (0, (*linkage as f64 + within) / self.samples.len() as f64)
            }
            Stage::Begin { candidates, next } => {
                (1, part(*next, candidates.len()).max(part(self.refinements.len(), self.starts)))
            }
            Stage::Place { next } => (2, part(*next, self.refinements.len())),
            Stage::Refine { round, next, .. } => {
                (3, (*round as f64 + part(*next, self.refinements.len())) / ROUNDS.len() as f64)
            }
            Stage::Restart { round, next, .. } => {
                let restarts = self.restarts();
                (4, (*round as f64 + part(*next, restarts.count)) / restarts.rounds as f64)
            }
            Stage::Done => return 1.0,
        };
        let [from, to] = [STAGES[stage], STAGES[stage + 1]];
        from + (to - from) * within.min(1.0)
    }

    /// How many parameter sets of a linkage are tried at most.
    fn tries(&self, linkage: usize) -> usize {
        self.samples[linkage] * if self.fittings[linkage].sampled.is_slow() { SLOW_TRIES } else { TRIES }
    }

    fn fitting(&self, refinement: &Refinement) -> &LinkageFitting {
        &self.fittings[refinement.linkage]
    }

    /// The number of curves in which the target has been looked up.
    pub fn curve_count(&self) -> usize {
        self.curves
    }

    /// The answers that have been found so far, the nearest first. Those whose curves are the same to a thousandth of the target's size are one.
    pub fn answers(&self, workers: &impl Workers) -> Vec<LinkageAnswer> {
        let mut refinements: Vec<&Refinement> = self.refinements.iter().collect();
        refinements.sort_by(|a, b| a.own.mean_square().total_cmp(&b.own.mean_square()));
        let fit = |refinement: &Refinement| Some((refinement.linkage, self.fitting(refinement).fit(&refinement.own)?));
        let fits = workers.map(refinements, fit);
        let mut fits: Vec<(usize, LinkageFit)> = fits.into_iter().flatten().collect();
        fits.sort_by(|a, b| a.1.fit.deviation.rms.total_cmp(&b.1.fit.deviation.rms));
        let answer = |(linkage, fit): (usize, LinkageFit)| answer(fit, self.fittings[linkage].space());
        let size = self.target.size();
        if self.fittings.len() == 1 {
            return distinct(
                fits.into_iter().filter_map(answer),
                |answer| &answer.curve.outline,
                size,
                self.options.most,
            );
        }
        fits.truncate(MOST_RANKED.max(self.options.most));
        let answers: Vec<LinkageAnswer> = workers.map(fits, answer).into_iter().flatten().collect();
        ranked(answers, size, self.options.most)
    }

    fn sample(&mut self, (linkage, next): (usize, usize), workers: &impl Workers) -> Stage {
        if linkage < self.fittings.len() {
            let (tries, samples) = (self.tries(linkage), self.samples[linkage]);
            if next >= tries || self.found >= samples || self.index.len() >= MAX_CURVES {
                self.found = 0;
                return Stage::Sample { linkage: linkage + 1, next: 0 };
            }
            let fitting = &self.fittings[linkage];
            let most = (CURVES_PER_STEP / fitting.space().template().curve_count().max(1)).max(1);
            let end = (next + most.min(workers.most_at_once())).min(tries);
            let curves: Vec<Vec<(SampleCurve, SampleShape)>> =
                workers.map((next..end).collect(), |sample| fitting.curves(sample));
            for curves in curves {
                if self.found < samples && self.index.len() < MAX_CURVES {
                    self.found += usize::from(!curves.is_empty());
                    self.index.extend(curves);
                }
            }
            return Stage::Sample { linkage, next: end };
        }
        // Many do not satisfy a condition.
        let most = if self.options.condition.is_some() { 20 * self.starts } else { self.starts };
        let index = std::mem::take(&mut self.index);
        self.curves = index.len();
        let candidates = self.fittings.first().map(|fitting| fitting.most_alike(&index, most));
        Stage::Begin { candidates: candidates.unwrap_or_default(), next: 0 }
    }

    /// Begins with the likeliest curves that satisfy the condition, as many as are wanted.
    fn begin(&mut self, candidates: Vec<SampleCurve>, next: usize, workers: &impl Workers) -> Stage {
        if next == candidates.len() || self.refinements.len() >= self.starts {
            self.refinements.truncate(self.starts);
            return Stage::Place { next: 0 };
        }
        let end = (next + BEGUN_PER_STEP.min(workers.most_at_once())).min(candidates.len());
        let begin = |curve: SampleCurve| {
            let linkage = curve.linkage as usize;
            Some(Refinement { linkage, own: self.fittings[linkage].begin(curve)? })
        };
        let begun = workers.map(candidates[next..end].to_vec(), begin);
        self.refinements.extend(begun.into_iter().flatten());
        Stage::Begin { candidates, next: end }
    }

    fn place(&mut self, next: usize, workers: &impl Workers) -> Stage {
        if next == self.refinements.len() {
            return if self.options.refine { self.next_round(0) } else { Stage::Done };
        }
        let end = self.refinements.len().min(next.saturating_add(workers.most_at_once()));
        let fittings = &self.fittings;
        let placed = workers.map(self.refinements.drain(next..end).collect(), |mut refinement: Refinement| {
            fittings[refinement.linkage].place(&mut refinement.own, PLACING_STEPS);
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
            None => self.next_restart(0, (f64::INFINITY, 0)),
        }
    }

    /// Takes steps of refinements, and leaves out those whose curves have not the length of the target.
    fn refine(&mut self, round: usize, next: usize, mut refined: Vec<Refinement>, workers: &impl Workers) -> Stage {
        if next == self.refinements.len() {
            self.refinements = refined;
            return self.next_round(round + 1);
        }
        let end = self.refinements.len().min(next.saturating_add(workers.most_at_once()));
        let (_, steps) = ROUNDS[round];
        let advanced = workers.map(self.refinements[next..end].to_vec(), |mut refinement| {
            let fitting = &self.fittings[refinement.linkage];
            if round + 1 == ROUNDS.len() {
                refinement.own = fitting.on_all_points(refinement.own)?;
            }
            fitting.advance(&mut refinement.own, steps);
            fitting.has_valid_length(&refinement.own).then_some(refinement)
        });
        refined.extend(advanced.into_iter().flatten());
        Stage::Refine { round, next: end, refined }
    }

    /// Begins again near the best, as long as that finds something nearer than it was, now and then.
    fn next_restart(&mut self, round: u64, (before, fruitless): (f64, u64)) -> Stage {
        /// The mean square of the distances at which a target is met to rounding.
        const EXACT: f64 = 1e-16;
        /// Nearer is a smaller mean square, by this factor at most.
        const NEARER: f64 = 0.97;
        let restarts = self.restarts();
        let count = self.refinements.len();
        keep_nearest(&mut self.refinements, count);
        match self.refinements.first().map(|refinement| refinement.own.mean_square()) {
            Some(best) if round < restarts.rounds && best > EXACT => {
                let fruitless = if best <= NEARER * before { 0 } else { fruitless + 1 };
                if fruitless >= restarts.patience {
                    return Stage::Done;
                }
                Stage::Restart { round, next: 0, from: restarts.nearest(&self.refinements), best, fruitless }
            }
            _ => Stage::Done,
        }
    }

    fn restarts(&self) -> Restarts {
        Restarts::of(self.fittings.len(), self.starts)
    }

    fn restart(
        &mut self,
        (round, next): (u64, usize),
        from: Vec<Refinement>,
        (best, fruitless): (f64, u64),
        workers: &impl Workers,
    ) -> Stage {
        let restarts = self.restarts();
        if next == restarts.count {
            return self.next_restart(round + 1, (best, fruitless));
        }
        let begun = |k: usize| restarts.begun((round, k), self.options.seed, &from, &self.fittings, best);
        let end = restarts.count.min(next.saturating_add(workers.most_at_once()));
        let found = workers.map((next..end).collect(), begun);
        self.refinements.extend(found.into_iter().flatten());
        Stage::Restart { round, next: end, from, best, fruitless }
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

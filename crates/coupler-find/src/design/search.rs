//! The search for the dimensions that meet wishes, in steps.

use super::answer::{DesignAnswer, DesignMiss};
use super::assessment::Assessment;
use super::idle::idle_axes;
use super::measured::Meter;
use super::merit::{Objective, Units};
use super::polish::{Measuring, Polished};
use super::run::Run;
use super::sample::{Sample, Sampling};
use super::space::DesignSpace;
use super::wish::{Direction, Wishes};
use crate::even_sequence::EvenSequence;
use crate::options::Effort;
use crate::workers::Workers;

/// How a search goes.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignOptions {
    /// The greatest number of answers.
    pub most: usize,
    /// How much is tried.
    pub effort: Effort,
    /// A number that changes what is tried.
    pub seed: u64,
}

impl Default for DesignOptions {
    fn default() -> DesignOptions {
        DesignOptions { most: 5, effort: Effort::Normal, seed: 0 }
    }
}

/// A search for the dimensions of a linkage that meet wishes, in steps. What it finds does not depend on how many parts are done at once.
///
/// ```
/// use coupler_curves::catalogue;
/// use coupler_find::{DesignOptions, DesignSearch, DesignSpace, Direction, Effort, OneAtATime, Wishes};
///
/// let slider_crank = catalogue::find("slider-crank").unwrap();
/// let space = DesignSpace::new(slider_crank.clone(), &[], &[]).unwrap();
/// let wishes = Wishes::new(&slider_crank, Some("time_ratio == 1.25 and output_stroke == 100"), &[], f64::INFINITY).unwrap();
/// let options = DesignOptions { effort: Effort::Quick, ..DesignOptions::default() };
/// let mut search = DesignSearch::new(space, wishes, options);
/// while search.step(&OneAtATime) {}
/// let answers = search.answers(&OneAtATime);
/// assert!((answers[0].wishes[1].value.as_ref().unwrap().1 - 100.0).abs() < 1e-6);
/// ```
pub struct DesignSearch {
    meter: Meter,
    options: DesignOptions,
    units: Units,
    /// The best samples, with how good they are.
    samples: Vec<Sample>,
    runs: Vec<Run>,
    found: Vec<Polished>,
    /// The linkages that come nearest without one of the wishes, by its number.
    misses: Vec<(usize, Polished)>,
    stage: Stage,
}

/// What the next step does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// Measures samples, from a number on.
    Sample {
        next: usize,
    },
    /// Meets the wishes from the best samples.
    Meet,
    /// Runs the strategy for goals, in a round.
    Evolve {
        round: usize,
        slice: usize,
    },
    /// Runs it for what comes nearest without one of the wishes.
    Relax {
        round: usize,
        slice: usize,
    },
    Done,
}

/// The samples in a step, and those that are remembered.
const BATCH: usize = 512;
const KEPT: usize = 300;

/// The generations of each run in a step.
const SLICE: usize = 20;
const MAX_SLICES: usize = 500;

/// The standard deviations of the first places around a start: in the first round, and around what has been found.
const WIDE: f64 = 0.15;
const CLOSE: f64 = 0.04;

/// The numbers of runs after the first ones, by which their random numbers differ.
const FURTHER: usize = 100;

impl DesignSearch {
    /// Begins a search. The wishes must be those of the space's linkage.
    pub fn new(space: DesignSpace, wishes: Wishes, options: DesignOptions) -> DesignSearch {
        let units = Units::plain(&wishes);
        let mut meter = Meter::new(space, wishes);
        if meter.space.is_scaled && !meter.depends_on_size() {
            meter = Meter::new(meter.space.of_default_size(), meter.wishes);
        }
        let idle = idle_axes(&meter);
        if idle.len() < meter.space.axes.len() {
            meter = Meter::new(meter.space.without(&idle), meter.wishes);
        }
        DesignSearch {
            meter,
            options,
            units,
            samples: Vec::new(),
            runs: Vec::new(),
            found: Vec::new(),
            misses: Vec::new(),
            stage: Stage::Sample { next: 0 },
        }
    }

    /// What is searched.
    pub fn space(&self) -> &DesignSpace {
        &self.meter.space
    }

    /// What is wished.
    pub fn wishes(&self) -> &Wishes {
        &self.meter.wishes
    }

    /// Whether any sample could be assembled.
    pub fn is_any_assembled(&self) -> bool {
        !self.samples.is_empty()
    }

    /// Whether nothing holds the size of the linkages, and the best would be smaller or greater without end.
    pub fn is_size_unbounded(&self) -> bool {
        self.found.iter().any(|polished| self.meter.space.is_size_at_its_end(&polished.place))
    }

    /// Takes a step; false if nothing is left to do.
    pub fn step(&mut self, workers: &impl Workers) -> bool {
        self.stage = match self.stage {
            Stage::Sample { next } => self.sample(next, workers),
            Stage::Meet => self.meet(workers),
            Stage::Evolve { round, slice } => self.evolve(round, slice, workers),
            Stage::Relax { round, slice } => self.relax(round, slice, workers),
            Stage::Done => Stage::Done,
        };
        self.stage != Stage::Done
    }

    /// About which part of the search is done, from 0 to 1. It may end sooner.
    pub fn part_done(&self) -> f64 {
        let slices = |slice: usize| (slice as f64 / self.slices() as f64).min(1.0);
        match self.stage {
            Stage::Sample { next } => 0.2 * next as f64 / self.sample_count() as f64,
            Stage::Meet => 0.2,
            Stage::Evolve { round, slice } => 0.2 + 0.6 * (round as f64 + slices(slice)) / 2.0,
            Stage::Relax { round, slice } => 0.8 + 0.2 * (round as f64 + slices(slice)) / 2.0,
            Stage::Done => 1.0,
        }
        .min(1.0)
    }

    /// About how many slices there are in a round.
    fn slices(&self) -> usize {
        5 + 3 * self.meter.space.dimension()
    }

    /// Whether all circuits of the linkage take long to find.
    fn is_slow(&self) -> bool {
        self.meter.space.template().structure().is_ok_and(|linkage| linkage.dyad_count() > 1)
    }

    fn effort(&self) -> f64 {
        match self.options.effort {
            Effort::Quick => 0.3,
            Effort::Normal => 1.0,
            Effort::Thorough => 4.0,
        }
    }

    /// How many samples are measured: fewer of linkages whose circuits or measures take long, or that trace many joints.
    fn sample_count(&self) -> usize {
        let dimension = self.meter.space.axes.len().max(1);
        let (each, [least, most]) = match (self.is_slow(), self.meter.is_of_paths()) {
            (true, _) => (100, [1000, 8000]),
            (false, true) => (300, [2000, 10_000]),
            (false, false) => (1500, [4000, 40_000]),
        };
        let count = (each * dimension * dimension).clamp(least, most);
        let curves = self.meter.space.template().curve_count().max(1);
        (self.effort() * count as f64 / (curves as f64).sqrt()) as usize
    }

    /// The generations of a run that meets the wishes at each place.
    fn projected_generations(&self) -> usize {
        let each = if self.is_slow() || self.meter.is_of_paths() { 4 } else { 30 };
        (self.effort() * (each * self.meter.space.dimension()) as f64) as usize
    }

    fn start_count(&self) -> usize {
        let count = if self.is_slow() || self.meter.is_of_paths() { 6.0 } else { 16.0 };
        ((self.effort() * count) as usize).max(4)
    }

    fn sample(&mut self, next: usize, workers: &impl Workers) -> Stage {
        let end = (next + BATCH).min(self.sample_count());
        let worst = self.samples.get(KEPT - 1).map_or(f64::INFINITY, |sample| sample.merit);
        let has_goals = !self.meter.wishes.goals.is_empty();
        // Of samples without goals those that are worse than all kept ones need not be measured to the end.
        let most = if has_goals { f64::INFINITY } else { worst * worst };
        let measured = workers.map((next..end).collect(), |number| self.sampling().sampled(number, most));
        self.samples.extend(measured.into_iter().flatten());
        if next == 0 {
            let all: Vec<Assessment> = self.samples.iter().map(|sample| sample.assessment.clone()).collect();
            self.units = Units::of_samples(&self.meter.wishes, &all);
            for k in 0..self.samples.len() {
                self.samples[k].merit = self.sampling().merit(&self.samples[k].assessment);
            }
        }
        self.samples.sort_by(|a, b| a.merit.total_cmp(&b.merit));
        self.samples.truncate(KEPT);
        if end < self.sample_count() { Stage::Sample { next: end } } else { Stage::Meet }
    }

    fn sampling(&self) -> Sampling<'_> {
        Sampling { meter: &self.meter, units: &self.units }
    }

    fn measuring<'a>(&'a self, objective: &'a Objective) -> Measuring<'a> {
        Measuring { meter: &self.meter, units: &self.units, objective }
    }

    /// The best samples that are not alike.
    fn starts(&self, count: usize) -> Vec<Vec<f64>> {
        /// The least distance of places, in parts of the ranges.
        const APART: f64 = 0.08;
        let mut starts: Vec<Vec<f64>> = Vec::new();
        for Sample { place, .. } in &self.samples {
            if starts.len() < count && starts.iter().all(|other| distance(other, place) > APART) {
                starts.push(place.clone());
            }
        }
        starts
    }

    fn polish(&self, places: Vec<(Vec<f64>, Objective)>, workers: &impl Workers) -> Vec<Polished> {
        let polished = workers.map(places, |(place, objective)| self.measuring(&objective).polished(&place));
        polished.into_iter().flatten().collect()
    }

    fn meet(&mut self, workers: &impl Workers) -> Stage {
        let count = 4 * self.start_count();
        let starts = self.starts(count).into_iter().map(|place| (place, Objective::Nothing)).collect();
        let polished = self.polish(starts, workers);
        self.found.extend(polished.into_iter().filter(|polished| polished.assessment.is_met));
        if self.samples.is_empty() {
            return Stage::Done;
        }
        let goals = self.meter.wishes.goals.len();
        if goals == 0 && !self.found.is_empty() {
            return Stage::Done;
        }
        let objective = |k: usize| if goals == 0 { Objective::Nothing } else { Objective::Goal(k % goals) };
        let starts = self.starts(self.start_count().max(2 * goals));
        self.runs = starts.iter().enumerate().map(|(k, place)| self.run(k, place, objective(k), WIDE)).collect();
        Stage::Evolve { round: 0, slice: 0 }
    }

    fn run(&self, number: usize, place: &[f64], objective: Objective, step: f64) -> Run {
        let seed = self.options.seed.wrapping_add((number as u64 + 1).wrapping_mul(0x5851_F42D_4C95_7F2D));
        Run::new(place, objective, step, seed)
    }

    /// Goes on with all runs; whether any is left to go on with.
    fn advance(&mut self, slice: usize, workers: &impl Workers) -> bool {
        let advanced = workers.map(self.runs.clone(), |mut run: Run| {
            let objective = run.objective.clone();
            run.advance(&self.measuring(&objective), SLICE);
            run
        });
        // They are left out if the search is stopped.
        if advanced.len() == self.runs.len() {
            self.runs = advanced;
        }
        slice < MAX_SLICES && self.runs.iter().any(|run| !run.is_done)
    }

    /// What the runs have come to, with what it is to be least of.
    fn finish_runs(&mut self, workers: &impl Workers) -> Vec<(Objective, Polished)> {
        let ends = std::mem::take(&mut self.runs);
        let places = ends
            .iter()
            .flat_map(|run| [run.best.clone(), run.mean().to_vec()].map(|place| (place, run.objective.clone())));
        let polished = workers.map(places.collect(), |(place, objective): (Vec<f64>, Objective)| {
            let polished = self.measuring(&objective).polished(&place)?;
            Some((objective, polished))
        });
        let mut polished: Vec<(Objective, Polished)> = polished.into_iter().flatten().collect();
        if self.meter.space.has_steps() {
            /// So many of the best are moved in steps; others would come to the same.
            const SETTLED: usize = 6;
            let rank = |(objective, polished): &(Objective, Polished)| self.measuring(objective).rank(polished);
            polished.sort_by(|a, b| rank(a).partial_cmp(&rank(b)).unwrap_or(std::cmp::Ordering::Equal));
            polished.truncate(SETTLED);
            polished = workers.map(polished, |(objective, polished)| {
                let settled = self.measuring(&objective).settled(polished);
                (objective, settled)
            });
        }
        polished
    }

    fn evolve(&mut self, round: usize, slice: usize, workers: &impl Workers) -> Stage {
        if self.advance(slice, workers) {
            return Stage::Evolve { round, slice: slice + 1 };
        }
        let ended = self.finish_runs(workers);
        self.found
            .extend(ended.into_iter().map(|(_, polished)| polished).filter(|polished| polished.assessment.is_met));
        if self.found.is_empty() {
            return self.begin_relaxing();
        }
        let goals = self.meter.wishes.goals.len();
        if round > 0 || goals == 0 {
            return Stage::Done;
        }
        self.go_on_from_found()
    }

    /// The last round for goals.
    fn go_on_from_found(&mut self) -> Stage {
        let goals = self.meter.wishes.goals.len();
        self.runs = match goals {
            0 => return Stage::Done,
            1 => self.near_the_best(),
            _ => self.between_goals(goals),
        };
        Stage::Evolve { round: 1, slice: 0 }
    }

    /// The found places, those first for which an objective is least.
    fn found_by(&self, objective: &Objective) -> Vec<&Polished> {
        let value = |polished: &Polished| self.units.objective(&polished.assessment, objective);
        let mut found: Vec<&Polished> = self.found.iter().collect();
        found.sort_by(|a, b| value(a).total_cmp(&value(b)));
        found
    }

    /// Further runs near the two best places: with the augmented Lagrangian, and where the wishes are met.
    fn near_the_best(&self) -> Vec<Run> {
        const RUNS: usize = 3;
        let objective = Objective::Goal(0);
        let best = self.found_by(&objective).into_iter().take(2);
        let runs = best
            .enumerate()
            .flat_map(|(n, polished)| (0..RUNS).map(move |k| (FURTHER + RUNS * n + k, polished, k + 1 == RUNS)));
        let begun = runs.map(|(number, polished, is_projected)| {
            let run = self.run(number, &polished.place, objective.clone(), CLOSE);
            if is_projected { run.projected(self.projected_generations()) } else { run }
        });
        begun.collect()
    }

    /// Runs for objectives between the goals.
    fn between_goals(&self, goals: usize) -> Vec<Run> {
        let begun = self.weighted(goals).into_iter().enumerate().flat_map(|(k, objective)| {
            let best = self.found_by(&objective)[0].place.clone();
            [CLOSE, WIDE].map(|step| {
                let run = self.run(FURTHER + k, &best, objective.clone(), step);
                run.projected(self.projected_generations())
            })
        });
        begun.collect()
    }

    /// Objectives between the goals, as many as answers are wanted.
    fn weighted(&self, goals: usize) -> Vec<Objective> {
        let least: Vec<f64> = (0..goals)
            .map(|k| self.found.iter().map(|polished| polished.assessment.goals[k]).fold(f64::INFINITY, f64::min))
            .collect();
        let sequence = EvenSequence::new(goals - 1);
        let of_number = |number: usize| {
            let part = sequence.parts(number);
            // The parts between sorted numbers fill the simplex evenly.
            let mut cuts: Vec<f64> = (0..goals - 1).map(part).collect();
            cuts.extend([0.0, 1.0]);
            cuts.sort_by(f64::total_cmp);
            let weights = cuts.windows(2).map(|pair| pair[1] - pair[0]).collect();
            Objective::Weighted { weights, least: least.clone() }
        };
        (0..self.options.most.max(2)).map(of_number).collect()
    }

    /// Begins to look for what comes nearest without one of the wishes.
    fn begin_relaxing(&mut self) -> Stage {
        let starts_each = self.start_count() / 2 + 1;
        let mut runs = Vec::new();
        for wish in 0..self.meter.wishes.wishes.len() {
            let objective = Objective::Wish(wish);
            let mut samples: Vec<&Sample> = self.samples.iter().collect();
            let violation = |sample: &Sample| self.units.violation(&sample.assessment, &objective);
            samples.sort_by(|a, b| violation(a).total_cmp(&violation(b)));
            let starts = samples.iter().take(starts_each).enumerate();
            runs.extend(starts.map(|(k, sample)| {
                self.run(2 * FURTHER + starts_each * wish + k, &sample.place, objective.clone(), WIDE)
            }));
        }
        self.runs = runs;
        Stage::Relax { round: 0, slice: 0 }
    }

    fn relax(&mut self, round: usize, slice: usize, workers: &impl Workers) -> Stage {
        /// What of the other wishes is met to rounding.
        const MET: f64 = 1e-6;
        if self.advance(slice, workers) {
            return Stage::Relax { round, slice: slice + 1 };
        }
        for (objective, polished) in self.finish_runs(workers) {
            let Objective::Wish(wish) = objective else { continue };
            if polished.assessment.is_met {
                self.found.push(polished.clone());
            }
            if self.units.violation(&polished.assessment, &objective) <= MET {
                self.misses.push((wish, polished));
            }
        }
        // What comes as near as can be may meet the wish.
        if !self.found.is_empty() {
            return self.go_on_from_found();
        }
        if round > 0 {
            return Stage::Done;
        }
        let wishes = 0..self.meter.wishes.wishes.len();
        let nearest = wishes.filter_map(|wish| Some((wish, self.nearest_miss(wish)?.place.clone())));
        let begun = nearest.map(|(wish, place)| {
            self.run(3 * FURTHER + wish, &place, Objective::Wish(wish), CLOSE).projected(self.projected_generations())
        });
        self.runs = begun.collect();
        Stage::Relax { round: 1, slice: 0 }
    }

    /// What comes nearest to a wish and meets the others.
    fn nearest_miss(&self, wish: usize) -> Option<&Polished> {
        let objective = Objective::Wish(wish);
        let of_this = self.misses.iter().filter(|(of, _)| *of == wish).map(|(_, polished)| polished);
        let value = |polished: &Polished| self.units.objective(&polished.assessment, &objective);
        of_this.reduce(|best, other| if value(other) < value(best) { other } else { best })
    }

    /// The linkages that have been found so far, the best first: by the goal; by the first goal if there are several, without those that
    /// another one exceeds in all; without goals by the transmission angle and the longest link. Of places that are alike one is left.
    pub fn answers(&self, workers: &impl Workers) -> Vec<DesignAnswer> {
        /// Of a search that is stopped, so many runs are brought to where they meet the wishes.
        const UNFINISHED: usize = 4;
        let is_of_goals = |run: &&Run| !matches!(run.objective, Objective::Wish(_));
        let unfinished = self.runs.iter().filter(is_of_goals).map(|run| (run.best.clone(), run.objective.clone()));
        let unfinished = self.polish(unfinished.take(UNFINISHED).collect(), workers);
        let mut found: Vec<&Polished> =
            self.found.iter().chain(&unfinished).filter(|polished| polished.assessment.is_met).collect();
        let goals = &self.meter.wishes.goals;
        let merit = |polished: &Polished| polished.assessment.goals.first().copied().unwrap_or(0.0);
        found.sort_by(|a, b| merit(a).total_cmp(&merit(b)));
        let mut distinct: Vec<&Polished> = Vec::new();
        for polished in found {
            /// Places that differ by less are one.
            const ALIKE: f64 = 0.01;
            let folded = |polished: &Polished| self.meter.space.folded(&polished.place);
            if distinct.iter().all(|other| distance(&folded(other), &folded(polished)) > ALIKE) {
                distinct.push(polished);
            }
        }
        let answers = distinct.into_iter().filter_map(|polished| self.answer(polished));
        let mut answers: Vec<DesignAnswer> =
            answers.filter(|answer| answer.is_met(self.meter.wishes.max_link)).collect();
        // Without a value of a goal an answer cannot be compared: it is one only if there is no other.
        let has_goals = |answer: &DesignAnswer| answer.goals.iter().all(|(_, value)| !value.is_nan());
        if answers.iter().any(has_goals) {
            answers.retain(has_goals);
        }
        let directions: Vec<Direction> = goals.iter().map(|goal| goal.direction).collect();
        if goals.len() > 1 {
            let all = answers.clone();
            answers.retain(|answer| all.iter().all(|other| !answer.is_exceeded_by(other, &directions)));
        }
        if goals.is_empty() {
            let order = |answer: &DesignAnswer| [-answer.mu_worst_deg().unwrap_or(0.0), answer.longest_link];
            answers.sort_by(|a, b| order(a).partial_cmp(&order(b)).unwrap_or(std::cmp::Ordering::Equal));
        }
        spread_over(answers, self.options.most, goals.len() > 1)
    }

    fn answer(&self, polished: &Polished) -> Option<DesignAnswer> {
        let values = self.meter.space.values(&polished.place)?;
        DesignAnswer::new(&self.meter, values, polished.assessment.curve)
    }

    /// For each wish without which the others can be met, the linkage that comes nearest to it.
    pub fn misses(&self) -> Vec<DesignMiss> {
        let of_wish = |wish: usize| Some(DesignMiss { wish, nearest: self.answer(self.nearest_miss(wish)?)? });
        (0..self.meter.wishes.wishes.len()).filter_map(of_wish).collect()
    }
}

/// Of answers in their order as many as are wanted: the first, or of trade-offs those that are evenly among them.
fn spread_over(answers: Vec<DesignAnswer>, most: usize, is_evenly: bool) -> Vec<DesignAnswer> {
    let count = answers.len();
    if count <= most || !is_evenly || most < 2 {
        return answers.into_iter().take(most).collect();
    }
    let wanted: Vec<usize> = (0..most).map(|k| (k * (count - 1) + (most - 1) / 2) / (most - 1)).collect();
    answers.into_iter().enumerate().filter(|(k, _)| wanted.contains(k)).map(|(_, answer)| answer).collect()
}

/// The greatest difference of two places, in parts of the ranges.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

//! The search: from the curves of an index that are most like the target to the linkages whose curves are nearest to it.

use crate::complex::Complex;
use crate::four_bar::fitting::Fitting;
use crate::four_bar::index::Index;
use crate::four_bar::parameters::Parameters;
use crate::four_bar::refinement::Refinement;
use crate::options::{Effort, Options};
use crate::scatter::Scatter;
use crate::search::lookup::Lookup;
use crate::target::{PathKind, Target};
use coupler_curves::linkage::PlacedFourBar;

/// A search in bounded steps.
pub struct Search {
    fitting: Fitting,
    options: Options,
    stage: Stage,
    refinements: Vec<Refinement>,
    /// Whether the nearest curve has been looked up in place of the target, and the refinements from before.
    has_looked_again: bool,
    kept: Vec<Refinement>,
    /// The refinements that were left behind in the last rounds, for further answers.
    left_behind: Vec<Refinement>,
    scatter: Scatter,
}

/// What the next step does.
enum Stage {
    /// Looks the target up, or the nearest curve in its place.
    LookUp(Lookup),
    /// Begins to refine the last of the linkages that are placed, which are in reverse order.
    Begin(Vec<Parameters>),
    /// Refines a linkage in a round.
    Refine {
        round: usize,
        place: usize,
        steps: usize,
    },
    /// Chooses the linkages to begin again from: the cognates of the best, or linkages near them.
    ChooseRestarts {
        count: usize,
    },
    /// Begins again from the last of the linkages, after the one that is being refined.
    Restart {
        count: usize,
        from: Vec<Parameters>,
        running: Option<(Refinement, usize)>,
    },
    /// Refines one of the nearest in the order of the target's points.
    Polish {
        place: usize,
        running: Option<Polish>,
    },
    /// Refines one of those that were left behind.
    Complete {
        place: usize,
        steps: usize,
    },
    Done,
}

/// A refinement to the means of points that share a pose, which puts the points in their order.
struct Polish {
    means: Vec<Complex>,
    refinement: Refinement,
    /// The sum of the squares of the distances in order, before.
    sum: f64,
    steps: usize,
}

/// The steps of a refinement in a step of the search: two milliseconds for a target of a hundred points.
const STEPS_AT_ONCE: usize = 4;

/// The number of points for which an effort is measured. A path of fewer points is refined in less time, and has more minima that are
/// not the least, as precision points do: more linkages are tried, up to this factor.
const POINTS_OF_EFFORT: usize = 100;
const MAX_MORE: usize = 5;

/// The parts of the starts that are refined in each round, and the steps of a round.
const ROUNDS: [(usize, usize); 4] = [(1, 6), (3, 12), (8, 40), (20, 200)];

/// The steps after a restart, and those after which it must be near the best.
const RESTART_STEPS: usize = 60;
const PROMISING_STEPS: usize = 16;
const PROMISING_SUM: f64 = 30.0;

/// The steps in which points are put in their order.
const POLISH_STEPS: usize = 20;

/// So many of those left behind are refined for each answer: some find a curve that is known.
const FURTHER_PER_ANSWER: usize = 2;

impl Search {
    /// Begins a search.
    pub fn new(target: &Target, options: Options) -> Search {
        let fitting = Fitting::new(target, &options);
        let mut search = Search {
            stage: Stage::Done,
            refinements: Vec::new(),
            // Portions are looked up more slowly, and hardly by their noise.
            has_looked_again: target.kind() != PathKind::Closed,
            kept: Vec::new(),
            left_behind: Vec::new(),
            scatter: Scatter::new(options.seed),
            fitting,
            options,
        };
        search.stage = Stage::LookUp(search.lookup(&search.fitting.points));
        search
    }

    /// Begins with a four-bar that is placed on the target, in place of those of the index.
    pub fn from_four_bar(target: &Target, options: Options, start: &PlacedFourBar) -> Search {
        let start = Parameters::from_placed(start).transformed(&target.placement().inverse());
        Search { stage: Stage::Begin(vec![start]), has_looked_again: true, ..Search::new(target, options) }
    }

    /// Takes a step, of a few milliseconds at most for a target of a hundred points; false if nothing is left to do. All steps are
    /// with one index, to which curves may be added at its end.
    pub fn step(&mut self, index: &Index) -> bool {
        self.stage = match std::mem::replace(&mut self.stage, Stage::Done) {
            Stage::LookUp(lookup) => self.look_up(lookup, index),
            Stage::Begin(starts) => self.begin(starts),
            Stage::Refine { round, place, steps } => self.refine(round, place, steps),
            Stage::ChooseRestarts { count } => self.choose_restarts(count),
            Stage::Restart { count, from, running } => self.restart(count, from, running),
            Stage::Polish { place, running } => self.polish(place, running),
            Stage::Complete { place, steps } => self.complete(place, steps),
            Stage::Done => Stage::Done,
        };
        !matches!(self.stage, Stage::Done)
    }

    /// What answers are made of: the refinements, and the most answers.
    pub(crate) fn results(&self) -> (&Fitting, &[Refinement], usize) {
        (&self.fitting, &self.refinements, self.options.most)
    }

    fn start_count(&self) -> usize {
        let count = match self.options.effort {
            Effort::Quick => 35,
            Effort::Normal => 100,
            Effort::Thorough => 400,
        };
        // A portion is looked up once only.
        let count = if self.fitting.target.kind() == PathKind::Closed { count } else { 2 * count };
        count * (POINTS_OF_EFFORT / self.fitting.points.len()).clamp(1, MAX_MORE)
    }

    /// Restarts are a third of the work, and find what no start has led to: half of it for a path of few points, of which the least minimum is
    /// otherwise found by some seeds only.
    fn restart_count(&self) -> usize {
        let is_sparse = self.fitting.points.len() <= POINTS_OF_EFFORT / 2;
        self.start_count() * if is_sparse { 6 } else { 3 } / 5
    }

    fn lookup(&self, points: &[Complex]) -> Lookup {
        let has_condition = self.fitting.limits.condition.is_some();
        Lookup::new(self.fitting.target.kind(), points, self.start_count(), has_condition)
    }

    fn look_up(&mut self, mut lookup: Lookup, index: &Index) -> Stage {
        if lookup.step(index, &self.fitting) {
            return Stage::LookUp(lookup);
        }
        let most = self.start_count() / if self.kept.is_empty() { 1 } else { 2 };
        let mut starts = lookup.into_starts(most);
        starts.reverse();
        Stage::Begin(starts)
    }

    fn begin(&mut self, mut starts: Vec<Parameters>) -> Stage {
        match starts.pop() {
            Some(start) => {
                self.refinements.extend(self.fitting.begin(&start));
                Stage::Begin(starts)
            }
            None if self.options.refine => Stage::Refine { round: 0, place: 0, steps: 0 },
            None => Stage::Done,
        }
    }

    fn refine(&mut self, round: usize, place: usize, steps: usize) -> Stage {
        let Some(&(_, most)) = ROUNDS.get(round) else { return self.look_again() };
        let Some(refinement) = self.refinements.get_mut(place) else {
            let next = ROUNDS.get(round + 1).map_or(1, |(part, _)| *part);
            let left_behind = self.keep_nearest(self.start_count() / next);
            if round + 2 == ROUNDS.len() {
                self.left_behind.extend(left_behind);
            }
            return Stage::Refine { round: round + 1, place: 0, steps: 0 };
        };
        let steps = self.fitting.advance(refinement, steps, most);
        if !refinement.descent.is_done && steps < most {
            return Stage::Refine { round, place, steps };
        }
        if round + 1 == ROUNDS.len() {
            self.fitting.put_in_order(&mut self.refinements[place]);
        }
        if self.fitting.has_valid_length(&self.refinements[place]) {
            return Stage::Refine { round, place: place + 1, steps: 0 };
        }
        self.refinements.remove(place);
        Stage::Refine { round, place, steps: 0 }
    }

    /// Looks the nearest curve up in the index in place of the target, whose noise hides what it is like.
    fn look_again(&mut self) -> Stage {
        self.refinements.append(&mut self.kept);
        self.keep_nearest(self.start_count());
        let Some(best) = self.refinements.first().filter(|_| !self.has_looked_again) else {
            return Stage::ChooseRestarts { count: 0 };
        };
        let points = best.linkage.curve(&self.fitting.circuit_of(&best.linkage, &best.poses[0]));
        self.has_looked_again = true;
        self.kept = std::mem::take(&mut self.refinements);
        Stage::LookUp(self.lookup(&points))
    }

    fn choose_restarts(&mut self, count: usize) -> Stage {
        /// So many of the best have their cognates tried; then linkages near them.
        const NEAR: usize = 8;
        /// The spreads of these in turn: minima are near each other in some paths, and far apart in others.
        const SPREADS: [f64; 4] = [0.15, 0.3, 0.6, 1.0];
        /// The mean square of the distances at which a target is met to rounding.
        const EXACT: f64 = 1e-16;
        let left_behind = self.keep_nearest(self.start_count() / ROUNDS[ROUNDS.len() - 1].0);
        self.left_behind.extend(left_behind);
        let Some(best) = self.refinements.first() else { return Stage::Done };
        if count == self.restart_count() || best.sum <= EXACT * self.fitting.points.len() as f64 {
            return Stage::Polish { place: 0, running: None };
        }
        let near = self.refinements[count % self.refinements.len().min(NEAR)].linkage;
        let spread = SPREADS[(count / NEAR) % SPREADS.len()];
        let from = match count < NEAR {
            true => near.cognates(),
            false => vec![near.scattered(&mut self.scatter, spread), near.scattered(&mut self.scatter, spread)],
        };
        Stage::Restart { count: count + 1, from, running: None }
    }

    /// Refines a linkage, as long as it may become better than the best.
    fn restart(&mut self, count: usize, mut from: Vec<Parameters>, running: Option<(Refinement, usize)>) -> Stage {
        let Some((mut refinement, steps)) = running else {
            let Some(start) = from.pop() else { return Stage::ChooseRestarts { count } };
            let running = self.fitting.begin(&start).map(|refinement| (refinement, 0));
            return Stage::Restart { count, from, running };
        };
        let promising = PROMISING_SUM * self.refinements.first().map_or(f64::INFINITY, |best| best.sum);
        let steps = self.fitting.advance(&mut refinement, steps, RESTART_STEPS);
        let is_hopeless = steps == PROMISING_STEPS && refinement.sum > promising;
        if !(refinement.descent.is_done || is_hopeless || steps == RESTART_STEPS) {
            return Stage::Restart { count, from, running: Some((refinement, steps)) };
        }
        if !is_hopeless {
            self.fitting.put_in_order(&mut refinement);
        }
        // Those from before have been found valid.
        if self.fitting.has_valid_length(&refinement) {
            self.refinements.push(refinement);
        }
        Stage::Restart { count, from, running: None }
    }

    /// Refines a linkage in the order of the target's points: those that share a pose are replaced by their mean.
    fn polish(&mut self, place: usize, running: Option<Polish>) -> Stage {
        let Some(refinement) = self.refinements.get(place) else {
            self.left_behind.sort_by(|a, b| a.sum.total_cmp(&b.sum));
            self.left_behind.truncate(if self.options.most > 1 { FURTHER_PER_ANSWER * self.options.most } else { 0 });
            return Stage::Complete { place: 0, steps: 0 };
        };
        let Some(Polish { means, refinement: mut polished, sum, steps }) = running else {
            let running =
                self.fitting.matching(refinement).filter(|matching| !matching.is_in_order).and_then(|matching| {
                    let polished = Refinement::new(refinement.linkage, &matching.poses, &matching.means, None)?;
                    Some(Polish { means: matching.means, refinement: polished, sum: matching.sum, steps: 0 })
                });
            return Stage::Polish { place: if running.is_some() { place } else { place + 1 }, running };
        };
        if steps < POLISH_STEPS && !polished.descent.is_done {
            (0..STEPS_AT_ONCE).for_each(|_| polished.step(&means, &self.fitting.limits));
            let running = Polish { means, refinement: polished, sum, steps: steps + STEPS_AT_ONCE };
            return Stage::Polish { place, running: Some(running) };
        }
        if let Some(better) = self.fitting.matching(&polished).filter(|better| better.sum < sum) {
            (polished.sum, polished.poses) = (better.sum, better.poses);
            self.refinements[place] = polished;
        }
        Stage::Polish { place: place + 1, running: None }
    }

    /// Takes some steps of one of those that were left behind, for a further answer.
    fn complete(&mut self, place: usize, steps: usize) -> Stage {
        let Some(refinement) = self.left_behind.get_mut(place) else {
            self.refinements.append(&mut self.left_behind);
            return Stage::Done;
        };
        let (_, most) = ROUNDS[ROUNDS.len() - 1];
        let steps = self.fitting.advance(refinement, steps, most);
        match refinement.descent.is_done || steps == most {
            true => Stage::Complete { place: place + 1, steps: 0 },
            false => Stage::Complete { place, steps },
        }
    }

    /// Keeps the nearest refinements with different curves; those that are left behind.
    fn keep_nearest(&mut self, most: usize) -> Vec<Refinement> {
        /// The part of their distance from the target by which the curves of two refinements differ, if they are on their way to one linkage, as along a
        /// valley in which links become longer and longer.
        const ALIKE: f64 = 0.3;
        self.refinements.sort_by(|a, b| a.sum.total_cmp(&b.sum));
        let mut kept: Vec<(Vec<Complex>, Refinement)> = Vec::new();
        let mut left_behind = Vec::new();
        for refinement in self.refinements.drain(..) {
            let feet = refinement.linkage.curve(&refinement.poses);
            let alike = ALIKE * ALIKE * refinement.sum / feet.len() as f64;
            let is_alike = |(other, _): &(Vec<Complex>, Refinement)| {
                other.iter().zip(&feet).all(|(a, b)| (a - b).norm_sqr() <= alike)
            };
            match kept.len() < most.max(1) && !kept.iter().any(is_alike) {
                true => kept.push((feet, refinement)),
                false => left_behind.push(refinement),
            }
        }
        self.refinements = kept.into_iter().map(|(_, refinement)| refinement).collect();
        left_behind
    }
}

impl Fitting {
    /// Matches the target's points with those of a linkage in their order, which feet that move each by itself may have lost: it would be
    /// ranked before linkages that are nearer in order.
    fn put_in_order(&self, refinement: &mut Refinement) {
        if let Some(matching) = self.matching(refinement) {
            (refinement.sum, refinement.poses) = (matching.sum, matching.poses);
        }
    }

    /// Takes some of the steps of a refinement, of which `taken` have been taken; how many have been taken then, `most` at most.
    fn advance(&self, refinement: &mut Refinement, taken: usize, most: usize) -> usize {
        let until = most.min(taken + STEPS_AT_ONCE);
        (taken..until).for_each(|_| refinement.step(&self.points, &self.limits));
        until
    }
}

//! The search: from the curves of an index that are most like the target to the linkages whose curves are nearest to it.

use super::answer::{Answer, LENGTH_RATIOS};
use super::complex::{Complex, closed_length, length};
use super::constraints::Limits;
use super::index::{Entry, Index};
use super::matching::{Matching, nearest_samples};
use super::mechanism::Mechanism;
use super::options::{Effort, Options};
use super::parameters::{COUNT, Parameters};
use super::portion::Stroke;
use super::pose::Pose;
use super::refinement::Refinement;
use super::spectrum::Spectrum;
use super::target::{PathKind, Target};
use super::timing::Timing;
use crate::geometry::{Point, trig};
use crate::linkage::{Cognate, Cognates, PlacedFourBar};

/// A search in bounded steps.
pub struct Search<'i> {
    index: &'i Index,
    target: Target,
    options: Options,
    limits: Limits,
    /// The points of the target with centroid 0 and size 1, and the length of their polyline.
    points: Vec<Complex>,
    polyline_length: f64,
    /// The inputs of the points, forward and backward, if they are timed.
    timing: Option<[Timing; 2]>,
    query: Query,
    stage: Stage,
    best: Vec<(f32, usize)>,
    /// Their linkages on the target, with how much their curves are like it.
    placed: Vec<(f64, Parameters)>,
    refinements: Vec<Refinement>,
    /// Whether the nearest curve has been looked up in place of the target, and the refinements from before.
    has_looked_again: bool,
    kept: Vec<Refinement>,
    /// The refinements that were left behind in the last rounds, for further answers.
    left_behind: Vec<Refinement>,
    /// The linkages to begin again from.
    restarts: Vec<Parameters>,
    random: u64,
}

/// What is looked up in the index.
enum Query {
    /// A closed curve: its spectrum, and the centroid and the size of points at equal distances along it.
    Whole(Spectrum, Complex, f64),
    /// A portion of a curve.
    Portion(Stroke),
}

/// What the next step does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// Compares the curves of the index from one on.
    Compare(usize),
    /// Places a curve on the target.
    Place(usize),
    /// Begins to refine a linkage that is placed.
    Begin(usize),
    /// Refines a linkage in a round.
    Refine {
        round: usize,
        place: usize,
        step: usize,
    },
    /// Begins again from the cognates of the best, or from linkages near them.
    Restart(usize),
    /// Refines one of the nearest in the order of the target's points.
    Polish(usize),
    /// Refines one of those that were left behind.
    Complete {
        place: usize,
        step: usize,
    },
    Done,
}

/// The curves of a step of comparison.
const CURVES_PER_STEP: usize = 4096;

/// Those whose portions are compared in a step.
const PORTIONS_PER_STEP: usize = 1024;

/// The curves that are compared exactly, for each that is refined.
const EXACT_PER_START: usize = 3;

/// The curves that are compared exactly, for each that is refined, until so many are found that meet a condition.
const EXACT_PER_START_WITH_CONDITION: usize = 20;

/// The parts of the starts that are refined in each round, and the steps of a round.
const ROUNDS: [(usize, usize); 4] = [(1, 6), (3, 12), (8, 40), (20, 200)];

/// The steps after a restart, and those after which it must be near the best.
const RESTART_STEPS: usize = 60;
const PROMISING_STEPS: usize = 15;
const PROMISING_SUM: f64 = 30.0;

/// So many of those left behind are refined for each answer: some find a curve that is known.
const FURTHER_PER_ANSWER: usize = 2;

impl<'i> Search<'i> {
    /// Begins a search.
    pub fn new(target: &Target, index: &'i Index, options: Options) -> Search<'i> {
        let points = target.normalized();
        let query = Query::new(target.kind(), &points, index);
        let (size, centre) = target.placement();
        let corner = |x: f64, y: f64| (Complex::new(x, y) - centre) / size;
        let pivots = options.pivots.map(|b| [corner(b.min.x, b.min.y), corner(b.max.x, b.max.y)]);
        let limits = Limits {
            full_turn: options.full_turn,
            max_link: options.max_link,
            pivots,
            condition: options.condition.clone(),
            placement: (size, centre),
        };
        Search {
            index,
            target: target.clone(),
            limits,
            polyline_length: target.polyline_length(),
            timing: target.angles_deg().map(Timing::both),
            points,
            query,
            stage: Stage::Compare(0),
            best: Vec::new(),
            placed: Vec::new(),
            refinements: Vec::new(),
            // Portions are looked up more slowly, and hardly by their noise.
            has_looked_again: target.kind() != PathKind::Closed,
            kept: Vec::new(),
            left_behind: Vec::new(),
            restarts: Vec::new(),
            // Any number but 0.
            random: options.seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1,
            options,
        }
    }

    /// Begins with a four-bar that is placed on the target, in place of those of the index.
    pub fn from_four_bar(target: &Target, index: &'i Index, options: Options, start: &PlacedFourBar) -> Search<'i> {
        let (size, centre) = target.placement();
        let start = Parameters::from_placed(start).transformed(Complex::new(1.0 / size, 0.0), -centre / size);
        let placed = vec![(1.0, start)];
        Search { placed, stage: Stage::Begin(0), has_looked_again: true, ..Search::new(target, index, options) }
    }

    /// Searches to the end.
    pub fn run(mut self) -> Vec<Answer> {
        while self.step() {}
        self.answers()
    }

    /// Takes a step, of a few milliseconds at most for a target of a hundred points; false if nothing is left to do.
    pub fn step(&mut self) -> bool {
        self.stage = match self.stage {
            Stage::Compare(from) => self.compare(from),
            Stage::Place(place) => self.place(place),
            Stage::Begin(place) => self.begin_placed(place),
            Stage::Refine { round, place, step } => self.refine(round, place, step),
            Stage::Restart(count) => self.restart(count),
            Stage::Polish(place) => self.polish(place),
            Stage::Complete { place, step } => self.complete(place, step),
            Stage::Done => Stage::Done,
        };
        self.stage != Stage::Done
    }

    fn start_count(&self) -> usize {
        let count = match self.options.effort {
            Effort::Quick => 70,
            Effort::Normal => 200,
            Effort::Thorough => 800,
        };
        // A portion is looked up once only.
        if self.target.kind() == PathKind::Closed { count } else { 2 * count }
    }

    fn restart_count(&self) -> usize {
        self.start_count() / 10
    }

    fn compare(&mut self, from: usize) -> Stage {
        let best = std::mem::take(&mut self.best);
        let per_start = if self.limits.condition.is_some() { EXACT_PER_START_WITH_CONDITION } else { EXACT_PER_START };
        let most = per_start * self.start_count();
        let is_whole = matches!(self.query, Query::Whole(..));
        let to = from + if is_whole { CURVES_PER_STEP } else { PORTIONS_PER_STEP };
        self.best = match &self.query {
            Query::Whole(spectrum, ..) => {
                let query = (spectrum, self.polyline_length, self.limits.full_turn);
                self.index.nearest(query, from..to, best, most)
            }
            Query::Portion(stroke) => {
                self.index.nearest_portions((stroke, self.limits.full_turn), from..to, best, most)
            }
        };
        if to < self.index.len() { Stage::Compare(to) } else { Stage::Place(0) }
    }

    /// Places a curve of the index on the target, where it is most like it.
    fn place(&mut self, place: usize) -> Stage {
        let is_enough = self.limits.condition.is_some() && self.placed.len() >= self.start_count();
        let Some(&(_, number)) = self.best.get(place).filter(|_| !is_enough) else {
            self.placed.sort_by(|a, b| b.0.total_cmp(&a.0));
            self.placed.truncate(self.start_count() / if self.kept.is_empty() { 1 } else { 2 });
            return Stage::Begin(0);
        };
        if let Some(entry) = self.index.entry(number) {
            let Some((likeness, linkage)) = self.placed_on_target(&entry) else { return Stage::Place(place + 1) };
            let starts: Vec<Parameters> = match self.limits.condition.is_some() {
                true => cognates(&linkage).into_iter().chain([linkage]).filter(|start| self.may_begin(start)).collect(),
                false => vec![linkage],
            };
            self.placed.extend(starts.into_iter().map(|start| (likeness, start)));
        }
        Stage::Place(place + 1)
    }

    /// The linkage of a curve of the index where it is most like the target, with how much it is.
    fn placed_on_target(&self, entry: &Entry) -> Option<(f64, Parameters)> {
        let mirrored = |is_mirrored: bool| if is_mirrored { entry.linkage.mirrored() } else { entry.linkage };
        match &self.query {
            Query::Whole(target, target_centre, target_size) => {
                let (spectrum, centre, size, _) = self.index.spectrum(entry);
                let likeness = self.index.transform().likeness(target, &spectrum);
                let centre = if likeness.is_mirrored { centre.conj() } else { centre };
                let factor = likeness.factor * (target_size / size);
                let linkage = mirrored(likeness.is_mirrored).transformed(factor, target_centre - factor * centre);
                Some((likeness.value, linkage))
            }
            Query::Portion(stroke) => {
                let (window, factor, shift) = stroke.placement(&entry.linkage.curve(&entry.circuit))?;
                Some((-f64::from(window.residual), mirrored(window.is_mirrored).transformed(factor, shift)))
            }
        }
    }

    /// Whether a linkage meets the condition on one of its circuits.
    fn may_begin(&self, linkage: &Parameters) -> bool {
        let circuits = linkage.circuits(self.index.directions());
        circuits.iter().any(|circuit| circuit.first().is_some_and(|pose| self.limits.meets_condition(linkage, pose)))
    }

    /// Begins to refine a linkage that is placed.
    fn begin_placed(&mut self, place: usize) -> Stage {
        let Some((_, linkage)) = self.placed.get(place) else {
            return if self.options.refine { Stage::Refine { round: 0, place: 0, step: 0 } } else { Stage::Done };
        };
        self.refinements.extend(self.begin(linkage));
        Stage::Begin(place + 1)
    }

    /// Begins a refinement from a linkage near the limits, on the circuit and in the direction that are nearest to the target.
    fn begin(&self, linkage: &Parameters) -> Option<Refinement> {
        let linkage = self.limits.nearest(linkage, linkage.frame >= linkage.crank)?;
        let refinement = match &self.timing {
            None => Refinement::new(linkage, &self.nearest_samples(&linkage)?, &self.points, None)?,
            Some(both) => {
                let samples = |timing: &Timing| {
                    let (sum, poses) = timing.nearest_samples(&linkage, self.index.directions(), &self.points)?;
                    Some((sum, poses, timing.clone()))
                };
                let nearer = both.iter().filter_map(samples).min_by(|a, b| a.0.total_cmp(&b.0));
                let (_, poses, timing) = nearer?;
                Refinement::new(linkage, &poses, &self.points, Some(timing))?
            }
        };
        Some(refinement).filter(|refinement| self.limits.meets_condition(&linkage, &refinement.poses[0]))
    }

    /// The samples of a linkage that are matched with the target, on the circuit and in the direction that are nearest to it.
    fn nearest_samples(&self, linkage: &Parameters) -> Option<Vec<Pose>> {
        let mut best: Option<(f64, Vec<Pose>)> = None;
        for mut circuit in linkage.circuits(self.index.directions()) {
            for _ in 0..2 {
                let (sum, poses) = nearest_samples(linkage, &circuit, &self.points)?;
                if best.as_ref().is_none_or(|(least, _)| sum < *least) {
                    best = Some((sum, poses));
                }
                circuit.reverse();
            }
        }
        best.map(|(_, poses)| poses)
    }

    fn refine(&mut self, round: usize, place: usize, step: usize) -> Stage {
        let Some(&(_, steps)) = ROUNDS.get(round) else { return self.look_again() };
        let Some(refinement) = self.refinements.get_mut(place) else {
            let next = ROUNDS.get(round + 1).map_or(1, |(part, _)| *part);
            self.keep_valid();
            let left_behind = self.keep_nearest(self.start_count() / next);
            if round + 2 == ROUNDS.len() {
                self.left_behind.extend(left_behind);
            }
            return Stage::Refine { round: round + 1, place: 0, step: 0 };
        };
        refinement.step(&self.points, &self.limits);
        if refinement.is_done || step + 1 == steps {
            return Stage::Refine { round, place: place + 1, step: 0 };
        }
        Stage::Refine { round, place, step: step + 1 }
    }

    /// Looks the nearest curve up in the index in place of the target, whose noise hides what it is like.
    fn look_again(&mut self) -> Stage {
        self.refinements.append(&mut self.kept);
        self.keep_nearest(self.start_count());
        let Some(best) = self.refinements.first().filter(|_| !self.has_looked_again) else { return Stage::Restart(0) };
        let points = best.linkage.curve(&self.circuit_of(&best.linkage, &best.poses[0]));
        self.query = Query::new(self.target.kind(), &points, self.index);
        self.has_looked_again = true;
        self.kept = std::mem::take(&mut self.refinements);
        self.best.clear();
        self.placed.clear();
        Stage::Compare(0)
    }

    /// Refines one of the linkages to begin again from, or chooses the next.
    fn restart(&mut self, count: usize) -> Stage {
        /// So many of the best have their cognates tried; then linkages near them.
        const COGNATES: usize = 6;
        /// The mean square of the distances at which a target is met to rounding.
        const EXACT: f64 = 1e-16;
        if let Some(start) = self.restarts.pop() {
            self.refine_restart(&start);
            return Stage::Restart(count);
        }
        let left_behind = self.keep_nearest(self.start_count() / ROUNDS[ROUNDS.len() - 1].0);
        self.left_behind.extend(left_behind);
        let Some(best) = self.refinements.first() else { return Stage::Done };
        if count == self.restart_count() || best.sum <= EXACT * self.points.len() as f64 {
            return Stage::Polish(0);
        }
        let from = self.refinements[count % self.refinements.len().min(COGNATES)].linkage;
        self.restarts = match count < COGNATES {
            true => cognates(&from),
            false => vec![self.scattered(&from), self.scattered(&from)],
        };
        Stage::Restart(count + 1)
    }

    /// Refines a linkage, as long as it may become better than the best.
    fn refine_restart(&mut self, start: &Parameters) {
        let promising = PROMISING_SUM * self.refinements.first().map_or(f64::INFINITY, |best| best.sum);
        let Some(mut refinement) = self.begin(start) else { return };
        for step in 0..RESTART_STEPS {
            if refinement.is_done || (step == PROMISING_STEPS && refinement.sum > promising) {
                break;
            }
            refinement.step(&self.points, &self.limits);
        }
        // Those from before have been found valid.
        if self.has_valid_length(&refinement) {
            self.refinements.push(refinement);
        }
    }

    /// Refines a linkage in the order of the target's points: those that share a pose are replaced by their mean.
    fn polish(&mut self, place: usize) -> Stage {
        const STEPS: usize = 20;
        let Some(refinement) = self.refinements.get(place) else {
            self.left_behind.sort_by(|a, b| a.sum.total_cmp(&b.sum));
            self.left_behind.truncate(if self.options.most > 1 { FURTHER_PER_ANSWER * self.options.most } else { 0 });
            return Stage::Complete { place: 0, step: 0 };
        };
        if let Some(matching) = self.matching(refinement)
            && !matching.is_in_order
            && let Some(mut polished) = Refinement::new(refinement.linkage, &matching.poses, &matching.means, None)
        {
            (0..STEPS).for_each(|_| polished.step(&matching.means, &self.limits));
            let better = self.matching(&polished);
            if let Some(better) = better.filter(|better| better.sum < matching.sum) {
                (polished.sum, polished.poses) = (better.sum, better.poses);
                self.refinements[place] = polished;
            }
        }
        Stage::Polish(place + 1)
    }

    /// Takes some steps of one of those that were left behind, for a further answer.
    fn complete(&mut self, place: usize, step: usize) -> Stage {
        const STEPS: usize = 20;
        let Some(refinement) = self.left_behind.get_mut(place) else {
            self.refinements.append(&mut self.left_behind);
            return Stage::Done;
        };
        (0..STEPS).for_each(|_| refinement.step(&self.points, &self.limits));
        let (_, most) = ROUNDS[ROUNDS.len() - 1];
        match refinement.is_done || step + STEPS >= most {
            true => Stage::Complete { place: place + 1, step: 0 },
            false => Stage::Complete { place, step: step + STEPS },
        }
    }

    /// The matching of the target with the circuit of a refined linkage, in the direction that is nearer.
    fn matching(&self, refinement: &Refinement) -> Option<Matching> {
        let Refinement { linkage, poses, .. } = refinement;
        if let Some(timing) = refinement.timing() {
            return timing.matching(linkage, poses, &self.points);
        }
        let mut circuit = self.circuit_of(linkage, &poses[0]);
        let forward = Matching::new(linkage, &circuit, &self.points)?;
        circuit.reverse();
        let backward = Matching::new(linkage, &circuit, &self.points)?;
        Some(if backward.sum < forward.sum { backward } else { forward })
    }

    /// A linkage near another one.
    fn scattered(&mut self, from: &Parameters) -> Parameters {
        /// The spread of the logarithms of lengths.
        const SPREAD: f64 = 0.3;
        let mut next = || {
            // The sum of four even numbers is nearly normal.
            let even = || {
                self.random ^= self.random << 13;
                self.random ^= self.random >> 7;
                self.random ^= self.random << 17;
                (self.random >> 11) as f64 / (1u64 << 53) as f64 - 0.5
            };
            let sum: f64 = std::iter::repeat_with(even).take(4).sum();
            SPREAD * 3f64.sqrt() * sum
        };
        let mut scaled = |length: f64| length * trig::exp(next());
        let [frame, crank, coupler, rocker] = [from.frame, from.crank, from.coupler, from.rocker].map(&mut scaled);
        let mut by = [0.0; COUNT];
        by[0] = 0.3 * next();
        by[1] = 0.3 * next();
        by[2] = 0.5 * next();
        by[7] = length(from.point) * next();
        by[8] = length(from.point) * next();
        Parameters { frame, crank, coupler, rocker, ..from.moved(&by) }
    }

    /// Keeps the nearest refinements that are not alike; those that are left behind.
    fn keep_nearest(&mut self, most: usize) -> Vec<Refinement> {
        /// Refinements that have found the same linkage differ by less than this.
        const ALIKE: f64 = 1e-6;
        self.refinements.sort_by(|a, b| a.sum.total_cmp(&b.sum));
        let is_alike = |a: &Refinement, b: &Refinement| {
            (a.sum - b.sum).abs() <= ALIKE * b.sum && (a.linkage.frame - b.linkage.frame).abs() <= ALIKE
        };
        self.refinements.dedup_by(|a, b| is_alike(a, b));
        self.refinements.split_off(most.max(1).min(self.refinements.len()))
    }

    /// Keeps the refinements whose curve has about the length of the target.
    fn keep_valid(&mut self) {
        let mut refinements = std::mem::take(&mut self.refinements);
        refinements.retain(|refinement| self.has_valid_length(refinement));
        self.refinements = refinements;
    }

    fn has_valid_length(&self, refinement: &Refinement) -> bool {
        match self.target.kind() {
            PathKind::Closed => is_valid_ratio(self.whole_length_ratio(refinement)),
            PathKind::Open => true,
            PathKind::Part => {
                let matching = self.matching(refinement);
                matching.is_some_and(|matching| is_valid_ratio(matching.portion_length / self.polyline_length))
            }
        }
    }

    /// The samples of the circuit that a pose is on.
    fn circuit_of(&self, linkage: &Parameters, pose: &Pose) -> Vec<Pose> {
        let distance = |circuit: &Vec<Pose>| {
            let square =
                |other: &Pose| (other.crank - pose.crank).norm_sqr() + (other.coupler - pose.coupler).norm_sqr();
            circuit.iter().map(square).fold(f64::INFINITY, f64::min)
        };
        let circuits = linkage.circuits(self.index.directions()).into_iter();
        circuits.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or_default()
    }

    /// The length of the whole curve relative to that of the target's polyline.
    fn whole_length_ratio(&self, Refinement { linkage, poses, .. }: &Refinement) -> f64 {
        closed_length(&linkage.curve(&self.circuit_of(linkage, &poses[0]))) / self.polyline_length
    }

    /// The answers that have been found so far, the nearest first. Those whose curves are the same to a thousandth of the
    /// target's size are one.
    pub fn answers(&self) -> Vec<Answer> {
        /// The distance up to which curves are the same, in sizes of the target.
        const SAME: f64 = 1e-3;
        let is_same = |a: &[Complex], b: &[Complex]| a.iter().zip(b).all(|(a, b)| length(a - b) <= SAME);
        let mut found: Vec<(Fit, Vec<Complex>)> = Vec::new();
        for fit in self.refinements.iter().filter_map(|refinement| self.fit(refinement)) {
            let feet = fit.linkage.curve(&fit.matching.poses);
            match found.iter_mut().find(|(_, other)| is_same(other, &feet)) {
                Some((other, _)) if other.matching.sum <= fit.matching.sum => {}
                Some(other) => *other = (fit, feet),
                None => found.push((fit, feet)),
            }
        }
        found.sort_by(|a, b| a.0.matching.sum.total_cmp(&b.0.matching.sum));
        found.into_iter().filter_map(|(fit, _)| self.answer(&fit)).take(self.options.most).collect()
    }

    /// How a refined linkage fits the target; `None` if it is not valid.
    fn fit(&self, refinement: &Refinement) -> Option<Fit> {
        let linkage = refinement.linkage;
        if !self.limits.are_satisfied(&linkage) {
            return None;
        }
        let matching = self.matching(refinement)?;
        let length_ratio = match self.target.kind() {
            PathKind::Closed => self.whole_length_ratio(refinement),
            PathKind::Open | PathKind::Part => matching.portion_length / self.polyline_length,
        };
        let is_valid = self.target.kind() == PathKind::Open || is_valid_ratio(length_ratio);
        is_valid.then_some(Fit { linkage, matching, length_ratio })
    }

    /// The answer of a fit, if one of the four-bars that trace its curve meets the constraints.
    fn answer(&self, Fit { linkage, matching, length_ratio }: &Fit) -> Option<Answer> {
        let (size, centre) = self.target.placement();
        let original = linkage.transformed(Complex::new(size, 0.0), centre);
        let placed = original.to_placed();
        let poses: Vec<[Point; 2]> = matching.poses.iter().map(|pose| original.pins(pose)).collect();
        // A point on a pin has no cognates.
        let all = match Cognates::from_four_bar(placed) {
            Ok(cognates) => cognates.all().to_vec(),
            Err(_) => Vec::new(),
        };
        let solve = |cognate: &Cognate| {
            let pins = |[a, b]: &[Point; 2]| cognate.pins([placed.pivots[0], *a, *b, placed.pivots[1]]);
            let pins: Vec<[Point; 2]> = poses.iter().map(pins).collect();
            // One of the cognates has another timing: its crank moves as the rocker of this one.
            let cranks = || pins.iter().map(|[crank, _]| *crank);
            let is_kept = |[timing, _]: &[Timing; 2]| timing.is_kept(cognate.four_bar.pivots[0], cranks());
            let is_timed = self.timing.as_ref().is_none_or(is_kept);
            if is_timed { self.mechanism(cognate.four_bar, &pins) } else { None }
        };
        let mut mechanisms: Vec<Mechanism> = match all.is_empty() {
            true => self.mechanism(placed, &poses).into_iter().collect(),
            false => all.iter().filter_map(solve).collect(),
        };
        let angle = |mechanism: &Mechanism| if mechanism.meets_constraints { mechanism.mu_worst_deg } else { f64::NAN };
        let best = (0..mechanisms.len()).filter(|k| mechanisms[*k].meets_constraints);
        let best = best.reduce(|best, k| if angle(&mechanisms[k]) > angle(&mechanisms[best]) { k } else { best })?;
        mechanisms[..=best].rotate_right(1);
        let rms_relative = (matching.sum / self.points.len() as f64).sqrt();
        Some(Answer {
            mechanism: mechanisms.remove(0),
            cognates: mechanisms,
            rms: size * rms_relative,
            rms_relative,
            greatest: size * matching.greatest,
            is_in_order: matching.is_in_order,
            length_ratio: *length_ratio,
        })
    }

    /// A four-bar, solved, with its pins at each point of the target.
    fn mechanism(&self, four_bar: PlacedFourBar, pins: &[[Point; 2]]) -> Option<Mechanism> {
        let mut mechanism = Mechanism::solve(four_bar, pins, self.options.condition.as_ref())?;
        let (size, centre) = self.target.placement();
        let normalized = Parameters::from_placed(&four_bar).transformed(Complex::new(1.0 / size, 0.0), -centre / size);
        mechanism.meets_constraints &= self.limits.are_nearly_satisfied(&normalized);
        Some(mechanism)
    }
}

/// A linkage with its points that are matched with those of the target.
struct Fit {
    linkage: Parameters,
    matching: Matching,
    length_ratio: f64,
}

impl Query {
    /// The query for a path.
    fn new(kind: PathKind, points: &[Complex], index: &Index) -> Query {
        match kind {
            PathKind::Closed => {
                let (spectrum, centre, size) = index.transform().spectrum(points);
                Query::Whole(spectrum, centre, size)
            }
            PathKind::Open | PathKind::Part => Query::Portion(Stroke::new(points)),
        }
    }
}

fn is_valid_ratio(length_ratio: f64) -> bool {
    (LENGTH_RATIOS[0]..=LENGTH_RATIOS[1]).contains(&length_ratio)
}

/// The two other four-bars that trace the same curve.
fn cognates(linkage: &Parameters) -> Vec<Parameters> {
    let Ok(cognates) = Cognates::from_four_bar(linkage.to_placed()) else { return Vec::new() };
    cognates.others.iter().map(|cognate| Parameters::from_placed(&cognate.four_bar)).collect()
}

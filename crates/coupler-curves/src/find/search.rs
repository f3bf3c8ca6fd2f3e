//! The search: from the curves of an index that are most like the target to the linkages whose curves are nearest to it.

use super::answer::{Answer, LENGTH_RATIOS};
use super::complex::{Complex, closed_length, dot, length, times_i};
use super::constraints::Limits;
use super::index::Index;
use super::matching::{Matching, nearest_samples};
use super::options::{Effort, Options};
use super::parameters::{COUNT, Parameters};
use super::pose::Pose;
use super::refinement::Refinement;
use super::spectrum::Spectrum;
use super::target::Target;
use crate::geometry::trig;
use crate::linkage::{Cognates, Side};

/// A search in bounded steps.
pub struct Search<'i> {
    index: &'i Index,
    target: Target,
    options: Options,
    limits: Limits,
    /// The points of the target with centroid 0 and size 1, and the length of their polygon.
    points: Vec<Complex>,
    polygon_length: f64,
    spectrum: Spectrum,
    /// The size and the centroid of the points at equal distances along the polygon.
    even_size: f64,
    even_centre: Complex,
    stage: Stage,
    best: Vec<(f32, usize)>,
    /// Their linkages on the target, with how much their curves are like it.
    placed: Vec<(f64, Parameters)>,
    refinements: Vec<Refinement>,
    /// Whether the nearest curve has been looked up in place of the target, and the refinements from before.
    has_looked_again: bool,
    kept: Vec<Refinement>,
    random: u64,
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
    Done,
}

/// The curves of a step of comparison.
const CURVES_PER_STEP: usize = 4096;

/// The curves that are compared exactly, for each that is refined.
const EXACT_PER_START: usize = 3;

/// The parts of the starts that are refined in each round, and the steps of a round.
const ROUNDS: [(usize, usize); 4] = [(1, 6), (3, 10), (8, 30), (20, 60)];

/// The steps after a restart, and those after which it must be near the best.
const RESTART_STEPS: usize = 60;
const PROMISING_STEPS: usize = 15;
const PROMISING_SUM: f64 = 30.0;

impl<'i> Search<'i> {
    /// Begins a search.
    pub fn new(target: &Target, index: &'i Index, options: Options) -> Search<'i> {
        let points = target.normalized();
        let (spectrum, even_centre, even_size) = index.transform().spectrum(&points);
        let (size, centre) = target.placement();
        let corner = |x: f64, y: f64| (Complex::new(x, y) - centre) / size;
        let pivots = options.pivots.map(|b| [corner(b.min.x, b.min.y), corner(b.max.x, b.max.y)]);
        let limits = Limits { full_turn: options.full_turn, max_link: options.max_link, pivots };
        Search {
            index,
            target: target.clone(),
            options,
            limits,
            polygon_length: target.polygon_length(),
            points,
            spectrum,
            even_size,
            even_centre,
            stage: Stage::Compare(0),
            best: Vec::new(),
            placed: Vec::new(),
            refinements: Vec::new(),
            has_looked_again: false,
            kept: Vec::new(),
            random: 0x9E37_79B9_7F4A_7C15,
        }
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
            Stage::Done => Stage::Done,
        };
        self.stage != Stage::Done
    }

    fn start_count(&self) -> usize {
        match self.options.effort {
            Effort::Quick => 70,
            Effort::Normal => 200,
            Effort::Thorough => 800,
        }
    }

    fn restart_count(&self) -> usize {
        self.start_count() / 10
    }

    fn compare(&mut self, from: usize) -> Stage {
        let query = (&self.spectrum, self.polygon_length, self.limits.full_turn);
        let best = std::mem::take(&mut self.best);
        let most = EXACT_PER_START * self.start_count();
        let to = from + CURVES_PER_STEP;
        self.best = self.index.nearest(query, from..to, best, most);
        if to < self.index.len() { Stage::Compare(to) } else { Stage::Place(0) }
    }

    /// Places a curve of the index on the target, where it is most like it.
    fn place(&mut self, place: usize) -> Stage {
        let Some(&(_, number)) = self.best.get(place) else {
            self.placed.sort_by(|a, b| b.0.total_cmp(&a.0));
            self.placed.truncate(self.start_count() / if self.has_looked_again { 2 } else { 1 });
            return Stage::Begin(0);
        };
        if let Some(entry) = self.index.entry(number) {
            let (spectrum, centre, size, _) = self.index.spectrum(&entry);
            let likeness = self.index.transform().likeness(&self.spectrum, &spectrum);
            let (linkage, centre) = match likeness.is_mirrored {
                true => (entry.linkage.mirrored(), centre.conj()),
                false => (entry.linkage, centre),
            };
            let factor = likeness.factor * (self.even_size / size);
            self.placed.push((likeness.value, linkage.transformed(factor, self.even_centre - factor * centre)));
        }
        Stage::Place(place + 1)
    }

    /// Begins to refine a linkage that is placed.
    fn begin_placed(&mut self, place: usize) -> Stage {
        let Some((_, linkage)) = self.placed.get(place) else {
            return Stage::Refine { round: 0, place: 0, step: 0 };
        };
        self.refinements.extend(self.begin(linkage));
        Stage::Begin(place + 1)
    }

    /// Begins a refinement from a linkage near the limits, on the circuit and in the direction that are nearest to the target.
    fn begin(&self, linkage: &Parameters) -> Option<Refinement> {
        let linkage = self.limits.nearest(linkage, linkage.frame >= linkage.crank)?;
        let mut best: Option<(f64, Vec<Pose>)> = None;
        for mut circuit in linkage.circuits(self.index.directions()) {
            for _ in 0..2 {
                let (sum, poses) = nearest_samples(&linkage, &circuit, &self.points)?;
                if best.as_ref().is_none_or(|(least, _)| sum < *least) {
                    best = Some((sum, poses));
                }
                circuit.reverse();
            }
        }
        Refinement::new(linkage, &best?.1, &self.points)
    }

    fn refine(&mut self, round: usize, place: usize, step: usize) -> Stage {
        let Some(&(_, steps)) = ROUNDS.get(round) else { return self.look_again() };
        let Some(refinement) = self.refinements.get_mut(place) else {
            let next = ROUNDS.get(round + 1).map_or(1, |(part, _)| *part);
            self.keep_valid();
            self.keep_nearest(self.start_count() / next);
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
        let circuit = self.circuit_of(&best.linkage, &best.poses[0]);
        let points: Vec<Complex> = circuit.iter().map(|pose| best.linkage.coupler_point(pose)).collect();
        (self.spectrum, self.even_centre, self.even_size) = self.index.transform().spectrum(&points);
        self.has_looked_again = true;
        self.kept = std::mem::take(&mut self.refinements);
        self.best.clear();
        self.placed.clear();
        Stage::Compare(0)
    }

    fn restart(&mut self, count: usize) -> Stage {
        /// So many of the best have their cognates tried; then linkages near them.
        const COGNATES: usize = 6;
        /// The mean square of the distances at which a target is met to rounding.
        const EXACT: f64 = 1e-16;
        self.keep_nearest(self.start_count() / ROUNDS[ROUNDS.len() - 1].0);
        let Some(best) = self.refinements.first() else { return Stage::Done };
        if count == self.restart_count() || best.sum <= EXACT * self.points.len() as f64 {
            return Stage::Polish(0);
        }
        let promising = PROMISING_SUM * best.sum;
        let from = self.refinements[count % self.refinements.len().min(COGNATES)].linkage;
        let starts: Vec<Parameters> = match count < COGNATES {
            true => cognates(&from),
            false => vec![self.scattered(&from), self.scattered(&from)],
        };
        for start in starts {
            let Some(mut refinement) = self.begin(&start) else { continue };
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
        Stage::Restart(count + 1)
    }

    /// Refines a linkage in the order of the target's points: those that share a pose are replaced by their mean.
    fn polish(&mut self, place: usize) -> Stage {
        const STEPS: usize = 20;
        let Some(refinement) = self.refinements.get(place) else { return Stage::Done };
        if let Some((matching, _)) = self.matching(&refinement.linkage, &refinement.poses[0])
            && !matching.is_in_order
            && let Some(mut polished) = Refinement::new(refinement.linkage, &matching.poses, &matching.means)
        {
            (0..STEPS).for_each(|_| polished.step(&matching.means, &self.limits));
            let better = self.matching(&polished.linkage, &polished.poses[0]);
            if let Some((better, _)) = better.filter(|(better, _)| better.sum < matching.sum) {
                (polished.sum, polished.poses) = (better.sum, better.poses);
                self.refinements[place] = polished;
            }
        }
        Stage::Polish(place + 1)
    }

    /// The matching of the target with the circuit of a pose, in the direction that is nearer, and whether that is the
    /// opposite one.
    fn matching(&self, linkage: &Parameters, pose: &Pose) -> Option<(Matching, bool)> {
        let mut circuit = self.circuit_of(linkage, pose);
        let forward = Matching::new(linkage, &circuit, &self.points)?;
        circuit.reverse();
        let backward = Matching::new(linkage, &circuit, &self.points)?;
        let is_reversed = backward.sum < forward.sum;
        Some((if is_reversed { backward } else { forward }, is_reversed))
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

    /// Keeps the nearest refinements that are not alike.
    fn keep_nearest(&mut self, most: usize) {
        /// Refinements that have found the same linkage differ by less than this.
        const ALIKE: f64 = 1e-6;
        self.refinements.sort_by(|a, b| a.sum.total_cmp(&b.sum));
        let is_alike = |a: &Refinement, b: &Refinement| {
            (a.sum - b.sum).abs() <= ALIKE * b.sum && (a.linkage.frame - b.linkage.frame).abs() <= ALIKE
        };
        self.refinements.dedup_by(|a, b| is_alike(a, b));
        self.refinements.truncate(most.max(1));
    }

    /// Keeps the refinements whose curve has about the length of the target.
    fn keep_valid(&mut self) {
        let mut refinements = std::mem::take(&mut self.refinements);
        refinements.retain(|refinement| self.has_valid_length(refinement));
        self.refinements = refinements;
    }

    fn has_valid_length(&self, refinement: &Refinement) -> bool {
        is_valid_ratio(self.length_ratio(refinement))
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

    /// The length of the curve relative to that of the target's polygon.
    fn length_ratio(&self, Refinement { linkage, poses, .. }: &Refinement) -> f64 {
        closed_length(&linkage.curve(&self.circuit_of(linkage, &poses[0]))) / self.polygon_length
    }

    /// The answers that have been found so far, the nearest first. Those whose curves are the same to a thousandth of the
    /// target's size are one.
    pub fn answers(&self) -> Vec<Answer> {
        /// The distance up to which curves are the same, in sizes of the target.
        const SAME: f64 = 1e-3;
        let mut found: Vec<(Answer, Vec<Complex>)> = Vec::new();
        let mut refinements: Vec<&Refinement> = self.refinements.iter().collect();
        refinements.sort_by(|a, b| a.sum.total_cmp(&b.sum));
        for refinement in refinements {
            let Some((answer, feet)) = self.answer(refinement) else { continue };
            let is_same =
                |(_, other): &(Answer, Vec<Complex>)| other.iter().zip(&feet).all(|(a, b)| length(a - b) <= SAME);
            if !found.iter().any(is_same) {
                found.push((answer, feet));
            }
        }
        found.sort_by(|a, b| a.0.rms.total_cmp(&b.0.rms));
        found.truncate(self.options.most);
        found.into_iter().map(|(answer, _)| answer).collect()
    }

    /// The answer of a refinement, with the feet of the target's points.
    fn answer(&self, refinement: &Refinement) -> Option<(Answer, Vec<Complex>)> {
        let linkage = refinement.linkage;
        let length_ratio = self.length_ratio(refinement);
        if !is_valid_ratio(length_ratio) || !self.limits.are_satisfied(&linkage) {
            return None;
        }
        let (matching, is_reversed) = self.matching(&linkage, &refinement.poses[0])?;
        let rms_relative = (matching.sum / self.points.len() as f64).sqrt();
        let (size, centre) = self.target.placement();
        let first = &matching.poses[0];
        let to_pivot = linkage.frame * linkage.direction - linkage.crank * first.crank;
        let is_left = dot(times_i(to_pivot), first.coupler) >= 0.0;
        let answer = Answer {
            linkage: linkage.transformed(Complex::new(size, 0.0), centre).to_placed(),
            side: if is_left { Side::Left } else { Side::Right },
            rms: size * rms_relative,
            rms_relative,
            greatest: size * matching.greatest,
            is_in_order: matching.is_in_order,
            is_reversed,
            length_ratio,
        };
        Some((answer, linkage.curve(&matching.poses)))
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

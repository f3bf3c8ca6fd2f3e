//! The answers of a search: refined linkages without those whose curves are the same, with their cognates.

use crate::answer::Answer;
use crate::deviation::Deviation;
use crate::distinct::{OUTLINE_POINTS, are_same};
use crate::four_bar::fitting::{Fit, Fitting};
use crate::four_bar::index::Index;
use crate::four_bar::mechanism::Mechanism;
use crate::four_bar::parameters::Parameters;
use crate::four_bar::timing::Timing;
use crate::options::Options;
use crate::search::four_bars::Search;
use crate::shape::spectrum::directions;
use crate::target::Target;
use crate::timing::TimedPoints;
use coupler_curves::geometry::Point;
use coupler_curves::linkage::{Cognate, Cognates, PlacedFourBar};

/// Makes the answers of a search so far, the nearest first. Those whose curves are the same to a thousandth of the target's size are
/// one. The search takes no step meanwhile.
#[derive(Default)]
pub struct Ranking {
    /// How many refinements are fitted.
    fitted: usize,
    fits: Vec<Fit>,
    /// The number of the next fit, in the order of their deviations.
    next: usize,
    answers: Vec<Answer>,
    /// The curves of the answers, with centroid 0 and size 1 of the target.
    outlines: Vec<Vec<Point>>,
}

impl Ranking {
    /// Takes a step, of a few milliseconds at most for a target of a hundred points; false if nothing is left to do.
    pub fn step(&mut self, search: &Search) -> bool {
        let (fitting, refinements, most) = search.results();
        if let Some(refinement) = refinements.get(self.fitted) {
            self.fitted += 1;
            self.fits.extend(fitting.fit(refinement));
            return true;
        }
        if self.next == 0 {
            self.fits.sort_by(|a, b| a.matching.sum.total_cmp(&b.matching.sum));
        }
        let Some(fit) = self.fits.get(self.next).filter(|_| self.answers.len() < most) else { return false };
        self.next += 1;
        let outline = fitting.outline(fit);
        if !self.outlines.iter().any(|other| are_same(other, &outline, 1.0))
            && let Some(answer) = fitting.answer(fit)
        {
            self.answers.push(answer);
            self.outlines.push(outline);
        }
        true
    }

    /// The answers.
    pub fn into_answers(self) -> Vec<Answer> {
        self.answers
    }
}

impl Target {
    /// The four-bars whose curves are nearest, the nearest first, from an index of [`Index::DEFAULT_COUNT`] curves. That takes half a second to
    /// compute: for several targets, make one and call [`Search::run`].
    pub fn search(&self, options: &Options) -> Vec<Answer> {
        Search::new(self, options.clone()).run(&Index::with_count(Index::DEFAULT_COUNT))
    }
}

impl Search {
    /// Searches to the end.
    pub fn run(mut self, index: &Index) -> Vec<Answer> {
        while self.step(index) {}
        self.answers()
    }

    /// The answers that have been found so far, the nearest first. Those whose curves are the same to a thousandth of the
    /// target's size are one. A [`Ranking`] makes them in steps.
    pub fn answers(&self) -> Vec<Answer> {
        let mut ranking = Ranking::default();
        while ranking.step(self) {}
        ranking.into_answers()
    }
}

impl Fitting {
    /// Points of the curve of a fit.
    fn outline(&self, Fit { linkage, matching, .. }: &Fit) -> Vec<Point> {
        let circuit = linkage.circuit_of(&matching.poses[0], &directions(OUTLINE_POINTS));
        linkage.curve(&circuit).into_iter().map(|z| Point::new(z.re, z.im)).collect()
    }

    /// The answer of a fit, if one of the four-bars that trace its curve meets the constraints.
    fn answer(&self, Fit { linkage, matching, length_ratio }: &Fit) -> Option<Answer> {
        let size = self.target.size();
        let original = linkage.transformed(&self.target.placement());
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
            let is_kept =
                |([timing, _], _): &([Timing; 2], TimedPoints)| timing.is_kept(cognate.four_bar.pivots[0], cranks());
            let is_timed = self.timing.as_ref().is_none_or(is_kept);
            if is_timed { self.mechanism(cognate.four_bar, &pins) } else { None }
        };
        let mut mechanisms: Vec<Mechanism> = match all.is_empty() {
            true => self.mechanism(placed, &poses).into_iter().collect(),
            false => all.iter().filter_map(solve).collect(),
        };
        let best = (0..mechanisms.len()).filter(|k| mechanisms[*k].meets_constraints);
        let best = best.reduce(|best, k| if is_better(&mechanisms[k], &mechanisms[best]) { k } else { best })?;
        mechanisms[..=best].rotate_right(1);
        let rms_relative = (matching.sum / self.points.len() as f64).sqrt();
        Some(Answer {
            mechanism: mechanisms.remove(0),
            cognates: mechanisms,
            deviation: Deviation {
                rms: size * rms_relative,
                rms_relative,
                greatest: size * matching.greatest,
                is_in_order: matching.is_in_order,
                length_ratio: *length_ratio,
            },
        })
    }

    /// A four-bar, solved, with its pins at each point of the target.
    fn mechanism(&self, four_bar: PlacedFourBar, pins: &[[Point; 2]]) -> Option<Mechanism> {
        let mut mechanism = Mechanism::solve(four_bar, pins, self.limits.condition.as_ref())?;
        let normalized = Parameters::from_placed(&four_bar).transformed(&self.target.placement().inverse());
        mechanism.meets_constraints &= self.limits.are_nearly_satisfied(&normalized);
        Some(mechanism)
    }
}

/// Whether a four-bar leads an answer rather than its cognate: it transmits force better, or as well and has shorter links. Often two of three
/// have the same worst angle but for rounding.
fn is_better(one: &Mechanism, other: &Mechanism) -> bool {
    /// In degrees.
    const ROUNDING: f64 = 1e-6;
    let difference = one.mu_worst_deg - other.mu_worst_deg;
    difference > ROUNDING || difference.abs() <= ROUNDING && one.longest_link() < other.longest_link()
}

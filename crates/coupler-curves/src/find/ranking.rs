//! The answers of a search, made from its refinements in bounded steps.

use super::answer::Answer;
use super::complex::{Complex, length};
use super::search::{Fit, Search};

/// Makes the answers of a search so far, the nearest first. Those whose curves are the same to a thousandth of the target's size are
/// one. The search takes no step meanwhile.
#[derive(Default)]
pub struct Ranking {
    /// How many refinements are compared.
    compared: usize,
    /// The fits that differ, with the points of the curves at those of the target.
    found: Vec<(Fit, Vec<Complex>)>,
    /// The answers that are made, and the number of the next fit.
    answers: Vec<Answer>,
    next: usize,
}

impl Ranking {
    /// Takes a step, of a few milliseconds at most for a target of a hundred points; false if nothing is left to do.
    pub fn step(&mut self, search: &Search) -> bool {
        if let Some(refinement) = search.refinements().get(self.compared) {
            self.compared += 1;
            if let Some(fit) = search.fit(refinement) {
                self.add(fit);
            }
            return true;
        }
        if self.next == 0 {
            self.found.sort_by(|a, b| a.0.matching.sum.total_cmp(&b.0.matching.sum));
        }
        if self.answers.len() == search.most_answers() {
            return false;
        }
        let Some((fit, _)) = self.found.get(self.next) else { return false };
        self.answers.extend(search.answer(fit));
        self.next += 1;
        true
    }

    /// Adds a fit, unless one that is at least as near has the same curve.
    fn add(&mut self, fit: Fit) {
        /// The distance up to which curves are the same, in sizes of the target.
        const SAME: f64 = 1e-3;
        let is_same = |a: &[Complex], b: &[Complex]| a.iter().zip(b).all(|(a, b)| length(a - b) <= SAME);
        let feet = fit.linkage.curve(&fit.matching.poses);
        match self.found.iter_mut().find(|(_, other)| is_same(other, &feet)) {
            Some((other, _)) if other.matching.sum <= fit.matching.sum => {}
            Some(other) => *other = (fit, feet),
            None => self.found.push((fit, feet)),
        }
    }

    /// The answers.
    pub fn into_answers(self) -> Vec<Answer> {
        self.answers
    }
}

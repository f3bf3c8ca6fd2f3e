//! The order of answers of several linkages.

use super::answer::LinkageAnswer;
use crate::distinct::distinct;

/// A linkage whose worst transmission angle is smaller jams, in degrees.
pub const JAM_DEG: f64 = 5.0;

/// Up to this part of the target's size curves are exact, and the simpler linkage is the better one.
const EXACT: f64 = 1e-4;

/// The most links of the linkages that are searched together.
const MOST_LINKS: usize = 6;

impl LinkageAnswer {
    /// The number of its links, with the frame.
    pub fn link_count(&self) -> usize {
        self.family.template.structure().map_or(0, |linkage| linkage.links.len())
    }

    /// Whether it jams: its worst transmission angle is less than [`JAM_DEG`]. Of a linkage without one it is not known.
    pub fn jams(&self) -> bool {
        self.curve.mu_worst_deg < JAM_DEG
    }
}

/// Those that do not jam before those that do; of these the nearest first, and of those that are exact the one with the fewest links. Of those whose
/// curves are the same for a target of a size only the one with the fewest links is kept; at most so many.
pub fn ranked(mut answers: Vec<LinkageAnswer>, size: f64, most: usize) -> Vec<LinkageAnswer> {
    let deviation = |answer: &LinkageAnswer| answer.curve.fit.deviation.rms_relative;
    let nearest = |a: &LinkageAnswer, b: &LinkageAnswer| deviation(a).total_cmp(&deviation(b));
    answers.sort_by(|a, b| (a.jams(), a.link_count()).cmp(&(b.jams(), b.link_count())).then_with(|| nearest(a, b)));
    let mut answers = distinct(answers, |answer| &answer.curve.outline, size, usize::MAX);
    let links = |answer: &LinkageAnswer| if deviation(answer) <= EXACT { answer.link_count() } else { usize::MAX };
    answers.sort_by(|a, b| (a.jams(), links(a)).cmp(&(b.jams(), links(b))).then_with(|| nearest(a, b)));
    // The nearest with few links is shown, too, if those with more are all nearer.
    let mut best = [f64::INFINITY; MOST_LINKS + 1];
    for answer in &answers {
        let links = answer.link_count().min(MOST_LINKS);
        best[links] = best[links].min(if answer.jams() { f64::INFINITY } else { deviation(answer) });
    }
    let is_best = |answer: &LinkageAnswer| {
        let links = answer.link_count().min(MOST_LINKS);
        !answer.jams() && deviation(answer) == best[links] && best[..links].iter().all(|other| *other > best[links])
    };
    let shown_besides = answers.iter().skip(most).filter(|answer| is_best(answer)).count();
    let mut left = most.saturating_sub(shown_besides);
    answers.retain(|answer| {
        let is_kept = left > 0 || is_best(answer);
        left = left.saturating_sub(1);
        is_kept
    });
    answers.truncate(most);
    answers
}

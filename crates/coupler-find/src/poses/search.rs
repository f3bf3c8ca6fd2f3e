//! The search for linkages that guide a body through poses.

use std::collections::BTreeMap;

use super::answer::{Candidate, PoseAnswer};
use super::body::PoseSet;
use super::difference::{are_apart, are_different, joints};
use super::dyad::Dyad;
use super::dyad_space::{DyadPlace, DyadSpace, Freedom};
use super::findings::{PairLeftOut, PoseFindings, PoseOptions, placed_dyad, wish};
use super::guide::{Form, Guide};
use super::pair::{Misfit, Passing, PosedDyad, Wish, order, passing, pins};
use crate::options::Effort;
use crate::scatter::Scatter;
use crate::workers::Workers;
use coupler_curves::linkage::{FourBar, PlacedFourBar};

/// A pair of dyads, and how it passes the poses.
#[derive(Clone, Copy, Debug)]
struct Scored {
    places: [DyadPlace; 2],
    passing: Passing,
}

impl Scored {
    /// Which of two is better: of two that jam alike but for rounding, as parallelograms do where all links are in line, the one that
    /// transmits better from the first pose to the last. What transmits as well as none can is not bettered: a slot of hardly any offset, whose
    /// line is known by fewer digits.
    fn cmp(&self, other: &Scored) -> std::cmp::Ordering {
        const ROUNDING: f64 = 1e-9;
        const BEST: f64 = 1e-5;
        let key = |Scored { passing, .. }: &Scored| {
            ((passing.ranked_cosine.max(BEST) / ROUNDING).round(), passing.worst_cosine.max(BEST))
        };
        let [(a, b), (c, d)] = [key(self), key(other)];
        a.total_cmp(&c).then(b.total_cmp(&d))
    }
}

/// Finds linkages that guide a body through 2 to 5 poses exactly.
pub fn exact_guides(set: &PoseSet, options: &PoseOptions, workers: &impl Workers) -> PoseFindings {
    let space = DyadSpace::new(set, options.pivots, &options.given_pivots);
    let search = Search { set, options, space, wish: wish(options) };
    search.run(workers)
}

struct Search<'a> {
    set: &'a PoseSet,
    options: &'a PoseOptions,
    space: DyadSpace,
    wish: Wish,
}

impl Search<'_> {
    fn run(&self, workers: &impl Workers) -> PoseFindings {
        let places = self.space.places(self.sample_count());
        let posed: Vec<(DyadPlace, PosedDyad)> =
            places.into_iter().filter_map(|place| Some((place, self.posed(&place)?))).collect();
        let (mut scored, mut left_out) = self.scored(&posed, workers);
        scored.sort_by(Scored::cmp);
        let is_finite = self.space.freedom() == Freedom::Points;
        if !is_finite {
            self.refine(&mut scored, workers);
        }
        if !is_finite && self.options.condition.is_some() {
            scored = self.spread(scored);
        }
        let mut pairs_left_out = if is_finite { self.pairs_left_out(&posed) } else { Vec::new() };
        let answers = self.solved(&scored, (&mut left_out, &mut pairs_left_out), workers);
        let cranks = (0..posed.len()).filter(|k| is_crank(&posed[*k].1));
        let pairs = cranks.map(|k| self.followers(&posed, k).count()).sum();
        PoseFindings {
            freedom: self.space.freedom(),
            dyads: posed.iter().map(|(_, dyad)| placed_dyad(self.set, &dyad.dyad)).collect(),
            pairs,
            left_out,
            pairs_left_out,
            answers,
        }
    }

    /// The pairs of finitely many dyads that are known not to pass the poses before they are solved.
    fn pairs_left_out(&self, posed: &[(DyadPlace, PosedDyad)]) -> Vec<PairLeftOut> {
        let mut found = Vec::new();
        for (k, (_, crank)) in posed.iter().enumerate().filter(|(_, (_, crank))| is_crank(crank)) {
            for (m, (_, follower)) in posed.iter().enumerate().filter(|(m, _)| *m != k) {
                if let Err(misfit) = self.passing(crank, follower) {
                    let order = if misfit == Misfit::Order { order(crank, follower) } else { Vec::new() };
                    found.push(PairLeftOut { dyads: [k + 1, m + 1], misfit, order });
                }
            }
        }
        found
    }

    /// The dyads with which a crank is tried.
    fn followers<'p>(
        &self,
        posed: &'p [(DyadPlace, PosedDyad)],
        crank: usize,
    ) -> impl Iterator<Item = &'p (DyadPlace, PosedDyad)> {
        let others = posed.iter().enumerate().filter(move |(m, _)| *m != crank).map(|(_, other)| other);
        others.filter(move |(place, _)| self.space.has_given([&posed[crank].0, place]))
    }

    /// The number of samples of infinitely many dyads.
    fn sample_count(&self) -> usize {
        const NORMAL: usize = 2000;
        match self.options.effort {
            Effort::Quick => NORMAL / 2,
            Effort::Normal => NORMAL,
            Effort::Thorough => 2 * NORMAL,
        }
    }

    fn posed(&self, place: &DyadPlace) -> Option<PosedDyad> {
        let posed = PosedDyad::new(self.space.dyad(place)?, self.set.placed());
        // Of infinitely many those with longer links are none; of others it is said that they are left out.
        let is_one_of_few = self.space.freedom() == Freedom::Points || self.space.is_of_given(place);
        (is_one_of_few || posed.reach <= self.wish.max_link).then_some(posed)
    }

    /// Whether a pair passes the poses as asked for, as far as it is known before it is solved.
    fn passing(&self, crank: &PosedDyad, follower: &PosedDyad) -> Result<Passing, Misfit> {
        match &self.options.condition {
            _ if !self.space.contains(&crank.dyad) || !self.space.contains(&follower.dyad) => Err(Misfit::TooFar),
            Some(condition) if !condition.is_of(Form::of(&follower.dyad)) => Err(Misfit::Condition),
            Some(condition) => {
                let passing = passing(crank, follower, &self.wish)?;
                let guide = Guide::new(self.set, &self.set.placed()[0], crank, follower).ok_or(Misfit::NoLinkage)?;
                if condition.admits(&guide) { Ok(passing) } else { Err(Misfit::Condition) }
            }
            None => passing(crank, follower, &self.wish),
        }
    }

    /// The pairs that pass the poses as asked for, and the others by their reasons.
    fn scored(
        &self,
        posed: &[(DyadPlace, PosedDyad)],
        workers: &impl Workers,
    ) -> (Vec<Scored>, BTreeMap<Misfit, usize>) {
        let of_crank = |k: usize| {
            let mut found = Vec::new();
            let mut left_out = BTreeMap::new();
            for (place, follower) in self.followers(posed, k) {
                match self.passing(&posed[k].1, follower) {
                    Ok(passing) => {
                        found.push(Scored { places: [posed[k].0, *place], passing });
                    }
                    Err(misfit) => *left_out.entry(misfit).or_insert(0) += 1,
                }
            }
            // Of many, the best are enough: answers differ.
            found.sort_by(Scored::cmp);
            found.truncate(MOST_OF_CRANK);
            (found, left_out)
        };
        let cranks: Vec<usize> = (0..posed.len()).filter(|k| is_crank(&posed[*k].1)).collect();
        let mut all = Vec::new();
        let mut left_out = BTreeMap::new();
        for (found, misfits) in workers.map(cranks, of_crank) {
            all.extend(found);
            misfits.into_iter().for_each(|(misfit, count)| *left_out.entry(misfit).or_insert(0) += count);
        }
        (all, left_out)
    }

    /// Moves the best pairs to better ones near them, each for itself.
    fn refine(&self, scored: &mut Vec<Scored>, workers: &impl Workers) {
        let mut starts: Vec<Scored> = Vec::new();
        for pair in scored.iter() {
            if starts.len() >= 2 * self.options.most {
                break;
            }
            if starts.iter().all(|other| !are_near(&pair.places, &other.places)) {
                starts.push(*pair);
            }
        }
        let numbered: Vec<(u64, Scored)> = (0..).zip(starts).collect();
        let refined = workers.map(numbered, |(number, start)| self.refined(start, self.options.seed + number));
        scored.splice(0..0, refined);
        scored.sort_by(Scored::cmp);
    }

    /// A pair after steps at random, of which those are kept that better it.
    fn refined(&self, mut best: Scored, seed: u64) -> Scored {
        const STEPS: usize = 300;
        let mut scatter = Scatter::new(seed);
        let mut spread = 0.05;
        for _ in 0..STEPS {
            let mut places = best.places;
            for place in &mut places {
                let free = place.coordinates.iter_mut().take(self.space.dimension());
                free.for_each(|x| *x = (*x + scatter.normal(spread)).clamp(0.0, 1.0));
            }
            let [Some(crank), Some(follower)] = places.map(|place| self.posed(&place)) else { continue };
            match self.passing(&crank, &follower) {
                Ok(passing) if Scored { places, passing }.cmp(&best).is_lt() => {
                    best = Scored { places, passing };
                    spread *= 1.2;
                }
                _ => spread = (0.97 * spread).max(1e-4),
            }
        }
        best
    }

    /// The same in another order: first the best of each neighbourhood, then the second of each, and so on, so that a condition is tried on
    /// pairs of all kinds.
    fn spread(&self, scored: Vec<Scored>) -> Vec<Scored> {
        /// The width of a neighbourhood, in parts of the range of a coordinate.
        const PARTS: f64 = 3.0;
        let mut seen: BTreeMap<Vec<usize>, usize> = BTreeMap::new();
        let key = |pair: &Scored| {
            let of_place = |place: &DyadPlace| {
                let parts = place.coordinates.map(|x| (PARTS * x) as usize);
                [place.number, parts[0], parts[1], parts[2]]
            };
            let places = pair.places.iter().flat_map(of_place);
            places.chain([self.shortest_link(pair)]).collect::<Vec<usize>>()
        };
        let mut numbered: Vec<(usize, Scored)> = Vec::with_capacity(scored.len());
        for pair in scored {
            let count = seen.entry(key(&pair)).or_insert(0);
            numbered.push((*count, pair));
            *count += 1;
        }
        numbered.sort_by_key(|(count, _)| *count);
        numbered.into_iter().map(|(_, pair)| pair).collect()
    }

    /// The number of the shortest link, on which the class depends.
    fn shortest_link(&self, pair: &Scored) -> usize {
        let [Some(crank), Some(follower)] = pair.places.map(|place| self.posed(&place)) else { return 0 };
        match Guide::new(self.set, &self.set.placed()[0], &crank, &follower) {
            Some(Guide::FourBar(PlacedFourBar { lengths: FourBar { frame, crank, coupler, rocker }, .. })) => {
                let lengths = [frame, crank, coupler, rocker];
                (0..4).min_by(|a, b| lengths[*a].total_cmp(&lengths[*b])).unwrap_or(0)
            }
            _ => 0,
        }
    }

    /// The best that differ and pass the poses when they are solved.
    fn solved(
        &self,
        scored: &[Scored],
        (left_out, pairs_left_out): (&mut BTreeMap<Misfit, usize>, &mut Vec<PairLeftOut>),
        workers: &impl Workers,
    ) -> Vec<PoseAnswer> {
        /// How many are solved at once, whatever the number of threads, so that the answer does not depend on it.
        const AT_ONCE: usize = 16;
        /// The most that are solved: with a condition that none meets it takes a few seconds.
        const MOST: usize = 4000;
        let is_finite = self.space.freedom() == Freedom::Points;
        let mut answers: Vec<PoseAnswer> = Vec::new();
        let mut solved = 0;
        let mut rest = scored.iter();
        while answers.len() < self.options.most && solved < MOST {
            let is_new = |pair: &&Scored| is_finite || answers.iter().all(|other| self.differ(pair, other));
            let next: Vec<Scored> = rest.by_ref().filter(is_new).take(AT_ONCE).copied().collect();
            if next.is_empty() {
                break;
            }
            solved += next.len();
            for (pair, result) in workers.map(next, |pair| (pair, self.solve(&pair))) {
                match result {
                    Ok(answer) => {
                        let differs = is_finite || answers.iter().all(|other| are_different(self.set, &answer, other));
                        if differs && answers.len() < self.options.most {
                            answers.push(answer);
                        }
                    }
                    Err(misfit) => {
                        *left_out.entry(misfit).or_insert(0) += 1;
                        if is_finite {
                            let dyads = pair.places.map(|place| place.number + 1);
                            pairs_left_out.push(PairLeftOut { dyads, misfit, order: Vec::new() });
                        }
                    }
                }
            }
        }
        answers
    }

    fn solve(&self, pair: &Scored) -> Result<PoseAnswer, Misfit> {
        let [Some(crank), Some(follower)] = pair.places.map(|place| self.posed(&place)) else {
            return Err(Misfit::NoLinkage);
        };
        let candidate = Candidate { set: self.set, passed: self.set.placed(), crank: &crank, follower: &follower };
        PoseAnswer::solve(&candidate, &self.wish, self.options.condition.as_ref())
    }

    /// Whether a pair differs from an answer, by its pins at the first pose and its pivots.
    fn differ(&self, pair: &Scored, answer: &PoseAnswer) -> bool {
        let [Some(crank), Some(follower)] = pair.places.map(|place| self.posed(&place)) else { return false };
        let mut own = pins(&crank, &follower, 0).to_vec();
        own.extend([&crank, &follower].iter().filter_map(|posed| posed.dyad.pivot()));
        Form::of(&follower.dyad) != answer.guide.form() || are_apart(&own, &joints(self.set, answer))
    }
}

fn is_crank(posed: &PosedDyad) -> bool {
    matches!(posed.dyad, Dyad::Revolute { .. })
}

/// The most pairs that are kept of a crank.
const MOST_OF_CRANK: usize = 100;

/// Whether places of two pairs are near each other.
fn are_near(a: &[DyadPlace; 2], b: &[DyadPlace; 2]) -> bool {
    const NEAR: f64 = 0.05;
    a.iter().zip(b).all(|(a, b)| {
        a.number == b.number && a.coordinates.iter().zip(&b.coordinates).all(|(x, y)| (x - y).abs() < NEAR)
    })
}

#[cfg(test)]
mod tests {
    use super::super::body::BodyPose;
    use super::super::body::random::random_poses;
    use super::super::condition::PoseCondition;
    use super::*;
    use crate::workers::OneAtATime;
    use coupler_curves::geometry::Point;

    fn any() -> PoseOptions {
        PoseOptions {
            full_turn: false,
            max_link: f64::INFINITY,
            effort: Effort::Quick,
            most: 12,
            ..PoseOptions::default()
        }
    }

    #[test]
    fn given_pivots_are_those_of_all_linkages() {
        for (count, freedom) in [(2, Freedom::Space), (3, Freedom::Plane)] {
            let mut found_any = [0, 0];
            for seed in 1..=3 {
                let (set, dyads) = random_poses(count, seed);
                let own = dyads.map(|[pivot, _]| set.place(pivot));
                for given in [&own[..1], &own[..]] {
                    let options = PoseOptions { given_pivots: given.to_vec(), ..any() };
                    let found = exact_guides(&set, &options, &OneAtATime);
                    assert_eq!(found.freedom, freedom);
                    let left_out: usize = found.left_out.values().sum();
                    assert!(left_out <= found.pairs);
                    for answer in &found.answers {
                        let pivots = answer.guide.pivots();
                        let has = |given: &Point| pivots.iter().any(|own| (own - given).norm() <= 1e-14 * set.size());
                        assert!(given.iter().all(has), "{seed}: {pivots:?} and {given:?}");
                        let error = answer.greatest_error();
                        assert!(error.distance < 1e-8 * set.size() && error.angle_deg < 1e-6, "{seed}: {error:?}");
                    }
                    found_any[given.len() - 1] += found.answers.len();
                }
                // Both pivots of three poses leave one linkage, with either of them as that of the crank.
                if count == 3 {
                    let options = PoseOptions { given_pivots: own.to_vec(), ..any() };
                    let found = exact_guides(&set, &options, &OneAtATime);
                    assert_eq!((found.dyads.len(), found.pairs), (2, 2));
                    for (dyad, [_, pin]) in found.dyads.iter().zip(dyads) {
                        assert!((dyad.pin.unwrap() - set.place(pin)).norm() < 1e-7 * set.size(), "{seed}: {dyad:?}");
                    }
                }
            }
            assert!(found_any.iter().all(|count| *count > 0), "{found_any:?}");
        }
    }

    #[test]
    fn the_four_bar_of_five_poses_is_found_and_passes_them() {
        for seed in 1..=40 {
            let (set, dyads) = random_poses(5, seed);
            let found = exact_guides(&set, &any(), &OneAtATime);
            let own = dyads.map(|[pivot, _]| set.place(pivot));
            let is_own = |answer: &&PoseAnswer| {
                let pivots = answer.guide.pivots();
                pivots.len() == 2 && (0..2).all(|k| (pivots[k] - own[k]).norm_squared().sqrt() < 1e-7 * set.size())
            };
            let answer = found.answers.iter().find(is_own);
            let answer = answer.unwrap_or_else(|| panic!("{seed}: {:?}", found.left_out));
            assert!(answer.in_order && answer.on_one_branch);
            let error = answer.greatest_error();
            assert!(error.distance < 1e-8 * set.size() && error.angle_deg < 1e-6, "{seed}: {error:?}");
            let left_out: usize = found.left_out.values().sum();
            assert_eq!(found.answers.len() + left_out, found.pairs, "{seed}");
        }
    }

    #[test]
    fn families_have_linkages_that_pass_two_to_four_poses() {
        for count in 2..=4 {
            for seed in 1..=2 {
                let (set, _) = random_poses(count, seed);
                for full_turn in [false, true] {
                    let options = PoseOptions { full_turn, max_link: 10.0, ..any() };
                    let found = exact_guides(&set, &options, &OneAtATime);
                    assert!(!found.answers.is_empty(), "{count} {seed} {full_turn}: {:?}", found.left_out);
                    for answer in &found.answers {
                        let error = answer.greatest_error();
                        assert!(error.distance < 1e-7 * set.size() && error.angle_deg < 1e-5, "{answer:?}");
                        assert!(answer.in_order && answer.on_one_branch && answer.is_full_turn >= full_turn);
                        assert!(answer.longest_link <= 10.0 * set.size());
                    }
                }
            }
        }
    }

    #[test]
    fn slider_cranks_and_inverted_ones_are_found() {
        let (set, _) = random_poses(3, 7);
        for (condition, form) in
            [("coupler > offset", Form::SliderCrank), ("frame > offset", Form::InvertedSliderCrank)]
        {
            let condition = Some(PoseCondition::new(condition).unwrap());
            let found = exact_guides(&set, &PoseOptions { condition, max_link: 10.0, ..any() }, &OneAtATime);
            assert!(!found.answers.is_empty());
            assert!(found.answers.iter().all(|answer| answer.guide.form() == form));
        }
    }

    #[test]
    fn translations_along_a_circle_are_passed_by_parallelograms() {
        use coupler_curves::geometry::trig;
        let pose = |deg: f64| {
            let (cos, sin) = trig::cos_sin_deg(deg);
            BodyPose { point: Point::new(2.0 + 3.0 * cos, 1.0 + 3.0 * sin), angle_deg: 20.0 }
        };
        let set = PoseSet::new(&[0.0, 20.0, 50.0, 75.0, 90.0].map(pose)).unwrap();
        let found = exact_guides(&set, &any(), &OneAtATime);
        assert_eq!(found.freedom, Freedom::Plane);
        assert!(!found.answers.is_empty(), "{:?}", found.left_out);
    }
}

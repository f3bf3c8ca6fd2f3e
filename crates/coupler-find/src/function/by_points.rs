//! Linkages that are exact at precision points: all, or where the points leave starts open, the best for starts over their whole range.

use std::f64::consts::PI;

use super::candidates::{Candidates, DISTANCE, TRANSMISSION_DEG, apart, sorted};
use super::defect::defect;
use super::generator::{Generator, GeneratorKind, UNKNOWNS};
use super::options::{FunctionOptions, LeftOut};
use super::precision::{GivenStarts, exact};
use super::structural_error::ErrorCurve;
use super::target::FunctionTarget;
use crate::workers::Workers;
use coupler_curves::geometry::trig;

/// The linkages that are exact at some points with some starts given, together no more than five.
pub(super) fn by_points(
    target: &FunctionTarget,
    options: &FunctionOptions,
    points: Vec<[f64; 2]>,
    starts: GivenStarts,
    workers: &impl Workers,
) -> Candidates {
    let problem = Problem { target, options, points, starts, least_transmission: 0.0 };
    let open = UNKNOWNS - problem.points.len() - starts.iter().flatten().count();
    if open == 0 {
        return problem.all();
    }
    // A condition may ask for a transmission angle, which the best linkages do not have.
    let levels = if options.condition.is_some() { TRANSMISSION_DEG } else { &TRANSMISSION_DEG[..1] };
    let found = levels.iter().flat_map(|level| {
        let least_transmission = if *level > 0.0 { trig::radians(*level) + MARGIN } else { 0.0 };
        Problem { least_transmission, points: problem.points.clone(), ..problem }.best(open, workers)
    });
    let linkages = sorted(found.collect());
    Candidates {
        linkages: apart(linkages, DISTANCE, KEPT),
        near: problem.points[0],
        distance: DISTANCE,
        ..Candidates::default()
    }
}

/// The linkages that are looked at, if the best do not meet a condition.
const KEPT: usize = 2000;

/// A transmission angle is kept with a margin, in radians, so that a condition on it holds whatever it is rounded to.
const MARGIN: f64 = 1e-6;

struct Problem<'a> {
    target: &'a FunctionTarget,
    options: &'a FunctionOptions,
    points: Vec<[f64; 2]>,
    starts: GivenStarts,
    /// The least transmission angle over the range, in radians; 0 for any.
    least_transmission: f64,
}

/// The part of the starts that is searched: the input, the output, or both.
type Place = Vec<f64>;

impl Problem<'_> {
    /// Why a linkage is no answer, but for conditions.
    fn objection(&self, linkage: &Generator) -> Option<LeftOut> {
        let range = [0.0, self.target.travel()];
        if let Some(defect) = defect(linkage, &self.points, range, self.target.size()) {
            return Some(LeftOut::Defect(defect));
        }
        if linkage.ratio() > self.options.max_ratio {
            return Some(LeftOut::MaxRatio);
        }
        if self.options.full_turn && !linkage.is_full_turn() {
            return Some(LeftOut::FullTurn);
        }
        let start = linkage.starts[0];
        let transmission = || linkage.worst_transmission(start, start + self.target.travel());
        (self.least_transmission > 0.0 && transmission() < self.least_transmission).then_some(LeftOut::Condition)
    }

    /// What is to be least: the greatest error of a law, and of rows, which are all exact, what the transmission angle lacks.
    fn cost(&self, linkage: &Generator) -> f64 {
        match self.target.as_law() {
            Some(_) => ErrorCurve::new(linkage, self.target, self.points[0])
                .map_or(f64::INFINITY, |curve| curve.measure().greatest.abs()),
            None => {
                let start = linkage.starts[0];
                -linkage.worst_transmission(start, start + self.target.travel())
            }
        }
    }

    /// All linkages of the points.
    fn all(&self) -> Candidates {
        /// Roots of the same form differ by more, but for double roots.
        const SAME: f64 = 1e-6;
        let found = exact(self.options.kind, &self.points, self.starts);
        let solutions = found.linkages.len() + found.imaginary + found.infinite;
        let mut left_out: Vec<(LeftOut, usize)> = Vec::new();
        let mut leave_out = |why: LeftOut, times: usize| match left_out.iter_mut().find(|(other, _)| *other == why) {
            Some((_, count)) => *count += times,
            None => left_out.push((why, times)),
        };
        for (why, count) in [(LeftOut::Imaginary, found.imaginary), (LeftOut::Infinite, found.infinite)] {
            if count > 0 {
                leave_out(why, count);
            }
        }
        let mut kept = Vec::new();
        for linkage in found.linkages {
            match self.objection(&linkage) {
                Some(why) => leave_out(why, 1),
                None => kept.push((self.cost(&linkage), linkage)),
            }
        }
        Candidates {
            linkages: sorted(kept),
            near: self.points[0],
            distance: SAME,
            left_out,
            solutions: Some(solutions),
            is_degenerate: found.is_degenerate,
        }
    }

    /// The starts with those of a place.
    fn starts_at(&self, place: &[f64]) -> GivenStarts {
        let mut searched = place.iter();
        // The input is searched first; where one is searched and points are left over, the output follows from them.
        self.starts.map(|start| start.or_else(|| searched.next().copied()))
    }

    /// The linkage of a place with the least cost.
    fn best_at(&self, place: &[f64]) -> Option<(f64, Generator)> {
        let found = exact(self.options.kind, &self.points, self.starts_at(place));
        let kept = found.linkages.into_iter().filter(|linkage| self.objection(linkage).is_none());
        kept.map(|linkage| (self.cost(&linkage), linkage)).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The best linkages where so many starts are open: those of a grid, and those that are best near the best of them.
    fn best(&self, open: usize, workers: &impl Workers) -> Vec<(f64, Generator)> {
        /// The steps of a grid over a turn, if one start is open, and if both are.
        const STEPS: [usize; 2] = [360, 72];
        /// The places from which the best nearby is searched, and how far they are apart.
        const REFINED: usize = 24;
        const APART: f64 = 0.2;
        let steps = STEPS[open - 1];
        let axes: Vec<usize> = (0..2).filter(|k| self.starts[*k].is_none()).take(open).collect();
        let values = |axis: usize| self.grid(axis, steps);
        let places: Vec<Place> = match axes[..] {
            [one] => values(one).into_iter().map(|value| vec![value]).collect(),
            _ => {
                let second = values(1);
                values(0).into_iter().flat_map(|a| second.iter().map(move |b| vec![a, *b])).collect()
            }
        };
        let found = workers.map(places, |place| self.best_at(&place).map(|(cost, linkage)| (cost, place, linkage)));
        let mut found: Vec<(f64, Place, Generator)> = found.into_iter().flatten().collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut begun: Vec<(f64, Place, Generator)> = Vec::new();
        for candidate in &found {
            if begun.len() < REFINED && begun.iter().all(|other| other.2.distance_to(&candidate.2) >= APART) {
                begun.push(candidate.clone());
            }
        }
        let step = 2.0 * PI / steps as f64;
        let refined = workers.map(begun, |(cost, place, linkage)| self.refined((cost, place, linkage), step));
        let grid = found.into_iter().take(KEPT).map(|(cost, _, linkage)| (cost, linkage));
        refined.into_iter().chain(grid).collect()
    }

    /// Values of a start: angles over a turn, or ways of a slider on both sides of the crank's pivot, closer together near it.
    fn grid(&self, axis: usize, steps: usize) -> Vec<f64> {
        let centred = (0..steps).map(|k| (2 * k + 1) as f64 / steps as f64 - 1.0);
        match (axis, self.options.kind) {
            (1, GeneratorKind::SliderCrank) => centred.map(|part| part / (1.0 - part * part)).collect(),
            // From 0 on, so that round angles are among them.
            _ => (0..steps).map(|k| 2.0 * PI * k as f64 / steps as f64).collect(),
        }
    }

    /// The best linkage near one, by steps of the open starts in each direction, which become shorter.
    fn refined(&self, (mut cost, mut place, mut linkage): (f64, Place, Generator), step: f64) -> (f64, Generator) {
        /// The last step, in radians or sizes.
        const LAST: f64 = 1e-5;
        let mut step = 0.5 * step;
        while step > LAST {
            let mut has_moved = false;
            for axis in 0..place.len() {
                for by in [step, -step] {
                    let mut next = place.clone();
                    next[axis] += by;
                    if let Some((less, better)) = self.best_at(&next).filter(|(less, _)| *less < cost) {
                        (cost, place, linkage) = (less, next, better);
                        has_moved = true;
                        break;
                    }
                }
            }
            if !has_moved {
                step *= 0.5;
            }
        }
        (cost, linkage)
    }
}

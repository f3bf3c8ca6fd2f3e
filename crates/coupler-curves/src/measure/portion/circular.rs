//! Portions of a curve that are circular to a tolerance.

use std::cell::RefCell;

use super::annulus::AlternatingPoints;
use super::curve_ring::{CurveRings, PortionRing};
use super::every_nth::EveryNth;
use super::longest::{INTERVALS, Requirement, longest};
use super::longest_near::{ACCURACY, Constraint, Constraints, Contacts, Fit, Limits, LongestNear, Reached, Touching};
use super::row::Row;
use super::strip::min_max;
use crate::geometry::Point;
use crate::measure::budget::{MAX_PORTION_POINTS, Steps, TooManySteps};
use crate::numerical::partition_point;

/// A circular portion.
#[derive(Clone, Copy, Debug)]
pub struct CircularPortion {
    /// The positions of its ends.
    pub ends: [f64; 2],
    /// The centre of its annulus.
    pub centre: Point,
    /// The mean radius of its annulus.
    pub radius: f64,
    /// The width of its annulus.
    pub width: f64,
}

/// The portion of a row's curve that spans the most input of those in an annulus no wider than `max_width`, with a mean radius no greater
/// than `max_radius`; `None` if there is none, as of a straight line.
///
/// # Errors
/// The search takes too many steps.
pub fn longest_circular(row: &Row, max_width: f64, max_radius: f64) -> Result<Option<CircularPortion>, TooManySteps> {
    /// What of the width is more than allowed is taken off as often.
    const ROUNDS: usize = 4;
    /// The accuracy of the widths compared, relative to what is allowed.
    const EXCESS: f64 = 1e-6;
    let steps = &Steps::new(MAX_PORTION_POINTS);
    let alternating = RefCell::new((AlternatingPoints::folded(row.is_folded()), 0));
    let mut requirement = Circular { row, max_width, max_radius, steps, alternating };
    let Some(&longest) = longest(row, &requirement, 0.0, steps)?.first() else { return Ok(None) };
    // The whole of a closed curve begins where the curve does.
    let is_whole = row.is_closed && longest[1] - longest[0] >= row.start_count as f64 * (1.0 - 1e-9);
    let mut ends = if is_whole { [0.0, row.start_count as f64] } else { requirement.longest_beside(longest) };
    steps.check()?;
    let all = |[from, to]: [f64; 2]| INTERVALS.max((to - from).ceil() as usize);
    let rings = |ends: [f64; 2]| CurveRings::new(row, ends, all(ends), max_radius);
    let Some(mut ring) = rings(ends).ring(ends) else { return Ok(None) };
    let mut width = width_about(row, ends, ring.centre);
    for _ in 0..ROUNDS {
        if is_whole || width <= max_width * (1.0 + EXCESS) {
            break;
        }
        // Next to a sharp bend the points that touch are known less exactly than elsewhere: by as much less is allowed of them.
        requirement.max_width = max_width - 1.01 * (width - ring.width);
        let reach = 0.1 * (ends[1] - ends[0]);
        let reached = requirement.longest_near_by(&mut rings(ends), all(ends), ends, reach, 0.0);
        steps.check()?;
        let Reached::Longest { ends: shorter, .. } = reached else { break };
        let Some(next) = rings(shorter).ring(shorter) else { return Ok(None) };
        (ends, ring) = (shorter, next);
        width = width_about(row, ends, ring.centre);
    }
    Ok(Some(CircularPortion { ends, centre: ring.centre, radius: ring.radius, width }))
}

/// The requirement of lying in an annulus of at most a given width and radius. The size is the input spanned.
struct Circular<'a> {
    row: &'a Row,
    max_width: f64,
    max_radius: f64,
    steps: &'a Steps,
    /// The points that bounded the last portion that was compared roughly, and the number of its points.
    alternating: RefCell<(AlternatingPoints, usize)>,
}

impl Requirement for Circular<'_> {
    const HAS_CERTAIN_BOUNDS: bool = false;
    const FEW: f64 = 24.0;
    // The fourth root of the width, which is known to a millionth.
    const EQUAL: f64 = 1e-6;

    fn longest_from(&self, points: &EveryNth, from: usize, least: f64, likely: usize) -> Option<(f64, usize)> {
        /// So many points are in any annulus, or nearly.
        const FEW: usize = 4;
        /// Of a portion of more than twice as many points so many are enough.
        const ENOUGH: usize = 48;
        let travel = &points.travel;
        let (before, last) = (points.step_before(travel, from), points.last_end(from));
        let start = travel[from] - before;
        let fits = |to: usize| {
            let portion = &points.points[from..=to];
            if portion.len() <= FEW {
                return true;
            }
            // Any points of a portion that fits fit too.
            let mut thinned = [Point::origin(); 2 * ENOUGH];
            let portion = if portion.len() > 2 * ENOUGH {
                let every_nth = portion.iter().step_by(portion.len() / ENOUGH);
                let count = thinned.iter_mut().zip(every_nth).map(|(to, from)| *to = *from).count();
                &thinned[..count]
            } else {
                portion
            };
            if self.steps.take(portion.len()).is_err() {
                return false;
            }
            let (alternating, count) = &mut *self.alternating.borrow_mut();
            let are_apart = alternating.are_apart(portion, std::mem::replace(count, portion.len()), self.max_width);
            !are_apart && alternating.narrowest_annulus_within(portion, self.max_width, self.max_radius).is_some()
        };
        // Any part of a portion that fits fits too.
        let first = points.first_reaching(travel, start + least, from + 1, last);
        let beyond = partition_point(first..last + 1, likely, fits);
        let to = beyond.checked_sub(1).filter(|to| *to >= first)?;
        Some((points.at_next(travel, to) - start, to))
    }

    fn quantity<'p>(&self, points: &'p EveryNth) -> &'p [f64] {
        &points.travel
    }

    fn longest_near(&self, mut ends: [f64; 2], reach: f64, least: f64) -> Reached {
        /// Points of the portion in which those that touch its annulus are found.
        const POINTS: usize = 32;
        /// So often points are added where the curve leaves the annulus between them.
        const ROUNDS: usize = 6;
        let mut added = Vec::new();
        let mut found = Reached::Nothing;
        for _ in 0..ROUNDS {
            let mut rings = CurveRings::new(self.row, ends, POINTS, self.max_radius).with_points(&added);
            found = self.longest_near_by(&mut rings, POINTS, ends, reach, least);
            if found == Reached::Nothing {
                // Where no rate shows the way, the portion itself is the longest that is known, if it fits.
                let fits = rings.ring(ends).is_some_and(|ring| ring.width <= self.max_width);
                if fits {
                    return Reached::Longest { size: self.row.input_span(ends), ends, is_certain: false };
                }
            }
            let Reached::Longest { ends: longest, .. } = found else { break };
            let outside = rings.next_ring(longest).map_or_else(Vec::new, |ring| self.points_outside(longest, ring));
            if outside.is_empty() {
                break;
            }
            added.extend(outside);
            ends = longest;
        }
        found
    }
}

impl Circular<'_> {
    /// A portion, or a longer one that is reached when it is moved a little along the curve: where other points begin to touch, the
    /// longest near one need not be the longest beside it.
    fn longest_beside(&self, mut ends: [f64; 2]) -> [f64; 2] {
        /// How far it is moved, relative to its span.
        const SHIFTS: [f64; 4] = [-0.01, 0.01, -0.04, 0.04];
        /// So often, at most, another is found.
        const ROUNDS: usize = 8;
        /// What is not longer by more is the same.
        const SAME: f64 = 1e-7;
        let Limits { low, high, .. } = self.row.limits();
        let reached = |ends: [f64; 2], shift: f64| {
            let span = ends[1] - ends[0];
            let moved = ends.map(|end| (end + shift * span).clamp(low, high));
            match self.longest_near(moved, 0.1 * span, 0.0) {
                Reached::Longest { size, ends: next, .. } if size > self.row.input_span(ends) * (1.0 + SAME) => {
                    Some(next)
                }
                _ => None,
            }
        };
        for _ in 0..ROUNDS {
            let Some(next) = SHIFTS.into_iter().find_map(|shift| reached(ends, shift)) else { break };
            ends = next;
        }
        ends
    }

    /// The points of the row between two positions at which the curve is furthest outside of an annulus.
    fn points_outside(&self, [from, to]: [f64; 2], ring: PortionRing) -> Vec<i64> {
        /// What it is outside by less, relative to the width, is taken off in the end.
        const OUTSIDE: f64 = 1e-7;
        let (first, last) = (from.ceil() as i64, to.floor() as i64);
        let outside = |k: i64| {
            let height = (self.row.nth_point(k) - ring.centre).norm() - ring.radius;
            if height.abs() > self.max_width * (0.5 + OUTSIDE) { height } else { 0.0 }
        };
        let mut found = Vec::new();
        let [mut before, mut here] = [0.0, outside(first)];
        for k in first..=last {
            let after = if k < last { outside(k + 1) } else { 0.0 };
            if here != 0.0 && here.abs() >= before.abs() && here.abs() > after.abs() {
                found.push(k);
            }
            (before, here) = (here, after);
        }
        found
    }

    /// The longest portion near one between two positions, by its annuli of about so many points.
    fn longest_near_by(&self, rings: &mut CurveRings, count: usize, ends: [f64; 2], reach: f64, least: f64) -> Reached {
        let permitted = self.max_width * (1.0 - ACCURACY);
        let fit = |ends: [f64; 2], touching: Touching| {
            self.steps.take(count)?;
            let size = self.row.input_span(ends);
            let rates = ends.map(|position| self.row.input_travel_rate_at(position));
            let compare = |Constraint { value, rates }| Constraint {
                value: value / permitted - 1.0,
                rates: rates.map(|rate: f64| rate / permitted),
            };
            let ring = match touching {
                Touching::Next => rings.next_ring(ends),
                Touching::Anew => rings.ring_anew(ends),
            };
            let excess = ring.map_or(Constraint { value: 0.0, rates: [0.0; 2] }, |ring| Constraint {
                value: ring.width,
                rates: ring.width_rates,
            });
            Ok(Fit {
                excess: compare(excess),
                size,
                size_rates: [-rates[0], rates[1]],
                contacts: ring.map_or(Contacts::default(), |ring| ring.contacts),
                others: ring.map_or(Constraints::default(), |ring| ring.others.map(|other| other.map(compare))),
            })
        };
        LongestNear { limits: self.row.limits(), fit, reach }.search(ends, least)
    }
}

/// The difference of the greatest and the least distance of a portion from a point.
fn width_about(row: &Row, [from, to]: [f64; 2], centre: Point) -> f64 {
    /// Points between two of the row.
    const FINER: f64 = 4.0;
    /// An extreme that sticks out further than the points, by the parabola through three of them, is searched for among so many
    /// points around it, as often, ever closer: where they are not evenly spaced on the curve the parabola errs.
    const AROUND: usize = 8;
    const ROUNDS: usize = 4;
    let parts = ((to - from) * FINER).ceil().max(2.0) as usize;
    let distances_between = |ends: [f64; 2], parts: usize| -> Vec<f64> {
        row.points_between(ends, parts).iter().map(|p| (p - centre).norm()).collect()
    };
    let distances = distances_between([from, to], parts);
    let [least, most] = min_max(&distances, |distance| *distance);
    let extreme_near = |k: usize| {
        let three = &distances[k - 1..=k + 1];
        let (slope, bend) = ((three[2] - three[0]) / 2.0, three[2] - 2.0 * three[1] + three[0]);
        let vertex = three[1] - slope * slope / (2.0 * bend);
        let is_extreme = (three[0] - three[1]) * (three[2] - three[1]) >= 0.0;
        if !is_extreme || !(vertex < least || vertex > most) {
            return None;
        }
        let sign = -bend.signum();
        let (mut best, mut half) = (three[1], (to - from) / parts as f64);
        let mut middle = from + (to - from) * k as f64 / parts as f64;
        for _ in 0..ROUNDS {
            let ends = [(middle - half).max(from), (middle + half).min(to)];
            let around = distances_between(ends, AROUND);
            let part = (0..=AROUND).max_by(|a, b| (sign * around[*a]).total_cmp(&(sign * around[*b])))?;
            best = around[part];
            middle = ends[0] + (ends[1] - ends[0]) * part as f64 / AROUND as f64;
            half *= 2.0 / AROUND as f64;
        }
        Some(best)
    };
    // Around a bend that points do not show, ever closer.
    let around = |bend: i64| {
        let offsets = (0..16).map(|k| 1.0 / f64::from(1u32 << k)).chain([0.0]);
        offsets.flat_map(move |offset| [bend as f64 - offset, bend as f64 + offset])
    };
    let beside: Vec<f64> = row.bends_between([from, to]).into_iter().flat_map(around).collect();
    let beside = row.points_at(&beside.into_iter().filter(|at| (from..=to).contains(at)).collect::<Vec<f64>>());
    let beside = beside.iter().map(|point| (point - centre).norm());
    let all: Vec<f64> = distances.iter().copied().chain((1..parts).filter_map(extreme_near)).chain(beside).collect();
    let [least, most] = min_max(&all, |distance| *distance);
    most - least
}

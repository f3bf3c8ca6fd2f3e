//! Portions of a curve that are straight to a tolerance.

use super::curve_strip::{CurveStrips, PortionStrip};
use super::every_nth::EveryNth;
use super::longest::{Requirement, longest};
use super::longest_near::{ACCURACY, Constraint, Fit, LongestNear, Reached, Touching};
use super::row::Row;
use super::strip::{Band, check_width};
use super::strokes::shortest_stroke;
use crate::measure::budget::{MAX_PORTION_POINTS, Steps, TooManySteps};

/// Points of a portion in which those that touch its strip are found.
const POINTS: usize = 32;

/// The longest portions of a row's curve, longer than `least`, in a strip no wider than `tolerance` times their length: of several equally
/// long ones all, in the order of the input at which they begin.
///
/// # Errors
/// The search takes too many steps.
pub fn longest_straight(row: &Row, tolerance: f64, least: f64) -> Result<Vec<[f64; 2]>, TooManySteps> {
    let steps = &Steps::new(MAX_PORTION_POINTS);
    longest(row, &StraightTo { row, tolerance, steps }, least, steps)
}

/// The requirement of lying in a strip no wider than `tolerance` times its length. The size is the length.
///
/// A portion that begins at the same point and ends further on is at least as wide. So one that is too wide for its
/// length rules out all ends closer than the length its width requires.
struct StraightTo<'a> {
    row: &'a Row,
    tolerance: f64,
    steps: &'a Steps,
}

impl Requirement for StraightTo<'_> {
    const HAS_CERTAIN_BOUNDS: bool = true;
    const FEW: f64 = 96.0;
    const EQUAL: f64 = 1e-7;

    fn longest_from(&self, points: &EveryNth, from: usize, least: f64, _: usize) -> Option<(f64, usize)> {
        let lengths = &points.lengths;
        let before = points.step_before(lengths, from);
        let (start, last) = (lengths[from] - before, points.last_end(from));
        let up_to_next = |to: usize| points.at_next(lengths, to);
        // The first end with a given length of the curve between the points outside.
        let first_reaching = |length: f64, after: usize| points.first_reaching(lengths, start + length, after, last);
        let mut best = least;
        let mut found = None;
        let mut band: Option<Band> = None;
        let mut to = first_reaching(best, from + 1);
        while to <= last {
            let distance = (points.points[to] - points.points[from]).norm();
            let bound = distance + before + up_to_next(to) - lengths[to];
            if bound < best {
                band = None;
                to = first_reaching(best - bound + (up_to_next(to) - start), to + 1);
                continue;
            }
            let permitted = self.tolerance * bound;
            // Most often the next point is in the band of those before it.
            let is_in_band = band.as_mut().is_some_and(|band| band.extend(points.points[to]) <= permitted);
            if !is_in_band {
                self.steps.take(to - from).ok()?;
                match check_width(&points.points[from..=to], permitted) {
                    Ok(narrow) => band = Some(narrow),
                    // A longer portion is at least as wide, and needs the length that this width requires.
                    Err(width) => {
                        band = None;
                        to = first_reaching(width / self.tolerance, to + 1);
                        continue;
                    }
                }
            }
            (best, found) = (bound, Some((bound, to)));
            to += 1;
        }
        found
    }

    fn quantity<'p>(&self, points: &'p EveryNth) -> &'p [f64] {
        &points.lengths
    }

    fn longest_near(&self, ends: [f64; 2], reach: f64, least: f64) -> Reached {
        let mut strips = CurveStrips::new(self.row, ends, POINTS);
        let fit = |ends: [f64; 2], touching: Touching| {
            self.steps.take(POINTS)?;
            let PortionStrip { width, length, width_rates, length_rates, contacts, others } = match touching {
                Touching::Next => strips.next_strip(ends),
                Touching::Anew => strips.strip_anew(ends),
            };
            let permitted = self.tolerance * (1.0 - ACCURACY) * length;
            // What is permitted changes with the length.
            let compare = |Constraint { value, rates }| Constraint {
                value: value / permitted - 1.0,
                rates: std::array::from_fn(|k| (rates[k] - value / length * length_rates[k]) / permitted),
            };
            Ok(Fit {
                excess: compare(Constraint { value: width, rates: width_rates }),
                size: length,
                size_rates: length_rates,
                contacts,
                others: others.map(|other| other.map(compare)),
            })
        };
        LongestNear { limits: self.row.limits(), fit, reach }.search(ends, least)
    }

    fn without_excess(&self, ends: [f64; 2]) -> [f64; 2] {
        // Most often a portion goes on at its ends.
        let strip = CurveStrips::new(self.row, ends, POINTS).strip(ends);
        if strip.length_rates.contains(&0.0) { shortest_stroke(self.row, ends) } else { ends }
    }
}

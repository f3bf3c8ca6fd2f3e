//! The straightest portion of a given input or length.

use super::curve_strip::{CurveStrips, PortionStrip};
use super::longest::EXACT;
use super::row::Row;
use super::strip::{Strip, check_width, min_max};
use crate::geometry::{Point, Vector, in_rising_order};
use crate::measure::budget::{MAX_PORTION_POINTS, Steps, TooManySteps};
use crate::measure::rounding::within_period;
use crate::numerical::maximum_with_ends;

/// Of which portion the strip is the narrowest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Narrowest {
    /// The one with the least width.
    Absolutely,
    /// The one with the least ratio of width to length.
    Relatively,
}

impl Narrowest {
    /// By what portions are compared; 0 for one that is straight to rounding.
    fn size(self, width: f64, length: f64) -> f64 {
        match self {
            _ if width < 2.0 * EXACT * length => 0.0,
            Narrowest::Absolutely => width,
            Narrowest::Relatively => width / length,
        }
    }
}

/// The ends of the portion with the narrowest strip that is no wider than `max_width`; of those that are equally narrow the
/// longest, and of those equally long the one that begins at the least input, from 0 up to 360 degrees. `end` returns the end of the portion that begins at a
/// position.
///
/// A portion contains the one from the next point to the end of the one from the previous point, and is at least as
/// wide as that: only between points where that is narrower than the narrowest found can there be a narrower one.
///
/// # Errors
/// The search takes too many steps.
pub fn straightest(
    row: &Row,
    end: impl Fn(f64) -> Option<f64>,
    narrowest: Narrowest,
    max_width: f64,
) -> Result<Option<[f64; 2]>, TooManySteps> {
    /// The number of parts of the curve in one of which the portion begins.
    const PARTS: usize = 128;
    /// Points of a portion in which those that touch its strip are found.
    const POINTS: usize = 48;
    /// How accurately the start is found, relative to the distance of two points.
    const ACCURACY: f64 = 1e-6;
    /// Widths and lengths that differ by less, relatively, are equal: as a symmetrical curve's are, to the accuracy with
    /// which starts are found.
    const EQUAL: f64 = 1e-7;
    let steps = Steps::new(MAX_PORTION_POINTS);
    let stride = (row.start_count / PARTS).max(1);
    let last = row.points.len() - 1;
    // The extent of a portion is at most its length, and at most the diagonal of the box around its points, beyond which it reaches by at most half
    // of the length between two of them, on both sides.
    let length_bound = |from: usize, to: usize| {
        let (lengths, points) = (&row.cumulative_length[from..=to.min(last)], &row.points[from..=to.min(last)]);
        let gap = lengths.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        let [[x_min, x_max], [y_min, y_max]] = [min_max(points, |p| p.x), min_max(points, |p| p.y)];
        let diagonal = Vector::new(x_max - x_min, y_max - y_min).norm();
        (lengths[lengths.len() - 1] - lengths[0]).min(diagonal + gap)
    };
    let mut cells: Vec<Cell> = Vec::new();
    for from in (0..row.start_count).step_by(stride) {
        let Some(to) = end(from as f64) else { continue };
        let inner = row.points.get(from + stride..=(to.floor() as usize).min(last)).unwrap_or_default();
        // Any of its points need a strip no wider.
        steps.take(inner.len() + 1)?;
        let thinned: Vec<Point> = inner.iter().step_by((inner.len() / POINTS).max(1)).copied().collect();
        if check_width(&thinned, max_width).is_err() {
            continue;
        }
        let width = match thinned.len() {
            0..3 => 0.0,
            count => Strip::of_row(&thinned, &mut [0, count / 2, count - 1]).width,
        };
        let longest = end((from + stride) as f64).map_or(f64::INFINITY, |to| length_bound(from, to.ceil() as usize));
        cells.push(Cell { from: from as f64, size: narrowest.size(width, longest), length: longest });
    }
    // The portion that begins in the part from a point and is the best by a rank.
    let best_from = |from: f64, rank: &dyn Fn(Candidate) -> f64| {
        let mut strips = CurveStrips::new(row, [from, end(from)?], POINTS);
        let mut best: Option<Candidate> = None;
        let mut rank_from = |at: f64| {
            let to = if steps.take(POINTS).is_ok() { end(at) } else { None };
            let strip = to.map(|to| (to, strips.strip([at, to]))).filter(|(_, strip)| strip.width <= max_width);
            let Some((to, PortionStrip { width, length, .. })) = strip else { return f64::NEG_INFINITY };
            let candidate = Candidate { size: narrowest.size(width, length), length, ends: [at, to] };
            if best.is_none_or(|best| rank(candidate) > rank(best)) {
                best = Some(candidate);
            }
            rank(candidate)
        };
        let ends = [from, from + stride as f64];
        let found = maximum_with_ends(ends, ACCURACY * stride as f64, &mut rank_from);
        // A portion may be missed when the search for the points that touch its strip begins elsewhere.
        rank_from(found.place);
        best
    };
    let mut found: Vec<(f64, Candidate)> = Vec::new();
    let (mut least, mut longest_straight) = (f64::INFINITY, 0.0);
    // Of portions that are straight to rounding, which those of a line all are, the longest first.
    cells.sort_by(|a, b| b.length.total_cmp(&a.length));
    for Cell { from, size, length } in in_rising_order(cells, |cell| cell.size) {
        if size > least * (1.0 + EQUAL) {
            break;
        }
        if length < longest_straight * (1.0 - EQUAL) {
            continue;
        }
        if let Some(candidate) = best_from(from, &|Candidate { size, length, .. }| match size {
            // Straight lines are all equally narrow.
            0.0 => length,
            _ => -size,
        }) {
            least = least.min(candidate.size);
            if candidate.size == 0.0 {
                longest_straight = candidate.length.max(longest_straight);
            }
            found.push((from, candidate));
        }
        steps.check()?;
    }
    let is_least = |candidate: &Candidate| candidate.size <= least * (1.0 + EQUAL);
    found.retain(|(_, candidate)| is_least(candidate));
    // A strip that touches no end of its portion is as wide for others, which begin next to it and are longer.
    let longest_from = |(from, candidate): (f64, Candidate)| {
        let rank = |other: Candidate| if is_least(&other) { other.length } else { -other.size };
        best_from(from, &rank).filter(|other| rank(*other) > candidate.length).unwrap_or(candidate)
    };
    let mut found: Vec<Candidate> = found.into_iter().map(longest_from).collect();
    steps.check()?;
    let longest = found.iter().map(|candidate| candidate.length).fold(0.0, f64::max);
    found.retain(|candidate| candidate.length >= longest * (1.0 - EQUAL));
    let start_input = |ends: &[f64; 2]| within_period(row.input_at(ends[0]), 360.0);
    Ok(found.into_iter().map(|candidate| candidate.ends).min_by(|a, b| start_input(a).total_cmp(&start_input(b))))
}

/// What is known of the portions that begin in one part of the curve before they are searched.
struct Cell {
    /// Where the part begins.
    from: f64,
    /// A lower bound of their sizes.
    size: f64,
    /// An upper bound of their lengths.
    length: f64,
}

/// The narrowest portion that begins in one part of the curve.
#[derive(Clone, Copy)]
struct Candidate {
    /// The width of its strip, or the ratio of that to the length.
    size: f64,
    length: f64,
    ends: [f64; 2],
}

//! The straightest portion of a given input or length.

use super::curve_strip::CurveStrips;
use super::maximum::{Bracket, greatest_in};
use super::row::Row;
use super::strip::{Strip, check_width};
use crate::geometry::{Point, in_rising_order};

/// Of which portion the strip is the narrowest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Narrowest {
    /// The one with the least width.
    Absolutely,
    /// The one with the least ratio of width to length.
    Relatively,
}

/// The ends of the portion with the narrowest strip that is no wider than `most`. `end` returns the end of the portion
/// that begins at a position.
///
/// A portion contains the one from the next point to the end of the one from the previous point, and is at least as
/// wide as that: only between points where that is narrower than the narrowest found can there be a narrower one.
pub(super) fn straightest(
    row: &Row,
    end: impl Fn(f64) -> Option<f64>,
    narrowest: Narrowest,
    most: f64,
) -> Option<[f64; 2]> {
    /// The number of parts of the curve in one of which the portion begins.
    const PARTS: usize = 128;
    /// Points of a portion in which those that touch its strip are found.
    const POINTS: usize = 48;
    /// How accurately the start is found, relative to the distance of two points.
    const ACCURACY: f64 = 1e-6;
    let stride = (row.start_count / PARTS).max(1);
    let last = row.points.len() - 1;
    let length_between = |from: usize, to: usize| row.cumulative_length[to.min(last)] - row.cumulative_length[from];
    let mut cells: Vec<(f64, f64)> = Vec::new();
    for from in (0..row.start_count).step_by(stride) {
        let Some(to) = end(from as f64) else { continue };
        let inner = row.points.get(from + stride..=(to.floor() as usize).min(last)).unwrap_or_default();
        // Any of its points need a strip no wider.
        let thinned: Vec<Point> = inner.iter().step_by((inner.len() / POINTS).max(1)).copied().collect();
        if check_width(&thinned, most).is_err() {
            continue;
        }
        let width = match thinned.len() {
            0..3 => 0.0,
            count => Strip::of_row(&thinned, &mut [0, count / 2, count - 1]).width,
        };
        let longest = end((from + stride) as f64).map_or(f64::INFINITY, |to| length_between(from, to.ceil() as usize));
        let bound = match narrowest {
            Narrowest::Absolutely => width,
            Narrowest::Relatively => width / longest,
        };
        cells.push((bound, from as f64));
    }
    let mut best: Option<(f64, [f64; 2])> = None;
    for (bound, from) in in_rising_order(cells, |cell| cell.0) {
        if best.is_some_and(|(least, _)| bound >= least) {
            break;
        }
        let Some(to) = end(from) else { continue };
        let mut strips = CurveStrips::new(row, [from, to], POINTS);
        let to = from + stride as f64;
        let bracket = Bracket { from, to, first_parts: 2, accuracy: ACCURACY * stride as f64 };
        let found = greatest_in(bracket, |at, _| {
            let to = end(at)?;
            let strip = strips.strip([at, to]);
            let size = match narrowest {
                Narrowest::Absolutely => strip.width,
                Narrowest::Relatively => strip.width / strip.length,
            };
            (strip.width <= most).then_some((to, -size))
        });
        if let Some((start, (to, negative))) = found
            && best.is_none_or(|(size, _)| -negative < size)
        {
            best = Some((-negative, [start, to]));
        }
    }
    best.map(|(_, ends)| ends)
}

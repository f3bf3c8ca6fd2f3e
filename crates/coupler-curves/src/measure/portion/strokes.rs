//! The strokes of a straight portion that is passed to and fro.

use super::longest::EXACT;
use super::row::Row;
use super::strip::{Strip, min_max};
use crate::numerical::maximum_with_ends;

/// Intervals between the points in which the turns of a portion are found.
const INTERVALS: usize = 96;

/// A straight portion without what goes back along its line beyond its furthest points, as next to a limit; of a line that is passed
/// to and fro, the stroke for which the input travels least.
pub fn shortest_stroke(row: &Row, ends: [f64; 2]) -> [f64; 2] {
    let turns = turns(row, ends);
    let [least, most] = min_max(&turns, |(_, reach)| *reach);
    let is_at = |end: f64, reach: f64| (reach - end).abs() <= EXACT * (most - least);
    let extremes = turns.into_iter().filter(|(_, reach)| is_at(least, *reach) || is_at(most, *reach));
    let extremes: Vec<(f64, f64)> = extremes.collect();
    let strokes = extremes.windows(2).filter(|pair| !is_at(pair[0].1, pair[1].1)).map(|pair| [pair[0].0, pair[1].0]);
    // The first of those that differ by rounding.
    let shortest = strokes.reduce(|a, b| if row.input_span(b) < row.input_span(a) * (1.0 - 1e-6) { b } else { a });
    shortest.unwrap_or(ends)
}

/// The positions between two at which a portion turns back along its line or ends, and how far along the line it is there.
fn turns(row: &Row, [from, to]: [f64; 2]) -> Vec<(f64, f64)> {
    let points = row.points_between([from, to], INTERVALS);
    let direction = Strip::enclosing(&points).direction;
    let reaches: Vec<f64> = points.iter().map(|point| direction.dot(&point.coords)).collect();
    let step = (to - from) / INTERVALS as f64;
    let position = |k: usize| from + step * k as f64;
    let turn = |k: usize| {
        let [before, after] = [k.saturating_sub(1), (k + 1).min(INTERVALS)];
        let [rise, fall] = [reaches[k] - reaches[before], reaches[k] - reaches[after]];
        if rise * fall < 0.0 {
            return None;
        }
        let sign = if rise + fall >= 0.0 { 1.0 } else { -1.0 };
        let reach = |at: f64| sign * direction.dot(&row.point_at(at).coords);
        let furthest = maximum_with_ends([before, after].map(position), 1e-8 * (to - from), reach);
        Some((furthest.place, sign * furthest.value))
    };
    (0..=INTERVALS).filter_map(turn).collect()
}

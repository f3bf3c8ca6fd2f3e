//! The path to search for, of a shape that was drawn by hand or read: without noise, and with points enough for its form to be seen.

use serde_json::{Value, json};

use coupler_curves::geometry::{Point, Vector};
use coupler_curves::numerical::equal_parts;
use coupler_find::PathKind;

use crate::response::Numbers;

/// As many points are taken as they are if they have no noise; other paths get `PATH_POINTS`.
const TAKEN: std::ops::RangeInclusive<usize> = 30..=200;
const PATH_POINTS: usize = 100;

/// The even points that are smoothed, and the points on either side of one over which it is smoothed.
const SMOOTHED: usize = 160;
const REACHES: [usize; 5] = [2, 3, 4, 6, 8];

/// Smoothing that shortens a path by no more than this part of its length removes no noise.
const SHORTENED: f64 = 0.01;

/// The points of the path to search for and its kind. As a part of curves a closed shape is a path that ends where it begins.
///
/// # Errors
/// The shape has fewer than two different points.
pub(crate) fn drawn_path_json(
    points: &[Point],
    is_closed: bool,
    is_part: bool,
    numbers: &mut Numbers,
) -> Result<Value, String> {
    let mut points: Vec<Point> = points.iter().copied().filter(|p| p.x.is_finite() && p.y.is_finite()).collect();
    points.dedup();
    while is_closed && points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    if points.len() < 2 {
        return Err("this is too small to be a curve".to_owned());
    }
    let quiet = without_noise(&points, is_closed);
    let mut path = match quiet {
        None if TAKEN.contains(&points.len()) => points,
        quiet => even_points(&quiet.unwrap_or(points), is_closed, PATH_POINTS),
    };
    if is_closed && is_part {
        path.push(path[0]);
    }
    let kind = if is_closed && !is_part { PathKind::Closed } else { PathKind::Part };
    Ok(json!({ "points": numbers.points(path), "kind": kind.name() }))
}

/// Points at equal distances along a polyline: of a closed one from its first point round, of an open one with both ends.
fn even_points(points: &[Point], is_closed: bool, count: usize) -> Vec<Point> {
    let at = |k: usize| points[k % points.len()];
    let steps: Vec<Vector> = (1..points.len() + usize::from(is_closed)).map(|k| at(k) - at(k - 1)).collect();
    let lengths: Vec<f64> = steps.iter().map(Vector::norm).collect();
    let places = equal_parts(&lengths, if is_closed { count } else { count - 1 });
    places.iter().take(count).map(|place| points[place.segment] + steps[place.segment] * place.fraction).collect()
}

fn length(points: &[Point], is_closed: bool) -> f64 {
    let closing = if is_closed { (points[0] - points[points.len() - 1]).norm() } else { 0.0 };
    points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum::<f64>() + closing
}

/// A path in even points, smoothed more and more widely as long as that shortens it; `None` if it has no noise.
fn without_noise(points: &[Point], is_closed: bool) -> Option<Vec<Point>> {
    let even = even_points(points, is_closed, SMOOTHED);
    let mut quiet = None;
    let mut shortest = length(&even, is_closed);
    for reach in REACHES {
        let smoother = smoothed(&even, is_closed, reach);
        let shorter = length(&smoother, is_closed);
        if shorter > (1.0 - SHORTENED) * shortest {
            break;
        }
        (quiet, shortest) = (Some(smoother), shorter);
    }
    quiet
}

/// Even points, each replaced by the value of the parabola that best fits the points within a reach on both sides of it (Savitzky and
/// Golay 1964), or those that there are at the ends of an open path.
fn smoothed(points: &[Point], is_closed: bool, reach: usize) -> Vec<Point> {
    let count = points.len();
    let value = |n: usize| {
        let first = if is_closed { n + count - reach } else { n.saturating_sub(reach).min(count - 1 - 2 * reach) };
        let middle = first + reach;
        let place = if is_closed { 0.0 } else { n as f64 - middle as f64 };
        let weights = parabola_weights(reach, place);
        let weighted = weights.iter().enumerate().map(|(k, weight)| points[(first + k) % count].coords * *weight);
        Point::from(weighted.sum::<Vector>())
    };
    (0..count).map(value).collect()
}

/// The weights of the values at -reach … reach in the value of their best parabola at a place.
fn parabola_weights(reach: usize, place: f64) -> Vec<f64> {
    let [count, reach] = [2 * reach + 1, reach].map(|n| n as f64);
    let square = reach * (reach + 1.0) / 3.0;
    let places = (0..count as usize).map(|k| k as f64 - reach);
    let bend = |k: f64| k * k - square;
    let fourth: f64 = places.clone().map(|k| bend(k) * bend(k)).sum();
    places.map(|k| 1.0 / count + k * place / (count * square) + bend(k) * bend(place) / fourth).collect()
}

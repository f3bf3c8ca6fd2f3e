//! The straightest portion of a given input or length.

use super::curve_segment::CurveSegment;
use super::strip::{Strip, triangle_height};

/// The ends of the portion with the narrowest strip. `end` returns the end of the portion that begins at a position.
pub(super) fn straightest(curve: &CurveSegment, end: impl Fn(f64) -> Option<f64>) -> Option<[f64; 2]> {
    /// The number of local minima at points that are refined between points.
    const RIVALS: usize = 3;
    let width =
        |from: f64| end(from).map_or(f64::INFINITY, |to| Strip::enclosing(curve.portion_points([from, to])).width);
    // A portion is not measured if three of its points show that it is wider than the narrowest so far.
    let mut narrowest = f64::INFINITY;
    let mut widths = vec![f64::INFINITY; curve.start_count];
    // Widely spaced beginnings first: the sooner a narrow portion is found, the more can be skipped.
    const STRIDE: usize = 16;
    for from in (0..STRIDE).flat_map(|k| (k..curve.start_count).step_by(STRIDE)) {
        let Some(to) = end(from as f64) else { continue };
        let last = (to.floor() as usize).min(curve.points.len() - 1);
        let point = |part: usize| curve.points[from + (last - from) * part / 4];
        let bound = [[0, 2, 4], [0, 1, 3], [1, 3, 4]].map(|parts| triangle_height(parts.map(point)));
        widths[from] = bound.into_iter().fold(0.0, f64::max);
        if widths[from] <= 2.0 * narrowest {
            widths[from] = width(from as f64);
            narrowest = narrowest.min(widths[from]);
        }
    }
    let before = |k: usize| widths[(k + curve.start_count - 1) % curve.start_count];
    let is_least = |&k: &usize| widths[k] <= before(k) && widths[k] <= widths[(k + 1) % curve.start_count];
    let mut least: Vec<usize> = (0..curve.start_count).filter(|&k| widths[k].is_finite()).filter(is_least).collect();
    least.sort_by(|&a, &b| widths[a].total_cmp(&widths[b]));
    let refined = |&k: &usize| {
        let [mut a, mut b] = curve.clamp([k as f64 - 1.0, k as f64 + 1.0]);
        let shift = if a > k as f64 { curve.start_count as f64 } else { 0.0 };
        b = b.min(a + 2.0);
        let at = k as f64 + shift;
        for _ in 0..30 {
            let (c, d) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
            if width(c) < width(d) { b = d } else { a = c }
        }
        let (refined, whole) = (width(a), width(at));
        if refined < whole { (refined, a) } else { (whole, at) }
    };
    let (width, from) = least.iter().take(RIVALS).map(refined).min_by(|a, b| a.0.total_cmp(&b.0))?;
    width.is_finite().then_some([from, end(from)?])
}

//! Curves that are the same.

use coupler_curves::geometry::{Point, distance_to_segment};

/// The distance up to which curves are the same, in sizes of the target.
const SAME: f64 = 1e-3;

/// The points of an outline, about: few enough to be compared soon, and so many that chords deviate by far less.
pub(crate) const OUTLINE_POINTS: usize = 720;

/// The first of what has been found whose curves are not the same to a thousandth of the target's size, at most so many; nothing after
/// these is looked at. An outline is some points of a closed curve in their order, in the unit of the target.
pub fn distinct<T>(
    found: impl IntoIterator<Item = T>,
    outline: impl Fn(&T) -> &[Point],
    size: f64,
    most: usize,
) -> Vec<T> {
    let mut kept: Vec<T> = Vec::new();
    let mut found = found.into_iter();
    while kept.len() < most
        && let Some(next) = found.next()
    {
        if kept.iter().all(|other| !are_same(outline(&next), outline(other), size)) {
            kept.push(next);
        }
    }
    kept
}

/// Whether two curves, each given by some of its points, are the same for a target of a size.
pub(crate) fn are_same(a: &[Point], b: &[Point], size: f64) -> bool {
    let is_near = |(points, curve): (&[Point], &[Point])| {
        let count = curve.len();
        // Points that follow each other are near chords that do, in either direction: each is looked for from the last on, on both sides.
        let mut last = 0;
        points.iter().all(|p| {
            let is_near = |k: &usize| distance_to_segment(*p, curve[*k], curve[(k + 1) % count]) <= SAME * size;
            let from_last = (0..count).map(|n| if n % 2 == 0 { last + n / 2 } else { last + count - n.div_ceil(2) });
            let found = from_last.map(|k| k % count).find(is_near);
            last = found.unwrap_or(last);
            found.is_some()
        })
    };
    is_near((a, b)) && is_near((b, a))
}

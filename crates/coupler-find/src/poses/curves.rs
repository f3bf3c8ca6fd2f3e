//! The curves of the pivots and of the pins of four poses, the dyads of five and the poles of fewer, for drawings.

use super::body::{PoseSet, pole};
use super::centre_curve::CentreCurve;
use super::dyad::{Dyad, Forms};
use super::findings::{PlacedDyad, placed_dyad};
use super::five;
use crate::complex::{Complex, length};
use coupler_curves::geometry::Point;

/// The centre-point curve of four poses and the circle-point curve at the first of them, each as polylines, as far as they are within 20 sizes of the
/// poses; `None` of another number of poses, and of translations, which have no such curves.
pub fn burmester_curves(set: &PoseSet) -> Option<[Vec<Vec<Point>>; 2]> {
    const LINES: usize = 2880;
    let placed = set.placed();
    let curve = (placed.len() == 4).then(|| CentreCurve::new(placed))??;
    let on_lines: Vec<[Option<Dyad>; 2]> =
        (0..=LINES).map(|k| curve.dyads(std::f64::consts::PI * k as f64 / LINES as f64)).collect();
    let points = |side: usize, of: fn(&Dyad) -> Option<Complex>| {
        on_lines.iter().map(move |dyads| dyads[side].as_ref().and_then(of)).collect::<Vec<_>>()
    };
    let lines = |of: fn(&Dyad) -> Option<Complex>| {
        (0..2)
            .flat_map(|side| polylines(&points(side, of)))
            .map(|line| line.into_iter().map(|z| set.place(z)).collect())
            .collect()
    };
    Some([lines(Dyad::pivot), lines(Dyad::pin)])
}

/// All real dyads of five poses, at most four; none of another number of poses.
pub fn burmester_dyads(set: &PoseSet) -> Vec<PlacedDyad> {
    let placed = set.placed();
    let dyads = (placed.len() == 5).then(|| five::dyads(&Forms::new(placed).independent())).flatten();
    dyads.unwrap_or_default().iter().map(|dyad| placed_dyad(set, dyad)).collect()
}

/// The poles of two or three poses, with the numbers of the two poses: the places about which the body turns from one to the other. None of a
/// pair between which it does not turn, and of more poses.
pub fn poles(set: &PoseSet) -> Vec<([usize; 2], Point)> {
    let placed = if set.placed().len() > 3 { &[] } else { set.placed() };
    let pairs = (0..placed.len()).flat_map(|k| (k + 1..placed.len()).map(move |m| [k, m]));
    let pole_of = |[k, m]: [usize; 2]| Some(([k + 1, m + 1], set.place(pole([&placed[k], &placed[m]])?)));
    pairs.filter_map(pole_of).collect()
}

/// Polylines through points, divided where one is missing, far away, or far from the one before.
fn polylines(points: &[Option<Complex>]) -> Vec<Vec<Complex>> {
    /// In sizes of the poses.
    const FAR: f64 = 20.0;
    const NEAR: f64 = 0.005;
    let mut lines: Vec<Vec<Complex>> = vec![Vec::new()];
    let mut last: Option<Complex> = None;
    for point in points.iter().map(|point| point.filter(|z| z.norm_sqr() < FAR * FAR)) {
        let is_joined = point.zip(last).is_some_and(|(z, before)| length(z - before) < 0.05 * (1.0 + length(z)));
        if !is_joined {
            lines.push(Vec::new());
        }
        last = point;
        if let (Some(z), Some(line)) = (point, lines.last_mut())
            && line.last().is_none_or(|before| length(z - before) > NEAR)
        {
            line.push(z);
        }
    }
    lines.into_iter().filter(|line| line.len() > 1).collect()
}

//! Stretches on which a curve is traced again.

use super::trajectory::{Trajectory, parameter};
use crate::geometry::{Chebyshev, Point};
use crate::measure::curve::{Arc, Place};

/// Places closer than this, in the parameter of a trajectory, are one: next to a stop all positions within this are the
/// same to rounding.
const SHORTEST: f64 = 1e-3;

impl Trajectory<'_> {
    /// The stretches that trace no earlier part of the curve again, as ranges of the parameter.
    ///
    /// Between its stops and corners a curve is analytic: two stretches of it that coincide in some part coincide as far as
    /// both go. So a stretch that is traced again begins and ends where the curve stops, has a corner or an end, or where it
    /// passes through such a point. Between two of these places some points tell whether all lie on the earlier part: a
    /// curve that crosses or touches itself does not meet itself in all of them.
    pub fn first_traced_ranges(&self) -> Vec<[f64; 2]> {
        /// Shares of a stretch, none of them special.
        const PROBES: [f64; 5] = [0.083, 0.29, 0.47, 0.71, 0.89];
        let cuts = self.cuts();
        let mut out: Vec<[f64; 2]> = Vec::new();
        for ends in cuts.windows(2) {
            let [from, to] = [ends[0], ends[1]];
            let is_traced = |share: &f64| self.is_on_path(self.point(from + (to - from) * share), from);
            match out.last_mut() {
                _ if from > 0.0 && PROBES.iter().all(is_traced) => {}
                Some(last) if last[1] == from => last[1] = to,
                _ => out.push([from, to]),
            }
        }
        out
    }

    /// The parameters between which stretches are traced for the first time or again, rising: the ends of the curve, its
    /// stops and corners, and where it passes through these.
    fn cuts(&self) -> Vec<f64> {
        let [start, end] = self.range();
        let mut cuts: Vec<f64> = [start].into_iter().chain(self.knots.iter().copied()).chain([end]).collect();
        let mut points: Vec<Point> = Vec::new();
        for point in cuts.iter().map(|t| self.point(*t)) {
            // A closed curve ends where it begins.
            if points.iter().all(|other| (other - point).norm() > self.same_distance()) {
                points.push(point);
            }
        }
        for (piece, arc) in self.curve.arcs.iter().enumerate() {
            for u in points.iter().flat_map(|point| places_near(arc, *point, self.same_distance())) {
                let t = parameter(Place { piece, u });
                // Next to a stop all places are near.
                if cuts.iter().all(|cut| (cut - t).abs() > SHORTEST) {
                    cuts.push(t);
                }
            }
        }
        cuts.sort_by(f64::total_cmp);
        cuts
    }

    /// Whether a point lies on the curve before a parameter.
    fn is_on_path(&self, point: Point, before: f64) -> bool {
        let arcs = self.curve.arcs.iter().take(before.ceil() as usize).enumerate();
        arcs.flat_map(|(piece, arc)| {
            places_near(arc, point, self.same_distance()).into_iter().map(move |u| parameter(Place { piece, u }))
        })
        .any(|t| t <= before)
    }

    /// The distance up to which positions are the same: a billionth of the extent, far less than can be drawn, and more
    /// than the rounding of a position near a limit, or the rounding itself of a curve that is small for its linkage.
    fn same_distance(&self) -> f64 {
        const SAME: f64 = 1e-9;
        (SAME * self.extent).max(16.0 * self.curve.rounding)
    }
}

/// Places on an arc within a distance of a point: the feet of its perpendiculars, and the ends.
fn places_near(arc: &Arc, point: Point, distance: f64) -> Vec<f64> {
    let mut out = Vec::new();
    search(arc, [-1.0, 1.0], point, distance, &mut out);
    out
}

/// Searches a part of an arc, which is `part` by its own parameter, in parts that turn little.
fn search(part: &Arc, [from, to]: [f64; 2], point: Point, distance: f64, out: &mut Vec<f64>) {
    /// Next to a stop no part turns little, however short.
    const NARROWEST: f64 = 1e-5;
    let is_outside = |series: &Chebyshev, value: f64| (value - series.0[0]).abs() > series.radius() + distance;
    let [x, y] = &part.position;
    if is_outside(x, point.x) || is_outside(y, point.y) {
        return;
    }
    let (_, along, across) = part.cone();
    let is_point = x.radius().max(y.radius()) <= distance;
    if along > across || is_point || to - from < NARROWEST {
        let is_near = |u: &f64| (part.point(*u) - point).norm() <= distance;
        let places = [Some(-1.0), part.foot(point), Some(1.0)];
        out.extend(places.into_iter().flatten().filter(is_near).map(|u| from + (u + 1.0) / 2.0 * (to - from)));
        return;
    }
    let middle = (from + to) / 2.0;
    let [left, right] = part.halves();
    search(&left, [from, middle], point, distance, out);
    search(&right, [middle, to], point, distance, out);
}

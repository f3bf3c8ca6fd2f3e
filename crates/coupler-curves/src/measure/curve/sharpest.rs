//! Where a curve bends most, and where it bends sharply.

use super::super::budget::{MAX_PARTS, Steps, TooManySteps};
use super::stops::{STOP_WIDTH, greatest};
use super::{Arc, NARROW, Place, SmoothCurve, Stop};
use crate::geometry::{Chebyshev, TERMS, Vector, cross, curvature, in_rising_order};

impl SmoothCurve {
    /// The greatest curvature and its place; `None` for a curve without pieces, or that does not move. `stops` are no cusps,
    /// at which it is infinite; next to where the path returns on itself it is not looked for.
    ///
    /// # Errors
    /// The search takes too many steps.
    pub fn sharpest(&self, stops: &[Stop]) -> Result<Option<(f64, Place)>, TooManySteps> {
        let mut best: Option<(f64, Place)> = None;
        let mut offer = |value: f64, place: Place| {
            if value.is_finite() && best.is_none_or(|(most, _)| value > most) {
                best = Some((value, place));
            }
            best.map_or(0.0, |(most, _)| most)
        };
        let mut parts: Vec<(usize, [f64; 2], Arc)> = Vec::new();
        for (piece, arc) in self.arcs.iter().enumerate() {
            for ends in self.parts_apart_from(piece, stops) {
                parts.push((piece, ends, if ends == [-1.0, 1.0] { arc.clone() } else { arc.restricted(ends) }));
            }
        }
        // First the values at the nodes, so that most pieces are excluded by their bounds.
        let mut most = 0.0;
        for (piece, [from, to], arc) in &parts {
            let [v, a, _] = arc.derivatives_at_nodes();
            for (j, u) in Chebyshev::nodes().iter().enumerate() {
                let place = Place { piece: *piece, u: (from + to + (to - from) * u) / 2.0 };
                most = offer(curvature(v[j], a[j]).abs(), place);
            }
        }
        self.visit_bends(parts, most, |value, place, _| offer(value, place))?;
        Ok(best)
    }

    /// The places at which the curvature has a maximum of at least `least`, and those where the curve stops, in order; none of
    /// them at the end of a piece, but at the beginning of the next.
    ///
    /// # Errors
    /// The search takes too many steps.
    pub fn bends(&self, least: f64, stops: &[Stop]) -> Result<Vec<Place>, TooManySteps> {
        let mut places: Vec<Place> = stops.iter().map(|stop| stop.place).collect();
        let whole = self.arcs.iter().cloned().enumerate().map(|(piece, arc)| (piece, [-1.0, 1.0], arc));
        self.visit_bends(whole.collect(), least, |value, place, is_extreme| {
            // Next to where the curve stops its curvature is rounding.
            let is_at_stop = || stops.iter().any(|stop| self.are_near(stop.place, place, stop.width()));
            let is_new = || places.iter().all(|other| !self.are_near(*other, place, 4.0 * STOP_WIDTH));
            if is_extreme && value >= least && !is_at_stop() && is_new() {
                places.push(place);
            }
            least
        })?;
        // What is so close to an end of a piece is there: the rest of the piece would be rounding.
        let at_start = |Place { piece, u }: Place| match u {
            _ if u < STOP_WIDTH - 1.0 => Some(Place { piece, u: -1.0 }),
            _ if u < 1.0 - STOP_WIDTH => Some(Place { piece, u }),
            _ if piece + 1 < self.arcs.len() => Some(Place { piece: piece + 1, u: -1.0 }),
            _ => self.is_closed.then_some(Place { piece: 0, u: -1.0 }),
        };
        let starts = places.into_iter().filter_map(at_start).collect();
        Ok(in_rising_order(starts, |place| 4.0 * place.piece as f64 + place.u))
    }

    /// Calls `visit` with the curvatures that may exceed the `least`, and the places, and whether it has an extreme there; it
    /// returns the new least.
    ///
    /// # Errors
    /// It takes too many steps.
    fn visit_bends(
        &self,
        mut pending: Vec<(usize, [f64; 2], Arc)>,
        mut least: f64,
        mut visit: impl FnMut(f64, Place, bool) -> f64,
    ) -> Result<(), TooManySteps> {
        /// A change of the curvature, relative to it, that is less than the accuracy promised.
        const SAME: f64 = 1e-10;
        let [_, second_rounding, third_rounding] = self.derivative_rounding();
        let steps = Steps::new(MAX_PARTS);
        while let Some((piece, [from, to], arc)) = pending.pop() {
            steps.take(1)?;
            let derivatives = arc.derivatives_at_nodes();
            let [v, a, j] = &derivatives;
            let (_, along, _) = arc.cone();
            let turning = Chebyshev::from_values(&std::array::from_fn(|k| cross(v[k], a[k])));
            if along > 0.0 && turning.bound() <= least * along * along * along {
                continue;
            }
            // The numerator of the curvature's derivative.
            let rate = |k: usize| {
                let (v, a, j) = (v[k], a[k], j[k]);
                cross(v, j) * v.norm_squared() - 3.0 * cross(v, a) * v.dot(&a)
            };
            let rate = Chebyshev::from_values(&std::array::from_fn(rate));
            // Over the part the curvature changes by no more than this, or by nothing but rounding: as on a circle.
            let change = 2.0 * rate.bound() / (along * along * along * along * along);
            let is_same = along > 0.0 && change <= SAME * least;
            let [speed, acceleration] = [v, a].map(greatest);
            let rounding = speed * speed * (speed * third_rounding + 6.0 * acceleration * second_rounding);
            if is_same || rate.bound() <= rounding {
                for (k, u) in Chebyshev::nodes().iter().enumerate() {
                    let place = Place { piece, u: (from + to + (to - from) * u) / 2.0 };
                    least = visit(curvature(v[k], a[k]).abs(), place, false);
                }
                continue;
            }
            let (middle, half) = ((from + to) / 2.0, (to - from) / 2.0);
            let is_resolved = rate.0[TERMS - 2].abs().max(rate.0[TERMS - 1].abs()) <= 1e-7 * rate.bound();
            if is_resolved || half < STOP_WIDTH {
                let whole = &self.arcs[piece];
                let acceleration = whole.velocity.each_ref().map(Chebyshev::derivative);
                let extremes = rate.zeros(0.0, NARROW / half).places.into_iter().map(|u| (u, true));
                for (u, is_extreme) in extremes.chain([(-1.0, false), (1.0, false)]) {
                    let place = Place { piece, u: middle + half * u };
                    let a = Vector::new(acceleration[0].at(place.u), acceleration[1].at(place.u));
                    least = visit(curvature(whole.velocity(place.u), a).abs(), place, is_extreme);
                }
                continue;
            }
            let [left, right] = arc.halves();
            pending.push((piece, [from, middle], left));
            pending.push((piece, [middle, to], right));
        }
        Ok(())
    }

    /// The parts of a piece that are not next to where the path returns on itself.
    fn parts_apart_from(&self, piece: usize, stops: &[Stop]) -> Vec<[f64; 2]> {
        let mut parts = vec![[-1.0, 1.0]];
        if stops.is_empty() {
            return parts;
        }
        let round = 2.0 * self.arcs.len() as f64;
        let rounds: &[f64] = if self.is_closed { &[0.0, round, -round] } else { &[0.0] };
        for stop in stops {
            // As a parameter of this piece; on a closed curve also across its start.
            let at = 2.0 * stop.place.piece as f64 + stop.place.u - 2.0 * piece as f64;
            for at in rounds.iter().map(|round| at + round) {
                let cut = |[from, to]: [f64; 2]| [[from, to.min(at - RETURNING)], [from.max(at + RETURNING), to]];
                parts = parts.into_iter().flat_map(cut).filter(|[from, to]| to - from > STOP_WIDTH).collect();
            }
        }
        parts
    }
}

/// The difference of the parameter from where the path returns on itself within which the curve is too slow for its curvature to
/// be told from its series.
const RETURNING: f64 = 0.25;

//! Crunodes, inflections, cusps and the greatest curvature of the path.

use super::budget::TooManySteps;
use super::curve::{Place, StopKind};
use super::{Measure, TracedCurve, Value};
use crate::geometry::{Chebyshev, curvature};
use crate::motion::{InputMap, JointDerivatives};

/// The measure `crunodes`.
pub const CRUNODES: Measure = Measure::number(
    "crunodes",
    "number of crunodes",
    "",
    "points at which the path crosses itself",
    |curve: &TracedCurve| {
        let crossings = Some(curve.crossings()).filter(|crossings| !crossings.is_cut_short);
        crossings.map_or(Value::Missing, |crossings| Value::Number(crossings.points.len() as f64))
    },
);

/// The measure `inflections`.
pub const INFLECTIONS: Measure = Measure::number(
    "inflections",
    "number of inflections",
    "",
    "points at which the curvature of the path changes its sign",
    |curve: &TracedCurve| Value::Number(curve.inflections().0 as f64),
);

/// The measure `cusps`.
pub const CUSPS: Measure = Measure::number(
    "cusps",
    "number of cusps",
    "",
    "points at which the path stops and goes on from a cusp",
    |curve: &TracedCurve| Value::Number(curve.cusp_count() as f64),
);

/// The measure `too_close`.
pub const TOO_CLOSE: Measure = Measure::word(
    "too_close",
    "counts in doubt",
    "counts of the curve of which it is not known whether they are two more, because two crunodes or inflections would be within 1e-9 of a turn; positions if the linkage is so near a change point that the curve is not known to 1e-9 of its extent; measures if some have no value because they are known to no more than rounding, or would take too many steps; empty if nothing is in doubt",
    |curve: &TracedCurve| match (curve.crossings().doubtful > 0, curve.inflections().1 > 0) {
        _ if curve.smooth().rounding > RESOLVED * curve.extent() => Value::Word("positions"),
        _ if curve.has_measures_too_close() => Value::Word("measures"),
        (true, true) => Value::Word("crunodes and inflections"),
        (true, false) => Value::Word("crunodes"),
        (false, true) => Value::Word("inflections"),
        (false, false) => Value::Missing,
    },
);

/// The accuracy of positions, relative to the extent of the curve, that is promised of all measures.
const RESOLVED: f64 = 1e-9;

/// The measure `curvature_max`.
pub const CURVATURE_MAX: Measure = Measure::number(
    "curvature_max",
    "greatest curvature",
    "",
    "greatest curvature of the path except at corners at change points, in 1 over the manifest's unit; inf if there is a cusp",
    |curve: &TracedCurve| curve.counted_max_curvature().unwrap_or_default().map_or(Value::Missing, Value::Number),
);

impl TracedCurve<'_> {
    /// The number of cusps.
    pub(super) fn cusp_count(&self) -> usize {
        *self.cusp_count.get_or_init(|| count_cusps(self))
    }

    /// The greatest curvature, unless the search takes too many steps.
    pub(super) fn counted_max_curvature(&self) -> Result<Option<f64>, TooManySteps> {
        *self.max_curvature.get_or_init(|| max_curvature(self))
    }
}

/// The number of cusps of a path.
fn count_cusps(curve: &TracedCurve) -> usize {
    curve.stops().iter().filter(|stop| stop.kind == StopKind::Cusp).count()
}

/// The greatest curvature of a path; infinite if it has a cusp, and 0 if it is a line to rounding: where such a path returns on
/// itself, what is left of its curvature is rounding divided by the square of the speed.
///
/// # Errors
/// The search takes too many steps.
fn max_curvature(curve: &TracedCurve) -> Result<Option<f64>, TooManySteps> {
    /// The part of the root of the input's range next to a limit in which the terms of the curvature cancel.
    const NEAR_LIMIT: f64 = 0.1;
    if curve.cusp_count() > 0 {
        return Ok(Some(f64::INFINITY));
    }
    let smooth = curve.smooth();
    if smooth.is_line() {
        return Ok(Some(0.0));
    }
    let away_from_stops = smooth.sharpest(curve.stops())?.map(|(of_series, place)| {
        let piece = &smooth.pieces[place.piece];
        let pass = &curve.circuit.passes[piece.pass_at(place.u)];
        let is_near_limit = match piece.map {
            InputMap::Root { middle, half, .. } => {
                (middle + half * place.u).abs() < NEAR_LIMIT * pass.input_length().sqrt()
            }
            InputMap::Linear { .. } => false,
        };
        let exact = curvature_at(curve, place).abs();
        if is_near_limit || !exact.is_finite() { of_series } else { exact }
    });
    let returning = curve.stops().iter().map(|stop| curvature_where_returning(curve, stop.place));
    Ok(away_from_stops.into_iter().chain(returning).reduce(f64::max))
}

/// The curvature at a place, from the derivatives of the motion, which are more exact than those of the series.
fn curvature_at(curve: &TracedCurve, place: Place) -> f64 {
    let piece = &curve.smooth().pieces[place.piece];
    let pass = &curve.circuit.passes[piece.pass_at(place.u)];
    let (linkage, joint) = curve.single_point_linkage();
    let derivatives = JointDerivatives::on_pass(linkage, pass, piece.map.input(place.u));
    curvature(derivatives.velocity(joint), derivatives.acceleration(joint))
}

/// The greatest curvature of the path next to a place where it returns on itself.
///
/// There the velocity is zero, and the curvature of the path a smooth function of the difference t of the parameter. It is
/// interpolated between both sides, at least 0.05 from t = 0 and so where the velocity has enough digits; at a limit of the
/// input, where both sides are the same, as a function of the square of t, and continued to t = 0: to about 1e-8 of it.
fn curvature_where_returning(curve: &TracedCurve, place: Place) -> f64 {
    /// The differences on both sides.
    const REACH: f64 = 0.5;
    /// A part of a piece that is rounding.
    const AT_LIMIT: f64 = 1e-6;
    /// The squares at a limit.
    const SQUARES: [f64; 2] = [0.1, 1.0];
    /// More terms would magnify the rounding of the curvatures: on both sides, and at a limit.
    const KEPT: [usize; 2] = [10, 6];
    let piece = &curve.smooth().pieces[place.piece];
    let at = |u: f64| curvature_at(curve, Place { u, ..place });
    let is_reached = |u: f64| {
        let [least, most] = curve.circuit.passes[piece.pass_at(u)].input_range();
        (least..=most).contains(&piece.map.input(u))
    };
    let is_at_limit = match piece.map {
        InputMap::Root { middle, half, .. } => (middle + half * place.u).abs() < AT_LIMIT * half,
        InputMap::Linear { .. } => false,
    };
    let (values, kept, centre) = if !is_at_limit && [-REACH, REACH].iter().all(|t| is_reached(place.u + t)) {
        // On its way back the path bends to the other side.
        (Chebyshev::nodes().map(|node| node.signum() * at(place.u + REACH * node)), KEPT[0], 0.0)
    } else {
        let [least, most] = SQUARES;
        let (middle, half) = ((least + most) / 2.0, (most - least) / 2.0);
        // Towards the further end of the piece.
        let sign = if place.u > 0.0 { -1.0 } else { 1.0 };
        let of_square = |node: f64| at(place.u + sign * (middle + half * node).sqrt());
        (Chebyshev::nodes().map(of_square), KEPT[1], -middle / half)
    };
    let mut series = Chebyshev::from_values(&values);
    series.0[kept..].fill(0.0);
    let extremes = series.derivative().zeros(0.0, 1e-3).places;
    let places = [centre, -1.0, 1.0].into_iter().chain(extremes);
    places.map(|place| series.at(place).abs()).fold(0.0, f64::max)
}

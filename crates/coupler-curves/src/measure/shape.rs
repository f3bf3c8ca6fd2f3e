//! Crunodes, inflections, cusps and the greatest curvature of the path.

use super::curve::{Place, StopKind};
use super::{Measure, TracedCurve, Value};
use crate::geometry::cross;
use crate::linkage::DyadSet;
use crate::motion::{InputMap, InputPosition, JointDerivatives};

/// The measure `crunodes`.
pub const CRUNODES: Measure = Measure::number(
    "crunodes",
    "number of crunodes",
    "",
    "points at which the path crosses itself",
    |curve: &TracedCurve| Value::Number(curve.crossings().points.len() as f64),
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
    "counts of the curve of which it is not known whether they are two more, because two crunodes or inflections would be within 1e-9 of a turn; positions if the linkage is so near a change point that the curve is not known to 1e-9 of its extent; empty if nothing is in doubt",
    |curve: &TracedCurve| match (curve.crossings().doubtful > 0, curve.inflections().1 > 0) {
        _ if curve.smooth().rounding > RESOLVED * curve.extent() => Value::Word("positions"),
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
    "greatest curvature of the path except at corners at change points, in 1 over the manifest's unit; inf if there is a cusp, or if the path reverses at a limit",
    |curve: &TracedCurve| max_curvature(curve).map_or(Value::Missing, Value::Number),
);

impl TracedCurve<'_> {
    /// The number of cusps.
    pub(super) fn cusp_count(&self) -> usize {
        *self.cusp_count.get_or_init(|| count_cusps(self))
    }
}

/// The number of cusps of a path.
fn count_cusps(curve: &TracedCurve) -> usize {
    curve.stops().iter().filter(|stop| stop.kind == StopKind::Cusp).count()
}

/// The greatest curvature of a path; infinite if it stops, at a cusp or where it returns on itself at a limit.
fn max_curvature(curve: &TracedCurve) -> Option<f64> {
    if !curve.stops().is_empty() {
        return Some(f64::INFINITY);
    }
    let (curvature, place) = curve.smooth().sharpest()?;
    Some(exact_curvature(curve, place).unwrap_or(curvature))
}

/// The curvature from the derivatives of the motion, which are more exact than those of the series; `None` near a limit,
/// where they are unbounded.
fn exact_curvature(curve: &TracedCurve, place: Place) -> Option<f64> {
    /// The part of the root of the input's range next to a limit in which the terms of the curvature cancel.
    const NEAR_LIMIT: f64 = 0.1;
    let piece = &curve.smooth().pieces[place.piece];
    let pass = &curve.circuit.passes[piece.pass_at(place.u)];
    if let InputMap::Root { middle, half, .. } = piece.map
        && (middle + half * place.u).abs() < NEAR_LIMIT * pass.input_length().sqrt()
    {
        return None;
    }
    let (linkage, joint) = curve.single_point_linkage();
    let input = InputPosition::new(linkage.input(), piece.map.input(place.u));
    let derivatives = JointDerivatives::new(linkage, input, pass.mode, DyadSet::EMPTY);
    let (v, a) = (derivatives.velocity(joint), derivatives.acceleration(joint));
    let speed = v.norm();
    let curvature = (cross(v, a) / (speed * speed * speed)).abs();
    curvature.is_finite().then_some(curvature)
}

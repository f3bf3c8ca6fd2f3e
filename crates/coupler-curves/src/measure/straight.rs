//! The straightest portion of a curve.
//!
//! The *strip* of a portion is the narrowest band between two parallel lines that contains it, so that the line in the
//! strip's middle is the minimax line of the portion. Its *length* is that of its projection on that line, and its
//! *deviation* is half the strip's width: no point of it is further from the line.
//!
//! For a tolerance, the result is the longest portion whose strip is no wider than that part of its length. For an
//! input span or a length, it is the portion with the narrowest strip: first among those that begin at samples, and
//! then between them. A portion may extend across sample 0 of a closed curve, and across limits.

use super::curve_segment::CurveSegment;
use super::longest_straight::longest;
use super::straightest::straightest;
use super::strip::Strip;
use super::{Measure, TracedCurve, Value};
use crate::geometry::Point;

/// The criterion by which the straight portion is selected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StraightCriterion {
    /// The longest portion whose strip is no wider than this part of its length.
    Tolerance(f64),
    /// The straightest portion that spans this much input, in degrees or as a length.
    Input(f64),
    /// The straightest portion of this length.
    Length(f64),
}

impl Default for StraightCriterion {
    fn default() -> StraightCriterion {
        StraightCriterion::Tolerance(0.001)
    }
}

/// A straight portion.
#[derive(Clone, Debug, PartialEq)]
pub struct StraightPortion {
    /// The length of its projection on its line.
    pub length: f64,
    /// The greatest distance of its points from that line.
    pub deviation: f64,
    /// The input at which it begins.
    pub start_input: f64,
    /// The input it spans, which is counted forward and backward at limits.
    pub input_span: f64,
    /// Its points: the samples and its ends.
    pub points: Vec<Point>,
}

/// The measures of the straight portion.
pub const MEASURES: [Measure; 4] = [
    Measure::number(
        "straight_length",
        "",
        "length of the straightest portion, projected on its line, in the manifest's unit: the longest in a strip no wider than 0.001 of it, or as set by the family's `straight`",
        |curve| portion_value(curve, |portion| portion.length),
    ),
    Measure::number(
        "straight_deviation",
        "",
        "greatest distance of the straightest portion from its line, half the width of its strip, in the manifest's unit",
        |curve| portion_value(curve, |portion| portion.deviation),
    ),
    Measure::number(
        "straight_start_deg",
        "deg",
        "input at which the straightest portion begins; a length for an actuator",
        |curve| portion_value(curve, |portion| portion.start_input),
    ),
    Measure::number(
        "straight_input_deg",
        "deg",
        "input that the straightest portion spans; a length for an actuator",
        |curve| portion_value(curve, |portion| portion.input_span),
    ),
];

fn portion_value(curve: &TracedCurve, value: fn(&StraightPortion) -> f64) -> Value {
    curve.straight().map_or(Value::Missing, |portion| Value::Number(value(portion)))
}

/// The portion of a curve that meets a criterion; `None` if the curve is too short.
pub(super) fn find_portion(curve: &CurveSegment, criterion: StraightCriterion) -> Option<StraightPortion> {
    let ends = match criterion {
        StraightCriterion::Tolerance(tolerance) => longest(curve, tolerance)?,
        StraightCriterion::Input(span) => straightest(curve, |from| curve.end_after_input(from, span))?,
        StraightCriterion::Length(length) => straightest(curve, |from| curve.end_after_length(from, length))?,
    };
    let points = curve.portion_points(ends);
    let Strip { width, length, .. } = Strip::enclosing(points.clone());
    let (start, input) = (curve.input_at(ends[0]), curve.input_span(ends));
    Some(StraightPortion { length, deviation: width / 2.0, start_input: start, input_span: input, points })
}

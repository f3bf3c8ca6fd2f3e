//! The straightest portion of a curve.
//!
//! A portion lies in a *strip*: the narrowest band between two parallel lines that holds it, so that the line in the
//! strip's middle is the minimax line of the portion. Its *length* is that of its projection on that line, and its
//! *deviation* half the strip's width: no point of it is further from the line.
//!
//! Of a tolerance, the longest portion is wanted whose strip is no wider than that part of its length. Of an input span or
//! a length the portion with the narrowest strip is wanted: of those that begin at samples, and then between them. A
//! portion may go over sample 0 of a closed curve, and over limits.

use super::curve_segment::CurveSegment;
use super::longest_straight::longest;
use super::straightest::straightest;
use super::strip::Strip;
use super::{Measure, TracedCurve, Value};
use crate::geometry::Point;

/// What is asked of the straight portion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StraightCriterion {
    /// The longest whose strip is no wider than this part of its length.
    Tolerance(f64),
    /// The straightest that spans this much input, in degrees or as a length.
    Input(f64),
    /// The straightest of this length.
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
    /// How much input it spans, there and back over limits.
    pub input_span: f64,
    /// Its points: the samples, and between them its ends.
    pub points: Vec<Point>,
}

/// What is told of it.
pub const MEASURES: [Measure; 4] = [
    Measure::number(
        "straight_length",
        "",
        "length of the straightest portion, projected on its line, in the manifest's unit: the longest in a strip no wider than 0.001 of it, or as the family's `straight` has it",
        |subject| portion_value(subject, |portion| portion.length),
    ),
    Measure::number(
        "straight_deviation",
        "",
        "greatest distance of the straightest portion from its line, half the width of its strip, in the manifest's unit",
        |subject| portion_value(subject, |portion| portion.deviation),
    ),
    Measure::number(
        "straight_start_deg",
        "deg",
        "input at which the straightest portion begins; of an actuator a length",
        |subject| portion_value(subject, |portion| portion.start_input),
    ),
    Measure::number(
        "straight_input_deg",
        "deg",
        "input the straightest portion spans; of an actuator a length",
        |subject| portion_value(subject, |portion| portion.input_span),
    ),
];

fn portion_value(subject: &TracedCurve, value: fn(&StraightPortion) -> f64) -> Value {
    subject.straight().map_or(Value::Missing, |portion| Value::Number(value(portion)))
}

/// The portion asked for, of a curve; `None` where there is none so long.
pub(super) fn find_portion(course: &CurveSegment, asked: StraightCriterion) -> Option<StraightPortion> {
    let ends = match asked {
        StraightCriterion::Tolerance(tolerance) => longest(course, tolerance)?,
        StraightCriterion::Input(span) => straightest(course, |from| course.end_after_input(from, span))?,
        StraightCriterion::Length(length) => straightest(course, |from| course.end_after_length(from, length))?,
    };
    let points = course.portion_points(ends);
    let Strip { width, length, .. } = Strip::enclosing(points.clone());
    let (start, input) = (course.input_at(ends[0]), course.input_span(ends));
    Some(StraightPortion { length, deviation: width / 2.0, start_input: start, input_span: input, points })
}

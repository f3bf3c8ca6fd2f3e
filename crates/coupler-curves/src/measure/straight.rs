//! The straightest portion of a curve.
//!
//! A portion lies in a *strip*: the narrowest band between two parallel lines that holds it, so that the line in the
//! strip's middle is the minimax line of the portion. Its *length* is that of its projection on that line, and its
//! *deviation* half the strip's width: no point of it is further from the line.
//!
//! Of a tolerance, the longest portion is wanted whose strip is no wider than that part of its length. Of an input span or
//! a length the portion with the narrowest strip is wanted: of those that begin at samples, and then between them. A
//! portion may go over sample 0 of a closed curve, and over limits.

use super::course::Course;
use super::longest::longest;
use super::straightest::straightest;
use super::strip::Strip;
use super::{Measure, Subject, Value};
use crate::geometry::Point;

/// What is asked of the straight portion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Straight {
    /// The longest whose strip is no wider than this part of its length.
    Tolerance(f64),
    /// The straightest that spans this much input, in degrees or as a length.
    Input(f64),
    /// The straightest of this length.
    Length(f64),
}

impl Default for Straight {
    fn default() -> Straight {
        Straight::Tolerance(0.001)
    }
}

/// A straight portion.
#[derive(Clone, Debug, PartialEq)]
pub struct Portion {
    /// The length of its projection on its line.
    pub length: f64,
    /// The greatest distance of its points from that line.
    pub deviation: f64,
    /// The input at which it begins.
    pub start: f64,
    /// How much input it spans, there and back over limits.
    pub input: f64,
    /// Its points: the samples, and between them its ends.
    pub points: Vec<Point>,
}

/// What is told of it.
pub const MEASURES: [Measure; 4] = [
    Measure::number(
        "straight_length",
        "",
        "length of the straightest portion, projected on its line, in the manifest's unit: the longest in a strip no wider than 0.001 of it, or as the family's `straight` has it",
        |subject| of(subject, |portion| portion.length),
    ),
    Measure::number(
        "straight_deviation",
        "",
        "greatest distance of the straightest portion from its line, half the width of its strip, in the manifest's unit",
        |subject| of(subject, |portion| portion.deviation),
    ),
    Measure::number(
        "straight_start_deg",
        "deg",
        "input at which the straightest portion begins; of an actuator a length",
        |subject| of(subject, |portion| portion.start),
    ),
    Measure::number(
        "straight_input_deg",
        "deg",
        "input the straightest portion spans; of an actuator a length",
        |subject| of(subject, |portion| portion.input),
    ),
];

fn of(subject: &Subject, value: fn(&Portion) -> f64) -> Value {
    subject.straight().map_or(Value::Missing, |portion| Value::Number(value(portion)))
}

/// The portion asked for, of a curve; `None` where there is none so long.
pub(super) fn portion(course: &Course, asked: Straight) -> Option<Portion> {
    let ends = match asked {
        Straight::Tolerance(tolerance) => longest(course, tolerance)?,
        Straight::Input(span) => straightest(course, |from| course.after_input(from, span))?,
        Straight::Length(length) => straightest(course, |from| course.after_length(from, length))?,
    };
    let points = course.portion(ends);
    let Strip { width, length, .. } = Strip::of(points.clone());
    let (start, input) = (course.input(ends[0]), course.spanned(ends));
    Some(Portion { length, deviation: width / 2.0, start, input, points })
}

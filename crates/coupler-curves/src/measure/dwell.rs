//! The best circular portion of a curve: the far end of a link that is as long as its radius dwells at its centre while
//! the coupler point traverses it.
//!
//! A portion is circular if it lies in an *annulus*, the ring between two concentric circles, no wider than 0.001 of
//! the curve's greatest extent, and the mean radius is no greater than the length of the curve, which excludes straight
//! portions. The best one spans the most input.

use super::budget::TooManySteps;
use super::features::Dwell;
use super::portion::{CircularPortion, EXACT, INTERVALS, Row, longest_circular};
use super::{Measure, TracedCurve, Value, start_input, without_rounding};

/// The greatest width of the annulus, relative to the curve's greatest extent.
const TOLERANCE: f64 = 0.001;

/// The measures of the dwell.
pub const MEASURES: [Measure; 6] = [
    Measure::number(
        "dwell_input_deg",
        "input span of the circular portion",
        "deg",
        "greatest input span of a portion within 0.0005 of the curve's greatest extent of a circle",
        |curve| dwell_value(curve, |dwell| dwell.input_span),
    )
    .more_is_better()
    .or_length("dwell_input_length"),
    Measure::number(
        "dwell_radius",
        "radius of the circular portion",
        "",
        "radius of that circle, no more than the curve's length, in the manifest's unit",
        |curve| dwell_value(curve, |dwell| dwell.radius),
    ),
    Measure::number(
        "dwell_deviation",
        "deviation of the circular portion",
        "",
        "greatest distance of the circular portion from its circle",
        |curve| dwell_value(curve, |dwell| dwell.deviation),
    ),
    Measure::number(
        "dwell_start_deg",
        "input at the start of the circular portion",
        "deg",
        "input at which the circular portion begins",
        |curve| curve.dwell().map_or(Value::Missing, |dwell| Value::Number(start_input(curve, dwell.start_input))),
    )
    .at_input()
    .or_length("dwell_start_length"),
    Measure::number("dwell_x", "x of the circular portion's centre", "", "x of the circle's centre", |curve| {
        dwell_value(curve, |dwell| dwell.centre.x)
    }),
    Measure::number("dwell_y", "y of the circular portion's centre", "", "y of the circle's centre", |curve| {
        dwell_value(curve, |dwell| dwell.centre.y)
    }),
];

fn dwell_value(curve: &TracedCurve, value: fn(&Dwell) -> f64) -> Value {
    curve.dwell().map_or(Value::Missing, |dwell| Value::Number(value(dwell)))
}

/// The best circular portion of a curve of a given extent and length, from its points; `None` for a point or a straight line.
///
/// # Errors
/// The search takes too many steps.
fn find_dwell(row: &Row, extent: f64, length: f64) -> Result<Option<Dwell>, TooManySteps> {
    let Some(portion) = longest_circular(row, TOLERANCE * extent, length)? else { return Ok(None) };
    let CircularPortion { ends, centre, radius, width } = portion;
    // The rounding of the circle is that of the positions; a deviation is as accurate as that of a straight portion.
    let centre = centre.map(|coordinate| without_rounding(coordinate, ROUNDING * radius));
    let deviation = without_rounding(width / 2.0, EXACT * radius);
    let input_span = row.input_span(ends);
    let points = row.points_between(ends, INTERVALS);
    Ok(Some(Dwell { centre, radius, deviation, start_input: row.input_at(ends[0]), input_span, points }))
}

impl TracedCurve<'_> {
    /// The best circular portion.
    pub fn dwell(&self) -> Option<&Dwell> {
        self.counted_dwell().as_ref().ok()?.as_ref()
    }

    /// The same, unless the search takes too many steps.
    pub(super) fn counted_dwell(&self) -> &Result<Option<Dwell>, TooManySteps> {
        let of_row = |row: &Row| find_dwell(row, self.extent(), self.arc_length().total());
        self.dwell.get_or_init(|| self.row()?.map_or(Ok(None), of_row))
    }
}

/// The rounding of a centre, relative to the radius.
const ROUNDING: f64 = 1e-12;

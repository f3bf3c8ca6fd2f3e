//! The limits of the output, and the angle or the distance between them.

use super::motion::OutputMotion;
use super::output_value;
use crate::geometry::{Point, trig};
use crate::measure::circuit_function::Extreme;
use crate::measure::{Measure, Subject, TracedCurve, without_rounding};
use crate::motion;

/// The measure `output_min`.
pub const MIN: Measure = Measure::number(
    "output_min",
    "least position of the output",
    "",
    "least angle of the output link from the frame, deg, or least displacement of the output slider along its line; empty if it turns fully",
    |curve| output_value(curve, |output| Some(limits(output)?[0])),
).of(Subject::WithOutput);

/// The measure `output_max`.
pub const MAX: Measure = Measure::number(
    "output_max",
    "greatest position of the output",
    "",
    "greatest angle of the output link from the frame, deg, or greatest displacement of the output slider; empty if it turns fully",
    |curve| output_value(curve, |output| Some(limits(output)?[1])),
).of(Subject::WithOutput);

/// The measure `output_swing_deg`.
pub const SWING: Measure = Measure::number(
    "output_swing_deg",
    "swing of the output link",
    "deg",
    "angle that the output link swings through over the circuit; 360 if it turns fully; empty for a slider",
    |curve| output_value(curve, |output| (!output.coordinate.quantity().is_slider()).then(|| swing(output))),
)
.more_is_better()
.of(Subject::WithTurningOutput);

/// The measure `output_stroke`.
pub const STROKE: Measure = Measure::number(
    "output_stroke",
    "stroke of the output slider",
    "",
    "stroke of the output slider over the circuit, in the manifest's unit; empty for a link that turns",
    |curve| output_value(curve, |output| output.coordinate.quantity().is_slider().then(|| output.travel())),
)
.more_is_better()
.of(Subject::WithSlidingOutput);

/// The positions of all joints at the limits of the output on the circuit of a curve: first where its angle or its
/// displacement is least, then where it is greatest. `None` without an output link, and where that turns fully or does not
/// move.
pub fn output_limit_poses(curve: &TracedCurve) -> Option<[Vec<Point>; 2]> {
    let output = curve.output().filter(|output| !output.turns_fully && !output.is_at_rest())?;
    let coordinate = &output.coordinate;
    let pose = |extreme: &Extreme| {
        let place = *extreme.places.first()?;
        let input = coordinate.refined_input(place, |derivatives| coordinate.quantity().rate(derivatives));
        Some(motion::pose(curve.linkage, coordinate.pass(place), input))
    };
    let [least, greatest] = &output.extremes;
    Some([pose(least)?, pose(greatest)?])
}

/// The accuracy of a limit, relative to a turn or to the stroke.
const RESOLVED: f64 = 1e-12;

/// The limits of the output: of an angle in degrees, with its middle in (-180, 180].
fn limits(output: &OutputMotion) -> Option<[f64; 2]> {
    let [least, greatest] = &output.extremes;
    let limits = [least.value, greatest.value];
    if output.coordinate.quantity().is_slider() {
        return Some(limits.map(|limit| without_rounding(limit, RESOLVED * output.travel())));
    }
    let limits = limits.map(trig::degrees);
    // A middle opposite the x-axis is 180 degrees in spite of rounding.
    const ROUNDING: f64 = 1e-10;
    let whole_turns = (0.5 - (limits[0] + limits[1]) / 720.0 + ROUNDING).floor();
    let limits = limits.map(|deg| without_rounding(deg + 360.0 * whole_turns, 360.0 * RESOLVED));
    (!output.turns_fully).then_some(limits)
}

fn swing(output: &OutputMotion) -> f64 {
    let swing = without_rounding(trig::degrees(output.travel()), 360.0 * RESOLVED);
    // An output that an actuator drives may turn once without a closed circuit.
    if output.turns_fully || (swing - 360.0).abs() <= 360.0 * RESOLVED { 360.0 } else { swing }
}

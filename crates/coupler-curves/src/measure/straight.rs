//! The straightest portion of a curve.
//!
//! The *strip* of a portion is the narrowest band between two parallel lines that contains it, so that the line in the
//! strip's middle is the minimax line of the portion. Its *length* is that of its projection on that line, and its
//! *deviation* is half the strip's width: no point of it is further from the line.
//!
//! For a tolerance, the result is the longest portion whose strip is no wider than that part of its length. For an
//! input span or a length, it is the portion with the narrowest strip. A portion may extend across the start of a closed
//! curve, and across limits.

use super::budget::TooManySteps;
use super::features::{StraightCriterion, StraightPortion};
use super::portion::{
    CurveStrips, EXACT, INTERVALS, LEAST_SHARE, Narrowest, PortionStrip, Row, SPACING, longest_straight, straightest,
};
use super::{Measure, Subject, TracedCurve, Value, start_input};
use crate::linkage::Input;

/// The measures of the straight portion.
pub const MEASURES: [Measure; 6] = [
    Measure::number(
        "straight_length",
        "length of the straight portion",
        "",
        "length of the straightest portion, projected on its line, in the manifest's unit: the longest in a strip no wider than 0.001 of it, or as set by the family's `straight`; empty if it is shorter than a twentieth of the curve's greatest extent",
        |curve| portion_value(curve, |portion| portion.length),
    ).more_is_better(),
    Measure::number(
        "straight_share",
        "length of the straight portion over the curve's extent",
        "",
        "that length relative to the curve's greatest extent",
        |curve| match curve.straight() {
            Some(portion) => Value::Number((portion.length / curve.extent()).min(1.0)),
            None => Value::Missing,
        },
    ).more_is_better(),
    Measure::number(
        "straight_deviation",
        "deviation of the straight portion",
        "",
        "greatest distance of the straightest portion from its line, half the width of its strip, in the manifest's unit",
        |curve| portion_value(curve, |portion| portion.deviation),
    ),
    Measure::number(
        "straight_start_deg",
        "input at the start of the straight portion",
        "deg",
        "input at which the straightest portion begins",
        |curve| start_value(curve, curve.straight()),
    )
    .at_input()
    .or_length("straight_start_length"),
    Measure::number(
        "straight_input_deg",
        "input span of the straight portion",
        "deg",
        "input that the straightest portion spans",
        |curve| portion_value(curve, |portion| portion.input_span),
    ).more_is_better()
    .or_length("straight_input_length"),
    Measure::number(
        "straight_twin_deg",
        "input at the start of the second straight portion",
        "deg",
        "input at which a second portion begins that is equally long, as on a symmetrical curve",
        |curve| start_value(curve, curve.straight_portions().get(1)),
    )
    .at_input()
    .or_length("straight_twin_length"),
];

/// The tolerances of further straight portions, wider than the default.
const WIDER_TOLERANCES: [f64; 2] = [0.005, 0.01];

/// The five measures of the longest straight portion to one of the wider tolerances.
macro_rules! wider {
    ($index:literal, $prefix:literal, $tolerance:literal) => {{
        fn value(curve: &TracedCurve, value: fn(&StraightPortion) -> f64) -> Value {
            portion_number(curve.wider_straight($index), value)
        }
        [
            Measure::number(
                concat!($prefix, "_length"),
                concat!("length of the portion straight to ", $tolerance),
                "",
                concat!(
                    "length of the longest portion in a strip no wider than ",
                    $tolerance,
                    " of it; empty below a twentieth of the extent"
                ),
                |curve| value(curve, |portion| portion.length),
            )
            .more_is_better(),
            Measure::number(
                concat!($prefix, "_share"),
                concat!("length over the curve's extent of the portion straight to ", $tolerance),
                "",
                "that length relative to the curve's greatest extent",
                |curve| {
                    portion_number(curve.wider_straight($index), |portion| (portion.length / curve.extent()).min(1.0))
                },
            )
            .more_is_better(),
            Measure::number(
                concat!($prefix, "_deviation"),
                concat!("deviation of the portion straight to ", $tolerance),
                "",
                "greatest distance of that portion from its line",
                |curve| value(curve, |portion| portion.deviation),
            ),
            Measure::number(
                concat!($prefix, "_start_deg"),
                concat!("input at the start of the portion straight to ", $tolerance),
                "deg",
                "input at which it begins",
                |curve| start_value(curve, curve.wider_straight($index)),
            )
            .at_input()
            .or_length(concat!($prefix, "_start_length")),
            Measure::number(
                concat!($prefix, "_input_deg"),
                concat!("input span of the portion straight to ", $tolerance),
                "deg",
                "input that it spans",
                |curve| value(curve, |portion| portion.input_span),
            )
            .more_is_better()
            .or_length(concat!($prefix, "_input_length")),
        ]
    }};
}

/// The measures of the straight portions to the wider tolerances.
pub const WIDER: [[Measure; 5]; 2] = [wider!(0, "straight_5", 0.005), wider!(1, "straight_10", 0.01)];

/// The measures of the straightest half turn.
pub const HALF_TURN: [Measure; 3] = [
    Measure::number(
        "straight_half_turn_length",
        "length of the straightest portion in half a turn",
        "",
        "length of the portion that is straightest for its length of those that half a turn of the input traverses; empty if its strip is wider than 0.02 of it",
        |curve| portion_number(curve.straight_half_turn(), |portion| portion.length),
    ).more_is_better().of(Subject::DrivenByAngle),
    Measure::number("straight_half_turn_deviation", "deviation of the straightest portion in half a turn", "", "greatest distance of that portion from its line", |curve| {
        portion_number(curve.straight_half_turn(), |portion| portion.deviation)
    }).of(Subject::DrivenByAngle),
    Measure::number("straight_half_turn_start_deg", "input at the start of the straightest portion in half a turn", "deg", "input at which it begins", |curve| {
        start_value(curve, curve.straight_half_turn())
    }).at_input().of(Subject::DrivenByAngle),
];

fn portion_number(portion: Option<&StraightPortion>, value: impl Fn(&StraightPortion) -> f64) -> Value {
    portion.map_or(Value::Missing, |portion| Value::Number(value(portion)))
}

fn start_value(curve: &TracedCurve, portion: Option<&StraightPortion>) -> Value {
    portion_number(portion, |portion| start_input(curve, portion.start_input))
}

fn portion_value(curve: &TracedCurve, value: fn(&StraightPortion) -> f64) -> Value {
    portion_number(curve.straight(), value)
}

impl TracedCurve<'_> {
    /// The straight portion that meets the criterion.
    pub fn straight(&self) -> Option<&StraightPortion> {
        self.straight_portions().first()
    }

    /// The straight portions that meet the criterion equally well, such as both of a symmetrical curve.
    pub fn straight_portions(&self) -> &[StraightPortion] {
        self.counted_straight().as_deref().unwrap_or_default()
    }

    /// The same, unless the search takes too many steps.
    pub(super) fn counted_straight(&self) -> &Result<Vec<StraightPortion>, TooManySteps> {
        self.straight.get_or_init(|| find_portions(self, self.straight_criterion))
    }

    /// The longest straight portion to one of the [`WIDER_TOLERANCES`].
    fn wider_straight(&self, index: usize) -> Option<&StraightPortion> {
        self.counted_wider_straight(index).as_ref().ok()?.first()
    }

    /// The longest straight portions to one of these tolerances, unless the search takes too many steps.
    pub(super) fn counted_wider_straight(&self, index: usize) -> &Result<Vec<StraightPortion>, TooManySteps> {
        let criterion = StraightCriterion::Tolerance(WIDER_TOLERANCES[index]);
        self.wider_straight[index].get_or_init(|| find_portions(self, criterion))
    }

    /// The straightest portion over half a turn of the input.
    fn straight_half_turn(&self) -> Option<&StraightPortion> {
        self.counted_half_turn().as_ref().ok()?.as_ref()
    }

    /// The same, unless the search takes too many steps.
    pub(super) fn counted_half_turn(&self) -> &Result<Option<StraightPortion>, TooManySteps> {
        self.straight_half_turn.get_or_init(|| find_half_turn(self))
    }
}

/// The portions of a curve that meet a criterion: the best, and of several equally long ones all, that of the least input span
/// first; none if the curve is too short, or nothing on it is straight over a twentieth of its extent.
///
/// # Errors
/// The search takes too many steps.
fn find_portions(curve: &TracedCurve, criterion: StraightCriterion) -> Result<Vec<StraightPortion>, TooManySteps> {
    let extent = curve.extent();
    let finer = match criterion {
        StraightCriterion::Length(length) if length < 16.0 * SPACING * extent => curve.row_of_spacing(length / 16.0)?,
        _ => None,
    };
    let row = finer.as_ref().map_or_else(|| curve.row(), |row| Ok(Some(row)))?;
    let Some(row) = row else { return Ok(Vec::new()) };
    let narrowest = |end: &dyn Fn(f64) -> Option<f64>| {
        straightest(row, end, Narrowest::Absolutely, f64::INFINITY).map(Vec::from_iter)
    };
    let ends = match criterion {
        StraightCriterion::Tolerance(tolerance) => longest_straight(row, tolerance, LEAST_SHARE * extent),
        StraightCriterion::Input(span) => narrowest(&|from| row.end_after_input(from, span)),
        StraightCriterion::Length(length) => narrowest(&|from| row.end_after_length(from, length)),
    };
    let mut portions: Vec<StraightPortion> = ends?.into_iter().map(|ends| portion(row, ends)).collect();
    // Of a line that is passed to and fro the quicker stroke comes first; spans that differ by rounding are equal.
    let shortest = portions.iter().map(|portion| portion.input_span).fold(f64::INFINITY, f64::min);
    portions.sort_by_key(|portion| portion.input_span > shortest * (1.0 + 1e-6));
    Ok(portions)
}

/// The portion that is straightest for its length of those that half a turn of the input traverses, if it is nearly
/// straight.
///
/// # Errors
/// The search takes too many steps.
fn find_half_turn(curve: &TracedCurve) -> Result<Option<StraightPortion>, TooManySteps> {
    /// The greatest width of its strip relative to its length: what is wider is no straight line to an eye.
    const WIDEST: f64 = 0.02;
    let row = curve.row()?.filter(|_| curve.linkage.input() != Input::Length);
    let Some(row) = row else { return Ok(None) };
    let ends =
        straightest(row, |from| row.end_after_input(from, 180.0), Narrowest::Relatively, WIDEST * curve.extent())?;
    let is_straight = |portion: &StraightPortion| 2.0 * portion.deviation <= WIDEST * portion.length;
    Ok(ends.map(|ends| portion(row, ends)).filter(is_straight))
}

/// The portion between two positions.
fn portion(row: &Row, ends: [f64; 2]) -> StraightPortion {
    let PortionStrip { width, length, .. } = CurveStrips::new(row, ends, INTERVALS).strip(ends);
    let input_span = row.input_span(ends);
    let deviation = if width / 2.0 < EXACT * length { 0.0 } else { width / 2.0 };
    let points = row.points_between(ends, INTERVALS);
    StraightPortion { length, deviation, start_input: row.input_at(ends[0]), input_span, points }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::trig;
    use crate::linkage::{LinkageBuilder, MotionOptions, Side};
    use crate::motion::{Motion, Sampler, Sampling};

    /// A coupler point of a four-bar with a frame of 4 and a crank of 1.
    fn with_curve(coupler: f64, rocker: f64, point: [f64; 2], use_curve: impl FnOnce(&TracedCurve)) {
        let mut builder = LinkageBuilder::default();
        let [o, c] = [("O", 0.0), ("C", 4.0)].map(|(name, x)| builder.fixed(name, [x, 0.0].into()));
        let a = builder.crank("A", o, 1.0).expect("a crank");
        let b = builder.dyad("B", [a, c], [coupler, rocker], Side::Left).expect("a dyad");
        let m = builder.point("M", [a, b], point[0], point[1]).expect("a point");
        let linkage = builder.build(vec![m], None, MotionOptions::default()).expect("a linkage");
        let motion = Motion::solve(&linkage, &Sampler::new(Sampling::Step(6.0)));
        use_curve(&TracedCurve::all(&linkage, &motion).next().expect("a curve"));
    }

    /// The strip of a portion next to another is that which is found anew: of all but one in a hundred to rounding, and of the others,
    /// where a point begins to touch that did not nearly touch before, it is no wider.
    #[test]
    fn a_strip_that_is_followed_is_that_of_its_portion() {
        const POINTS: usize = 32;
        let (mut count, mut different) = (0, 0);
        for k in 0..120 {
            // Numbers that do not repeat.
            let turn = |n: usize| (f64::from(k) * trig::cos(n as f64 + 0.5)).rem_euclid(1.0);
            let point = [8.0 * turn(2) - 2.0, 6.0 * turn(3) - 3.0];
            with_curve(3.5 + turn(0), 3.5 + turn(1), point, |curve| {
                let row = curve.row().ok().flatten().expect("points of a curve");
                let round = row.start_count as f64;
                let span = (0.02 + 0.2 * turn(4)) * round;
                let mut ends = [turn(5) * round, turn(5) * round + span];
                let start = CurveStrips::new(row, ends, POINTS);
                let mut strips = start.clone();
                for n in 6..14 {
                    ends = [ends[0] + 0.1 * (turn(n) - 0.5) * span, ends[1] + 0.1 * (turn(n + 20) - 0.5) * span];
                    let (next, anew) = (strips.next_strip(ends), start.clone().strip(ends));
                    let part = next.width / anew.width - 1.0;
                    if anew.width > 1e-6 * anew.length {
                        count += 1;
                        different += usize::from(part.abs() > 1e-9);
                        assert!(part < 1e-9, "{point:?} {ends:?}: {} is wider than {}", next.width, anew.width);
                    }
                }
            });
        }
        assert!(count > 500 && different <= count / 100, "{different} of {count} differ");
    }
}

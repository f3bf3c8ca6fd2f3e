//! The equations of the coupler curves of a four-bar.

use std::fmt::Write;

use coupler_curves::linkage::{DoublePointKind, PlacedFourBar, Sextic, SymmetricalFourBar};
use coupler_curves::solve::SolvedCell;
use serde::Serialize;

use super::format::format_point;
use crate::format::format_significant;

/// The equation of one coupler curve.
pub(super) struct Equation {
    /// The number of the traced joint, from 1.
    trace: usize,
    /// The name of the traced joint.
    name: String,
    sextic: Sextic,
    /// The length of the frame.
    frame: f64,
    /// For the symmetrical linkages of Natesan's chapter 8, where the curve crosses its axis.
    axis: Option<AxisCrossings>,
}

/// The axis of a symmetrical curve, perpendicular to the frame, and where the curve crosses it.
struct AxisCrossings {
    form: SymmetricalFourBar,
    x: f64,
    /// The y of the crossings above the frame, the furthest first; those below are their mirror images.
    y: Vec<f64>,
}

impl AxisCrossings {
    fn new(placed: &PlacedFourBar) -> Option<AxisCrossings> {
        let (form, [frame, short, long]) = SymmetricalFourBar::from_four_bar(placed.lengths, placed.coupler_point)?;
        let y = form.axis_crossings(frame, short, long).into_iter().flatten().map(|point| point.y).collect();
        Some(AxisCrossings { form, x: form.axis_x(frame), y })
    }

    /// "crosses its axis x = 1 at y = ±2.5, ±1.2 (Natesan 8.12)".
    fn describe(&self) -> String {
        let source = match self.form {
            SymmetricalFourBar::Evans => "8.3",
            SymmetricalFourBar::Chebyshev => "8.12",
        };
        let list: Vec<String> = self.y.iter().map(|y| format!("±{}", format_significant(*y, 10))).collect();
        let at =
            if list.is_empty() { "nowhere but at the frame".to_owned() } else { format!("at y = {}", list.join(", ")) };
        format!("crosses its axis x = {} {at} (Natesan {source})", format_significant(self.x, 10))
    }
}

/// The equations of all traced joints on the coupler of a four-bar, except its pins, which move on circles.
pub(super) fn coupler_equations(solved: &SolvedCell) -> Vec<Equation> {
    let linkage = &solved.linkage;
    let equation = |(trace, &joint)| {
        let placed = PlacedFourBar::from_linkage(linkage, joint).ok()?;
        let sextic = Sextic::from_four_bar(placed.lengths, placed.coupler_point)?;
        let name = linkage.joints[joint].name.clone();
        Some(Equation { trace, name, sextic, frame: placed.lengths.frame, axis: AxisCrossings::new(&placed) })
    };
    (1..).zip(&linkage.traced).filter_map(equation).collect()
}

/// Appends a line for each equation, followed by its coefficients if `with_coefficients`.
pub(super) fn append_text(equations: &[Equation], with_coefficients: bool, out: &mut String) {
    let has_several = equations.len() > 1;
    for Equation { trace, name, sextic, frame, axis } in equations {
        let name = if has_several { format!("{name} {trace}") } else { name.clone() };
        let double_points = sextic.double_points();
        let describe = |double: &coupler_curves::linkage::DoublePoint| {
            let isolated = if double.kind == DoublePointKind::Acnode { ", isolated" } else { "" };
            format!("{} {}{isolated}", double.kind.name(), format_point(double.point))
        };
        let list = double_points.iter().map(describe).collect::<Vec<_>>().join(", ");
        let list = if list.is_empty() { "none".to_owned() } else { list };
        let _ = writeln!(
            out,
            "{name}: on a sextic, {} through the circular points; real double points: {list}",
            count_word(sextic.circularity())
        );
        if let Some(axis) = axis {
            let _ = writeln!(out, "{name}: {}", axis.describe());
        }
        if with_coefficients {
            write_coefficients(["x", "y"], |i, j| sextic.coefficient(i, j), out);
            let centred = sextic.centred_coefficients();
            let is_even = (1..=5).step_by(2).all(|i| centred[i].iter().all(|coefficient| *coefficient == 0.0));
            let middle = format_significant(frame / 2.0, 10);
            let note = if is_even { "; no odd powers of X, the curve is symmetrical about X = 0" } else { "" };
            let _ = writeln!(out, "about the middle of the frame, X = x - {middle}, Y = y (Natesan 7.6){note}:");
            write_coefficients(["X", "Y"], |i, j| centred[i][j], out);
        }
    }
}

fn count_word(n: usize) -> String {
    ["not", "once", "twice", "three times"].get(n).map_or_else(|| format!("{n} times"), |word| (*word).to_owned())
}

/// Writes the coefficients, one row for each power of x and one column for each power of y.
fn write_coefficients([x, y]: [&str; 2], coefficient: impl Fn(usize, usize) -> f64, out: &mut String) {
    let power = |letter: &str, n: usize| match n {
        0 => "1".to_owned(),
        1 => letter.to_owned(),
        n => format!("{letter}^{n}"),
    };
    let head: String = (0..=6).map(|j| format!("{:>15}", power(y, j))).collect();
    let _ = writeln!(out, "     {head}");
    for i in 0..=6 {
        let row: String = (0..=6 - i).map(|j| format!("{:>17}", format_significant(coefficient(i, j), 9))).collect();
        let _ = writeln!(out, "{:<5}{row}", power(x, i));
    }
}

/// The coefficients, a list for each power of x of those of rising powers of y.
fn coefficient_rows(coefficient: impl Fn(usize, usize) -> f64) -> Vec<Vec<f64>> {
    // Adding 0 turns -0 into 0.
    (0..=6).map(|i| (0..=6 - i).map(|j| coefficient(i, j) + 0.0).collect()).collect()
}

/// An equation, for `inspect --json`.
#[derive(Serialize)]
pub(super) struct EquationJson {
    trace: usize,
    coefficients: Vec<Vec<f64>>,
    centred_coefficients: Vec<Vec<f64>>,
    axis: Option<AxisJson>,
    double_points: Vec<DoublePointJson>,
    circular_points: usize,
}

#[derive(Serialize)]
struct AxisJson {
    x: f64,
    y: Vec<f64>,
}

#[derive(Serialize)]
struct DoublePointJson {
    at: [f64; 2],
    kind: &'static str,
}

/// The equations, for `inspect --json`.
pub(super) fn json(equations: &[Equation]) -> Vec<EquationJson> {
    let equation = |Equation { trace, sextic, axis, .. }: &Equation| {
        let centred = sextic.centred_coefficients();
        let double_points = sextic.double_points().into_iter();
        EquationJson {
            trace: *trace,
            coefficients: coefficient_rows(|i, j| sextic.coefficient(i, j)),
            centred_coefficients: coefficient_rows(|i, j| centred[i][j]),
            axis: axis.as_ref().map(|AxisCrossings { x, y, .. }| AxisJson { x: *x, y: y.clone() }),
            double_points: double_points
                .map(|double| DoublePointJson { at: [double.point.x, double.point.y], kind: double.kind.name() })
                .collect(),
            circular_points: sextic.circularity(),
        }
    };
    equations.iter().map(equation).collect()
}

//! The equations of the curves that points of a four-bar's coupler draw.

use std::fmt::Write;

use coupler_curves::linkage::{DoublePointKind, PlacedFourBar, Sextic};
use coupler_curves::solve::SolvedCell;
use serde_json::{Value, json};

use super::text::{format_point, format_significant};

/// The equation of one coupler curve.
pub(super) struct Equation {
    /// The number of the traced joint, from 1, and its name.
    trace: usize,
    name: String,
    sextic: Sextic,
}

/// Those of all traced joints on the coupler of a four-bar; none of other joints, nor of the pins, which go on circles.
pub(super) fn coupler_equations(solved: &SolvedCell) -> Vec<Equation> {
    let linkage = &solved.linkage;
    let equation = |(trace, &joint)| {
        let placed = PlacedFourBar::from_linkage(linkage, joint).ok()?;
        let sextic = Sextic::from_four_bar(placed.lengths, placed.coupler_point)?;
        Some(Equation { trace, name: linkage.joints[joint].name.clone(), sextic })
    };
    (1..).zip(&linkage.traced).filter_map(equation).collect()
}

/// For people: a line for each, and the coefficients if they are wanted.
pub(super) fn text(equations: &[Equation], in_full: bool, out: &mut String) {
    let is_grid = equations.len() > 1;
    for Equation { trace, name, sextic } in equations {
        let name = if is_grid { format!("{name} {trace}") } else { name.clone() };
        let doubles = sextic.double_points();
        let double = |double: &coupler_curves::linkage::DoublePoint| {
            let isolated = if double.kind == DoublePointKind::Acnode { ", isolated" } else { "" };
            format!("{} {}{isolated}", double.kind.name(), format_point(double.point))
        };
        let list = doubles.iter().map(double).collect::<Vec<_>>().join(", ");
        let list = if list.is_empty() { "none".to_owned() } else { list };
        let _ = writeln!(
            out,
            "{name}: on a sextic, {} through the circular points; real double points: {list}",
            count_word(sextic.circularity())
        );
        if in_full {
            write_coefficients(sextic, out);
        }
    }
}

fn count_word(n: usize) -> String {
    ["not", "once", "twice", "three times"].get(n).map_or_else(|| format!("{n} times"), |word| (*word).to_owned())
}

/// The coefficients, a row to a power of x and a column to a power of y.
fn write_coefficients(sextic: &Sextic, out: &mut String) {
    let power = |letter: &str, n: usize| match n {
        0 => "1".to_owned(),
        1 => letter.to_owned(),
        n => format!("{letter}^{n}"),
    };
    let head: String = (0..=6).map(|j| format!("{:>15}", power("y", j))).collect();
    let _ = writeln!(out, "     {head}");
    for i in 0..=6 {
        let row: String =
            (0..=6 - i).map(|j| format!("{:>17}", format_significant(sextic.coefficient(i, j), 9))).collect();
        let _ = writeln!(out, "{:<5}{row}", power("x", i));
    }
}

/// For programs.
pub(super) fn json(equations: &[Equation]) -> Vec<Value> {
    let equation = |Equation { trace, sextic, .. }: &Equation| {
        // Adding 0 makes a zero of either sign plain.
        let row = |i: usize| (0..=6 - i).map(|j| sextic.coefficient(i, j) + 0.0).collect::<Vec<f64>>();
        let doubles = sextic.double_points().into_iter();
        json!({
            "trace": trace,
            "coefficients": (0..=6).map(row).collect::<Vec<_>>(),
            "double_points": doubles
                .map(|double| json!({ "at": [double.point.x, double.point.y], "kind": double.kind.name() }))
                .collect::<Vec<_>>(),
            "circular_points": sextic.circularity(),
        })
    };
    equations.iter().map(equation).collect()
}

//! The equations of the coupler curves of a four-bar.

use std::fmt::Write;

use coupler_curves::linkage::{DoublePointKind, PlacedFourBar, Sextic};
use coupler_curves::solve::SolvedCell;
use serde_json::{Value, json};

use super::format::{format_point, format_significant};

/// The equation of one coupler curve.
pub(super) struct Equation {
    /// The number of the traced joint, from 1.
    trace: usize,
    /// The name of the traced joint.
    name: String,
    sextic: Sextic,
}

/// The equations of all traced joints on the coupler of a four-bar, except its pins, which move on circles.
pub(super) fn coupler_equations(solved: &SolvedCell) -> Vec<Equation> {
    let linkage = &solved.linkage;
    let equation = |(trace, &joint)| {
        let placed = PlacedFourBar::from_linkage(linkage, joint).ok()?;
        let sextic = Sextic::from_four_bar(placed.lengths, placed.coupler_point)?;
        Some(Equation { trace, name: linkage.joints[joint].name.clone(), sextic })
    };
    (1..).zip(&linkage.traced).filter_map(equation).collect()
}

/// Appends a line for each equation, followed by its coefficients if `with_coefficients`.
pub(super) fn append_text(equations: &[Equation], with_coefficients: bool, out: &mut String) {
    let has_several = equations.len() > 1;
    for Equation { trace, name, sextic } in equations {
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
        if with_coefficients {
            write_coefficients(sextic, out);
        }
    }
}

fn count_word(n: usize) -> String {
    ["not", "once", "twice", "three times"].get(n).map_or_else(|| format!("{n} times"), |word| (*word).to_owned())
}

/// Writes the coefficients, one row for each power of x and one column for each power of y.
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

/// The equations, for `inspect --json`.
pub(super) fn json(equations: &[Equation]) -> Vec<Value> {
    let equation = |Equation { trace, sextic, .. }: &Equation| {
        // Adding 0 turns -0 into 0.
        let row = |i: usize| (0..=6 - i).map(|j| sextic.coefficient(i, j) + 0.0).collect::<Vec<f64>>();
        let double_points = sextic.double_points().into_iter();
        json!({
            "trace": trace,
            "coefficients": (0..=6).map(row).collect::<Vec<_>>(),
            "double_points": double_points
                .map(|double| json!({ "at": [double.point.x, double.point.y], "kind": double.kind.name() }))
                .collect::<Vec<_>>(),
            "circular_points": sextic.circularity(),
        })
    };
    equations.iter().map(equation).collect()
}

//! How far the curves move where each length is off by a tolerance, and how far each may be off.

use std::fmt::Write;

use coupler_curves::family::Family;
use coupler_curves::solve::{CurveTolerance, SolvedCell, curve_tolerances};
use coupler_curves::template::Template;
use serde::Serialize;

use crate::format::format_significant;
use crate::notation::Notation;

/// The tolerances of all curves for an error of each length.
pub(super) struct Tolerance {
    error: f64,
    /// The names of the lengths.
    names: Vec<String>,
    curves: Vec<ToleratedCurve>,
    /// The numbers of the traces and circuits of curves that have none.
    without: Vec<[usize; 2]>,
}

struct ToleratedCurve {
    curve: CurveTolerance,
    /// The length of the straight portion.
    straight: Option<f64>,
}

#[derive(Serialize)]
pub(super) struct ToleranceJson<'a> {
    error: f64,
    curves: Vec<CurveJson<'a>>,
}

#[derive(Serialize)]
struct CurveJson<'a> {
    trace: usize,
    circuit: usize,
    worst_case: f64,
    root_sum_square: f64,
    lengths: Vec<LengthJson<'a>>,
}

#[derive(Serialize)]
struct LengthJson<'a> {
    name: &'a str,
    sensitivity: f64,
    straight_sensitivity: Option<f64>,
    permitted: Option<f64>,
}

/// Checks that the lengths of a linkage can be off by a length.
///
/// # Errors
/// It is not positive; the linkage has a grid of points.
pub(super) fn check(template: &Template, error: f64, notation: Notation) -> Result<(), String> {
    if !(error > 0.0 && error.is_finite()) {
        let [given, example] = [error, 0.1].map(|length| notation.with_value("tolerance", length));
        return Err(format!("{given}: give a positive length, as in {example}"));
    }
    if template.lengths().is_none() {
        return Err(format!("{}: {}: {}", notation.name("tolerance"), template.id, Template::NO_LENGTHS));
    }
    Ok(())
}

impl Tolerance {
    /// The tolerances of a linkage; `None` where no length is off by itself.
    pub(super) fn new(family: &Family, solved: &SolvedCell, error: f64) -> Option<Tolerance> {
        let template = &family.template;
        let (lengths, curves) = template.lengths().zip(curve_tolerances(family, solved))?;
        let names = lengths.iter().map(|length| template.length_name(length)).collect();
        let straight = |curve: &CurveTolerance| {
            let same = solved.curves.iter().find(|own| own.trace == curve.trace && own.circuit == curve.circuit);
            same.and_then(|own| Some(own.straight.as_ref()?.length))
        };
        let without: Vec<[usize; 2]> = solved
            .curves
            .iter()
            .map(|curve| [curve.trace, curve.circuit])
            .filter(|own| curves.iter().all(|curve| [curve.trace, curve.circuit] != *own))
            .collect();
        let curves = curves.into_iter().map(|curve| ToleratedCurve { straight: straight(&curve), curve }).collect();
        Some(Tolerance { error, names, curves, without })
    }

    /// Appends a line and a table for each curve.
    pub(super) fn append_text(&self, out: &mut String) {
        let error = format_significant(self.error, 7);
        let number = |value: f64| format_significant(value, 4);
        for [trace, circuit] in &self.without {
            let why = "it stands still, or passes a change point, near which no error is small";
            let _ = writeln!(out, "\ntolerance: none of the curve (trace {trace}, circuit {circuit}): {why}");
        }
        for own in &self.curves {
            let ToleratedCurve { curve, .. } = own;
            let [worst, rss] =
                [curve.moves.worst_case, curve.moves.root_sum_square].map(|unit| number(self.error * unit));
            // Writing to a string cannot fail.
            let _ = writeln!(
                out,
                "\ntolerance: every length off by {error} moves the curve (trace {}, circuit {}) by at most {worst}; root sum square {rss}",
                curve.trace, curve.circuit
            );
            let _ = writeln!(
                out,
                "{:<16}{:>14}{:>20}{:>22}",
                "length", "move per unit", "straight per unit", "may be off by"
            );
            for (k, name) in self.names.iter().enumerate() {
                let straight = curve.straight[k].map_or("–".to_owned(), number);
                let permitted = own.permitted(k).map_or("–".to_owned(), |by| format_significant(by, 2));
                let _ = writeln!(out, "{name:<16}{:>14}{straight:>20}{permitted:>22}", number(curve.moves.lengths[k]));
            }
        }
    }

    pub(super) fn json(&self) -> ToleranceJson<'_> {
        let curve = |own: &'_ ToleratedCurve| CurveJson {
            trace: own.curve.trace,
            circuit: own.curve.circuit,
            worst_case: self.error * own.curve.moves.worst_case,
            root_sum_square: self.error * own.curve.moves.root_sum_square,
            lengths: self
                .names
                .iter()
                .enumerate()
                .map(|(k, name)| LengthJson {
                    name,
                    sensitivity: own.curve.moves.lengths[k],
                    straight_sensitivity: own.curve.straight[k],
                    permitted: own.permitted(k),
                })
                .collect(),
        };
        ToleranceJson { error: self.error, curves: self.curves.iter().map(curve).collect() }
    }
}

impl ToleratedCurve {
    /// How far a length may be off until the length of the straight portion, as it is printed, changes by its last digit.
    fn permitted(&self, length: usize) -> Option<f64> {
        /// The digits with which it is printed.
        const DIGITS: i32 = 4;
        let exponent: i32 = format!("{:e}", self.straight?).split_once('e')?.1.parse().ok()?;
        let last_digit: f64 = format!("1e{}", exponent + 1 - DIGITS).parse().ok()?;
        let by = last_digit / self.curve.straight[length]?.abs();
        by.is_finite().then_some(by)
    }
}

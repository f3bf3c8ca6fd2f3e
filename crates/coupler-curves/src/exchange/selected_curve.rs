//! A curve to be exported.

use super::curve_name::CurveName;
use super::number::format_number;
use crate::family::{Family, ParameterText};
use crate::geometry::Point;
use crate::motion::Circuit;
use crate::solve::{MeasuredCurve, SolvedCell};

/// A curve to be exported.
#[derive(Clone, Debug)]
pub struct SelectedCurve<'a> {
    /// Its family.
    pub family: &'a Family,
    /// The source of the linkage, printed under the title of the plate.
    pub source: &'a str,
    /// Its solved cell, with this curve only.
    pub solved: SolvedCell,
    /// The parameters that replace those of its cell.
    overrides: &'a [(String, f64)],
}

impl<'a> SelectedCurve<'a> {
    /// The one curve of a solved cell; `source` is printed under the title of its plate.
    pub(crate) fn new(family: &'a Family, source: &'a str, solved: SolvedCell) -> SelectedCurve<'a> {
        SelectedCurve { family, source, solved, overrides: &[] }
    }

    /// Each curve of a solved cell by itself; `overrides` are the parameters that replace those of the cell with the
    /// same number.
    pub fn all_from_cell(
        family: &'a Family,
        source: &'a str,
        overrides: &'a [(String, f64)],
        solved: &SolvedCell,
    ) -> Vec<SelectedCurve<'a>> {
        solved
            .curves
            .iter()
            .map(|curve| SelectedCurve { family, source, solved: solved.with_curve(curve), overrides })
            .collect()
    }

    /// Its name: `evans:12.1.1`, or with overridden parameters `evans:12.1.1?p=2.5&k=2`.
    pub fn name(&self) -> String {
        let [cell, trace, circuit] = self.cell_trace_circuit();
        let family = self.family.id.clone();
        let overrides =
            self.overrides.iter().map(|(name, value)| ParameterText::from_number(name.clone(), *value)).collect();
        CurveName { family, cell: Some(cell), curve: Some([trace, circuit]), overrides }.to_string()
    }

    /// The name of its files, without an extension: `evans-12-1-1`, `evans-12-1-1-p-2.5`.
    pub fn file_stem(&self) -> String {
        let [cell, trace, circuit] = self.cell_trace_circuit();
        let override_suffix = |(name, value): &(String, f64)| format!("-{name}-{}", format_number(*value));
        let overrides: String = self.overrides.iter().map(override_suffix).collect();
        format!("{}-{cell}-{trace}-{circuit}{overrides}", self.family.id)
    }

    /// The numbers of its cell, trace and circuit, each from 1.
    pub(super) fn cell_trace_circuit(&self) -> [usize; 3] {
        let curve = self.curve();
        [self.solved.cell.number, curve.trace, curve.circuit]
    }

    /// The curve in its cell.
    pub fn curve(&self) -> &MeasuredCurve {
        &self.solved.curves[0]
    }

    /// The circuit of the curve.
    pub fn circuit(&self) -> &Circuit {
        self.solved.circuit(self.curve())
    }

    /// The positions of all joints in the pose drawn for CAD: at the sample a third of the way through the circuit,
    /// where a linkage that oscillates is not near a limit.
    pub(super) fn pose(&self) -> Vec<Point> {
        let circuit = self.circuit();
        let sample = circuit.len() / 3;
        self.solved.linkage.joint_ids().map(|joint| circuit.positions.point(joint, sample)).collect()
    }
}

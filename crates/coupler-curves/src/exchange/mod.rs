//! The name of a curve and its exchange formats: CSV, JSON, DXF and a fragment of a manifest.
//!
//! Each format is a submodule that turns a [`SelectedCurve`] into text; selecting curves and writing files happen
//! elsewhere.

mod circle;
mod curve_name;
mod dxf;
mod fragment;
mod json;
mod number;
mod points;
mod pretty_json;
mod table;

pub use curve_name::{CurveName, CurveNameError};
pub use fragment::{manifest_families, manifest_fragment};
pub use json::{Members, PassDocument};
pub use number::{append_integer, append_number, format_significant};
pub use table::PointTable;

use crate::family::{Family, ParameterText, Sampling};
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

    /// The curve's rows of `points.csv`, with the header.
    pub fn to_csv(&self) -> Vec<u8> {
        points::document(self)
    }

    /// A drawing in DXF. No chord of its polyline is further from the curve than `chord` times the curve's extent,
    /// the longer side of the bounds of its samples.
    pub fn to_dxf(&self, chord: f64) -> String {
        dxf::document(self, chord)
    }

    /// The linkage, parameters, circuits, points and measures as JSON.
    pub fn to_json(&self) -> String {
        json::document(self)
    }

    /// A manifest fragment: a family with this curve's cell.
    pub fn to_toml(&self) -> String {
        manifest_fragment(&[ParameterSet::from_curve(self)])
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
    fn cell_trace_circuit(&self) -> [usize; 3] {
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
    fn pose(&self) -> Vec<Point> {
        let circuit = self.circuit();
        let sample = circuit.len() / 3;
        self.solved.linkage.joint_ids().map(|joint| circuit.positions.point(joint, sample)).collect()
    }
}

/// A parameter set to be exported.
#[derive(Clone, Debug)]
pub struct ParameterSet<'a> {
    /// Its family.
    pub family: &'a Family,
    /// The values of its template's parameters.
    pub values: Vec<f64>,
    /// The name of the curve it belongs to.
    pub curve_name: String,
}

impl<'a> ParameterSet<'a> {
    /// The parameter set of a curve.
    pub fn from_curve(selected: &SelectedCurve<'a>) -> ParameterSet<'a> {
        let values = selected.family.parameter_values(&selected.solved.cell).to_vec();
        ParameterSet { family: selected.family, values, curve_name: selected.name() }
    }
}

/// A number in the fewest digits that read back to the same value.
fn format_number(value: f64) -> String {
    let mut out = Vec::new();
    append_number(value, &mut out);
    String::from_utf8(out).unwrap_or_default()
}

/// The fields of a `sampling` table: the key, its number, and the spacing if it is not even.
fn sampling_fields(sampling: Sampling) -> (&'static str, f64, Option<&'static str>) {
    match sampling {
        Sampling::Step(step) => ("step", step, None),
        Sampling::Samples(samples) => ("samples", samples as f64, None),
        Sampling::DenseAtLimits(samples) => ("samples", samples as f64, Some("smooth")),
        Sampling::ArcLength(samples) => ("samples", samples as f64, Some("arc")),
    }
}

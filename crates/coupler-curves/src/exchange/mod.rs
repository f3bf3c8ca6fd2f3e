//! The exchange formats of a curve: CSV, JSON, DXF and a fragment of a manifest.
//!
//! Each format is a file here and makes text of a [`SelectedCurve`] curve; none of them decides which curves are exported or where the
//! text goes.

mod circle;
mod dxf;
mod fragment;
mod json;
mod number;
mod points;
mod pretty_json;
mod table;

pub use fragment::manifest_fragment;
pub use number::{append_integer, append_number};
pub use table::PointTable;

use crate::family::{Family, Sampling};
use crate::geometry::Point;
use crate::motion::Circuit;
use crate::solve::{MeasuredCurve, SolvedCell};

/// One curve that is taken away.
#[derive(Clone, Debug)]
pub struct SelectedCurve<'a> {
    /// Its family.
    pub family: &'a Family,
    /// What stands under the title of its plate.
    pub source: &'a str,
    /// Its cell, solved, with this one curve left of it.
    pub solved: SolvedCell,
    /// The parameters it has in place of its cell's.
    overrides: &'a [(String, f64)],
}

impl<'a> SelectedCurve<'a> {
    /// The one curve of a solved cell; `source` is printed under the title of its plate.
    pub(crate) fn new(family: &'a Family, source: &'a str, solved: SolvedCell) -> SelectedCurve<'a> {
        SelectedCurve { family, source, solved, overrides: &[] }
    }

    /// Each curve of a solved cell by itself; `changed` are the parameters it has in place of those of the cell of its
    /// number.
    pub fn all_from_cell(
        family: &'a Family,
        source: &'a str,
        changed: &'a [(String, f64)],
        solved: &SolvedCell,
    ) -> Vec<SelectedCurve<'a>> {
        let alone = |curve: &MeasuredCurve| SolvedCell { curves: vec![curve.clone()], ..solved.clone() };
        solved
            .curves
            .iter()
            .map(|curve| SelectedCurve { family, source, solved: alone(curve), overrides: changed })
            .collect()
    }

    /// The curve's rows of `points.csv`, under its header.
    pub fn to_csv(&self) -> Vec<u8> {
        points::document(self)
    }

    /// A drawing in DXF; no chord of its polyline is further from the curve than `chord` times the curve's extent, the longer
    /// side of the box around its samples.
    pub fn to_dxf(&self, chord: f64) -> String {
        dxf::document(self, chord)
    }

    /// Linkage, parameters, circuits, points and measures as JSON.
    pub fn to_json(&self) -> String {
        json::document(self)
    }

    /// A family of a manifest that has this one curve's cell.
    pub fn to_toml(&self) -> String {
        manifest_fragment(&[ParameterSet::from_curve(self)])
    }

    /// What it is called: `evans:12.1.1`, with the parameters that are not its cell's, `evans:12.1.1?p=2.5&k=2`.
    pub fn name(&self) -> String {
        let [cell, trace, circuit] = self.cell_trace_circuit();
        let changed = self.format_overrides(|name, value| format!("{name}={value}"));
        let query = if changed.is_empty() { String::new() } else { format!("?{}", changed.join("&")) };
        format!("{}:{cell}.{trace}.{circuit}{query}", self.family.id)
    }

    /// The name of its files, without an extension: `evans-12-1-1`, `evans-12-1-1-p-2.5`.
    pub fn file_stem(&self) -> String {
        let [cell, trace, circuit] = self.cell_trace_circuit();
        let changed = self.format_overrides(|name, value| format!("-{name}-{value}")).concat();
        format!("{}-{cell}-{trace}-{circuit}{changed}", self.family.id)
    }

    /// The numbers of its cell, its trace and its circuit.
    fn cell_trace_circuit(&self) -> [usize; 3] {
        let curve = self.curve();
        [self.solved.cell.number, curve.trace, curve.circuit]
    }

    fn format_overrides(&self, written: impl Fn(&str, String) -> String) -> Vec<String> {
        self.overrides.iter().map(|(name, value)| written(name, format_number(*value))).collect()
    }

    /// The curve in its cell.
    pub fn curve(&self) -> &MeasuredCurve {
        &self.solved.curves[0]
    }

    /// The circuit it is traced on.
    pub fn circuit(&self) -> &Circuit {
        self.solved.circuit(self.curve())
    }

    /// The places of all joints in the pose it is shown in for CAD: at the sample a third of the way through its circuit,
    /// where no dyad of a linkage that goes there and back is near its limit.
    fn pose(&self) -> Vec<Point> {
        let circuit = self.circuit();
        let sample = circuit.len() / 3;
        self.solved.linkage.joint_ids().map(|joint| circuit.positions.point(joint, sample)).collect()
    }
}

/// A parameter set that is taken away.
#[derive(Clone, Debug)]
pub struct ParameterSet<'a> {
    /// Its family.
    pub family: &'a Family,
    /// The values of its template's parameters.
    pub values: Vec<f64>,
    /// The name of the curve it is taken for.
    pub curve_name: String,
}

impl<'a> ParameterSet<'a> {
    /// That of a curve.
    pub fn from_curve(chosen: &SelectedCurve<'a>) -> ParameterSet<'a> {
        let values = chosen.family.parameter_values(&chosen.solved.cell).to_vec();
        ParameterSet { family: chosen.family, values, curve_name: chosen.name() }
    }
}

/// A number in the fewest digits that read back to it.
fn format_number(value: f64) -> String {
    let mut out = Vec::new();
    append_number(value, &mut out);
    String::from_utf8(out).unwrap_or_default()
}

/// How circuits are sampled: the key, its number, and the spacing where it is not even.
fn sampling_fields(sampling: Sampling) -> (&'static str, f64, Option<&'static str>) {
    match sampling {
        Sampling::Step(step) => ("step", step, None),
        Sampling::Samples(samples) => ("samples", samples as f64, None),
        Sampling::DenseAtLimits(samples) => ("samples", samples as f64, Some("smooth")),
        Sampling::ArcLength(samples) => ("samples", samples as f64, Some("arc")),
    }
}

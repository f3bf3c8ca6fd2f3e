//! A curve as JSON, with all data; `docs/export.md` describes the format.

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

use super::pretty_json::to_pretty_string;
use super::sampling_fields::sampling_fields;
use super::{PointTable, SelectedCurve};
use crate::family::LengthUnit;
use crate::linkage::{DyadId, Linkage};
use crate::measure::{self, Value, compute_columns};
use crate::motion::{Circuit, Pass, PassEnd};

/// The version of the format.
const FORMAT_VERSION: usize = 1;

/// The whole document; the fields are its members, in order.
#[derive(Serialize)]
struct Document<'a> {
    format: usize,
    curve: String,
    family: &'a str,
    linkage: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    unit: Option<&'static str>,
    cell: usize,
    trace: usize,
    circuit: usize,
    joint: &'a str,
    parameters: Members<'a, f64>,
    helpers: Members<'a, f64>,
    sampling: Members<'a, SamplingField>,
    status: &'static str,
    reason: Option<String>,
    circuits: Vec<CircuitDocument<'a>>,
    columns: Vec<String>,
    points: Vec<Vec<f64>>,
    measures: Members<'a, Option<MeasureValue>>,
}

/// An object whose members are known at run time only, in order.
pub struct Members<'a, V>(pub Vec<(&'a str, V)>);

impl<V: Serialize> Serialize for Members<'_, V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        self.0.iter().try_for_each(|(name, value)| map.serialize_entry(name, value))?;
        map.end()
    }
}

#[derive(Serialize)]
#[serde(untagged)]
enum SamplingField {
    Number(f64),
    Spacing(&'static str),
}

#[derive(Serialize)]
#[serde(untagged)]
enum MeasureValue {
    Number(f64),
    Word(&'static str),
}

#[derive(Serialize)]
struct CircuitDocument<'a> {
    closed: bool,
    passes: Vec<PassDocument<'a>>,
}

/// A pass of a circuit.
#[derive(Serialize)]
pub struct PassDocument<'a> {
    from: EndDocument<'a>,
    to: EndDocument<'a>,
    /// The sides of all dyads: 1 is left, -1 right.
    branches: Vec<i8>,
    /// Whether the input reverses at its end.
    turns: bool,
}

#[derive(Serialize)]
struct EndDocument<'a> {
    input: f64,
    /// The joints of the dyads that are flat there.
    flat: Vec<&'a str>,
}

/// The JSON document of a curve.
pub(super) fn document(selected: &SelectedCurve) -> String {
    let SelectedCurve { family, solved, .. } = selected;
    let linkage = &solved.linkage;
    let curve = selected.curve();
    let [cell, trace, circuit] = selected.cell_trace_circuit();
    let mut parameters: Vec<(&str, f64)> =
        family.names.iter().map(String::as_str).zip(solved.cell.values.iter().copied()).collect();
    let helpers = parameters.split_off(family.template.parameters.len());
    let value = |value: &Value| match *value {
        Value::Number(value) => Some(MeasureValue::Number(value)),
        Value::Word(word) => Some(MeasureValue::Word(word)),
        Value::Missing => None,
    };
    let is_driven_by_length = family.template.is_driven_by_length();
    let document = Document {
        format: FORMAT_VERSION,
        curve: selected.name(),
        family: &family.id,
        linkage: &family.template.id,
        unit: family.unit.map(LengthUnit::symbol),
        cell,
        trace,
        circuit,
        joint: &linkage.joints[curve.joint].name,
        parameters: Members(parameters),
        helpers: Members(helpers),
        sampling: sampling(selected),
        status: solved.status().name(),
        reason: solved.motion.assembly_error.as_ref().map(ToString::to_string),
        circuits: solved.motion.circuits.iter().map(|circuit| circuit_document(linkage, circuit)).collect(),
        // The first three columns, the numbers of the curve, are members of the document.
        columns: PointTable::new(family).header().trim_end().split(',').skip(3).map(str::to_owned).collect(),
        points: rows(selected),
        measures: Members(
            measure::ALL.iter().zip(&curve.values).map(|(m, v)| (m.name_for(is_driven_by_length), value(v))).collect(),
        ),
    };
    to_pretty_string(&document).expect("every member can be represented in JSON")
}

fn sampling(selected: &SelectedCurve) -> Members<'static, SamplingField> {
    let (key, number, spacing) = sampling_fields(selected.family.sampling);
    let spacing = spacing.map(|spacing| ("spacing", SamplingField::Spacing(spacing)));
    Members([(key, SamplingField::Number(number))].into_iter().chain(spacing).collect())
}

impl<'a> PassDocument<'a> {
    /// The passes of a circuit, in order.
    pub fn of_circuit(linkage: &'a Linkage, circuit: &Circuit) -> Vec<PassDocument<'a>> {
        let end = |end: PassEnd| EndDocument { input: end.input.value, flat: end.flat_joints(linkage) };
        let pass = |(k, pass): (usize, &Pass)| PassDocument {
            from: end(pass.from),
            to: end(pass.to),
            branches: linkage.dyad_ids().map(|dyad| pass.mode.sign(dyad)).collect(),
            turns: circuit.reverses_after(k),
        };
        circuit.passes.iter().enumerate().map(pass).collect()
    }
}

fn circuit_document<'a>(linkage: &'a Linkage, circuit: &Circuit) -> CircuitDocument<'a> {
    CircuitDocument { closed: circuit.is_closed, passes: PassDocument::of_circuit(linkage, circuit) }
}

/// The rows of `points.csv`, one for each sample, without the three columns that identify the curve.
fn rows(selected: &SelectedCurve) -> Vec<Vec<f64>> {
    let (circuit, joint) = (selected.circuit(), selected.curve().joint);
    let linkage = &selected.solved.linkage;
    let row = |sample: usize| {
        let mode = circuit.mode_at(sample);
        let branches = (0..linkage.dyad_count().max(1)).map(DyadId::new).map(|dyad| f64::from(mode.sign(dyad)));
        let point = circuit.positions.point(joint, sample);
        let further = compute_columns(&selected.family.columns, linkage, circuit, joint, sample);
        branches.chain([sample as f64, circuit.inputs[sample], point.x, point.y]).chain(further).collect()
    };
    (0..circuit.len()).map(row).collect()
}

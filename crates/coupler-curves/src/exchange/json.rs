//! Everything that is known of a curve, for programs; docs/export.md describes it.

use super::PointTable;
use super::pretty_json::Json;
use super::{SelectedCurve, sampling_fields};
use crate::linkage::Linkage;
use crate::measure::{self, Value, compute_columns};
use crate::motion::{Circuit, Pass, PassEnd};

/// The version of the format.
const FORMAT_VERSION: usize = 1;

pub(super) fn document(chosen: &SelectedCurve) -> String {
    let SelectedCurve { family, solved, .. } = chosen;
    let linkage = &solved.linkage;
    let curve = chosen.curve();
    let named = |names: &[String], values: &[f64]| {
        Json::Object(names.iter().cloned().zip(values.iter().map(|value| Json::Number(*value))).collect())
    };
    let parameters = family.template.parameters.len();
    let (names, values) = (&family.names, &solved.cell.values);
    let (columns, points) = columns_and_points(chosen);
    let [cell, trace, circuit] = chosen.cell_trace_circuit().map(Json::integer);
    Json::object([
        ("format", Json::integer(FORMAT_VERSION)),
        ("curve", Json::text(chosen.name())),
        ("family", Json::text(&family.id)),
        ("linkage", Json::text(&family.template.id)),
        ("cell", cell),
        ("trace", trace),
        ("circuit", circuit),
        ("joint", Json::text(&linkage.joints[curve.joint].name)),
        ("parameters", named(&names[..parameters], &values[..parameters])),
        ("helpers", named(&names[parameters..], &values[parameters..])),
        ("sampling", sampling(chosen)),
        ("status", Json::text(solved.status().name())),
        ("reason", solved.motion.incomplete_reason.as_ref().map_or(Json::Null, Json::text)),
        (
            "circuits",
            Json::List(solved.motion.circuits.iter().map(|circuit| circuit_to_json(linkage, circuit)).collect()),
        ),
        ("columns", columns),
        ("points", points),
        ("measures", measures(&curve.values)),
    ])
    .to_pretty_string()
}

fn sampling(chosen: &SelectedCurve) -> Json {
    let (key, number, spacing) = sampling_fields(chosen.family.sampling);
    let spacing = spacing.map(|spacing| ("spacing".to_owned(), Json::text(spacing)));
    Json::Object([(key.to_owned(), Json::Number(number))].into_iter().chain(spacing).collect())
}

/// Of every pass its ends, with the joints whose dyads lie flat there, and the sides of all two-valued joints.
fn circuit_to_json(linkage: &Linkage, circuit: &Circuit) -> Json {
    let end = |end: PassEnd| {
        let flat = linkage
            .joints
            .iter()
            .filter(|joint| joint.kind.dyad_index().is_some_and(|index| end.flat_dyads.contains(index)));
        let flat = flat.map(|joint| Json::text(&joint.name)).collect();
        Json::object([("input", Json::Number(end.input.value)), ("flat", Json::List(flat))])
    };
    let pass = |(k, pass): (usize, &Pass)| {
        let branches = (0..linkage.dyad_count()).map(|dyad| Json::Number(f64::from(pass.mode.sign(dyad))));
        Json::object([
            ("from", end(pass.from)),
            ("to", end(pass.to)),
            ("branches", Json::List(branches.collect())),
            ("turns", Json::Bool(circuit.reverses_after(k))),
        ])
    };
    let passes = circuit.passes.iter().enumerate().map(pass).collect();
    Json::object([("closed", Json::Bool(circuit.is_closed)), ("passes", Json::List(passes))])
}

/// The columns of `points.csv` behind the numbers of the curve, and a row for each sample.
fn columns_and_points(chosen: &SelectedCurve) -> (Json, Json) {
    let (circuit, joint) = (chosen.circuit(), chosen.curve().joint);
    let linkage = &chosen.solved.linkage;
    let header = PointTable::new(chosen.family).header();
    let columns = header.trim_end().split(',').skip(3).map(Json::text).collect();
    let row = |sample: usize| {
        let signs = circuit.mode_at(sample);
        let branches = (0..linkage.dyad_count().max(1)).map(|dyad| f64::from(signs.sign(dyad)));
        let at = circuit.positions.point(joint, sample);
        let further = compute_columns(&chosen.family.columns, linkage, (circuit, joint), sample);
        let values = branches.chain([sample as f64, circuit.inputs[sample], at.x, at.y]).chain(further);
        Json::List(values.map(Json::Number).collect())
    };
    (Json::List(columns), Json::List((0..circuit.len()).map(row).collect()))
}

fn measures(values: &[Value]) -> Json {
    let value = |value: &Value| match value {
        Value::Number(value) => Json::Number(*value),
        Value::Word(word) => Json::text(*word),
        Value::Missing => Json::Null,
    };
    Json::Object(measure::ALL.iter().zip(values).map(|(m, v)| (m.name.to_owned(), value(v))).collect())
}

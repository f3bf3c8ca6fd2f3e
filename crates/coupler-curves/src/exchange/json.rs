//! Everything that is known of a curve, for programs; docs/export.md describes it.

use super::Points;
use super::layout::Json;
use super::{Chosen, sampled};
use crate::linkage::Linkage;
use crate::measure::{self, Value, take_columns};
use crate::motion::{Circuit, End, Pass};

/// The version of the format.
const FORMAT: usize = 1;

pub(super) fn document(chosen: &Chosen) -> String {
    let Chosen { family, solved, .. } = chosen;
    let linkage = &solved.linkage;
    let curve = chosen.curve();
    let named = |names: &[String], values: &[f64]| {
        Json::Object(names.iter().cloned().zip(values.iter().map(|value| Json::Number(*value))).collect())
    };
    let parameters = family.template.parameters.len();
    let (names, values) = (&family.names, &solved.cell.values);
    let (columns, points) = points(chosen);
    let [cell, trace, circuit] = chosen.numbers().map(Json::whole);
    Json::object([
        ("format", Json::whole(FORMAT)),
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
        ("reason", solved.motion.shortfall.as_ref().map_or(Json::Null, Json::text)),
        ("circuits", Json::List(solved.motion.circuits.iter().map(|circuit| of_circuit(linkage, circuit)).collect())),
        ("columns", columns),
        ("points", points),
        ("measures", measures(&curve.measures)),
    ])
    .document()
}

fn sampling(chosen: &Chosen) -> Json {
    let (key, number, spacing) = sampled(chosen.family.sampling);
    let spacing = spacing.map(|spacing| ("spacing".to_owned(), Json::text(spacing)));
    Json::Object([(key.to_owned(), Json::Number(number))].into_iter().chain(spacing).collect())
}

/// Of every pass its ends, with the joints whose dyads lie flat there, and the sides of all two-valued joints.
fn of_circuit(linkage: &Linkage, circuit: &Circuit) -> Json {
    let end = |end: End| {
        let flat = linkage.joints.iter().filter(|joint| joint.step.index().is_some_and(|index| end.flat.has(index)));
        let flat = flat.map(|joint| Json::text(&joint.name)).collect();
        Json::object([("input", Json::Number(end.stop.at)), ("flat", Json::List(flat))])
    };
    let pass = |(k, pass): (usize, &Pass)| {
        let branches = (0..linkage.dyads()).map(|dyad| Json::Number(f64::from(pass.signs.get(dyad))));
        Json::object([
            ("from", end(pass.from)),
            ("to", end(pass.to)),
            ("branches", Json::List(branches.collect())),
            ("turns", Json::Truth(circuit.turns_after(k))),
        ])
    };
    let passes = circuit.passes.iter().enumerate().map(pass).collect();
    Json::object([("closed", Json::Truth(circuit.closed)), ("passes", Json::List(passes))])
}

/// The columns of `points.csv` behind the numbers of the curve, and a row for each sample.
fn points(chosen: &Chosen) -> (Json, Json) {
    let (circuit, joint) = (chosen.circuit(), chosen.curve().joint);
    let linkage = &chosen.solved.linkage;
    let header = Points::new(chosen.family).header();
    let columns = header.trim_end().split(',').skip(3).map(Json::text).collect();
    let row = |sample: usize| {
        let signs = circuit.signs(sample);
        let branches = (0..linkage.dyads().max(1)).map(|dyad| f64::from(signs.get(dyad)));
        let at = circuit.places.point(joint, sample);
        let further = take_columns(&chosen.family.columns, linkage, (circuit, joint), sample);
        let values = branches.chain([sample as f64, circuit.input[sample], at.x, at.y]).chain(further);
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

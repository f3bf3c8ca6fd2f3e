//! The page's own solver, compared with the program's; skipped if node is not installed.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use coupler_atlas::gallery;
use coupler_atlas::manifest;
use coupler_curves::catalogue;
use coupler_curves::family::Family;
use coupler_curves::linkage::{CircuitSelection, Continuation, JointId, Linkage};
use coupler_curves::measure::{self, COLUMNS, TracedCurve, Value as Measured, compute_columns};
use coupler_curves::motion::{Circuit, Motion, Sampler};
use serde_json::{Value, json};
use tempfile::TempDir;

/// A number in JSON: infinities as strings, NaN as null.
fn number(value: f64) -> Value {
    if value.is_infinite() { json!(value.to_string()) } else { json!(value) }
}

fn circuit(linkage: &Linkage, circuit: &Circuit) -> Value {
    let rows = |row: &dyn Fn(JointId) -> Vec<Value>| linkage.joint_ids().map(row).collect::<Vec<_>>();
    let column = |values: &[f64]| values.iter().map(|value| json!(value)).collect::<Vec<_>>();
    let sides = |mode: coupler_curves::linkage::AssemblyMode| {
        linkage.dyad_ids().map(|dyad| mode.sign(dyad)).collect::<Vec<_>>()
    };
    let pass = |pass: &coupler_curves::motion::Pass| {
        let [from, to] = [&pass.from, &pass.to].map(|end| end.input.value);
        json!({ "from": from, "to": to, "signs": sides(pass.mode) })
    };
    json!({
        "closed": circuit.is_closed,
        "input": circuit.inputs,
        "branch": (0..circuit.len()).map(|sample| sides(circuit.mode_at(sample))).collect::<Vec<_>>(),
        "x": rows(&|joint| column(circuit.positions.x(joint))),
        "y": rows(&|joint| column(circuit.positions.y(joint))),
        "passes": circuit.passes.iter().map(pass).collect::<Vec<_>>(),
    })
}

fn measures(family: &Family, linkage: &Linkage, motion: &Motion) -> Vec<Value> {
    let mut measures = Vec::new();
    for (trace, &joint) in (1..).zip(&linkage.traced) {
        for (circuit_number, circuit) in (1..).zip(&motion.circuits) {
            let curve = TracedCurve::new(linkage, motion, circuit, joint).with_straight_criterion(family.straight);
            let value = |value: Measured| match value {
                Measured::Number(value) => number(value),
                Measured::Word(word) => json!(word),
                Measured::Missing => Value::Null,
            };
            let values: serde_json::Map<String, Value> = measure::ALL
                .iter()
                .zip(measure::compute_all(&curve))
                .map(|(measure, computed)| (measure.name.to_owned(), value(computed)))
                .collect();
            measures.push(json!({ "trace": trace, "circuit": circuit_number, "values": values }));
        }
    }
    measures
}

/// Every additional column of the first traced joint, sample by sample.
fn rates(linkage: &Linkage, motion: &Motion) -> Vec<Value> {
    let circuit_columns = |(circuit_number, circuit): (usize, &Circuit)| {
        let rows: Vec<Vec<f64>> = (0..circuit.len())
            .map(|sample| compute_columns(&COLUMNS, linkage, (circuit, linkage.traced[0]), sample))
            .collect();
        let values: serde_json::Map<String, Value> = COLUMNS
            .iter()
            .enumerate()
            .map(|(k, column)| (column.name.to_owned(), rows.iter().map(|row| number(row[k])).collect()))
            .collect();
        json!({ "trace": 1, "circuit": circuit_number, "values": values })
    };
    (1..).zip(&motion.circuits).map(circuit_columns).collect()
}

/// A cell of a family as input of the page's solver, with the program's results.
fn case(family: &Family, cell: usize, name: &str) -> Value {
    let cell = family.cell(cell);
    let linkage = family.linkage(&cell).unwrap();
    let motion = Motion::solve(&linkage, &Sampler::new(family.sampling));
    json!({
        "name": format!("{name}, cell {}", cell.number),
        "template": gallery::template_json(&family.template),
        "values": cell.values,
        "sampling": gallery::sampling_json(family.sampling),
        "straight": gallery::straight_json(family.straight),
        "motion": {
            "shortfall": motion.assembly_error.as_ref().map(ToString::to_string),
            "circuits": motion.circuits.iter().map(|c| circuit(&linkage, c)).collect::<Vec<_>>(),
        },
        "measures": measures(family, &linkage, &motion),
        "rates": rates(&linkage, &motion),
    })
}

/// The family with other circuits selected and continued in another way.
fn with_circuits(family: &Family, circuits: CircuitSelection, continuation: Continuation) -> Family {
    let template = coupler_curves::template::Template { circuits, continuation, ..(*family.template).clone() };
    Family { template: template.into(), ..family.clone() }
}

/// The indices of at most this many cells, evenly spread, the first and the last among them.
fn spread_cells(count: usize, total: usize) -> impl Iterator<Item = usize> {
    let count = count.min(total);
    (0..count).map(move |k| if count < 2 { 0 } else { k * (total - 1) / (count - 1) })
}

fn cases() -> Vec<Value> {
    let atlas = manifest::parse(include_str!("../../../atlas.toml")).plan.unwrap();
    let mut cases = Vec::new();
    let mut linkages = BTreeSet::new();
    for planned in &atlas.families {
        let family = &planned.family;
        linkages.insert(family.template.id.clone());
        for cell in spread_cells(6, family.cell_count()) {
            cases.push(case(family, cell, &family.id));
        }
        for (circuits, continuation) in
            [(CircuitSelection::All, Continuation::Smooth), (CircuitSelection::All, Continuation::Branch)]
        {
            let other = with_circuits(family, circuits, continuation);
            let name = format!("{}, all circuits, {continuation:?}", family.id);
            cases.extend(spread_cells(2, family.cell_count()).map(|cell| case(&other, cell, &name)));
        }
    }
    for template in catalogue::all() {
        assert!(linkages.contains(&template.id), "atlas.toml has no {}", template.id);
    }
    cases
}

/// Runs a script of `tests/gallery` under node; its standard output, or `None` if node is not installed.
fn node(script: &str, arguments: &[&Path]) -> Option<String> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/gallery").join(script);
    let Ok(output) = Command::new("node").arg(&script).args(arguments).output() else {
        eprintln!("skipped: node is not installed, and {} cannot run", script.display());
        return None;
    };
    let stdout = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{stdout}{}", String::from_utf8_lossy(&output.stderr));
    Some(stdout)
}

#[test]
fn the_page_solves_every_catalogue_linkage_as_the_program_does() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("cases.json");
    let cases = cases();
    fs::write(&path, serde_json::to_vec(&cases).unwrap()).unwrap();
    let Some(stdout) = node("solver.mjs", &[&path]) else { return };
    // The script compares all cases.
    assert!(stdout.contains(&format!("{} cases", cases.len())), "{stdout}");
}

#[test]
fn the_pages_solver_and_measures_agree_with_closed_forms() {
    node("kinematics.mjs", &[]);
    node("measures.mjs", &[]);
}

#[test]
fn the_page_finds_the_files_with_its_data() {
    node("data.mjs", &[]);
}

/// Tests plates, filters and exports with the families of the committed atlas.
#[test]
fn the_page_computes_with_the_committed_atlas() {
    let atlas = Path::new(env!("CARGO_MANIFEST_DIR")).join("output");
    for script in ["plate-parts.mjs", "find.mjs", "export.mjs"] {
        node(script, &[&atlas]);
    }
}

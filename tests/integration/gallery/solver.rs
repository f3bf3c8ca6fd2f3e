//! The page's own solver, held against the program's: node runs it, where there is node.

use std::collections::BTreeSet;
use std::fs;
use std::process::Command;

use coupler_atlas::catalogue;
use coupler_atlas::family::{Family, Sampling};
use coupler_atlas::gallery;
use coupler_atlas::linkage::{Circuits, Continuation, Linkage};
use coupler_atlas::manifest;
use coupler_atlas::measure::{self, Subject, Value as Measured};
use coupler_atlas::motion::{Circuit, Motion, Sampler};
use serde_json::{Value, json};
use tempfile::TempDir;

fn sampling(sampling: Sampling) -> Value {
    match sampling {
        Sampling::Step(step) => json!({ "step": step }),
        Sampling::Samples(samples) => json!({ "samples": samples }),
        Sampling::Smooth(samples) => json!({ "samples": samples, "spacing": "smooth" }),
        Sampling::Arc(samples) => json!({ "samples": samples, "spacing": "arc" }),
    }
}

/// A number, or nothing where it is not one: JSON has no other way.
fn number(value: f64) -> Value {
    if value.is_infinite() { json!("inf") } else { json!(value) }
}

fn circuit(linkage: &Linkage, circuit: &Circuit) -> Value {
    let rows = |of: &dyn Fn(usize) -> Vec<Value>| (0..linkage.joints.len()).map(of).collect::<Vec<_>>();
    let column = |values: &[f64]| values.iter().map(|value| json!(value)).collect::<Vec<_>>();
    let sides =
        |signs: coupler_atlas::linkage::Signs| (0..linkage.dyads()).map(|dyad| signs.get(dyad)).collect::<Vec<_>>();
    let pass = |pass: &coupler_atlas::motion::Pass| json!({ "from": pass.from.stop.at, "to": pass.to.stop.at, "signs": sides(pass.signs) });
    json!({
        "closed": circuit.closed,
        "input": circuit.input,
        "branch": (0..circuit.len()).map(|sample| sides(circuit.signs(sample))).collect::<Vec<_>>(),
        "x": rows(&|joint| column(circuit.places.x(joint))),
        "y": rows(&|joint| column(circuit.places.y(joint))),
        "passes": circuit.passes.iter().map(pass).collect::<Vec<_>>(),
    })
}

fn measures(family: &Family, linkage: &Linkage, motion: &Motion) -> Vec<Value> {
    let mut told = Vec::new();
    for (trace, &joint) in (1..).zip(&linkage.traced) {
        for (number_of_circuit, circuit) in (1..).zip(&motion.circuits) {
            let subject = Subject::new(linkage, motion, circuit, joint).asking(family.straight);
            let value = |value: Measured| match value {
                Measured::Number(value) => number(value),
                Measured::Word(word) => json!(word),
                Measured::Missing => Value::Null,
            };
            let values: serde_json::Map<String, Value> = measure::ALL
                .iter()
                .zip(measure::take(&subject))
                .map(|(measure, taken)| (measure.name.to_owned(), value(taken)))
                .collect();
            told.push(json!({ "trace": trace, "circuit": number_of_circuit, "values": values }));
        }
    }
    told
}

/// A cell of a family as the page's solver is given it, and what the program makes of it.
fn case(family: &Family, cell: usize, name: &str) -> Value {
    let cell = family.cell(cell);
    let linkage = family.linkage(&cell).unwrap();
    let motion = Motion::of(&linkage, &Sampler::new(family.sampling));
    json!({
        "name": format!("{name}, cell {}", cell.number),
        "template": gallery::template(&family.template),
        "values": cell.values,
        "sampling": sampling(family.sampling),
        "straight": match family.straight {
            measure::Straight::Tolerance(tolerance) => json!({ "tolerance": tolerance }),
            measure::Straight::Input(input) => json!({ "input": input }),
            measure::Straight::Length(length) => json!({ "length": length }),
        },
        "motion": {
            "shortfall": motion.shortfall,
            "circuits": motion.circuits.iter().map(|c| circuit(&linkage, c)).collect::<Vec<_>>(),
        },
        "measures": measures(family, &linkage, &motion),
    })
}

/// A family with other ways to travel.
fn travelling(family: &Family, circuits: Circuits, continuation: Continuation) -> Family {
    let template = coupler_atlas::template::Template { circuits, continuation, ..(*family.template).clone() };
    Family { template: template.into(), ..family.clone() }
}

/// So many cells, the first and the last among them.
fn some(count: usize, of: usize) -> impl Iterator<Item = usize> {
    let shown = count.min(of);
    (0..shown).map(move |k| if shown < 2 { 0 } else { k * (of - 1) / (shown - 1) })
}

fn cases() -> Vec<Value> {
    let atlas = manifest::load(include_str!("../../../atlas.toml")).plan.unwrap();
    let mut cases = Vec::new();
    let mut linkages = BTreeSet::new();
    for planned in &atlas.families {
        let family = &planned.family;
        linkages.insert(family.template.id.clone());
        for cell in some(6, family.cells()) {
            cases.push(case(family, cell, &family.id));
        }
        for (circuits, continuation) in [(Circuits::All, Continuation::Smooth), (Circuits::All, Continuation::Branch)] {
            let other = travelling(family, circuits, continuation);
            let name = format!("{}, all circuits, {continuation:?}", family.id);
            cases.extend(some(2, family.cells()).map(|cell| case(&other, cell, &name)));
        }
    }
    for template in catalogue::all() {
        assert!(linkages.contains(&template.id), "atlas.toml has no {}", template.id);
    }
    cases
}

#[test]
fn the_page_solves_every_catalogue_linkage_as_the_program_does() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("cases.json");
    let script = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/gallery/solver.mjs");
    fs::write(&path, serde_json::to_vec(&cases()).unwrap()).unwrap();
    let Ok(run) = Command::new("node").arg(script).arg(&path).output() else {
        eprintln!("skipped: node is not installed, and the page's solver is not compared");
        return;
    };
    let told = String::from_utf8_lossy(&run.stdout);
    assert!(run.status.success(), "{told}{}", String::from_utf8_lossy(&run.stderr));
    eprintln!("{told}");
}

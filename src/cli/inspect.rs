use std::fmt::Write;
use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use coupler_atlas::expression::{Caption, Expression};
use coupler_atlas::family::{Family, Sampling};
use coupler_atlas::linkage::{Flat, FourBar, Input};
use coupler_atlas::measure;
use coupler_atlas::motion::{Circuit, Jets, Pass, Sampler, Stop};
use coupler_atlas::page::{self, Layout, Options, Panel, Paper, Sheet};
use coupler_atlas::problem::nearest_or_all;
use coupler_atlas::render::{self, TextMode};
use coupler_atlas::sweep::{self, Solved};
use coupler_atlas::template::Template;
use coupler_atlas::{build, catalogue, manifest};
use serde_json::{Value, json};

use super::{Outcome, WrongInput, print};

/// The version of the format of `--json`.
const FORMAT: u32 = 1;

/// Look at one linkage: its class, its circuits and their limits, and where its joints are and how fast they move.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The linkage: one of the catalogue, or of the manifest given.
    linkage: String,
    /// Its parameters, as numbers or expressions: p=2 "a=(1+2)^1.5/2".
    #[arg(value_name = "NAME=VALUE")]
    parameters: Vec<String>,
    /// A manifest whose own linkages can be named.
    #[arg(long, value_name = "FILE")]
    manifest: Option<PathBuf>,
    /// Say where the joints are at this input, in degrees or as a length.
    #[arg(long, value_name = "INPUT", allow_negative_numbers = true)]
    at: Option<f64>,
    /// Of the poses at that input, only those with the first two-valued joint on this side: 1 left, -1 right.
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(i8).range(-1..=1))]
    branch: Option<i8>,
    /// As JSON.
    #[arg(long)]
    json: bool,
    /// Draw it, on one plate.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    let template = template(arguments)?;
    let given = arguments.parameters.iter().map(|text| parameter(text)).collect::<Result<Vec<_>, _>>()?;
    let family = Family::single(template, &given, Sampling::Samples(360))
        .map_err(|wrong| WrongInput(format!("{}: {}", arguments.linkage, wrong.join("; "))))?;
    let Some(solved) = sweep::solve(&family, &Sampler::new(family.sampling), 0) else {
        return Err(WrongInput(format!("{}: its values make no linkage", arguments.linkage)).into());
    };
    let poses: Vec<Pose> = arguments.at.map(|at| poses(&solved, at, arguments.branch)).unwrap_or_default();
    if let Some(path) = &arguments.svg {
        build::write_file(path, &plate(&family, &solved))?;
    }
    print(&if arguments.json {
        as_json(&family, &solved, &poses)
    } else {
        as_text(&family, &solved, arguments, &poses)
    })?;
    Ok(Outcome::Done)
}

/// The linkage asked for.
fn template(arguments: &Arguments) -> anyhow::Result<Arc<Template>> {
    let mut known: Vec<Arc<Template>> = Vec::new();
    if let Some(path) = &arguments.manifest {
        let text = build::read_manifest(path)?;
        let (own, problems) = manifest::linkages(&text);
        super::plan::report(path, &text, &problems);
        known.extend(own);
    }
    known.extend(catalogue::all().iter().cloned());
    let found = known.iter().find(|template| template.id == arguments.linkage).cloned();
    found.ok_or_else(|| {
        let ids: Vec<&str> = known.iter().map(|template| template.id.as_str()).collect();
        let name = &arguments.linkage;
        WrongInput(format!("there is no linkage `{name}`: {}", nearest_or_all(name, &ids))).into()
    })
}

/// `name=value`, the value a number or an expression without names.
fn parameter(text: &str) -> Result<(String, f64), WrongInput> {
    let wrong = |why: String| WrongInput(format!("`{text}`: {why}; write it like p=2 or \"a=sqrt(2)\""));
    let (name, value) = text.split_once('=').ok_or_else(|| wrong("there is no `=`".to_owned()))?;
    let expression = Expression::parse(value).map_err(|error| wrong(error.message))?;
    if let Some(name) = expression.names().first() {
        return Err(wrong(format!("`{name}` has no value here")));
    }
    Ok((name.trim().to_owned(), expression.evaluate(|_| f64::NAN)))
}

/// The linkage at one input, on one pass.
struct Pose<'a> {
    circuit: usize,
    pass: &'a Pass,
    jets: Jets,
}

/// Every pose at an input, circuit by circuit.
fn poses(solved: &Solved, at: f64, branch: Option<i8>) -> Vec<Pose<'_>> {
    let input = solved.linkage.input();
    let mut found = Vec::new();
    for (circuit, motion) in (1..).zip(&solved.motion.circuits) {
        for pass in &motion.passes {
            let (from, to) = (pass.from.stop.at, pass.to.stop.at);
            let [low, high] = [from.min(to), from.max(to)];
            // The input may have been given a few turns off.
            let over = (at - low).rem_euclid(input.period());
            let is_branch = branch.is_none_or(|branch| pass.signs.get(0) == branch);
            if low + over <= high && is_branch {
                let stop = Stop::of(input, low + over);
                let flat = [pass.from, pass.to].into_iter().find(|end| end.stop.at == stop.at);
                let flat = flat.map_or(Flat::NONE, |end| end.flat);
                found.push(Pose { circuit, pass, jets: Jets::of(&solved.linkage, stop, pass.signs, flat) });
            }
        }
    }
    found
}

fn unit(solved: &Solved) -> &'static str {
    if solved.linkage.input() == Input::Length { "" } else { "°" }
}

/// A number to read: ten significant digits, and no zeros after them.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    (rounded + 0.0).to_string()
}

fn as_text(family: &Family, solved: &Solved, arguments: &Arguments, poses: &[Pose]) -> String {
    let mut out = String::new();
    let values =
        family.names.iter().zip(&solved.cell.values).map(|(name, value)| format!("{name} = {}", short(*value)));
    // Writing to a string cannot fail.
    let _ = writeln!(out, "{}: {}", family.id, values.collect::<Vec<_>>().join(", "));
    if let Some(four_bar) = FourBar::of(&solved.linkage) {
        let _ = writeln!(out, "class: {}", four_bar.class().name());
    }
    if let Some(reason) = &solved.motion.shortfall {
        let _ = writeln!(out, "not assembled: {reason}");
    }
    for (number, circuit) in (1..).zip(&solved.motion.circuits) {
        let _ = writeln!(out, "circuit {number}: {}", course(circuit, unit(solved)));
    }
    if let (Some(at), true) = (arguments.at, poses.is_empty()) {
        let _ = writeln!(out, "at {}{}: no circuit comes there", short(at), unit(solved));
    }
    for pose in poses {
        let at = arguments.at.map(short).unwrap_or_default();
        let branch = pose.pass.signs.get(0);
        let _ = writeln!(out, "\nat {at}{}, circuit {}, branch {branch}", unit(solved), pose.circuit);
        let _ = writeln!(out, "{:<6}{:>14}{:>14}{:>14}{:>14}{:>14}{:>14}", "joint", "x", "y", "vx", "vy", "ax", "ay");
        for (joint, named) in solved.linkage.joints.iter().enumerate() {
            let (p, v, a) = (pose.jets.place(joint), pose.jets.velocity(joint), pose.jets.acceleration(joint));
            let row: String = [p.x, p.y, v.x, v.y, a.x, a.y].iter().map(|x| format!("{:>14}", short(*x))).collect();
            let _ = writeln!(out, "{:<6}{row}", named.name);
        }
    }
    out
}

/// How the input goes on a circuit: "a full turn on branch 1", "from 28.96° on branch 1 to 97.18°, on branch -1 to 28.96°".
fn course(circuit: &Circuit, unit: &str) -> String {
    let first = &circuit.passes[0];
    if let [pass] = circuit.passes[..]
        && circuit.closed
    {
        let turns = (pass.length() / 360.0).round();
        let length = if turns == 1.0 { "a full turn".to_owned() } else { format!("{turns} turns") };
        return format!("{length} on branch {}", pass.signs.get(0));
    }
    let steps: Vec<String> = circuit
        .passes
        .iter()
        .map(|pass| format!("on branch {} to {}{unit}", pass.signs.get(0), short(pass.to.stop.at)))
        .collect();
    format!("from {}{unit} {}", short(first.from.stop.at), steps.join(", "))
}

fn as_json(family: &Family, solved: &Solved, poses: &[Pose]) -> String {
    // JSON has no infinity: what is unbounded, and what does not exist, is null.
    let number = |value: f64| if value.is_finite() { json!(value) } else { Value::Null };
    let pair = |x: f64, y: f64| json!([number(x), number(y)]);
    let parameters: serde_json::Map<String, Value> =
        family.names.iter().cloned().zip(solved.cell.values.iter().map(|value| number(*value))).collect();
    let passes = |circuit: &Circuit| -> Value {
        let pass = |pass: &Pass| {
            let [from, to] =
                [pass.from, pass.to].map(|end| json!({ "input": end.stop.at, "limit": !end.flat.is_none() }));
            let signs: Vec<i8> = (0..solved.linkage.dyads()).map(|dyad| pass.signs.get(dyad)).collect();
            json!({ "from": from, "to": to, "branches": signs })
        };
        circuit.passes.iter().map(pass).collect()
    };
    let circuits: Vec<Value> = solved
        .motion
        .circuits
        .iter()
        .map(|circuit| json!({ "closed": circuit.closed, "passes": passes(circuit) }))
        .collect();
    let measures = |values: &[measure::Value]| -> Value {
        let value = |value: &measure::Value| match value {
            measure::Value::Number(value) => number(*value),
            measure::Value::Word(word) => json!(word),
            measure::Value::Missing => Value::Null,
        };
        measure::ALL
            .iter()
            .zip(values)
            .map(|(m, v)| (m.name.to_owned(), value(v)))
            .collect::<serde_json::Map<_, _>>()
            .into()
    };
    let curves: Vec<Value> = solved
        .curves
        .iter()
        .map(|c| json!({ "trace": c.trace, "circuit": c.circuit, "measures": measures(&c.measures) }))
        .collect();
    let poses: Vec<Value> = poses
        .iter()
        .map(|pose| {
            let joint = |joint: usize| {
                let (p, v) = (pose.jets.place(joint), pose.jets.velocity(joint));
                let (a, j) = (pose.jets.acceleration(joint), pose.jets.jerk(joint));
                json!({
                    "name": solved.linkage.joints[joint].name,
                    "place": pair(p.x, p.y),
                    "velocity": pair(v.x, v.y),
                    "acceleration": pair(a.x, a.y),
                    "jerk": pair(j.x, j.y),
                })
            };
            let joints: Vec<Value> = (0..solved.linkage.joints.len()).map(joint).collect();
            json!({ "circuit": pose.circuit, "branch": pose.pass.signs.get(0), "joints": joints })
        })
        .collect();
    let whole = json!({
        "format": FORMAT,
        "linkage": family.id,
        "parameters": parameters,
        "status": solved.status().name(),
        "reason": solved.motion.shortfall,
        "circuits": circuits,
        "curves": curves,
        "poses": poses,
    });
    format!("{whole:#}\n")
}

/// One plate of the linkage, as SVG.
fn plate(family: &Family, solved: &Solved) -> Vec<u8> {
    let template = &family.template;
    let line = |caption: &Option<Caption>| family.describe(caption.as_ref(), &solved.cell);
    let panel = Panel { caption: line(&template.caption), note: line(&template.note), solved };
    let sheet = Sheet {
        atlas: "coupler-atlas",
        family: &family.id,
        title: &family.title,
        source: template.source.clone(),
        symbols: &family.names,
        page: 1,
        of: 1,
        layout: Layout::Panels { columns: 1, rows: 1 },
        panels: vec![panel],
    };
    let options = Options { paper: Paper { width: 200.0, height: 150.0 }, dash_deg: 5.0 };
    render::svg(&page::compose(&sheet, &options), TextMode::Text)
}

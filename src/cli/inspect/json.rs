//! The JSON that `inspect --json` prints.

use coupler_curves::geometry::{Point, Vector};
use coupler_curves::linkage::{DyadId, FourBar, Input, JointId, Linkage, MovingLink, OutputLink, PlacedFourBar};
use coupler_curves::measure;
use coupler_curves::motion::{Circuit, Pass, PassEnd};
use serde_json::{Map, Value, json};

use super::Report;
use super::cognates::{CognateMember, CognateSet};
use super::equation;
use super::pose::{Pose, flat_joints, instant_geometries, link_rotations};
use super::ranges::Ranges;

/// The version of the format; docs/inspect.md describes it.
const FORMAT: u32 = 1;

/// The report as indented JSON.
pub(super) fn json(report: &Report) -> String {
    let Report { family, solved, .. } = report;
    let values = solved.cell.values.iter().map(|value| number(*value));
    let parameters: Map<String, Value> = family.names.iter().cloned().zip(values).collect();
    let curves: Vec<Value> = solved
        .curves
        .iter()
        .map(|curve| json!({ "trace": curve.trace, "circuit": curve.circuit, "measures": measures(&curve.values) }))
        .collect();
    let circuits: Vec<Value> =
        solved.motion.circuits.iter().map(|circuit| self::circuit(&solved.linkage, circuit)).collect();
    let ranges = Ranges::new(&solved.linkage);
    let document = json!({
        "format": FORMAT,
        "linkage": family.id,
        "parameters": parameters,
        "class": FourBar::from_linkage(&solved.linkage).map(|four_bar| four_bar.class().name()),
        "six_bar": ranges.six_bar_json(),
        "rocker_limits": ranges.rocker_limits_json(),
        "arc": ranges.arc_json(),
        "inverted_slider_crank": ranges.slider_json(),
        "output_link": output_link(&solved.linkage),
        "input": if solved.linkage.input() == Input::Length { "length" } else { "deg" },
        "status": solved.status().name(),
        "reason": solved.motion.assembly_error.as_ref().map(ToString::to_string),
        "circuits": circuits,
        "curves": curves,
        "equations": equation::json(&report.equations.0),
        "cognates": report.cognates.as_ref().map(cognates),
        "poses": report.poses.iter().map(|pose| self::pose(report, pose)).collect::<Vec<_>>(),
    });
    format!("{document:#}\n")
}

/// The output link as in a manifest: two joints of a link, or the joint of a slider; null if there is none.
fn output_link(linkage: &Linkage) -> Value {
    let name = |joint: JointId| linkage.joints[joint].name.as_str();
    match linkage.output() {
        None => Value::Null,
        Some(OutputLink::Link(joints) | OutputLink::Slot { base: joints, .. }) => json!(joints.map(name)),
        Some(OutputLink::Slider { joint, .. }) => json!(name(joint)),
    }
}

/// A number, or null if it is infinite or does not exist.
fn number(value: f64) -> Value {
    if value.is_finite() { json!(value) } else { Value::Null }
}

fn pair(v: Vector) -> Value {
    json!([number(v.x), number(v.y)])
}

fn point(p: Point) -> Value {
    pair(p.coords)
}

fn circuit(linkage: &Linkage, circuit: &Circuit) -> Value {
    let end = |end: PassEnd| json!({ "input": end.input.value, "flat": flat_joints(linkage, end.flat_dyads) });
    let pass = |(k, pass): (usize, &Pass)| {
        let signs: Vec<i8> = linkage.dyad_ids().map(|dyad| pass.mode.sign(dyad)).collect();
        json!({ "from": end(pass.from), "to": end(pass.to), "branches": signs, "turns": circuit.reverses_after(k) })
    };
    let passes: Vec<Value> = circuit.passes.iter().enumerate().map(pass).collect();
    json!({ "closed": circuit.is_closed, "full_turn": circuit.is_full_turn(), "passes": passes })
}

fn cognates(cognate_set: &CognateSet) -> Value {
    let member = |CognateMember { cognate, class, linkage, motion, .. }: &CognateMember| {
        let PlacedFourBar { pivots, lengths, coupler_point } = cognate.four_bar;
        let circuits: Vec<Value> = motion.circuits.iter().map(|circuit| self::circuit(linkage, circuit)).collect();
        json!({
            "class": class.name(),
            "pivots": pivots.map(point),
            "frame": number(lengths.frame),
            "crank": number(lengths.crank),
            "coupler": number(lengths.coupler),
            "rocker": number(lengths.rocker),
            "along": number(coupler_point.x),
            "across": number(coupler_point.y),
            "turns_as": cognate.counterparts.map(MovingLink::name),
            "start": linkage.motion_options.start,
            "side": linkage.motion_options.mode.sign(DyadId::FIRST),
            "circuits": circuits,
        })
    };
    json!({
        "trace": cognate_set.trace,
        "third_pivot": point(cognate_set.cognates.third_pivot),
        "linkages": cognate_set.linkages.iter().map(member).collect::<Vec<_>>(),
    })
}

fn measures(values: &[measure::Value]) -> Value {
    let value = |value: &measure::Value| match value {
        measure::Value::Number(value) => number(*value),
        measure::Value::Word(word) => json!(word),
        measure::Value::Missing => Value::Null,
    };
    let named = measure::ALL.iter().zip(values).map(|(m, v)| (m.name.to_owned(), value(v)));
    named.collect::<Map<_, _>>().into()
}

fn pose(report: &Report, pose: &Pose) -> Value {
    let (solved, jets) = (report.solved, &pose.jets);
    let joint = |joint: JointId| {
        json!({
            "name": solved.linkage.joints[joint].name,
            "place": point(jets.position(joint)),
            "velocity": pair(jets.velocity(joint)),
            "acceleration": pair(jets.acceleration(joint)),
            "jerk": pair(jets.jerk(joint)),
        })
    };
    let joints: Vec<Value> = solved.linkage.joint_ids().map(joint).collect();
    let links: Vec<Value> = link_rotations(solved, pose)
        .into_iter()
        .map(|link| {
            json!({
                "joints": link.joints,
                "angular_velocity": number(link.angular_velocity),
                "angular_acceleration": number(link.angular_acceleration),
            })
        })
        .collect();
    let instants: Vec<Value> = instant_geometries(solved, pose)
        .filter_map(|(joint, instant)| {
            let instant = instant?;
            let position = jets.position(joint);
            Some(json!({
                "joint": solved.linkage.joints[joint].name,
                "pole": point(instant.pole),
                "moving_pole": pair(instant.moving_pole),
                "inflection_pole": point(instant.inflection_pole()),
                "ball_point": instant.ball_point().map(point),
                "cubic": instant.cubic_parameters().map(|cubic| cubic.map(number)),
                "curvature": number(instant.curvature(position)),
                "curvature_rate": number(instant.curvature_rate(position)),
            }))
        })
        .collect();
    json!({
        "input": pose.input,
        "circuit": pose.circuit,
        "branch": pose.pass.mode.sign(DyadId::FIRST),
        "joints": joints,
        "links": links,
        "instants": instants,
    })
}

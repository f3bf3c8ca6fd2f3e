//! The motion of a joint and of the links over a circuit, and the input torque against a load.

use serde_json::{Value, json};

use coupler_curves::linkage::{JointId, Linkage};
use coupler_curves::measure::{Measure, TracedCurve, input_torque};
use coupler_curves::motion::{self, JointDerivatives, LinkRotation, Motion};

use crate::response::Numbers;
use crate::study::{Place, Study};

/// The motion of a joint at places of the circuit: its positions, velocities and accelerations, the rotations of the links, the transmission
/// angles of a four-bar, and with a load the input torques with their extremes over the circuit. Rates are per radian, or unit of length, of
/// the input; at limits they are not finite. The load is written as for `inspect`; without one it is the family's, if it has one.
///
/// # Errors
/// There is no such joint, or the text is no load.
pub(crate) fn joint_motion_json(
    study: &Study,
    joint: usize,
    places: &[Place],
    load: Option<&str>,
    numbers: &mut Numbers,
) -> Result<Value, String> {
    if joint >= study.linkage.joints.len() {
        return Err(format!("the study has no joint {joint}"));
    }
    let joint = JointId::new(joint);
    let linkage = with_load(study, load)?;
    let passes = study.passes();
    if let Some(place) = places.iter().find(|place| place.pass >= passes.len()) {
        return Err(format!("the study has no pass {}", place.pass));
    }
    let at: Vec<JointDerivatives> =
        places.iter().map(|place| JointDerivatives::on_pass(&linkage, &passes[place.pass], place.input)).collect();
    let rotations: Vec<Vec<LinkRotation>> = at.iter().map(|at| LinkRotation::of_links(&linkage, at)).collect();
    let links: Vec<Value> = rotations
        .first()
        .into_iter()
        .flatten()
        .enumerate()
        .map(|(k, link)| {
            json!({
                "joints": link.joints,
                "velocities": numbers.array(rotations.iter().map(|all| all[k].angular_velocity)),
                "accelerations": numbers.array(rotations.iter().map(|all| all[k].angular_acceleration)),
            })
        })
        .collect();
    let angle = |place: &Place| {
        let pose = motion::pose(&linkage, &passes[place.pass], place.input);
        study.transmission_angle(&pose)
    };
    let angles: Option<Vec<f64>> = places.iter().map(angle).collect();
    let torques: Option<Vec<f64>> =
        places.iter().zip(&at).map(|(place, at)| input_torque(&linkage, &passes[place.pass], at)).collect();
    let extremes = torques.as_ref().and_then(|_| extremes_json(study, &linkage));
    Ok(json!({
        "passes": numbers.array(places.iter().map(|place| place.pass as f64)),
        "inputs": numbers.array(places.iter().map(|place| place.input)),
        "positions": numbers.points(at.iter().map(|at| at.position(joint))),
        "velocities": numbers.array(at.iter().flat_map(|at| { let v = at.velocity(joint); [v.x, v.y] })),
        "accelerations": numbers.array(at.iter().flat_map(|at| { let a = at.acceleration(joint); [a.x, a.y] })),
        "links": links,
        "transmission_angles": angles.map(|angles| numbers.array(angles)),
        "torques": torques.map(|torques| numbers.array(torques)),
        "torque": extremes,
    }))
}

/// The linkage of a study with a load.
fn with_load(study: &Study, load: Option<&str>) -> Result<Linkage, String> {
    let Some(text) = load else { return Ok(study.linkage.clone()) };
    let template = &study.family.template;
    let load = template.parse_load(text).map_err(|error| error.to_string())?;
    let name = &template.joints[load.joint].name;
    let joint = study.linkage.find_joint(name).ok_or_else(|| format!("the study has no joint `{name}`"))?;
    Ok(Linkage { load: Some(load.map_joint(|_| joint)), ..study.linkage.clone() })
}

/// The extremes of the torque over the circuit, infinite ones as words.
fn extremes_json(study: &Study, linkage: &Linkage) -> Option<Value> {
    let motion = Motion { circuits: vec![study.circuit.clone()], assembly_error: None };
    let curve = TracedCurve::new(linkage, &motion, &motion.circuits[0], study.joint);
    // JSON has no infinity.
    let number = |value: f64| if value.is_finite() { json!(value) } else { json!(value.to_string()) };
    let [peak, at, least, most] =
        [Measure::TORQUE_PEAK, Measure::TORQUE_PEAK_DEG, Measure::TORQUE_MIN, Measure::TORQUE_MAX]
            .map(|key| curve.measure(key).map(number));
    Some(json!({ "peak": peak?, "peak_input": at?, "min": least?, "max": most? }))
}

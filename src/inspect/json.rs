//! The JSON that `inspect --json` prints. Its keys are in the order of the fields here, which is that of docs/inspect.md.

use coupler_curves::exchange::{Members, PassDocument};
use coupler_curves::geometry::{Point, Vector};
use coupler_curves::linkage::{DyadId, FourBar, Input, JointId, Linkage, MovingLink, OutputLink, PlacedFourBar};
use coupler_curves::measure;
use coupler_curves::motion::{Circuit, InstantaneousMotion, LinkRotation};
use coupler_curves::solve::MeasuredCurve;
use serde::Serialize;
use serde_json::{Value, json};

use super::cognate_set::{CognateMember, CognateSet};
use super::equation::{self, EquationJson};
use super::inspection::Inspection;
use super::pose::{Pose, instant_geometries};
use super::ranges::{ArcJson, Ranges, RockerLimitsJson, SliderJson};
use super::tolerance::{Tolerance, ToleranceJson};

/// The version of the format; docs/inspect.md describes it.
const FORMAT: u32 = 1;

/// The description of a linkage. Numbers that are infinite or do not exist become null.
#[derive(Serialize)]
struct Document<'a> {
    format: u32,
    linkage: &'a str,
    parameters: Members<'a, f64>,
    class: Option<&'static str>,
    six_bar: Option<&'static str>,
    rocker_limits: Option<RockerLimitsJson>,
    arc: Option<ArcJson>,
    inverted_slider_crank: Option<SliderJson>,
    output_link: Value,
    load: Option<LoadJson<'a>>,
    input: &'static str,
    status: &'static str,
    reason: Option<String>,
    circuits: Vec<CircuitJson<'a>>,
    curves: Vec<CurveJson>,
    poses: Vec<PoseJson<'a>>,
    equations: Vec<EquationJson>,
    tolerance: Option<ToleranceJson<'a>>,
    cognates: Option<CognatesJson<'a>>,
}

#[derive(Serialize)]
struct LoadJson<'a> {
    joint: &'a str,
    force: f64,
    direction: Option<f64>,
}

#[derive(Serialize)]
struct CircuitJson<'a> {
    closed: bool,
    full_turn: bool,
    passes: Vec<PassDocument<'a>>,
}

#[derive(Serialize)]
struct CurveJson {
    trace: usize,
    circuit: usize,
    measures: Members<'static, Value>,
}

#[derive(Serialize)]
struct PoseJson<'a> {
    input: f64,
    circuit: usize,
    branch: i8,
    joints: Vec<JointJson<'a>>,
    links: Vec<LinkJson<'a>>,
    torque: Option<f64>,
    instants: Vec<InstantJson<'a>>,
}

#[derive(Serialize)]
struct JointJson<'a> {
    name: &'a str,
    place: [f64; 2],
    velocity: [f64; 2],
    acceleration: [f64; 2],
    jerk: [f64; 2],
}

#[derive(Serialize)]
struct LinkJson<'a> {
    joints: Vec<&'a str>,
    angular_velocity: f64,
    angular_acceleration: f64,
}

#[derive(Serialize)]
struct InstantJson<'a> {
    joint: &'a str,
    pole: [f64; 2],
    moving_pole: [f64; 2],
    inflection_pole: [f64; 2],
    ball_point: Option<[f64; 2]>,
    cubic: Option<[f64; 2]>,
    curvature: f64,
    curvature_rate: f64,
}

#[derive(Serialize)]
struct CognatesJson<'a> {
    trace: usize,
    third_pivot: [f64; 2],
    linkages: Vec<CognateJson<'a>>,
}

#[derive(Serialize)]
struct CognateJson<'a> {
    pivots: [[f64; 2]; 2],
    frame: f64,
    crank: f64,
    coupler: f64,
    rocker: f64,
    along: f64,
    across: f64,
    turns_as: [&'static str; 3],
    start: Option<f64>,
    side: i8,
    class: &'static str,
    circuits: Vec<CircuitJson<'a>>,
}

/// The inspection as indented JSON.
///
/// # Errors
/// None that can occur: the keys are strings.
pub(super) fn json(inspection: &Inspection) -> serde_json::Result<String> {
    let Inspection { family, solved, .. } = inspection;
    let linkage = &solved.linkage;
    let ranges = Ranges::new(linkage);
    let document = Document {
        format: FORMAT,
        linkage: &family.id,
        parameters: Members(family.names.iter().map(String::as_str).zip(solved.cell.values.iter().copied()).collect()),
        class: FourBar::from_linkage(linkage).map(|four_bar| four_bar.class().name()),
        six_bar: ranges.six_bar_name(),
        rocker_limits: ranges.rocker_limits_json(),
        arc: ranges.arc_json(),
        inverted_slider_crank: ranges.slider_json(),
        output_link: output_link(linkage),
        load: linkage.load.map(|load| LoadJson {
            joint: &linkage.joints[load.joint].name,
            force: load.force,
            direction: load.direction_deg,
        }),
        input: if linkage.input() == Input::Length { "length" } else { "deg" },
        status: solved.status().name(),
        reason: solved.motion.assembly_error.as_ref().map(ToString::to_string),
        circuits: solved.motion.circuits.iter().map(|circuit| CircuitJson::new(linkage, circuit)).collect(),
        curves: solved.curves.iter().map(|curve| CurveJson::new(&solved.linkage, curve)).collect(),
        poses: inspection.poses.iter().map(|pose| PoseJson::new(inspection, pose)).collect(),
        equations: equation::json(&inspection.equations),
        tolerance: inspection.tolerance.as_ref().map(Tolerance::json),
        cognates: inspection.cognates.as_ref().map(CognatesJson::new),
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
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

fn pair(v: Vector) -> [f64; 2] {
    [v.x, v.y]
}

fn point(p: Point) -> [f64; 2] {
    pair(p.coords)
}

impl<'a> CircuitJson<'a> {
    fn new(linkage: &'a Linkage, circuit: &Circuit) -> CircuitJson<'a> {
        let passes = PassDocument::of_circuit(linkage, circuit);
        CircuitJson { closed: circuit.is_closed, full_turn: circuit.is_full_turn(), passes }
    }
}

impl CurveJson {
    fn new(linkage: &Linkage, curve: &MeasuredCurve) -> CurveJson {
        let is_driven_by_length = linkage.input() == Input::Length;
        let value = |value: &measure::Value| match value {
            measure::Value::Number(value) => json!(value),
            measure::Value::Word(word) => json!(word),
            measure::Value::Missing => Value::Null,
        };
        let measures = measure::ALL
            .iter()
            .zip(&curve.values)
            .map(|(measure, found)| (measure.name_for(is_driven_by_length), value(found)));
        CurveJson { trace: curve.trace, circuit: curve.circuit, measures: Members(measures.collect()) }
    }
}

impl<'a> PoseJson<'a> {
    fn new(inspection: &'a Inspection, pose: &'a Pose) -> PoseJson<'a> {
        let (solved, jets) = (&inspection.solved, &pose.jets);
        let name = |joint: JointId| solved.linkage.joints[joint].name.as_str();
        let joint = |joint: JointId| JointJson {
            name: name(joint),
            place: point(jets.position(joint)),
            velocity: pair(jets.velocity(joint)),
            acceleration: pair(jets.acceleration(joint)),
            jerk: pair(jets.jerk(joint)),
        };
        let link = |LinkRotation { joints, angular_velocity, angular_acceleration }| LinkJson {
            joints,
            angular_velocity,
            angular_acceleration,
        };
        let instant = |(joint, instant): (JointId, Option<InstantaneousMotion>)| {
            let (instant, position) = (instant?, jets.position(joint));
            Some(InstantJson {
                joint: name(joint),
                pole: point(instant.pole),
                moving_pole: pair(instant.moving_pole),
                inflection_pole: point(instant.inflection_pole()),
                ball_point: instant.ball_point().map(point),
                cubic: instant.cubic_parameters(),
                curvature: instant.curvature(position),
                curvature_rate: instant.curvature_rate(position),
            })
        };
        PoseJson {
            input: pose.input,
            circuit: pose.circuit,
            branch: pose.pass.mode.sign(DyadId::FIRST),
            joints: solved.linkage.joint_ids().map(joint).collect(),
            links: LinkRotation::of_links(&solved.linkage, jets).into_iter().map(link).collect(),
            torque: pose.torque(solved),
            instants: instant_geometries(solved, pose).filter_map(instant).collect(),
        }
    }
}

impl<'a> CognatesJson<'a> {
    fn new(cognate_set: &'a CognateSet) -> CognatesJson<'a> {
        let member = |CognateMember { cognate, class, linkage, motion, .. }: &'a CognateMember| {
            let PlacedFourBar { pivots, lengths, coupler_point } = cognate.four_bar;
            CognateJson {
                pivots: pivots.map(point),
                frame: lengths.frame,
                crank: lengths.crank,
                coupler: lengths.coupler,
                rocker: lengths.rocker,
                along: coupler_point.x,
                across: coupler_point.y,
                turns_as: cognate.counterparts.map(MovingLink::name),
                start: linkage.motion_options.start,
                side: linkage.motion_options.mode.sign(DyadId::FIRST),
                class: class.name(),
                circuits: motion.circuits.iter().map(|circuit| CircuitJson::new(linkage, circuit)).collect(),
            }
        };
        CognatesJson {
            trace: cognate_set.trace,
            third_pivot: point(cognate_set.cognates.third_pivot),
            linkages: cognate_set.linkages.iter().map(member).collect(),
        }
    }
}

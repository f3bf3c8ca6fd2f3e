//! One linkage, as text for people, as JSON for programs, and as a plate.

mod cognates;
mod equation;
mod json;
mod plate;
mod text;

use coupler_curves::solve;
use std::path::PathBuf;

use clap::Args;
use coupler_atlas::output;
use coupler_curves::family::{Family, Sampling};
use coupler_curves::geometry::{Vector, cross};
use coupler_curves::linkage::{DyadSet, Input, JointId, Linkage};
use coupler_curves::motion::{InstantaneousMotion, JointDerivatives, Pass, Sampler};
use coupler_curves::solve::SolvedCell;

use super::{InputError, Outcome, linkage, print};

/// Look at one linkage: its class, its circuits and their limits, where its joints are and how fast they move.
///
/// Rates are to a radian of input, or to a unit of an actuator's length. With --json everything is told as JSON, which
/// docs/inspect.md describes.
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
    /// Say where the joints are at this input, in degrees or as a length; a number or an expression.
    #[arg(long, value_name = "INPUT", allow_hyphen_values = true)]
    at: Option<String>,
    /// Of the poses at that input, only those with the first two-valued joint on this side: 1 left, -1 right.
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = ["1", "-1"], requires = "at")]
    branch: Option<String>,
    /// Print the coefficients of the equations of its coupler curves, with the crank's pivot at the origin and x towards the
    /// rocker's.
    #[arg(long, conflicts_with = "toml")]
    sextic: bool,
    /// Tell of the two other four-bars that draw its curve, the Roberts-Chebyshev cognates; a plate shows all three.
    #[arg(long)]
    cognates: bool,
    /// Of several traced joints, the one they are cognates for, from 1.
    #[arg(long, value_name = "N", default_value_t = 1, requires = "cognates")]
    trace: usize,
    /// Print a manifest of all three instead.
    #[arg(long, requires = "cognates", conflicts_with = "json")]
    toml: bool,
    /// As JSON.
    #[arg(long)]
    json: bool,
    /// Draw it on one plate: at the input, or where it can be seen best.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Let it move through its first circuit, over and over.
    #[arg(long, requires = "svg", conflicts_with = "at")]
    animate: bool,
}

/// What is told of a linkage.
struct Report<'a> {
    family: &'a Family,
    solved: &'a SolvedCell,
    /// The input asked for.
    input: Option<f64>,
    /// Its poses there.
    poses: Vec<Pose<'a>>,
    /// The equations of its coupler curves, and whether they are wanted in full.
    equations: (Vec<equation::Equation>, bool),
    /// The cognates, if they are asked for.
    cognates: Option<cognates::CognateSet>,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<Outcome> {
    let template = linkage::find_template(&arguments.linkage, arguments.manifest.as_deref())?;
    let given =
        arguments.parameters.iter().map(|text| linkage::parse_parameter(text)).collect::<Result<Vec<_>, _>>()?;
    let at = arguments.at.as_deref().map(|text| linkage::parse_number(text, "--at 30")).transpose()?;
    if let (Some(at), Some(text)) = (at.filter(|at| !at.is_finite()), &arguments.at) {
        return Err(InputError(format!("`{text}` is {at}: give a finite number, as in --at 30")).into());
    }
    let branch = arguments.branch.as_ref().map(|text| if text == "1" { 1 } else { -1 });
    let family = Family::single_cell(template, &given, Sampling::Samples(360))
        .map_err(|wrong| InputError(format!("{}: {}", arguments.linkage, wrong.join("; "))))?;
    let Some(solved) = solve::solve_cell(&family, &Sampler::new(family.sampling), 0) else {
        return Err(InputError(format!("{}: its values make no linkage", arguments.linkage)).into());
    };
    let poses: Vec<Pose> = at.map(|at| poses(&solved, at, branch)).unwrap_or_default();
    let cognates =
        arguments.cognates.then(|| cognates::find_cognates(&family.id, &solved, arguments.trace)).transpose()?;
    let equations = (equation::coupler_equations(&solved), arguments.sextic);
    let report = Report { family: &family, solved: &solved, input: at, poses, equations, cognates };
    if let Some(path) = &arguments.svg {
        output::write_file(path, &plate::plate(&report, arguments.animate))?;
    }
    let told = match &report.cognates {
        Some(found) if arguments.toml => cognates::manifest(&report, found),
        _ if arguments.json => json::json(&report),
        _ => text::text(&report),
    };
    print(&told)?;
    Ok(Outcome::Done)
}

/// The linkage at one input, on one pass.
struct Pose<'a> {
    circuit: usize,
    pass: &'a Pass,
    input: f64,
    jets: JointDerivatives,
}

/// Every pose at an input, circuit by circuit.
fn poses(solved: &SolvedCell, at: f64, branch: Option<i8>) -> Vec<Pose<'_>> {
    let input = solved.linkage.input();
    let mut found = Vec::new();
    for (circuit, motion) in (1..).zip(&solved.motion.circuits) {
        for pass in &motion.passes {
            let (from, to) = (pass.from.input.value, pass.to.input.value);
            let [low, high] = [from.min(to), from.max(to)];
            // The input may have been given a few turns off.
            let over = (at - low).rem_euclid(input.period());
            let is_branch = branch.is_none_or(|branch| pass.mode.sign(0) == branch);
            // The end of a whole turn is its beginning.
            let is_seam = motion.is_closed && motion.passes.len() == 1 && low + over == high;
            if low + over <= high && is_branch && !is_seam {
                let jets = JointDerivatives::on_pass(&solved.linkage, pass, low + over);
                found.push(Pose { circuit, pass, input: low + over, jets });
            }
        }
    }
    found
}

/// A moving link: its joints, and how fast it turns.
struct LinkRotation<'a> {
    joints: Vec<&'a str>,
    /// To a radian, or a unit, of input.
    angular_velocity: f64,
    /// The derivative of that by the input.
    angular_acceleration: f64,
}

/// The moving links of a pose that have two joints to tell their direction by.
fn link_rotations<'a>(solved: &'a SolvedCell, pose: &Pose) -> Vec<LinkRotation<'a>> {
    let linkage = &solved.linkage;
    let jets = &pose.jets;
    let moving = linkage.links.iter().filter(|link| !std::ptr::eq(*link, linkage.ground()));
    let turning = |link: &'a coupler_curves::linkage::Link| {
        let (first, place) = *link.joints.first()?;
        let (second, _) = *link.joints.iter().find(|(_, other)| *other != place)?;
        let between = |of: fn(&JointDerivatives, JointId) -> Vector| of(jets, second) - of(jets, first);
        let arm = jets.position(second) - jets.position(first);
        let along = |rate: Vector| cross(arm, rate) / arm.norm_squared();
        Some(LinkRotation {
            joints: link.joints.iter().map(|(joint, _)| linkage.joints[*joint].name.as_str()).collect(),
            angular_velocity: along(between(JointDerivatives::velocity)),
            angular_acceleration: along(between(JointDerivatives::acceleration)),
        })
    };
    moving.filter_map(turning).collect()
}

/// The instant geometry of each traced joint's link.
fn instant_geometries<'a>(
    solved: &'a SolvedCell,
    pose: &'a Pose,
) -> impl Iterator<Item = (JointId, Option<InstantaneousMotion>)> + use<'a> {
    let linkage = &solved.linkage;
    linkage.traced.iter().map(move |&joint| (joint, InstantaneousMotion::from_joint(linkage, &pose.jets, joint)))
}

/// The names of the joints whose dyads lie flat at an end.
fn flat_joints(linkage: &Linkage, flat: DyadSet) -> Vec<&str> {
    let is_flat =
        |joint: &&coupler_curves::linkage::Joint| joint.kind.dyad_index().is_some_and(|index| flat.contains(index));
    linkage.joints.iter().filter(is_flat).map(|joint| joint.name.as_str()).collect()
}

fn input_unit(linkage: &Linkage) -> &'static str {
    if linkage.input() == Input::Length { "" } else { "°" }
}

//! An inspection as text.

use std::fmt::Write;

use coupler_curves::linkage::{DyadId, FourBar};
use coupler_curves::motion::LinkRotation;
use coupler_curves::solve::SolvedCell;

use super::format::{describe_circuit, describe_load, describe_output, drive_word, format_point, input_unit};
use super::inspection::Inspection;
use super::pose::{Pose, instant_geometries};
use super::ranges::Ranges;
use super::{cognates, equation, summary};
use crate::format::format_significant;

/// The greatest width of the column of joint names, in characters; longer names exceed it.
const MAX_NAME_WIDTH: usize = 40;

/// The inspection as text: class, limits, transmission angle and straight portion; then the details, a table for each pose
/// and the cognates.
pub(super) fn text(inspection: &Inspection) -> String {
    let Inspection { family, solved, input, poses, equations, has_coefficients, cognates, tolerance } = inspection;
    let mut out = String::new();
    let values = family
        .names
        .iter()
        .zip(&solved.cell.values)
        .map(|(name, value)| format!("{name} = {}", format_significant(*value, 10)));
    // Writing to a string cannot fail.
    let _ = writeln!(out, "{}: {}", family.id, values.collect::<Vec<_>>().join(", "));
    if let Some(four_bar) = FourBar::from_linkage(&solved.linkage) {
        let _ = writeln!(out, "class: {}", four_bar.class().name());
    }
    let ranges = Ranges::new(&solved.linkage);
    if let Some(six_bar) = ranges.six_bar_name() {
        let _ = writeln!(out, "six-bar: {six_bar}");
    }
    if let Some(reason) = &solved.motion.assembly_error {
        let status = if solved.motion.is_assembled() { "assembled in part" } else { "not assembled" };
        let _ = writeln!(out, "{status}: {reason}");
    }
    summary::append_text(solved, &mut out);
    ranges.append_text(&mut out);
    if let Some(output) = describe_output(&solved.linkage) {
        let _ = writeln!(out, "output: {output}");
    }
    if let Some(load) = describe_load(&solved.linkage) {
        let _ = writeln!(out, "load: {load}");
    }
    for (number, circuit) in (1..).zip(&solved.motion.circuits) {
        let _ = writeln!(out, "circuit {number}: {}", describe_circuit(&solved.linkage, circuit));
    }
    equation::append_text(equations, *has_coefficients, &mut out);
    if let (Some(input), true) = (input, poses.is_empty()) {
        let (input, unit) = (format_significant(*input, 10), input_unit(&solved.linkage));
        let _ = writeln!(out, "at {input}{unit}: no circuit reaches this input");
    }
    if let Some(tolerance) = tolerance {
        tolerance.append_text(&mut out);
    }
    for pose in poses {
        describe_pose(solved, pose, &mut out);
    }
    if let Some(cognate_set) = cognates {
        cognates::append_text(cognate_set, &mut out);
    }
    out
}

/// A number with seven significant digits; 0 if it is rounding in comparison with others.
fn format_cleared(value: f64, greatest: f64) -> String {
    const ROUNDING: f64 = 1e-13;
    format_significant(if value.abs() <= ROUNDING * greatest { 0.0 } else { value }, 7)
}

/// Appends a table of the joints, a line for each link, and the instant centres of the links with traced joints.
fn describe_pose(solved: &SolvedCell, pose: &Pose, out: &mut String) {
    let (input, branch) = (format_significant(pose.input, 10), pose.pass.mode.sign(DyadId::FIRST));
    let _ = writeln!(out, "\nat {input}{}, circuit {}, branch {branch}", input_unit(&solved.linkage), pose.circuit);
    let width = solved
        .linkage
        .joints
        .iter()
        .map(|joint| joint.name.chars().count())
        .max()
        .unwrap_or(0)
        .clamp(5, MAX_NAME_WIDTH);
    let row = |out: &mut String, name: &str, cells: &[String]| {
        let cells: String = cells.iter().map(|cell| format!("{cell:>13}")).collect();
        let _ = writeln!(out, "{name:<width$}{cells}");
    };
    let jets = &pose.jets;
    let vectors =
        |joint| [jets.position(joint).coords, jets.velocity(joint), jets.acceleration(joint), jets.jerk(joint)];
    // The greatest coordinates, velocities and so on: what is much less than all of them is rounding.
    let mut greatest = [0.0f64; 4];
    for joint in solved.linkage.joint_ids() {
        for (greatest, vector) in greatest.iter_mut().zip(vectors(joint)) {
            *greatest =
                [vector.x, vector.y].into_iter().filter(|c| c.is_finite()).fold(*greatest, |g, c| g.max(c.abs()));
        }
    }
    let size = greatest[0];
    row(out, "joint", &["x", "y", "vx", "vy", "ax", "ay", "jx", "jy"].map(str::to_owned));
    for (joint, named) in solved.linkage.joint_ids().zip(&solved.linkage.joints) {
        let cells =
            vectors(joint).into_iter().zip(greatest).flat_map(|(v, g)| [v.x, v.y].map(|c| format_cleared(c, g)));
        row(out, &named.name, &cells.collect::<Vec<String>>());
    }
    for link in LinkRotation::of_links(&solved.linkage, &pose.jets) {
        let name = link.joints.join("-");
        let velocity = format_cleared(link.angular_velocity, 1.0);
        let acceleration = format_cleared(link.angular_acceleration, 1.0);
        let _ = writeln!(out, "link {name}: angular velocity {velocity}, angular acceleration {acceleration}");
    }
    if let Some(torque) = pose.torque(solved) {
        let _ = writeln!(out, "input {}: {}", drive_word(&solved.linkage), format_significant(torque, 7));
    }
    for (joint, instant) in instant_geometries(solved, pose) {
        let name = &solved.linkage.joints[joint].name;
        let Some(instant) = instant else {
            let velocity = pose.jets.velocity(joint);
            let is_moving = velocity.x.is_finite() && velocity.y.is_finite();
            let reason = if is_moving { "its link does not rotate" } else { "it is at a limit" };
            let _ = writeln!(out, "{name}: no instant centre: {reason}");
            continue;
        };
        let position = pose.jets.position(joint);
        let cubic = instant
            .cubic_parameters()
            .map(|[m, n]| format!("M = {}, N = {}", format_significant(m, 7), format_significant(n, 7)));
        let [curvature, rate] = [instant.curvature(position), instant.curvature_rate(position)];
        let curvatures = if curvature.is_finite() && rate.is_finite() {
            let [curvature, rate] =
                [format_cleared(curvature, size.recip()), format_cleared(rate, size.recip() * size.recip())];
            format!("curvature of its path {curvature}, rate of curvature {rate}")
        } else {
            "no curvature of its path, for it is at rest".to_owned()
        };
        let _ = writeln!(
            out,
            "{name}: instant centre {}, inflection pole {}, {curvatures}",
            format_point(instant.pole),
            format_point(instant.inflection_pole()),
        );
        let ball = instant.ball_point().map_or("none".to_owned(), format_point);
        let cubic = cubic.unwrap_or("none".to_owned());
        let _ = writeln!(out, "{name}: cubic of stationary curvature {cubic}; Ball's point {ball}");
    }
}

use std::fmt::Write;

use coupler_curves::geometry::Point;
use coupler_curves::linkage::{FourBar, Linkage};
use coupler_curves::motion::{Circuit, Pass};
use coupler_curves::solve::SolvedCell;

use super::{Pose, Report, flat_joints, input_unit, instant_geometries, link_rotations};

/// For people.
pub(super) fn text(report: &Report) -> String {
    let Report { family, solved, input: at, poses, equations, cognates } = report;
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
    if let Some(reason) = &solved.motion.incomplete_reason {
        let how = if solved.motion.is_assembled() { "assembled in part" } else { "not assembled" };
        let _ = writeln!(out, "{how}: {reason}");
    }
    for (number, circuit) in (1..).zip(&solved.motion.circuits) {
        let _ = writeln!(out, "circuit {number}: {}", describe_circuit(&solved.linkage, circuit));
    }
    super::equation::text(&equations.0, equations.1, &mut out);
    if let (Some(at), true) = (at, poses.is_empty()) {
        let _ =
            writeln!(out, "at {}{}: no circuit comes there", format_significant(*at, 10), input_unit(&solved.linkage));
    }
    for pose in poses {
        describe_pose(solved, pose, &mut out);
    }
    if let Some(found) = cognates {
        super::cognates::text(found, &mut out);
    }
    out
}

/// A number to read, with so many significant digits and no zeros after them.
pub(super) fn format_significant(value: f64, digits: usize) -> String {
    let rounded: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    match rounded {
        0.0 => "0".to_owned(),
        x if x.is_finite() && !(1e-4..1e7).contains(&x.abs()) => format!("{x:e}"),
        x => x.to_string(),
    }
}

pub(super) fn format_point(p: Point) -> String {
    format!("({}, {})", format_significant(p.x, 7), format_significant(p.y, 7))
}

/// How the input goes on a circuit: "a full turn on branch 1", "from 28.96° on branch 1 to 97.18° (B flat), on branch -1
/// to 28.96° (B flat)".
pub(super) fn describe_circuit(linkage: &Linkage, circuit: &Circuit) -> String {
    let unit = input_unit(linkage);
    let first = &circuit.passes[0];
    if let [pass] = circuit.passes[..]
        && circuit.is_closed
    {
        let turns = (pass.input_length() / 360.0).round();
        let length = if turns == 1.0 { "a full turn".to_owned() } else { format!("{turns} turns") };
        return format!("{length} on branch {}", pass.mode.sign(0));
    }
    let flat = |pass: &Pass| match &flat_joints(linkage, pass.to.flat_dyads)[..] {
        [] => String::new(),
        joints => format!(" ({} flat)", joints.join(", ")),
    };
    let step = |pass: &Pass| {
        format!(
            "on branch {} to {}{unit}{}",
            pass.mode.sign(0),
            format_significant(pass.to.input.value, 10),
            flat(pass)
        )
    };
    let steps: Vec<String> = circuit.passes.iter().map(step).collect();
    format!("from {}{unit} {}", format_significant(first.from.input.value, 10), steps.join(", "))
}

/// A table of the joints, one of the links, and the instant geometry of the traced joints' links.
fn describe_pose(solved: &SolvedCell, pose: &Pose, out: &mut String) {
    let (at, branch) = (format_significant(pose.input, 10), pose.pass.mode.sign(0));
    let _ = writeln!(out, "\nat {at}{}, circuit {}, branch {branch}", input_unit(&solved.linkage), pose.circuit);
    let width = solved.linkage.joints.iter().map(|joint| joint.name.chars().count()).max().unwrap_or(0).max(5);
    let row = |out: &mut String, name: &str, cells: &[String]| {
        let cells: String = cells.iter().map(|cell| format!("{cell:>13}")).collect();
        let _ = writeln!(out, "{name:<width$}{cells}");
    };
    row(out, "joint", &["x", "y", "vx", "vy", "ax", "ay", "jx", "jy"].map(str::to_owned));
    for (joint, named) in solved.linkage.joints.iter().enumerate() {
        let jets = &pose.jets;
        let vectors = [jets.position(joint).coords, jets.velocity(joint), jets.acceleration(joint), jets.jerk(joint)];
        let cells: Vec<String> =
            vectors.iter().flat_map(|v| [format_significant(v.x, 7), format_significant(v.y, 7)]).collect();
        row(out, &named.name, &cells);
    }
    for turning in link_rotations(solved, pose) {
        let (name, w) = (turning.joints.join("-"), format_significant(turning.angular_velocity, 7));
        let _ = writeln!(
            out,
            "link {name} turns at {w}, changing by {}",
            format_significant(turning.angular_acceleration, 7)
        );
    }
    for (joint, instant) in instant_geometries(solved, pose) {
        let name = &solved.linkage.joints[joint].name;
        let Some(instant) = instant else {
            let _ = writeln!(out, "{name}: its link does not turn, or is at a limit");
            continue;
        };
        let place = pose.jets.position(joint);
        let cubic = instant
            .cubic_parameters()
            .map(|[m, n]| format!("M = {}, N = {}", format_significant(m, 7), format_significant(n, 7)));
        let _ = writeln!(
            out,
            "{name}: instant centre {}, inflection pole {}, path curved by {}, changing by {}",
            format_point(instant.pole),
            format_point(instant.inflection_pole()),
            format_significant(instant.curvature(place), 7),
            format_significant(instant.curvature_rate(place), 7)
        );
        let ball = instant.ball_point().map_or("none".to_owned(), format_point);
        let cubic = cubic.unwrap_or("none".to_owned());
        let _ = writeln!(out, "{name}: cubic of stationary curvature {cubic}; Ball's point {ball}");
    }
}

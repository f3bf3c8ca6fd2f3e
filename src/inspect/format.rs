//! Numbers, points and circuits, as text.

use coupler_curves::geometry::Point;
use coupler_curves::linkage::{DyadId, Input, JointId, Linkage, OutputLink};
use coupler_curves::motion::{Circuit, Pass};

use crate::format::format_significant;

/// "(1.5, -2)".
pub(super) fn format_point(p: Point) -> String {
    format!("({}, {})", format_significant(p.x, 7), format_significant(p.y, 7))
}

/// The unit of the input: degrees, or none for the length of an actuator.
pub(super) fn input_unit(linkage: &Linkage) -> &'static str {
    linkage.input().unit_sign()
}

/// The output link: "link C-B", or "slider B".
pub(super) fn describe_output(linkage: &Linkage) -> Option<String> {
    let name = |joint: JointId| linkage.joints[joint].name.as_str();
    linkage.output().map(|output| match output {
        OutputLink::Link([from, to]) | OutputLink::Slot { base: [from, to], .. } => {
            format!("link {}-{}", name(from), name(to))
        }
        OutputLink::Slider { joint, .. } => format!("slider {}", name(joint)),
    })
}

/// The load, as it is given: "100 on C at -90°", or "100 on C against its motion".
pub(super) fn describe_load(linkage: &Linkage) -> Option<String> {
    let load = linkage.load?;
    let direction = match load.direction_deg {
        Some(deg) => format!("at {}°", format_significant(deg, 10)),
        None => "against its motion".to_owned(),
    };
    Some(format!("{} on {} {direction}", format_significant(load.force, 10), linkage.joints[load.joint].name))
}

/// What drives the input: a torque, or a force where the input is a length.
pub(super) fn drive_word(linkage: &Linkage) -> &'static str {
    if linkage.input() == Input::Length { "force" } else { "torque" }
}

/// The input over a circuit, pass by pass: "a full turn on branch 1", "from 28.96° on branch 1 to 97.18° (B flat), on
/// branch -1 to 28.96° (B flat)".
pub(super) fn describe_circuit(linkage: &Linkage, circuit: &Circuit) -> String {
    let unit = input_unit(linkage);
    let first = &circuit.passes[0];
    if let [pass] = &circuit.passes[..]
        && circuit.is_closed
    {
        let turns = (pass.input_length() / 360.0).round();
        let length = if turns == 1.0 { "a full turn".to_owned() } else { format!("{turns} turns") };
        return format!("{length} on branch {}", pass.mode.sign(DyadId::FIRST));
    }
    let flat = |pass: &Pass| match &pass.to.flat_joints(linkage)[..] {
        [] => String::new(),
        joints => format!(" ({} flat)", joints.join(", ")),
    };
    let describe_pass = |pass: &Pass| {
        format!(
            "on branch {} to {}{unit}{}",
            pass.mode.sign(DyadId::FIRST),
            format_significant(pass.to.input.value, 10),
            flat(pass)
        )
    };
    let passes: Vec<String> = circuit.passes.iter().map(describe_pass).collect();
    let turn = if circuit.is_full_turn() { "; the input turns fully" } else { "" };
    format!("from {}{unit} {}{turn}", format_significant(first.from.input.value, 10), passes.join(", "))
}

//! The drawing of a curve's linkage, for a manifest.

use coupler_curves::exchange::SelectedCurve;
use coupler_curves::geometry::{Point, trig};
use coupler_curves::linkage::{JointId, JointKind, Linkage};
use coupler_curves::linkage_format::toml_number;
use coupler_drawing::page;

use super::drawn_links::{missing, own_joints};
use crate::import::{Drawing, DrawingInput, Names};

/// Why a linkage has no drawing.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a drawing has no {what}, which `{joint}` needs; export the linkage with --form joints")]
pub struct DrawingError {
    /// The joint.
    pub joint: String,
    /// What a drawing does not have.
    pub what: &'static str,
}

/// The drawing of a linkage, as it is placed, in the clearest pose of a circuit, with the curves of that circuit that are given.
///
/// # Errors
/// It has a joint that a drawing cannot express.
pub(super) fn drawing(curves: &[&SelectedCurve]) -> Result<Option<Drawing>, DrawingError> {
    let Some(curve) = curves.first() else { return Ok(None) };
    let linkage = &curve.solved.linkage;
    for joint in &linkage.joints {
        let what = match joint.kind {
            JointKind::Piston { offset, .. } if offset != 0.0 => Some("actuator with an offset"),
            ref kind => missing(kind),
        };
        if let Some(what) = what {
            return Err(DrawingError { joint: joint.name.clone(), what });
        }
    }
    let Some(pose) = page::clearest_pose(&curve.solved) else { return Ok(None) };
    let at = |joint: JointId| pose[joint.index()];
    let mut traced: Vec<JointId> = curves.iter().map(|curve| curve.curve().joint).collect();
    traced.dedup();
    let slides: Vec<(JointId, [JointId; 2])> =
        linkage.joint_ids().filter_map(|joint| Some((joint, linkage.joints[joint].kind.slider_line()?))).collect();
    let kept: Vec<JointId> = traced.iter().copied().chain(slides.iter().flat_map(|(_, line)| *line)).collect();
    let ground = linkage.links.iter().position(|link| std::ptr::eq(link, linkage.ground())).unwrap_or_default();
    let input = input(linkage, ground, &at);
    let links: Vec<Vec<JointId>> = (0..linkage.links.len())
        .filter(|&link| link != ground)
        .map(|link| own_joints(linkage, link, &kept))
        .filter(|joints| joints.len() > 1)
        .collect();
    let mut frame = own_joints(linkage, ground, &kept);
    let is_used = |joint: &JointId| {
        kept.contains(joint) || links.iter().any(|link| link.contains(joint)) || input.joints().contains(joint)
    };
    frame.retain(is_used);
    let drawn: Vec<JointId> = linkage.joint_ids().filter(|joint| frame.contains(joint) || is_used(joint)).collect();
    let index = |joint: JointId| drawn.iter().position(|other| *other == joint).unwrap_or_default();
    let indices = |joints: &[JointId]| joints.iter().map(|&joint| index(joint)).collect::<Vec<_>>();
    let mut names = Names::default();
    let joints = drawn.iter().map(|&joint| (names.distinct(&linkage.joints[joint].name), at(joint).into())).collect();
    Ok(Some(Drawing {
        origin: "a curve",
        title: None,
        unit: None,
        joints,
        frame: indices(&frame),
        links: links.iter().map(|link| indices(link)).collect(),
        slides: slides.iter().map(|(joint, line)| (index(*joint), line.map(index))).collect(),
        input: input.to_drawing(index),
        range: range(curve, &input, &pose),
        trace: indices(&traced),
        notes: Vec::new(),
    }))
}

/// What is driven, by joints of the linkage.
enum Input {
    /// The angle of the line from a pivot to a pin, measured from that to another joint if there is one.
    Crank {
        from: Option<JointId>,
        line: [JointId; 2],
    },
    Slider(JointId),
    Distance([JointId; 2]),
}

impl Input {
    fn joints(&self) -> Vec<JointId> {
        match *self {
            Input::Crank { from, line } => from.into_iter().chain(line).collect(),
            Input::Slider(joint) => vec![joint],
            Input::Distance(joints) => joints.to_vec(),
        }
    }

    fn to_drawing(&self, index: impl Fn(JointId) -> usize) -> DrawingInput {
        match *self {
            Input::Crank { from: None, line } => DrawingInput::Line(line.map(index)),
            Input::Crank { from: Some(from), line } => {
                DrawingInput::Between([[line[0], from], line].map(|line| line.map(&index)))
            }
            Input::Slider(joint) => DrawingInput::Slider(index(joint)),
            Input::Distance(joints) => DrawingInput::Distance(joints.map(index)),
        }
    }
}

/// The input of a linkage. A crank turns relative to the first link, which moves where another is the ground.
fn input(linkage: &Linkage, ground: usize, at: &impl Fn(JointId) -> Point) -> Input {
    for joint in linkage.joint_ids() {
        match linkage.joints[joint].kind {
            JointKind::DrivenSlider { .. } => return Input::Slider(joint),
            JointKind::Piston { base: [from, _], .. } => return Input::Distance([from, joint]),
            JointKind::Crank { pivot, .. } => {
                let others = linkage.links[0].joints.iter().map(|(other, _)| *other);
                let from = others.into_iter().find(|&other| ground != 0 && at(other) != at(pivot));
                return Input::Crank { from, line: [pivot, joint] };
            }
            _ => {}
        }
    }
    // Every linkage has an input.
    Input::Slider(JointId::new(0))
}

/// The range of the input that is given, as the drawing measures it; mirrored linkages turn the other way.
fn range(curve: &SelectedCurve, input: &Input, pose: &[Point]) -> Option<[String; 2]> {
    let linkage = &curve.solved.linkage;
    let [from, to] = linkage.motion_options.range?;
    let Input::Crank { from: base, line: [pivot, pin] } = *input else {
        return Some([from, to].map(toml_number));
    };
    let circuit = curve.circuit();
    let is_drawn = |sample: &usize| {
        linkage.joint_ids().all(|joint| circuit.positions.point(joint, *sample) == pose[joint.index()])
    };
    let sample = (0..circuit.len()).find(is_drawn)?;
    let angle = |a: JointId, b: JointId| {
        let v = pose[b.index()] - pose[a.index()];
        trig::degrees(trig::atan2(v.y, v.x))
    };
    let drawn = angle(pivot, pin) - base.map_or(0.0, |base| angle(pivot, base));
    let sign = linkage.placement.handedness();
    let mut ends = [from, to].map(|end| drawn + sign * (end - circuit.inputs[sample]));
    ends.sort_by(f64::total_cmp);
    Some(ends.map(|end| format!("\"{} deg\"", toml_number(end))))
}

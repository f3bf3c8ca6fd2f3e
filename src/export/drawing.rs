//! The drawing of a curve's linkage, for a manifest.

use coupler_curves::exchange::SelectedCurve;
use coupler_curves::geometry::{Point, trig};
use coupler_curves::linkage::{JointId, JointKind, LineDirection, Linkage};
use coupler_curves::linkage_format::toml_number;
use coupler_drawing::page;

use super::drawn_links::{missing, own_joints};
use crate::import::{Drawing, DrawingInput, Names};

/// Why a linkage cannot be written in a form.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{form} has no {what}, which `{joint}` needs; export the linkage with --form {other}")]
pub struct FormError {
    /// The joint.
    pub joint: String,
    /// What the form does not have.
    pub what: &'static str,
    /// The form.
    pub form: &'static str,
    /// The one that has it.
    pub other: &'static str,
}

/// The drawing of a linkage, as it is placed, in the clearest pose of a circuit, with the curves of that circuit that are given.
///
/// # Errors
/// It has a joint that a drawing cannot express.
pub(super) fn drawing(curves: &[&SelectedCurve]) -> Result<Option<Drawing>, FormError> {
    let Some(curve) = curves.first() else { return Ok(None) };
    let linkage = &curve.solved.linkage;
    for joint in &linkage.joints {
        let what = match joint.kind {
            JointKind::Piston { offset, .. } if offset != 0.0 => Some("actuator with an offset"),
            // On the link with a slot it is a point like others.
            JointKind::Aligned { direction: LineDirection::BySide(_), .. } => None,
            ref kind => missing(kind),
        };
        if let Some(what) = what {
            return Err(FormError { joint: joint.name.clone(), what, form: "a drawing", other: "joints" });
        }
    }
    let Some(pose) = page::clearest_pose(&curve.solved) else { return Ok(None) };
    let at = |joint: JointId| pose[joint.index()];
    let mut traced: Vec<JointId> = curves.iter().map(|curve| curve.curve().joint).collect();
    traced.dedup();
    let slides: Vec<(JointId, [JointId; 2])> =
        linkage.joint_ids().filter_map(|joint| Some((joint, linkage.slider_line(joint)?))).collect();
    let kept: Vec<JointId> = traced.iter().copied().chain(slides.iter().flat_map(|(_, line)| *line)).collect();
    let slots = slots(linkage, &at);
    // The foot of a line that passes through its pivot is the pivot.
    let place = |joint: JointId| slots.iter().find(|slot| slot.foot == joint).map_or(joint, |slot| slot.from);
    let on_link = |link: usize| {
        let mut joints: Vec<JointId> = own_joints(linkage, link, &kept).into_iter().map(place).collect();
        joints.sort_unstable();
        joints.dedup();
        joints
    };
    let has_slot = |link: usize| slots.iter().any(|slot| slot.link == link);
    let ground = linkage.links.iter().position(|link| std::ptr::eq(link, linkage.ground())).unwrap_or_default();
    let input = input(linkage, ground, &at);
    let links: Vec<(usize, Vec<JointId>)> = (0..linkage.links.len())
        .filter(|&link| link != ground)
        .map(|link| (link, on_link(link)))
        .filter(|(link, joints)| joints.len() > 1 || has_slot(*link))
        .collect();
    let is_used = |joint: &JointId| {
        kept.contains(joint)
            || links.iter().any(|(_, joints)| joints.contains(joint))
            || input.joints().contains(joint)
            || slots.iter().any(|slot| slot.through == *joint)
    };
    let mut frame = on_link(ground);
    frame.retain(is_used);
    let drawn: Vec<JointId> = linkage.joint_ids().filter(|joint| frame.contains(joint) || is_used(joint)).collect();
    let index = |joint: JointId| drawn.iter().position(|other| *other == place(joint)).unwrap_or_default();
    let indices = |joints: &[JointId]| joints.iter().map(|&joint| index(joint)).collect::<Vec<_>>();
    // Each link with a slot has a further joint on its line, after all others.
    let with_ends = |link: usize, joints: &[JointId]| {
        let ends = slots.iter().enumerate().filter(|(_, slot)| slot.link == link).map(|(k, _)| drawn.len() + k);
        indices(joints).into_iter().chain(ends).collect::<Vec<_>>()
    };
    let own = drawn.iter().map(|&joint| (linkage.joints[joint].name.clone(), at(joint)));
    let ends = slots.iter().map(|slot| (format!("{}-line", linkage.joints[slot.through].name), slot.end));
    let mut names = Names::default();
    let joints = own.chain(ends).map(|(name, position)| (names.distinct(&name), position.into())).collect();
    let sliders = slides.iter().map(|(joint, line)| (index(*joint), line.map(index)));
    let through = slots.iter().enumerate().map(|(k, slot)| (index(slot.through), [index(slot.from), drawn.len() + k]));
    Ok(Some(Drawing {
        origin: "a curve",
        title: None,
        unit: None,
        joints,
        frame: with_ends(ground, &frame),
        links: links.iter().map(|(link, joints)| with_ends(*link, joints)).collect(),
        slides: sliders.chain(through).collect(),
        input: input.to_drawing(index),
        range: range(curve, &input, &pose),
        trace: indices(&traced),
        notes: Vec::new(),
    }))
}

/// A line of a link on which a joint slides, from its foot or, if it has no offset from it, its pivot.
struct Slot {
    foot: JointId,
    from: JointId,
    /// A further point of the line.
    end: Point,
    /// The link with the line.
    link: usize,
    /// The joint that slides.
    through: JointId,
}

fn slots(linkage: &Linkage, at: &impl Fn(JointId) -> Point) -> Vec<Slot> {
    let slot = |foot: JointId| {
        let JointKind::Slot { base: [pivot, through], offset, .. } = linkage.joints[foot].kind else { return None };
        let link = linkage.links.iter().position(|link| link.position(foot).is_some())?;
        let from = if offset == 0.0 { pivot } else { foot };
        // As far again, so that it is not at the joint that slides.
        let end = at(through) + (at(through) - at(foot));
        Some(Slot { foot, from, end, link, through })
    };
    linkage.joint_ids().filter_map(slot).collect()
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
    if let Some(joints) = linkage.driven_distance() {
        return Input::Distance(joints);
    }
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

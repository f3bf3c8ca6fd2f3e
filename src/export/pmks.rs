//! The address by which PMKS+ opens a curve's linkage.

use std::fmt::Write;

use coupler_curves::exchange::SelectedCurve;
use coupler_curves::geometry::{Point, trig};
use coupler_curves::linkage::{JointId, JointKind, Linkage};

use super::drawn_links::{missing, own_joints};

/// Where PMKS+ is.
const PROGRAM: &str = "https://app.pmksplus.com/";

/// Why a linkage has no address.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "PMKS+ has no {what}, which `{joint}` needs; export a linkage of pins, of sliders on the frame and of one driven crank"
)]
pub struct PmksError {
    /// The joint, or what else is in the way.
    pub joint: String,
    /// What PMKS+ does not have.
    pub what: &'static str,
}

/// A joint of an address.
struct AddressJoint {
    name: String,
    position: Point,
    links: Vec<usize>,
    is_ground: bool,
    is_input: bool,
    /// The angle of the line on which it slides, in radians.
    line: Option<f64>,
}

/// The address of a curve's linkage, at the sample a third of the way through the circuit, where it is not near a limit.
///
/// # Errors
/// It has a joint that PMKS+ does not have.
pub(super) fn address(curve: &SelectedCurve) -> Result<String, PmksError> {
    let linkage = &curve.solved.linkage;
    let traced = curve.curve().joint;
    check_joints(linkage)?;
    let circuit = curve.circuit();
    let sample = circuit.len() / 3;
    let at = |joint: JointId| circuit.positions.point(joint, sample);
    let is_fixed = |joint: JointId| linkage.links[0].position(joint).is_some();
    let crank = linkage.crank();
    // The crank is the first link, which is the one that its pivot drives.
    let is_crank = |joints: &[JointId]| crank.is_some_and(|line| line.iter().all(|joint| joints.contains(joint)));
    let mut links: Vec<Vec<JointId>> =
        (1..linkage.links.len()).map(|link| own_joints(linkage, link, &[traced])).collect();
    links.retain(|joints| joints.len() > 1);
    links.sort_by_key(|joints| !is_crank(joints));
    let mut joints: Vec<JointId> =
        linkage.joint_ids().filter(|joint| links.iter().any(|link| link.contains(joint))).collect();
    joints.sort_by_key(|joint| crank.is_none_or(|[pivot, _]| pivot != *joint));
    let mut names: Vec<String> = Vec::new();
    let mut out: Vec<AddressJoint> = Vec::new();
    let mut blocks = Vec::new();
    for &joint in &joints {
        let name = distinct(&linkage.joints[joint].name, &mut names);
        let position = at(joint);
        let mut on: Vec<usize> = (0..links.len()).filter(|&link| links[link].contains(&joint)).collect();
        if let JointKind::Slide { line: [a, b], .. } = linkage.joints[joint].kind {
            // The block is a link of its own, with the slider and the pin at one place.
            let direction = at(b) - at(a);
            let block = links.len() + blocks.len();
            on.push(block);
            let slider = distinct(&format!("{name}s"), &mut names);
            blocks.push([name.clone(), slider.clone()]);
            let angle = trig::atan2(direction.y, direction.x);
            out.push(AddressJoint { name, position, links: on, is_ground: false, is_input: false, line: None });
            out.push(AddressJoint {
                name: slider,
                position,
                links: vec![block],
                is_ground: true,
                is_input: false,
                line: Some(angle),
            });
            continue;
        }
        let is_input = crank.is_some_and(|[pivot, _]| pivot == joint);
        out.push(AddressJoint { name, position, links: on, is_ground: is_fixed(joint), is_input, line: None });
    }
    Ok(write_address(&out, links.len() + blocks.len()))
}

/// Checks that PMKS+ has all that a linkage is made of.
fn check_joints(linkage: &Linkage) -> Result<(), PmksError> {
    let is_fixed = |joint: &JointId| linkage.links[0].position(*joint).is_some();
    if let Some([origin, _]) = linkage.seen_from {
        return Err(PmksError { joint: linkage.joints[origin].name.clone(), what: "frame that is a moving link" });
    }
    if let Some([joint, _]) = linkage.driven_distance() {
        return Err(PmksError { joint: linkage.joints[joint].name.clone(), what: "actuator between two links" });
    }
    for (id, joint) in linkage.joint_ids().zip(&linkage.joints) {
        let what = match joint.kind {
            JointKind::Grouped { .. } => {
                linkage.slider_line(id).map(|_| "slider of a group of links that no dyads place")
            }
            JointKind::Slide { line, .. } if !line.iter().all(is_fixed) => Some("slider on a moving link"),
            JointKind::Piston { .. } => Some("actuator between two links"),
            JointKind::DrivenSlider { .. } => Some("driven slider"),
            JointKind::Slot { .. } => Some("slot"),
            ref kind => missing(kind),
        };
        if let Some(what) = what {
            return Err(PmksError { joint: joint.name.clone(), what });
        }
    }
    Ok(())
}

/// A name of ASCII letters and digits that no other joint has.
fn distinct(wanted: &str, names: &mut Vec<String>) -> String {
    let plain: String = wanted.chars().filter(char::is_ascii_alphanumeric).collect();
    let plain = if plain.is_empty() { "J".to_owned() } else { plain };
    let numbered = (2..).map(|k| format!("{plain}{k}"));
    let name = [plain.clone()].into_iter().chain(numbered).find(|name| !names.contains(name)).unwrap_or(plain);
    names.push(name.clone());
    name
}

/// Writes the joints, then the links, each in a line.
fn write_address(joints: &[AddressJoint], link_count: usize) -> String {
    let on = |link: usize| joints.iter().filter(move |joint| joint.links.contains(&link));
    // A link is called by its joints; no two links have the same.
    let link_name = |link: usize| on(link).map(|joint| joint.name.as_str()).collect::<Vec<_>>().join("-");
    let flag = |is_set: bool| if is_set { 't' } else { 'f' };
    let mut out = format!("{PROGRAM}?j=");
    for joint in joints {
        let links: Vec<String> = joint.links.iter().map(|&link| link_name(link)).collect();
        let kind = if joint.line.is_some() { 'P' } else { 'R' };
        // Writing to a string cannot fail.
        let _ = write!(
            out,
            "{},{},{},{},{kind},{},{},0.1,{},%0A",
            joint.name,
            joint.position.x,
            joint.position.y,
            links.join("%7C"),
            flag(joint.is_ground),
            joint.line.unwrap_or(0.0),
            flag(joint.is_input)
        );
    }
    out.push_str("&l=");
    for link in 0..link_count {
        let count = on(link).count().max(1) as f64;
        let [x, y] = [0, 1].map(|axis| on(link).map(|joint| joint.position[axis]).sum::<f64>() / count);
        let names: Vec<&str> = on(link).map(|joint| joint.name.as_str()).collect();
        let _ = write!(out, "{},1,1,{x},{y},{},,l,%0A", link_name(link), names.join("%7C"));
    }
    out.push('\n');
    out
}

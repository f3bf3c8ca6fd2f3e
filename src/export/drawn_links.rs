//! The links of a linkage as it is drawn, for formats that have joints by coordinates and links by their joints.

use coupler_curves::linkage::{JointId, JointKind, Linkage};

/// What a joint needs that such formats do not have; `None` if they have all of it.
pub(super) fn missing(kind: &JointKind) -> Option<&'static str> {
    match kind {
        JointKind::Gear { .. } => Some("gear"),
        JointKind::Rack { .. } => Some("rack"),
        JointKind::Yoke { .. } => Some("yoke"),
        JointKind::Parallelogram { .. } => Some("parallelogram that is a joint"),
        JointKind::Aligned { .. } => Some("link that keeps the direction of a line"),
        JointKind::Fixed(_)
        | JointKind::Crank { .. }
        | JointKind::Dyad { .. }
        | JointKind::Grouped { .. }
        | JointKind::Rigid { .. }
        | JointKind::Slide { .. }
        | JointKind::Piston { .. }
        | JointKind::Slot { .. }
        | JointKind::DrivenSlider { .. } => None,
        _ => Some("joint of this kind"),
    }
}

/// The joints of a link, by its index, without points that nothing else is connected to and that are not among `kept`.
pub(super) fn own_joints(linkage: &Linkage, link: usize, kept: &[JointId]) -> Vec<JointId> {
    let count = |joint: JointId| linkage.links.iter().filter(|link| link.position(joint).is_some()).count();
    let is_point = |joint: JointId| matches!(linkage.joints[joint].kind, JointKind::Rigid { .. }) && count(joint) == 1;
    let joints = linkage.links[link].joints.iter().map(|(joint, _)| *joint);
    joints.filter(|joint| kept.contains(joint) || !is_point(*joint)).collect()
}

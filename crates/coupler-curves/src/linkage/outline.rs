//! The outlines of links for drawing, bars and plates, and the pivots on the ground.

use super::{Joint, JointId, JointKind, Link, LinkId, Linkage};
use crate::geometry::{Bounds, Point, Vector, cross, trig};

impl Linkage {
    /// The joints that the ground shares with moving links, or on which a block is through which one slides, in the order of the ground's joints.
    pub fn pivots(&self) -> Vec<JointId> {
        let ground = self.ground();
        let is_pivot = |joint: JointId| {
            let slides_through =
                |other: &Joint| matches!(other.kind, JointKind::Slot { base: [_, through], .. } if through == joint);
            self.links.iter().any(|link| !std::ptr::eq(link, ground) && link.position(joint).is_some())
                || self.joints.iter().any(slides_through)
        };
        ground.joints.iter().map(|(joint, _)| *joint).filter(|&joint| is_pivot(joint)).collect()
    }

    /// The outlines of the moving links that have two joints or more.
    pub fn link_outlines(&self) -> Vec<LinkOutline> {
        let ground = self.ground();
        let moving = (0..).map(LinkId::new).zip(&self.links).filter(|(_, link)| !std::ptr::eq(*link, ground));
        let outlines = moving.map(|(id, link)| LinkOutline { link: id, joints: outline(self, link) });
        outlines.filter(|outline| outline.joints.len() > 1).collect()
    }
}

/// The joints that a moving link is drawn through.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LinkOutline {
    /// The link's index in [`Linkage::links`].
    pub link: LinkId,
    /// Its joints in the order of the outline: along a bar, counter-clockwise around a plate. Points of a grid are
    /// excluded.
    pub joints: Vec<JointId>,
}

/// The joints of a link in order around their centre, or along their line; the points of a grid are excluded.
fn outline(linkage: &Linkage, link: &Link) -> Vec<JointId> {
    // The points of a grid are consecutive joints with the same name.
    let name = |index: usize| linkage.joints.get(index).map(|joint| &joint.name);
    let is_grid = |joint: JointId| {
        let index = joint.index();
        matches!(linkage.joints[joint].kind, JointKind::Rigid { .. } | JointKind::Aligned { .. })
            && (name(index + 1) == name(index) || index.checked_sub(1).and_then(name) == name(index))
    };
    let joints: Vec<(JointId, Vector)> = link.joints.iter().filter(|(joint, _)| !is_grid(*joint)).copied().collect();
    let centre = joints.iter().map(|(_, position)| position).sum::<Vector>() / joints.len().max(1) as f64;
    let points: Vec<Point> = joints.iter().map(|(_, position)| Point::from(*position)).collect();
    let mut order: Vec<usize> = (0..joints.len()).collect();
    if is_flat(&points) {
        let direction = points.last().zip(points.first()).map_or(Vector::zeros(), |(b, a)| b - a);
        order.sort_by(|&a, &b| direction.dot(&points[a].coords).total_cmp(&direction.dot(&points[b].coords)));
    } else {
        let angle = |k: usize| trig::atan2(joints[k].1.y - centre.y, joints[k].1.x - centre.x);
        order.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)));
    }
    order.into_iter().map(|k| joints[k].0).collect()
}

/// Whether a link with joints at these positions is drawn as a plate: it has three joints or more that are not on one
/// line.
pub fn is_plate(points: &[Point]) -> bool {
    points.len() > 2 && !is_flat(points)
}

/// Whether points lie on one line, to a thousandth of their extent.
fn is_flat(points: &[Point]) -> bool {
    let size = Bounds::from_points(points.iter().copied()).size().norm();
    let Some((first, rest)) = points.split_first() else { return true };
    rest.iter().all(|a| rest.iter().all(|b| cross(a - first, b - first).abs() <= 1e-3 * size * size))
}

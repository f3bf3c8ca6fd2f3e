//! The rotations of the links of a linkage in a pose.

use super::JointDerivatives;
use crate::geometry::{Vector, cross};
use crate::linkage::{JointId, Link, Linkage};

/// The rotation of a moving link.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkRotation<'a> {
    /// The names of its joints.
    pub joints: Vec<&'a str>,
    /// Radians per radian of input, or per unit of length of an actuator.
    pub angular_velocity: f64,
    /// The derivative of the angular velocity by the input.
    pub angular_acceleration: f64,
}

impl<'a> LinkRotation<'a> {
    /// The rotations of the moving links that have two distinct joints.
    pub fn of_links(linkage: &'a Linkage, derivatives: &JointDerivatives) -> Vec<LinkRotation<'a>> {
        let moving = linkage.links.iter().filter(|link| !std::ptr::eq(*link, linkage.ground()));
        let rotation = |link: &'a Link| {
            let (first, position) = *link.joints.first()?;
            let (second, _) = *link.joints.iter().find(|(_, other)| *other != position)?;
            let relative =
                |rate: fn(&JointDerivatives, JointId) -> Vector| rate(derivatives, second) - rate(derivatives, first);
            let arm = derivatives.position(second) - derivatives.position(first);
            let angular = |rate: Vector| cross(arm, rate) / arm.norm_squared();
            Some(LinkRotation {
                joints: link.joints.iter().map(|(joint, _)| linkage.joints[*joint].name.as_str()).collect(),
                angular_velocity: angular(relative(JointDerivatives::velocity)),
                angular_acceleration: angular(relative(JointDerivatives::acceleration)),
            })
        };
        moving.filter_map(rotation).collect()
    }
}

//! How far joints go on bodies.

use super::anchor::Anchor;
use super::body::Body;
use crate::geometry::{Point, Vector, cross, left_normal};
use crate::linkage::{JointId, Linkage};
use crate::measure::circuit_function::{Pose, Quantity, range_over};
use crate::motion::Circuit;

/// The ends of the way of a joint on a body over a circuit, in a direction of the body, a unit vector; `None` if it is nowhere.
pub(super) fn travel(
    body: &Body,
    (joint, direction): (JointId, Vector),
    (linkage, circuit): (&Linkage, &Circuit),
) -> Option<[Point; 2]> {
    let place = PlaceOnBody { anchor: body.anchor, joint, direction };
    let aside = |sample: usize| {
        let at = |joint: JointId| circuit.positions.point(joint, sample);
        cross(direction, place.on_body(&at).coords)
    };
    let aside = left_normal(direction) * (0..circuit.len()).map(aside).find(|aside| aside.is_finite())?;
    Some(range_over(circuit, linkage, &place)?.map(|along| Point::from(direction * along + aside)))
}

/// Where a joint is along a direction of a body, in the coordinates of the body.
#[derive(Clone, Copy, Debug)]
struct PlaceOnBody {
    anchor: Anchor,
    joint: JointId,
    direction: Vector,
}

impl PlaceOnBody {
    /// The joint on the body.
    fn on_body(&self, at: &impl Fn(JointId) -> Point) -> Point {
        self.anchor.plane_from_body(at).inverse().apply(at(self.joint))
    }
}

impl Quantity for PlaceOnBody {
    fn joints(&self) -> Vec<JointId> {
        [self.joint, self.anchor.origin()].into_iter().chain(self.anchor.line()).collect()
    }

    fn value(&self, pose: &Pose) -> f64 {
        self.direction.dot(&self.on_body(&|joint| pose.at(joint)).coords)
    }

    fn sensitivity(&self, pose: &Pose) -> f64 {
        // Both the joint and the body move, and the body turns.
        let [from, to] = self.anchor.line().map(|joint| pose.at(joint));
        2.0 + 2.0 * (pose.at(self.joint) - pose.at(self.anchor.origin())).norm() / (to - from).norm()
    }
}

//! Where a body is in a pose.

use crate::geometry::{Complex, Point, Similarity, Vector, cross};
use crate::linkage::JointId;

/// What of a body says where it is in a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Anchor {
    /// Two of its joints, and where they are on it.
    Joints([(JointId, Point); 2]),
    /// A joint, where it is on the body, and a unit vector of the body that has the direction of a line through two joints.
    Line { joint: (JointId, Point), axis: Vector, line: [JointId; 2] },
}

impl Anchor {
    /// The joint that the body is placed by.
    pub fn origin(&self) -> JointId {
        let (Anchor::Joints([(joint, _), _]) | Anchor::Line { joint: (joint, _), .. }) = *self;
        joint
    }

    /// The joints on the line that the body turns with.
    pub fn line(&self) -> [JointId; 2] {
        match *self {
            Anchor::Joints(joints) => joints.map(|(joint, _)| joint),
            Anchor::Line { line, .. } => line,
        }
    }

    /// Where a body is in a pose.
    pub fn plane_from_body(&self, at: &impl Fn(JointId) -> Point) -> Similarity {
        let (joint, own, posed) = match *self {
            Anchor::Joints([a, b]) => (a, b.1 - a.1, at(b.0) - at(a.0)),
            Anchor::Line { joint, axis, line: [from, to] } => (joint, axis, at(to) - at(from)),
        };
        let turn = posed.normalize();
        let factor = Complex::new(turn.x, turn.y) * Complex::new(own.x, -own.y).unscale(own.norm());
        let [origin, place] = [joint.1, at(joint.0)].map(|p| Complex::new(p.x, p.y));
        Similarity { is_mirrored: false, factor, shift: place - factor * origin }
    }

    /// The anchor of the same body in other coordinates.
    pub fn in_frame(&self, frame: &Frame) -> Anchor {
        match *self {
            Anchor::Joints(joints) => Anchor::Joints(joints.map(|(joint, p)| (joint, frame.coordinates(p)))),
            Anchor::Line { joint: (joint, p), axis, line } => {
                let axis = Vector::new(frame.axis.dot(&axis), cross(frame.axis, axis));
                Anchor::Line { joint: (joint, frame.coordinates(p)), axis, line }
            }
        }
    }
}

/// A frame on a body: an origin and the unit vector of its x-axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    pub origin: Point,
    pub axis: Vector,
}

impl Frame {
    /// The coordinates of a point of the body in the frame.
    pub fn coordinates(&self, p: Point) -> Point {
        /// What products of two coordinates have lost where their difference is 0.
        const ROUNDING: f64 = 4.0 * f64::EPSILON;
        let arm = p - self.origin;
        let without_rounding = |value: f64| if value.abs() <= ROUNDING * arm.norm() { 0.0 } else { value };
        Point::new(without_rounding(self.axis.dot(&arm)), without_rounding(cross(self.axis, arm)))
    }
}

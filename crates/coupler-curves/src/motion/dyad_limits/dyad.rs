//! A dyad and its extent, the length that decides whether it closes.

use super::closed_form::SinusoidalExtent;
use crate::geometry::{cross, left_normal};
use crate::linkage::{DyadId, Input, JointId, JointKind, Link, Linkage};
use crate::motion::interval::{EndCause, IntervalEnd, Span};
use crate::motion::pass::InputPosition;
use crate::motion::series::{Scalar, Series, VectorSeries};

/// A dyad: a joint that can be placed on two sides of its base.
pub(super) struct Dyad {
    pub joint: JointId,
    pub id: DyadId,
    pub kind: JointKind,
}

impl Dyad {
    pub fn from_index(linkage: &Linkage, id: DyadId) -> Dyad {
        let found = linkage.joint_ids().zip(&linkage.joints).find(|(_, joint)| joint.kind.dyad() == Some(id));
        let (joint, kind) = found.map(|(id, joint)| (id, joint.kind)).expect("dyads are numbered without gaps");
        Dyad { joint, id, kind }
    }

    /// The quantity that must be within [`Dyad::extent_bounds`] for the dyad to close: the length of its base, or, for
    /// a slide, the distance of its line from the joint that its link starts at, positive if the line is to the left.
    pub fn extent<T: Scalar, const N: usize>(&self, at: impl Fn(JointId) -> VectorSeries<T, N>) -> Series<T, N> {
        match self.kind {
            JointKind::Dyad { base: [p, q], .. } | JointKind::Slot { base: [p, q], .. } => {
                at(q).minus(at(p)).norm_squared().sqrt()
            }
            JointKind::Slide { from, line: [p, q], offset, .. } => {
                Series::constant(offset) - at(q).minus(at(p)).unit().cross(at(from).minus(at(p)))
            }
            _ => Series::constant(0.0),
        }
    }

    /// Whether its base can have length zero, where its joint is not determined and is placed by continuity.
    pub fn base_can_vanish(&self) -> bool {
        matches!(self.kind, JointKind::Dyad { .. } | JointKind::Slot { offset: 0.0, .. })
    }

    /// The range of a piston's length: from the pose in which crank and frame are folded, or from zero, to that in
    /// which they are stretched. Its ends are numbered from `next_id + 1`.
    pub fn stroke(&self, linkage: &Linkage, next_id: &mut usize) -> Option<Span> {
        let JointKind::Piston { base: [c, o], length, offset, .. } = self.kind else { return None };
        let frame = (linkage.links[0].position(c)? - linkage.links[0].position(o)?).norm();
        let leg = |b: f64| ((b - offset) * (b + offset)).max(0.0).sqrt();
        let (folded, stretched) = (leg((frame - length).abs()), leg(frame + length));
        let mut end = |at: f64| {
            *next_id += 1;
            let input = InputPosition::new(Input::Length, at);
            if at > 0.0 {
                IntervalEnd::from_flat_dyad(input, EndCause::Limit, self.id, *next_id)
            } else {
                IntervalEnd::range_end(input, *next_id)
            }
        };
        let (lower, upper) = (end(folded), end(stretched));
        (folded < stretched).then_some(Span::Range { lower, upper })
    }

    /// The least and the greatest extent with which the dyad closes.
    pub fn extent_bounds(&self) -> [f64; 2] {
        match self.kind {
            JointKind::Dyad { lengths: [l0, l1], .. } => [(l0 - l1).abs(), l0 + l1],
            JointKind::Slot { offset, .. } => [offset.abs(), f64::INFINITY],
            JointKind::Slide { length, .. } => [-length, length],
            _ => [0.0, 0.0],
        }
    }

    /// The extent as a function of the cosine of the crank's angle, if it depends only on the frame and on a point of
    /// the crank's link.
    pub fn sinusoidal_extent(&self, linkage: &Linkage) -> Option<SinusoidalExtent> {
        if linkage.input() != (Input::Angle { turns: 1 }) {
            return None;
        }
        let [pivot, crank] = linkage.crank()?;
        let frame = &linkage.links[0];
        let pivot_position = frame.position(pivot)?;
        let is_crank_link = |link: &&Link| link.position(pivot).is_some() && link.position(crank).is_some();
        let arm = linkage.links[1..].iter().find(is_crank_link)?;
        match self.kind {
            JointKind::Dyad { base: [p, q], .. } | JointKind::Slot { base: [p, q], .. } => {
                let (on_arm, fixed) = match (arm.position(p), frame.position(q), arm.position(q), frame.position(p)) {
                    (Some(on_arm), Some(fixed), ..) | (.., Some(on_arm), Some(fixed)) => (on_arm, fixed),
                    _ => return None,
                };
                Some(SinusoidalExtent::from_base_length(on_arm, fixed - pivot_position, self.extent_bounds()))
            }
            JointKind::Slide { from, line: [p, q], offset, .. } => {
                let (on_arm, p, q) = (arm.position(from)?, frame.position(p)?, frame.position(q)?);
                let along = (q - p).normalize();
                let distance = offset - cross(along, pivot_position - p);
                Some(SinusoidalExtent::from_projection(on_arm, left_normal(along), distance, self.extent_bounds()))
            }
            _ => None,
        }
    }
}

//! A four-bar at its position in the plane.

use super::CognateError;
use crate::geometry::{Point, Vector, cross};
use crate::linkage::{Error, FourBar, JointId, Link, Linkage, LinkageBuilder, MotionOptions, Side};

/// A four-bar at its position in the plane, and a point of its coupler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedFourBar {
    /// The pivot of the crank, and that of the rocker.
    pub pivots: [Point; 2],
    /// The lengths; the frame's is the distance of the pivots.
    pub lengths: FourBar,
    /// The coupler point: along the coupler from the crank pin towards the rocker pin, and to the left of it.
    pub coupler_point: Vector,
}

impl PlacedFourBar {
    /// The four-bar in a linkage, at its position in the reported plane, with one of its joints as the coupler point.
    ///
    /// # Errors
    /// The linkage is not a four-bar, or the joint is not on its coupler.
    pub fn from_linkage(linkage: &Linkage, joint: JointId) -> Result<PlacedFourBar, CognateError> {
        let (Some(pins), Some(lengths)) = (FourBar::pins(linkage), FourBar::from_linkage(linkage)) else {
            return Err(CognateError::NotFourBar);
        };
        let [o, a, b, c] = pins;
        let (Some(from), Some(to), Some(position)) = positions_on_link(linkage, [a, b], joint) else {
            let joint = linkage.joints.get(joint.index()).map_or(String::new(), |joint| joint.name.clone());
            return Err(CognateError::NotOnCoupler { joint });
        };
        let along = (to - from) / lengths.coupler;
        let (m, handedness) = (position - from, linkage.placement.handedness());
        let point = Vector::new(along.dot(&m), cross(along, m) * handedness);
        let pivot = |joint| linkage.links[0].position(joint).map(Point::from);
        let pivots = match (linkage.seen_from, pivot(o), pivot(c)) {
            (None, Some(o), Some(c)) => [o, c],
            // `seen_from` puts the crank's pivot at the origin and the rocker's on the x-axis.
            _ => [Point::origin(), Point::new(lengths.frame, 0.0)],
        };
        Ok(PlacedFourBar {
            pivots: pivots.map(|p| linkage.placement.transform_point(p)),
            lengths,
            coupler_point: point,
        })
    }

    /// The four-bar as a linkage with the joints O, C, A, B and M, of which M is traced, and with the rocker pin on a
    /// side of the directed line from the crank pin to the rocker's pivot.
    ///
    /// # Errors
    /// A length that is not positive.
    pub fn to_linkage(&self, side: Side, options: MotionOptions) -> Result<Linkage, Error> {
        let FourBar { crank, coupler, rocker, .. } = self.lengths;
        let mut builder = LinkageBuilder::default();
        let [o, c] = [("O", self.pivots[0]), ("C", self.pivots[1])].map(|(name, pivot)| builder.fixed(name, pivot));
        let a = builder.crank("A", o, crank)?;
        let b = builder.dyad("B", [a, c], [coupler, rocker], side)?;
        let m = builder.point("M", [a, b], self.coupler_point.x, self.coupler_point.y)?;
        builder.build(vec![m], None, options)
    }

    /// The same four-bar with crank and rocker exchanged.
    pub(super) fn reversed(self) -> PlacedFourBar {
        let FourBar { frame, crank, coupler, rocker } = self.lengths;
        PlacedFourBar {
            pivots: [self.pivots[1], self.pivots[0]],
            lengths: FourBar { frame, crank: rocker, coupler, rocker: crank },
            coupler_point: Vector::new(coupler - self.coupler_point.x, -self.coupler_point.y),
        }
    }
}

/// The positions of two joints and a third on the link that has the first two.
fn positions_on_link(
    linkage: &Linkage,
    base: [JointId; 2],
    joint: JointId,
) -> (Option<Vector>, Option<Vector>, Option<Vector>) {
    let has = |link: &&Link| base.iter().all(|&pin| link.position(pin).is_some());
    let link = linkage.links.iter().find(has);
    let position = |joint| link.and_then(|link| link.position(joint));
    (position(base[0]), position(base[1]), position(joint))
}

//! Velocity, acceleration and jerk of all joints with respect to the input, by Taylor series to the third order.

use std::collections::HashMap;

use super::end_series::EndSeries;
use super::joint_series::{SeriesInput, place_as_series};
use super::pass::{InputPosition, Pass, PassEnd};
use super::series::{Series, VectorSeries};
use crate::geometry::{Orientation, Point, Vector};
use crate::linkage::{AssemblyMode, DyadId, JointId, Linkage};

/// A joint's position and its first three Taylor coefficients.
type JointSeries = VectorSeries<f64, 4>;

/// Positions of all joints at one input and their derivatives per radian, or unit of length, of the input, in the frame
/// the linkage is seen from.
///
/// At a limit the derivatives of the joints that reverse there are infinite, except across a line they are confined to.
#[derive(Clone, Debug)]
pub struct JointDerivatives(Vec<JointSeries>);

impl JointDerivatives {
    /// The derivatives at an input in an assembly mode in which no dyad is flat there, of a linkage without a group.
    ///
    /// # Source
    /// The constraints of each dyad, differentiated as series.
    pub fn new(linkage: &Linkage, input: InputPosition, mode: AssemblyMode) -> JointDerivatives {
        let input = SeriesInput { value: input.value, direction: [input.cos, input.sin] };
        let sign = |dyad: DyadId| f64::from(mode.sign(dyad));
        let all = place_as_series(linkage, linkage.joints.len(), input, sign, |_, position, _| position);
        JointDerivatives(in_view_frame(linkage, all))
    }

    /// The derivatives at an input of a pass. At its ends they are the one-sided ones: unbounded at a limit; finite at
    /// a change point, through which the motion continues smoothly.
    pub fn on_pass(linkage: &Linkage, pass: &Pass, input: f64) -> JointDerivatives {
        let position = InputPosition::new(linkage.input(), input);
        if let Some(track) = &pass.track {
            let is_limit =
                [pass.from, pass.to].iter().any(|end| end.input.value == input && !end.flat_dyads.is_empty());
            let input = SeriesInput { value: position.value, direction: [position.cos, position.sin] };
            let group: HashMap<JointId, JointSeries> = track.series(input, is_limit).into_iter().collect();
            let placed = |joint, position, _: &[JointSeries]| group.get(&joint).copied().unwrap_or(position);
            let all = place_as_series(linkage, linkage.joints.len(), input, |_| 1.0, placed);
            return JointDerivatives(in_view_frame(linkage, all));
        }
        let is_here = |(end, _): &(PassEnd, f64)| end.input.value == input && !end.flat_dyads.is_empty();
        if let Some((end, inwards)) = pass.ends().into_iter().rev().find(is_here) {
            let series = EndSeries::new(linkage, &end, pass.mode, inwards);
            let at = linkage.joint_ids().map(|joint| series.in_input(joint)).collect();
            return JointDerivatives(in_view_frame(linkage, at));
        }
        JointDerivatives::new(linkage, position, pass.mode)
    }

    /// A joint's position.
    pub fn position(&self, joint: JointId) -> Point {
        Point::from(self.coefficient(joint, 0))
    }

    /// A joint's velocity: the derivative of its position with respect to the input, per radian or unit of length.
    pub fn velocity(&self, joint: JointId) -> Vector {
        self.rate(joint, 1)
    }

    /// The greatest finite speed of all joints, to which rounding is relative.
    pub fn greatest_speed(&self) -> f64 {
        let speeds = self.0.iter().map(|joint| Vector::new(joint.x.0[1], joint.y.0[1]).norm());
        speeds.filter(|speed| speed.is_finite()).fold(0.0, f64::max)
    }

    /// A joint's acceleration: the second derivative of its position with respect to the input.
    pub fn acceleration(&self, joint: JointId) -> Vector {
        self.rate(joint, 2) * 2.0
    }

    /// A joint's jerk: the third derivative of its position with respect to the input.
    pub fn jerk(&self, joint: JointId) -> Vector {
        self.rate(joint, 3) * 6.0
    }

    /// A Taylor coefficient; infinite where it depends on an infinite one.
    fn rate(&self, joint: JointId, order: usize) -> Vector {
        self.coefficient(joint, order).map(|rate| if rate.is_nan() { f64::INFINITY } else { rate })
    }

    fn coefficient(&self, joint: JointId, n: usize) -> Vector {
        Vector::new(self.0[joint].x.0[n], self.0[joint].y.0[n])
    }
}

/// The positions and derivatives in the frame they are reported in.
fn in_view_frame(linkage: &Linkage, at: Vec<JointSeries>) -> Vec<JointSeries> {
    let mut at = to_view_frame(linkage, at);
    if linkage.seen_from.is_some() {
        // The joints of the link the linkage is seen from are at rest; their computed derivatives are rounding errors.
        for (joint, _) in &linkage.ground().joints {
            let VectorSeries { x, y } = at[*joint];
            at[*joint] = VectorSeries { x: Series::constant(x.0[0]), y: Series::constant(y.0[0]) };
        }
    }
    at
}

/// Transforms positions and derivatives into the frame they are reported in.
pub(super) fn to_view_frame<const N: usize>(
    linkage: &Linkage,
    mut at: Vec<VectorSeries<f64, N>>,
) -> Vec<VectorSeries<f64, N>> {
    if let Some([origin, end]) = linkage.seen_from {
        let (from, unit) = (at[origin], at[end].minus(at[origin]).unit());
        for place in &mut at {
            let v = place.minus(from);
            *place = VectorSeries { x: unit.dot(v), y: unit.cross(v) };
        }
    }
    if linkage.placement != Orientation::default() {
        for VectorSeries { x, y } in &mut at {
            for n in 0..N {
                let placed = linkage.placement.transform_vector(Vector::new(x.0[n], y.0[n]));
                (x.0[n], y.0[n]) = (placed.x, placed.y);
            }
        }
    }
    at
}

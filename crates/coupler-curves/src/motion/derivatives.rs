//! Velocity, acceleration and jerk of all joints with respect to the input, by Taylor series to the third order.

use super::joint_series::{SeriesInput, place_as_series};
use super::pass::{InputPosition, Pass};
use super::series::{Series, VectorSeries};
use crate::geometry::{Orientation, Point, Vector};
use crate::linkage::{AssemblyMode, DyadId, DyadSet, JointId, JointKind, Linkage};

/// A joint's position and its first three Taylor coefficients.
type JointSeries = VectorSeries<f64, 4>;

/// Positions of all joints at one input and their derivatives per radian, or unit of length, of the input, in the frame
/// the linkage is seen from.
///
/// At a limit the derivatives of the joints that reverse there are infinite, except across a line they are confined to.
#[derive(Clone, Debug)]
pub struct JointDerivatives(Vec<JointSeries>);

impl JointDerivatives {
    /// The derivatives at an input in an assembly mode; those of the dyads in `flat`, which are fully stretched or
    /// folded there, are unbounded.
    ///
    /// # Source
    /// The constraints of each dyad, differentiated as series.
    pub fn new(linkage: &Linkage, input: InputPosition, mode: AssemblyMode, flat: DyadSet) -> JointDerivatives {
        let JointDerivatives(at) = JointDerivatives::in_fixed_frame(linkage, input, mode, flat);
        JointDerivatives(to_view_frame(linkage, at))
    }

    /// The derivatives at an input of a pass. At its ends they are the one-sided ones: unbounded at a limit; finite at
    /// a change point, through which the motion continues smoothly.
    pub fn on_pass(linkage: &Linkage, pass: &Pass, input: f64) -> JointDerivatives {
        for (end, inwards) in [(pass.to, -pass.input_direction()), (pass.from, pass.input_direction())] {
            if end.input.value == input && !end.flat_dyads.is_empty() {
                return JointDerivatives(to_view_frame(
                    linkage,
                    differentiate_joints::<END_TERMS>(linkage, end.input, pass.mode, (end.flat_dyads, inwards)),
                ));
            }
        }
        JointDerivatives::new(linkage, InputPosition::new(linkage.input(), input), pass.mode, DyadSet::EMPTY)
    }

    /// The same as [`JointDerivatives::new`] in the frame of the fixed joints.
    pub(super) fn in_fixed_frame(
        linkage: &Linkage,
        input: InputPosition,
        mode: AssemblyMode,
        flat: DyadSet,
    ) -> JointDerivatives {
        JointDerivatives(differentiate_joints::<4>(linkage, input, mode, (flat, 0.0)))
    }

    /// A joint's position.
    pub fn position(&self, joint: JointId) -> Point {
        Point::from(self.coefficient(joint, 0))
    }

    /// A joint's velocity: the derivative of its position with respect to the input, per radian or unit of length.
    pub fn velocity(&self, joint: JointId) -> Vector {
        self.rate(joint, 1)
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

/// The number of terms of a series at an end of a pass. The square root that places each dyad at a change
/// point there loses one of them.
const END_TERMS: usize = 8;

/// Positions and derivatives in the frame of the fixed joints, by series of `N` terms; `inwards` is 1 where the pass
/// lies at greater inputs than this, -1 where it lies at smaller ones, and 0 where that is not known.
fn differentiate_joints<const N: usize>(
    linkage: &Linkage,
    input: InputPosition,
    mode: AssemblyMode,
    (flat, inwards): (DyadSet, f64),
) -> Vec<JointSeries> {
    let input = SeriesInput { value: input.value, direction: [input.cos, input.sin] };
    let sign = |dyad: DyadId| if flat.contains(dyad) { 0.0 } else { f64::from(mode.sign(dyad)) };
    let adjust = |joint: JointId, position: VectorSeries<f64, N>, at: &[VectorSeries<f64, N>]| {
        let kind = linkage.joints[joint].kind;
        let Some(dyad) = kind.dyad().filter(|dyad| flat.contains(*dyad)) else { return position };
        let Some(DyadHeight { direction, height_squared, magnitude }) = dyad_height(kind, at) else {
            return position;
        };
        let side = f64::from(mode.sign(dyad)) * inwards;
        match height_squared.sqrt_at_touch(magnitude).filter(|_| side != 0.0) {
            Some(height) => position.moved(direction, height.scaled(side), Series::constant(0.0)),
            None => with_unbounded_derivatives(position, direction),
        }
    };
    let all = place_as_series(linkage, linkage.joints.len(), input, sign, adjust);
    let truncated = |series: Series<f64, N>| Series(std::array::from_fn(|n| series.0[n]));
    all.into_iter().map(|at: VectorSeries<f64, N>| VectorSeries { x: truncated(at.x), y: truncated(at.y) }).collect()
}

/// The distance of a dyad's joint from its position in the flat dyad, as `sqrt(height_squared) * direction`.
struct DyadHeight<const N: usize> {
    /// Along a slider's line or perpendicular to a base; of any length.
    direction: VectorSeries<f64, N>,
    /// The square of the distance divided by the squared length of the direction.
    height_squared: Series<f64, N>,
    /// The magnitude of the terms whose sum is `height_squared`, to which its rounding errors are relative.
    magnitude: f64,
}

/// The height of a dyad over its flat pose; `None` for a joint that is not a dyad's, and for a slot without offset.
fn dyad_height<const N: usize>(kind: JointKind, at: &[VectorSeries<f64, N>]) -> Option<DyadHeight<N>> {
    let between = |[p, q]: [JointId; 2]| at[q].minus(at[p]);
    let left_normal = |base: VectorSeries<f64, N>| VectorSeries { x: -base.y, y: base.x };
    let number = |value: f64| Series::constant(value);
    match kind {
        // The foot of a slot without offset is its pivot.
        JointKind::Slot { offset: 0.0, .. } => None,
        JointKind::Slot { base, offset, .. } => {
            let base = between(base);
            let d2 = base.norm_squared();
            let height2 = ((d2 - number(offset * offset)) / d2.square()).scaled(offset * offset);
            // The foot is to the left of the base for a positive offset.
            let direction = left_normal(base);
            let sense = offset.signum();
            let direction = VectorSeries { x: direction.x.scaled(sense), y: direction.y.scaled(sense) };
            Some(DyadHeight { direction, height_squared: height2, magnitude: 1.0 })
        }
        JointKind::Slide { from, length, line, offset, .. } => {
            let unit = between(line).unit();
            let h = number(offset) - unit.cross(at[from].minus(at[line[0]]));
            let height2 = (number(length) - h) * (number(length) + h);
            Some(DyadHeight { direction: unit, height_squared: height2, magnitude: length * length })
        }
        JointKind::Dyad { base, lengths: [l0, l1], .. } => {
            let base = between(base);
            let (sum, difference) = (number(l0 + l1), number(l0 - l1));
            let d2 = base.norm_squared();
            let d = d2.sqrt();
            let product = (sum - d) * (sum + d) * ((d - difference) * (d + difference));
            Some(DyadHeight {
                direction: left_normal(base),
                height_squared: product.scaled(0.25) / d2.square(),
                magnitude: 1.0,
            })
        }
        JointKind::Piston { base, .. } => {
            let unknown = Series([f64::NAN; N]);
            Some(DyadHeight { direction: left_normal(between(base)), height_squared: unknown, magnitude: 1.0 })
        }
        _ => None,
    }
}

/// The same position with derivatives that are unbounded along `direction`. Across it the velocity is bounded, and if
/// the direction is constant, so are the higher derivatives.
fn with_unbounded_derivatives<const N: usize>(
    at: VectorSeries<f64, N>,
    direction: VectorSeries<f64, N>,
) -> VectorSeries<f64, N> {
    let unbounded = |position: Series<f64, N>, along: Series<f64, N>, across: Series<f64, N>| {
        let bounded = match along.0 {
            _ if along.0[0] != 0.0 || across.0[0] == 0.0 => 1,
            along if along.iter().any(|c| *c != 0.0) => 2,
            _ => N,
        };
        Series(std::array::from_fn(|n| if n < bounded { position.0[n] } else { f64::INFINITY }))
    };
    VectorSeries { x: unbounded(at.x, direction.x, direction.y), y: unbounded(at.y, direction.y, direction.x) }
}

/// Transforms positions and derivatives into the frame they are reported in.
fn to_view_frame(linkage: &Linkage, mut at: Vec<JointSeries>) -> Vec<JointSeries> {
    if let Some([origin, end]) = linkage.seen_from {
        let (from, unit) = (at[origin], at[end].minus(at[origin]).unit());
        for place in &mut at {
            let v = place.minus(from);
            *place = VectorSeries { x: unit.dot(v), y: unit.cross(v) };
        }
        // The joints of the link the linkage is seen from are at rest; their computed derivatives are rounding errors.
        for (joint, _) in &linkage.ground().joints {
            let VectorSeries { x, y } = at[*joint];
            at[*joint] = VectorSeries { x: Series::constant(x.0[0]), y: Series::constant(y.0[0]) };
        }
    }
    if linkage.placement != Orientation::default() {
        for VectorSeries { x, y } in &mut at {
            for n in 0..4 {
                let placed = linkage.placement.transform_vector(Vector::new(x.0[n], y.0[n]));
                (x.0[n], y.0[n]) = (placed.x, placed.y);
            }
        }
    }
    at
}

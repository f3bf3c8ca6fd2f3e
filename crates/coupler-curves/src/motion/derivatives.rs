//! Velocity, acceleration and jerk of every joint with respect to the input, by Taylor series to the third order.

use super::circuit::{InputPosition, Pass};
use super::joint_series::{SeriesInput, place_as_series};
use super::series::{Series, VectorSeries};
use crate::geometry::{Orientation, Point, Vector};
use crate::linkage::{AssemblyMode, DyadSet, JointId, JointKind, Linkage};

/// A joint's place and its first three rates.
type JointSeries = VectorSeries<f64, 4>;

/// Places and rates of all joints at one input, to a radian of it or to a unit of its length, in the frame the linkage is seen from.
///
/// At a limit the rates of the joints that turn round there are infinite, but across a line they keep to.
#[derive(Clone, Debug)]
pub struct JointDerivatives(Vec<JointSeries>);

impl JointDerivatives {
    /// The rates at an input in an assembly; of the dyads in `flat`, which lie flat there, they are unbounded.
    ///
    /// # Source
    /// The constraints of each dyad, differentiated as series.
    pub fn new(linkage: &Linkage, stop: InputPosition, signs: AssemblyMode, flat: DyadSet) -> JointDerivatives {
        let JointDerivatives(at) = JointDerivatives::in_fixed_frame(linkage, stop, signs, flat);
        JointDerivatives(to_view_frame(linkage, at))
    }

    /// The rates at an input of a pass. At its ends they are those of the pass: at a limit unbounded, at a change point,
    /// through which the motion goes on smoothly, as they are beside it.
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
        stop: InputPosition,
        signs: AssemblyMode,
        flat: DyadSet,
    ) -> JointDerivatives {
        JointDerivatives(differentiate_joints::<4>(linkage, stop, signs, (flat, 0.0)))
    }

    /// Where a joint is.
    pub fn position(&self, joint: JointId) -> Point {
        Point::from(self.coefficient(joint, 0))
    }

    /// A joint's velocity: the change of its place to a radian, or a unit, of input.
    pub fn velocity(&self, joint: JointId) -> Vector {
        self.rate(joint, 1)
    }

    /// A joint's acceleration: the second derivative of its place by the input.
    pub fn acceleration(&self, joint: JointId) -> Vector {
        self.rate(joint, 2) * 2.0
    }

    /// A joint's jerk: the third derivative of its place by the input.
    pub fn jerk(&self, joint: JointId) -> Vector {
        self.rate(joint, 3) * 6.0
    }

    /// Infinite where anything the rate depends on is.
    fn rate(&self, joint: JointId, order: usize) -> Vector {
        self.coefficient(joint, order).map(|rate| if rate.is_nan() { f64::INFINITY } else { rate })
    }

    fn coefficient(&self, joint: JointId, n: usize) -> Vector {
        Vector::new(self.0[joint].x.0[n], self.0[joint].y.0[n])
    }
}

/// Terms of a series at an end of a pass: each dyad that touches its flat pose there takes one of them.
const END_TERMS: usize = 8;

/// Places and rates in the frame of the fixed joints, by series of `N` terms; `inwards` is 1 where the motion is at greater
/// inputs than this, -1 where it is at smaller ones, and 0 where that is not known.
fn differentiate_joints<const N: usize>(
    linkage: &Linkage,
    stop: InputPosition,
    signs: AssemblyMode,
    (flat, inwards): (DyadSet, f64),
) -> Vec<JointSeries> {
    let drive = SeriesInput { value: stop.value, direction: [stop.cos, stop.sin] };
    let mode = |dyad: usize| if flat.contains(dyad) { 0.0 } else { f64::from(signs.sign(dyad)) };
    let settle = |joint: JointId, place: VectorSeries<f64, N>, at: &[VectorSeries<f64, N>]| {
        let step = linkage.joints[joint].kind;
        let Some(index) = step.dyad_index().filter(|index| flat.contains(*index)) else { return place };
        let Some(DyadHeight { direction, height_squared: height2, magnitude: size }) = dyad_height(step, at) else {
            return place;
        };
        let way = f64::from(signs.sign(index)) * inwards;
        match height2.sqrt_at_touch(size).filter(|_| way != 0.0) {
            Some(height) => place.moved(direction, height.scaled(way), Series::constant(0.0)),
            None => with_unbounded_rates(place, direction),
        }
    };
    let all = place_as_series(linkage, linkage.joints.len(), drive, mode, settle);
    let first = |place: Series<f64, N>| Series(std::array::from_fn(|n| place.0[n]));
    all.into_iter().map(|at: VectorSeries<f64, N>| VectorSeries { x: first(at.x), y: first(at.y) }).collect()
}

/// How a dyad's joint stands off from where it is when the dyad lies flat.
struct DyadHeight<const N: usize> {
    /// Where to: along a slider's line, or square to a base, of any length.
    direction: VectorSeries<f64, N>,
    /// The square of how far, in lengths of the direction.
    height_squared: Series<f64, N>,
    /// The size of the terms that the square is made of.
    magnitude: f64,
}

fn dyad_height<const N: usize>(step: JointKind, at: &[VectorSeries<f64, N>]) -> Option<DyadHeight<N>> {
    let between = |[p, q]: [JointId; 2]| at[q].minus(at[p]);
    let square_to = |base: VectorSeries<f64, N>| VectorSeries { x: -base.y, y: base.x };
    let number = |value: f64| Series::constant(value);
    match step {
        // The foot of a slot without offset is its pivot.
        JointKind::Slot { offset: 0.0, .. } => None,
        JointKind::Slot { base, offset, .. } => {
            let base = between(base);
            let d2 = base.norm_squared();
            let height2 = ((d2 - number(offset * offset)) / d2.square()).scaled(offset * offset);
            // The foot is to the left of the base for a positive offset.
            let direction = square_to(base);
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
                direction: square_to(base),
                height_squared: product.scaled(0.25) / d2.square(),
                magnitude: 1.0,
            })
        }
        JointKind::Piston { base, .. } => {
            let none = Series([f64::NAN; N]);
            Some(DyadHeight { direction: square_to(between(base)), height_squared: none, magnitude: 1.0 })
        }
        _ => None,
    }
}

/// The same place with rates that have no bound, but across the direction they have none in: there the velocity has one,
/// and all rates where the direction stays.
fn with_unbounded_rates<const N: usize>(
    at: VectorSeries<f64, N>,
    direction: VectorSeries<f64, N>,
) -> VectorSeries<f64, N> {
    let rates = |place: Series<f64, N>, along: Series<f64, N>, across: Series<f64, N>| {
        let bounded = match along.0 {
            _ if along.0[0] != 0.0 || across.0[0] == 0.0 => 1,
            along if along.iter().any(|c| *c != 0.0) => 2,
            _ => N,
        };
        Series(std::array::from_fn(|n| if n < bounded { place.0[n] } else { f64::INFINITY }))
    };
    VectorSeries { x: rates(at.x, direction.x, direction.y), y: rates(at.y, direction.y, direction.x) }
}

/// Places and rates in the plane they are reported in.
fn to_view_frame(linkage: &Linkage, mut at: Vec<JointSeries>) -> Vec<JointSeries> {
    if let Some([origin, end]) = linkage.seen_from {
        let (from, unit) = (at[origin], at[end].minus(at[origin]).unit());
        for place in &mut at {
            let v = place.minus(from);
            *place = VectorSeries { x: unit.dot(v), y: unit.cross(v) };
        }
        // What is on the link seen from is at rest, but for rounding.
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

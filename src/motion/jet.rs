//! Velocity, acceleration and jerk of every joint with respect to the input, by Taylor series to the third order.

use super::chain::{Drive, chain};
use super::circuit::Stop;
use super::series::{Planar, Series};
use crate::geometry::{Placement, Point, Vector};
use crate::linkage::{Flat, JointId, Linkage, Signs, Step};

/// A joint's place and its first three rates.
type Jet = Planar<f64, 4>;

/// Places and rates of all joints at one input, to a radian of it or to a unit of its length, in the frame the linkage is seen from.
///
/// At a limit the rates of the joints that turn round there are infinite.
#[derive(Clone, Debug)]
pub struct Jets(Vec<Jet>);

impl Jets {
    /// The rates at an input in an assembly; `flat` are the dyads that lie flat there.
    ///
    /// # Source
    /// The constraints of each dyad, differentiated as series.
    pub fn of(linkage: &Linkage, stop: Stop, signs: Signs, flat: Flat) -> Jets {
        let Jets(at) = Jets::in_fixed_frame(linkage, stop, signs, flat);
        Jets(seen(linkage, at))
    }

    /// The same in the frame of the fixed joints.
    pub(super) fn in_fixed_frame(linkage: &Linkage, stop: Stop, signs: Signs, flat: Flat) -> Jets {
        let drive = Drive { at: stop.at, direction: [stop.cos, stop.sin] };
        let mode = |dyad: usize| if flat.has(dyad) { 0.0 } else { f64::from(signs.get(dyad)) };
        let settle = |joint: JointId, place: Jet, at: &[Jet]| {
            let between = |p: JointId, q: JointId| at[q].minus(at[p]);
            // Where it goes to and fro at its limit: along its line, or square to its base.
            match linkage.joints[joint].step {
                // The foot of a slot without offset is its pivot.
                Step::Slot { offset: 0.0, .. } => place,
                Step::Slide { line: [p, q], index, .. } if flat.has(index) => unbounded(place, between(p, q)),
                Step::Dyad { base: [p, q], index, .. }
                | Step::Slot { base: [p, q], index, .. }
                | Step::Piston { base: [p, q], index, .. }
                    if flat.has(index) =>
                {
                    let base = between(p, q);
                    unbounded(place, Planar { x: -base.y, y: base.x })
                }
                _ => place,
            }
        };
        Jets(chain(linkage, linkage.joints.len(), drive, mode, settle))
    }

    /// Where a joint is.
    pub fn place(&self, joint: JointId) -> Point {
        Point::from(self.order(joint, 0))
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
        self.order(joint, order).map(|rate| if rate.is_nan() { f64::INFINITY } else { rate })
    }

    fn order(&self, joint: JointId, n: usize) -> Vector {
        Vector::new(self.0[joint].x.0[n], self.0[joint].y.0[n])
    }
}

/// The same place with rates that have no bound, but across the direction they have none in: there the velocity has one,
/// and all rates where the direction stays.
fn unbounded(at: Jet, direction: Jet) -> Jet {
    let none = f64::INFINITY;
    let rates = |place: Series<f64, 4>, along: Series<f64, 4>, across: Series<f64, 4>| match along.0 {
        [0.0, 0.0, 0.0, 0.0] if across.0[0] != 0.0 => place,
        [0.0, ..] if across.0[0] != 0.0 => Series([place.0[0], place.0[1], none, none]),
        _ => Series([place.0[0], none, none, none]),
    };
    Planar { x: rates(at.x, direction.x, direction.y), y: rates(at.y, direction.y, direction.x) }
}

/// Places and rates in the plane they are reported in.
fn seen(linkage: &Linkage, mut at: Vec<Jet>) -> Vec<Jet> {
    if let Some([origin, end]) = linkage.seen_from {
        let (from, unit) = (at[origin], at[end].minus(at[origin]).unit());
        for place in &mut at {
            let v = place.minus(from);
            *place = Planar { x: unit.dot(v), y: unit.cross(v) };
        }
        // What is on the link seen from is at rest, but for rounding.
        for (joint, _) in &linkage.ground().joints {
            let Planar { x, y } = at[*joint];
            at[*joint] = Planar { x: Series::constant(x.0[0]), y: Series::constant(y.0[0]) };
        }
    }
    if linkage.placement != Placement::default() {
        for Planar { x, y } in &mut at {
            for n in 0..4 {
                let placed = linkage.placement.vector(Vector::new(x.0[n], y.0[n]));
                (x.0[n], y.0[n]) = (placed.x, placed.y);
            }
        }
    }
    at
}

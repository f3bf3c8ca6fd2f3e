//! Rates of change of every joint with respect to the input, to the third order, by Taylor series.
//!
//! A [`Jet`] is the beginning of a Taylor series in the input. Sums, products, quotients and roots of series are exact
//! to their order, so that what comes out are derivatives in closed form and not differences.

use std::ops::{Add, Mul, Neg, Sub};

use super::circuit::Stop;
use super::kernel::geared;
use crate::geometry::{Point, Vector, trig};
use crate::linkage::{Flat, JointId, Linkage, Signs, Step};

/// The coefficients of 1, t, t^2 and t^3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Jet([f64; 4]);

impl Jet {
    fn constant(value: f64) -> Jet {
        Jet([value, 0.0, 0.0, 0.0])
    }

    fn over(self, divisor: Jet) -> Jet {
        let mut q = [0.0; 4];
        for n in 0..4 {
            let carried: f64 = (1..=n).map(|k| divisor.0[k] * q[n - k]).sum();
            q[n] = (self.0[n] - carried) / divisor.0[0];
        }
        Jet(q)
    }

    fn sqrt(self) -> Jet {
        let mut r = [self.0[0].max(0.0).sqrt(), 0.0, 0.0, 0.0];
        for n in 1..4 {
            let carried: f64 = (1..n).map(|k| r[k] * r[n - k]).sum();
            r[n] = (self.0[n] - carried) / (2.0 * r[0]);
        }
        Jet(r)
    }

    fn scaled(self, by: f64) -> Jet {
        Jet(self.0.map(|c| c * by))
    }
}

impl Add for Jet {
    type Output = Jet;
    fn add(self, other: Jet) -> Jet {
        Jet(std::array::from_fn(|n| self.0[n] + other.0[n]))
    }
}

impl Sub for Jet {
    type Output = Jet;
    fn sub(self, other: Jet) -> Jet {
        Jet(std::array::from_fn(|n| self.0[n] - other.0[n]))
    }
}

impl Mul for Jet {
    type Output = Jet;
    fn mul(self, other: Jet) -> Jet {
        Jet(std::array::from_fn(|n| (0..=n).map(|k| self.0[k] * other.0[n - k]).sum()))
    }
}

impl Neg for Jet {
    type Output = Jet;
    fn neg(self) -> Jet {
        self.scaled(-1.0)
    }
}

/// A place, or a difference of places, as it changes with the input.
#[derive(Clone, Copy, Debug, PartialEq)]
struct JetVector {
    x: Jet,
    y: Jet,
}

impl JetVector {
    fn constant(v: Vector) -> JetVector {
        JetVector { x: Jet::constant(v.x), y: Jet::constant(v.y) }
    }

    fn minus(self, other: JetVector) -> JetVector {
        JetVector { x: self.x - other.x, y: self.y - other.y }
    }

    /// This place, moved `along` times a vector and `across` times its left normal.
    fn moved(self, by: JetVector, along: Jet, across: Jet) -> JetVector {
        JetVector { x: self.x + along * by.x - across * by.y, y: self.y + along * by.y + across * by.x }
    }

    fn dot(self, other: JetVector) -> Jet {
        self.x * other.x + self.y * other.y
    }

    fn cross(self, other: JetVector) -> Jet {
        self.x * other.y - self.y * other.x
    }

    fn order(self, n: usize) -> Vector {
        Vector::new(self.x.0[n], self.y.0[n])
    }
}

/// Places and rates of all joints at one input, to a radian of it or to a unit of its length, in the frame the linkage is seen from.
///
/// At a limit the rates of the joints that turn round there are infinite.
#[derive(Clone, Debug)]
pub struct Jets(Vec<JetVector>);

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
        // A crank's direction as it turns `by` radians to a radian of input.
        let turning = |(cos, sin): (f64, f64), by: f64| JetVector {
            x: Jet([cos, -sin * by, -cos * by * by / 2.0, sin * by * by * by / 6.0]),
            y: Jet([sin, cos * by, -sin * by * by / 2.0, -cos * by * by * by / 6.0]),
        };
        let none = Jet::constant(0.0);
        let mut at: Vec<JetVector> = Vec::with_capacity(linkage.joints.len());
        for joint in &linkage.joints {
            let unbounded = joint.step.index().is_some_and(|index| flat.has(index));
            let mode = |index: usize| if unbounded { 0.0 } else { f64::from(signs.get(index)) };
            let place = match joint.step {
                Step::Fixed(place) => JetVector::constant(place.coords),
                Step::Crank { pivot, length } => {
                    at[pivot].moved(turning((stop.cos, stop.sin), 1.0), Jet::constant(length), none)
                }
                Step::Gear { pivot, length, ratio, phase_deg } => {
                    let direction = trig::cos_sin_deg(geared(stop.at, ratio, phase_deg));
                    let by = ratio[0] as f64 / ratio[1] as f64;
                    at[pivot].moved(turning(direction, by), Jet::constant(length), none)
                }
                Step::Piston { base, length, offset, index } => {
                    let s = Jet([stop.at, 1.0, 0.0, 0.0]);
                    let b = (s * s + Jet::constant(offset * offset)).sqrt();
                    dyad(base.map(|j| at[j]), [b, Jet::constant(length)], mode(index))
                }
                Step::Dyad { base, lengths, index } => {
                    dyad(base.map(|j| at[j]), lengths.map(Jet::constant), mode(index))
                }
                Step::Slide { from, length, line: [p, q], offset, index } => {
                    let line = at[q].minus(at[p]);
                    let d = line.dot(line).sqrt();
                    let unit = JetVector { x: line.x.over(d), y: line.y.over(d) };
                    let h = Jet::constant(offset) - unit.cross(at[from].minus(at[p]));
                    let length = Jet::constant(length);
                    let along = ((length - h) * (length + h)).sqrt().scaled(mode(index));
                    at[from].moved(unit, along, h)
                }
                Step::Slot { base: [p, q], offset, index } => {
                    let base = at[q].minus(at[p]);
                    let d2 = base.dot(base);
                    let along = Jet::constant(offset * offset).over(d2);
                    let across = (d2 - Jet::constant(offset * offset)).sqrt().over(d2).scaled(offset * mode(index));
                    at[p].moved(base, along, across)
                }
                Step::Rigid { base: [p, q], along, across } => {
                    at[p].moved(at[q].minus(at[p]), Jet::constant(along), Jet::constant(across))
                }
                Step::Directed { base: [p, q], along, across } => {
                    let base = at[q].minus(at[p]);
                    let d = base.dot(base).sqrt();
                    at[p].moved(base, Jet::constant(along).over(d), Jet::constant(across).over(d))
                }
            };
            at.push(if unbounded { infinite(place) } else { place });
        }
        Jets(at)
    }

    /// Where a joint is.
    pub fn place(&self, joint: JointId) -> Point {
        Point::from(self.0[joint].order(0))
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
        self.0[joint].order(order).map(|rate| if rate.is_nan() { f64::INFINITY } else { rate })
    }
}

/// The third corner of a triangle of two links on a base, as the kernel places it.
fn dyad([p, q]: [JetVector; 2], [l0, l1]: [Jet; 2], mode: f64) -> JetVector {
    let base = q.minus(p);
    let d2 = base.dot(base);
    let d = d2.sqrt();
    let (sum, difference) = (l0 + l1, l0 - l1);
    let discriminant = (sum - d) * (sum + d) * (d - difference) * (d + difference);
    let along = (d2 + sum * difference).over(d2).scaled(0.5);
    let across = discriminant.sqrt().over(d2).scaled(0.5 * mode);
    p.moved(base, along, across)
}

/// The same place with rates that have no bound.
fn infinite(at: JetVector) -> JetVector {
    let unbounded = |jet: Jet| Jet([jet.0[0], f64::INFINITY, f64::INFINITY, f64::INFINITY]);
    JetVector { x: unbounded(at.x), y: unbounded(at.y) }
}

/// Places and rates in the frame the linkage is seen from.
fn seen(linkage: &Linkage, at: Vec<JetVector>) -> Vec<JetVector> {
    let Some([origin, end]) = linkage.seen_from else { return at };
    let axis = at[end].minus(at[origin]);
    let length = axis.dot(axis).sqrt();
    let unit = JetVector { x: axis.x.over(length), y: axis.y.over(length) };
    let turned = |v: JetVector| JetVector { x: unit.dot(v), y: unit.cross(v) };
    at.iter().map(|place| turned(place.minus(at[origin]))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_multiply_divide_and_take_roots() {
        let t = Jet([2.0, 1.0, 0.0, 0.0]);
        assert_eq!((t * t * t).0, [8.0, 12.0, 6.0, 1.0]);
        assert_eq!((t * t).over(t).0, t.0);
        assert_eq!((t * t).sqrt().0, t.0);
        // 1 / t = 1/2 - (t-2)/4 + (t-2)^2/8 - (t-2)^3/16
        assert_eq!(Jet::constant(1.0).over(t).0, [0.5, -0.25, 0.125, -0.0625]);
    }
}

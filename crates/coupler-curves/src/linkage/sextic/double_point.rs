//! A double point of a coupler curve, and its kind.

use crate::geometry::{Point, Vector, cross, left_normal};
use crate::linkage::FourBar;

/// A double point of a coupler curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoublePoint {
    /// Its position.
    pub point: Point,
    /// Its kind.
    pub kind: DoublePointKind,
}

/// The kinds of double points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DoublePointKind {
    /// Two branches of the curve cross.
    Crunode,
    /// Two branches of the curve touch.
    Tacnode,
    /// A branch ends and goes on in the direction it came from.
    Cusp,
    /// An isolated point, which satisfies the equation but which the coupler point does not reach.
    Acnode,
}

impl DoublePointKind {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            DoublePointKind::Crunode => "crunode",
            DoublePointKind::Tacnode => "tacnode",
            DoublePointKind::Cusp => "cusp",
            DoublePointKind::Acnode => "acnode",
        }
    }
}

/// The kind of a double point, by the poses in which the coupler point is there: a pin is on two circles, about its pivot and about the
/// coupler point, which meet in two points, or touch at a cusp.
pub(super) fn poses_kind(four_bar: FourBar, coupler_point: Vector, at: Point) -> DoublePointKind {
    /// The square of half the distance of the two places of the pin at a cusp, relative to that of its link: the rounding of the
    /// double point.
    const ROUNDING: f64 = 1e-9;
    let FourBar { frame, crank, coupler, rocker } = four_bar;
    let pivots = [Point::origin(), Point::new(frame, 0.0)];
    // Each link with its pivot and, along the coupler, its pin; of the two the one whose pivot is further away, for the coupler point
    // may pass a pivot.
    let dyads = [(pivots[0], crank, 0.0), (pivots[1], rocker, coupler)];
    let (pivot, link, pin_along) = dyads[usize::from(at.x < frame / 2.0)];
    let from_pin = coupler_point - Vector::new(pin_along, 0.0);
    let away = at - pivot;
    let along = (away.norm_squared() + link * link - from_pin.norm_squared()) / (2.0 * away.norm());
    let square = link * link - along * along;
    if square < -ROUNDING * link * link {
        return DoublePointKind::Acnode;
    }
    if square <= ROUNDING * link * link {
        return DoublePointKind::Cusp;
    }
    let unit = away / away.norm();
    branches_kind([-1.0, 1.0].map(|side: f64| {
        let pin = pivot + unit * along + left_normal(unit) * (side * square.sqrt());
        // The direction of the coupler, from that of the line from the pin to the point.
        let offset = at - pin;
        let direction = Vector::new(offset.dot(&from_pin), cross(from_pin, offset)) / from_pin.norm_squared();
        let pins = [0.0, coupler].map(|other| pin + direction * (other - pin_along));
        // The angular velocities of crank and coupler, in a ratio by which the rocker pin moves across the rocker.
        let arms = [pins[0] - pivots[0], pins[1] - pivots[1]];
        let rates = [arms[1].dot(&left_normal(direction * coupler)), -arms[1].dot(&left_normal(arms[0]))];
        left_normal(arms[0]) * rates[0] + left_normal(at - pins[0]) * rates[1]
    }))
}

/// The kind of a point through which the curve passes twice, in two directions.
pub(super) fn branches_kind([a, b]: [Vector; 2]) -> DoublePointKind {
    /// The sine of the angle of two tangents that are the same but for rounding.
    const ROUNDING: f64 = 1e-9;
    let sine = cross(a, b).abs() / (a.norm() * b.norm());
    match sine {
        // The coupler point is an instant centre.
        sine if sine.is_nan() => DoublePointKind::Cusp,
        sine if sine <= ROUNDING => DoublePointKind::Tacnode,
        _ => DoublePointKind::Crunode,
    }
}

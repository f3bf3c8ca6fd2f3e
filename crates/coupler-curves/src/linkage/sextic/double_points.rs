//! The double points of a coupler curve.

use super::roots::periodic_zeros;
use super::{EquationTerms, Sextic};
use crate::geometry::{Point, Vector, cross, left_normal, trig};
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

impl Sextic {
    /// The real double points: at most three, and one for each change point of the linkage.
    ///
    /// The three lie on the circle through both pivots and the third singular focus; if the coupler point is on the
    /// line of pins, they lie on the line of pivots.
    ///
    /// # Source
    /// At a double point the two equations for the coupler's direction coincide (Natesan 6.4): the right side of (6.5)
    /// vanishes. Its kind is that of the poses in which the coupler point is there.
    pub fn double_points(&self) -> Vec<DoublePoint> {
        /// Of a difference of two squares of lengths.
        const ROUNDING: f64 = 1e-12;
        let EquationTerms { frame, dot, cross: sine, u, v } = self.terms;
        // Zero where the lines of both equations coincide: on the circle their normals are parallel, and this is the
        // difference of their distances.
        let agreement = |p: Point| {
            let e1 = p.coords.norm_squared() + u[1];
            let e2 = (p - Point::new(frame, 0.0)).norm_squared() + v[1];
            let far = p - Point::new(frame, 0.0);
            // The second normal is the first times this over |p|^2; computed about the pivot that is further away.
            let turned = far * dot + left_normal(far) * -sine;
            if p.coords.norm_squared() > far.norm_squared() {
                e1 * turned.dot(&p.coords) - e2 * u[0] * p.coords.norm_squared()
            } else {
                let back = p.coords * dot + left_normal(p.coords) * sine;
                e1 * v[0] * far.norm_squared() - e2 * back.dot(&far)
            }
        };
        let is_line = sine.abs() <= 1e-12 * dot.abs();
        let at = |t: f64| {
            if is_line {
                // The whole line, parametrised by the tangent of half the angle.
                Point::new(frame * (0.5 + trig::tan(t / 2.0)), 0.0)
            } else {
                let centre = Point::new(frame / 2.0, frame * dot / (2.0 * sine));
                let radius = (centre.coords).norm();
                Point::new(centre.x + radius * trig::cos(t), centre.y + radius * trig::sin(t))
            }
        };
        let mut found: Vec<DoublePoint> = Vec::new();
        let flat = self.change_points.iter().map(|flat| (flat.point, flat.kind));
        // The pivots are on the circle too, and agree for any linkage; double points are those that the coupler point can be at.
        let pivots = [(Point::origin(), u), (Point::new(frame, 0.0), v)];
        let passed =
            pivots.iter().filter(|(_, [square, excess])| excess.abs() <= ROUNDING * square).map(|(pivot, _)| *pivot);
        let is_pivot = |p: Point| pivots.iter().any(|(pivot, _)| (p - pivot).norm() <= 1e-9 * frame);
        let zeros = periodic_zeros(|t| agreement(at(t))).into_iter().map(at).filter(|p| !is_pivot(*p));
        let in_poses = passed.chain(zeros).map(|p| (p, poses_kind(self.four_bar, self.point, p)));
        for (point, kind) in flat.chain(in_poses) {
            let is_new = found.iter().all(|other| (other.point - point).norm() > 1e-6 * (frame + point.coords.norm()));
            let [value, terms] = self.evaluate(point);
            if is_new && point.x.is_finite() && value.abs() <= 1e-9 * terms {
                found.push(DoublePoint { point, kind });
            }
        }
        found
    }
}

/// The kind of a double point, by the poses in which the coupler point is there: a pin is on two circles, about its pivot and about the
/// coupler point, which meet in two points, or touch at a cusp.
fn poses_kind(four_bar: FourBar, coupler_point: Vector, at: Point) -> DoublePointKind {
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

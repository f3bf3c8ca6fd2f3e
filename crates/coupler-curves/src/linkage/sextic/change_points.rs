//! The points of a coupler curve at which all links lie on one line.

use super::double_point::{DoublePoint, DoublePointKind, branches_kind};
use crate::geometry::{Point, Vector, left_normal};
use crate::linkage::{FourBar, length_tolerance};

/// The positions of the coupler point at the change points of a four-bar, where its motion may continue on either
/// branch.
///
/// With a, b and c the links along the line, each with the sign of its direction, and their angular velocities, of which those of
/// the crank and the coupler are p and q, the loop stays closed to the first order for a p + b q = c r and to the second for
/// a p^2 + b q^2 = c r^2: p and q are in one of two ratios, or in none, if the linkage is locked.
pub(super) fn change_points(four_bar: FourBar, point: Vector) -> Vec<DoublePoint> {
    let FourBar { frame, crank, coupler, rocker } = four_bar;
    let tolerance = length_tolerance(frame + crank + coupler + rocker);
    let lines = (0..8).map(|k| [1, 2, 4].map(|bit| if k & bit == 0 { 1.0 } else { -1.0 }));
    let flat = lines.filter(|[a, b, c]| (a * crank + b * coupler - c * rocker - frame).abs() <= tolerance);
    let double_point = |[along_crank, along_coupler, along_rocker]: [f64; 3]| {
        let [a, b, c] = [along_crank * crank, along_coupler * coupler, along_rocker * rocker];
        let (pin, offset) = (Vector::new(a, 0.0), point * along_coupler);
        let discriminant = a * b * c * frame;
        let kind = if discriminant < 0.0 {
            DoublePointKind::Acnode
        } else {
            branches_kind([-1.0, 1.0].map(|sign: f64| {
                // Of b (c - b) q^2 - 2 a b p q + a (c - a) p^2 = 0, each root in the form that loses no digits.
                let middle = a * b + sign * discriminant.sqrt();
                let [one, other] = [[b * (c - b), middle], [a * b - sign * discriminant.sqrt(), a * (c - a)]];
                let size = |[p, q]: [f64; 2]| p.abs() + q.abs();
                let [p, q] = if size(one) >= size(other) { one } else { other };
                left_normal(pin) * p + left_normal(offset) * q
            }))
        };
        DoublePoint { point: Point::from(pin + offset), kind }
    };
    flat.map(double_point).collect()
}

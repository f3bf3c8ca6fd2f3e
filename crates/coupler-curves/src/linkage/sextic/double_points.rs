//! The double points of a coupler curve.

use super::roots::periodic_zeros;
use super::{EquationTerms, Sextic};
use crate::geometry::{Point, left_normal, trig};

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
    /// The branches touch, or form a cusp.
    Cusp,
    /// An isolated point, which satisfies the equation but which the coupler point does not reach.
    Acnode,
}

impl DoublePointKind {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            DoublePointKind::Crunode => "crunode",
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
    /// vanishes.
    pub fn double_points(&self) -> Vec<DoublePoint> {
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
        for point in periodic_zeros(|t| agreement(at(t))).into_iter().map(at).chain(self.change_points.iter().copied())
        {
            let [determinant, size] = self.hessian_determinant(point);
            let kind = match determinant / size {
                d if d.abs() < 1e-7 => DoublePointKind::Cusp,
                d if d < 0.0 => DoublePointKind::Crunode,
                _ => DoublePointKind::Acnode,
            };
            let is_new = found.iter().all(|other| (other.point - point).norm() > 1e-6 * (frame + point.coords.norm()));
            // The pivots are on the circle too, but are double points only if the curve passes through them.
            let [value, terms] = self.evaluate(point);
            if is_new && point.x.is_finite() && value.abs() <= 1e-9 * terms {
                found.push(DoublePoint { point, kind });
            }
        }
        found
    }

    /// The determinant of its second derivatives at a point, and the sum of the magnitudes of its terms.
    fn hessian_determinant(&self, point: Point) -> [f64; 2] {
        let [xx, xy, yy] = self.second_derivatives(point);
        [xx * yy - xy * xy, (xx * yy).abs() + xy * xy]
    }
}

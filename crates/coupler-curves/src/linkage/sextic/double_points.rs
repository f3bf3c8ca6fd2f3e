//! The double points of a coupler curve.

use super::double_point::{DoublePoint, poses_kind};
use super::roots::periodic_zeros;
use super::{EquationTerms, Sextic};
use crate::geometry::{Point, left_normal, trig};

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

//! The geometry of a link's motion at an instant: its pole, inflection circle and cubic of stationary curvature.

use super::derivatives::JointDerivatives;
use crate::geometry::{Point, Vector, cross, left_normal};
use crate::linkage::{FourBar, JointId, Linkage};

/// The motion of a link at an instant, to the third order, as a plane that turns about its instant centre.
///
/// It does not depend on the speed of the input: derivatives are with respect to the link's own angle, in radians.
///
/// # Source
/// Bottema and Roth, *Theoretical Kinematics* (1979), chapter VIII: with w the vector from the pole to a point of the
/// link, its velocity is `i w`, its acceleration `q - w` and its jerk `k - i w`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InstantaneousMotion {
    /// The instant centre: the point of the fixed centrode.
    pub pole: Point,
    /// The instant centre in the link's own frame, with origin at its first joint and x towards the second: the point
    /// of the moving centrode.
    pub moving_pole: Vector,
    /// From the pole to the inflection pole, whose acceleration is zero: a diameter of the inflection circle.
    pub inflection_diameter: Vector,
    /// The jerk of the point at the pole.
    pole_jerk: Vector,
    /// 1 where the link turns counter-clockwise as the input rises, -1 where it turns clockwise; 1 at a limit.
    sense: f64,
}

/// A link translates without turning if its turning moves it by less than this part of its velocity.
const TRANSLATION_TOLERANCE: f64 = 1e-13;

impl InstantaneousMotion {
    /// The motion of a link, from the derivatives of two of its joints; `None` if it does not turn, or at a limit.
    pub fn from_link(derivatives: &JointDerivatives, [a, b]: [JointId; 2]) -> Option<InstantaneousMotion> {
        let arm = derivatives.position(b) - derivatives.position(a);
        let rate = |derivative: fn(&JointDerivatives, JointId) -> Vector| {
            let (rate_a, rate_b) = (derivative(derivatives, a), derivative(derivatives, b));
            (rate_b - rate_a, rate_a)
        };
        let [(v, va), (acc, aa), (jerk, ja)] =
            [JointDerivatives::velocity, JointDerivatives::acceleration, JointDerivatives::jerk].map(rate);
        // A rigid arm e has e' = i w e, e'' = (i w' - w^2) e, e''' = (i (w'' - w^3) - 3 w w') e.
        let turning = |rate: Vector| cross(arm, rate) / arm.norm_squared();
        let w = turning(v);
        // A link that translates has its pole at infinity, not at the point that rounding would give.
        if w.abs() * arm.norm() <= TRANSLATION_TOLERANCE * va.norm() {
            return None;
        }
        let (w1, w2) = (turning(acc), turning(jerk) + w * w * w);
        // The joint's derivatives with respect to the link's angle, from those with respect to the input.
        let first = va / w;
        let second = (aa - first * w1) / (w * w);
        let third = (ja - second * (3.0 * w * w1) - first * w2) / (w * w * w);
        let frame = [derivatives.position(a), derivatives.position(b)];
        InstantaneousMotion::from_plane(frame, [first, second, third], w.signum())
    }

    /// The motion of the coupler of a four-bar seen from its frame, from the positions of its pins; `None` where crank
    /// and rocker are parallel, and the coupler does not turn.
    ///
    /// It is defined at a limit, too, because it is parametrized by the coupler's own angle. There the coupler turns
    /// about the crank's pin, which is at rest.
    pub fn from_coupler([o, a, b, c]: [Point; 4], sense: f64) -> Option<InstantaneousMotion> {
        let (crank, coupler, rocker) = (a - o, b - a, b - c);
        // crank' + coupler' = rocker', each an angular velocity times the arm's left normal, differentiated twice more.
        let area = cross(crank, rocker);
        if area.abs() <= TRANSLATION_TOLERANCE * crank.norm() * rocker.norm() {
            return None;
        }
        let solve =
            |known: Vector| [-cross(known, left_normal(rocker)) / area, -cross(known, left_normal(crank)) / area];
        // The terms of the derivatives of an arm with angular velocity w that do not contain the highest derivative of
        // w.
        let [wc1, wr1] = solve(left_normal(coupler));
        let second_order = |arm: Vector, w: f64| -arm * (w * w);
        let [wc2, wr2] = solve(second_order(crank, wc1) - coupler - second_order(rocker, wr1));
        let third_order = |arm: Vector, w: f64, w1: f64| -arm * (3.0 * w * w1) - left_normal(arm) * (w * w * w);
        let [wc3, _] = solve(third_order(crank, wc1, wc2) - left_normal(coupler) - third_order(rocker, wr1, wr2));
        let first = left_normal(crank) * wc1;
        let second = left_normal(crank) * wc2 + second_order(crank, wc1);
        let third = left_normal(crank) * wc3 + third_order(crank, wc1, wc2);
        InstantaneousMotion::from_plane([a, b], [first, second, third], sense)
    }

    /// The motion of a plane with two joints, from the derivatives of the first with respect to the plane's angle.
    fn from_plane([a, b]: [Point; 2], [first, second, third]: [Vector; 3], sense: f64) -> Option<InstantaneousMotion> {
        let to_pole = left_normal(first);
        let axis = (b - a).normalize();
        // The acceleration of the point at the pole is that of the joint without what turning about the pole
        // contributes; so is the jerk.
        let (diameter, jerk) = (second - to_pole, third + first);
        let finite = |v: Vector| v.x.is_finite() && v.y.is_finite();
        [to_pole, axis, diameter, jerk].into_iter().all(finite).then(|| InstantaneousMotion {
            pole: a + to_pole,
            moving_pole: Vector::new(axis.dot(&to_pole), cross(axis, to_pole)),
            inflection_diameter: diameter,
            pole_jerk: jerk,
            sense,
        })
    }

    /// The point of zero acceleration; it and the pole are the ends of a diameter of the inflection circle.
    pub fn inflection_pole(&self) -> Point {
        self.pole + self.inflection_diameter
    }

    /// The common tangent of both centrodes, as long as the diameter, with the inflection pole to its left. As the link
    /// turns counter-clockwise, the pole moves in the opposite direction, by this length per radian.
    pub fn pole_tangent(&self) -> Vector {
        -left_normal(self.inflection_diameter)
    }

    /// The curvature of the path of the link's point at `point`, positive to the left in the direction of rising input.
    ///
    /// # Source
    /// Euler and Savary: `|w|^2 - w . q` over `|w|^3`.
    pub fn curvature(&self, point: Point) -> f64 {
        let w = point - self.pole;
        self.sense * (w.norm_squared() - w.dot(&self.inflection_diameter)) / (w.norm_squared() * w.norm())
    }

    /// The derivative of that curvature with respect to arc length. It is zero on the cubic of stationary curvature.
    ///
    /// # Source
    /// `-[(w . k) |w|^2 + 3 (|w|^2 - w . q) (w x q)] / |w|^6`, from the derivatives of the path.
    pub fn curvature_rate(&self, point: Point) -> f64 {
        let w = point - self.pole;
        let w2 = w.norm_squared();
        let numerator = w2 - w.dot(&self.inflection_diameter);
        -(w.dot(&self.pole_jerk) * w2 + 3.0 * numerator * cross(w, self.inflection_diameter)) / (w2 * w2 * w2)
    }

    /// The parameters M and N of the cubic of stationary curvature `1/r = 1 / (M sin a) + 1 / (N cos a)`, with the pole
    /// as origin and the angle a from the tangent, the inflection pole at 90 degrees; infinite where a term is missing.
    ///
    /// `None` where the diameter is zero: for a link that turns about a fixed pivot.
    ///
    /// # Source
    /// Hall, *Kinematics and Linkage Design* (1961), chapter 5.
    pub fn cubic_parameters(&self) -> Option<[f64; 2]> {
        let size = self.inflection_diameter.norm();
        if size <= 1e-12 * (self.moving_pole.norm() + size) {
            return None;
        }
        let [tangent, normal] = [self.pole_tangent(), self.inflection_diameter].map(|axis| axis / size);
        let area = 3.0 * size * size;
        Some([area / (self.pole_jerk.dot(&tangent) + 3.0 * size), area / self.pole_jerk.dot(&normal)])
    }

    /// The point of the cubic of stationary curvature in a direction from the pole; `None` where the cubic is at
    /// infinity.
    pub fn cubic_point(&self, direction: Vector) -> Option<Point> {
        let [m, n] = self.cubic_parameters()?;
        let d = direction.normalize();
        let [cos, sin] = [self.pole_tangent(), self.inflection_diameter].map(|axis| d.dot(&axis.normalize()));
        // The equation multiplied by sin cos, so that neither of them is divided by.
        let radius = sin * cos / (cos / m + sin / n);
        radius.is_finite().then(|| self.pole + d * radius)
    }

    /// Ball's point, on the inflection circle and on the cubic: its path is straight to the third order.
    pub fn ball_point(&self) -> Option<Point> {
        // On the circle the curvature is zero, and its derivative is zero where w . k is.
        let along = left_normal(self.pole_jerk).try_normalize(0.0)?;
        let point = self.pole + along * along.dot(&self.inflection_diameter);
        (point.x.is_finite() && point.y.is_finite()).then_some(point)
    }
}

impl InstantaneousMotion {
    /// The motion of the moving link that a joint is on; of several, the one that is placed first. `None` where it does
    /// not turn and, except for the coupler of a four-bar, at a limit.
    pub fn from_joint(
        linkage: &Linkage,
        derivatives: &JointDerivatives,
        joint: JointId,
    ) -> Option<InstantaneousMotion> {
        if let Some(pins) = FourBar::coupler_pins(linkage, joint) {
            let [_, a, b, _] = pins;
            let arm = derivatives.position(b) - derivatives.position(a);
            let turning = cross(arm, derivatives.velocity(b) - derivatives.velocity(a));
            let sense = if turning < 0.0 { -1.0 } else { 1.0 };
            let motion = InstantaneousMotion::from_coupler(pins.map(|pin| derivatives.position(pin)), sense);
            // With all joints on one line the coupler's motion does not follow from their positions alone.
            return motion.or_else(|| InstantaneousMotion::from_link(derivatives, [a, b]));
        }
        let ground = linkage.ground();
        let link = linkage.links.iter().find(|link| !std::ptr::eq(*link, ground) && link.position(joint).is_some())?;
        let (first, from) = *link.joints.first()?;
        let (second, _) = link.joints.iter().find(|(_, place)| *place != from)?;
        InstantaneousMotion::from_link(derivatives, [first, *second])
    }
}

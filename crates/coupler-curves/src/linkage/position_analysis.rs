//! McCarthy's position analysis, sections 2.2 and 2.3, equation by equation; angles are in radians.

use std::f64::consts::PI;

use super::{FourBar, JointKind, Linkage};
use crate::geometry::trig::{atan2, cos, sin};

/// The inverted slider-crank of McCarthy 2.2: a crank about O whose pin A slides on a line that turns about C.
///
/// B is the foot of the line from C. The angle psi of CB is measured about C, theta of OA about O, both from O -> C.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InvertedSliderCrank {
    /// The frame |OC|.
    pub g: f64,
    /// The crank |OA|.
    pub r: f64,
    /// The joint offset |CB|.
    pub e: f64,
}

impl InvertedSliderCrank {
    /// The inverted slider-crank in a linkage: a crank on a fixed pivot, whose pin slides on a line that turns about
    /// another; `e` is not negative. `None` if there is none, or the linkage is seen from another link.
    pub fn from_linkage(linkage: &Linkage) -> Option<InvertedSliderCrank> {
        if linkage.seen_from.is_some() {
            return None;
        }
        let slot = |kind| match kind {
            JointKind::Slot { base, offset, .. } => Some((base, offset)),
            _ => None,
        };
        linkage.joints.iter().filter_map(|joint| slot(joint.kind)).find_map(|([c, a], offset)| {
            let JointKind::Crank { pivot, length } = linkage.joints[a].kind else { return None };
            let fixed = |joint| linkage.links[0].position(joint);
            Some(InvertedSliderCrank { g: (fixed(c)? - fixed(pivot)?).norm(), r: length, e: offset.abs() })
        })
    }

    /// The slide s = |AB| at a crank angle, McCarthy (2.42); `None` where the linkage cannot be assembled. The other
    /// assembly has the slide -s.
    pub fn slide(&self, theta: f64) -> Option<f64> {
        let square = self.g * self.g + self.r * self.r - self.e * self.e - 2.0 * self.r * self.g * cos(theta);
        (square >= 0.0).then(|| square.sqrt())
    }

    /// The distance b = |CA| at a slide, McCarthy (2.40).
    pub fn b(&self, s: f64) -> f64 {
        (s * s + self.e * self.e).sqrt()
    }

    /// The angle beta from CB to CA at a slide, McCarthy (2.40): atan2(s, e).
    pub fn beta(&self, s: f64) -> f64 {
        atan2(s, self.e)
    }

    /// The crank angle in [0, pi] at a slide, McCarthy (2.43); the other solution is its negative. `None` where the
    /// actuator is too long or too short.
    pub fn theta(&self, s: f64) -> Option<f64> {
        let InvertedSliderCrank { g, r, e } = *self;
        clamped_acos(g * g + r * r - e * e - s * s, g * g + r * r + e * e + s * s, 2.0 * r * g)
    }

    /// The angle psi of CB at a crank angle and the slide there, McCarthy (2.45).
    pub fn psi(&self, theta: f64, s: f64) -> f64 {
        atan2(self.r * sin(theta), self.r * cos(theta) - self.g) - self.beta(s)
    }

    /// The least and the greatest crank angle in [0, pi] that can be assembled; the range in [-pi, 0] is its mirror
    /// image. `None` where the linkage cannot be assembled.
    pub fn crank_range(&self) -> Option<[f64; 2]> {
        let InvertedSliderCrank { g, r, e } = *self;
        let e = e.abs();
        if e > g + r {
            return None;
        }
        let nearest = (g - r).abs();
        let least = clamped_acos(g * g + r * r - e * e, g * g + r * r + e * e, 2.0 * r * g);
        Some([if nearest >= e { 0.0 } else { least.unwrap_or(PI) }, PI])
    }

    /// The least and the greatest output angle psi on a circuit, continuous; `None` where the linkage cannot be
    /// assembled.
    ///
    /// Where the output turns fully, -pi and pi. Where the crank turns fully and the output rocks, both are in [0, pi],
    /// for a positive slide; with a negative one the range is the mirror image, in [-pi, 0]. Otherwise both rock, the
    /// output about pi, and the greatest angle exceeds pi.
    ///
    /// # Source
    /// As McCarthy, section 2.2, recommends, from the limits of the other crank: the line is a tangent of the crank's
    /// circle where psi is extreme, so that `g cos psi + e`, its distance from O, is r or -r there.
    pub fn psi_range(&self) -> Option<[f64; 2]> {
        let InvertedSliderCrank { g, r, e } = *self;
        let e = e.abs();
        self.crank_range()?;
        let direction = |distance: f64| {
            let beyond = if distance > e { 0.0 } else { PI };
            clamped_acos(distance - e, distance.abs() + e + g, g).unwrap_or(beyond)
        };
        Some(match () {
            () if (g - r).abs() < e => [direction(r), 2.0 * PI - direction(r)],
            () if r > g => [-PI, PI],
            () => [direction(r), direction(-r)],
        })
    }

    /// The least and the greatest slide s >= 0; `None` where the linkage cannot be assembled.
    pub fn slide_range(&self) -> Option<[f64; 2]> {
        let leg = |base: f64| ((base - self.e) * (base + self.e)).max(0.0).sqrt();
        self.crank_range().map(|_| [leg((self.g - self.r).abs()), leg(self.g + self.r)])
    }
}

/// McCarthy 2.3: the 4R linkage driven by its crank, where a is the crank, b the rocker, g the frame, h the coupler.
impl FourBar {
    /// A^2 + B^2 - C^2 at a crank angle, which is not negative where the linkage can be assembled, McCarthy (2.53).
    pub fn solvability(&self, theta: f64) -> f64 {
        let [a, b, c] = self.output_coefficients(theta);
        a * a + b * b - c * c
    }

    /// The output angle psi about C on branch 1 and on branch -1, McCarthy (2.52).
    pub fn output_angles(&self, theta: f64) -> Option<[f64; 2]> {
        // Left of A -> C is clockwise of the diagonal C -> A, whose direction is delta.
        solve_angle(self.output_coefficients(theta))
    }

    /// The angles of the crank from O -> C, in [0, pi], at which the rocker reverses: crank and coupler are on one line,
    /// extended, and folded. The angles in [-pi, 0] are their negatives. `None` for one that is not reached, and where
    /// the rocker's pin is at O, whatever the angle.
    ///
    /// # Source
    /// Natesan (4.8) is the extended one of Roberts's linkage. The crank's own limits, with coupler and rocker on one
    /// line, are (4.3), (4.4), (4.6) and (4.9).
    pub fn rocker_limits(&self) -> [Option<f64>; 2] {
        let FourBar { frame: p, crank: r, coupler: a, rocker: s } = *self;
        // With a coupler longer than the crank the rocker's pin is behind O where they are folded.
        [r + a, r - a].map(|reach| {
            let squares = [p * p, reach * reach, s * s];
            let angle = clamped_acos(squares[0] + squares[1] - squares[2], squares.iter().sum(), 2.0 * p * reach.abs());
            angle.filter(|_| reach != 0.0).map(|angle| if reach < 0.0 { PI - angle } else { angle })
        })
    }

    /// The coupler angle phi, measured about A from OA, at an input and an output angle, McCarthy (2.57).
    pub fn coupler_angle(&self, theta: f64, psi: f64) -> f64 {
        let FourBar { frame: g, crank: a, rocker: b, .. } = *self;
        atan2(b * sin(psi) - a * sin(theta), g + b * cos(psi) - a * cos(theta)) - theta
    }

    /// The coupler angle phi on branch 1 and on branch -1, without the output angle, McCarthy (2.59) and (2.60).
    pub fn coupler_angles(&self, theta: f64) -> Option<[f64; 2]> {
        let FourBar { frame: g, crank: a, coupler: h, rocker: b } = *self;
        solve_angle([
            2.0 * a * h - 2.0 * g * h * cos(theta),
            2.0 * g * h * sin(theta),
            b * b - a * a - g * g - h * h + 2.0 * a * g * cos(theta),
        ])
    }

    /// The transmission angle zeta at B between coupler and rocker, from 0 to pi, by the law of cosines.
    pub fn transmission_angle(&self, theta: f64) -> Option<f64> {
        let FourBar { frame: g, crank: a, coupler: h, rocker: b } = *self;
        let diagonal = g * g + a * a - 2.0 * a * g * cos(theta);
        clamped_acos(h * h + b * b - diagonal, h * h + b * b + diagonal, 2.0 * h * b)
    }

    /// A, B and C of McCarthy (2.51).
    fn output_coefficients(&self, theta: f64) -> [f64; 3] {
        let FourBar { frame: g, crank: a, coupler: h, rocker: b } = *self;
        [
            2.0 * a * b * cos(theta) - 2.0 * g * b,
            2.0 * a * b * sin(theta),
            g * g + b * b + a * a - h * h - 2.0 * a * g * cos(theta),
        ]
    }
}

/// The angle in [0, pi] whose cosine is a quotient: 0 or pi where the quotient is 1 or -1 within the rounding of its dividend, a sum of terms
/// of total magnitude `magnitude`, which would be some 1e-8 in the angle; `None` where it exceeds that.
fn clamped_acos(dividend: f64, magnitude: f64, divisor: f64) -> Option<f64> {
    let excess = dividend.abs() - divisor;
    if excess.abs() <= 4.0 * f64::EPSILON * magnitude {
        return Some(if dividend < 0.0 { PI } else { 0.0 });
    }
    (excess < 0.0).then(|| atan2(((divisor - dividend) * (divisor + dividend)).sqrt(), dividend))
}

/// The solutions of A cos x + B sin x = C, McCarthy (A.1): the direction of (A, B) less and plus the arc cosine.
fn solve_angle([a, b, c]: [f64; 3]) -> Option<[f64; 2]> {
    let (delta, radius) = (atan2(b, a), (a * a + b * b).sqrt());
    let epsilon = clamped_acos(c, c.abs() + radius, radius)?;
    Some([delta - epsilon, delta + epsilon])
}

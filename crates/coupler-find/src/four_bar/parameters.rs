//! A four-bar with a coupler point by its nine parameters.

use crate::complex::{Complex, dot, length, times_i, turned, unit};
use crate::four_bar::pose::Pose;
use crate::scatter::Scatter;
use coupler_curves::geometry::{Point, Similarity, Vector, trig};
use coupler_curves::linkage::{Cognates, FourBar, PlacedFourBar};
use nalgebra::SVector;

/// The number of parameters of a placed four-bar with a coupler point.
pub(crate) const COUNT: usize = 9;

/// The places of the lengths among the parameters, see [`Parameters::moved`].
pub(crate) const FRAME: usize = 3;

/// A motion of the parameters.
pub(crate) type Motion = SVector<f64, COUNT>;

/// A value that must not be negative, and its derivatives.
pub(crate) type Constraint = (f64, Motion);

/// A four-bar with a coupler point, somewhere in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Parameters {
    pub crank_pivot: Complex,
    /// The direction from the crank's pivot to the rocker's, of length 1.
    pub direction: Complex,
    pub frame: f64,
    pub crank: f64,
    pub coupler: f64,
    pub rocker: f64,
    /// The coupler point: along the coupler from the crank pin towards the rocker pin, and to the left of it.
    pub point: Complex,
}

impl Parameters {
    /// Those of a placed four-bar.
    pub fn from_placed(placed: &PlacedFourBar) -> Parameters {
        let [origin, end] = placed.pivots.map(|p| Complex::new(p.x, p.y));
        let FourBar { frame, crank, coupler, rocker } = placed.lengths;
        Parameters {
            crank_pivot: origin,
            direction: (end - origin) / length(end - origin),
            frame,
            crank,
            coupler,
            rocker,
            point: Complex::new(placed.coupler_point.x, placed.coupler_point.y),
        }
    }

    /// The placed four-bar.
    pub fn to_placed(self) -> PlacedFourBar {
        let pivots = [self.crank_pivot, self.rocker_pivot()].map(|p| Point::new(p.re, p.im));
        let coupler_point = Vector::new(self.point.re, self.point.im);
        PlacedFourBar { pivots, lengths: self.lengths(), coupler_point }
    }

    pub fn lengths(&self) -> FourBar {
        FourBar { frame: self.frame, crank: self.crank, coupler: self.coupler, rocker: self.rocker }
    }

    pub fn rocker_pivot(&self) -> Complex {
        self.crank_pivot + self.frame * self.direction
    }

    /// Whether the crank turns fully.
    pub fn is_full_turn(&self) -> bool {
        let Parameters { frame, crank, coupler, rocker, .. } = *self;
        (frame - crank).abs() >= (coupler - rocker).abs() && frame + crank <= coupler + rocker
    }

    /// The linkage after a motion of its parameters: the crank's pivot in x and y, the direction in radians to the first
    /// order, the lengths of frame, crank, coupler and rocker, and the coupler point along and across.
    pub fn moved(&self, by: &[f64; COUNT]) -> Parameters {
        Parameters {
            crank_pivot: self.crank_pivot + Complex::new(by[0], by[1]),
            direction: turned(self.direction, by[2]),
            frame: self.frame + by[FRAME],
            crank: self.crank + by[FRAME + 1],
            coupler: self.coupler + by[FRAME + 2],
            rocker: self.rocker + by[FRAME + 3],
            point: self.point + Complex::new(by[7], by[8]),
        }
    }

    /// The image of the linkage.
    pub fn transformed(&self, by: &Similarity) -> Parameters {
        let scale = by.scale();
        Parameters {
            crank_pivot: by.image(self.crank_pivot),
            direction: by.direction(self.direction) / scale,
            frame: scale * self.frame,
            crank: scale * self.crank,
            coupler: scale * self.coupler,
            rocker: scale * self.rocker,
            point: scale * by.reflected(self.point),
        }
    }

    /// A linkage near this one, at random.
    pub fn scattered(&self, scatter: &mut Scatter, spread: f64) -> Parameters {
        let mut scaled = |length: f64| length * trig::exp(scatter.normal(spread));
        let [frame, crank, coupler, rocker] = [self.frame, self.crank, self.coupler, self.rocker].map(&mut scaled);
        let mut by = [0.0; COUNT];
        by[0] = 0.3 * scatter.normal(spread);
        by[1] = 0.3 * scatter.normal(spread);
        by[2] = 0.5 * scatter.normal(spread);
        by[7] = length(self.point) * scatter.normal(spread);
        by[8] = length(self.point) * scatter.normal(spread);
        Parameters { frame, crank, coupler, rocker, ..self.moved(&by) }
    }

    /// The two other four-bars that trace the same curve.
    pub fn cognates(&self) -> Vec<Parameters> {
        let Ok(cognates) = Cognates::from_four_bar(self.to_placed()) else { return Vec::new() };
        cognates.others.iter().map(|cognate| Parameters::from_placed(&cognate.four_bar)).collect()
    }

    /// The coupler point in a pose.
    pub fn coupler_point(&self, pose: &Pose) -> Complex {
        self.crank_pivot + self.crank * pose.crank + self.point * pose.coupler
    }

    /// The crank pin and the rocker pin in a pose.
    pub fn pins(&self, pose: &Pose) -> [Point; 2] {
        let crank_pin = self.crank_pivot + self.crank * pose.crank;
        [crank_pin, crank_pin + self.coupler * pose.coupler].map(|z| Point::new(z.re, z.im))
    }

    /// The points of the coupler curve in the poses of a circuit.
    pub fn curve(&self, circuit: &[Pose]) -> Vec<Complex> {
        circuit.iter().map(|pose| self.coupler_point(pose)).collect()
    }

    /// The pose with the crank in a direction and the rocker pin on a side of the line from the crank pin to the rocker's
    /// pivot, 1 for the left and -1 for the right; `None` if coupler and rocker do not reach each other.
    pub fn assemble(&self, crank: Complex, side: f64) -> Option<Pose> {
        /// A pose at a limit is missed by rounding only.
        const ROUNDING: f64 = 1e-9;
        let to_pivot = self.frame * self.direction - self.crank * crank;
        let square = to_pivot.norm_sqr();
        let distance = square.sqrt();
        let cos = (self.coupler * self.coupler + square - self.rocker * self.rocker) / (2.0 * self.coupler * distance);
        let sin_square = 1.0 - cos * cos;
        if sin_square.is_nan() || sin_square < -ROUNDING {
            return None;
        }
        let coupler = to_pivot / distance * Complex::new(cos, side * sin_square.max(0.0).sqrt());
        Some(Pose { crank, coupler })
    }

    /// The circuits, each as poses in the order of the motion, of which there are about `directions.len()`; `directions`
    /// are those of a crank that turns fully, at equal angles from 0 on.
    pub fn circuits(&self, directions: &[Complex]) -> Vec<Vec<Pose>> {
        if self.is_full_turn() {
            let circuit = |side: f64| -> Vec<Pose> {
                directions.iter().filter_map(|&crank| self.assemble(crank * self.direction, side)).collect()
            };
            return vec![circuit(1.0), circuit(-1.0)];
        }
        let arc = |[from, to]: [f64; 2]| -> Vec<Pose> {
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            // There on one side and back on the other; the sine makes the motion smooth where it turns round.
            let pose = |direction: &Complex| {
                let crank = unit(middle + half * direction.im) * self.direction;
                self.assemble(crank, if direction.re >= 0.0 { 1.0 } else { -1.0 })
            };
            directions.iter().filter_map(pose).collect()
        };
        self.crank_arcs().into_iter().map(arc).collect()
    }

    /// The ranges of the angle from the frame to a crank that does not turn fully, in radians.
    fn crank_arcs(&self) -> Vec<[f64; 2]> {
        use std::f64::consts::PI;
        let Parameters { frame, crank, coupler, rocker, .. } = *self;
        let cos_at = |distance: f64| (frame * frame + crank * crank - distance * distance) / (2.0 * frame * crank);
        let (at_stretched, at_folded) = (cos_at(coupler + rocker), cos_at(coupler - rocker));
        if at_stretched > 1.0 || at_folded < -1.0 {
            return Vec::new();
        }
        match (at_stretched > -1.0, at_folded < 1.0) {
            (true, true) => {
                let [low, high] = [trig::acos(at_folded), trig::acos(at_stretched)];
                vec![[low, high], [-high, -low]]
            }
            (true, false) => vec![[-trig::acos(at_stretched), trig::acos(at_stretched)]],
            (false, true) => vec![[trig::acos(at_folded), 2.0 * PI - trig::acos(at_folded)]],
            (false, false) => Vec::new(),
        }
    }

    /// The closure of the linkage in a pose: half the excess of the square of the distance of the coupler's end from the
    /// rocker's pivot.
    fn closure(&self, arm: Complex) -> f64 {
        0.5 * (arm.norm_sqr() - self.rocker * self.rocker)
    }

    /// From the rocker's pivot to the end of the coupler in a pose.
    pub(crate) fn arm(&self, pose: &Pose) -> Complex {
        self.crank * pose.crank + self.coupler * pose.coupler - self.frame * self.direction
    }

    /// Moves a pose so that the linkage is closed, along the gradient of the closure, which vanishes at change points
    /// only; `None` if that fails.
    pub fn settle(&self, mut pose: Pose) -> Option<Pose> {
        const ROUNDS: usize = 8;
        const ROUNDING: f64 = 1e-14;
        /// Of a pose that converges slowly next to a change point.
        const LOOSE: f64 = 1e-10;
        let scale = self.coupler * self.coupler + self.rocker * self.rocker;
        for _ in 0..ROUNDS {
            let arm = self.arm(&pose);
            let closure = self.closure(arm);
            if closure.abs() <= ROUNDING * scale {
                return Some(pose);
            }
            let [by_crank, by_coupler] = self.closure_rates(&pose, arm);
            let step = -closure / (by_crank * by_crank + by_coupler * by_coupler).max(f64::MIN_POSITIVE);
            let [crank, coupler] = [by_crank * step, by_coupler * step];
            // A pose is never far from the last one.
            if (crank.abs() + coupler.abs()).is_nan() || crank.abs() + coupler.abs() >= 1.0 {
                return None;
            }
            pose = pose.turned([crank, coupler]);
        }
        (self.closure(self.arm(&pose)).abs() <= LOOSE * scale).then_some(pose)
    }

    /// The derivatives of the closure with respect to the angles of crank and coupler.
    pub(crate) fn closure_rates(&self, pose: &Pose, arm: Complex) -> [f64; 2] {
        [self.crank * dot(arm, times_i(pose.crank)), self.coupler * dot(arm, times_i(pose.coupler))]
    }
}

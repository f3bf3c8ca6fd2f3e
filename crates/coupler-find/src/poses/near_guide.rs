//! A linkage that is moved towards poses, of which it need not pass any exactly.
//!
//! The poses that the body can take are a curve in the space of its place and its angle, where the two dyads keep their lengths. The error
//! of a pose is its distance from that curve, with angles times a length; across the curve it is regular at limits of the crank.

use super::body::Placed;
use super::dyad::Dyad;
use crate::complex::{Complex, dot, length, times_i, unit};
use crate::descent::{Candidate, Equations};
use coupler_curves::geometry::trig;
use nalgebra::{DVector, Dyn, Matrix2, Matrix2x3, Vector2, Vector3};

/// A dyad whose length need not be that of the poses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum FreeDyad {
    /// A link: its pivot and length.
    Revolute { pivot: Complex, length: f64, of_body: Complex },
    /// A slider: the angle of the normal of its line and the distance of that from the middle.
    Slider { angle: f64, distance: f64, of_body: Complex },
    /// A slot: its pivot, the angle of the normal of its line in the body, and the distance of the pivot from the line's parallel through the body's
    /// point.
    Slot { pivot: Complex, angle: f64, distance: f64 },
}

/// A constraint of a dyad at a pose: its value, and its derivatives.
struct Constraint {
    value: f64,
    /// By the place and the angle of the body.
    by_pose: [f64; 3],
    /// By the numbers of the dyad, of which a slider and a slot have one less.
    by_dyad: [f64; 5],
}

impl FreeDyad {
    /// The dyad that has its length on the mean of the poses.
    pub fn new(dyad: &Dyad, placed: &[Placed]) -> FreeDyad {
        let pins = dyad.pins(placed);
        let mean = |distance: &dyn Fn(Complex, &Placed) -> f64| {
            let distances = pins.iter().zip(placed).map(|(pin, pose)| distance(*pin, pose));
            distances.sum::<f64>() / placed.len() as f64
        };
        match *dyad {
            Dyad::Revolute { pivot, pin } => FreeDyad::Revolute {
                pivot,
                length: mean(&|pin, _| length(pin - pivot)),
                of_body: placed[0].of_body(pin),
            },
            Dyad::Slider { normal, pin } => FreeDyad::Slider {
                angle: trig::atan2(normal.im, normal.re),
                distance: mean(&|pin, _| dot(normal, pin)),
                of_body: placed[0].of_body(pin),
            },
            Dyad::Slot { pivot, normal } => {
                let of_body = normal * placed[0].direction.conj();
                FreeDyad::Slot {
                    pivot,
                    angle: trig::atan2(of_body.im, of_body.re),
                    distance: mean(&|normal, pose| dot(normal, pivot - pose.point)),
                }
            }
        }
    }

    /// The number of its numbers.
    pub fn count(&self) -> usize {
        if matches!(self, FreeDyad::Revolute { .. }) { 5 } else { 4 }
    }

    /// The dyad with its pin, or the line of its slot, where it is in a pose.
    pub fn at(&self, first: &Placed) -> Dyad {
        match *self {
            FreeDyad::Revolute { pivot, of_body, .. } => Dyad::Revolute { pivot, pin: first.apply(of_body) },
            FreeDyad::Slider { angle, of_body, .. } => Dyad::Slider { normal: unit(angle), pin: first.apply(of_body) },
            FreeDyad::Slot { pivot, angle, .. } => Dyad::Slot { pivot, normal: first.direction * unit(angle) },
        }
    }

    fn constraint(&self, pose: &Placed) -> Constraint {
        let [along, across] = [pose.direction, times_i(pose.direction)];
        match *self {
            FreeDyad::Revolute { pivot, length: own, of_body } => {
                let turned = pose.direction * of_body;
                let arm = pose.point + turned - pivot;
                let distance = length(arm);
                let u = arm / distance.max(f64::MIN_POSITIVE);
                Constraint {
                    value: distance - own,
                    by_pose: [u.re, u.im, dot(u, times_i(turned))],
                    by_dyad: [dot(u, along), dot(u, across), -1.0, -u.re, -u.im],
                }
            }
            FreeDyad::Slider { angle, distance, of_body } => {
                let turned = pose.direction * of_body;
                let (n, pin) = (unit(angle), pose.point + turned);
                Constraint {
                    value: dot(n, pin) - distance,
                    by_pose: [n.re, n.im, dot(n, times_i(turned))],
                    by_dyad: [dot(n, along), dot(n, across), -1.0, dot(times_i(n), pin), 0.0],
                }
            }
            FreeDyad::Slot { pivot, angle, distance } => {
                let (n, arm) = (pose.direction * unit(angle), pivot - pose.point);
                let by_angle = dot(times_i(n), arm);
                Constraint {
                    value: dot(n, arm) - distance,
                    by_pose: [-n.re, -n.im, by_angle],
                    by_dyad: [n.re, n.im, -1.0, by_angle, 0.0],
                }
            }
        }
    }

    /// The dyad with its numbers changed.
    pub fn moved(&self, by: &[f64]) -> FreeDyad {
        let by_place = Complex::new(by[0], by[1]);
        match *self {
            FreeDyad::Revolute { pivot, length, of_body } => FreeDyad::Revolute {
                of_body: of_body + by_place,
                length: length + by[2],
                pivot: pivot + Complex::new(by[3], by[4]),
            },
            FreeDyad::Slider { angle, distance, of_body } => {
                FreeDyad::Slider { of_body: of_body + by_place, distance: distance + by[2], angle: angle + by[3] }
            }
            FreeDyad::Slot { pivot, angle, distance } => {
                FreeDyad::Slot { pivot: pivot + by_place, distance: distance + by[2], angle: angle + by[3] }
            }
        }
    }
}

/// The poses that linkages are moved towards, and the length with which angles count.
pub(super) struct PoseAim<'a> {
    pub placed: &'a [Placed],
    /// In sizes of the poses.
    pub angle_length: f64,
}

/// One dyad alone, moved so that it changes its length least.
#[derive(Clone, Debug)]
pub(super) struct NearDyad {
    pub dyad: FreeDyad,
    objective: f64,
}

impl NearDyad {
    pub fn new(dyad: FreeDyad, aim: &PoseAim) -> NearDyad {
        let objective = aim.placed.iter().map(|pose| dyad.constraint(pose).value).map(|value| value * value).sum();
        NearDyad { dyad, objective }
    }
}

impl Candidate for NearDyad {
    type Unknowns = Dyn;
    type Aim<'a> = PoseAim<'a>;
    const NO_GAIN: f64 = 1e-9;

    fn objective(&self) -> f64 {
        self.objective
    }

    fn equations(&self, aim: &PoseAim) -> Option<Equations<Dyn>> {
        let count = self.dyad.count();
        let mut equations = Equations::new(Dyn(count));
        for pose in aim.placed {
            let constraint = self.dyad.constraint(pose);
            equations.add(&constraint.by_dyad.map(|x| -x)[..count], constraint.value, 1.0);
        }
        Some(equations)
    }

    fn moved(&self, aim: &PoseAim, motion: &DVector<f64>) -> Option<NearDyad> {
        let moved = NearDyad::new(self.dyad.moved(motion.as_slice()), aim);
        moved.objective.is_finite().then_some(moved)
    }
}

/// Two dyads, and the poses of the body nearest to those aimed at.
#[derive(Clone, Debug)]
pub(super) struct NearGuide {
    pub dyads: [FreeDyad; 2],
    pub passed: Vec<Placed>,
    /// The sum of the squares of the errors.
    objective: f64,
}

/// The two constraints at a pose, by the place of the body and its angle times the length.
struct Closed {
    values: Vector2<f64>,
    by_pose: Matrix2x3<f64>,
    by_dyads: [[f64; 5]; 2],
}

impl NearGuide {
    /// Two dyads where the body is nearest to the poses; `None` if it cannot be assembled near one of them.
    pub fn new(dyads: [FreeDyad; 2], aim: &PoseAim) -> Option<NearGuide> {
        let mut passed = Vec::with_capacity(aim.placed.len());
        let mut objective = 0.0;
        for pose in aim.placed {
            let offset = foot(&dyads, pose, aim.angle_length)?;
            objective += offset.norm_squared();
            passed.push(shifted(pose, &offset, aim.angle_length));
        }
        Some(NearGuide { dyads, passed, objective })
    }

    /// The root of the mean square of the errors, in sizes of the poses.
    pub fn rms(&self) -> f64 {
        (self.objective / self.passed.len() as f64).sqrt()
    }
}

/// A pose that is moved by a place, and by an angle times a length.
fn shifted(pose: &Placed, offset: &Vector3<f64>, angle_length: f64) -> Placed {
    Placed {
        point: pose.point + Complex::new(offset.x, offset.y),
        direction: pose.direction * unit(offset.z / angle_length),
    }
}

fn closed(dyads: &[FreeDyad; 2], pose: &Placed, angle_length: f64) -> Closed {
    let [a, b] = dyads.map(|dyad| dyad.constraint(pose));
    let row = |of: &Constraint| [of.by_pose[0], of.by_pose[1], of.by_pose[2] / angle_length];
    let [ra, rb] = [row(&a), row(&b)];
    Closed {
        values: Vector2::new(a.value, b.value),
        by_pose: Matrix2x3::new(ra[0], ra[1], ra[2], rb[0], rb[1], rb[2]),
        by_dyads: [a.by_dyad, b.by_dyad],
    }
}

/// From a pose to the nearest one in which the dyads have their lengths.
fn foot(dyads: &[FreeDyad; 2], pose: &Placed, angle_length: f64) -> Option<Vector3<f64>> {
    const ROUNDS: usize = 60;
    /// Of a step, in sizes of the poses.
    const CONVERGED: f64 = 1e-14;
    /// What rounding leaves of a length.
    const CLOSED: f64 = 1e-11;
    /// The greatest step.
    const MOST: f64 = 0.5;
    let mut offset = Vector3::zeros();
    for _ in 0..ROUNDS {
        let Closed { values, by_pose, .. } = closed(dyads, &shifted(pose, &offset, angle_length), angle_length);
        let square: Matrix2<f64> = by_pose * by_pose.transpose();
        let next: Vector3<f64> = by_pose.transpose() * square.try_inverse()? * (by_pose * offset - values);
        let step = next - offset;
        let norm = step.norm();
        if !norm.is_finite() {
            return None;
        }
        offset += if norm > MOST { step * (MOST / norm) } else { step };
        if norm <= CONVERGED {
            break;
        }
    }
    let left = closed(dyads, &shifted(pose, &offset, angle_length), angle_length).values;
    (left.amax() <= CLOSED).then_some(offset)
}

impl Candidate for NearGuide {
    type Unknowns = Dyn;
    type Aim<'a> = PoseAim<'a>;
    const NO_GAIN: f64 = 1e-9;

    fn objective(&self) -> f64 {
        self.objective
    }

    fn is_exact(&self, aim: &PoseAim) -> bool {
        /// Of an error of the size of the poses, squared.
        const ROUNDING: f64 = 1e-26;
        self.objective <= ROUNDING * aim.placed.len() as f64
    }

    fn equations(&self, aim: &PoseAim) -> Option<Equations<Dyn>> {
        let counts = self.dyads.map(|dyad| dyad.count());
        let mut equations = Equations::new(Dyn(counts[0] + counts[1]));
        for (pose, passed) in aim.placed.iter().zip(&self.passed) {
            let Closed { by_pose, by_dyads, .. } = closed(&self.dyads, passed, aim.angle_length);
            let inverse = by_pose.transpose() * (by_pose * by_pose.transpose()).try_inverse()?;
            let turn = pose.direction * passed.direction.conj();
            let away = pose.point - passed.point;
            let away = Vector3::new(away.re, away.im, aim.angle_length * trig::atan2(turn.im, turn.re));
            // Two directions across the curve, of length 1.
            let first = by_pose.row(0).transpose().normalize();
            let second = by_pose.row(1).transpose();
            let second = (second - first * first.dot(&second)).normalize();
            for direction in [first, second] {
                let across = inverse.transpose() * direction;
                let mut row = Vec::with_capacity(counts[0] + counts[1]);
                for k in 0..2 {
                    row.extend(by_dyads[k][..counts[k]].iter().map(|x| -across[k] * x));
                }
                equations.add(&row, direction.dot(&away), 1.0);
            }
        }
        Some(equations)
    }

    fn moved(&self, aim: &PoseAim, motion: &DVector<f64>) -> Option<NearGuide> {
        let (first, second) = motion.as_slice().split_at(self.dyads[0].count());
        NearGuide::new([self.dyads[0].moved(first), self.dyads[1].moved(second)], aim)
    }
}

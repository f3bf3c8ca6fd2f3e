//! What a linkage must satisfy, and the least-squares step that keeps to it.

use crate::complex::{Complex, length, times_i};
use crate::condition::Condition;
use crate::four_bar::curve_length::LengthLimit;
use crate::four_bar::parameters::{COUNT, Constraint, FRAME, Motion, Parameters};
use crate::four_bar::pose::Pose;
use coupler_curves::geometry::Similarity;
use nalgebra::{Cholesky, Const};

/// The limits of a linkage, in sizes of the target.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Limits {
    /// Whether the crank must turn fully.
    pub full_turn: bool,
    /// The greatest distance of two joints of a link.
    pub max_link: f64,
    /// The corners of the box of the fixed pivots.
    pub pivots: Option<[Complex; 2]>,
    /// The condition on the linkage, in the unit and axes of the target.
    pub condition: Option<Condition>,
    /// From the plane of these limits to that of the target.
    pub placement: Similarity,
    /// The greatest length of the curve of a closed target.
    pub length: Option<LengthLimit>,
}

/// Shorter links are not built: a hundredth of a millimetre in a path of ten.
const MIN_LINK: f64 = 1e-3;

/// What keeps a crank that turns fully off a change point, so that rounding does not take it there.
const MARGIN: f64 = 1e-9;

impl Limits {
    /// The constraints of a linkage; `is_frame_longer` than its crank, which a crank that turns fully never changes.
    fn constraints(&self, linkage: &Parameters, is_frame_longer: bool) -> Vec<Constraint> {
        let mut all: Vec<Constraint> = Vec::with_capacity(20);
        let mut of_lengths = |value: f64, by: [f64; 4]| {
            let mut rates = Motion::zeros();
            (0..4).for_each(|k| rates[FRAME + k] = by[k]);
            all.push((value, rates));
        };
        let Parameters { frame, crank, coupler, rocker, point, direction, .. } = *linkage;
        for (k, length) in [frame, crank, coupler, rocker].into_iter().enumerate() {
            let mut by = [0.0; 4];
            by[k] = 1.0;
            of_lengths(length - MIN_LINK, by);
            of_lengths(self.max_link - length, by.map(|part| -part));
        }
        if self.full_turn {
            // The crank passes both poses on the line of the frame: the rocker pin is in reach of the far and of the near
            // crank pin.
            let sign = if is_frame_longer { 1.0 } else { -1.0 };
            let near = sign * (frame - crank);
            of_lengths(coupler + rocker - frame - crank - MARGIN, [-1.0, -1.0, 1.0, 1.0]);
            of_lengths(near - coupler + rocker - MARGIN, [sign, -sign, -1.0, 1.0]);
            of_lengths(near + coupler - rocker - MARGIN, [sign, -sign, 1.0, -1.0]);
        }
        if self.max_link.is_finite() {
            // The sides of the coupler's triangle.
            for (side, by_coupler) in [(point, 0.0), (point - coupler, 1.0)] {
                let length = length(side).max(f64::MIN_POSITIVE);
                let mut rates = Motion::zeros();
                (rates[7], rates[8]) = (-side.re / length, -side.im / length);
                rates[FRAME + 2] = by_coupler * side.re / length;
                all.push((self.max_link - length, rates));
            }
        }
        if let Some([low, high]) = self.pivots {
            // The part of the frame that moves each pivot.
            for (pivot, part) in [(linkage.crank_pivot, 0.0), (linkage.rocker_pivot(), 1.0)] {
                let (turn, along) = (part * frame * times_i(direction), part * direction);
                let parts = [
                    (pivot.re - low.re, 1.0, [turn.re, along.re], 0),
                    (high.re - pivot.re, -1.0, [turn.re, along.re], 0),
                    (pivot.im - low.im, 1.0, [turn.im, along.im], 1),
                    (high.im - pivot.im, -1.0, [turn.im, along.im], 1),
                ];
                for (value, sign, [by_turn, by_frame], axis) in parts {
                    let mut rates = Motion::zeros();
                    rates[axis] = sign;
                    rates[2] = sign * by_turn;
                    rates[FRAME] = sign * by_frame;
                    all.push((value, rates));
                }
            }
        }
        all.retain(|(value, _)| *value < f64::INFINITY);
        all
    }

    /// Whether a linkage satisfies the constraints.
    pub fn are_satisfied(&self, linkage: &Parameters) -> bool {
        let is_frame_longer = linkage.frame >= linkage.crank;
        self.constraints(linkage, is_frame_longer).iter().all(|(value, _)| *value >= 0.0)
    }

    /// Whether a linkage that was computed from another one, such as a cognate, satisfies the constraints to rounding.
    pub fn are_nearly_satisfied(&self, linkage: &Parameters) -> bool {
        const ROUNDING: f64 = 1e-10;
        let is_frame_longer = linkage.frame >= linkage.crank;
        self.constraints(linkage, is_frame_longer).iter().all(|(value, _)| *value >= -ROUNDING)
    }

    /// Whether a linkage satisfies the condition on the circuit of a pose.
    pub fn meets_condition(&self, linkage: &Parameters, pose: &Pose) -> bool {
        let Some(condition) = &self.condition else { return true };
        let placed = linkage.transformed(&self.placement);
        condition.is_met(&placed.to_placed(), placed.pins(pose))
    }

    /// A linkage near another one that satisfies the constraints: each that is violated is corrected by the shortest
    /// motion, in turn. `None` if they are not all satisfied after a while.
    pub fn nearest(&self, linkage: &Parameters, is_frame_longer: bool) -> Option<Parameters> {
        const ROUNDS: usize = 50;
        /// A correction that is a little too long ends.
        const BEYOND: f64 = 1e-12;
        let mut linkage = *linkage;
        for _ in 0..ROUNDS {
            let constraints = self.constraints(&linkage, is_frame_longer);
            if constraints.iter().all(|(value, _)| *value >= 0.0) {
                return Some(linkage);
            }
            for (value, rates) in constraints.iter().filter(|(value, _)| *value < 0.0) {
                let motion = rates * ((BEYOND - value) / rates.norm_squared());
                linkage = linkage.moved(&motion.into());
            }
        }
        None
    }

    /// The motion that minimizes a quadratic function, given by its factored matrix and by the motion to its minimum, as far
    /// as the linearized constraints allow it, with a further one. Their multipliers are found one after the other, round by round
    /// (Hildreth 1957).
    pub fn constrained_step(
        &self,
        linkage: &Parameters,
        is_frame_longer: bool,
        further: Option<&Constraint>,
        (matrix, free): (&Cholesky<f64, Const<COUNT>>, Motion),
    ) -> Motion {
        const ROUNDS: usize = 60;
        /// The accuracy in sizes of the target; what remains is corrected after the step.
        const ACCURACY: f64 = 1e-12;
        let mut constraints = self.constraints(linkage, is_frame_longer);
        constraints.extend(further);
        if constraints.iter().all(|(value, rates)| value + rates.dot(&free) >= 0.0) {
            return free;
        }
        let responses: Vec<Motion> = constraints.iter().map(|(_, rates)| matrix.solve(rates)).collect();
        let mut multipliers = vec![0.0; constraints.len()];
        let mut motion = free;
        for _ in 0..ROUNDS {
            let mut change = 0.0f64;
            for (((value, rates), response), multiplier) in constraints.iter().zip(&responses).zip(&mut multipliers) {
                let stiffness = rates.dot(response).max(f64::MIN_POSITIVE);
                let next = f64::max(0.0, *multiplier - (value + rates.dot(&motion)) / stiffness);
                let by = next - *multiplier;
                if by != 0.0 {
                    motion += response * by;
                    *multiplier = next;
                    change = change.max((by * stiffness).abs());
                }
            }
            if change < ACCURACY {
                break;
            }
        }
        motion
    }
}

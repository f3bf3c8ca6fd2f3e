//! A linkage that guides the body through poses, solved: its circuit, its crank, and how near it comes.

use super::body::{Placed, PoseSet};
use super::condition::PoseCondition;
use super::guide::{Form, Guide};
use super::pair::{Misfit, PosedDyad, Wish, ordered_range, passing, pins};
use crate::complex::{Complex, length};
use coupler_curves::geometry::{Point, trig};
use coupler_curves::linkage::{DyadId, Linkage};
use coupler_curves::measure::{Measure, MeasureSet};
use coupler_curves::motion::{Pass, find_circuits, poses};
use coupler_curves::solve::{SolvedCell, Solver};

/// A linkage that guides a body through poses, in their unit and axes.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseAnswer {
    /// The linkage.
    pub guide: Guide,
    /// The crank pin, and the pin of the rocker or slider, or the foot of the perpendicular from the block's pivot to the coupler's line, at each
    /// pose as it is passed.
    pub pins: Vec<[Point; 2]>,
    /// The angle from the x-axis to the crank at each pose in degrees, continuous along the motion.
    pub inputs_deg: Vec<f64>,
    /// How far the body is from each pose when it is nearest to it, and by how many degrees it is turned from it; of the linkage as it is
    /// solved.
    pub errors: Vec<PoseDeviation>,
    /// The number of the circuit at the first pose, from 1, among those of [`Guide::template`].
    pub circuit: usize,
    /// The branch at the first pose: 1 left or ahead, -1 right or behind; of an inverted slider-crank, that of the foot from the block's pivot towards the crank pin.
    pub branch: i8,
    /// Whether all poses are on one branch of one circuit.
    pub on_one_branch: bool,
    /// Whether the poses are passed in their order.
    pub in_order: bool,
    /// The class of a four-bar; empty for the others.
    pub class: &'static str,
    /// Whether the crank turns fully.
    pub is_full_turn: bool,
    /// The worst transmission angle in degrees, 0 to 90: from the first pose to the last, and over the whole circuit.
    pub mu_worst_deg: [f64; 2],
    /// The greatest distance of two joints of a link.
    pub longest_link: f64,
}

/// How far a body is from a pose.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PoseDeviation {
    /// The distance of its point.
    pub distance: f64,
    /// How far it is turned from it, in degrees, -180 to 180.
    pub angle_deg: f64,
}

/// A pose on a circuit.
struct Located {
    circuit: usize,
    branch: i8,
    input: f64,
    /// The pins and the body's point.
    points: [Point; 3],
}

/// Two dyads, and the poses that their pins are in: those that are given, or those nearest to them.
pub(super) struct Candidate<'a> {
    pub set: &'a PoseSet,
    pub passed: &'a [Placed],
    pub crank: &'a PosedDyad,
    pub follower: &'a PosedDyad,
}

impl PoseAnswer {
    /// Solves the linkage of two dyads.
    ///
    /// # Errors
    /// Why it does not pass the poses as asked for.
    pub(super) fn solve(
        candidate: &Candidate,
        wish: &Wish,
        condition: Option<&PoseCondition>,
    ) -> Result<PoseAnswer, Misfit> {
        let Candidate { set, passed, crank, follower } = candidate;
        let passing = passing(crank, follower, wish)?;
        let guide = Guide::new(set, &passed[0], crank, follower).ok_or(Misfit::NoLinkage)?;
        let own_condition = match condition {
            Some(condition) => Some(condition.of(&guide).ok_or(Misfit::Condition)?),
            None => None,
        };
        let mut family = guide.family().ok_or(Misfit::Unsolved)?;
        let used = own_condition.map_or(MeasureSet::EMPTY, |condition| family.measures_in(condition.compiled()));
        let reported = MeasureSet::EMPTY.with(Measure::CLASS).with(Measure::MU_WORST);
        let solved = Solver::new(&family).measuring(used | reported).solve(0).ok_or(Misfit::Unsolved)?;
        let located = candidate.locate(&solved.linkage).ok_or(Misfit::Unsolved)?;
        let first = &located[0];
        let curve = solved.curves.iter().find(|curve| curve.circuit == first.circuit).ok_or(Misfit::Unsolved)?;
        let is_full_turn = solved.circuit(curve).is_full_turn();
        if wish.full_turn && !is_full_turn {
            return Err(Misfit::NoFullTurn);
        }
        let on_one_circuit = located.iter().all(|at| at.circuit == first.circuit);
        let on_one_branch = on_one_circuit && located.iter().all(|at| at.branch == first.branch);
        if !on_one_branch && !wish.any_circuit {
            return Err(if on_one_circuit { Misfit::Branches } else { Misfit::Circuits });
        }
        let angles: Vec<f64> = located.iter().map(|at| trig::radians(at.input)).collect();
        let range = ordered_range(&angles, is_full_turn).filter(|_| on_one_branch);
        if range.is_none() && on_one_branch && !wish.any_order {
            return Err(Misfit::Order);
        }
        family.filter = own_condition.map(|condition| condition.compiled().clone());
        if !family.keeps(&solved.cell, &curve.values) {
            return Err(Misfit::Condition);
        }
        let turned = |at: &Located| match range {
            Some([from, to]) if is_full_turn => {
                let sign = (to - from).signum();
                first.input + sign * (sign * (at.input - first.input)).rem_euclid(360.0)
            }
            _ => at.input,
        };
        // From the direction of the second pin from that of the crank, which a slot reverses on its other branch.
        let [a, b] = pins(crank, follower, 0);
        let to_body = (b - a) * passed[0].direction.conj() / length(b - a);
        let is_reversed = |at: &Located| guide.form() == Form::InvertedSliderCrank && at.branch != first.branch;
        Ok(PoseAnswer {
            inputs_deg: located.iter().map(turned).collect(),
            pins: located.iter().map(|at| [at.points[0], at.points[1]]).collect(),
            errors: located
                .iter()
                .zip(set.poses())
                .map(|(at, pose)| {
                    let [a, b, m] = at.points;
                    let direction = Complex::new(b.x - a.x, b.y - a.y) * to_body.conj();
                    let direction = if is_reversed(at) { -direction } else { direction };
                    let turned = trig::degrees(trig::atan2(direction.im, direction.re)) - pose.angle_deg;
                    let away = m - pose.point;
                    PoseDeviation {
                        distance: away.norm_squared().sqrt(),
                        angle_deg: (turned + 180.0).rem_euclid(360.0) - 180.0,
                    }
                })
                .collect(),
            circuit: first.circuit,
            branch: first.branch,
            on_one_branch,
            in_order: range.is_some(),
            class: curve.measure(Measure::CLASS).unwrap_or(""),
            is_full_turn,
            mu_worst_deg: [
                90.0 - trig::degrees(trig::asin(passing.worst_cosine)),
                curve.measure(Measure::MU_WORST).unwrap_or(f64::NAN),
            ],
            longest_link: set.size() * super::pair::longest_link(crank, follower),
            guide,
        })
    }

    /// The root of the mean square of the errors, with angles in radians times a length.
    pub fn rms(&self, angle_length: f64) -> f64 {
        let square = |error: &PoseDeviation| {
            let by_angle = angle_length * trig::radians(error.angle_deg);
            error.distance * error.distance + by_angle * by_angle
        };
        (self.errors.iter().map(square).sum::<f64>() / self.errors.len() as f64).sqrt()
    }

    /// The greatest error of the place, and of the angle in degrees.
    pub fn greatest_error(&self) -> PoseDeviation {
        let greatest = |value: fn(&PoseDeviation) -> f64| self.errors.iter().map(value).fold(0.0, f64::max);
        PoseDeviation { distance: greatest(|e| e.distance), angle_deg: greatest(|e| e.angle_deg.abs()) }
    }

    /// The positions of the joints of [`Guide::template`] at the first pose.
    pub fn joints(&self, solved: &SolvedCell) -> Vec<Point> {
        let input = self.inputs_deg[0];
        let circuits = find_circuits(&solved.linkage).circuits;
        let passes = circuits.get(self.circuit - 1).map_or(Vec::new(), |circuit| circuit.passes.clone());
        let mut on_branch = passes.iter().filter(|pass| pass.mode.sign(DyadId::FIRST) == self.branch);
        let found = on_branch.find_map(|pass| Some((pass, input_within(pass, input)?)));
        found.map_or(Vec::new(), |(pass, input)| coupler_curves::motion::pose(&solved.linkage, pass, input))
    }

    /// The solved linkage with the curve of the body's point on the circuit of the first pose only, without measures.
    pub fn solved(&self) -> Option<SolvedCell> {
        let family = self.guide.family()?;
        let solved = Solver::new(&family).measuring(MeasureSet::EMPTY).solve(0)?;
        let curve = solved.curves.iter().find(|curve| curve.circuit == self.circuit)?;
        Some(solved.with_curve(curve))
    }
}

/// The input, by whole turns, on a pass.
fn input_within(pass: &Pass, input: f64) -> Option<f64> {
    /// Of an input at a limit, in degrees: there half of its digits are lost.
    const ROUNDING: f64 = 1e-6;
    let [low, high] = pass.input_range();
    let input = low - ROUNDING + (input - low + ROUNDING).rem_euclid(360.0);
    (input <= high + ROUNDING).then(|| input.clamp(low, high))
}

impl Candidate<'_> {
    /// Where the poses are on the circuits; `None` if the solved linkage is not in one of them.
    fn locate(&self, linkage: &Linkage) -> Option<Vec<Located>> {
        /// Of places, in sizes of the poses: at limits the place follows the root of the rounding of the input.
        const NEAR: f64 = 1e-6;
        let circuits = find_circuits(linkage).circuits;
        let joints = ["O", "A", "B", "M"].map(|name| linkage.find_joint(name));
        let [Some(pivot), Some(crank_pin), Some(other_pin), Some(point)] = joints else { return None };
        let locate = |k: usize| {
            let [a, b] = pins(self.crank, self.follower, k);
            let own = [a, b, self.passed[k].point].map(|z| self.set.place(z));
            let mut best: Option<(f64, Located)> = None;
            for (number, circuit) in (1..).zip(&circuits) {
                for pass in &circuit.passes {
                    let at_end = poses(linkage, pass, &[pass.from.input.value]);
                    let arm = own[0] - at_end.point(pivot, 0);
                    let Some(input) = input_within(pass, trig::degrees(trig::atan2(arm.y, arm.x))) else { continue };
                    let placed = poses(linkage, pass, &[input]);
                    let points = [crank_pin, other_pin, point].map(|joint| placed.point(joint, 0));
                    let away = points.iter().zip(&own).map(|(p, q)| (p - q).norm_squared().sqrt()).fold(0.0, f64::max);
                    if away.is_finite() && best.as_ref().is_none_or(|(least, _)| away < *least) {
                        let branch = pass.mode.sign(DyadId::FIRST);
                        best = Some((away, Located { circuit: number, branch, input, points }));
                    }
                }
            }
            best.filter(|(away, _)| *away <= NEAR * self.set.size()).map(|(_, located)| located)
        };
        (0..self.passed.len()).map(locate).collect()
    }
}

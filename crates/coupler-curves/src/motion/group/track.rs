//! Poses and rates on a part of a group's curve on which the input rises or falls.

use std::sync::Arc;

use nalgebra::DVector;

use super::equations::Equations;
use super::step::Node;
use super::turn_poses::{Base, Turn};
use crate::geometry::{Point, trig};
use crate::linkage::JointId;
use crate::motion::joint_series::SeriesInput;
use crate::motion::series::{Series, VectorSeries};

/// The poses of a linkage with a group on a part of a circuit on which the input is monotonic.
#[derive(Clone)]
pub struct GroupTrack {
    poses: Poses,
    /// What the input of a pass is greater by than that of the poses, a whole number of turns, in degrees.
    shift: f64,
    /// The equations of a linkage that differs little, if the poses are those of one.
    neighbour: Option<Arc<Equations>>,
    /// Poses of a turn from which those of its neighbours are found, in the order of their inputs: others are found where they are asked for.
    bases: Arc<[Base]>,
}

/// What tracks share.
#[derive(Clone)]
enum Poses {
    /// Exact, from nodes that are proven to be on one curve.
    Exact(Arc<Nodes>),
    /// Of a turn that is not proven.
    Turn(Arc<Turn>),
}

struct Nodes {
    equations: Arc<Equations>,
    /// In the order of rising input.
    nodes: Vec<Node>,
    /// Whether the last is the first again, some turns later, and the input never reverses.
    is_closed: bool,
}

impl std::fmt::Debug for GroupTrack {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match &self.poses {
            Poses::Exact(nodes) => write!(f, "GroupTrack of {} nodes", nodes.nodes.len()),
            Poses::Turn(_) => f.write_str("GroupTrack of a turn"),
        }
    }
}

/// Only what is proven is known to be the same.
impl PartialEq for GroupTrack {
    fn eq(&self, other: &GroupTrack) -> bool {
        let (Poses::Exact(own), Poses::Exact(nodes)) = (&self.poses, &other.poses) else { return false };
        self.shift == other.shift && own.nodes == nodes.nodes && self.neighbour.is_none() && other.neighbour.is_none()
    }
}

impl GroupTrack {
    /// The poses between nodes in the order of rising input; `is_closed` if the last is the first again, some turns later.
    pub(super) fn new(equations: Arc<Equations>, nodes: Vec<Node>, is_closed: bool) -> GroupTrack {
        GroupTrack::of(Poses::Exact(Arc::new(Nodes { equations, nodes, is_closed })))
    }

    /// The poses of a turn.
    pub(super) fn of_turn(turn: Turn) -> GroupTrack {
        GroupTrack::of(Poses::Turn(Arc::new(turn)))
    }

    fn of(poses: Poses) -> GroupTrack {
        GroupTrack { poses, shift: 0.0, neighbour: None, bases: Arc::new([]) }
    }

    /// The same; of a turn that is not proven what its neighbours have in common at some inputs is found once for all of them.
    pub(super) fn based_at(&self, inputs: &[f64]) -> GroupTrack {
        let Poses::Turn(turn) = &self.poses else { return self.clone() };
        let mut bases: Vec<Base> = inputs.iter().map(|input| turn.base(turn.own_input(input - self.shift))).collect();
        bases.sort_by(|a, b| a.input().total_cmp(&b.input()));
        GroupTrack { bases: bases.into(), ..self.clone() }
    }

    /// The same on a pass whose input is greater by that many degrees, a whole number of turns.
    pub(in crate::motion) fn shifted(&self, deg: f64) -> GroupTrack {
        GroupTrack { shift: self.shift + deg, ..self.clone() }
    }

    /// The poses of a linkage that differs little, at the same inputs; `None` if they do not go all around, so that they may end at others.
    pub(super) fn of_neighbour(&self, equations: Equations) -> Option<GroupTrack> {
        let own = self.own_equations();
        let is_turn = match &self.poses {
            Poses::Exact(nodes) => nodes.is_closed,
            Poses::Turn(_) => true,
        };
        let is_alike = is_turn && own.joints == equations.joints && equations.is_angle;
        is_alike.then(|| GroupTrack { neighbour: Some(Arc::new(equations)), ..self.clone() })
    }

    /// The equations of the linkage from whose poses these are found.
    fn own_equations(&self) -> &Equations {
        match &self.poses {
            Poses::Exact(nodes) => &nodes.equations,
            Poses::Turn(turn) => &turn.equations,
        }
    }

    /// The equations of the linkage whose poses these are.
    fn equations(&self) -> &Equations {
        self.neighbour.as_deref().unwrap_or_else(|| self.own_equations())
    }

    /// Gives the positions of the joints of the group at an input.
    pub(in crate::motion) fn positions(&self, input: f64, each: impl FnMut((JointId, Point))) {
        self.equations().positions(&self.state(input)).for_each(each);
    }

    /// Positions of the group's joints and their first Taylor coefficients per radian, or unit of length, at an input.
    ///
    /// At a change point they are those of the motion that continues. At a limit the rates of the coordinates that change there are infinite; those of others, such as across a fixed line, are 0.
    pub(in crate::motion) fn series<const N: usize>(
        &self,
        input: SeriesInput<f64>,
        is_end: bool,
    ) -> Vec<(JointId, VectorSeries<f64, N>)> {
        /// Slower than this, relative to the fastest, a coordinate does not change at a limit.
        const AT_REST: f64 = 1e-12;
        let equations = self.equations();
        let state = self.state(input.value);
        let nodes = match &self.poses {
            Poses::Exact(nodes) if is_end => Some((nodes, nodes.own_input(input.value - self.shift))),
            _ => None,
        };
        let limit = nodes.and_then(|(nodes, own)| nodes.end_at(own));
        if let Some((nodes, own)) = nodes.filter(|_| limit.is_some_and(|node| node.is_change)) {
            return self.series_at_change(nodes, own);
        }
        let n = equations.unknown_count();
        let constant = |k: usize| Series::constant(state[k]);
        let mut unknowns: Vec<VectorSeries<f64, N>> =
            (0..n / 2).map(|k| VectorSeries { x: constant(2 * k), y: constant(2 * k + 1) }).collect();
        let lu = equations.matrix_without(&equations.jacobian(&state), n).lu();
        for order in 1..N {
            let residuals = equations.in_input(unknowns.clone(), input);
            let known = DVector::from_iterator(n, residuals.iter().map(|series| -series.0[order]));
            let solved = if limit.is_some() { None } else { lu.solve(&known) };
            for (k, unknown) in unknowns.iter_mut().enumerate() {
                let rate = |k: usize| match (&solved, limit) {
                    (Some(solved), _) => solved[k],
                    (None, Some(limit)) if limit.tangent[k].abs() <= AT_REST => 0.0,
                    (None, _) => f64::INFINITY,
                };
                (unknown.x.0[order], unknown.y.0[order]) = (rate(2 * k), rate(2 * k + 1));
            }
        }
        let placed = |at: VectorSeries<f64, N>| equations.placed(at);
        equations.joints.iter().copied().zip(unknowns.into_iter().map(placed)).collect()
    }

    /// The same at an end that is a change point: the series at an input beside it, expanded there. Velocities have about nine digits, accelerations
    /// seven.
    fn series_at_change<const N: usize>(&self, nodes: &Nodes, end: f64) -> Vec<(JointId, VectorSeries<f64, N>)> {
        /// Of so many terms, at that distance, in radians or relative to the size.
        const TERMS: usize = 16;
        const BESIDE: f64 = 0.015;
        let Nodes { equations, nodes, .. } = nodes;
        let n = equations.unknown_count();
        let [low, high] = [nodes[0].state[n], nodes[nodes.len() - 1].state[n]];
        let inwards = BESIDE.min((high - low) / 4.0);
        let beside = if end < (low + high) / 2.0 { low + inwards } else { high - inwards };
        let unit = if equations.is_angle { 1.0 } else { equations.size };
        let by = (end - beside) * unit;
        let value = equations.input_value(beside) + self.shift;
        let (cos, sin) = if equations.is_angle { trig::cos_sin_deg(value) } else { (0.0, 0.0) };
        let input = SeriesInput { value, direction: [cos, sin] };
        let series: Vec<(JointId, VectorSeries<f64, TERMS>)> = self.series(input, false);
        let moved = |series: Series<f64, TERMS>| {
            // Repeated division by (t - by), which leaves the coefficients about `by`.
            let mut c = series.0;
            for k in 0..TERMS {
                for j in (k..TERMS - 1).rev() {
                    c[j] += by * c[j + 1];
                }
            }
            Series(std::array::from_fn(|k| c[k]))
        };
        series.into_iter().map(|(joint, at)| (joint, VectorSeries { x: moved(at.x), y: moved(at.y) })).collect()
    }

    /// The state at an input: on nodes the one that Newton's method finds from those next to it.
    fn state(&self, input: f64) -> Vec<f64> {
        let input = input - self.shift;
        match (&self.poses, &self.neighbour) {
            (Poses::Exact(nodes), None) => nodes.state(nodes.own_input(input)),
            (Poses::Exact(nodes), Some(other)) => nodes.state_of_neighbour(other, nodes.own_input(input)),
            (Poses::Turn(turn), None) => turn.state(turn.own_input(input)),
            (Poses::Turn(turn), Some(other)) => {
                let own = turn.own_input(input);
                match self.bases.binary_search_by(|base| base.input().total_cmp(&own)) {
                    Ok(number) => self.bases[number].state_of_neighbour(&turn.equations, other),
                    Err(_) => turn.base(own).state_of_neighbour(&turn.equations, other),
                }
            }
        }
    }

    /// Whether a state is a pose of the track, at whole turns from its input or not.
    pub(super) fn passes(&self, state: &[f64]) -> bool {
        matches!(&self.poses, Poses::Exact(nodes) if nodes.passes(state))
    }
}

impl Nodes {
    /// The state of a linkage that differs little, by Newton's method from that of the nodes.
    fn state_of_neighbour(&self, other: &Equations, own: f64) -> Vec<f64> {
        let n = other.unknown_count();
        let mut guess = self.guess(own);
        guess[n] = own;
        let guess = other.state_of(&self.equations, guess);
        other.corrected(guess.clone(), n).unwrap_or(guess)
    }

    /// About the state at an input of the nodes.
    fn guess(&self, own: f64) -> Vec<f64> {
        let Nodes { equations, nodes, .. } = self;
        let n = equations.unknown_count();
        let next = nodes.partition_point(|node| node.state[n] < own).clamp(1, nodes.len() - 1);
        nodes[next - 1].at_input(&nodes[next], own)
    }

    /// The state at an input as it is on the nodes.
    fn state(&self, input: f64) -> Vec<f64> {
        let Nodes { equations, nodes, .. } = self;
        let n = equations.unknown_count();
        if let Some(end) = self.end_at(input) {
            return end.state.clone();
        }
        let next = nodes.partition_point(|node| node.state[n] < input).clamp(1, nodes.len() - 1);
        let (before, after) = (&nodes[next - 1], &nodes[next]);
        let mut guess = before.at_input(after, input);
        // Next to a crossing the cubic is more exact than Newton's method, and cannot leave for the other part.
        if before.is_change || after.is_change {
            return guess;
        }
        guess[n] = input;
        equations.corrected(guess.clone(), n).unwrap_or(guess)
    }

    /// The end that an input of the nodes is at, or beyond: at a limit the equations are singular, and next to it a rounding of the input is some
    /// 1e-8 of the pose.
    fn end_at(&self, input: f64) -> Option<&Node> {
        let Nodes { equations, nodes, .. } = self;
        let n = equations.unknown_count();
        // Of degrees that have been radians, and are again.
        let rounding = 8.0 * f64::EPSILON * (1.0 + input.abs());
        let (first, last) = (&nodes[0], &nodes[nodes.len() - 1]);
        match () {
            () if input <= first.state[n] + rounding => Some(first),
            () if input >= last.state[n] - rounding => Some(last),
            () => None,
        }
    }

    /// Whether a state is a pose of the track, at whole turns from its input or not.
    fn passes(&self, state: &[f64]) -> bool {
        /// States this close are one: that of a node is known to rounding, magnified next to limits.
        const SAME: f64 = 1e-6;
        let Nodes { equations, nodes, .. } = self;
        let n = equations.unknown_count();
        let [low, high] = [nodes[0].state[n], nodes[nodes.len() - 1].state[n]];
        let turn = equations.turn().unwrap_or(f64::INFINITY);
        let first = if turn.is_finite() { low + (state[n] - low).rem_euclid(turn) } else { state[n] };
        let mut inputs =
            (0..).map(|k| first + if k == 0 { 0.0 } else { f64::from(k) * turn }).take_while(|at| *at <= high);
        inputs.any(|at| {
            let own = self.state(at);
            low <= at && (0..n).all(|k| (own[k] - state[k]).abs() < SAME)
        })
    }

    /// An input, an angle in degrees or a length, as it is on the nodes, where it may be whole turns from what the pass calls it.
    fn own_input(&self, input: f64) -> f64 {
        /// Beyond an end by less it is the end.
        const ROUNDING: f64 = 1e-9;
        let Nodes { equations, nodes, is_closed } = self;
        let n = equations.unknown_count();
        let input = equations.input_in_state(input);
        let Some(turn) = equations.turn() else { return input };
        let [low, high] = [nodes[0].state[n], nodes[nodes.len() - 1].state[n]];
        if (low - ROUNDING..=high + ROUNDING).contains(&input) {
            return input;
        }
        let period = if *is_closed { high - low } else { turn };
        input - ((input - low + ROUNDING) / period).floor() * period
    }
}

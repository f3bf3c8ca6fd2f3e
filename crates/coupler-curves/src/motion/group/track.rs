//! Poses and rates on a part of a group's curve on which the input rises or falls.

use std::sync::Arc;

use nalgebra::DVector;

use super::equations::Equations;
use super::step::Node;
use crate::geometry::Point;
use crate::linkage::JointId;
use crate::motion::joint_series::SeriesInput;
use crate::motion::series::{Series, VectorSeries};

/// The poses of a linkage with a group on a part of a circuit on which the input is monotonic.
#[derive(Clone)]
pub struct GroupTrack {
    nodes: Arc<Nodes>,
    /// What the input of a pass is greater by than that of the nodes, a whole number of turns, in degrees.
    shift: f64,
}

/// What tracks share.
struct Nodes {
    equations: Arc<Equations>,
    /// In the order of rising input.
    nodes: Vec<Node>,
}

impl std::fmt::Debug for GroupTrack {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "GroupTrack of {} nodes", self.nodes.nodes.len())
    }
}

impl PartialEq for GroupTrack {
    fn eq(&self, other: &GroupTrack) -> bool {
        self.shift == other.shift && self.nodes.nodes == other.nodes.nodes
    }
}

impl GroupTrack {
    /// The poses between nodes in the order of rising input.
    pub(super) fn new(equations: Arc<Equations>, nodes: Vec<Node>) -> GroupTrack {
        GroupTrack { nodes: Arc::new(Nodes { equations, nodes }), shift: 0.0 }
    }

    /// The same on a pass whose input is greater by that many degrees, a whole number of turns.
    pub(in crate::motion) fn shifted(&self, deg: f64) -> GroupTrack {
        GroupTrack { nodes: self.nodes.clone(), shift: self.shift + deg }
    }

    /// The positions of the joints of the group at an input.
    pub(in crate::motion) fn positions(&self, input: f64) -> impl Iterator<Item = (JointId, Point)> + use<> {
        let state = self.state(input);
        self.nodes.equations.positions(&state).collect::<Vec<_>>().into_iter()
    }

    /// Positions of the group's joints and their first Taylor coefficients per radian, or unit of length, at an input.
    ///
    /// At a limit the rates of all joints that move there are infinite.
    pub(in crate::motion) fn series<const N: usize>(
        &self,
        input: SeriesInput<f64>,
        is_limit: bool,
    ) -> Vec<(JointId, VectorSeries<f64, N>)> {
        let equations = &self.nodes.equations;
        let state = self.state(input.value);
        let n = equations.unknown_count();
        let constant = |k: usize| Series::constant(state[k]);
        let mut unknowns: Vec<VectorSeries<f64, N>> =
            (0..n / 2).map(|k| VectorSeries { x: constant(2 * k), y: constant(2 * k + 1) }).collect();
        let lu = equations.matrix_without(&equations.jacobian(&state), n).lu();
        for order in 1..N {
            let residuals = equations.in_input(unknowns.clone(), input);
            let known = DVector::from_iterator(n, residuals.iter().map(|series| -series.0[order]));
            let solved = if is_limit { None } else { lu.solve(&known) };
            for (k, unknown) in unknowns.iter_mut().enumerate() {
                let rate = |k: usize| solved.as_ref().map_or(f64::INFINITY, |solved| solved[k]);
                (unknown.x.0[order], unknown.y.0[order]) = (rate(2 * k), rate(2 * k + 1));
            }
        }
        let size = equations.size;
        let scaled = |at: VectorSeries<f64, N>| VectorSeries { x: at.x.scaled(size), y: at.y.scaled(size) };
        equations.joints.iter().copied().zip(unknowns.into_iter().map(scaled)).collect()
    }

    /// The state at an input: the one that Newton's method finds from the nodes next to it.
    pub(super) fn state(&self, input: f64) -> Vec<f64> {
        let Nodes { equations, nodes } = &*self.nodes;
        let n = equations.unknown_count();
        let own = |node: &Node| node.state[n];
        let last = nodes.len() - 1;
        let input = self.own_input(equations.input_in_state(input - self.shift));
        // At its ends the equations are singular, or all that is known.
        for (node, is_beyond) in [(&nodes[0], input <= own(&nodes[0])), (&nodes[last], input >= own(&nodes[last]))] {
            if is_beyond {
                return node.state.clone();
            }
        }
        let next = nodes.partition_point(|node| own(node) < input).clamp(1, last);
        let (before, after) = (&nodes[next - 1], &nodes[next]);
        let mut guess = before.at_input(after, input);
        guess[n] = input;
        equations.corrected(guess.clone(), n).unwrap_or(guess)
    }
}

impl GroupTrack {
    /// Whether an input is on the track, at whole turns from what it is called.
    pub(super) fn has_input(&self, input: f64) -> bool {
        let Nodes { equations, nodes } = &*self.nodes;
        let n = equations.unknown_count();
        let own = self.own_input(equations.input_in_state(input));
        (nodes[0].state[n]..=nodes[nodes.len() - 1].state[n]).contains(&own)
    }

    /// An input as it is on the track, where it may be whole turns from what a pass calls it.
    fn own_input(&self, input: f64) -> f64 {
        /// Beyond an end by less it is the end.
        const ROUNDING: f64 = 1e-9;
        let Nodes { equations, nodes } = &*self.nodes;
        let n = equations.unknown_count();
        let Some(turn) = equations.turn() else { return input };
        let [low, high] = [nodes[0].state[n], nodes[nodes.len() - 1].state[n]];
        if (low - ROUNDING..=high + ROUNDING).contains(&input) {
            return input;
        }
        input - ((input - low + ROUNDING) / turn).floor() * turn
    }
}

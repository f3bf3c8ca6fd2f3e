//! A full turn of a group by Newton's method alone, and poses of linkages that differ little: for searches, which look at millions of linkages and
//! prove what they find in the end.

use std::sync::Arc;

use super::equations::Equations;
use super::step::Node;
use super::track::GroupTrack;
use crate::linkage::{DyadId, Input, Linkage, Side};
use crate::motion::circuit::UnsampledCircuit;
use crate::motion::interval::{Interval, Span};
use crate::motion::pass::Pass;

/// The steps of a turn.
const STEPS: usize = 60;

/// A pose may be this many times as far from where its tangent leads as the step is long, or the step is halved, this often.
const FARTHEST: f64 = 0.25;
const MOST_HALVES: u32 = 3;

/// The pose after a turn is that before it, to this part of the linkage's size.
const SAME: f64 = 1e-6;

/// The circuit on which the input of a linkage with a group turns fully, once around, from the start pose; `None` if it does not, or the linkage has no
/// group, or a range of the input. It is not proven: where two circuits are very close, a step may lead from one to the other.
pub fn follow_full_turn(linkage: &Linkage) -> Option<UnsampledCircuit> {
    let group = linkage.group.as_ref().filter(|_| linkage.motion_options.range.is_none())?;
    let Input::Angle { turns: 1 } = linkage.input() else { return None };
    let equations = Equations::new(linkage, group)?;
    let start_input = linkage.motion_options.start.unwrap_or(0.0);
    let origin = equations.start(group, start_input).ok()?;
    let nodes = equations.turn_from(origin)?;
    let track = Some(GroupTrack::new(Arc::new(equations), nodes, true));
    let mode = linkage.motion_options.mode.with_side(DyadId::FIRST, Side::Left);
    let turn = Interval { span: Span::FullTurn, mode, track };
    Some(UnsampledCircuit { passes: vec![turn.to_pass(true, linkage.input().period())], is_closed: true })
}

impl Equations {
    /// The nodes of a turn from one on, in the order of rising input.
    fn turn_from(&self, origin: Node) -> Option<Vec<Node>> {
        let n = self.unknown_count();
        let whole = std::f64::consts::TAU / STEPS as f64;
        let first = origin.state[n];
        let mut nodes = vec![risen(origin)?];
        for k in 1..=STEPS {
            let to = first + whole * k as f64;
            while nodes[nodes.len() - 1].state[n] < to {
                let node = &nodes[nodes.len() - 1];
                let next = (0..=MOST_HALVES).find_map(|halves| {
                    // Ends of steps are those of whole ones, to the last bit.
                    let rest = to - node.state[n];
                    let step = whole / f64::from(1u32 << halves);
                    self.step_to(node, if rest < 1.5 * step { to } else { node.state[n] + step })
                });
                nodes.push(next?);
            }
        }
        let last = &nodes[nodes.len() - 1].state;
        let is_same = (0..n).all(|k| (last[k] - nodes[0].state[k]).abs() < SAME);
        is_same.then_some(nodes)
    }

    /// The node at an input that is a little greater, if it is where the tangent leads.
    fn step_to(&self, node: &Node, input: f64) -> Option<Node> {
        let n = self.unknown_count();
        let step = (input - node.state[n]) / node.input_rate();
        let mut ahead = node.ahead(step);
        ahead[n] = input;
        let state = self.corrected(ahead.clone(), n)?;
        let off = state.iter().zip(&ahead).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
        if off > FARTHEST * step {
            return None;
        }
        let next = self.node(state)?.directed_as(node).0;
        (next.input_rate() > 0.0).then_some(next)
    }
}

/// A node in the direction in which the input rises.
fn risen(mut node: Node) -> Option<Node> {
    if node.input_rate() < 0.0 {
        node.tangent.iter_mut().for_each(|rate| *rate = -*rate);
    }
    (node.input_rate() > 0.0).then_some(node)
}

impl Pass {
    /// The same pass of a linkage that differs little, all of whose poses are found from those of this one: of a full turn of a group. `None` if it is
    /// none, or the linkage has another group.
    pub fn of_neighbour(&self, linkage: &Linkage) -> Option<Pass> {
        let equations = Equations::new(linkage, linkage.group.as_ref()?)?;
        let track = self.track.as_ref()?.of_neighbour(equations)?;
        Some(Pass { track: Some(track), ..self.clone() })
    }
}

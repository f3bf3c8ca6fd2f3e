//! Follows the curve on which the equations of a group hold, by certified steps, and finds the limits on it.

use super::equations::Equations;
use super::step::{Node, Tube};
use crate::motion::assembly_error::AssemblyError;
use crate::numerical::{Bracket, border};

/// The most nodes of a curve, and the most numbers in them: 16 MB.
const MAX_NODES: usize = 100_000;
const MAX_NUMBERS: usize = 1_000_000;

/// The length of the first step, relative to the size of the linkage and a radian.
const FIRST_STEP: f64 = 0.05;

/// The greatest step: the nodes are also what poses between them are found from.
const MAX_STEP: f64 = 0.25;

/// Where steps become shorter than this two parts of the curve cross, or are closer to each other than that.
const LEAST_STEP: f64 = 1e-9;

/// How far from a crossing the curve is taken up again: far enough that Newton's method tells its parts apart.
const REACH_OF_CHANGE: f64 = 1e-3;

/// Within this of a limit, relative to the size, poses next to it are found from it.
const LEAST_DISTANCE_FROM_LIMIT: f64 = 1e-7;

/// Beyond this many times the size, the curve has left the linkage: a slider on a line that is parallel to another.
const FARTHEST: f64 = 1e3;

/// A closed curve in the direction of its tangents: the last node is the first again, apart from whole turns of the input.
#[derive(Debug, Default)]
pub(super) struct Curve {
    pub nodes: Vec<Node>,
    /// The indices of the nodes at which the input reverses, and of those at which another part of the curve crosses it.
    pub ends: Vec<usize>,
}

impl Equations {
    /// The curve through a node.
    ///
    /// # Errors
    /// Two parts of it cross, or it leads to infinity.
    pub fn follow(&self, origin: &Node) -> Result<Curve, AssemblyError> {
        let mut curve = Curve { nodes: vec![origin.clone()], ..Curve::default() };
        let mut length = FIRST_STEP;
        loop {
            let node = &curve.nodes[curve.nodes.len() - 1];
            let Some(tube) = self.certified_step(node, length) else {
                length /= 2.0;
                if length < LEAST_STEP {
                    let crossed = self.crossed(&curve.nodes);
                    let (kept, change, after) = crossed.ok_or_else(|| self.error_at(node))?;
                    curve.nodes.truncate(kept);
                    curve.ends.push(curve.nodes.len());
                    curve.nodes.extend([change, after]);
                    length = REACH_OF_CHANGE / 4.0;
                }
                continue;
            };
            let unknowns = &node.state[..self.unknown_count()];
            let is_full = curve.nodes.len() > MAX_NODES.min(MAX_NUMBERS / node.state.len());
            if is_full || unknowns.iter().any(|x| x.abs() > FARTHEST) {
                return Err(AssemblyError::GroupTooLong { input: self.input(&node.state) });
            }
            let closing = (curve.nodes.len() > 1).then(|| self.origin_in(&tube, node, origin)).flatten();
            let next = match &closing {
                // With the same direction, to the last bit: at a limit its sign is rounding.
                Some(state) => Some(Node { state: state.clone(), ..origin.clone() }),
                None => {
                    let corrected = self.corrected(node.ahead(length), tube.parameter);
                    let inside = corrected.filter(|state| tube.position_of(node, state).is_some());
                    inside.and_then(|state| self.node(state)).map(|next| next.directed_as(node).0)
                }
            };
            // In the tube there is a solution; that it is not found, or that its direction is not, is for lack of digits.
            let Some(next) = next else { return Err(self.error_at(node)) };
            let before = node.clone();
            if (before.input_rate() > 0.0) != (next.input_rate() > 0.0) {
                let limit = self.limit_between(&before, &next);
                // Of this curve, and not of one that is near.
                let limit = limit.filter(|limit| tube.position_of(&before, &limit.state).is_some());
                let limit = limit.ok_or_else(|| self.error_at(&before))?;
                curve.ends.push(curve.nodes.len());
                curve.nodes.push(limit);
            }
            curve.nodes.push(next);
            if closing.is_some() {
                return Ok(curve);
            }
            let growth = if tube.contraction < 0.3 { 2.0 } else { 1.2 };
            length = (length * growth).min(MAX_STEP);
        }
    }

    /// The curve beyond a point where another part crosses it, which steps from the last node do not reach: how many nodes are kept, the node there,
    /// and the first beyond it. The curve goes on as it came, in the direction of its cubic.
    ///
    /// This is not proven: parts of the curve that pass each other within [`LEAST_STEP`] are taken to cross.
    fn crossed(&self, nodes: &[Node]) -> Option<(usize, Node, Node)> {
        let last = nodes.last()?;
        // The last nodes are so near that their directions are rounding: the cubic is that of two before them.
        let node_at = |distance: f64| nodes.iter().rposition(|node| node.distance(last) >= distance);
        let (kept, first) = (node_at(REACH_OF_CHANGE)?, node_at(3.0 * REACH_OF_CHANGE)?);
        let (before, first) = (&nodes[kept], &nodes[first]);
        let ahead = (before.distance(last) + REACH_OF_CHANGE) / first.distance(before);
        let guess = first.towards(before, 1.0 + ahead);
        let state = self.corrected(guess.clone(), last.parameter())?;
        let miss = state.iter().zip(&guess).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        let (after, sense) = self.node(state)?.directed_as(last);
        let sense_before = self.orientation(&before.state, &before.tangent);
        // Beyond a crossing the determinant has the other sign; and the curve is smooth.
        let is_smooth = miss < REACH_OF_CHANGE / 1000.0 && before.input_rate() * after.input_rate() > 0.0;
        if sense == sense_before || !is_smooth {
            return None;
        }
        let direction = |share: f64| {
            let [a, b] = [share - 1e-3, share + 1e-3].map(|share| before.towards(&after, share));
            let ahead: Vec<f64> = a.iter().zip(&b).map(|(a, b)| b - a).collect();
            let norm = ahead.iter().map(|rate| rate * rate).sum::<f64>().sqrt();
            ahead.into_iter().map(|rate| rate / norm).collect::<Vec<f64>>()
        };
        let is_before =
            |share: f64| self.orientation(&before.towards(&after, share), &direction(share)) == sense_before;
        let [share, _] = border([0.0, 1.0], f64::EPSILON, is_before);
        let change = Node { state: before.towards(&after, share), tangent: direction(share), is_change: true };
        Some((kept + 1, change, after))
    }

    /// A tube of that length on which the input has one limit at most.
    fn certified_step(&self, node: &Node, length: f64) -> Option<Tube> {
        /// In a shorter tube the rates of the input at both ends decide.
        const SHORT: f64 = 1e-6;
        let tube = self.tube(node, length)?;
        let is_sure = tube.input_rates.iter().any(|rate| !rate.contains(0.0));
        (is_sure || tube.parameter == self.unknown_count() || length < SHORT).then_some(tube)
    }

    /// The origin of the curve, if it is in a tube; its input is that at which it is reached again.
    fn origin_in(&self, tube: &Tube, node: &Node, origin: &Node) -> Option<Vec<f64>> {
        let input = self.unknown_count();
        let mut state = origin.state.clone();
        if let Some(turn) = self.turn() {
            let middle = node.ahead(tube.length / 2.0)[input];
            state[input] += ((middle - state[input]) / turn).round() * turn;
        }
        tube.position_of(node, &state).is_some().then_some(state)
    }

    /// The node between two at which the input does not change.
    fn limit_between(&self, before: &Node, after: &Node) -> Option<Node> {
        let held = before.parameter();
        let places = [before, after].map(|node| node.state[held]);
        let node_at = |at: f64| {
            let mut guess = before.towards(after, (at - places[0]) / (places[1] - places[0]));
            guess[held] = at;
            Some(self.node(self.corrected(guess, held)?)?.directed_as(before).0)
        };
        let bracket = Bracket::new(places, [before, after].map(Node::input_rate))?;
        node_at(bracket.zero(0.0, |at| node_at(at).map_or(f64::NAN, |node| node.input_rate())))
    }

    /// Nodes from a limit on, with others between them so that each is at most a few times as far from the limit as the one before: next to
    /// it, the curve in the input is as narrow as it is near.
    pub fn graded(&self, nodes: Vec<Node>) -> Vec<Node> {
        /// How much farther.
        const RATIO: f64 = 4.0;
        let limit = nodes[0].clone();
        let mut out: Vec<Node> = vec![limit.clone()];
        for next in nodes.into_iter().skip(1) {
            let far = next.distance(&limit);
            // Each is about four times as far as the one before.
            for _ in 0..64 {
                let last = &out[out.len() - 1];
                let near = last.distance(&limit);
                let wanted = RATIO * near.max(LEAST_DISTANCE_FROM_LIMIT / RATIO);
                if far <= 1.5 * wanted {
                    break;
                }
                let guess = last.towards(&next, (wanted - near) / (far - near));
                let between = self.corrected(guess, last.parameter()).and_then(|state| self.node(state));
                let between = between.map(|node| node.directed_as(last).0);
                match between.filter(|node| node.distance(&limit) > near) {
                    Some(node) => out.push(node),
                    None => break,
                }
            }
            out.push(next);
        }
        out
    }

    /// The error where a curve cannot be followed.
    pub fn error_at(&self, node: &Node) -> AssemblyError {
        AssemblyError::GroupNotFollowed { input: self.input(&node.state) }
    }
}

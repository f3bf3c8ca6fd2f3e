//! The intervals of the input on the circuits of a group.

use std::collections::HashMap;
use std::sync::Arc;

use super::equations::Equations;
use super::follow::Curve;
use super::step::Node;
use super::track::GroupTrack;
use crate::geometry::{Point, Vector, cross};
use crate::linkage::{CircuitSelection, DyadId, Group, Input, Joint, JointId, JointKind, Linkage, Side};
use crate::motion::assembly_error::AssemblyError;
use crate::motion::interval::{EndCause, Interval, IntervalEnd, Span};
use crate::motion::pass::InputPosition;

/// The positions of joints by their names, in any frame.
pub(in crate::motion) type NamedPose<'a> = HashMap<&'a str, Point>;

/// The intervals of the input on the circuits of a linkage with a group through the start pose and through others, and the
/// index of the one with the start pose.
///
/// # Errors
/// The group does not close at the start, or its motion cannot be followed.
pub(in crate::motion) fn find_intervals(
    linkage: &Linkage,
    group: &Group,
    poses: &[NamedPose],
) -> Result<(Vec<Interval>, usize), AssemblyError> {
    let equations = Equations::new(linkage, group).ok_or(AssemblyError::GroupOfGears)?;
    let start = equations.start(group, linkage.motion_options.start.unwrap_or(0.0))?;
    if let Some(error) = equations.held_input(&start, linkage) {
        return Err(error);
    }
    let mut intervals = TrackIntervals {
        linkage,
        equations: Arc::new(equations),
        start_rises: start.input_rate() > 0.0,
        found: Vec::new(),
        next_id: 2,
    };
    intervals.follow(&start)?;
    for pose in poses {
        let Some(node) = intervals.node_of_pose(pose) else { continue };
        if !intervals.contains(&node) {
            intervals.follow(&node)?;
        }
    }
    if linkage.motion_options.circuits == CircuitSelection::All && linkage.driven_elsewhere.is_none() {
        intervals.follow_all_at_start(linkage.motion_options.start.unwrap_or(0.0))?;
    }
    let Some(range) = linkage.motion_options.range else { return Ok((intervals.found, 0)) };
    let start = linkage.motion_options.start.unwrap_or(0.0);
    let [first, rest @ ..] = &intervals.found[..] else { return Err(AssemblyError::NoStart) };
    let of_start = within(first, range, linkage.input());
    let period = linkage.input().period();
    let index = of_start.iter().position(|interval| interval.span.wrap(start, period).is_some());
    let index = index.ok_or(AssemblyError::StartOutOfRange { start, range })?;
    let others = rest.iter().flat_map(|interval| within(interval, range, linkage.input()));
    Ok((of_start.into_iter().chain(others).collect(), index))
}

/// The parts of an interval within a range of the input.
fn within(interval: &Interval, [from, to]: [f64; 2], input: Input) -> Vec<Interval> {
    let period = input.period();
    let end = |at: f64, id: usize| IntervalEnd::range_end(InputPosition::new(input, at), id);
    let of_span = |span: Span| Interval { span, ..interval.clone() };
    let Span::Range { lower, upper } = interval.span else {
        let is_part = to - from < period;
        return vec![if is_part {
            of_span(Span::Range { lower: end(from, 0), upper: end(to, 1) })
        } else {
            interval.clone()
        }];
    };
    let [low, high] = [lower.input.value, upper.input.value];
    // The range is met again every turn.
    let turns = match input {
        Input::Angle { .. } => ((low - to) / period).ceil() as i64..=((high - from) / period).floor() as i64,
        Input::Length => 0..=0,
    };
    let part = |turn: i64| {
        let [from, to] = [from, to].map(|at| if turn == 0 { at } else { at + turn as f64 * period });
        let lower = if from > low { end(from, 0) } else { lower };
        let upper = if to < high { end(to, 1) } else { upper };
        (lower.input.value < upper.input.value).then(|| of_span(Span::Range { lower, upper }))
    };
    turns.filter_map(part).collect()
}

/// The intervals of the circuits that have been followed.
struct TrackIntervals<'a> {
    linkage: &'a Linkage,
    equations: Arc<Equations>,
    /// Whether the input rises in the direction of the curve at the start.
    start_rises: bool,
    found: Vec<Interval>,
    next_id: usize,
}

impl TrackIntervals<'_> {
    /// Adds the intervals of the circuit through a node.
    fn follow(&mut self, start: &Node) -> Result<(), AssemblyError> {
        let curve = self.equations.follow(start)?;
        let limits = curve.limits.len();
        for (nodes, ends) in monotonic_parts(curve) {
            let interval = self.interval(nodes, ends);
            self.found.push(interval);
        }
        self.next_id += limits.max(1);
        Ok(())
    }

    /// Adds the intervals of all circuits that pass the input at the start.
    fn follow_all_at_start(&mut self, start: f64) -> Result<(), AssemblyError> {
        let states = self.equations.poses_at(start).ok_or(AssemblyError::TooManyPoses)?;
        for state in states {
            let node = self.equations.node(state).filter(|node| !self.contains(node));
            if let Some(node) = node {
                self.follow(&node)?;
            }
        }
        Ok(())
    }

    /// The interval of a part of a curve, which begins and ends at limits of these numbers or, if there are none, is all of it.
    fn interval(&self, mut nodes: Vec<Node>, ends: [Option<usize>; 2]) -> Interval {
        let equations = &self.equations;
        let rises = nodes[nodes.len() / 2].input_rate() > 0.0;
        // Towards both ends.
        for end in ends {
            if end.is_some() {
                nodes = equations.graded(nodes);
            }
            nodes.reverse();
        }
        let [mut lower, mut upper] = ends;
        if !rises {
            nodes.reverse();
            (lower, upper) = (upper, lower);
        }
        let side = if rises == self.start_rises { Side::Left } else { Side::Right };
        let mode = self.linkage.motion_options.mode.with_side(DyadId::FIRST, side);
        let input = self.linkage.input();
        let [first, last] =
            [&nodes[0], &nodes[nodes.len() - 1]].map(|node| InputPosition::new(input, equations.input(&node.state)));
        let end = |at: InputPosition, limit: Option<usize>| match limit {
            Some(limit) => IntervalEnd::from_flat_dyad(at, EndCause::Limit, DyadId::FIRST, self.next_id + limit),
            // Nothing happens where a curve of several turns begins and ends.
            None => IntervalEnd { cause: EndCause::ChangePoint, ..IntervalEnd::range_end(at, self.next_id) },
        };
        let turns = (last.value - first.value) / input.period();
        let span = match lower {
            None if turns.round() == 1.0 => Span::FullTurn,
            _ => Span::Range { lower: end(first, lower), upper: end(last, upper) },
        };
        Interval { span, mode, track: Some(GroupTrack::new(equations.clone(), nodes)) }
    }

    /// The node of a pose in any frame, by the names of joints; `None` if it is not one of this linkage, or at a singularity.
    fn node_of_pose(&self, pose: &NamedPose) -> Option<Node> {
        let at = |joint: JointId| pose.get(self.linkage.joints[joint].name.as_str()).copied();
        // Two fixed joints show how the frame lies.
        let fixed = self.linkage.links[0].joints.iter().filter_map(|(joint, own)| Some((*own, at(*joint)?)));
        let fixed: Vec<(Vector, Point)> = fixed.collect();
        let ((a, a_there), (b, b_there)) = (fixed.first()?, fixed.get(1)?);
        let (here, there) = (b - a, b_there - a_there);
        let [cos, sin] = [there.dot(&here), cross(there, here)].map(|part| part / there.norm_squared());
        let placed = |joint: JointId| {
            let v = at(joint).map_or(Vector::zeros(), |at| at - a_there);
            Point::from(a + Vector::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y))
        };
        let input = self.linkage.input_of_pose(placed)?;
        let state = self.equations.state(placed, input);
        let held = self.equations.node(state.clone())?.parameter();
        self.equations.node(self.equations.corrected(state, held)?)
    }

    /// Whether a node is on a circuit that has been followed.
    fn contains(&self, node: &Node) -> bool {
        /// States this close are one: that of a node is known to rounding, magnified next to limits.
        const SAME: f64 = 1e-6;
        let tracks = self.found.iter().filter_map(|interval| interval.track.as_ref());
        let input = self.equations.input(&node.state);
        let distance = |track: &GroupTrack| {
            let own = track.state(input);
            let unknowns = own.iter().zip(&node.state).take(own.len() - 1);
            unknowns.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
        };
        tracks.into_iter().any(|track| track.has_input(input) && distance(track) < SAME)
    }
}

/// The parts of a curve between limits, each with the numbers of the limits at which it begins and ends. The first has
/// the curve's first node.
fn monotonic_parts(curve: Curve) -> Vec<(Vec<Node>, [Option<usize>; 2])> {
    let Curve { mut nodes, limits, .. } = curve;
    let Some((&first, &last)) = limits.first().zip(limits.last()) else { return vec![(nodes, [None; 2])] };
    let mut parts = Vec::new();
    for (k, pair) in limits.windows(2).enumerate() {
        parts.push((nodes[pair[0]..=pair[1]].to_vec(), [Some(k), Some(k + 1)]));
    }
    // The end of the curve is its beginning, but for whole turns.
    let input = nodes[0].state.len() - 1;
    let turns = nodes[nodes.len() - 1].state[input] - nodes[0].state[input];
    let mut whole = nodes.split_off(last);
    let head = nodes.get(1..=first).map(<[Node]>::to_vec).unwrap_or_else(|| whole[1..=first].to_vec());
    whole.extend(head.into_iter().map(|mut node| {
        node.state[input] += turns;
        node
    }));
    parts.insert(0, (whole, [Some(limits.len() - 1), Some(0)]));
    parts
}

impl Equations {
    /// The error to report if the input does not move along the curve through a node.
    fn held_input(&self, node: &Node, linkage: &Linkage) -> Option<AssemblyError> {
        /// Slower than this, relative to the fastest, an unknown is at rest.
        const AT_REST: f64 = 1e-12;
        /// At a limit the input is at rest, and a little ahead of it is not.
        const AHEAD: f64 = 1e-3;
        if node.input_rate().abs() > AT_REST {
            return None;
        }
        let ahead = self.corrected(node.ahead(AHEAD), node.parameter()).and_then(|state| self.node(state))?;
        let is_at_rest = |k: usize| [node, &ahead].iter().all(|node| node.tangent[k].abs() <= AT_REST);
        let at_rest = self.joints.iter().enumerate().filter(|(k, _)| is_at_rest(2 * k) && is_at_rest(2 * k + 1));
        let is_driven = |joint: &&Joint| matches!(joint.kind, JointKind::Crank { .. } | JointKind::DrivenSlider { .. });
        let driven = linkage.joints.iter().filter(is_driven);
        let held = driven.chain(at_rest.map(|(_, joint)| &linkage.joints[*joint]));
        let joints = held.map(|joint| joint.name.clone()).collect();
        is_at_rest(self.unknown_count()).then_some(AssemblyError::InputHeld { joints })
    }

    /// The node of the start pose.
    fn start(&self, group: &Group, input: f64) -> Result<Node, AssemblyError> {
        let drawn =
            |joint: JointId| group.joints.iter().find(|(id, _)| *id == joint).map_or(Point::origin(), |(_, at)| *at);
        let drawn = self.state(drawn, input);
        let n = self.unknown_count();
        let closed = self.corrected(drawn.clone(), n).or_else(|| {
            // A pose at a limit.
            let held = self.node(drawn.clone())?.parameter();
            self.corrected(drawn.clone(), held)
        });
        let gap = |state: &[f64]| {
            let zero = vec![0.0; n + 1];
            let residuals = self.along_line::<f64, 1>(state, &zero);
            residuals.iter().fold(0.0, |most: f64, series| most.max(series.0[0].abs())) * self.size
        };
        let open = || AssemblyError::GroupOpen { input, gap: gap(&drawn) };
        self.node(closed.ok_or_else(open)?).ok_or(AssemblyError::GroupNotFollowed { input })
    }
}

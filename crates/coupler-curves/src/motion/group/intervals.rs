//! The intervals of the input on the circuits of a group.

use std::collections::HashMap;
use std::sync::Arc;

use super::equations::Equations;
use super::follow::Curve;
use super::step::Node;
use super::track::GroupTrack;
use crate::geometry::{Complex, Point, Similarity, Vector};
use crate::linkage::{CircuitSelection, DyadId, Group, Input, Joint, JointId, JointKind, Linkage, Side, gcd};
use crate::motion::assembly_error::AssemblyError;
use crate::motion::interval::{EndCause, Interval, IntervalEnd, Span};
use crate::motion::pass::InputPosition;

/// The positions of joints by their names, in any frame.
pub(in crate::motion) type NamedPose<'a> = HashMap<&'a str, Point>;

/// What is found of the circuits of a group.
pub(in crate::motion) struct GroupIntervals {
    pub intervals: Vec<Interval>,
    /// The index of the interval with the start pose.
    pub start: usize,
    /// Why a further circuit is not among them.
    pub missing: Option<AssemblyError>,
}

/// The intervals of the input on the circuits of a linkage with a group through the start pose and through others.
///
/// # Errors
/// The group does not close at the start, or its motion cannot be followed.
pub(in crate::motion) fn find_intervals(
    linkage: &Linkage,
    group: &Group,
    poses: &[NamedPose],
) -> Result<GroupIntervals, AssemblyError> {
    let equations = Equations::new(linkage, group).ok_or(AssemblyError::GroupOfGears)?;
    let start_input = linkage.motion_options.start.unwrap_or(0.0);
    let start = equations.start(group, start_input)?;
    if let Some(error) = equations.held_input(&start, linkage) {
        return Err(error);
    }
    let mut all = TrackIntervals {
        linkage,
        equations: Arc::new(equations),
        start_rises: start.input_rate() > 0.0,
        found: Vec::new(),
        next_id: 2,
        missing: None,
    };
    let turned = all.follow(&start)?;
    for pose in poses {
        all.follow_another(all.node_of_pose(pose));
    }
    if linkage.motion_options.circuits == CircuitSelection::All && linkage.driven_elsewhere.is_none() {
        for state in all.equations.poses_at(start_input).ok_or(AssemblyError::TooManyPoses)? {
            all.follow_another(all.equations.node(state));
        }
    }
    let TrackIntervals { found, missing, .. } = all;
    let Some(range) = linkage.motion_options.range else {
        return Ok(GroupIntervals { intervals: found, start: 0, missing });
    };
    let period = linkage.input().period();
    if (start_input - range[0]).rem_euclid(period) > range[1] - range[0] {
        return Err(AssemblyError::StartOutOfRange { start: start_input, range });
    }
    let [first, rest @ ..] = &found[..] else { return Err(AssemblyError::NoStart) };
    // The start pose is at the end of the curve, which is the first interval, or in it.
    let own_start = start_input + turned;
    let of_start = within(first, range, linkage.input());
    let has_start = |(_, [low, high]): &(Interval, [f64; 2])| (*low..=*high).contains(&own_start);
    let index = of_start.iter().position(has_start);
    let start = index.ok_or(AssemblyError::StartOutOfRange { start: start_input, range })?;
    let others = rest.iter().flat_map(|interval| within(interval, range, linkage.input()));
    let intervals = of_start.into_iter().chain(others).map(|(interval, _)| interval).collect();
    Ok(GroupIntervals { intervals, start, missing })
}

/// The parts of an interval within a range of the input, whose turns they are moved to; and for each the least and the greatest input on the interval
/// itself.
fn within(interval: &Interval, [from, to]: [f64; 2], input: Input) -> Vec<(Interval, [f64; 2])> {
    let period = input.period();
    let everything = [f64::NEG_INFINITY, f64::INFINITY];
    if to - from >= period {
        return vec![(interval.clone(), everything)];
    }
    let end = |at: f64, id: usize| IntervalEnd::range_end(InputPosition::new(input, at), id);
    let Span::Range { lower, upper } = interval.span else {
        let span = Span::Range { lower: end(from, 0), upper: end(to, 1) };
        return vec![(Interval { span, ..interval.clone() }, everything)];
    };
    let [low, high] = [lower.input.value, upper.input.value];
    // The range is met again every turn.
    let turns = match input {
        Input::Angle { .. } => ((low - to) / period).ceil() as i64..=((high - from) / period).floor() as i64,
        Input::Length => 0..=0,
    };
    let part = |turn: i64| {
        let by = if turn == 0 { 0.0 } else { turn as f64 * period };
        let own = [low.max(from + by), high.min(to + by)];
        let lower = if from + by > low { end(from, 0) } else { lower.shifted(-by) };
        let upper = if to + by < high { end(to, 1) } else { upper.shifted(-by) };
        let track = interval.track.as_ref().map(|track| track.shifted(-by));
        let part = Interval { span: Span::Range { lower, upper }, mode: interval.mode, track };
        (own[0] < own[1]).then_some((part, own))
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
    missing: Option<AssemblyError>,
}

impl TrackIntervals<'_> {
    /// Adds the intervals of the circuit through a node, and returns by how much the input is greater at the end of the curve.
    fn follow(&mut self, start: &Node) -> Result<f64, AssemblyError> {
        let curve = self.equations.follow(start)?;
        let count = curve.ends.len();
        let ends = [0, curve.nodes.len() - 1].map(|k| self.equations.input(&curve.nodes[k].state));
        for (nodes, ends) in monotonic_parts(curve) {
            let interval = self.interval(nodes, ends);
            self.found.push(interval);
        }
        self.next_id += count.max(1);
        // Without limits the interval begins at the start.
        Ok(if count == 0 { 0.0 } else { ends[1] - ends[0] })
    }

    /// Adds the intervals of the circuit through a further node, if there is one, unless the circuit is there already, or its input does not move.
    fn follow_another(&mut self, node: Option<Node>) {
        let tracks = || self.found.iter().filter_map(|interval| interval.track.as_ref());
        let followed = match node {
            Some(node) if tracks().any(|track| track.passes(&node.state)) => return,
            Some(node) if self.equations.held_input(&node, self.linkage).is_some() => return,
            Some(node) => self.follow(&node).err(),
            None => Some(AssemblyError::GroupNotFollowed { input: self.linkage.motion_options.start.unwrap_or(0.0) }),
        };
        if let Some(error) = followed {
            self.missing.get_or_insert(error);
        }
    }

    /// The interval of a part of a curve, which begins and ends at limits of these numbers or, if there are none, is all of it.
    fn interval(&self, mut nodes: Vec<Node>, ends: [Option<usize>; 2]) -> Interval {
        let equations = &self.equations;
        let rises = nodes[nodes.len() / 2].input_rate() > 0.0;
        // Towards both ends.
        for end in ends {
            if end.is_some() && !nodes[0].is_change {
                nodes = equations.graded(nodes);
            }
            nodes.reverse();
        }
        let [mut lower, mut upper] = ends;
        if !rises {
            nodes.reverse();
            (lower, upper) = (upper, lower);
        }
        // Where the curve has been crossed once, derivatives have the other orientation.
        let middle = &nodes[nodes.len() / 2];
        let is_turned = equations.orientation(&middle.state, &middle.tangent) < 0.0;
        let side = if (rises == self.start_rises) != is_turned { Side::Left } else { Side::Right };
        let mode = self.linkage.motion_options.mode.with_side(DyadId::FIRST, side);
        let input = self.linkage.input();
        let [first, last] =
            [&nodes[0], &nodes[nodes.len() - 1]].map(|node| InputPosition::new(input, equations.input(&node.state)));
        let [is_lowest_change, is_highest_change] = [&nodes[0], &nodes[nodes.len() - 1]].map(|node| node.is_change);
        let end = |at: InputPosition, number: Option<usize>, is_change: bool| match number {
            Some(number) => {
                let cause = if is_change { EndCause::ChangePoint } else { EndCause::Limit };
                IntervalEnd::from_flat_dyad(at, cause, DyadId::FIRST, self.next_id + number)
            }
            // Nothing happens where a curve of several turns begins and ends.
            None => IntervalEnd { cause: EndCause::ChangePoint, ..IntervalEnd::range_end(at, self.next_id) },
        };
        let is_closed = lower.is_none();
        let span = match (is_closed, input) {
            (true, Input::Angle { turns }) => {
                // Joints on gears may be back after more turns than those of the group.
                let own = ((last.value - first.value) / 360.0).round().max(1.0) as u32;
                let all = own / gcd(own, turns) * turns;
                let after_all = InputPosition { value: first.value + f64::from(all) * 360.0, ..first };
                match all == turns {
                    true => Span::FullTurn,
                    false => Span::Range { lower: end(first, None, false), upper: end(after_all, None, false) },
                }
            }
            _ => Span::Range { lower: end(first, lower, is_lowest_change), upper: end(last, upper, is_highest_change) },
        };
        Interval { span, mode, track: Some(GroupTrack::new(equations.clone(), nodes, is_closed)) }
    }

    /// The node of a pose in any frame, by the names of joints; `None` if it is not one of this linkage, or at a singularity.
    fn node_of_pose(&self, pose: &NamedPose) -> Option<Node> {
        let at = |joint: JointId| pose.get(self.linkage.joints[joint].name.as_str()).copied();
        if self.equations.joints.iter().any(|joint| at(*joint).is_none()) {
            return None;
        }
        // Two fixed joints show how the frame lies.
        let fixed = self.linkage.links[0].joints.iter().filter_map(|(joint, own)| Some((*own, at(*joint)?)));
        let fixed: Vec<(Vector, Point)> = fixed.collect();
        let ((a, a_there), (b, b_there)) = (fixed.first()?, fixed.get(1)?);
        let complex = |v: Vector| Complex::new(v.x, v.y);
        let factor = complex(b - a) / complex(b_there - a_there);
        let shift = complex(*a) - factor * complex(a_there.coords);
        let here = Similarity { is_mirrored: false, factor, shift };
        let placed = |joint: JointId| at(joint).map_or(Point::origin(), |there| here.apply(there));
        let input = self.linkage.input_of_pose(placed)?;
        let state = self.equations.state(placed, input);
        let held = self.equations.node(state.clone())?.parameter();
        self.equations.node(self.equations.corrected(state, held)?)
    }
}

/// The parts of a curve between limits and change points, each with the numbers of those at which it begins and ends. The first has the
/// curve's first node.
fn monotonic_parts(curve: Curve) -> Vec<(Vec<Node>, [Option<usize>; 2])> {
    let Curve { mut nodes, ends } = curve;
    let Some((&first, &last)) = ends.first().zip(ends.last()) else { return vec![(nodes, [None; 2])] };
    let mut parts = Vec::new();
    for (k, pair) in ends.windows(2).enumerate() {
        parts.push((nodes[pair[0]..=pair[1]].to_vec(), [Some(k), Some(k + 1)]));
    }
    // The end of the curve is its beginning, but for whole turns.
    let input = nodes[0].state.len() - 1;
    let turns = nodes[nodes.len() - 1].state[input] - nodes[0].state[input];
    let mut whole = nodes.split_off(last);
    // If there is one only, a change point, it is the last node of the head and the first of the rest.
    let head = nodes.get(1..=first).map_or_else(|| [&nodes[1..], &whole[..1]].concat(), <[Node]>::to_vec);
    whole.extend(head.into_iter().map(|mut node| {
        node.state[input] += turns;
        node
    }));
    parts.insert(0, (whole, [Some(ends.len() - 1), Some(0)]));
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
    pub fn start(&self, group: &Group, input: f64) -> Result<Node, AssemblyError> {
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
        // Where it closes and is not found, it is singular.
        let open = || match gap(&drawn) {
            gap if gap <= 1e-9 * self.size => AssemblyError::GroupNotFollowed { input },
            gap => AssemblyError::GroupOpen { input, gap },
        };
        self.node(closed.ok_or_else(open)?).ok_or(AssemblyError::GroupNotFollowed { input })
    }
}

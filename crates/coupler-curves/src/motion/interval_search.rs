//! The search for the intervals of the input on which a linkage can be assembled, one assembly mode at a time.
//!
//! The dyads are processed in the order they are placed. Each restricts the intervals of those before it to the inputs
//! at which it can span its base; both of its sides share the result. So an end of an interval belongs to one dyad, and
//! the intervals that meet there are recognised by its `id`.
//!
//! There are 2^n assembly modes of n dyads. Only those that a circuit passes through are searched, or, if all circuits
//! are requested, those that can be assembled.

use std::collections::HashMap;
use std::ops::Range;

use super::AssemblyError;
use super::dyad_limits;
use super::group::{GroupIntervals, NamedPose, find_intervals};
use super::interval::{Interval, IntervalEnd, Span};
use super::limits::MAX_ASSEMBLY_MODES;
use super::pass::InputPosition;
use crate::linkage::{AssemblyMode, DyadId, DyadSet, Group, Input, Joint, JointKind, Linkage, Side};

/// Finds the intervals of assembly modes within the requested range.
pub(super) struct IntervalSearch<'a> {
    pub linkage: &'a Linkage,
    /// The intervals found so far, mode by mode.
    intervals: Vec<Interval>,
    ranges_by_mode: HashMap<AssemblyMode, Range<usize>>,
    /// The spans on which the first few dyads close, by the number of these dyads and the sides of all but the last:
    /// assembly modes that have them in common share the spans and the `id`s of their ends.
    spans_by_mode: HashMap<(usize, AssemblyMode), Vec<Span>>,
    next_id: usize,
    /// Why there are no intervals of the mode at the start, if one of its dyads closes at no input.
    assembly_error: Option<AssemblyError>,
    /// Why the motion ends where the input could continue.
    motion_end: Option<AssemblyError>,
}

impl<'a> IntervalSearch<'a> {
    pub fn new(linkage: &'a Linkage) -> IntervalSearch<'a> {
        IntervalSearch {
            linkage,
            intervals: Vec::new(),
            ranges_by_mode: HashMap::new(),
            spans_by_mode: HashMap::new(),
            next_id: 2,
            assembly_error: None,
            motion_end: None,
        }
    }

    /// The intervals that have been found so far.
    pub fn intervals(&self) -> &[Interval] {
        &self.intervals
    }

    /// Why there are no intervals of the mode at the start, once that mode has been searched, if one of its dyads closes
    /// at no input.
    pub fn assembly_error(&self) -> Option<&AssemblyError> {
        self.assembly_error.as_ref()
    }

    /// Why the motion ends where the input could continue, the first time that it does.
    pub fn motion_end(&self) -> Option<&AssemblyError> {
        self.motion_end.as_ref()
    }

    /// Notes why the motion ends where the input could continue.
    pub fn end_motion(&mut self, error: AssemblyError) {
        self.motion_end.get_or_insert(error);
    }

    /// The indices of the intervals of an assembly mode; none if it cannot be assembled.
    ///
    /// # Errors
    /// [`MAX_ASSEMBLY_MODES`] other modes that can be assembled have been searched.
    pub fn intervals_of(&mut self, mode: AssemblyMode) -> Result<Range<usize>, AssemblyError> {
        if let Some(known) = self.ranges_by_mode.get(&mode) {
            return Ok(known.clone());
        }
        let spans = self.spans(self.linkage.dyad_count(), mode);
        let begin = self.intervals.len();
        if spans.is_empty() {
            return Ok(begin..begin);
        }
        if self.ranges_by_mode.len() == MAX_ASSEMBLY_MODES {
            return Err(AssemblyError::TooManyModesOnCircuit);
        }
        self.intervals.extend(spans.into_iter().map(|span| Interval { span, mode, track: None }));
        let range = begin..self.intervals.len();
        self.ranges_by_mode.insert(mode, range.clone());
        Ok(range)
    }

    /// Finds the intervals of a group on its circuits through the start pose and through other poses, and returns the index of the one
    /// that contains the start pose.
    ///
    /// # Errors
    /// The group does not close at the start, or its motion cannot be followed.
    pub fn add_group(&mut self, group: &Group, poses: &[NamedPose]) -> Result<usize, AssemblyError> {
        let GroupIntervals { intervals: found, start, missing } = find_intervals(self.linkage, group, poses)?;
        if let Some(error) = missing {
            self.end_motion(error);
        }
        let start_mode = found[start].mode;
        // Those of a mode are together.
        let (of_start, others): (Vec<_>, Vec<_>) = found.into_iter().partition(|interval| interval.mode == start_mode);
        let split = of_start.len();
        self.ranges_by_mode.insert(start_mode, 0..split);
        let other_mode = start_mode.flipped(DyadSet::single(DyadId::FIRST));
        self.ranges_by_mode.insert(other_mode, split..split + others.len());
        self.intervals = of_start.into_iter().chain(others).collect();
        Ok(start)
    }

    /// Finds the intervals of all assembly modes, in the order of the modes.
    ///
    /// # Errors
    /// More than [`MAX_ASSEMBLY_MODES`] modes can be assembled, of all dyads or of the first few.
    pub fn find_all(&mut self) -> Result<(), AssemblyError> {
        let mut modes = vec![AssemblyMode::default()];
        for last in 0..self.linkage.dyad_count() {
            // A mode is extended by one dyad after the other, so that a dyad that never closes ends it.
            modes.retain(|&mode| !self.spans(last + 1, mode).is_empty());
            if 2 * modes.len() > MAX_ASSEMBLY_MODES {
                return Err(AssemblyError::TooManyModes { dyads: last + 1, modes: 2 * modes.len() });
            }
            let last = DyadId::new(last);
            let sides = [Side::Left, Side::Right];
            modes = modes.iter().flat_map(|mode| sides.map(|side| mode.with_side(last, side))).collect();
        }
        for mode in modes {
            self.intervals_of(mode)?;
        }
        Ok(())
    }

    /// The spans on which the first `dyads` dyads close, with the sides of all but the last of them given.
    fn spans(&mut self, dyads: usize, mode: AssemblyMode) -> Vec<Span> {
        let Some(last) = dyads.checked_sub(1) else { return vec![requested_span(self.linkage)] };
        let mode_before = mode.truncated(last);
        if let Some(known) = self.spans_by_mode.get(&(dyads, mode_before)) {
            return known.clone();
        }
        let mut spans = Vec::new();
        for span in self.spans(last, mode) {
            match dyad_limits::closing_spans(self.linkage, DyadId::new(last), span, mode_before, &mut self.next_id) {
                Ok(parts) => spans.extend(parts),
                Err(error) if mode_before == self.linkage.motion_options.mode.truncated(last) => {
                    self.assembly_error.get_or_insert(error);
                }
                Err(_) => {}
            }
        }
        self.spans_by_mode.insert((dyads, mode_before), spans.clone());
        spans
    }
}

/// A distance from any joint beyond which links keep no slider: the sum of all lengths and coordinates. A slider that nothing else keeps moves as far.
fn reach(linkage: &Linkage) -> f64 {
    let extent = |joint: &Joint| match joint.kind {
        JointKind::Fixed(at) => at.coords.norm(),
        JointKind::Crank { length, .. } | JointKind::Gear { length, .. } => length,
        JointKind::Piston { length, offset, .. } | JointKind::Slide { length, offset, .. } => length + offset.abs(),
        JointKind::Dyad { lengths, .. } => lengths.iter().sum(),
        JointKind::Slot { offset, .. } | JointKind::Yoke { offset, .. } | JointKind::DrivenSlider { offset, .. } => {
            offset.abs()
        }
        JointKind::Rack { offset, start, .. } => offset.abs() + start.abs(),
        JointKind::Aligned { offset, along, across, .. } => offset.abs() + along.abs() + across.abs(),
        JointKind::Grouped { .. } | JointKind::Parallelogram { .. } | JointKind::Rigid { .. } => 0.0,
    };
    // Points are as far from a joint of their link as they are on it.
    let links = linkage.links.iter().flat_map(|link| &link.joints).map(|(_, at)| at.norm());
    linkage.joints.iter().map(extent).chain(links).sum()
}

/// The requested range of the input.
fn requested_span(linkage: &Linkage) -> Span {
    let input = linkage.input();
    let end = |at: f64, id| IntervalEnd::range_end(InputPosition::new(input, at), id);
    match linkage.motion_options.range {
        Some([from, to]) if to - from < input.period() => Span::Range { lower: end(from, 0), upper: end(to, 1) },
        _ if linkage.is_driven_by_slider() => {
            let reach = reach(linkage);
            Span::Range { lower: end(-reach, 0), upper: end(reach, 1) }
        }
        _ if input == Input::Length => Span::Range { lower: end(0.0, 0), upper: end(f64::MAX / 16.0, 1) },
        _ => Span::FullTurn,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use crate::linkage::{CircuitSelection, LinkageBuilder, MotionOptions};
    use crate::motion::circuit::trace_start_circuit;

    /// A crank and dyads on its pin whose links are so long that they are never flat.
    fn linkage_of_open_dyads(dyads: usize, circuits: CircuitSelection) -> Linkage {
        let mut builder = LinkageBuilder::default();
        let o = builder.fixed("O", Point::new(0.0, 0.0));
        let crank_pin = builder.crank("A", o, 1.0).unwrap();
        for k in 1..=dyads {
            let pivot = builder.fixed(&format!("C{k}"), Point::new(4.0, k as f64 / 100.0));
            builder.dyad(&format!("B{k}"), [crank_pin, pivot], [8.0, 8.0], Side::Left).unwrap();
        }
        builder.build(vec![crank_pin], None, MotionOptions { circuits, ..MotionOptions::default() }).unwrap()
    }

    #[test]
    fn the_search_for_one_circuit_doubles_with_the_number_of_dyads() {
        for dyads in [7, 14, 28] {
            let linkage = linkage_of_open_dyads(dyads, CircuitSelection::Start);
            let mut search = IntervalSearch::new(&linkage);
            trace_start_circuit(&mut search).unwrap();
            // Each dyad is searched once, for the sides of those before it.
            assert_eq!((search.spans_by_mode.len(), search.intervals.len()), (dyads, 1));
        }
    }

    #[test]
    fn the_search_for_all_circuits_is_bounded() {
        for dyads in [15, 30] {
            let linkage = linkage_of_open_dyads(dyads, CircuitSelection::All);
            let mut search = IntervalSearch::new(&linkage);
            assert!(matches!(search.find_all(), Err(AssemblyError::TooManyModes { .. })));
            assert!(search.spans_by_mode.len() < 2 * MAX_ASSEMBLY_MODES, "{}", search.spans_by_mode.len());
        }
    }
}

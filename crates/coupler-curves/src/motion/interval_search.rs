//! The search for the intervals of the input on which a linkage can be assembled, for each assembly mode.
//!
//! The dyads are processed in the order they are placed. Each restricts the intervals of those before it to the inputs
//! at which it can span its base; both of its sides share the result. So an end of an interval belongs to one dyad, and
//! the intervals that meet there are recognised by its `id`.

use std::collections::HashMap;

use super::AssemblyError;
use super::dyad_limits;
use super::interval::{Interval, IntervalEnd, Span};
use super::pass::InputPosition;
use crate::linkage::{AssemblyMode, CircuitSelection, DyadId, Input, Linkage};

/// The result of [`find_intervals`].
pub(super) struct ReachableIntervals {
    pub intervals: Vec<Interval>,
    /// Why there are none of the requested mode, if one of its dyads closes at no input.
    pub assembly_error: Option<AssemblyError>,
}

/// Finds the intervals within the requested range: those of all assembly modes, or, if only the circuit through the
/// start pose is requested, those of the modes that can be reached from it.
pub(super) fn find_intervals(linkage: &Linkage) -> ReachableIntervals {
    let mut cache = SpanCache { linkage, spans_by_mode: HashMap::new(), next_id: 2, assembly_error: None };
    let options = &linkage.motion_options;
    let mut modes = match options.circuits {
        CircuitSelection::Start => vec![options.mode],
        CircuitSelection::All => AssemblyMode::all(linkage.dyad_count()).collect(),
    };
    let mut intervals = Vec::new();
    let mut done = 0;
    while let Some(&mode) = modes.get(done) {
        done += 1;
        for span in cache.spans(linkage.dyad_count(), mode) {
            let interval = Interval { span, mode };
            for rising in [true, false] {
                let next_mode = interval.end(rising).and_then(|end| end.next_mode(mode, rising, options));
                modes.extend(next_mode.map(|(mode, _)| mode).filter(|mode| !modes.contains(mode)));
            }
            intervals.push(interval);
        }
    }
    ReachableIntervals { intervals, assembly_error: cache.assembly_error }
}

/// The requested range of the input.
fn requested_span(linkage: &Linkage) -> Span {
    let input = linkage.input();
    let end = |at: f64, id| IntervalEnd::range_end(InputPosition::new(input, at), id);
    match linkage.motion_options.range {
        Some([from, to]) if to - from < input.period() => Span::Range { lower: end(from, 0), upper: end(to, 1) },
        _ if input == Input::Length => Span::Range { lower: end(0.0, 0), upper: end(f64::MAX / 16.0, 1) },
        _ => Span::FullTurn,
    }
}

/// The spans on which the first few dyads close, by the number of these dyads and their sides: assembly modes that have
/// them in common share the spans and the `id`s of their ends.
struct SpanCache<'a> {
    linkage: &'a Linkage,
    spans_by_mode: HashMap<(usize, AssemblyMode), Vec<Span>>,
    next_id: usize,
    assembly_error: Option<AssemblyError>,
}

impl SpanCache<'_> {
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

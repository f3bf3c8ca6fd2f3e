//! The inputs at which a dyad closes, so that its joint can be placed: its links are neither too short nor too long.
//!
//! The limits of a dyad between a point of the crank's link and the frame are computed in closed form (McCarthy 2.53,
//! Natesan 4.3-4.9). For any other dyad, the input is cut into pieces on which enclosures of the extent and its
//! derivative show that there is one limit at most, and that is refined to the last bit. So every interval in which the
//! dyad closes, or does not, is found down to a width of 1e-12 of a turn, or of the stroke of an actuator; one in which
//! the dyad misses by less than rounding is a change point.
//!
//! Enclosures become wider with every dyad of a chain, and more pieces are needed. A dyad that closes in every pose of
//! the links before it needs none.

mod closed_form;
mod distance_bounds;
mod dyad;
mod limit_search;
mod monotone_pieces;

use super::AssemblyError;
use super::interval::{COINCIDENCE_TOLERANCE, IntervalEnd, Span};
use crate::linkage::{AssemblyMode, DyadId, Input, JointId, JointKind, Linkage, length_tolerance};
use distance_bounds::distance_bounds;
use dyad::Dyad;
use limit_search::LimitSearch;

/// The parts of `span` on which a dyad closes, given the sides of the dyads before it.
///
/// # Errors
/// Why there are none.
pub(super) fn closing_spans(
    linkage: &Linkage,
    dyad: DyadId,
    span: Span,
    mode: AssemblyMode,
    next_id: &mut usize,
) -> Result<Vec<Span>, AssemblyError> {
    let dyad = Dyad::from_index(linkage, dyad);
    if let JointKind::Piston { .. } = dyad.kind {
        let spans = intersect_spans(span, dyad.stroke(linkage, next_id).into_iter().collect(), 0, Input::Length);
        return if spans.is_empty() { Err(dyad.assembly_error(linkage, span, mode)) } else { Ok(spans) };
    }
    if let JointKind::Slide { line, .. } = dyad.kind
        && !linkage.links.iter().any(|link| line.iter().all(|&joint| link.position(joint).is_some()))
    {
        return dyad.closing_spans_on_moving_line(linkage, line, span, mode, next_id);
    }
    let spans = match dyad.sinusoidal_extent(linkage) {
        Some(extent) => intersect_spans(span, extent.closing_spans(dyad.id, next_id), 3, linkage.input()),
        None if dyad.always_closes(linkage) => vec![span],
        None => LimitSearch { linkage, dyad: &dyad, span, mode }.closing_spans(next_id),
    };
    if spans.is_empty() { Err(dyad.assembly_error(linkage, span, mode)) } else { Ok(spans) }
}

impl Dyad {
    /// The parts of `span` on which a slider closes whose line is that through joints of two links: it has no direction where
    /// they coincide, and a span ends there.
    fn closing_spans_on_moving_line(
        &self,
        linkage: &Linkage,
        line: [JointId; 2],
        span: Span,
        mode: AssemblyMode,
        next_id: &mut usize,
    ) -> Result<Vec<Span>, AssemblyError> {
        // The direction of the line is that of a slot without offset.
        let direction = Dyad { kind: JointKind::Slot { base: line, offset: 0.0, dyad: self.id }, ..*self };
        let parts = if direction.always_closes(linkage) {
            vec![span]
        } else {
            LimitSearch { linkage, dyad: &direction, span, mode }.closing_spans(next_id)
        };
        let name = |joint: JointId| linkage.joints[joint].name.clone();
        if parts.is_empty() {
            return Err(AssemblyError::CoincidentBase { joint: name(self.joint), base: line.map(name) });
        }
        let closing = |span| LimitSearch { linkage, dyad: self, span, mode }.closing_spans(next_id);
        let spans: Vec<Span> = parts.into_iter().flat_map(closing).collect();
        if spans.is_empty() { Err(self.assembly_error(linkage, span, mode)) } else { Ok(spans) }
    }

    /// Whether the links between the joints of its base keep it certainly, and by far more than rounding, from being
    /// flat.
    fn always_closes(&self, linkage: &Linkage) -> bool {
        /// Relative to the lengths, far above the rounding of positions.
        const MARGIN: f64 = 1e-6;
        let (JointKind::Dyad { base, .. } | JointKind::Slot { base, .. }) = self.kind else { return false };
        let [low, high] = self.extent_bounds();
        let [least, greatest] = distance_bounds(linkage, self.joint.index(), base);
        let margin = MARGIN * (low + greatest + if high.is_finite() { high } else { 0.0 });
        let is_normal = |length: f64| (length * length).is_normal();
        least > low + margin && greatest < high - margin && is_normal(least) && is_normal(greatest)
    }

    /// Why the dyad closes at no input of `span`.
    fn assembly_error(&self, linkage: &Linkage, span: Span, mode: AssemblyMode) -> AssemblyError {
        let [least, greatest] = match self.sinusoidal_extent(linkage) {
            _ if matches!(self.kind, JointKind::Piston { .. }) => [0.0; 2],
            Some(extent) if span == Span::FullTurn => extent.range,
            _ => LimitSearch { linkage, dyad: self, span, mode }.extent_range(),
        };
        let name = |id: JointId| linkage.joints[id].name.clone();
        let joint = name(self.joint);
        let [low, high] = self.extent_bounds();
        let size = if high.is_finite() { greatest.abs().max(high) } else { greatest.abs() };
        if !matches!(self.kind, JointKind::Piston { .. }) && !(size * size).is_normal() {
            return AssemblyError::BeyondDoublePrecision;
        }
        match self.kind {
            JointKind::Slide { from, length, .. } => {
                let distance = if least > 0.0 { least } else { -greatest };
                AssemblyError::LineTooFar { joint, base: name(from), length, distance }
            }
            JointKind::Slot { base, .. } => {
                AssemblyError::OffsetTooLong { joint, base: base.map(name), greatest, offset: low }
            }
            JointKind::Dyad { base, lengths, .. } => {
                let base = base.map(name);
                if greatest <= low && greatest <= length_tolerance(high) {
                    AssemblyError::CoincidentBase { joint, base }
                } else if least >= high {
                    AssemblyError::BaseTooLong { joint, base, lengths, least }
                } else if greatest <= low {
                    AssemblyError::BaseTooShort { joint, base, lengths, greatest }
                } else {
                    AssemblyError::BaseNeverSpanned { joint, base, lengths }
                }
            }
            _ => AssemblyError::ActuatorOutOfRange { joint },
        }
    }
}

/// Whether two inputs are equal within rounding, which is relative for lengths.
fn is_same_input(a: f64, b: f64, input: Input) -> bool {
    let unit = if input == Input::Length { 0.0 } else { 1.0 };
    (a - b).abs() <= COINCIDENCE_TOLERANCE * a.abs().max(b.abs()).max(unit)
}

/// The end that comes later as the input rises (`direction` 1) or falls (-1); if both are at one input, they are
/// merged, with the `id` of the earlier dyads' end.
fn later_end(earlier_dyads: IntervalEnd, own: IntervalEnd, direction: f64, input: Input) -> IntervalEnd {
    if is_same_input(earlier_dyads.input.value, own.input.value, input) {
        earlier_dyads.merged(own)
    } else if (own.input.value - earlier_dyads.input.value) * direction > 0.0 {
        own
    } else {
        earlier_dyads
    }
}

/// The parts of `span` that are in one of the `allowed` spans, which may differ from it by up to `turns` whole turns.
fn intersect_spans(span: Span, allowed: Vec<Span>, turns: i32, input: Input) -> Vec<Span> {
    let Span::Range { lower, upper } = span else { return allowed };
    let mut out = Vec::new();
    for piece in allowed {
        let Span::Range { lower: from, upper: to } = piece else {
            out.push(span);
            continue;
        };
        for turn in -turns..=turns {
            let (from, to) = (from.shifted(360.0 * f64::from(turn)), to.shifted(360.0 * f64::from(turn)));
            let low = later_end(lower, from, 1.0, input);
            let high = later_end(upper, to, -1.0, input);
            if low.input.value < high.input.value {
                out.push(Span::Range { lower: low, upper: high });
            }
        }
    }
    out.sort_by(|a, b| match (a, b) {
        (Span::Range { lower: a, .. }, Span::Range { lower: b, .. }) => a.input.value.total_cmp(&b.input.value),
        _ => std::cmp::Ordering::Equal,
    });
    out
}

//! Where one two-valued joint can be placed: the inputs at which its dyad is neither too short nor too long.
//!
//! Where a dyad hangs on a point of the crank's link and on the frame, its limits are in closed form (McCarthy 2.53,
//! Natesan 4.3-4.9). For any other, the input is cut into pieces on which enclosures of the extent and its rate leave
//! room for one limit at most, and that is refined to the last bit. So every gap and every window is found, however
//! narrow, down to 1e-12 of a turn, or of the stroke of an actuator; one in which the dyad misses by less than rounding
//! is a change point.

mod closed_form;
mod limit_search;
mod monotone_pieces;

use super::circuit::InputPosition;
use super::interval::{EndCause, IntervalEnd, Span};
use super::series::{Scalar, Series, VectorSeries};
use crate::geometry::{cross, left_normal};
use crate::linkage::{AssemblyMode, Input, JointId, JointKind, Link, Linkage, length_tolerance};
use closed_form::SinusoidalExtent;
use limit_search::LimitSearch;

/// The parts of `span` where a dyad closes, given the sides of the dyads before it.
///
/// # Errors
/// Why there are none.
pub(super) fn closing_spans(
    linkage: &Linkage,
    dyad: usize,
    span: Span,
    signs: AssemblyMode,
    next_id: &mut usize,
) -> Result<Vec<Span>, String> {
    let dyad = Dyad::from_index(linkage, dyad);
    if let JointKind::Piston { .. } = dyad.kind {
        let spans = intersect_spans(span, dyad.stroke(linkage, next_id).into_iter().collect(), 0, Input::Length);
        return if spans.is_empty() { Err(dyad.unclosed_reason(linkage, span, signs)) } else { Ok(spans) };
    }
    let spans = match dyad.sinusoidal_extent(linkage) {
        Some(swing) => intersect_spans(span, swing.closing_spans(dyad.index, next_id), 3, linkage.input()),
        None => LimitSearch { linkage, dyad: &dyad, span, mode: signs }.closing_spans(next_id),
    };
    if spans.is_empty() { Err(dyad.unclosed_reason(linkage, span, signs)) } else { Ok(spans) }
}

/// A two-valued joint and how it is placed.
struct Dyad {
    joint: JointId,
    index: usize,
    kind: JointKind,
}

impl Dyad {
    fn from_index(linkage: &Linkage, wanted: usize) -> Dyad {
        let found = linkage.joints.iter().enumerate().find(|(_, joint)| joint.kind.dyad_index() == Some(wanted));
        let (joint, step) = found.map(|(id, joint)| (id, joint.kind)).expect("dyads are numbered without gaps");
        Dyad { joint, index: wanted, kind: step }
    }

    /// What must lie within [`Dyad::extent_bounds`] for the dyad to close: the length of its base, or, of a slide, how far
    /// the line it slides on runs to the left of the joint its link hangs on.
    fn extent<T: Scalar, const N: usize>(&self, at: impl Fn(JointId) -> VectorSeries<T, N>) -> Series<T, N> {
        match self.kind {
            JointKind::Dyad { base: [p, q], .. } | JointKind::Slot { base: [p, q], .. } => {
                at(q).minus(at(p)).norm_squared().sqrt()
            }
            JointKind::Slide { from, line: [p, q], offset, .. } => {
                Series::constant(offset) - at(q).minus(at(p)).unit().cross(at(from).minus(at(p)))
            }
            _ => Series::constant(0.0),
        }
    }

    /// Whether its joint has no place of its own where its base vanishes: it goes on as it comes there.
    fn base_can_vanish(&self) -> bool {
        matches!(self.kind, JointKind::Dyad { .. } | JointKind::Slot { offset: 0.0, .. })
    }

    /// What a piston's length can be: from where crank and frame are folded, or from nothing, to where they are
    /// stretched.
    fn stroke(&self, linkage: &Linkage, next_id: &mut usize) -> Option<Span> {
        let JointKind::Piston { base: [c, o], length, offset, .. } = self.kind else { return None };
        let frame = (linkage.links[0].position(c)? - linkage.links[0].position(o)?).norm();
        let leg = |b: f64| ((b - offset) * (b + offset)).max(0.0).sqrt();
        let (folded, stretched) = (leg((frame - length).abs()), leg(frame + length));
        let mut end = |at: f64| {
            *next_id += 1;
            let stop = InputPosition::new(Input::Length, at);
            if at > 0.0 {
                IntervalEnd::from_flat_dyad(stop, EndCause::Limit, self.index, *next_id)
            } else {
                IntervalEnd::range_end(stop, *next_id)
            }
        };
        let (lower, upper) = (end(folded), end(stretched));
        (folded < stretched).then_some(Span::Range { lower, upper })
    }

    fn extent_bounds(&self) -> [f64; 2] {
        match self.kind {
            JointKind::Dyad { lengths: [l0, l1], .. } => [(l0 - l1).abs(), l0 + l1],
            JointKind::Slot { offset, .. } => [offset.abs(), f64::INFINITY],
            JointKind::Slide { length, .. } => [-length, length],
            _ => [0.0, 0.0],
        }
    }

    /// The extent as the projection or the length of an arm that turns with the crank, if it is one.
    fn sinusoidal_extent(&self, linkage: &Linkage) -> Option<SinusoidalExtent> {
        if linkage.input() != (Input::Angle { turns: 1 }) {
            return None;
        }
        let (pivot, crank) = linkage.joints.iter().enumerate().find_map(|(id, joint)| match joint.kind {
            JointKind::Crank { pivot, .. } => Some((pivot, id)),
            _ => None,
        })?;
        let frame = &linkage.links[0];
        let pivot_place = frame.position(pivot)?;
        let of_crank = |link: &&Link| link.position(pivot).is_some() && link.position(crank).is_some();
        let arm = linkage.links[1..].iter().find(of_crank)?;
        match self.kind {
            JointKind::Dyad { base: [p, q], .. } | JointKind::Slot { base: [p, q], .. } => {
                let (on_arm, fixed) = match (arm.position(p), frame.position(q), arm.position(q), frame.position(p)) {
                    (Some(on_arm), Some(fixed), ..) | (.., Some(on_arm), Some(fixed)) => (on_arm, fixed),
                    _ => return None,
                };
                Some(SinusoidalExtent::from_base_length(on_arm, fixed - pivot_place, self.extent_bounds()))
            }
            JointKind::Slide { from, line: [p, q], offset, .. } => {
                let (on_arm, p, q) = (arm.position(from)?, frame.position(p)?, frame.position(q)?);
                let along = (q - p).normalize();
                let beside = offset - cross(along, pivot_place - p);
                Some(SinusoidalExtent::from_projection(on_arm, left_normal(along), beside, self.extent_bounds()))
            }
            _ => None,
        }
    }

    /// Why it closes nowhere in `span`.
    fn unclosed_reason(&self, linkage: &Linkage, span: Span, signs: AssemblyMode) -> String {
        let [least, greatest] = match self.sinusoidal_extent(linkage) {
            _ if matches!(self.kind, JointKind::Piston { .. }) => [0.0; 2],
            Some(swing) if span == Span::FullTurn => swing.range,
            _ => LimitSearch { linkage, dyad: self, span, mode: signs }.extent_range(),
        };
        let name = |id: JointId| linkage.joints[id].name.as_str();
        let joint = name(self.joint);
        let [low, high] = self.extent_bounds();
        let size = if high.is_finite() { greatest.abs().max(high) } else { greatest.abs() };
        if !matches!(self.kind, JointKind::Piston { .. }) && !(size * size).is_normal() {
            return super::OUT_OF_RANGE_REASON.to_owned();
        }
        match self.kind {
            JointKind::Slide { from, length, .. } => {
                let nearest = if least > 0.0 { least } else { -greatest };
                format!(
                    "{joint} cannot be placed: its line stays {} or more from {}, and the link of {} is too short",
                    format_significant(nearest),
                    name(from),
                    format_significant(length)
                )
            }
            JointKind::Slot { base: [p, q], .. } => format!(
                "{joint} cannot be placed: {} and {} are {} or less apart, and the offset is {}",
                name(p),
                name(q),
                format_significant(greatest),
                format_significant(low)
            ),
            JointKind::Dyad { base: [p, q], lengths, .. } => {
                let (from, to) = (name(p), name(q));
                let [l0, l1] = lengths.map(format_significant);
                let bases = format!("{joint} cannot be placed: {from} and {to}");
                if greatest <= low && greatest <= length_tolerance(high) {
                    format!("{joint} has no place: {from} and {to} are one point throughout")
                } else if least >= high {
                    format!(
                        "{bases} are {} or more apart, links of {l0} and {l1} reach {}",
                        format_significant(least),
                        format_significant(high)
                    )
                } else if greatest <= low {
                    format!(
                        "{bases} are {} or less apart, links of {l0} and {l1} need {}",
                        format_significant(greatest),
                        format_significant(low)
                    )
                } else {
                    format!("{bases} are nowhere in the range at a distance that links of {l0} and {l1} span")
                }
            }
            _ => format!("{joint} cannot be placed by an actuator of any length asked for"),
        }
    }
}

/// Up to six significant digits.
fn format_significant(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    rounded.to_string()
}

/// Ends closer than this, in degrees or in parts of a length, are at one input: the rounding of an angle near 360.
const COINCIDENCE_TOLERANCE: f64 = 1e-12;

/// Whether two inputs are one but for rounding; of lengths there is no unit to compare them with.
fn is_same_input(a: f64, b: f64, input: Input) -> bool {
    let unit = if input == Input::Length { 0.0 } else { 1.0 };
    (a - b).abs() <= COINCIDENCE_TOLERANCE * a.abs().max(b.abs()).max(unit)
}

/// The end that comes later as the input rises (`way` 1) or falls (-1); both in one where they are at one input, with
/// the number of the earlier dyad's.
fn later_end(earlier_dyads: IntervalEnd, own: IntervalEnd, way: f64, input: Input) -> IntervalEnd {
    if is_same_input(earlier_dyads.input.value, own.input.value, input) {
        earlier_dyads.merged(own)
    } else if (own.input.value - earlier_dyads.input.value) * way > 0.0 {
        own
    } else {
        earlier_dyads
    }
}

/// The parts of `span` that are in one of `allowed`, which may be up to so many turns off.
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

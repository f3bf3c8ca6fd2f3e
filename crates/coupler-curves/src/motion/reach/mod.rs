//! Where one two-valued joint can be placed: the inputs at which its dyad is neither too short nor too long.
//!
//! Where a dyad hangs on a point of the crank's link and on the frame, its limits are in closed form (McCarthy 2.53,
//! Natesan 4.3-4.9). For any other, the input is cut into pieces on which enclosures of the extent and its rate leave
//! room for one limit at most, and that is refined to the last bit. So every gap and every window is found, however
//! narrow, down to 1e-12 of a turn, or of the stroke of an actuator; one in which the dyad misses by less than rounding
//! is a change point.

mod certain;
mod search;
mod swing;

use super::circuit::Stop;
use super::interval::{Cause, IntervalEnd, Span};
use super::series::{Planar, Scalar, Series};
use crate::geometry::{cross, left_normal};
use crate::linkage::{Input, JointId, Link, Linkage, Signs, Step, four_bar_tolerance};
use search::Search;
use swing::Swing;

/// The parts of `span` where a dyad closes, given the sides of the dyads before it.
///
/// # Errors
/// Why there are none.
pub(super) fn cut(
    linkage: &Linkage,
    dyad: usize,
    span: Span,
    signs: Signs,
    next_id: &mut usize,
) -> Result<Vec<Span>, String> {
    let dyad = Dyad::of(linkage, dyad);
    if let Step::Piston { .. } = dyad.step {
        let spans = intersect(span, dyad.stroke(linkage, next_id).into_iter().collect(), 0, Input::Length);
        return if spans.is_empty() { Err(dyad.shortfall(linkage, span, signs)) } else { Ok(spans) };
    }
    let spans = match dyad.swing(linkage) {
        Some(swing) => intersect(span, swing.spans(dyad.index, next_id), 3, linkage.input()),
        None => Search { linkage, dyad: &dyad, span, signs }.spans(next_id),
    };
    if spans.is_empty() { Err(dyad.shortfall(linkage, span, signs)) } else { Ok(spans) }
}

/// A two-valued joint and how it is placed.
struct Dyad {
    joint: JointId,
    index: usize,
    step: Step,
}

impl Dyad {
    fn of(linkage: &Linkage, wanted: usize) -> Dyad {
        let found = linkage.joints.iter().enumerate().find(|(_, joint)| joint.step.index() == Some(wanted));
        let (joint, step) = found.map(|(id, joint)| (id, joint.step)).expect("dyads are numbered without gaps");
        Dyad { joint, index: wanted, step }
    }

    /// What must lie within [`Dyad::bounds`] for the dyad to close: the length of its base, or, of a slide, how far
    /// the line it slides on runs to the left of the joint its link hangs on.
    fn extent<T: Scalar, const N: usize>(&self, at: impl Fn(JointId) -> Planar<T, N>) -> Series<T, N> {
        match self.step {
            Step::Dyad { base: [p, q], .. } | Step::Slot { base: [p, q], .. } => {
                at(q).minus(at(p)).norm_squared().sqrt()
            }
            Step::Slide { from, line: [p, q], offset, .. } => {
                Series::constant(offset) - at(q).minus(at(p)).unit().cross(at(from).minus(at(p)))
            }
            _ => Series::constant(0.0),
        }
    }

    /// Whether its joint has no place of its own where its base vanishes: it goes on as it comes there.
    fn vanishes(&self) -> bool {
        matches!(self.step, Step::Dyad { .. } | Step::Slot { offset: 0.0, .. })
    }

    /// What a piston's length can be: from where crank and frame are folded, or from nothing, to where they are
    /// stretched.
    fn stroke(&self, linkage: &Linkage, next_id: &mut usize) -> Option<Span> {
        let Step::Piston { base: [c, o], length, offset, .. } = self.step else { return None };
        let frame = (linkage.links[0].place(c)? - linkage.links[0].place(o)?).norm();
        let leg = |b: f64| ((b - offset) * (b + offset)).max(0.0).sqrt();
        let (folded, stretched) = (leg((frame - length).abs()), leg(frame + length));
        let mut end = |at: f64| {
            *next_id += 1;
            let stop = Stop::of(Input::Length, at);
            if at > 0.0 {
                IntervalEnd::flat(stop, Cause::Limit, self.index, *next_id)
            } else {
                IntervalEnd::asked(stop, *next_id)
            }
        };
        let (lower, upper) = (end(folded), end(stretched));
        (folded < stretched).then_some(Span::Arc { lower, upper })
    }

    fn bounds(&self) -> [f64; 2] {
        match self.step {
            Step::Dyad { lengths: [l0, l1], .. } => [(l0 - l1).abs(), l0 + l1],
            Step::Slot { offset, .. } => [offset.abs(), f64::INFINITY],
            Step::Slide { length, .. } => [-length, length],
            _ => [0.0, 0.0],
        }
    }

    /// The extent as the projection or the length of an arm that turns with the crank, if it is one.
    fn swing(&self, linkage: &Linkage) -> Option<Swing> {
        if linkage.input() != (Input::Angle { turns: 1 }) {
            return None;
        }
        let (pivot, crank) = linkage.joints.iter().enumerate().find_map(|(id, joint)| match joint.step {
            Step::Crank { pivot, .. } => Some((pivot, id)),
            _ => None,
        })?;
        let frame = &linkage.links[0];
        let pivot_place = frame.place(pivot)?;
        let of_crank = |link: &&Link| link.place(pivot).is_some() && link.place(crank).is_some();
        let arm = linkage.links[1..].iter().find(of_crank)?;
        match self.step {
            Step::Dyad { base: [p, q], .. } | Step::Slot { base: [p, q], .. } => {
                let (on_arm, fixed) = match (arm.place(p), frame.place(q), arm.place(q), frame.place(p)) {
                    (Some(on_arm), Some(fixed), ..) | (.., Some(on_arm), Some(fixed)) => (on_arm, fixed),
                    _ => return None,
                };
                Some(Swing::of_length(on_arm, fixed - pivot_place, self.bounds()))
            }
            Step::Slide { from, line: [p, q], offset, .. } => {
                let (on_arm, p, q) = (arm.place(from)?, frame.place(p)?, frame.place(q)?);
                let along = (q - p).normalize();
                let beside = offset - cross(along, pivot_place - p);
                Some(Swing::of_projection(on_arm, left_normal(along), beside, self.bounds()))
            }
            _ => None,
        }
    }

    /// Why it closes nowhere in `span`.
    fn shortfall(&self, linkage: &Linkage, span: Span, signs: Signs) -> String {
        let [least, greatest] = match self.swing(linkage) {
            _ if matches!(self.step, Step::Piston { .. }) => [0.0; 2],
            Some(swing) if span == Span::Turn => swing.extent,
            _ => Search { linkage, dyad: self, span, signs }.range(),
        };
        let name = |id: JointId| linkage.joints[id].name.as_str();
        let joint = name(self.joint);
        let [low, high] = self.bounds();
        let size = if high.is_finite() { greatest.abs().max(high) } else { greatest.abs() };
        if !matches!(self.step, Step::Piston { .. }) && !(size * size).is_normal() {
            return super::TOO_EXTREME.to_owned();
        }
        match self.step {
            Step::Slide { from, length, .. } => {
                let nearest = if least > 0.0 { least } else { -greatest };
                format!(
                    "{joint} cannot be placed: its line stays {} or more from {}, and the link of {} is too short",
                    short(nearest),
                    name(from),
                    short(length)
                )
            }
            Step::Slot { base: [p, q], .. } => format!(
                "{joint} cannot be placed: {} and {} are {} or less apart, and the offset is {}",
                name(p),
                name(q),
                short(greatest),
                short(low)
            ),
            Step::Dyad { base: [p, q], lengths, .. } => {
                let (from, to) = (name(p), name(q));
                let [l0, l1] = lengths.map(short);
                let bases = format!("{joint} cannot be placed: {from} and {to}");
                if greatest <= low && greatest <= four_bar_tolerance(high) {
                    format!("{joint} has no place: {from} and {to} are one point throughout")
                } else if least >= high {
                    format!("{bases} are {} or more apart, links of {l0} and {l1} reach {}", short(least), short(high))
                } else if greatest <= low {
                    format!("{bases} are {} or less apart, links of {l0} and {l1} need {}", short(greatest), short(low))
                } else {
                    format!("{bases} are nowhere in the range at a distance that links of {l0} and {l1} span")
                }
            }
            _ => format!("{joint} cannot be placed by an actuator of any length asked for"),
        }
    }
}

/// Up to six significant digits.
fn short(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    rounded.to_string()
}

/// Ends closer than this, in degrees or in parts of a length, are at one input: the rounding of an angle near 360.
const COINCIDENT: f64 = 1e-12;

/// Whether two inputs are one but for rounding; of lengths there is no unit to compare them with.
fn is_one(a: f64, b: f64, input: Input) -> bool {
    let unit = if input == Input::Length { 0.0 } else { 1.0 };
    (a - b).abs() <= COINCIDENT * a.abs().max(b.abs()).max(unit)
}

/// The end that comes later as the input rises (`way` 1) or falls (-1); both in one where they are at one input, with
/// the number of the earlier dyad's.
fn later(earlier_dyads: IntervalEnd, own: IntervalEnd, way: f64, input: Input) -> IntervalEnd {
    if is_one(earlier_dyads.stop.at, own.stop.at, input) {
        earlier_dyads.merged(own)
    } else if (own.stop.at - earlier_dyads.stop.at) * way > 0.0 {
        own
    } else {
        earlier_dyads
    }
}

/// The parts of `span` that are in one of `allowed`, which may be up to so many turns off.
fn intersect(span: Span, allowed: Vec<Span>, turns: i32, input: Input) -> Vec<Span> {
    let Span::Arc { lower, upper } = span else { return allowed };
    let mut out = Vec::new();
    for piece in allowed {
        let Span::Arc { lower: from, upper: to } = piece else {
            out.push(span);
            continue;
        };
        for turn in -turns..=turns {
            let (from, to) = (from.turned(360.0 * f64::from(turn)), to.turned(360.0 * f64::from(turn)));
            let low = later(lower, from, 1.0, input);
            let high = later(upper, to, -1.0, input);
            if low.stop.at < high.stop.at {
                out.push(Span::Arc { lower: low, upper: high });
            }
        }
    }
    out.sort_by(|a, b| match (a, b) {
        (Span::Arc { lower: a, .. }, Span::Arc { lower: b, .. }) => a.stop.at.total_cmp(&b.stop.at),
        _ => std::cmp::Ordering::Equal,
    });
    out
}

//! Where one two-valued joint can be placed: the inputs at which its dyad is neither too short nor too long.
//!
//! Where a dyad hangs on a point of the crank's link and on the frame, its limits are in closed form (McCarthy 2.53,
//! Natesan 4.3-4.9). For any other, the distance that is left to stretch or fold is sampled along the input, its
//! zeros are bracketed and refined to the last bit, and dips between samples are looked into.

use super::circuit::Stop;
use super::interval::{Cause, IntervalEnd, Span};
use super::jet::Jets;
use super::kernel::{Columns, Modes, OwnInputs, place};
use crate::geometry::{Point, Vector, cross, left_normal, trig};
use crate::linkage::{Flat, Input, JointId, Link, Linkage, Signs, Step, four_bar_tolerance};

/// Samples to a turn when zeros are bracketed.
const SAMPLES: usize = 720;

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
        let spans = intersect(span, dyad.stroke(linkage, next_id).into_iter().collect(), 0);
        return if spans.is_empty() { Err(dyad.shortfall(linkage, span, signs)) } else { Ok(spans) };
    }
    let spans = match dyad.swing(linkage) {
        Some(swing) => intersect(span, swing.spans(dyad.index, next_id), 3),
        None => Sampled { linkage, dyad: &dyad, span, signs }.spans(next_id),
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
    fn extent(&self, at: impl Fn(JointId) -> Point) -> f64 {
        match self.step {
            Step::Dyad { base: [p, q], .. } | Step::Slot { base: [p, q], .. } => (at(q) - at(p)).norm(),
            Step::Slide { from, line: [p, q], offset, .. } => {
                offset - cross((at(q) - at(p)).normalize(), at(from) - at(p))
            }
            _ => 0.0,
        }
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
            _ => Sampled { linkage, dyad: self, span, signs }.range(),
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

/// An extent that goes with the cosine of the input: with the angle measured from `towards`, it is at one end of its
/// range at 0 degrees and at the other at 180.
struct Swing {
    /// The input's direction at which the near bound may be met.
    towards: Vector,
    /// The least and the greatest extent.
    extent: [f64; 2],
    /// What is left to the bounds at 0 and at 180 degrees; negative where they are passed.
    room: [f64; 2],
    /// 1 - cos and 1 + cos of the input where the bound near 0 degrees is met, and where that near 180 is.
    versines: [[f64; 2]; 2],
    /// What is left to the other bound at 0 and at 180 degrees: where there is none, the dyad closes nowhere.
    hope: [f64; 2],
    /// Lengths closer than this are equal.
    tolerance: f64,
    /// Whether the base may vanish at 0 degrees.
    may_vanish: bool,
}

impl Swing {
    /// The length of a base with one end on an arm and the other fixed, `to_fixed` from the arm's pivot.
    fn of_length(on_arm: Vector, to_fixed: Vector, [low, high]: [f64; 2]) -> Swing {
        let (fixed, arm) = (to_fixed.norm(), on_arm.norm());
        let (nearest, furthest) = ((fixed - arm).abs(), fixed + arm);
        let product = 2.0 * fixed * arm;
        let finite = if high.is_finite() { high } else { low };
        let tolerance = four_bar_tolerance(furthest + finite);
        Swing {
            towards: quotient(to_fixed, on_arm),
            extent: [nearest, furthest],
            room: [nearest - low, high - furthest],
            // Differences of squares are taken apart: exact factors, and accurate when small.
            versines: [low, if high.is_finite() { high } else { furthest }].map(|bound| {
                [(bound - nearest) * (bound + nearest) / product, (furthest - bound) * (furthest + bound) / product]
            }),
            hope: [high - nearest, furthest - low],
            tolerance,
            may_vanish: nearest <= tolerance,
        }
    }

    /// `beside` less the projection of an arm on a fixed direction.
    fn of_projection(on_arm: Vector, normal: Vector, beside: f64, [low, high]: [f64; 2]) -> Swing {
        let arm = on_arm.norm();
        let (least, greatest) = (beside - arm, beside + arm);
        Swing {
            towards: quotient(normal, on_arm),
            extent: [least, greatest],
            room: [least - low, high - greatest],
            versines: [low, high].map(|bound| [(bound - least) / arm, (greatest - bound) / arm]),
            hope: [high - least, greatest - low],
            tolerance: four_bar_tolerance(beside.abs() + arm + high),
            may_vanish: false,
        }
    }

    /// The input whose angle from `towards` has this cosine and sine.
    fn stop(&self, cos: f64, sin: f64) -> Stop {
        let t = self.towards;
        // Both angles are exact where the arm starts on the frame line.
        let deg = trig::degrees(trig::atan2(t.y, t.x)) + trig::degrees(trig::atan2(sin, cos));
        Stop { at: deg, cos: t.x * cos - t.y * sin, sin: t.y * cos + t.x * sin }
    }

    /// The spans of the whole turn on which the dyad closes.
    ///
    /// What is compared at 0 and at 180 degrees is a sum of lengths with a sum of lengths; equal within their
    /// rounding, they make a change point.
    fn spans(&self, dyad: usize, next_id: &mut usize) -> Vec<Span> {
        if self.hope.iter().any(|hope| *hope <= self.tolerance) {
            return Vec::new();
        }
        let [fold, stretch] = self.room.map(|room| Gate::new(room, self.tolerance));
        // The smaller of 1 - cos and 1 + cos is the exact one, and both make the sine.
        let direction = |[minus, plus]: [f64; 2]| {
            (if minus < plus { 1.0 - minus } else { plus - 1.0 }, (minus * plus).max(0.0).sqrt())
        };
        let [inner, outer] = self.versines.map(direction);

        let (change, limit) = (Cause::Change, Cause::Limit);
        let mut at = |(cos, sin): (f64, f64), cause| {
            *next_id += 1;
            let end = IntervalEnd::flat(self.stop(cos, sin), cause, dyad, *next_id);
            if cause == change && cos > 0.0 { end.with(dyad, self.may_vanish) } else { end }
        };
        let arc = |lower: IntervalEnd, upper: IntervalEnd| {
            // Both ends are within half a turn of `towards`; the upper one follows the lower.
            let turn = if upper.stop.at > lower.stop.at { 0.0 } else { 360.0 };
            Span::Arc { lower, upper: upper.turned(turn) }
        };
        let mirrored = |(cos, sin): (f64, f64)| (cos, -sin);
        match (fold, stretch) {
            (Gate::Open, Gate::Open) => vec![Span::Turn],
            (Gate::Touched, Gate::Open) => {
                let near = at((1.0, 0.0), change);
                vec![arc(near, near)]
            }
            (Gate::Open, Gate::Touched) => {
                let far = at((-1.0, 0.0), change);
                vec![arc(far, far)]
            }
            (Gate::Touched, Gate::Touched) => {
                let (near, far) = (at((1.0, 0.0), change), at((-1.0, 0.0), change));
                vec![arc(near, far), arc(far, near)]
            }
            (Gate::Shut, Gate::Open) => {
                let (lower, upper) = (at(inner, limit), at(mirrored(inner), limit));
                vec![arc(lower, upper)]
            }
            (Gate::Open, Gate::Shut) => {
                let (lower, upper) = (at(mirrored(outer), limit), at(outer, limit));
                vec![arc(lower, upper)]
            }
            (Gate::Touched, Gate::Shut) => {
                let near = at((1.0, 0.0), change);
                let (lower, upper) = (at(mirrored(outer), limit), at(outer, limit));
                vec![arc(lower, near), arc(near, upper)]
            }
            (Gate::Shut, Gate::Touched) => {
                let far = at((-1.0, 0.0), change);
                let (lower, upper) = (at(inner, limit), at(mirrored(inner), limit));
                vec![arc(lower, far), arc(far, upper)]
            }
            (Gate::Shut, Gate::Shut) => {
                let up = [at(inner, limit), at(outer, limit)];
                let down = [at(mirrored(outer), limit), at(mirrored(inner), limit)];
                vec![arc(down[0], down[1]), arc(up[0], up[1])]
            }
        }
    }
}

/// The direction that turns `b` into the direction of `a`: their quotient, as of complex numbers.
fn quotient(a: Vector, b: Vector) -> Vector {
    let product = a.norm() * b.norm();
    if product > 0.0 { Vector::new(a.dot(&b), cross(b, a)) / product } else { Vector::new(1.0, 0.0) }
}

/// Whether a dyad can pass the shortest or the longest its base can be.
#[derive(Clone, Copy, PartialEq)]
enum Gate {
    Open,
    /// It lies flat there, and can.
    Touched,
    Shut,
}

impl Gate {
    fn new(room: f64, tolerance: f64) -> Gate {
        if room.abs() <= tolerance {
            Gate::Touched
        } else if room > 0.0 {
            Gate::Open
        } else {
            Gate::Shut
        }
    }
}

/// Ends closer than this, in degrees or in parts of a length, are at one input: the rounding of an angle near 360.
const COINCIDENT: f64 = 1e-12;

/// The end that comes later as the input rises (`way` 1) or falls (-1); both in one where they are at one input, with
/// the number of the earlier dyad's.
fn later(earlier_dyads: IntervalEnd, own: IntervalEnd, way: f64) -> IntervalEnd {
    let over = (own.stop.at - earlier_dyads.stop.at) * way;
    if over.abs() <= COINCIDENT * earlier_dyads.stop.at.abs().max(1.0) {
        earlier_dyads.merged(own)
    } else if over > 0.0 {
        own
    } else {
        earlier_dyads
    }
}

/// The parts of `span` that are in one of `allowed`, which may be up to so many turns off.
fn intersect(span: Span, allowed: Vec<Span>, turns: i32) -> Vec<Span> {
    let Span::Arc { lower, upper } = span else { return allowed };
    let mut out = Vec::new();
    for piece in allowed {
        let Span::Arc { lower: from, upper: to } = piece else {
            out.push(span);
            continue;
        };
        for turn in -turns..=turns {
            let (from, to) = (from.turned(360.0 * f64::from(turn)), to.turned(360.0 * f64::from(turn)));
            let low = later(lower, from, 1.0);
            let high = later(upper, to, -1.0);
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

/// A dyad whose reach is sampled along a span.
struct Sampled<'a> {
    linkage: &'a Linkage,
    dyad: &'a Dyad,
    span: Span,
    signs: Signs,
}

impl Sampled<'_> {
    /// The extent at each input; the ends of the span with the dyad flat that ends it.
    fn extents(&self, degs: &[f64]) -> Vec<f64> {
        let input = self.linkage.input();
        let stops: Vec<Stop> = degs.iter().map(|&at| Stop::of(input, at)).collect();
        let mut out = Columns::new(self.linkage.joints.len(), degs.len());
        let joints = self.dyad.joint;
        let modes = Modes::new(self.signs, Flat::NONE);
        let inputs = OwnInputs::new(&stops);
        place(self.linkage, joints, inputs.all(), &modes, &mut out, 0..degs.len());
        if let Span::Arc { lower, upper } = self.span {
            for (i, deg) in degs.iter().enumerate() {
                for end in [lower, upper].into_iter().filter(|end| end.stop.at == *deg) {
                    let modes = Modes::new(self.signs, end.flat);
                    let inputs = OwnInputs::new(&[end.stop]);
                    place(self.linkage, joints, inputs.all(), &modes, &mut out, i..i + 1);
                }
            }
        }
        (0..degs.len()).map(|i| self.dyad.extent(|joint| out.point(joint, i))).collect()
    }

    /// What is left to stretch or to fold at an input, whichever is less; negative where the dyad does not close.
    fn room(&self, deg: f64) -> f64 {
        self.room_of(self.extents(&[deg])[0])
    }

    fn room_of(&self, extent: f64) -> f64 {
        let [low, high] = self.dyad.bounds();
        let room = (high - extent).min(extent - low);
        if room.is_nan() { -1.0 } else { room }
    }

    fn grid(&self) -> Vec<f64> {
        let (from, to) = match self.span {
            Span::Turn => (0.0, self.linkage.input().period()),
            Span::Arc { lower, upper } => (lower.stop.at, upper.stop.at),
        };
        let turns = if self.linkage.input() == Input::Length { 1.0 } else { (to - from) / 360.0 };
        let n = (turns * SAMPLES as f64).ceil() as usize + 4;
        let at = |i: usize| if i == n { to } else { from + (to - from) * i as f64 / n as f64 };
        (0..=n).map(at).collect()
    }

    /// The least and the greatest extent.
    fn range(&self) -> [f64; 2] {
        let extents = self.extents(&self.grid());
        let fold = |pick: fn(f64, f64) -> f64, start| extents.iter().copied().fold(start, pick);
        [fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY)]
    }

    fn spans(&self, next_id: &mut usize) -> Vec<Span> {
        let mut degs = self.grid();
        let extents = self.extents(&degs);
        let tolerance = self.tolerance(&extents);
        if matches!(self.dyad.step, Step::Dyad { .. }) && extents.iter().all(|extent| *extent <= tolerance) {
            // Two joints that are one point throughout leave their dyad free to turn: it has no place.
            return Vec::new();
        }
        let mut rooms: Vec<f64> = extents.iter().map(|&extent| self.room_of(extent)).collect();
        let touched = self.look_between(&mut degs, &mut rooms, tolerance);
        let open: Vec<bool> = rooms.iter().map(|room| *room >= -tolerance).collect();
        let mut end = |inside: f64, outside: f64| {
            *next_id += 1;
            let stop = Stop::of(self.linkage.input(), self.refine(inside, outside));
            IntervalEnd::flat(stop, Cause::Limit, self.dyad.index, *next_id)
        };
        let mut arcs: Vec<(Option<IntervalEnd>, Option<IntervalEnd>)> = Vec::new();
        let mut lower = open[0].then_some(None);
        for i in 1..degs.len() {
            match (open[i - 1], open[i]) {
                (false, true) => lower = Some(Some(end(degs[i], degs[i - 1]))),
                (true, false) => arcs.extend(lower.take().map(|from| (from, Some(end(degs[i - 1], degs[i]))))),
                _ => {}
            }
        }
        arcs.extend(lower.map(|from| (from, None)));
        let spans = self.joined(arcs, tolerance);
        touched.into_iter().fold(spans, |spans, at| {
            *next_id += 1;
            let stop = Stop::of(self.linkage.input(), at);
            parted(spans, IntervalEnd::flat(stop, Cause::Change, self.dyad.index, *next_id), self.linkage.input())
        })
    }

    /// Extents that differ by no more than their rounding: what is within this of a bound touches it.
    fn tolerance(&self, extents: &[f64]) -> f64 {
        let [low, high] = self.dyad.bounds();
        let finite = if high.is_finite() { high.abs() } else { 0.0 };
        let greatest = extents.iter().copied().filter(|e| e.is_finite()).fold(0.0, |a: f64, b| a.max(b.abs()));
        64.0 * f64::EPSILON * (low.abs() + finite + greatest)
    }

    /// The end of the span, where this dyad lies flat too if there is no room left.
    fn at_end(&self, end: IntervalEnd, tolerance: f64) -> IntervalEnd {
        let extent = self.extents(&[end.stop.at])[0];
        if end.cause == Cause::Asked || self.room_of(extent).abs() > tolerance {
            return end;
        }
        end.with(self.dyad.index, matches!(self.dyad.step, Step::Dyad { .. }) && extent <= tolerance)
    }

    /// Gives the arcs that reach the ends of the span those ends; on a whole turn, joins them over input 0.
    fn joined(&self, mut arcs: Vec<(Option<IntervalEnd>, Option<IntervalEnd>)>, tolerance: f64) -> Vec<Span> {
        match self.span {
            Span::Turn => {
                let over_zero = arcs.len() > 1 && arcs[0].0.is_none() && arcs[arcs.len() - 1].1.is_none();
                if over_zero {
                    let (_, upper) = arcs.remove(0);
                    let last = arcs.len() - 1;
                    arcs[last].1 = upper.map(|end| end.turned(self.linkage.input().period()));
                }
                let span = |arc| match arc {
                    (Some(lower), Some(upper)) => Span::Arc { lower, upper },
                    _ => Span::Turn,
                };
                arcs.into_iter().map(span).collect()
            }
            Span::Arc { lower, upper } => arcs
                .into_iter()
                .map(|(from, to)| Span::Arc {
                    lower: from.unwrap_or_else(|| self.at_end(lower, tolerance)),
                    upper: to.unwrap_or_else(|| self.at_end(upper, tolerance)),
                })
                .filter(|span| matches!(span, Span::Arc { lower, upper } if lower.stop.at < upper.stop.at))
                .collect(),
        }
    }

    /// Inserts the bottom of a dip, or the top of a rise, that passes a bound between samples. The inputs at which a
    /// bound is touched and not passed are returned.
    fn look_between(&self, degs: &mut Vec<f64>, rooms: &mut Vec<f64>, tolerance: f64) -> Vec<f64> {
        let mut found = Vec::new();
        let mut touched = Vec::new();
        for i in 1..degs.len() - 1 {
            let (before, here, after) = (rooms[i - 1], rooms[i], rooms[i + 1]);
            let is_open = here >= -tolerance;
            let sign = if is_open { 1.0 } else { -1.0 };
            let is_turning = sign * before >= sign * here && sign * here <= sign * after;
            // Between samples the room changes by no more than a few times what it changed to the next one.
            let is_near = here.abs() <= 4.0 * (before - here).abs().max((after - here).abs());
            if is_turning && is_near {
                let deg = golden(degs[i - 1], degs[i + 1], |deg| sign * self.room(deg));
                let room = self.room(deg);
                // Near where a bound is touched the room is as flat as its rounding: the slope tells the place.
                let at = self.level(degs[i - 1], degs[i + 1]).unwrap_or(deg);
                let clear = before.min(after) > 1e3 * tolerance;
                if is_open && room < -tolerance || !is_open && room >= -tolerance {
                    found.push((deg, room));
                } else if is_open && clear && self.room(at) <= tolerance {
                    touched.push(at);
                }
            }
        }
        for (deg, room) in found {
            let at = degs.partition_point(|d| *d < deg);
            degs.insert(at, deg);
            rooms.insert(at, room);
        }
        touched
    }

    /// Where the length of the base is least or greatest between two inputs, by bisection of its rate.
    fn level(&self, a: f64, b: f64) -> Option<f64> {
        let (Step::Dyad { base: [p, q], .. } | Step::Slot { base: [p, q], .. }) = self.dyad.step else { return None };
        let rate = |at: f64| {
            let stop = Stop::of(self.linkage.input(), at);
            let jets = Jets::in_fixed_frame(self.linkage, stop, self.signs, Flat::NONE);
            (jets.place(q) - jets.place(p)).dot(&(jets.velocity(q) - jets.velocity(p)))
        };
        let (mut a, mut b) = (a, b);
        let rises = rate(b) > 0.0;
        if (rate(a) > 0.0) == rises {
            return None;
        }
        loop {
            let middle = a + (b - a) / 2.0;
            if middle == a || middle == b {
                return Some(middle);
            }
            if (rate(middle) > 0.0) == rises { b = middle } else { a = middle }
        }
    }

    /// The last input, going from `inside` towards `outside`, at which the dyad still closes.
    fn refine(&self, mut inside: f64, mut outside: f64) -> f64 {
        let floor = self.room(inside).min(0.0);
        loop {
            let middle = inside + (outside - inside) / 2.0;
            if middle == inside || middle == outside {
                return inside;
            }
            if self.room(middle) >= floor { inside = middle } else { outside = middle }
        }
    }
}

/// The spans with the one that an end lies inside of parted there.
fn parted(spans: Vec<Span>, end: IntervalEnd, input: Input) -> Vec<Span> {
    let mut out = Vec::new();
    for span in spans {
        match (span, span.turns_to(end.stop.at, input.period())) {
            (Span::Turn, _) => out.push(Span::Arc { lower: end, upper: end.turned(input.period()) }),
            (Span::Arc { lower, upper }, Some(at)) if lower.stop.at < at && at < upper.stop.at => {
                let end = end.turned(at - end.stop.at);
                out.extend([Span::Arc { lower, upper: end }, Span::Arc { lower: end, upper }]);
            }
            _ => out.push(span),
        }
    }
    out
}

/// Where `f` is least between `a` and `b`, by golden section.
fn golden(mut a: f64, mut b: f64, f: impl Fn(f64) -> f64) -> f64 {
    const RATIO: f64 = 0.618_033_988_749_894_9;
    let (mut x, mut y) = (b - RATIO * (b - a), a + RATIO * (b - a));
    let (mut fx, mut fy) = (f(x), f(y));
    // 0.618^40 of a sample is below the rounding of an angle.
    for _ in 0..40 {
        if fx < fy {
            (b, y, fy) = (y, x, fx);
            x = b - RATIO * (b - a);
            fx = f(x);
        } else {
            (a, x, fx) = (x, y, fy);
            y = a + RATIO * (b - a);
            fy = f(y);
        }
    }
    if fx < fy { x } else { y }
}

//! The motion next to an end of a pass, as power series in a root of the distance of the input from it.
//!
//! Where a dyad is flat, its joint moves with the root of the distance or, at a change point, with the distance; where a base has no
//! length, its direction is that of the first derivative that is not zero. Both follow from the series of the joints before, so that
//! limits and derivatives are those of the motion on the pass, and not differences.

use super::AssemblyError;
use super::pass::{Heading, PassEnd};
use super::series::{Series, VectorSeries, geared_angle};
use crate::geometry::{Point, Vector, trig};
use crate::linkage::{AssemblyMode, DyadId, DyadSet, Joint, JointId, JointKind, LineDirection, Linkage};

/// The number of terms. Every root of a flat dyad and every direction of a base without length loses some.
const TERMS: usize = 16;

/// The order of the greatest root: three dyads, each at a limit of those before it.
const MAX_ROOT: usize = 8;

/// A base shorter than this part of the coordinates of its joints has no length.
const VANISHING_BASE: f64 = 1e-12;

/// Positions that differ by less than this part of the length of a link are the same, and not on its two sides.
const SAME_PLACE: f64 = 1e-6;

const UNKNOWN: Vector = Vector::new(f64::NAN, f64::NAN);

/// A coefficient below this part of the others is rounding: at a limit that misses a change point by 1e-12 it is 1e-6.
const ROUNDING: f64 = 1e-9;

type EndVector = VectorSeries<f64, TERMS>;

/// Positions of all joints next to an end of a pass, in the frame of the fixed joints.
pub(super) struct EndSeries {
    /// The distance of the input, in radians or in units of length, is this power of the variable.
    root: usize,
    /// 1 where the pass lies at greater inputs than its end, -1 where it lies at smaller ones.
    inwards: f64,
    /// The coefficients that are not known are NaN.
    at: Vec<EndVector>,
    /// For each joint that is placed on a base, or along a line, whose joints coincide at the end, the direction of that
    /// on the pass.
    directions: Vec<Option<Vector>>,
}

/// Why a joint has no series.
enum Failure {
    /// It is one in a greater root.
    OddPower,
    /// Its dyad does not close, or its base has no direction.
    Undefined,
}

impl EndSeries {
    /// The series on a pass in an assembly mode that begins or ends at `end` and lies `inwards` of it.
    pub fn new(linkage: &Linkage, end: &PassEnd, mode: AssemblyMode, inwards: f64) -> EndSeries {
        let mut root = 1;
        loop {
            let mut placing = Placing { linkage, end, mode, inwards, root, at: Vec::new(), directions: Vec::new() };
            match placing.place_all(root == MAX_ROOT) {
                Some(()) => {
                    let Placing { at, directions, .. } = placing;
                    return EndSeries { root, inwards, at, directions };
                }
                None => root *= 2,
            }
        }
    }

    /// The joint's position at the end, in the limit on the pass; NaN if there is none.
    pub fn limit(&self, joint: JointId) -> Point {
        Point::new(self.at[joint].x.0[0], self.at[joint].y.0[0])
    }

    /// Whether a joint is placed on a base, or along a line, whose joints coincide at the end.
    pub fn is_by_continuity(&self, joint: JointId) -> bool {
        self.directions[joint.index()].is_some()
    }

    /// The joint's position at a distance of the input from the end, in radians or in units of length; `None` if so many terms of its
    /// series do not give it to rounding.
    pub fn position(&self, joint: JointId, distance: f64) -> Option<Point> {
        let s = (0..self.root.ilog2()).fold(distance, |s, _| s.sqrt());
        let sum = |series: &Series<f64, TERMS>| {
            let known = series.0.iter().position(|c| c.is_nan()).unwrap_or(TERMS);
            let powers = (0..known).scan(1.0, |power, _| Some(std::mem::replace(power, *power * s)));
            let terms: Vec<f64> = powers.zip(&series.0).map(|(power, c)| power * c).collect();
            let size = terms.iter().fold(0.0, |most: f64, term| most.max(term.abs()));
            let rest = terms.iter().rev().take(2).fold(0.0, |most: f64, term| most.max(term.abs()));
            (known > 3 && rest <= f64::EPSILON * size).then(|| terms.iter().rev().sum::<f64>())
        };
        let VectorSeries { x, y } = &self.at[joint];
        Some(Point::new(sum(x)?, sum(y)?))
    }

    /// The first Taylor coefficients of the position with respect to the input; infinite where a root of the distance changes it.
    pub fn in_input<const N: usize>(&self, joint: JointId) -> VectorSeries<f64, N> {
        let series = |series: &Series<f64, TERMS>| {
            let size = series.0.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
            let is_rounding = |c: f64| c.abs() <= f64::EPSILON * size;
            let is_root = |k: &usize| !k.is_multiple_of(self.root) && !is_rounding(series.0[*k]);
            let regular = (0..TERMS).find(is_root).unwrap_or(TERMS);
            let sense = |n: usize| if n % 2 == 1 { self.inwards } else { 1.0 };
            Series(std::array::from_fn(|n| match n * self.root {
                k if k < regular => series.0[k] * sense(n),
                _ => f64::INFINITY,
            }))
        };
        VectorSeries { x: series(&self.at[joint].x), y: series(&self.at[joint].y) }
    }
}

/// The sides of dyads after an end of a pass, with those whose bases vanish there on the sides on which their joints do not jump.
///
/// # Errors
/// A joint would jump on either side.
pub(super) fn continuous_mode(
    linkage: &Linkage,
    end: &PassEnd,
    before: Heading,
    after: Heading,
) -> Result<AssemblyMode, AssemblyError> {
    let Heading { mut mode, rises } = after;
    if end.vanishing_dyads.is_empty() {
        return Ok(mode);
    }
    let sense = |rises: bool| if rises { 1.0 } else { -1.0 };
    let arriving = EndSeries::new(linkage, end, before.mode, -sense(before.rises));
    for (id, joint) in linkage.joint_ids().zip(&linkage.joints) {
        let is_reached = |mode: AssemblyMode| {
            let leaving = EndSeries::new(linkage, end, mode, sense(rises));
            // The foot of a slot without offset is its pivot: its line must not turn round.
            let [from, to, size] = match joint.kind {
                JointKind::Slot { offset: 0.0, dyad, .. } => {
                    let line = |series: &EndSeries, mode: AssemblyMode| {
                        series.directions[id.index()].unwrap_or(UNKNOWN) * f64::from(mode.sign(dyad))
                    };
                    [line(&arriving, before.mode), line(&leaving, mode), Vector::x()]
                }
                kind => {
                    // Relative to a joint at the other end of its link, whatever the distance of the linkage from the origin.
                    let other = match kind {
                        JointKind::Slide { from, .. }
                        | JointKind::Aligned { from, .. }
                        | JointKind::Yoke { from, .. } => from,
                        kind => kind.base().map_or(id, |[first, _]| first),
                    };
                    let [from, to] = [&arriving, &leaving].map(|series| series.limit(id) - arriving.limit(other));
                    [from, to, from]
                }
            };
            (to - from).norm() <= SAME_PLACE * size.norm()
        };
        let vanishing = joint.kind.dyad().filter(|dyad| end.vanishing_dyads.contains(*dyad));
        if vanishing.is_none() && !arriving.is_by_continuity(id) || is_reached(mode) {
            continue;
        }
        mode = vanishing.map(|dyad| mode.flipped(DyadSet::single(dyad))).filter(|&mode| is_reached(mode)).ok_or_else(
            || {
                let name = |joint: JointId| linkage.joints[joint].name.clone();
                let base = joint.kind.base().unwrap_or([id; 2]).map(name);
                let input = end.input.value.rem_euclid(linkage.input().period());
                AssemblyError::Jump { joint: name(id), base, input }
            },
        )?;
    }
    Ok(mode)
}

/// The direction from one joint to another and their distance.
struct Base {
    unit: EndVector,
    length: Series<f64, TERMS>,
    /// Whether they coincide at the end.
    vanishes: bool,
}

/// The joints that have been placed so far.
struct Placing<'a> {
    linkage: &'a Linkage,
    end: &'a PassEnd,
    mode: AssemblyMode,
    inwards: f64,
    root: usize,
    at: Vec<EndVector>,
    directions: Vec<Option<Vector>>,
}

impl Placing<'_> {
    /// Places all joints; `None` if a greater root is needed, unless this is the last one.
    fn place_all(&mut self, is_last: bool) -> Option<()> {
        for joint in &self.linkage.joints {
            let mut vanishing = None;
            let placed = self.place(joint.kind, &mut vanishing);
            self.at.push(match placed {
                Ok(position) => position,
                Err(Failure::OddPower) if !is_last => return None,
                Err(_) => VectorSeries { x: Series([f64::NAN; TERMS]), y: Series([f64::NAN; TERMS]) },
            });
            self.directions.push(vanishing);
        }
        Some(())
    }

    fn place(&self, kind: JointKind, vanishing: &mut Option<Vector>) -> Result<EndVector, Failure> {
        let at = |joint: JointId| self.at[joint];
        let zero = number(0.0);
        let mut direction = |pair: [JointId; 2]| {
            *vanishing = Some(UNKNOWN);
            let base = self.direction(pair)?;
            *vanishing = base.vanishes.then(|| Vector::new(base.unit.x.0[0], base.unit.y.0[0]));
            Ok(base)
        };
        Ok(match kind {
            JointKind::Fixed(point) => VectorSeries::constant(point.coords),
            JointKind::Crank { pivot, length } => {
                let unit = VectorSeries::rotating_unit([self.end.input.cos, self.end.input.sin], 1.0);
                at(pivot).moved(self.composed(unit), number(length), zero)
            }
            JointKind::Gear { pivot, length, ratio, phase_deg } => {
                let (cos, sin) = trig::cos_sin_deg(geared_angle(self.end.input.value, ratio, phase_deg));
                let unit = VectorSeries::rotating_unit([cos, sin], ratio[0] as f64 / ratio[1] as f64);
                at(pivot).moved(self.composed(unit), number(length), zero)
            }
            JointKind::Piston { base, length, offset, dyad } => {
                let s = self.input();
                let b = root(s.square() + number(offset * offset), self.end.input.value * self.end.input.value, false)?;
                self.dyad(at(base[0]), direction(base)?, [b, number(length)], dyad)?
            }
            // Rates at the limits of groups are those of their tracks.
            JointKind::Grouped { .. } => return Err(Failure::Undefined),
            JointKind::Rack { line, offset, radius, start } => {
                let Base { unit, .. } = direction(line)?;
                let mut turn = self.input();
                turn.0[0] = trig::radians(turn.0[0]);
                at(line[0]).moved(unit, turn.scaled(radius) + number(start), number(offset))
            }
            JointKind::DrivenSlider { line, offset } => {
                let Base { unit, .. } = direction(line)?;
                at(line[0]).moved(unit, self.input(), number(offset))
            }
            JointKind::Dyad { base, lengths, dyad } => {
                self.dyad(at(base[0]), direction(base)?, lengths.map(number), dyad)?
            }
            JointKind::Slide { from, length, line, offset, dyad } => {
                let Base { unit, .. } = direction(line)?;
                let h = number(offset) - unit.cross(at(from).minus(at(line[0])));
                let square = (number(length) - h) * (number(length) + h);
                let along = root(square, length * length, self.end.flat_dyads.contains(dyad))?;
                at(from).moved(unit, along.scaled(self.sign(dyad)), h)
            }
            JointKind::Slot { base, offset: 0.0, .. } => {
                let _: Result<Base, Failure> = direction(base);
                at(base[0])
            }
            JointKind::Slot { base, offset, dyad } => {
                let Base { unit, length: d, .. } = direction(base)?;
                let square = (d - number(offset.abs())) * (d + number(offset.abs()));
                let slide = root(square, offset * offset, self.end.flat_dyads.contains(dyad))?;
                let across = slide.scaled(offset * self.sign(dyad)) / d;
                at(base[0]).moved(unit, number(offset * offset) / d, across)
            }
            JointKind::Rigid { base: [p, q], along, across } => {
                at(p).moved(at(q).minus(at(p)), number(along), number(across))
            }
            JointKind::Parallelogram { corners: [p, q, r] } => at(p).moved(at(r).minus(at(q)), number(1.0), zero),
            JointKind::Yoke { from, line, offset, slot_direction: slot } => {
                let Base { unit, .. } = direction(line)?;
                let pin = at(from).minus(at(line[0]));
                let along = unit.dot(pin) - (unit.cross(pin) - number(offset)).scaled(slot.x / slot.y);
                at(line[0]).moved(unit, along, number(offset))
            }
            JointKind::Aligned { from, line, offset, direction: line_is, along, across } => {
                let Base { unit, length: d, .. } = direction(line)?;
                let sense = if let LineDirection::BySide(dyad) = line_is { -self.sign(dyad) } else { 1.0 };
                let (along, across) = (along * sense, across * sense);
                if offset == 0.0 {
                    return Ok(at(from).moved(unit, number(along), number(across)));
                }
                // The line's direction is the base's, rotated clockwise by the angle whose sine is offset / d.
                let s = match line_is {
                    LineDirection::Actuator => self.input(),
                    _ => ((d - number(offset)) * (d + number(offset))).sqrt(),
                };
                let forward = (s.scaled(along) + number(across * offset)) / d;
                at(from).moved(unit, forward, (s.scaled(across) - number(along * offset)) / d)
            }
        })
    }

    fn sign(&self, dyad: DyadId) -> f64 {
        f64::from(self.mode.sign(dyad))
    }

    /// The joint of an RRR dyad, from the first joint of its base.
    fn dyad(
        &self,
        from: EndVector,
        Base { unit, length: d, vanishes }: Base,
        [l0, l1]: [Series<f64, TERMS>; 2],
        dyad: DyadId,
    ) -> Result<EndVector, Failure> {
        let magnitude = l0.0[0] * l1.0[0];
        let (sum, difference) = (l0 + l1, l0 - l1);
        let (foot, square) = if vanishes {
            // The links are equally long, within rounding.
            (d.scaled(0.5), ((sum - d) * (sum + d)).scaled(0.25))
        } else {
            let product = (sum - d) * (sum + d) * ((d - difference) * (d + difference));
            ((d + sum * difference / d).scaled(0.5), product.scaled(0.25) / d.square())
        };
        let height = root(square, magnitude, self.end.flat_dyads.contains(dyad))?;
        Ok(from.moved(unit, foot, height.scaled(self.sign(dyad))))
    }

    /// The base from one joint to another.
    fn direction(&self, pair: [JointId; 2]) -> Result<Base, Failure> {
        let [p, q] = pair.map(|joint| self.at[joint]);
        let base = q.minus(p);
        let coefficient = |v: &EndVector, n: usize| Vector::new(v.x.0[n], v.y.0[n]);
        let size = |range: std::ops::Range<usize>| {
            range.flat_map(|n| [coefficient(&p, n).norm(), coefficient(&q, n).norm()]).fold(0.0, f64::max)
        };
        let is_known = |joint: &Joint| {
            let dyad = joint.kind.dyad().filter(|dyad| self.end.vanishing_dyads.contains(*dyad));
            dyad.and(joint.kind.base()).is_some_and(|[a, b]| pair == [a, b] || pair == [b, a])
        };
        let least = VANISHING_BASE * size(0..TERMS / 4 + 1);
        if coefficient(&base, 0).norm() > least && !self.linkage.joints.iter().any(is_known) {
            let d = base.norm_squared().sqrt();
            let unit = VectorSeries { x: base.x / d, y: base.y / d };
            return Ok(Base { unit, length: d, vanishes: false });
        }
        let least = ROUNDING * size(1..TERMS / 4 + 1);
        let is_rounding = |c: f64| c <= least;
        let order = (1..TERMS).find(|&n| !is_rounding(coefficient(&base, n).norm())).ok_or(Failure::Undefined)?;
        let leading = VectorSeries { x: lowered(base.x, order), y: lowered(base.y, order) };
        if !coefficient(&leading, 0).norm().is_finite() {
            return Err(Failure::Undefined);
        }
        let length = leading.norm_squared().sqrt();
        let unit = VectorSeries { x: leading.x / length, y: leading.y / length };
        Ok(Base { unit, length: raised(length, order), vanishes: true })
    }

    /// The value of the input.
    fn input(&self) -> Series<f64, TERMS> {
        let value = |n| {
            if n == 0 {
                self.end.input.value
            } else if n == self.root {
                self.inwards
            } else {
                0.0
            }
        };
        Series(std::array::from_fn(value))
    }

    /// A series in the input as one in the variable.
    fn composed(&self, v: EndVector) -> EndVector {
        let composed = |series: Series<f64, TERMS>| {
            let sense = |n: usize| if n % 2 == 1 { self.inwards } else { 1.0 };
            let coefficient = |k: usize| {
                if k.is_multiple_of(self.root) { series.0[k / self.root] * sense(k / self.root) } else { 0.0 }
            };
            Series(std::array::from_fn(coefficient))
        };
        VectorSeries { x: composed(v.x), y: composed(v.y) }
    }
}

fn number(value: f64) -> Series<f64, TERMS> {
    Series::constant(value)
}

/// The series divided by a power of its variable; the coefficients below it are rounding.
fn lowered(series: Series<f64, TERMS>, order: usize) -> Series<f64, TERMS> {
    Series(std::array::from_fn(|n| series.0.get(n + order).copied().unwrap_or(f64::NAN)))
}

/// The series multiplied by a power of its variable.
fn raised(series: Series<f64, TERMS>, order: usize) -> Series<f64, TERMS> {
    Series(std::array::from_fn(|n| if n < order { 0.0 } else { series.0[n - order] }))
}

/// The root of a square that is positive next to the end and, if `may_vanish`, may be 0 there within the rounding of terms of this
/// magnitude.
fn root(square: Series<f64, TERMS>, magnitude: f64, may_vanish: bool) -> Result<Series<f64, TERMS>, Failure> {
    let least = ROUNDING * magnitude;
    if !may_vanish && square.0[0] > 0.0 || square.0[0] > least {
        return Ok(square.sqrt());
    }
    let is_rounding = |c: f64| c.abs() <= least;
    let Some(order) = (1..TERMS).find(|&n| !is_rounding(square.0[n])) else { return Ok(number(0.0)) };
    match order % 2 {
        _ if !(square.0[order].is_finite()) => Err(Failure::Undefined),
        1 => Err(Failure::OddPower),
        _ if square.0[order] < 0.0 => Err(Failure::Undefined),
        _ => Ok(raised(lowered(square, order).sqrt(), order / 2)),
    }
}

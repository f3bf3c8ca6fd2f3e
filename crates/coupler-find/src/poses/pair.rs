//! Two dyads as a linkage that is driven by the first: whether it passes the poses, from its closure.
//!
//! The cosine of the transmission angle is k0 + k1 cos β with the angle β of the crank from the frame or, if the second dyad is a
//! slider, from the normal of its line; if it is a slot, the offset of its line over the distance of the crank pin from the block, the root of
//! k0 + k1 cos β. The linkage can be assembled where that is from -1 to 1, on one branch for each sign of its sine.

use super::body::Placed;
use super::dyad::Dyad;
use crate::complex::{Complex, dot, length, times_i};
use coupler_curves::geometry::trig;
use std::f64::consts::{PI, TAU};

/// A dyad, and where its pin is in each pose.
#[derive(Clone, Debug)]
pub(super) struct PosedDyad {
    pub dyad: Dyad,
    /// Of a slot the normals of its line.
    pins: Vec<Complex>,
    /// The greatest distance of its joints from each other and from the body's point; 0 of a slot.
    pub reach: f64,
}

impl PosedDyad {
    pub fn new(dyad: Dyad, placed: &[Placed]) -> PosedDyad {
        let pins = dyad.pins(placed);
        let reach = match dyad {
            Dyad::Revolute { pivot, pin } => length(pin - placed[0].point).max(length(pin - pivot)),
            Dyad::Slider { pin, .. } => length(pin - placed[0].point),
            Dyad::Slot { .. } => 0.0,
        };
        PosedDyad { dyad, pins, reach }
    }
}

/// What is asked of a linkage.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wish {
    pub full_turn: bool,
    pub any_order: bool,
    pub any_circuit: bool,
    /// The greatest distance of two joints of a link, in sizes of the poses.
    pub max_link: f64,
}

/// Why two dyads make no linkage that passes the poses as it should.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Misfit {
    /// Neither dyad is a link, or they have a pivot or a pin in common, so that they are no linkage.
    NoLinkage,
    /// A pivot is beyond the box that is asked for.
    TooFar,
    /// A link is longer than asked for.
    TooLong,
    /// The crank does not turn fully.
    NoFullTurn,
    /// The poses are on several circuits.
    Circuits,
    /// The poses are on one circuit, which passes a limit of the crank between them.
    Branches,
    /// The poses are passed in another order.
    Order,
    /// The condition is not met.
    Condition,
    /// The linkage cannot be assembled in the poses with the accuracy of their equations: it is too near a change point or a limit.
    Unsolved,
}

impl Misfit {
    /// In a few words, as the end of "3 pairs:".
    pub fn description(self) -> &'static str {
        match self {
            Misfit::NoLinkage => "no linkage, for they share a pivot or a pin, or both slide",
            Misfit::TooFar => "a pivot is beyond --pivots",
            Misfit::TooLong => "a link is longer than --max-link",
            Misfit::NoFullTurn => "the crank does not turn fully (--input any)",
            Misfit::Circuits => "the poses are on several circuits",
            Misfit::Branches => "the crank passes a limit between poses",
            Misfit::Order => "the poses are passed in another order",
            Misfit::Condition => "--where is not met",
            Misfit::Unsolved => "too near a limit or a change point to be solved",
        }
    }

    /// Its name in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Misfit::NoLinkage => "no_linkage",
            Misfit::TooFar => "pivots",
            Misfit::TooLong => "max_link",
            Misfit::NoFullTurn => "full_turn",
            Misfit::Circuits => "circuits",
            Misfit::Branches => "branches",
            Misfit::Order => "order",
            Misfit::Condition => "where",
            Misfit::Unsolved => "unsolved",
        }
    }
}

/// How a linkage passes the poses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Passing {
    /// The greatest size of the cosine of the transmission angle from the first pose to the last.
    pub worst_cosine: f64,
    /// The same by which linkages are ranked: over the whole turn if the crank is to turn fully.
    pub ranked_cosine: f64,
}

/// The two pins of a linkage in a pose: that of the crank, and that of the other dyad or, of a slot, the foot of the perpendicular from the
/// pivot to the parallel to its line through the crank pin.
pub(super) fn pins(crank: &PosedDyad, follower: &PosedDyad, pose: usize) -> [Complex; 2] {
    let [a, b] = [crank, follower].map(|dyad| dyad.pins[pose]);
    match follower.dyad {
        Dyad::Slot { pivot, .. } => [a, pivot - b * dot(b, pivot - a)],
        Dyad::Revolute { .. } | Dyad::Slider { .. } => [a, b],
    }
}

/// The closure of a linkage.
struct Closure {
    constant: f64,
    slope: f64,
    /// Of a slot, the distance of its line from the pivot.
    offset: Option<f64>,
    /// The direction from which the crank's angle is counted.
    from: Complex,
    pivot: Complex,
}

/// A cosine may be beyond 1 by so much at a change point.
const ROUNDING: f64 = 1e-12;

impl Closure {
    fn new(crank: &PosedDyad, follower: &PosedDyad) -> Option<Closure> {
        /// Shorter links, in sizes of the poses, are none.
        const SHORTEST: f64 = 1e-6;
        let Dyad::Revolute { pivot, pin: a } = crank.dyad else { return None };
        let arm = length(a - pivot);
        let frame = |other: Complex| Some(length(other - pivot)).filter(|frame| *frame > SHORTEST);
        let rod = |b: Complex| Some(length(b - a)).filter(|rod| *rod >= SHORTEST);
        Some(match follower.dyad {
            Dyad::Revolute { pivot: other, pin: b } => {
                let (rod, rocker, frame) = (rod(b)?, length(b - other), frame(other)?);
                let twice = 2.0 * rod * rocker;
                let constant = (rod * rod + rocker * rocker - frame * frame - arm * arm) / twice;
                let slope = 2.0 * frame * arm / twice;
                Closure { constant, slope, offset: None, from: (other - pivot) / frame, pivot }
            }
            Dyad::Slider { normal, pin: b } => {
                let rod = rod(b)?;
                let constant = dot(normal, pivot - b) / rod;
                Closure { constant, slope: arm / rod, offset: None, from: normal, pivot }
            }
            Dyad::Slot { pivot: other, normal } => {
                let frame = frame(other)?;
                let (constant, slope) = (frame * frame + arm * arm, -2.0 * frame * arm);
                let offset = Some(dot(normal, other - a).abs());
                Closure { constant, slope, offset, from: (other - pivot) / frame, pivot }
            }
        })
    }

    /// The cosine of the transmission angle, which falls or rises from β = 0 to π, for that of β.
    fn cosine(&self, of_crank: f64) -> f64 {
        let value = self.constant + self.slope * of_crank;
        match self.offset {
            Some(offset) => offset / value.max(f64::MIN_POSITIVE).sqrt(),
            None => value,
        }
    }

    /// Whether the crank does not reach β = 0, and β = π.
    fn limits(&self) -> [bool; 2] {
        [self.cosine(1.0) > 1.0 + ROUNDING, self.cosine(-1.0) < -1.0 - ROUNDING]
    }

    fn is_full_turn(&self) -> bool {
        [1.0, -1.0].into_iter().all(|of_crank| self.cosine(of_crank).abs() <= 1.0 + ROUNDING)
    }

    /// The angle of the crank, where it has no limit at 0 from -π to π, and otherwise from 0 to 2π.
    fn angle(&self, pin: Complex) -> f64 {
        let z = (pin - self.pivot) * self.from.conj();
        let angle = trig::atan2(z.im, z.re);
        if self.limits() == [true, false] { angle.rem_euclid(TAU) } else { angle }
    }

    /// The greatest size of the cosine over a range of angles.
    fn worst(&self, [from, to]: [f64; 2]) -> f64 {
        let at = |angle: f64| self.cosine(trig::cos(angle)).abs();
        let [low, high] = [from.min(to), from.max(to)];
        let extremes = ((low / PI).ceil() as i64..=(high / PI).floor() as i64).take(3);
        let within = extremes.map(|k| self.cosine(if k % 2 == 0 { 1.0 } else { -1.0 }).abs());
        within.fold(at(from).max(at(to)), f64::max).min(1.0)
    }
}

/// The sign of the branch at each pose: of a pose at a limit, 0.
fn sides<'a>(crank: &'a PosedDyad, follower: &'a PosedDyad) -> impl Iterator<Item = f64> + 'a {
    /// The sine of a transmission angle at a limit.
    const AT_LIMIT: f64 = 1e-9;
    crank.pins.iter().zip(&follower.pins).map(|(a, b)| {
        let (across, rod) = match follower.dyad {
            Dyad::Revolute { pivot, .. } => (times_i(pivot - a), b - a),
            Dyad::Slider { normal, .. } => (times_i(normal), b - a),
            Dyad::Slot { pivot, .. } => (times_i(*b), pivot - a),
        };
        let side = dot(across, rod);
        if side.abs() <= AT_LIMIT * length(across) * length(rod) { 0.0 } else { side.signum() }
    })
}

/// The greatest distance of two joints of a link; of a bar that slides on a block, its part from the crank pin to the block counts as one.
pub(super) fn longest_link(crank: &PosedDyad, follower: &PosedDyad) -> f64 {
    let frame = crank.dyad.pivot().zip(follower.dyad.pivot()).map_or(0.0, |(a, b)| length(a - b));
    let couplers = (0..crank.pins.len()).map(|pose| pins(crank, follower, pose)).map(|[a, b]| length(a - b));
    couplers.fold(crank.reach.max(follower.reach).max(frame), f64::max)
}

/// Whether a linkage passes the poses as asked for.
///
/// # Errors
/// Why it does not.
pub(super) fn passing(crank: &PosedDyad, follower: &PosedDyad, wish: &Wish) -> Result<Passing, Misfit> {
    let closure = Closure::new(crank, follower).ok_or(Misfit::NoLinkage)?;
    if longest_link(crank, follower) > wish.max_link {
        return Err(Misfit::TooLong);
    }
    let is_full_turn = closure.is_full_turn();
    if wish.full_turn && !is_full_turn {
        return Err(Misfit::NoFullTurn);
    }
    let angles: Vec<f64> = crank.pins.iter().map(|pin| closure.angle(*pin)).collect();
    let has_both = |values: &mut dyn Iterator<Item = f64>| {
        let [low, high] = values.fold([0.0_f64; 2], |[low, high], value| [low.min(value), high.max(value)]);
        low < 0.0 && high > 0.0
    };
    let is_divided = closure.limits() == [true, true] && has_both(&mut angles.iter().copied());
    let changes_side = has_both(&mut sides(crank, follower));
    let passing = |worst_cosine| {
        let ranked_cosine = if wish.full_turn { closure.worst([0.0, TAU]) } else { worst_cosine };
        Passing { worst_cosine, ranked_cosine }
    };
    let at_poses = || angles.iter().map(|angle| closure.worst([*angle; 2])).fold(0.0, f64::max);
    if is_divided || changes_side {
        return match wish.any_circuit {
            true => Ok(passing(at_poses())),
            false if is_divided || is_full_turn => Err(Misfit::Circuits),
            false => Err(Misfit::Branches),
        };
    }
    match ordered_range(&angles, is_full_turn) {
        Some(range) => Ok(passing(closure.worst(range))),
        None if wish.any_order => {
            let range = angles.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(*x), b.max(*x)]);
            Ok(passing(closure.worst(if is_full_turn { [0.0, TAU] } else { range })))
        }
        None => Err(Misfit::Order),
    }
}

/// The numbers of the poses, from 1, in the order in which the crank passes them as it turns from that of the first one on a full turn, or else
/// from one limit to the other, in the direction in which the second comes before the last.
pub(super) fn order(crank: &PosedDyad, follower: &PosedDyad) -> Vec<usize> {
    let Some(closure) = Closure::new(crank, follower) else { return Vec::new() };
    let angles: Vec<f64> = crank.pins.iter().map(|pin| closure.angle(*pin)).collect();
    let key = |k: usize| if closure.is_full_turn() { (angles[k] - angles[0]).rem_euclid(TAU) } else { angles[k] };
    let mut order: Vec<usize> = (0..angles.len()).collect();
    order.sort_by(|a, b| key(*a).total_cmp(&key(*b)));
    let place = |number: usize| order.iter().position(|k| *k == number);
    if place(1) > place(angles.len() - 1) {
        match closure.is_full_turn() {
            true => order[1..].reverse(),
            false => order.reverse(),
        }
    }
    order.into_iter().map(|k| k + 1).collect()
}

/// The angles from the first pose to the last, if those between are passed in order in either direction; on a full turn within one.
pub(super) fn ordered_range(angles: &[f64], is_full_turn: bool) -> Option<[f64; 2]> {
    let turn = |sign: f64| {
        let step = |pair: &[f64]| {
            let step = sign * (pair[1] - pair[0]);
            if is_full_turn { step.rem_euclid(TAU) } else { step }
        };
        let mut sum = 0.0;
        for pair in angles.windows(2) {
            let step = step(pair);
            if step <= 0.0 {
                return None;
            }
            sum += step;
        }
        (sum < TAU).then_some(sign * sum)
    };
    // Two poses are in order in both directions of a full turn: the shorter way.
    let found = [turn(1.0), turn(-1.0)].into_iter().flatten();
    let by = found.min_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    Some([angles[0], angles[0] + by])
}

#[cfg(test)]
mod tests {
    use super::super::body::random::random_poses;
    use super::super::dyad::Forms;
    use super::super::five;
    use super::*;
    use crate::complex::unit;

    /// The position of the second pin for an angle of the crank on a side, by the intersection of circles.
    fn second_pin(crank: &PosedDyad, follower: &PosedDyad, angle: f64, side: f64) -> Option<[Complex; 2]> {
        let (Dyad::Revolute { pivot: o, .. }, Dyad::Revolute { pivot: c, .. }) = (crank.dyad, follower.dyad) else {
            return None;
        };
        let [a0, b0] = [crank.pins[0], follower.pins[0]];
        let a = o + unit(angle) * length(a0 - o);
        let (rod, rocker, base) = (length(b0 - a0), length(b0 - c), c - a);
        let along = (rod * rod - rocker * rocker + base.norm_sqr()) / (2.0 * base.norm_sqr());
        let height = rod * rod / base.norm_sqr() - along * along;
        (height >= 0.0).then(|| [a, a + base * Complex::new(along, side * height.sqrt())])
    }

    /// The poses, as their numbers, that are passed as the crank turns from the first one in a direction on its branch, and whether it comes
    /// back there.
    fn walked(crank: &PosedDyad, follower: &PosedDyad, direction: f64) -> (Vec<usize>, bool) {
        const STEPS: usize = 40_000;
        let Dyad::Revolute { pivot, .. } = crank.dyad else { return (Vec::new(), false) };
        let side = sides(crank, follower).next().unwrap_or(0.0);
        let arm = crank.pins[0] - pivot;
        let start = trig::atan2(arm.im, arm.re);
        let mut passed = vec![1];
        let step = TAU / STEPS as f64;
        for k in 0..STEPS {
            let at = |side| second_pin(crank, follower, start + direction * step * (k as f64 + 0.5), side);
            let (Some([_, b]), Some([_, other])) = (at(side), at(-side)) else { return (passed, false) };
            // The poses whose crank pins are within half a step, if the other pin is there, too.
            for number in 1..crank.pins.len() {
                let own = crank.pins[number] - pivot;
                let from = direction * (trig::atan2(own.im, own.re) - start);
                let is_here = (from.rem_euclid(TAU) / step) as usize == k;
                if is_here && length(follower.pins[number] - b) < length(follower.pins[number] - other) {
                    passed.push(number + 1);
                }
            }
        }
        (passed, true)
    }

    #[test]
    fn what_passes_the_poses_does_so_when_it_is_moved_in_small_steps() {
        let wish = Wish { full_turn: false, any_order: false, any_circuit: false, max_link: f64::INFINITY };
        let mut counts = std::collections::BTreeMap::new();
        for seed in 1..=45 {
            let (set, _) = random_poses(5, seed);
            // In another order for some of them.
            let mut placed = set.placed().to_vec();
            if seed % 3 == 0 {
                placed.swap(2, 3);
            }
            let dyads = five::dyads(&Forms::new(&placed).independent()).unwrap();
            let posed: Vec<PosedDyad> = dyads.into_iter().map(|dyad| PosedDyad::new(dyad, &placed)).collect();
            for (k, crank) in posed.iter().enumerate() {
                for (_, follower) in posed.iter().enumerate().filter(|(m, _)| *m != k) {
                    let (forward, is_full) = walked(crank, follower, 1.0);
                    let (backward, _) = walked(crank, follower, -1.0);
                    // All that are reached on the branch of the first, from the limit on one side to that on the other.
                    let mut row: Vec<usize> = backward.iter().skip(1).rev().copied().collect();
                    row.extend(&forward);
                    let rising = |row: &[usize]| row.windows(2).all(|pair| pair[0] < pair[1]);
                    let falling = |row: &[usize]| row.windows(2).all(|pair| pair[0] > pair[1]);
                    let expected = match is_full {
                        true => forward.len() == 5 && (rising(&forward) || falling(&forward[1..])),
                        false => row.len() == 5 && (rising(&row) || falling(&row)),
                    };
                    let found = passing(crank, follower, &wish);
                    // A pose at a limit is beyond the last step.
                    if found.is_ok_and(|passing| passing.worst_cosine > 0.9999) {
                        continue;
                    }
                    assert_eq!(found.is_ok(), expected, "{seed}: {found:?}, {forward:?} {backward:?} {is_full}");
                    if found == Err(Misfit::Order) {
                        let all = if is_full { forward.len() } else { row.len() };
                        assert_eq!(all, 5, "{seed}: all are on the branch");
                    }
                    *counts.entry(found.err()).or_insert(0) += 1;
                }
            }
        }
        for expected in [None, Some(Misfit::Order), Some(Misfit::Circuits), Some(Misfit::Branches)] {
            assert!(counts.get(&expected).is_some_and(|count| *count >= 10), "{expected:?}: {counts:?}");
        }
    }
}

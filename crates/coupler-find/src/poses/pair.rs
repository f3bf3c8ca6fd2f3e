//! Two dyads as a linkage that is driven by the first: whether it passes the poses, from its closure.
//!
//! The cosine of the transmission angle is k0 + k1 cos β with the angle β of the crank from the frame or, if the second dyad is a
//! slider, from the normal of its line: the linkage can be assembled where that is from -1 to 1, on one branch for each sign of its sine.

use super::body::Placed;
use super::dyad::Dyad;
use crate::complex::{Complex, dot, length, times_i};
use coupler_curves::geometry::trig;
use std::f64::consts::{PI, TAU};

/// A dyad, and where its pin is in each pose.
#[derive(Clone, Debug)]
pub(super) struct PosedDyad {
    pub dyad: Dyad,
    pub pins: Vec<Complex>,
    /// The greatest distance of its joints from each other and from the body's point.
    pub reach: f64,
}

impl PosedDyad {
    pub fn new(dyad: Dyad, placed: &[Placed]) -> PosedDyad {
        let pins = dyad.pins(placed);
        let to_point = length(pins[0] - placed[0].point);
        let reach = match dyad {
            Dyad::Revolute { pivot, .. } => to_point.max(length(pins[0] - pivot)),
            Dyad::Slider { .. } => to_point,
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
    /// The first dyad is a slider, or they have a pivot or a pin in common, so that they are no linkage.
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
}

/// The closure of a linkage.
struct Closure {
    constant: f64,
    slope: f64,
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
        let Dyad::Revolute { pivot, .. } = crank.dyad else { return None };
        let [a, b] = [crank, follower].map(|dyad| dyad.pins[0]);
        let (arm, rod) = (length(a - pivot), length(b - a));
        if rod < SHORTEST {
            return None;
        }
        match follower.dyad {
            Dyad::Revolute { pivot: other, .. } => {
                let (rocker, frame) = (length(b - other), length(other - pivot));
                let twice = 2.0 * rod * rocker;
                let constant = (rod * rod + rocker * rocker - frame * frame - arm * arm) / twice;
                let slope = 2.0 * frame * arm / twice;
                (frame > SHORTEST).then(|| Closure { constant, slope, from: (other - pivot) / frame, pivot })
            }
            Dyad::Slider { normal, .. } => {
                Some(Closure { constant: dot(normal, pivot - b) / rod, slope: arm / rod, from: normal, pivot })
            }
        }
    }

    /// Whether the crank does not reach β = 0, and β = π.
    fn limits(&self) -> [bool; 2] {
        [self.constant + self.slope > 1.0 + ROUNDING, self.constant - self.slope < -1.0 - ROUNDING]
    }

    fn is_full_turn(&self) -> bool {
        let [near, far] = [self.constant + self.slope, self.constant - self.slope];
        near.abs() <= 1.0 + ROUNDING && far.abs() <= 1.0 + ROUNDING
    }

    /// The angle of the crank, where it has no limit at 0 from -π to π, and otherwise from 0 to 2π.
    fn angle(&self, pin: Complex) -> f64 {
        let z = (pin - self.pivot) * self.from.conj();
        let angle = trig::atan2(z.im, z.re);
        if self.limits() == [true, false] { angle.rem_euclid(TAU) } else { angle }
    }

    /// The greatest size of the cosine over a range of angles.
    fn worst(&self, [from, to]: [f64; 2]) -> f64 {
        let at = |angle: f64| (self.constant + self.slope * trig::cos(angle)).abs();
        let [low, high] = [from.min(to), from.max(to)];
        let extremes = ((low / PI).ceil() as i64..=(high / PI).floor() as i64).take(3);
        let within = extremes.map(|k| (self.constant + if k % 2 == 0 { self.slope } else { -self.slope }).abs());
        within.fold(at(from).max(at(to)), f64::max).min(1.0)
    }
}

/// The sign of the branch at each pose: of a pose at a limit, 0.
fn sides<'a>(crank: &'a PosedDyad, follower: &'a PosedDyad) -> impl Iterator<Item = f64> + 'a {
    /// The sine of a transmission angle at a limit.
    const AT_LIMIT: f64 = 1e-9;
    crank.pins.iter().zip(&follower.pins).map(|(a, b)| {
        let rod = b - a;
        let across = match follower.dyad {
            Dyad::Revolute { pivot, .. } => times_i(pivot - a),
            Dyad::Slider { normal, .. } => times_i(normal),
        };
        let side = dot(across, rod);
        if side.abs() <= AT_LIMIT * length(across) * length(rod) { 0.0 } else { side.signum() }
    })
}

/// The greatest distance of two joints of a link.
pub(super) fn longest_link(crank: &PosedDyad, follower: &PosedDyad) -> f64 {
    let frame = match [&crank.dyad, &follower.dyad] {
        [Dyad::Revolute { pivot: a, .. }, Dyad::Revolute { pivot: b, .. }] => length(a - b),
        _ => 0.0,
    };
    crank.reach.max(follower.reach).max(length(crank.pins[0] - follower.pins[0])).max(frame)
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
    let at_poses = || angles.iter().map(|angle| closure.worst([*angle; 2])).fold(0.0, f64::max);
    if is_divided || changes_side {
        return match wish.any_circuit {
            true => Ok(Passing { worst_cosine: at_poses() }),
            false if is_divided || is_full_turn => Err(Misfit::Circuits),
            false => Err(Misfit::Branches),
        };
    }
    match ordered_range(&angles, is_full_turn) {
        Some(range) => Ok(Passing { worst_cosine: closure.worst(range) }),
        None if wish.any_order => {
            let range = angles.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(*x), b.max(*x)]);
            Ok(Passing { worst_cosine: closure.worst(if is_full_turn { [0.0, TAU] } else { range }) })
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

//! The circles on which gears roll.

use crate::linkage::{JointId, JointKind, Linkage};
use crate::motion::Circuit;

/// The pitch circle of a gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PitchCircle {
    /// The joint at its centre.
    pub centre: JointId,
    /// The pin of the crank that it turns with.
    pub pin: JointId,
    /// Its radius.
    pub radius: f64,
}

/// The pitch circle of an idler, in the gap between two gears that turn in the same direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Idler {
    /// The pin of the crank of the gear that is not that of the first crank.
    pub pin: JointId,
    /// The pivots of the first crank and of the other.
    pub pivots: [JointId; 2],
    /// How far its centre is from the first pivot towards the second.
    pub distance: f64,
    /// Its radius.
    pub radius: f64,
}

/// The idlers of gears.
pub fn idlers(linkage: &Linkage, circuit: &Circuit) -> Vec<Idler> {
    let circles = pitch_circles(linkage, circuit);
    let idler = |[own, first]: [&PitchCircle; 2]| {
        let is_needed = matches!(linkage.joints[own.pin].kind, JointKind::Gear { ratio: [turns, _], .. } if turns > 0);
        let pivots = [first.centre, own.centre];
        let [from, to] = pivots.map(|pivot| circuit.positions.point(pivot, 0));
        let radius = ((to - from).norm() - first.radius - own.radius) / 2.0;
        is_needed.then_some(Idler { pin: own.pin, pivots, distance: first.radius + radius, radius })
    };
    circles.iter().zip(circles.iter().skip(1)).filter_map(|(own, first)| idler([own, first])).collect()
}

/// The pitch circles of gears, each followed by that of the first crank, centred on the pivots of both cranks, and of the pinions of racks. Gears that turn in the same direction mesh over an
/// idler, for which there is a gap between them.
pub fn pitch_circles(linkage: &Linkage, circuit: &Circuit) -> Vec<PitchCircle> {
    let Some([first, crank_pin]) = linkage.crank() else { return Vec::new() };
    let mut circles = Vec::new();
    for (pin, joint) in linkage.joint_ids().zip(&linkage.joints) {
        match joint.kind {
            JointKind::Gear { pivot, ratio: [turns, crank_turns], .. } => {
                let distance = (circuit.positions.point(pivot, 0) - circuit.positions.point(first, 0)).norm();
                let filled_part = if turns < 0 { 1.0 } else { 0.8 };
                // The slower gear is the larger one.
                let [own, other] = [crank_turns.abs() as f64, turns.abs() as f64]
                    .map(|n| filled_part * distance * n / (turns.abs() + crank_turns.abs()) as f64);
                circles.push(PitchCircle { centre: pivot, pin, radius: own });
                circles.push(PitchCircle { centre: first, pin: crank_pin, radius: other });
            }
            JointKind::Rack { radius, .. } => {
                circles.push(PitchCircle { centre: first, pin: crank_pin, radius: radius.abs() });
            }
            _ => {}
        }
    }
    circles
}

//! The curves of parameter sets of a space.

use super::circuit::Traced;
use super::poses::Places;
use super::space::LinkageSpace;
use crate::complex::Complex;
use coupler_curves::linkage::{CircuitSelection, JointId};
use coupler_curves::motion::find_circuits;

/// A space whose curves are sampled.
pub(super) struct SampledSpace {
    pub space: LinkageSpace,
    /// Whether the input must turn fully.
    pub full_turn: bool,
    /// The places of a turn, if the input must turn fully and, where it does, it has no change points and the circuit is the only one.
    turn: Option<Turn>,
}

/// The places of a turn at which its curve is sampled, and some of them.
struct Turn {
    /// Its length in degrees.
    period: f64,
    few: Places,
    all: Places,
}

/// A traced joint on a circuit of a parameter set.
pub(super) struct OnCircuit {
    /// The number of the joint, from 0.
    pub trace: usize,
    /// The number of the circuit, from 0.
    pub circuit: usize,
    pub traced: Traced,
}

/// The points of a curve of which the shape is computed.
const POINTS: usize = 128;

impl SampledSpace {
    pub fn new(space: &LinkageSpace, full_turn: bool) -> SampledSpace {
        let mut sampled = SampledSpace { space: space.clone(), full_turn, turn: None };
        sampled.turn = sampled.simple_turn();
        sampled
    }

    /// The places of a turn, if the first samples whose input turns fully have no change points.
    fn simple_turn(&self) -> Option<Turn> {
        /// So few that it takes next to no time to see that most linkages that do not turn do not.
        const FEW: usize = 8;
        /// The samples that turn, and those among which they are sought.
        const ENOUGH: usize = 16;
        const MOST: usize = 200;
        let template = self.space.template();
        let is_group = self.space.is_group();
        if !self.full_turn || template.circuits != CircuitSelection::Start || template.input.is_some() {
            return None;
        }
        let turning = |sample| {
            let values = self.space.sample(sample)?;
            if is_group {
                // It has no change points where Newton's method follows it all around.
                let linkage = template.linkage(&values).ok()?;
                let joint = *linkage.traced.first()?;
                return Traced::on_full_turn(linkage, joint);
            }
            Some(self.traced(&values).into_iter().next()?.traced)
        };
        let enough = if is_group { 1 } else { ENOUGH };
        let turning: Vec<Traced> = (0..MOST).filter_map(turning).take(enough).collect();
        let first = turning.first().filter(|_| turning.iter().all(Traced::has_fixed_passes))?;
        let [few, all] = [FEW, POINTS].map(|count| first.places(&first.positions(count)));
        Some(Turn { period: first.linkage.input().period(), few, all })
    }

    /// The default number of parameter sets: for few parameters fewer fill their ranges, and those of linkages that take long or trace many
    /// joints are fewer.
    pub fn default_count(&self) -> usize {
        const MOST: usize = 10_000;
        const LEAST: usize = 500;
        /// Of many traced joints together.
        const MOST_CURVES: usize = 200_000;
        /// For so many dyads more all circuits take as many times as long as there are modes.
        const MODES: u32 = 4;
        let template = self.space.template();
        let dimension = self.space.dimension() - usize::from(self.space.is_scalable && self.space.dimension() > 1);
        let samples = if self.is_slow() {
            let dyads = template.structure().map_or(0, |linkage| linkage.dyad_count()) as u32;
            let modes = if template.circuits == CircuitSelection::All { dyads.saturating_sub(2).min(MODES) } else { 0 };
            (10 * dimension.pow(3)).clamp(LEAST, MOST).div_ceil(2 << modes)
        } else {
            (250 * dimension.pow(2)).clamp(LEAST, MOST)
        };
        samples.min((MOST_CURVES / template.curve_count().max(1)).max(1))
    }

    /// Whether it takes long to find the circuits: limits of a chain of dyads are searched for.
    pub fn is_slow(&self) -> bool {
        let dyads = self.space.template().structure().map_or(0, |linkage| linkage.dyad_count());
        self.turn.is_none() && dyads > 1
    }

    /// The traced joints on the circuits of a parameter set.
    pub fn traced(&self, values: &[f64]) -> Vec<OnCircuit> {
        let Ok(linkage) = self.space.template().linkage(values) else { return Vec::new() };
        let circuits = find_circuits(&linkage).circuits;
        let mut found = Vec::new();
        for (trace, joint) in self.compared(&linkage.traced) {
            for (number, circuit) in circuits.iter().enumerate() {
                let traced = Traced { linkage: linkage.clone(), circuit: circuit.clone(), joint };
                if !self.full_turn || traced.is_full_turn() {
                    found.push(OnCircuit { trace, circuit: number, traced });
                }
            }
        }
        found
    }

    /// The same with points all around. Where a turn is simple, it is not certain that the linkage turns between them.
    pub fn curves(&self, values: &[f64]) -> Vec<(OnCircuit, Option<Vec<Complex>>)> {
        match &self.turn {
            Some(turn) => self.curves_of_turn(values, turn).unwrap_or_default(),
            None => {
                let with_points = |on: OnCircuit| {
                    let points = on.traced.points(&on.traced.positions(POINTS));
                    (on, points)
                };
                self.traced(values).into_iter().map(with_points).collect()
            }
        }
    }

    fn curves_of_turn(&self, values: &[f64], turn: &Turn) -> Option<Vec<(OnCircuit, Option<Vec<Complex>>)>> {
        let linkage = self.space.template().linkage(values).ok()?;
        let joints = linkage.traced.clone();
        let traced = Traced::on_full_turn(linkage, *joints.first()?)?;
        let are_closed = |places| Some(traced.poses(places)).filter(|poses| poses.are_closed(&traced.linkage));
        if traced.linkage.input().period() != turn.period {
            return None;
        }
        are_closed(&turn.few)?;
        let poses = are_closed(&turn.all)?;
        let of_joint = |(trace, joint)| {
            let on = OnCircuit { trace, circuit: 0, traced: Traced { joint, ..traced.clone() } };
            (on, poses.points(joint))
        };
        Some(self.compared(&joints).map(of_joint).collect())
    }

    /// The traced joints whose curves are compared, with their numbers, from 0.
    fn compared(&self, joints: &[JointId]) -> impl Iterator<Item = (usize, JointId)> {
        let is_compared = |(number, _): &(usize, JointId)| self.space.trace.is_none_or(|trace| trace == *number);
        joints.iter().copied().enumerate().filter(is_compared)
    }
}

//! The curve of a traced joint on a circuit, by a coordinate in which it is regular at limits of the input.

use super::poses::{PassPlaces, Places, Poses};
use crate::complex::Complex;
use coupler_curves::linkage::{CircuitSelection, Input, JointId, Linkage};
use coupler_curves::motion::{
    InputColumns, InputPosition, Pass, PassEnd, UnsampledCircuit, eased_fraction, eased_input, find_circuits,
    follow_full_turn, poses_in_columns,
};

/// A traced joint of a linkage on one of its circuits.
///
/// A position on it is the number of a pass plus a fraction of it, which is eased at limits ([`eased_input`]), and may be of any
/// round. Along an open circuit the curve goes there and back, so that every curve is closed.
#[derive(Clone, Debug)]
pub(super) struct Traced {
    pub linkage: Linkage,
    pub circuit: UnsampledCircuit,
    pub joint: JointId,
}

impl Traced {
    /// A joint of a linkage whose input turns fully on the branch of its start, without limits or change points. Whether it does is not known: where
    /// it cannot be assembled, its links do not keep their lengths. It takes far less time than to find the circuits of a chain of dyads.
    pub fn on_full_turn(linkage: Linkage, joint: JointId) -> Option<Traced> {
        let end = |value| PassEnd::regular(InputPosition::from_degrees(value));
        let Input::Angle { .. } = linkage.input() else { return None };
        if linkage.group.is_some() {
            let circuit = follow_full_turn(&linkage)?;
            return Some(Traced { linkage, circuit, joint });
        }
        let mode = linkage.motion_options.mode.truncated(linkage.dyad_count());
        let pass = Pass { from: end(0.0), to: end(linkage.input().period()), mode, track: None };
        let circuit = UnsampledCircuit { passes: vec![pass], is_closed: true };
        Some(Traced { linkage, circuit, joint })
    }

    /// The number of positions of a round.
    pub fn period(&self) -> f64 {
        let passes = self.circuit.passes.len() as f64;
        if self.circuit.is_closed { passes } else { 2.0 * passes }
    }

    /// Whether the input turns fully: the circuit is closed and the input never reverses.
    pub fn is_full_turn(&self) -> bool {
        let passes = &self.circuit.passes;
        self.circuit.is_closed && passes.iter().all(|pass| pass.input_direction() == passes[0].input_direction())
    }

    /// Whether no dyad is flat on the circuit, so that it stays as it is when the linkage changes a little.
    pub fn is_regular(&self) -> bool {
        let passes = &self.circuit.passes;
        passes.iter().all(|pass| pass.from.flat_dyads.is_empty() && pass.to.flat_dyads.is_empty())
    }

    /// Whether the inputs of the passes do not depend on the dimensions as long as the linkage can be assembled at them.
    pub fn has_fixed_passes(&self) -> bool {
        let Linkage { motion_options, group, .. } = &self.linkage;
        // Of several circuits of a group it is not known which one Newton's method follows.
        let is_group_followed = || self.is_full_turn() && motion_options.circuits == CircuitSelection::Start;
        self.is_regular() && motion_options.range.is_none() && (group.is_none() || is_group_followed())
    }

    /// Whether the circuit of each linkage is followed by Newton's method, as that of a group that turns fully is. It is proven in the end only.
    pub fn is_followed(&self) -> bool {
        self.linkage.group.is_some() && self.has_fixed_passes()
    }

    /// Whether the passes of a circuit of the same linkage are these. Where they are followed, it has no other circuit.
    pub fn is_on(&self, passes: &[Pass]) -> bool {
        let own = &self.circuit.passes;
        let is_same = |(a, b): (&Pass, &Pass)| a.from == b.from && a.to == b.to && a.mode == b.mode;
        match self.is_followed() {
            true => own.len() == passes.len() && own.iter().zip(passes).all(is_same),
            false => own == passes,
        }
    }

    /// The same joint of another linkage of the same template on a circuit with the same passes, that nearest to this one. That a group turns fully
    /// is not proven.
    pub fn followed(&self, linkage: Linkage) -> Option<Traced> {
        if self.is_followed() {
            return Traced::on_full_turn(linkage, self.joint);
        }
        let own = &self.circuit;
        let is_alike = |other: &UnsampledCircuit| {
            own.is_closed == other.is_closed
                && own.passes.len() == other.passes.len()
                && own.passes.iter().zip(&other.passes).all(|(a, b)| {
                    a.mode == b.mode
                        && a.from.flat_dyads == b.from.flat_dyads
                        && a.to.flat_dyads == b.to.flat_dyads
                        && a.input_direction() == b.input_direction()
                })
        };
        let input = linkage.input();
        let period = input.period();
        let distance = |other: &UnsampledCircuit| -> f64 {
            let apart = |a: f64, b: f64| {
                let difference = (a - b).rem_euclid(period);
                if input == Input::Length { (a - b).abs() } else { difference.min(period - difference) }
            };
            let pairs = own.passes.iter().zip(&other.passes);
            pairs.map(|(a, b)| apart(a.from.input.value, b.from.input.value)).sum()
        };
        let found = find_circuits(&linkage).circuits.into_iter().filter(is_alike);
        let circuit = found.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        Some(Traced { linkage, circuit, joint: self.joint })
    }

    /// The same circuit, from which those of linkages that differ next to nothing are found sooner at some places.
    pub fn based_at(&self, places: &Places) -> Traced {
        let mut based = self.clone();
        for of in &places.of_passes {
            based.circuit.passes[of.pass] = self.circuit.passes[of.pass].based_at(&of.inputs);
        }
        based
    }

    /// The same joint of a linkage that differs next to nothing, at the same positions.
    pub fn perturbed(&self, linkage: Linkage) -> Option<Traced> {
        if !self.has_fixed_passes() {
            return self.followed(linkage);
        }
        let passes = self.circuit.passes.iter().map(|pass| pass.of_neighbour(&linkage)).collect::<Option<_>>()?;
        Some(Traced { circuit: UnsampledCircuit { passes, ..self.circuit }, linkage, joint: self.joint })
    }

    /// The same joint of a linkage that differs little, at the same positions: on a circuit without limits the same inputs, where it is
    /// not certain that it can be assembled at them.
    pub fn moved(&self, linkage: Linkage) -> Option<Traced> {
        match self.has_fixed_passes() && !self.is_followed() {
            true => Some(Traced { linkage, circuit: self.circuit.clone(), joint: self.joint }),
            false => self.followed(linkage),
        }
    }

    /// The pass of a position, and the fraction of it.
    fn place(&self, position: f64) -> (usize, f64) {
        let passes = self.circuit.passes.len();
        let period = self.period();
        let within = if (0.0..period).contains(&position) { position } else { position.rem_euclid(period) };
        let there = if within > passes as f64 { period - within } else { within };
        let pass = (there as usize).min(passes - 1);
        (pass, (there - pass as f64).clamp(0.0, 1.0))
    }

    /// The index of the pass of a position.
    pub fn pass_of(&self, position: f64) -> usize {
        self.place(position).0
    }

    /// The input at a position; on a full turn it goes on rising from round to round.
    pub fn input(&self, position: f64) -> f64 {
        let (pass, fraction) = self.place(position);
        let passes = &self.circuit.passes;
        let rounds = if self.is_full_turn() { (position / self.period()).floor() } else { 0.0 };
        let turn = passes[passes.len() - 1].to.input.value - passes[0].from.input.value;
        eased_input(&passes[pass], fraction) + rounds * turn
    }

    /// The position of an input of a pass, which on a full turn may be in any round.
    pub fn position_of_input(&self, pass: usize, input: f64) -> f64 {
        let Some(of) = self.circuit.passes.get(pass) else { return 0.0 };
        let fraction = (input - of.from.input.value) / (of.to.input.value - of.from.input.value);
        pass as f64 + if self.is_regular() { fraction } else { eased_fraction(of, input) }
    }

    /// Where some positions are on the passes.
    pub fn places(&self, positions: &[f64]) -> Places {
        let passes = self.circuit.passes.len();
        let (mut numbers, mut inputs) = (vec![Vec::new(); passes], vec![Vec::new(); passes]);
        for (number, position) in positions.iter().enumerate() {
            let (pass, fraction) = self.place(*position);
            numbers[pass].push(number);
            inputs[pass].push(eased_input(&self.circuit.passes[pass], fraction));
        }
        let input = self.linkage.input();
        let of_pass = |(pass, (numbers, inputs)): (usize, (Vec<usize>, Vec<f64>))| PassPlaces {
            pass,
            numbers,
            inputs: InputColumns::from_values(input, inputs),
        };
        let of_passes = numbers.into_iter().zip(inputs).enumerate().map(of_pass);
        Places { count: positions.len(), of_passes: of_passes.filter(|places| !places.numbers.is_empty()).collect() }
    }

    /// The places of inputs of a pass; `None` if one of them is beyond it. The pass of a full turn has all inputs.
    pub fn places_at_inputs(&self, pass: usize, inputs: &[f64]) -> Option<Places> {
        let [low, high] = self.circuit.passes.get(pass)?.input_range();
        let has_all = self.is_regular() && self.is_full_turn();
        if !has_all && inputs.iter().any(|input| *input < low || *input > high) {
            return None;
        }
        let columns = InputColumns::from_values(self.linkage.input(), inputs.iter().copied());
        let of_pass = PassPlaces { pass, numbers: (0..inputs.len()).collect(), inputs: columns };
        Some(Places { count: inputs.len(), of_passes: vec![of_pass] })
    }

    /// The poses at places, which are those of this circuit or of one with the same passes.
    pub fn poses<'a>(&self, places: &'a Places) -> Poses<'a> {
        let passes = &self.circuit.passes;
        let of_pass = |of: &PassPlaces| poses_in_columns(&self.linkage, &passes[of.pass], &of.inputs);
        Poses { places, of_passes: places.of_passes.iter().map(of_pass).collect() }
    }

    /// The points at places; `None` if one of them is not defined.
    pub fn points_at(&self, places: &Places) -> Option<Vec<Complex>> {
        self.poses(places).points(self.joint)
    }

    /// The points at some positions; `None` if one of them is not defined.
    pub fn points(&self, positions: &[f64]) -> Option<Vec<Complex>> {
        self.points_at(&self.places(positions))
    }

    /// Positions of a round in their order, about as many as asked for a turn, more for several turns.
    pub fn positions(&self, count: usize) -> Vec<f64> {
        /// The most turns for which there are more.
        const MOST_TURNS: f64 = 8.0;
        /// The least on a pass.
        const LEAST: usize = 8;
        let passes = &self.circuit.passes;
        let input: f64 = passes.iter().map(|pass| pass.input_length()).sum();
        let is_length = self.linkage.input() == Input::Length;
        let turns = if is_length { 1.0 } else { (input / 360.0).clamp(1.0, MOST_TURNS) };
        let intervals = |k: usize| {
            let part = passes[k].input_length() / input.max(f64::MIN_POSITIVE);
            ((part * count as f64 * turns).round() as usize).max(LEAST)
        };
        let on_pass = |k: usize| {
            let intervals = intervals(k);
            (0..intervals).map(move |n| k as f64 + n as f64 / intervals as f64)
        };
        let there: Vec<f64> = (0..passes.len()).flat_map(on_pass).collect();
        if self.circuit.is_closed {
            return there;
        }
        let period = self.period();
        let back: Vec<f64> = there.iter().skip(1).rev().map(|position| period - position).collect();
        there.into_iter().chain([passes.len() as f64]).chain(back).collect()
    }
}

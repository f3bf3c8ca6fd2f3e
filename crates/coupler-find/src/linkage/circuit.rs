//! The curve of a traced joint on a circuit, by a coordinate in which it is regular at limits of the input.

use crate::complex::Complex;
use coupler_curves::linkage::{Input, JointId, Linkage};
use coupler_curves::motion::{
    InputPosition, Pass, PassEnd, UnsampledCircuit, eased_fraction, eased_input, find_circuits, poses,
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
    /// A joint of a linkage whose input turns fully on the branch of its start, without limits or change points, as far as its links keep
    /// their lengths at some inputs. `None` otherwise. It takes far less time than to find the circuits of a chain of dyads.
    pub fn on_full_turn(linkage: &Linkage, joint: JointId) -> Option<Traced> {
        /// The inputs of a turn.
        const CHECKED: usize = 64;
        let end = |value| PassEnd::regular(InputPosition::from_degrees(value));
        let Input::Angle { .. } = linkage.input() else { return None };
        let mode = linkage.motion_options.mode.truncated(linkage.dyad_count());
        let pass = Pass { from: end(0.0), to: end(linkage.input().period()), mode };
        let circuit = UnsampledCircuit { passes: vec![pass], is_closed: true };
        let traced = Traced { linkage: linkage.clone(), circuit, joint };
        traced.is_closed_at(&traced.positions(CHECKED)).then_some(traced)
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

    /// Whether the passes do not depend on the dimensions as long as the linkage can be assembled on them.
    pub fn has_fixed_passes(&self) -> bool {
        self.is_regular() && self.linkage.motion_options.range.is_none()
    }

    /// The same joint of another linkage of the same template on a circuit with the same passes, that nearest to this one.
    pub fn followed(&self, linkage: Linkage) -> Option<Traced> {
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

    /// The same joint of a linkage that differs little, at the same positions: on a circuit without limits the same inputs, where it is
    /// not certain that it can be assembled at them.
    pub fn perturbed(&self, linkage: Linkage) -> Option<Traced> {
        match self.has_fixed_passes() {
            true => Some(Traced { linkage, circuit: self.circuit.clone(), joint: self.joint }),
            false => self.followed(linkage),
        }
    }

    /// The pass of a position, and the fraction of it.
    fn place(&self, position: f64) -> (usize, f64) {
        let passes = self.circuit.passes.len();
        let period = self.period();
        let within = position.rem_euclid(period);
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

    /// Whether the linkage keeps the lengths of its links at positions of a round: where it cannot be assembled, its joints are placed
    /// otherwise. A circuit on which no dyad is flat has the same passes then, up to what is between the positions.
    pub fn is_closed_at(&self, positions: &[f64]) -> bool {
        /// Relative to the length of a link.
        const ROUNDING: f64 = 1e-9;
        self.circuit.passes.iter().enumerate().all(|(k, pass)| {
            let inputs: Vec<f64> = positions
                .iter()
                .map(|position| self.place(*position))
                .filter(|(pass, _)| *pass == k)
                .map(|(_, fraction)| eased_input(pass, fraction))
                .collect();
            let placed = poses(&self.linkage, pass, &inputs);
            self.linkage.links.iter().all(|link| {
                let Some((first, from)) = link.joints.first() else { return true };
                link.joints[1..].iter().all(|(joint, to)| {
                    let own = (to - from).norm();
                    let is_kept = |n: usize| {
                        let distance = (placed.point(*joint, n) - placed.point(*first, n)).norm();
                        (distance - own).abs() <= ROUNDING * own.max(distance)
                    };
                    (0..inputs.len()).all(is_kept)
                })
            })
        })
    }

    /// The points at some positions; `None` if one of them is not defined.
    pub fn points(&self, positions: &[f64]) -> Option<Vec<Complex>> {
        let mut points = vec![Complex::new(f64::NAN, f64::NAN); positions.len()];
        let (mut on_pass, mut inputs) = (Vec::with_capacity(positions.len()), Vec::with_capacity(positions.len()));
        for (k, pass) in self.circuit.passes.iter().enumerate() {
            on_pass.clear();
            inputs.clear();
            for (n, position) in positions.iter().enumerate() {
                let (pass_of, fraction) = self.place(*position);
                if pass_of == k {
                    on_pass.push(n);
                    inputs.push(eased_input(pass, fraction));
                }
            }
            if on_pass.is_empty() {
                continue;
            }
            let placed = poses(&self.linkage, pass, &inputs);
            for (place, n) in on_pass.iter().enumerate() {
                let point = placed.point(self.joint, place);
                points[*n] = Complex::new(point.x, point.y);
            }
        }
        points.iter().all(|z| z.re.is_finite() && z.im.is_finite()).then_some(points)
    }

    /// The points at inputs of a pass; `None` if one of them is beyond it or not defined. The pass of a full turn has all inputs.
    pub fn points_at_inputs(&self, pass: usize, inputs: &[f64]) -> Option<Vec<Complex>> {
        let pass = self.circuit.passes.get(pass)?;
        let [low, high] = pass.input_range();
        let has_all = self.is_regular() && self.is_full_turn();
        if !has_all && inputs.iter().any(|input| *input < low || *input > high) {
            return None;
        }
        let placed = poses(&self.linkage, pass, inputs);
        let points: Vec<Complex> = (0..inputs.len())
            .map(|k| placed.point(self.joint, k))
            .map(|point| Complex::new(point.x, point.y))
            .collect();
        points.iter().all(|z| z.re.is_finite() && z.im.is_finite()).then_some(points)
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

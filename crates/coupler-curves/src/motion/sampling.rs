//! Sampling of circuits: by a step of the input, by a number of samples, or evenly along a path.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use super::AssemblyError;
use super::circuit::UnsampledCircuit;
use super::derivatives::JointDerivatives;
use super::input_columns::InputColumns;
use super::limits::MAX_SAMPLES;
use super::pass::{InputPosition, Pass, PassEnd};
use super::pass_ends::place_at_end;
use super::pass_positions::place_on_pass;
use super::pieces::CircuitPieces;
use super::positions::{JointPositions, convert_to_view_frame};
use super::spacing::{self, CumulativeLength};
use crate::geometry::Point;
use crate::linkage::{AssemblyMode, Input, JointId, LinkOutline, Linkage};

/// How a circuit is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sampling {
    /// At all whole multiples of a step, in degrees or in units of length, and at the ends of the passes.
    Step(f64),
    /// A number of samples in the whole circuit, evenly spaced in the input on each pass.
    Samples(usize),
    /// A number of samples, denser towards the limits.
    DenseAtLimits(usize),
    /// A number of samples, evenly spaced along the path of the first traced joint, to a part in ten thousand.
    ArcLength(usize),
}

/// Samples circuits. Contains the sines and cosines of a full turn, computed once for all linkages that it samples; its clones share
/// them.
#[derive(Clone, Debug)]
pub struct Sampler {
    sampling: Sampling,
    /// The samples of a full turn.
    full_turn: Arc<[InputPosition]>,
}

/// A sampled circuit.
#[derive(Clone, Debug)]
pub struct Circuit {
    /// Whether it ends where it begins.
    pub is_closed: bool,
    /// Its passes, in order.
    pub passes: Vec<Pass>,
    /// The input of each sample: degrees, continuous and never wrapped, or lengths.
    pub inputs: Vec<f64>,
    /// The positions of all joints at each sample, in the frame the linkage is seen from.
    pub positions: JointPositions,
    /// The index of the pass of each sample; at the end of a pass, the pass that ends there.
    sample_passes: Vec<usize>,
    /// The circuit in pieces; computed on first use.
    pub(super) pieces: OnceLock<Box<CircuitPieces>>,
}

impl Circuit {
    /// The number of samples.
    pub fn len(&self) -> usize {
        self.inputs.len()
    }

    /// Whether there are no samples.
    pub fn is_empty(&self) -> bool {
        self.inputs.is_empty()
    }

    /// Whether two joints are in one place all the time: one pin has both.
    pub fn coincide(&self, a: JointId, b: JointId) -> bool {
        /// The rounding of positions, relative to their coordinates.
        const ROUNDING: f64 = 1e-9;
        (0..self.len()).all(|sample| {
            let (a, b) = (self.positions.point(a, sample), self.positions.point(b, sample));
            (a - b).norm() <= ROUNDING * (a.coords.norm() + b.coords.norm())
        })
    }

    /// The joints of a linkage that only serve to place others, as of [`Linkage::is_helper`], and are in no pin of another joint.
    pub fn helpers(&self, linkage: &Linkage) -> Vec<JointId> {
        self.in_no_other_pin(linkage, |joint| linkage.is_helper(joint))
    }

    /// The joints of a linkage that are mere points, as of [`Linkage::is_mere_point`], and are in no pin of another joint.
    pub fn mere_points(&self, linkage: &Linkage) -> Vec<JointId> {
        self.in_no_other_pin(linkage, |joint| linkage.is_mere_point(joint))
    }

    /// The joints of a kind that are never where one of another kind is.
    fn in_no_other_pin(&self, linkage: &Linkage, is_of_kind: impl Fn(JointId) -> bool) -> Vec<JointId> {
        let (of_kind, others): (Vec<_>, Vec<_>) = linkage.joint_ids().partition(|&joint| is_of_kind(joint));
        of_kind.into_iter().filter(|&joint| !others.iter().any(|&other| self.coincide(joint, other))).collect()
    }

    /// The outlines of the moving links, as of [`Linkage::link_outlines`], through their joints without helpers.
    pub fn link_outlines(&self, linkage: &Linkage) -> Vec<LinkOutline> {
        let helpers = self.helpers(linkage);
        let mut outlines = linkage.link_outlines();
        outlines.iter_mut().for_each(|outline| outline.joints.retain(|joint| !helpers.contains(joint)));
        outlines.retain(|outline| outline.joints.len() > 1);
        outlines
    }

    /// The input at the sample in which the joints are in a pose, if there is one.
    pub fn input_of_pose(&self, pose: &[Point]) -> Option<f64> {
        let is_pose =
            |sample: &usize| (0..).zip(pose).all(|(k, at)| self.positions.point(JointId::new(k), *sample) == *at);
        (0..self.len()).find(is_pose).map(|sample| self.inputs[sample])
    }

    /// The assembly mode at a sample; at the end of a pass, that of the pass that ends there.
    pub fn mode_at(&self, sample: usize) -> AssemblyMode {
        self.passes[self.sample_passes[sample]].mode
    }

    /// The index of the pass of a sample; at the end of a pass, the pass that ends there.
    pub fn pass_at(&self, sample: usize) -> usize {
        self.sample_passes[sample]
    }

    /// The input to which it continues after its last sample: on a full turn the whole turn, otherwise the input of the
    /// first sample; `None` unless it is closed.
    pub fn input_after_last(&self) -> Option<f64> {
        self.passes.last().filter(|_| self.is_closed).map(|pass| pass.to.input.value)
    }

    /// Whether the input turns fully: the circuit is closed and the input never reverses, also through change points.
    /// The length of an actuator never turns.
    pub fn is_full_turn(&self) -> bool {
        self.is_closed && self.limit_count() == 0
    }

    /// The number of limit positions: where the input reverses, because it can go no further.
    pub fn limit_count(&self) -> usize {
        (0..self.passes.len()).filter(|&pass| self.reverses_after(pass)).count()
    }

    /// Whether the input reverses at the end of a pass, because a dyad is flat there.
    pub fn reverses_after(&self, pass: usize) -> bool {
        let last = pass + 1 == self.passes.len();
        let next = &self.passes[(pass + 1) % self.passes.len()];
        (!last || self.is_closed) && self.passes[pass].input_direction() != next.input_direction()
    }

    /// Whether paths may have a corner at a sample: at a change point where the motion continues in the same assembly
    /// mode.
    pub fn is_corner(&self, sample: usize) -> bool {
        let k = self.sample_passes[sample];
        let (pass, next) = (&self.passes[k], &self.passes[(k + 1) % self.passes.len()]);
        let is_end = self.inputs[sample] == pass.to.input.value || (sample == 0 && self.is_closed);
        // Continuity decides the sides of dyads whose bases vanish, at a corner or not.
        let PassEnd { flat_dyads: flat, vanishing_dyads: vanishing, .. } = pass.to;
        let keep_sides = pass.mode.is_same_apart_from(vanishing, next.mode);
        is_end && !flat.without(vanishing).is_empty() && !self.reverses_after(k) && keep_sides
    }

    /// The positions and derivatives of all joints at a sample.
    pub fn derivatives(&self, linkage: &Linkage, sample: usize) -> JointDerivatives {
        let pass = &self.passes[self.sample_passes[sample]];
        // A closed circuit begins where its last pass ends, apart from whole turns.
        let begins_at_an_end = sample == 0 && self.is_closed && !pass.to.flat_dyads.is_empty();
        JointDerivatives::on_pass(
            linkage,
            pass,
            if begins_at_an_end { pass.to.input.value } else { self.inputs[sample] },
        )
    }

    /// A joint's positions, sample by sample.
    pub fn points(&self, joint: JointId) -> impl Iterator<Item = Point> {
        self.positions.x(joint).iter().zip(self.positions.y(joint)).map(|(&x, &y)| Point::new(x, y))
    }
}

impl Sampler {
    /// Creates a sampler.
    ///
    /// # Panics
    /// If a step is not positive or the number of samples is greater than [`MAX_SAMPLES`].
    pub fn new(sampling: Sampling) -> Sampler {
        let turn = match sampling {
            Sampling::Step(step) => {
                assert!(step > 0.0, "a step of {step}");
                // The step may be that of an actuator's length and very short; the table is not used then.
                multiples(step, 0.0, 360.0).take(MAX_SAMPLES).map(InputPosition::from_degrees).collect()
            }
            Sampling::Samples(n) | Sampling::DenseAtLimits(n) | Sampling::ArcLength(n) => {
                assert!(n <= MAX_SAMPLES, "{n} samples");
                (0..n).map(|i| InputPosition::from_degrees(360.0 * i as f64 / n as f64)).collect()
            }
        };
        Sampler { sampling, full_turn: turn }
    }

    /// The samples of a full turn from input 0: the table of sines and cosines.
    pub fn full_turn(&self) -> &[InputPosition] {
        &self.full_turn
    }

    /// The error to report if the step is too short for a circuit.
    pub(super) fn excess_error(&self, circuit: &UnsampledCircuit) -> Option<AssemblyError> {
        let Sampling::Step(step) = self.sampling else { return None };
        // A full turn may have `MAX_SAMPLES` samples, and one more by rounding.
        let is_long = |pass: &Pass| pass.input_length() / step > MAX_SAMPLES as f64 + 1.0;
        circuit.passes.iter().any(is_long).then_some(AssemblyError::TooManySamples { step })
    }

    /// The number of samples of a circuit, or a few more.
    pub(super) fn sample_count(&self, circuit: &UnsampledCircuit) -> usize {
        match self.sampling {
            Sampling::Step(step) => circuit.passes.iter().map(|pass| (pass.input_length() / step) as usize + 2).sum(),
            Sampling::Samples(n) | Sampling::DenseAtLimits(n) | Sampling::ArcLength(n) => {
                n.max(circuit.passes.len() + 1)
            }
        }
    }

    /// Samples a circuit of a linkage.
    pub fn sample_circuit(&self, linkage: &Linkage, circuit: UnsampledCircuit) -> Circuit {
        let mut plan = self.plan_samples(&circuit, linkage);
        let mut positions = JointPositions::new(linkage.joints.len(), plan.inputs.len());
        let inputs = InputColumns::new(&plan.inputs);
        for (range, pass) in plan.pass_ranges.iter().zip(&circuit.passes) {
            place_on_pass(linkage, pass, inputs.slice(range.clone()), &mut positions, range.clone());
        }
        for &(sample, pass, is_first) in &plan.pass_ends {
            place_at_end(linkage, &circuit.passes[pass], is_first, &mut positions, sample);
            plan.sample_passes[sample] = pass;
        }
        convert_to_view_frame(linkage, &mut positions);
        let input = plan.inputs.iter().map(|position| position.value).collect();
        Circuit {
            is_closed: circuit.is_closed,
            passes: circuit.passes,
            inputs: input,
            positions,
            sample_passes: plan.sample_passes,
            pieces: OnceLock::new(),
        }
    }

    /// The inputs of a circuit's samples: the start, which in a closed circuit is the end of its last pass, then pass
    /// after pass, each including its end.
    fn plan_samples(&self, circuit: &UnsampledCircuit, linkage: &Linkage) -> SamplePlan {
        let input = linkage.input();
        let mut plan = SamplePlan::default();
        if let [pass] = &circuit.passes[..]
            && circuit.is_closed
            && pass.from.flat_dyads.is_empty()
            && pass.input_length() == input.period()
            && !matches!(self.sampling, Sampling::ArcLength(_))
        {
            // A full turn in one assembly mode: the table, repeated for every further turn.
            plan.inputs = self.full_period(input);
            plan.sample_passes = vec![0; plan.inputs.len()];
            plan.pass_ranges.push(0..plan.inputs.len());
            return plan;
        }
        let last = circuit.passes.len() - 1;
        plan.pass_ends.push(if circuit.is_closed { (0, last, false) } else { (0, 0, true) });
        plan.inputs.push(circuit.passes[0].from.input);
        plan.sample_passes.push(0);
        let lengths = self.cumulative_lengths(circuit, linkage);
        let intervals = self.interval_counts(circuit, &lengths);
        for (k, pass) in circuit.passes.iter().enumerate() {
            let begin = plan.inputs.len();
            self.push_inner_samples(pass, intervals[k], input, lengths.get(k), &mut plan.inputs);
            if k < last || !circuit.is_closed {
                plan.pass_ends.push((plan.inputs.len(), k, false));
                plan.inputs.push(pass.to.input);
            }
            plan.pass_ranges.push(begin..plan.inputs.len());
            plan.sample_passes.resize(plan.inputs.len(), k);
        }
        plan
    }

    /// The samples strictly inside a pass.
    fn push_inner_samples(
        &self,
        pass: &Pass,
        intervals: usize,
        input: Input,
        cumulative_length: Option<&CumulativeLength>,
        out: &mut Vec<InputPosition>,
    ) {
        let (from, to) = (pass.from.input.value, pass.to.input.value);
        let shares = (1..intervals).map(|i| i as f64 / intervals as f64);
        match self.sampling {
            Sampling::DenseAtLimits(_) | Sampling::ArcLength(_) => out.extend(shares.map(|share| {
                InputPosition::new(
                    input,
                    spacing::eased_input(
                        pass,
                        cumulative_length.map_or(share, |cumulative_length| cumulative_length.pass_fraction(share)),
                    ),
                )
            })),
            Sampling::Samples(_) => out.extend(shares.map(|t| {
                // From the lower end in both directions, so that a forward and a backward pass have the same samples.
                InputPosition::new(input, if from < to { from + (to - from) * t } else { to + (from - to) * (1.0 - t) })
            })),
            Sampling::Step(step) => {
                let begin = out.len();
                let is_inside = |value: &f64| (value - from).abs() > 1e-9 * step && (value - to).abs() > 1e-9 * step;
                let inside = multiples(step, from.min(to), from.max(to)).filter(is_inside).take(MAX_SAMPLES);
                out.extend(inside.map(|value| self.input_at_multiple(input, value, step)));
                if from > to {
                    out[begin..].reverse();
                }
            }
        }
    }

    /// The input at a multiple of the step, from the table where the step divides the turn.
    fn input_at_multiple(&self, input: Input, value: f64, step: f64) -> InputPosition {
        let n = self.full_turn.len();
        if n as f64 * step == 360.0 && input != Input::Length {
            let index = ((value / step).round() as i64).rem_euclid(n as i64) as usize;
            return InputPosition { value, ..self.full_turn[index] };
        }
        InputPosition::new(input, value)
    }

    /// The samples of a full period from input 0.
    fn full_period(&self, input: Input) -> Vec<InputPosition> {
        let period = input.period();
        match self.sampling {
            _ if period == 360.0 => self.full_turn.to_vec(),
            Sampling::Step(step) => {
                multiples(step, 0.0, period).map(|value| self.input_at_multiple(input, value, step)).collect()
            }
            Sampling::Samples(n) | Sampling::DenseAtLimits(n) | Sampling::ArcLength(n) => {
                (0..n).map(|i| InputPosition::from_degrees(period * i as f64 / n as f64)).collect()
            }
        }
    }

    /// The cumulative lengths of the first traced joint's path on each pass, for samples evenly spaced along it; empty
    /// if they are not needed.
    fn cumulative_lengths(&self, circuit: &UnsampledCircuit, linkage: &Linkage) -> Vec<CumulativeLength> {
        match (self.sampling, linkage.traced.first()) {
            (Sampling::ArcLength(_), Some(&joint)) => {
                let lengths: Vec<CumulativeLength> =
                    circuit.passes.iter().map(|pass| CumulativeLength::measure(linkage, pass, joint)).collect();
                // If the joint does not move on a pass, samples are evenly spaced in the input instead.
                if lengths.iter().all(|length| length.total() > 0.0) { lengths } else { Vec::new() }
            }
            _ => Vec::new(),
        }
    }

    /// The number of intervals of each pass: in proportion to its length, at least one, by the largest remainders.
    fn interval_counts(&self, circuit: &UnsampledCircuit, lengths: &[CumulativeLength]) -> Vec<usize> {
        let samples = match self.sampling {
            Sampling::Step(_) => return vec![0; circuit.passes.len()],
            Sampling::Samples(n) | Sampling::DenseAtLimits(n) | Sampling::ArcLength(n) => n,
        };
        let intervals = if circuit.is_closed { samples } else { samples.saturating_sub(1) };
        let length = |k: usize| lengths.get(k).map_or(circuit.passes[k].input_length(), CumulativeLength::total);
        let total: f64 = (0..circuit.passes.len()).map(length).sum();
        let exact: Vec<f64> = (0..circuit.passes.len()).map(|k| intervals as f64 * length(k) / total).collect();
        // A share that is a rounding error below a whole number is rounded up to it.
        let mut shares: Vec<usize> = exact.iter().map(|e| ((e + 1e-9).floor() as usize).max(1)).collect();
        let mut order: Vec<usize> = (0..shares.len()).collect();
        order.sort_by(|&a, &b| (exact[b] - shares[b] as f64).total_cmp(&(exact[a] - shares[a] as f64)));
        for k in order.into_iter().cycle() {
            if shares.iter().sum::<usize>() >= intervals {
                break;
            }
            shares[k] += 1;
        }
        shares
    }
}

/// The inputs of a circuit's samples and the passes they are on.
#[derive(Default)]
struct SamplePlan {
    inputs: Vec<InputPosition>,
    /// The pass of each sample.
    sample_passes: Vec<usize>,
    /// The samples of each pass.
    pass_ranges: Vec<Range<usize>>,
    /// The samples at the ends of passes: sample, pass, and whether the pass begins there.
    pass_ends: Vec<(usize, usize, bool)>,
}

/// The whole multiples of `step` in `[from, to)`, rounded as decimals: the third multiple of 0.1 is 0.3.
fn multiples(step: f64, from: f64, to: f64) -> impl Iterator<Item = f64> {
    // If the step is a decimal of up to nine places, the multiple is a single division and so correctly rounded.
    let whole = (0..=9).map(|d| 10u64.pow(d) as f64).find_map(|scale| {
        let units = (step * scale).round();
        (units / scale == step).then_some((units, scale))
    });
    let multiple = move |k: f64| match whole {
        Some((units, scale)) => k * units / scale,
        None => k * step,
    };
    let first = (from / step).ceil() as i64;
    (first..).map(move |k| multiple(k as f64)).skip_while(move |at| *at < from).take_while(move |at| *at < to)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multiples_of_a_decimal_step_are_correctly_rounded() {
        let multiples_between = |step, from, to| multiples(step, from, to).collect::<Vec<f64>>();
        assert_eq!(multiples_between(0.1, 0.0, 0.45), [0.0, 0.1, 0.2, 0.3, 0.4]);
        assert_eq!(multiples_between(2.0, -3.0, 3.0), [-2.0, 0.0, 2.0]);
        assert_eq!(multiples_between(360.0 / 7.0, 0.0, 360.0).len(), 7);
        assert_eq!(multiples_between(2.0, 0.0, 360.0).len(), 180);
        assert_eq!(multiples_between(0.1, 0.0, 360.0).len(), 3600);
    }
}

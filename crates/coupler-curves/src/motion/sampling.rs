use std::ops::Range;
use std::sync::OnceLock;

use super::circuit::{InputPosition, Pass, UnsampledCircuit};
use super::derivatives::JointDerivatives;
use super::pass_ends::place_at_end;
use super::positions::{DyadSigns, InputColumns, JointPositions, convert_to_view_frame, place_leading_joints};
use super::spacing::{self, CumulativeLength};
use crate::geometry::Point;
use crate::linkage::{AssemblyMode, DyadSet, Input, JointId, Linkage};

/// How densely a circuit is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sampling {
    /// Every whole multiple of a step, in degrees or in units of length, and the ends of the passes.
    Step(f64),
    /// That many samples in the whole circuit, evenly over each pass.
    Samples(usize),
    /// That many, dense towards the limits.
    DenseAtLimits(usize),
    /// That many, evenly along the path of the first traced joint, to a part in ten thousand.
    ArcLength(usize),
}

/// The most samples a circuit may have.
pub const MAX_SAMPLES: usize = 100_000;

/// Samples circuits; holds the sines and cosines of a full turn, made once for all cells.
#[derive(Clone, Debug)]
pub struct Sampler {
    sampling: Sampling,
    /// The samples of a full turn.
    full_turn: Vec<InputPosition>,
}

/// A sampled circuit.
#[derive(Clone, Debug)]
pub struct Circuit {
    /// Whether it comes back to where it began.
    pub is_closed: bool,
    /// Its passes, in order.
    pub passes: Vec<Pass>,
    /// The input of each sample: degrees, continuous and never wrapped, or lengths.
    pub inputs: Vec<f64>,
    /// Where each joint is at each sample, in the frame the linkage is seen from.
    pub positions: JointPositions,
    /// The pass each sample is on; at the end of one, the pass it ends.
    sample_passes: Vec<usize>,
    /// The same by more samples, once they are asked for.
    pub(super) refined: OnceLock<Box<Circuit>>,
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

    /// The sides of the dyads at a sample; at the end of a pass, those of the pass it ends.
    pub fn mode_at(&self, sample: usize) -> AssemblyMode {
        self.passes[self.sample_passes[sample]].mode
    }

    /// Whether the input turns round at the end of a pass, for a dyad lies flat there.
    pub fn reverses_after(&self, pass: usize) -> bool {
        let last = pass + 1 == self.passes.len();
        let next = &self.passes[(pass + 1) % self.passes.len()];
        (!last || self.is_closed) && self.passes[pass].input_direction() != next.input_direction()
    }

    /// Whether paths may have a corner at a sample: where the input goes on over a change point, and the branch stays.
    pub fn is_corner(&self, sample: usize) -> bool {
        let k = self.sample_passes[sample];
        let (pass, next) = (&self.passes[k], &self.passes[(k + 1) % self.passes.len()]);
        let is_end = self.inputs[sample] == pass.to.input.value || (sample == 0 && self.is_closed);
        is_end && !pass.to.flat_dyads.is_empty() && !self.reverses_after(k) && pass.mode == next.mode
    }

    /// Places and rates of all joints at a sample.
    pub fn derivatives(&self, linkage: &Linkage, sample: usize) -> JointDerivatives {
        let pass = &self.passes[self.sample_passes[sample]];
        // A closed circuit begins where its last pass ends, perhaps a few turns on.
        let begins_at_an_end = sample == 0 && self.is_closed && !pass.to.flat_dyads.is_empty();
        JointDerivatives::on_pass(
            linkage,
            pass,
            if begins_at_an_end { pass.to.input.value } else { self.inputs[sample] },
        )
    }

    /// A joint's places, sample by sample.
    pub fn points(&self, joint: JointId) -> impl Iterator<Item = Point> {
        self.positions.x(joint).iter().zip(self.positions.y(joint)).map(|(&x, &y)| Point::new(x, y))
    }
}

impl Sampler {
    /// A sampler.
    ///
    /// # Panics
    /// If a step is not positive or there are to be more than [`MAX_SAMPLES`] samples.
    pub fn new(sampling: Sampling) -> Sampler {
        let turn = match sampling {
            Sampling::Step(step) => {
                assert!(step > 0.0, "a step of {step}");
                // A step of a length may be short; there is no turn then.
                multiples(step, 0.0, 360.0).take(MAX_SAMPLES).map(InputPosition::from_degrees).collect()
            }
            Sampling::Samples(n) | Sampling::DenseAtLimits(n) | Sampling::ArcLength(n) => {
                assert!(n <= MAX_SAMPLES, "{n} samples");
                (0..n).map(|i| InputPosition::from_degrees(360.0 * i as f64 / n as f64)).collect()
            }
        };
        Sampler { sampling, full_turn: turn }
    }

    /// The samples of a whole turn from input 0: the table of sines and cosines.
    pub fn full_turn(&self) -> &[InputPosition] {
        &self.full_turn
    }

    /// Why a route is not sampled by so short a step.
    pub(super) fn excess_reason(&self, route: &UnsampledCircuit) -> Option<String> {
        let Sampling::Step(step) = self.sampling else { return None };
        // A full turn may have them all, and rounding one more.
        let is_long = |pass: &Pass| pass.input_length() / step > MAX_SAMPLES as f64 + 1.0;
        let reason = || format!("a step of {step} makes more than {MAX_SAMPLES} samples from one end to the other");
        route.passes.iter().any(is_long).then(reason)
    }

    pub(super) fn sample_circuit(&self, linkage: &Linkage, route: UnsampledCircuit) -> Circuit {
        let mut plan = self.plan_samples(&route, linkage);
        let mut places = JointPositions::new(linkage.joints.len(), plan.inputs.len());
        let inputs = InputColumns::new(&plan.inputs);
        let all = linkage.joints.len();
        for (run, pass) in plan.pass_ranges.iter().zip(&route.passes) {
            let modes = DyadSigns::new(pass.mode, DyadSet::EMPTY);
            place_leading_joints(linkage, all, inputs.slice(run.clone()), &modes, &mut places, run.clone());
        }
        for &(sample, on, is_first) in &plan.pass_ends {
            let pass = &route.passes[on];
            place_at_end(linkage, pass, is_first, &mut places, sample);
            plan.sample_passes[sample] = on;
        }
        convert_to_view_frame(linkage, &mut places);
        let input = plan.inputs.iter().map(|stop| stop.value).collect();
        Circuit {
            is_closed: route.is_closed,
            passes: route.passes,
            inputs: input,
            positions: places,
            sample_passes: plan.sample_passes,
            refined: OnceLock::new(),
        }
    }

    /// Where the samples of a route are: pass after pass, each up to and with its end; before them the start, which
    /// of a closed circuit is the end of its last pass.
    fn plan_samples(&self, route: &UnsampledCircuit, linkage: &Linkage) -> SamplePlan {
        let input = linkage.input();
        let mut plan = SamplePlan::default();
        if let [pass] = route.passes[..]
            && route.is_closed
            && pass.from.flat_dyads.is_empty()
            && !matches!(self.sampling, Sampling::ArcLength(_))
        {
            // A full turn on one branch: the table as it is, and again for every further turn.
            plan.inputs = self.full_period(input);
            plan.sample_passes = vec![0; plan.inputs.len()];
            plan.pass_ranges.push(0..plan.inputs.len());
            return plan;
        }
        let last = route.passes.len() - 1;
        plan.pass_ends.push(if route.is_closed { (0, last, false) } else { (0, 0, true) });
        plan.inputs.push(route.passes[0].from.input);
        plan.sample_passes.push(0);
        let mileages = self.cumulative_lengths(route, linkage);
        let intervals = self.interval_counts(route, &mileages);
        for (k, pass) in route.passes.iter().enumerate() {
            let begin = plan.inputs.len();
            self.push_inner_samples(pass, (intervals[k], input), mileages.get(k), &mut plan.inputs);
            if k < last || !route.is_closed {
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
        (intervals, input): (usize, Input),
        mileage: Option<&CumulativeLength>,
        out: &mut Vec<InputPosition>,
    ) {
        let (from, to) = (pass.from.input.value, pass.to.input.value);
        let shares = (1..intervals).map(|i| i as f64 / intervals as f64);
        match self.sampling {
            Sampling::DenseAtLimits(_) | Sampling::ArcLength(_) => out.extend(shares.map(|share| {
                InputPosition::new(
                    input,
                    spacing::eased_input(pass, mileage.map_or(share, |mileage| mileage.pass_fraction(share))),
                )
            })),
            Sampling::Samples(_) => out.extend(shares.map(|t| {
                // From both ends, so that equal passes there and back have equal samples.
                InputPosition::new(input, if from < to { from + (to - from) * t } else { to + (from - to) * (1.0 - t) })
            })),
            Sampling::Step(step) => {
                let begin = out.len();
                let apart = |at: &f64| (at - from).abs() > 1e-9 * step && (at - to).abs() > 1e-9 * step;
                let inside = multiples(step, from.min(to), from.max(to)).filter(apart).take(MAX_SAMPLES);
                out.extend(inside.map(|at| self.input_at_multiple(input, at, step)));
                if from > to {
                    out[begin..].reverse();
                }
            }
        }
    }

    /// The input at a multiple of the step, from the table where the step divides the turn.
    fn input_at_multiple(&self, input: Input, at: f64, step: f64) -> InputPosition {
        let n = self.full_turn.len();
        if n as f64 * step == 360.0 && input != Input::Length {
            let index = ((at / step).round() as i64).rem_euclid(n as i64) as usize;
            return InputPosition { value: at, ..self.full_turn[index] };
        }
        InputPosition::new(input, at)
    }

    /// The samples of a whole period from input 0.
    fn full_period(&self, input: Input) -> Vec<InputPosition> {
        let period = input.period();
        match self.sampling {
            _ if period == 360.0 => self.full_turn.clone(),
            Sampling::Step(step) => {
                multiples(step, 0.0, period).map(|at| self.input_at_multiple(input, at, step)).collect()
            }
            Sampling::Samples(n) | Sampling::DenseAtLimits(n) | Sampling::ArcLength(n) => {
                (0..n).map(|i| InputPosition::from_degrees(period * i as f64 / n as f64)).collect()
            }
        }
    }

    /// The paths of the first traced joint, pass by pass, where samples are to be even along them.
    fn cumulative_lengths(&self, route: &UnsampledCircuit, linkage: &Linkage) -> Vec<CumulativeLength> {
        match (self.sampling, linkage.traced.first()) {
            (Sampling::ArcLength(_), Some(&joint)) => {
                let mileages: Vec<CumulativeLength> =
                    route.passes.iter().map(|pass| CumulativeLength::measure(linkage, pass, joint)).collect();
                // A joint that does not move tells nothing: the input is as good then.
                if mileages.iter().all(|mileage| mileage.total() > 0.0) { mileages } else { Vec::new() }
            }
            _ => Vec::new(),
        }
    }

    /// How many intervals each pass gets: in proportion to its length, at least one, by largest remainder.
    fn interval_counts(&self, route: &UnsampledCircuit, mileages: &[CumulativeLength]) -> Vec<usize> {
        let samples = match self.sampling {
            Sampling::Step(_) => return vec![0; route.passes.len()],
            Sampling::Samples(n) | Sampling::DenseAtLimits(n) | Sampling::ArcLength(n) => n,
        };
        let wanted = if route.is_closed { samples } else { samples.saturating_sub(1) };
        let length = |k: usize| mileages.get(k).map_or(route.passes[k].input_length(), CumulativeLength::total);
        let total: f64 = (0..route.passes.len()).map(length).sum();
        let exact: Vec<f64> = (0..route.passes.len()).map(|k| wanted as f64 * length(k) / total).collect();
        // A share a rounding error below a whole number is that number.
        let mut shares: Vec<usize> = exact.iter().map(|e| ((e + 1e-9).floor() as usize).max(1)).collect();
        let mut order: Vec<usize> = (0..shares.len()).collect();
        order.sort_by(|&a, &b| (exact[b] - shares[b] as f64).total_cmp(&(exact[a] - shares[a] as f64)));
        for k in order.into_iter().cycle() {
            if shares.iter().sum::<usize>() >= wanted {
                break;
            }
            shares[k] += 1;
        }
        shares
    }
}

#[derive(Default)]
struct SamplePlan {
    inputs: Vec<InputPosition>,
    /// The pass of each sample.
    sample_passes: Vec<usize>,
    /// The samples of each pass.
    pass_ranges: Vec<Range<usize>>,
    /// The samples at the ends of passes: sample, pass, and whether it is where the pass begins.
    pass_ends: Vec<(usize, usize, bool)>,
}

/// The whole multiples of `step` in `[from, to)`, as the decimals say: the third multiple of 0.1 is 0.3.
fn multiples(step: f64, from: f64, to: f64) -> impl Iterator<Item = f64> {
    // Where the step is a decimal of up to nine places, the multiple is one division and so correctly rounded.
    let whole = (0..=9).map(|d| 10u64.pow(d) as f64).find_map(|scale| {
        let units = (step * scale).round();
        (units / scale == step).then_some((units, scale))
    });
    let multiple = move |k: f64| match whole {
        Some((units, scale)) => k * units / scale,
        None => k * step,
    };
    let first = (from / step).ceil() as i64;
    (first..).map(move |k| multiple(k as f64)).skip_while(move |deg| *deg < from).take_while(move |deg| *deg < to)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multiples_are_what_the_decimals_say() {
        let of = |step, from, to| multiples(step, from, to).collect::<Vec<f64>>();
        assert_eq!(of(0.1, 0.0, 0.45), [0.0, 0.1, 0.2, 0.3, 0.4]);
        assert_eq!(of(2.0, -3.0, 3.0), [-2.0, 0.0, 2.0]);
        assert_eq!(of(360.0 / 7.0, 0.0, 360.0).len(), 7);
        assert_eq!(of(2.0, 0.0, 360.0).len(), 180);
        assert_eq!(of(0.1, 0.0, 360.0).len(), 3600);
    }
}

use std::ops::Range;
use std::sync::OnceLock;

use super::circuit::{Pass, Route, Stop};
use super::ends::place_end;
use super::jet::Jets;
use super::kernel::{Columns, Modes, OwnInputs, place, see};
use super::spacing::{self, Mileage};
use crate::geometry::Point;
use crate::linkage::{Flat, Input, JointId, Linkage, Signs};

/// How densely a circuit is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sampling {
    /// Every whole multiple of a step, in degrees or in units of length, and the ends of the passes.
    Step(f64),
    /// That many samples in the whole circuit, evenly over each pass.
    Samples(usize),
    /// That many, dense towards the limits.
    Smooth(usize),
    /// That many, evenly along the path of the first traced joint, to a part in ten thousand.
    Arc(usize),
}

/// The most samples a circuit may have.
pub const MAX_SAMPLES: usize = 100_000;

/// Samples circuits; holds the sines and cosines of a full turn, made once for all cells.
#[derive(Clone, Debug)]
pub struct Sampler {
    sampling: Sampling,
    /// The samples of a full turn.
    turn: Vec<Stop>,
}

/// A sampled circuit.
#[derive(Clone, Debug)]
pub struct Circuit {
    /// Whether it comes back to where it began.
    pub closed: bool,
    /// Its passes, in order.
    pub passes: Vec<Pass>,
    /// The input of each sample: degrees, continuous and never wrapped, or lengths.
    pub input: Vec<f64>,
    /// Where each joint is at each sample, in the frame the linkage is seen from.
    pub places: Columns,
    /// The pass each sample is on; at the end of one, the pass it ends.
    pass: Vec<usize>,
    /// The same by more samples, once they are asked for.
    pub(super) fine: OnceLock<Box<Circuit>>,
}

impl Circuit {
    /// The number of samples.
    pub fn len(&self) -> usize {
        self.input.len()
    }

    /// Whether there are no samples.
    pub fn is_empty(&self) -> bool {
        self.input.is_empty()
    }

    /// The sides of the dyads at a sample; at the end of a pass, those of the pass it ends.
    pub fn signs(&self, sample: usize) -> Signs {
        self.passes[self.pass[sample]].signs
    }

    /// Whether the input turns round at the end of a pass, for a dyad lies flat there.
    pub fn turns_after(&self, pass: usize) -> bool {
        let last = pass + 1 == self.passes.len();
        let next = &self.passes[(pass + 1) % self.passes.len()];
        (!last || self.closed) && self.passes[pass].heading() != next.heading()
    }

    /// Whether paths may have a corner at a sample: where the input goes on over a change point, and the branch stays.
    pub fn is_corner(&self, sample: usize) -> bool {
        let k = self.pass[sample];
        let (pass, next) = (&self.passes[k], &self.passes[(k + 1) % self.passes.len()]);
        let is_end = self.input[sample] == pass.to.stop.at || (sample == 0 && self.closed);
        is_end && !pass.to.flat.is_none() && !self.turns_after(k) && pass.signs == next.signs
    }

    /// Places and rates of all joints at a sample.
    pub fn jets(&self, linkage: &Linkage, sample: usize) -> Jets {
        let pass = &self.passes[self.pass[sample]];
        // A closed circuit begins where its last pass ends, perhaps a few turns on.
        let begins_at_an_end = sample == 0 && self.closed && !pass.to.flat.is_none();
        Jets::on(linkage, pass, if begins_at_an_end { pass.to.stop.at } else { self.input[sample] })
    }

    /// A joint's places, sample by sample.
    pub fn points(&self, joint: JointId) -> impl Iterator<Item = Point> {
        self.places.x(joint).iter().zip(self.places.y(joint)).map(|(&x, &y)| Point::new(x, y))
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
                multiples(step, 0.0, 360.0).take(MAX_SAMPLES).map(Stop::angle).collect()
            }
            Sampling::Samples(n) | Sampling::Smooth(n) | Sampling::Arc(n) => {
                assert!(n <= MAX_SAMPLES, "{n} samples");
                (0..n).map(|i| Stop::angle(360.0 * i as f64 / n as f64)).collect()
            }
        };
        Sampler { sampling, turn }
    }

    /// The samples of a whole turn from input 0: the table of sines and cosines.
    pub fn turn(&self) -> &[Stop] {
        &self.turn
    }

    /// Why a route is not sampled by so short a step.
    pub(super) fn excess(&self, route: &Route) -> Option<String> {
        let Sampling::Step(step) = self.sampling else { return None };
        // A full turn may have them all, and rounding one more.
        let is_long = |pass: &Pass| pass.length() / step > MAX_SAMPLES as f64 + 1.0;
        let reason = || format!("a step of {step} makes more than {MAX_SAMPLES} samples from one end to the other");
        route.passes.iter().any(is_long).then(reason)
    }

    pub(super) fn sample(&self, linkage: &Linkage, route: Route) -> Circuit {
        let mut plan = self.plan(&route, linkage);
        let mut places = Columns::new(linkage.joints.len(), plan.stops.len());
        let inputs = OwnInputs::new(&plan.stops);
        let all = linkage.joints.len();
        for (run, pass) in plan.runs.iter().zip(&route.passes) {
            let modes = Modes::new(pass.signs, Flat::NONE);
            place(linkage, all, inputs.of(run.clone()), &modes, &mut places, run.clone());
        }
        for &(sample, on, is_first) in &plan.ends {
            let pass = &route.passes[on];
            place_end(linkage, pass, is_first, &mut places, sample);
            plan.pass[sample] = on;
        }
        see(linkage, &mut places);
        let input = plan.stops.iter().map(|stop| stop.at).collect();
        Circuit { closed: route.closed, passes: route.passes, input, places, pass: plan.pass, fine: OnceLock::new() }
    }

    /// Where the samples of a route are: pass after pass, each up to and with its end; before them the start, which
    /// of a closed circuit is the end of its last pass.
    fn plan(&self, route: &Route, linkage: &Linkage) -> Plan {
        let input = linkage.input();
        let mut plan = Plan::default();
        if let [pass] = route.passes[..]
            && route.closed
            && pass.from.flat.is_none()
            && !matches!(self.sampling, Sampling::Arc(_))
        {
            // A full turn on one branch: the table as it is, and again for every further turn.
            plan.stops = self.turns(input);
            plan.pass = vec![0; plan.stops.len()];
            plan.runs.push(0..plan.stops.len());
            return plan;
        }
        let last = route.passes.len() - 1;
        plan.ends.push(if route.closed { (0, last, false) } else { (0, 0, true) });
        plan.stops.push(route.passes[0].from.stop);
        plan.pass.push(0);
        let mileages = self.mileages(route, linkage);
        let intervals = self.intervals(route, &mileages);
        for (k, pass) in route.passes.iter().enumerate() {
            let begin = plan.stops.len();
            self.inside(pass, (intervals[k], input), mileages.get(k), &mut plan.stops);
            if k < last || !route.closed {
                plan.ends.push((plan.stops.len(), k, false));
                plan.stops.push(pass.to.stop);
            }
            plan.runs.push(begin..plan.stops.len());
            plan.pass.resize(plan.stops.len(), k);
        }
        plan
    }

    /// The samples strictly inside a pass.
    fn inside(&self, pass: &Pass, (intervals, input): (usize, Input), mileage: Option<&Mileage>, out: &mut Vec<Stop>) {
        let (from, to) = (pass.from.stop.at, pass.to.stop.at);
        let shares = (1..intervals).map(|i| i as f64 / intervals as f64);
        match self.sampling {
            Sampling::Smooth(_) | Sampling::Arc(_) => out.extend(shares.map(|share| {
                Stop::of(input, spacing::smooth(pass, mileage.map_or(share, |mileage| mileage.part(share))))
            })),
            Sampling::Samples(_) => out.extend(shares.map(|t| {
                // From both ends, so that equal passes there and back have equal samples.
                Stop::of(input, if from < to { from + (to - from) * t } else { to + (from - to) * (1.0 - t) })
            })),
            Sampling::Step(step) => {
                let begin = out.len();
                let apart = |at: &f64| (at - from).abs() > 1e-9 * step && (at - to).abs() > 1e-9 * step;
                let inside = multiples(step, from.min(to), from.max(to)).filter(apart).take(MAX_SAMPLES);
                out.extend(inside.map(|at| self.stop(input, at, step)));
                if from > to {
                    out[begin..].reverse();
                }
            }
        }
    }

    /// The input at a multiple of the step, from the table where the step divides the turn.
    fn stop(&self, input: Input, at: f64, step: f64) -> Stop {
        let n = self.turn.len();
        if n as f64 * step == 360.0 && input != Input::Length {
            let index = ((at / step).round() as i64).rem_euclid(n as i64) as usize;
            return Stop { at, ..self.turn[index] };
        }
        Stop::of(input, at)
    }

    /// The samples of a whole period from input 0.
    fn turns(&self, input: Input) -> Vec<Stop> {
        let period = input.period();
        match self.sampling {
            _ if period == 360.0 => self.turn.clone(),
            Sampling::Step(step) => multiples(step, 0.0, period).map(|at| self.stop(input, at, step)).collect(),
            Sampling::Samples(n) | Sampling::Smooth(n) | Sampling::Arc(n) => {
                (0..n).map(|i| Stop::angle(period * i as f64 / n as f64)).collect()
            }
        }
    }

    /// The paths of the first traced joint, pass by pass, where samples are to be even along them.
    fn mileages(&self, route: &Route, linkage: &Linkage) -> Vec<Mileage> {
        match (self.sampling, linkage.traced.first()) {
            (Sampling::Arc(_), Some(&joint)) => {
                let mileages: Vec<Mileage> =
                    route.passes.iter().map(|pass| Mileage::of(linkage, pass, joint)).collect();
                // A joint that does not move tells nothing: the input is as good then.
                if mileages.iter().all(|mileage| mileage.whole() > 0.0) { mileages } else { Vec::new() }
            }
            _ => Vec::new(),
        }
    }

    /// How many intervals each pass gets: in proportion to its length, at least one, by largest remainder.
    fn intervals(&self, route: &Route, mileages: &[Mileage]) -> Vec<usize> {
        let samples = match self.sampling {
            Sampling::Step(_) => return vec![0; route.passes.len()],
            Sampling::Samples(n) | Sampling::Smooth(n) | Sampling::Arc(n) => n,
        };
        let wanted = if route.closed { samples } else { samples.saturating_sub(1) };
        let length = |k: usize| mileages.get(k).map_or(route.passes[k].length(), Mileage::whole);
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
struct Plan {
    stops: Vec<Stop>,
    /// The pass of each sample.
    pass: Vec<usize>,
    /// The samples of each pass.
    runs: Vec<Range<usize>>,
    /// The samples at the ends of passes: sample, pass, and whether it is where the pass begins.
    ends: Vec<(usize, usize, bool)>,
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

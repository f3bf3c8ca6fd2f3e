//! Evaluates trial linkages against the requirements.

use std::sync::Arc;

use super::extent::greatest_distance;
use super::kind::{DrivenLinkage, Driver, LinkageKind};
use super::requirements::Requirements;
use super::stroke::{InputLink, Stroke};
use coupler_curves::geometry::{Point, trig};
use coupler_curves::linkage::{FourBar, Linkage};
use coupler_curves::measure::{Measure, StraightCriterion, StraightPortion, TracedCurve};
use coupler_curves::motion::{Motion, Sampler};
use coupler_curves::template::Template;

/// A trial linkage, with a unit link of length 1.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Trial {
    pub driven_linkage: DrivenLinkage,
    /// Its free proportions.
    pub proportions: Vec<f64>,
    /// The tolerance of its straight portion.
    pub tolerance: f64,
    /// The length of its straight portion.
    pub length: f64,
    pub performance: Performance,
}

/// The properties of a linkage that requirements refer to, in addition to its straight portion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Performance {
    /// The driven link: of two rockers that can be driven, the one with the greater transmission angle.
    pub input_link: InputLink,
    /// The greatest distance between any two positions of its joints: over a whole turn if a motor drives, over the
    /// straight stroke if a rocker does.
    pub size: f64,
    /// The least transmission angle in degrees over the same motion; of an angle over 90 the supplement counts.
    pub mu_min: f64,
    /// The fraction of a turn that the straight stroke takes; `None` if a rocker drives.
    pub turn_fraction: Option<f64>,
}

impl Trial {
    /// The ratio of straight length to size.
    pub fn length_to_size(&self) -> f64 {
        self.length / self.performance.size
    }
}

/// The goal of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Goal {
    /// The longest straight portion for the size.
    Longest,
    /// The greatest transmission angle, with a straight portion of at least this fraction of the size.
    Transmission { min_length_to_size: f64 },
    /// The nearest `p`, with a straight portion of at least this fraction of the size.
    Frame { p: f64, min_length_to_size: f64 },
}

/// The objective function of a search.
#[derive(Clone, Copy, Debug)]
pub(super) struct Objective<'a> {
    pub driven_linkage: DrivenLinkage,
    pub template: &'a Arc<Template>,
    pub requirements: &'a Requirements,
    pub tolerance: f64,
    pub goal: Goal,
}

/// From this value on, a requirement is not met; the shortfall is added to it.
pub(super) const UNMET_PENALTY: f64 = 10.0;
/// The value of proportions that give no linkage of the kind.
const IMPOSSIBLE_PENALTY: f64 = 1e4;

impl Objective<'_> {
    /// Evaluates proportions: the value to be minimized, and the trial; `None` if they give no linkage, or one that is
    /// rejected before its straight portion is measured.
    pub fn evaluate(&self, proportions: &[f64], sampler: &Sampler) -> (f64, Option<Trial>) {
        let ranges = self.driven_linkage.kind.free_proportions(self.tolerance);
        let outside =
            proportions.iter().zip(&ranges).map(|(&x, free)| (free.range[0] / x).max(x / free.range[1]).max(1.0) - 1.0);
        let outside: f64 = outside.sum();
        if outside > 1e-12 {
            return (IMPOSSIBLE_PENALTY * (1.0 + outside), None);
        }
        match self.evaluate_linkage(proportions, sampler) {
            Err(value) => (value, None),
            Ok((value, trial)) => (value, Some(trial)),
        }
    }

    fn evaluate_linkage(&self, proportions: &[f64], sampler: &Sampler) -> Result<(f64, Trial), f64> {
        let linkage = self
            .template
            .linkage(&self.driven_linkage.kind.template_values(proportions))
            .map_err(|_| IMPOSSIBLE_PENALTY)?;
        let class = FourBar::from_linkage(&linkage).map(FourBar::class).ok_or(IMPOSSIBLE_PENALTY)?;
        if !self.driven_linkage.kind.allows_class(class) {
            return Err(IMPOSSIBLE_PENALTY);
        }
        let motion = Motion::solve(&linkage, sampler);
        let curve = first_traced_curve(&linkage, &motion, self.tolerance).ok_or(IMPOSSIBLE_PENALTY)?;
        let requirements = self.requirements;
        // The straight portion takes longest, so the other requirements are checked first.
        let angle_shortfall = |mu: f64| if mu < requirements.mu_min { 1.0 - mu / requirements.mu_min } else { 0.0 };
        let requires_angle = !matches!(self.goal, Goal::Transmission { .. });
        if self.driven_linkage.input == Driver::Motor && requires_angle {
            let shortfall = angle_shortfall(min_transmission_angle(&curve).ok_or(IMPOSSIBLE_PENALTY)?);
            if shortfall > 0.0 {
                return Err(100.0 * UNMET_PENALTY * (1.0 + shortfall));
            }
        }
        if requirements.double_point.is_some_and(|required| required != (curve.measure(Measure::CRUNODES) > Some(0.0)))
        {
            return Err(100.0 * UNMET_PENALTY);
        }
        let portion = curve.straight().ok_or(IMPOSSIBLE_PENALTY)?;
        let figures = performance(self.driven_linkage, &curve, portion).ok_or(IMPOSSIBLE_PENALTY)?;
        let (driven_linkage, tolerance, length) = (self.driven_linkage, self.tolerance, portion.length);
        let trial =
            Trial { driven_linkage, proportions: proportions.to_vec(), tolerance, length, performance: figures };
        let mut shortfall = if requires_angle { angle_shortfall(figures.mu_min) } else { 0.0 };
        if requirements.quick_return {
            shortfall += figures.turn_fraction.map_or(1.0, |turn| (1.0 - 2.0 * turn).max(0.0));
        }
        if let Goal::Transmission { min_length_to_size: ratio } | Goal::Frame { min_length_to_size: ratio, .. } =
            self.goal
        {
            shortfall += (1.0 - trial.length_to_size() / ratio).max(0.0);
        }
        let value = match self.goal {
            _ if shortfall > 0.0 => UNMET_PENALTY * (1.0 + shortfall),
            Goal::Longest => -trial.length_to_size(),
            Goal::Transmission { .. } => -figures.mu_min,
            Goal::Frame { p, .. } => (proportions[0] / p).max(p / proportions[0]),
        };
        Ok((value, trial))
    }
}

/// The curve that is measured: that of the first traced joint on the first circuit.
pub(super) fn first_traced_curve<'a>(
    linkage: &'a Linkage,
    motion: &'a Motion,
    tolerance: f64,
) -> Option<TracedCurve<'a>> {
    let (circuit, joint) = (motion.circuits.first()?, *linkage.traced.first()?);
    Some(
        TracedCurve::new(linkage, motion, circuit, joint)
            .with_straight_criterion(StraightCriterion::Tolerance(tolerance)),
    )
}

/// The least transmission angle over a full turn, of an angle over 90 the supplement; `None` if the input cannot turn
/// fully.
fn min_transmission_angle(curve: &TracedCurve) -> Option<f64> {
    let turns = curve.circuit.is_closed && curve.circuit.passes.len() == 1;
    curve.measure(Measure::MU_WORST).filter(|_| turns)
}

/// The performance of a linkage with this straight portion; `None` if a motor drives and cannot turn it fully, or if
/// the stroke of a rocker cannot be found.
pub(super) fn performance(
    driven_linkage: DrivenLinkage,
    curve: &TracedCurve,
    portion: &StraightPortion,
) -> Option<Performance> {
    if driven_linkage.input == Driver::Motor {
        let circuit = curve.circuit;
        let joints = curve.linkage.joint_ids();
        let places: Vec<Point> = joints.flat_map(|joint| circuit.points(joint)).collect();
        let driven = if driven_linkage.kind == LinkageKind::Chebyshev { InputLink::Coupler } else { InputLink::Crank };
        let (mu_min, turn) = (min_transmission_angle(curve)?, Some(portion.input_span / 360.0));
        return Some(Performance { input_link: driven, size: greatest_distance(&places), mu_min, turn_fraction: turn });
    }
    let stroke = Stroke::from_portion(curve, portion)?;
    let size = greatest_distance(&stroke.poses.concat());
    let [by_crank, by_rocker] =
        [InputLink::Crank, InputLink::Rocker].map(|driven| stroke.min_transmission_angle(driven));
    // If the angles are equal up to rounding, the crank is driven.
    let is_rocker = by_rocker > by_crank + 1e-6;
    let (driven, mu_min) = if is_rocker { (InputLink::Rocker, by_rocker) } else { (InputLink::Crank, by_crank) };
    Some(Performance { input_link: driven, size, mu_min, turn_fraction: None })
}

/// The distance of two trials of a kind: the greatest relative difference of a proportion.
pub(super) fn proportion_distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a / b).max(b / a) - 1.0).fold(0.0, f64::max)
}

/// The next tolerance at which the portion is likely to be the given fraction of the size: by the power law through the
/// last two measurements, or through one with the exponent of a fourth-order contact.
pub(super) fn next_tolerance(target: f64, [t0, ratio0]: [f64; 2], last: Option<[f64; 2]>) -> f64 {
    let ln = |x: f64| trig::ln(x);
    let slope = last.map(|[t1, ratio1]| (ln(ratio1) - ln(ratio0)) / (ln(t1) - ln(t0)));
    let slope = slope.filter(|slope| slope.is_finite()).unwrap_or(0.2).clamp(0.1, 1.0);
    t0 * trig::pow(target / ratio0, 1.0 / slope)
}

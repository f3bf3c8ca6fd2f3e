use std::sync::Arc;

use super::extent::greatest_distance;
use super::kind::{DrivenLinkage, Driver, LinkageKind};
use super::requirements::Requirements;
use super::stroke::{InputLink, Stroke};
use coupler_curves::geometry::{Point, trig};
use coupler_curves::linkage::{FourBar, Linkage};
use coupler_curves::measure::{self, StraightCriterion, StraightPortion, TracedCurve, Value};
use coupler_curves::motion::{Motion, Sampler};
use coupler_curves::template::Template;

/// A linkage tried out, its unit link 1.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Trial {
    pub driven_linkage: DrivenLinkage,
    /// Its free proportions.
    pub proportions: Vec<f64>,
    /// The tolerance its straight portion has been measured at.
    pub tolerance: f64,
    /// The length of that portion.
    pub length: f64,
    pub performance: Performance,
}

/// What a designer asks of a linkage, beside the straight line itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Performance {
    /// The link that is driven: of two rockers that can be, the one with the better transmission angle.
    pub input_link: InputLink,
    /// The greatest distance of two places of its joints: over a whole turn where a motor drives, over the straight stroke
    /// where a rocker does.
    pub size: f64,
    /// The least transmission angle in degrees over the same motion, an angle over 90 as its supplement.
    pub mu_min: f64,
    /// The part of a turn the straight stroke takes; `None` where a rocker drives.
    pub turn_fraction: Option<f64>,
}

impl Trial {
    /// The straight length as a part of the size.
    pub fn length_to_size(&self) -> f64 {
        self.length / self.performance.size
    }
}

/// What a search is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Goal {
    /// The longest straight portion for the size.
    Longest,
    /// The greatest transmission angle, the straight portion being such a part of the size.
    Transmission { min_length_to_size: f64 },
    /// The `p` nearest to this one, the straight portion being such a part of the size.
    Frame { p: f64, min_length_to_size: f64 },
}

/// What is asked of trials.
#[derive(Clone, Copy, Debug)]
pub(super) struct Objective<'a> {
    pub driven_linkage: DrivenLinkage,
    pub template: &'a Arc<Template>,
    pub requirements: &'a Requirements,
    pub tolerance: f64,
    pub goal: Goal,
}

/// From this value on something that was wished is not met: what is missing is counted from here.
pub(super) const UNMET_PENALTY: f64 = 10.0;
/// What is no linkage of the kind at all.
const IMPOSSIBLE_PENALTY: f64 = 1e4;

impl Objective<'_> {
    /// How far a trial is from the goal, the less the better, and the trial; of what makes no linkage, only that.
    pub fn evaluate(&self, of: &[f64], sampler: &Sampler) -> (f64, Option<Trial>) {
        let ranges = self.driven_linkage.kind.free_proportions(self.tolerance);
        let outside =
            of.iter().zip(&ranges).map(|(&x, free)| (free.range[0] / x).max(x / free.range[1]).max(1.0) - 1.0);
        let outside: f64 = outside.sum();
        if outside > 1e-12 {
            return (IMPOSSIBLE_PENALTY * (1.0 + outside), None);
        }
        match self.evaluate_linkage(of, sampler) {
            Err(value) => (value, None),
            Ok((value, trial)) => (value, Some(trial)),
        }
    }

    fn evaluate_linkage(&self, of: &[f64], sampler: &Sampler) -> Result<(f64, Trial), f64> {
        let linkage =
            self.template.linkage(&self.driven_linkage.kind.template_values(of)).map_err(|_| IMPOSSIBLE_PENALTY)?;
        let class = FourBar::from_linkage(&linkage).map(FourBar::class).ok_or(IMPOSSIBLE_PENALTY)?;
        if !self.driven_linkage.kind.allows_class(class) {
            return Err(IMPOSSIBLE_PENALTY);
        }
        let motion = Motion::solve(&linkage, sampler);
        let subject = first_traced_curve(&linkage, &motion, self.tolerance).ok_or(IMPOSSIBLE_PENALTY)?;
        let wishes = self.requirements;
        // What is known before the straight portion, which takes longest.
        let lacks_angle = |mu: f64| if mu < wishes.mu_min { 1.0 - mu / wishes.mu_min } else { 0.0 };
        let asks_angle = !matches!(self.goal, Goal::Transmission { .. });
        if self.driven_linkage.input == Driver::Motor && asks_angle {
            let lacks = lacks_angle(min_transmission_angle(&subject).ok_or(IMPOSSIBLE_PENALTY)?);
            if lacks > 0.0 {
                return Err(100.0 * UNMET_PENALTY * (1.0 + lacks));
            }
        }
        if wishes.double_point.is_some_and(|wanted| wanted != (number_value(&subject, "crunodes") > Some(0.0))) {
            return Err(100.0 * UNMET_PENALTY);
        }
        let portion = subject.straight().ok_or(IMPOSSIBLE_PENALTY)?;
        let figures = performance(self.driven_linkage, &subject, portion).ok_or(IMPOSSIBLE_PENALTY)?;
        let (arrangement, tolerance, length) = (self.driven_linkage, self.tolerance, portion.length);
        let trial =
            Trial { driven_linkage: arrangement, proportions: of.to_vec(), tolerance, length, performance: figures };
        let mut lacks = if asks_angle { lacks_angle(figures.mu_min) } else { 0.0 };
        if wishes.quick_return {
            lacks += figures.turn_fraction.map_or(1.0, |turn| (1.0 - 2.0 * turn).max(0.0));
        }
        if let Goal::Transmission { min_length_to_size: part } | Goal::Frame { min_length_to_size: part, .. } =
            self.goal
        {
            lacks += (1.0 - trial.length_to_size() / part).max(0.0);
        }
        let value = match self.goal {
            _ if lacks > 0.0 => UNMET_PENALTY * (1.0 + lacks),
            Goal::Longest => -trial.length_to_size(),
            Goal::Transmission { .. } => -figures.mu_min,
            Goal::Frame { p, .. } => (of[0] / p).max(p / of[0]),
        };
        Ok((value, trial))
    }
}

/// What is measured of a linkage: its first traced joint on its first circuit.
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

/// A measure that is a number.
pub(super) fn number_value(subject: &TracedCurve, name: &str) -> Option<f64> {
    let measure = measure::ALL.iter().find(|measure| measure.name == name)?;
    match (measure.compute)(subject) {
        Value::Number(number) => Some(number),
        _ => None,
    }
}

/// The least transmission angle over the circuit, an angle over 90 as its supplement.
fn min_transmission_angle(subject: &TracedCurve) -> Option<f64> {
    let turns = subject.circuit.is_closed && subject.circuit.passes.len() == 1;
    let [least, most] = [number_value(subject, "mu_min_deg")?, number_value(subject, "mu_max_deg")?];
    turns.then(|| least.min(180.0 - most))
}

/// What a designer asks of a straight portion's linkage; `None` where a motor cannot turn it.
pub(super) fn performance(
    arrangement: DrivenLinkage,
    subject: &TracedCurve,
    portion: &StraightPortion,
) -> Option<Performance> {
    if arrangement.input == Driver::Motor {
        let circuit = subject.circuit;
        let joints = subject.linkage.joint_ids();
        let places: Vec<Point> = joints.flat_map(|joint| circuit.points(joint)).collect();
        let driven = if arrangement.kind == LinkageKind::Chebyshev { InputLink::Coupler } else { InputLink::Crank };
        let (mu_min, turn) = (min_transmission_angle(subject)?, Some(portion.input_span / 360.0));
        return Some(Performance { input_link: driven, size: greatest_distance(&places), mu_min, turn_fraction: turn });
    }
    let stroke = Stroke::from_portion(subject, portion)?;
    let size = greatest_distance(&stroke.poses.concat());
    let [by_crank, by_rocker] =
        [InputLink::Crank, InputLink::Rocker].map(|driven| stroke.min_transmission_angle(driven));
    // Alike but for rounding, the crank is driven.
    let is_rocker = by_rocker > by_crank + 1e-6;
    let (driven, mu_min) = if is_rocker { (InputLink::Rocker, by_rocker) } else { (InputLink::Crank, by_crank) };
    Some(Performance { input_link: driven, size, mu_min, turn_fraction: None })
}

/// How far two trials of a kind are apart, in parts of their proportions.
pub(super) fn proportion_distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a / b).max(b / a) - 1.0).fold(0.0, f64::max)
}

/// The tolerance at which a portion is to be measured next, to be a given part of the size: by the power law through two
/// measurements, or where a path is straight to the fourth power, through one.
pub(super) fn next_tolerance(wanted: f64, [t0, part0]: [f64; 2], last: Option<[f64; 2]>) -> f64 {
    let ln = |x: f64| trig::ln(x);
    let slope = last.map(|[t1, part1]| (ln(part1) - ln(part0)) / (ln(t1) - ln(t0)));
    let slope = slope.filter(|slope| slope.is_finite()).unwrap_or(0.2).clamp(0.1, 1.0);
    t0 * trig::pow(wanted / part0, 1.0 / slope)
}

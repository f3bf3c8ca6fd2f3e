//! Samples of the ranges, in the size that suits the wishes.

use coupler_curves::geometry::trig;
use coupler_curves::numerical::maximum;

use super::assessment::Assessment;
use super::measured::Meter;
use super::merit::{Objective, Units};

/// A sample, and how good it is to start from.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    /// The less the better.
    pub merit: f64,
    pub place: Vec<f64>,
    pub assessment: Assessment,
}

/// What measures samples.
pub(super) struct Sampling<'a> {
    pub meter: &'a Meter,
    pub units: &'a Units,
}

impl Sampling<'_> {
    /// A sample in the size that suits the wishes best.
    pub fn sampled(&self, number: usize, most: f64) -> Option<Sample> {
        let place = self.meter.space.sample(number);
        let measured = self.meter.screened(&place, self.units, most)?;
        if !self.meter.space.is_scaled {
            return self.best_curve(place, self.meter.assess(&measured));
        }
        /// Factors of the size, and the accuracy of their logarithm.
        const SIZES: i32 = 60;
        const ACCURACY: f64 = 1e-3;
        let at = |logarithm: f64| {
            let factor = trig::exp(logarithm);
            let place = self.meter.space.resized(&place, factor);
            let assessments = match self.meter.resized(&measured, factor) {
                Some(resized) => self.meter.assess(&resized),
                None => self.meter.assess_at(&place),
            };
            self.best_curve(place, assessments)
        };
        let merit = |logarithm: f64| at(logarithm).map_or(f64::NEG_INFINITY, |sample| -sample.merit);
        let coarse = (-SIZES..=SIZES).map(|k| f64::from(k) / 3.0).map(|logarithm| (logarithm, merit(logarithm)));
        let (best, _) = coarse.reduce(|best, other| if other.1 > best.1 { other } else { best })?;
        let fine = maximum([best - 1.0 / 3.0, best + 1.0 / 3.0], ACCURACY, merit);
        at(fine.place)
    }

    fn best_curve(&self, place: Vec<f64>, assessments: Vec<Assessment>) -> Option<Sample> {
        let merits = assessments.into_iter().map(|assessment| (self.merit(&assessment), assessment));
        let (merit, assessment) = merits.reduce(|best, other| if other.0 < best.0 { other } else { best })?;
        Some(Sample { merit, place, assessment })
    }

    /// How good a sample is to start from: what it violates, and a part of its goals.
    pub fn merit(&self, assessment: &Assessment) -> f64 {
        const PART_OF_GOALS: f64 = 0.3;
        let goals: f64 =
            (0..assessment.goals.len()).map(|k| self.units.objective(assessment, &Objective::Goal(k))).sum();
        self.units.violation(assessment, &Objective::Nothing) + PART_OF_GOALS * goals
    }
}

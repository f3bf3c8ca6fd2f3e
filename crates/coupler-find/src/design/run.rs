//! A run of the evolution strategy from a place.

use super::assessment::Assessment;
use super::evolution::Evolution;
use super::lagrangian::Lagrangian;
use super::merit::Objective;
use super::polish::Measuring;

/// A run on its way.
#[derive(Clone, Debug)]
pub(super) struct Run {
    evolution: Evolution,
    lagrangian: Option<Lagrangian>,
    pub objective: Objective,
    generations: usize,
    /// The most generations.
    most: usize,
    /// Whether each place is moved to where the wishes are met before it is judged, and not by the augmented Lagrangian. It takes far more
    /// evaluations and comes far nearer where little of the space meets the wishes.
    is_projected: bool,
    pub is_done: bool,
    /// The place that violates the wishes least and, of those that meet them, has the least objective.
    pub best: Vec<f64>,
    merit: [f64; 2],
}

/// The generations at most, and those for each unknown.
const LEAST: usize = 100;
const FOR_EACH: usize = 60;

/// What the violation that a projection leaves counts.
const FAR: f64 = 100.0;

impl Run {
    pub fn new(place: &[f64], objective: Objective, step: f64, seed: u64) -> Run {
        Run {
            evolution: Evolution::new(place, step, seed),
            lagrangian: None,
            objective,
            generations: 0,
            most: LEAST + FOR_EACH * place.len(),
            is_projected: false,
            is_done: false,
            best: place.to_vec(),
            merit: [f64::INFINITY; 2],
        }
    }

    /// The same run that judges places where they meet the wishes, for so many generations at most.
    pub fn projected(self, most: usize) -> Run {
        Run { is_projected: true, most, ..self }
    }

    /// Goes on for some generations.
    pub fn advance(&mut self, measuring: &Measuring<'_>, generations: usize) {
        /// Where all places are so near, nothing is gained any more.
        const NARROW: f64 = 1e-8;
        /// A generation that is moved to where the wishes are met takes about as long as so many others.
        const PROJECTION: usize = 10;
        let generations = if self.is_projected { generations.div_ceil(PROJECTION) } else { generations };
        for _ in 0..generations {
            if self.is_done {
                return;
            }
            self.step(measuring);
            self.generations += 1;
            self.is_done = self.generations >= self.most || self.evolution.spread() < NARROW;
        }
    }

    fn step(&mut self, measuring: &Measuring<'_>) {
        if self.is_projected {
            return self.projected_step(measuring);
        }
        let generation = self.evolution.generation();
        let mut values = Vec::with_capacity(generation.places.len());
        for place in &generation.places {
            values.push(self.value(measuring, place));
        }
        self.evolution.advance(&generation, &values);
        let mean = self.evolution.mean().to_vec();
        if let Some((assessment, lagrangian)) = self.nearest(measuring, &mean) {
            self.remember(measuring, &mean, &assessment);
            let Measuring { units, objective, .. } = measuring;
            let value = units.objective(&assessment, objective);
            let mut lagrangian = lagrangian;
            lagrangian.adapt(value, &units.constraints(&assessment, objective));
            self.lagrangian = Some(lagrangian);
        }
    }

    fn projected_step(&mut self, measuring: &Measuring<'_>) {
        let generation = self.evolution.generation();
        let mut values = Vec::with_capacity(generation.places.len());
        for place in &generation.places {
            let polished = measuring.projected(place);
            values.push(polished.map_or(f64::NAN, |polished| {
                self.remember(measuring, &polished.place, &polished.assessment);
                let violation = measuring.units.violation(&polished.assessment, measuring.objective);
                measuring.units.objective(&polished.assessment, measuring.objective) + FAR * violation
            }));
        }
        self.evolution.advance(&generation, &values);
    }

    /// The augmented Lagrangian of a place; that of the curve for which it is least.
    fn value(&mut self, measuring: &Measuring<'_>, place: &[f64]) -> f64 {
        match self.nearest(measuring, place) {
            Some((assessment, lagrangian)) => {
                self.remember(measuring, place, &assessment);
                self.lagrangian_of(measuring, &lagrangian, &assessment)
            }
            None => f64::NAN,
        }
    }

    fn lagrangian_of(&self, measuring: &Measuring<'_>, lagrangian: &Lagrangian, assessment: &Assessment) -> f64 {
        let objective = measuring.units.objective(assessment, measuring.objective);
        lagrangian.value(objective, &measuring.units.constraints(assessment, measuring.objective))
    }

    fn nearest(&self, measuring: &Measuring<'_>, place: &[f64]) -> Option<(Assessment, Lagrangian)> {
        let all = measuring.meter.assess_at(place);
        let first = all.first()?;
        let lagrangian = self.lagrangian.clone().unwrap_or_else(|| {
            Lagrangian::new(measuring.units.constraints(first, measuring.objective).len(), place.len())
        });
        let valued =
            all.into_iter().map(|assessment| (self.lagrangian_of(measuring, &lagrangian, &assessment), assessment));
        let (_, best) = valued.reduce(|best, other| if other.0 < best.0 { other } else { best })?;
        Some((best, lagrangian))
    }

    fn remember(&mut self, measuring: &Measuring<'_>, place: &[f64], assessment: &Assessment) {
        /// Violations below this, in units of the wishes, are met afterwards.
        const NEAR: f64 = 1e-3;
        let violation = measuring.units.violation(assessment, measuring.objective);
        let merit = [violation.max(NEAR), measuring.units.objective(assessment, measuring.objective)];
        if merit < self.merit {
            self.merit = merit;
            self.best = place.to_vec();
        }
    }

    /// Where the strategy is.
    pub fn mean(&self) -> &[f64] {
        self.evolution.mean()
    }
}

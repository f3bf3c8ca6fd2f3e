//! Meets wishes to rounding from near: Levenberg and Marquardt's method on what they are violated by.

use nalgebra::{DVector, Dyn};

use super::assessment::Assessment;
use super::measured::Meter;
use super::merit::{Objective, Units};
use coupler_curves::geometry::trig;
use coupler_curves::template::ParameterKind;

use crate::descent::{Candidate, Descent, Equations};
use crate::scatter::Scatter;

/// A place on its way to where the wishes are met.
#[derive(Clone, Debug)]
pub(super) struct Polished {
    pub place: Vec<f64>,
    pub assessment: Assessment,
    /// What each constraint is violated by; bounds that hold by 0.
    residuals: Vec<f64>,
    sum: f64,
}

/// What measures a place.
pub(super) struct Measuring<'a> {
    pub meter: &'a Meter,
    pub units: &'a Units,
    pub objective: &'a Objective,
}

impl Measuring<'_> {
    /// The residuals of a curve.
    fn residuals(&self, assessment: &Assessment) -> Vec<f64> {
        let constraints = self.units.constraints(assessment, self.objective);
        constraints
            .iter()
            .map(|constraint| if constraint.is_equality { constraint.value } else { constraint.value.max(0.0) })
            .collect()
    }

    /// A curve of the linkage at a place; that with these numbers, if they are given, and otherwise the nearest to what is wished.
    fn at(&self, place: Vec<f64>, curve: Option<[usize; 2]>) -> Option<Polished> {
        let of_curve = |assessment: Assessment| {
            let residuals = self.residuals(&assessment);
            let sum = residuals.iter().map(|residual| residual * residual).sum();
            Polished { place: place.clone(), assessment, residuals, sum }
        };
        let all = self.meter.assess_at(&place).into_iter().map(of_curve);
        let wanted = all.filter(|polished| curve.is_none_or(|curve| polished.assessment.curve == curve));
        wanted.reduce(|best, other| {
            let order = other.sum.total_cmp(&best.sum);
            let goal = |polished: &Polished| self.units.objective(&polished.assessment, self.objective);
            if order.then_with(|| goal(&other).total_cmp(&goal(&best))).is_lt() { other } else { best }
        })
    }

    /// The place near another one where the wishes are met, or nearest to being so.
    pub fn polished(&self, place: &[f64]) -> Option<Polished> {
        /// Near a place where the wishes are met there are few.
        const STEPS: usize = 30;
        self.descended(place, Descent::default(), STEPS)
    }

    /// The same from a place that is near already.
    pub fn projected(&self, place: &[f64]) -> Option<Polished> {
        const STEPS: usize = 5;
        self.descended(place, Descent::near_the_end(), STEPS)
    }

    fn descended(&self, place: &[f64], mut descent: Descent, steps: usize) -> Option<Polished> {
        let mut polished = self.at(place.to_vec(), None)?;
        for _ in 0..steps {
            if descent.is_done || polished.sum == 0.0 {
                break;
            }
            descent.step(&mut polished, self);
        }
        Some(polished)
    }

    /// From a place or the same shape in another size on, as long as other steps of one or two parameters are better.
    pub fn settled(&self, mut polished: Polished) -> Polished {
        const MOST: usize = 60;
        let mut places = self.resized(&polished.place);
        for _ in 0..MOST {
            let near = places.iter().filter_map(|place| self.polished(place));
            let better = |a: Polished, b: Polished| if self.rank(&b) < self.rank(&a) { b } else { a };
            let near = near.reduce(better).filter(|near| self.rank(near) < self.rank(&polished));
            places = self.neighbours(near.as_ref().map_or(&polished.place, |near| &near.place));
            match near.or_else(|| self.jump(&polished)) {
                Some(near) => polished = near,
                None => break,
            }
        }
        polished
    }

    /// The same shape in other sizes: where nothing depends on the size, values are nearer to steps in some of them.
    fn resized(&self, place: &[f64]) -> Vec<Vec<f64>> {
        /// The sizes, and the factor between two of them.
        const SIZES: i32 = 60;
        const FACTOR: f64 = 1.0125;
        let space = &self.meter.space;
        let resized = |factor: f64| -> Option<Vec<f64>> {
            let mut resized = place.to_vec();
            for (part, axis) in resized.iter_mut().zip(&space.axes) {
                if space.template().parameters[axis.slot].kind == ParameterKind::Length {
                    *part = axis.part(factor * axis.unstepped(*part))?;
                }
            }
            Some(resized)
        };
        (-SIZES..=SIZES).filter_map(|k| resized(trig::pow(FACTOR, f64::from(k)))).collect()
    }

    /// A better place some steps away, where few places meet the wishes.
    fn jump(&self, polished: &Polished) -> Option<Polished> {
        const TRIES: usize = 300;
        /// The spread of the steps.
        const SPREAD: f64 = 2.0;
        let axes = &self.meter.space.axes;
        let mut scatter = Scatter::new(0);
        let places = (0..TRIES).filter_map(|_| {
            let moved = polished.place.iter().enumerate().map(|(k, part)| {
                match axes.get(k).filter(|axis| axis.step.is_some()) {
                    Some(axis) => axis.stepped(*part, scatter.normal(SPREAD).round()),
                    None => Some(*part),
                }
            });
            moved.collect::<Option<Vec<f64>>>()
        });
        let places: Vec<Vec<f64>> = places.collect();
        places.iter().filter_map(|place| self.polished(place)).find(|other| self.rank(other) < self.rank(polished))
    }

    /// What is better has less of: the violation, unless all wishes are met to their tolerance, and then the objective.
    pub fn rank(&self, polished: &Polished) -> [f64; 2] {
        let violation = if polished.assessment.is_met { 0.0 } else { polished.sum };
        [violation, self.units.objective(&polished.assessment, self.objective)]
    }

    /// The places a step of one or two parameters away.
    fn neighbours(&self, place: &[f64]) -> Vec<Vec<f64>> {
        const STEPS: [f64; 3] = [-1.0, 0.0, 1.0];
        let axes = &self.meter.space.axes;
        let stepped: Vec<usize> = (0..axes.len()).filter(|&k| axes[k].step.is_some()).collect();
        let mut places = Vec::new();
        for (n, &k) in stepped.iter().enumerate() {
            for &l in &stepped[n..] {
                for (a, b) in STEPS.into_iter().flat_map(|a| STEPS.map(|b| (a, b))) {
                    // Of a single parameter the first step, of two both.
                    if a == 0.0 || (k == l) != (b == 0.0) {
                        continue;
                    }
                    let mut moved = place.to_vec();
                    let parts = [(k, a), (l, b)].map(|(axis, steps)| {
                        (axis, if steps == 0.0 { Some(place[axis]) } else { axes[axis].stepped(place[axis], steps) })
                    });
                    if let [(_, Some(first)), (_, Some(second))] = parts {
                        moved[l] = second;
                        moved[k] = first;
                        places.push(moved);
                    }
                }
            }
        }
        places
    }
}

impl Candidate for Polished {
    type Unknowns = Dyn;
    type Aim<'a> = Measuring<'a>;
    const NO_GAIN: f64 = 1e-9;

    fn objective(&self) -> f64 {
        self.sum
    }

    fn is_exact(&self, _: &Measuring<'_>) -> bool {
        /// The square of what measures are computed to.
        const EXACT: f64 = 1e-24;
        self.sum <= EXACT
    }

    fn equations(&self, measuring: &Measuring<'_>) -> Option<Equations<Dyn>> {
        /// The change of an unknown: the root of the accuracy of measures.
        const STEP: f64 = 1e-6;
        let count = self.place.len();
        let mut columns: Vec<Vec<f64>> = Vec::with_capacity(count);
        for k in 0..count {
            let is_stepped = measuring.meter.space.axes.get(k).is_some_and(|axis| axis.step.is_some());
            let column = |step: f64| {
                let mut place = self.place.clone();
                place[k] += step;
                let other = measuring.at(place, Some(self.assessment.curve))?;
                Some(other.residuals.iter().zip(&self.residuals).map(|(b, a)| (b - a) / step).collect())
            };
            let none = || vec![0.0; self.residuals.len()];
            columns.push(if is_stepped { none() } else { column(STEP).or_else(|| column(-STEP)).unwrap_or_else(none) });
        }
        let mut equations = Equations::new(Dyn(count));
        for (n, residual) in self.residuals.iter().enumerate().filter(|(_, residual)| **residual != 0.0) {
            let row: Vec<f64> = columns.iter().map(|column| column[n]).collect();
            equations.add(&row, -residual, 1.0);
        }
        Some(equations)
    }

    fn moved(&self, measuring: &Measuring<'_>, motion: &DVector<f64>) -> Option<Polished> {
        /// The greatest motion of an unknown.
        const MOST: f64 = 0.1;
        let scale = (MOST / motion.amax().max(MOST)).min(1.0);
        let place = self.place.iter().zip(motion.iter()).map(|(part, by)| part + scale * by).collect();
        measuring.at(place, Some(self.assessment.curve))
    }
}

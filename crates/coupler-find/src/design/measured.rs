//! The curves of a linkage with the measures that wishes use.

use coupler_curves::expression::CompiledExpression;
use coupler_curves::family::{Cell, Family};
use coupler_curves::geometry::trig;
use coupler_curves::linkage::Linkage;
use coupler_curves::measure::{self, MeasureSet, TracedCurve, Value};
use coupler_curves::motion::{Motion, Sampler, Sampling};
use coupler_curves::template::ParameterKind;

use super::assessment::Assessment;
use super::merit::Units;
use super::space::DesignSpace;
use super::wish::{Direction, Wishes};
use crate::linkage::{longest_link, scaled_values};

/// What is measured, and of which linkages.
pub(super) struct Meter {
    pub space: DesignSpace,
    pub wishes: Wishes,
    sampler: Sampler,
    /// The wishes in the order in which they are measured: those whose measures take longest last.
    order: Vec<usize>,
    /// By which power of the size each measure grows, if that is known of all that are used.
    powers: Option<Vec<i32>>,
}

/// A curve with the values of the measures that are used, by their indices.
pub(super) struct CurveMeasures {
    pub curve: [usize; 2],
    pub values: Vec<Value>,
}

/// A linkage with its curves.
pub(super) struct Measured {
    pub parameters: Vec<f64>,
    pub curves: Vec<CurveMeasures>,
    pub longest_link: f64,
}

impl Meter {
    /// Measures are properties of the curves, whatever their samples.
    const SAMPLES: usize = 120;

    pub fn new(space: DesignSpace, wishes: Wishes) -> Meter {
        let mut order: Vec<usize> = (0..wishes.wishes.len()).collect();
        // The later a measure is in the list, the longer it usually takes.
        order.sort_by_key(|&k| wishes.wishes[k].measures.iter().next_back());
        let sampler = Sampler::new(Sampling::Samples(Meter::SAMPLES));
        let mut meter = Meter { space, wishes, sampler, order, powers: None };
        if meter.space.is_scaled {
            meter.powers = meter.find_powers();
        }
        meter
    }

    /// The samples that can be assembled.
    pub fn assembled_samples(&self, count: usize) -> Vec<Vec<f64>> {
        /// Those among which they are sought.
        const AMONG: usize = 300;
        let places = (0..AMONG).map(|number| self.space.sample(number));
        places.filter(|place| self.measure_set(place, MeasureSet::EMPTY).is_some()).take(count).collect()
    }

    /// By which power of the size each measure that is used grows; `None` if one does not.
    fn find_powers(&self) -> Option<Vec<i32>> {
        const SAMPLES: usize = 8;
        /// Not a power of 2, which would be exact.
        const FACTOR: f64 = 1.7;
        /// Of measures relative to their size.
        const ACCURACY: f64 = 1e-6;
        const POWERS: std::ops::RangeInclusive<i32> = -2..=2;
        let mut powers: Vec<Option<i32>> = vec![None; measure::ALL.len()];
        for place in self.assembled_samples(SAMPLES) {
            let [one, other] = [1.0, FACTOR].map(|factor| self.measure(&self.space.resized(&place, factor)));
            let (one, other) = (one?, other?);
            let values =
                one.curves.iter().zip(&other.curves).flat_map(|(a, b)| a.values.iter().zip(&b.values).enumerate());
            for (k, pair) in values {
                let (Value::Number(a), Value::Number(b)) = pair else { continue };
                let is_of = |power: &i32| {
                    let expected = a * trig::pow(FACTOR, f64::from(*power));
                    (b - expected).abs() <= ACCURACY * b.abs().max(expected.abs())
                };
                match powers[k] {
                    _ if *a == 0.0 && *b == 0.0 => {}
                    Some(power) if !is_of(&power) => return None,
                    Some(_) => {}
                    None => powers[k] = Some(POWERS.into_iter().find(is_of)?),
                }
            }
        }
        Some(powers.into_iter().map(|power| power.unwrap_or(0)).collect())
    }

    /// Whether measures of paths are used.
    pub fn is_of_paths(&self) -> bool {
        !(self.wishes.measures() & MeasureSet::OF_PATHS).is_empty()
    }

    /// Whether what is wished depends on the size of the linkage.
    pub fn depends_on_size(&self) -> bool {
        let lengths = self.space.template().parameters.iter().map(|p| p.kind == ParameterKind::Length);
        let lengths: Vec<bool> = lengths.collect();
        let expressions = self.wishes.wishes.iter().map(|wish| &wish.condition);
        let expressions = expressions.chain(self.wishes.goals.iter().map(|goal| &goal.expression));
        let uses_length = |slot: &usize| lengths.get(*slot).copied().unwrap_or(false);
        self.wishes.max_link.is_finite()
            || self.powers.as_ref().is_none_or(|powers| powers.iter().any(|power| *power != 0))
            || expressions.flat_map(CompiledExpression::slots).any(uses_length)
    }

    /// A linkage as many times greater; `None` if it is not known how its measures grow.
    pub fn resized(&self, measured: &Measured, factor: f64) -> Option<Measured> {
        let powers = self.powers.as_ref()?;
        let grown = |(value, power): (&Value, &i32)| match value {
            Value::Number(number) if *power != 0 => Value::Number(number * trig::pow(factor, f64::from(*power))),
            other => *other,
        };
        let curve = |curve: &CurveMeasures| CurveMeasures {
            curve: curve.curve,
            values: curve.values.iter().zip(powers).map(grown).collect(),
        };
        Some(Measured {
            parameters: scaled_values(self.space.template(), &measured.parameters, factor),
            curves: measured.curves.iter().map(curve).collect(),
            longest_link: factor * measured.longest_link,
        })
    }

    /// The linkage at a place, with all measures that are used. `None` if it cannot be assembled.
    pub fn measure(&self, place: &[f64]) -> Option<Measured> {
        self.measure_set(place, self.wishes.measures())
    }

    /// The same with further measures.
    pub fn measure_set(&self, place: &[f64], measures: MeasureSet) -> Option<Measured> {
        self.of_curves(place, |_, curve| {
            let mut values = missing();
            compute(measures, curve, &mut values);
            Some(values)
        })
    }

    /// The same without the curves that violate the first wishes by more than a bound, which are measured no further.
    pub fn screened(&self, place: &[f64], units: &Units, most: f64) -> Option<Measured> {
        self.of_curves(place, |cell, curve| {
            let mut values = missing();
            let mut squares = 0.0;
            for &k in &self.order {
                let wish = &self.wishes.wishes[k];
                compute(wish.measures, curve, &mut values);
                let excess = wish.excess(|slot| Family::scope_value(cell, &values, slot));
                squares += units.violation_of(k, excess, wish.is_equality());
                // The size of the linkage is not known yet.
                if squares > most && !self.space.is_scaled {
                    return None;
                }
            }
            self.wishes.goals.iter().for_each(|goal| compute(goal.measures, curve, &mut values));
            Some(values)
        })
    }

    fn of_curves(
        &self,
        place: &[f64],
        measure: impl Fn(&Cell, &TracedCurve) -> Option<Vec<Value>>,
    ) -> Option<Measured> {
        let parameters = self.space.values(place)?;
        let linkage: Linkage = self.space.template().linkage(&parameters).ok()?;
        let motion = Motion::solve(&linkage, &self.sampler);
        let circuits = motion.circuits.len();
        let cell = Cell { number: 1, values: parameters };
        let numbered = TracedCurve::all(&linkage, &motion).enumerate();
        let curves = numbered.filter_map(|(k, curve)| {
            Some(CurveMeasures { curve: [k / circuits + 1, k % circuits + 1], values: measure(&cell, &curve)? })
        });
        let curves: Vec<CurveMeasures> = curves.collect();
        let longest_link = longest_link(&linkage);
        (!curves.is_empty()).then_some(Measured { parameters: cell.values, curves, longest_link })
    }

    /// How each curve of a linkage meets the wishes.
    pub fn assess(&self, measured: &Measured) -> Vec<Assessment> {
        let cell = Cell { number: 1, values: measured.parameters.clone() };
        let of_curve = |CurveMeasures { curve, values }: &CurveMeasures| {
            let load = |slot: usize| Family::scope_value(&cell, values, slot);
            let goal = |goal: &super::wish::Goal| {
                let value = goal.expression.evaluate(load);
                if goal.direction == Direction::Greatest { -value } else { value }
            };
            let link_excess = measured.longest_link - self.wishes.max_link;
            Assessment {
                curve: *curve,
                excesses: self.wishes.wishes.iter().map(|wish| wish.excess(load)).collect(),
                link_excess,
                goals: self.wishes.goals.iter().map(goal).collect(),
                is_met: link_excess <= 0.0 && self.wishes.wishes.iter().all(|wish| wish.is_met(load)),
            }
        };
        measured.curves.iter().map(of_curve).collect()
    }

    /// The curves of the linkage at a place, assessed.
    pub fn assess_at(&self, place: &[f64]) -> Vec<Assessment> {
        self.measure(place).map(|measured| self.assess(&measured)).unwrap_or_default()
    }
}

fn missing() -> Vec<Value> {
    vec![Value::Missing; measure::ALL.len()]
}

/// Computes those of a set that have no value yet.
fn compute(set: MeasureSet, curve: &TracedCurve, values: &mut [Value]) {
    for k in set.iter() {
        if values[k] == Value::Missing {
            values[k] = (measure::ALL[k].compute)(curve);
        }
    }
}

//! The order in which the measures of a curve are computed: a curve that `where` excludes is measured no further.

use crate::expression::CompiledExpression;
use crate::family::{Cell, Family};
use crate::measure::{self, TracedCurve, Value};

/// The conditions of a family's `where`, one after the other, and the measures to compute of the curves that it keeps.
#[derive(Clone, Debug)]
pub struct Screening {
    /// Each condition with the measures it uses, by their indices in [`measure::ALL`].
    conditions: Vec<(CompiledExpression, Vec<usize>)>,
    /// The measures of kept curves, by their indices in [`measure::ALL`].
    requested: Vec<usize>,
}

impl Screening {
    /// The screening of a family that computes the requested measures, by their indices in [`measure::ALL`]; those that
    /// `where` uses are computed in any case.
    pub fn new(family: &Family, requested: &[bool]) -> Screening {
        let used_by = |condition: CompiledExpression| {
            let used = (0..measure::ALL.len()).filter(|k| family.expression_uses(&condition, *k)).collect();
            (condition, used)
        };
        let conditions = family.filter.iter().flat_map(CompiledExpression::conjuncts);
        let mut conditions: Vec<(CompiledExpression, Vec<usize>)> = conditions.map(used_by).collect();
        // The later a measure is in the list, the longer it usually takes.
        conditions.sort_by_key(|(_, used)| used.last().copied());
        let requested = requested.iter().enumerate().filter(|(_, is_requested)| **is_requested).map(|(k, _)| k);
        Screening { conditions, requested: requested.collect() }
    }

    /// The values of [`measure::ALL`] of a curve, those that are not requested missing; `None` if `where` excludes it.
    pub(super) fn measure(&self, cell: &Cell, curve: &TracedCurve) -> Option<Vec<Value>> {
        let mut values = vec![Value::Missing; measure::ALL.len()];
        let mut is_computed = [false; measure::ALL.len()];
        let mut compute = |k: usize, values: &mut [Value]| {
            if !is_computed[k] {
                is_computed[k] = true;
                values[k] = (measure::ALL[k].compute)(curve);
            }
        };
        for (condition, used) in &self.conditions {
            used.iter().for_each(|&k| compute(k, &mut values));
            if condition.evaluate(|slot| Family::scope_value(cell, &values, slot)) != 1.0 {
                return None;
            }
        }
        self.requested.iter().for_each(|&k| compute(k, &mut values));
        Some(values)
    }
}

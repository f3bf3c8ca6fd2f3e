//! The order in which the measures of a curve are computed: a curve that `where` excludes is measured no further.

use crate::expression::CompiledExpression;
use crate::family::{Cell, Family};
use crate::measure::{self, MeasureSet, TracedCurve, Value};

/// The conditions of a family's `where`, one after the other, and the measures to compute of the curves that it keeps.
#[derive(Clone, Debug)]
pub(super) struct Screening {
    /// Each condition with the measures it uses.
    conditions: Vec<(CompiledExpression, MeasureSet)>,
    /// The measures of kept curves, in addition to those that the conditions use.
    pub requested: MeasureSet,
}

impl Screening {
    /// The screening of a family that computes its measures.
    pub fn new(family: &Family) -> Screening {
        let conditions = family.filter.iter().flat_map(CompiledExpression::conjuncts);
        let used_by = |condition: CompiledExpression| {
            let used = family.measures_in(&condition);
            (condition, used)
        };
        let mut conditions: Vec<(CompiledExpression, MeasureSet)> = conditions.map(used_by).collect();
        // The later a measure is in the list, the longer it usually takes.
        conditions.sort_by_key(|(_, used)| used.iter().next_back());
        Screening { conditions, requested: family.measures }
    }

    /// The values of [`measure::ALL`] of a curve, those that are not requested missing; `None` if `where` excludes it.
    pub fn measure(&self, cell: &Cell, curve: &TracedCurve) -> Option<Vec<Value>> {
        let mut values = vec![Value::Missing; measure::ALL.len()];
        let mut computed = MeasureSet::EMPTY;
        let mut compute = |set: MeasureSet, values: &mut [Value]| {
            set.iter().filter(|k| !computed.contains(*k)).for_each(|k| values[k] = (measure::ALL[k].compute)(curve));
            computed |= set;
        };
        for (condition, used) in &self.conditions {
            compute(*used, &mut values);
            if condition.evaluate(|slot| Family::scope_value(cell, &values, slot)) != 1.0 {
                return None;
            }
        }
        compute(self.requested, &mut values);
        Some(values)
    }
}

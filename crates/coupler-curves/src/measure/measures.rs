//! The list of measures.

use super::definition::{Measure, Value};
use super::{
    TracedCurve, class, dwell, four_bar_type, input_range, output, path, shape, six_bar, speed_ratio, straight,
    symmetry, transmission,
};

impl Measure {
    /// The measure that has this name for some linkage.
    pub fn find(name: &str) -> Option<&'static Measure> {
        ALL.iter().find(|measure| measure.names().any(|own| own == name))
    }
}

/// All measures, in the order of the columns.
pub static ALL: [Measure; 63] = [
    class::CLASS,
    four_bar_type::TYPE,
    four_bar_type::SHORTEST,
    six_bar::SIX_BAR,
    input_range::IS_FULL_TURN,
    input_range::INPUT_MIN,
    input_range::INPUT_MAX,
    input_range::LIMIT_POSITIONS,
    output::MIN,
    output::MAX,
    output::SWING,
    output::STROKE,
    transmission::MU_MIN,
    transmission::MU_MAX,
    transmission::MU_WORST,
    output::TIME_RATIO,
    output::DWELL,
    output::DWELL_START,
    output::TOGGLES,
    output::VELOCITY_RATIO_MIN,
    output::VELOCITY_RATIO_MAX,
    output::MECHANICAL_ADVANTAGE_MIN,
    output::MECHANICAL_ADVANTAGE_MAX,
    path::LENGTH,
    path::AREA,
    path::BOUNDING_BOX[0],
    path::BOUNDING_BOX[1],
    path::BOUNDING_BOX[2],
    path::BOUNDING_BOX[3],
    shape::CUSPS,
    shape::CRUNODES,
    shape::INFLECTIONS,
    shape::TOO_CLOSE,
    symmetry::SYMMETRY,
    symmetry::AXIS,
    symmetry::RESIDUAL,
    shape::CURVATURE_MAX,
    speed_ratio::SPEED_RATIO,
    straight::MEASURES[0],
    straight::MEASURES[1],
    straight::MEASURES[2],
    straight::MEASURES[3],
    straight::MEASURES[4],
    straight::MEASURES[5],
    straight::WIDER[0][0],
    straight::WIDER[0][1],
    straight::WIDER[0][2],
    straight::WIDER[0][3],
    straight::WIDER[0][4],
    straight::WIDER[1][0],
    straight::WIDER[1][1],
    straight::WIDER[1][2],
    straight::WIDER[1][3],
    straight::WIDER[1][4],
    straight::HALF_TURN[0],
    straight::HALF_TURN[1],
    straight::HALF_TURN[2],
    dwell::MEASURES[0],
    dwell::MEASURES[1],
    dwell::MEASURES[2],
    dwell::MEASURES[3],
    dwell::MEASURES[4],
    dwell::MEASURES[5],
];

/// A boolean name of `where`: true where a measure that is a word has a certain value, false where it has another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Boolean {
    /// Its name.
    pub name: &'static str,
    /// The name of the measure.
    pub measure: &'static str,
    /// The value of the measure for which it is true.
    pub word: &'static str,
}

/// All booleans.
pub static BOOLEANS: [Boolean; 7] = [
    Boolean::of_class("is_crank_rocker", "crank-rocker"),
    Boolean::of_class("is_rocker_crank", "rocker-crank"),
    Boolean::of_class("is_drag_link", "drag-link"),
    Boolean::of_class("is_double_rocker", "double-rocker"),
    Boolean::of_class("is_triple_rocker", "triple-rocker"),
    Boolean::of_class("is_change_point", "change-point"),
    Boolean { name: input_range::IS_FULL_TURN.name, measure: input_range::IS_FULL_TURN.name, word: input_range::YES },
];

impl Boolean {
    const fn of_class(name: &'static str, class: &'static str) -> Boolean {
        Boolean { name, measure: class::CLASS.name, word: class }
    }

    /// Its value as a number, 1 or 0, with the values of [`ALL`]; NaN if the measure does not apply.
    pub fn value(&self, values: &[Value]) -> f64 {
        match ALL.iter().zip(values).find(|(measure, _)| measure.name == self.measure) {
            Some((_, Value::Word(word))) => f64::from(u8::from(*word == self.word)),
            _ => f64::NAN,
        }
    }
}

/// Computes all measures of a curve, in the order of [`ALL`].
pub fn compute_all(curve: &TracedCurve) -> Vec<Value> {
    compute_selected(curve, |_| true)
}

/// Computes the selected measures of a curve, in the order of [`ALL`]; the others are [`Value::Missing`]. `is_selected`
/// is called with indices of [`ALL`].
pub fn compute_selected(curve: &TracedCurve, is_selected: impl Fn(usize) -> bool) -> Vec<Value> {
    let value =
        |(k, measure): (usize, &Measure)| if is_selected(k) { (measure.compute)(curve) } else { Value::Missing };
    ALL.iter().enumerate().map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linkage::FourBarClass;

    #[test]
    fn every_class_has_a_boolean() {
        for class in FourBarClass::ALL {
            let name = format!("is_{}", class.name().replace('-', "_"));
            let boolean = BOOLEANS.iter().find(|boolean| boolean.name == name).unwrap_or_else(|| panic!("{name}"));
            assert_eq!((boolean.measure, boolean.word), ("class", class.name()));
        }
        for boolean in &BOOLEANS {
            assert!(ALL.iter().any(|measure| measure.name == boolean.measure && measure.is_word), "{boolean:?}");
        }
    }
}

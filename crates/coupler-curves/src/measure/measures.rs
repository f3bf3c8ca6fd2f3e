//! The list of measures.

use std::ops::Deref;

use super::definition::{Measure, MeasureKey, MeasureValue, Value};
use super::{
    TracedCurve, class, dwell, four_bar_type, input_range, moves, output, path, shape, six_bar, speed_ratio, straight,
    symmetry, torque, transmission,
};

impl Measure {
    /// The measure that has this name for some linkage.
    pub fn find(name: &str) -> Option<&'static Measure> {
        ALL.iter().find(|measure| measure.names().any(|own| own == name))
    }
}

/// The table of measures: makes [`ALL`], and of each row a constant of [`Measure`], which has its index and the type of its values.
macro_rules! measures {
    ($($name:ident: $value:ty = $measure:expr,)*) => {
        /// The indices of the rows.
        #[expect(non_camel_case_types, clippy::upper_case_acronyms, reason = "rows have the names of constants")]
        enum Row { $($name,)* Count }

        /// All measures, in the order of the columns.
        pub static ALL: [Measure; Row::Count as usize] = [$($measure),*];

        /// A constant for each measure, to ask a curve for it: the name of its column in capitals, without `_DEG` where no other
        /// measure has that name.
        impl Measure {
            $(
                #[doc = concat!("The measure `", stringify!($name), "`.")]
                pub const $name: MeasureKey<$value> = MeasureKey::new(Row::$name as usize, &$measure);
            )*
        }

        #[cfg(test)]
        const CONSTANTS: [(&str, &str); Row::Count as usize] = [$((stringify!($name), $measure.name)),*];
    };
}

measures! {
    CLASS: &'static str = class::CLASS,
    TYPE: &'static str = four_bar_type::TYPE,
    SHORTEST: &'static str = four_bar_type::SHORTEST,
    SIX_BAR: &'static str = six_bar::SIX_BAR,
    IS_FULL_TURN: &'static str = input_range::IS_FULL_TURN,
    INPUT_MIN: f64 = input_range::INPUT_MIN,
    INPUT_MAX: f64 = input_range::INPUT_MAX,
    LIMIT_POSITIONS: f64 = input_range::LIMIT_POSITIONS,
    OUTPUT_MIN: f64 = output::MIN,
    OUTPUT_MAX: f64 = output::MAX,
    OUTPUT_SWING: f64 = output::SWING,
    OUTPUT_STROKE: f64 = output::STROKE,
    MU_MIN: f64 = transmission::MU_MIN,
    MU_MAX: f64 = transmission::MU_MAX,
    MU_WORST: f64 = transmission::MU_WORST,
    TIME_RATIO: f64 = output::TIME_RATIO,
    OUTPUT_DWELL: f64 = output::DWELL,
    OUTPUT_DWELL_START: f64 = output::DWELL_START,
    TOGGLES: f64 = output::TOGGLES,
    VELOCITY_RATIO_MIN: f64 = output::VELOCITY_RATIO_MIN,
    VELOCITY_RATIO_MAX: f64 = output::VELOCITY_RATIO_MAX,
    MECHANICAL_ADVANTAGE_MIN: f64 = output::MECHANICAL_ADVANTAGE_MIN,
    MECHANICAL_ADVANTAGE_MAX: f64 = output::MECHANICAL_ADVANTAGE_MAX,
    TORQUE_PEAK: f64 = torque::TORQUE_PEAK,
    TORQUE_PEAK_DEG: f64 = torque::TORQUE_PEAK_INPUT,
    TORQUE_MIN: f64 = torque::TORQUE_MIN,
    TORQUE_MAX: f64 = torque::TORQUE_MAX,
    SENSITIVITY_MAX: f64 = moves::SENSITIVITY,
    SENSITIVITY_LENGTH: &'static str = moves::LENGTH,
    TOLERANCE_WORST: f64 = moves::WORST,
    TOLERANCE_RSS: f64 = moves::ROOT_SUM_SQUARE,
    LENGTH: f64 = path::LENGTH,
    AREA: f64 = path::AREA,
    BBOX_X_MIN: f64 = path::BOUNDING_BOX[0],
    BBOX_X_MAX: f64 = path::BOUNDING_BOX[1],
    BBOX_Y_MIN: f64 = path::BOUNDING_BOX[2],
    BBOX_Y_MAX: f64 = path::BOUNDING_BOX[3],
    BBOX_WIDTH: f64 = path::SIZE[0],
    BBOX_HEIGHT: f64 = path::SIZE[1],
    CUSPS: f64 = shape::CUSPS,
    CRUNODES: f64 = shape::CRUNODES,
    INFLECTIONS: f64 = shape::INFLECTIONS,
    TOO_CLOSE: &'static str = shape::TOO_CLOSE,
    SYMMETRY: &'static str = symmetry::SYMMETRY,
    SYMMETRY_DEG: f64 = symmetry::AXIS,
    SYMMETRY_RESIDUAL: f64 = symmetry::RESIDUAL,
    CURVATURE_MAX: f64 = shape::CURVATURE_MAX,
    SPEED_RATIO: f64 = speed_ratio::SPEED_RATIO,
    STRAIGHT_LENGTH: f64 = straight::MEASURES[0],
    STRAIGHT_SHARE: f64 = straight::MEASURES[1],
    STRAIGHT_DEVIATION: f64 = straight::MEASURES[2],
    STRAIGHT_START: f64 = straight::MEASURES[3],
    STRAIGHT_INPUT: f64 = straight::MEASURES[4],
    STRAIGHT_TWIN: f64 = straight::MEASURES[5],
    STRAIGHT_5_LENGTH: f64 = straight::WIDER[0][0],
    STRAIGHT_5_SHARE: f64 = straight::WIDER[0][1],
    STRAIGHT_5_DEVIATION: f64 = straight::WIDER[0][2],
    STRAIGHT_5_START: f64 = straight::WIDER[0][3],
    STRAIGHT_5_INPUT: f64 = straight::WIDER[0][4],
    STRAIGHT_10_LENGTH: f64 = straight::WIDER[1][0],
    STRAIGHT_10_SHARE: f64 = straight::WIDER[1][1],
    STRAIGHT_10_DEVIATION: f64 = straight::WIDER[1][2],
    STRAIGHT_10_START: f64 = straight::WIDER[1][3],
    STRAIGHT_10_INPUT: f64 = straight::WIDER[1][4],
    STRAIGHT_HALF_TURN_LENGTH: f64 = straight::HALF_TURN[0],
    STRAIGHT_HALF_TURN_DEVIATION: f64 = straight::HALF_TURN[1],
    STRAIGHT_HALF_TURN_START: f64 = straight::HALF_TURN[2],
    DWELL_INPUT: f64 = dwell::MEASURES[0],
    DWELL_RADIUS: f64 = dwell::MEASURES[1],
    DWELL_DEVIATION: f64 = dwell::MEASURES[2],
    DWELL_START: f64 = dwell::MEASURES[3],
    DWELL_X: f64 = dwell::MEASURES[4],
    DWELL_Y: f64 = dwell::MEASURES[5],
}

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

impl<T> Deref for MeasureKey<T> {
    type Target = Measure;

    fn deref(&self) -> &Measure {
        &ALL[self.index]
    }
}

impl TracedCurve<'_> {
    /// Computes a measure; `None` where it does not apply.
    pub fn measure<T: MeasureValue>(&self, key: MeasureKey<T>) -> Option<T> {
        T::from_value((key.compute)(self))
    }
}

/// Computes all measures of a curve, in the order of [`ALL`].
pub fn compute_all(curve: &TracedCurve) -> Vec<Value> {
    ALL.iter().map(|measure| (measure.compute)(curve)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linkage::FourBarClass;

    #[test]
    fn constants_have_the_names_of_columns() {
        for (constant, column) in CONSTANTS {
            let column = column.to_uppercase();
            assert!([&*column, column.trim_end_matches("_DEG")].contains(&constant), "{constant} is {column}");
        }
        assert_eq!((Measure::MU_WORST.name, Measure::CLASS.name), ("mu_worst_deg", "class"));
    }

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

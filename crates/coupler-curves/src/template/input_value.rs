//! Values of the input as expressions.

use crate::expression::{CompiledExpression, MathText, Unit};
use crate::text::format_as_written;

/// A value of the input as an expression: an angle, evaluated in degrees, or a length.
#[derive(Clone, Debug, PartialEq)]
pub struct InputValue {
    /// The number of units.
    pub value: CompiledExpression,
    /// Degrees or radians; none for a length.
    pub unit: Option<Unit>,
}

impl InputValue {
    pub(crate) fn evaluate(&self, values: &[f64]) -> f64 {
        let value = self.value.evaluate(|slot| values[slot]);
        self.unit.map_or(value, |unit| unit.to_base_unit(value))
    }

    /// The value as it is printed: a number with its unit; that of a parameter is stated with its unit.
    pub fn to_math_text(&self) -> MathText {
        let is_number = self.value.slots().is_empty();
        let unit = match self.unit {
            Some(Unit::Deg) if is_number => "°",
            Some(Unit::Rad) if is_number => " rad",
            _ => "",
        };
        let number = match (self.unit, self.value.constant_value()) {
            // As a quotient, only its divisor would seem to be of degrees.
            (Some(Unit::Deg), Some(value)) => MathText::from_words(format_as_written(value)),
            _ => self.value.to_math_text(),
        };
        number.with_words(unit)
    }
}

//! Quantities: expressions with a unit.

use super::unit::{Dimension, Unit};
use super::{Error, Expression, parser};

/// An expression and a unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// The number of units.
    pub expression: Expression,
    /// The unit.
    pub unit: Unit,
}

impl Quantity {
    /// Parses a quantity such as `360/7 deg`.
    ///
    /// # Errors
    /// An error in the expression; a unit that is missing, unknown or of another dimension.
    pub fn parse(text: &str, dimension: Dimension) -> Result<Quantity, Error> {
        let (expression, word) = parser::parse_expression_and_word(text)?;
        let Some((word, span)) = word else {
            return Err(Error::new(0..text.len(), "the unit is missing", dimension.example()));
        };
        match dimension.unit(&word) {
            Some(unit) => Ok(Quantity { expression, unit }),
            None => Err(Error::new(span, format!("`{word}` is not a unit here"), dimension.example())),
        }
    }

    /// The value in degrees or millimetres; names are loaded as in [`Expression::evaluate`].
    pub fn evaluate(&self, load: impl Fn(usize) -> f64) -> f64 {
        self.unit.to_base_unit(self.expression.evaluate(load))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_converted_and_unknown_ones_are_errors() {
        let value = |text, dimension| Quantity::parse(text, dimension).map(|q| q.evaluate(|_| f64::NAN));
        assert_eq!(value("2 deg", Dimension::Angle), Ok(2.0));
        assert_eq!(value("pi rad", Dimension::Angle), Ok(180.0));
        assert_eq!(value("deg(pi) deg", Dimension::Angle), Ok(180.0));
        assert_eq!(value("17 in", Dimension::PaperLength), Ok(431.8));
        assert_eq!(value("72 pt", Dimension::PaperLength), Ok(25.4));
        assert_eq!(value("2", Dimension::Angle).unwrap_err().message, "the unit is missing");
        assert_eq!(value("2 mm", Dimension::Angle).unwrap_err().message, "`mm` is not a unit here");
    }
}

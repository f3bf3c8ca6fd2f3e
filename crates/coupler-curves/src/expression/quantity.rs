//! Quantities: expressions with a unit.

use super::{Error, Expression, parser};
use crate::geometry::trig;

/// A unit a quantity can be given in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Degrees.
    Deg,
    /// Radians.
    Rad,
    /// Millimetres.
    Mm,
    /// Inches of 25.4 mm.
    In,
    /// Points, 72 to the inch.
    Pt,
}

/// The dimension of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// An angle, evaluated in degrees, so that `2 deg` remains exactly 2.
    Angle,
    /// A length on paper, evaluated in millimetres.
    PaperLength,
}

impl Dimension {
    /// The units it can be given in, with their names.
    pub fn units(self) -> &'static [(&'static str, Unit)] {
        match self {
            Dimension::Angle => &[("deg", Unit::Deg), ("rad", Unit::Rad)],
            Dimension::PaperLength => &[("mm", Unit::Mm), ("in", Unit::In), ("pt", Unit::Pt)],
        }
    }

    /// The unit of a name; `None` if it is none of this dimension.
    pub fn unit(self, name: &str) -> Option<Unit> {
        self.units().iter().find(|(known, _)| *known == name).map(|(_, unit)| *unit)
    }

    fn example(self) -> &'static str {
        match self {
            Dimension::Angle => "write an angle like \"2 deg\" or \"pi / 90 rad\"",
            Dimension::PaperLength => "write a length on paper like \"432 mm\", \"17 in\" or \"1224 pt\"",
        }
    }
}

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

impl Unit {
    /// Its name.
    pub fn name(self) -> &'static str {
        let all = [Dimension::Angle, Dimension::PaperLength].into_iter().flat_map(Dimension::units);
        all.into_iter().find(|(_, unit)| *unit == self).map_or("", |(name, _)| name)
    }

    /// Converts a number of this unit to degrees or millimetres.
    pub fn to_base_unit(self, value: f64) -> f64 {
        match self {
            Unit::Deg | Unit::Mm => value,
            Unit::Rad => trig::degrees(value),
            // 254 and 10 are exact in binary, 25.4 is not.
            Unit::In => value * 254.0 / 10.0,
            Unit::Pt => value * 254.0 / 720.0,
        }
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

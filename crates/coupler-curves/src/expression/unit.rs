//! The units of quantities, and their dimensions.

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

    /// What to write for a value that has no unit of this dimension.
    pub(crate) fn example(self) -> &'static str {
        match self {
            Dimension::Angle => "write an angle like \"2 deg\" or \"pi / 90 rad\"",
            Dimension::PaperLength => "write a length on paper like \"432 mm\", \"17 in\" or \"1224 pt\"",
        }
    }
}

/// The units of lengths that people write, and what `unit` of the manifest calls them.
const LENGTH_UNITS: [(&str, &str); 8] = [
    ("mm", "mm"),
    ("millimetres", "mm"),
    ("millimeters", "mm"),
    ("cm", "cm"),
    ("m", "m"),
    ("in", "in"),
    ("inch", "in"),
    ("inches", "in"),
];

/// What to do about a length with a unit, if a word is one.
pub(crate) fn length_unit_help(word: &str) -> Option<String> {
    let (_, unit) = LENGTH_UNITS.iter().find(|(name, _)| name.eq_ignore_ascii_case(word))?;
    Some(format!(
        "lengths are numbers in the unit of the atlas: leave it out here, and write unit = \"{unit}\" in [atlas] if it is that"
    ))
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

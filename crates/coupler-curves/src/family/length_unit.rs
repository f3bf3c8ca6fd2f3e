//! The units of lengths that a family may have.

/// The unit of the lengths of a family. Without one they are in a unit of their own, which pages and drawings do not name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthUnit {
    /// Millimetres.
    Millimetre,
    /// Centimetres.
    Centimetre,
    /// Metres.
    Metre,
    /// Inches of 25.4 mm.
    Inch,
}

impl LengthUnit {
    /// All of them, by their symbols.
    pub const ALL: [(&'static str, LengthUnit); 4] = [
        ("mm", LengthUnit::Millimetre),
        ("cm", LengthUnit::Centimetre),
        ("m", LengthUnit::Metre),
        ("in", LengthUnit::Inch),
    ];

    /// Its symbol.
    pub fn symbol(self) -> &'static str {
        match self {
            LengthUnit::Millimetre => "mm",
            LengthUnit::Centimetre => "cm",
            LengthUnit::Metre => "m",
            LengthUnit::Inch => "in",
        }
    }

    /// What a page says of its lengths: `lengths in mm`.
    pub fn note(self) -> String {
        let words = if self == LengthUnit::Inch { "inches" } else { self.symbol() };
        format!("lengths in {words}")
    }

    /// Its length in millimetres.
    pub fn millimetres(self) -> f64 {
        match self {
            LengthUnit::Millimetre => 1.0,
            LengthUnit::Centimetre => 10.0,
            LengthUnit::Metre => 1000.0,
            LengthUnit::Inch => 25.4,
        }
    }

    /// The code of a unit in DXF, the value of `$INSUNITS`: 0 without a unit.
    ///
    /// # Source
    /// *AutoCAD DXF Reference*, header variables.
    pub fn dxf_code(unit: Option<LengthUnit>) -> u8 {
        match unit {
            None => 0,
            Some(LengthUnit::Inch) => 1,
            Some(LengthUnit::Millimetre) => 4,
            Some(LengthUnit::Centimetre) => 5,
            Some(LengthUnit::Metre) => 6,
        }
    }
}

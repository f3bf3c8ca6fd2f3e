//! How far an output may move while it dwells.

/// The width of the band within which an output dwells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DwellBand {
    /// A share of the swing or the stroke of the output, or of a turn if it turns fully.
    Share(f64),
    /// An angle of an output link that turns, in degrees.
    Angle(f64),
    /// A displacement of an output slider, in the unit of the lengths.
    Length(f64),
}

impl Default for DwellBand {
    fn default() -> DwellBand {
        DwellBand::Share(0.01)
    }
}

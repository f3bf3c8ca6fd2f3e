//! The kind of input that drives a linkage.

/// The kind of input that drives a linkage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// The angle of a crank, in degrees.
    Angle {
        /// The turns of the crank after which every joint is back at its position; with a rack, which never is, more than its range has.
        turns: u32,
    },
    /// The length of a linear actuator.
    Length,
}

impl Input {
    /// The change of the input after which every joint is back at its position, in degrees. A length is not periodic:
    /// its period is greater than any length.
    pub fn period(self) -> f64 {
        match self {
            Input::Angle { turns } => 360.0 * f64::from(turns),
            Input::Length => f64::MAX / 8.0,
        }
    }

    /// What is written after a value of it: the sign of degrees, or nothing for a length.
    pub fn unit_sign(self) -> &'static str {
        match self {
            Input::Angle { .. } => "°",
            Input::Length => "",
        }
    }
}

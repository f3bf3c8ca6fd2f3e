//! Why a linkage has no cognates.

/// Why a linkage has no cognates.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CognateError {
    /// The linkage is not a four-bar.
    #[error("the linkage is not a four-bar of a crank and one dyad with points on their links")]
    NotFourBar,
    /// The traced joint is on another link.
    #[error("`{joint}` is not a point of the coupler")]
    NotOnCoupler {
        /// The traced joint.
        joint: String,
    },
    /// The coupler point is a pin.
    #[error("the coupler point is the {pin} pin, which traces a circle: one cognate would have links of length 0")]
    CouplerPointOnPin {
        /// The pin: `crank` or `rocker`.
        pin: &'static str,
    },
}

impl CognateError {
    /// How to fix it, for `help:`.
    pub fn help(&self) -> &'static str {
        match self {
            CognateError::NotFourBar => "name a linkage for which `inspect` prints a class",
            CognateError::NotOnCoupler { .. } => "trace a point of the link with the crank pin and the rocker pin",
            CognateError::CouplerPointOnPin { .. } => "choose a coupler point that is not a pin",
        }
    }
}

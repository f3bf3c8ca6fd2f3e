//! What counts as a fit of a curve.

/// What counts as a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveFitOptions {
    /// Whether the curve stays where it is, in position, size and direction.
    pub is_fixed: bool,
    /// Whether the curve may be mirrored, if it is not fixed.
    pub may_be_mirrored: bool,
    /// The least part of a curve's length that may be like an open target, if it is not fixed: a short enough portion of any curve
    /// is an arc of a circle.
    pub least_portion: f64,
}

impl Default for CurveFitOptions {
    fn default() -> CurveFitOptions {
        CurveFitOptions { is_fixed: false, may_be_mirrored: true, least_portion: 0.15 }
    }
}

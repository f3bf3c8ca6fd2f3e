//! The motion of the output link, with what is computed from it once for all measures.

use std::cell::OnceCell;

use super::coordinate::OutputCoordinate;
use crate::linkage::DwellBand;
use crate::measure::circuit_function::{CircuitFunction, Extreme};

/// The coordinate of the output link along a circuit, in radians or in the manifest's unit. What is computed from it is
/// computed once for all measures.
#[derive(Clone, Debug)]
pub(in crate::measure) struct OutputMotion {
    pub(super) coordinate: CircuitFunction<OutputCoordinate>,
    /// Whether it turns fully: round a closed circuit it makes whole turns.
    pub(super) turns_fully: bool,
    pub(super) extremes: [Extreme; 2],
    pub(super) dwell_band: DwellBand,
    pub(super) dwell: OnceCell<Option<Stretch>>,
    pub(super) velocity_ratios: OnceCell<VelocityRatios>,
    pub(super) toggle_count: OnceCell<usize>,
}

/// A stretch of a circuit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::measure) struct Stretch {
    /// The input at which it begins.
    pub start_input: f64,
    /// The input it spans, which is counted forward and backward at limits.
    pub input_span: f64,
}

/// The extremes of the velocity ratio over a circuit.
#[derive(Clone, Copy, Debug)]
pub(in crate::measure) struct VelocityRatios {
    /// The least and the greatest.
    pub range: [f64; 2],
    /// The least and the greatest magnitude.
    pub magnitudes: [f64; 2],
}

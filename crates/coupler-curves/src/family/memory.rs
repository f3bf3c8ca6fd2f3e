//! The memory that the cells of a family take, estimated before they are solved.

use super::{Family, Sampling};
use crate::linkage::Input;
use crate::motion;
use crate::template::CircuitSelection;

/// The memory of a value in an additional column of a row, in bytes.
const BYTES_PER_COLUMN: usize = 20;

/// The most circuits that a linkage is assumed to have. If it has more, and they take too much memory, it counts as
/// not assembled.
const MAX_CIRCUITS: usize = 8;

impl Family {
    /// The memory that a solved cell and its rows in tables take, in bytes, estimated from the first cell.
    ///
    /// Cells that are in memory together should take at most [`motion::MAX_CIRCUIT_BYTES`].
    pub fn estimate_cell_bytes(&self) -> usize {
        // The cells of a family differ in their dimensions only.
        let Ok(linkage) = self.linkage(&self.cell(0)) else { return 0 };
        let turns = match linkage.input() {
            Input::Angle { turns } => turns as usize,
            Input::Length => 1,
        };
        let samples = match self.sampling {
            Sampling::Step(step) if linkage.input() != Input::Length => ((360.0 / step) as usize).saturating_mul(turns),
            // The length of a stroke is known only when the linkage is solved.
            Sampling::Step(_) => 0,
            Sampling::Samples(n) | Sampling::DenseAtLimits(n) | Sampling::ArcLength(n) => n,
        };
        // Each assembly mode may have a circuit of its own.
        let circuits = match self.template.circuits {
            CircuitSelection::Start => 1,
            CircuitSelection::All => 1usize.checked_shl(linkage.dyad_count() as u32).unwrap_or(MAX_CIRCUITS),
        };
        let circuits = circuits.min(MAX_CIRCUITS);
        let column_bytes = linkage.traced.len() * self.columns.len() * BYTES_PER_COLUMN;
        let bytes = motion::estimate_bytes(&linkage, std::iter::repeat_n(samples, circuits));
        bytes.saturating_add(samples.saturating_mul(circuits * column_bytes))
    }
}

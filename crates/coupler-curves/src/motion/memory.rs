//! The memory that the circuits of a linkage take, estimated before they are sampled.

use super::AssemblyError;
use super::circuit::UnsampledCircuit;
use super::limits::MAX_CIRCUIT_BYTES;
use super::pieces::estimate_node_count;
use super::sampling::Sampler;
use crate::linkage::{Input, Linkage};

/// The bytes of a position.
const POSITION_BYTES: usize = 16;
/// The bytes of a sample in addition to the positions of joints.
const SAMPLE_BYTES: usize = 24;
/// The bytes of the row of a sample of a curve.
const ROW_BYTES: usize = 100;
/// The bytes of a curve: its measures, and its path on a page.
const CURVE_BYTES: usize = 20_000;
/// The pieces of a path in a turn of the input, if a dash and its gap are one degree.
const PIECES_PER_TURN: usize = 720;

/// The memory for circuits of a linkage, their curves and their rows in tables, in bytes, estimated from the number of
/// samples of each circuit.
pub fn estimate_bytes(linkage: &Linkage, sample_counts: impl IntoIterator<Item = usize>) -> usize {
    let (joints, traced) = (linkage.joints.len(), linkage.traced.len());
    let turns = match linkage.input() {
        Input::Angle { turns } => turns as usize,
        Input::Length => 1,
    };
    // A path of one turn is among what a curve takes.
    let further_turns = turns.saturating_sub(1);
    let path_bytes = further_turns.saturating_mul((joints + traced) * PIECES_PER_TURN * POSITION_BYTES);
    let nodes = estimate_node_count(linkage);
    let circuit_bytes = |samples: usize| {
        let positions = samples.saturating_add(nodes).saturating_mul(joints).saturating_mul(POSITION_BYTES);
        let rows = samples.saturating_mul(SAMPLE_BYTES + traced * ROW_BYTES);
        positions.saturating_add(rows).saturating_add(traced * CURVE_BYTES).saturating_add(path_bytes)
    };
    sample_counts.into_iter().map(circuit_bytes).fold(0, usize::saturating_add)
}

/// The error to report if circuits would take too much memory.
pub(super) fn memory_error(
    linkage: &Linkage,
    circuits: &[UnsampledCircuit],
    sampler: &Sampler,
) -> Option<AssemblyError> {
    let bytes = estimate_bytes(linkage, circuits.iter().map(|circuit| sampler.sample_count(circuit)));
    (bytes > MAX_CIRCUIT_BYTES).then_some(AssemblyError::TooMuchMemory { bytes, circuits: circuits.len() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use crate::linkage::{LinkageBuilder, MotionOptions};
    use crate::motion::{Motion, Sampling};

    /// A crank with a number of traced points.
    fn crank_with_points(count: usize) -> Linkage {
        let mut builder = LinkageBuilder::default();
        let pivot = builder.fixed("O", Point::origin());
        let pin = builder.crank("A", pivot, 1.0).unwrap();
        let traced = (0..count).map(|k| builder.point("M", [pivot, pin], k as f64, 1.0).unwrap()).collect();
        builder.build(traced, None, MotionOptions::default()).unwrap()
    }

    #[test]
    fn circuits_that_do_not_fit_memory_are_not_sampled() {
        let sampler = Sampler::new(Sampling::Samples(100_000));
        assert_eq!(Motion::solve(&crank_with_points(2), &sampler).circuits.len(), 1);
        let motion = Motion::solve(&crank_with_points(200), &sampler);
        assert!(!motion.is_assembled());
        let message = motion.assembly_error.unwrap().to_string();
        assert!(message.starts_with("its circuits, of which there are 1, would take about 23"), "{message}");
        assert!(message.ends_with(" MB, more than the limit of 240 MB"), "{message}");
    }

    #[test]
    fn the_estimate_counts_positions_and_rows() {
        let bytes = |samples| estimate_bytes(&crank_with_points(1), [samples]);
        // Three joints and one row for each sample.
        assert_eq!(bytes(2000) - bytes(1000), 1000 * (3 * POSITION_BYTES + SAMPLE_BYTES + ROW_BYTES));
        assert_eq!(estimate_bytes(&crank_with_points(1), [usize::MAX, 9]), usize::MAX);
    }
}
